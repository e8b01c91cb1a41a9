//! The three places in the caller's memory that samples go to.

use nalgebra::Vector3;

use super::buffers::{FRAME_FORMATS, POINT_FORMATS, VECTOR_FORMATS, Writer, each};
use super::types::shx_output;
use crate::error::{Error, Result};
use crate::rod::uniform_points::{Lanes, Real};
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
        for (lane, strand) in tile.strands.iter().enumerate() {
            let strand = *strand as usize;
            let (first, count) = (strand * self.per_strand + tile.first, tile.count);
            if let Some(points) = &self.outputs.points {
                let radius = self.radii.get(strand).copied().unwrap_or_default();
                let at = |k: usize| column(&tile.positions[k], lane);
                match (points.is_single(), points.width()) {
                    (true, 3) => points.singles(first, count, |k| singles(at(k))),
                    (true, _) => points.singles(first, count, |k| {
                        let [x, y, z] = singles(at(k));
                        [x, y, z, radius as f32]
                    }),
                    (false, 3) => points.doubles(first, count, |k| doubles(at(k))),
                    (false, _) => points.doubles(first, count, |k| {
                        let [x, y, z] = doubles(at(k));
                        [x, y, z, radius]
                    }),
                }
            }
            if let Some(frames) = &self.outputs.frames {
                let at = |k: usize| {
                    let [x, y, z, w] = &tile.rotations[k];
                    [x[lane], y[lane], z[lane], w[lane]]
                };
                match (frames.is_single(), frames.width()) {
                    (true, _) => frames.singles(first, count, |k| {
                        let [x, y, z, w] = at(k);
                        [x.into() as f32, y.into() as f32, z.into() as f32, w.into() as f32]
                    }),
                    (false, 4) => frames.doubles(first, count, |k| {
                        let [x, y, z, w] = at(k);
                        [x.into(), y.into(), z.into(), w.into()]
                    }),
                    (false, _) => frames.doubles(first, count, |k| {
                        let [x, y, z] = doubles(column(&tile.positions[k], lane));
                        let [i, j, k, w] = at(k);
                        [x, y, z, i.into(), j.into(), k.into(), w.into()]
                    }),
                }
            }
            if let Some(velocities) = &self.outputs.velocities {
                let at = |k: usize| column(&tile.velocities[k], lane);
                if velocities.is_single() {
                    velocities.singles(first, count, |k| singles(at(k)));
                } else {
                    velocities.doubles(first, count, |k| doubles(at(k)));
                }
            }
        }
    }
}

#[inline(always)]
fn column<T: Real>(vector: &[Lanes<T>; 3], lane: usize) -> [T; 3] {
    [vector[0][lane], vector[1][lane], vector[2][lane]]
}

#[inline(always)]
fn singles<T: Real>([x, y, z]: [T; 3]) -> [f32; 3] {
    [x.into() as f32, y.into() as f32, z.into() as f32]
}

#[inline(always)]
fn doubles<T: Real>([x, y, z]: [T; 3]) -> [f64; 3] {
    [x.into(), y.into(), z.into()]
}
