//! Which strands of a file can be used, and why the others cannot: reconstructions contain strands without points, numbers that are
//! not finite, strands without length, the same strand twice, and strands that begin at the tip.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::drawn::{DrawnCurve, in_metres};
use crate::contact::shape::Mesh;
use crate::error::{Result, check_not_negative, check_positive};
use crate::groom::render_hair::resampled;
use crate::math::point_tree::PointTree;

/// Points at equal arclengths at which strands are compared.
const STATIONS: usize = 9;
/// Which of the nearest other roots is looked at: a few strands that begin at their tips have few others beside them.
const NEIGHBOUR: usize = 3;
/// A strand begins at its tip if its last point is so many times nearer to the roots of others than its first one.
const NEARER: f64 = 4.0;
/// A strand that begins nearer to the scalp than this, m, begins at its root; and farther ones are not looked for than this.
const OFF: f64 = 2e-3;
const FAR: f64 = 0.5;
/// Fewer strands than this do not tell where roots are.
const LEAST: usize = 12;

/// Why a strand cannot be used.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Unusable {
    /// It has fewer than two points.
    TooFewPoints {
        /// How many.
        points: usize,
    },
    /// It has numbers that are not finite.
    NotFinite {
        /// How many points have.
        points: usize,
    },
    /// It is no longer than permitted.
    TooShort {
        /// Its length, m.
        length: f64,
    },
    /// It is another strand again, to the bit.
    Duplicate {
        /// Index of the other in the file.
        of: usize,
    },
    /// It is nowhere farther from another strand than permitted.
    NearDuplicate {
        /// Index of the other in the file.
        of: usize,
        /// The largest distance at equal arclengths, m.
        distance: f64,
    },
}

/// Strands left out, with their indices in the file, and why.
pub type LeftOut = Vec<(usize, Unusable)>;

/// The curves of strands that have at least two points, only finite numbers, and a length above `least_length` (m); and the others.
/// `metres_per_unit` is the unit of the strands.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a unit that is not above zero or a length below zero.
pub fn usable_curves<'a>(
    strands: impl Iterator<Item = &'a [[f32; 3]]>,
    metres_per_unit: f64,
    least_length: f64,
) -> Result<(Vec<DrawnCurve>, LeftOut)> {
    check_positive(|| "metres_per_unit".into(), metres_per_unit)?;
    check_not_negative(|| "least_length".into(), least_length)?;
    let (mut curves, mut left_out) = (Vec::new(), LeftOut::new());
    for (index, strand) in strands.enumerate() {
        let broken = strand.iter().filter(|point| !point.iter().all(|number| number.is_finite())).count();
        if broken > 0 {
            left_out.push((index, Unusable::NotFinite { points: broken }));
        } else if strand.len() < 2 {
            left_out.push((index, Unusable::TooFewPoints { points: strand.len() }));
        } else {
            let points = in_metres(strand, metres_per_unit);
            let length = length_of(&points);
            if length > least_length {
                curves.push(DrawnCurve { index, points, arclengths: None });
            } else {
                left_out.push((index, Unusable::TooShort { length }));
            }
        }
    }
    Ok((curves, left_out))
}

/// Turns curves around that begin at the tip, and returns their indices in the file. Most curves must begin at the root; of fewer than
/// twelve none is turned. A curve is turned if it ends among the roots of others, four times nearer to them than it begins, and
/// begins farther from them than nine tenths of the curves; or, with a scalp (in the curves' axes), if its end is four times nearer to
/// it than its beginning, that is farther from it than nine tenths of the curves' and than 2 mm, and farther from the roots of others as
/// well.
pub fn turn_around(curves: &mut [DrawnCurve], scalp: Option<&Mesh>) -> Vec<usize> {
    if curves.len() < LEAST {
        return Vec::new();
    }
    let roots: Vec<Vector3<f64>> = curves.iter().map(|curve| curve.points[0]).collect();
    let (tree, mut found) = (PointTree::new(&roots), Vec::new());
    let mut near = |place: Vector3<f64>, own: usize| {
        tree.nearest(place, NEIGHBOUR + 1, &mut found);
        let others = found.iter().filter(|(_, root)| *root as usize != own);
        others.map(|(squared, _)| squared.sqrt()).take(NEIGHBOUR).last().unwrap_or(f64::INFINITY)
    };
    let off = |place: Vector3<f64>| {
        scalp.map(|scalp| scalp.closest(place, FAR).map_or(f64::INFINITY, |surface| (surface.point - place).norm()))
    };
    let first: Vec<f64> = curves.iter().enumerate().map(|(own, curve)| near(curve.points[0], own)).collect();
    let usual = nine_tenths(first.clone());
    let first_off: Option<Vec<f64>> = roots.iter().map(|root| off(*root)).collect();
    let usual_off = first_off.clone().map(nine_tenths);
    let mut turned = Vec::new();
    for (own, curve) in curves.iter_mut().enumerate() {
        let end = curve.points[curve.points.len() - 1];
        let last = near(end, own);
        let by_roots = first[own] >= usual && NEARER * last < first[own];
        let by_scalp = match (&first_off, usual_off, off(end)) {
            (Some(first_off), Some(usual), Some(last_off)) => {
                let begins = first_off[own];
                begins >= usual.max(OFF) && NEARER * last_off < begins && last < first[own]
            }
            _ => false,
        };
        if by_roots || by_scalp {
            curve.points.reverse();
            turned.push(curve.index);
        }
    }
    turned
}

/// The value that nine tenths of some do not exceed.
fn nine_tenths(mut values: Vec<f64>) -> f64 {
    let place = values.len() * 9 / 10;
    *values.select_nth_unstable_by(place, f64::total_cmp).1
}

