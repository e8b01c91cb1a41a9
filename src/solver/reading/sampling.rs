//! Samples a strand's material points at any arclengths.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

use crate::math::quadrature::{Rule, Rules};
use crate::math::vector::Vec3;
use crate::rod::kinematics::{ElementState, PointState, element_state};
use crate::rod::segment;
use crate::solver::strands::strand::Strand;
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

/// Samples along a strand; ascending arclengths cost one pass. Computes only what is requested.
pub(super) struct Sampler<'a> {
    strand: &'a Strand,
    rules: &'a Rules,
    index: usize,
    start: f64,
    element: ElementState<f64>,
}

/// A place of a strand at which the sampler is.
pub(super) struct SampledPoint<'a> {
    strand: &'a Strand,
    rule: &'a Rule,
    index: usize,
    element: &'a ElementState<f64>,
    point: PointState<f64>,
}

impl<'a> Sampler<'a> {
    pub fn new(strand: &'a Strand, rules: &'a Rules) -> Self {
        let element = Self::first(strand);
        Self { strand, rules, index: 0, start: 0.0, element }
    }

    fn first(strand: &Strand) -> ElementState<f64> {
        element_state(
            Vec3(strand.state.curvatures[0]),
            strand.model.lengths[0],
            rotation_matrix(&strand.state.root),
            Vec3::zero(),
        )
    }

    /// The point at `arclength`, which must be in [0, L].
    pub fn at(&mut self, arclength: f64) -> Sample {
        let place = self.go(arclength);
        Sample { arclength, position: place.position(), rotation: place.rotation(), velocity: place.velocity() }
    }

    /// Moves to `arclength`, which must be in [0, L].
    pub fn go(&mut self, arclength: f64) -> SampledPoint<'_> {
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
        let point = self.element.point((arclength - self.start).min(self.element.length));
        let rule = self.rules.rule(state.rule);
        SampledPoint { strand: self.strand, rule, index: self.index, element: &self.element, point }
    }
}

/// The material frame at a point of an element, world axes.
pub(in crate::solver) fn material_rotation(element: &ElementState<f64>, point: &PointState<f64>) -> UnitQuaternion<f64> {
    let frame = segment::frame(element.kappa.scale(point.s), element.kappa_squared * point.s * point.s, &point.c);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(element.frame_left.mul(&frame).into()))
}

impl SampledPoint<'_> {
    /// In the world, m.
    pub fn position(&self) -> Vector3<f64> {
        self.strand.state.root.origin + Vector3::from(self.point.position)
    }

    /// The material frame.
    pub fn rotation(&self) -> UnitQuaternion<f64> {
        material_rotation(self.element, &self.point)
    }

    /// The material point's velocity, m/s: a polynomial on each element through the values at its nodes.
    pub fn velocity(&self) -> Vector3<f64> {
        let first = self.index * self.rule.len();
        let mut sum = Vec3::<f64>::zero();
        self.rule.for_each_coefficient(self.point.s / self.element.length, |k, coefficient| {
            sum += self.strand.state.velocities[first + k].scale(coefficient);
        });
        sum.into()
    }
}
