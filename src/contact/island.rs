//! Strands that joints tie together, directly or through others: their joints at the present iterate, and where their iteration ends. (The contact
//! problem of one iteration: `island_problem.rs`.)

use nalgebra::Vector3;

use super::body::BodyAt;
use super::constrained_strand::{Attachment, ConstrainedStrand};
use super::contact_space::End;
use super::ending::Ending;
use super::gauss_seidel::Report;
use super::law::Law;
use super::law::coefficient::Coefficient;
use super::law::contact::Friction;
use super::law::response::Response;
use super::nearest::nearest;
use super::options::{ContactModel, ContactOptions};
use super::step_constraint::{ConstraintKind, Give, SAME_SIDE, Standing, StepConstraint};
use crate::chain::load::MaterialPoint;

/// How nearly a bond must hold at the end of a step, m.
const BILATERAL_TOLERANCE: f64 = 1e-10;
/// Where an island is solved roughly: the residual, as a part of its problem's size, and how far from its end an element may be, rad.
const ROUGH: f64 = 1e-3;
const ROUGH_TOLERANCE: f64 = 1e-3;
/// What the penalty models are content with: the same two.
const SOFT: f64 = 1e-3;
const SOFT_TOLERANCE: f64 = 2e-3;
/// A strand that ends further from the end than this, rad, has come to nowhere.
const DIVERGED: f64 = 0.1;

/// Iterations in which what is left to do, or the number of strands and joints that have it to do, must halve: where it is good enough as it is;
/// in a large island whose touches may yet yield; and elsewhere. An island that does not get on will not.
const PATIENCE: [u32; 3] = [5, 15, 25];
/// So few iterations are a choice with penalties: what springs push out no further in this step they do in the next.
const CHOSEN: u32 = 10;
/// What an island that has not come to its end may be off by and still be kept as it is: a strand, rad; a touch, in units of the tolerance
/// of touches; a bond, m.
pub(super) const ENOUGH_TURN: f64 = 1e-2;
const ENOUGH_DEPTH: f64 = 2.0;
const ENOUGH_BILATERAL: f64 = 1e-9;
/// Forces of touches beyond this many times what takes a strand its own length in a step are those of a problem that has no solution.
const NO_SOLUTION: f64 = 1e4;
/// So are those of constraints beyond this many times that and what bends an element by a radian. What can be held takes a few times as much
/// in the end, though more on the way; what cannot takes a thousandfold more in every iteration.
const CANNOT_HOLD: f64 = 1e12;
/// So many iterations in a row that move no strand by more than this part of what may be left, or whose contact problem is left with more than
/// this residual, end an island with constraints: they leave its touches no room (of the hard models; others give displacement).
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
    pub constraints: Vec<StepConstraint>,
    /// The last contact problem's report.
    pub report: Report,
    /// What its next contact problem may take, nanoseconds or so.
    pub max_work: u64,
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
    pub is_subdivided: bool,
    /// Its forces grew beyond measure.
    pub beyond: bool,
    /// How often strands of it were bent, see `kink.rs`.
    pub kinked: u32,
    /// How often joints were relaxed in it.
    pub relaxings: u32,
    /// Whether bonds that do not give displacement hold strands to the world in this iteration.
    pub constrained_to_world: bool,
    /// Whether strands may rest: constraints are to hold to the last digit, and few strands come to their end sooner together.
    pub may_rest: bool,
    /// How far from the end a strand may be to rest, rad, and its joints' residual.
    pub rest: f64,
    /// See `rest`.
    pub rest_residual: f64,
    /// The least that was left to do, in units of what may be, and the iteration that it was halved in.
    best: (f64, u32),
    /// The same of how many strands and joints were not at their end.
    fewest: (usize, u32),
    /// Iterations in a row that led nowhere, see [`IDLE`].
    idle: u32,
    /// How deep the deepest of its touches that give displacement was when they were pushed on last, m, and how often that was.
    pub(super) pushed: (f64, u32),
    pub(super) ends: Vec<[End; 2]>,
    /// The joints that have a part in the present contact problem: a strand at their ends moves.
    pub(super) included: Vec<u32>,
    pub(super) is_included: Vec<bool>,
    /// Whether a strand has such joints.
    pub(super) strand_is_included: Vec<bool>,
}

impl Island {
    /// Empties it.
    pub fn clear(&mut self) {
        self.strands.clear();
        self.constraints.clear();
        (self.sweeps, self.iterations, self.ending) = (0, 0, Ending::default());
        (self.done, self.beyond, self.rest, self.rough) = (false, false, -1.0, false);
        (self.kinked, self.relaxings, self.report) = (0, 0, Report::default());
        (self.pushed, self.left, self.is_subdivided) = ((f64::INFINITY, 0), Left::default(), false);
        self.begin_to_count(0);
    }

