//! Who touches whom in a substep: bodies and strands found near held strands, as joints.
//!
//! Files:
//!
//! - `memory.rs`: What is kept of touches from substep to substep, taken out and put back, for images of a scene.
//! - `permitted_overlaps.rs`: Touches of strands that may overlap what they touch: their surfaces are nearer to their centrelines there.

mod memory;
mod permitted_overlaps;

use nalgebra::Vector3;

pub(super) use memory::{NearStrands, TouchMemory};

use super::constraints::{Constraint, ConstraintStatus, Hold};
use super::holding::Scene;
use super::id::StrandId;
use crate::chain::load::MaterialPoint;
use crate::contact::hair_pairs::{HairPairs, PairOptions, Tie};
use crate::contact::held_strand::HeldStrand;
use crate::contact::island::Island;
use crate::contact::joint::{Give, Joint, JointEnd, JointKind, SAME_SIDE};
use crate::contact::law::Law;
use crate::contact::nearest_pair::depth;
use crate::contact::options::{ContactOptions, GRAVITY};
use crate::contact::pieces::Wisp;
use crate::contact::touch::{Partner, Place, StrandPath, Touch};
use crate::contact::touches::TouchScratch;
use crate::platform::Instant;

/// Surfaces nearer than this at the present iterate are touches, m; nearer than this share of the largest wisp's radius for strands.
pub(super) const NEAR: f64 = 1e-3;
const NEAR_HAIR: f64 = 0.1;
/// Pairs of strands are searched anew when one has moved by this share of the largest wisp's radius.
const MARGIN: f64 = 0.5;
/// Surfaces are in each other when a step begins where they are so many tolerances deep: more than a step's end leaves.
const DEEP: f64 = 2.0;
/// How deep in a body a strand is looked for at a substep's start, m.
const DEEPEST: f64 = 0.1;
/// A strand that has gone less than this part of the touches' tolerance since it was searched is not searched again.
const UNSEEN: f64 = 0.1;
/// A touch that was missed is one that is known, seen from where the strands are now, if along the strand it is no further from it than this share
/// of what holds the surfaces' centres apart: side by side they would be one force in two places, which no solve can tell apart.
const SAME_PLACE: f64 = 0.5;
/// While its iteration goes on, a strand with an element further than this from its end, rad, and more new touches than this is not where it will
/// touch anything.
const WILD: f64 = 1.0;
const CROWD: usize = 20;
/// A solve leaves no larger force where there should be none than this many times what its residual is in the strand's weight.
const LEFT_OVER: f64 = 2.0;
/// A touch is one that was known in the last step if along the strand it is no further from it than this share of the strand's length.
const SAME: f64 = 0.02;

/// What a touch is with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum With {
    Body(u32),
    Strand(u32),
}

/// A touch of the last substep.
#[derive(Debug, Clone, Copy)]
pub(super) struct Remembered {
    pub strand: u32,
    pub with: With,
    pub along: f64,
    pub force: Vector3<f64>,
}

/// What it takes to search an element near bodies, and a pair of pieces of strands, nanoseconds or so.
const WORK_AN_ELEMENT: u64 = 1000;
const WORK_A_CANDIDATE: u64 = 1000;

/// Pairs of strands that are looked at together.
const PART: usize = 32;

/// Some pairs of strands, by the first of them, and their touches.
#[derive(Debug, Default)]
struct PairPart {
    from: usize,
    touches: Vec<Touch>,
    scratch: TouchScratch,
}

/// The search and its memory.
#[derive(Debug, Default)]
pub(super) struct Touching {
    pairs: HairPairs,
    /// What `pairs` was set for: a wisp a held strand, and which strands these are.
    wisps: Vec<Wisp>,
    of: Vec<u32>,
    ready: bool,
    hair: Vec<Touch>,
    parts: Vec<PairPart>,
    /// Which of the wisps are tied together.
    ties: Vec<Tie>,
    /// Some of the strands may overlap others or bodies.
    allows: bool,
    remembered: Vec<Remembered>,
    /// Seconds that searches took since somebody asked.
    seconds: f64,
    /// Memory of [`Touching::missed`] and of [`Touching::add_missed`].
    missed: Vec<Joint>,
    left_deep: Vec<JointEnd>,
    known_of: KnownOf,
}

