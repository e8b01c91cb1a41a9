//! Strands that a substep did not bring through: left before an iteration, carried over a jump of their root, or rolled back and brought back.
//!
//! Such a strand keeps its shape and goes along with its root. Bodies go on meanwhile: what one went past in a substep that the strand was
//! not part of it is to meet in those to come, so that the side that the strand is on is never forgotten. For it the body comes after by no more
//! in a substep than such a strand can follow, until it is where it is for all others.

use nalgebra::Vector3;

use super::fast_bodies::Passing;
use super::strand::Strand;
use crate::contact::body::BodyAt;
use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::math::rotation::{from_rotation_vector, rotation_vector};
use crate::step::StrandOutcome;

/// A strand that is rolled back for so many seconds on end is brought back: from the shape that it had to its natural one, in so many.
const LOST_FOR: f64 = 0.1;
const RETURNS_IN: f64 = 0.25;

/// A body comes after a strand by this share of what it is ahead at least.
const LEAST_SHARE: f64 = 1.0 / 64.0;

/// What it is to come after by no more than this part of what a strand can follow, it does at once.
const NEAR_ENOUGH: f64 = 0.1;
/// It asks for half as much after each substep that could not follow, so often at most.
const MOST_HALVINGS: u32 = 20;

/// What is kept of a strand that is not where a substep would have brought it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Astray {
    /// Where bodies stand for it when the coming substep begins: where they were at the last one that it came through, as seen from its root; or, when
    /// that has jumped, where they jump to. One a body, or none: where they are.
    pub bodies: Vec<Frame>,
    pub state: Whereabouts,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Whereabouts {
    /// It was carried along in the last substeps, for so many seconds on end, and goes on: bodies come after it.
    Carried { seconds: f64 },
    /// It came through, but in a body or behind one, for so many seconds on end: it is to meet all of what went past it in the next.
    Behind { seconds: f64 },
    /// It was rolled back in the last substeps, for so many seconds on end.
    Lost { seconds: f64 },
    /// It is on its way from this shape to its natural one, for so many seconds, and touches nothing.
    Returning { seconds: f64, from: Box<[[f64; 3]]> },
}

impl Strand {
    /// Where bodies stand for it when the coming substep begins, if not where they are.
    pub fn bodies_from(&self) -> &[Frame] {
        self.astray.as_deref().map_or(&[], |astray| &astray.bodies)
    }

    /// From where to where bodies go for it in the coming substep of `h` seconds, if not as they go. Its root's way has begun.
    pub fn ways_of_bodies(&self, h: f64, bodies: &[BodyAt], ways: &mut Vec<[Frame; 2]>) {
        ways.clear();
        let from = self.bodies_from();
        if from.len() != bodies.len() {
            return;
        }
        // Where a substep could not follow the next asks for less.
        let failed = (self.carried_for() / h).min(f64::from(MOST_HALVINGS)).round() as u32;
        let share_asked = 1.0 / f64::from(1_u32 << failed);
        let (root, length) = (self.root_during(h), self.model.length());
        ways.extend(bodies.iter().zip(from).map(|(body, from)| {
            let passing = Passing::new(from, body, &root, length);
            let near = !self.is_carried() || passing.travel <= NEAR_ENOUGH * passing.limit;
            let share = if near { 1.0 } else { (passing.limit / passing.travel).clamp(LEAST_SHARE, 1.0) * share_asked };
            [*from, if share < 1.0 { between(&passing.along, &body.end, share) } else { body.end }]
        }));
    }

    /// A substep brought it through in which bodies came so far for it, and not to where they are.
    pub fn goes_after(&mut self, came_to: Vec<Frame>) {
        self.astray = Some(Box::new(Astray { bodies: came_to, state: Whereabouts::Carried { seconds: 0.0 } }));
    }

    /// Whether it was carried along in the last substep: bodies come after it.
    pub fn is_carried(&self) -> bool {
        matches!(self.astray.as_deref(), Some(Astray { state: Whereabouts::Carried { .. }, .. }))
    }

    /// Whether it takes no part in the scene: it is on its way back, or stands still.
    pub fn is_aside(&self) -> bool {
        self.frozen.is_some() || self.is_returning()
    }

    /// Whether it is on its way back, and no part of the scene until it is there.
    pub fn is_returning(&self) -> bool {
        self.astray.as_deref().is_some_and(|astray| matches!(astray.state, Whereabouts::Returning { .. }))
    }

    /// Its root jumps: it goes there at once. `bodies` are to be told.
    pub fn jump_to(&mut self, root: Frame) {
        self.state.teleport(root);
        self.root_move = None;
        self.astray = Some(Box::new(Astray { bodies: Vec::new(), state: Whereabouts::Carried { seconds: 0.0 } }));
    }

    /// Takes it through a substep of `h` seconds as its root goes, its shape kept: nothing else is done for it. `bodies`: those that it did not meet so.
    /// Its velocities turn with it.
    pub fn go_with_root(&mut self, h: f64, bodies: &[BodyAt]) -> StrandOutcome {
        self.begin_root_way(h);
        let seconds = self.astray_for() + h;
        self.go_along(h, bodies, Whereabouts::Carried { seconds });
        self.forget_what_is_out_of_reach(seconds);
        self.advance_root(h);
        let outcome = StrandOutcome { converged: false, left: true, energies: self.energies, ..StrandOutcome::default() };
        self.fared = (&outcome).into();
        outcome
    }

