//! How islands' iterations end: further attempts for islands that have not converged, and ended islands that stay as they are
//! while others go on with new contacts.

use nalgebra::Vector3;

use super::convergence::ENOUGH_TURN;
use super::{FEW, Island, LOOKS, Phase};
use crate::contact::constraint::step_constraint::{Give, Standing, StepConstraint};
use crate::contact::options::ContactOptions;
use crate::coupled::constrained_strand::{ConstrainedStrand, Strands};
use crate::meter::Stopped;

/// Where forces have grown beyond measure, strands have diverged whose forces exceed this many times the force that moves a
/// strand by its own length in a step.
const LARGE: f64 = 1e2;

/// The largest number of relaxations: first of diverged strands, then of their neighbours too. (With penalties all are relaxed
/// at once.)
const RELAXINGS: u32 = 2;

/// An attempt to make an island converge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Attempt {
    /// No constraint yields.
    #[default]
    Whole,
    /// Some contacts yield, see [`Give`]; the iteration goes on from the end of the first attempt.
    Yielding,
    /// Some contacts yield, from the start of the step.
    YieldingFromStart,
    /// All constraints of diverged strands yield more, from the start of the step; then those of their neighbours too.
    Relaxed,
}

/// What follows after an island has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Next {
    /// Nothing: it stays as it ended.
    Stays,
    /// It goes on from where it is.
    GoesOn,
    /// Its strands begin the step again.
    BeginsAgain,
}

/// What an island's iteration has come to, the worst first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Outcome {
    /// It has diverged in its last attempt: some of its strands stay as they were when the step began, see [`Island::has_diverged`].
    Diverged,
    /// It has not converged.
    #[default]
    Unconverged,
    /// It has not converged, but is close enough to stay as it is.
    GoodEnough,
    /// The attempt converged, but some constraints yield, or not all is known to be well.
    AttemptConverged,
    /// It converged with no constraint yielding, or the host chose to pay for this many iterations.
    Converged,
}

/// How an island's iteration ended, as reported.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ending {
    /// What it has come to.
    pub outcome: Outcome,
    /// The attempt.
    pub attempt: Attempt,
    /// Why the iteration was stopped early, if it was.
    pub stopped: Stopped,
    /// Largest residual of the laws at the last check, see [`Report::residual`](crate::contact::solver::gauss_seidel::Report::residual).
    pub residual: f64,
}

impl Ending {
    /// Whether it has converged.
    pub fn is_converged(&self) -> bool {
        self.outcome == Outcome::Converged
    }

    /// Lowers what it has come to, to this at most.
    pub(super) fn lower_to(&mut self, outcome: Outcome) {
        self.outcome = self.outcome.min(outcome);
    }

    /// Rejects the end of a strand, and with it that of its island.
    pub fn reject(&mut self, strand: &mut ConstrainedStrand) {
        (strand.residual, self.outcome) = (f64::INFINITY, Outcome::Diverged);
    }

    /// Takes back that it has converged: something has turned out otherwise since.
    pub fn doubt(&mut self) {
        self.lower_to(Outcome::AttemptConverged);
    }
}

impl Island {
    /// How it ended, if it has ended and no further attempt follows.
    pub fn ended(&self) -> Option<Ending> {
        (self.phase.has_ended() && !self.is_to_be_tried_again()).then_some(self.progress.ending)
    }

    /// Ends it where it is, unless it has converged.
    pub fn stop(&mut self, why: Stopped) {
        if self.phase == Phase::Ended && !self.is_to_be_tried_again() {
            return;
        }
        (self.phase, self.progress.ending.stopped) = (Phase::Ended, why);
        self.progress.ending.doubt();
    }

    /// The search for its strands' contacts was halted: undetected contacts are possible, however the iteration ended.
    pub fn interrupt(&mut self, why: Stopped) {
        self.stop(why);
        self.progress.ending.stopped = why;
        self.progress.ending.doubt();
    }

    /// Rejects the end of strands in contact whose energy has risen, and with it that of the island: it counts as diverged
    /// unless it takes the substep in substeps.
    pub fn reject_risen(&mut self, strands: &mut [ConstrainedStrand], step: f64) {
        if self.progress.ending.stopped != Stopped::No || !self.has_contacts() || self.has_bilateral() {
            return;
        }
        for strand in &self.strands {
            let strand = &mut strands[*strand as usize];
            if strand.has_risen(step) {
                self.progress.ending.reject(strand);
            }
        }
    }

    /// Goes on from where it is: one of its strands has been moved.
    pub fn go_on(&mut self) {
        (self.phase, self.progress.rest) = (self.phase.resumed(), -1.0);
        self.progress.ending.lower_to(Outcome::GoodEnough);
        self.begin_to_count();
    }

    /// Leaves it as it ended: nothing in it has changed, and it would end the same way.
    pub fn keep(&mut self, ending: Ending) {
        (self.phase, self.progress.ending) = (self.phase.ended(), ending);
    }

