//! The step of coupled strands: the strands that are constrained in it, their constraints, and their islands, since constraints
//! couple strands, directly or through others.

use super::constrained_strand::{ConstrainedStrand, Rest};
use super::detection::{ContactDetection, ContactMemory};
use super::island::Island;
use super::island::problem::ProblemScratch;
use super::packs::{Packs, Work};
use super::solitary::Member;
use crate::contact::body_at::BodyAt;
use crate::contact::constraint::step_constraint::StepConstraint;
use crate::contact::options::ContactOptions;
use crate::math::disjoint_sets::DisjointSets;
use crate::meter::{Meter, Stopped};
use crate::step::Setting;
use crate::workers::WorkerSet;

/// What the step of coupled strands needs beside them.
pub struct Stepping<'a, S> {
    /// The setting of the strands' steps.
    pub setting: &'a Setting<'a>,
    /// The options of contact.
    pub options: &'a ContactOptions,
    /// The bodies, as they move in the step.
    pub bodies: &'a [BodyAt<'a>],
    /// The workers, with their scratch memory.
    pub workers: &'a WorkerSet<S>,
    /// The budget of the step.
    pub meter: &'a Meter<'a>,
    /// The step, s.
    pub h: f64,
}

/// A worker's scratch memory, with that of contact problems.
pub trait Scratch: Default + Send + AsMut<ProblemScratch> {}

impl<S: Default + Send + AsMut<ProblemScratch>> Scratch for S {}

impl<S> Clone for Stepping<'_, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S> Copy for Stepping<'_, S> {}

/// What owns the strands' states and the bilateral constraints.
pub trait CoupledScene {
    /// Adds the constraints that the scene's bilateral constraints put on the `strands` in this step.
    fn add_bilateral(&self, strands: &[ConstrainedStrand], constraints: &mut Vec<StepConstraint>);
    /// Begins the step of the strands that are [`Formula::ToBeginAgain`](super::constrained_strand::Formula) again, by implicit
    /// Euler.
    fn begin_again(&mut self, packs: &mut Packs, strands: &mut [ConstrainedStrand]);
}

/// The constrained strands of a step, their contacts and their islands. Memory is kept from step to step.
#[derive(Debug, Default)]
pub struct CoupledStep {
    /// The constrained strands; more may be kept for their memory.
    pub(super) strands: Vec<ConstrainedStrand>,
    pub(super) count: usize,
    pub(super) packs: Packs,
    pub(super) islands: Vec<Island>,
    /// Memory for the islands before they are formed again.
    pub(super) former: Vec<Island>,
    pub(super) island_count: usize,
    /// Memory for lists of islands, and of packs.
    pub(super) at_work: Vec<&'static mut Island>,
    pub(super) solitary_work: Vec<Work<'static, Member<'static>>>,
    /// Islands with strands that may have to begin again by the other formula, and those strands.
    pub(super) asked: Vec<bool>,
    pub(super) pressed: Vec<u32>,
    /// Time of contact problems since it was last read, s.
    pub(super) contact_seconds: f64,
    pub(super) detection: ContactDetection,
    /// Those that belong to no island yet.
    pub(super) constraints: Vec<StepConstraint>,
    pub(super) sets: DisjointSets,
    /// The largest number of searches for undetected contacts, if not the usual one.
    #[cfg(test)]
    pub max_searches: Option<u32>,
    /// A strand whose energy counts as risen, by its index in the solver.
    #[cfg(test)]
    pub risen: Option<u32>,
}

/// The parts of coupled strands, borrowed side by side.
#[derive(Debug)]
pub struct CoupledParts<'a> {
    /// Their packs.
    pub packs: &'a mut Packs,
    /// The strands.
    pub strands: &'a mut [ConstrainedStrand],
    /// Their islands.
    pub islands: &'a mut [Island],
}

impl CoupledStep {
    /// Makes room for `count` strands of a new step, as the last step left them.
    pub fn begin(&mut self, count: usize) {
        self.count = count;
        self.strands.resize_with(self.strands.len().max(count), ConstrainedStrand::default);
        self.strands[..count].iter_mut().for_each(|constrained| constrained.attachments.clear());
        self.island_count = 0;
        self.packs.clear();
    }

    /// The strands.
    pub fn strands(&self) -> &[ConstrainedStrand] {
        &self.strands[..self.count]
    }

    /// The islands.
    pub fn islands(&self) -> &[Island] {
        &self.islands[..self.island_count]
    }

    /// All of it.
    pub fn parts(&mut self) -> CoupledParts<'_> {
        CoupledParts {
            packs: &mut self.packs,
            strands: &mut self.strands[..self.count],
            islands: &mut self.islands[..self.island_count],
        }
    }

    /// The island of a strand.
    pub fn island_of(&self, strand: usize) -> &Island {
        &self.islands[self.strands[strand].island as usize]
    }

    /// The time of searches and of contact problems since it was last read, s.
    pub fn take_seconds(&mut self) -> [f64; 2] {
        [self.detection.take_seconds(), std::mem::take(&mut self.contact_seconds)]
    }

    /// What is kept of contacts from step to step.
    pub fn detection(&mut self) -> &mut ContactDetection {
        &mut self.detection
    }

    /// The contacts kept from the last step.
    pub fn memory(&self) -> ContactMemory {
        self.detection.memory()
    }

    /// Stores the contacts' forces as the warm start of the next step, except those of islands that are subdivided.
    pub fn store_warm_start(&mut self) {
        let islands = self.islands[..self.island_count].iter().filter(|island| !island.is_subdivided());
        self.detection.store_warm_start(islands, &self.strands);
    }

    /// Ends all islands where they are, unless they have converged.
    pub fn stop(&mut self, why: Stopped) {
        self.islands[..self.island_count].iter_mut().for_each(|island| island.stop(why));
    }

    /// Whether nothing is left to do for any island.
    pub fn is_done(&self) -> bool {
        self.islands().iter().all(|island| island.phase.has_ended() && !island.is_to_be_tried_again())
    }

    /// Goes on with islands that were solved roughly. True if there is more to do.
    pub fn refine(&mut self) -> bool {
        let mut goes_on = false;
        for island in &mut self.islands[..self.island_count] {
            if island.refine() {
                goes_on = true;
                for constrained in &island.strands {
                    let constrained = &mut self.strands[*constrained as usize];
                    (constrained.ended, constrained.rest) = (None, Rest::Active);
                }
            }
        }
        goes_on
    }
}
