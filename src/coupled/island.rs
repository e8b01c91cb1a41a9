//! Islands: strands coupled by constraints, directly or through others. Their constraints at the present iterate.
//!
//! Files:
//!
//! - `convergence.rs`: The test for convergence of an island, after each Newton iteration: what still moves, which laws hold, whether it makes progress.
//! - `dormant.rs`: Dormant contacts, left out of an island's contact problems for a while.
//! - `ending.rs`: How islands' iterations end: further attempts for islands that have not converged.
//! - `kink.rs`: Strands that lie exactly along what presses them.
//! - `problem.rs`: The contact problem of an island's Newton iteration: the constraints in it, and its solution.
//! - `pushing.rs`: Removes the depth of yielding contacts.
//! - `state.rs`: States of an island: where its iteration is, whether it iterates with others, what its bilateral constraints hold.

pub(super) mod convergence;
mod dormant;
pub mod ending;
pub mod kink;
pub mod problem;
mod pushing;
mod state;

use nalgebra::Vector3;

use super::constrained_strand::{Attachment, ConstrainedStrand, LookAhead, Rest, Strands};
use crate::chain::load::MaterialPoint;
use crate::contact::body_at::BodyAt;
use crate::contact::constraint::law::Law;
use crate::contact::constraint::law::coefficient::Coefficient;
use crate::contact::constraint::law::contact::Friction;
use crate::contact::constraint::law::response::Response;
use crate::contact::constraint::step_constraint::{ConstraintKind, Give, SAME_SIDE, StepConstraint};
use crate::contact::narrow_phase::nearest::nearest;
use crate::contact::options::{ContactModel, ContactOptions};
use crate::contact::solver::contact_space::End;
use crate::contact::solver::gauss_seidel::Report;
use ending::{Ending, Outcome};
pub use state::{Bilateral, Phase, Turn};

/// The residual that a rough solve leaves, as a fraction of the size of the problem.
const ROUGH: f64 = 1e-3;
/// The largest residual that a rough solve may leave. Forces are wrong by this fraction of themselves; where it is large they change
/// from iteration to iteration, and strands never come to rest.
const ROUGHEST: f64 = 0.05;
/// The residual that the penalty models leave, as a fraction of the size of the problem.
const SOFT: f64 = 1e-3;
/// A strand that ends further from convergence than this, rad, has diverged.
const DIVERGED: f64 = 0.1;

/// In an island of at most this many strands none rests, and there is no rough solve.
pub const FEW: usize = 20;

/// Compliance of a relaxed constraint, in units of the displacement of the whole strand by its force in a step.
const RELAXED: f64 = 0.03;
/// The same of a single contact that yields.
const YIELDS: f64 = 0.003;
/// How far from a body's surface a contact is updated, m.
const LOOK: f64 = 0.01;
/// In how many of an island's first iterations that is done: later, a contact in a crease or a mesh's notch could alternate
/// between faces for ever. The search at the end of the step finds what goes undetected in this way.
pub(super) const LOOKS: u32 = 6;
/// The largest increase of a normal's component along the strand.
const ALONG: f64 = 0.1;

/// Depth of overlap left, m.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Left {
    /// The largest.
    pub deep: f64,
    /// The largest of overlaps that were not there when the step began.
    pub newly: f64,
}

/// How far an island's iteration has come.
#[derive(Debug, Clone)]
pub struct Progress {
    /// The last contact problem's report.
    pub report: Report,
    /// Whether that problem was solved as exactly as asked for.
    pub is_solved: bool,
    /// The largest residual of its constraints' laws at the iterate to which its solution led.
    law_residual: f64,
    /// Newton iterations so far.
    pub iterations: u32,
    /// How the iteration ended, or its present state.
    pub ending: Ending,
    /// How often its strands were bent, see `kink.rs`.
    pub kinked: u32,
    /// How often its constraints were relaxed.
    pub relaxings: u32,
    /// How far from convergence a strand may be to rest, rad.
    pub rest: f64,
    /// What it has spent so far, in iterations of all its strands: those at rest cost nothing.
    spent: f64,
    /// The least residual so far, in units of the tolerance, and what was spent when it was halved.
    best: (f64, f64),
    /// The same for the number of unconverged strands and constraints.
    fewest: (usize, f64),
    /// Iterations in a row without progress, see [`IDLE`].
    idle: u32,
    /// How far the contact that was most off at the last push was off, see [`StepConstraint::off_by`], and the number of pushes.
    pub(super) pushed: (f64, u32),
}

