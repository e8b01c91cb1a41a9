//! Touches that have no part in an island's contact problems for a while. Of what searches find three quarters press nothing in the end; in the
//! strands' models (whose Delassus operators grow with the square of their touches) and in sweeps they cost as much as those that do.

use nalgebra::Vector3;

use super::constrained_strand::ConstrainedStrand;
use super::island::{Island, is_nearly_outside, is_outside};
use super::law::Law;
use super::options::ContactOptions;
use super::step_constraint::{Give, Standing, StepConstraint};

/// A touch sleeps where its surfaces are further apart than so many times what they moved against each other in the iteration: the next ones are
/// shorter.
const ASIDE: f64 = 1.0;

impl StepConstraint {
    /// Whether a strand at its ends takes part in the iteration.
    pub(super) fn moves(&self, strands: &[ConstrainedStrand]) -> bool {
        self.ends().any(|end| !strands[end.strand as usize].resting)
    }

    /// After an iteration that took its surfaces to `u` and by `moved` (m) nearer or apart: lets it sleep if nothing presses it and it is out of
    /// reach.
    pub(super) fn may_sleep(&mut self, law: &Law, u: &Vector3<f64>, moved: f64) {
        let Law::Contact(contact) = law else { return };
        let free = self.force == Vector3::zeros() && !(self.deep || self.give != Give::No || self.roused);
        if free && u.dot(&contact.normal) > ASIDE * moved {
            (self.dormant, self.standing) = (true, Standing::apart());
        }
    }
}

impl Island {
    /// Wakes a touch that sleeps where its surfaces have met, for the rest of the step.
    pub(super) fn rouse(&mut self, index: usize, strands: &[ConstrainedStrand], options: &ContactOptions, step: f64) {
        if !self.constraints[index].moves(strands) {
            return;
        }
        let (law, u) = self.evaluate(index, strands, options, step);
        let Law::Contact(contact) = law else { return };
        let gap = u.dot(&contact.normal);
        if gap >= 0.0 {
            return;
        }
        let constraint = &mut self.constraints[index];
        (constraint.dormant, constraint.roused) = (false, true);
        // What springs hold they hold in no way yet.
        let soft = options.model.is_soft();
        let holds = !soft && is_outside(gap, options);
        constraint.standing = Standing { holds, nearly: soft || is_nearly_outside(gap, options), ..constraint.standing };
    }
}
