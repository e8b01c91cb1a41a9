//! Strands that a soft model has left deep in bodies. Springs are found at the start of a step, and few iterations move strands past them; those
//! that end deep take more iterations by themselves, with the contacts where they are now, among others that stay where they are.

use super::constrained_strand::{Attachment, ConstrainedStrand, Rest};
use super::coupled_step::{CoupledScene, CoupledStep, Scratch, Stepping};
use super::detection::{SearchFor, unseen};
use super::island::Island;
use super::island::convergence::SOFT_TOLERANCE;
use super::island::ending::Ending;
use super::iterations::IterationTally;
use crate::contact::constraint::step_constraint::StepConstraint;
use crate::contact::options::{ContactOptions, MAX_CHOSEN_ITERATIONS};
use crate::meter::Stopped;

/// A strand is deep that is deeper in a body than the springs that push it out account for, by more than this many contact tolerances.
const DEEP: f64 = 5.0;
/// Iterations that deep strands take by themselves, unless the step has more: most are out of the body after three.
const ITERATIONS: u32 = 6;
/// How often they do: a strand that is out in one place may have come in in another.
const ROUNDS: u32 = 4;

/// A deep strand.
#[derive(Debug, Clone, Copy)]
struct Deep {
    /// Its number among the constrained strands.
    strand: u32,
    /// How much deeper it is than its springs account for, m.
    depth: f64,
    /// How the iteration of its island has ended.
    ending: Ending,
}

impl CoupledStep {
    /// Brings strands out of bodies in which they are deep, the deepest first, as far as the budget allows and for no more than the step's own
    /// iterations have cost.
    pub(super) fn bring_out<S: Scratch>(
        &mut self,
        stepping: &Stepping<S>,
        scene: &mut dyn CoupledScene,
        tally: &mut IterationTally,
    ) {
        let meter = stepping.meter;
        if meter.is_halted() {
            return;
        }
        let options = ContactOptions { max_iterations: stepping.options.max_iterations.max(ITERATIONS), ..*stepping.options };
        let further = Stepping { options: &options, ..*stepping };
        let strands = &mut self.strands[..self.count];
        strands.iter_mut().for_each(ConstrainedStrand::search_all_of_it);
        let own = stepping.options.max_iterations.min(MAX_CHOSEN_ITERATIONS);
        let mut allowance = strands.iter().map(|constrained| work(constrained, own)).sum::<u64>();
        for round in 0..=ROUNDS {
            let strands = &mut self.strands[..self.count];
            meter.uncounted(|| self.detection.find(stepping, strands, SearchFor::OverlapsWithBodies));
            if round == ROUNDS || meter.is_halted() {
                return;
            }
            let mut deep = deep_strands(strands, &self.islands, stepping.options);
            let available = allowance.min(meter.left());
            let mut left = available;
            deep.retain(|deep| {
                let work = work(&strands[deep.strand as usize], options.max_iterations);
                let is_allowed = work <= left;
                left -= if is_allowed { work } else { 0 };
                is_allowed
            });
            if deep.is_empty() || !self.free(&deep, stepping) {
                return;
            }
            allowance -= available - left;
            self.iterate(&further, scene, tally, u32::MAX);
            self.settle(&deep, stepping.options);
            let moved =
                self.strands[..self.count].iter_mut().filter(|constrained| constrained.has_gone(unseen(stepping.options)));
            moved.for_each(ConstrainedStrand::search_all_of_it);
        }
    }

    /// Couples these strands again, with what they overlap with now; all others of their islands stay where they are. False if the meter has
    /// halted it.
    fn free<S>(&mut self, deep: &[Deep], stepping: &Stepping<S>) -> bool {
        let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
        let mut numbers: Vec<u32> = deep.iter().map(|deep| deep.strand).collect();
        numbers.sort_unstable();
        if !self.detection.add_undetected_of(&numbers, stepping, strands, islands, &mut self.constraints) {
            return false;
        }
        self.tie(false);
        for strand in &numbers {
            let Island { strands, .. } = &self.islands[self.strands[*strand as usize].island as usize];
            strands.iter().for_each(|other| self.strands[*other as usize].rest = Rest::Held);
        }
        for strand in numbers {
            self.strands[strand as usize].rest = Rest::Active;
        }
        true
    }

    /// They have ended where they are now; others of their islands count as they did before. A strand that has not converged counts as one that
    /// may overlap yet, unless the host chose to pay for so many iterations.
    fn settle(&mut self, deep: &[Deep], options: &ContactOptions) {
        let chosen = options.max_iterations <= MAX_CHOSEN_ITERATIONS;
        for Deep { strand, ending: before, .. } in deep {
            let constrained = &mut self.strands[*strand as usize];
            constrained.has_undetected |= !chosen && (constrained.residual > SOFT_TOLERANCE || constrained.residual.is_nan());
            let island = &mut self.islands[self.strands[*strand as usize].island as usize];
            let ending = &mut island.progress.ending;
            (ending.outcome, ending.stopped) = (before.outcome, before.stopped);
            for other in &island.strands {
                let rest = &mut self.strands[*other as usize].rest;
                *rest = if *rest == Rest::Held { Rest::Active } else { *rest };
            }
        }
    }
}

/// The strands that are deep in bodies by the last search, the deepest first.
fn deep_strands(strands: &[ConstrainedStrand], islands: &[Island], options: &ContactOptions) -> Vec<Deep> {
    // (Of islands that have diverged some strands stay as they were when the step began.)
    let stays = |constrained: &ConstrainedStrand| {
        let island = &islands[constrained.island as usize];
        !constrained.step.outcome.quarantined && !island.is_diverged() && island.progress.ending.stopped == Stopped::No
    };
    let numbered = strands.iter().enumerate().filter(|(_, constrained)| stays(constrained));
    let all = numbered.map(|(strand, constrained)| {
        let island = &islands[constrained.island as usize];
        let deepest = constrained.found.iter().fold(0.0, |deepest: f64, contact| deepest.max(-contact.gap));
        let depth = if deepest > 0.0 { deepest - spring_depth(constrained, island, options) } else { 0.0 };
        Deep { strand: strand as u32, depth, ending: island.progress.ending }
    });
    let mut deep: Vec<Deep> = all.filter(|deep| deep.depth > DEEP * options.tolerance).collect();
    deep.sort_by(|a, b| b.depth.total_cmp(&a.depth));
    deep
}

/// The largest depth in bodies to which the springs on a strand correspond, m.
fn spring_depth(constrained: &ConstrainedStrand, island: &Island, options: &ContactOptions) -> f64 {
    let constraint = |end: &Attachment| &island.constraints[end.constraint as usize];
    let with_bodies = constrained.attachments.iter().map(constraint).filter(|constraint| constraint.second.is_none());
    with_bodies.map(StepConstraint::pressure).fold(0.0, f64::max) / options.stiffness
}

/// What so many iterations of a strand cost, nanoseconds or so.
fn work(constrained: &ConstrainedStrand, iterations: u32) -> u64 {
    2 * u64::from(iterations) * constrained.half_work_with(constrained.attachments.len())
}
