//! The stages of a coupled step and their order. The scene begins the strands' steps before them; after them it reads where the strands
//! end, has islands that have failed take the substep in substeps, and reports.

use super::constrained_strand::ConstrainedStrand;
use super::contact_limit;
use super::coupled_step::{CoupledScene, CoupledStep, Scratch, Stepping};
use super::detection::{SearchFor, unseen};
use super::iterations::IterationTally;
use crate::meter::Stopped;
use crate::platform::Instant;

/// The largest number of searches for undetected contacts.
const MAX_SEARCHES: u32 = 16;
/// The first searches follow after this many Newton iterations: most new contacts are visible by then, and need not wait until
/// the others are exact. (Sooner, contacts of a mere first guess would be kept, and the energy of long runs grows.)
const EARLY: u32 = 2;
const EARLY_ITERATIONS: u32 = 2;

/// This search lets go of contacts that press strands which are no longer beside each other there, where as much work as this many
/// iterations of all strands take is left. (Iterates at the first search are still far from their ends. After later ones all would be
/// solved a second time.)
const LETS_GO: u32 = 1;
const LETS_GO_ITERATIONS: u64 = 20;

/// Cost of a constraint found by a search, nanoseconds or so.
const WORK_A_CONSTRAINT: u64 = 1000;

/// A stage of a coupled step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// The contacts at the start of the step are detected; they begin with the forces of the last step.
    Detection,
    /// Strands that constraints couple form islands.
    Coupling,
    /// Strands that would run into something begin again by implicit Euler.
    Prediction,
    /// Newton's iterations of all islands, with further attempts where they fail: all to their end, or a few before an early search.
    /// Strands at equilibrium rest meanwhile.
    Iteration,
    /// Contacts that the iterations have brought about are searched for. What is new is added, and strands are coupled again; if
    /// nothing is, islands that were solved roughly iterate on.
    Search,
    /// No more contacts may be added: what a last search finds is reported.
    LastSearch,
    /// Ends whose energy has risen are rejected.
    Rejection,
    /// Strands that a soft model has left deep in bodies are brought out.
    DeepStrands,
    /// The depth that is left is measured, with the hard models where the step has failed.
    Depths,
}

/// Iterations and searches alternate in rounds.
#[derive(Debug)]
struct Round {
    /// Searches done.
    search: u32,
    /// Their limit.
    searches: u32,
    /// Whether islands are solved roughly.
    rough: bool,
}

impl CoupledStep {
    /// Takes the strands of a `scene`, whose step has begun, through all stages. Returns when the iterations began, where time is
    /// limited.
    pub fn run<S: Scratch>(
        &mut self,
        stepping: &Stepping<S>,
        scene: &mut dyn CoupledScene,
        is_last: bool,
        tally: &mut IterationTally,
    ) -> Option<Instant> {
        let searches = self.searches(stepping);
        // The solve is rough until a search finds nothing new: a contact detected later would undo an exact solution.
        let mut round = Round { search: 0, searches, rough: searches > 0 };
        let mut stage = Some(Stage::Detection);
        let mut begins = None;
        while let Some(present) = stage {
            if present == Stage::Iteration && begins.is_none() && stepping.meter.has_deadline() {
                begins = Some(Instant::now());
            }
            stage = match present {
                Stage::Detection => self.detect(stepping, scene),
                Stage::Coupling => self.couple(&round),
                Stage::Prediction => self.predict(stepping, scene),
                Stage::Iteration => self.iterate_round(stepping, scene, &mut round, tally),
                Stage::Search => self.search(stepping, &mut round, tally),
                Stage::LastSearch => self.search_last(stepping),
                Stage::Rejection => self.reject(stepping, is_last),
                Stage::DeepStrands => self.bring_deep_out(stepping, scene, tally),
                Stage::Depths => self.measure_depths(stepping),
            };
        }
        begins
    }

    /// The contacts at the start of the step and the scene's bilateral constraints: as constraints that belong to no island yet.
    fn detect<S: Scratch>(&mut self, stepping: &Stepping<S>, scene: &mut dyn CoupledScene) -> Option<Stage> {
        let strands = &mut self.strands[..self.count];
        self.constraints.clear();
        self.detection.find(stepping, strands, SearchFor::Start);
        if !stepping.meter.is_halted() {
            self.detection.constraints(stepping, strands, &mut self.constraints);
        }
        contact_limit::thin_out(&mut self.constraints, strands, &mut [], stepping.meter.left());
        scene.add_bilateral(strands, &mut self.constraints);
        stepping.meter.spend(self.constraints.len() as u64 * WORK_A_CONSTRAINT);
        Some(Stage::Coupling)
    }

    /// Couples the strands by all constraints.
    fn couple(&mut self, round: &Round) -> Option<Stage> {
        self.tie(round.rough);
        Some(if round.search == 0 { Stage::Prediction } else { Stage::Iteration })
    }

