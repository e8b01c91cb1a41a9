//! The substep of constrained strands: their contacts are detected, they are coupled into islands and stepped together, Newton
//! iteration by Newton iteration. Strands do the two halves of an iteration on any thread, and islands solve their contact
//! problems in between; no result depends on the threads.
//!
//! Files:
//!
//! - `account.rs`: The results of a constrained substep: the outcomes of strands, the list of contacts, the loads of bodies and bilateral constraints.
//! - `contact_limit.rs`: The largest number of contacts of a strand.
//! - `formula.rs`: The integration formula of constrained strands.
//! - `iterations.rs`: Newton iterations of all islands.
//! - `packs.rs`: Constrained strands side by side: their distribution to packs, and each half of an iteration pack by pack.
//! - `solitary.rs`: Newton iterations of strands that share no constraint with others: what touches them is bodies, or holds them in place.
//! - `substeps.rs`: Substeps of a substep: islands that have not converged repeat it in two halves if contacts are left deep, and always if they are small.
//! - `tests.rs`: Substeps in which the limit of searches is reached before all contacts are found.

mod account;
mod contact_limit;
mod formula;
mod iterations;
mod packs;
mod solitary;
mod substeps;
#[cfg(test)]
mod tests;

pub(super) use account::Account;
pub use account::ContactTally;

use super::bodies::Contact;
use super::constraints::{Constraint, ConstraintStatus};
use super::contact_detection::{self, ContactDetection, ContactMemory};
use super::id::{BodyId, SlotMap, StrandId};
use super::report::Phases;
use super::strand::{Constrained, Strand};
use super::workers::{WorkerScratch, WorkerSet};
use crate::contact::body::{Body, BodyAt};
use crate::contact::constrained_strand::{Attachment, ConstrainedStrand, Formula, Meets, StrandEnd};
use crate::contact::ending::Outcome;
use crate::contact::island::Island;
use crate::contact::options::{ContactModel, ContactOptions};
use crate::contact::step_constraint::StepConstraint;
use crate::math::disjoint_sets::DisjointSets;
use crate::math::lanes::InstructionSet;
use crate::meter::{Meter, Stopped};
use crate::platform::Instant;
use crate::step::constrained_packs::AnyPack;
use crate::step::{Setting, StrandOutcome};
use packs::{Packs, Pair, Work};
use solitary::Member;

/// The largest number of searches for undetected contacts.
const MAX_SEARCHES: u32 = 16;
/// The first searches follow after this many Newton iterations: most new contacts are visible by then, and need not wait until
/// the others are exact. (Sooner, contacts of a mere first guess would be kept, and the energy of long runs grows.)
const EARLY: u32 = 2;
const EARLY_ITERATIONS: u32 = 2;

/// A strand whose iteration was cut short moves with its root if it is further from convergence than this, rad: halfway,
/// strands of a tangle would be flung about.
const NEAR_END: f64 = 0.03;

/// Cost of a constraint found by a search, nanoseconds or so.
const WORK_A_CONSTRAINT: u64 = 3000;

/// The solver's memory of constrained strands between substeps.
#[derive(Debug, Default)]
pub(super) struct ConstrainedSubstep {
    /// The constrained strands of the last substep; more may be kept for their memory.
    strands: Vec<ConstrainedStrand>,
    count: usize,
    packs: Packs,
    islands: Vec<Island>,
    island_count: usize,
    /// Memory for lists of islands, and of packs.
    at_work: Vec<&'static mut Island>,
    solitary_work: Vec<Work<'static, Member<'static>>>,
    /// Islands with strands that may have to begin again by the other formula, and those strands.
    asked: Vec<bool>,
    pressed: Vec<u32>,
    constraints: Vec<StepConstraint>,
    sets: DisjointSets,
    detection: ContactDetection,
    contacts: Vec<Contact>,
    /// The last substep's time beside its iterations, s.
    overhead: Overhead,
    /// Time of contact problems since it was last read, s.
    contact_seconds: f64,
    /// Takes the substeps of a substep, see `substeps.rs`.
    shorter: Option<Box<ConstrainedSubstep>>,
    /// The largest number of searches for undetected contacts, if not [`MAX_SEARCHES`].
    #[cfg(test)]
    max_searches: Option<u32>,
}

/// A substep's time beside its iterations, s.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Overhead {
    /// Before them.
    pub begin: f64,
    /// After them.
    pub end: f64,
}