impl Touching {
    /// The seconds that searches took since this was asked last.
    pub fn take_seconds(&mut self) -> f64 {
        std::mem::take(&mut self.seconds)
    }

    /// Forgets the last substep's touches and pairs.
    pub fn forget(&mut self) {
        self.remembered.clear();
        self.ready = false;
    }

    /// Forgets which strands are near each other.
    pub fn forget_pairs(&mut self) {
        self.ready = false;
    }

    /// Whether anything can touch at all.
    pub fn is_possible(&self, scene: &Scene) -> bool {
        !scene.bodies.is_empty() || scene.options.hair
    }

    /// Begins a substep.
    pub fn begin_step(&mut self) {
        self.pairs.begin_step();
    }

    /// Finds the touches at the present iterate of all strands that have moved since they were searched last: what two others do to each
    /// other is known. At a substep's start also those that may come to touch, later only what is in each other. Where the meter halts it some are
    /// missing, and these strands have still moved.
    pub fn find(&mut self, scene: &Scene, strands: &mut [HeldStrand], at_start: bool) {
        let begins = Instant::now();
        self.search(scene, strands, at_start);
        self.seconds += begins.elapsed().as_secs_f64();
    }

    fn search(&mut self, scene: &Scene, strands: &mut [HeldStrand], at_start: bool) {
        self.hair.clear();
        if at_start {
            self.allows = scene.strands.iter().any(|strand| strand.permitted_overlap.is_some());
        }
        let unseen = unseen(scene.options);
        for held in strands.iter_mut() {
            held.found.clear();
        }
        if !scene.bodies.is_empty() {
            let all = &*scene.strands;
            scene.workers.for_each(strands, |held, _| {
                if held.has_gone(unseen) && !scene.meter.is_halted() {
                    held.find_bodies(scene.bodies, NEAR);
                    scene.meter.spend(held.path().now.elements.len() as u64 * WORK_AN_ELEMENT);
                    if let Some(permitted_overlap) = all[held.index as usize].permitted_overlap.as_deref() {
                        permitted_overlaps::give_way_to_bodies(held, permitted_overlap, NEAR);
                    }
                }
            });
        }
        if scene.options.hair && !scene.meter.is_halted() {
            self.find_hair(scene, strands, at_start);
        }
        if scene.meter.is_halted() {
            return;
        }
        for held in strands.iter_mut().filter(|held| held.has_gone(unseen)) {
            held.held.gone = 0.0;
        }
    }

    fn find_hair(&mut self, scene: &Scene, strands: &[HeldStrand], at_start: bool) {
        let within = if at_start { NEAR } else { 0.0 };
        let meets_hair = |held: &HeldStrand| held.touches && held.contact.wisp_radius > 0.0 && !held.alone;
        let wisps = || strands.iter().enumerate().filter(|(_, held)| meets_hair(held));
        let paths: Vec<StrandPath> = wisps().map(|(k, held)| StrandPath { index: k as u32, ..held.path() }).collect();
        let same = self.of.len() == paths.len() && wisps().zip(&self.of).all(|((_, held), of)| held.index == *of);
        let anew = !(self.ready && same);
        if anew {
            self.of = wisps().map(|(_, held)| held.index).collect();
            self.wisps = wisps().map(|(_, held)| held.contact.wisp()).collect();
            self.ready = self.pairs.set(&self.wisps, &pair_options(&self.wisps)).is_ok();
        }
        if anew || at_start {
            let Self { of, ties, .. } = self;
            tied(scene.constraints, |id| of.binary_search(&(scene.slots.index(id)? as u32)).ok(), ties);
            self.ready &= self.pairs.set_ties(&self.ties).is_ok();
        }
        self.ready &= self.pairs.update_by(&paths, scene.workers, scene.meter).is_ok();
        if !self.ready {
            return;
        }
        let moved: Vec<bool> = wisps().map(|(_, held)| held.has_gone(unseen(scene.options))).collect();
        // In parts of a fixed size, put together in their order: the same touches whoever finds them.
        let groups: Vec<_> = self.pairs.groups().iter().filter(|pair| moved[pair.a as usize] || moved[pair.b as usize]).collect();
        let parts = groups.len().div_ceil(PART);
        self.parts.resize_with(self.parts.len().max(parts), PairPart::default);
        for (k, part) in self.parts[..parts].iter_mut().enumerate() {
            part.from = k * PART;
        }
        let (pairs, allows, all) = (&self.pairs, self.allows, &*scene.strands);
        scene.workers.for_each_task(&mut self.parts[..parts], 1, 1, |parts, _| {
            for PairPart { from, touches, scratch } in parts {
                touches.clear();
                for group in groups[*from..].iter().take(PART).take_while(|_| !scene.meter.is_halted()) {
                    pairs.touches(group, &paths, within, scratch, touches);
                    scene.meter.spend(u64::from(group.candidates()) * WORK_A_CANDIDATE);
                }
                if allows {
                    permitted_overlaps::give_way_to_hair(all, strands, within.min(pairs.activation()), touches);
                }
            }
        });
        for part in &self.parts[..parts] {
            self.hair.extend_from_slice(&part.touches);
        }
    }

