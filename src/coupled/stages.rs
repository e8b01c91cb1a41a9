//! The stages of a coupled step, in their order: the contacts at its start; Newton's iterations and the searches for contacts that
//! they bring about; the depth that is left where that has failed.

use super::constrained_strand::ConstrainedStrand;
use super::contact_limit;
use super::coupled_step::{BeginAgain, CoupledStep, Scratch, Stepping};
use super::detection::unseen;
use super::iterations::IterationTally;
use crate::contact::broad_phase::hair_pairs::Tie;
use crate::meter::Stopped;

/// The largest number of searches for undetected contacts.
const MAX_SEARCHES: u32 = 16;
/// The first searches follow after this many Newton iterations: most new contacts are visible by then, and need not wait until
/// the others are exact. (Sooner, contacts of a mere first guess would be kept, and the energy of long runs grows.)
const EARLY: u32 = 2;
const EARLY_ITERATIONS: u32 = 2;

/// Cost of a constraint found by a search, nanoseconds or so.
const WORK_A_CONSTRAINT: u64 = 3000;

impl CoupledStep {
    /// Detects the contacts at the start of the step of strands that are `tied` together (by their indices in the solver): as
    /// constraints that belong to no island yet.
    pub fn detect<S: Scratch>(&mut self, stepping: &Stepping<S>, tied: impl Iterator<Item = Tie>) {
        let strands = &mut self.strands[..self.count];
        self.constraints.clear();
        self.detection.begin_step(tied);
        self.detection.find(stepping, strands, true);
        if !stepping.meter.is_halted() {
            self.detection.constraints(stepping, strands, &mut self.constraints);
        }
        contact_limit::thin_out(&mut self.constraints, strands, stepping.meter.left());
    }

    /// Couples the strands by all constraints.
    pub fn couple<S>(&mut self, stepping: &Stepping<S>) {
        stepping.meter.spend(self.constraints.len() as u64 * WORK_A_CONSTRAINT);
        let rough = self.searches(stepping) > 0;
        self.tie(rough);
    }

    /// The largest number of searches for undetected contacts.
    fn searches<S>(&self, stepping: &Stepping<S>) -> u32 {
        if stepping.options.model.is_soft() || !self.detection.is_possible(stepping) {
            return 0;
        }
        #[cfg(test)]
        if let Some(most) = self.max_searches {
            return most;
        }
        MAX_SEARCHES
    }

    /// Newton's iterations of all islands, and searches for undetected contacts between them.
    pub fn solve<S: Scratch>(&mut self, stepping: &Stepping<S>, begin_again: &mut BeginAgain, tally: &mut IterationTally) {
        let searches = self.searches(stepping);
        // The solve is rough until a search finds nothing new: a contact detected later would undo an exact solution.
        let mut rough = searches > 0;
        for search in 0..searches {
            self.iterate(stepping, begin_again, tally, if search < EARLY { EARLY_ITERATIONS } else { u32::MAX });
            let stopped = stepping.meter.stopped();
            if stopped != Stopped::No {
                return self.stop(stopped);
            }
            let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
            self.detection.find(stepping, strands, false);
            if stepping.meter.is_halted() {
                return self.interrupt(stepping);
            }
            let more = self.detection.add_undetected(stepping, strands, islands, &mut self.constraints);
            if !more && stepping.meter.is_halted() {
                return self.interrupt(stepping);
            }
            if more {
                tally.searches += 1;
                contact_limit::thin_out(&mut self.constraints, strands, stepping.meter.left());
                self.tie(rough);
            } else if self.is_done() {
                if !(rough && self.refine()) {
                    return;
                }
                rough = false;
            }
        }
        self.iterate(stepping, begin_again, tally, u32::MAX);
        if rough && self.refine() {
            self.iterate(stepping, begin_again, tally, u32::MAX);
        }
        if searches > 0 && !stepping.meter.is_halted() {
            // No more contacts are added, and what there is is reported.
            let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
            self.detection.find(stepping, strands, false);
            if stepping.meter.is_halted() {
                return self.interrupt(stepping);
            }
            if !self.detection.report_undetected(stepping, strands, islands) {
                self.interrupt(stepping);
            }
        }
    }

    /// The last search was halted: strands that it has not reached may have undetected contacts.
    fn interrupt<S>(&mut self, stepping: &Stepping<S>) {
        let (why, unseen) = (stepping.meter.stopped(), unseen(stepping.options));
        self.stop(why);
        let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
        for constrained in strands.iter_mut().filter(|constrained| constrained.has_gone(unseen)) {
            constrained.has_undetected = true;
            islands[constrained.island as usize].interrupt(why);
        }
    }

    /// Measures the depth of islands that have not converged or are held apart by springs, and of overlap that no constraint
    /// represents. Their constraints only tell the depth where the contacts were found.
    pub fn look_at_failures<S: Scratch>(&mut self, stepping: &Stepping<S>, is_last: bool) {
        let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
        if stepping.meter.is_halted() {
            return;
        }
        let is_looked_at = |constrained: &ConstrainedStrand| {
            constrained.left_deep || constrained.lags() || islands[constrained.island as usize].failed()
        };
        // Penalty models search only at the start.
        let all = stepping.options.model.is_soft();
        if !self.detection.is_possible(stepping) || (all && !is_last) || !(all || strands.iter().any(is_looked_at)) {
            return;
        }
        for constrained in strands.iter_mut() {
            constrained.step.gone = if all || is_looked_at(constrained) { f64::INFINITY } else { 0.0 };
        }
        self.detection.find(stepping, strands, false);
        self.detection.report_depths(stepping, strands, islands, true);
        if stepping.meter.is_halted() || !strands.iter().any(ConstrainedStrand::lags) {
            return;
        }
        // Bodies that still follow a strand are there all the same.
        for constrained in strands.iter_mut() {
            constrained.look_around(stepping.bodies);
            constrained.step.gone = if constrained.lags() { f64::INFINITY } else { 0.0 };
        }
        self.detection.find(stepping, strands, false);
        self.detection.report_depths(stepping, strands, islands, false);
    }
}
