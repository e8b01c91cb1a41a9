//! Planes that separate convex shapes from straight segments, for the shapes that know them in closed form.

use nalgebra::Vector3;

use super::{Kind, Shape};
use crate::contact::narrow_phase::segment_distance::closest_of_segments;

/// A plane between a shape and a segment, across the shortest distance from one to the other.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Separation {
    /// Unit normal, from the shape to the segment.
    normal: Vector3<f64>,
    /// No point of the shape is further along the normal than this, m.
    offset: f64,
    /// The distance of shape and segment, m; below zero where they overlap.
    pub distance: f64,
}

impl Separation {
    /// A lower bound on the distance from the shape of everything between these points, m.
    pub fn distance_of(&self, points: impl IntoIterator<Item = Vector3<f64>>) -> f64 {
        points.into_iter().map(|point| self.normal.dot(&point)).fold(f64::INFINITY, f64::min) - self.offset
    }
}

/// A shape that knows the planes between itself and segments in closed form.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) enum Separator {
    /// All points within a radius of a segment, which may be a point: spheres and capsules.
    Round { axis: [Vector3<f64>; 2], radius: f64 },
    /// Everything behind the plane through the origin with this unit normal.
    Plane { normal: Vector3<f64> },
}

impl Separator {
    /// The plane between the shape and a straight segment.
    pub fn of_segment(&self, segment: [Vector3<f64>; 2]) -> Separation {
        match self {
            Self::Plane { normal } => {
                let distance = normal.dot(&segment[0]).min(normal.dot(&segment[1]));
                Separation { normal: *normal, offset: 0.0, distance }
            }
            Self::Round { axis, radius } => {
                let nearest = closest_of_segments([&axis[0], &axis[1]], [&segment[0], &segment[1]]);
                let apart = segment[0].lerp(&segment[1], nearest.u) - axis[0].lerp(&axis[1], nearest.t);
                // (If a segment meets the axis, any plane is valid: the segment is inside.)
                let normal = apart.try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vector3::x);
                let offset = normal.dot(&axis[0]).max(normal.dot(&axis[1])) + radius;
                Separation { normal, offset, distance: nearest.distance - radius }
            }
        }
    }
}

impl Shape {
    /// What separates the shape from segments; `None` for shapes without a closed form.
    pub(in crate::contact) fn separator(&self) -> Option<Separator> {
        match &self.0 {
            Kind::Sphere { radius } => Some(Separator::Round { axis: [Vector3::zeros(); 2], radius: *radius }),
            Kind::Capsule { a, b, radius } => Some(Separator::Round { axis: [*a, *b], radius: *radius }),
            Kind::HalfSpace { normal } => Some(Separator::Plane { normal: *normal }),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::signed_numbers;

    /// No point of the shape is beyond the plane, none of the segment before it, and the distance is that of the shape's nearest point.
    #[test]
    fn a_plane_separates() {
        let mut number = signed_numbers(3);
        let mut point = || Vector3::new(number(), number(), number());
        for _ in 0..300 {
            let capsule = Shape::new_capsule(0.5 * point(), 0.5 * point(), 0.1).unwrap();
            let shapes = [Shape::new_sphere(0.4).unwrap(), capsule, Shape::new_half_space(point()).unwrap()];
            let segment = [point(), point()];
            for shape in shapes {
                let plane = shape.separator().unwrap().of_segment(segment);
                let places = (0..=400).map(|k| segment[0].lerp(&segment[1], f64::from(k) / 400.0));
                let nearest =
                    places.map(|place| shape.closest(place, f64::INFINITY).unwrap().distance).fold(f64::INFINITY, f64::min);
                assert!((nearest - plane.distance).abs() < 1e-2 && nearest > plane.distance - 1e-12, "{shape:?} {segment:?}");
                let bound = plane.distance_of(segment);
                assert!(plane.distance < 0.0 || (bound - plane.distance).abs() < 1e-9, "{bound} {plane:?}");
                // Points anywhere are no nearer than the plane says.
                let others = [point(), point()];
                let least = others
                    .map(|place| shape.closest(place, f64::INFINITY).unwrap().distance)
                    .into_iter()
                    .fold(f64::INFINITY, f64::min);
                assert!(plane.distance_of(others) <= least + 1e-12);
            }
        }
    }
}
