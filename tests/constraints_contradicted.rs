//! Constraints that cannot hold: told as violated, drawn as near as they go, in bounded time, and without forces beyond measure.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::contact::body::BodyDef;
use superhelix::contact::options::{ContactModel, Friction, StrandContact};
use superhelix::contact::shape::Shape;
use superhelix::math::frame::Frame;
use superhelix::solver::Solver;
use superhelix::solver::constraints::{ConstraintDef, ConstraintState, ConstraintStatus, Hold};
use superhelix::solver::definition::{SolverOptions, StrandDef};
use superhelix::solver::id::StrandId;

const STEP: f64 = 1.0 / 60.0;
const LENGTH: f64 = 0.1;
const STRANDS: usize = 8;

/// Strands of a decimetre that hang from a circle of 5 mm.
fn hanging() -> Vec<StrandDef> {
    let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5 * PI);
    (0..STRANDS)
        .map(|k| {
            let mut def = StrandDef::straight(LENGTH, 10);
            def.material.viscosity = 0.02;
            def.material.air_drag = 1e-4;
            let turn = 2.0 * PI * k as f64 / STRANDS as f64;
            def.natural = vec![[0.0, 9.0 * turn.cos(), 9.0 * turn.sin()]; 10];
            def.initial = Some(def.natural.clone());
            def.root = Frame { origin: Vector3::new(turn.cos(), turn.sin(), 0.0) * 0.005, rotation: down };
            def
        })
        .collect()
}

fn at(origin: [f64; 3]) -> Frame {
    Frame { origin: origin.into(), ..Frame::default() }
}

fn held(strand: StrandId, arclength: f64, hold: Hold, target: Frame) -> ConstraintDef {
    ConstraintDef { strand, arclength, hold, target, compliance: 0.0 }
}

struct Outcome {
    states: Vec<ConstraintState>,
    iterations: u32,
    sweeps: u64,
    seconds: f64,
    quarantined: u32,
    violated: u32,
    force: f64,
    tips: Vec<Vector3<f64>>,
}

/// A second of it.
fn course(model: ContactModel, bodies: Vec<BodyDef>, wisp_radius: f64, hold: impl Fn(&[StrandId]) -> Vec<ConstraintDef>) -> Outcome {
    let mut options = SolverOptions::default();
    (options.contact.model, options.contact.hair) = (model, wisp_radius > 0.0);
    let mut solver = Solver::new(options).unwrap();
    let ids = solver.add_strands(&hanging()).unwrap();
    solver.add_bodies(bodies).unwrap();
    solver.set_contact(&ids, Some(&StrandContact { wisp_radius, ..StrandContact::default() })).unwrap();
    let constraints = solver.add_constraints(&hold(&ids)).unwrap();
    let mut out = Outcome {
        states: Vec::new(),
        iterations: 0,
        sweeps: 0,
        seconds: 0.0,
        quarantined: 0,
        violated: 0,
        force: 0.0,
        tips: Vec::new(),
    };
    for _ in 0..60 {
        let report = solver.step(STEP, 1).unwrap();
        out.iterations += report.contact.iterations;
        out.sweeps += report.contact.sweeps;
        out.seconds += report.seconds;
        out.quarantined += report.quarantined;
        out.states = constraints.iter().map(|id| solver.constraint_state(*id).unwrap()).collect();
        out.violated += out.states.iter().filter(|state| state.status == ConstraintStatus::Violated).count() as u32;
        out.force = out.states.iter().map(|state| state.force.norm()).fold(out.force, f64::max);
    }
    for id in ids {
        solver.sample_at(id, &[LENGTH], |_, sample| out.tips.push(sample.position)).unwrap();
    }
    out
}

#[test]
fn probe() {
    let ball = |z: f64, radius: f64| {
        let mut def = BodyDef::new(Arc::new(Shape::new_sphere(radius).unwrap()));
        def.pose.origin = Vector3::new(0.0, 0.0, z);
        def
    };
    let friction = Friction { along: 0.1, against: 0.2 };
    for model in [ContactModel::Hard, ContactModel::Coulomb, ContactModel::Penalty] {
        let print = |name: &str, out: Outcome| {
            println!(
                "{model:?} {name}: {:.0} ms, {} iterations, {} sweeps, {} quarantined, {} violated, force {:.1e}, {:?} {:.2e}",
                out.seconds * 1e3, out.iterations, out.sweeps, out.quarantined, out.violated, out.force, out.states[0].status, out.states[0].error
            );
        };
        print("in a ball", course(model, vec![ball(-0.09, 0.02)], 0.0, |ids| {
            ids.iter().map(|id| held(*id, LENGTH, Hold::Point, at([0.0, 0.0, -0.09]))).collect()
        }));
        print("in a ball, frames", course(model, vec![ball(-0.09, 0.02)], 0.0, |ids| {
            ids.iter().map(|id| held(*id, LENGTH, Hold::Frame, at([0.0, 0.0, -0.09]))).collect()
        }));
        print("out of reach", course(model, vec![], 0.0, |ids| {
            ids.iter().map(|id| held(*id, LENGTH, Hold::Point, at([0.12, 0.0, -0.09]))).collect()
        }));
        print("out of reach, wisps", course(model, vec![], 5e-4, |ids| {
            ids.iter().map(|id| held(*id, LENGTH, Hold::Point, at([0.12, 0.0, -0.09]))).collect()
        }));
        print("behind a ball", course(model, vec![ball(-0.05, 0.03)], 0.0, |ids| {
            ids.iter().map(|id| held(*id, LENGTH, Hold::Point, at([0.0, 0.0, -0.095]))).collect()
        }));
        print("too far apart", course(model, vec![], 0.0, |ids| {
            ids.iter().flat_map(|id| [held(*id, 0.05, Hold::Point, at([0.02, 0.0, -0.04])), held(*id, 0.09, Hold::Point, at([-0.04, 0.0, -0.05]))]).collect()
        }));
        print("two frames", course(model, vec![], 0.0, |ids| {
            ids.iter().flat_map(|id| [held(*id, 0.05, Hold::Frame, at([0.0, 0.0, -0.04])), held(*id, 0.055, Hold::Direction, at([0.0, 0.001, -0.048]))]).collect()
        }));
        print("ring out of reach", course(model, vec![], 0.0, |ids| {
            ids.iter().map(|id| held(*id, 0.06, Hold::Ring { friction }, at([0.1, 0.05, 0.05]))).collect()
        }));
        print("tie and pins", course(model, vec![], 0.0, |ids| {
            let mut out = vec![held(ids[0], LENGTH, Hold::Point, at([0.05, 0.0, -0.07])), held(ids[1], LENGTH, Hold::Point, at([-0.05, 0.0, -0.07]))];
            out.push(held(ids[0], 0.08, Hold::Tie { other: ids[1], arclength: 0.09 }, Frame::default()));
            out
        }));
        print("ties in a ball", course(model, vec![ball(-0.05, 0.03)], 5e-4, |ids| {
            (1..8).map(|k| held(ids[0], LENGTH, Hold::Tie { other: ids[k], arclength: LENGTH }, Frame::default())).chain([held(ids[0], LENGTH, Hold::Point, at([0.0, 0.0, -0.05]))]).collect()
        }));
    }
}
