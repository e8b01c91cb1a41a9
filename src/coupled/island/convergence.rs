//! The test for convergence of an island, after each Newton iteration: what still moves, which laws hold, whether it makes progress.

use super::ending::Outcome;
use super::{DIVERGED, FEW, Island, ROUGH};
use crate::contact::constraint::law::Law;
use crate::contact::constraint::step_constraint::{Give, Standing, StepConstraint};
use crate::contact::options::{ContactOptions, MAX_CHOSEN_ITERATIONS};
use crate::coupled::constrained_strand::{Rest, Strands};

/// Tolerance of a rigid bilateral constraint at the end of a step, m.
const BILATERAL_TOLERANCE: f64 = 1e-10;
/// The distance of an element from convergence that a rough solve leaves, rad.
const ROUGH_TOLERANCE: f64 = 1e-3;
/// The same for the penalty models.
pub(in crate::coupled) const SOFT_TOLERANCE: f64 = 2e-3;
/// Iterations of all strands in which the residual, or the number of unconverged strands and constraints, must halve: in an island that is
/// good enough as it is; in a large island whose contacts may yet yield; elsewhere. Otherwise the island makes no progress and
/// is ended.
const PATIENCE: [f64; 3] = [5.0, 15.0, 25.0];
/// An iteration of few strands whose contact problem is not solved counts as so many of these: no forces satisfy most such problems, and contacts
/// that yield come next.
const UNSOLVED: f64 = 3.0;
/// Tolerances of an island that has not converged and is kept as it is: of a strand, rad; of a contact, in units of the contact
/// tolerance; of a bilateral constraint, m.
pub(super) const ENOUGH_TURN: f64 = 1e-2;
const ENOUGH_DEPTH: f64 = 2.0;
const ENOUGH_BILATERAL: f64 = 1e-9;
/// A contact problem has no solution if a force exceeds this many times the force that moves a strand by its own length in a
/// step.
const NO_SOLUTION: f64 = 1e4;
/// The same for bilateral constraints, in units of that force plus the force that bends an element by a radian. Constraints
/// that can be satisfied need a few times as much in the end, though more during the iteration; others need a thousand times
/// more in every iteration.
const CANNOT_HOLD: f64 = 1e12;
/// An island with bilateral constraints is ended after this many iterations in a row that move no strand by more than this
/// fraction of the tolerance, or leave the contact problem with more than this residual: the constraints leave its contacts no
/// room (hard models; others yield).
const IDLE: u32 = 5;
const STILL: f64 = 1e-2;
const HOPELESS: f64 = 0.1;

/// A contact that has been pushed as far as it went holds if it is off by this many times what it is to be.
const TIGHT: f64 = 2.0;

/// A strand may rest if it is closer to convergence than this fraction of the tolerance, until changed forces would move it by
/// more than that (an element's length times the angle).
const REST: f64 = 0.3;

