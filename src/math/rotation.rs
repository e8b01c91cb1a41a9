//! Rotation vectors, and the smooth motion of a pose from one frame to the next.

use nalgebra::{UnitQuaternion, Vector3};

use super::frame::Frame;

/// The rotation vector (axis times angle in [0, π]) of a rotation.
pub fn rotation_vector(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    let q = rotation.quaternion();
    let (scalar, vector) = if q.w < 0.0 { (-q.w, -q.imag()) } else { (q.w, q.imag()) };
    let sine = vector.norm();
    if sine < 1e-9 {
        // atan2(s, w)/s → 1/w: no division by a vanishing sine.
        return vector * (2.0 / scalar);
    }
    vector * (2.0 * arc_tangent(sine, scalar) / sine)
}

/// A number at or above the angle of a rotation, and the nearer the smaller it is.
pub fn angle_at_most(rotation: &UnitQuaternion<f64>) -> f64 {
    let sine = rotation.quaternion().imag().norm();
    // Of the arc sine's series all terms after the first are at most its sum at 1 less that, times s³.
    2.0 * (sine + (std::f64::consts::FRAC_PI_2 - 1.0) * sine * sine * sine)
}

/// The rotation of a rotation vector.
pub fn from_rotation_vector(vector: Vector3<f64>) -> UnitQuaternion<f64> {
    let half = 0.5 * vector.norm();
    let (sine, cosine) = super::functions::trigonometry::sine_cosine(half);
    let factor = if half < 1e-9 { 0.5 } else { 0.5 * sine / half };
    UnitQuaternion::new_normalize(nalgebra::Quaternion::from_parts(cosine, vector * factor))
}

/// Arc tangent of y/x for y ≥ 0, x ≥ 0, by Newton's iteration on this crate's sine and cosine: the same bits on every machine.
pub(crate) fn arc_tangent(y: f64, x: f64) -> f64 {
    let radius = (x * x + y * y).sqrt();
    let (sine, cosine) = (y / radius, x / radius);
    // A rational start (error under 0.01 rad), two steps of a third-order method, and one for rounding.
    let ratio = if sine < cosine { sine / cosine } else { cosine / sine };
    let start = ratio * (std::f64::consts::FRAC_PI_4 + 0.273 * (1.0 - ratio));
    let mut angle = if sine < cosine { start } else { std::f64::consts::FRAC_PI_2 - start };
    for _ in 0..3 {
        let (s, c) = super::functions::trigonometry::sine_cosine(angle);
        angle += sine * c - cosine * s;
    }
    angle
}

/// The same to 2e-8 rad at a fraction of the cost (Abramowitz and Stegun, 4.4.49). Zero where both are.
pub(crate) fn rough_arc_tangent(y: f64, x: f64) -> f64 {
    const TERMS: [f64; 9] = [
        0.002_866_225_7,
        -0.016_165_736_7,
        0.042_909_613_8,
        -0.075_289_640_0,
        0.106_562_639_3,
        -0.142_088_994_4,
        0.199_935_508_5,
        -0.333_331_452_8,
        1.0,
    ];
    let (low, high) = (x.min(y), x.max(y));
    let ratio = if high > 0.0 { low / high } else { 0.0 };
    let angle = ratio * TERMS.iter().fold(0.0, |sum, term| sum * (ratio * ratio) + term);
    if y > x { std::f64::consts::FRAC_PI_2 - angle } else { angle }
}

/// A pose in motion: it leaves `from` with its current velocity and arrives at `to` after `duration` with the mean velocity of
/// the move.
///
/// Position and rotation are C¹ across successive moves and pass exactly through the host's frames. A host that sets one frame
/// per tick gets a smooth motion at any number of substeps, without looking ahead.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseMove {
    /// Pose at the start.
    pub from: Frame,
    /// Pose at the end.
    pub to: Frame,
    /// Velocity at the start, m/s.
    pub velocity: Vector3<f64>,
    /// Angular velocity at the start in the axes of `from`, rad/s.
    pub angular_velocity: Vector3<f64>,
    /// Seconds from start to end; above zero.
    pub duration: f64,
}

impl PoseMove {
    /// The rotation from start to end in the axes of `from`.
    fn turn(&self) -> Vector3<f64> {
        rotation_vector(&(self.from.rotation.inverse() * self.to.rotation))
    }

