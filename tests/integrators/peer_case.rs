//! A continuous rod on which three independent codes agree: one turn of a helix let go. The error of the tip is that of the elements
//! plus that of the step; position-based and maximal-coordinate rods are 10 to 14 mm off at 1/60 s.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use superhelix::{Integrator, Solver, SolverOptions, StrandDef};

/// L = 0.2 m, one turn of a helix of radius 15 mm about +x, clamped along its own tangent.
fn helix(count: usize) -> StrandDef {
    let (length, radius): (f64, f64) = (0.2, 0.015);
    let c = length / (2.0 * std::f64::consts::PI);
    let p = (c * c - radius * radius).sqrt();
    let mut def = StrandDef::straight(length, count);
    def.natural = vec![[p / (c * c), 0.0, radius / (c * c)]; count];
    let n0 = Vector3::new(p, 0.0, radius) / c;
    let n1 = -Vector3::y();
    let frame = Matrix3::from_columns(&[n0, n1, n0.cross(&n1)]);
    def.root.rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(frame));
    def
}

/// Distance of the tip from the reference at 0.1 s, m.
fn error(count: usize, integrator: Integrator, per_second: u32) -> f64 {
    let mut options = SolverOptions::default();
    options.step.integrator = integrator;
    let mut solver = Solver::new(options).unwrap();
    let id = solver.add_strands(&[helix(count)]).unwrap()[0];
    for _ in 0..per_second / 10 {
        assert_eq!(solver.step(1.0 / f64::from(per_second), 1).unwrap().unconverged, 0);
    }
    let mut tip = Vector3::zeros();
    solver.sample_at(id, &[0.2], |_, sample| tip = sample.position).unwrap();
    // Agreed to 0.02, 0.03, 0.02 mm.
    (tip - Vector3::new(0.17246, -0.00663, -0.05098)).norm()
}

#[test]
fn second_order_steps_of_a_sixtieth_are_within_a_millimetre() {
    for (count, bound) in [(10, 1.2e-3), (20, 0.6e-3), (40, 0.6e-3)] {
        let errors = [60, 120, 240].map(|per_second| error(count, Integrator::SecondOrder, per_second));
        println!(
            "N = {count}: {:.2}, {:.2}, {:.2} mm at 1/60, 1/120, 1/240 s",
            errors[0] * 1e3,
            errors[1] * 1e3,
            errors[2] * 1e3
        );
        assert!(errors.iter().all(|error| *error < bound), "{errors:?}");
    }
    // The elements' own error falls by four when their number is doubled: 1.0, 0.25, 0.06 mm.
    let fine = [10, 20, 40].map(|count| error(count, Integrator::SecondOrder, 480));
    assert!(fine[0] / fine[1] > 3.0 && fine[2] < 1.2e-4, "{fine:?}");
    // Implicit Euler needs steps thirty times smaller for as much.
    assert!(error(20, Integrator::ImplicitEuler, 60) > 0.01 && error(20, Integrator::ImplicitEuler, 1920) < 0.6e-3);
}

#[test]
fn an_undamped_second_at_a_sixtieth_is_stable() {
    // Ten seconds, in fact: no friction, no drag. The method may trade energy between forms; it must not make any.
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let id = solver.add_strands(&[helix(20)]).unwrap()[0];
    let total = |solver: &Solver| {
        let e = solver.energies(id).unwrap();
        e.kinetic + e.elastic + e.gravity
    };
    let start = total(&solver);
    let (mut lowest, mut highest) = (start, start);
    for step in 0..600 {
        let report = solver.step(1.0 / 60.0, 1).unwrap();
        assert_eq!((report.unconverged, report.quarantined), (0, 0), "step {step}");
        lowest = lowest.min(total(&solver));
        highest = highest.max(total(&solver));
    }
    // The scale: what gravity gives when the strand's weight falls by its length.
    let scale = 9.81 * helix(20).material.linear_density() * 0.2 * 0.2;
    println!("energy from {:.4} to {:.4} of the scale about the start", (lowest - start) / scale, (highest - start) / scale);
    assert!(highest - start < 0.01 * scale);
}
