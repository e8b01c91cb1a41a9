//! Diverged strands: strands that a substep gave up before an iteration, carried over a jump of their root, or rolled back.
//!
//! Such a strand keeps its shape and moves with its root. Meanwhile bodies move on. A body that passed it in a substep without it
//! must meet it in later substeps, so that the strand's side of the body is never forgotten. For that strand the body follows in
//! steps no larger than the strand can follow, until it is at its true position.

use nalgebra::Vector3;

use super::fast_bodies::Passing;
use crate::contact::body_at::BodyAt;
use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::math::rotation::{from_rotation_vector, rotation_vector};
use crate::rod::target::TargetMotion;
use crate::solver::strands::strand::Strand;
use crate::step::StrandOutcome;

/// A strand that has been rolled back for this many seconds without a break is brought back from its shape to its natural one, in
/// this many seconds.
const LOST_FOR: f64 = 0.1;
const RETURNS_IN: f64 = 0.25;

/// A strand that bodies have followed for this many seconds without a break meets them where they are: caught between two of
/// their poses, it could be lost for as long as it is there.
const FOLLOWED_FOR: f64 = 0.25;

/// The least fraction of its lead by which a body follows for a strand.
const MIN_FRACTION: f64 = 1.0 / 64.0;

/// A body follows at once for the last of its lead, up to this fraction of what a strand can follow.
const NEAR_ENOUGH: f64 = 0.1;
/// After each substep that could not follow, a body follows by half as much, at most this often.
const MAX_HALVINGS: u32 = 20;

/// The record of a strand that is not where a substep would have brought it.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::solver) struct Divergence {
    /// The bodies' poses for the strand at the start of the next substep: their poses at its last good substep as seen from its
    /// root or, if that jumped, the poses to which they jump. One per body; empty for their true poses.
    pub bodies: Vec<Frame>,
    /// The time without a break for which they have not been at their true poses, s.
    pub lag: f64,
    pub state: DivergenceState,
}

#[derive(Debug, Clone, PartialEq)]
pub(in crate::solver) enum DivergenceState {
    /// The last substeps carried it along, for this many seconds without a break, and bodies follow for it.
    Carried { seconds: f64 },
    /// It converged, but inside a body or behind one, for this many seconds without a break: in the next substep it meets
    /// everything that passed it.
    Behind { seconds: f64 },
    /// The last substeps rolled it back, for this many seconds without a break.
    RolledBack { seconds: f64 },
    /// It has been returning from this shape to its natural one for this many seconds, without contact.
    Returning { seconds: f64, from: Box<[[f64; 3]]> },
}

impl Strand {
    /// The bodies' poses for it at the start of the next substep, if not their true ones.
    pub fn bodies_from(&self) -> &[Frame] {
        self.divergence.as_deref().map_or(&[], |divergence| &divergence.bodies)
    }

    /// The bodies' motions for it in the next substep of `h` seconds, if not their true ones. Its root's motion has begun.
    pub fn body_motions(&self, h: f64, bodies: &[BodyAt], motions: &mut Vec<[Frame; 2]>) {
        motions.clear();
        let from = self.bodies_from();
        if from.len() != bodies.len() {
            return;
        }
        // Where a substep could not follow, the next one takes less.
        let failed = (self.carried_for() / h).min(f64::from(MAX_HALVINGS)).round() as u32;
        let requested_fraction = 1.0 / f64::from(1_u32 << failed);
        let (root, length) = (self.root_during(h), self.model.length());
        motions.extend(bodies.iter().zip(from).map(|(body, from)| {
            let passing = Passing::new(from, body, &root, length);
            let near = !self.is_carried() || passing.travel <= NEAR_ENOUGH * passing.limit;
            let fraction =
                if near { 1.0 } else { (passing.limit / passing.travel).clamp(MIN_FRACTION, 1.0) * requested_fraction };
            [*from, if fraction < 1.0 { between(&passing.along, &body.end, fraction) } else { body.end }]
        }));
    }

    /// The time without a break for which bodies have not been at their true poses for it, s.
    pub fn lag(&self) -> f64 {
        self.divergence.as_deref().map_or(0.0, |divergence| divergence.lag)
    }