    /// The same, and its velocities are those of that motion: kept, they would ask as much of every substep to come as of the one that could not be
    /// done.
    pub fn carry_along(&mut self, h: f64, bodies: &[BodyAt], rules: &Rules) -> StrandOutcome {
        let from = self.state.root;
        let outcome = self.go_with_root(h, bodies);
        self.moves_as_its_root(&from, h, rules);
        outcome
    }

    /// A substep of `h` seconds took it through, but left it in a body, or behind one: those to come are to see what went past it. `before`: its root
    /// when the substep began; `astray`: what was kept of it then.
    pub fn stay_before(&mut self, before: &Frame, h: f64, bodies: &[BodyAt], astray: Option<Box<Astray>>) {
        self.astray = astray;
        let (to, seconds) = (self.state.root, self.astray_for() + h);
        let astray = self.begin_to_stray(bodies, Whereabouts::Behind { seconds });
        take_along(&mut astray.bodies, before, &to);
        self.forget_what_is_out_of_reach(seconds);
    }

    fn begin_to_stray(&mut self, bodies: &[BodyAt], state: Whereabouts) -> &mut Astray {
        let meets = self.contact.is_some();
        let astray = self.astray.get_or_insert_with(|| Box::new(Astray { bodies: Vec::new(), state: state.clone() }));
        astray.state = state;
        if meets && astray.bodies.len() != bodies.len() {
            astray.bodies = bodies.iter().map(|body| body.start).collect();
        }
        astray
    }

    fn carried_for(&self) -> f64 {
        if self.is_carried() { self.astray_for() } else { 0.0 }
    }

    /// For how many seconds on end no substep brought it through.
    fn astray_for(&self) -> f64 {
        use Whereabouts::{Behind, Carried, Lost, Returning};
        match self.astray.as_deref().map(|astray| &astray.state) {
            Some(Carried { seconds } | Behind { seconds } | Lost { seconds }) => *seconds,
            Some(Returning { .. }) | None => 0.0,
        }
    }

    /// What went past it so long ago may be where it can never come to.
    fn forget_what_is_out_of_reach(&mut self, seconds: f64) {
        if seconds >= LOST_FOR * (1.0 - 1e-12) {
            self.astray = None;
        }
    }

    /// It was rolled back in a substep of `h` seconds: it goes along with its root, and after a while is brought back.
    pub fn lose(&mut self, h: f64, bodies: &[BodyAt]) {
        let seconds = self.astray_for() + h;
        let returns = seconds >= LOST_FOR * (1.0 - 1e-12);
        let from = || self.state.curvatures.clone().into_boxed_slice();
        let state = if returns { Whereabouts::Returning { seconds: 0.0, from: from() } } else { Whereabouts::Lost { seconds } };
        self.go_along(h, bodies, state);
    }

    /// A substep brought it through.
    pub fn come_through(&mut self) {
        self.astray = None;
    }

    fn go_along(&mut self, h: f64, bodies: &[BodyAt], state: Whereabouts) {
        let [from, to] = self.root_during(h);
        let astray = self.begin_to_stray(bodies, state);
        take_along(&mut astray.bodies, &from, &to);
        self.state.teleport(to);
    }

    /// Its velocities are those of a rigid motion with its root, which has come from there in `h` seconds.
    pub fn moves_as_its_root(&mut self, from: &Frame, h: f64, rules: &Rules) {
        let to = self.state.root;
        self.state.rates.fill([0.0; 3]);
        self.state.root_velocity = (to.origin - from.origin) / h;
        self.state.root_angular_velocity = rotation_vector(&(to.rotation * from.rotation.inverse())) / h;
        self.state.velocities_from_rates(&self.model, rules);
    }

    /// A substep of `h` seconds on its way back: from shape to shape, with its root.
    pub fn go_back(&mut self, h: f64, rules: &Rules) -> StrandOutcome {
        self.begin_root_way(h);
        let [from_root, to] = self.root_during(h);
        let outcome = StrandOutcome { converged: false, quarantined: true, energies: self.energies, ..StrandOutcome::default() };
        let Some(Astray { state: Whereabouts::Returning { seconds, from }, .. }) = self.astray.as_deref_mut() else {
            return outcome;
        };
        *seconds += h;
        let x = (*seconds / RETURNS_IN).min(1.0);
        let part = x * x * (3.0 - 2.0 * x);
        for ((now, from), natural) in self.state.curvatures.iter_mut().zip(from.iter()).zip(self.model.natural.iter()) {
            *now = std::array::from_fn(|axis| from[axis] + part * (natural[axis] - from[axis]));
        }
        let is_back = *seconds >= RETURNS_IN * (1.0 - 1e-12);
        self.state.teleport(to);
        self.moves_as_its_root(&from_root, h, rules);
        (self.state.wrench_force, self.state.wrench_torque) = (Vector3::zeros().into(), Vector3::zeros().into());
        self.advance_root(h);
        self.fared = (&outcome).into();
        if is_back {
            self.astray = None;
        }
        outcome
    }
}

/// The pose at a share of the way from one to another.
fn between(from: &Frame, to: &Frame, share: f64) -> Frame {
    let turn = rotation_vector(&(to.rotation * from.rotation.inverse())) * share;
    Frame { origin: from.origin + (to.origin - from.origin) * share, rotation: from_rotation_vector(turn) * from.rotation }
}

/// Takes frames along as a root goes from place to place.
fn take_along(frames: &mut [Frame], from: &Frame, to: &Frame) {
    for frame in frames {
        *frame = frame.carried(from, to);
    }
}
