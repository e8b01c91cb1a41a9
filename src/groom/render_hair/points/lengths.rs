//! Restores the lengths of render strands: moves points along their path to their target arclengths.

/// The most that a strand may continue straight beyond its path's end, as a factor: longer tails show. A shorter path is
/// stretched.
const LONGER: f32 = 1.1;
/// The largest stretch of a path: what guides on two sides of a parting leave of a strand between them would stand up from it.
const MAX_STRETCH: f32 = 1.3;

/// A point and its arclength on the path, m.
type Knot = [f32; 4];

/// Scratch memory.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// The points, with one more at each end.
    knots: Vec<Knot>,
    edges: Vec<f32>,
    /// The new position of each point on the path, in points from the root.
    pub places: Vec<f32>,
}

/// The target arclengths of points.
#[derive(Debug, Clone, Copy)]
pub(super) enum Wanted<'a> {
    /// These arclengths, times a fraction.
    Along(&'a [f32], f32),
    /// Their own arclengths, times a fraction.
    Fraction(f32),
}

/// Moves the points of rows of x, y and z (`stride` floats each, of which `points` count) along the Catmull–Rom spline through
/// them, and straight on beyond its end; the root stays to the bit. A path that is much too short is first stretched away from
/// the root.
#[inline(always)]
pub(super) fn respace(wanted: Wanted, stride: usize, points: usize, rows: &mut [f32], room: &mut Room) {
    let Room { knots, edges, places } = room;
    knots.resize(points + 2, [0.0; 4]);
    edges.resize(stride, 0.0);
    places.resize(stride, 0.0);
    let (x, rest) = rows.split_at_mut(stride);
    let (y, z) = rest.split_at_mut(stride);
    let (x, y, z) = (&mut x[..points], &mut y[..points], &mut z[..points]);
    {
        let [a, b, c] = [&x[..points - 1], &y[..points - 1], &z[..points - 1]];
        let [d, e, f] = [&x[1..], &y[1..], &z[1..]];
        let edges = &mut edges[..points - 1];
        for k in 0..points - 1 {
            let (u, v, w) = (d[k] - a[k], e[k] - b[k], f[k] - c[k]);
            edges[k] = (u * u + v * v + w * w).sqrt();
        }
    }
    let mut along = 0.0;
    for k in 0..points {
        knots[k + 1] = [x[k], y[k], z[k], along];
        along += edges[k];
    }
    let whole = knots[points][3];
    // One more at either end, on the parabola (for two points, the line) through the ends.
    let beyond = |a: Knot, b: Knot, c: Option<Knot>| -> Knot {
        std::array::from_fn(|axis| c.map_or(2.0 * a[axis] - b[axis], |c| 3.0 * (a[axis] - b[axis]) + c[axis]))
    };
    let third = points > 2;
    knots[0] = beyond(knots[1], knots[2], third.then(|| knots[3.min(points)]));
    knots[points + 1] = beyond(knots[points], knots[points - 1], third.then(|| knots[points - 2]));
    let end = if let Wanted::Along(along, fraction) = wanted { fraction * along[points - 1] } else { 0.0 };
    let stretch = (end / (LONGER * whole).max(f32::MIN_POSITIVE)).clamp(1.0, MAX_STRETCH);
    if stretch > 1.0 {
        let root = knots[1];
        for knot in knots.iter_mut() {
            (0..3).for_each(|axis| knot[axis] = root[axis] + stretch * (knot[axis] - root[axis]));
            knot[3] *= stretch;
        }
        edges[..points - 1].iter_mut().for_each(|edge| *edge *= stretch);
    }
    let whole = stretch * whole;
    let most = LONGER * whole;
    let less = if end > most { most / end } else { 1.0 };
    let mut at = 0;
    places[0] = 0.0;
    for k in 1..points {
        let target = match wanted {
            Wanted::Along(along, fraction) => less * (fraction * along[k]),
            Wanted::Fraction(fraction) => fraction * knots[k + 1][3],
        };
        while at + 2 < points && knots[at + 2][3] <= target {
            at += 1;
        }
        let (before, after) = (knots[at + 1][3], knots[at + 2][3]);
        let span = after - before;
        let u = if span > 0.0 { (target - before) / span } else { 0.0 };
        places[k] = at as f32 + u.min(1.0);
        let place: [f32; 3] = if target > whole {
            // Straight on, along the last edge that has a length.
            let last = (0..points - 1).rev().find(|edge| edges[*edge] > 0.0);
            let (end, more) = (knots[points], target - whole);
            match last {
                Some(edge) => {
                    std::array::from_fn(|axis| end[axis] + (knots[edge + 2][axis] - knots[edge + 1][axis]) * (more / edges[edge]))
                }
                None => [end[0], end[1], end[2]],
            }
        } else {
            let [a, b, c, d] = weights(u);
            let (p, q, r, s) = (knots[at], knots[at + 1], knots[at + 2], knots[at + 3]);
            std::array::from_fn(|axis| (a * p[axis] + b * q[axis]) + (c * r[axis] + d * s[axis]))
        };
        (x[k], y[k], z[k]) = (place[0], place[1], place[2]);
    }
}

