//! The places of a curve that a strand is fitted to, in units of its length.

use crate::math::vector::Vec3;

/// One place of the curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    /// Arclength, 0 to 1.
    pub arclength: f64,
    /// Position from the root.
    pub target: Vec3<f64>,
    /// Its share of the length.
    pub weight: f64,
    /// Where n1 should point, if the curve has frames.
    pub normal: Option<Vec3<f64>>,
}
