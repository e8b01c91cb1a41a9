//! Friction coefficients found again from curves that the independent oracle made, with noise (`tests/data/friction/`).

use std::path::PathBuf;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;
use superhelix::files::recorded_curve::{Measured, RecordedCurve};
use superhelix::math::frame::Frame;
use superhelix::math::pose_spline::PoseSpline;
use superhelix::rod::definition::StrandDef;
use superhelix::rod::material::Material;
use superhelix::solver::definition::{SolverOptions, Workers};
use superhelix::study::friction_fit::fit_friction;
use superhelix::study::friction_fit::{Coefficient, FittedCoefficient, FrictionFit, FrictionFitOptions, Sought, Start, Verdict};
use superhelix::study::recording::{Observable, Recording, RootMotion};

/// A recorded curve, the strand that it is of (its friction coefficients those that were true), and what is known about it.
struct Case {
    strand: StrandDef,
    recording: Recording,
    motion: RootMotion,
    /// Standard deviation of the noise.
    noise: f64,
}

fn data(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/friction").join(name)
}

fn json(name: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(data(name)).unwrap()).unwrap()
}

fn case(file: &str) -> Case {
    let name = &file[..file.rfind('_').unwrap()];
    let scene = json(&format!("{name}.scene.json"));
    let def = &scene["strands"][0];
    let number = |key: &str| def[key].as_f64().unwrap();
    let list = |value: &Value| value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect::<Vec<_>>();
    let mut strand = StrandDef::straight(number("length"), def["elements"].as_u64().unwrap() as usize);
    let radius = list(&def["radius"]);
    strand.material = Material {
        radius: [radius[0], radius[1]],
        density: number("density"),
        youngs_modulus: number("youngs_modulus"),
        poisson_ratio: number("poisson_ratio"),
        internal_friction: number("internal_friction"),
        viscosity: number("viscosity"),
        air_drag: number("air_drag"),
    };
    let natural = list(&def["natural_curvatures"][0]);
    strand.natural.fill([natural[0], natural[1], natural[2]]);
    let turned = list(&def["root"]["rotation"]);
    strand.root.rotation = UnitQuaternion::new_normalize(Quaternion::new(turned[3], turned[0], turned[1], turned[2]));

    let curve = RecordedCurve::read(data(file)).unwrap();
    let poses = curve.root.unwrap().into_iter().map(|origin| Frame { origin, rotation: strand.root.rotation }).collect();
    let motion = RootMotion::Recorded(PoseSpline::new(curve.times.clone(), poses).unwrap());
    let observable = match curve.measured {
        Measured::Span => Observable::Span,
        Measured::Depth => Observable::Depth,
        Measured::Offset => Observable::Offset(Vector3::x()),
        Measured::Angle => Observable::Angle(Vector3::x()),
    };
    let noise = json("true.json")[name]["noise"][file].as_f64().unwrap();
    Case { strand, recording: Recording { times: curve.times, values: curve.values, observable }, motion, noise }
}

fn truth(case: &Case, coefficient: Coefficient) -> f64 {
    *coefficient.of(&mut case.strand.material.clone())
}

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

/// Three standard errors, and a share of the value.
fn check(found: &FittedCoefficient, truth: f64, share: f64) {
    assert_eq!(found.verdict, Verdict::Determined);
    assert!((found.value - truth).abs() < 3.0 * found.standard_error, "{found:?}: {truth:e}");
    assert!((found.value / truth - 1.0).abs() < share, "{found:?}: {truth:e}");
    assert!(found.step_shift.abs() < 0.01 && found.excluded[0] < truth && truth < found.excluded[1], "{found:?}");
}

#[test]
fn coefficients_of_the_oracle_are_found_again() {
    use Coefficient::{AirDrag, InternalFriction, Viscosity};
    for (file, coefficients, share) in [
        ("curl_shaken_05.csv", &[InternalFriction][..], 0.02),
        ("curl_shaken_20.csv", &[InternalFriction], 0.08),
        ("curl_shaken_viscous_05.csv", &[Viscosity], 0.03),
        ("pendulum_05.csv", &[AirDrag], 0.02),
        ("pendulum_20.csv", &[AirDrag], 0.06),
        ("curl_swung_05.csv", &[InternalFriction, AirDrag], 0.05),
    ] {
        let case = case(file);
        let fit = fit(&case, &FrictionFitOptions::of(coefficients));
        shown(file, &case, &fit);
        for found in &fit.coefficients {
            check(found, truth(&case, found.coefficient), share);
        }
        assert!(fit.converged && fit.unconverged == 0);
        // The standard deviation of a standard deviation of 90 samples is 7.5 %; correlation of so many by chance 0.1.
        assert!((fit.noise / case.noise - 1.0).abs() < 0.25 && fit.residual_correlation.abs() < 0.35);
    }
}

#[test]
fn probe() {
    let both = [Coefficient::InternalFriction, Coefficient::AirDrag];
    for (file, c) in [("curl_swung_05.csv", &both[..]), ("curl_shaken_05.csv", &both[..1]), ("pendulum_05.csv", &both[1..])] {
        let mut case = case(file);
        let exact = RecordedCurve::read(format!("/tmp/target-friction-exact_{file}")).unwrap();
        case.recording.values = exact.values;
        for step in [480.0, 1920.0] {
            let mut o = FrictionFitOptions::of(c);
            o.time_step = 1.0 / step;
            shown(&format!("{step} {file}"), &case, &fit(&case, &o));
        }
    }
}
