//! Contact detection in a step: contacts of constrained strands with bodies and other strands, as constraints, and their
//! warm start.
//!
//! Files:
//!
//! - `memory.rs`: The contacts kept from substep to substep, saved and restored for snapshots.
//! - `permitted_overlaps.rs`: Contacts with bodies of strands with permitted overlaps: their surfaces are nearer to their centrelines there.
//! - `undetected.rs`: Contacts that a search between iterations finds and no constraint represents: they are added to the islands' constraints.
//! - `warm_start.rs`: The warm start: the forces of the last substep's contacts, with which the next one begins.

mod memory;
mod permitted_overlaps;
mod undetected;
mod warm_start;

use nalgebra::Vector3;

pub(crate) use memory::{ContactMemory, NearStrands};
use undetected::KnownOf;
pub(crate) use warm_start::{WarmStartForce, With};

use super::constrained_strand::{ConstrainedStrand, Meets};
use super::coupled_step::{Scratch, Stepping};
use super::island::Island;
use super::nearest_pair::{deepest_possible, depth};
use crate::chain::load::MaterialPoint;
use crate::contact::broad_phase::hair_pairs::{HairPairs, HeldRoots, PairOptions, Tie};
use crate::contact::broad_phase::pieces::Wisp;
use crate::contact::constraint::step_constraint::{ConstraintEnd, ConstraintKind, StepConstraint};
use crate::contact::contact_point::{ContactPoint, Partner, StrandPath, StrandPoint};
use crate::contact::narrow_phase::strand_contacts::PairScratch;
use crate::contact::options::{ContactOptions, GRAVITY};
use crate::platform::Instant;

/// Surfaces closer than this at the present iterate are contacts, m; between strands closer than this fraction of the largest
/// wisp's radius.
pub(crate) const NEAR: f64 = 1e-3;
const NEAR_HAIR: f64 = 0.1;
/// Pairs of strands are searched for again when one has moved by this fraction of the largest wisp's radius.
const MARGIN: f64 = 0.5;
/// Surfaces count as overlapping at the start of a step if they are this many tolerances deep: more than the end of a step
/// leaves.
const DEEP: f64 = 2.0;
/// Depth to which two strands in contact yield under the weight of the heavier one, in tolerances.
const YIELDS_TO_WEIGHT: f64 = 0.01;
/// The largest depth in a body at which a strand is looked for at the start of a substep, m.
const DEEPEST: f64 = 0.1;
/// A strand that has moved by less than this fraction of the contact tolerance since its last search is not searched again.
const UNSEEN: f64 = 0.1;
/// A solve leaves no larger spurious force than this many times its residual in units of the strand's weight.
const LEFT_OVER: f64 = 2.0;
/// Cost of a pair of chords of strands and of the search for such pairs, nanoseconds or so.
const WORK_A_CANDIDATE: u64 = 600;

/// Pairs of strands per task.
const PAIRS_PER_TASK: usize = 32;

/// What contacts are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SearchFor {
    /// All that may close in the substep, at its start.
    Start,
    /// Overlaps at the present iterate.
    Overlaps,
    /// The same, but with bodies only where the strands are now: what they have passed through on their way does not count.
    OverlapsInPlace,
    /// Overlaps at the present iterate with bodies alone. What was found of strands that have not moved since is kept.
    OverlapsWithBodies,
}

/// What contacts between strands are looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
enum HairSearch {
    /// All that may close in the substep, at its start.
    AtStart,
    /// Overlaps of strands that have moved since their last search.
    OfMoved,
    /// Overlaps of all strands, deeper than this, m.
    DeeperThan(f64),
}

/// The pairs of strands of a task, from this one on, and their contacts.
#[derive(Debug, Default)]
struct PairTask {
    from: usize,
    contacts: Vec<ContactPoint>,
    scratch: PairScratch,
}

/// Contact detection, with its memory.
#[derive(Debug, Default)]
pub(crate) struct ContactDetection {
    pairs: HairPairs,
    /// The wisps for which `pairs` was set, one per constrained strand in contact with hair, and the indices of these strands.
    wisps: Vec<Wisp>,
    of: Vec<u32>,
    ready: bool,
    hair: Vec<ContactPoint>,
    tasks: Vec<PairTask>,
    /// Which strands are tied together, by their indices in the solver; and which of the wisps.
    tied: Vec<Tie>,
    ties: Vec<Tie>,
    /// Some strands have permitted overlaps.
    allows: bool,
    warm_start: Vec<WarmStartForce>,
    /// Time of searches since it was last read, s.
    seconds: f64,
    /// Memory of [`ContactDetection::undetected`] and of [`ContactDetection::add_undetected`].
    undetected: Vec<StepConstraint>,
    left_deep: Vec<ConstraintEnd>,
    known_of: KnownOf,
}