    /// The joints of all touches found.
    pub fn joints(&mut self, scene: &Scene, strands: &[HeldStrand], joints: &mut Vec<Joint>) {
        joints.extend(self.found(strands).map(|(held, touch)| self.joint(scene, strands, held, touch)));
    }

    fn joint(&self, scene: &Scene, strands: &[HeldStrand], held: u32, touch: &Touch) -> Joint {
        let strand = &strands[held as usize];
        let first = end(held, &touch.place);
        let (second, kind, with) = match touch.partner {
            Partner::Body { body, feature } => {
                let at = &scene.bodies[body as usize];
                let margin = permitted_overlaps::radius(scene.strands, strand, &first.material_point) + at.thickness;
                let point = strand.end_state(&first.material_point).now - touch.normal * (touch.gap + margin);
                let (normal, carried) = (touch.normal, touch.carried);
                let kind = JointKind::Body {
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
                    // What a knot near by, or what the strands may overlap, has left of the radii.
                    let apart = strand.end_state(&first.material_point).now - other.end_state(&second.material_point).now;
                    touch.normal.dot(&apart) - touch.gap
                };
                let kind = JointKind::Hair { normal: touch.normal, margin };
                (Some(second), kind, With::Strand(other.index))
            }
        };
        let deep = !scene.options.model.is_soft() && touch.gap < 0.0 && self.was_deep(scene, strands, &first, second, kind);
        let force = self.recall(strand.index, with, strand.along(&first.material_point), strand.length());
        // A force that draws is none of a touch; and so small a one as the solve may leave where there is none would stay for ever on a
        // strand that leaves.
        let lightest = second.map_or(strand.mass, |end| strand.mass.min(strands[end.held as usize].mass));
        let is_left_over = !scene.options.model.is_soft()
            && touch.gap > 0.0
            && force.norm_squared() <= (LEFT_OVER * scene.options.residual * lightest * GRAVITY).powi(2);
        let force = if force.dot(&touch.normal) > 0.0 && !is_left_over { force } else { Vector3::zeros() };
        Joint { gap: touch.gap, deep, ..Joint::new(first, second, kind, force) }
    }

    /// Whether the surfaces of a touch were in each other when the substep began.
    fn was_deep(
        &self,
        scene: &Scene,
        strands: &[HeldStrand],
        first: &JointEnd,
        second: Option<JointEnd>,
        kind: JointKind,
    ) -> bool {
        let strand = &strands[first.held as usize];
        let (allowed, at) = (DEEP * scene.options.tolerance, strand.end_state(&first.material_point).start);
        match (kind, second) {
            (JointKind::Body { body, .. }, _) => {
                let radius = permitted_overlaps::radius(scene.strands, strand, &first.material_point);
                radius + strand.met(scene.bodies, body).depth_at_start(at, DEEPEST) > allowed
            }
            (JointKind::Hair { margin, .. }, Some(end)) => {
                let apart = (at - strands[end.held as usize].end_state(&end.material_point).start).norm();
                apart < margin - allowed
            }
            _ => false,
        }
    }

