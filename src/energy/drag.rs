//! Viscous drag of the air (Bertails et al. 2006, eq. 5a) against wind: the force −ν (v − wind) per unit length, as the potential
//! ν/(2h) |r − r_t − h·wind|². Where a field gives each point a wind of its own, the points' pulls get ν·wind one by one.

use super::PointQuadratic;
use crate::math::lane::Lane;
use crate::math::vector::Vec3;

/// Adds the term for drag ν and step h.
#[inline(always)]
pub fn add<T: Lane>(quadratic: &mut PointQuadratic<T>, air_drag: T, step: T, wind: Vec3<T>) {
    quadratic.stiffness += air_drag / step;
    quadratic.pull += wind.scale(air_drag);
}