impl ContactDetection {
    /// The time of searches since it was last read, s.
    pub fn take_seconds(&mut self) -> f64 {
        std::mem::take(&mut self.seconds)
    }

    /// Forgets the last substep's contacts and pairs.
    pub fn forget(&mut self) {
        self.warm_start.clear();
        self.ready = false;
    }

    /// Forgets which strands are near each other.
    pub fn forget_pairs(&mut self) {
        self.ready = false;
    }

    /// Whether any contact is possible.
    pub fn is_possible<S>(&self, stepping: &Stepping<S>) -> bool {
        !stepping.bodies.is_empty() || stepping.options.hair
    }

    /// Begins a step in which these strands are tied together, by their indices in the solver.
    pub fn begin_step(&mut self, tied: impl Iterator<Item = Tie>) {
        self.tied.clear();
        self.tied.extend(tied);
        self.pairs.begin_step();
    }

    /// Finds the contacts at the present iterate of all strands that have moved since their last search; those of two strands
    /// that have not are known. At the start of a substep these include contacts that may close, later only overlaps. If the
    /// meter halts it some are missing, and their strands still count as moved.
    pub fn find<S: Scratch>(&mut self, stepping: &Stepping<S>, strands: &mut [ConstrainedStrand], what: SearchFor) {
        let begins = Instant::now();
        self.search(stepping, strands, what);
        self.seconds += begins.elapsed().as_secs_f64();
    }

    /// Adds overlaps of hair with hair to those with bodies that were found last, but none of less than some depth that is there anyway: for
    /// the greatest depth of all.
    pub fn find_deeper_hair<S: Scratch>(&mut self, stepping: &Stepping<S>, strands: &[ConstrainedStrand], islands: &[Island]) {
        if !stepping.options.hair || stepping.meter.is_halted() {
            return;
        }
        let begins = Instant::now();
        let tolerance = stepping.options.tolerance;
        let most = deepest_possible(2.0 * strands.iter().map(|strand| strand.contact.wisp_radius).fold(0.0, f64::max), tolerance);
        let with_bodies =
            strands.iter().flat_map(|strand| &strand.found).fold(0.0, |depth: f64, contact| depth.max(-contact.gap));
        let of_hair = |constraint: &&StepConstraint| constraint.second.is_some() && constraint.is_contact();
        let mut known = islands.iter().flat_map(|island| &island.constraints).filter(of_hair);
        let least = known
            .try_fold(with_bodies, |least, constraint| (least < most).then(|| least.max(depth(constraint, strands, tolerance))));
        if let Some(least) = least.filter(|least| *least < most) {
            self.find_hair(stepping, strands, HairSearch::DeeperThan(least));
        }
        self.seconds += begins.elapsed().as_secs_f64();
    }

    fn search<S: Scratch>(&mut self, stepping: &Stepping<S>, strands: &mut [ConstrainedStrand], what: SearchFor) {
        self.hair.clear();
        if what == SearchFor::Start {
            self.allows = strands.iter().any(|strand| strand.permitted_overlap.is_some());
        }
        let unseen = unseen(stepping.options);
        let keeps = what == SearchFor::OverlapsWithBodies;
        for constrained in strands.iter_mut().filter(|constrained| !keeps || constrained.has_gone(unseen)) {
            constrained.found.clear();
        }
        if !stepping.bodies.is_empty() {
            stepping.workers.for_each(strands, |constrained, _| {
                if constrained.has_gone(unseen) && !stepping.meter.is_halted() {
                    stepping.meter.spend(constrained.find_bodies(stepping.bodies, what, NEAR, unseen));
                    permitted_overlaps::reduce_body_contacts(constrained, NEAR);
                }
            });
        }
        if stepping.options.hair && what != SearchFor::OverlapsWithBodies && !stepping.meter.is_halted() {
            let which = if what == SearchFor::Start { HairSearch::AtStart } else { HairSearch::OfMoved };
            self.find_hair(stepping, strands, which);
        }
        if stepping.meter.is_halted() {
            return;
        }
        for constrained in strands.iter_mut().filter(|constrained| constrained.has_gone(unseen)) {
            constrained.step.gone = 0.0;
            constrained.step.gone_by_element.fill(0.0);
        }
    }

