//! Strands mixed from their guides' lengths and bends: worked out from the root to the tip, sixteen strands side by side.

use super::RenderHair;
use super::quaternion::quaternion;
use super::settings::MOST_GUIDES;
use super::shape::{BEND, CURL, LENGTH, N1, PLACE, Reference, Shape};
use super::strand::{RenderCurl, RenderStrand};
use crate::math::trigonometry::sine_cosine;

/// Strands that go side by side.
pub(super) const WIDTH: usize = 16;
type Lanes = [f32; WIDTH];

/// Room for the bends and places of [`WIDTH`] strands.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// Bends along n1 and n2, and lengths, of one strand: rows.
    rows: Vec<f32>,
    /// The same of all: a point after the other, its three numbers, each for all strands.
    bends: Vec<[Lanes; 3]>,
    /// Places from the root: three rows a strand.
    pub places: Vec<f32>,
}

/// sin x / x and (1 − cos x)/x² for x² up to π² = 9.87: Taylor's series, good to 4e-7.
#[inline(always)]
fn turning(squared: f32) -> (f32, f32) {
    const SINE: [f32; 9] = [
        1.0,
        -1.0 / 6.0,
        1.0 / 120.0,
        -1.0 / 5040.0,
        1.0 / 362_880.0,
        -1.0 / 39_916_800.0,
        1.605_904_4e-10,
        -7.647_164e-13,
        2.811_457_3e-15,
    ];
    const COSINE: [f32; 9] = [
        0.5,
        -1.0 / 24.0,
        1.0 / 720.0,
        -1.0 / 40_320.0,
        1.0 / 3_628_800.0,
        -1.0 / 479_001_600.0,
        1.147_074_6e-11,
        -4.779_477_3e-14,
        1.561_920_7e-16,
    ];
    let (mut sine, mut cosine) = (SINE[8], COSINE[8]);
    for k in (0..8).rev() {
        sine = sine * squared + SINE[k];
        cosine = cosine * squared + COSINE[k];
    }
    (sine, cosine)
}

/// The direction of a guide's first edge: of its first point that is not the root's.
#[inline(always)]
fn first_way(reference: &Reference, rows: &[f32]) -> [f32; 3] {
    let stride = reference.stride;
    let at = |k: usize| [0, 1, 2].map(|axis| rows[(PLACE + axis) * stride + k]);
    let mut k = 1;
    while k + 1 < reference.points && at(k) == [0.0; 3] {
        k += 1;
    }
    unit(at(k))
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn unit(a: [f32; 3]) -> [f32; 3] {
    let squared = dot(a, a);
    // What has no direction gets none: its strand has no length either.
    let factor = if squared > 0.0 { 1.0 / squared.sqrt() } else { 0.0 };
    a.map(|value| value * factor)
}

/// Works out the places of up to [`WIDTH`] strands from their roots.
#[inline(always)]
pub(super) fn bend(hair: &RenderHair, shape: &Shape, strands: &[RenderStrand], curls: &[RenderCurl], room: &mut Room) {
    let reference = &hair.reference;
    let (stride, points) = (reference.stride, reference.points);
    room.rows.resize(3 * stride, 0.0);
    room.bends.resize(stride, [[0.0; WIDTH]; 3]);
    room.places.resize(3 * stride * WIDTH, 0.0);
    // Tangent, n1 and n2 on the edge at hand.
    let mut frames = [[[0.0_f32; WIDTH]; 3]; 3];
    for (lane, (strand, curl)) in strands.iter().zip(curls).enumerate() {
        start(reference, shape, strand, curl, lane, &mut frames);
        mix_bends(hair, shape, strand, curl, &mut room.rows);
        for k in 0..points {
            for row in 0..3 {
                room.bends[k][row][lane] = room.rows[row * stride + k];
            }
        }
    }
    let mut place = [[0.0_f32; WIDTH]; 3];
    for k in 1..points {
        if k > 1 {
            let [b1, b2, _] = &room.bends[k - 1];
            for lane in 0..WIDTH {
                let (b1, b2) = (b1[lane], b2[lane]);
                let (s, c) = turning(b1 * b1 + b2 * b2);
                for axis in 0..3 {
                    let (t, m, n) = (frames[0][axis][lane], frames[1][axis][lane], frames[2][axis][lane]);
                    frames[0][axis][lane] = t + (s * (b2 * m - b1 * n) - c * (b1 * b1 + b2 * b2) * t);
                    frames[1][axis][lane] = m + (c * b2 * (b1 * n - b2 * m) - s * b2 * t);
                    frames[2][axis][lane] = n + (c * b1 * (b2 * m - b1 * n) + s * b1 * t);
                }
            }
        }
        let lengths = &room.bends[k - 1][2];
        for axis in 0..3 {
            for lane in 0..WIDTH {
                place[axis][lane] += lengths[lane] * frames[0][axis][lane];
            }
            for lane in 0..strands.len() {
                room.places[(3 * lane + axis) * stride + k] = place[axis][lane];
            }
        }
    }
}

/// The frame on a strand's first edge: the mean of its guides' as rotations.
#[inline(always)]
fn start(
    reference: &Reference,
    shape: &Shape,
    strand: &RenderStrand,
    curl: &RenderCurl,
    lane: usize,
    frames: &mut [[Lanes; 3]; 3],
) {
    let (mut first, mut sum) = ([0.0, 0.0, 0.0, 1.0], [0.0; 4]);
    for k in 0..MOST_GUIDES {
        let weight = strand.weights[k];
        if weight == 0.0 && k > 0 {
            continue;
        }
        let rows = &shape.rows[strand.guides[k] as usize * reference.size()..][..reference.size()];
        let way = first_way(reference, rows);
        let n1 = [0, 1, 2].map(|axis| rows[(N1 + axis) * reference.stride]);
        let n2 = cross(way, n1);
        let [cosine, sine] = curl.turns[k];
        let across = [0, 1, 2].map(|axis| cosine * n1[axis] + sine * n2[axis]);
        let q = quaternion(way, across, cross(way, across));
        if k == 0 {
            first = q;
        }
        // A rotation is two quaternions: the one on the first guide's side.
        let side = q[0] * first[0] + q[1] * first[1] + q[2] * first[2] + q[3] * first[3];
        let weight = if side < 0.0 { -weight } else { weight };
        (0..4).for_each(|number| sum[number] += weight * q[number]);
    }
    let squared = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2] + sum[3] * sum[3];
    // All are on the first's side, so the sum is at least its share; with nothing of it left the first counts.
    let [x, y, z, w] = if squared > 1e-6 { sum.map(|value| value / squared.sqrt()) } else { first };
    let columns = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    ];
    for column in 0..3 {
        for axis in 0..3 {
            frames[column][axis][lane] = columns[column][axis];
        }
    }
}

