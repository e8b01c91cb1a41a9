//! `superhelix prepare`: strands of a reconstruction in, a scene that can be simulated out.
//!
//! Files:
//!
//! - `arguments.rs`: The flags of `superhelix prepare`.
//! - `guides.rs`: The guides of `superhelix prepare`: chosen, kept apart, fitted, and watched at rest.
//! - `head.rs`: The head and the scalp of `superhelix prepare`.
//! - `picture.rs`: The picture of `superhelix prepare`: strands as read, as prepared, and as grown from the guides.
//! - `report.rs`: What `superhelix prepare` tells.
//! - `scene.rs`: What `superhelix prepare` writes: a scene, its guides and bust, and the strands that are bound to the guides.
//! - `strands.rs`: Strands of a reconstruction made usable: what cannot be used dropped, roots on the scalp, strands out of the head.

pub mod arguments;
mod guides;
mod head;
mod picture;
mod report;
mod scene;
mod strands;

use std::collections::BTreeMap;
use std::io::Write;
use std::time::Instant;

use superhelix::Workers;
use superhelix::io::{Curves, RawStrands, UpAxis};

use self::arguments::PrepareArguments;
use self::head::Head;
use self::report::PrepareReport;
use self::scene::{Files, Motion};
use self::strands::Dropped;
use crate::groom::statistics::GroomStatistics;
use crate::groom::unit;
use crate::shell::answer::print_answer;
use crate::shell::atomic_file::AtomicFile;
use crate::shell::failure::Failure;
use crate::shell::up::Up;

/// Length of a scene without a motion, s.
const USUAL_DURATION: f64 = 2.0;

/// Runs the command.
pub fn run(arguments: &PrepareArguments) -> Result<(), Failure> {
    let begun = Instant::now();
    let said = |text: &str| {
        if !arguments.quiet {
            eprintln!("{text}");
        }
    };
    if let Some(flag) = arguments.material.reshaping() {
        return Err(Failure::Other(format!("{flag}: strands would not rest as they were reconstructed")));
    }
    let moves = arguments.head_motion.read(arguments.up)?;
    let raw = RawStrands::read(&arguments.strands, arguments.points_per_strand)?;
    check_up(arguments, &raw)?;
    let scale = scale_of(arguments, &raw)?;
    let head = Head::read(arguments, scale)?;
    let files =
        arguments.out.as_deref().filter(|_| !arguments.dry_run).map(|out| (out, Files::in_directory(out, head.body.as_ref())));
    if let Some((out, files)) = &files {
        files.begin(out, arguments.overwrite)?;
    }
    said("looking at strands ...");
    let mut prepared = strands::prepare(arguments, &raw, scale, &head)?;
    let workers = if arguments.threads == 1 { Workers::Serial } else { Workers::Pool(arguments.threads as usize) };
    let guides = guides::make(arguments, &prepared, head.body.as_ref(), &workers, said)?;
    for skipped in &guides.skipped {
        let because = skipped.because.clone();
        prepared.report.dropped.push(Dropped { strand: skipped.strand, reason: "not_fitted", because });
    }
    let (motion, left) = moves.map_or((None, USUAL_DURATION), |(motion, left)| (Some(motion), left));
    let duration = arguments.duration.unwrap_or(left);
    let moving = motion.map(|motion| {
        let roots = guides.strands.iter().map(|strand| strand.definition.root.origin);
        arguments.head_motion.head(Some(motion), roots, scale)
    });
    let motion = Motion { head: moving, duration };
    if let Some((_, files)) = &files {
        said("writing ...");
        files.write(arguments, &prepared.curves, &guides, head.body.as_ref(), &motion)?;
    }
    if let Some(path) = &arguments.picture {
        said("drawing ...");
        picture::draw(arguments, path, &raw, scale, &prepared.curves, &guides, head.body.as_ref())?;
    }
    let mut dropped_for = BTreeMap::new();
    for dropped in &prepared.report.dropped {
        *dropped_for.entry(dropped.reason).or_insert(0) += 1;
    }
    let answer = PrepareReport {
        version: 1,
        file: arguments.strands.display().to_string(),
        format: raw.format().name(),
        strands_by: raw.strands_by().name(),
        metres_per_unit: scale,
        strands_in_file: raw.strand_count(),
        points_in_file: raw.point_count(),
        dropped_for,
        strands: prepared.report,
        head: head.body.as_ref().map(|body| body.report.clone()),
        guides: guides.report,
        duration,
        files: files.map(|(_, files)| files),
        picture: arguments.picture.as_ref().map(|path| path.display().to_string()),
        seconds: begun.elapsed().as_secs_f64(),
    };
    if let Some(files) = &answer.files {
        write_report(&answer, files)?;
    }
    print_answer(arguments.json, &answer, || answer.in_words())
}

fn write_report(answer: &PrepareReport, files: &Files) -> Result<(), Failure> {
    let fail = |error: &dyn std::fmt::Display| Failure::file(&files.report, format!("cannot be written: {error}"));
    let mut file = AtomicFile::create(&files.report)?;
    serde_json::to_writer_pretty(&mut file, answer).map_err(|error| fail(&error))?;
    file.write_all(b"\n").map_err(|error| fail(&error))?;
    file.commit()
}

/// Refuses a file that says that another axis is up.
fn check_up(arguments: &PrepareArguments, raw: &RawStrands) -> Result<(), Failure> {
    match (raw.up(), arguments.up) {
        (Some(UpAxis::Y), Up::Z) => Err(Failure::file(&arguments.strands, "says that y is up: give --up y")),
        (Some(UpAxis::Z), Up::Y) => Err(Failure::file(&arguments.strands, "says that z is up: give --up z")),
        _ => Ok(()),
    }
}

/// Metres a unit of the strands: judged by those that have a length.
fn scale_of(arguments: &PrepareArguments, raw: &RawStrands) -> Result<f64, Failure> {
    let finite = |strand: &&[[f32; 3]]| strand.len() > 1 && strand.iter().flatten().all(|number| number.is_finite());
    let strands: Vec<&[[f32; 3]]> = raw.strands().filter(finite).collect();
    if strands.is_empty() {
        return Err(Failure::file(&arguments.strands, "has no strand of two points or more that are finite"));
    }
    let statistics = GroomStatistics::of(&Curves::from_strands(&strands)?);
    let stated = arguments.scale.or(raw.metres_per_unit());
    unit::plausible(&arguments.strands, &statistics, stated, arguments.scale.is_some())
}
