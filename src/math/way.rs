//! A pose that a host sends from frame to frame: bodies and the targets of constraints.

use nalgebra::Vector3;

use super::frame::Frame;
use super::rotation::{PoseMove, rotation_vector};

/// A pose at rest or on its way.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Way {
    /// The pose now.
    pub pose: Frame,
    /// Where it is going, and how many seconds of that are done. Kept for a substep after its end, so that the next move begins with
    /// its velocity.
    pub going: Option<(PoseMove, f64)>,
}

impl Way {
    /// At rest.
    pub fn at(pose: Frame) -> Self {
        Self { pose, going: None }
    }

    /// Sends it to a pose in `duration` seconds, leaving with the velocity that it has; in 0 seconds: within the coming substep.
    pub fn send(&mut self, pose: Frame, duration: f64) {
        let (velocity, spin) = self.velocity();
        let angular_velocity = self.pose.rotation.inverse() * spin;
        self.going = Some((PoseMove { from: self.pose, to: pose, velocity, angular_velocity, duration }, 0.0));
    }

    /// Velocity (m/s) and angular velocity (rad/s), world, where the last move has brought it.
    pub fn velocity(&self) -> (Vector3<f64>, Vector3<f64>) {
        match &self.going {
            Some((way, elapsed)) if way.duration > 0.0 && *elapsed > 0.0 => {
                if *elapsed >= way.duration {
                    return (way.final_velocity(), self.pose.rotation * way.final_angular_velocity());
                }
                // In the middle of a way: the mean over a short stretch up to now.
                let short = (1e-4 * way.duration).min(*elapsed);
                let before = way.at(elapsed - short);
                let turn = rotation_vector(&(self.pose.rotation * before.rotation.inverse()));
                ((self.pose.origin - before.origin) / short, turn / short)
            }
            _ => (Vector3::zeros(), Vector3::zeros()),
        }
    }

    /// Before a substep of `h` seconds: a way to be gone at once takes it.
    pub fn begin(&mut self, h: f64) {
        if let Some((way, _)) = &mut self.going
            && way.duration == 0.0
        {
            way.duration = h;
        }
    }

    /// The pose `seconds` on.
    pub fn after(&self, seconds: f64) -> Frame {
        match &self.going {
            Some((way, elapsed)) => {
                let time = elapsed + seconds;
                // A step meant to end with the move may miss its end by rounding.
                if time >= way.duration * (1.0 - 1e-12) { way.to } else { way.at(time) }
            }
            None => self.pose,
        }
    }

    /// Counts the `h` seconds of a substep.
    pub fn advance(&mut self, h: f64) {
        self.pose = self.after(h);
        if let Some((way, elapsed)) = &mut self.going {
            if *elapsed >= way.duration {
                self.going = None;
            } else {
                *elapsed += h;
                if *elapsed >= way.duration * (1.0 - 1e-12) {
                    *elapsed = way.duration;
                }
            }
        }
    }
}
