//! Contact points: a material point of a strand, a strand's curve at one time, and a contact point between a strand and its
//! partner.

use nalgebra::Vector3;

use super::permitted_overlap::PermittedOverlap;
use crate::math::vector::Vec3;
use crate::rod::kinematics::ElementState;

/// A material point of a strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrandPoint {
    /// Index of the strand in the solver.
    pub strand: u32,
    /// Index of the element.
    pub element: u32,
    /// Arclength from the element's left end, m; 0 to its length.
    pub s: f64,
}

/// A strand's curve at one time.
#[derive(Debug, Clone, Copy)]
pub struct StrandCurve<'a> {
    /// The root's origin, world, m; the elements are relative to it.
    pub origin: Vector3<f64>,
    /// Elements from root to tip.
    pub elements: &'a [ElementState<f64>],
}

impl StrandCurve<'_> {
    /// Arclength from the root of the material point at arclength `s` of an element, m.
    pub fn along(&self, element: usize, s: f64) -> f64 {
        self.elements[..element].iter().map(|element| element.length).sum::<f64>() + s
    }

    /// Position of the material point at arclength `s` of an element, world, m.
    pub fn position(&self, element: usize, s: f64) -> Vector3<f64> {
        self.origin + Vector3::from(self.elements[element].point(s).position)
    }

    /// Position of the left end of an element, world, m.
    pub fn left_end(&self, element: usize) -> Vector3<f64> {
        self.origin + Vector3::from(self.elements[element].origin_left)
    }

    /// Tangent there, unit, from root to tip.
    pub fn tangent(&self, element: usize, s: f64) -> Vector3<f64> {
        let element = &self.elements[element];
        let theta = element.kappa.scale(s);
        let z = element.kappa_squared * (s * s);
        let frame = crate::rod::segment::frame(theta, z, &crate::math::functions::entire::Stumpff::at(z));
        Vector3::from(element.frame_left.apply(Vec3([frame.0[0][0], frame.0[1][0], frame.0[2][0]])))
    }
}

/// A strand at the start of a step and at the present iterate for its end.
#[derive(Debug, Clone, Copy)]
pub struct StrandPath<'a> {
    /// Its index in the solver.
    pub index: u32,
    /// At the step's start.
    pub start: StrandCurve<'a>,
    /// At the present iterate for the step's end.
    pub now: StrandCurve<'a>,
    /// The overlap with other strands that it is permitted to have, if any.
    pub permitted_overlap: Option<&'a PermittedOverlap>,
}

/// The partner of a strand in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Partner {
    /// A body and the feature of its surface.
    Body {
        /// Index of the body.
        body: u32,
        /// Triangle of a mesh; 0 for other shapes.
        feature: u32,
    },
    /// A material point of a strand.
    Strand(StrandPoint),
}

/// A contact point of a strand, or a point that may soon be in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// The strand's material point.
    pub point: StrandPoint,
    /// Its partner.
    pub partner: Partner,
    /// Unit normal at the step's end, world, from the partner to the strand.
    pub normal: Vector3<f64>,
    /// Distance of the surfaces along the normal at the present iterate, m: the distance from centreline to partner minus both
    /// thicknesses. Negative if they overlap.
    pub gap: f64,
    /// Displacement of the partner's material point during the step, world, m; zero for strands, which have their own paths.
    pub carried: Vector3<f64>,
}
