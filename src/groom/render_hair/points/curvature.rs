//! Strands mixed from their guides' lengths and bends: integrated from root to tip, sixteen strands side by side.

use super::position::{STEP, gathered, lane, mixed_places};
use crate::groom::render_hair::RenderHair;
use crate::groom::render_hair::guides::shape::{BEND, CURL, LENGTH, Shape};
use crate::groom::render_hair::map::strand::{RenderCurl, RenderStrand};

/// How many strands go side by side.
pub(super) const WIDTH: usize = 16;
type Lanes = [f32; WIDTH];

/// Scratch memory for the bends and positions of [`WIDTH`] strands.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// Bends along n1 and n2, lengths, and blend into the wisp, of one strand: rows.
    rows: Vec<f32>,
    /// The same for all strands: point after point, three numbers each, every number for all strands.
    bends: Vec<[Lanes; 3]>,
    /// Positions during integration: point after point, three numbers each, every number for all strands.
    walked: Vec<[Lanes; 3]>,
    /// Positions of one strand relative to its root, mixed from its guides' positions: rows.
    mixed: Vec<f32>,
    /// Positions relative to the root: three rows per strand.
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

/// Sine and cosine, to 2e-7 for up to some hundreds of turns.
#[inline(always)]
fn sine_cosine(angle: f32) -> (f32, f32) {
    // Whole turns removed, 2π as the sum of two numbers; adding and subtracting 1.5·2²³ rounds.
    let turns = (angle * std::f32::consts::FRAC_1_PI * 0.5 + 12_582_912.0) - 12_582_912.0;
    let rest = (angle - turns * 6.281_25) - turns * 1.935_307_2e-3;
    let (sine, cosine) = turning(rest * rest);
    (rest * sine, 1.0 - rest * rest * cosine)
}

/// Computes the positions of up to [`WIDTH`] strands relative to their roots.
#[inline(always)]
pub(super) fn bend(hair: &RenderHair, shape: &Shape, strands: &[RenderStrand], curls: &[RenderCurl], room: &mut Room) {
    let reference = &hair.reference;
    let (stride, points) = (reference.stride, reference.points);
    room.rows.resize(4 * stride, 0.0);
    room.bends.resize(stride, [[0.0; WIDTH]; 3]);
    room.walked.resize(stride, [[0.0; WIDTH]; 3]);
    room.places.resize(3 * stride * WIDTH, 0.0);
    // Tangent, n1 and n2 on the current edge.
    let mut frames = [[[0.0_f32; WIDTH]; 3]; 3];
    for (lane, (strand, curl)) in strands.iter().zip(curls).enumerate() {
        start(shape, strand, curl, hair.settings.guides_per_strand, lane, &mut frames);
        mix_bends(hair, shape, strand, curl, &mut room.rows);
        for row in 0..3 {
            for (bends, value) in room.bends.iter_mut().zip(&room.rows[row * stride..][..stride]) {
                bends[row][lane] = *value;
            }
        }
    }
    let mut place = [[0.0_f32; WIDTH]; 3];
    for k in 1..points {
        let [b1, b2, lengths] = &room.bends[k - 1];
        if k > 1 {
            // The frame times I + s [ω]× + c [ω]×², ω = (0, b1, b2) in it.
            let (mut s, mut c, mut d) = ([0.0; WIDTH], [0.0; WIDTH], [0.0; WIDTH]);
            for lane in 0..WIDTH {
                let squared = b1[lane] * b1[lane] + b2[lane] * b2[lane];
                (s[lane], c[lane]) = turning(squared);
                d[lane] = c[lane] * squared;
            }
            for axis in 0..3 {
                let (t, m, n) = (frames[0][axis], frames[1][axis], frames[2][axis]);
                let (mut t_new, mut m_new, mut n_new) = (t, m, n);
                for lane in 0..WIDTH {
                    let w = b2[lane] * m[lane] - b1[lane] * n[lane];
                    let u = c[lane] * w + s[lane] * t[lane];
                    t_new[lane] = t[lane] + (s[lane] * w - d[lane] * t[lane]);
                    m_new[lane] = m[lane] - b2[lane] * u;
                    n_new[lane] = n[lane] + b1[lane] * u;
                }
                (frames[0][axis], frames[1][axis], frames[2][axis]) = (t_new, m_new, n_new);
            }
        }
        for axis in 0..3 {
            for lane in 0..WIDTH {
                place[axis][lane] += lengths[lane] * frames[0][axis][lane];
            }
        }
        room.walked[k] = place;
    }
    room.mixed.resize(3 * stride, 0.0);
    for (lane, strand) in strands.iter().enumerate() {
        mixed_places(hair, shape, strand, &mut room.mixed);
        for axis in 0..3 {
            let row = &mut room.places[(3 * lane + axis) * stride..][..stride];
            for (value, walked) in row.iter_mut().zip(&room.walked[..points]) {
                *value = walked[axis][lane];
            }
            hair.silhouette.bring(stride, row, &room.mixed[axis * stride..]);
        }
    }
}

/// The frame on a strand's first edge: the mean of its guides' as rotations.
#[inline(always)]
fn start(shape: &Shape, strand: &RenderStrand, curl: &RenderCurl, guides: usize, lane: usize, frames: &mut [[Lanes; 3]; 3]) {
    let (mut first, mut sum) = ([0.0, 0.0, 0.0, 1.0], [0.0; 4]);
    for k in 0..guides {
        let [x, y, z, w] = shape.starts[strand.guides[k] as usize];
        // The guide's frame, turned about its edge.
        let [cosine, sine] = curl.halves[k];
        let q = [w * sine + x * cosine, y * cosine + z * sine, z * cosine - y * sine, w * cosine - x * sine];
        if k == 0 {
            first = q;
        }
        // A rotation has two quaternions: take the one on the first guide's side.
        let side = q[0] * first[0] + q[1] * first[1] + q[2] * first[2] + q[3] * first[3];
        let weight = if side < 0.0 { -strand.weights[k] } else { strand.weights[k] };
        (0..4).for_each(|number| sum[number] += weight * q[number]);
    }
    let squared = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2] + sum[3] * sum[3];
    // All are on the first one's side, so the sum is at least its part; if that vanishes the first one counts.
    let factor = 1.0 / squared.sqrt();
    let [x, y, z, w] = if squared > 1e-6 { sum.map(|value| value * factor) } else { first };
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

/// A strand's bends and lengths, mixed from its guides'; to the extent that it blends into its wisp, those of its first guide.
#[inline(always)]
fn mix_bends(hair: &RenderHair, shape: &Shape, strand: &RenderStrand, curl: &RenderCurl, rows: &mut [f32]) {
    let reference = &hair.reference;
    let (stride, size) = (reference.stride, reference.size());
    let (b1, rest) = rows.split_at_mut(stride);
    let (b2, rest) = rest.split_at_mut(stride);
    let (lengths, fraction) = rest.split_at_mut(stride);
    for at in (0..stride).step_by(STEP) {
        fraction[at..at + STEP].copy_from_slice(&gathered(lane(&hair.profiles.place, at), strand.gather));
    }
    let gathered = &fraction[..stride];
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
