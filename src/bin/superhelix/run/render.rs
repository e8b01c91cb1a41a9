//! The render hair of `superhelix run`: what `superhelix interpolate` would make of the run's cache, to the bit, without the cache; and kept
//! out of the scene's colliders.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use superhelix::Solver;
use superhelix::io::time_as_read;
use superhelix::render::{RenderBody, VELOCITY_STEP};

use crate::render::frames::BodyThen;
use crate::render::guide_frames::guides_of;
use crate::render::output::RenderOutput;
use crate::render::run::{BoundHair, RenderRun};
use crate::run::cache::extras_of;
use crate::scene::Scene;
use crate::scene::render_hair::SceneRenderHair;
use crate::shell::failure::Failure;
use crate::stepping::sampled_frame::SampledFrame;

/// Render hair being written, in metres.
pub struct RunRender {
    run: RenderRun,
    scene: PathBuf,
    per_second: f64,
    every: usize,
    per_strand: usize,
    bodies: bool,
}

impl RunRender {
    /// Binds the render hair of a scene to its strands as they are at the start, and begins its files.
    pub fn create(wanted: SceneRenderHair, scene: &Scene, path: &Path, start: &SampledFrame) -> Result<Self, Failure> {
        let (every, per_strand) = (wanted.every, wanted.settings.points_per_strand);
        let rest = guides_of(&start.curves()?, every, per_strand, 1.0)?;
        let complain = |error| Failure::scene(path, &wanted.keys.complaint(error));
        let places = wanted.ground.places(&rest.points, per_strand, wanted.settings.seed).map_err(complain)?;
        let bound = BoundHair::bind(&wanted.settings, places, &rest).map_err(complain)?;
        let out = RenderOutput::create(&wanted.out, wanted.kind, wanted.overwrite)?;
        let run = RenderRun::new(bound, None, 1.0, extras_of(scene), out);
        Ok(Self { run, scene: path.to_owned(), per_second: scene.outputs_per_second(), every, per_strand, bodies: wanted.bodies })
    }

    /// Takes the state of a time.
    pub fn write(&mut self, time: f64, frame: &SampledFrame, solver: &Solver) -> Result<(), Failure> {
        let guides = guides_of(&frame.curves()?, self.every, self.per_strand, 1.0)?;
        let name = format!("{}, at {time} s", self.scene.display());
        let bodies = if self.bodies { bodies_of(solver)? } else { Vec::new() };
        self.run.take(name, Some(time_as_read(time, self.per_second)), guides, bodies)
    }

    /// Ends the files.
    pub fn finish(self) -> Result<(), Failure> {
        self.run.finish().map(|_| ())
    }
}

/// A solver's bodies, kept for a moment that is drawn when the next is known.
fn bodies_of(solver: &Solver) -> Result<Vec<BodyThen>, Failure> {
    let ids = solver.body_ids();
    let shapes: Result<Vec<_>, _> = ids.iter().map(|id| solver.body(*id).map(|def| Arc::clone(&def.shape))).collect();
    let now = solver.render_bodies(VELOCITY_STEP);
    let shapes = shapes?;
    let owned = |body: &RenderBody| shapes.iter().find(|shape| std::ptr::eq(&raw const ***shape, body.shape));
    let then = now.iter().filter_map(|body| {
        let (shape, RenderBody { pose, pose_before, thickness, .. }) = (Arc::clone(owned(body)?), *body);
        Some(BodyThen { shape, pose, pose_before, thickness })
    });
    Ok(then.collect())
}
