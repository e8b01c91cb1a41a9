//! Sample outputs in the caller's memory: points, frames, velocities.

use nalgebra::Vector3;

use super::output_transform::OutputTransform;
use crate::capi::base::buffers::{POINT_FORMATS, SAMPLED_FRAME_FORMATS, VECTOR_FORMATS, Writer, each, tangent};
use crate::capi::base::types::shx_output;
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::rod::uniform_points::{Lanes, Real};
use crate::solver::id::StrandId;
use crate::solver::{Sample, SampleSink, Solver, Tile, Wanted};

/// Checked outputs of points, frames and velocities.
pub(crate) struct Outputs {
    points: Option<Writer>,
    frames: Option<Writer>,
    velocities: Option<Writer>,
    place: OutputPlace,
}

/// The origin and axes of outputs.
pub(crate) struct OutputPlace {
    pub origin: Vector3<f64>,
    /// `None` for the world's.
    pub transform: Option<OutputTransform>,
}

impl Outputs {
    /// # Safety
    /// Each output is null or a shx_output whose memory is there, and the caller's alone, while this lives.
    pub(crate) unsafe fn new(
        points: *const shx_output,
        frames: *const shx_output,
        velocities: *const shx_output,
        needed: usize,
        place: OutputPlace,
    ) -> Result<Self> {
        if points.is_null() && frames.is_null() && velocities.is_null() {
            return Err(Error::NullArgument { argument: "points (and frames, and velocities)".into() });
        }
        // SAFETY: the same.
        unsafe {
            Ok(Self {
                points: Writer::optional("points", points, POINT_FORMATS, needed)?,
                frames: Writer::optional("frames", frames, SAMPLED_FRAME_FORMATS, needed)?,
                velocities: Writer::optional("velocities", velocities, VECTOR_FORMATS, needed)?,
                place,
            })
        }
    }

    /// Writes one sample.
    pub(crate) fn write(&self, index: usize, sample: &Sample, radius: f64) {
        let OutputPlace { origin, transform } = &self.place;
        let frame = Frame { origin: sample.position - origin, rotation: sample.rotation };
        let (position, velocity) = (frame.origin.into(), sample.velocity.into());
        let Some(transform) = transform else { return self.put(index, position, radius, frame.rotation_xyzw(), velocity) };
        let rotation = transform.quaternion(frame.rotation_xyzw());
        self.put(index, transform.point(position), transform.scale() * radius, rotation, transform.vector(velocity));
    }

    fn put(&self, index: usize, position: [f64; 3], radius: f64, rotation: [f64; 4], velocity: [f64; 3]) {
        if let Some(points) = &self.points {
            points.point(index, position, radius);
        }
        if let Some(frames) = &self.frames {
            frames.pose(index, position, rotation);
        }
        if let Some(velocities) = &self.velocities {
            velocities.vector(index, velocity);
        }
    }

    /// Samples strands uniformly; item i * `per_strand` + j is point j of strand i. All ids are looked up before
    /// anything is written.
    pub(crate) fn bulk(&self, core: &Solver, ids: &[StrandId], per_strand: usize) -> Result<()> {
        let whole_frames = self.frames.as_ref().is_some_and(|frames| frames.width() == 7);
        let wanted = Wanted {
            points_per_strand: per_strand,
            origin: self.place.origin,
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
        if let Some(transform) = &self.outputs.place.transform {
            return self.take_transformed(tile, transform);
        }
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
                let along = |k: usize| tangent(at(k).map(|x| x.into()));
                match (frames.is_single(), frames.width()) {
                    (true, 3) => frames.singles(first, count, |k| along(k).map(|x| x as f32)),
                    (false, 3) => frames.doubles(first, count, along),
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

impl BulkSink<'_> {
    /// The same in the host's space.
    fn take_transformed<T: Real>(&self, tile: &Tile<T>, transform: &OutputTransform) {
        for (lane, strand) in tile.strands.iter().enumerate() {
            let strand = *strand as usize;
            let (first, count) = (strand * self.per_strand + tile.first, tile.count);
            let position = |k: usize| transform.point(doubles(column(&tile.positions[k], lane)));
            let rotation = |k: usize| {
                let [x, y, z, w] = &tile.rotations[k];
                transform.quaternion([x[lane].into(), y[lane].into(), z[lane].into(), w[lane].into()])
            };
            if let Some(points) = &self.outputs.points {
                let radius = transform.scale() * self.radii.get(strand).copied().unwrap_or_default();
                let with_radius = |k: usize| {
                    let [x, y, z] = position(k);
                    [x, y, z, radius]
                };
                match (points.is_single(), points.width()) {
                    (true, 3) => points.singles(first, count, |k| position(k).map(|x| x as f32)),
                    (true, _) => points.singles(first, count, |k| with_radius(k).map(|x| x as f32)),
                    (false, 3) => points.doubles(first, count, position),
                    (false, _) => points.doubles(first, count, with_radius),
                }
            }
            if let Some(frames) = &self.outputs.frames {
                match (frames.is_single(), frames.width()) {
                    (true, 3) => frames.singles(first, count, |k| tangent(rotation(k)).map(|x| x as f32)),
                    (false, 3) => frames.doubles(first, count, |k| tangent(rotation(k))),
                    (true, _) => frames.singles(first, count, |k| rotation(k).map(|x| x as f32)),
                    (false, 4) => frames.doubles(first, count, rotation),
                    (false, _) => frames.doubles(first, count, |k| {
                        let ([x, y, z], [i, j, k, w]) = (position(k), rotation(k));
                        [x, y, z, i, j, k, w]
                    }),
                }
            }
            if let Some(velocities) = &self.outputs.velocities {
                let velocity = |k: usize| transform.vector(doubles(column(&tile.velocities[k], lane)));
                if velocities.is_single() {
                    velocities.singles(first, count, |k| velocity(k).map(|x| x as f32));
                } else {
                    velocities.doubles(first, count, velocity);
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
