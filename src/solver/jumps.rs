//! Roots that jump: that go further within a call of [`Solver::step`](super::Solver::step) than their strand can follow, as when a head is dragged, or put
//! elsewhere between two frames. Such a strand goes along with its root, its shape and its velocities in the root's axes kept, and the
//! bodies that jump meanwhile are for it where they end: nothing is flung about that a dearer step would only have to put in order again.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::Solver;
use super::astray::Whereabouts;
use super::strand::{self, Strand};
use crate::math::frame::Frame;
use crate::math::rotation::{from_rotation_vector, rotation_vector};

/// A root jumps that comes, in units of its strand's length, further than this from where its velocity would have taken it.
const PART: f64 = 0.25;
/// The least way of a body that jumps, m.
const LEAST: f64 = 0.01;

/// How far something at `radius` from a frame's origin is, at most, from where the frame would have come to at its velocities.
fn surprise(from: &Frame, to: &Frame, velocity: Vector3<f64>, spin: Vector3<f64>, dt: f64, radius: f64) -> f64 {
    let foreseen = from_rotation_vector(spin * dt) * from.rotation;
    let turn = rotation_vector(&(to.rotation * foreseen.inverse())).norm();
    (to.origin - from.origin - velocity * dt).norm() + radius * turn
}

impl Strand {
    /// Where its root will have jumped to in `dt` seconds, if it does: with more than `most` m/s² between what it did and what it is to do.
    fn jump(&self, dt: f64, most: f64) -> Option<Frame> {
        self.root_move.as_ref().filter(|_| self.frozen.is_none())?;
        let (from, to) = (&self.state.root, strand::root_after(&self.root_move, &self.state.root, dt));
        let (velocity, spin) = (self.instant_velocity(), self.instant_angular_velocity());
        let length = self.model.length();
        let most = (PART * length).max(most * dt * dt);
        // An angle is at most π times its half's sine: nearly all roots are told so without trigonometry.
        let half_sine = (to.rotation * from.rotation.inverse()).quaternion().imag().norm();
        if (to.origin - from.origin - velocity * dt).norm() + length * (PI * half_sine + spin.norm() * dt) <= most {
            return None;
        }
        let surprise = surprise(from, &to, velocity, spin, dt, length);
        (surprise > most).then_some(to)
    }
}

impl Solver {
    /// Takes strands whose roots jump in the `dt` seconds to come to where these will be, and tells how many. Bodies that jump with them make their way within
    /// the coming substep, and stand still for these strands.
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
            let to = body.way.after(dt);
            let (velocity, spin) = body.way.velocity();
            let jumps = surprise(&body.way.pose, &to, velocity, spin, dt, body.radius()) > LEAST.max(most * dt * dt);
            if jumps {
                body.way.send(to, 0.0);
            }
            let bends = body.end_bending_where_it_jumps(dt, LEAST.max(most * dt * dt));
            from.push(if jumps || bends { to } else { body.way.pose });
        }
        for astray in self.strands.iter_mut().filter_map(|strand| strand.astray.as_deref_mut()) {
            if matches!(astray.state, Whereabouts::Carried { .. }) && astray.bodies.is_empty() {
                astray.bodies.clone_from(&from);
            }
        }
        carried
    }
}
