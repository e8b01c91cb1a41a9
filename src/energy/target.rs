//! A target: per unit length ½ ρS ω² |r − r*|² draws a point to its place r*, and ρS ω |ṙ − ṙ*|² damps it critically relative to
//! that place. ω is the inverse of the time constant.
//!
//! Mass cancels from the motion: strands of any thickness come to their targets alike.

use super::PointQuadratic;
use crate::math::lane::Lane;
use crate::math::vector::Vec3;

/// Adds the implicit term for linear density ρS and step h. Displacements are counted from where the velocity at the start
/// leads: `offset` is the way from there to r*, `velocity` that of r* relative to the point.
#[inline(always)]
pub fn add<T: Lane>(quadratic: &mut PointQuadratic<T>, linear_density: T, step: T, rate: T, offset: Vec3<T>, velocity: Vec3<T>) {
    let (spring, damping) = (spring(linear_density, rate), damping(linear_density, rate));
    quadratic.stiffness += spring + damping / step;
    quadratic.pull += offset.scale(spring) + velocity.scale(damping);
}

/// ρS ω², N/m per m.
#[inline(always)]
pub fn spring<T: Lane>(linear_density: T, rate: T) -> T {
    linear_density * rate * rate
}

/// 2 ρS ω, N·s/m per m.
#[inline(always)]
pub fn damping<T: Lane>(linear_density: T, rate: T) -> T {
    T::splat(2.0) * linear_density * rate
}
