//! The motion of a pose that a host sends from frame to frame: bodies and the targets of constraints.

use nalgebra::Vector3;

use super::Frame;
use crate::math::rotation::{PoseMove, rotation_vector};

/// A pose at rest or in motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PoseMotion {
    /// The pose now.
    pub pose: Frame,
    /// The current move, and how many of its seconds have passed. Kept for one substep after its end, so that the next move
    /// begins with its velocity.
    pub going: Option<(PoseMove, f64)>,
}

impl PoseMotion {
    /// At rest.
    pub fn at(pose: Frame) -> Self {
        Self { pose, going: None }
    }

    /// Sends the pose to another in `duration` seconds, starting with its current velocity; 0 seconds means within the next
    /// substep.
    pub fn send(&mut self, pose: Frame, duration: f64) {
        let (velocity, spin) = self.velocity();
        let angular_velocity = self.pose.rotation.inverse() * spin;
        self.going = Some((PoseMove { from: self.pose, to: pose, velocity, angular_velocity, duration }, 0.0));
    }

    /// Velocity (m/s) and angular velocity (rad/s), world axes, that the last move has reached.
    pub fn velocity(&self) -> (Vector3<f64>, Vector3<f64>) {
        match &self.going {
            Some((motion, elapsed)) if motion.duration > 0.0 && *elapsed > 0.0 => {
                if *elapsed >= motion.duration {
                    return (motion.final_velocity(), self.pose.rotation * motion.final_angular_velocity());
                }
                // In the middle of a move: the mean over a short stretch up to now.
                let short = (1e-4 * motion.duration).min(*elapsed);
                let before = motion.at(elapsed - short);
                let turn = rotation_vector(&(self.pose.rotation * before.rotation.inverse()));
                ((self.pose.origin - before.origin) / short, turn / short)
            }
            _ => (Vector3::zeros(), Vector3::zeros()),
        }
    }

    /// Prepares for a substep of `h` seconds: a move of duration 0 takes that substep.
    pub fn begin(&mut self, h: f64) {
        if let Some((motion, _)) = &mut self.going
            && motion.duration == 0.0
        {
            motion.duration = h;
        }
    }

    /// The pose `seconds` from now.
    pub fn after(&self, seconds: f64) -> Frame {
        match &self.going {
            Some((motion, elapsed)) => {
                let time = elapsed + seconds;
                // A step meant to end with the move may miss its end by rounding.
                if time >= motion.duration * (1.0 - 1e-12) { motion.to } else { motion.at(time) }
            }
            None => self.pose,
        }
    }

    /// Advances by a substep of `h` seconds.
    pub fn advance(&mut self, h: f64) {
        self.pose = self.after(h);
        if let Some((motion, elapsed)) = &mut self.going {
            if *elapsed >= motion.duration {
                self.going = None;
            } else {
                *elapsed += h;
                if *elapsed >= motion.duration * (1.0 - 1e-12) {
                    *elapsed = motion.duration;
                }
            }
        }
    }
}
