//! Motions that broke drafts: a head shaken hard, at frame-sized steps.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{Frame, Integrator, LinearSolver, Material, Solver, SolverOptions, StrandDef};

/// Head yaw ±46° at 2 Hz with ±8 cm of sway.
fn shake(t: f64) -> Frame {
    let w = 2.0 * std::f64::consts::PI * 2.0;
    let ease = 1.0 - (-(4.0 * t).powi(2)).exp();
    let (a, y) = (0.8 * (w * t).sin() * ease, 0.08 * (w * t).sin() * ease);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), a);
    let tilt = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -0.5);
    Frame { origin: turn * Vector3::new(0.09, 0.0, 0.0) + Vector3::new(0.0, y, 0.0), rotation: turn * tilt }
}

/// Tip after three seconds, mean iterations, most iterations.
fn shaken(
    count: usize,
    natural: [f64; 3],
    per_second: f64,
    integrator: Integrator,
    kind: LinearSolver,
) -> (Vector3<f64>, f64, u32) {
    let mut options = SolverOptions::default();
    options.step.integrator = integrator;
    options.step.linear_solver = kind;
    options.step.max_iterations = 300;
    let mut solver = Solver::new(options).unwrap();
    let mut def = StrandDef::straight(0.25, count);
    def.material = Material { youngs_modulus: 1e9, internal_friction: 1e-10, air_drag: 5e-6, ..Material::default() };
    def.natural = vec![natural; count];
    def.root = shake(0.0);
    let id = solver.add_strands(&[def]).unwrap()[0];
    let h = 1.0 / per_second;
    let steps = (3.0 / h) as i32;
    let (mut total, mut most) = (0.0, 0);
    for step in 1..=steps {
        solver.set_root_frames(&[id], &[shake(h * f64::from(step))], h).unwrap();
        let report = solver.step(h, 1).unwrap();
        assert_eq!((report.unconverged, report.quarantined), (0, 0), "N = {count}, 1/{per_second} s, step {step}");
        total += report.mean_iterations;
        most = most.max(report.max_iterations);
    }
    let mut tip = Vector3::zeros();
    solver.sample_at(id, &[0.25], |_, sample| tip = sample.position).unwrap();
    (tip, total / f64::from(steps), most)
}

#[test]
fn a_shaken_head_converges_at_every_step_and_both_solvers_find_the_same_minimum() {
    for (count, natural) in [(5, [0.0; 3]), (10, [0.0; 3]), (10, [10.0, 60.0, 0.0])] {
        for per_second in [30.0, 60.0, 240.0] {
            let (fast, mean, most) = shaken(count, natural, per_second, Integrator::ImplicitEuler, LinearSolver::LinearTime);
            let (slow, dense_mean, dense_most) =
                shaken(count, natural, per_second, Integrator::ImplicitEuler, LinearSolver::DenseCholesky);
            println!(
                "N = {count} {natural:?} h = 1/{per_second}: linear time {mean:.1} iterations (most {most}), dense {dense_mean:.1} ({dense_most})"
            );
            // Converged to 1e-6 rad a step; the motion amplifies that over three seconds.
            assert!((fast - slow).norm() < 1e-4, "{fast} {slow}");
        }
    }
    for integrator in [Integrator::ImplicitEuler, Integrator::SecondOrder] {
        for (count, per_second) in [(5, 30.0), (10, 60.0), (50, 60.0), (10, 240.0)] {
            let (_, mean, most) = shaken(count, [0.0; 3], per_second, integrator, LinearSolver::LinearTime);
            println!("{integrator:?} N = {count} h = 1/{per_second}: {mean:.1} iterations (most {most})");
        }
    }
}
