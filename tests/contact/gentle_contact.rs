//! What a small contact problem costs: where surfaces move little in a step, its exact solution spares the strand an iteration.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{
    BodyDef, ContactModel, ContactOptions, Frame, Shape, Solver, SolverOptions, StepOptions, StrandContact, StrandDef,
};

/// Ticks of a millisecond.
const TICK: f64 = 1e-3;

/// A tooth leans against hanging strands and is drawn through them at 4 cm/s: they converge in one iteration, as free strands do.
#[test]
fn strands_on_a_slow_tooth_take_one_iteration() {
    let step = StepOptions { tolerance: 1e-4, ..StepOptions::default() };
    let mut solver = Solver::new(SolverOptions { step, ..SolverOptions::default() }).unwrap();
    let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), FRAC_PI_2);
    let defs: Vec<StrandDef> = (0..10)
        .map(|k| {
            let mut def = StrandDef::straight(0.15, 5);
            (def.material.internal_friction, def.material.air_drag) = (1e-10, 1e-5);
            def.root = Frame { origin: Vector3::new(0.0, 0.002 * f64::from(k), 0.0), rotation: down };
            def
        })
        .collect();
    let strands = solver.add_strands(&defs).unwrap();
    solver.set_contact(&strands, Some(&StrandContact::default())).unwrap();
    let options = ContactOptions { model: ContactModel::Coulomb, ..ContactOptions::default() };
    solver.set_contact_options(&options).unwrap();
    let tooth = Shape::new_capsule(Vector3::new(0.0, -0.02, 0.0), Vector3::new(0.0, 0.04, 0.0), 0.001).unwrap();
    let place = |x: f64, z: f64| Frame { origin: Vector3::new(x, 0.0, z), rotation: UnitQuaternion::identity() };
    let mut body = BodyDef::new(Arc::new(tooth));
    body.pose = place(-0.004, -0.05);
    let body = solver.add_bodies(vec![body]).unwrap();
    let (mut x, mut z) = (-0.004, -0.05);
    let (mut iterations, mut contacts) = (0.0, 0);
    for tick in 0..1500 {
        // It comes, waits for the strands to hang still, and goes down along them.
        if tick < 500 {
            x += 2e-5;
        } else if tick >= 900 {
            z -= 4e-5;
        }
        solver.set_body_frames(&body, &[place(x, z)], TICK).unwrap();
        let report = solver.step(TICK, 1).unwrap();
        assert_eq!(report.unconverged, 0, "{tick}");
        if tick >= 900 {
            assert!(report.contact.residual <= options.residual, "{tick}: {:e}", report.contact.residual);
            iterations += report.mean_iterations / 600.0;
            contacts += report.contact.contacts;
        }
    }
    assert!(contacts > 600 * 9, "{contacts}");
    assert!(iterations < 1.1, "{iterations}");
}
