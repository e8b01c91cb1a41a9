//! Moves curves apart that run through each other: guides that each stand for a wisp as thick as a pencil lead.

use nalgebra::Vector3;

use crate::error::{Result, check_positive};
use crate::math::point_tree::PointTree;

/// How steeply curves part whose roots are too near: distance gained per arclength of both.
const SLOPE: f64 = 0.5;
/// Curves this much too near are far enough, of their diameter.
const CLOSE: f64 = 0.02;
/// Most rounds of moving points and restoring the lengths of edges.
const ROUNDS: usize = 40;

/// What was done.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MovedApart {
    /// Pairs of curves that were too near each other.
    pub pairs: usize,
    /// Pairs that still are.
    pub pairs_left: usize,
    /// How much nearer than permitted, m: before and after.
    pub deepest: f64,
    /// See `deepest`.
    pub deepest_left: f64,
    /// The largest displacement of a point, m.
    pub moved: f64,
}

/// An edge that is too near to one of another curve.
struct Overlap {
    curves: [usize; 2],
    /// First points of the edges.
    points: [usize; 2],
    /// How far along the edges, 0 to 1.
    along: [f64; 2],
    /// From the second to the first.
    direction: Vector3<f64>,
    by: f64,
}

/// Moves curves (m, root first) apart until their centrelines are `2 radius` (m) from each other, or as far as the bounded number of
/// rounds gets. Roots stay; where they are nearer than that, curves part at one in two. Edges keep their lengths. `settle` is called on each
/// curve that was moved in a round, to keep it out of a head.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a radius that is not above zero, and errors of `settle`.
pub fn move_apart(
    curves: &mut [Vec<Vector3<f64>>],
    radius: f64,
    mut settle: impl FnMut(usize, &mut Vec<Vector3<f64>>) -> Result<()>,
) -> Result<MovedApart> {
    check_positive(|| "radius".into(), radius)?;
    let drawn: Vec<Vec<Vector3<f64>>> = curves.to_vec();
    let lengths: Vec<Vec<f64>> =
        drawn.iter().map(|curve| curve.windows(2).map(|edge| (edge[1] - edge[0]).norm()).collect()).collect();
    let mut report = MovedApart::default();
    for round in 0..=ROUNDS {
        let overlaps = overlaps(curves, 2.0 * radius);
        let mut pairs: Vec<[usize; 2]> = overlaps.iter().map(|overlap| overlap.curves).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let deepest = overlaps.iter().map(|overlap| overlap.by).fold(0.0, f64::max);
        if round == 0 {
            (report.pairs, report.deepest) = (pairs.len(), deepest);
        }
        (report.pairs_left, report.deepest_left) = (pairs.len(), deepest);
        if pairs.is_empty() || round == ROUNDS {
            break;
        }
        part(curves, &overlaps);
        let mut touched: Vec<usize> = pairs.into_iter().flatten().collect();
        touched.sort_unstable();
        touched.dedup();
        for index in touched {
            follow(&mut curves[index], &lengths[index], &drawn[index]);
            settle(index, &mut curves[index])?;
        }
    }
    for (now, before) in curves.iter().flatten().zip(drawn.iter().flatten()) {
        report.moved = report.moved.max((now - before).norm());
    }
    Ok(report)
}

/// All edges that are too near.
fn overlaps(curves: &[Vec<Vector3<f64>>], diameter: f64) -> Vec<Overlap> {
    let (mut edges, mut middles, mut longest) = (Vec::new(), Vec::new(), 0.0_f64);
    for (index, curve) in curves.iter().enumerate() {
        let mut along = 0.0;
        for (point, edge) in curve.windows(2).enumerate() {
            let length = (edge[1] - edge[0]).norm();
            edges.push((index, point, along));
            middles.push(edge[0].lerp(&edge[1], 0.5));
            longest = longest.max(length);
            along += length;
        }
    }
    let (tree, mut found) = (PointTree::new(&middles), Vec::new());
    for (own, (index, point, along)) in edges.iter().enumerate() {
        tree.within(middles[own], diameter + longest, |other, _| {
            let (other_index, other_point, other_along) = edges[other as usize];
            if other_index <= *index {
                return;
            }
            let edge = |index: usize, point: usize| [curves[index][point], curves[index][point + 1]];
            let (first, second) = (edge(*index, *point), edge(other_index, other_point));
            let (s, t) = nearest(&first, &second);
            let between = first[0].lerp(&first[1], s) - second[0].lerp(&second[1], t);
            let roots = (curves[*index][0] - curves[other_index][0]).norm();
            let [reached, other_reached] =
                [along + s * (first[1] - first[0]).norm(), other_along + t * (second[1] - second[0]).norm()];
            let wanted = diameter.min(roots + SLOPE * (reached + other_reached));
            let by = wanted - between.norm();
            if by > CLOSE * diameter {
                // Curves that cross part across both.
                let across = (first[1] - first[0]).cross(&(second[1] - second[0]));
                let direction = between.try_normalize(1e-9).or_else(|| across.try_normalize(0.0)).unwrap_or_else(Vector3::x);
                found.push(Overlap {
                    curves: [*index, other_index],
                    points: [*point, other_point],
                    along: [s, t],
                    direction,
                    by,
                });
            }
        });
    }
    found
}