/// Removes curves that are others again: to the bit, or nowhere farther from one than `near` (m; 0: to the bit only) at equal
/// arclengths. The first of them stays.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a distance below zero.
pub fn remove_duplicates(curves: &mut Vec<DrawnCurve>, near: f64) -> Result<LeftOut> {
    check_not_negative(|| "near".into(), near)?;
    let bits = |curve: &DrawnCurve| -> Vec<u64> { curve.points.iter().flatten().map(|number| number.to_bits()).collect() };
    let (mut seen, mut left_out) = (HashMap::new(), LeftOut::new());
    curves.retain(|curve| {
        let first = *seen.entry(bits(curve)).or_insert(curve.index);
        if first != curve.index {
            left_out.push((curve.index, Unusable::Duplicate { of: first }));
        }
        first == curve.index
    });
    drop(seen);
    if near == 0.0 {
        return Ok(left_out);
    }
    let stations: Vec<Vec<Vector3<f64>>> =
        curves.iter().map(|curve| at_stations(&curve.points, STATIONS)).collect::<Result<_>>()?;
    let tree = PointTree::new(&curves.iter().map(|curve| curve.points[0]).collect::<Vec<_>>());
    let mut twin: Vec<Option<(usize, f64)>> = vec![None; curves.len()];
    for own in 0..curves.len() {
        let mut found: Option<(usize, f64)> = None;
        tree.within(curves[own].points[0], near, |other, _| {
            let other = other as usize;
            if other >= own || twin[other].is_some() || found.is_some_and(|(best, _)| best < other) {
                return;
            }
            // Tips first: those differ most.
            let mut most = 0.0;
            for (a, b) in stations[own].iter().zip(&stations[other]).rev() {
                most = f64::max(most, (a - b).norm());
                if most > near {
                    return;
                }
            }
            found = Some((other, most));
        });
        twin[own] = found;
    }
    let indices: Vec<usize> = curves.iter().map(|curve| curve.index).collect();
    let mut next = twin.iter();
    curves.retain(|curve| match next.next().copied().flatten() {
        Some((other, distance)) => {
            left_out.push((curve.index, Unusable::NearDuplicate { of: indices[other], distance }));
            false
        }
        None => true,
    });
    Ok(left_out)
}

/// Points at equal arclengths along a polyline.
pub(super) fn at_stations(points: &[Vector3<f64>], count: usize) -> Result<Vec<Vector3<f64>>> {
    Ok(resampled(points, &[points.len() as u32], None, count)?.points)
}

/// The length of a polyline.
pub(super) fn length_of(points: &[Vector3<f64>]) -> f64 {
    points.windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strands of 8 cm on a patch of scalp, 4 mm apart, which lean to one side.
    fn patch() -> Vec<Vec<[f32; 3]>> {
        let strand = |k: usize| {
            let (x, y) = (0.004 * (k % 10) as f32, 0.004 * (k / 10) as f32);
            (0..20).map(|p| [x + 0.002 * p as f32, y, 0.0035 * p as f32]).collect()
        };
        (0..60).map(strand).collect()
    }

    fn curves(strands: &[Vec<[f32; 3]>]) -> (Vec<DrawnCurve>, LeftOut) {
        usable_curves(strands.iter().map(Vec::as_slice), 1.0, 1e-4).expect("a unit")
    }

    #[test]
    fn broken_strands_are_told() {
        let mut strands = patch();
        strands[3][7][1] = f32::NAN;
        strands[3][8][1] = f32::INFINITY;
        strands[5].truncate(1);
        strands[6].clear();
        strands[9] = vec![[0.1; 3]; 20];
        let (kept, left_out) = curves(&strands);
        assert_eq!((kept.len(), kept[3].index, kept[5].index), (56, 4, 8));
        let expected = [
            (3, Unusable::NotFinite { points: 2 }),
            (5, Unusable::TooFewPoints { points: 1 }),
            (6, Unusable::TooFewPoints { points: 0 }),
            (9, Unusable::TooShort { length: 0.0 }),
        ];
        assert_eq!(left_out, expected);
        assert!(usable_curves(strands.iter().map(Vec::as_slice), 0.0, 0.0).is_err());
    }

    #[test]
    fn strands_that_begin_at_the_tip_are_turned_and_no_others() {
        let mut strands = patch();
        for index in [12, 13, 40] {
            strands[index].reverse();
        }
        let (mut kept, _) = curves(&strands);
        assert_eq!(turn_around(&mut kept, None), [12, 13, 40]);
        assert_eq!(kept, curves(&patch()).0);
        assert!(turn_around(&mut kept, None).is_empty());
    }

    #[test]
    fn twins_are_removed_and_neighbours_stay() {
        let mut strands = patch();
        strands.push(strands[4].clone());
        let mut near = strands[11].clone();
        near.iter_mut().for_each(|point| point[1] += 5e-5);
        strands.push(near);
        let (mut kept, _) = curves(&strands);
        let left_out = remove_duplicates(&mut kept, 1e-4).expect("a distance");
        assert_eq!(kept.len(), 60);
        assert_eq!(left_out[0], (60, Unusable::Duplicate { of: 4 }));
        let (61, Unusable::NearDuplicate { of: 11, distance }) = left_out[1] else { panic!("{left_out:?}") };
        assert!((distance - 5e-5).abs() < 1e-8, "{distance}");
        let (mut kept, _) = curves(&strands);
        assert_eq!(remove_duplicates(&mut kept, 0.0).expect("a distance").len(), 1);
    }
}