/// The input of a constrained substep.
pub(super) struct Scene<'a> {
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
        let (search, contact) = (self.detection.take_seconds(), std::mem::take(&mut self.contact_seconds));
        let mut phases = Phases { search, contact, ..Phases::default() };
        if let Some(shorter) = &mut self.shorter {
            phases.add(&shorter.take_phases());
        }
        phases
    }

    /// Forgets the last substep's contacts: the indices of strands or bodies have changed.
    pub fn forget(&mut self) {
        self.detection.forget();
        self.contacts.clear();
    }

    /// Forgets the contacts of the last substep: there are none in this one.
    pub fn forget_contacts(&mut self) {
        self.contacts.clear();
    }

    /// Forgets which strands are near each other.
    pub fn forget_pairs(&mut self) {
        self.detection.forget_pairs();
    }

    /// The contacts kept from the last substep.
    pub fn memory(&self) -> ContactMemory {
        self.detection.memory()
    }

    /// A solver's memory restored, see [`ContactDetection::take_up`].
    pub fn taken_up<'a>(memory: ContactMemory, elements: impl Fn(u32) -> Option<&'a [f64]>, bodies: usize) -> Option<Self> {
        let mut new = Self::default();
        new.detection.take_up(memory, elements, bodies).then_some(new)
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
        self.count = scene.strands.iter().filter(|strand| strand.is_constrained()).count();
        self.strands.resize_with(self.strands.len().max(self.count), ConstrainedStrand::default);
        for constraint in scene.constraints.iter_mut() {
            constraint.motion.begin(h);
        }
        self.begin(scene, h);
        self.constraints.clear();
        self.detection.begin_step();
        self.detection.find(scene, &mut self.strands[..self.count], true);
        if !scene.meter.is_halted() {
            self.detection.constraints(scene, &self.strands[..self.count], &mut self.constraints);
        }
        contact_limit::thin_out(&mut self.constraints, &mut self.strands[..self.count], scene.meter.left());
        self.add_bilateral(scene, h);
        scene.meter.spend(self.constraints.len() as u64 * WORK_A_CONSTRAINT);
        let searches = if scene.options.model.is_soft() || !self.detection.is_possible(scene) { 0 } else { self.max_searches() };
        self.tie(searches > 0);
        self.predict_pressed(scene, h);
        let begin = begins.map(|begins| begins.elapsed().as_secs_f64());
        self.solve(scene, h, account.contact, searches);
        if !scene.options.model.is_soft() {
            let strands = &mut self.strands[..self.count];
            self.islands[..self.island_count].iter_mut().for_each(|island| island.reject_risen(strands, h));
        }
        scene.meter.uncounted(|| self.look_at_failures(scene));
        let ends = scene.meter.has_deadline().then(Instant::now);
        let goes_on = levels > 0 && scene.meter.stopped() == Stopped::No;
        let taking = if goes_on { self.choose_subdivided(scene) } else { Vec::new() };
        self.finish(scene, h);
        let substeps = (!taking.is_empty()).then(|| self.take_substeps(scene, h, levels - 1, &taking));
        self.report_replaced(scene, h);
        self.report(scene, h, &mut account);
        if let (None, Some(begin), Some(ends)) = (&substeps, begin, ends) {
            self.overhead = Overhead { begin, end: ends.elapsed().as_secs_f64() };
        }
        if let Some(substeps) = substeps {
            self.add_substeps(&substeps, account);
        }
    }

    fn max_searches(&self) -> u32 {
        #[cfg(test)]
        if let Some(most) = self.max_searches {
            return most;
        }
        MAX_SEARCHES
    }

    /// Newton's iterations of all islands, with at most `searches` searches for undetected contacts.
    fn solve(&mut self, scene: &mut Scene, h: f64, contact: &mut ContactTally, searches: u32) {
        // The solve is rough until a search finds nothing new: a contact detected later would undo an exact solution.
        let mut rough = searches > 0;
        for search in 0..searches {
            self.iterate(scene, h, contact, if search < EARLY { EARLY_ITERATIONS } else { u32::MAX });
            let stopped = scene.meter.stopped();
            if stopped != Stopped::No {
                return self.islands[..self.island_count].iter_mut().for_each(|island| island.stop(stopped));
            }
            let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
            self.detection.find(scene, strands, false);
            if scene.meter.is_halted() {
                return self.interrupt(scene);
            }
            let more = self.detection.add_undetected(scene, strands, islands, &mut self.constraints, h);
            if !more && scene.meter.is_halted() {
                return self.interrupt(scene);
            }
            if more {
                contact.searches += 1;
                contact_limit::thin_out(&mut self.constraints, &mut self.strands[..self.count], scene.meter.left());
                self.tie(rough);
            } else if islands.iter().all(|island| island.done && !island.is_to_be_tried_again()) {
                if !(rough && self.refine()) {
                    return;
                }
                rough = false;
            }
        }
        self.iterate(scene, h, contact, u32::MAX);
        if rough && self.refine() {
            self.iterate(scene, h, contact, u32::MAX);
        }
        if searches > 0 && !scene.meter.is_halted() {
            // No more contacts are added, and what there is is reported.
            let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
            self.detection.find(scene, strands, false);
            if scene.meter.is_halted() {
                return self.interrupt(scene);
            }
            if !self.detection.report_undetected(scene, strands, islands, h) {
                self.interrupt(scene);
            }
        }
    }

    /// The last search was halted: strands that it has not reached may have undetected contacts.
    fn interrupt(&mut self, scene: &Scene) {
        let (why, unseen) = (scene.meter.stopped(), contact_detection::unseen(scene.options));
        self.islands[..self.island_count].iter_mut().for_each(|island| island.stop(why));
        for constrained in self.strands[..self.count].iter_mut().filter(|constrained| constrained.has_gone(unseen)) {
            constrained.has_undetected = true;
            self.islands[constrained.island as usize].interrupt(why);
        }
    }

    /// Measures the depth of islands that have not converged or are held apart by springs, and of overlap that no constraint
    /// represents. Their constraints only tell the depth where the contacts were found.
    fn look_at_failures(&mut self, scene: &Scene) {
        let (strands, islands) = (&mut self.strands[..self.count], &mut self.islands[..self.island_count]);
        if scene.meter.is_halted() {
            return;
        }
        let is_looked_at = |constrained: &ConstrainedStrand| {
            constrained.left_deep || constrained.lags() || islands[constrained.island as usize].failed()
        };
        // Penalty models search only at the start.
        let all = scene.options.model.is_soft();
        if !self.detection.is_possible(scene) || (all && !scene.is_last) || !(all || strands.iter().any(is_looked_at)) {
            return;
        }
        for constrained in strands.iter_mut() {
            constrained.step.gone = if all || is_looked_at(constrained) { f64::INFINITY } else { 0.0 };
        }
        self.detection.find(scene, strands, false);
        self.detection.report_depths(scene, strands, islands, true);
        if scene.meter.is_halted() || !strands.iter().any(ConstrainedStrand::lags) {
            return;
        }
        // Bodies that still follow a strand are there all the same.
        for constrained in strands.iter_mut() {
            constrained.look_around(scene.bodies);
            constrained.step.gone = if constrained.lags() { f64::INFINITY } else { 0.0 };
        }
        self.detection.find(scene, strands, false);
        self.detection.report_depths(scene, strands, islands, false);
    }

    /// The marked strands, each with its entry in `strands`.
    fn pairs<'a>(
        strands: &'a mut [Strand],
        constrained: &'a mut [ConstrainedStrand],
    ) -> impl Iterator<Item = (&'a mut Strand, &'a mut ConstrainedStrand)> {
        strands.iter_mut().filter(|strand| strand.is_constrained()).zip(constrained)
    }

    /// Begins the step of the strands marked for it again, by implicit Euler.
    fn restart(scene: &mut Scene, packs: &mut Packs, constrained: &mut [ConstrainedStrand], h: f64) {
        let is_marked = |constrained: &ConstrainedStrand| constrained.formula == Formula::ToBeginAgain;
        if !constrained.iter().any(is_marked) || scene.meter.is_halted() {
            return;
        }
        packs.begin(scene, constrained, h, is_marked);
        for constrained in constrained.iter_mut().filter(|constrained| is_marked(constrained)) {
            (constrained.formula, constrained.resting, constrained.looked_ahead) = (Formula::ImplicitEuler, false, false);
        }
    }

    /// Makes the ends of the iteration the strands' states.
    fn finish(&mut self, scene: &mut Scene, h: f64) {
        if self.count == 0 {
            return;
        }
        let islands = &self.islands[..self.island_count];
        let pairs = Self::pairs(scene.strands, &mut self.strands[..self.count]);
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
                let at_end = constrained.resting || island.progress.ending.outcome >= Outcome::AttemptConverged;
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
                let behind = behind && !outcome.quarantined;
                let divergence = strand.divergence.take_if(|_| behind);
                strand.ended(outcome, setting, h, bodies, &mut scratch.step);
                if behind {
                    strand.record_passed_bodies(&root, h, bodies, divergence);
                } else if !outcome.quarantined && constrained.lags() {
                    strand.bodies_follow(constrained.final_poses.clone());
                }
                strand.touched = constrained.attachments.iter().any(|end| island.constraints[end.constraint as usize].presses());
            };
        let finish = |work: &mut Work<Pair>, scratch: &mut WorkerScratch| {
            work.finish(setting, h, |constrained| {
                stopped == Stopped::No || stopped != Stopped::Cancelled && constrained.end != StrandEnd::AsBegun
            });
            for (strand, constrained) in work.members.iter_mut().flatten() {
                finish_one(work.pack, strand, constrained, scratch);
            }
        };
        self.packs.with_pairs(pairs, |work| scene.workers.for_each(work, finish));
    }

    fn begin(&mut self, scene: &mut Scene, h: f64) {
        let strands = scene.strands.iter().enumerate().filter(|(_, strand)| strand.is_constrained());
        for ((k, strand), constrained) in strands.zip(&mut self.strands) {
            constrained.index = k as u32;
            (constrained.mass, constrained.bending) = (strand.model.mass(), strand.model.bending_force());
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
            constrained.resting = false;
            (constrained.ended, constrained.progress) = (None, None);
            (constrained.left_deep, constrained.has_undetected, constrained.behind) = (false, false, false);
            (constrained.root_gap, constrained.looked_ahead, constrained.end) = (f64::INFINITY, false, StrandEnd::AsBegun);
            constrained.found.clear();
        }
        self.packs.clear();
        let constrained = &mut self.strands[..self.count];
        self.packs.begin(scene, constrained, h, |_| true);
        scene.meter.spend(constrained.iter().map(ConstrainedStrand::half_work).sum());
    }

    /// Adds the constraints of the scene's bilateral constraints.
    fn add_bilateral(&mut self, scene: &Scene, h: f64) {
        let (constrained, constraints) = (&self.strands[..self.count], &mut self.constraints);
        for (k, constraint) in scene.constraints.iter().enumerate() {
            let find = |id| {
                let index = scene.slots.index(id)?;
                let place = constrained.binary_search_by_key(&(index as u32), |constrained| constrained.index).ok()?;
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
            constraint.step_constraints(k as u32, h, first, second, |constraint| constraints.push(constraint));
        }
    }

    /// Goes on with islands that were solved roughly. True if there is more to do.
    fn refine(&mut self) -> bool {
        let mut goes_on = false;
        for island in &mut self.islands[..self.island_count] {
            if island.refine() {
                goes_on = true;
                for constrained in &island.strands {
                    let constrained = &mut self.strands[*constrained as usize];
                    (constrained.ended, constrained.resting, constrained.woken) = (None, false, 0);
                }
            }
        }
        goes_on
    }

    /// Couples the constraints' strands into islands, to be solved `rough`ly first where that is of use.
    fn tie(&mut self, rough: bool) {
        self.sets.reset(self.count);
        for constraint in &self.constraints {
            if let Some(second) = constraint.second {
                self.sets.join(constraint.first.strand, second.strand);
            }
        }
        for constrained in &mut self.strands[..self.count] {
            constrained.attachments.clear();
            constrained.woken = 0;
        }
        self.island_count = 0;
        for k in 0..self.count {
            let lowest = self.sets.lowest(k as u32) as usize;
            let island = if lowest == k {
                self.island_count += 1;
                self.islands.resize_with(self.islands.len().max(self.island_count), Island::default);
                self.islands[self.island_count - 1].clear();
                self.island_count - 1
            } else {
                self.strands[lowest].island as usize
            };
            self.strands[k].island = island as u32;
            self.islands[island].strands.push(k as u32);
        }
        for island in &mut self.islands[..self.island_count] {
            // Strands on which nothing new acts are coupled as before.
            let ended = |constrained: &u32| self.strands[*constrained as usize].ended;
            if island.strands.iter().all(|constrained| ended(constrained).is_some())
                && let Some(ending) = island.strands.first().and_then(ended)
            {
                island.keep(ending);
            }
            if let [alone] = island.strands[..]
                && let Some(progress) = self.strands[alone as usize].progress.take()
            {
                island.resume(progress);
            }
        }
        for constraint in self.constraints.drain(..) {
            let island = &mut self.islands[self.strands[constraint.first.strand as usize].island as usize];
            let number = island.constraints.len() as u32;
            island.constraints.push(constraint);
            for (k, end) in constraint.ends().enumerate() {
                let attachment = Attachment {
                    constraint: number,
                    second: k == 1,
                    material_point: end.material_point,
                    modelled: constraint.modelled[k],
                };
                self.strands[end.strand as usize].attachments.push(attachment);
            }
        }
        if rough {
            self.islands[..self.island_count].iter_mut().for_each(Island::begin_roughly);
        }
    }
}
