//! What `superhelix run` writes of a scene's strands beside its result: their cache, and render hair.

use std::path::Path;

use superhelix::{Solver, StrandId};

use crate::run::cache::RunCache;
use crate::run::render::RunRender;
use crate::scene::Scene;
use crate::shell::failure::Failure;
use crate::stepping::sampled_frame::SampledFrame;

/// The files being written, as far as they are asked for.
pub struct RunFiles {
    frame: SampledFrame,
    cache: Option<RunCache>,
    render: Option<RunRender>,
}

impl RunFiles {
    /// Begins them with the solver as it is at the start. What the scene (at `path`) says of render hair is taken out of it.
    pub fn create(
        cache: Option<&Path>,
        scene: &mut Scene,
        path: &Path,
        solver: &Solver,
        ids: &[StrandId],
    ) -> Result<Self, Failure> {
        let mut frame = SampledFrame::new(scene.samples, 1.0);
        let cache = cache.map(|path| RunCache::create(path, scene)).transpose()?;
        let render = match scene.render_hair.take() {
            Some(wanted) => {
                frame.take(solver, ids)?;
                Some(RunRender::create(wanted, scene, path, &frame)?)
            }
            None => None,
        };
        Ok(Self { frame, cache, render })
    }

    /// Writes the solver's present state as that of `time`.
    pub fn write(&mut self, time: f64, solver: &Solver, ids: &[StrandId]) -> Result<(), Failure> {
        if self.cache.is_some() || self.render.is_some() {
            self.frame.take(solver, ids)?;
        }
        if let Some(cache) = &mut self.cache {
            cache.write(time, &self.frame)?;
        }
        if let Some(render) = &mut self.render {
            render.write(time, &self.frame, solver)?;
        }
        Ok(())
    }

    /// Ends the files and puts them in their places.
    pub fn finish(self) -> Result<(), Failure> {
        if let Some(render) = self.render {
            render.finish()?;
        }
        self.cache.map_or(Ok(()), RunCache::finish)
    }
}
