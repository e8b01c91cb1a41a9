//! Friction coefficients found again from curves that the independent oracle made, with noise (`tests/data/friction/`).

use crate::friction_cases::{Case, case, truth};
use nalgebra::Vector3;
use superhelix::editing::EquilibriumOptions;
use superhelix::experiments::Coefficient::{AirDrag, InternalFriction, Viscosity};
use superhelix::experiments::{
    FittedCoefficient, FrictionFit, FrictionFitOptions, Observable, RootMotion, Sought, Start, Verdict, fit_friction,
};
use superhelix::{Integrator, Solver, SolverOptions, Workers};

/// Fits, without the true coefficients in the strand.
fn fit(case: &Case, options: &FrictionFitOptions) -> FrictionFit {
    let mut strand = case.strand.clone();
    for sought in &options.sought {
        *sought.coefficient.of(&mut strand.material) = 0.0;
    }
    fit_friction(&strand, &case.recording, &case.motion, options).unwrap()
}

fn shown(name: &str, case: &Case, fit: &FrictionFit) {
    for found in &fit.coefficients {
        let truth = truth(case, found.coefficient);
        println!(
            "{name} {}: {:.4e} of {truth:e} ({:+.2} %, {:+.2} standard errors of {:.2} %), step {:+.1e}, excluded {:.1e} to {:.1e}, {:?}",
            found.coefficient.name(),
            found.value,
            100.0 * (found.value / truth - 1.0),
            (found.value - truth) / found.standard_error,
            100.0 * found.standard_error / found.value,
            found.step_shift,
            found.excluded[0],
            found.excluded[1],
            found.verdict,
        );
    }
    println!(
        "  residual {:.3e}, noise {:.3e} of {:.3e}, correlation {:+.2}, offset {:.2e}, {} simulations, converged {}",
        fit.rms_residual, fit.noise, case.noise, fit.residual_correlation, fit.offset, fit.simulations, fit.converged
    );
}

/// Three standard errors, and a fraction of the value.
fn check(found: &FittedCoefficient, truth: f64, share: f64) {
    assert_eq!(found.verdict, Verdict::Determined);
    assert!((found.value - truth).abs() < 3.0 * found.standard_error, "{found:?}: {truth:e}");
    assert!((found.value / truth - 1.0).abs() < share, "{found:?}: {truth:e}");
    assert!(found.step_shift.abs() < 0.01 && found.excluded[0] < truth && truth < found.excluded[1], "{found:?}");
}

#[test]
fn coefficients_of_the_oracle_are_found_again() {
    for (file, coefficients, share) in [
        ("curl_shaken_05.csv", &[InternalFriction][..], 0.03),
        ("curl_shaken_20.csv", &[InternalFriction], 0.12),
        ("curl_shaken_viscous_05.csv", &[Viscosity], 0.03),
        ("pendulum_05.csv", &[AirDrag], 0.01),
        ("pendulum_20.csv", &[AirDrag], 0.04),
        ("curl_swung_05.csv", &[InternalFriction, AirDrag], 0.05),
    ] {
        let case = case(file);
        let fit = fit(&case, &FrictionFitOptions::of(coefficients));
        shown(file, &case, &fit);
        for found in &fit.coefficients {
            check(found, truth(&case, found.coefficient), share);
        }
        assert!(fit.converged && fit.unconverged == 0);
        // The standard deviation of a standard deviation of 90 samples is 7.5 %; chance correlation of that many 0.1.
        assert!((fit.noise / case.noise - 1.0).abs() < 0.25 && fit.residual_correlation.abs() < 0.35);
    }
}