    /// Progress is counted from this iteration on.
    pub(super) fn begin_to_count(&mut self, iteration: u32) {
        (self.best, self.fewest, self.idle) = ((f64::INFINITY, iteration), (usize::MAX, iteration), 0);
    }

    /// Goes on from where it was solved roughly. True if there is more to do.
    pub fn refine(&mut self) -> bool {
        let goes_on = self.rough && self.ending.attempt_converged;
        if goes_on {
            // What rested did so by what was asked then.
            (self.done, self.ending.converged, self.ending.attempt_converged, self.rest) = (false, false, false, -1.0);
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
    pub fn find_ends(&mut self, strands: &[ConstrainedStrand]) {
        self.ends.clear();
        self.ends.resize(self.constraints.len(), [End { strand: 0, point: 0 }; 2]);
        for (local, strand) in self.strands.iter().enumerate() {
            for (point, attachment) in strands[*strand as usize].attachments.iter().enumerate() {
                self.ends[attachment.constraint as usize][usize::from(attachment.second)] =
                    End { strand: local as u32, point: point as u32 };
            }
        }
    }

    /// Whether a strand of it has come to nowhere, all that could be tried done: those alone that are astray themselves, which may free the
    /// others; all where not one iteration was possible.
    pub fn has_diverged(&self, strand: &ConstrainedStrand) -> bool {
        let all = self.iterations <= 1;
        self.ending.diverged && (all || strand.residual > DIVERGED || strand.residual.is_nan())
    }

    /// Whether a strand ends in a body that it was not in when the step began, or beyond it.
    pub fn is_behind(&self, strand: &ConstrainedStrand) -> bool {
        let constraint = |end: &Attachment| &self.constraints[end.constraint as usize];
        strand.attachments.iter().map(constraint).any(|constraint| constraint.is_behind(constraint.gap))
    }

    /// Whether strands of it touch something.
    pub fn has_contacts(&self) -> bool {
        self.constraints.iter().any(StepConstraint::is_contact)
    }

    /// Adds the held strands to `pressed` that run into what they touch if no force acts, when all have done the first half of an iteration.
    pub fn about_to_press(&mut self, strands: &[ConstrainedStrand], pressed: &mut Vec<u32>) {
        self.find_ends(strands);
        for (constraint, [first, second]) in self.constraints.iter().zip(&self.ends) {
            let (ConstraintKind::Body { normal, .. } | ConstraintKind::Hair { normal, .. }) = constraint.kind else { continue };
            let displacement = |end: &End| strands[self.strands[end.strand as usize] as usize].unconstrained(end.point);
            let displacement = displacement(first) - constraint.second.map_or(Vector3::zeros(), |_| displacement(second));
            if constraint.gap + normal.dot(&displacement) < 0.0 {
                pressed.extend(constraint.ends().map(|end| end.strand));
            }
        }
    }

    /// Lets it be solved roughly at first, if it has touches and is large.
    pub fn begin_roughly(&mut self) {
        self.rough = self.strands.len() > FEW && self.has_contacts();
    }

    /// Whether the joints at these ends hold, and none of them gives motion.
    pub fn holds(&self, ends: &[Attachment]) -> bool {
        let holds = |end: &Attachment| {
            let constraint = &self.constraints[end.constraint as usize];
            constraint.standing.holds && constraint.give == Give::No
        };
        ends.iter().all(holds)
    }

    /// Before an iteration: rings go where the strands run through them, bodies' surfaces are looked at from where their touches are.
    pub fn refresh(&mut self, strands: &[ConstrainedStrand], bodies: &[BodyAt]) {
        self.constrained_to_world = false;
        self.may_rest = self.strands.len() > FEW && !self.has_bilateral();
        for constraint in &mut self.constraints {
            let strand = &strands[constraint.first.strand as usize];
            self.constrained_to_world |=
                constraint.give == Give::No && matches!(constraint.kind, ConstraintKind::Pin { compliance: 0.0, .. });
            if strand.resting || constraint.dormant || constraint.in_crease {
                continue;
            }
            match &mut constraint.kind {
                ConstraintKind::Ring { target, .. } => {
                    let MaterialPoint { element, s, .. } = constraint.first.material_point;
                    let (element, s) = nearest(&strand.path().now, element, s, *target);
                    constraint.first.material_point = MaterialPoint::on(element, s);
                }
                ConstraintKind::Body { body, feature, normal, side, point, carried, .. } if self.iterations < LOOKS => {
                    let (body, at) = (strand.met(bodies, *body), strand.end_state(&constraint.first.material_point));
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
                ConstraintKind::Body { .. }
                | ConstraintKind::Hair { .. }
                | ConstraintKind::Pin { .. }
                | ConstraintKind::Tie { .. } => {}
            }
        }
    }

    pub(super) fn evaluate(
        &mut self,
        constraint: usize,
        strands: &[ConstrainedStrand],
        options: &ContactOptions,
        step: f64,
    ) -> (Law, Vector3<f64>) {
        let ends = &self.ends[constraint];
        let constraint = &mut self.constraints[constraint];
        let relaxed = constraint.give == Give::Much;
        let first = &strands[constraint.first.strand as usize];
        let second = constraint.second.map_or(first, |end| &strands[end.strand as usize]);
        let a = first.place(ends[0].point);
        let b = constraint.second.map_or(a, |_| second.place(ends[1].point));
        let (mut law, mut u) = constraint.evaluate([a, b], [&first.contact, &second.contact], options, step);
        if relaxed || constraint.deep || constraint.give == Give::ALittle {
            let part = if relaxed || constraint.deep { RELAXED } else { YIELDS };
            let compliance = part * step * step / first.mass.min(second.mass);
            match &mut law {
                Law::Bilateral(bilateral) => bilateral.compliance = bilateral.compliance.max(compliance),
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
                    if constraint.give != Give::No {
                        contact.friction = Friction::None;
                    }
                    constraint.off = -u.dot(&contact.normal);
                    u -= contact.normal * constraint.pushed;
                }
            }
        }
        (law, u)
    }

    /// How far the strands at a joint's ends, where they rest, are moved by the forces now, in units of an element's length.
    fn pushes_resting(&self, index: usize, strands: &[ConstrainedStrand]) -> [f64; 2] {
        let ends = if self.constraints[index].second.is_some() { 2 } else { 1 };
        let mut motions = [0.0; 2];
        for (moved, end) in motions.iter_mut().zip(&self.ends[index][..ends]) {
            let strand = &strands[self.strands[end.strand as usize] as usize];
            if strand.resting {
                let motion =
                    strand.given_way(end.point, &self.is_included, |constraint| self.constraints[constraint].force).norm();
                let element = strand.length() / strand.step.now().1.len() as f64;
                *moved = if motion.is_nan() { f64::INFINITY } else { motion / element };
            }
        }
        motions
    }

    /// Whether constraints have a part in it.
    pub fn has_bilateral(&self) -> bool {
        !self.constraints.iter().all(StepConstraint::is_contact)
    }

    /// What bends an element of the stiffest strand by about a radian, N.
    fn bending_force(&self, strands: &[ConstrainedStrand]) -> f64 {
        self.strands.iter().map(|strand| strands[*strand as usize].bending).fold(0.0, f64::max)
    }

    /// The largest of its strands' [`ConstrainedStrand::usual_force`], N.
    pub(super) fn usual_force(&self, strands: &[ConstrainedStrand], step: f64) -> f64 {
        self.strands.iter().map(|strand| strands[*strand as usize].usual_force(step)).fold(0.0, f64::max)
    }

    /// After the second half: whether the iteration has ended, by the strands' residuals and by how far the laws are from holding where
    /// the strands are now.
    pub fn check(&mut self, strands: &[ConstrainedStrand], options: &ContactOptions, tolerance: f64, step: f64) {
        let soft = options.model.is_soft();
        let enough_for_contacts = match () {
            () if !self.has_contacts() => 0.0,
            () if options.model.is_soft() => SOFT_TOLERANCE,
            () if self.rough => ROUGH_TOLERANCE,
            () => 0.0,
        };
        let tolerance_asked = tolerance;
        let tolerance = tolerance.max(enough_for_contacts);
        let residual = self.strands.iter().map(|strand| strands[*strand as usize].residual).fold(0.0, f64::max);
        let mut good = residual <= tolerance;
        let mut enough = residual <= ENOUGH_TURN;
        let (mut rested, mut wakes_some) = (0.0_f64, false);
        let asked = self.asked(options);
        (self.rest, self.rest_residual) = (REST * tolerance, asked);
        self.ending.residual = 0.0;
        for index in 0..self.constraints.len() {
            if !self.is_included[index] {
                if self.constraints[index].dormant {
                    self.rouse(index, strands, options, step);
                }
                let Standing { law_residual, holds, nearly, .. } = self.constraints[index].standing;
                (good, enough) = (good && holds, enough && nearly);
                rested = rested.max(law_residual);
                continue;
            }
            let before = self.constraints[index].gap;
            let (law, u) = self.evaluate(index, strands, options, step);
            let constraint = &self.constraints[index];
            let moved = (constraint.gap - before).abs();
            let law_residual = self.report.law_residual(&law, u, constraint.force, step);
            self.ending.residual = self.ending.residual.max(law_residual);
            let (holds, nearly) = match law {
                Law::Bilateral(bilateral) => {
                    let off = bilateral.directions().map(|d| (d.dot(&u) + bilateral.compliance * d.dot(&constraint.force)).abs());
                    let off = off.fold(0.0, f64::max);
                    (off <= BILATERAL_TOLERANCE, off <= ENOUGH_BILATERAL)
                }
                Law::Ring(_) => (constraint.gap <= BILATERAL_TOLERANCE, constraint.gap <= ENOUGH_BILATERAL),
                Law::Contact(contact) => {
                    let gap = if soft || constraint.deep || constraint.give != Give::No { 0.0 } else { u.dot(&contact.normal) };
                    let exact = soft || constraint.give == Give::Much || law_residual <= asked;
                    let outside = self.rough || is_outside(gap, options);
                    (outside && exact, is_nearly_outside(gap, options))
                }
            };
            // (A joint that does not hold may wait for what its resting strand gives motion by, however little.)
            let motions = self.pushes_resting(index, strands);
            let wakes = motions.map(|motion| motion > if holds { REST * tolerance } else { 0.0 });
            // What rests is within that of its end, and moved by no more it is no further from it than it may be.
            let waits = motions.iter().any(|motion| *motion > (1.0 - REST) * tolerance);
            self.constraints[index].standing = Standing { law_residual, holds, nearly, wakes };
            self.constraints[index].may_sleep(&law, &u, moved);
            (good, enough, wakes_some) = (good && holds, enough && nearly, wakes_some || waits);
        }
        let left = (residual / tolerance).max(self.ending.residual / ROUGH);
        if left < 0.5 * self.best.0 {
            self.best = (left, self.iterations);
        }
        let open = self.strands.iter().filter(|strand| strands[**strand as usize].residual > tolerance).count()
            + self
                .constraints
                .iter()
                .filter(|constraint| !constraint.standing.holds || constraint.standing.wakes != [false; 2])
                .count();
        if open < self.fewest.0.div_ceil(2) {
            self.fewest = (open, self.iterations);
        }
        // What rests is told as well, but nobody waits for it.
        self.ending.residual = self.ending.residual.max(rested);
        let largest = |contacts: bool| {
            let of = self
                .constraints
                .iter()
                .filter(|constraint| constraint.is_contact() == contacts)
                .map(|constraint| constraint.force.norm());
            of.fold(0.0, f64::max)
        };
        let usual = self.usual_force(strands, step);
        self.beyond = largest(true) > NO_SOLUTION * usual
            || self.has_bilateral() && largest(false) > CANNOT_HOLD * (usual + self.bending_force(strands));
        let idle = !options.model.is_soft()
            && (residual <= STILL * tolerance_asked || self.report.residual > HOPELESS * self.report.size);
        self.idle = if idle { self.idle + 1 } else { 0 };
        // Constraints may turn a strand right round, a little in every iteration. What only waits for resting strands gets on: these are woken
        // twice at most.
        let waits_only = good && wakes_some;
        let got_on = self.best.1.max(self.fewest.1);
        let large = self.strands.len() > FEW && !soft && !self.is_relaxed();
        let patience = PATIENCE[if enough { 0 } else { 2 - usize::from(large) }];
        let slow = !waits_only && !self.has_bilateral() && self.iterations >= got_on + patience;
        let stuck = slow || self.beyond || self.has_bilateral() && self.idle > IDLE;
        let diverged = self.strands.iter().all(|strand| strands[*strand as usize].step.outcome.quarantined);
        // One touch that stays a little beyond what is asked roughly says nothing of the end.
        let good = good && !wakes_some || self.rough && slow && enough;
        let good = good && !self.push_on(strands, options, step);
        // What has given motion holds not, whatever it came to.
        self.ending.attempt_converged = good;
        // So many iterations are what the host chose to pay for.
        let chosen = options.model.is_soft() && options.max_iterations <= CHOSEN && self.iterations >= options.max_iterations;
        self.ending.converged = (good || chosen) && self.constraints.iter().all(|constraint| constraint.give == Give::No);
        self.done = good || diverged || stuck || self.iterations >= options.max_iterations;
        self.ending.good_enough = self.done && (enough || chosen);
        self.ending.diverged =
            self.done && self.is_relaxed() && self.strands.iter().any(|strand| strands[*strand as usize].residual > DIVERGED);
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
