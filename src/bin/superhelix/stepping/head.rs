//! A head that carries roots: a motion laid onto a groom.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::Frame;
use superhelix::io::Motion;

/// A rigid motion of roots. At its start every root is where the groom has it; from there the roots turn about the head's joint
/// as the motion turns, and go where it goes: M(t) M(start)⁻¹, with M's origin moved to the joint.
#[derive(Debug)]
pub struct Head {
    motion: Option<Motion>,
    start: f64,
    joint: Vector3<f64>,
}

impl Head {
    /// A head that follows `motion` from its time `start` (s) on, or stands still; `joint` is where the motion's joint sits in
    /// the groom, m.
    pub fn new(motion: Option<Motion>, start: f64, joint: Vector3<f64>) -> Self {
        Self { motion, start, joint }
    }

    /// How far it has turned and where the joint is, `elapsed` seconds after the start.
    fn carry(&self, elapsed: f64) -> (UnitQuaternion<f64>, Vector3<f64>) {
        let Some(motion) = &self.motion else { return (UnitQuaternion::identity(), self.joint) };
        let (now, start) = (motion.at(self.start + elapsed), motion.at(self.start));
        (now.rotation * start.rotation.inverse(), self.joint + now.origin - start.origin)
    }

    /// Where roots are, `elapsed` seconds after the start.
    pub fn roots(&self, elapsed: f64, at_start: &[Frame], roots: &mut Vec<Frame>) {
        let (turn, joint) = self.carry(elapsed);
        roots.clear();
        roots.extend(
            at_start
                .iter()
                .map(|root| Frame { origin: joint + turn * (root.origin - self.joint), rotation: turn * root.rotation }),
        );
    }

    /// Velocity (m/s) and angular velocity (rad/s) of a root at the start.
    pub fn velocity_at_start(&self, root: &Frame) -> (Vector3<f64>, Vector3<f64>) {
        let Some(motion) = &self.motion else { return (Vector3::zeros(), Vector3::zeros()) };
        let (velocity, spin) = motion.velocity(self.start);
        (velocity + spin.cross(&(root.origin - self.joint)), spin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nodding() -> Motion {
        let times: Vec<f64> = (0..60).map(|index| f64::from(index) / 60.0).collect();
        let frames = times
            .iter()
            .map(|time| Frame {
                origin: Vector3::new(time * time, 1.6, 0.3 * time),
                rotation: UnitQuaternion::from_euler_angles(0.5 * (4.0 * time).sin(), 0.3 + time, 0.1),
            })
            .collect();
        Motion::from_samples(times, frames).unwrap()
    }

    #[test]
    fn roots_start_where_the_groom_has_them_and_keep_their_distance() {
        let head = Head::new(Some(nodding()), 0.25, Vector3::new(0.0, 1.5, 0.0));
        let groom: Vec<Frame> = (0..5)
            .map(|index| Frame {
                origin: Vector3::new(0.1, 1.6, 0.02 * f64::from(index)),
                rotation: UnitQuaternion::from_euler_angles(0.1 * f64::from(index), 0.0, 0.4),
            })
            .collect();
        let mut roots = Vec::new();
        head.roots(0.0, &groom, &mut roots);
        for (root, drawn) in roots.iter().zip(&groom) {
            assert!((root.origin - drawn.origin).norm() < 1e-14);
            assert!(root.rotation.angle_to(&drawn.rotation) < 1e-7);
        }
        head.roots(0.5, &groom, &mut roots);
        let local = |frames: &[Frame]| frames[0].rotation.inverse() * (frames[4].origin - frames[0].origin);
        assert!((local(&roots) - local(&groom)).norm() < 1e-14);
        assert!((roots[0].origin - groom[0].origin).norm() > 0.05);
    }

    #[test]
    fn the_velocity_at_the_start_is_the_derivative() {
        let head = Head::new(Some(nodding()), 0.25, Vector3::new(0.0, 1.5, 0.0));
        let root = Frame { origin: Vector3::new(0.1, 1.6, 0.02), rotation: UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3) };
        let step = 1e-6;
        let (mut before, mut after) = (Vec::new(), Vec::new());
        head.roots(-step, &[root], &mut before);
        head.roots(step, &[root], &mut after);
        let (velocity, spin) = head.velocity_at_start(&root);
        assert!(((after[0].origin - before[0].origin) / (2.0 * step) - velocity).norm() < 1e-6);
        let turned = (after[0].rotation * before[0].rotation.inverse()).scaled_axis() / (2.0 * step);
        assert!((turned - spin).norm() < 1e-6, "{turned} {spin}");
    }
}
