//! Trajectories of the discrete Super-Helix (fixed N, continuous time) by an independent oracle: implicit Euler approaches every one of
//! them at first order.

use crate::oracle_cases::{self, Case};
use nalgebra::Vector3;
use superhelix::{Integrator, Solver, SolverOptions};

/// Tips at the reference's times (each 1/60 s) with `per_output` steps between two of them.
fn simulate(case: &Case, integrator: Integrator, per_output: u32) -> Vec<Vector3<f64>> {
    let mut options = SolverOptions::default();
    options.step.integrator = integrator;
    let mut solver = Solver::new(options).unwrap();
    let id = solver.add_strands(std::slice::from_ref(&case.def)).unwrap()[0];
    let h = 1.0 / 60.0 / f64::from(per_output);
    let mut tips = Vec::new();
    for output in 0..case.times.len() {
        for step in 0..per_output {
            if let Some(root) = case.root {
                let t = h * f64::from(output as u32 * per_output + step + 1);
                solver.set_root_frames(&[id], &[root.at(t)], h).unwrap();
            }
            let report = solver.step(h, 1).unwrap();
            assert_eq!((report.unconverged, report.quarantined), (0, 0));
        }
        solver.sample_at(id, &[case.def.length()], |_, sample| tips.push(sample.position)).unwrap();
    }
    tips
}

fn worst(tips: &[Vector3<f64>], reference: &[Vector3<f64>], length: f64) -> f64 {
    tips.iter().zip(reference).map(|(a, b)| (a - b).norm() / length).fold(0.0, f64::max)
}

#[test]
fn implicit_euler_converges_to_every_reference_trajectory() {
    // Halving the step halves the error; the two smallest steps extrapolated agree to 1e-4 of the length at every output time. The
    // whipping head needs smaller steps for that than the others.
    for case in oracle_cases::all() {
        let (name, length) = (&case.name, case.def.length());
        // The oracle itself is far better than what is asked here.
        assert!(case.uncertainty < 1e-6 * length, "{name}: {:e}", case.uncertainty);
        let finest = if name == "head_yaw_n2" { 512 } else { 128 };
        let tips: Vec<_> =
            [finest / 4, finest / 2, finest].map(|per_output| simulate(&case, Integrator::ImplicitEuler, per_output)).into();
        let errors: Vec<f64> = tips.iter().map(|tips| worst(tips, &case.tips, length)).collect();
        let extrapolated: Vec<Vector3<f64>> = tips[1].iter().zip(&tips[2]).map(|(a, b)| b * 2.0 - a).collect();
        let error = worst(&extrapolated, &case.tips, length);
        println!("{name}: {errors:?} L at {finest}/4, /2, /1 steps a 60th of a second; extrapolated {error:e} L");
        for pair in errors.windows(2) {
            assert!((1.85..2.15).contains(&(pair[0] / pair[1])), "{name}: {errors:?}");
        }
        assert!(error < 1e-4, "{name}: {error:e}");
    }
}

#[test]
fn the_second_order_method_converges_at_second_order() {
    // Halving the step quarters the error, once the step sees the motion. The root's path between two frames is the cubic of
    // `PoseMove`, which is smooth but knows no curvature: it is exact to second order in the step as well.
    for case in oracle_cases::all() {
        let (name, length) = (&case.name, case.def.length());
        let errors: Vec<f64> = [4, 8, 16, 32]
            .map(|per_output| worst(&simulate(&case, Integrator::SecondOrder, per_output), &case.tips, length))
            .into();
        println!("{name}: {errors:?} L at 4, 8, 16, 32 steps a 60th of a second");
        for pair in errors.windows(2) {
            assert!((3.4..4.6).contains(&(pair[0] / pair[1])), "{name}: {errors:?}");
        }
        assert!(errors[3] < 3e-4, "{name}: {errors:?}");
    }
}
