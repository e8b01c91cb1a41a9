//! Reading a strand's material points at any arclength.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

use super::strand::Strand;
use crate::math::quadrature::Rules;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::{ElementState, element_state};
use crate::rod::segment;
use crate::step::state::rotation_matrix;

/// One sampled material point of a strand, in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Arclength from the root, m.
    pub arclength: f64,
    /// Position r, m.
    pub position: Vector3<f64>,
    /// Material frame (n0, n1, n2).
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of the material point, m/s.
    pub velocity: Vector3<f64>,
}

/// Walks along a strand; asking for ascending arclengths costs one pass.
pub(super) struct Sampler<'a> {
    strand: &'a Strand,
    rules: &'a Rules,
    index: usize,
    start: f64,
    element: ElementState<f64>,
    coefficients: Vec<f64>,
}

impl<'a> Sampler<'a> {
    pub fn new(strand: &'a Strand, rules: &'a Rules) -> Self {
        let element = Self::first(strand);
        Self { strand, rules, index: 0, start: 0.0, element, coefficients: Vec::new() }
    }

    fn first(strand: &Strand) -> ElementState<f64> {
        element_state(
            Vec3(strand.state.curvatures[0]),
            strand.model.lengths[0],
            rotation_matrix(&strand.state.root),
            Vec3::zero(),
        )
    }

    /// The point at `arclength`, which lies in [0, L].
    pub fn at(&mut self, arclength: f64) -> Sample {
        if arclength < self.start {
            (self.index, self.start, self.element) = (0, 0.0, Self::first(self.strand));
        }
        let (model, state) = (&self.strand.model, &self.strand.state);
        while arclength > self.start + self.element.length && self.index + 1 < model.element_count() {
            self.start += self.element.length;
            self.index += 1;
            let (frame, origin) = (self.element.frame_right(), self.element.origin_right());
            self.element = element_state(Vec3(state.curvatures[self.index]), model.lengths[self.index], frame, origin);
        }
        let s = (arclength - self.start).min(self.element.length);
        let point = self.element.point(s);
        let theta = self.element.kappa.scale(s);
        let frame = self.element.frame_left.mul(&segment::frame(theta, self.element.kappa_squared * s * s, &point.c));
        Sample {
            arclength,
            position: state.root.origin + Vector3::from(point.position),
            rotation: quaternion(frame),
            velocity: self.velocity(s / self.element.length),
        }
    }

    /// The velocity field is a polynomial on each element through the values at its nodes.
    fn velocity(&mut self, x: f64) -> Vector3<f64> {
        let rule = self.rules.rule(self.strand.state.rule);
        rule.interpolation(x, &mut self.coefficients);
        let first = self.index * rule.len();
        let mut sum = Vec3::<f64>::zero();
        for (k, coefficient) in self.coefficients.iter().enumerate() {
            sum += self.strand.state.velocities[first + k].scale(*coefficient);
        }
        sum.into()
    }
}

fn quaternion(frame: Mat3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(frame.into()))
}
