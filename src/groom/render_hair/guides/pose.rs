//! The guides of render hair at one moment.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};

use super::guide_samples::GuideSamples;
use super::shape::{Shape, closest_turn};
use crate::error::{Error, Result};
use crate::groom::render_hair::RenderHair;
use crate::math::frame::Frame;
use crate::math::rotation::from_rotation_vector;

/// The time over which the strands' velocities are taken, s: the guides are moved back by their velocities for as long.
pub const VELOCITY_STEP: f64 = 1e-3;

/// The guides of a [`RenderHair`] at one moment. Set it each frame; then any threads may evaluate it at the same time.
#[derive(Debug, Clone)]
pub struct RenderPose {
    hair: Arc<RenderHair>,
    pub(in crate::groom::render_hair) now: Shape,
    /// [`VELOCITY_STEP`] earlier, if velocities were given.
    pub(in crate::groom::render_hair) before: Option<Shape>,
}

impl RenderPose {
    /// A pose of a map. It must be set before it is evaluated.
    pub fn new(hair: Arc<RenderHair>) -> Self {
        Self { hair, now: Shape::default(), before: None }
    }

    /// The map.
    pub fn hair(&self) -> &Arc<RenderHair> {
        &self.hair
    }

    /// Whether it has been set.
    pub(in crate::groom::render_hair) fn is_set(&self) -> bool {
        !self.now.origins.is_empty()
    }

    /// Sets the guides' points, in the order of binding.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for mismatched counts, numbers that are not finite, or root rotations where there were none at
    /// binding. Nothing has then changed.
    pub fn set(&mut self, guides: &GuideSamples) -> Result<()> {
        let reference = &self.hair.reference;
        guides.check(reference.points, Some(reference.guides))?;
        if guides.roots.is_some() && !reference.rotations_given {
            let expected = "none, as at binding: how the follicles are turned there is not known";
            return Err(Error::invalid("guides.roots", "there", expected));
        }
        let roots = |points: &[Vector3<f64>]| points.iter().step_by(reference.points).copied().collect::<Vec<_>>();
        let origins = roots(guides.points);
        let rotations = match guides.roots {
            Some(rotations) => rotations.to_vec(),
            None => turned(&reference.origins, &origins, &reference.rotations),
        };
        self.now.update(reference, guides.points, &rotations);
        let Some(velocities) = guides.velocities else {
            self.before = None;
            return Ok(());
        };
        let points: Vec<_> = guides.points.iter().zip(velocities).map(|(p, v)| p - v * VELOCITY_STEP).collect();
        let earlier = match guides.root_angular_velocities {
            Some(list) => {
                rotations.iter().zip(list).map(|(rotation, w)| from_rotation_vector(w * -VELOCITY_STEP) * rotation).collect()
            }
            None => turned(&origins, &roots(&points), &rotations),
        };
        self.before.get_or_insert_default().update(reference, &points, &earlier);
        Ok(())
    }

    /// The common motion of the guides' roots since binding: the rigid motion that best maps their old positions to the new ones
    /// (Kabsch), as a displacement of the origin and a rotation. A head moves like this. The identity if the pose was never set.
    pub fn head(&self) -> Frame {
        let from = &self.hair.reference.origins;
        if !self.is_set() {
            return Frame::default();
        }
        let middle = |list: &[Vector3<f64>]| list.iter().sum::<Vector3<f64>>() / list.len() as f64;
        let rotation = closest_turn(from, &self.now.origins).unwrap_or_default();
        Frame { origin: middle(&self.now.origins) - rotation * middle(from), rotation }
    }

    /// Memory of the pose without the map, bytes.
    pub fn memory_usage(&self) -> u64 {
        let of = |shape: &Shape| {
            4 * shape.rows.capacity() + 16 * shape.starts.capacity() + 24 * shape.origins.capacity() + 36 * shape.turns.capacity()
        };
        (size_of::<Self>() + of(&self.now) + self.before.as_ref().map_or(0, of)) as u64
    }
}

/// Rotations of roots that moved from one set of positions to another: all turned like the positions, or unchanged where that is
/// undetermined.
fn turned(from: &[Vector3<f64>], to: &[Vector3<f64>], rotations: &[UnitQuaternion<f64>]) -> Vec<UnitQuaternion<f64>> {
    let turn = closest_turn(from, to).unwrap_or_default();
    rotations.iter().map(|rotation| turn * rotation).collect()
}
