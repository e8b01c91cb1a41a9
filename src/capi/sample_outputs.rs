//! The three places in the caller's memory that samples go to.

use nalgebra::Vector3;

use super::buffers::{FRAME_FORMATS, POINT_FORMATS, VECTOR_FORMATS, Writer, each};
use super::types::shx_output;
use crate::error::{Error, Result};
use crate::rod::uniform_points::Real;
use crate::solver::id::StrandId;
use crate::solver::{Sample, SampleSink, Solver, Tile, Wanted};

/// Checked outputs of points, frames and velocities.
pub(crate) struct Outputs {
    points: Option<Writer>,
    frames: Option<Writer>,
    velocities: Option<Writer>,
    origin: Vector3<f64>,
}

impl Outputs {
    /// # Safety
    /// Each output is null or a shx_output whose memory is there, and the caller's alone, while this lives.
    pub(crate) unsafe fn new(
        points: *const shx_output,
        frames: *const shx_output,
        velocities: *const shx_output,
        needed: usize,
        origin: Vector3<f64>,
    ) -> Result<Self> {
        if points.is_null() && frames.is_null() && velocities.is_null() {
            return Err(Error::NullArgument { argument: "points (and frames, and velocities)".into() });
        }
        // SAFETY: the same.
        unsafe {
            Ok(Self {
                points: Writer::optional("points", points, POINT_FORMATS, needed)?,
                frames: Writer::optional("frames", frames, FRAME_FORMATS, needed)?,
                velocities: Writer::optional("velocities", velocities, VECTOR_FORMATS, needed)?,
                origin,
            })
        }
    }

    /// Writes one sample.
    pub(crate) fn write(&self, index: usize, sample: &Sample, radius: f64) {
        if let Some(points) = &self.points {
            points.point(index, (sample.position - self.origin).into(), radius);
        }
        if let Some(frames) = &self.frames {
            frames.sample_frame(index, sample, self.origin);
        }
        if let Some(velocities) = &self.velocities {
            velocities.vector(index, sample.velocity.into());
        }
    }

    /// Samples strands uniformly; item i * `per_strand` + j is point j of strand i. All ids are looked up before anything is written.
    pub(crate) fn bulk(&self, core: &Solver, ids: &[StrandId], per_strand: usize) -> Result<()> {
        let whole_frames = self.frames.as_ref().is_some_and(|frames| frames.width() == 7);
        let wanted = Wanted {
            points_per_strand: per_strand,
            origin: self.origin,
            positions: self.points.is_some() || whole_frames,
            rotations: self.frames.is_some(),
            velocities: self.velocities.is_some(),
        };
        let with_radius = self.points.as_ref().is_some_and(|points| points.width() == 4);
        let radii = if with_radius { each(ids, |id| core.radius(id))? } else { Vec::new() };
        let sink = BulkSink { outputs: self, per_strand, radii };
        let outputs = [&self.points, &self.frames, &self.velocities];
        if outputs.into_iter().flatten().all(Writer::is_single) {
            core.sample_tiles::<f32>(ids, &wanted, &sink)
        } else {
            core.sample_tiles::<f64>(ids, &wanted, &sink)
        }
    }
}

struct BulkSink<'a> {
    outputs: &'a Outputs,
    per_strand: usize,
    /// A strand's radius, where the points' format has a place for it.
    radii: Vec<f64>,
}

// SAFETY: the writers point into memory that is the caller's alone during the call, and every item is written by one tile only.
unsafe impl Sync for BulkSink<'_> {}

impl<T: Real> SampleSink<T> for BulkSink<'_> {
    fn take(&self, tile: &Tile<T>) {
        let single = |number: T| number.into() as f32;
        let double = |number: T| number.into();
        for (lane, strand) in tile.strands.iter().enumerate() {
            let strand = *strand as usize;
            let (first, count) = (strand * self.per_strand + tile.first, tile.count);
            let position = |point: usize, axis: usize| tile.positions[point][axis][lane];
            let rotation = |point: usize, number: usize| tile.rotations[point][number][lane];
            let velocity = |point: usize, axis: usize| tile.velocities[point][axis][lane];
            if let Some(points) = &self.outputs.points {
                let radius = self.radii.get(strand).copied().unwrap_or_default();
                match (points.is_single(), points.width()) {
                    (true, 3) => points.singles(first, count, |k| [0, 1, 2].map(|axis| single(position(k, axis)))),
                    (true, _) => points.singles(first, count, |k| {
                        let [x, y, z] = [0, 1, 2].map(|axis| single(position(k, axis)));
                        [x, y, z, radius as f32]
                    }),
                    (false, 3) => points.doubles(first, count, |k| [0, 1, 2].map(|axis| double(position(k, axis)))),
                    (false, _) => points.doubles(first, count, |k| {
                        let [x, y, z] = [0, 1, 2].map(|axis| double(position(k, axis)));
                        [x, y, z, radius]
                    }),
                }
            }
            if let Some(frames) = &self.outputs.frames {
                match (frames.is_single(), frames.width()) {
                    (true, _) => frames.singles(first, count, |k| [0, 1, 2, 3].map(|number| single(rotation(k, number)))),
                    (false, 4) => frames.doubles(first, count, |k| [0, 1, 2, 3].map(|number| double(rotation(k, number)))),
                    (false, _) => frames.doubles(first, count, |k| {
                        let [x, y, z] = [0, 1, 2].map(|axis| double(position(k, axis)));
                        let [i, j, k, w] = [0, 1, 2, 3].map(|number| double(rotation(k, number)));
                        [x, y, z, i, j, k, w]
                    }),
                }
            }
            if let Some(velocities) = &self.outputs.velocities {
                if velocities.is_single() {
                    velocities.singles(first, count, |k| [0, 1, 2].map(|axis| single(velocity(k, axis))));
                } else {
                    velocities.doubles(first, count, |k| [0, 1, 2].map(|axis| double(velocity(k, axis))));
                }
            }
        }
    }
}