/// The values of other rows along the path at the points' new positions, linear between the points.
#[inline(always)]
pub(super) fn taken_along(places: &[f32], stride: usize, points: usize, rows: &[f32], out: &mut Vec<f32>) {
    out.resize(rows.len(), 0.0);
    for (row, out) in rows.chunks_exact(stride).zip(out.chunks_exact_mut(stride)) {
        for k in 0..points {
            let at = (places[k] as usize).min(points - 2);
            let fraction = places[k] - at as f32;
            out[k] = row[at] + fraction * (row[at + 1] - row[at]);
        }
    }
}

/// The weights of four points in a row at u between the middle two (Catmull and Rom 1974).
#[inline(always)]
fn weights(u: f32) -> [f32; 4] {
    let (u2, u3) = (u * u, u * u * u);
    [u2 - 0.5 * (u + u3), 1.0 + 1.5 * u3 - 2.5 * u2, 0.5 * u + 2.0 * u2 - 1.5 * u3, 0.5 * (u3 - u2)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(points: usize, stride: usize, at: impl Fn(f32) -> [f32; 3]) -> Vec<f32> {
        let mut rows = vec![7.0; 3 * stride];
        for k in 0..points {
            let place = at(k as f32 / (points - 1) as f32);
            (0..3).for_each(|axis| rows[axis * stride + k] = place[axis]);
        }
        rows
    }

    fn length(rows: &[f32], stride: usize, points: usize) -> f32 {
        let at = |k: usize| [0, 1, 2].map(|axis| rows[axis * stride + k]);
        let edge = |k: usize| {
            let (a, b) = (at(k), at(k + 1));
            (0..3).map(|axis| (b[axis] - a[axis]).powi(2)).sum::<f32>().sqrt()
        };
        (0..points - 1).map(edge).sum()
    }

    #[test]
    fn strands_stay_on_their_path_and_have_the_wanted_length() {
        // A turn and a half in 32 edges.
        let (points, stride) = (33, 40);
        let angle = 1.5 * std::f32::consts::TAU;
        let arc = |s: f32| [(angle * s).cos(), (angle * s).sin(), 0.5 * s];
        let before = rows(points, stride, arc);
        let whole = length(&before, stride, points);
        for fraction in [0.5_f32, 0.8, 1.0] {
            let wanted: Vec<f32> = (0..stride).map(|k| whole * k as f32 / 32.0).collect();
            for wanted in [Wanted::Along(&wanted, fraction), Wanted::Fraction(fraction)] {
                let mut after = before.clone();
                respace(wanted, stride, points, &mut after, &mut Room::default());
                // Chords of the spline, which bulges beyond the polygon by 1 − cos(0.147) on 1 (0.3 % of the length).
                assert!((length(&after, stride, points) / (fraction * whole) - 1.0).abs() < 4e-3);
                for k in 0..points {
                    let off = (0..3).map(|axis| (after[axis * stride + k] - arc(fraction * k as f32 / 32.0)[axis]).abs());
                    assert!(off.fold(0.0, f32::max) < 2e-3, "{fraction} {k}");
                }
                assert!(after[points..stride].iter().all(|value| *value == 7.0));
            }
        }
    }

    #[test]
    fn short_guides_are_extended_straight_and_two_points_make_a_line() {
        let mut line = rows(5, 8, |s| [s, 0.0, 0.0]);
        respace(Wanted::Along(&[0.0, 0.27, 0.54, 0.81, 1.08], 1.0), 8, 5, &mut line, &mut Room::default());
        assert!((0..5).all(|k| (line[k] - 0.27 * k as f32).abs() < 1e-6), "{line:?}");
        // By a tenth at most, and stretched by three.
        let mut line = rows(5, 8, |s| [s, 0.0, 0.0]);
        respace(Wanted::Along(&[0.0, 0.5, 1.0, 1.5, 2.0], 1.0), 8, 5, &mut line, &mut Room::default());
        assert!((0..5).all(|k| (line[k] - 0.3575 * k as f32).abs() < 1e-6), "{line:?}");
        // An arc made a quarter longer is a larger arc from the same root, with a tail.
        let arc = |s: f32| [(2.0 * s).sin(), 1.0 - (2.0 * s).cos(), 0.0];
        let (before, mut after) = (rows(33, 40, arc), rows(33, 40, arc));
        let whole = length(&before, 40, 33);
        let wanted: Vec<f32> = (0..33).map(|k| 1.25 * whole * k as f32 / 32.0).collect();
        respace(Wanted::Along(&wanted, 1.0), 40, 33, &mut after, &mut Room::default());
        assert!((length(&after, 40, 33) / (1.25 * whole) - 1.0).abs() < 1e-3);
        let scale = 1.25 / 1.1;
        let bow = |k: usize| after[k].hypot(after[40 + k] - scale);
        assert!((0..29).all(|k| (bow(k) - scale).abs() < 1e-3));
        let mut two = rows(2, 8, |s| [0.1 + 0.8 * s, 0.0, 0.0]);
        let mut room = Room::default();
        respace(Wanted::Fraction(0.25), 8, 2, &mut two, &mut room);
        assert!(two[0] == 0.1 && (two[1] - 0.3).abs() < 1e-6, "{two:?}");
        assert!((room.places[1] - 0.25).abs() < 1e-6);
        // Coincident points stay where they are.
        let mut still = rows(4, 8, |_| [1.0; 3]);
        respace(Wanted::Along(&[0.0, 1.0, 2.0, 3.0], 1.0), 8, 4, &mut still, &mut room);
        assert!((0..4).all(|k| still[k] == 1.0));
    }
}
