//! One element during a step as seen from a body: its points at the start and at the present iterate in the body's axes.

use nalgebra::{Matrix3, Vector3};

use super::body::BodyAt;
use super::contact_point::StrandCurve;
use crate::math::entire::Stumpff;
use crate::math::frame::Frame;
use crate::math::vector::Vec3;
use crate::rod::kinematics::ElementState;
use crate::rod::segment;

/// An element's helix in the body's axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Helix {
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
pub(super) struct ElementPath {
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
}