/// A strand's bends and lengths, mixed from its guides'; as far as it has gone over to its wisp they are those of its first guide.
#[inline(always)]
fn mix_bends(hair: &RenderHair, shape: &Shape, strand: &RenderStrand, curl: &RenderCurl, rows: &mut [f32]) {
    let reference = &hair.reference;
    let (stride, size) = (reference.stride, reference.size());
    let first = strand.guides[0] as usize;
    let gathered = &hair.gathered[first * stride..][..stride];
    let (b1, rest) = rows.split_at_mut(stride);
    let (b2, lengths) = rest.split_at_mut(stride);
    b1.fill(0.0);
    b2.fill(0.0);
    lengths.fill(0.0);
    let row = if curl.curled { CURL } else { BEND };
    for guide in 0..hair.settings.guides_per_strand {
        let (weight, [cosine, sine]) = (strand.weights[guide], curl.turns[guide]);
        let own = if guide == 0 { 1.0 } else { 0.0 };
        let rows = &shape.rows[strand.guides[guide] as usize * size..][..size];
        let (g1, g2) = (&rows[row * stride..][..stride], &rows[(row + 1) * stride..][..stride]);
        let length = &rows[LENGTH * stride..][..stride];
        for k in 0..stride {
            let w = weight * (1.0 - gathered[k]) + own * gathered[k];
            b1[k] += w * (cosine * g1[k] + sine * g2[k]);
            b2[k] += w * (cosine * g2[k] - sine * g1[k]);
            lengths[k] += w * length[k];
        }
    }
    if curl.curled {
        let phases = |guide: usize| &reference.phases[strand.guides[guide] as usize * stride..][..stride];
        for k in 0..stride {
            let mut phase = gathered[k] * phases(0)[k];
            for guide in 0..hair.settings.guides_per_strand {
                phase += strand.weights[guide] * (1.0 - gathered[k]) * phases(guide)[k];
            }
            let (sine, cosine) = sine_cosine(phase);
            (b1[k], b2[k]) = (cosine * b1[k] - sine * b2[k], sine * b1[k] + cosine * b2[k]);
        }
    }
}