    fn find_hair<S: Scratch>(&mut self, stepping: &Stepping<S>, strands: &[ConstrainedStrand], which: HairSearch) {
        let (at_start, within) = match which {
            HairSearch::AtStart => (true, NEAR),
            HairSearch::OfMoved => (false, 0.0),
            HairSearch::DeeperThan(depth) => (false, -depth),
        };
        let meets_hair =
            |constrained: &ConstrainedStrand| constrained.meets == Meets::All && constrained.contact.wisp_radius > 0.0;
        let wisps = || strands.iter().enumerate().filter(|(_, constrained)| meets_hair(constrained));
        let paths: Vec<StrandPath> =
            wisps().map(|(k, constrained)| StrandPath { index: k as u32, ..constrained.path() }).collect();
        let same = self.of.len() == paths.len() && wisps().zip(&self.of).all(|((_, constrained), of)| constrained.index == *of);
        let rebuilt = !(self.ready && same);
        if rebuilt {
            self.of = wisps().map(|(_, constrained)| constrained.index).collect();
            self.wisps = wisps().map(|(_, constrained)| constrained.contact.wisp()).collect();
            self.ready = self.pairs.set(&self.wisps, &pair_options(&self.wisps)).is_ok();
        }
        if rebuilt || at_start {
            let Self { of, tied, ties, .. } = self;
            let wisp = |strand: u32| of.binary_search(&strand).ok().map(|place| place as u32);
            ties.clear();
            ties.extend(tied.iter().filter_map(|tie| {
                let [first, second] = tie.strands.map(wisp);
                Some(Tie { strands: [first?, second?], ..*tie })
            }));
            self.ready &= self.pairs.set_ties(&self.ties).is_ok();
        }
        self.ready &= self.pairs.update_by(&paths, stepping.workers, stepping.meter).is_ok();
        if !self.ready {
            return;
        }
        let all = matches!(which, HairSearch::DeeperThan(_));
        let moved: Vec<bool> = wisps().map(|(_, constrained)| all || constrained.has_gone(unseen(stepping.options))).collect();
        // In tasks of a fixed size, joined in order: the same contacts for any threads.
        let groups: Vec<_> = self.pairs.groups().iter().filter(|pair| moved[pair.a as usize] || moved[pair.b as usize]).collect();
        let tasks = groups.len().div_ceil(PAIRS_PER_TASK);
        self.tasks.resize_with(self.tasks.len().max(tasks), PairTask::default);
        for (k, task) in self.tasks[..tasks].iter_mut().enumerate() {
            task.from = k * PAIRS_PER_TASK;
        }
        let pairs = &self.pairs;
        stepping.workers.for_each_task(&mut self.tasks[..tasks], 1, 1, |tasks, _| {
            for PairTask { from, contacts, scratch } in tasks {
                contacts.clear();
                for group in groups[*from..].iter().take(PAIRS_PER_TASK).take_while(|_| !stepping.meter.is_halted()) {
                    pairs.contacts(group, &paths, within, scratch, contacts);
                    stepping.meter.spend(u64::from(group.candidates()) * WORK_A_CANDIDATE);
                }
            }
        });
        for task in &self.tasks[..tasks] {
            self.hair.extend_from_slice(&task.contacts);
        }
    }

    /// The constraints of all contacts found.
    pub fn constraints<S>(
        &mut self,
        stepping: &Stepping<S>,
        strands: &[ConstrainedStrand],
        constraints: &mut Vec<StepConstraint>,
    ) {
        constraints
            .extend(self.found(strands).map(|(constrained, contact)| self.constraint(stepping, strands, constrained, contact)));
    }

    fn constraint<S>(
        &self,
        stepping: &Stepping<S>,
        strands: &[ConstrainedStrand],
        constrained: u32,
        contact: &ContactPoint,
    ) -> StepConstraint {
        let strand = &strands[constrained as usize];
        let first = end(constrained, &contact.point);
        let (second, kind, with) = match contact.partner {
            Partner::Body { body, feature } => {
                let at = &stepping.bodies[body as usize];
                let margin = permitted_overlaps::radius(strand, &first.material_point) + at.thickness;
                let point = strand.end_state(&first.material_point).now - contact.normal * (contact.gap + margin);
                let (normal, carried) = (contact.normal, contact.carried);
                let kind = ConstraintKind::Body {
                    body,
                    feature,
                    normal,
                    side: normal,
                    point,
                    carried,
                    margin,
                    friction: [at.friction, at.viscous_friction],
                };
                (None, kind, With::Body(body))
            }
            Partner::Strand(place) => {
                let other = &strands[place.strand as usize];
                let second = end(place.strand, &place);
                let margin = if self.ties.is_empty() && !self.allows {
                    strand.contact.wisp_radius + other.contact.wisp_radius
                } else {
                    // What a nearby knot or the permitted overlaps leave of the radii.
                    let apart = strand.end_state(&first.material_point).now - other.end_state(&second.material_point).now;
                    contact.normal.dot(&apart) - contact.gap
                };
                // The weight of the heavier one: a light stub would let a lock sink into it.
                let weight = strand.mass.max(other.mass) * GRAVITY;
                let compliance = YIELDS_TO_WEIGHT * stepping.options.tolerated_depth() / weight;
                let kind = ConstraintKind::Hair { normal: contact.normal, margin, compliance };
                (Some(second), kind, With::Strand(other.index))
            }
        };
        let deep =
            !stepping.options.model.is_soft() && contact.gap < 0.0 && self.was_deep(stepping, strands, &first, second, kind);
        let force = self.warm_start_force(strand.index, with, strand.along(&first.material_point), strand.length());
        // A pulling force is no contact force; and one as small as a solve may leave where there is none would stay for ever on
        // a strand that moves away.
        let lightest = second.map_or(strand.mass, |end| strand.mass.min(strands[end.strand as usize].mass));
        let is_left_over = !stepping.options.model.is_soft()
            && contact.gap > 0.0
            && force.norm_squared() <= (LEFT_OVER * stepping.options.residual * lightest * GRAVITY).powi(2);
        let force = if force.dot(&contact.normal) > 0.0 && !is_left_over { force } else { Vector3::zeros() };
        let constraint = StepConstraint { gap: contact.gap, deep, ..StepConstraint::new(first, second, kind, force) };
        // At rest nothing yields.
        StepConstraint { pushed: constraint.compliance() * constraint.pressure(), ..constraint }
    }

