//! Weight (Bertails et al. 2006, eq. 5a): −ρS g·r.

use super::PointQuadratic;
use crate::math::lane::Lane;
use crate::math::vector::Vec3;

/// Adds the term for linear density ρS.
#[inline(always)]
pub fn add<T: Lane>(quadratic: &mut PointQuadratic<T>, linear_density: T, gravity: Vec3<T>) {
    quadratic.pull += gravity.scale(linear_density);
}
