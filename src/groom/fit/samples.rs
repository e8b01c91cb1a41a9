//! Samples of a curve to fit, relative to its length.

use crate::math::vector::Vec3;

/// One sample of the curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    /// Arclength, 0 to 1.
    pub arclength: f64,
    /// Position from the root.
    pub target: Vec3<f64>,
    /// Its fraction of the length.
    pub weight: f64,
    /// The direction for n1, if the curve has frames.
    pub normal: Option<Vec3<f64>>,
}
