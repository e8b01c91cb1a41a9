//! Hard constraints: they hold to 1e-9 m, their forces are those that statics asks for, and sets that cannot hold are told.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::contact::options::Friction;
use superhelix::math::frame::Frame;
use superhelix::solver::Solver;
use superhelix::solver::constraints::{ConstraintDef, ConstraintStatus, Hold};
use superhelix::solver::definition::{SolverOptions, StrandDef};
use superhelix::solver::id::StrandId;
use superhelix::step::options::Integrator;

const GRAVITY: f64 = 9.81;

/// A strand of 10 cm, stiff enough to be a rod and damped enough to come to rest.
fn strand(elements: usize) -> StrandDef {
    let mut def = StrandDef::straight(0.1, elements);
    def.material.viscosity = 0.05;
    def.material.air_drag = 2e-4;
    def
}

fn solver(integrator: Integrator) -> Solver {
    let mut options = SolverOptions::default();
    options.step.integrator = integrator;
    Solver::new(options).unwrap()
}

fn pin(strand: StrandId, arclength: f64, at: [f64; 3]) -> ConstraintDef {
    let target = Frame { origin: Vector3::from(at), rotation: UnitQuaternion::identity() };
    ConstraintDef { strand, arclength, hold: Hold::Point, target, compliance: 0.0 }
}

fn point(solver: &Solver, id: StrandId, arclength: f64) -> Vector3<f64> {
    let mut at = Vector3::zeros();
    solver.sample_at(id, &[arclength], |_, sample| at = sample.position).unwrap();
    at
}

#[test]
fn a_pinned_point_stays_and_its_force_carries_the_weight() {
    for integrator in [Integrator::ImplicitEuler, Integrator::SecondOrder] {
        let mut solver = solver(integrator);
        let def = strand(10);
        let weight = def.material.linear_density() * def.length() * GRAVITY;
        let id = solver.add_strands(&[def]).unwrap()[0];
        let held = solver.add_constraints(&[pin(id, 0.1, [0.08, 0.0, -0.01])]).unwrap()[0];
        let mut worst = 0.0_f64;
        for _ in 0..600 {
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            assert_eq!(report.quarantined, 0);
            worst = worst.max((point(&solver, id, 0.1) - Vector3::new(0.08, 0.0, -0.01)).norm());
        }
        let report = solver.step(1.0 / 60.0, 1).unwrap();
        let state = solver.constraint_state(held).unwrap();
        let wrench = solver.root_wrench(id).unwrap();
        println!("{integrator:?}: off by {worst:e}, {state:?}, wrench {wrench:?}, weight {weight:e}, {report:?}");
        assert!(worst < 1e-9, "off by {worst:e}");
        assert_eq!(state.status, ConstraintStatus::Holds);
        // At rest: what the follicle bears is the weight and the pin's pull.
        let balance = wrench.force - Vector3::new(0.0, 0.0, -weight) - state.force;
        assert!(balance.norm() < 1e-6 * weight, "{balance:?}");
    }
}
