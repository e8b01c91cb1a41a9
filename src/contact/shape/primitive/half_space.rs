//! Half of space, bounded by a plane through the origin.

use nalgebra::Vector3;

use crate::contact::shape::Surface;

/// Nearest point of the plane across `normal`, which points out of the half that is filled.
pub(in crate::contact::shape) fn closest(normal: &Vector3<f64>, point: Vector3<f64>) -> Surface {
    let distance = normal.dot(&point);
    Surface::smooth(point - normal * distance, *normal, distance)
}
