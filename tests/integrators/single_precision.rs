//! Single precision: how far it agrees with double precision, against theory and trajectories of the independent oracle. Its range
//! over stiffness, curl, elements and steps is measured by `examples/single_precision` and documented in docs/theory/lanes.md.

use crate::oracle_cases::{self, Case};
use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::EquilibriumOptions;
use superhelix::{Frame, Integrator, Material, Precision, Solver, SolverOptions, StrandDef};

fn solver(precision: Precision, integrator: Integrator) -> Solver {
    let mut options = SolverOptions::default();
    (options.step.precision, options.step.integrator) = (precision, integrator);
    Solver::new(options).unwrap()
}

/// Tips at the reference's times (each 1/60 s) with `per_output` steps between two of them.
fn tips(case: &Case, precision: Precision, per_output: u32) -> Vec<Vector3<f64>> {
    let mut solver = solver(precision, Integrator::SecondOrder);
    let id = solver.add_strands(std::slice::from_ref(&case.def)).unwrap()[0];
    let h = 1.0 / 60.0 / f64::from(per_output);
    let mut tips = Vec::new();
    for output in 0..case.times.len() as u32 {
        for step in 0..per_output {
            if let Some(root) = case.root {
                let t = h * f64::from(output * per_output + step + 1);
                solver.set_root_frames(&[id], &[root.at(t)], h).unwrap();
            }
            let report = solver.step(h, 1).unwrap();
            assert_eq!((report.unconverged, report.quarantined, report.subdivided), (0, 0, 0), "{}", case.name);
        }
        solver.sample_at(id, &[case.def.length()], |_, sample| tips.push(sample.position)).unwrap();
    }
    tips
}

fn apart(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

/// The oracle's trajectories: f32 stays as near to f64 as rounding of positions lets it. 10⁻⁷ L of fresh rounding at each step is a velocity of
/// 10⁻⁷ L/h, which adds up at random: about as h^-1.5, from some 10⁻⁶ L at 1/60 s. The bounds are a few times what half a second of the
/// most sensitive of the motions was seen to make of it.
#[test]
fn trajectories_are_those_of_double_precision_at_every_step() {
    for case in oracle_cases::all() {
        let length = case.def.length();
        for (per_output, bound) in [(1, 5e-5), (4, 2e-4), (16, 2e-3)] {
            let double = tips(&case, Precision::F64, per_output);
            let single = tips(&case, Precision::F32, per_output);
            let off = apart(&single, &double) / length;
            let [error64, error32] = [&double, &single].map(|tips| apart(tips, &case.tips) / length);
            println!(
                "{} at 1/{} s: f32 from f64 {off:.1e} L; from the oracle {error64:.2e} and {error32:.2e}",
                case.name,
                60 * per_output
            );
            assert!(off < bound, "{} at 1/{} s: {off:e}", case.name, 60 * per_output);
            assert!(error32 < error64 + bound);
        }
    }
}

fn hanging(count: usize) -> StrandDef {
    let mut def = StrandDef::straight(0.2, count);
    def.natural = vec![[3.0, 25.0, 0.0]; count];
    def.material = Material { youngs_modulus: 1e9, viscosity: 2e-3, air_drag: 5e-6, ..Material::default() };
    def.root = Frame { rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.6), ..Frame::default() };
    def
}

/// A strand put at its rest stays there for ten seconds but for a tremble by rounding, which grows with the number of steps a second. The
/// bounds are three times what was seen; a creep of a rounding (6·10⁻⁸) a step would be beyond them.
#[test]
fn a_strand_at_rest_stays() {
    for (count, per_second, bound) in [(8, 60, 4e-5), (8, 240, 3e-4), (40, 60, 6e-5)] {
        let mut solver = solver(Precision::F32, Integrator::SecondOrder);
        let id = solver.add_strands(&[hanging(count)]).unwrap()[0];
        let found = solver.settle(&[id], &EquilibriumOptions::default()).unwrap();
        assert!(found[0].converged);
        let tip = |solver: &Solver| {
            let mut tip = Vector3::zeros();
            solver.sample_at(id, &[0.2], |_, sample| tip = sample.position).unwrap();
            tip
        };
        let start = tip(&solver);
        let mut worst = 0.0_f64;
        for _ in 0..10 * per_second {
            let report = solver.step(1.0 / f64::from(per_second), 1).unwrap();
            assert_eq!((report.unconverged, report.quarantined), (0, 0));
            worst = worst.max((tip(&solver) - start).norm() / 0.2);
        }
        println!("N = {count} at 1/{per_second} s: at most {worst:.1e} L from its rest in 10 s");
        assert!(worst < bound, "N = {count} at 1/{per_second} s: {worst:e}");
    }
}

