//! The normal response: the depth of a contact under a normal force.

use std::fmt::Display;

use crate::error::{Result, check_not_negative, check_positive};

/// The normal response of a contact. With depth d (m, minus the gap at the step's end) and force F (N): F ≥ 0, and d is at most
/// the depth under F, exactly that where F > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Response {
    /// No depth at any force: 0 ≤ gap ⟂ F ≥ 0.
    Hard,
    /// A spring and a damper, F = k d + c (d − d₀)/h, never below zero (the elastic response of Bertails et al. 2006).
    Penalty {
        /// k, N/m, above zero.
        stiffness: f64,
        /// c, N·s/m, zero or above.
        damping: f64,
        /// d₀, the depth at the step's start, m; zero where the surfaces were apart.
        depth_at_start: f64,
    },
    /// The regularised spring of Bergbom (2007, section 4.2.10): F = k d²/(2 d_reg) up to d_reg, k (d − d_reg/2) beyond.
    Regularised {
        /// k, N/m, above zero.
        stiffness: f64,
        /// d_reg, m, above zero.
        depth: f64,
    },
}

/// A response's depth as a function of the force: `shift + compliance F` plus, for the regularised spring, its curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Depth {
    /// m/N.
    compliance: f64,
    /// Added to the gap, m.
    pub(super) shift: f64,
    /// d_reg, or zero.
    curve: f64,
}

impl Response {
    /// A spring of this compliance, m/N; hard if it is zero.
    pub fn spring(compliance: f64) -> Self {
        if compliance > 0.0 {
            Self::Penalty { stiffness: 1.0 / compliance, damping: 0.0, depth_at_start: 0.0 }
        } else {
            Self::Hard
        }
    }

    pub(super) fn check(&self, argument: impl Display) -> Result<()> {
        match *self {
            Response::Hard => Ok(()),
            Response::Penalty { stiffness, damping, depth_at_start } => {
                check_positive(|| format!("{argument}.stiffness"), stiffness)?;
                check_not_negative(|| format!("{argument}.damping"), damping)?;
                check_not_negative(|| format!("{argument}.depth_at_start"), depth_at_start)
            }
            Response::Regularised { stiffness, depth } => {
                check_positive(|| format!("{argument}.stiffness"), stiffness)?;
                check_positive(|| format!("{argument}.depth"), depth)
            }
        }
    }

    pub(super) fn depth(&self, step: f64) -> Depth {
        match *self {
            Response::Hard => Depth { compliance: 0.0, shift: 0.0, curve: 0.0 },
            Response::Penalty { stiffness, damping, depth_at_start } => {
                let compliance = 1.0 / (stiffness + damping / step);
                Depth { compliance, shift: damping / step * depth_at_start * compliance, curve: 0.0 }
            }
            Response::Regularised { stiffness, depth } => Depth { compliance: 1.0 / stiffness, shift: 0.0, curve: depth },
        }
    }
}

impl Depth {
    /// The depth under the force F ≥ 0, m, including the shift.
    pub(super) fn at(&self, force: f64) -> f64 {
        let straight = self.compliance * force;
        let bent = if straight < 0.5 * self.curve { (2.0 * self.curve * straight).sqrt() } else { straight + 0.5 * self.curve };
        self.shift + bent
    }

    /// The force at a depth, N; infinite for a hard contact.
    pub(super) fn pressed(&self, depth: f64) -> f64 {
        let depth = depth - self.shift;
        if self.compliance == 0.0 {
            f64::INFINITY
        } else if depth <= 0.0 {
            0.0
        } else if depth < self.curve {
            depth * depth / (2.0 * self.curve * self.compliance)
        } else {
            (depth - 0.5 * self.curve) / self.compliance
        }
    }

    /// m/N, of a linear response.
    pub(super) fn compliance(&self) -> f64 {
        self.compliance
    }

    /// Slope of the force over the depth, N/m; zero where nothing presses, infinite for a hard contact.
    pub(super) fn stiffness(&self, depth: f64) -> f64 {
        let depth = depth - self.shift;
        if depth <= 0.0 {
            0.0
        } else if depth < self.curve {
            depth / (self.curve * self.compliance)
        } else {
            1.0 / self.compliance
        }
    }

    /// The force F with D F + depth(F) − shift = `drive`, and the slope of the left side there. A drive of zero or below gives
    /// what a linear spring would (a force of zero or below), which shows a search on which side it is.
    #[inline(always)]
    pub(super) fn force(&self, d: f64, drive: f64) -> (f64, f64) {
        if self.curve == 0.0 {
            let slope = d + self.compliance;
            return (drive / slope, slope);
        }
        let slope = d + self.compliance;
        let straight = (drive - 0.5 * self.curve) / slope;
        if drive <= 0.0 {
            return (drive / slope, slope);
        }
        if self.compliance * straight >= 0.5 * self.curve {
            return (straight, slope);
        }
        // d y² + e y = drive for y = √F.
        let e = (2.0 * self.curve * self.compliance).sqrt();
        let y = 2.0 * drive / (e + (e * e + 4.0 * d * drive).sqrt());
        (y * y, d + 0.5 * e / y)
    }
}
