//! Contact against theory: what statics and Coulomb's law say of strands on bodies.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::contact::body::BodyDef;
use superhelix::contact::options::{ContactModel, Friction, StrandContact};
use superhelix::contact::shape::Shape;
use superhelix::math::frame::Frame;
use superhelix::solver::Solver;
use superhelix::solver::definition::{SolverOptions, StrandDef};
use superhelix::solver::id::StrandId;

const GRAVITY: f64 = 9.81;

fn solver(model: ContactModel, gravity: Vector3<f64>) -> Solver {
    let mut options = SolverOptions { gravity, ..SolverOptions::default() };
    options.contact.model = model;
    Solver::new(options).unwrap()
}

/// A limp strand of 20 cm along x whose surface lies on the plane z = 0.
fn lying(elements: usize) -> StrandDef {
    let mut def = StrandDef::straight(0.2, elements);
    def.material.youngs_modulus = 1e6;
    def.root = Frame { origin: Vector3::new(0.0, 0.0, def.material.radius[0]), rotation: UnitQuaternion::identity() };
    def
}

fn floor() -> BodyDef {
    BodyDef::new(Arc::new(Shape::new_half_space(Vector3::z()).unwrap()))
}

fn tip(solver: &Solver, id: StrandId, length: f64) -> Vector3<f64> {
    let mut at = Vector3::zeros();
    solver.sample_at(id, &[length], |_, sample| at = sample.position).unwrap();
    at
}

#[test]
fn a_resting_strand_is_borne_by_its_contacts() {
    for model in [ContactModel::Penalty, ContactModel::RegularisedPenalty, ContactModel::Hard, ContactModel::Coulomb] {
        let mut solver = solver(model, Vector3::new(0.0, 0.0, -GRAVITY));
        let def = lying(10);
        let weight = def.material.linear_density() * def.length() * GRAVITY;
        let id = solver.add_strands(&[def]).unwrap()[0];
        let floor = solver.add_bodies(vec![floor()]).unwrap()[0];
        solver.set_contact(&[id], Some(&StrandContact::default())).unwrap();
        let mut report = Default::default();
        for _ in 0..600 {
            report = solver.step(1.0 / 60.0, 1).unwrap();
        }
        let contacts: Vector3<f64> = solver.contacts().iter().map(|contact| contact.force).sum();
        let wrench = solver.body_wrench(floor).unwrap();
        let root = solver.root_wrench(id).unwrap();
        println!(
            "{model:?}: {} contacts bear {:?} of {weight:e}, root {:?}, {report:?}",
            solver.contacts().len(),
            contacts,
            root.force
        );
        assert!((contacts + wrench.force).norm() < 1e-15);
        // The penalty models are still swinging a little: what they bear follows.
        let allowed = if matches!(model, ContactModel::Hard | ContactModel::Coulomb) { 1e-6 } else { 1e-3 };
        assert!((contacts - root.force - Vector3::new(0.0, 0.0, weight)).norm() < allowed * weight);
    }
}

#[test]
fn friction_holds_below_its_angle_and_not_above() {
    let mu = 0.4;
    for model in [ContactModel::Hard, ContactModel::Coulomb] {
        for (share, sticks) in [(0.99, true), (1.01, false)] {
            // The slope is along y, across the strand: only its root and what stiffness it has hold it there.
            let angle = (mu * share as f64).atan();
            let gravity = Vector3::new(0.0, angle.sin(), -angle.cos()) * GRAVITY;
            let mut solver = solver(model, gravity);
            let id = solver.add_strands(&[lying(10)]).unwrap()[0];
            solver.add_bodies(vec![floor()]).unwrap();
            let contact = StrandContact { friction: Friction::uniform(mu), ..StrandContact::default() };
            solver.set_contact(&[id], Some(&contact)).unwrap();
            let start = tip(&solver, id, 0.2);
            let mut worst = 0;
            for _ in 0..180 {
                let report = solver.step(1.0 / 60.0, 1).unwrap();
                worst += report.contact.unconverged;
            }
            let way = tip(&solver, id, 0.2) - start;
            println!("{model:?} {share}: {way:?}, unconverged {worst}");
            if sticks {
                assert!(way.norm() < 1e-5, "{way:?}");
            } else {
                assert!(way.y > 1e-2, "{way:?}");
            }
        }
    }
}
