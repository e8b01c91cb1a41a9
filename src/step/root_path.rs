//! The root's smooth path through a step, with velocities and accelerations, from poses alone: polynomials through Chebyshev's
//! points, differentiated exactly. A path with a kink is cut there.

use nalgebra::{Matrix3, Vector3};

use crate::math::frame::Frame;
use crate::math::functions::trigonometry::sine_cosine;
use crate::math::rotation::{from_rotation_vector, rotation_vector};
use crate::math::splines::pose_spline::right_jacobian;
use crate::rod::velocity::RootMotion;

/// Points of a polynomial.
const POINTS: usize = 14;
/// The most that a polynomial may turn from its start, rad.
const LARGEST_TURN: f64 = 1.5;
/// Relative error permitted between the points of a smooth path.
const SMOOTH: f64 = 1e-12;
/// The shortest piece in units of the step: a shorter rest around a kink is skipped.
const SHORTEST: f64 = 1e-11;
/// Largest number of polynomials to try.
const MAX_CUTS: u32 = 2000;

type Values = [Vector3<f64>; POINTS];

/// One smooth piece.
#[derive(Debug, Clone)]
pub struct RootPath {
    /// Start, s from the start of the step.
    pub start: f64,
    /// End, s.
    pub end: f64,
    frame: Frame,
    velocity: Values,
    acceleration: Values,
    turn: Values,
    angular_velocity: Values,
    angular_acceleration: Values,
}

/// Chebyshev's extreme points on [0, 1].
fn nodes() -> [f64; POINTS] {
    std::array::from_fn(|k| 0.5 * (1.0 - sine_cosine(std::f64::consts::PI * k as f64 / (POINTS - 1) as f64).1))
}

/// Barycentric weight of a node, up to a common factor.
fn weight(k: usize) -> f64 {
    let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    if k == 0 || k == POINTS - 1 { 0.5 * sign } else { sign }
}

/// The polynomial's value at `x`.
fn interpolate(nodes: &[f64; POINTS], values: &Values, x: f64) -> Vector3<f64> {
    let (mut sum, mut total) = (Vector3::zeros(), 0.0);
    for k in 0..POINTS {
        let off = x - nodes[k];
        if off == 0.0 {
            return values[k];
        }
        sum += values[k] * (weight(k) / off);
        total += weight(k) / off;
    }
    sum / total
}

/// Derivatives at the nodes with respect to a variable over [0, `length`].
fn differentiate(nodes: &[f64; POINTS], values: &Values, length: f64) -> Values {
    std::array::from_fn(|i| {
        let mut sum = Vector3::zeros();
        for j in 0..POINTS {
            if i != j {
                // Differences of values: the diagonal's rounding cancels, and a root at rest is at rest to the bit.
                sum += (values[j] - values[i]) * (weight(j) / weight(i) / (nodes[i] - nodes[j]));
            }
        }
        sum / length
    })
}

impl RootPath {
    /// All smooth pieces from 0 to `h`, in order. `None` for a path that is nowhere smooth.
    pub fn pieces(root_at: &dyn Fn(f64) -> Frame, h: f64) -> Option<Vec<RootPath>> {
        let mut pieces = Vec::new();
        let mut left = MAX_CUTS;
        Self::cut(root_at, h, 0.0, h, &mut pieces, &mut left).then_some(pieces)
    }

    fn cut(root_at: &dyn Fn(f64) -> Frame, h: f64, start: f64, end: f64, pieces: &mut Vec<RootPath>, left: &mut u32) -> bool {
        if end - start < SHORTEST * h {
            return true;
        }
        if *left == 0 {
            return false;
        }
        *left -= 1;
        if let Some(piece) = Self::through(root_at, start, end) {
            pieces.push(piece);
            return true;
        }
        let middle = 0.5 * (start + end);
        Self::cut(root_at, h, start, middle, pieces, left) && Self::cut(root_at, h, middle, end, pieces, left)
    }

