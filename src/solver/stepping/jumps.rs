//! Root jumps: roots that move farther within a call of [`Solver::step`](crate::solver::Solver::step) than their strand can follow, as
//! when a head is dragged or moved between two frames.
//!
//! Such a strand moves with its root and keeps its shape and its velocities in the root's axes. For it, bodies that jump at the
//! same time are already at their final poses. So nothing is flung about that a costlier step would have to put in order again.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::divergence::DivergenceState;
use crate::math::frame::Frame;
use crate::math::rotation::{from_rotation_vector, rotation_vector};
use crate::solver::Solver;
use crate::solver::strands::strand::{self, Strand};

/// A root jumps if it ends farther than this, in units of its strand's length, from where its velocity would take it.
const JUMP_FRACTION: f64 = 0.25;
/// The least displacement of a jumping body, m.
const MIN_BODY_JUMP: f64 = 0.01;

/// An upper bound on the distance of any point within `radius` of a frame's origin from where the frame's velocities would take
/// it.
fn surprise(from: &Frame, to: &Frame, velocity: Vector3<f64>, spin: Vector3<f64>, dt: f64, radius: f64) -> f64 {
    let foreseen = from_rotation_vector(spin * dt) * from.rotation;
    let turn = rotation_vector(&(to.rotation * foreseen.inverse())).norm();
    (to.origin - from.origin - velocity * dt).norm() + radius * turn
}

impl Strand {
    /// The final pose of its root after `dt` seconds if it jumps, that is, if its velocity changes by more than `most` m/s².
    fn jump(&self, dt: f64, most: f64) -> Option<Frame> {
        self.root_move.as_ref().filter(|_| self.frozen.is_none())?;
        let (from, to) = (&self.state.root, strand::root_after(&self.root_move, &self.state.root, dt));
        let (velocity, spin) = (self.instant_velocity(), self.instant_angular_velocity());
        let length = self.model.length();
        let most = (JUMP_FRACTION * length).max(most * dt * dt);
        // An angle is at most π times the sine of its half: nearly all roots are decided without trigonometry.
        let half_sine = (to.rotation * from.rotation.inverse()).quaternion().imag().norm();
        if (to.origin - from.origin - velocity * dt).norm() + length * (PI * half_sine + spin.norm() * dt) <= most {
            return None;
        }
        let surprise = surprise(from, &to, velocity, spin, dt, length);
        (surprise > most).then_some(to)
    }
}

impl Solver {
    /// Moves strands whose roots jump in the next `dt` seconds to the roots' final poses, and returns how many. Bodies that jump
    /// with them take the next substep for it, and stand still for these strands.
    pub(super) fn carry_over_jumps(&mut self, dt: f64) -> u32 {
        let most = self.options.jump_acceleration;
        if most.is_infinite() {
            return 0;
        }
        let mut carried = 0;
        for strand in &mut self.strands {
            let Some(to) = strand.jump(dt, most) else { continue };
            strand.jump_to(to);
            carried += 1;
        }
        if carried == 0 {
            return 0;
        }
        let mut from = Vec::with_capacity(self.bodies.len());
        for scene_body in &mut self.bodies {
            let body = &mut scene_body.body;
            let to = body.motion.after(dt);
            let (velocity, spin) = body.motion.velocity();
            let jumps = surprise(&body.motion.pose, &to, velocity, spin, dt, body.radius()) > MIN_BODY_JUMP.max(most * dt * dt);
            if jumps {
                body.motion.send(to, 0.0);
            }
            let bends = body.end_bending_where_it_jumps(dt, MIN_BODY_JUMP.max(most * dt * dt));
            from.push(if jumps || bends { to } else { body.motion.pose });
        }
        for divergence in self.strands.iter_mut().filter_map(|strand| strand.divergence.as_deref_mut()) {
            if matches!(divergence.state, DivergenceState::Carried { .. }) && divergence.bodies.is_empty() {
                divergence.bodies.clone_from(&from);
            }
        }
        carried
    }
}
