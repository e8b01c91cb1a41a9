//! A rigid pose: the position and orientation of a strand's root or of one of its cross-sections.
//!
//! Files:
//!
//! - `pose_motion.rs`: The motion of a pose that a host sends from frame to frame: bodies and the targets of constraints.

pub mod pose_motion;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::error::{Error, Result, check_finite};

/// How far a quaternion's length may be from 1 to count as a unit quaternion. Wide enough for one that was stored as f32.
pub const UNIT_QUATERNION_TOLERANCE: f64 = 1e-5;

/// A right-handed pose in the world. `rotation` takes the axes to (n0, n1, n2): n0 the tangent, n1 and n2 the section's axes.
///
/// ```
/// use superhelix::Frame;
/// use superhelix::nalgebra::{UnitQuaternion, Vector3};
///
/// let head = Frame {
///     origin: Vector3::new(0.0, 0.0, 1.7),
///     rotation: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2),
/// };
/// // A root 9 cm in front of the head's centre.
/// let root = head.compose(&Frame { origin: Vector3::new(0.09, 0.0, 0.0), ..Frame::default() });
/// assert!((root.origin - Vector3::new(0.0, 0.09, 1.7)).norm() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Position, m.
    pub origin: Vector3<f64>,
    /// Orientation: maps local to world.
    pub rotation: UnitQuaternion<f64>,
}

impl Default for Frame {
    fn default() -> Self {
        Self { origin: Vector3::zeros(), rotation: UnitQuaternion::identity() }
    }
}

impl Frame {
    /// A frame from plain numbers: position (m) and quaternion (x, y, z, w).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when a number is not finite or the quaternion's length is not 1 within
    /// [`UNIT_QUATERNION_TOLERANCE`] (it is then normalised to rounding).
    pub fn from_arrays(argument: impl std::fmt::Display, origin: [f64; 3], rotation: [f64; 4]) -> Result<Self> {
        for (axis, value) in origin.iter().enumerate() {
            check_finite(|| format!("{argument}.origin[{axis}]"), *value)?;
        }
        for (axis, value) in rotation.iter().enumerate() {
            check_finite(|| format!("{argument}.rotation[{axis}]"), *value)?;
        }
        let quaternion = Quaternion::new(rotation[3], rotation[0], rotation[1], rotation[2]);
        let norm = quaternion.norm();
        if (norm - 1.0).abs() > UNIT_QUATERNION_TOLERANCE {
            return Err(Error::invalid(
                format!("{argument}.rotation"),
                format!("{rotation:?} of length {norm}"),
                "a unit quaternion x, y, z, w",
            ));
        }
        Ok(Self { origin: Vector3::from(origin), rotation: UnitQuaternion::new_normalize(quaternion) })
    }

    /// The quaternion's numbers in the order x, y, z, w.
    pub fn rotation_xyzw(&self) -> [f64; 4] {
        let q = self.rotation.quaternion();
        [q.i, q.j, q.k, q.w]
    }

    /// The inverse: the world as this frame sees it.
    pub fn inverse(&self) -> Frame {
        let rotation = self.rotation.inverse();
        Frame { origin: -(rotation * self.origin), rotation }
    }

    /// The pose of something at this pose after the rigid body that carries it moves from `from` to `to`.
    pub fn carried(&self, from: &Frame, to: &Frame) -> Frame {
        let turn = to.rotation * from.rotation.inverse();
        Frame { origin: to.origin + turn * (self.origin - from.origin), rotation: turn * self.rotation }
    }

    /// The pose of a child whose pose in this frame is `local`.
    pub fn compose(&self, local: &Frame) -> Frame {
        Frame { origin: self.origin + self.rotation * local.origin, rotation: self.rotation * local.rotation }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rotation::{from_rotation_vector, rotation_vector};

    #[test]
    fn a_frame_and_its_inverse_are_the_identity() {
        let frame = Frame { origin: Vector3::new(1.0, -2.0, 3.0), rotation: from_rotation_vector(Vector3::new(0.3, 0.7, -0.2)) };
        let both = frame.inverse().compose(&frame);
        assert!(both.origin.norm() < 1e-14 && rotation_vector(&both.rotation).norm() < 1e-14);
    }
}
