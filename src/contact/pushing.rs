//! Touches that give way are brought out after all, where there is a way: where an island has come to its end with them, their springs push by as much
//! more as their surfaces are in each other, again and again. (An augmented Lagrangian: forces are found from outside the contact problem, in
//! which nothing turns stiff. What no force parts stays as deep as it is.)

use nalgebra::Vector3;

use super::constrained_strand::ConstrainedStrand;
use super::island::Island;
use super::options::ContactOptions;
use super::step_constraint::{ConstraintEnd, Give, StepConstraint};

/// Touches are pushed on as long as that leaves the deepest at this part of its depth, and so often at most between two searches for touches.
const GETS_ON: f64 = 0.7;
const MAX_PUSHES: u32 = 10;

/// Touches that press harder than what takes the lighter of their strands so many times its own length in a step are pushed no further: what they
/// stand between would be flung away.
const STRENGTH: f64 = 1.0;

impl StepConstraint {
    fn is_pushed(&self, strands: &[ConstrainedStrand], step: f64) -> bool {
        if !(self.give != Give::No || self.deep) || !self.is_contact() || self.force == Vector3::zeros() && self.off <= 0.0 {
            return false;
        }
        let usual = |end: ConstraintEnd| strands[end.strand as usize].usual_force(step);
        self.off <= 0.0 || self.force.norm() < STRENGTH * self.ends().map(usual).fold(f64::INFINITY, f64::min)
    }
}

impl Island {
    /// At its end: pushes touches on that give way. True if there is more to do.
    pub(super) fn push_on(&mut self, strands: &[ConstrainedStrand], options: &ContactOptions, step: f64) -> bool {
        if self.is_relaxed() || options.model.is_soft() {
            return false;
        }
        let is_pushed = |constraint: &StepConstraint| constraint.is_pushed(strands, step);
        let deepest = self
            .constraints
            .iter()
            .filter(|constraint| is_pushed(constraint))
            .fold(0.0, |a: f64, constraint| a.max(constraint.off));
        let (before, times) = self.pushed;
        if deepest <= options.tolerance || deepest > GETS_ON * before || times == MAX_PUSHES {
            return false;
        }
        for constraint in self.constraints.iter_mut().filter(|constraint| is_pushed(constraint)) {
            constraint.pushed = (constraint.pushed + constraint.off).max(0.0);
            // Nobody at its ends may go on resting.
            constraint.standing.wakes = [true; 2];
        }
        self.pushed = (deepest, times + 1);
        self.begin_to_count(self.iterations);
        true
    }
}
