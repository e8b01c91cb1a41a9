//! Contact detection in a step: contacts of constrained strands with bodies and other strands, as constraints, and their
//! warm start.
//!
//! Files:
//!
//! - `memory.rs`: The contacts kept from substep to substep, saved and restored for snapshots.
//! - `permitted_overlaps.rs`: Contacts of strands with permitted overlaps: their surfaces are nearer to their centrelines there.

mod memory;
mod permitted_overlaps;

use nalgebra::Vector3;

pub(crate) use memory::{ContactMemory, NearStrands};

use super::constrained_strand::{ConstrainedStrand, Meets};
use super::coupled_step::{Scratch, Stepping};
use super::island::Island;
use super::nearest_pair::depth;
use crate::chain::load::MaterialPoint;
use crate::contact::broad_phase::hair_pairs::{HairPairs, PairOptions, Tie};
use crate::contact::broad_phase::pieces::Wisp;
use crate::contact::constraint::law::Law;
use crate::contact::constraint::step_constraint::{ConstraintEnd, ConstraintKind, Give, SAME_SIDE, StepConstraint};
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
/// The largest depth in a body at which a strand is looked for at the start of a substep, m.
const DEEPEST: f64 = 0.1;
/// A strand that has moved by less than this fraction of the contact tolerance since its last search is not searched again.
const UNSEEN: f64 = 0.1;
/// An undetected contact is a known one, seen from where the strands are now, if it is no further from it along the strand than
/// this fraction of the distance that the surfaces keep between their centres. Side by side the two would be one force in two
/// places, which no solve can tell apart.
const SAME_PLACE: f64 = 0.5;
/// A strand whose element is further from convergence than this, rad, while its iteration goes on, and that has more new
/// contacts than this, is not near its final place.
const WILD: f64 = 1.0;
const CROWD: usize = 20;
/// A solve leaves no larger spurious force than this many times its residual in units of the strand's weight.
const LEFT_OVER: f64 = 2.0;
/// A contact continues one of the last step if it is no further from it along the strand than this fraction of the strand's
/// length.
const SAME: f64 = 0.02;

/// The partner of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum With {
    Body(u32),
    Strand(u32),
}

/// The force of a contact in the last substep.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WarmStartForce {
    pub strand: u32,
    pub with: With,
    pub along: f64,
    pub force: Vector3<f64>,
}

/// Cost of the search of an element near bodies, and of a pair of pieces of strands, nanoseconds or so.
const WORK_AN_ELEMENT: u64 = 1000;
const WORK_A_CANDIDATE: u64 = 1000;

