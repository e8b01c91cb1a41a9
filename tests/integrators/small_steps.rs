//! Newton's stop where steps are small: its tolerance is an angle, and an angle left in a step of h seconds is a velocity of angle × length / h.

use nalgebra::Vector3;
use superhelix::{Frame, Integrator, Solver, SolverOptions, StepOptions, StrandDef};

/// Velocities along a strand after ten steps of `h`, the first of which strikes it: its moving root stops at once.
fn velocities(integrator: Integrator, tolerance: f64, h: f64) -> Vec<Vector3<f64>> {
    let step = StepOptions { integrator, tolerance, ..StepOptions::default() };
    let mut solver = Solver::new(SolverOptions { step, ..SolverOptions::default() }).unwrap();
    let mut def = StrandDef::straight(0.1, 6);
    def.natural = vec![[5.0, 10.0, 2.0]; 6];
    def.material.air_drag = 1e-5;
    let ids = solver.add_strands(&[def]).unwrap();
    for frame in 0..4 {
        let moved = Frame { origin: Vector3::new(0.0, 0.01 * f64::from(frame), 0.0), ..Frame::default() };
        solver.set_root_frames(&ids, &[moved], 1.0 / 60.0).unwrap();
        solver.step(1.0 / 60.0, 2).unwrap();
    }
    for _ in 0..10 {
        let report = solver.step(h, 1).unwrap();
        assert_eq!((report.unconverged, report.quarantined, report.subdivided), (0, 0, 0), "{integrator:?}, {h:e} s");
    }
    let mut found = Vec::new();
    solver.sample_strands(&ids, 25, |_, _, sample| found.push(sample.velocity)).unwrap();
    found
}

#[test]
fn the_tolerance_is_not_seen_in_velocities_at_any_step() {
    for integrator in [Integrator::SecondOrder, Integrator::ImplicitEuler] {
        for exponent in 3..=9 {
            let h = 10.0_f64.powi(-exponent);
            let exact = velocities(integrator, 1e-13, h);
            let speed = exact.iter().map(|v| v.norm()).fold(0.0, f64::max);
            let found = velocities(integrator, StepOptions::default().tolerance, h);
            let apart = found.iter().zip(&exact).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            println!("{integrator:?}, {h:e} s: {:.1e} of {speed:.2} m/s", apart / speed);
            // The bound that the tolerance itself would allow is 1e-7 m / h: 100 m/s at the shortest step. Iterations stop with far less,
            // since the last one leaves the square of what it turned by.
            assert!(apart < 1e-4 * speed, "{integrator:?}, {h:e} s: {apart:e} of {speed}");
        }
    }
}