    /// The force that such a touch had in the last substep.
    fn recall(&self, strand: u32, with: With, along: f64, length: f64) -> Vector3<f64> {
        let from = self.remembered.partition_point(|seen| (seen.strand, seen.with) < (strand, with));
        let mut best = (SAME * length, Vector3::zeros());
        for seen in self.remembered[from..].iter().take_while(|seen| (seen.strand, seen.with) == (strand, with)) {
            let off = (seen.along - along).abs();
            if off <= best.0 {
                best = (off, seen.force);
            }
        }
        best.1
    }

    /// Of the touches found last, those that overlap where the strands are now and that no joint tells of. None where the meter has halted it:
    /// strands with touches have then still moved.
    fn missed(&mut self, scene: &Scene, strands: &mut [HeldStrand], islands: &[Island], h: f64) -> Option<Vec<Joint>> {
        let (mut missed, mut left_deep, mut halted) =
            (std::mem::take(&mut self.missed), std::mem::take(&mut self.left_deep), false);
        missed.clear();
        for (index, (held, touch)) in self.found(strands).enumerate() {
            halted = scene.meter.is_halted_at(index);
            if halted {
                break;
            }
            if touch.gap >= -scene.options.tolerance || islands[strands[held as usize].island as usize].is_given_up() {
                continue;
            }
            let mut joint = self.joint(scene, strands, held, touch);
            if joint.deep {
                // It gives way; how deep it is says nothing, but is told.
                left_deep.extend(joint.ends());
                continue;
            }
            let first = &strands[held as usize];
            let a = first.end_state(&joint.first.material_point);
            let other = joint.second.map(|end| (&strands[end.held as usize], end.material_point));
            let (b, contact) = other
                .map_or((a, &first.contact), |(strand, material_point)| (strand.end_state(&material_point), &strand.contact));
            let (law, u) = joint.evaluate([a, b], [&first.contact, contact], scene.options, h);
            let overlaps = matches!(law, Law::Contact(law) if law.normal.dot(&u) < -scene.options.tolerance);
            if overlaps && !is_told(&joint, strands, islands, scene.options.tolerance) {
                missed.push(joint);
            }
        }
        for end in left_deep.drain(..) {
            strands[end.held as usize].left_deep = true;
        }
        self.left_deep = left_deep;
        if halted {
            let with_touches: Vec<u32> = self.found(strands).map(|(held, _)| held).collect();
            with_touches.iter().for_each(|held| strands[*held as usize].held.gone = f64::INFINITY);
        }
        (!halted).then_some(missed)
    }

    /// Tells the strands, and their islands, that have touches which no joint holds, when there is to be no other search.
    /// False where the meter has halted it.
    pub fn tell_missed(&mut self, scene: &Scene, strands: &mut [HeldStrand], islands: &mut [Island], h: f64) -> bool {
        let missed = self.missed(scene, strands, islands, h);
        for end in missed.iter().flatten().flat_map(Joint::ends) {
            let strand = &mut strands[end.held as usize];
            strand.overlooked = true;
            islands[strand.island as usize].ending.converged = false;
        }
        let whole = missed.is_some();
        self.missed = missed.unwrap_or_default();
        whole
    }