/// Pairs of strands per task.
const PAIRS_PER_TASK: usize = 32;

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
    pub fn find<S: Scratch>(&mut self, stepping: &Stepping<S>, strands: &mut [ConstrainedStrand], at_start: bool) {
        let begins = Instant::now();
        self.search(stepping, strands, at_start);
        self.seconds += begins.elapsed().as_secs_f64();
    }

    fn search<S: Scratch>(&mut self, stepping: &Stepping<S>, strands: &mut [ConstrainedStrand], at_start: bool) {
        self.hair.clear();
        if at_start {
            self.allows = strands.iter().any(|strand| strand.permitted_overlap.is_some());
        }
        let unseen = unseen(stepping.options);
        for constrained in strands.iter_mut() {
            constrained.found.clear();
        }
        if !stepping.bodies.is_empty() {
            stepping.workers.for_each(strands, |constrained, _| {
                if constrained.has_gone(unseen) && !stepping.meter.is_halted() {
                    constrained.find_bodies(stepping.bodies, NEAR, unseen);
                    stepping.meter.spend(constrained.path().now.elements.len() as u64 * WORK_AN_ELEMENT);
                    permitted_overlaps::reduce_body_contacts(constrained, NEAR);
                }
            });
        }
        if stepping.options.hair && !stepping.meter.is_halted() {
            self.find_hair(stepping, strands, at_start);
        }
        if stepping.meter.is_halted() {
            return;
        }
        for constrained in strands.iter_mut().filter(|constrained| constrained.has_gone(unseen)) {
            constrained.step.gone = 0.0;
            constrained.step.gone_by_element.fill(0.0);
        }
    }

    fn find_hair<S: Scratch>(&mut self, stepping: &Stepping<S>, strands: &[ConstrainedStrand], at_start: bool) {
        let within = if at_start { NEAR } else { 0.0 };
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
        let moved: Vec<bool> = wisps().map(|(_, constrained)| constrained.has_gone(unseen(stepping.options))).collect();
        // In tasks of a fixed size, joined in order: the same contacts for any threads.
        let groups: Vec<_> = self.pairs.groups().iter().filter(|pair| moved[pair.a as usize] || moved[pair.b as usize]).collect();
        let tasks = groups.len().div_ceil(PAIRS_PER_TASK);
        self.tasks.resize_with(self.tasks.len().max(tasks), PairTask::default);
        for (k, task) in self.tasks[..tasks].iter_mut().enumerate() {
            task.from = k * PAIRS_PER_TASK;
        }
        let (pairs, allows) = (&self.pairs, self.allows);
        stepping.workers.for_each_task(&mut self.tasks[..tasks], 1, 1, |tasks, _| {
            for PairTask { from, contacts, scratch } in tasks {
                contacts.clear();
                for group in groups[*from..].iter().take(PAIRS_PER_TASK).take_while(|_| !stepping.meter.is_halted()) {
                    pairs.contacts(group, &paths, within, scratch, contacts);
                    stepping.meter.spend(u64::from(group.candidates()) * WORK_A_CANDIDATE);
                }
                if allows {
                    permitted_overlaps::reduce_hair_contacts(strands, within.min(pairs.activation()), contacts);
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
                let kind = ConstraintKind::Hair { normal: contact.normal, margin };
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
        StepConstraint { gap: contact.gap, deep, ..StepConstraint::new(first, second, kind, force) }
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

    /// The force of this contact in the last substep.
    fn warm_start_force(&self, strand: u32, with: With, along: f64, length: f64) -> Vector3<f64> {
        let from = self.warm_start.partition_point(|seen| (seen.strand, seen.with) < (strand, with));
        let mut best = (SAME * length, Vector3::zeros());
        for seen in self.warm_start[from..].iter().take_while(|seen| (seen.strand, seen.with) == (strand, with)) {
            let off = (seen.along - along).abs();
            if off <= best.0 {
                best = (off, seen.force);
            }
        }
        best.1
    }

    /// Of the contacts found last: overlaps at the present iterate that no constraint represents. `None` if the meter has
    /// halted it: strands with contacts still count as moved.
    fn undetected<S>(
        &mut self,
        stepping: &Stepping<S>,
        strands: &mut [ConstrainedStrand],
        islands: &[Island],
    ) -> Option<Vec<StepConstraint>> {
        let (mut undetected, mut left_deep, mut halted) =
            (std::mem::take(&mut self.undetected), std::mem::take(&mut self.left_deep), false);
        undetected.clear();
        for (index, (constrained, contact)) in self.found(strands).enumerate() {
            halted = stepping.meter.is_halted_at(index);
            if halted {
                break;
            }
            if contact.gap >= -stepping.options.tolerance || islands[strands[constrained as usize].island as usize].is_given_up()
            {
                continue;
            }
            let mut constraint = self.constraint(stepping, strands, constrained, contact);
            if constraint.deep {
                // It yields: its depth means nothing, but is reported.
                left_deep.extend(constraint.ends());
                continue;
            }
            let first = &strands[constrained as usize];
            let a = first.end_state(&constraint.first.material_point);
            let other = constraint.second.map(|end| (&strands[end.strand as usize], end.material_point));
            let (b, contact) = other
                .map_or((a, &first.contact), |(strand, material_point)| (strand.end_state(&material_point), &strand.contact));
            let (law, u) = constraint.evaluate([a, b], [&first.contact, contact], stepping.options, stepping.h);
            let overlaps = matches!(law, Law::Contact(law) if law.normal.dot(&u) < -stepping.options.tolerance);
            if overlaps && !is_reported(&constraint, strands, islands, stepping.options.tolerance) {
                undetected.push(constraint);
            }
        }
        for end in left_deep.drain(..) {
            strands[end.strand as usize].left_deep = true;
        }
        self.left_deep = left_deep;
        if halted {
            let with_contacts: Vec<u32> = self.found(strands).map(|(constrained, _)| constrained).collect();
            with_contacts.iter().for_each(|constrained| strands[*constrained as usize].step.gone = f64::INFINITY);
        }
        (!halted).then_some(undetected)
    }

    /// Marks strands and islands with contacts that no constraint represents, after the last search. False if the meter has
    /// halted it.
    pub fn report_undetected<S>(
        &mut self,
        stepping: &Stepping<S>,
        strands: &mut [ConstrainedStrand],
        islands: &mut [Island],
    ) -> bool {
        let undetected = self.undetected(stepping, strands, islands);
        for end in undetected.iter().flatten().flat_map(StepConstraint::ends) {
            let strand = &mut strands[end.strand as usize];
            strand.has_undetected = true;
            islands[strand.island as usize].progress.ending.doubt();
        }
        let whole = undetected.is_some();
        self.undetected = undetected.unwrap_or_default();
        whole
    }

    /// Adds the undetected contacts of the last search to the islands' constraints: true if there are any. All constraints are
    /// then in `constraints`, from which islands are formed again.
    pub fn add_undetected<S>(
        &mut self,
        stepping: &Stepping<S>,
        strands: &mut [ConstrainedStrand],
        islands: &mut [Island],
        constraints: &mut Vec<StepConstraint>,
    ) -> bool {
        constraints.clear();
        let Some(mut undetected) = self.undetected(stepping, strands, islands) else {
            return false;
        };
        leave_wild_ones(&mut undetected, strands, islands);
        if undetected.is_empty() {
            self.undetected = undetected;
            return false;
        }
        for constrained in strands.iter_mut() {
            let island = &islands[constrained.island as usize];
            (constrained.ended, constrained.progress) = (island.ended(), island.unfinished());
            constrained.resting |= constrained.ended.is_some_and(|ending| ending.is_converged());
        }
        for end in undetected.iter().flat_map(StepConstraint::ends) {
            let strand = &mut strands[end.strand as usize];
            (strand.ended, strand.progress) = (None, None);
        }
        // Attachments are made again; the models of resting strands are not.
        for constrained in &*strands {
            let constraints = &mut islands[constrained.island as usize].constraints;
            for end in &constrained.attachments {
                constraints[end.constraint as usize].modelled[usize::from(end.second)] = end.modelled;
            }
        }
        for island in islands.iter_mut() {
            constraints.append(&mut island.constraints);
        }
        let known_of = &mut self.known_of;
        known_of.reset(strands.len());
        for constraint in undetected.drain(..) {
            known_of.take_in(constraints);
            let (mut give, mut nearest) = (Give::No, None);
            let known = known_of.strand(constraint.first.strand).map(|index| (index, &constraints[index]));
            for (index, known) in known.filter(|(_, known)| known.is_with(&constraint)) {
                // A yielding pair of surfaces yields everywhere.
                give = give.max(known.give);
                let apart = apart(known, &constraint, strands);
                let turned = known.turned(&constraint);
                let same = !known.deep && turned < 1.0 - SAME_SIDE && apart <= SAME_PLACE * constraint.margin();
                // A point in a crease has two contacts.
                let unlike = apart + turned * constraint.margin();
                if same && nearest.is_none_or(|(_, least)| unlike <= least) {
                    nearest = Some((index, unlike));
                }
            }
            // A known contact moves to its deepest point; any other is new, also beside a yielding one.
            let constraint = StepConstraint { give, ..constraint };
            match nearest {
                Some((known, _)) if constraints[known].has_left(&constraint) => {
                    constraints.push(StepConstraint { in_crease: true, ..constraint })
                }
                Some((known, _)) => {
                    let StepConstraint { force, in_crease, .. } = constraints[known];
                    constraints[known] = StepConstraint { force, in_crease, ..constraint };
                }
                None => constraints.push(constraint),
            }
        }
        self.undetected = undetected;
        true
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
        // Springs have no tolerated depth.
        let may = if stepping.options.model.is_soft() { 0.0 } else { stepping.options.tolerance };
        let mut behind = Vec::new();
        for (constrained, contact) in self.found(strands) {
            if contact.gap >= -may {
                continue;
            }
            let constraint = self.constraint(stepping, strands, constrained, contact);
            let depth = depth(&constraint, strands, stepping.options.tolerance);
            for end in constraint.ends() {
                let left = &mut islands[strands[end.strand as usize].island as usize].left;
                left.deep = left.deep.max(depth);
                left.newly = left.newly.max(if constraint.deep || !step { 0.0 } else { depth });
            }
            if step && !strands[constrained as usize].lags() && constraint.is_behind(-depth) {
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

    /// Stores the contacts' forces as the warm start of the next substep.
    pub fn store_warm_start<'a>(&mut self, islands: impl Iterator<Item = &'a Island>, strands: &[ConstrainedStrand]) {
        self.warm_start.clear();
        for constraint in islands.flat_map(|island| &island.constraints).filter(|constraint| constraint.force != Vector3::zeros())
        {
            let with = match (constraint.kind, constraint.second) {
                (ConstraintKind::Body { body, .. }, _) => With::Body(body),
                (ConstraintKind::Hair { .. }, Some(second)) => With::Strand(strands[second.strand as usize].index),
                _ => continue,
            };
            let strand = &strands[constraint.first.strand as usize];
            let along = strand.along(&constraint.first.material_point);
            self.warm_start.push(WarmStartForce { strand: strand.index, with, along, force: constraint.force });
        }
        self.sort_warm_start();
    }

    fn sort_warm_start(&mut self) {
        self.warm_start.sort_by(|a, b| (a.strand, a.with).cmp(&(b.strand, b.with)).then(a.along.total_cmp(&b.along)));
    }

    /// Adds the forces of strands that took the substep in substeps.
    pub fn keep_warm_start_of(&mut self, substeps: &Self) {
        self.warm_start.extend_from_slice(&substeps.warm_start);
        self.sort_warm_start();
    }
}

/// Removes the new contacts of strands that are far from convergence and overlap many others there: their real contacts are
/// visible when they have come nearer to it. (Thousands of such contacts would hold the strands of a tangle.)
fn leave_wild_ones(undetected: &mut Vec<StepConstraint>, strands: &[ConstrainedStrand], islands: &[Island]) {
    let is_wild = |constrained: u32| {
        strands[constrained as usize].residual > WILD && !islands[strands[constrained as usize].island as usize].done
    };
    let mut ends: Vec<u32> = undetected
        .iter()
        .flat_map(StepConstraint::ends)
        .map(|end| end.strand)
        .filter(|constrained| is_wild(*constrained))
        .collect();
    ends.sort_unstable();
    let wild: Vec<u32> = ends.chunk_by(|a, b| a == b).filter(|ends| ends.len() > CROWD).map(|ends| ends[0]).collect();
    undetected.retain(|constraint| !constraint.ends().any(|end| wild.binary_search(&end.strand).is_ok()));
}

/// The constraints of which a strand is the first end, the last first.
#[derive(Debug, Default)]
struct KnownOf {
    last: Vec<Option<usize>>,
    before: Vec<Option<usize>>,
}

impl KnownOf {
    /// For this number of strands, without constraints.
    fn reset(&mut self, strands: usize) {
        self.last.clear();
        self.last.resize(strands, None);
        self.before.clear();
    }

    /// Adds the new entries of a list of constraints.
    fn take_in(&mut self, constraints: &[StepConstraint]) {
        for (index, constraint) in constraints.iter().enumerate().skip(self.before.len()) {
            self.before.push(self.last[constraint.first.strand as usize].replace(index));
        }
    }

    fn strand(&self, constrained: u32) -> impl Iterator<Item = usize> {
        std::iter::successors(self.last[constrained as usize], |index| self.before[*index])
    }
}

/// Whether an existing constraint already represents the overlap of this contact: it is as deep elsewhere, and yields or is
/// beside it.
fn is_reported(constraint: &StepConstraint, strands: &[ConstrainedStrand], islands: &[Island], tolerance: f64) -> bool {
    let strand = &strands[constraint.first.strand as usize];
    let known = strand.attachments.iter().map(|end| &islands[strand.island as usize].constraints[end.constraint as usize]);
    let beside = |known: &StepConstraint| apart(known, constraint, strands) <= SAME_PLACE * constraint.margin();
    let mut as_deep = known.filter(|known| known.is_with(constraint) && !known.deep && known.gap <= constraint.gap + tolerance);
    as_deep.any(|known| known.give != Give::No || beside(known))
}

/// The larger distance of two contacts of a strand with the same partner, along the strand or along the partner, m.
fn apart(one: &StepConstraint, other: &StepConstraint, strands: &[ConstrainedStrand]) -> f64 {
    let along = |end: &ConstraintEnd| strands[end.strand as usize].along(&end.material_point);
    let off = |a: &ConstraintEnd, b: &ConstraintEnd| (along(a) - along(b)).abs();
    let first = off(&one.first, &other.first);
    match (&one.second, &other.second) {
        (Some(a), Some(b)) => first.max(off(a, b)),
        _ => first,
    }
}

/// Strands that have moved by no more than this since their last search are not searched again, m.
pub(super) fn unseen(options: &ContactOptions) -> f64 {
    UNSEEN * options.tolerance
}

/// The search distances for these wisps.
pub(crate) fn pair_options(wisps: &[Wisp]) -> PairOptions {
    let largest = wisps.iter().fold(0.0_f64, |a, wisp| a.max(wisp.radius));
    PairOptions { activation: NEAR.min(NEAR_HAIR * largest), margin: MARGIN * largest }
}

fn end(constrained: u32, place: &StrandPoint) -> ConstraintEnd {
    ConstraintEnd { strand: constrained, material_point: MaterialPoint::on(place.element as usize, place.s) }
}
