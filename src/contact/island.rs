//! Strands that joints tie together, directly or through others: their joints at the present iterate, and where their iteration ends. (The contact
//! problem of one iteration: `island_problem.rs`.)

use nalgebra::Vector3;

use super::body::BodyAt;
use super::contact_space::End;
use super::ending::Ending;
use super::gauss_seidel::Report;
use super::held_strand::{Attachment, HeldStrand};
use super::joint::{Give, Joint, JointKind, SAME_SIDE, Standing};
use super::law::Law;
use super::law::coefficient::Coefficient;
use super::law::contact::Friction;
use super::law::response::Response;
use super::nearest::nearest;
use super::options::{ContactModel, ContactOptions};
use crate::chain::load::MaterialPoint;

/// How nearly a bond must hold at the end of a step, m.
const BOND_TOLERANCE: f64 = 1e-10;
/// Where an island is solved roughly: the residual, as a part of its problem's size, and how far from its end an element may be, rad.
const ROUGH: f64 = 1e-3;
const ROUGH_TOLERANCE: f64 = 1e-3;
/// What the penalty models are content with: the same two.
const SOFT: f64 = 1e-3;
const SOFT_TOLERANCE: f64 = 2e-3;
/// A strand that ends further from the end than this, rad, has come to nowhere.
const LOST: f64 = 0.1;

/// Iterations in which what is left to do, or the number of strands and joints that have it to do, must halve: where it is good enough as it is;
/// in a large island whose touches may yet yield; and elsewhere. An island that does not get on will not.
const PATIENCE: [u32; 3] = [5, 15, 25];
/// So few iterations are a choice with penalties: what springs push out no further in this step they do in the next.
const CHOSEN: u32 = 10;
/// What an island that has not come to its end may be off by and still be kept as it is: a strand, rad; a touch, in units of the tolerance
/// of touches; a bond, m.
pub(super) const ENOUGH_TURN: f64 = 1e-2;
const ENOUGH_DEPTH: f64 = 2.0;
const ENOUGH_BOND: f64 = 1e-9;
/// Forces of touches beyond this many times what takes a strand its own length in a step are those of a problem that has no solution.
const NO_SOLUTION: f64 = 1e4;
/// So are those of constraints beyond this many times that and what bends an element by a radian. What can be held takes a few times as much
/// in the end, though more on the way; what cannot takes a thousandfold more in every iteration.
const CANNOT_HOLD: f64 = 1e12;
/// So many iterations in a row that move no strand by more than this part of what may be left, or whose contact problem is left with more than
/// this residual, end an island with constraints: they leave its touches no room (of the hard models; others give way).
const IDLE: u32 = 5;
const STILL: f64 = 1e-2;
const HOPELESS: f64 = 0.1;

/// A strand rests while others go on where it is nearer to the end than this part of what may be left; and until forces that changed would
/// move it by more than that (an element's length times the angle).
const REST: f64 = 0.3;
/// In an island of no more strands none rests, and it is not solved roughly first.
pub const FEW: usize = 20;

/// How far a relaxed constraint gives way, in units of what its force would move the whole strand by in a step.
const RELAXED: f64 = 0.03;
/// The same of a single touch that yields.
const YIELDS: f64 = 0.003;
/// How far from a body's surface a touch is looked at again, m.
const LOOK: f64 = 0.01;
/// In how many of an island's first iterations that is done: in a crease or a mesh's notch a touch would be on one face and on another in
/// turn for ever. What is missed so is found by the search at the step's end.
pub(super) const LOOKS: u32 = 6;
/// By how much more than before a normal may point along the strand.
const ALONG: f64 = 0.1;

/// How deep surfaces are in each other, m.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Left {
    /// At most.
    pub deep: f64,
    /// Where they were not when the step began.
    pub newly: f64,
}

