//! Removes the depth of yielding contacts. After the island has converged with them, each spring's offset grows by the depth
//! that is left, again and again: an augmented Lagrangian, whose forces are found outside the contact problem, in which nothing
//! becomes stiff. Contacts that no force separates stay as deep as they are.
//!
//! Between strands all contacts yield by next to nothing and are pushed, too: hard ones that friction wedges have forces beyond all measure,
//! or many solutions. Their springs begin with the offsets that give the last step's forces at no depth, so that at rest nothing
//! yields and nothing is left to push: a proximal point method over the steps (Rockafellar 1976).

use nalgebra::Vector3;

use super::Island;
use crate::contact::constraint::step_constraint::{ConstraintEnd, Give, StepConstraint};
use crate::contact::options::ContactOptions;
use crate::coupled::constrained_strand::Strands;

/// Pushing goes on while it reduces the largest depth to this fraction, and at most this often between two searches for
/// contacts.
const GETS_ON: f64 = 0.7;
const MAX_PUSHES: u32 = 10;

/// A contact is pushed no further if its force exceeds this many times the force that moves the lighter of its strands by its
/// own length in a step (and, where it is to hold, that bends an element): it would fling away what it stands between.
const STRENGTH: f64 = 1.0;

/// The depth to which a contact that is to hold is pushed, in tolerances.
const FIRM: f64 = 0.1;

impl StepConstraint {
    /// What it is off by, in units of what it may be: deep, or pressed where it has been pushed apart.
    pub(super) fn off_by(&self, tolerance: f64) -> f64 {
        if self.is_compliant() {
            let apart = if self.pushed > 0.0 && self.presses() { -self.off } else { 0.0 };
            self.off.max(apart) / (FIRM * tolerance)
        } else {
            self.off / tolerance
        }
    }

    fn is_pushed(&self, strands: &(impl Strands + ?Sized), tolerance: f64, step: f64) -> bool {
        let yields = self.give != Give::No || self.deep || self.is_compliant() && self.off_by(tolerance) > 1.0;
        let is_idle = self.force == Vector3::zeros() && self.off <= 0.0;
        if !yields || !self.is_contact() || is_idle {
            return false;
        }
        let usual = |end: ConstraintEnd| {
            let strand = &strands[end.strand as usize];
            strand.usual_force(step) + if self.is_compliant() { strand.bending } else { 0.0 }
        };
        self.off <= 0.0 || self.force.norm() < STRENGTH * self.ends().map(usual).fold(f64::INFINITY, f64::min)
    }
}

impl Island {
    /// After convergence: pushes the contacts that yield. True if there is more to do.
    pub(super) fn push_on(&mut self, strands: &(impl Strands + ?Sized), options: &ContactOptions, step: f64) -> bool {
        if self.is_relaxed() || options.model.is_soft() {
            return false;
        }
        let is_rough = self.phase.is_rough();
        let is_pushed = |constraint: &StepConstraint| {
            !(is_rough && constraint.is_compliant()) && constraint.is_pushed(strands, options.tolerance, step)
        };
        let deepest = self
            .constraints
            .iter()
            .filter(|constraint| is_pushed(constraint))
            .fold(0.0, |a: f64, constraint| a.max(constraint.off_by(options.tolerance)));
        let (before, times) = self.progress.pushed;
        if deepest <= 1.0 || deepest > GETS_ON * before || times == MAX_PUSHES {
            return false;
        }
        for constraint in self.constraints.iter_mut().filter(|constraint| is_pushed(constraint)) {
            constraint.pushed = (constraint.pushed + constraint.off).max(0.0);
            // No strand at its ends may go on resting.
            constraint.standing.wakes = [true; 2];
        }
        self.progress.pushed = (deepest, times + 1);
        self.begin_to_count();
        true
    }
}
