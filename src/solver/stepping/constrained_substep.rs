//! The substep of constrained strands: their contacts are detected, they are coupled into islands and stepped together, Newton
//! iteration by Newton iteration. Strands do the two halves of an iteration on any thread, and islands solve their contact
//! problems in between; no result depends on the threads.
//!
//! Files:
//!
//! - `account.rs`: The results of a constrained substep: the outcomes of strands, the list of contacts, the loads of bodies and bilateral constraints.
//! - `packs.rs`: Constrained strands side by side with the scene's strands: how their step begins and ends, pack by pack (`coupled/packs.rs`).
//! - `substeps.rs`: Substeps of a substep: islands that have not converged repeat it in two halves if contacts are left deep, and always if they are small.
//! - `tests.rs`: Substeps in which the limit of searches is reached before all contacts are found (sixteen searches hardly ever are too few: here the limit is one or two), and substeps within them whose strands meet others that they do not see.

mod account;
mod packs;
mod substeps;
#[cfg(test)]
mod tests;

pub(in crate::solver) use account::Account;
pub use account::ContactTally;

use super::workers::{WorkerScratch, WorkerSet};
use crate::contact::body::Body;
use crate::contact::body_at::BodyAt;
use crate::contact::constraint::step_constraint::StepConstraint;
use crate::contact::options::{ContactModel, ContactOptions};
use crate::coupled::constrained_strand::{ConstrainedStrand, Formula, LookAhead, Meets, Rest, StrandEnd};
use crate::coupled::coupled_step::{CoupledParts, CoupledScene, CoupledStep, Stepping};
use crate::coupled::detection::ContactMemory;
use crate::coupled::island::ending::Outcome;
use crate::coupled::iterations::IterationTally;
use crate::coupled::packs::{Packs, Work};
use crate::math::lanes::InstructionSet;
use crate::meter::{Meter, Stopped};
use crate::platform::Instant;
use crate::solver::bodies::Contact;
use crate::solver::constraints::ties::ties;
use crate::solver::constraints::{Constraint, ConstraintStatus};
use crate::solver::id::{BodyId, SlotMap, StrandId};
use crate::solver::report::Phases;
use crate::solver::strands::strand::{Constrained, Strand};
use crate::step::constrained::packs::AnyPack;
use crate::step::{Setting, StrandOutcome};
use packs::{Pair, PairWork};

/// A strand whose iteration was cut short moves with its root if it is further from convergence than this, rad: halfway,
/// strands of a tangle would be flung about.
const NEAR_END: f64 = 0.03;

/// The solver's memory of constrained strands between substeps.
#[derive(Debug, Default)]
pub(in crate::solver) struct ConstrainedSubstep {
    /// The constrained strands of the last substep, and their islands.
    coupled: CoupledStep,
    /// Memory for lists of packs with the scene's strands.
    pairs: PairWork,
    contacts: Vec<Contact>,
    /// The last substep's time beside its iterations, s.
    overhead: Overhead,
    /// Strands (by index) that substeps have not solved, of the host's present substep.
    unsolved: Vec<u32>,
    /// Takes the substeps of a substep, see `substeps.rs`.
    shorter: Option<Box<ConstrainedSubstep>>,
}

/// A substep's time beside its iterations, s.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::solver) struct Overhead {
    /// Before them.
    pub begin: f64,
    /// After them.
    pub end: f64,
}

/// The input of a constrained substep.
pub(in crate::solver) struct Scene<'a> {
    pub strands: &'a mut [Strand],
    pub slots: &'a SlotMap<StrandId>,
    pub constraints: &'a mut [Constraint],
    pub bodies: &'a [BodyAt<'a>],
    /// Copies of the moving bodies, ready for the substep.
    pub copies: &'a (dyn Fn() -> Vec<Body> + Sync),
    pub body_ids: &'a [BodyId],
    pub options: &'a ContactOptions,
    pub setting: &'a Setting<'a>,
    /// The instruction set of packs.
    pub set: InstructionSet,
    pub workers: &'a WorkerSet,
    /// The budget of the substep.
    pub meter: &'a Meter<'a>,
    /// Whether it is the last one of its call: penalty models report the depth of overlap for that one.
    pub is_last: bool,
    /// Whether a body moves far among strands in it: it is one of several substeps made for that.
    pub is_fast: bool,
    /// Whether it is a substep within a substep: strands outside it are already at the end of the whole.
    pub is_nested: bool,
    /// It is not halved again once the meter has counted this much, see `substeps.rs`.
    pub halving_ends: u64,
}