#[test]
fn without_noise_what_is_left_is_the_step() {
    for (file, coefficients, frequency) in [
        ("curl_shaken_00.csv", &[InternalFriction][..], Some(3.0)),
        ("curl_shaken_viscous_00.csv", &[Viscosity], Some(4.0)),
        ("pendulum_00.csv", &[AirDrag], None),
        ("curl_swung_00.csv", &[InternalFriction, AirDrag], None),
    ] {
        let mut case = case(file);
        if let Some(frequency) = frequency {
            case.motion = RootMotion::Oscillation { amplitude: 0.01, frequency, phase: 0.0, direction: None };
        }
        let mut options = FrictionFitOptions::of(coefficients);
        options.grid_points = 5;
        let fit = fit(&case, &options);
        shown(file, &case, &fit);
        for found in &fit.coefficients {
            let error = found.value / truth(&case, found.coefficient) - 1.0;
            // Half the step takes three quarters of a second-order error away.
            assert!(error.abs() < 2.0 * found.step_shift.abs() + 2e-4 && error.abs() < 0.01, "{file}: {found:?}");
        }
    }
}

#[test]
fn fifteen_samples_a_period_of_the_root_are_enough_for_two_percent() {
    let recorded = case("curl_shaken_viscous_00.csv");
    let fit = fit(&recorded, &FrictionFitOptions::of(&[Viscosity]));
    assert!((fit.coefficients[0].value / truth(&recorded, Viscosity) - 1.0).abs() < 0.02, "{:?}", fit.coefficients);
}

/// Numbers with the distribution of Gauss, from a seed.
fn gaussian(seed: u64) -> impl Iterator<Item = f64> {
    let mut state = seed;
    let mut uniform = move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    };
    std::iter::repeat_with(move || (-2.0 * (1.0 - uniform()).ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos())
}

#[test]
fn the_standard_error_is_what_noise_does_to_the_coefficient() {
    let exact = case("curl_shaken_00.csv");
    let truth = truth(&exact, InternalFriction);
    let mut options = FrictionFitOptions::of(&[InternalFriction]);
    (options.sought[0].guess, options.grid_points, options.time_step) = (Some(1.5 * truth), 0, 1.0 / 240.0);
    let draws = 20;
    let errors: Vec<f64> = (0..draws)
        .map(|seed| {
            let mut noisy = case("curl_shaken_00.csv");
            noisy.recording.values.iter_mut().zip(gaussian(seed)).for_each(|(value, noise)| *value += 0.001 * noise);
            let found = fit(&noisy, &options).coefficients[0];
            (found.value - truth) / found.standard_error
        })
        .collect();
    let mean = errors.iter().sum::<f64>() / draws as f64;
    let square = (errors.iter().map(|error| error * error).sum::<f64>() / draws as f64).sqrt();
    println!("in standard errors: mean {mean:.2}, root mean square {square:.2}");
    // Three standard deviations of the mean of 20, and of their root mean square (16 %).
    assert!(mean.abs() < 0.67 && (0.52..1.48).contains(&square));
}

#[test]
fn curves_without_information_are_told_from_those_with_some() {
    // A straight strand that is shaken along itself does not change its span.
    let straight = case("straight_shaken_05.csv");
    let found = fit(&straight, &FrictionFitOptions::of(&[InternalFriction])).coefficients[0];
    assert_eq!(found.verdict, Verdict::Undetermined, "{found:?}");
    assert!(found.excluded == [0.0, f64::INFINITY] && found.standard_error >= found.value);

    // A round strand that bends in a plane does not distinguish its two kinds of internal friction.
    let pendulum = case("pendulum_05.csv");
    let mut options = FrictionFitOptions::of(&[InternalFriction, Viscosity]);
    options.grid_points = 3;
    let fitted = fit(&pendulum, &options);
    for found in &fitted.coefficients {
        assert_eq!(found.verdict, Verdict::Undetermined, "{found:?}");
    }
}

