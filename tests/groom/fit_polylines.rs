//! Fitting strands to polylines: made-up ones whose answer is known, and real grooms.

use std::path::Path;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::{Fit, FitOptions, fit_polyline};
use superhelix::io::Curves;
use superhelix::{Error, Frame, Solver, SolverOptions, StrandDef};

fn fit(points: &[Vector3<f64>], element_count: usize) -> Fit {
    fit_polyline(points, &FitOptions::elements(element_count)).unwrap()
}

/// Root mean square and largest errors over the length, each ascending.
fn errors_of(file: &str, scale: f64, elements: usize) -> [Vec<f64>; 2] {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/grooms").join(file);
    let curves = Curves::read(&path).unwrap();
    let mut errors = [Vec::new(), Vec::new()];
    for strand in curves.strands() {
        let points: Vec<Vector3<f64>> =
            strand.iter().map(|p| Vector3::new(p[0].into(), p[1].into(), p[2].into()) * scale).collect();
        let fit = fit(&points, elements);
        assert!(fit.rms_error <= fit.max_error && fit.max_error.is_finite());
        let length = fit.element_lengths.iter().sum::<f64>();
        errors[0].push(fit.rms_error / length);
        errors[1].push(fit.max_error / length);
    }
    errors.iter_mut().for_each(|list| list.sort_by(f64::total_cmp));
    errors
}

#[test]
fn real_grooms_are_fitted_within_a_percent_of_their_length() {
    // Of the root mean square what is measured today, with a quarter of room. Of the largest distance what was aimed at: straight and wavy
    // hair at 5 elements and curly hair at 10.
    for (file, scale, at_five, at_ten, aim) in [
        ("blender_wavy.hair", 1.0, 0.0067, 0.0025, 5),
        ("blender_curly.hair", 1.0, 0.0103, 0.0018, 10),
        ("amd_ponytail_tail.tfx", 0.0031, 0.0019, 0.0011, 5),
        ("sintel_hair_001.tfx", 0.01, 0.0023, 0.0016, 5),
        ("fibermesh_1k.tfx", 0.0012, 0.0029, 0.0012, 5),
    ] {
        for (elements, bound) in [(5, at_five), (10, at_ten)] {
            let [errors, largest] = errors_of(file, scale, elements);
            let at = |share: f64| errors[((errors.len() - 1) as f64 * share) as usize];
            println!("{file} N = {elements}: rms/L median {:.4}, p95 {:.4}, largest {:.4}", at(0.5), at(0.95), at(1.0));
            assert!(at(0.95) < bound && at(1.0) < 0.035, "{file} {elements}");
            let under = largest.partition_point(|error| *error < 0.01) as f64 / largest.len() as f64;
            assert!(elements < aim || under >= 0.95, "{file} {elements}: {under}");
        }
    }
}

#[test]
fn nearly_straight_strands_are_not_wound_up() {
    // Sintel's strands hardly bend; twist there moves the centreline by nothing and must not be invented.
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/grooms/sintel_hair_001.tfx");
    let mut largest: Vec<f64> = Curves::read(&path)
        .unwrap()
        .strands()
        .map(|strand| {
            let points: Vec<Vector3<f64>> =
                strand.iter().map(|p| Vector3::new(p[0].into(), p[1].into(), p[2].into()) * 0.01).collect();
            let fit = fit(&points, 10);
            fit.curvatures.iter().zip(&fit.element_lengths).map(|(row, length)| (row[0] * length).abs()).fold(0.0, f64::max)
        })
        .collect();
    largest.sort_by(f64::total_cmp);
    let wound = largest.iter().filter(|angle| **angle > std::f64::consts::FRAC_PI_2).count();
    println!(
        "largest twist of an element: median {:.2} rad, most {:.2} rad; {wound} strands above π/2",
        largest[114], largest[227]
    );
    assert!(wound == 0);
}

