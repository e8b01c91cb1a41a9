//! Newton iterations of all islands. Islands of one strand are independent of each other, and go pack by pack (`solitary.rs`);
//! those that couple strands go side by side, since a pack holds strands of several. So do all where work is short: what is
//! missing then is missing everywhere.

use super::constrained_strand::{ConstrainedStrand, Formula};
use super::coupled_step::{CoupledScene, CoupledStep, Scratch, Stepping};
use super::formula::restart;
use super::island::ending::Next;
use super::island::{Island, Turn};
use crate::memory::recycled;
use crate::meter::{Meter, Stopped};
use crate::platform::Instant;
use crate::step::options::Integrator;
use crate::workers::WorkerSet;

/// Islands with at least this many constraints are solved by all threads together.
const LARGE: usize = 1000;

/// Work is not short where as much as this many iterations of all strands take is left.
const AMPLE: u64 = 100;

/// What iterations of all islands have come to.
#[derive(Debug, Clone, Copy, Default)]
pub struct IterationTally {
    /// The largest number of an island's Newton iterations in the step.
    pub iterations: u32,
    /// Sweeps of all islands.
    pub sweeps: u64,
    /// Searches that found undetected contacts.
    pub searches: u32,
}

impl CoupledStep {
    /// Whether as much work is left as this many iterations of all strands take.
    pub(super) fn is_left(&self, iterations: u64, meter: &Meter) -> bool {
        let half = |constrained: &ConstrainedStrand| constrained.half_work_with(constrained.attachments.len());
        self.strands().iter().map(half).sum::<u64>() <= meter.left() / (2 * iterations)
    }

    /// At most `most` Newton iterations of all islands.
    pub(super) fn iterate<S: Scratch>(
        &mut self,
        stepping: &Stepping<S>,
        scene: &mut dyn CoupledScene,
        tally: &mut IterationTally,
        most: u32,
    ) {
        let is_ample = self.is_left(AMPLE, stepping.meter);
        let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
        for island in islands.iter_mut() {
            let is_alone = is_ample && island.strands.len() == 1;
            island.turn = if is_alone { Turn::Alone { iterations_left: most } } else { Turn::WithOthers };
        }
        self.packs.forget_mixed_look_ahead(strands, islands);
        self.iterate_solitary(stepping, scene);
        self.iterate_coupled(stepping, scene, most);
        // Here and not at the end of the substep: the next search forms new islands.
        for island in &mut self.islands[..self.island_count] {
            tally.iterations = tally.iterations.max(island.progress.iterations);
            tally.sweeps += u64::from(std::mem::take(&mut island.sweeps));
        }
    }

    /// Those of islands whose strands are not solitary.
    fn iterate_coupled<S: Scratch>(&mut self, stepping: &Stepping<S>, scene: &mut dyn CoupledScene, most: u32) {
        let Stepping { setting, options, bodies, workers, meter, h } = *stepping;
        let Self { strands, islands, packs, count, island_count, contact_seconds, at_work, .. } = self;
        let (strands, islands) = (&mut strands[..*count], &mut islands[..*island_count]);
        if islands.iter().all(|island| island.turn.is_alone()) {
            return;
        }
        for _ in 0..most {
            let stopped = meter.stopped();
            if stopped != Stopped::No {
                islands.iter_mut().filter(|island| !island.turn.is_alone()).for_each(|island| island.stop(stopped));
                break;
            }
            let coupled = islands.iter_mut().filter(|island| !island.turn.is_alone());
            for island in coupled.filter(|island| island.phase.has_ended() && island.progress.ending.stopped == Stopped::No) {
                let kinks = island.kinks(strands, options);
                if !kinks.is_empty() {
                    for kink in &kinks {
                        let constrained = &mut strands[kink.strand as usize];
                        constrained.bend(kink, setting, packs.pack(constrained));
                    }
                    island.go_on();
                    continue;
                }
                if island.try_again(strands, options, h) == Next::BeginsAgain {
                    for constrained in &island.strands {
                        strands[*constrained as usize].formula = Formula::ToBeginAgain;
                    }
                }
            }
            let goes = |island: &Island| !island.turn.is_alone() && !island.phase.has_ended();
            if !islands.iter().any(goes) {
                break;
            }
            restart(packs, strands, meter, scene);
            workers.for_each(islands, |island, _| {
                if goes(island) && !meter.is_halted() {
                    island.refresh(strands, bodies);
                }
            });
            packs.linearise(strands, islands, workers, meter, |constrained| goes(&islands[constrained.island as usize]));
            let begins = Instant::now();
            distribute_work(islands, goes, meter.left());
            // Large islands one after the other, each by all threads; then the others in parallel, the largest first, as a few
            // take longer than all the others.
            let mut to_solve: Vec<&mut Island> = recycled(std::mem::take(at_work));
            to_solve.extend(islands.iter_mut().filter(|island| goes(island)));
            to_solve.sort_unstable_by_key(|island| std::cmp::Reverse(island.constraints.len()));
            let large = to_solve.partition_point(|island| island.constraints.len() >= LARGE);
            let (large, small) = to_solve.split_at_mut(large);
            let solve = |island: &mut Island, scratch: &mut S, workers: &WorkerSet<S>| {
                island.find_ends(strands);
                island.solve_or_diverge(strands, options, h, scratch.as_mut(), workers, meter);
            };
            for island in large {
                workers.with_own_scratch(|scratch| solve(island, scratch, workers));
            }
            let alone = WorkerSet::serial();
            workers.for_each_task(small, 1, 1, |islands, scratch| {
                for island in islands {
                    solve(island, scratch, &alone);
                }
            });
            *at_work = recycled(to_solve);
            *contact_seconds += begins.elapsed().as_secs_f64();
            if setting.options.integrator == Integrator::SecondOrder {
                for island in islands.iter().filter(|island| goes(island) && island.progress.iterations < options.max_iterations)
                {
                    Self::begin_pressed_again(island, strands);
                }
            }
            packs.advance(strands, islands, setting, workers, meter, |constrained| goes(&islands[constrained.island as usize]));
            if meter.is_halted() {
                continue;
            }
            workers.for_each(islands, |island, _| {
                if goes(island) {
                    island.check(strands, options, setting.options.tolerance, h);
                }
            });
        }
    }
}

/// Distributes the work that is `left` among the islands that go on, by their numbers of constraints.
pub(super) fn distribute_work(islands: &mut [Island], goes: impl Fn(&Island) -> bool, left: u64) {
    let weight = |island: &Island| (island.constraints.len() + 1) as f64;
    let all: f64 = islands.iter().filter(|island| goes(island)).map(weight).sum();
    for island in islands.iter_mut().filter(|island| goes(island)) {
        island.max_work = (left as f64 * (weight(island) / all)) as u64;
    }
}
