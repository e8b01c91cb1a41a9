//! Elastic energy (Bertails et al. 2006, eq. 5c): ½ EIᵢ (κᵢ − κᵢⁿ)² per unit length.

use super::CurvatureQuadratic;
use crate::math::lane::Lane;

/// Adds the term of one curvature: stiffness EIᵢ, natural value κᵢⁿ, and value κ_t at the step's start.
#[inline(always)]
pub fn add<T: Lane>(quadratic: &mut CurvatureQuadratic<T>, stiffness: T, natural: T, start: T) {
    quadratic.stiffness += stiffness;
    quadratic.pull += stiffness * (natural - start);
}
