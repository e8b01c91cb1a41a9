//! `superhelix run`: a scene file in, a result file out.

use std::fs;
use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use superhelix::math::pose_spline::PoseSpline;
use superhelix::solver::Solver;
use superhelix::solver::definition::StrandDef;
use superhelix::solver::id::StrandId;

use crate::atomic_file::AtomicFile;
use crate::failure::Failure;
use crate::progress;
use crate::resolution;
use crate::result::{Report, RunResult};
use crate::scene::{self, Scene};
use crate::settled;
use crate::timeline;

/// Runs a scene file (docs/scene_format.md) and writes what happened.
///
/// Exit status: 0 when the run ended, 2 for a bad scene (nothing is written), 1 for anything else.
#[derive(Debug, Args)]
pub struct RunArguments {
    /// The scene: JSON; // and /* */ comments are allowed.
    #[arg(value_name = "SCENE.json")]
    scene: PathBuf,
    /// Where the result goes: JSON. Written whole or not at all.
    #[arg(long, value_name = "RESULT.json")]
    out: PathBuf,
    /// Start the strands at rest in their static equilibrium under the scene's gravity, searched for from their initial shapes.
    #[arg(long)]
    settle: bool,
    /// Neither progress bar nor warnings.
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command.
pub fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let path = &arguments.scene;
    let bytes = fs::read(path).map_err(|error| Failure::file(path, format!("cannot be read: {error}")))?;
    let text =
        String::from_utf8(bytes).map_err(|error| Failure::BadScene(format!("{}: is not UTF-8: {error}", path.display())))?;
    let scene = scene::parse(&text).map_err(|complaint| Failure::scene(path, &complaint))?;

    // The solver has the last word on what it can do: its complaints about the scene are the scene's.
    let complain = |error: superhelix::error::Error| match error {
        superhelix::error::Error::InvalidArgument { .. } | superhelix::error::Error::Unsupported { .. } => {
            Failure::scene(path, &scene::in_words_of_the_scene(error))
        }
        other => Failure::from(other),
    };
    let mut solver = Solver::new(scene.options.clone()).map_err(complain)?;
    let mut definitions: Vec<StrandDef> = scene.strands.iter().map(|strand| strand.definition.clone()).collect();
    if arguments.settle {
        let settled = settled::settle(&mut definitions, &scene.options).map_err(complain)?;
        if !arguments.quiet {
            settled.warn(&path.display().to_string(), definitions.len());
        }
    }
    let ids = solver.add_strands(&definitions).map_err(complain)?;
    if !arguments.quiet {
        resolution::warn(definitions.iter(), resolution::Shapes::All, |index| format!("{}: strands[{index}]", path.display()));
    }

    let mut out = AtomicFile::create(&arguments.out)?;
    let result = simulate(&scene, &mut solver, &ids, arguments.quiet)?;
    let unwritable = |error: &dyn std::fmt::Display| Failure::file(&arguments.out, format!("cannot be written: {error}"));
    serde_json::to_writer(&mut out, &result).map_err(|error| unwritable(&error))?;
    out.write_all(b"\n").map_err(|error| unwritable(&error))?;
    out.commit()
}

fn simulate(scene: &Scene, solver: &mut Solver, ids: &[StrandId], quiet: bool) -> Result<RunResult, Failure> {
    let times = timeline::output_times(scene.duration, scene.output_interval);
    let bar = progress::bar(times.len() as u64 - 1, "states", quiet);
    let motions: Vec<(StrandId, &PoseSpline)> =
        ids.iter().zip(&scene.strands).filter_map(|(id, strand)| Some((*id, strand.motion.as_ref()?))).collect();
    let moving: Vec<StrandId> = motions.iter().map(|(id, _)| *id).collect();
    let mut frames = Vec::with_capacity(moving.len());

    let mut result = RunResult::new(ids.len(), &scene.outputs);
    let mut report = Report::default();
    result.record(times[0], solver, ids)?;
    for pair in times.windows(2) {
        for (end, length) in timeline::steps_between(pair[0], pair[1], scene.time_step) {
            if !moving.is_empty() {
                frames.clear();
                frames.extend(motions.iter().map(|(_, motion)| motion.at(end)));
                solver.set_root_frames(&moving, &frames, length)?;
            }
            report.add(&solver.step(length, 1)?);
        }
        result.record(pair[1], solver, ids)?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    result.set_report(report);
    Ok(result)
}
