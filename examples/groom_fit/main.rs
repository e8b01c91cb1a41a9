//! The quality of fits on real grooms, their cost beside other methods, and how still fitted strands lie: the tables of
//! docs/notebook/groom_fit.md.
//!
//!     cargo run --profile demo --example groom_fit -- OUT_DIRECTORY [GROOM_DIRECTORY] [THREADS]
//!
//! Reads every .hair, .tfx, .usda, .data and .obj of the directory (by default tests/data/grooms), uncompressed. Errors are
//! relative to the strand's length, so the grooms' units do not matter; where weight matters they are known or chosen
//! (`stillness.rs`).

mod floating_tangents;
mod methods;
mod sequential;
mod stillness;

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use methods::{Errors, METHODS};
use nalgebra::Vector3;
use rustix::time::{ClockId, clock_gettime};
use superhelix::Workers;
use superhelix::hair::{FitCurve, FitOptions, fit_curves};
use superhelix::io::Curves;

type Answer<T> = Result<T, Box<dyn std::error::Error>>;

/// Strands for the other methods, evenly spread.
const SAMPLE: usize = 300;
/// Times are the least of this many rounds.
const ROUNDS: usize = 3;

fn main() -> Answer<()> {
    let mut arguments = std::env::args().skip(1);
    let out = PathBuf::from(arguments.next().ok_or("usage: groom_fit OUT_DIRECTORY [GROOM_DIRECTORY] [THREADS]")?);
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/grooms");
    let directory = arguments.next().map_or(own, PathBuf::from);
    let threads: usize = arguments.next().map_or(Ok(2), |text| text.parse())?;
    let workers = if threads > 1 { Workers::Pool(threads) } else { Workers::Serial };

    let mut table = BufWriter::new(File::create(out.join("groom_fit.csv"))?);
    writeln!(
        table,
        "groom,strands,skipped,points,turning_degrees,elements,rms50,rms95,rms99,rms100,max50,max95,max99,max100,within1,distance95,unequal,coarse,seconds,processor_seconds,threads"
    )?;
    let mut still = BufWriter::new(File::create(out.join("groom_rest.csv"))?);
    writeln!(still, "{}", stillness::HEAD)?;
    let mut compared = BufWriter::new(File::create(out.join("groom_fit_methods.csv"))?);
    writeln!(compared, "groom,elements,method,strands,rms50,rms95,max50,max95,max100,microseconds")?;
    let mut fewest = BufWriter::new(File::create(out.join("groom_fit_tolerance.csv"))?);
    writeln!(fewest, "groom,tolerance,strands,elements50,elements95,elements100,unmet,processor_seconds")?;

    let mut files: Vec<PathBuf> =
        std::fs::read_dir(&directory)?.map(|entry| entry.map(|entry| entry.path())).collect::<Result<_, _>>()?;
    files.sort();
    for file in files {
        let name = file.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let curves = match Curves::read(&file) {
            Ok(curves) => curves,
            // A directory of grooms also has other files: bodies, motions.
            Err(error) => {
                println!("left out: {error}");
                continue;
            }
        };
        let polylines: Vec<Vec<Vector3<f64>>> =
            curves.strands().map(|strand| strand.iter().map(|point| Vector3::from(point.map(f64::from))).collect()).collect();
        let inputs: Vec<FitCurve<'_>> = polylines.iter().map(|points| FitCurve::polyline(points)).collect();
        let mut turnings: Vec<f64> = polylines.iter().map(|points| turning(points)).collect();
        let turning = at(&mut turnings, 0.5);
        for elements in [3, 5, 10, 20] {
            let options = FitOptions::elements(elements);
            let (mut seconds, mut processor, mut results) = (f64::INFINITY, f64::INFINITY, Vec::new());
            for _ in 0..ROUNDS {
                let (clock, before) = (Instant::now(), processor_seconds());
                results = fit_curves(&inputs, &options, &workers)?;
                seconds = seconds.min(clock.elapsed().as_secs_f64());
                processor = processor.min(processor_seconds() - before);
            }
            let fits: Vec<_> = results.iter().flatten().collect();
            let length = |index: usize| fits[index].element_lengths.iter().sum::<f64>();
            let over = |value: &dyn Fn(usize) -> f64| (0..fits.len()).map(value).collect::<Vec<f64>>();
            let mut rms = over(&|index| fits[index].rms_error / length(index));
            let mut max = over(&|index| fits[index].max_error / length(index));
            let mut distance = over(&|index| fits[index].max_distance / length(index));
            let unequal = fits
                .iter()
                .filter(|fit| fit.element_lengths.iter().any(|own| (own / fit.element_lengths[0] - 1.0).abs() > 1e-9))
                .count();
            let turned = |fit: &superhelix::hair::Fit| superhelix::editing::largest_turn(&fit.element_lengths, &fit.curvatures);
            let coarse = fits.iter().filter(|fit| turned(fit) > superhelix::editing::LARGEST_TURN).count();
            let within = max.iter().filter(|largest| **largest < 0.01).count() as f64 / fits.len().max(1) as f64;
            let [r50, r95, r99, r100] = [0.5, 0.95, 0.99, 1.0].map(|share| at(&mut rms, share));
            let [m50, m95, m99, m100] = [0.5, 0.95, 0.99, 1.0].map(|share| at(&mut max, share));
            writeln!(
                table,
                "{name},{},{},{},{turning:.0},{elements},{r50:.6},{r95:.6},{r99:.6},{r100:.6},{m50:.6},{m95:.6},{m99:.6},{m100:.6},{within:.5},{:.6},{unequal},{coarse},{seconds:.4},{processor:.4},{threads}",
                fits.len(),
                results.len() - fits.len(),
                curves.point_count(),
                at(&mut distance, 0.95),
            )?;
            println!("{name}, N = {elements}: rms 95 % {:.3} %, largest 95 % {:.3} %, {seconds:.2} s", 100.0 * r95, 100.0 * m95);
        }
        stillness::measure(&name, &curves, turning, &workers, &mut still)?;
        table.flush()?;
        compare(&name, &polylines, &mut compared)?;
        for share in [0.01, 0.003] {
            // A tolerance for each strand relative to its own length: the curves are scaled to length one.
            let scaled: Vec<Vec<Vector3<f64>>> =
                polylines.iter().step_by(polylines.len().div_ceil(2000)).filter_map(|points| unit(points)).collect();
            let inputs: Vec<FitCurve<'_>> = scaled.iter().map(|points| FitCurve::polyline(points)).collect();
            let before = processor_seconds();
            let results = fit_curves(&inputs, &FitOptions::within(share, 100), &workers)?;
            let processor = processor_seconds() - before;
            let fits: Vec<_> = results.iter().flatten().collect();
            let mut counts: Vec<f64> = fits.iter().map(|fit| fit.curvatures.len() as f64).collect();
            let unmet = fits.iter().filter(|fit| fit.max_error > share).count();
            let [half, most, all] = [0.5, 0.95, 1.0].map(|share| at(&mut counts, share));
            writeln!(fewest, "{name},{share},{},{half},{most},{all},{unmet},{processor:.4}", fits.len())?;
        }
    }
    Ok(())
}