impl<'a> Scene<'a> {
    /// What the iterations of a substep of `h` seconds need of it.
    fn stepping(&self, h: f64) -> Stepping<'a, WorkerScratch> {
        let Self { setting, options, bodies, workers, meter, .. } = *self;
        Stepping { setting, options, bodies, workers, meter, h }
    }
}

impl Strand {
    /// Whether hair or one of the bodies may constrain it in a substep of `h` seconds.
    #[inline]
    fn may_be_constrained(&self, bodies: &[BodyAt], options: &ContactOptions, h: f64) -> Constrained {
        let Some(contact) = self.contact.as_deref() else { return Constrained::No };
        // It still meets the bodies that passed it while it was elsewhere.
        let at_points = options.model == ContactModel::AtPoints;
        if !at_points && !self.bodies_from().is_empty() || options.hair && contact.wisp_radius > 0.0 {
            return Constrained::Yes;
        }
        let around = self.reach(contact, &self.root_during(h));
        let is_near = bodies.iter().any(|body| body.meets(contact.groups, contact.mask) && body.is_near(&around));
        match (is_near, at_points) {
            (false, _) => Constrained::No,
            (true, true) => Constrained::AtPoints,
            (true, false) => Constrained::Perhaps,
        }
    }
}

impl ConstrainedSubstep {
    /// The contacts with a force at the end of the last substep.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// Adds a contact to those of the last substep.
    pub fn add_contact(&mut self, contact: Contact) {
        self.contacts.push(contact);
    }

    /// A substep's time beside its iterations, as far as it is known.
    pub fn overhead(&self) -> Overhead {
        self.overhead
    }

    /// The time of searches and contact problems since it was last read, s.
    pub fn take_phases(&mut self) -> Phases {
        let [search, contact] = self.coupled.take_seconds();
        let mut phases = Phases { search, contact, ..Phases::default() };
        if let Some(shorter) = &mut self.shorter {
            phases.add(&shorter.take_phases());
        }
        phases
    }

    /// Forgets the last substep's contacts: the indices of strands or bodies have changed.
    pub fn forget(&mut self) {
        self.coupled.detection().forget();
        self.contacts.clear();
    }

    /// Forgets the contacts of the last substep: there are none in this one.
    pub fn forget_contacts(&mut self) {
        self.contacts.clear();
    }

    /// Begins a substep of the host's, which may be taken in parts.
    pub fn begin_whole(&mut self) {
        self.unsolved.clear();
    }

    /// Forgets which strands are near each other.
    pub fn forget_pairs(&mut self) {
        self.coupled.detection().forget_pairs();
    }

    /// The contacts kept from the last substep.
    pub fn memory(&self) -> ContactMemory {
        self.coupled.memory()
    }