#[test]
fn the_end_of_the_range_is_no_answer() {
    let case = case("curl_shaken_20.csv");
    for (range, verdict) in [([1e-12, 3e-11], Verdict::AtUpperEnd), ([4e-10, 1e-8], Verdict::AtLowerEnd)] {
        let sought = Sought { range, ..Sought::usual(InternalFriction) };
        let options = FrictionFitOptions { sought: vec![sought], grid_points: 4, ..FrictionFitOptions::of(&[]) };
        let found = fit(&case, &options).coefficients[0];
        assert_eq!(found.verdict, verdict, "{found:?}");
        assert!((found.value / range[usize::from(verdict == Verdict::AtUpperEnd)] - 1.0).abs() < 1e-12);
    }
}

#[test]
fn an_oscillation_may_be_given_by_its_numbers_and_its_beginning_left_out() {
    let mut case = case("curl_shaken_05.csv");
    case.motion = RootMotion::Oscillation { amplitude: 0.01, frequency: 3.0, phase: 0.0, direction: None };
    let truth = truth(&case, InternalFriction);
    let mut options = FrictionFitOptions::of(&[InternalFriction]);
    options.grid_points = 5;
    check(&fit(&case, &options).coefficients[0], truth, 0.04);
    // From 0.4 s on, the strand at rest at 0 s as it was: exact.
    case.recording.times.drain(..24);
    case.recording.values.drain(..24);
    options.lead_in = case.recording.times[0];
    check(&fit(&case, &options).coefficients[0], truth, 0.04);
    // At rest a period before the first sample, as it was not: half a second is too short for it to be forgotten, and residuals that
    // follow one another tell so.
    (options.lead_in, options.discard) = (1.0 / 3.0, 0.5);
    let hasty = fit(&case, &options);
    shown("half a second", &case, &hasty);
    assert!(hasty.residual_correlation > 0.5);
    assert_eq!((hasty.first_compared, hasty.curve.len()), (30, case.recording.times.len() - 30));
}

#[test]
fn a_motion_that_has_forgotten_its_beginning_needs_none() {
    // Recorded from 2 s on; simulated from rest at 1 s, elsewhere in the period than the oracle started.
    let mut case = case("curl_shaken_long_05.csv");
    case.motion = RootMotion::Oscillation { amplitude: 0.01, frequency: 3.0, phase: 0.0, direction: None };
    let mut options = FrictionFitOptions::of(&[InternalFriction]);
    (options.lead_in, options.grid_points) = (1.25, 5);
    let fit = fit(&case, &options);
    shown("forgotten", &case, &fit);
    check(&fit.coefficients[0], truth(&case, InternalFriction), 0.03);
    assert!(fit.residual_correlation.abs() < 0.35);
}

#[test]
fn a_marker_beside_the_tip_is_fitted_as_an_offset() {
    let mut case = case("curl_shaken_05.csv");
    case.recording.values.iter_mut().for_each(|value| *value += 0.002);
    let mut options = FrictionFitOptions::of(&[InternalFriction]);
    let without = fit(&case, &options);
    assert!(without.residual_correlation > 0.5 && without.offset == 0.0, "{without:?}");
    options.fit_offset = true;
    let with = fit(&case, &options);
    shown("offset", &case, &with);
    check(&with.coefficients[0], truth(&case, InternalFriction), 0.05);
    // The noise of a mean of 121, and twice that for what the coefficient takes from it.
    assert!((with.offset - 0.002).abs() < 6.0 * case.noise / 11.0 && with.residual_correlation < 0.3);
    let square: f64 = with.curve.iter().zip(&case.recording.values).map(|(curve, value)| (curve - value).powi(2)).sum();
    assert!(((square / 121.0).sqrt() / with.rms_residual - 1.0).abs() < 1e-9);
}

#[test]
fn the_result_depends_neither_on_threads_nor_on_how_the_start_is_given() {
    let mut case = case("curl_shaken_viscous_05.csv");
    let mut options = FrictionFitOptions::of(&[Viscosity]);
    (options.grid_points, options.time_step) = (5, 1.0 / 240.0);
    let serial = fit(&case, &options);
    options.solver.workers = Workers::Pool(2);
    assert_eq!(fit(&case, &options), serial);
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let ids = solver.add_strands(std::slice::from_ref(&case.strand)).unwrap();
    assert!(solver.settle(&ids, &EquilibriumOptions::default()).unwrap()[0].converged);
    case.strand.initial = Some(solver.curvatures(ids[0]).unwrap().to_vec());
    options.start = Start::AsDefined;
    let value = fit(&case, &options).coefficients[0].value;
    assert!((value / serial.coefficients[0].value - 1.0).abs() < 1e-6);
}

