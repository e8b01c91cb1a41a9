//! `superhelix run`: a scene file in, a result file out.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use superhelix::math::frame::Frame;
use superhelix::solver::Solver;
use superhelix::solver::definition::StrandDef;
use superhelix::solver::id::{BodyId, ConstraintId, StrandId};

use crate::atomic_file::AtomicFile;
use crate::failure::Failure;
use crate::progress;
use crate::report::Report;
use crate::resolution;
use crate::rest_arguments::RestArguments;
use crate::result::RunResult;
use crate::run_files::RunFiles;
use crate::scene::pose::Moves;
use crate::scene::{self, Scene};
use crate::settled;
use crate::timeline;

/// Runs a scene file (docs/scene_format.md) and writes what happened, and the render hair that the scene asks for.
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

    let things = Things::make(&scene, &mut solver, ids).map_err(complain)?;

    let mut out = AtomicFile::create(&arguments.out)?;
    let mut files = RunFiles::create(arguments.cache.as_deref(), &mut scene, path, &solver, &things.strands)?;
    let result = simulate(&scene, &mut solver, &things, &mut files, arguments.quiet)?;
    let unwritable = |error: &dyn std::fmt::Display| Failure::file(&arguments.out, format!("cannot be written: {error}"));
    serde_json::to_writer(&mut out, &result).map_err(|error| unwritable(&error))?;
    out.write_all(b"\n").map_err(|error| unwritable(&error))?;
    files.finish()?;
    out.commit()
}

/// What is in the solver, in the scene's order.
#[derive(Debug)]
pub struct Things {
    /// The strands.
    pub strands: Vec<StrandId>,
    /// The colliders.
    pub bodies: Vec<BodyId>,
    /// The attachments.
    pub constraints: Vec<ConstraintId>,
}

impl Things {
    /// Adds a scene's colliders and attachments to a solver that has its strands.
    fn make(scene: &Scene, solver: &mut Solver, strands: Vec<StrandId>) -> superhelix::error::Result<Self> {
        let bodies = solver.add_bodies(scene.colliders.iter().map(|collider| collider.definition.clone()).collect())?;
        for (strand, id) in scene.strands.iter().zip(&strands) {
            if let Some(contact) = &strand.contact {
                solver.set_contact(&[*id], Some(contact))?;
            }
        }
        let constraints = scene.attachments.iter().map(|attachment| attachment.constraint(solver, &strands));
        let constraints = constraints.collect::<superhelix::error::Result<Vec<_>>>()?;
        let constraints = solver.add_constraints(&constraints)?;
        if scene.allow_overlaps {
            solver.allow_overlaps(&strands)?;
        }
        Ok(Self { strands, bodies, constraints })
    }
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
    solver: &mut Solver,
    things: &Things,
    files: &mut RunFiles,
    quiet: bool,
) -> Result<RunResult, Failure> {
    let times = timeline::output_times(scene.duration, scene.output_interval);
    let bar = progress::bar(times.len() as u64 - 1, "states", quiet);
    let mut roots = Moving::of(&things.strands, scene.strands.iter().map(|strand| strand.motion.as_ref()));
    let mut bodies = Moving::of(&things.bodies, scene.colliders.iter().map(|collider| collider.motion.as_ref()));
    let mut targets = Moving::of(&things.constraints, scene.attachments.iter().map(|attachment| attachment.motion.as_ref()));
    let deforming: Vec<_> =
        things.bodies.iter().zip(&scene.colliders).filter_map(|(id, body)| Some((*id, body.deformation.as_ref()?))).collect();

    let mut result = RunResult::new(things, &scene.outputs);
    let mut report = Report::default();
    let mut record = |time: f64, solver: &Solver| -> Result<(), Failure> {
        files.write(time, solver, &things.strands)?;
        Ok(result.record(time, solver)?)
    };
    record(times[0], solver)?;
    for pair in times.windows(2) {
        for (end, length) in timeline::steps_between(pair[0], pair[1], scene.time_step) {
            if let Some((ids, frames)) = roots.at(end) {
                solver.set_root_frames(ids, frames, length)?;
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
    result.set_report(report);
    Ok(result)
}