    /// Has strands that would run into something begin again by implicit Euler.
    fn predict<S: Scratch>(&mut self, stepping: &Stepping<S>, scene: &mut dyn CoupledScene) -> Option<Stage> {
        self.predict_pressed(stepping, scene);
        Some(Stage::Iteration)
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

    /// Newton's iterations of all islands until the next search.
    fn iterate_round<S: Scratch>(
        &mut self,
        stepping: &Stepping<S>,
        scene: &mut dyn CoupledScene,
        round: &mut Round,
        tally: &mut IterationTally,
    ) -> Option<Stage> {
        let most = if round.search < EARLY.min(round.searches) { EARLY_ITERATIONS } else { u32::MAX };
        self.iterate(stepping, scene, tally, most);
        if round.search < round.searches {
            let stopped = stepping.meter.stopped();
            if stopped == Stopped::No {
                return Some(Stage::Search);
            }
            self.stop(stopped);
            return Some(Stage::Rejection);
        }
        if std::mem::take(&mut round.rough) && self.refine() {
            return Some(Stage::Iteration);
        }
        Some(if round.searches > 0 && !stepping.meter.is_halted() { Stage::LastSearch } else { Stage::Rejection })
    }

    /// Searches for contacts that no constraint represents, and adds them.
    fn search<S: Scratch>(&mut self, stepping: &Stepping<S>, round: &mut Round, tally: &mut IterationTally) -> Option<Stage> {
        let lets_go = round.search == LETS_GO && self.is_left(LETS_GO_ITERATIONS, stepping.meter);
        let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
        self.detection.find(stepping, strands, SearchFor::Overlaps);
        if stepping.meter.is_halted() {
            return self.interrupt(stepping);
        }
        let more = self.detection.add_undetected(stepping, strands, islands, &mut self.constraints, lets_go);
        if more.is_none() && stepping.meter.is_halted() {
            return self.interrupt(stepping);
        }
        round.search += 1;
        if let Some(found) = more {
            tally.searches += u32::from(found > 0);
            contact_limit::thin_out(&mut self.constraints, strands, islands, stepping.meter.left());
            return Some(Stage::Coupling);
        }
        if self.is_done() && !(std::mem::take(&mut round.rough) && self.refine()) {
            return Some(Stage::Rejection);
        }
        Some(Stage::Iteration)
    }

    /// The last search: no more contacts are added, and what there is is reported.
    fn search_last<S: Scratch>(&mut self, stepping: &Stepping<S>) -> Option<Stage> {
        let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
        self.detection.find(stepping, strands, SearchFor::Overlaps);
        if stepping.meter.is_halted() || !self.detection.report_undetected(stepping, strands, islands) {
            return self.interrupt(stepping);
        }
        Some(Stage::Rejection)
    }

    /// A search was halted: strands that it has not reached may have undetected contacts.
    fn interrupt<S>(&mut self, stepping: &Stepping<S>) -> Option<Stage> {
        let (why, unseen) = (stepping.meter.stopped(), unseen(stepping.options));
        self.stop(why);
        let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
        for constrained in strands.iter_mut().filter(|constrained| constrained.has_gone(unseen)) {
            constrained.has_undetected = true;
            islands[constrained.island as usize].interrupt(why);
        }
        Some(Stage::Rejection)
    }

    /// Rejects ends whose energy has risen.
    fn reject<S>(&mut self, stepping: &Stepping<S>, is_last: bool) -> Option<Stage> {
        if !stepping.options.model.is_soft() {
            let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
            islands.iter_mut().for_each(|island| island.reject_risen(strands, stepping.h));
            #[cfg(test)]
            for strand in strands.iter_mut().filter(|strand| Some(strand.index) == self.risen) {
                islands[strand.island as usize].progress.ending.reject(strand);
            }
            return Some(Stage::Depths);
        }
        // Soft models search only at the start.
        (is_last && self.detection.is_possible(stepping)).then_some(Stage::DeepStrands)
    }

    /// Brings strands that a soft model has left deep out of bodies.
    fn bring_deep_out<S: Scratch>(
        &mut self,
        stepping: &Stepping<S>,
        scene: &mut dyn CoupledScene,
        tally: &mut IterationTally,
    ) -> Option<Stage> {
        self.bring_out(stepping, scene, tally);
        Some(Stage::Depths)
    }

    /// Measures how deep strands are left, at no cost to the budget: whatever was cut short is reported.
    fn measure_depths<S: Scratch>(&mut self, stepping: &Stepping<S>) -> Option<Stage> {
        stepping.meter.uncounted(|| self.look_at_failures(stepping));
        None
    }

    /// Measures the depth of islands that have not converged or are held apart by springs, and of overlap that no constraint
    /// represents. Their constraints only tell the depth where the contacts were found.
    fn look_at_failures<S: Scratch>(&mut self, stepping: &Stepping<S>) {
        let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
        if stepping.meter.is_halted() {
            return;
        }
        let is_looked_at = |constrained: &ConstrainedStrand| {
            constrained.left_deep || constrained.lags() || islands[constrained.island as usize].failed()
        };
        if stepping.options.model.is_soft() {
            // Bodies have been searched.
            self.detection.find_deeper_hair(stepping, strands, islands);
        } else if self.detection.is_possible(stepping) && strands.iter().any(is_looked_at) {
            for constrained in strands.iter_mut() {
                constrained.step.gone = if is_looked_at(constrained) { f64::INFINITY } else { 0.0 };
            }
            self.detection.find(stepping, strands, SearchFor::Overlaps);
        } else {
            return;
        }
        self.detection.report_depths(stepping, strands, islands, true);
        if stepping.meter.is_halted() || !strands.iter().any(ConstrainedStrand::lags) {
            return;
        }
        // Bodies that still follow a strand are there all the same.
        for constrained in strands.iter_mut() {
            constrained.look_around(stepping.bodies);
            constrained.step.gone = if constrained.lags() { f64::INFINITY } else { 0.0 };
        }
        self.detection.find(stepping, strands, SearchFor::OverlapsInPlace);
        self.detection.report_depths(stepping, strands, islands, false);
    }
}
