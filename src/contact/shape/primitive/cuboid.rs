//! Box about the origin, along the axes.

use nalgebra::Vector3;

use crate::contact::shape::Surface;

/// Nearest point of the box of half edges `half`. From inside the way out is through the nearest face.
pub(in crate::contact::shape) fn closest(half: &Vector3<f64>, point: Vector3<f64>) -> Surface {
    let on = Vector3::from_fn(|axis, _| point[axis].clamp(-half[axis], half[axis]));
    let out = point - on;
    let distance = out.norm();
    if distance > 0.0 {
        return Surface::smooth(on, out / distance, distance);
    }
    let mut nearest = 0;
    for axis in 1..3 {
        if half[axis] - point[axis].abs() < half[nearest] - point[nearest].abs() {
            nearest = axis;
        }
    }
    let side = if point[nearest] < 0.0 { -1.0 } else { 1.0 };
    let mut on = point;
    on[nearest] = side * half[nearest];
    Surface::smooth(on, Vector3::ith(nearest, side), point[nearest].abs() - half[nearest])
}
