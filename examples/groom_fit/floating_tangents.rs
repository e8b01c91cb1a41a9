//! Piecewise helices by floating tangents (Derouet-Jourdan, Bertails-Descoubes and Thollot 2013): a curve of helices with
//! continuous tangents passes through given points of the curve if, for each piece, both tangents make the same angle with the
//! chord. The tangents are moved as little as possible until they do; each piece's helix then follows from its chord and
//! tangents.
//!
//! The result is a Super-Helix with a parallel-transported material frame. But its length is its own, and the choice of the
//! pieces is not part of the method.

use nalgebra::{Rotation3, Unit, Vector3};

use crate::methods::Errors;
use crate::sequential::{arclengths, stretch};

/// Largest number of sweeps over the pieces' conditions.
const SWEEPS: usize = 500;

/// Fits, and measures at the points, at equal fractions of the lengths.
pub fn fit(points: &[Vector3<f64>], elements: usize) -> Option<Errors> {
    let all = arclengths(points);
    let total = all[all.len() - 1];
    let place = |s: f64| stretch(points, &all, s.clamp(0.0, total), total).0[0];
    let nodes: Vec<Vector3<f64>> = (0..=elements).map(|k| place(total * k as f64 / elements as f64)).collect();
    // Tangents of the curve over a tenth of a piece to either side.
    let reach = 0.1 * total / elements as f64;
    let mut tangents: Vec<Vector3<f64>> = (0..=elements)
        .map(|k| {
            let s = total * k as f64 / elements as f64;
            (place(s + reach) - place(s - reach)).normalize()
        })
        .collect();
    float(&nodes, &mut tangents);
    let pieces: Vec<Piece> =
        (0..elements).map(|k| Piece::between(nodes[k], nodes[k + 1], tangents[k], tangents[k + 1])).collect::<Option<_>>()?;
    let length: f64 = pieces.iter().map(|piece| piece.length).sum();
    let (mut piece, mut before) = (0, 0.0);
    let distances: Vec<f64> = points
        .iter()
        .zip(&all)
        .map(|(point, s)| {
            let wanted = s / total * length;
            while piece + 1 < elements && wanted > before + pieces[piece].length {
                before += pieces[piece].length;
                piece += 1;
            }
            (pieces[piece].at(wanted - before) - point).norm()
        })
        .collect();
    Some(Errors::of(&distances))
}

/// Moves tangents until (t − t′)·chord = 0 for every piece: satisfies each condition in turn by the least change, repeatedly.
fn float(nodes: &[Vector3<f64>], tangents: &mut [Vector3<f64>]) {
    for _ in 0..SWEEPS {
        let mut worst = 0.0_f64;
        for k in 0..nodes.len() - 1 {
            let chord = (nodes[k + 1] - nodes[k]).normalize();
            let off = 0.5 * (tangents[k] - tangents[k + 1]).dot(&chord);
            worst = worst.max(off.abs());
            tangents[k] = (tangents[k] - chord * off).normalize();
            tangents[k + 1] = (tangents[k + 1] + chord * off).normalize();
        }
        if worst < 1e-12 {
            return;
        }
    }
}

/// A helix from a point along a tangent, turning about an axis.
struct Piece {
    start: Vector3<f64>,
    tangent: Vector3<f64>,
    axis: Unit<Vector3<f64>>,
    /// rad per unit of length.
    rate: f64,
    length: f64,
}

impl Piece {
    /// The helix that turns least out of the plane between two points with these tangents, which make the same angle with the chord.
    fn between(from: Vector3<f64>, to: Vector3<f64>, t0: Vector3<f64>, t1: Vector3<f64>) -> Option<Self> {
        let chord = to - from;
        let size = chord.norm();
        let middle = (t0 + t1).normalize();
        let across = t0.cross(&t1);
        if size == 0.0 || !middle.x.is_finite() {
            return None;
        }
        if across.norm() < 1e-9 {
            // Equal tangents: a straight piece if the chord lies along them (otherwise a whole turn, which is unwanted here).
            return Some(Self { start: from, tangent: chord / size, axis: Vector3::z_axis(), rate: 0.0, length: size });
        }
        let normal = across.normalize();
        // Axes that turn t0 into t1 lie in the plane of `middle` and `normal`; so does the mean tangent. One angle decides.
        let wanted = chord.dot(&middle).atan2(chord.dot(&normal));
        let helix = |angle: f64| {
            let axis = normal * angle.cos() + middle * angle.sin();
            let (a, b) = (t0 - axis * axis.dot(&t0), t1 - axis * axis.dot(&t1));
            let turn = a.cross(&b).dot(&axis).atan2(a.dot(&b)).rem_euclid(std::f64::consts::TAU);
            let mean = if turn < 1e-9 {
                t0
            } else {
                axis * axis.dot(&t0) + a * (turn.sin() / turn) + axis.cross(&a) * ((1.0 - turn.cos()) / turn)
            };
            (axis, turn, mean)
        };
        let miss = |angle: f64| {
            let (_, _, mean) = helix(angle);
            let here = mean.dot(&middle).atan2(mean.dot(&normal));
            (here - wanted + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI
        };
        // The zero nearest to the plane arc's axis, by widening steps and bisection.
        let mut best: Option<f64> = None;
        for side in [1.0, -1.0] {
            let (mut low, mut value) = (0.0, miss(0.0));
            for step in 1..=120 {
                let high = side * 0.026 * f64::from(step);
                let next = miss(high);
                if value * next <= 0.0 && (value - next).abs() < 1.0 {
                    let (mut a, mut b) = (low, high);
                    for _ in 0..60 {
                        let half = 0.5 * (a + b);
                        if miss(a) * miss(half) <= 0.0 { b = half } else { a = half }
                    }
                    let zero = 0.5 * (a + b);
                    if best.is_none_or(|other: f64| zero.abs() < other.abs()) {
                        best = Some(zero);
                    }
                    break;
                }
                (low, value) = (high, next);
            }
        }
        let (axis, turn, mean) = helix(best?);
        let length = size / mean.norm();
        Some(Self { start: from, tangent: t0, axis: Unit::new_normalize(axis), rate: turn / length, length })
    }

    fn at(&self, s: f64) -> Vector3<f64> {
        if self.rate * self.length < 1e-9 {
            return self.start + self.tangent * s;
        }
        let axis = self.axis.into_inner();
        let across = self.tangent - axis * axis.dot(&self.tangent);
        let quarter = Rotation3::from_axis_angle(&self.axis, std::f64::consts::FRAC_PI_2) * across;
        let (sine, cosine) = (self.rate * s).sin_cos();
        self.start + axis * (axis.dot(&self.tangent) * s) + across * (sine / self.rate) + quarter * ((1.0 - cosine) / self.rate)
    }
}
