//! Elastic energy (Bertails et al. 2006, eq. 5c): ½ EIᵢ (κᵢ − κᵢⁿ)² per unit length.

use super::CurvatureQuadratic;
use crate::math::lane::Lane;

/// Adds the term of one curvature, with stiffness EIᵢ, natural value κᵢⁿ and value κ_t at the start of the step.
#[inline(always)]
pub fn add<T: Lane>(quadratic: &mut CurvatureQuadratic<T>, stiffness: T, natural: T, start: T) {
    quadratic.stiffness += stiffness;
    quadratic.pull += stiffness * (natural - start);
}