/// Strands that hang together.
#[derive(Debug, Default)]
pub struct Island {
    /// Indices among the held strands, ascending.
    pub strands: Vec<u32>,
    /// What holds them.
    pub joints: Vec<Joint>,
    /// The last contact problem's report.
    pub report: Report,
    /// What its next contact problem may take, nanoseconds or so.
    pub most_work: u64,
    /// Sweeps so far.
    pub sweeps: u32,
    /// Newton iterations so far.
    pub iterations: u32,
    /// Whether it is solved no more exactly than it takes to see which touches there are: [`Island::refine`] goes on to the end.
    pub rough: bool,
    /// Whether its strands' iterations have ended.
    pub done: bool,
    /// How they have ended, or stand so far.
    pub ending: Ending,
    /// How deep it is left, m, as far as that was searched for: at most, and where it was not when the step began.
    pub left: Left,
    /// Whether its strands take the substep in parts: this end of theirs is not to be.
    pub takes_parts: bool,
    /// Its forces grew beyond measure.
    pub beyond: bool,
    /// How often strands of it were bent, see `kink.rs`.
    pub kinked: u32,
    /// How often joints were relaxed in it.
    pub relaxings: u32,
    /// Whether bonds that do not give way hold strands to the world in this iteration.
    pub bonded_to_world: bool,
    /// Whether strands may rest: constraints are to hold to the last digit, and few strands come to their end sooner together.
    pub may_rest: bool,
    /// How far from the end a strand may be to rest, rad, and its joints' residual.
    pub rest: f64,
    /// See `rest`.
    pub rest_miss: f64,
    /// The least that was left to do, in units of what may be, and the iteration that it was halved in.
    best: (f64, u32),
    /// The same of how many strands and joints were not at their end.
    fewest: (usize, u32),
    /// Iterations in a row that led nowhere, see [`IDLE`].
    idle: u32,
    /// How deep the deepest of its touches that give way was when they were pushed on last, m, and how often that was.
    pub(super) pushed: (f64, u32),
    pub(super) ends: Vec<[End; 2]>,
    /// The joints that have a part in the present contact problem: a strand at their ends moves.
    pub(super) parts: Vec<u32>,
    pub(super) has_part: Vec<bool>,
    /// Whether a strand has such joints.
    pub(super) strand_has_part: Vec<bool>,
}

impl Island {
    /// Empties it.
    pub fn clear(&mut self) {
        self.strands.clear();
        self.joints.clear();
        (self.sweeps, self.iterations, self.ending) = (0, 0, Ending::default());
        (self.done, self.beyond, self.rest, self.rough) = (false, false, -1.0, false);
        (self.kinked, self.relaxings, self.report) = (0, 0, Report::default());
        (self.pushed, self.left, self.takes_parts) = ((f64::INFINITY, 0), Left::default(), false);
        self.begin_to_count(0);
    }

    /// Progress is counted from this iteration on.
    pub(super) fn begin_to_count(&mut self, iteration: u32) {
        (self.best, self.fewest, self.idle) = ((f64::INFINITY, iteration), (usize::MAX, iteration), 0);
    }

    /// Goes on from where it was solved roughly. True if there is more to do.
    pub fn refine(&mut self) -> bool {
        let goes_on = self.rough && self.ending.came_to_end;
        if goes_on {
            // What rested did so by what was asked then.
            (self.done, self.ending.converged, self.ending.came_to_end, self.rest) = (false, false, false, -1.0);
            self.begin_to_count(self.iterations);
        }
        self.rough = false;
        goes_on
    }

    /// How nearly the laws of touches are to hold.
    pub(super) fn asked(&self, options: &ContactOptions) -> f64 {
        let size = self.report.size.max(1.0);
        let in_the_end = match options.model {
            ContactModel::Coulomb => options.residual,
            ContactModel::Penalty | ContactModel::RegularisedPenalty => SOFT * size,
        };
        if self.rough { in_the_end.max(ROUGH * size) } else { in_the_end }
    }

    /// Finds every joint's ends among its strands' attachments, once they are in order.
    pub fn find_ends(&mut self, strands: &[HeldStrand]) {
        self.ends.clear();
        self.ends.resize(self.joints.len(), [End { strand: 0, point: 0 }; 2]);
        for (local, held) in self.strands.iter().enumerate() {
            for (point, attachment) in strands[*held as usize].attachments.iter().enumerate() {
                self.ends[attachment.joint as usize][usize::from(attachment.second)] =
                    End { strand: local as u32, point: point as u32 };
            }
        }
    }

    /// Whether a strand of it has come to nowhere, all that could be tried done: those alone that are astray themselves, which may free the
    /// others; all where not one iteration was possible.
    pub fn has_lost(&self, strand: &HeldStrand) -> bool {
        let all = self.iterations <= 1;
        self.ending.lost && (all || strand.residual > LOST || strand.residual.is_nan())
    }