    /// Adds what the last search found and no joint tells of to the islands' joints: true if there is any. All joints are then in `joints`,
    /// for islands to be made anew.
    pub fn add_missed(
        &mut self,
        scene: &Scene,
        strands: &mut [HeldStrand],
        islands: &mut [Island],
        joints: &mut Vec<Joint>,
        h: f64,
    ) -> bool {
        joints.clear();
        let Some(mut missed) = self.missed(scene, strands, islands, h) else {
            return false;
        };
        leave_wild_ones(&mut missed, strands, islands);
        if missed.is_empty() {
            self.missed = missed;
            return false;
        }
        for held in strands.iter_mut() {
            held.ended = islands[held.island as usize].ended();
            held.resting |= held.ended.is_some_and(|ending| ending.converged);
        }
        for end in missed.iter().flat_map(Joint::ends) {
            strands[end.held as usize].ended = None;
        }
        // Attachments are made anew; the models of strands that rest are not.
        for held in &*strands {
            let joints = &mut islands[held.island as usize].joints;
            for end in &held.attachments {
                joints[end.joint as usize].modelled[usize::from(end.second)] = end.modelled;
            }
        }
        for island in islands.iter_mut() {
            joints.append(&mut island.joints);
        }
        let known_of = &mut self.known_of;
        known_of.reset(strands.len());
        for joint in missed.drain(..) {
            known_of.take_in(joints);
            let (mut give, mut nearest) = (Give::No, None);
            let known = known_of.strand(joint.first.held).map(|index| (index, &joints[index]));
            for (index, known) in known.filter(|(_, known)| known.is_with(&joint)) {
                // What yields does so all along.
                give = give.max(known.give);
                let apart = apart(known, &joint, strands);
                let turned = known.turned(&joint);
                let same = !known.deep && turned < 1.0 - SAME_SIDE && apart <= SAME_PLACE * joint.margin();
                // In a crease there are two of one place.
                let unlike = apart + turned * joint.margin();
                if same && nearest.is_none_or(|(_, least)| unlike <= least) {
                    nearest = Some((index, unlike));
                }
            }
            // One that is known moves to where it is deepest; any other is new, beside one that only gives way too.
            let joint = Joint { give, ..joint };
            match nearest {
                Some((known, _)) if joints[known].has_left(&joint) => joints.push(Joint { in_crease: true, ..joint }),
                Some((known, _)) => {
                    let Joint { force, in_crease, .. } = joints[known];
                    joints[known] = Joint { force, in_crease, ..joint };
                }
                None => joints.push(joint),
            }
        }
        self.missed = missed;
        true
    }

    /// Tells the islands how deep what the last search found is; where it is the `step`'s doing also that it is new, and the strands whether they are
    /// in a body, or behind it.
    pub fn tell_depths(&self, scene: &Scene, strands: &mut [HeldStrand], islands: &mut [Island], step: bool) {
        // What springs hold apart has no depth that it may have.
        let may = if scene.options.model.is_soft() { 0.0 } else { scene.options.tolerance };
        let mut behind = Vec::new();
        for (held, touch) in self.found(strands) {
            if touch.gap >= -may {
                continue;
            }
            let joint = self.joint(scene, strands, held, touch);
            let depth = depth(&joint, strands, scene.options.tolerance);
            for end in joint.ends() {
                let left = &mut islands[strands[end.held as usize].island as usize].left;
                left.deep = left.deep.max(depth);
                left.newly = left.newly.max(if joint.deep || !step { 0.0 } else { depth });
            }
            if step && !strands[held as usize].lags() && joint.is_behind(-depth) {
                behind.push(held);
            }
        }
        for held in behind {
            strands[held as usize].behind = true;
        }
    }

    /// What the last search found, and on which strand.
    fn found<'a>(&'a self, strands: &'a [HeldStrand]) -> impl Iterator<Item = (u32, &'a Touch)> {
        let bodies = strands.iter().enumerate().flat_map(|(k, held)| held.found.iter().map(move |touch| (k as u32, touch)));
        bodies.chain(self.hair.iter().map(|touch| (touch.place.strand, touch)))
    }

    /// Keeps the touches' forces for the next substep.
    pub fn remember<'a>(&mut self, islands: impl Iterator<Item = &'a Island>, strands: &[HeldStrand]) {
        self.remembered.clear();
        for joint in islands.flat_map(|island| &island.joints).filter(|joint| joint.force != Vector3::zeros()) {
            let with = match (joint.kind, joint.second) {
                (JointKind::Body { body, .. }, _) => With::Body(body),
                (JointKind::Hair { .. }, Some(second)) => With::Strand(strands[second.held as usize].index),
                _ => continue,
            };
            let strand = &strands[joint.first.held as usize];
            let along = strand.along(&joint.first.material_point);
            self.remembered.push(Remembered { strand: strand.index, with, along, force: joint.force });
        }
        self.sort_remembered();
    }

    fn sort_remembered(&mut self) {
        self.remembered.sort_by(|a, b| (a.strand, a.with).cmp(&(b.strand, b.with)).then(a.along.total_cmp(&b.along)));
    }

    /// Remembers also what is left of the touches of strands that took the substep in parts.
    pub fn remember_parts(&mut self, parts: &Self) {
        self.remembered.extend_from_slice(&parts.remembered);
        self.sort_remembered();
    }
}

