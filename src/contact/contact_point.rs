//! The words of contact: a material point of a strand, a strand's curve at one time, and a touch, which is where something meets it.

use nalgebra::Vector3;

use crate::math::vector::Vec3;
use crate::rod::kinematics::ElementState;

/// A material point of a strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrandPoint {
    /// Which strand (its index in the solver).
    pub strand: u32,
    /// Which element of it.
    pub element: u32,
    /// Arclength from the element's left end, m; 0 to its length.
    pub s: f64,
}

/// A strand's curve at one time.
#[derive(Debug, Clone, Copy)]
pub struct StrandCurve<'a> {
    /// The root's origin, world, m; the elements are told from there.
    pub origin: Vector3<f64>,
    /// Elements from root to tip.
    pub elements: &'a [ElementState<f64>],
}

impl StrandCurve<'_> {
    /// Arclength from the root of the material point at arclength `s` of an element, m.
    pub fn along(&self, element: usize, s: f64) -> f64 {
        self.elements[..element].iter().map(|element| element.length).sum::<f64>() + s
    }

    /// Where the material point at arclength `s` of an element is, world, m.
    pub fn position(&self, element: usize, s: f64) -> Vector3<f64> {
        self.origin + Vector3::from(self.elements[element].point(s).position)
    }

    /// The tangent there (unit, from root to tip).
    pub fn tangent(&self, element: usize, s: f64) -> Vector3<f64> {
        let element = &self.elements[element];
        let theta = element.kappa.scale(s);
        let z = element.kappa_squared * (s * s);
        let frame = crate::rod::segment::frame(theta, z, &crate::math::entire::Stumpff::at(z));
        Vector3::from(element.frame_left.apply(Vec3([frame.0[0][0], frame.0[1][0], frame.0[2][0]])))
    }
}

/// A strand during a step: where it was, and where it would be at the step's end.
#[derive(Debug, Clone, Copy)]
pub struct StrandPath<'a> {
    /// Its index in the solver.
    pub index: u32,
    /// At the step's start.
    pub start: StrandCurve<'a>,
    /// At the present iterate for the step's end.
    pub now: StrandCurve<'a>,
}

/// What a strand meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Partner {
    /// A body, by its index in the solver, and which feature of its surface (a triangle of a mesh; 0 else).
    Body {
        /// Index of the body.
        body: u32,
        /// Triangle, or 0.
        feature: u32,
    },
    /// A material point of a strand.
    Strand(StrandPoint),
}

/// A place where something meets a strand, or soon may.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// The strand's material point.
    pub point: StrandPoint,
    /// What it meets.
    pub partner: Partner,
    /// Unit normal at the step's end, world, from the partner to the strand.
    pub normal: Vector3<f64>,
    /// Distance of the surfaces at the present iterate along the normal: that of centreline and partner less both thicknesses, m.
    /// Negative where they overlap.
    pub gap: f64,
    /// How far the partner's material point goes during the step, world, m; for strands zero (they tell it themselves).
    pub carried: Vector3<f64>,
}