    /// The piece from `start` to `end`, if it is smooth.
    fn through(root_at: &dyn Fn(f64) -> Frame, start: f64, end: f64) -> Option<Self> {
        let nodes = nodes();
        let length = end - start;
        let frame = root_at(start);
        let place = |x: f64| {
            let at = root_at(start + length * x);
            (at.origin - frame.origin, rotation_vector(&(frame.rotation.inverse() * at.rotation)))
        };
        let samples: [_; POINTS] = nodes.map(place);
        let displacement: Values = samples.map(|sample| sample.0);
        let turn: Values = samples.map(|sample| sample.1);
        let far = |values: &Values| values.iter().map(Vector3::norm).fold(0.0, f64::max);
        let (extent, angle) = (far(&displacement), far(&turn));
        if angle > LARGEST_TURN {
            return None;
        }
        // Rounding of the poses and of their times: a short piece late in a step knows its own time poorly.
        let coarse = SMOOTH + 64.0 * f64::EPSILON * end / length;
        let rounding = 64.0 * f64::EPSILON * (frame.origin.norm() + extent);
        for pair in nodes.windows(2) {
            let x = 0.5 * (pair[0] + pair[1]);
            let (there, turned) = place(x);
            let off = (interpolate(&nodes, &displacement, x) - there).norm();
            let off_turn = (interpolate(&nodes, &turn, x) - turned).norm();
            if off > coarse * extent + rounding || off_turn > coarse * angle + 64.0 * f64::EPSILON {
                return None;
            }
        }
        let velocity = differentiate(&nodes, &displacement, length);
        let rate = differentiate(&nodes, &turn, length);
        // Angular velocity in the axes of the piece's first frame.
        let spin: Values = std::array::from_fn(|k| from_rotation_vector(turn[k]) * (right_jacobian(&turn[k]) * rate[k]));
        let spin_rate = differentiate(&nodes, &spin, length);
        Some(Self {
            start,
            end,
            frame,
            velocity,
            acceleration: differentiate(&nodes, &velocity, length),
            turn,
            angular_velocity: spin.map(|value| frame.rotation * value),
            angular_acceleration: spin_rate.map(|value| frame.rotation * value),
        })
    }

    /// The root's rotation and motion at `time`, s from the start of the step, within the piece.
    pub fn at(&self, time: f64) -> (Matrix3<f64>, RootMotion) {
        let nodes = nodes();
        let x = (time - self.start) / (self.end - self.start);
        let value = |values: &Values| interpolate(&nodes, values, x);
        let rotation = self.frame.rotation * from_rotation_vector(value(&self.turn));
        let motion = RootMotion {
            velocity: value(&self.velocity).into(),
            angular_velocity: value(&self.angular_velocity).into(),
            acceleration: value(&self.acceleration).into(),
            angular_acceleration: value(&self.angular_acceleration).into(),
        };
        (rotation.to_rotation_matrix().into_inner(), motion)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn swinging(t: f64) -> Frame {
        let turn = Vector3::new(0.3 * (7.0 * t).sin(), 0.0, 0.9 * (5.0 * t).sin());
        Frame { origin: Vector3::new((3.0 * t).cos(), 2.0 * t * t, 0.0), rotation: from_rotation_vector(turn) }
    }

    #[test]
    fn velocities_and_accelerations_are_those_of_the_path() {
        let pieces = RootPath::pieces(&swinging, 0.5).unwrap();
        assert_eq!((pieces[0].start, pieces[pieces.len() - 1].end), (0.0, 0.5));
        for piece in &pieces {
            for part in 0..=10 {
                let t = piece.start + (piece.end - piece.start) * f64::from(part) / 10.0;
                let (_, motion) = piece.at(t);
                let exact = Vector3::new(-3.0 * (3.0 * t).sin(), 4.0 * t, 0.0);
                assert!((Vector3::from(motion.velocity) - exact).norm() < 1e-9);
                let exact = Vector3::new(-9.0 * (3.0 * t).cos(), 4.0, 0.0);
                assert!((Vector3::from(motion.acceleration) - exact).norm() < 1e-6);
                // Angular velocity by a difference over a short path, and its rate by a difference of that.
                let small = 1e-4;
                let (before, after) = (swinging(t - small).rotation, swinging(t + small).rotation);
                let difference = rotation_vector(&(after * before.inverse())) / (2.0 * small);
                assert!((Vector3::from(motion.angular_velocity) - difference).norm() < 1e-5);
                if part > 0 && part < 10 {
                    let spin = |t: f64| Vector3::from(piece.at(t).1.angular_velocity);
                    let rate = (spin(t + small) - spin(t - small)) / (2.0 * small);
                    assert!((Vector3::from(motion.angular_acceleration) - rate).norm() < 1e-4);
                }
            }
        }
    }

    #[test]
    fn a_kink_is_cut_out() {
        let kinked = |t: f64| Frame { origin: Vector3::new((t - 0.3).max(0.0), 0.0, 0.0), ..Frame::default() };
        let pieces = RootPath::pieces(&kinked, 1.0).unwrap();
        assert!(pieces.len() > 1);
        let noise = |t: f64| Frame { origin: Vector3::new((1e9 * t).sin(), 0.0, 0.0), ..Frame::default() };
        assert!(RootPath::pieces(&noise, 1.0).is_none());
        for piece in &pieces {
            let speed = piece.at(0.5 * (piece.start + piece.end)).1.velocity.0[0];
            let expected = if piece.start < 0.3 { 0.0 } else { 1.0 };
            // Short pieces beside the kink know their speed less well.
            assert!((speed - expected).abs() < 1e-3, "{} to {}: {speed}", piece.start, piece.end);
        }
    }
}