    /// The pose `elapsed` seconds after the start, constant before the start and after the end.
    pub fn at(&self, elapsed: f64) -> Frame {
        if elapsed <= 0.0 {
            return self.from;
        }
        if elapsed >= self.duration {
            return self.to;
        }
        let u = elapsed / self.duration;
        let displacement = self.to.origin - self.from.origin;
        let turn = self.turn();
        Frame {
            origin: self.from.origin + hermite(u, self.velocity * self.duration, displacement),
            rotation: self.from.rotation * from_rotation_vector(hermite(u, self.angular_velocity * self.duration, turn)),
        }
    }

    /// Velocity at the end, m/s.
    pub fn final_velocity(&self) -> Vector3<f64> {
        (self.to.origin - self.from.origin) / self.duration
    }

    /// Angular velocity at the end, rad/s; it lies along the turn, so the axes of `from` and of `to` give the same components.
    pub fn final_angular_velocity(&self) -> Vector3<f64> {
        self.turn() / self.duration
    }
}

/// The cubic from 0 with slope `start` to `displacement` with slope `displacement`, at u in [0, 1].
fn hermite(u: f64, start: Vector3<f64>, displacement: Vector3<f64>) -> Vector3<f64> {
    let (u2, u3) = (u * u, u * u * u);
    start * (u3 - 2.0 * u2 + u) + displacement * ((3.0 * u2 - 2.0 * u3) + (u3 - u2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotation_vectors_go_there_and_back() {
        for vector in [
            Vector3::new(0.3, -0.2, 0.9),
            Vector3::new(1e-12, 3e-12, 0.0),
            Vector3::zeros(),
            Vector3::new(0.0, 3.1, 0.0),
            Vector3::new(-1.5, 0.001, 2.2),
        ] {
            let back = rotation_vector(&from_rotation_vector(vector));
            assert!((back - vector).norm() < 1e-14 * (1.0 + vector.norm()), "{vector} {back}");
            let direct = UnitQuaternion::from_scaled_axis(vector);
            assert!(from_rotation_vector(vector).angle_to(&direct) < 1e-14);
        }
    }

    #[test]
    fn an_angle_is_bounded_closely() {
        for k in 0..=1000 {
            let angle = std::f64::consts::PI * f64::from(k) / 1000.0;
            let rotation = from_rotation_vector(Vector3::new(0.6, 0.0, -0.8) * angle);
            let bound = angle_at_most(&rotation);
            assert!(bound >= angle - 1e-15 && bound - angle <= 0.11 * angle * angle * angle, "{angle} {bound}");
        }
    }

    #[test]
    fn arc_tangents_are_those_of_the_platform() {
        for k in 0..=1000 {
            let angle = std::f64::consts::FRAC_PI_2 * f64::from(k) / 1000.0;
            let (y, x) = (3.0 * angle.sin(), 3.0 * angle.cos().abs());
            assert!((arc_tangent(y, x) - y.atan2(x)).abs() < 1e-15, "{angle}");
            assert!((rough_arc_tangent(y, x) - y.atan2(x)).abs() < 2e-8, "{angle}");
        }
        assert_eq!(rough_arc_tangent(0.0, 0.0), 0.0);
    }

    #[test]
    fn a_move_is_exact_at_both_ends_and_smooth_across_moves() {
        let frame =
            |x: f64, turn: Vector3<f64>| Frame { origin: Vector3::new(x, 0.1 * x, 0.0), rotation: from_rotation_vector(turn) };
        let (a, b, c) =
            (frame(0.0, Vector3::zeros()), frame(0.1, Vector3::new(0.2, 0.1, 0.0)), frame(0.3, Vector3::new(0.1, 0.4, -0.2)));
        let duration = 0.02;
        let first = PoseMove { from: a, to: b, velocity: Vector3::zeros(), angular_velocity: Vector3::zeros(), duration };
        let second = PoseMove {
            from: b,
            to: c,
            velocity: first.final_velocity(),
            angular_velocity: first.final_angular_velocity(),
            duration,
        };
        assert_eq!(first.at(0.0), a);
        assert_eq!(first.at(duration), b);
        let small = 1e-7;
        let before = (first.at(duration).origin - first.at(duration - small).origin) / small;
        let after = (second.at(small).origin - second.at(0.0).origin) / small;
        assert!((before - after).norm() < 1e-4 * before.norm(), "{before} {after}");
        let turn_before = rotation_vector(&(first.at(duration - small).rotation.inverse() * b.rotation)) / small;
        let turn_after = rotation_vector(&(b.rotation.inverse() * second.at(small).rotation)) / small;
        assert!((turn_before - turn_after).norm() < 1e-4 * turn_before.norm(), "{turn_before} {turn_after}");
    }
}
