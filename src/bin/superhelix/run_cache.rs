//! The strands of `superhelix run` over time in one `.usda` file, with velocities: to be drawn, or as guides for `superhelix interpolate`.

use std::path::Path;

use superhelix::files::curve_cache::CurveCacheWriter;
use superhelix::files::curves::{Curves, CurvesFormat, Extras, UpAxis};
use superhelix::solver::Solver;
use superhelix::solver::id::StrandId;

use crate::failure::Failure;
use crate::sampled_frame::SampledFrame;
use crate::scene::Scene;

/// A cache being written, in metres.
#[derive(Debug)]
pub struct RunCache {
    writer: CurveCacheWriter,
    frame: SampledFrame,
}

impl RunCache {
    /// Begins the cache of a scene's strands, `samples` of the scene each.
    pub fn create(path: &Path, scene: &Scene) -> Result<Self, Failure> {
        if CurvesFormat::of_name(path) != Some(CurvesFormat::Usda) {
            return Err(Failure::file(path, "is no .usda file: no other format has frames and velocities"));
        }
        let (samples, count) = (scene.samples, scene.strands.len());
        let total = samples * count;
        let thickness = scene
            .strands
            .iter()
            .flat_map(|strand| std::iter::repeat_n((2.0 * strand.definition.material.mean_radius()) as f32, samples));
        let gravity = scene.options.gravity;
        let extras = Extras {
            velocities: Some(vec![[0.0; 3]; total]),
            thickness: Some(thickness.collect()),
            metres_per_unit: Some(1.0),
            up: Some(if gravity.y.abs() > gravity.z.abs() { UpAxis::Y } else { UpAxis::Z }),
            ..Extras::default()
        };
        let still = Curves::from_counts(vec![samples as u32; count], vec![[0.0; 3]; total])?.with_extras(extras)?;
        let writer = CurveCacheWriter::create(path, &still, 1.0 / scene.output_interval)?;
        Ok(Self { writer, frame: SampledFrame::new(samples, 1.0) })
    }

    /// Writes the solver's present state as that of `time`.
    pub fn write(&mut self, time: f64, solver: &Solver, ids: &[StrandId]) -> Result<(), Failure> {
        self.frame.take(solver, ids)?;
        Ok(self.writer.write(time, &self.frame.points, Some(&self.frame.velocities))?)
    }

    /// Puts the file in its place.
    pub fn finish(self) -> Result<(), Failure> {
        Ok(self.writer.finish()?)
    }
}