impl Default for Progress {
    fn default() -> Self {
        Self {
            report: Report::default(),
            is_solved: false,
            law_residual: 0.0,
            iterations: 0,
            ending: Ending::default(),
            kinked: 0,
            relaxings: 0,
            rest: -1.0,
            spent: 0.0,
            best: (f64::INFINITY, 0.0),
            fewest: (usize::MAX, 0.0),
            idle: 0,
            pushed: (f64::INFINITY, 0),
        }
    }
}

/// Coupled strands.
#[derive(Debug, Default)]
pub struct Island {
    /// Indices among the constrained strands, ascending.
    pub strands: Vec<u32>,
    /// Their constraints.
    pub constraints: Vec<StepConstraint>,
    /// How far its iteration has come.
    pub progress: Progress,
    /// The limit of its next contact problem's cost, nanoseconds or so.
    pub max_work: u64,
    /// Sweeps so far.
    pub sweeps: u32,
    /// When it iterates.
    pub turn: Turn,
    /// Where its iteration is.
    pub phase: Phase,
    /// Depth of overlap left, as far as it was searched for.
    pub left: Left,
    /// What its bilateral constraints hold in this iteration.
    pub bilateral: Bilateral,
    /// The residual that constraints of strands at rest may have.
    pub rest_residual: f64,
    pub(super) ends: Vec<[End; 2]>,
    /// The constraints in the present contact problem: those with a moving strand at one end.
    pub(super) included: Vec<u32>,
    pub(super) is_included: Vec<bool>,
    /// Whether a strand has such constraints.
    pub(super) strand_is_included: Vec<bool>,
}

impl Island {
    /// Empties it.
    pub fn clear(&mut self) {
        self.strands.clear();
        self.constraints.clear();
        self.begin();
    }

    /// Begins with the strands and the constraints that it has.
    pub fn begin(&mut self) {
        (self.sweeps, self.phase, self.progress) = (0, Phase::default(), Progress::default());
        (self.left, self.turn, self.bilateral) = (Left::default(), Turn::WithOthers, Bilateral::None);
    }

    /// How far it has come, if it goes on and has a single strand. (All islands begin again when new contacts are found; one
    /// without any goes on from there. Strands that wait for others begin again with these.)
    pub fn unfinished(&self) -> Option<Progress> {
        (!self.phase.has_ended() && self.strands.len() == 1).then(|| self.progress.clone())
    }

    /// Goes on from there, but looks at bodies' surfaces as often as a new one ([`LOOKS`]).
    pub fn resume(&mut self, progress: Progress) {
        let iterations = progress.iterations.min(1);
        let spent = f64::from(iterations);
        let counted = |then: f64| (then - (progress.spent - spent)).max(0.0);
        let (best, fewest) = ((progress.best.0, counted(progress.best.1)), (progress.fewest.0, counted(progress.fewest.1)));
        self.progress = Progress { iterations, spent, best, fewest, ..progress };
    }

    /// Progress is counted from now on.
    pub(super) fn begin_to_count(&mut self) {
        let spent = self.progress.spent;
        (self.progress.best, self.progress.fewest, self.progress.idle) = ((f64::INFINITY, spent), (usize::MAX, spent), 0);
    }

    /// Goes on from a rough solve. True if there is more to do.
    pub fn refine(&mut self) -> bool {
        let goes_on = self.phase.is_rough() && self.progress.ending.outcome >= Outcome::AttemptConverged;
        if goes_on {
            // Strands rested by the rough tolerance.
            self.progress.rest = -1.0;
            self.progress.ending.lower_to(Outcome::GoodEnough);
            self.begin_to_count();
        }
        self.phase = if self.phase.has_ended() && !goes_on { Phase::Ended } else { Phase::Full };
        goes_on
    }