    /// It converged in a substep in which bodies followed this far for it, and not to their true poses: for `lag` seconds by now.
    pub fn bodies_follow(&mut self, came_to: Vec<Frame>, lag: f64) {
        let state = DivergenceState::Carried { seconds: 0.0 };
        self.divergence = (!is_over(lag, FOLLOWED_FOR)).then(|| Box::new(Divergence { bodies: came_to, lag, state }));
    }

    /// Whether the last substep carried it along: bodies follow for it.
    pub fn is_carried(&self) -> bool {
        matches!(self.divergence.as_deref(), Some(Divergence { state: DivergenceState::Carried { .. }, .. }))
    }

    /// Whether it is outside the scene: it is returning, or frozen.
    pub fn is_aside(&self) -> bool {
        self.frozen.is_some() || self.is_returning()
    }

    /// Whether it is returning, and outside the scene until it has arrived.
    pub fn is_returning(&self) -> bool {
        self.divergence.as_deref().is_some_and(|divergence| matches!(divergence.state, DivergenceState::Returning { .. }))
    }

    /// Its root jumps to a pose at once, and its target to the end of its motion. The caller then sets `bodies`.
    pub fn jump_to(&mut self, root: Frame) {
        self.state.teleport(root);
        self.root_move = None;
        if let Some(target) = &mut self.target {
            target.motion = TargetMotion::Rests;
        }
        let state = DivergenceState::Carried { seconds: 0.0 };
        self.divergence = Some(Box::new(Divergence { bodies: Vec::new(), lag: 0.0, state }));
    }

    /// Takes it through a substep of `h` seconds with its root, its shape kept, without any other work. `bodies`: those that it
    /// did not meet. Its velocities turn along.
    pub fn go_with_root(&mut self, h: f64, bodies: &[BodyAt]) -> StrandOutcome {
        self.begin_moves(h);
        let seconds = self.diverged_for() + h;
        self.move_with_root(h, bodies, DivergenceState::Carried { seconds });
        self.drop_unreachable_bodies(seconds);
        self.advance_moves(h);
        let outcome = StrandOutcome { converged: false, left: true, energies: self.energies, ..StrandOutcome::default() };
        self.last = (&outcome).into();
        outcome
    }

    /// The same, with the velocities of that motion. Its own velocities would make every later substep as hard as the one that
    /// failed.
    pub fn carry_along(&mut self, h: f64, bodies: &[BodyAt], rules: &Rules) -> StrandOutcome {
        let from = self.state.root;
        let outcome = self.go_with_root(h, bodies);
        self.set_rigid_velocities(&from, h, rules);
        outcome
    }

    /// It converged in a substep of `h` seconds, but inside a body or behind one: later substeps must see what passed it.
    /// `before`: its root at the start of the substep; `divergence`: its record then.
    pub fn record_passed_bodies(&mut self, before: &Frame, h: f64, bodies: &[BodyAt], divergence: Option<Box<Divergence>>) {
        self.divergence = divergence;
        let (to, seconds) = (self.state.root, self.diverged_for() + h);
        let divergence = self.start_divergence(h, bodies, DivergenceState::Behind { seconds });
        take_along(&mut divergence.bodies, before, &to);
        self.drop_unreachable_bodies(seconds);
    }

    /// Begins the record of a substep of `h` seconds without it, or goes on with it.
    fn start_divergence(&mut self, h: f64, bodies: &[BodyAt], state: DivergenceState) -> &mut Divergence {
        let meets = self.contact.is_some();
        let new = || Box::new(Divergence { bodies: Vec::new(), lag: 0.0, state: state.clone() });
        let divergence = self.divergence.get_or_insert_with(new);
        divergence.lag += h;
        divergence.state = state;
        if meets && divergence.bodies.len() != bodies.len() {
            divergence.bodies = bodies.iter().map(|body| body.start).collect();
        }
        divergence
    }

    fn carried_for(&self) -> f64 {
        if self.is_carried() { self.diverged_for() } else { 0.0 }
    }

