//! The phase of a guide's curl: the angle by which its bend has rotated about the guide from point to point.
//!
//! In frames that are parallel-transported the bends of a curl rotate. Those of two curls that are out of phase cancel when
//! mixed. With each guide's own phase φ removed they all point the same way. The phase starts as the strongest frequency among
//! the bends; the rest is smoothed and tracked. A straight or plainly bent guide has nearly none.

use super::shape::{BEND, Reference, Shape};
use crate::math::functions::trigonometry::sine_cosine;
use crate::math::rotation::arc_tangent;

/// The largest phase change from point to point: beyond a half turn it is ambiguous.
const LARGEST: f64 = 0.95 * std::f64::consts::PI;
/// The fraction of their size that smoothed bends must keep for their angle to be tracked.
const CLEAR: f64 = 0.3;

type Complex = [f64; 2];

fn product(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// e^(i angle).
pub(in crate::groom::render_hair) fn phasor(angle: f64) -> Complex {
    let (sine, cosine) = sine_cosine(angle);
    [cosine, sine]
}

/// The angle of a number, in (−π, π]; 0 of 0.
pub(in crate::groom::render_hair) fn argument([x, y]: Complex) -> f64 {
    if x == 0.0 && y == 0.0 {
        return 0.0;
    }
    let angle = arc_tangent(y.abs(), x.abs());
    let angle = if x < 0.0 { std::f64::consts::PI - angle } else { angle };
    if y < 0.0 { -angle } else { angle }
}

/// An angle shifted by whole turns to within half a turn of another.
fn nearest_turn(angle: f64, to: f64) -> f64 {
    angle - std::f64::consts::TAU * ((angle - to) / std::f64::consts::TAU).round()
}

/// Phases of all guides, one row each.
pub(in crate::groom::render_hair) fn phases(reference: &Reference, shape: &Shape) -> Vec<f32> {
    let stride = reference.stride;
    let mut out = vec![0.0; reference.guides * stride];
    for (row, phases) in shape.rows.chunks(reference.size()).zip(out.chunks_mut(stride)) {
        let bends: Vec<Complex> = (1..reference.points.max(2) - 1)
            .map(|k| [f64::from(row[BEND * stride + k]), f64::from(row[(BEND + 1) * stride + k])])
            .collect();
        for (phase, found) in phases[1..].iter_mut().zip(phases_of(&bends)) {
            *phase = found as f32;
        }
    }
    out
}

/// The phase at each bend.
fn phases_of(bends: &[Complex]) -> Vec<f64> {
    let count = bends.len();
    let most = 4 * count as i64;
    let mut best = (0.0, 0.0);
    // Slowest first: of equals it wins.
    for step in 0..=most {
        for sign in [1.0, -1.0] {
            let turn = sign * LARGEST * step as f64 / most.max(1) as f64;
            let back = phasor(-turn);
            let (mut factor, mut sum) = ([1.0, 0.0], [0.0; 2]);
            for bend in bends {
                let term = product(factor, *bend);
                sum = [sum[0] + term[0], sum[1] + term[1]];
                factor = product(factor, back);
            }
            let strength = sum[0] * sum[0] + sum[1] * sum[1];
            if strength > best.0 * (1.0 + 1e-9) {
                best = (strength, turn);
            }
        }
    }
    let mut phases: Vec<f64> = (0..count).map(|k| best.1 * k as f64).collect();
    let left: Vec<Complex> = bends.iter().zip(&phases).map(|(bend, phase)| product(phasor(-phase), *bend)).collect();
    let half = (count / 8).max(1) as i64;
    let mut followed = None;
    for k in 0..count as i64 {
        let (mut sum, mut size) = ([0.0; 2], 0.0);
        for offset in -half..=half {
            if let Some(value) = usize::try_from(k + offset).ok().and_then(|at| left.get(at)) {
                let weight = (half + 1 - offset.abs()) as f64;
                sum = [sum[0] + weight * value[0], sum[1] + weight * value[1]];
                size += weight * (value[0] * value[0] + value[1] * value[1]).sqrt();
            }
        }
        let strength = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
        if strength > CLEAR * size {
            let angle = argument(sum);
            followed = Some(followed.map_or(angle, |before| nearest_turn(angle, before)));
        }
        phases[k as usize] += followed.unwrap_or(0.0);
    }
    phases
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curl_loses_its_turning_and_a_bend_has_none() {
        for turn in [0.0, 0.4, -1.3, 2.2] {
            // The pitch drifts by a tenth, the strength by a third.
            let bends: Vec<Complex> = (0..30)
                .map(|k| {
                    let k = f64::from(k);
                    product([0.3 + 0.003 * k, 0.0], phasor(1.0 + turn * k * (1.0 + 0.003 * k)))
                })
                .collect();
            let phases = phases_of(&bends);
            let sum = bends.iter().zip(&phases).fold([0.0; 2], |sum, (bend, phase)| {
                let left = product(phasor(-phase), *bend);
                [sum[0] + left[0], sum[1] + left[1]]
            });
            let whole: f64 = bends.iter().map(|[x, y]| (x * x + y * y).sqrt()).sum();
            let kept = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt() / whole;
            assert!(kept > 0.97, "{turn}: {kept}");
        }
        for (x, y) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 1e-3), (-1.0, -1e-3), (0.3, -2.0)] {
            assert!((argument([x, y]) - f64::atan2(y, x)).abs() < 1e-14);
        }
    }
}