    /// Whether a strand ends in a body that it was not in when the step began, or beyond it.
    pub fn is_behind(&self, strand: &HeldStrand) -> bool {
        let joint = |end: &Attachment| &self.joints[end.joint as usize];
        strand.attachments.iter().map(joint).any(|joint| joint.is_behind(joint.gap))
    }

    /// Whether strands of it touch something.
    pub fn has_touches(&self) -> bool {
        self.joints.iter().any(Joint::is_touch)
    }

    /// Adds the held strands to `pressed` that run into what they touch if no force acts, when all have done the first half of an iteration.
    pub fn about_to_press(&mut self, strands: &[HeldStrand], pressed: &mut Vec<u32>) {
        self.find_ends(strands);
        for (joint, [first, second]) in self.joints.iter().zip(&self.ends) {
            let (JointKind::Body { normal, .. } | JointKind::Hair { normal, .. }) = joint.kind else { continue };
            let way = |end: &End| strands[self.strands[end.strand as usize] as usize].free(end.point);
            let way = way(first) - joint.second.map_or(Vector3::zeros(), |_| way(second));
            if joint.gap + normal.dot(&way) < 0.0 {
                pressed.extend(joint.ends().map(|end| end.held));
            }
        }
    }

    /// Lets it be solved roughly at first, if it has touches and is large.
    pub fn begin_roughly(&mut self) {
        self.rough = self.strands.len() > FEW && self.has_touches();
    }

    /// Whether the joints at these ends hold, and none of them gives way.
    pub fn holds(&self, ends: &[Attachment]) -> bool {
        let holds = |end: &Attachment| {
            let joint = &self.joints[end.joint as usize];
            joint.standing.holds && joint.give == Give::No
        };
        ends.iter().all(holds)
    }

    /// Before an iteration: rings go where the strands run through them, bodies' surfaces are looked at from where their touches are.
    pub fn refresh(&mut self, strands: &[HeldStrand], bodies: &[BodyAt]) {
        self.bonded_to_world = false;
        self.may_rest = self.strands.len() > FEW && !self.is_constrained();
        for joint in &mut self.joints {
            let strand = &strands[joint.first.held as usize];
            self.bonded_to_world |= joint.give == Give::No && matches!(joint.kind, JointKind::Pin { compliance: 0.0, .. });
            if strand.resting || joint.dormant || joint.in_crease {
                continue;
            }
            match &mut joint.kind {
                JointKind::Ring { target, .. } => {
                    let MaterialPoint { element, s, .. } = joint.first.material_point;
                    let (element, s) = nearest(&strand.path().now, element, s, *target);
                    joint.first.material_point = MaterialPoint::on(element, s);
                }
                JointKind::Body { body, feature, normal, side, point, carried, .. } if self.iterations < LOOKS => {
                    let (body, at) = (strand.met(bodies, *body), strand.end_state(&joint.first.material_point));
                    if let Some(surface) = body.closest_at_end(at.now, LOOK) {
                        let new = body.to_world(&surface.normal);
                        // Another side of an edge or a sheet is another surface, and so is a face beside the edge that the strand lies across.
                        let along = |normal: &Vector3<f64>| normal.dot(&at.tangent).abs();
                        if new.dot(side) > SAME_SIDE && along(&new) < along(normal) + ALONG {
                            (*normal, *point) = (new, body.surface_at_end(&surface));
                            (*feature, *carried) = (surface.feature, body.carried(&surface));
                        }
                    }
                }
                JointKind::Body { .. } | JointKind::Hair { .. } | JointKind::Pin { .. } | JointKind::Tie { .. } => {}
            }
        }
    }

