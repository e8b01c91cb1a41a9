//! One element during a step as seen from a body: its points at the start and at the present iterate in the body's axes.

use nalgebra::{Matrix3, Vector3};

use crate::contact::body_at::BodyAt;
use crate::contact::contact_point::StrandCurve;
use crate::contact::shape::Separator;
use crate::math::frame::Frame;
use crate::math::functions::entire::Stumpff;
use crate::math::vector::Vec3;
use crate::rod::kinematics::{ElementState, off_chord};
use crate::rod::segment;

/// An element's helix in the body's axes.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Helix {
    kappa: Vec3<f64>,
    kappa_squared: f64,
    length: f64,
    end: Vector3<f64>,
    origin: Vector3<f64>,
    axes: Matrix3<f64>,
}

impl Helix {
    fn new(curve: &StrandCurve, element: &ElementState<f64>, frame: &Frame, axes: &Matrix3<f64>) -> Self {
        // Differences first: a scene far from the world's origin keeps its digits.
        let origin = axes.tr_mul(&((curve.origin - frame.origin) + Vector3::from(element.origin_left)));
        let axes = axes.tr_mul(&Matrix3::from(element.frame_left));
        Self {
            kappa: element.kappa,
            kappa_squared: element.kappa_squared,
            length: element.length,
            end: origin + axes * Vector3::from(element.end),
            origin,
            axes,
        }
    }

    /// Its left end.
    #[inline]
    pub fn left(&self) -> Vector3<f64> {
        self.origin
    }

    /// Its right end.
    #[inline]
    pub fn right(&self) -> Vector3<f64> {
        self.end
    }

    /// Curvature across the tangent, 1/m.
    pub fn bend(&self) -> f64 {
        (self.kappa_squared - self.kappa.0[0] * self.kappa.0[0]).max(0.0).sqrt()
    }

    /// How far its points are off its chord at most, m, each from the point of the chord at the same fraction.
    fn off_chord(&self) -> f64 {
        off_chord(self.kappa_squared, self.length)
    }

    /// Position and unit tangent at an arclength.
    #[inline]
    pub fn at(&self, s: f64) -> (Vector3<f64>, Vector3<f64>) {
        let theta = self.kappa.scale(s);
        let z = self.kappa_squared * (s * s);
        let c = Stumpff::at(z);
        let local = Vector3::from(segment::chord(theta, z, &c).scale(s));
        // The first column of `segment::frame`.
        let [x, y, w] = theta.0;
        let tangent = Vector3::new(1.0 - c.c2 * (z - x * x), c.c2 * x * y + c.c1 * w, c.c2 * x * w - c.c1 * y);
        let position = if s == self.length { self.end } else { self.origin + self.axes * local };
        (position, self.axes * tangent)
    }
}

/// An element's helix at the step's start and at the present iterate, each in the body's axes at that time.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct ElementPath {
    pub start: Helix,
    pub now: Helix,
}

impl ElementPath {
    pub fn new(start: &StrandCurve, now: &StrandCurve, element: usize, body: &BodyAt) -> Self {
        Self {
            start: Helix::new(start, &start.elements[element], &body.start, &body.axes_start),
            now: Helix::new(now, &now.elements[element], &body.end, &body.axes_end),
        }
    }

    /// A ball around all straight paths of the element's points from start to now: an arc lies within half its length of the
    /// middle of its ends.
    pub fn ball(&self) -> (Vector3<f64>, f64) {
        let (before, after) = (0.5 * (self.start.left() + self.start.right()), 0.5 * (self.now.left() + self.now.right()));
        (0.5 * (before + after), 0.5 * (self.now.length + (after - before).norm()))
    }

    /// No point on these paths is nearer to the shape than this, m: by the plane between the shape and the chord in the middle of its motion,
    /// and by how far arcs are off their chords.
    pub fn least_distance(&self, separator: &Separator) -> f64 {
        let paths = [[self.start.left(), self.now.left()], [self.start.right(), self.now.right()]];
        let plane = separator.of_segment(paths.map(|[before, after]| 0.5 * (before + after)));
        plane.distance_of(paths.into_iter().flatten()) - self.start.off_chord().max(self.now.off_chord())
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;
    use crate::contact::shape::Shape;
    use crate::math::random::signed_numbers;
    use crate::rod::kinematics::element_states;
    use crate::step::state::rotation_matrix;

    /// No point of an element comes nearer to a shape than the plane between them says, and where they are far apart that is not much less.
    #[test]
    fn an_element_stays_as_far_from_a_shape_as_its_chord_says() {
        let mut number = signed_numbers(5);
        let mut told = 0;
        for _ in 0..400 {
            let mut point = |size: f64| size * Vector3::new(number(), number(), number());
            let shapes = [
                Shape::new_sphere(0.02).unwrap(),
                Shape::new_capsule(point(0.03), point(0.03), 0.004).unwrap(),
                Shape::new_half_space(point(1.0)).unwrap(),
            ];
            let mut turn = || UnitQuaternion::from_scaled_axis(point(2.0));
            let (roots, poses) = ([turn(), turn()], [turn(), turn()]);
            let origins = [point(0.05), point(0.05)];
            let frame = |rotation, origin| Frame { origin, rotation };
            let mut elements = [Vec::new(), Vec::new()];
            for end in 0..2 {
                let curvature: [f64; 3] = point(60.0).into();
                element_states(rotation_matrix(&frame(roots[end], origins[end])), [0.03], &[curvature], &mut elements[end]);
            }
            let curve = |end: usize| StrandCurve { origin: origins[end], elements: &elements[end] };
            for shape in &shapes {
                let bodies = [0, 1].map(|end| frame(poses[end], Vector3::new(0.01, 0.0, 0.02 * end as f64)));
                let body = BodyAt::new(0, shape, bodies[0], bodies[1], 0.0);
                let path = ElementPath::new(&curve(0), &curve(1), 0, &body);
                let bound = path.least_distance(&shape.separator().unwrap());
                for along in 0..=20 {
                    let s = 0.03 * f64::from(along) / 20.0;
                    let (before, now) = (path.start.at(s).0, path.now.at(s).0);
                    for time in 0..=10 {
                        let at = before.lerp(&now, f64::from(time) / 10.0);
                        let distance = shape.closest(at, f64::INFINITY).unwrap().distance;
                        assert!(distance >= bound - 1e-12, "{distance} {bound} {shape:?}");
                    }
                }
                told += usize::from(bound > 0.01);
            }
        }
        assert!(told > 100, "{told}");
    }
}
