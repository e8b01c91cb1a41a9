//! `superhelix fit`: strands for the curves of a groom, and how close they come.

use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};
use serde::Serialize;
use superhelix::editing::{LARGEST_TURN, largest_turn};
use superhelix::hair::{DrawnCurve, ElementLengths, Fit, FitCurve, FitOptions, MAX_STARTS, fit_curves};
use superhelix::io::Curves;
use superhelix::{GroomOptions, Workers};

use crate::groom::material_arguments::MaterialArguments;
use crate::groom::statistics::ranked;
use crate::groom::stiffening_arguments::StiffeningArguments;
use crate::groom::strands::{NaturalShape, Skipped, check_stiffening};
use crate::groom::unit;
use crate::groom::wisp_arguments::WispArguments;
use crate::scene::strands::written as fit_scene;
use crate::shell::argument_values::{not_negative, positive, share};
use crate::shell::failure::Failure;
use crate::shell::up::Up;

/// Fits Super-Helices to the strands of a groom: says how close they come with how many elements, and writes them as a scene.
#[derive(Debug, Args)]
pub struct FitArguments {
    /// The groom: .hair, .tfx, .obj with lines, .usda, .abc, .data, .ply, .npy or .npz, root first.
    #[arg(value_name = "GROOM")]
    groom: PathBuf,
    /// Helical elements a strand; several numbers make a table. With --tolerance: the most. Default: 3,5,10,20, or with --tolerance 100.
    #[arg(long, value_name = "N,..", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=10_000))]
    elements: Vec<u32>,
    /// The fewest elements for which no point is farther than this from its strand at equal arclength, m. Needs the groom's unit.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    tolerance: Option<f64>,
    /// Metres a unit of the groom. Default: what the file says (.usda). Without either errors are given in per cent of the length alone.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    scale: Option<f64>,
    /// Whether the elements of a strand may differ in length.
    #[arg(long, value_enum, default_value_t = Lengths::WhereNeeded)]
    lengths: Lengths,
    /// Elements without twist: arcs of circles.
    #[arg(long)]
    no_twist: bool,
    /// What points may be off by, file units: the length of a strand that zigzags by less is taken along its middle.
    #[arg(long, value_name = "UNITS", default_value_t = 0.0, value_parser = not_negative)]
    noise: f64,
    /// Starts tried for a strand at most.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=MAX_STARTS as i64))]
    starts: u32,
    /// A strand farther than this share of its length from a point has that lowered, at the cost of the root mean square; 1: never.
    #[arg(long, value_name = "SHARE", default_value_t = 0.01, value_parser = share)]
    good_largest: f64,
    /// Use each K-th strand only.
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Threads.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=256))]
    threads: u32,
    /// Writes the strands of the last fit as a scene for `superhelix run`. Needs the groom's unit.
    #[arg(long, short, value_name = "SCENE.json")]
    out: Option<PathBuf>,
    /// For --out: the groom's axis that points up; gravity points the other way.
    #[arg(long, value_enum, value_name = "AXIS", default_value_t = Up::Y)]
    up: Up,
    /// For --out: natural shape of the strands.
    #[arg(long, value_enum, value_name = "SHAPE", default_value_t = NaturalShape::SagFree)]
    natural: NaturalShape,
    #[command(flatten)]
    stiffening: StiffeningArguments,
    #[command(flatten)]
    wisps: WispArguments,
    #[command(flatten)]
    material: MaterialArguments,
    /// The answer as JSON.
    #[arg(long)]
    json: bool,
}

/// See [`ElementLengths`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
enum Lengths {
    /// All equally long.
    Equal,
    /// Equally long where that is good, else free.
    WhereNeeded,
    /// Free.
    Free,
}

/// Nearest ranks over the strands.
#[derive(Debug, Clone, Copy, Serialize)]
struct Percentiles {
    p50: f64,
    p95: f64,
    p99: f64,
    max: f64,
}

impl Percentiles {
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let at = |share: f64| ranked(&values, share);
        Self { p50: at(0.5), p95: at(0.95), p99: at(0.99), max: at(1.0) }
    }
}

