//! Dormant contacts, left out of an island's contact problems for a while. Of the contacts found by searches three quarters
//! press nothing in the end. In the strands' models, whose Delassus operators grow with the square of the number of contacts,
//! and in sweeps they would cost as much as the others.

use nalgebra::Vector3;

use super::Island;
use super::convergence::{is_nearly_outside, is_outside};
use crate::contact::constraint::law::Law;
use crate::contact::constraint::step_constraint::{Activity, Give, Standing, StepConstraint};
use crate::contact::options::ContactOptions;
use crate::coupled::constrained_strand::{Rest, Strands};

/// A contact becomes dormant if its surfaces are further apart than this many times their relative motion in the iteration: the
/// next ones are shorter.
const ASIDE: f64 = 1.0;

impl StepConstraint {
    /// Whether a strand at one of its ends takes part in the iteration.
    pub(super) fn moves(&self, strands: &(impl Strands + ?Sized)) -> bool {
        self.ends().any(|end| !strands[end.strand as usize].rest.is_resting())
    }

    /// Whether no strand at its ends moves, since one is held.
    pub(super) fn is_held(&self, strands: &(impl Strands + ?Sized)) -> bool {
        !self.moves(strands) && self.ends().any(|end| strands[end.strand as usize].rest == Rest::Held)
    }

    /// Takes it into contact problems again; it may fall asleep once more.
    pub(super) fn wake(&mut self) {
        if self.is_dormant() {
            self.activity = Activity::Active;
        }
    }

    /// After an iteration that took its surfaces to `u` and moved them by `moved` (m): makes it dormant if nothing presses it
    /// and it is out of reach.
    pub(super) fn may_sleep(&mut self, law: &Law, u: &Vector3<f64>, moved: f64) {
        let Law::Contact(contact) = law else { return };
        let free = self.force == Vector3::zeros() && !(self.deep || self.give != Give::No || self.activity == Activity::Roused);
        if free && u.dot(&contact.normal) > ASIDE * moved {
            (self.activity, self.standing) = (Activity::Dormant, Standing::apart());
        }
    }
}

impl Island {
    /// Wakes a dormant contact whose surfaces have met, for the rest of the step.
    pub(super) fn rouse(&mut self, index: usize, strands: &(impl Strands + ?Sized), options: &ContactOptions, step: f64) {
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
        constraint.activity = Activity::Roused;
        // A dormant spring exerts no force yet.
        let soft = options.model.is_soft();
        let holds = !soft && is_outside(gap, options);
        constraint.standing = Standing { holds, nearly: soft || is_nearly_outside(gap, options), ..constraint.standing };
    }
}
