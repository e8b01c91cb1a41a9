//! How islands' iterations end; what is tried where one does not come to its end; and how those that have ended are left so while others,
//! made anew by what a later search finds, go on.

use nalgebra::Vector3;

use super::constrained_strand::ConstrainedStrand;
use super::island::{ENOUGH_TURN, FEW, Island, LOOKS};
use super::options::ContactOptions;
use super::step_constraint::{Give, Standing, StepConstraint};
use crate::meter::Stopped;

/// Where forces grew beyond measure, strands with forces beyond this many times what takes a strand its own length in a step are astray.
const LARGE: f64 = 1e2;

/// How often joints are relaxed at most: of strands that are astray; and of their neighbours too. (Penalties relax all at once.)
const RELAXINGS: u32 = 2;

/// How an island is tried to come to an end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Attempt {
    /// All joints are to hold.
    #[default]
    Whole,
    /// Some touches give way, from where the first attempt came to, see [`Give`].
    Yielding,
    /// The same from the step's start.
    YieldingFromStart,
    /// All joints of the strands that are astray give way by more, from the step's start; then those of their neighbours too.
    Relaxed,
}

/// What follows where an island has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Next {
    /// Nothing: it stays as it ended.
    Stays,
    /// It goes on from where it is.
    GoesOn,
    /// Its strands begin the step again.
    BeginsAgain,
}

/// How an island's iteration ended: all that is told of it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ending {
    /// Where it should.
    pub converged: bool,
    /// How it was tried to come to an end.
    pub attempt: Attempt,
    /// Whether that came to its end, whatever gave way for it.
    pub attempt_converged: bool,
    /// It has not come to its end, but is near enough to stay as it is.
    pub good_enough: bool,
    /// Not even so: strands of it stay as the step found them, see [`Island::has_diverged`].
    pub diverged: bool,
    /// Why it was ended before its end, if so.
    pub stopped: Stopped,
    /// Largest residual of the laws at the last check, see [`Report::residual`](super::gauss_seidel::Report::residual).
    pub residual: f64,
}

impl Island {
    /// How it ended, if it has, and no other attempt is to follow.
    pub fn ended(&self) -> Option<Ending> {
        (self.done && !self.is_to_be_tried_again()).then_some(self.ending)
    }

    /// Ends it where it is, unless it is at its end.
    pub fn stop(&mut self, why: Stopped) {
        if self.done && !self.rough && !self.is_to_be_tried_again() {
            return;
        }
        (self.done, self.rough) = (true, false);
        (self.ending.converged, self.ending.stopped) = (false, why);
    }

    /// The search for what its strands touch was halted: they may be anywhere, whatever their end.
    pub fn interrupt(&mut self, why: Stopped) {
        self.stop(why);
        (self.ending.converged, self.ending.stopped) = (false, why);
    }

    /// Refuses the end of touches' strands that have strayed, and with it the island's: they are lost where the substep is not taken in parts.
    pub fn reject_risen(&mut self, strands: &mut [ConstrainedStrand], step: f64) {
        if self.ending.stopped != Stopped::No || !self.has_contacts() || self.has_bilateral() {
            return;
        }
        for strand in &self.strands {
            let strand = &mut strands[*strand as usize];
            if strand.has_risen(step) {
                strand.residual = f64::INFINITY;
                (self.ending.converged, self.ending.attempt_converged, self.ending.good_enough) = (false, false, false);
                self.ending.diverged = true;
            }
        }
    }

    /// Goes on from where it is: a strand of it has been moved.
    pub fn go_on(&mut self) {
        (self.done, self.ending.attempt_converged, self.ending.converged, self.rest) = (false, false, false, -1.0);
        self.begin_to_count(self.iterations);
    }

    /// Leaves it as it ended: made anew, it is the same, and would end there again.
    pub fn keep(&mut self, ending: Ending) {
        (self.done, self.ending) = (true, ending);
    }

    /// Whether joints of it give way that could not be held, constraints too.
    pub fn is_relaxed(&self) -> bool {
        self.ending.attempt == Attempt::Relaxed
    }

    /// Whether its iteration ended elsewhere than it should.
    pub fn failed(&self) -> bool {
        self.done && !self.ending.converged
    }

    /// Whether no more is done for it: it is not where it should be, or only nearly so by giving way, and would be dear to solve again.
    pub fn is_given_up(&self) -> bool {
        let dear = self.has_bilateral() || self.strands.len() > FEW;
        self.failed() && (self.is_relaxed() && dear || !self.ending.good_enough)
    }