/// One fit of the whole groom.
#[derive(Debug, Serialize)]
struct Row {
    /// Elements asked for.
    elements: u32,
    strands: usize,
    /// Shares of the length.
    rms: Percentiles,
    max: Percentiles,
    /// From the nearest place of the centreline.
    distance: Percentiles,
    /// Elements that strands got.
    element_count: Percentiles,
    /// Strands with an element that turns by more than a quarter turn: it moves too stiffly.
    coarse_strands: usize,
    /// Metres, where the groom's unit is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    max_metres: Option<Percentiles>,
    /// Strands that do not keep the tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    unmet: Option<usize>,
    seconds: f64,
}

#[derive(Debug, Serialize)]
struct Answer {
    file: String,
    format: &'static str,
    strands: usize,
    points: usize,
    threads: u32,
    rows: Vec<Row>,
    /// Strands that cannot be fitted, or not be simulated (--out).
    skipped: Vec<Skipped>,
}

/// Runs the command.
pub fn run(arguments: &FitArguments) -> Result<(), Failure> {
    let hair = arguments.wisps.hair(arguments.material.groom()?)?;
    check_stiffening(arguments.natural, &arguments.stiffening, &arguments.material)?;
    let curves = Curves::read(&arguments.groom)?;
    let unit = unit::stated(arguments.scale, &curves);
    for (given, flag) in [(arguments.tolerance.is_some(), "--tolerance"), (arguments.out.is_some(), "--out")] {
        if given {
            unit::needed(arguments.scale, &curves, &arguments.groom, flag)?;
        }
    }
    let scale = unit.unwrap_or(1.0);
    if arguments.out.is_some() {
        arguments.up.check_groom(&arguments.groom, &curves)?;
    }
    let polylines = unit::drawn(&curves, arguments.every as usize, scale);
    let workers = if arguments.threads == 1 { Workers::Serial } else { Workers::Pool(arguments.threads as usize) };
    let inputs: Vec<FitCurve<'_>> = polylines.iter().map(DrawnCurve::fit_curve).collect();
    let elements = match (&arguments.elements[..], arguments.tolerance) {
        ([], None) => vec![3, 5, 10, 20],
        ([], Some(_)) => vec![100],
        (given, _) => given.to_vec(),
    };
    let mut answer = Answer {
        file: arguments.groom.display().to_string(),
        format: curves.format().name(),
        strands: inputs.len(),
        points: polylines.iter().map(|polyline| polyline.points.len()).sum(),
        threads: arguments.threads,
        rows: Vec::new(),
        skipped: Vec::new(),
    };
    let mut last = Vec::new();
    for count in elements {
        let options = FitOptions {
            element_count: count as usize,
            tolerance: arguments.tolerance,
            lengths: match arguments.lengths {
                Lengths::Equal => ElementLengths::Equal,
                Lengths::WhereNeeded => ElementLengths::WhereNeeded,
                Lengths::Free => ElementLengths::Free,
            },
            twist: !arguments.no_twist,
            starts: arguments.starts as usize,
            good_largest: arguments.good_largest,
            noise: arguments.noise * scale,
            ..FitOptions::default()
        };
        let begun = Instant::now();
        let results = fit_curves(&inputs, &options, &workers)?;
        let seconds = begun.elapsed().as_secs_f64();
        last.clear();
        answer.skipped.clear();
        for (DrawnCurve { index, .. }, result) in polylines.iter().zip(results) {
            match result {
                Ok(fit) => last.push((*index, fit)),
                Err(error) => answer.skipped.push(Skipped { strand: *index, because: error.to_string() }),
            }
        }
        if last.is_empty() {
            let why = answer.skipped.first().map_or_else(|| "it has none".to_string(), |skipped| skipped.because.clone());
            return Err(Failure::file(&arguments.groom, format!("no strand can be fitted: {why}")));
        }
        answer.rows.push(row(count, &last, arguments, unit, seconds));
    }
    if let Some(path) = &arguments.out {
        let options = GroomOptions {
            natural: arguments.natural.into(),
            stiffening: arguments.stiffening.stiffening().or_else(|| arguments.wisps.stiffening(arguments.natural, &hair)),
            gravity: arguments.up.gravity(),
            ..hair.options()
        };
        let mut strands = Vec::new();
        for (index, fit) in last {
            match options.definition(index, fit) {
                Ok((strand, _)) => strands.push(strand),
                Err(error) => answer.skipped.push(Skipped { strand: index, because: error.to_string() }),
            }
        }
        fit_scene::write(path, &strands, options.gravity)?;
    }
    crate::shell::answer::print_answer(arguments.json, &answer, || in_words(&answer, arguments))
}

