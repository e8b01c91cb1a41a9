//! Internal friction: (γ + μ EIᵢ)/(2h) (κᵢ − κ_t)² per unit length, with γ as in Bertails et al. 2006, eq. 5d, and the
//! Kelvin–Voigt time μ as in Bergbom 2007, eq. 4.28.

use super::CurvatureQuadratic;
use crate::math::lane::Lane;

/// Adds the term of one curvature for dissipation γ + μ EIᵢ and step h.
#[inline(always)]
pub fn add<T: Lane>(quadratic: &mut CurvatureQuadratic<T>, dissipation: T, step: T) {
    quadratic.stiffness += dissipation / step;
}
