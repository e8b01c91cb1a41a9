//! Sphere about the origin.

use nalgebra::Vector3;

use crate::contact::shape::Surface;

/// Nearest point of a sphere of radius `radius` about the origin. From the centre the way out is along x.
pub(in crate::contact::shape) fn closest(radius: f64, point: Vector3<f64>) -> Surface {
    let distance = point.norm();
    let normal = if distance > 0.0 { point / distance } else { Vector3::x() };
    Surface::smooth(normal * radius, normal, distance - radius)
}
