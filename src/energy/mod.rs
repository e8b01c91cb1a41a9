//! The terms of the incremental potential, one file per term.
//!
//! Per unit length, each term is a quadratic in the displacement of a material point over the step (d = r − r_t), or in the
//! change of a curvature (e = κ − κ_t): ½ stiffness·d² − pull·d. A term adds to these two numbers once per step, and their sum is
//! a spring to one target. So a term costs nothing in Newton's iterations, and an absent one costs nothing at all.
//!
//! Files:
//!
//! - `drag.rs`: Viscous drag of the air (Bertails et al. 2006, eq. 5a) against wind: the force −ν (v − wind) per unit length.
//! - `elastic.rs`: Elastic energy (Bertails et al. 2006, eq. 5c): ½ EIᵢ (κᵢ − κᵢⁿ)² per unit length.
//! - `energies.rs`: The energies of a strand: kinetic, elastic and gravitational.
//! - `friction.rs`: Internal friction: (γ + μ EIᵢ)/(2h) (κᵢ − κ_t)² per unit length, with γ as in Bertails et al. 2006, eq. 5d.
//! - `gravity.rs`: Weight (Bertails et al. 2006, eq. 5a): −ρS g·r.
//! - `inertia.rs`: Inertia of the centreline (Bertails et al. 2006, eq. 5b): ρS/(2h²) |r − (r_t + h v_t)|².
//! - `target.rs`: A target: per unit length ½ ρS ω² |r − r*|² draws a point to its place r*.

pub mod drag;
pub mod elastic;
pub mod energies;
pub mod friction;
pub mod gravity;
pub mod inertia;
pub mod target;

pub use energies::Energies;

use crate::math::lane::Lane;
use crate::math::vector::Vec3;

/// ½ stiffness·d² − pull·d of a material point, per unit of length.
#[derive(Debug, Clone, Copy)]
pub struct PointQuadratic<T> {
    /// N/m per m.
    pub stiffness: T,
    /// N per m.
    pub pull: Vec3<T>,
}

impl<T: Lane> PointQuadratic<T> {
    /// No term yet.
    pub fn zero() -> Self {
        Self { stiffness: T::zero(), pull: Vec3::zero() }
    }
}

/// ½ stiffness·e² − pull·e of one curvature, per unit of length.
#[derive(Debug, Clone, Copy)]
pub struct CurvatureQuadratic<T> {
    /// N·m².
    pub stiffness: T,
    /// N·m.
    pub pull: T,
}

impl<T: Lane> CurvatureQuadratic<T> {
    /// No term yet.
    pub fn zero() -> Self {
        Self { stiffness: T::zero(), pull: T::zero() }
    }
}
