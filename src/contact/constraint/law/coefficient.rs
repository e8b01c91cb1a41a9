//! Friction coefficients that depend on the direction of sliding: the cuticle's scales point to the tip, so that what goes over a hair
//! from root to tip meets less friction than what goes from tip to root (Bertails et al. 2006, section 2 and "Friction with another object").

use std::fmt::Display;

use nalgebra::Vector3;

use crate::error::{Error, Result, check_finite, check_not_negative};

/// A coefficient over the directions d (unit) in which the first strand slides relative to its partner: `mean + lean·d`, so the smooth
/// interpolation by the cosine of the direction of Bertails et al. (2006). Coulomb: without unit; viscous: N·s/m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficient {
    /// The mean over opposite directions, zero or above.
    pub mean: f64,
    /// Which way it grows, world axes; no longer than `mean`, so that no direction has a coefficient below zero.
    pub lean: Vector3<f64>,
}

impl Coefficient {
    /// The same in every direction.
    pub fn uniform(value: f64) -> Self {
        Self { mean: value, lean: Vector3::zeros() }
    }

    /// Of a hair's scales. `along`: the partner goes over the hair from root to tip (the hair itself slides towards its root: d·tangent =
    /// −1), `against`: from tip to root (d·tangent = 1). `tangent` is the hair's, unit, root to tip. Sliding across the hair meets their mean.
    pub fn of_scales(along: f64, against: f64, tangent: Vector3<f64>) -> Self {
        Self { mean: 0.5 * (along + against), lean: tangent * (0.5 * (against - along)) }
    }

    /// Of two hairs on each other: the mean of both, each given as the first strand of a contact.
    pub fn of_two(first: Self, second: Self) -> Self {
        Self { mean: 0.5 * (first.mean + second.mean), lean: (first.lean - second.lean) * 0.5 }
    }

    /// The coefficient for sliding in direction `d` (unit).
    pub fn at(&self, d: &Vector3<f64>) -> f64 {
        (self.mean + self.lean.dot(d)).max(0.0)
    }

    pub(super) fn check(&self, argument: impl Display) -> Result<()> {
        check_not_negative(|| format!("{argument}.mean"), self.mean)?;
        for i in 0..3 {
            check_finite(|| format!("{argument}.lean[{i}]"), self.lean[i])?;
        }
        if self.lean.norm() > self.mean * (1.0 + 1e-12) {
            return Err(Error::invalid(
                format!("{argument}.lean"),
                self.lean.norm(),
                format!("a length of at most {}", self.mean),
            ));
        }
        Ok(())
    }
}
