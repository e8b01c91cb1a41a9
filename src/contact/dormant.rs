//! Touches that have no part in an island's contact problems for a while. Of what searches find three quarters press nothing in the end; in the
//! strands' models (whose Delassus operators grow with the square of their touches) and in sweeps they cost as much as those that do.

use nalgebra::Vector3;

use super::held_strand::HeldStrand;
use super::island::{ENOUGH_DEPTH, Island};
use super::joint::{Joint, Standing};
use super::law::Law;
use super::options::ContactOptions;

/// A touch sleeps where its surfaces are further apart than so many times what they moved against each other in the iteration: the next ones are
/// shorter.
const ASIDE: f64 = 1.0;

impl Joint {
    /// After an iteration that took its surfaces to `u` and `nearer` to each other (m): lets it sleep if nothing presses it and it is out of reach.
    pub(super) fn may_sleep(&mut self, law: &Law, u: &Vector3<f64>, nearer: f64) {
        let Law::Contact(contact) = law else { return };
        let free = self.force == Vector3::zeros() && !(self.deep || self.yields || self.roused);
        if free && u.dot(&contact.normal) > ASIDE * nearer.abs() {
            (self.dormant, self.standing) = (true, self.standing.apart());
        }
    }
}

impl Island {
    /// Wakes a touch that sleeps where its surfaces have met, for the rest of the step.
    pub(super) fn rouse(&mut self, index: usize, strands: &[HeldStrand], options: &ContactOptions, step: f64) {
        let joint = &self.joints[index];
        let moves = |held: u32| !strands[held as usize].resting;
        if !(moves(joint.first.held) || joint.second.is_some_and(|end| moves(end.held))) {
            return;
        }
        let (law, u) = self.evaluate(index, strands, options, step);
        let Law::Contact(contact) = law else { return };
        let gap = u.dot(&contact.normal);
        if gap >= 0.0 {
            return;
        }
        let joint = &mut self.joints[index];
        (joint.dormant, joint.roused) = (false, true);
        let soft = options.model.is_soft();
        let holds = !soft && gap >= -0.5 * options.tolerance;
        let nearly = soft || gap >= -ENOUGH_DEPTH * options.tolerance;
        joint.standing = Standing { holds, nearly, ..joint.standing };
    }
}