    /// The time without a break for which it has diverged, s.
    fn diverged_for(&self) -> f64 {
        use DivergenceState::{Behind, Carried, Returning, RolledBack};
        match self.divergence.as_deref().map(|divergence| &divergence.state) {
            Some(Carried { seconds } | Behind { seconds } | RolledBack { seconds }) => *seconds,
            Some(Returning { .. }) | None => 0.0,
        }
    }

    /// A body that passed it long ago may be at a place that it can never reach.
    fn drop_unreachable_bodies(&mut self, seconds: f64) {
        if is_over(seconds, LOST_FOR) || is_over(self.lag(), FOLLOWED_FOR) {
            self.divergence = None;
        }
    }

    /// A substep of `h` seconds rolled it back: it moves with its root, and after a while it is brought back.
    pub fn roll_back(&mut self, h: f64, bodies: &[BodyAt]) {
        let seconds = self.diverged_for() + h;
        let returns = is_over(seconds, LOST_FOR);
        let from = || self.state.curvatures.clone().into_boxed_slice();
        let state = if returns {
            DivergenceState::Returning { seconds: 0.0, from: from() }
        } else {
            DivergenceState::RolledBack { seconds }
        };
        self.move_with_root(h, bodies, state);
    }

    /// It converged in a substep.
    pub fn clear_divergence(&mut self) {
        self.divergence = None;
    }

    fn move_with_root(&mut self, h: f64, bodies: &[BodyAt], state: DivergenceState) {
        let [from, to] = self.root_during(h);
        let divergence = self.start_divergence(h, bodies, state);
        take_along(&mut divergence.bodies, &from, &to);
        self.state.teleport(to);
    }

    /// Gives it the velocities of a rigid motion with its root, which came from this pose in `h` seconds.
    pub fn set_rigid_velocities(&mut self, from: &Frame, h: f64, rules: &Rules) {
        let to = self.state.root;
        self.state.rates.fill([0.0; 3]);
        self.state.root_velocity = (to.origin - from.origin) / h;
        self.state.root_angular_velocity = rotation_vector(&(to.rotation * from.rotation.inverse())) / h;
        self.state.velocities_from_rates(&self.model, rules);
    }

    /// A substep of `h` seconds of its return: from shape to shape, with its root.
    pub fn step_home(&mut self, h: f64, rules: &Rules) -> StrandOutcome {
        self.begin_moves(h);
        let [from_root, to] = self.root_during(h);
        let outcome = StrandOutcome { converged: false, quarantined: true, energies: self.energies, ..StrandOutcome::default() };
        let Some(Divergence { state: DivergenceState::Returning { seconds, from }, .. }) = self.divergence.as_deref_mut() else {
            return outcome;
        };
        *seconds += h;
        let x = (*seconds / RETURNS_IN).min(1.0);
        let part = x * x * (3.0 - 2.0 * x);
        for ((now, from), natural) in self.state.curvatures.iter_mut().zip(from.iter()).zip(self.model.natural.iter()) {
            *now = std::array::from_fn(|axis| from[axis] + part * (natural[axis] - from[axis]));
        }
        let is_back = is_over(*seconds, RETURNS_IN);
        self.state.teleport(to);
        self.set_rigid_velocities(&from_root, h, rules);
        (self.state.wrench_force, self.state.wrench_torque) = (Vector3::zeros().into(), Vector3::zeros().into());
        self.advance_moves(h);
        self.last = (&outcome).into();
        if is_back {
            self.divergence = None;
        }
        outcome
    }
}

/// Whether a time that substeps have added up has reached a limit, but for rounding.
fn is_over(seconds: f64, limit: f64) -> bool {
    seconds >= limit * (1.0 - 1e-12)
}

/// The pose at a fraction of the motion from one to another.
fn between(from: &Frame, to: &Frame, fraction: f64) -> Frame {
    let turn = rotation_vector(&(to.rotation * from.rotation.inverse())) * fraction;
    Frame { origin: from.origin + (to.origin - from.origin) * fraction, rotation: from_rotation_vector(turn) * from.rotation }
}

/// Moves frames along with a root that goes from pose to pose.
fn take_along(frames: &mut [Frame], from: &Frame, to: &Frame) {
    for frame in frames {
        *frame = frame.carried(from, to);
    }
}
