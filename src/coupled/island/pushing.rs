//! Removes the depth of yielding contacts. After the island has converged with them, each spring's offset grows by the depth
//! that is left, again and again: an augmented Lagrangian, whose forces are found outside the contact problem, in which nothing
//! becomes stiff. Contacts that no force separates stay as deep as they are.

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
/// own length in a step: it would fling away what it stands between.
const STRENGTH: f64 = 1.0;

impl StepConstraint {
    fn is_pushed(&self, strands: &(impl Strands + ?Sized), step: f64) -> bool {
        if !(self.give != Give::No || self.deep) || !self.is_contact() || self.force == Vector3::zeros() && self.off <= 0.0 {
            return false;
        }
        let usual = |end: ConstraintEnd| strands[end.strand as usize].usual_force(step);
        self.off <= 0.0 || self.force.norm() < STRENGTH * self.ends().map(usual).fold(f64::INFINITY, f64::min)
    }
}

impl Island {
    /// After convergence: pushes the contacts that yield. True if there is more to do.
    pub(super) fn push_on(&mut self, strands: &(impl Strands + ?Sized), options: &ContactOptions, step: f64) -> bool {
        if self.is_relaxed() || options.model.is_soft() {
            return false;
        }
        let is_pushed = |constraint: &StepConstraint| constraint.is_pushed(strands, step);
        let deepest = self
            .constraints
            .iter()
            .filter(|constraint| is_pushed(constraint))
            .fold(0.0, |a: f64, constraint| a.max(constraint.off));
        let (before, times) = self.progress.pushed;
        if deepest <= options.tolerance || deepest > GETS_ON * before || times == MAX_PUSHES {
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