impl Island {
    /// After the second half: tests for convergence, by the strands' residuals and those of the laws at the new iterate.
    pub fn check(&mut self, strands: &(impl Strands + ?Sized), options: &ContactOptions, tolerance: f64, step: f64) {
        let soft = options.model.is_soft();
        let enough_for_contacts = match () {
            () if !self.has_contacts() => 0.0,
            () if options.model.is_soft() => SOFT_TOLERANCE,
            () if self.phase.is_rough() => ROUGH_TOLERANCE,
            () => 0.0,
        };
        let tolerance_asked = tolerance;
        let tolerance = tolerance.max(enough_for_contacts);
        let iterating = self.strands.iter().map(|strand| &strands[*strand as usize]).filter(|strand| strand.rest != Rest::Held);
        let residual = iterating.map(|strand| strand.residual).fold(0.0, f64::max);
        let mut good = residual <= tolerance;
        let mut enough = residual <= ENOUGH_TURN;
        let (mut rested, mut wakes_some) = (0.0_f64, false);
        let asked = self.asked(options);
        (self.progress.rest, self.rest_residual) = (REST * tolerance, asked);
        self.progress.ending.residual = 0.0;
        for index in 0..self.constraints.len() {
            if !self.is_included[index] {
                if self.constraints[index].is_dormant() {
                    self.rouse(index, strands, options, step);
                }
                let Standing { law_residual, holds, nearly, .. } = self.constraints[index].standing;
                if self.is_beyond_held(index, strands) || self.constraints[index].is_held(strands) {
                    // Nothing waits for it.
                    rested = rested.max(law_residual);
                    continue;
                }
                if !holds && !self.constraints[index].is_dormant() {
                    // Its strands all rest, and nothing else would wake them.
                    self.constraints[index].standing.wakes = [true; 2];
                }
                (good, enough) = (good && holds, enough && nearly);
                rested = rested.max(law_residual);
                continue;
            }
            let before = self.constraints[index].gap;
            let (law, u) = self.evaluate(index, strands, options, step);
            let constraint = &self.constraints[index];
            let moved = (constraint.gap - before).abs();
            let law_residual = self.progress.report.law_residual(&law, u, constraint.force, step);
            self.progress.ending.residual = self.progress.ending.residual.max(law_residual);
            let (holds, nearly) = match law {
                Law::Bilateral(bilateral) => {
                    let off = bilateral.directions().map(|d| (d.dot(&u) + bilateral.compliance * d.dot(&constraint.force)).abs());
                    let off = off.fold(0.0, f64::max);
                    (off <= BILATERAL_TOLERANCE, off <= ENOUGH_BILATERAL)
                }
                Law::Ring(_) => (constraint.gap <= BILATERAL_TOLERANCE, constraint.gap <= ENOUGH_BILATERAL),
                Law::Contact(contact) => {
                    let yields = soft || constraint.deep || constraint.give != Give::No;
                    let gap = if yields { 0.0 } else { contact.gap(&u, &constraint.force, step) };
                    let exact = soft || constraint.give == Give::Much || law_residual <= asked;
                    let outside = self.phase.is_rough() || is_outside(gap, options);
                    (outside && exact, is_nearly_outside(gap, options))
                }
            };
            // (A constraint that does not hold may wait for any displacement of its resting strand, however small.)
            let motions = self.pushes_resting(index, strands);
            let wakes = motions.map(|motion| motion > if holds { REST * tolerance } else { 0.0 });
            // A resting strand that moves by no more than this stays within the tolerance.
            let waits = motions.iter().any(|motion| *motion > (1.0 - REST) * tolerance);
            self.constraints[index].standing = Standing { law_residual, holds, nearly, wakes };
            self.constraints[index].may_sleep(&law, &u, moved);
            (good, enough, wakes_some) = (good && holds, enough && nearly, wakes_some || waits);
        }
        let moving = self.strands.iter().filter(|strand| !strands[**strand as usize].rest.is_resting()).count();
        self.progress.spent += match () {
            () if self.progress.is_solved => moving as f64 / self.strands.len() as f64,
            () if self.strands.len() <= FEW && !self.has_bilateral() => UNSOLVED,
            () => 1.0,
        };
        let left = (residual / tolerance).max(self.progress.ending.residual / ROUGH);
        if left < 0.5 * self.progress.best.0 {
            self.progress.best = (left, self.progress.spent);
        }
        let open = self.strands.iter().filter(|strand| strands[**strand as usize].residual > tolerance).count()
            + self
                .constraints
                .iter()
                .filter(|constraint| !constraint.standing.holds || constraint.standing.wakes != [false; 2])
                .count();
        if open < self.progress.fewest.0.div_ceil(2) {
            self.progress.fewest = (open, self.progress.spent);
        }
        self.progress.law_residual = self.progress.ending.residual;
        // Resting constraints are reported as well, but nothing waits for them.
        self.progress.ending.residual = self.progress.ending.residual.max(rested);
        let beyond = self.is_beyond_measure(strands, step);
        let idle = !options.model.is_soft()
            && (residual <= STILL * tolerance_asked || self.progress.report.residual > HOPELESS * self.progress.report.size);
        self.progress.idle = if idle { self.progress.idle + 1 } else { 0 };
        // Bilateral constraints may turn a strand right round, a little in every iteration. An island that waits only for
        // resting strands makes progress: these are woken twice at most.
        let waits_only = good && wakes_some;
        let got_on = self.progress.best.1.max(self.progress.fewest.1);
        let large = self.strands.len() > FEW && !soft && !self.is_relaxed();
        let patience = PATIENCE[if enough { 0 } else { 2 - usize::from(large) }];
        let slow = !waits_only && !self.has_bilateral() && self.progress.spent >= got_on + patience;
        let stuck = slow || beyond || self.has_bilateral() && self.progress.idle > IDLE;
        let diverged = self.strands.iter().all(|strand| strands[*strand as usize].step.outcome.quarantined);
        // One contact slightly beyond the rough tolerance says nothing about the end.
        let good = good && !wakes_some || self.phase.is_rough() && slow && enough;
        let good = good && !self.push_on(strands, options, step);
        // The host chose to pay for this many iterations.
        let chosen = options.model.is_soft()
            && options.max_iterations <= MAX_CHOSEN_ITERATIONS
            && self.progress.iterations >= options.max_iterations;
        let ends = good || diverged || stuck || self.progress.iterations >= options.max_iterations;
        self.phase = if ends { self.phase.ended() } else { self.phase.resumed() };
        let is_far = |strand: &u32| strands[*strand as usize].residual > DIVERGED;
        // An island with yielding constraints has not converged, whatever its residual.
        self.progress.ending.outcome = match () {
            () if (good || chosen) && self.constraints.iter().all(|constraint| constraint.is_tight(options)) => {
                Outcome::Converged
            }
            () if good => Outcome::AttemptConverged,
            () if ends && (enough || chosen) => Outcome::GoodEnough,
            () if ends && self.is_relaxed() && self.strands.iter().any(is_far) => Outcome::Diverged,
            () => Outcome::Unconverged,
        };
    }

    /// Whether its forces have grown beyond measure: its contact problem has no solution.
    pub(super) fn is_beyond_measure(&self, strands: &(impl Strands + ?Sized), step: f64) -> bool {
        let largest = |contacts: bool| {
            let of = self.constraints.iter().filter(|constraint| constraint.is_contact() == contacts);
            of.map(|constraint| constraint.force.norm()).fold(0.0, f64::max)
        };
        let usual = self.usual_force(strands, step);
        largest(true) > NO_SOLUTION * usual
            || self.has_bilateral() && largest(false) > CANNOT_HOLD * (usual + self.bending_force(strands))
    }
}

impl StepConstraint {
    /// Whether it does not yield, or has been pushed to within a part of the tolerance.
    fn is_tight(&self, options: &ContactOptions) -> bool {
        self.give == Give::No && !(self.is_compliant() && self.off_by(options.tolerance) > TIGHT)
    }
}

/// Whether the gap of a contact is within the tolerance of a converged step.
pub(super) fn is_outside(gap: f64, options: &ContactOptions) -> bool {
    gap >= -0.5 * options.tolerance
}

/// The same for an island that makes no progress.
pub(super) fn is_nearly_outside(gap: f64, options: &ContactOptions) -> bool {
    gap >= -ENOUGH_DEPTH * options.tolerance
}