    /// A solver's memory restored: `None` if it does not belong to the scene, of which `elements` gives the lengths of a strand's
    /// elements.
    pub fn taken_up<'a>(memory: ContactMemory, elements: impl Fn(u32) -> Option<&'a [f64]>, bodies: usize) -> Option<Self> {
        let mut new = Self::default();
        new.coupled.detection().take_up(memory, elements, bodies).then_some(new)
    }

    /// Marks the strands that are constrained in this substep of `h` seconds. True if some may be constrained only by a body
    /// near them.
    pub fn mark(scene: &mut Scene, h: f64) -> bool {
        let mut are_near = false;
        for strand in scene.strands.iter_mut() {
            strand.constrained =
                if strand.is_aside() { Constrained::No } else { strand.may_be_constrained(scene.bodies, scene.options, h) };
            are_near |= strand.constrained == Constrained::Perhaps;
        }
        for constraint in scene.constraints.iter().filter(|constraint| constraint.state.status != ConstraintStatus::Released) {
            let ends = [Some(constraint.def.strand), constraint.other()];
            for index in ends.into_iter().flatten().filter_map(|id| scene.slots.index(id)) {
                let strand = &mut scene.strands[index];
                strand.constrained = if strand.is_aside() { Constrained::No } else { Constrained::Yes };
            }
        }
        are_near
    }

    /// Takes the marked strands through a substep of `h` seconds. Those left deep may take it in substeps, halved at most
    /// `levels` times.
    pub fn take(&mut self, scene: &mut Scene, h: f64, levels: u32, mut account: Account) {
        let begins = scene.meter.has_deadline().then(Instant::now);
        self.coupled.begin(scene.strands.iter().filter(|strand| strand.is_constrained()).count());
        for constraint in scene.constraints.iter_mut() {
            constraint.motion.begin(h);
        }
        self.begin(scene, h);
        let stepping = scene.stepping(h);
        self.coupled.detection().begin_step(ties(scene.constraints, |id| scene.slots.index(id)));
        let mut tally = IterationTally::default();
        let is_last = scene.is_last;
        let iterates = self.coupled.run(&stepping, &mut Beginning { scene, pairs: &mut self.pairs, h }, is_last, &mut tally);
        account.contact.count(&tally);
        let ends = scene.meter.has_deadline().then(Instant::now);
        let goes_on = levels > 0 && scene.meter.stopped() == Stopped::No && scene.meter.spent() < scene.halving_ends;
        let taking = if goes_on { self.choose_subdivided(scene) } else { Vec::new() };
        self.finish(scene, h);
        let substeps = (!taking.is_empty()).then(|| self.take_substeps(scene, h, levels - 1, &taking));
        self.report_replaced(scene, h);
        self.report(scene, h, &mut account);
        if let (None, Some(begins), Some(iterates), Some(ends)) = (&substeps, begins, iterates, ends) {
            let begin = begins.elapsed().saturating_sub(iterates.elapsed()).as_secs_f64();
            self.overhead = Overhead { begin, end: ends.elapsed().as_secs_f64() };
        }
        if let Some(substeps) = substeps {
            if !scene.is_nested {
                self.note_unsolved(&taking, &substeps);
            }
            self.add_substeps(&substeps, account);
        }
    }

    /// Makes the ends of the iteration the strands' states.
    fn finish(&mut self, scene: &mut Scene, h: f64) {
        let CoupledParts { packs, strands, islands, .. } = self.coupled.parts();
        if strands.is_empty() {
            return;
        }
        let (pairs, islands) = (packs::pairs(scene.strands, strands), &*islands);
        let (setting, bodies) = (scene.setting, scene.bodies);
        let (stopped, fast) = (scene.meter.stopped(), scene.is_fast && !scene.options.model.is_soft());
        let finish_one =
            |pack: &mut AnyPack, strand: &mut Strand, constrained: &mut ConstrainedStrand, scratch: &mut WorkerScratch| {
                let island = &islands[constrained.island as usize];
                let left = island.progress.ending.stopped != Stopped::No;
                if stopped == Stopped::Cancelled || stopped != Stopped::No && constrained.end == StrandEnd::AsBegun {
                    constrained.step.outcome = if stopped == Stopped::Cancelled {
                        strand.go_with_root(h, bodies)
                    } else {
                        strand.carry_along(h, bodies, setting.rules)
                    };
                    constrained.end = StrandEnd::WithRoot;
                    return;
                }
                let at_end = constrained.is_at_equilibrium(island, setting.options.tolerance, scene.options.residual)
                    || island.progress.ending.outcome >= Outcome::AttemptConverged;
                let converged = !constrained.has_undetected
                    && (island.progress.ending.is_converged() || (at_end && island.holds(&constrained.attachments)));
                let quarantined = constrained.step.outcome.quarantined || island.has_diverged(constrained);
                let fails = !converged && !quarantined;
                let behind = fails && island.is_behind(constrained);
                let far = left && (constrained.residual > NEAR_END || constrained.residual.is_nan());
                if fails && (left || fast || strand.is_carried()) && (behind || constrained.behind || far) {
                    // A strand that an unconverged iteration has left behind a body, or one cut short far from convergence, may
                    // have passed through bodies and strands. Such an end is worse than the beginning: the strand stays on its
                    // side.
                    constrained.step.outcome = StrandOutcome { left, ..strand.carry_along(h, bodies, setting.rules) };
                    constrained.end = StrandEnd::WithRoot;
                    return;
                }
                let root = strand.state.root;
                let outcome = &mut constrained.step.outcome;
                (outcome.converged, outcome.quarantined, outcome.left) = (converged, quarantined, left && !converged);
                // No step bends a strand by more than the energy of moving by its own length in it.
                let speed = strand.model.length() / h;
                let max_elastic = strand.energies.elastic + constrained.mass * speed * speed;
                let lane = constrained.lane as usize;
                strand
                    .with_one(|one| pack.end(lane, one, setting, h, max_elastic, &mut scratch.step.rule, &mut constrained.step));
                let outcome = constrained.step.outcome;
                // (If its end is no finite shape it is rolled back, and is not behind.)
                let (behind, lag) = (behind && !outcome.quarantined, strand.lag() + h);
                let divergence = strand.divergence.take_if(|_| behind);
                strand.ended(outcome, setting, h, bodies, &mut scratch.step);
                if behind {
                    strand.record_passed_bodies(&root, h, bodies, divergence);
                } else if !outcome.quarantined && constrained.lags() {
                    strand.bodies_follow(constrained.final_poses.clone(), lag);
                }
                strand.touched = constrained.attachments.iter().any(|end| island.constraints[end.constraint as usize].presses());
            };
        let finish = |work: &mut Work<Pair>, scratch: &mut WorkerScratch| {
            packs::finish(work, setting, h, |constrained| {
                stopped == Stopped::No || stopped != Stopped::Cancelled && constrained.end != StrandEnd::AsBegun
            });
            for (strand, constrained) in work.members.iter_mut().flatten() {
                finish_one(work.pack, strand, constrained, scratch);
            }
        };
        packs::with_pairs(packs, &mut self.pairs, pairs, |work| scene.workers.for_each(work, finish));
    }

    fn begin(&mut self, scene: &mut Scene, h: f64) {
        let strands = scene.strands.iter().enumerate().filter(|(_, strand)| strand.is_constrained());
        let CoupledParts { packs, strands: constrained_strands, .. } = self.coupled.parts();
        for ((k, strand), constrained) in strands.zip(constrained_strands.iter_mut()) {
            constrained.index = k as u32;
            (constrained.mass, constrained.bending) = (strand.model.mass(), strand.model.bending_force());
            constrained.permitted_overlap.clone_from(&strand.permitted_overlap);
            constrained.contact = strand.contact.as_deref().copied().unwrap_or_default();
            strand.body_motions(h, scene.bodies, &mut constrained.body_motions);
            constrained.final_poses.clear();
            if constrained.body_motions.iter().zip(scene.bodies).any(|([_, end], body)| *end != body.end) {
                constrained.final_poses.extend(constrained.body_motions.iter().map(|[_, end]| *end));
            }
            constrained.meets = match () {
                () if strand.contact.is_none() => Meets::Nothing,
                () if constrained.lags() => Meets::Bodies,
                () => Meets::All,
            };
            constrained.formula = if strand.touched { Formula::ImplicitEuler } else { Formula::AsSet };
            constrained.rest = Rest::Active;
            (constrained.ended, constrained.progress) = (None, None);
            (constrained.left_deep, constrained.has_undetected, constrained.behind) = (false, false, false);
            (constrained.root_gap, constrained.look_ahead, constrained.end) =
                (f64::INFINITY, LookAhead::None, StrandEnd::AsBegun);
            constrained.found.clear();
        }
        packs::begin(packs, &mut self.pairs, scene, constrained_strands, h, |_| true);
        scene.meter.spend(constrained_strands.iter().map(ConstrainedStrand::half_work).sum());
    }
}