    /// Whether the surfaces of a contact overlapped when the substep began.
    fn was_deep<S>(
        &self,
        stepping: &Stepping<S>,
        strands: &[ConstrainedStrand],
        first: &ConstraintEnd,
        second: Option<ConstraintEnd>,
        kind: ConstraintKind,
    ) -> bool {
        let strand = &strands[first.strand as usize];
        let (allowed, at) = (DEEP * stepping.options.tolerance, strand.end_state(&first.material_point).start);
        match (kind, second) {
            (ConstraintKind::Body { body, .. }, _) => {
                let radius = permitted_overlaps::radius(strand, &first.material_point);
                radius + strand.met(stepping.bodies, body).depth_at_start(at, DEEPEST) > allowed
            }
            (ConstraintKind::Hair { margin, .. }, Some(end)) => {
                let apart = (at - strands[end.strand as usize].end_state(&end.material_point).start).norm();
                apart < margin - allowed
            }
            _ => false,
        }
    }

    /// Stores the depths found by the last search in the islands; with `step` also those caused by the step, and which strands
    /// are in or behind a body.
    pub fn report_depths<S>(
        &self,
        stepping: &Stepping<S>,
        strands: &mut [ConstrainedStrand],
        islands: &mut [Island],
        step: bool,
    ) {
        let may = stepping.options.tolerated_depth();
        let mut behind = Vec::new();
        for (constrained, contact) in self.found(strands) {
            if contact.gap >= -may {
                continue;
            }
            let constraint = self.constraint(stepping, strands, constrained, contact);
            let depth = depth(&constraint, strands, stepping.options.tolerance);
            let follows = step && strands[constrained as usize].lags();
            // A body that follows the strand is elsewhere in the scene.
            let is_elsewhere = follows && constraint.second.is_none();
            for end in constraint.ends() {
                let left = &mut islands[strands[end.strand as usize].island as usize].left;
                left.deep = left.deep.max(if is_elsewhere { 0.0 } else { depth });
                left.newly = left.newly.max(if constraint.deep || !step { 0.0 } else { depth });
            }
            if step && !follows && constraint.is_behind(-depth) {
                behind.push(constrained);
            }
        }
        for constrained in behind {
            strands[constrained as usize].behind = true;
        }
    }

    /// The contacts found by the last search, with their strands.
    fn found<'a>(&'a self, strands: &'a [ConstrainedStrand]) -> impl Iterator<Item = (u32, &'a ContactPoint)> {
        let bodies = strands
            .iter()
            .enumerate()
            .flat_map(|(k, constrained)| constrained.found.iter().map(move |contact| (k as u32, contact)));
        bodies.chain(self.hair.iter().map(|contact| (contact.point.strand, contact)))
    }
}

/// Strands that have moved by no more than this since their last search are not searched again, m.
pub(super) fn unseen(options: &ContactOptions) -> f64 {
    UNSEEN * options.tolerance
}

/// The search distances for these wisps.
pub(crate) fn pair_options(wisps: &[Wisp]) -> PairOptions {
    let largest = wisps.iter().fold(0.0_f64, |a, wisp| a.max(wisp.radius));
    PairOptions { activation: NEAR.min(NEAR_HAIR * largest), margin: MARGIN * largest, held_roots: HeldRoots::Ignored }
}

fn end(constrained: u32, place: &StrandPoint) -> ConstraintEnd {
    ConstraintEnd { strand: constrained, material_point: MaterialPoint::on(place.element as usize, place.s) }
}
