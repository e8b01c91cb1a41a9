//! Subdivided steps: where a strand's step does not converge, and where it errs by more than permitted.

use crate::oracle_cases::{self, Case};
use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{Frame, Integrator, Material, Solver, SolverOptions, StrandDef, StrandId, Workers};

/// A root shaken in yaw by ±46° at 2 Hz.
fn shake(t: f64) -> Frame {
    let angle = 0.8 * (4.0 * std::f64::consts::PI * t).sin() * (1.0 - (-(4.0 * t).powi(2)).exp());
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
    let tilt = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -0.5);
    Frame { origin: turn * Vector3::new(0.09, 0.0, 0.0), rotation: turn * tilt }
}

fn long_hair() -> StrandDef {
    let mut def = StrandDef::straight(0.25, 10);
    def.material = Material { youngs_modulus: 1e9, internal_friction: 1e-10, air_drag: 5e-6, ..Material::default() };
    def.root = shake(0.0);
    def
}

fn tip(solver: &Solver, id: StrandId) -> Vector3<f64> {
    let mut tip = Vector3::zeros();
    solver
        .sample_strands(&[id], 2, |_, point, sample| {
            if point == 1 {
                tip = sample.position;
            }
        })
        .unwrap();
    tip
}

/// One call of the head shake at 1/30 s: the first strand is shaken, the others hang.
fn shake_once(solver: &mut Solver, shaken: StrandId, step: i32) -> superhelix::StepReport {
    let h = 1.0 / 30.0;
    solver.set_root_frames(&[shaken], &[shake(h * f64::from(step))], h).unwrap();
    solver.step(h, 1).unwrap()
}

#[test]
fn a_step_that_does_not_converge_does_so_in_substeps() {
    let run = |max_subdivisions: u32| {
        let mut options = SolverOptions::default();
        (options.step.max_iterations, options.step.max_subdivisions) = (8, max_subdivisions);
        let mut solver = Solver::new(options).unwrap();
        let id = solver.add_strands(&[long_hair()]).unwrap()[0];
        let (mut unconverged, mut subdivided) = (0, 0);
        for step in 1..=60 {
            let report = shake_once(&mut solver, id, step);
            assert_eq!(report.quarantined, 0);
            unconverged += report.unconverged;
            subdivided += report.subdivided;
        }
        (unconverged, subdivided)
    };
    let (whole, none) = run(0);
    let (parts, subdivided) = run(4);
    println!("of 60 steps {whole} do not converge within 8 iterations; in substeps {parts} ({subdivided} subdivided)");
    assert_eq!(none, 0);
    assert!(whole >= 5, "the test is too easy");
    assert_eq!(parts, 0);
    assert!(subdivided > 0);
}

#[test]
fn only_strands_that_need_substeps_take_them_with_any_number_of_threads() {
    let run = |others: usize, workers: Workers| {
        let mut options = SolverOptions { workers, ..SolverOptions::default() };
        (options.step.max_iterations, options.step.error_tolerance) = (8, 1e-3);
        let mut solver = Solver::new(options).unwrap();
        let mut calm = StrandDef::straight(0.1, 5);
        // Hanging down.
        calm.root.rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::FRAC_PI_2);
        let mut defs = vec![calm; others];
        defs.push(long_hair());
        let ids = solver.add_strands(&defs).unwrap();
        let mut subdivided = 0;
        for step in 1..=30 {
            subdivided += shake_once(&mut solver, ids[others], step).subdivided;
        }
        (tip(&solver, ids[others]), subdivided, solver.state_hash())
    };
    let (alone, subdivided, _) = run(0, Workers::Serial);
    assert!(subdivided > 0, "the test is too easy");
    let (beside, subdivided_beside, hash) = run(9, Workers::Serial);
    assert_eq!((alone, subdivided), (beside, subdivided_beside));
    for threads in [2, 3] {
        assert_eq!(hash, run(9, Workers::Pool(threads)).2);
    }
}