/// A scene while its constrained strands are stepped.
struct Beginning<'b, 'a> {
    scene: &'b mut Scene<'a>,
    pairs: &'b mut PairWork,
    h: f64,
}

impl CoupledScene for Beginning<'_, '_> {
    fn begin_again(&mut self, packs: &mut Packs, strands: &mut [ConstrainedStrand]) {
        packs::begin(packs, self.pairs, self.scene, strands, self.h, |strand| strand.formula == Formula::ToBeginAgain);
    }

    fn add_bilateral(&self, strands: &[ConstrainedStrand], constraints: &mut Vec<StepConstraint>) {
        let Self { scene, h, .. } = self;
        for (k, constraint) in scene.constraints.iter().enumerate() {
            let find = |id| {
                let index = scene.slots.index(id)?;
                let place = strands.binary_search_by_key(&(index as u32), |strand| strand.index).ok()?;
                Some((place as u32, &scene.strands[index].model))
            };
            if constraint.state.status == ConstraintStatus::Released {
                continue;
            }
            let Some(first) = find(constraint.def.strand) else { continue };
            let other = constraint.other();
            let second = other.and_then(find);
            if other.is_some() && second.is_none() {
                continue;
            }
            constraint.step_constraints(k as u32, *h, first, second, |constraint| constraints.push(constraint));
        }
    }
}