/// Changes a step far below the last digit of an f32 add up: a strand whose friction is so strong that its curvature goes
/// κ = κⁿ − (κⁿ − κ₀) exp(−t/μ) with μ a day goes there, although each step changes it by a hundredth of a rounding.
#[test]
fn changes_too_small_for_a_step_are_not_lost() {
    for integrator in [Integrator::ImplicitEuler, Integrator::SecondOrder, Integrator::LinearlyImplicit] {
        let mut options = SolverOptions { gravity: Vector3::zeros(), ..SolverOptions::default() };
        (options.step.precision, options.step.integrator) = (Precision::F32, integrator);
        let mut solver = Solver::new(options).unwrap();
        let (from, natural, time) = (10.0, 20.0, 86_400.0);
        let mut def = StrandDef::straight(0.02, 2);
        def.material = Material { viscosity: time, ..Material::default() };
        def.natural = vec![[0.0, natural, 0.0]; 2];
        def.initial = Some(vec![[0.0, from, 0.0]; 2]);
        // It moves from the start as it will go on: no inertia to get over.
        def.initial_rates = Some(vec![[0.0, (natural - from) / time, 0.0]; 2]);
        let id = solver.add_strands(&[def]).unwrap()[0];
        let (steps, h) = (2000, 1e-3);
        for _ in 0..steps {
            let report = solver.step(h, 1).unwrap();
            assert_eq!((report.unconverged, report.quarantined), (0, 0));
        }
        let expected = (natural - from) * f64::from(steps) * h / time;
        for row in solver.curvatures(id).unwrap() {
            let gone = row[1] - from;
            println!("{integrator:?}: gone {gone:e} of {expected:e}");
            // The step's own error is a millionth; f32 has its few digits of the change, not of the curvature.
            assert!((gone - expected).abs() < 1e-3 * expected, "{integrator:?}: {gone:e} of {expected:e}");
        }
    }
}

/// From the same state, a step in f32 ends where the one in f64 does, within what it says that it may be off by: `residual` does not claim
/// digits that f32 has not. The first step is two minimisations, and what the first leaves is carried into the second, 2.4 times at most.
#[test]
fn residuals_are_honest() {
    let sway = |step: u32| {
        let mut root = hanging(1).root;
        root.origin.x = 0.02 * (0.3 * f64::from(step)).sin();
        root
    };
    for count in [5, 20, 100] {
        let mut solver = solver(Precision::F64, Integrator::SecondOrder);
        let id = solver.add_strands(&[hanging(count)]).unwrap()[0];
        let mut worst = 0.0_f64;
        for step in 0..40 {
            solver.set_root_frames(&[id], &[sway(step)], 1.0 / 60.0).unwrap();
            solver.step(1.0 / 60.0, 1).unwrap();
            let mut def = hanging(count);
            (def.initial, def.initial_rates) =
                (Some(solver.curvatures(id).unwrap().to_vec()), Some(solver.rates(id).unwrap().to_vec()));
            def.root = sway(step);
            let [(double, _), (single, residual)] = [Precision::F64, Precision::F32].map(|precision| one_step(&def, precision));
            let off = double.iter().zip(&single).map(|(a, b)| a.angle_to(b)).fold(0.0, f64::max);
            worst = worst.max(off / residual);
            assert!(off <= 3.4 * (residual + 1e-6), "N = {count}, step {step}: {off:e} rad off, said {residual:e}");
        }
        println!("N = {count}: at most {worst:.2} of the residual off");
    }
}

/// The frames at the elements' ends after a step, and the residual.
fn one_step(def: &StrandDef, precision: Precision) -> (Vec<UnitQuaternion<f64>>, f64) {
    let mut solver = solver(precision, Integrator::SecondOrder);
    let id = solver.add_strands(std::slice::from_ref(def)).unwrap()[0];
    let report = solver.step(1.0 / 60.0, 1).unwrap();
    assert_eq!((report.unconverged, report.quarantined, report.subdivided), (0, 0, 0), "{precision:?}: {report:?}");
    let mut frames = Vec::new();
    solver.sample_strands(&[id], def.element_lengths.len() + 1, |_, _, sample| frames.push(sample.rotation)).unwrap();
    (frames, report.max_residual)
}

/// Long and limp strands shaken hard: directions too large for f32 are damped, no step is rolled back. (Without, the strand of 200 elements
/// is rolled back in most steps.)
#[test]
fn long_strands_survive_being_shaken() {
    let shake = |t: f64| {
        let swing = (4.0 * std::f64::consts::PI * t).sin() * (1.0 - (-(4.0 * t).powi(2)).exp());
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.8 * swing);
        let tilt = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5);
        Frame { origin: turn * Vector3::new(0.09, 0.08 * swing, 0.0), rotation: turn * tilt }
    };
    for (count, length, radius) in [(100, 0.25, 50e-6), (200, 0.25, 50e-6), (100, 0.5, 20e-6)] {
        let mut tips = Vec::new();
        for precision in [Precision::F64, Precision::F32] {
            let mut solver = solver(precision, Integrator::SecondOrder);
            let mut def = StrandDef::straight(length, count);
            def.material =
                Material { radius: [radius; 2], youngs_modulus: 1e9, viscosity: 2e-3, air_drag: 5e-6, ..Material::default() };
            def.root = shake(0.0);
            let id = solver.add_strands(&[def]).unwrap()[0];
            for step in 1..=90 {
                solver.set_root_frames(&[id], &[shake(f64::from(step) / 60.0)], 1.0 / 60.0).unwrap();
                let report = solver.step(1.0 / 60.0, 1).unwrap();
                assert_eq!((report.unconverged, report.quarantined), (0, 0), "N = {count}, {precision:?}, step {step}");
            }
            solver.sample_at(id, &[length], |_, sample| tips.push(sample.position)).unwrap();
        }
        let off = (tips[0] - tips[1]).norm() / length;
        println!("N = {count}, L = {length}: {off:.1e} L from f64 after 1.5 s");
        assert!(off < 1e-2, "N = {count}: {off:e}");
    }
}
