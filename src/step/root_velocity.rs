//! The root's mean velocity over a step.

use nalgebra::Vector3;

use crate::math::frame::Frame;
use crate::math::rotation::rotation_vector;

/// Mean velocity, m/s, and mean angular velocity, rad/s, world axes, from one pose to another in `h` seconds.
pub fn root_velocity(from: &Frame, to: &Frame, h: f64) -> (Vector3<f64>, Vector3<f64>) {
    let velocity = (to.origin - from.origin) / h;
    if from.rotation == to.rotation {
        return (velocity, Vector3::zeros());
    }
    let angular = from.rotation * (rotation_vector(&(from.rotation.inverse() * to.rotation)) / h);
    (velocity, angular)
}