    pub(super) fn evaluate(
        &mut self,
        joint: usize,
        strands: &[HeldStrand],
        options: &ContactOptions,
        step: f64,
    ) -> (Law, Vector3<f64>) {
        let ends = &self.ends[joint];
        let joint = &mut self.joints[joint];
        let relaxed = joint.give == Give::Much;
        let first = &strands[joint.first.held as usize];
        let second = joint.second.map_or(first, |end| &strands[end.held as usize]);
        let a = first.place(ends[0].point);
        let b = joint.second.map_or(a, |_| second.place(ends[1].point));
        let (mut law, mut u) = joint.evaluate([a, b], [&first.contact, &second.contact], options, step);
        if relaxed || joint.deep || joint.give == Give::ALittle {
            let part = if relaxed || joint.deep { RELAXED } else { YIELDS };
            let compliance = part * step * step / first.mass.min(second.mass);
            match &mut law {
                Law::Bond(bond) => bond.compliance = bond.compliance.max(compliance),
                Law::Ring(ring) => ring.friction = Coefficient::uniform(0.0),
                Law::Contact(contact) => {
                    // A groom may be drawn with a strand between two surfaces that both push it into the other: no force parts these.
                    let most = 1.0 / compliance;
                    match &mut contact.response {
                        Response::Hard => {
                            contact.response = Response::Penalty { stiffness: most, damping: 0.0, depth_at_start: 0.0 };
                        }
                        Response::Penalty { stiffness, .. } | Response::Regularised { stiffness, .. } => {
                            *stiffness = stiffness.min(most);
                        }
                    }
                    if joint.give != Give::No {
                        contact.friction = Friction::None;
                    }
                    joint.off = -u.dot(&contact.normal);
                    u -= contact.normal * joint.pushed;
                }
            }
        }
        (law, u)
    }

    /// How far the strands at a joint's ends, where they rest, are moved by the forces now, in units of an element's length.
    fn pushes_resting(&self, index: usize, strands: &[HeldStrand]) -> [f64; 2] {
        let ends = if self.joints[index].second.is_some() { 2 } else { 1 };
        let mut ways = [0.0; 2];
        for (moved, end) in ways.iter_mut().zip(&self.ends[index][..ends]) {
            let strand = &strands[self.strands[end.strand as usize] as usize];
            if strand.resting {
                let way = strand.given_way(end.point, &self.has_part, |joint| self.joints[joint].force).norm();
                let element = strand.length() / strand.held.now().1.len() as f64;
                *moved = if way.is_nan() { f64::INFINITY } else { way / element };
            }
        }
        ways
    }

    /// Whether constraints have a part in it.
    pub fn is_constrained(&self) -> bool {
        !self.joints.iter().all(Joint::is_touch)
    }

    /// What bends an element of the stiffest strand by about a radian, N.
    fn bending_force(&self, strands: &[HeldStrand]) -> f64 {
        self.strands.iter().map(|held| strands[*held as usize].bending).fold(0.0, f64::max)
    }

    /// The largest of its strands' [`HeldStrand::usual_force`], N.
    pub(super) fn usual_force(&self, strands: &[HeldStrand], step: f64) -> f64 {
        self.strands.iter().map(|held| strands[*held as usize].usual_force(step)).fold(0.0, f64::max)
    }

