//! Motions that broke drafts.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::math::frame::Frame;
use superhelix::rod::material::Material;
use superhelix::solver::Solver;
use superhelix::solver::definition::{SolverOptions, StrandDef};
use superhelix::step::options::{Integrator, LinearSolver};

/// Head yaw ±46° at 2 Hz with ±8 cm of sway.
fn shake(t: f64) -> Frame {
    let w = 2.0 * std::f64::consts::PI * 2.0;
    let ease = 1.0 - (-(4.0 * t).powi(2)).exp();
    let (a, y) = (0.8 * (w * t).sin() * ease, 0.08 * (w * t).sin() * ease);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), a);
    let tilt = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -0.5);
    Frame { origin: turn * Vector3::new(0.09, 0.0, 0.0) + Vector3::new(0.0, y, 0.0), rotation: turn * tilt }
}

#[test]
fn probe() {
    for (n, natural) in [(5, [0.0; 3]), (10, [0.0; 3]), (10, [10.0, 60.0, 0.0]), (50, [0.0; 3])] {
        for per_second in [30.0, 60.0, 240.0] {
            for (solver_kind, exact) in
                [(LinearSolver::LinearTime, true), (LinearSolver::LinearTime, false), (LinearSolver::DenseCholesky, true)]
            {
                if n > 10 && solver_kind != LinearSolver::LinearTime {
                    continue;
                }
                let mut options = SolverOptions::default();
                options.step.integrator = Integrator::ImplicitEuler;
                options.step.linear_solver = solver_kind;
                options.step.exact_hessian = exact;
                options.step.max_iterations = 200;
                let mut solver = Solver::new(options).unwrap();
                let mut def = StrandDef::straight(0.25, n);
                def.material = Material { youngs_modulus: 1e9, internal_friction: 1e-10, air_drag: 5e-6, ..Material::default() };
                def.natural = vec![natural; n];
                def.root = shake(0.0);
                let id = solver.add_strands(&[def]).unwrap()[0];
                let h = 1.0 / per_second;
                let (mut total, mut most, mut unconverged) = (0.0, 0, 0);
                let steps = (3.0 / h) as i32;
                let mut seconds = 0.0;
                for step in 1..=steps {
                    solver.set_root_frames(&[id], &[shake(h * f64::from(step))], h).unwrap();
                    let report = solver.step(h, 1).unwrap();
                    total += report.mean_iterations;
                    most = most.max(report.max_iterations);
                    unconverged += report.unconverged;
                    seconds += report.seconds;
                }
                let mut tip = Vector3::zeros();
                solver.sample_at(id, &[0.25], |_, s| tip = s.position).unwrap();
                println!(
                    "N={n} {natural:?} h=1/{per_second} {solver_kind:?} exact={exact}: mean {:.2} most {most} unconverged {unconverged} tip {:.4} {:.4} {:.4}  {:.2} us/elem-iter",
                    total / f64::from(steps),
                    tip.x,
                    tip.y,
                    tip.z,
                    seconds * 1e6 / (total * n as f64)
                );
            }
        }
    }
}
