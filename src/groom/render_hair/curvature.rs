//! Strands mixed from their guides' lengths and bends: worked out from the root to the tip, sixteen strands side by side.

use super::RenderHair;
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

/// The frame on a strand's first edge.
#[inline(always)]
fn start(
    reference: &Reference,
    shape: &Shape,
    strand: &RenderStrand,
    curl: &RenderCurl,
    lane: usize,
    frames: &mut [[Lanes; 3]; 3],
) {
    let (mut tangent, mut n1) = ([0.0; 3], [0.0; 3]);
    let mut own = ([0.0; 3], [0.0; 3]);
    for k in 0..MOST_GUIDES {
        let weight = strand.weights[k];
        if weight == 0.0 && k > 0 {
            continue;
        }
        let rows = &shape.rows[strand.guides[k] as usize * reference.size()..][..reference.size()];
        let way = first_way(reference, rows);
        let across = [0, 1, 2].map(|axis| rows[(N1 + axis) * reference.stride]);
        let beside = cross(way, across);
        let [cosine, sine] = curl.turns[k];
        let turned = [0, 1, 2].map(|axis| cosine * across[axis] + sine * beside[axis]);
        if k == 0 {
            own = (way, turned);
        }
        for axis in 0..3 {
            tangent[axis] += weight * way[axis];
            n1[axis] += weight * turned[axis];
        }
    }
    // Guides that leave in opposite directions have no mean: then the first's counts.
    let mut along = unit(tangent);
    if dot(tangent, tangent) < 1e-6 {
        (along, n1) = own;
    }
    let part = dot(n1, along);
    let mut across = [0, 1, 2].map(|axis| n1[axis] - part * along[axis]);
    if dot(across, across) < 1e-6 {
        let part = dot(own.1, along);
        across = [0, 1, 2].map(|axis| own.1[axis] - part * along[axis]);
    }
    if dot(across, across) < 1e-6 {
        across = cross(along, own.0);
    }
    let across = unit(across);
    let beside = cross(along, across);
    for axis in 0..3 {
        frames[0][axis][lane] = along[axis];
        frames[1][axis][lane] = across[axis];
        frames[2][axis][lane] = beside[axis];
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
        let (weight, [p, q]) = (strand.weights[guide], curl.phasors[guide]);
        let own = if guide == 0 { 1.0 } else { 0.0 };
        let rows = &shape.rows[strand.guides[guide] as usize * size..][..size];
        let (g1, g2) = (&rows[row * stride..][..stride], &rows[(row + 1) * stride..][..stride]);
        let length = &rows[LENGTH * stride..][..stride];
        for k in 0..stride {
            let w = weight * (1.0 - gathered[k]) + own * gathered[k];
            b1[k] += w * (p * g1[k] - q * g2[k]);
            b2[k] += w * (p * g2[k] + q * g1[k]);
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
