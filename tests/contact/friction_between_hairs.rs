//! Friction of strands on strands: with Coulomb's law a strand that lies across sloping ones stays where it is, and slides off where the
//! slope is steeper than friction holds.

use std::f64::consts::PI;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{ContactModel, ContactPartner, Frame, Friction, Solver, SolverOptions, StrandContact, StrandDef};

const RADIUS: f64 = 1e-3;
const FRICTION: f64 = 0.3;

/// What came of a strand across two sloping ones.
#[derive(Debug)]
struct Lying {
    /// How far it went down the slope in half a second, and in two more, m.
    slid: [f64; 2],
    /// Friction over normal force at the end, of each contact.
    ratios: Vec<f64>,
}

/// A limp strand that is laid across two stiff ones which slope by `slope` (rise over run).
fn lie(model: ContactModel, max_iterations: u32, slope: f64) -> Lying {
    let mut options = SolverOptions { gravity: Vector3::new(0.0, 0.0, -9.81), ..SolverOptions::default() };
    (options.contact.model, options.contact.hair, options.contact.max_iterations) = (model, true, max_iterations);
    let mut solver = Solver::new(options).unwrap();
    let down = slope.atan();
    let rail = |x: f64| {
        let mut rail = StrandDef::straight(0.06, 3);
        rail.material.radius = [1e-3; 2];
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5 * PI)
            * UnitQuaternion::from_axis_angle(&Vector3::y_axis(), down);
        rail.root = Frame { origin: Vector3::new(x, 0.0, 0.0) - turn * Vector3::x() * 0.03, rotation: turn };
        rail
    };
    let mut across = StrandDef::straight(0.1, 8);
    across.material.youngs_modulus = 1e9;
    across.material.air_drag = 1e-5;
    across.root.origin = Vector3::new(-0.04, 0.0, 2.0 * RADIUS / down.cos());
    let ids = solver.add_strands(&[rail(0.0), rail(0.04), across]).unwrap();
    let contact = StrandContact {
        wisp_radius: RADIUS,
        hair_friction: Friction::uniform(FRICTION),
        viscous_friction: Friction::uniform(1e-4),
        ..StrandContact::default()
    };
    solver.set_contact(&ids, Some(&contact)).unwrap();
    let aside = |solver: &Solver| {
        let mut aside = 0.0;
        solver.sample_at(ids[2], &[0.08], |_, sample| aside = sample.position.y).unwrap();
        aside
    };
    solver.step(0.5, 30).unwrap();
    let first = aside(&solver);
    solver.step(2.0, 120).unwrap();
    let mut ratios = Vec::new();
    for contact in solver.contacts() {
        assert!(matches!(contact.partner, ContactPartner::Strand { .. }));
        let normal = contact.force.dot(&contact.normal);
        ratios.push((contact.force - contact.normal * normal).norm() / normal);
    }
    Lying { slid: [first, aside(&solver) - first], ratios }
}

#[test]
fn a_strand_rests_on_sloping_hair_where_friction_is_coulombs() {
    let coulomb =
        [(ContactModel::Coulomb, 50), (ContactModel::AtPoints, 1), (ContactModel::AtPoints, 2), (ContactModel::AtPoints, 50)];
    for (model, iterations) in coulomb {
        let gentle = lie(model, iterations, 0.1);
        println!("{model:?}, {iterations} iterations: {gentle:?}");
        // Springs hold the law to what a step's problems leave.
        let (creep, law) = if model == ContactModel::Coulomb { (1e-6, 1e-6) } else { (1e-4, 0.1) };
        assert!(
            gentle.ratios.len() >= 2 && gentle.slid.iter().all(|way| way.abs() < creep),
            "{model:?}, {iterations}: {gentle:?}"
        );
        // At least what the slope takes, at most what the law gives.
        let may = 0.099..FRICTION * (1.0 + law);
        assert!(gentle.ratios.iter().all(|ratio| may.contains(ratio)), "{model:?}, {iterations}: {gentle:?}");
        let steep = lie(model, iterations, 0.5);
        assert!(steep.slid[0] > 5e-3, "{model:?}, {iterations}: {steep:?}");
    }
    // Viscous friction holds nothing.
    let viscous = lie(ContactModel::Penalty, 50, 0.1);
    assert!(viscous.slid[1] > 2e-3, "{viscous:?}");
}
