//! Inertia of the centreline (Bertails et al. 2006, eq. 5b): ρS/(2h²) |r − (r_t + h v_t)|². The velocity-product terms
//! (Coriolis, centrifugal) are in r(q).

use super::PointQuadratic;
use crate::math::lane::Lane;
use crate::math::vector::Vec3;

/// Adds the term for linear density ρS, step h and the point's velocity at the start of the step.
#[inline(always)]
pub fn add<T: Lane>(quadratic: &mut PointQuadratic<T>, linear_density: T, step: T, velocity: Vec3<T>) {
    let rate = linear_density / step;
    quadratic.stiffness += rate / step;
    quadratic.pull += velocity.scale(rate);
}