    /// Whether its constraints yield, bilateral ones too.
    pub fn is_relaxed(&self) -> bool {
        self.progress.ending.attempt == Attempt::Relaxed
    }

    /// Whether it has diverged.
    pub fn is_diverged(&self) -> bool {
        self.progress.ending.outcome == Outcome::Diverged
    }

    /// Whether it ended without converging.
    pub fn failed(&self) -> bool {
        self.phase.has_ended() && !self.progress.ending.is_converged()
    }

    /// Whether no more work is spent on it: it has not converged, or only by yielding, and another solve would be expensive.
    pub fn is_given_up(&self) -> bool {
        let dear = self.has_bilateral() || self.strands.len() > FEW;
        self.failed() && (self.is_relaxed() && dear || self.progress.ending.outcome < Outcome::GoodEnough)
    }

    /// Whether another attempt follows, see [`Island::try_again`].
    pub fn is_to_be_tried_again(&self) -> bool {
        let goes_on = self.progress.ending.stopped == Stopped::No && self.progress.ending.outcome < Outcome::GoodEnough;
        let is_last = self.is_relaxed() && self.progress.relaxings >= RELAXINGS;
        self.failed() && goes_on && !is_last && !self.constraints.is_empty()
    }

    /// Begins another attempt if the last one failed. First, in the hard models, only the contacts of unconverged strands
    /// yield, mostly one to five of hundreds. The iteration goes on from where it is, or begins again if forces have grown
    /// beyond measure. Then all constraints of such strands yield more, from the start of the step, and those of their
    /// neighbours if that is not enough: contradictory constraints, or targets out of a strand's reach, are satisfied as well
    /// as possible. The other constraints stay exact, with friction.
    pub fn try_again(&mut self, strands: &(impl Strands + ?Sized), options: &ContactOptions, step: f64) -> Next {
        if !self.is_to_be_tried_again() {
            return Next::Stays;
        }
        let beyond = self.is_beyond_measure(strands, step);
        let diverged = self.diverged_strands(strands, beyond, step);
        let may_yield = matches!(self.progress.ending.attempt, Attempt::Whole | Attempt::Yielding);
        let forgives = may_yield && !options.model.is_soft() && !self.has_bilateral() && self.let_some_yield(&diverged);
        if forgives && self.progress.ending.attempt == Attempt::Whole && !beyond {
            // The normals of bodies stay as they are.
            (self.progress.iterations, self.progress.ending.attempt) = (LOOKS, Attempt::Yielding);
            self.phase = self.phase.resumed();
            self.begin_to_count();
            return Next::GoesOn;
        }
        if !forgives {
            self.relax(diverged, options);
            self.progress.relaxings = if options.model.is_soft() { RELAXINGS } else { self.progress.relaxings + 1 };
        }
        self.progress.ending.attempt = if forgives { Attempt::YieldingFromStart } else { Attempt::Relaxed };
        self.progress.iterations = 0;
        self.phase = if forgives { self.phase.resumed() } else { Phase::Full };
        self.begin_to_count();
        for constraint in &mut self.constraints {
            (constraint.force, constraint.pushed) = (Vector3::zeros(), 0.0);
            constraint.wake();
        }
        Next::BeginsAgain
    }

    /// Lets the contacts of `diverged` strands (ascending) yield. False if none is new.
    fn let_some_yield(&mut self, diverged: &[u32]) -> bool {
        let mut some = false;
        for constraint in &mut self.constraints {
            if constraint.give == Give::No && constraint.ends().any(|end| diverged.binary_search(&end.strand).is_ok()) {
                (constraint.give, constraint.standing, some) = (Give::ALittle, Standing::UNKNOWN, true);
                constraint.wake();
            }
        }
        some
    }

    /// Relaxes all constraints of `diverged` strands (ascending); from the second time on, those of their neighbours too.
    fn relax(&mut self, mut diverged: Vec<u32>, options: &ContactOptions) {
        if self.progress.relaxings > 0 {
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

    /// The diverged strands, ascending: those with forces beyond measure where there are any, else those too far from
    /// convergence or with constraints that are. `beyond`: see [`Island::is_beyond_measure`].
    fn diverged_strands(&self, strands: &(impl Strands + ?Sized), beyond: bool, step: f64) -> Vec<u32> {
        let far = |strand: &&u32| {
            let residual = strands[**strand as usize].residual;
            !beyond && (residual > ENOUGH_TURN || residual.is_nan())
        };
        let mut diverged: Vec<u32> = self.strands.iter().filter(far).copied().collect();
        let large = LARGE * self.usual_force(strands, step);
        let off = |constraint: &&StepConstraint| {
            if beyond { constraint.force.norm() > large } else { !constraint.standing.nearly }
        };
        for constraint in self.constraints.iter().filter(off) {
            diverged.extend(constraint.ends().map(|end| end.strand));
        }
        diverged.sort_unstable();
        diverged
    }
}