    /// The tolerance of the contact laws.
    pub(super) fn asked(&self, options: &ContactOptions) -> f64 {
        let size = self.progress.report.size.max(1.0);
        let in_the_end = match options.model {
            ContactModel::Coulomb => options.residual,
            ContactModel::Penalty | ContactModel::RegularisedPenalty | ContactModel::AtPoints => SOFT * size,
        };
        if self.phase.is_rough() { in_the_end.max((ROUGH * size).min(ROUGHEST)) } else { in_the_end }
    }

    /// Finds the points of every constraint in its strands' sorted attachments.
    pub fn find_ends(&mut self, strands: &(impl Strands + ?Sized)) {
        self.ends.clear();
        self.ends.resize(self.constraints.len(), [End { strand: 0, point: 0 }; 2]);
        for (local, strand) in self.strands.iter().enumerate() {
            for (point, attachment) in strands[*strand as usize].attachments.iter().enumerate() {
                self.ends[attachment.constraint as usize][usize::from(attachment.second)] =
                    End { strand: local as u32, point: point as u32 };
            }
        }
    }

    /// Whether one of its strands has diverged after all attempts: only strands that are unconverged themselves, which may free
    /// the others; all if not even one iteration was possible.
    pub fn has_diverged(&self, strand: &ConstrainedStrand) -> bool {
        let all = self.progress.iterations <= 1;
        self.is_diverged() && (all || strand.residual > DIVERGED || strand.residual.is_nan())
    }

    /// Whether a strand ends in or beyond a body that it was outside of when the step began.
    pub fn is_behind(&self, strand: &ConstrainedStrand) -> bool {
        let constraint = |end: &Attachment| &self.constraints[end.constraint as usize];
        strand.attachments.iter().map(constraint).any(|constraint| constraint.is_behind(constraint.gap))
    }

    /// Whether surfaces press each other at some contact.
    pub fn presses(&self) -> bool {
        self.constraints.iter().any(StepConstraint::presses)
    }

    /// Whether it has contacts.
    pub fn has_contacts(&self) -> bool {
        self.constraints.iter().any(StepConstraint::is_contact)
    }