    /// After the second half: whether the iteration has ended, by the strands' residuals and by how far the laws are from holding where
    /// the strands are now.
    pub fn check(&mut self, strands: &[HeldStrand], options: &ContactOptions, tolerance: f64, step: f64) {
        let soft = options.model.is_soft();
        let enough_for_touches = match () {
            () if !self.has_touches() => 0.0,
            () if options.model.is_soft() => SOFT_TOLERANCE,
            () if self.rough => ROUGH_TOLERANCE,
            () => 0.0,
        };
        let tolerance_asked = tolerance;
        let tolerance = tolerance.max(enough_for_touches);
        let residual = self.strands.iter().map(|held| strands[*held as usize].residual).fold(0.0, f64::max);
        let mut good = residual <= tolerance;
        let mut enough = residual <= ENOUGH_TURN;
        let (mut rested, mut wakes_some) = (0.0_f64, false);
        let asked = self.asked(options);
        (self.rest, self.rest_miss) = (REST * tolerance, asked);
        self.ending.residual = 0.0;
        for index in 0..self.joints.len() {
            if !self.has_part[index] {
                if self.joints[index].dormant {
                    self.rouse(index, strands, options, step);
                }
                let Standing { miss, holds, nearly, .. } = self.joints[index].standing;
                (good, enough) = (good && holds, enough && nearly);
                rested = rested.max(miss);
                continue;
            }
            let before = self.joints[index].gap;
            let (law, u) = self.evaluate(index, strands, options, step);
            let joint = &self.joints[index];
            let moved = (joint.gap - before).abs();
            let miss = self.report.miss(&law, u, joint.force, step);
            self.ending.residual = self.ending.residual.max(miss);
            let (holds, nearly) = match law {
                Law::Bond(bond) => {
                    let off = bond.directions().map(|d| (d.dot(&u) + bond.compliance * d.dot(&joint.force)).abs());
                    let off = off.fold(0.0, f64::max);
                    (off <= BOND_TOLERANCE, off <= ENOUGH_BOND)
                }
                Law::Ring(_) => (joint.gap <= BOND_TOLERANCE, joint.gap <= ENOUGH_BOND),
                Law::Contact(contact) => {
                    let gap = if soft || joint.deep || joint.give != Give::No { 0.0 } else { u.dot(&contact.normal) };
                    let exact = soft || joint.give == Give::Much || miss <= asked;
                    let outside = self.rough || is_outside(gap, options);
                    (outside && exact, is_nearly_outside(gap, options))
                }
            };
            // (A joint that does not hold may wait for what its resting strand gives way by, however little.)
            let ways = self.pushes_resting(index, strands);
            let wakes = ways.map(|way| way > if holds { REST * tolerance } else { 0.0 });
            // What rests is within that of its end, and moved by no more it is no further from it than it may be.
            let waits = ways.iter().any(|way| *way > (1.0 - REST) * tolerance);
            self.joints[index].standing = Standing { miss, holds, nearly, wakes };
            self.joints[index].may_sleep(&law, &u, moved);
            (good, enough, wakes_some) = (good && holds, enough && nearly, wakes_some || waits);
        }
        let left = (residual / tolerance).max(self.ending.residual / ROUGH);
        if left < 0.5 * self.best.0 {
            self.best = (left, self.iterations);
        }
        let open = self.strands.iter().filter(|held| strands[**held as usize].residual > tolerance).count()
            + self.joints.iter().filter(|joint| !joint.standing.holds || joint.standing.wakes != [false; 2]).count();
        if open < self.fewest.0.div_ceil(2) {
            self.fewest = (open, self.iterations);
        }
        // What rests is told as well, but nobody waits for it.
        self.ending.residual = self.ending.residual.max(rested);
        let largest = |touches: bool| {
            let of = self.joints.iter().filter(|joint| joint.is_touch() == touches).map(|joint| joint.force.norm());
            of.fold(0.0, f64::max)
        };
        let usual = self.usual_force(strands, step);
        self.beyond = largest(true) > NO_SOLUTION * usual
            || self.is_constrained() && largest(false) > CANNOT_HOLD * (usual + self.bending_force(strands));
        let idle = !options.model.is_soft()
            && (residual <= STILL * tolerance_asked || self.report.residual > HOPELESS * self.report.size);
        self.idle = if idle { self.idle + 1 } else { 0 };
        // Constraints may turn a strand right round, a little in every iteration. What only waits for resting strands gets on: these are woken
        // twice at most.
        let waits_only = good && wakes_some;
        let got_on = self.best.1.max(self.fewest.1);
        let large = self.strands.len() > FEW && !soft && !self.is_relaxed();
        let patience = PATIENCE[if enough { 0 } else { 2 - usize::from(large) }];
        let slow = !waits_only && !self.is_constrained() && self.iterations >= got_on + patience;
        let stuck = slow || self.beyond || self.is_constrained() && self.idle > IDLE;
        let lost = self.strands.iter().all(|held| strands[*held as usize].held.outcome.quarantined);
        // One touch that stays a little beyond what is asked roughly says nothing of the end.
        let good = good && !wakes_some || self.rough && slow && enough;
        let good = good && !self.push_on(strands, options, step);
        // What has given way holds not, whatever it came to.
        self.ending.came_to_end = good;
        // So many iterations are what the host chose to pay for.
        let chosen = options.model.is_soft() && options.max_iterations <= CHOSEN && self.iterations >= options.max_iterations;
        self.ending.converged = (good || chosen) && self.joints.iter().all(|joint| joint.give == Give::No);
        self.done = good || lost || stuck || self.iterations >= options.max_iterations;
        self.ending.good_enough = self.done && (enough || chosen);
        self.ending.lost =
            self.done && self.is_relaxed() && self.strands.iter().any(|held| strands[*held as usize].residual > LOST);
    }
}

/// Whether a touch with that gap is as far outside as a step's end asks.
pub(super) fn is_outside(gap: f64, options: &ContactOptions) -> bool {
    gap >= -0.5 * options.tolerance
}

/// The same of an island that does not get on.
pub(super) fn is_nearly_outside(gap: f64, options: &ContactOptions) -> bool {
    gap >= -ENOUGH_DEPTH * options.tolerance
}
