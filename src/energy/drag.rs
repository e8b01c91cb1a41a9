//! Viscous drag of the air (Bertails et al. 2006, eq. 5a) against wind: the force −ν (v − wind) per unit length.
//!
//! Implicit: the potential ν/(2h) |r − r_t − h·wind|²; where a field gives each point a wind of its own, the points' pulls get ν·wind one by one.
//! Explicit, in the papers' step, and continuous, in the reference's equations of motion: the force itself.

use super::PointQuadratic;
use crate::math::lane::Lane;
use crate::math::vector::Vec3;

/// Adds the implicit term for drag ν and step h, as a quadratic of displacements.
#[inline(always)]
pub fn add<T: Lane>(quadratic: &mut PointQuadratic<T>, air_drag: T, step: T, wind: Vec3<T>) {
    quadratic.stiffness += air_drag / step;
    quadratic.pull += of_wind(wind, air_drag);
}

/// What wind at a point adds to the implicit term's pull.
#[inline(always)]
pub fn of_wind<T: Lane>(wind: Vec3<T>, air_drag: T) -> Vec3<T> {
    wind.scale(air_drag)
}

/// What the implicit term pulls less where displacements are counted from where the point's velocity at the start leads.
#[inline(always)]
pub fn of_start<T: Lane>(velocity: Vec3<T>, air_drag: T) -> Vec3<T> {
    velocity.scale(air_drag)
}

/// The force against a point's motion, N/m: ν (v − wind).
#[inline(always)]
pub fn resistance<T: Lane>(velocity: Vec3<T>, wind: Vec3<T>, air_drag: T) -> Vec3<T> {
    (velocity - wind).scale(air_drag)
}