    /// After the first half of an iteration: adds the strands to `pressed` that would run into their partner without forces.
    pub fn about_to_press(&mut self, strands: &(impl Strands + ?Sized), pressed: &mut Vec<u32>) {
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

    /// Has it solved roughly first, if it has contacts and is large.
    pub fn begin_roughly(&mut self) {
        if self.strands.len() > FEW && self.has_contacts() {
            self.phase = if self.phase.has_ended() { Phase::RoughEnded } else { Phase::Rough };
        }
    }

    /// Whether the constraints at these ends hold without yielding.
    pub fn holds(&self, ends: &[Attachment]) -> bool {
        let holds = |end: &Attachment| {
            let constraint = &self.constraints[end.constraint as usize];
            constraint.standing.holds && constraint.give == Give::No
        };
        ends.iter().all(holds)
    }

    /// Before an iteration: moves rings to where the strands run through them, and updates bodies' surfaces at their contacts.
    pub fn refresh(&mut self, strands: &(impl Strands + ?Sized), bodies: &[BodyAt]) {
        self.bilateral = Bilateral::None;
        for constraint in &mut self.constraints {
            let strand = &strands[constraint.first.strand as usize];
            self.bilateral = self.bilateral.max(constraint.held());
            if strand.rest.is_resting() || strand.look_ahead != LookAhead::None || constraint.is_dormant() || constraint.in_crease
            {
                continue;
            }
            match &mut constraint.kind {
                ConstraintKind::Ring { target, .. } => {
                    let MaterialPoint { element, s, .. } = constraint.first.material_point;
                    let (element, s) = nearest(&strand.path().now, element, s, *target);
                    constraint.first.material_point = MaterialPoint::on(element, s);
                }
                ConstraintKind::Body { body, feature, normal, side, point, carried, .. } if self.progress.iterations < LOOKS => {
                    let (body, at) = (strand.met(bodies, *body), strand.end_state(&constraint.first.material_point));
                    if let Some(surface) = body.closest_at_end(at.now, LOOK) {
                        let new = body.to_world(&surface.normal);
                        // Another side of an edge or a sheet is another surface, and so is a face beside the edge that the
                        // strand lies across.
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
        strands: &(impl Strands + ?Sized),
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
        if let (true, Law::Contact(contact)) = (constraint.is_compliant(), &mut law) {
            contact.response = Response::spring(constraint.compliance());
            constraint.off = -u.dot(&contact.normal);
            u -= contact.normal * constraint.pushed;
        }
        if relaxed || constraint.deep || constraint.give == Give::ALittle {
            let part = if relaxed || constraint.deep { RELAXED } else { YIELDS };
            let compliance = part * step * step / first.mass.min(second.mass);
            match &mut law {
                Law::Bilateral(bilateral) => bilateral.compliance = bilateral.compliance.max(compliance),
                Law::Ring(ring) => ring.friction = Coefficient::uniform(0.0),
                Law::Contact(contact) => {
                    // A groom may be drawn with a strand between two surfaces that both push it into the other: no force
                    // separates these.
                    let most = 1.0 / compliance;
                    match &mut contact.response {
                        Response::Hard => contact.response = Response::spring(compliance),
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

    /// How far the resting strands at a constraint's ends would be moved by the present forces if they were to wake, in units of an element's
    /// length.
    fn pushes_resting(&self, index: usize, strands: &(impl Strands + ?Sized)) -> [f64; 2] {
        let ends = if self.constraints[index].second.is_some() { 2 } else { 1 };
        let mut motions = [0.0; 2];
        for (moved, end) in motions.iter_mut().zip(&self.ends[index][..ends]) {
            let strand = &strands[self.strands[end.strand as usize] as usize];
            if strand.rest.is_resting() && strand.rest != Rest::Held {
                let motion = strand
                    .resting_displacement(end.point, &self.is_included, |constraint| self.constraints[constraint].force)
                    .norm();
                *moved = if motion.is_nan() { f64::INFINITY } else { motion / strand.mean_element() };
            }
        }
        motions
    }

    /// Whether one of a constraint's ends is on a held strand whose model does not include it: it cannot be in a contact problem.
    pub(super) fn is_beyond_held(&self, index: usize, strands: &(impl Strands + ?Sized)) -> bool {
        let ends = if self.constraints[index].second.is_some() { 2 } else { 1 };
        self.ends[index][..ends].iter().any(|end| {
            let strand = &strands[self.strands[end.strand as usize] as usize];
            strand.rest == Rest::Held && !strand.attachments[end.point as usize].modelled
        })
    }

    /// Whether strands may rest in this iteration. Not with bilateral constraints, which hold to the last digit, nor in small
    /// islands, whose strands converge sooner together.
    pub fn may_rest(&self) -> bool {
        self.strands.len() > FEW && self.bilateral == Bilateral::None
    }

    /// Whether it is to take the substep in substeps.
    pub fn is_subdivided(&self) -> bool {
        self.phase == Phase::Subdivided
    }

    /// Whether it has bilateral constraints.
    pub fn has_bilateral(&self) -> bool {
        !self.constraints.iter().all(StepConstraint::is_contact)
    }

    /// The force that bends an element of the stiffest strand by about a radian, N.
    fn bending_force(&self, strands: &(impl Strands + ?Sized)) -> f64 {
        self.strands.iter().map(|strand| strands[*strand as usize].bending).fold(0.0, f64::max)
    }

    /// The largest [`ConstrainedStrand::usual_force`] of its strands, N.
    pub(super) fn usual_force(&self, strands: &(impl Strands + ?Sized), step: f64) -> f64 {
        self.strands.iter().map(|strand| strands[*strand as usize].usual_force(step)).fold(0.0, f64::max)
    }
}

impl StepConstraint {
    /// What it holds if it is bilateral.
    fn held(&self) -> Bilateral {
        match self.kind {
            ConstraintKind::Body { .. } | ConstraintKind::Hair { .. } => Bilateral::None,
            ConstraintKind::Pin { compliance: 0.0, .. } if self.give == Give::No => Bilateral::ToWorld,
            ConstraintKind::Pin { .. } | ConstraintKind::Tie { .. } | ConstraintKind::Ring { .. } => Bilateral::Strands,
        }
    }
}
