//! Material frames along a strand, from its points.

use super::quaternion::quaternion;

/// How many points go side by side.
const STEP: usize = 8;
/// Squared sine of the angle between a strand and its guide's n1 below which another transverse direction is used.
const ALONG: f32 = 1e-8;

#[inline(always)]
fn pick(yes: bool, a: f32, b: f32) -> f32 {
    if yes { a } else { b }
}

/// Rows of x, y, z and w of the frames: n0 by differences of the points (rows of x, y, z), n1 as close as possible to that of the
/// guide (rows of x, y, z in `guide_n1`). `room` is scratch memory.
#[inline(always)]
pub(super) fn frames(stride: usize, points: usize, guide_n1: &[f32], places: &[f32], room: &mut Vec<f32>, out: &mut [f32]) {
    // Differences, and how far n1 is from the strand's direction.
    room.resize(4 * stride, 0.0);
    for axis in 0..3 {
        let (place, ahead) = (&places[axis * stride..][..points], &mut room[axis * stride..][..points]);
        for k in 1..points - 1 {
            ahead[k] = place[k + 1] - place[k - 1];
        }
        ahead[0] = place[1] - place[0];
        ahead[points - 1] = place[points - 1] - place[points - 2];
    }
    let mut at = 0;
    while at < stride {
        let row = |list: &[f32], row: usize| {
            let mut out = [0.0; STEP];
            out.copy_from_slice(&list[row * stride + at..][..STEP]);
            out
        };
        let ahead = [0, 1, 2].map(|axis| row(room, axis));
        let n1 = [0, 1, 2].map(|axis| row(guide_n1, axis));
        let (mut q, mut across) = ([[0.0; STEP]; 4], [0.0; STEP]);
        for k in 0..STEP {
            let [x, y, z] = [ahead[0][k], ahead[1][k], ahead[2][k]];
            let factor = 1.0 / (x * x + y * y + z * z).sqrt();
            let a = [x * factor, y * factor, z * factor];
            let n = [n1[0][k], n1[1][k], n1[2][k]];
            let along = n[0] * a[0] + n[1] * a[1] + n[2] * a[2];
            let m = [n[0] - along * a[0], n[1] - along * a[1], n[2] - along * a[2]];
            across[k] = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
            let factor = 1.0 / across[k].sqrt();
            let b = [m[0] * factor, m[1] * factor, m[2] * factor];
            let c = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
            // As in `quaternion`, in a form that compilers vectorise.
            let s = [1.0 + a[0] - b[1] - c[2], 1.0 - a[0] + b[1] - c[2], 1.0 - a[0] - b[1] + c[2], 1.0 + a[0] + b[1] + c[2]];
            let (xy, xz, yz) = (a[1] + b[0], a[2] + c[0], b[2] + c[1]);
            let (wx, wy, wz) = (b[2] - c[1], c[0] - a[2], a[1] - b[0]);
            let (mut best, mut v) = (s[3], [wx, wy, wz, s[3]]);
            for (value, other) in [(s[0], [s[0], xy, xz, wx]), (s[1], [xy, s[1], yz, wy]), (s[2], [xz, yz, s[2], wz])] {
                let more = value > best;
                best = pick(more, value, best);
                for number in 0..4 {
                    v[number] = pick(more, other[number], v[number]);
                }
            }
            let factor = 0.5 / best.sqrt();
            for number in 0..4 {
                q[number][k] = v[number] * factor;
            }
        }
        for number in 0..4 {
            out[number * stride + at..][..STEP].copy_from_slice(&q[number]);
        }
        room[3 * stride + at..][..STEP].copy_from_slice(&across);
        at += STEP;
    }
    for k in 0..points {
        // Coincident points have no direction: the result there is NaN.
        let across = room[3 * stride + k];
        if across.is_nan() || across < ALONG {
            let ahead = [0, 1, 2].map(|axis| room[axis * stride + k]);
            let n1 = [0, 1, 2].map(|axis| guide_n1[axis * stride + k]);
            for (number, value) in degenerate(ahead, n1).into_iter().enumerate() {
                out[number * stride + k] = value;
            }
        }
    }
}

/// The frame where the strand runs along the guide's n1, or has no direction.
#[cold]
fn degenerate(ahead: [f32; 3], n1: [f32; 3]) -> [f32; 4] {
    let unit = |v: [f32; 3]| {
        let size = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        v.map(|value| value / size)
    };
    let beside = |v: [f32; 3]| unit(if v[0].abs() < 0.7 { [0.0, v[2], -v[1]] } else { [-v[2], 0.0, v[0]] });
    let (a, b) = if ahead == [0.0; 3] { (beside(n1), n1) } else { (unit(ahead), beside(unit(ahead))) };
    quaternion(a, b, [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
}
