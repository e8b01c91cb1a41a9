//! Aligns the bends of guides before they are mixed.

use nalgebra::Vector3;

use super::phase::{argument, phasor};
use super::shape::{BEND, CURL, N1, N2, PLACE, Reference, Shape, carried};
use crate::groom::render_hair::map::strand::RenderCurl;
use crate::groom::render_hair::map::weights::Followed;
use crate::groom::render_hair::settings::MAX_GUIDES;

/// How much more bend must remain with the phases removed for that to be worth while.
const WORTH_WHILE: f64 = 1.1;

/// A guide's first edge and the frame's n1 on it.
fn first_edge(reference: &Reference, shape: &Shape, guide: u32) -> (Vector3<f64>, Vector3<f64>) {
    let rows = &shape.rows[guide as usize * reference.size()..][..reference.size()];
    let at = |row: usize, k: usize| Vector3::from([0, 1, 2].map(|axis| f64::from(rows[(row + axis) * reference.stride + k])));
    let n1 = at(N1, 0);
    // Coincident points: any direction is as good across n1.
    let ahead =
        (1..reference.points).map(|k| at(PLACE, k)).find(|place| place.norm() > 0.0).unwrap_or_else(|| n1.cross(&at(N2, 0)));
    (ahead.normalize(), n1)
}

/// The bends of a guide (of row `first` and the next) as complex numbers.
fn bend(reference: &Reference, shape: &Shape, guide: u32, first: usize, k: usize) -> [f64; 2] {
    let rows = &shape.rows[guide as usize * reference.size()..];
    [f64::from(rows[first * reference.stride + k]), f64::from(rows[(first + 1) * reference.stride + k])]
}

/// How the bends of a strand's guides are mixed: either unchanged, in frames aligned with the first guide's at the root; or with
/// the curls' phases removed, in frames whose n1 points along the curl's bend, so that the root of a strand between two curls is
/// on the curl between them. Takes whichever preserves more bend.
pub(in crate::groom::render_hair) fn align(reference: &Reference, shape: &Shape, followed: &Followed) -> RenderCurl {
    let mut plain = [0.0; MAX_GUIDES];
    let mut curled = [0.0; MAX_GUIDES];
    let (first_direction, first_n1) = first_edge(reference, shape, followed.guides[0]);
    for k in 0..followed.count {
        let guide = followed.guides[k];
        let (direction, n1) = first_edge(reference, shape, guide);
        let like = carried(first_n1, first_direction, direction);
        plain[k] = argument([like.dot(&n1), like.dot(&direction.cross(&n1))]);
        let sum = (0..reference.points).fold([0.0; 2], |sum, j| {
            let value = bend(reference, shape, guide, CURL, j);
            [sum[0] + value[0], sum[1] + value[1]]
        });
        curled[k] = argument(sum);
    }
    let left = |angles: &[f64; MAX_GUIDES], row: usize| -> f64 {
        let turns = angles.map(phasor);
        (0..reference.points)
            .map(|j| {
                let mut sum = [0.0; 2];
                for k in 0..followed.count {
                    let (b, t, w) = (bend(reference, shape, followed.guides[k], row, j), turns[k], followed.weights[k]);
                    sum[0] += w * (t[0] * b[0] + t[1] * b[1]);
                    sum[1] += w * (t[0] * b[1] - t[1] * b[0]);
                }
                (sum[0] * sum[0] + sum[1] * sum[1]).sqrt()
            })
            .sum()
    };
    let in_step = left(&curled, CURL) > WORTH_WHILE * left(&plain, BEND);
    let angles = if in_step { curled } else { plain };
    let phasors = |fraction: f64| angles.map(|angle| phasor(fraction * angle).map(|value| value as f32));
    RenderCurl { turns: phasors(1.0), halves: phasors(0.5), curled: in_step }
}
