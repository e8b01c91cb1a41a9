//! A body during a substep: where it is at its start and end, and what is asked of it there.

use nalgebra::{Matrix3, Vector3};

use super::shape::{Bounds, Mesh, Shape, Surface};
use crate::math::frame::Frame;
use crate::math::rotation::rotation_vector;

/// A body during a substep.
#[derive(Debug, Clone, Copy)]
pub struct BodyAt<'a> {
    /// Its index in the solver.
    pub index: u32,
    /// Its shape; a deforming mesh with its vertices at the substep's start and end.
    pub shape: &'a Shape,
    /// Pose at the substep's start.
    pub start: Frame,
    /// Pose at its end.
    pub end: Frame,
    /// How far outside its shape the surface lies, m.
    pub thickness: f64,
    /// Multiplies the strands' Coulomb friction.
    pub friction: f64,
    /// Multiplies the strands' viscous friction.
    pub viscous_friction: f64,
    /// Groups that it is in.
    pub group: u32,
    /// Groups with which it collides.
    pub mask: u32,
    /// A box around the shape (without its thickness) during the substep, world.
    pub bounds: Bounds,
    /// The angle by which it turns, rad.
    pub turn: f64,
    /// The largest distance of its shape from its pose's origin, m; 0 for an infinite shape.
    pub radius: f64,
    pub(super) axes_start: Matrix3<f64>,
    pub(super) axes_end: Matrix3<f64>,
}

impl<'a> BodyAt<'a> {
    /// A body that moves from pose to pose.
    pub fn new(index: u32, shape: &'a Shape, start: Frame, end: Frame, thickness: f64) -> Self {
        let (axes_start, axes_end) = (*start.rotation.to_rotation_matrix().matrix(), *end.rotation.to_rotation_matrix().matrix());
        let turn = rotation_vector(&(start.rotation.inverse() * end.rotation)).norm();
        let local = shape.bounds();
        let (bounds, radius) = if local.low.x.is_finite() {
            let corners = local.corners();
            let radius = corners.iter().map(|corner| corner.norm_squared()).fold(0.0, f64::max).sqrt();
            let place =
                |frame: &Frame, axes: &Matrix3<f64>| Bounds::of_points(corners.map(|corner| frame.origin + axes * corner));
            // A point that turns by an angle φ about the pose's origin leaves its chord by at most r (1 − cos φ/2) ≤ r φ²/8.
            let bounds = place(&start, &axes_start).union(&place(&end, &axes_end));
            (bounds.grown(radius * (0.125 * turn * turn).min(1.0)), radius)
        } else {
            (local, 0.0)
        };
        let (friction, viscous_friction, group, mask) = (1.0, 1.0, 1, u32::MAX);
        Self {
            index,
            shape,
            start,
            end,
            thickness,
            friction,
            viscous_friction,
            group,
            mask,
            bounds,
            turn,
            radius,
            axes_start,
            axes_end,
        }
    }

    /// The same with another motion.
    pub fn with_motion(&self, [start, end]: [Frame; 2]) -> Self {
        let Self { friction, viscous_friction, group, mask, .. } = *self;
        Self { friction, viscous_friction, group, mask, ..Self::new(self.index, self.shape, start, end, self.thickness) }
    }

    /// Half of the shape's least extent, m: a strand passed at once by more shows no trace of it.
    pub fn half_extent(&self) -> f64 {
        let bounds = self.shape.bounds();
        0.5 * (bounds.high - bounds.low).min() + self.thickness
    }

    /// Its surface nearest to a point of the world at the substep's end, see [`Shape::closest`].
    pub fn closest_at_end(&self, at: Vector3<f64>, within: f64) -> Option<Surface> {
        self.shape.closest(self.axes_end.tr_mul(&(at - self.end.origin)), within)
    }

    /// The same, or else a distance (m) that the surface surely has from the point.
    #[inline]
    pub(super) fn closest_or_least_at_end(&self, at: Vector3<f64>, within: f64) -> std::result::Result<Surface, f64> {
        self.shape.closest_or_least(self.axes_end.tr_mul(&(at - self.end.origin)), within)
    }

    /// Its surface nearest to a point of the world when the substep began, see [`Shape::closest`]; a mesh that deforms is taken as it is at
    /// the end.
    pub(super) fn closest_at_start(&self, at: Vector3<f64>, within: f64) -> Option<Surface> {
        self.shape.closest(self.axes_start.tr_mul(&(at - self.start.origin)), within)
    }

    /// Where a point of the world begins and ends in the body's axes, m.
    pub(super) fn way(&self, start: Vector3<f64>, now: Vector3<f64>) -> [Vector3<f64>; 2] {
        [self.axes_start.tr_mul(&(start - self.start.origin)), self.axes_end.tr_mul(&(now - self.end.origin))]
    }

    /// The depth of a point of the world in the body when the substep began, m, if it is no more than `within`; a mesh that
    /// deforms is taken as it is at the end.
    pub fn depth_at_start(&self, at: Vector3<f64>, within: f64) -> f64 {
        self.closest_at_start(at, within).map_or(0.0, |surface| self.thickness - surface.distance)
    }

    /// Whether it is a mesh whose vertices move in the substep.
    pub fn deforms(&self) -> bool {
        self.shape.mesh().is_some_and(Mesh::is_moving)
    }

    /// A direction of the body's own axes at the substep's end, world.
    pub fn to_world(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        self.axes_end * direction
    }

    /// The position of a point of its surface at the substep's end, world.
    pub fn surface_at_end(&self, surface: &Surface) -> Vector3<f64> {
        self.end.origin + self.axes_end * surface.point
    }

    /// Whether its surface may be in a box of the world in the substep.
    pub fn is_near(&self, around: &Bounds) -> bool {
        self.bounds.grown(self.thickness).meets(around)
    }

    /// Whether it collides with something of these groups and this mask.
    pub fn meets(&self, group: u32, mask: u32) -> bool {
        self.group & mask != 0 && group & self.mask != 0
    }

    /// Whether all that moves straight (in the body's axes) within a box of the world stays further than `margin` (m) from the
    /// shape. False where that is not plain at once. `slack` (m): how far such paths may leave the box.
    pub(super) fn is_clear_of(&self, region: &Bounds, margin: f64, slack: f64) -> bool {
        match self.shape.plane() {
            Some(normal) => {
                let (middle, half) = (0.5 * (region.low + region.high), 0.5 * (region.high - region.low));
                [(&self.start, &self.axes_start), (&self.end, &self.axes_end)].into_iter().all(|(frame, axes)| {
                    let normal = axes * normal;
                    normal.dot(&(middle - frame.origin)) - normal.abs().dot(&half) > margin
                })
            }
            None => !region.meets(&self.bounds.grown(margin + slack)),
        }
    }

    /// Displacement of the body's material point at a point of its surface during the substep, world, m.
    pub fn carried(&self, surface: &Surface) -> Vector3<f64> {
        let mut before = surface.point;
        if let Some(mesh) = self.shape.mesh()
            && mesh.is_moving()
        {
            let (start, end) = (mesh.corners_before(surface.feature), mesh.corners(surface.feature));
            for corner in 0..3 {
                before += (start[corner] - end[corner]) * surface.weights[corner];
            }
        }
        (self.end.origin - self.start.origin) + self.axes_end * surface.point - self.axes_start * before
    }
}