/// Moves points of the overlaps apart, by the mean of what their overlaps ask for.
fn part(curves: &mut [Vec<Vector3<f64>>], overlaps: &[Overlap]) {
    let mut asked: Vec<Vec<(Vector3<f64>, f64)>> =
        curves.iter().map(|curve| vec![(Vector3::zeros(), 0.0); curve.len()]).collect();
    for Overlap { curves, points, along, direction, by } in overlaps {
        for side in 0..2 {
            let way = direction * (0.5 * by * if side == 0 { 1.0 } else { -1.0 });
            for (point, weight) in [(points[side], 1.0 - along[side]), (points[side] + 1, along[side])] {
                let (sum, weights) = &mut asked[curves[side]][point];
                *sum += way * weight;
                *weights += weight;
            }
        }
    }
    for (curve, asked) in curves.iter_mut().zip(asked) {
        for (point, (sum, weights)) in curve.iter_mut().zip(asked).skip(1) {
            if weights > 0.0 {
                *point += sum / weights;
            }
        }
    }
}

/// Restores the lengths of edges, from the root on.
fn follow(points: &mut [Vector3<f64>], lengths: &[f64], drawn: &[Vector3<f64>]) {
    for k in 1..points.len() {
        let along = (points[k] - points[k - 1]).try_normalize(0.0).or_else(|| (drawn[k] - drawn[k - 1]).try_normalize(0.0));
        points[k] = points[k - 1] + along.unwrap_or_else(Vector3::zeros) * lengths[k - 1];
    }
}

/// Where two segments are nearest to each other, each as a fraction of its length (Ericson 2005, section 5.1.9).
fn nearest(first: &[Vector3<f64>; 2], second: &[Vector3<f64>; 2]) -> (f64, f64) {
    let (u, v, w) = (first[1] - first[0], second[1] - second[0], first[0] - second[0]);
    let (a, e, f, c, b) = (u.norm_squared(), v.norm_squared(), v.dot(&w), u.dot(&w), u.dot(&v));
    let clamp = |value: f64| if value.is_finite() { value.clamp(0.0, 1.0) } else { 0.0 };
    let denominator = a * e - b * b;
    let s = if denominator > 1e-12 * a * e { clamp((b * f - c * e) / denominator) } else { 0.0 };
    let t = (b * s + f) / e;
    if t < 0.0 {
        (clamp(-c / a), 0.0)
    } else if t > 1.0 {
        (clamp((b - c) / a), 1.0)
    } else {
        (s, clamp(t))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::groom::curves::usable::length_of;

    #[test]
    fn crossing_curves_part_and_keep_their_lengths() {
        let straight =
            |from: Vector3<f64>, way: Vector3<f64>| (0..21).map(|k| from + way * (f64::from(k) / 20.0)).collect::<Vec<_>>();
        // Two that cross half-way, one that runs beside the first at a third of the distance, and one that is clear.
        let mut curves = vec![
            straight(Vector3::zeros(), Vector3::new(0.1, 0.0, 0.0)),
            straight(Vector3::new(0.05, -0.05, 0.0002), Vector3::new(0.0, 0.1, 0.0)),
            straight(Vector3::new(0.0, 0.0, 0.0007), Vector3::new(0.1, 0.0, 0.0)),
            straight(Vector3::new(0.0, 0.0, 0.05), Vector3::new(0.1, 0.0, 0.0)),
        ];
        let drawn = curves.clone();
        let report = move_apart(&mut curves, 0.001, |_, _| Ok(())).expect("a radius");
        assert_eq!((report.pairs, report.pairs_left), (3, 0), "{report:?}");
        assert!(report.moved < 0.004 && (report.deepest - 0.0018).abs() < 1e-4, "{report:?}");
        assert_eq!(curves[3], drawn[3]);
        for (now, before) in curves.iter().zip(&drawn) {
            assert_eq!(now[0], before[0]);
            assert!((length_of(now) - length_of(before)).abs() < 1e-12);
        }
        // By another way of measuring: between densely sampled points.
        let dense = |curve: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            curve
                .windows(2)
                .flat_map(|edge| (0..10).map(|k| edge[0].lerp(&edge[1], 0.1 * f64::from(k))).collect::<Vec<_>>())
                .collect()
        };
        let distance = |a: usize, b: usize, from: usize| {
            let (a, b) = (dense(&curves[a]), dense(&curves[b]));
            a[from..].iter().flat_map(|p| b[from..].iter().map(move |q| (p - q).norm())).fold(f64::INFINITY, f64::min)
        };
        assert!(distance(0, 1, 0) > 0.00195 && distance(0, 2, 60) > 0.00195, "{} {}", distance(0, 1, 0), distance(0, 2, 60));
        assert!(move_apart(&mut curves, 0.0, |_, _| Ok(())).is_err());
    }
}