/// The methods on a sample of a groom's strands, each on one thread.
fn compare(name: &str, polylines: &[Vec<Vector3<f64>>], out: &mut impl Write) -> Answer<()> {
    let sample: Vec<Vec<Vector3<f64>>> =
        polylines.iter().step_by(polylines.len().div_ceil(SAMPLE)).filter_map(|points| unit(points)).collect();
    for elements in [5, 10] {
        for (method, fit) in METHODS {
            let mut best = f64::INFINITY;
            let mut errors: Vec<Errors> = Vec::new();
            for _ in 0..2 {
                let before = processor_seconds();
                errors = sample.iter().filter_map(|points| fit(points, elements)).collect();
                best = best.min(processor_seconds() - before);
            }
            let mut rms: Vec<f64> = errors.iter().map(|errors| errors.root_mean_square).collect();
            let mut max: Vec<f64> = errors.iter().map(|errors| errors.largest).collect();
            writeln!(
                out,
                "{name},{elements},{method},{},{:.6},{:.6},{:.6},{:.6},{:.6},{:.1}",
                errors.len(),
                at(&mut rms, 0.5),
                at(&mut rms, 0.95),
                at(&mut max, 0.5),
                at(&mut max, 0.95),
                at(&mut max, 1.0),
                1e6 * best / sample.len() as f64
            )?;
        }
    }
    Ok(())
}

/// Processor time of all threads: the wall clock depends on what else runs.
fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// A polyline scaled to length one; `None` without length.
fn unit(points: &[Vector3<f64>]) -> Option<Vec<Vector3<f64>>> {
    let length: f64 = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    (length > 1e-12).then(|| points.iter().map(|point| (point - points[0]) / length).collect())
}

/// By nearest rank; sorts.
fn at(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(((values.len().max(1) - 1) as f64 * share).round() as usize).copied().unwrap_or(f64::NAN)
}

/// Sum of the angles between successive edges, degrees.
fn turning(points: &[Vector3<f64>]) -> f64 {
    let edges: Vec<Vector3<f64>> = points.windows(2).map(|pair| pair[1] - pair[0]).filter(|edge| edge.norm() > 0.0).collect();
    edges.windows(2).map(|pair| pair[0].angle(&pair[1])).sum::<f64>().to_degrees()
}