#[test]
fn a_sampled_super_helix_is_found_again() {
    // Points on a strand of four elements, dense enough that the chords hide little: 801 points leave (Ω ds)² / 24 of the length.
    let mut def = StrandDef::straight(0.2, 4);
    def.natural = vec![[5.0, 30.0, 0.0], [-3.0, 25.0, 12.0], [0.0, -10.0, 20.0], [12.0, 40.0, -5.0]];
    def.root = Frame { origin: Vector3::new(0.1, 0.2, 0.3), rotation: UnitQuaternion::from_euler_angles(0.3, 1.0, -2.0) };
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let id = solver.add_strands(&[def.clone()]).unwrap()[0];
    let mut points = Vec::new();
    solver.sample_strands(&[id], 801, |_, _, sample| points.push(sample.position)).unwrap();
    let found = fit(&points, 4);
    // The price of the twist that the fit charges for (here up to 12 rad/m) is 5.5e-6 m, 3e-5 of the length.
    assert!(found.max_error < 1e-5, "{:e}", found.max_error);
    assert_eq!(found.root.origin, points[0]);
    let tangent = def.root.rotation * Vector3::x();
    assert!((found.root.rotation * Vector3::x() - tangent).norm() < 1e-3);
    // Bending is found; twist too, wherever the element is bent. The section's axes are not in a polyline: sizes are compared.
    for (row, natural) in found.curvatures.iter().zip(&def.natural) {
        let bend = |row: &[f64; 3]| row[1].hypot(row[2]);
        assert!((bend(row) - bend(natural)).abs() < 0.1 && (row[0] - natural[0]).abs() < 0.5, "{row:?} {natural:?}");
    }
}

#[test]
fn the_fitted_strand_lies_where_the_fit_says() {
    let points: Vec<Vector3<f64>> = (0..40)
        .map(|k| {
            let t = f64::from(k) * 0.2;
            Vector3::new(0.01 * t.cos(), 0.01 * t.sin(), 0.004 * t)
        })
        .collect();
    let fit = fit(&points, 6);
    let mut def = StrandDef::straight(1.0, 6);
    def.element_lengths = fit.element_lengths.clone();
    def.natural = fit.curvatures.clone();
    def.root = fit.root;
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let id = solver.add_strands(&[def]).unwrap()[0];
    let mut arclengths = vec![0.0];
    for pair in points.windows(2) {
        arclengths.push(arclengths[arclengths.len() - 1] + (pair[1] - pair[0]).norm());
    }
    let mut worst = 0.0_f64;
    solver.sample_at(id, &arclengths, |k, sample| worst = worst.max((sample.position - points[k]).norm())).unwrap();
    assert!((worst - fit.max_error).abs() < 1e-9, "{worst:e} {:e}", fit.max_error);
    assert!(fit.max_error < 2e-4);
}

#[test]
fn hard_polylines_are_fitted_and_bad_ones_refused() {
    let line = |count: usize| (0..count).map(|k| Vector3::new(0.0, 0.0, -0.01 * k as f64)).collect::<Vec<_>>();
    for count in [2, 3, 10_000] {
        let fit = fit(&line(count), 5);
        // A straight line is a straight strand, whatever the number of points: curvature only from rounding.
        let length: f64 = fit.element_lengths.iter().sum();
        assert!(fit.max_error < 1e-9 * length, "{count}: {:e}", fit.max_error);
        assert!((length - 0.01 * (count - 1) as f64).abs() < 1e-9 * length);
    }
    // Doubled points and a hairpin.
    let mut points = line(6);
    points.insert(3, points[3]);
    points.push(points[7 - 1]);
    assert!(fit(&points, 4).max_error < 1e-9);
    let hairpin = [Vector3::zeros(), Vector3::new(0.1, 0.0, 0.0), Vector3::zeros()];
    assert!(fit(&hairpin, 8).max_error < 0.02);
    // More elements than points, and a strand shorter than a hair is wide.
    let short: Vec<_> = line(3).iter().map(|p| p * 1e-4).collect();
    assert!(fit(&short, 40).max_error < 1e-9);

    let bad = |points: &[Vector3<f64>], element_count| fit_polyline(points, &FitOptions::elements(element_count));
    for result in [
        bad(&line(4), 0),
        bad(&line(4), usize::MAX),
        bad(&[], 3),
        bad(&line(1), 3),
        bad(&[Vector3::x(); 5], 3),
        bad(&[Vector3::zeros(), Vector3::new(0.0, f64::NAN, 0.0)], 3),
        bad(&[Vector3::zeros(), Vector3::new(f64::INFINITY, 0.0, 0.0)], 3),
        bad(&[Vector3::zeros(), Vector3::new(1e300, 0.0, 0.0)], 3),
    ] {
        assert!(matches!(result, Err(Error::InvalidArgument { .. })), "{result:?}");
    }
}
