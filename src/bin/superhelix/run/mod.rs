//! `superhelix run`: a scene file in, a result file out.
//!
//! Files:
//!
//! - `cache.rs`: The strands of `superhelix run` over time in one `.usda` file, with velocities: to be drawn, or as guides for `superhelix interpolate`.
//! - `files.rs`: What `superhelix run` writes of a scene's strands beside its result: their cache, and render hair.
//! - `render.rs`: The render hair of `superhelix run`: what `superhelix interpolate` would make of the run's cache, to the bit, without the cache.
//! - `result.rs`: What a run of a scene gives: the document of docs/reference/scene_format.md, section "Result".
//! - `snapshot.rs`: Where a run of a scene was left, so that another can go on from there.
//! - `things.rs`: What of a scene is in the solver.

mod cache;
mod files;
mod render;
mod result;
mod snapshot;
mod things;

use std::io::Write;
use std::ops::RangeInclusive;
use std::path::PathBuf;

use clap::Args;
use superhelix::internals::contact::options::MAX_CHOSEN_ITERATIONS;
use superhelix::{Frame, Solver, StrandDef};

use crate::run::files::RunFiles;
use crate::run::result::RunResult;
use crate::run::snapshot::{RunSnapshot, SnapshotFile};
use crate::run::things::Things;
use crate::scene;
use crate::scene::Scene;
use crate::scene::outputs::timeline;
use crate::scene::pose::Moves;
use crate::scene::posing::rest_arguments::RestArguments;
use crate::scene::targets::DrawnStrands;
use crate::shell::atomic_file::AtomicFile;
use crate::shell::failure::Failure;
use crate::shell::progress;
use crate::stepping::report::Report;
use crate::stepping::{resolution, settled};

/// Runs a scene file (docs/reference/scene_format.md) and writes what happened, and the render hair that the scene asks for.
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
    /// The strands at the same times, with velocities, for pictures and as guides of `superhelix interpolate`: the scene's `samples` a strand.
    #[arg(long, value_name = "CACHE.usda")]
    cache: Option<PathBuf>,
    /// End with this written state, counted from 0, instead of the scene's last.
    #[arg(long, value_name = "STATE")]
    until: Option<usize>,
    /// Where the run can be gone on from: what the last written state leaves for the next.
    #[arg(long, value_name = "FILE")]
    snapshot: Option<PathBuf>,
    /// Go on from a `--snapshot` of the same scene: the first written state is the one after it. The states are those of a whole run, to the bit.
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
    #[command(flatten)]
    rest: RestArguments,
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
    let mut scene = scene::load(path)?;
    arguments.rest.apply(&mut scene, path)?;
    let text = scene::read_text(path)?;
    let resumed = arguments.resume.as_deref().map(|from| RunSnapshot::read(from, &text)).transpose()?;
    let states = states_to_write(&scene, arguments.until, resumed.as_ref().map(|snapshot| snapshot.state))?;
    if scene.render_hair.is_some() && (resumed.is_some() || arguments.until.is_some()) {
        let advice = "the render hair of a part of a run is not written: take a --cache and `superhelix interpolate`";
        return Err(Failure::Other(advice.into()));
    }

    // The solver has the last word on what it can do: its complaints about the scene are the scene's.
    let complain = |error: superhelix::Error| match error {
        superhelix::Error::InvalidArgument { .. } | superhelix::Error::Unsupported { .. } => {
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

    let mut things = Things::make(&scene, &mut solver, ids).map_err(complain)?;
    // (What goes on from a snapshot has begun already.)
    if !arguments.quiet && resumed.is_none() {
        things.warn_of_overlaps(&scene, path, &mut solver)?;
    }

    let mut out = AtomicFile::create(&arguments.out)?;
    let snapshot = arguments.snapshot.as_deref().map(|path| Ok::<_, Failure>((path, SnapshotFile::create(path)?))).transpose()?;
    let mut files = RunFiles::create(arguments.cache.as_deref(), &mut scene, path, &solver, &things.strands)?;
    let drawn = scene.targets.iter().map(|target| DrawnStrands::new(target, &scene.strands, &things.strands, &solver));
    let drawn = drawn.collect::<superhelix::Result<Vec<_>>>().map_err(complain)?;
    if let Some(resumed) = &resumed {
        resumed.restore(&mut solver)?;
        things = Things::of(&solver);
    }
    let result = simulate(&scene, &drawn, &mut solver, &things, &mut files, states.clone(), arguments.quiet)?;
    // (Few iterations are a choice of cost.)
    let few = scene.options.step.max_iterations.min(scene.options.contact.max_iterations) <= MAX_CHOSEN_ITERATIONS;
    if !arguments.quiet && !few {
        result.report.warn(&path.display().to_string(), things.strands.len());
    }
    let unwritable = |error: &dyn std::fmt::Display| Failure::file(&arguments.out, format!("cannot be written: {error}"));
    serde_json::to_writer(&mut out, &result).map_err(|error| unwritable(&error))?;
    out.write_all(b"\n").map_err(|error| unwritable(&error))?;
    files.finish()?;
    if let Some((path, file)) = snapshot {
        file.finish(path, &text, *states.end(), &solver)?;
    }
    out.commit()
}

/// The written states of this run, of those of the whole scene. The one that it goes on from is not written again.
fn states_to_write(scene: &Scene, until: Option<usize>, resumed: Option<usize>) -> Result<RangeInclusive<usize>, Failure> {
    let last = timeline::output_times(scene.duration, scene.output_interval).len() - 1;
    let until = until.unwrap_or(last);
    let first = resumed.map_or(0, |state| state + 1);
    if until > last {
        return Err(Failure::Other(format!("--until is {until}: the scene's states are 0 to {last}")));
    }
    if first > until {
        return Err(Failure::Other(format!("--resume is of state {}, and the run is to end with state {until}", first - 1)));
    }
    Ok(first..=until)
}

/// Those of some things that move, with their motions.
struct Moving<'a, Id, Motion> {
    ids: Vec<Id>,
    motions: Vec<&'a Motion>,
    frames: Vec<Frame>,
}