fn row(elements: u32, fits: &[(usize, Fit)], arguments: &FitArguments, unit: Option<f64>, seconds: f64) -> Row {
    let over = |value: &dyn Fn(&Fit) -> f64| Percentiles::of(fits.iter().map(|(_, fit)| value(fit)).collect());
    let length = |fit: &Fit| fit.element_lengths.iter().sum::<f64>();
    Row {
        elements,
        strands: fits.len(),
        rms: over(&|fit| fit.rms_error / length(fit)),
        max: over(&|fit| fit.max_error / length(fit)),
        distance: over(&|fit| fit.max_distance / length(fit)),
        element_count: over(&|fit| fit.curvatures.len() as f64),
        coarse_strands: fits
            .iter()
            .filter(|(_, fit)| largest_turn(&fit.element_lengths, &fit.curvatures) > LARGEST_TURN * (1.0 + 1e-9))
            .count(),
        max_metres: unit.map(|_| over(&|fit| fit.max_error)),
        unmet: arguments.tolerance.map(|tolerance| fits.iter().filter(|(_, fit)| fit.max_error > tolerance).count()),
        seconds,
    }
}

fn in_words(answer: &Answer, arguments: &FitArguments) -> String {
    let mut text = format!(
        "{}: {}, {} strands, {} points\ndistance at equal arclength, per cent of the length\n",
        answer.file, answer.format, answer.strands, answer.points
    );
    text += "elements   strands      rms: 50 %    95 %    99 %     max   largest: 50 %    95 %    99 %     max    seconds\n";
    for row in &answer.rows {
        let count = if arguments.tolerance.is_some() { format!("to {}", row.elements) } else { row.elements.to_string() };
        text += &format!("{count:>8}{:>10}", row.strands);
        for (Percentiles { p50, p95, p99, max }, width) in [(row.rms, 15), (row.max, 16)] {
            let [p50, p95, p99, max] = [p50, p95, p99, max].map(|share| 100.0 * share);
            text += &format!("{p50:>width$.3}{p95:>8.3}{p99:>8.3}{max:>8.3}");
        }
        text += &format!("{:>11.3}\n", row.seconds);
        if let Some(Percentiles { p50, p95, p99, max }) = row.max_metres {
            let [p50, p95, p99, max] = [p50, p95, p99, max].map(|metres| 1e3 * metres);
            text += &format!("          largest, mm: {p50:.3} (half), {p95:.3} (95 %), {p99:.3} (99 %), {max:.3} (most)\n");
        }
        if let Some(unmet) = row.unmet {
            let Percentiles { p50, p95, p99, max } = row.element_count;
            text += &format!(
                "          elements: {p50} (half), {p95} (95 %), {p99} (99 %), {max} (most); {unmet} strands do not keep it\n"
            );
        }
        if row.coarse_strands > 0 {
            text += &format!(
                "          {} strands have an element that turns by more than a quarter turn: it moves too stiffly\n",
                row.coarse_strands
            );
        }
    }
    if !answer.skipped.is_empty() {
        text += &format!(
            "{} strands left out: strand {}, {}",
            answer.skipped.len(),
            answer.skipped[0].strand,
            answer.skipped[0].because
        );
        text += if answer.skipped.len() > 1 { ", ...\n" } else { "\n" };
    }
    text.trim_end().to_string()
}