    /// Whether there is to be another attempt, see [`Island::try_again`].
    pub fn is_to_be_tried_again(&self) -> bool {
        let goes_on = self.ending.stopped == Stopped::No && !self.ending.good_enough;
        let is_last = self.is_relaxed() && self.relaxings >= RELAXINGS;
        self.failed() && goes_on && !is_last && !self.constraints.is_empty()
    }

    /// Another attempt, if its joints were not to be held. First, if they are touches without springs of their own, those of strands alone give
    /// way that did not come to their end; mostly these are one to five of hundreds. It goes on from where it is, or, where forces grew beyond measure,
    /// begins again. Then all joints of such strands give way by more, from the start, and of their neighbours where that does not do: what contradicts
    /// itself, or is out of a strand's reach, is drawn as near as it goes. The others hold and rub as ever.
    pub fn try_again(&mut self, strands: &[ConstrainedStrand], options: &ContactOptions, step: f64) -> Next {
        if !self.is_to_be_tried_again() {
            return Next::Stays;
        }
        let may_yield = matches!(self.ending.attempt, Attempt::Whole | Attempt::Yielding);
        let forgives = may_yield && !options.model.is_soft() && !self.has_bilateral() && self.let_some_yield(strands, step);
        if forgives && self.ending.attempt == Attempt::Whole && !self.beyond {
            // Bodies' surfaces stay as they are.
            (self.iterations, self.done, self.ending.attempt) = (LOOKS, false, Attempt::Yielding);
            self.begin_to_count(LOOKS);
            return Next::GoesOn;
        }
        if !forgives {
            self.relax(strands, options, step);
            self.relaxings = if options.model.is_soft() { RELAXINGS } else { self.relaxings + 1 };
        }
        self.ending.attempt = if forgives { Attempt::YieldingFromStart } else { Attempt::Relaxed };
        (self.iterations, self.done, self.rough) = (0, false, forgives && self.rough);
        self.begin_to_count(0);
        for constraint in &mut self.constraints {
            (constraint.force, constraint.dormant, constraint.pushed) = (Vector3::zeros(), false, 0.0);
        }
        Next::BeginsAgain
    }

    /// Lets the touches of strands yield that are astray. False if none yields that did not.
    fn let_some_yield(&mut self, strands: &[ConstrainedStrand], step: f64) -> bool {
        let diverged = self.diverged_strands(strands, step);
        let mut some = false;
        for constraint in &mut self.constraints {
            if constraint.give == Give::No && constraint.ends().any(|end| diverged.binary_search(&end.strand).is_ok()) {
                (constraint.give, constraint.dormant, constraint.standing, some) =
                    (Give::ALittle, false, Standing::UNKNOWN, true);
            }
        }
        some
    }

    /// Relaxes all joints of the strands that are astray; from the second time on, of their neighbours too.
    fn relax(&mut self, strands: &[ConstrainedStrand], options: &ContactOptions, step: f64) {
        let mut diverged = self.diverged_strands(strands, step);
        if self.relaxings > 0 {
            let meets = |constraint: &&StepConstraint| constraint.ends().any(|end| diverged.binary_search(&end.strand).is_ok());
            let mut all: Vec<u32> =
                self.constraints.iter().filter(meets).flat_map(StepConstraint::ends).map(|end| end.strand).collect();
            all.extend_from_slice(&diverged);
            all.sort_unstable();
            diverged = all;
        }
        let all = diverged.is_empty() || options.model.is_soft();
        for constraint in &mut self.constraints {
            if all || constraint.ends().any(|end| diverged.binary_search(&end.strand).is_ok()) {
                (constraint.give, constraint.standing) = (Give::Much, Standing::UNKNOWN);
            }
        }
    }

    /// The strands that are astray, ascending: where forces grew beyond measure, those with such forces; else those too far from
    /// their end, or with joints that are.
    fn diverged_strands(&self, strands: &[ConstrainedStrand], step: f64) -> Vec<u32> {
        let far = |strand: &&u32| {
            let residual = strands[**strand as usize].residual;
            !self.beyond && (residual > ENOUGH_TURN || residual.is_nan())
        };
        let mut diverged: Vec<u32> = self.strands.iter().filter(far).copied().collect();
        let large = LARGE * self.usual_force(strands, step);
        let off = |constraint: &&StepConstraint| {
            if self.beyond { constraint.force.norm() > large } else { !constraint.standing.nearly }
        };
        for constraint in self.constraints.iter().filter(off) {
            diverged.extend(constraint.ends().map(|end| end.strand));
        }
        diverged.sort_unstable();
        diverged
    }
}