impl<'a, Id: Copy, Motion: Moves> Moving<'a, Id, Motion> {
    fn of(ids: &[Id], motions: impl Iterator<Item = Option<&'a Motion>>) -> Self {
        let (ids, motions): (Vec<Id>, Vec<&Motion>) =
            ids.iter().zip(motions).filter_map(|(id, motion)| Some((*id, motion?))).unzip();
        Self { frames: Vec::with_capacity(ids.len()), ids, motions }
    }

    /// Where they are at a time; none where nothing moves.
    fn at(&mut self, time: f64) -> Option<(&[Id], &[Frame])> {
        self.frames.clear();
        self.frames.extend(self.motions.iter().map(|motion| motion.at(time)));
        (!self.ids.is_empty()).then_some((&self.ids, &self.frames))
    }
}

fn simulate(
    scene: &Scene,
    drawn: &[DrawnStrands],
    solver: &mut Solver,
    things: &Things,
    files: &mut RunFiles,
    states: RangeInclusive<usize>,
    quiet: bool,
) -> Result<RunResult, Failure> {
    let times = timeline::output_times(scene.duration, scene.output_interval);
    let begin = states.start().saturating_sub(1);
    let times = &times[begin..=*states.end()];
    let bar = progress::bar(times.len() as u64 - 1, "states", quiet);
    let mut roots = Moving::of(&things.strands, scene.strands.iter().map(|strand| strand.motion.as_ref()));
    let mut bodies = Moving::of(&things.bodies, scene.colliders.iter().map(|collider| collider.motion.as_ref()));
    let mut targets = Moving::of(&things.constraints, scene.attachments.iter().map(|attachment| attachment.motion.as_ref()));
    let deforming: Vec<_> =
        things.bodies.iter().zip(&scene.colliders).filter_map(|(id, body)| Some((*id, body.deformation.as_ref()?))).collect();

    let mut result = RunResult::new(things, scene);
    let mut report = Report::default();
    let mut record = |time: f64, solver: &Solver| -> Result<(), Failure> {
        files.write(time, solver, &things.strands)?;
        Ok(result.record(time, solver)?)
    };
    if *states.start() == 0 {
        for strands in drawn {
            strands.begin(solver, &scene.strands, &things.strands)?;
        }
        record(times[0], solver)?;
    }
    for pair in times.windows(2) {
        for (end, length) in timeline::steps_between(pair[0], pair[1], scene.time_step) {
            if let Some((ids, frames)) = roots.at(end) {
                solver.set_root_frames(ids, frames, length)?;
            }
            for strands in drawn {
                strands.send(solver, &scene.strands, &things.strands, end, length)?;
            }
            if let Some((ids, frames)) = bodies.at(end) {
                solver.set_body_frames(ids, frames, length)?;
            }
            if let Some((ids, frames)) = targets.at(end) {
                solver.set_constraint_targets(ids, frames, length)?;
            }
            for (id, deformation) in &deforming {
                solver.set_body_vertices(*id, &deformation.at(end), length)?;
            }
            report.add(&solver.step(length, 1)?);
        }
        record(pair[1], solver)?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    let contact = !(scene.colliders.is_empty() && scene.attachments.is_empty()) || scene.options.contact.hair;
    report.contact = report.contact.filter(|_| contact);
    result.end(report, solver);
    Ok(result)
}
