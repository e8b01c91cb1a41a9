//! The strands of `superhelix run` over time in one `.usda` file, with velocities: to be drawn, or as guides for `superhelix interpolate`.

use std::path::Path;

use superhelix::io::{CurveCacheWriter, Curves, CurvesFormat, Extras, UpAxis};

use crate::scene::Scene;
use crate::shell::failure::Failure;
use crate::stepping::sampled_frame::SampledFrame;

/// A cache being written, in metres.
#[derive(Debug)]
pub struct RunCache {
    writer: CurveCacheWriter,
}

/// Unit and axis of files that a scene's strands go to.
pub fn extras_of(scene: &Scene) -> Extras {
    let gravity = scene.options.gravity;
    let up = if gravity.y.abs() > gravity.z.abs() { UpAxis::Y } else { UpAxis::Z };
    Extras { metres_per_unit: Some(1.0), up: Some(up), ..Extras::default() }
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
        let velocities = Some(vec![[0.0; 3]; total]);
        let extras = Extras { velocities, thickness: Some(thickness.collect()), ..extras_of(scene) };
        let still = Curves::from_counts(vec![samples as u32; count], vec![[0.0; 3]; total])?.with_extras(extras)?;
        Ok(Self { writer: CurveCacheWriter::create(path, &still, scene.outputs_per_second())? })
    }

    /// Writes the state of a time.
    pub fn write(&mut self, time: f64, frame: &SampledFrame) -> Result<(), Failure> {
        Ok(self.writer.write(time, &frame.points, Some(&frame.velocities))?)
    }

    /// Puts the file in its place.
    pub fn finish(self) -> Result<(), Failure> {
        Ok(self.writer.finish()?)
    }
}