/// Takes out the new touches of strands that are in the middle of nowhere and meet all the others there: what they touch is seen when they have come
/// nearer to their end. (Taken in, thousands held forty strands in a tangle: a step of 84 s.)
fn leave_wild_ones(missed: &mut Vec<Joint>, strands: &[HeldStrand], islands: &[Island]) {
    let is_wild = |held: u32| strands[held as usize].residual > WILD && !islands[strands[held as usize].island as usize].done;
    let mut ends: Vec<u32> = missed.iter().flat_map(Joint::ends).map(|end| end.held).filter(|held| is_wild(*held)).collect();
    ends.sort_unstable();
    let wild: Vec<u32> = ends.chunk_by(|a, b| a == b).filter(|ends| ends.len() > CROWD).map(|ends| ends[0]).collect();
    missed.retain(|joint| !joint.ends().any(|end| wild.binary_search(&end.held).is_ok()));
}

/// Which joints strands are the first end of: the last first.
#[derive(Debug, Default)]
struct KnownOf {
    last: Vec<Option<usize>>,
    before: Vec<Option<usize>>,
}

impl KnownOf {
    /// Of that many strands, no joints yet.
    fn reset(&mut self, strands: usize) {
        self.last.clear();
        self.last.resize(strands, None);
        self.before.clear();
    }

    /// Takes in what was added to a list of joints.
    fn take_in(&mut self, joints: &[Joint]) {
        for (index, joint) in joints.iter().enumerate().skip(self.before.len()) {
            self.before.push(self.last[joint.first.held as usize].replace(index));
        }
    }

    fn strand(&self, held: u32) -> impl Iterator<Item = usize> {
        std::iter::successors(self.last[held as usize], |index| self.before[*index])
    }
}

/// Whether a joint that there is already tells that this touch overlaps: its island is solved roughly so far, or has not come to its end, or it
/// yields, and is as deep elsewhere.
fn is_told(joint: &Joint, strands: &[HeldStrand], islands: &[Island], tolerance: f64) -> bool {
    let strand = &strands[joint.first.held as usize];
    let known = strand.attachments.iter().map(|end| &islands[strand.island as usize].joints[end.joint as usize]);
    let beside = |known: &Joint| apart(known, joint, strands) <= SAME_PLACE * joint.margin();
    let mut as_deep = known.filter(|known| known.is_with(joint) && !known.deep && known.gap <= joint.gap + tolerance);
    as_deep.any(|known| known.give != Give::No || beside(known))
}

/// How far two touches of a strand with the same partner are apart along the strand, or its partner, at most, m.
fn apart(one: &Joint, other: &Joint, strands: &[HeldStrand]) -> f64 {
    let along = |end: &JointEnd| strands[end.held as usize].along(&end.material_point);
    let off = |a: &JointEnd, b: &JointEnd| (along(a) - along(b)).abs();
    let first = off(&one.first, &other.first);
    match (&one.second, &other.second) {
        (Some(a), Some(b)) => first.max(off(a, b)),
        _ => first,
    }
}

/// Strands that have gone no further since they were searched are not searched again, m.
pub(super) fn unseen(options: &ContactOptions) -> f64 {
    UNSEEN * options.tolerance
}

/// How far to look for what touches these wisps.
pub(super) fn pair_options(wisps: &[Wisp]) -> PairOptions {
    let largest = wisps.iter().fold(0.0_f64, |a, wisp| a.max(wisp.radius));
    PairOptions { activation: NEAR.min(NEAR_HAIR * largest), margin: MARGIN * largest }
}

/// Which of the wisps constraints tie together: the wisps give way to each other there. `wisp` gives a strand's place among them.
pub(super) fn tied(constraints: &[Constraint], wisp: impl Fn(StrandId) -> Option<usize>, ties: &mut Vec<Tie>) {
    ties.clear();
    ties.extend(constraints.iter().filter_map(|constraint| match constraint.def.hold {
        Hold::Tie { other, arclength } if constraint.state.status != ConstraintStatus::Released => Some(Tie {
            strands: [wisp(constraint.def.strand)? as u32, wisp(other)? as u32],
            along: [constraint.state.arclength, arclength],
        }),
        _ => None,
    }));
}

fn end(held: u32, place: &Place) -> JointEnd {
    JointEnd { held, material_point: MaterialPoint::on(place.element as usize, place.s) }
}