/// Largest error of the tip, in lengths, over an oracle's trajectory in calls of 1/60 s; the largest error that a step reported; mean number of substeps.
fn with_error_tolerance(case: &Case, integrator: Integrator, error_tolerance: f64) -> (f64, f64, u32) {
    let mut options = SolverOptions::default();
    options.step.integrator = integrator;
    options.step.tolerance = 1e-9;
    (options.step.max_subdivisions, options.step.error_tolerance) = (10, error_tolerance);
    let mut solver = Solver::new(options).unwrap();
    let id = solver.add_strands(std::slice::from_ref(&case.def)).unwrap()[0];
    let (mut worst, mut told, mut subdivided, mut t) = (0.0_f64, 0.0_f64, 0, 0.0);
    for (time, expected) in case.times.iter().zip(&case.tips) {
        let calls = ((time - t) * 60.0).round().max(1.0);
        let h = (time - t) / calls;
        for call in 1..=calls as u32 {
            if let Some(root) = &case.root {
                solver.set_root_frames(&[id], &[root.at(t + h * f64::from(call))], h).unwrap();
            }
            let report = solver.step(h, 1).unwrap();
            assert_eq!((report.unconverged, report.quarantined), (0, 0));
            told = told.max(report.max_error);
            subdivided += report.subdivided;
        }
        t = *time;
        worst = worst.max((tip(&solver, id) - expected).norm() / case.def.length());
    }
    (worst, told, subdivided)
}

#[test]
fn a_smaller_error_tolerance_brings_a_smaller_error_at_the_same_frames() {
    let case = oracle_cases::all().into_iter().find(|case| case.name == "stiff_planar_n1").unwrap();
    assert!(case.uncertainty < 1e-6);
    for integrator in [Integrator::SecondOrder, Integrator::ImplicitEuler] {
        let tolerances = [0.0, 1e-3, 1e-4, 1e-5];
        let mut errors = Vec::new();
        for tolerance in tolerances {
            let (error, told, subdivided) = with_error_tolerance(&case, integrator, tolerance);
            println!(
                "{integrator:?}, {tolerance:e} L a step: error {error:.2e} L, reported {told:.1e} L, {subdivided} of 30 steps in substeps"
            );
            assert_eq!(told > 0.0, tolerance > 0.0);
            // Ten halvings are enough for the second order here, and for the first down to 1e-5 too.
            assert!(told <= tolerance, "{told:e}");
            errors.push(error);
        }
        // A tenth of the error a step is, at second order, a third of the steps' length squared … at least a factor of three each.
        for pair in errors[1..].windows(2) {
            assert!(pair[1] < 0.4 * pair[0], "{errors:?}");
        }
        assert!(errors[1] < 0.7 * errors[0], "{errors:?}");
    }
}

#[test]
fn the_reported_error_of_a_step_falls_with_its_cube() {
    // A smooth motion: a strand let go, past its start.
    let told = |h: f64| {
        let mut options = SolverOptions::default();
        (options.step.max_subdivisions, options.step.error_tolerance, options.step.tolerance) = (0, 1.0, 1e-10);
        let mut solver = Solver::new(options).unwrap();
        let mut def = StrandDef::straight(0.1, 3);
        def.material = Material { viscosity: 5e-3, ..Material::default() };
        solver.add_strands(&[def]).unwrap();
        let steps = (0.1 / h).round() as u32;
        (0..steps).map(|_| solver.step(h, 1).unwrap().max_error).last().unwrap()
    };
    let (one, half, quarter) = (told(1e-3), told(5e-4), told(2.5e-4));
    println!("reported after 0.1 s: {one:.2e}, {half:.2e}, {quarter:.2e}");
    for ratio in [one / half, half / quarter] {
        assert!((6.0..10.0).contains(&ratio), "{ratio}");
    }
}

#[test]
fn a_snapshot_in_the_middle_of_substeps_goes_on_to_the_same_bits() {
    let mut options = SolverOptions::default();
    (options.step.max_iterations, options.step.error_tolerance) = (8, 1e-3);
    let mut solver = Solver::new(options).unwrap();
    let id = solver.add_strands(&[long_hair()]).unwrap()[0];
    let mut subdivided = 0;
    for step in 1..=15 {
        subdivided += shake_once(&mut solver, id, step).subdivided;
    }
    assert!(subdivided > 0);
    let image = solver.snapshot();
    let mut twin = Solver::new(SolverOptions::default()).unwrap();
    twin.restore(&image).unwrap();
    for step in 16..=30 {
        shake_once(&mut solver, id, step);
        shake_once(&mut twin, id, step);
    }
    assert_eq!(solver.state_hash(), twin.state_hash());
}
