//! Strands mixed from their guides' positions, and blended into their wisps.

use crate::groom::render_hair::RenderHair;
use crate::groom::render_hair::guides::shape::{ALONG, N1, N2, PLACE, Shape};
use crate::groom::render_hair::map::strand::RenderStrand;
use crate::groom::render_hair::settings::MAX_GUIDES;

/// How many points go side by side.
pub(super) const STEP: usize = 8;
pub(super) type Lane = [f32; STEP];

#[inline(always)]
pub(super) fn lane(row: &[f32], at: usize) -> Lane {
    let mut out = [0.0; STEP];
    out.copy_from_slice(&row[at..at + STEP]);
    out
}

/// Root positions for one strand, relative to the origin.
pub(super) struct Roots {
    /// The strand's own.
    pub own: [f32; 3],
    /// Its first guide's.
    pub first: [f32; 3],
}

/// How far a strand has blended into its wisp at positions 0 to 1: S(s/end) of the most.
#[inline(always)]
pub(super) fn gathered(places: Lane, [most, inverse_end]: [f32; 2]) -> Lane {
    let mut out: Lane = [0.0; STEP];
    for k in 0..STEP {
        let x = (places[k] * inverse_end).min(1.0);
        out[k] = most * (x * x * (3.0 - 2.0 * x));
    }
    out
}

/// Writes a strand's points into rows of x, y and z, followed by a row of the target arclength of each. `bent`: the strand's
/// positions relative to its root from its curvatures, rows as well; without them they are mixed from the guides' positions.
#[inline(always)]
pub(super) fn mix(hair: &RenderHair, shape: &Shape, strand: &RenderStrand, roots: &Roots, bent: Option<&[f32]>, out: &mut [f32]) {
    // The number of guides as a constant unrolls the loop over them.
    match hair.settings.guides_per_strand {
        1 => mix_of::<1>(hair, shape, strand, roots, bent, out),
        2 => mix_of::<2>(hair, shape, strand, roots, bent, out),
        3 => mix_of::<3>(hair, shape, strand, roots, bent, out),
        _ => mix_of::<MAX_GUIDES>(hair, shape, strand, roots, bent, out),
    }
}

/// Rows of a strand's positions relative to its root, mixed from the guides' positions.
#[inline(always)]
pub(super) fn mixed_places(hair: &RenderHair, shape: &Shape, strand: &RenderStrand, out: &mut [f32]) {
    let (stride, size) = (hair.reference.stride, hair.reference.size());
    let out = &mut out[..3 * stride];
    for guide in 0..hair.settings.guides_per_strand {
        let weight = strand.weights[guide];
        let places = &shape.rows[strand.guides[guide] as usize * size + PLACE * stride..][..3 * stride];
        if guide == 0 {
            out.iter_mut().zip(places).for_each(|(out, place)| *out = weight * place);
        } else {
            out.iter_mut().zip(places).for_each(|(out, place)| *out += weight * place);
        }
    }
}

#[inline(always)]
fn mix_of<const GUIDES: usize>(
    hair: &RenderHair,
    shape: &Shape,
    strand: &RenderStrand,
    roots: &Roots,
    bent: Option<&[f32]>,
    out: &mut [f32],
) {
    let (stride, size) = (hair.reference.stride, hair.reference.size());
    let guides: [&[f32]; GUIDES] = std::array::from_fn(|k| &shape.rows[strand.guides[k] as usize * size..][..size]);
    let place = &hair.profiles.place[..stride];
    let wisp = &hair.profiles.wisp[..stride];
    let of = |which: u32| which as usize * 2 * stride..(which as usize + 1) * 2 * stride;
    let frizz = hair.profiles.frizz.get(of(strand.frizz));
    let clump = hair.profiles.clumps.get(of(strand.clump));
    let out = &mut out[..4 * stride];
    let mut at = 0;
    while at < stride {
        let (c, radius) = (gathered(lane(place, at), strand.gather), lane(wisp, at));
        let (mut a1, mut a2): (Lane, Lane) = ([0.0; STEP], [0.0; STEP]);
        for k in 0..STEP {
            a1[k] = strand.middle[0] + radius[k] * strand.offset[0];
            a2[k] = strand.middle[1] + radius[k] * strand.offset[1];
        }
        let stray = |curve: &[f32], [cosine, sine]: [f32; 2], a1: &mut Lane, a2: &mut Lane| {
            let (f1, f2) = (lane(&curve[..stride], at), lane(&curve[stride..], at));
            for k in 0..STEP {
                a1[k] += cosine * f1[k] - sine * f2[k];
                a2[k] += sine * f1[k] + cosine * f2[k];
            }
        };
        if let Some(clump) = clump {
            stray(clump, strand.clump_turn, &mut a1, &mut a2);
        }
        for k in 0..STEP {
            a1[k] *= c[k];
            a2[k] *= c[k];
        }
        if let Some(frizz) = frizz {
            stray(frizz, strand.frizz_turn, &mut a1, &mut a2);
        }
        for axis in 0..3 {
            let row = |guide: usize, row: usize| lane(&guides[guide][(row + axis) * stride..][..stride], at);
            let first = row(0, PLACE);
            let mut mixed: Lane = [0.0; STEP];
            match bent {
                Some(bent) => mixed = lane(&bent[axis * stride..][..stride], at),
                None => {
                    for k in 0..STEP {
                        mixed[k] = strand.weights[0] * first[k];
                    }
                    for guide in 1..GUIDES {
                        let place = row(guide, PLACE);
                        for k in 0..STEP {
                            mixed[k] += strand.weights[guide] * place[k];
                        }
                    }
                }
            }
            let (n1, n2) = (row(0, N1), row(0, N2));
            let mut place: Lane = [0.0; STEP];
            for k in 0..STEP {
                let (interpolated, wisp) = (roots.own[axis] + mixed[k], roots.first[axis] + first[k]);
                // Not interpolated + c (wisp - interpolated): c = 1 must give the wisp itself, to the bit.
                place[k] = ((1.0 - c[k]) * interpolated + c[k] * wisp) + (n1[k] * a1[k] + n2[k] * a2[k]);
            }
            out[axis * stride + at..axis * stride + at + STEP].copy_from_slice(&place);
        }
        let along = |guide: usize| lane(&guides[guide][ALONG * stride..][..stride], at);
        let first = along(0);
        let mut mixed: Lane = [0.0; STEP];
        for k in 0..STEP {
            mixed[k] = strand.weights[0] * first[k];
        }
        for guide in 1..GUIDES {
            let other = along(guide);
            for k in 0..STEP {
                mixed[k] += strand.weights[guide] * other[k];
            }
        }
        for k in 0..STEP {
            mixed[k] = (1.0 - c[k]) * mixed[k] + c[k] * first[k];
        }
        out[3 * stride + at..3 * stride + at + STEP].copy_from_slice(&mixed);
        at += STEP;
    }
}
