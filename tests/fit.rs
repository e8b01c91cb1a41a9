//! Fitting strands to polylines: made-up ones whose answer is known, and real grooms.

use std::path::Path;

use nalgebra::Vector3;
use superhelix::files::curves::Curves;
use superhelix::groom::fit::{Fit, FitOptions, fit_polyline};

fn fit_all(file: &str, scale: f64, elements: usize) -> Vec<(Fit, f64)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/grooms").join(file);
    let curves = Curves::read(&path).unwrap();
    curves
        .strands()
        .filter_map(|strand| {
            let points: Vec<Vector3<f64>> =
                strand.iter().map(|p| Vector3::new(p[0].into(), p[1].into(), p[2].into()) * scale).collect();
            let fit = fit_polyline(&points, &FitOptions { element_count: elements }).ok()?;
            let length: f64 = fit.element_lengths.iter().sum();
            Some((fit, length))
        })
        .collect()
}

#[test]
fn probe() {
    for (file, scale) in [
        ("blender_wavy.hair", 1.0),
        ("blender_curly.hair", 1.0),
        ("amd_ponytail_tail.tfx", 0.0031),
        ("sintel_hair_001.tfx", 0.01),
        ("fibermesh_1k.tfx", 0.0012),
    ] {
        for elements in [5, 10, 20] {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/grooms").join(file);
            if !path.exists() {
                continue;
            }
            let start = std::time::Instant::now();
            let fits = fit_all(file, scale, elements);
            let seconds = start.elapsed().as_secs_f64();
            let mut errors: Vec<f64> = fits.iter().map(|(fit, length)| fit.rms_error / length).collect();
            errors.sort_by(f64::total_cmp);
            let at = |q: f64| errors[((errors.len() - 1) as f64 * q) as usize];
            println!(
                "{file} N={elements}: {} strands, rms/L p50 {:.4} p90 {:.4} p95 {:.4} max {:.4}, {seconds:.2} s",
                errors.len(),
                at(0.5),
                at(0.9),
                at(0.95),
                at(1.0)
            );
        }
    }
}