#[test]
fn simulations_that_blow_up_are_left_out() {
    // The papers' step does not survive this friction from 5e-12 kg m3/s on (docs/theory/integrators.md).
    let case = case("curl_shaken_05.csv");
    let mut options = FrictionFitOptions::of(&[InternalFriction]);
    options.solver.step.integrator = Integrator::LinearlyImplicit;
    let found = fit(&case, &options).coefficients[0];
    assert!(found.value < 1e-10 && found.excluded[1].is_infinite(), "{found:?}");
    options.sought[0].range = [1e-9, 1e-8];
    let error = fit_friction(&case.strand, &case.recording, &case.motion, &options).unwrap_err().to_string();
    assert!(error.contains("options.sought") && error.contains("internal_friction"), "{error}");
}

#[test]
fn what_cannot_be_used_is_named() {
    type Spoil = fn(&mut Case, &mut FrictionFitOptions);
    let cases: [(&str, Spoil); 24] = [
        ("options.sought", |_, o| o.sought.clear()),
        ("options.sought[1]", |_, o| o.sought.push(o.sought[0])),
        ("options.internal_friction_range[0]", |_, o| o.sought[0].range[0] = 0.0),
        ("options.internal_friction_range[1]", |_, o| o.sought[0].range[1] = 1e-12),
        ("options.internal_friction_guess", |_, o| o.sought[0].guess = Some(1.0)),
        ("options.internal_friction_guess", |_, o| o.grid_points = 0),
        ("options.grid_points", |_, o| o.grid_points = 1),
        ("options.grid_points", |_, o| o.grid_points = 65),
        ("options.lead_in", |_, o| o.lead_in = -1.0),
        ("options.discard", |_, o| o.discard = f64::NAN),
        ("options.time_step", |_, o| o.time_step = 0.0),
        ("options.time_step", |_, o| o.time_step = 1e-12),
        ("options.max_iterations", |_, o| o.max_iterations = 0),
        ("options.solver.wind[1]", |_, o| o.solver.wind[1] = f64::INFINITY),
        ("options.solver.gravity", |c, o| {
            o.solver.gravity.fill(0.0);
            c.recording.observable = Observable::Depth;
        }),
        ("recording.values (count)", |c, _| c.recording.values.truncate(3)),
        ("recording.values[2]", |c, _| c.recording.values[2] = f64::NAN),
        ("recording.times[5]", |c, _| c.recording.times[5] = c.recording.times[4]),
        ("recording.times[5]", |c, _| c.recording.times[5] = c.recording.times[4] + 1e-12),
        ("recording.times (count to compare)", |_, o| o.discard = 1e3),
        ("recording.direction", |c, _| c.recording.observable = Observable::Angle(Vector3::z())),
        ("recording.direction", |c, _| c.recording.observable = Observable::Offset(Vector3::zeros())),
        ("motion.frequency", |c, _| {
            c.motion = RootMotion::Oscillation { amplitude: 1.0, frequency: 0.0, phase: 0.0, direction: None };
        }),
        ("strand.density", |c, _| c.strand.material.density = -1.0),
    ];
    for (named, spoil) in cases {
        let (mut case, mut options) = (case("curl_shaken_05.csv"), FrictionFitOptions::of(&[InternalFriction]));
        spoil(&mut case, &mut options);
        let error = fit_friction(&case.strand, &case.recording, &case.motion, &options).unwrap_err().to_string();
        assert!(error.starts_with(&format!("{named} is ")), "{named}: {error}");
    }
}
