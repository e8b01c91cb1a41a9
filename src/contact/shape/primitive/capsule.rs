//! Capsule: all points within a radius of a segment.

use nalgebra::Vector3;

use crate::contact::shape::Surface;

/// Nearest point of the capsule of radius `radius` about the segment from `a` to `b`. From its axis the way out is across the axis.
pub(in crate::contact::shape) fn closest(a: Vector3<f64>, b: Vector3<f64>, radius: f64, point: Vector3<f64>) -> Surface {
    let axis = b - a;
    let place = ((point - a).dot(&axis) / axis.norm_squared()).clamp(0.0, 1.0);
    let centre = a + axis * place;
    let out = point - centre;
    let distance = out.norm();
    let normal = if distance > 0.0 { out / distance } else { across(&axis) };
    Surface::smooth(centre + normal * radius, normal, distance - radius)
}

/// A unit vector across another.
pub(in crate::contact::shape) fn across(axis: &Vector3<f64>) -> Vector3<f64> {
    axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize()
}
