//! Newton iterations per step: a head shaken hard and a recorded walk, both integrators that minimise, two tolerances. The table
//! of docs/theory/newton.md.
//!
//! `cargo run --release --example newton -- docs/figures/newton.csv`

use std::fmt::Write as _;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::io::Motion;
use superhelix::{Frame, Integrator, Material, Solver, SolverOptions, StrandDef};

/// Seconds simulated.
const DURATION: f64 = 3.0;

/// The follicle's pose, y up: 9 cm to the side of the head's axis. When shaken, as in tests/integrators/hard_cases.rs, the strand leaves upwards
/// and falls over, and the head sways to where it turns; when walking, the strand leaves downwards.
fn root(walk: Option<&Motion>, t: f64) -> Frame {
    let up = if walk.is_some() { -0.5 } else { 0.5 };
    let tilt = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), up);
    let follicle = Frame { origin: Vector3::new(0.09, 0.0, 0.0), rotation: tilt };
    let head = match walk {
        Some(motion) => motion.at(motion.times()[0] + t),
        // ±46° of yaw and ±8 cm at 2 Hz, eased in.
        None => {
            let swing = (4.0 * std::f64::consts::PI * t).sin() * (1.0 - (-(4.0 * t).powi(2)).exp());
            Frame {
                origin: Vector3::new(0.0, 0.0, -0.08 * swing),
                rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.8 * swing),
            }
        }
    };
    head.compose(&follicle)
}

/// Mean and largest number of iterations per step, and how many steps needed more than the default cap.
fn iterations(walk: Option<&Motion>, integrator: Integrator, tolerance: f64, count: usize, rate: u32) -> (f64, u32, u64) {
    let mut options = SolverOptions { gravity: Vector3::new(0.0, -9.81, 0.0), ..SolverOptions::default() };
    (options.step.integrator, options.step.tolerance, options.step.max_iterations) = (integrator, tolerance, 300);
    let mut solver = Solver::new(options).expect("a solver");
    let mut def = StrandDef::straight(0.25, count);
    def.material = Material { youngs_modulus: 1e9, internal_friction: 1e-10, air_drag: 5e-6, ..Material::default() };
    def.root = root(walk, 0.0);
    if walk.is_some() {
        let h = 1e-4;
        def.root_velocity = (root(walk, h).origin - def.root.origin) / h;
        def.root_angular_velocity = (root(walk, h).rotation * def.root.rotation.inverse()).scaled_axis() / h;
    }
    let id = solver.add_strands(&[def]).expect("a strand")[0];
    let h = 1.0 / f64::from(rate);
    let steps = (DURATION * f64::from(rate)).round() as u32;
    let (mut total, mut most, mut beyond) = (0.0, 0, 0);
    for step in 1..=steps {
        solver.set_root_frames(&[id], &[root(walk, h * f64::from(step))], h).expect("a root");
        let report = solver.step(h, 1).expect("a step");
        total += report.mean_iterations;
        most = most.max(report.max_iterations);
        assert_eq!((report.unconverged, report.quarantined), (0, 0), "within 300");
        beyond += u64::from(report.max_iterations > SolverOptions::default().step.max_iterations);
    }
    (total / f64::from(steps), most, beyond)
}

fn main() {
    let path = std::env::args().nth(1);
    let walk =
        Motion::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/grooms/walk_figure8_head.csv"), None).expect("the walk");
    let mut csv = String::from("motion,integrator,tolerance,elements,rate,iterations,most,beyond_cap\n");
    for (motion, walk) in [("shake", None), ("walk", Some(&walk))] {
        for (called, integrator) in [("implicit_euler", Integrator::ImplicitEuler), ("second_order", Integrator::SecondOrder)] {
            for tolerance in [1e-6, 1e-3] {
                for (count, rate) in [(5, 60), (10, 60), (50, 60), (10, 30)] {
                    let (mean, most, beyond) = iterations(walk, integrator, tolerance, count, rate);
                    println!(
                        "{motion:5} {called:14} {tolerance:.0e} rad N = {count:<2} h = 1/{rate}: {mean:.1} (most {most}), beyond the cap {beyond}"
                    );
                    writeln!(csv, "{motion},{called},{tolerance:e},{count},{rate},{mean:.3},{most},{beyond}").expect("a string");
                }
            }
        }
    }
    if let Some(path) = path {
        std::fs::write(&path, csv).unwrap_or_else(|error| panic!("{path}: {error}"));
        println!("written: {path}");
    }
}
