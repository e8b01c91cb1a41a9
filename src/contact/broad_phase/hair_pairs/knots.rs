//! Knots: where ties hold strands together their wisps give way to each other. A knot has no room for wisps of their full
//! radii, which would push apart what the tie pulls together. Beside a knot the wisps are as if gathered, and regain their
//! radii some distance from it.

use crate::error::{Error, Result, check_not_negative};

/// Two material points that are held together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tie {
    /// Indices of the strands among the wisps; equal if a strand is tied to itself.
    pub strands: [u32; 2],
    /// Arclength of the points from the roots, m, zero or above.
    pub along: [f64; 2],
}

/// Two strands have their full radii from this many times their sum on, along both, from the knot; in a knot of many strands
/// the distance grows with the radius of the bundle, the square root of their number.
const GATHERED: f64 = 4.0;
/// They are not in contact closer than this many times the sum.
const TIED: f64 = 1.0;

/// A point of a knot.
#[derive(Debug, Clone, Copy)]
struct Point {
    strand: u32,
    along: f64,
    knot: u32,
    /// The range of the knot, in units of the sum of the radii.
    reach: f64,
}

/// The knots made by ties: ties that share a point of a strand make one.
#[derive(Debug, Default)]
pub(super) struct Knots {
    /// By strand, then arclength.
    points: Vec<Point>,
    /// For each knot, while they are formed, one that it is joined with.
    leader: Vec<u32>,
    members: Vec<u32>,
}

impl Knots {
    /// Replaces all knots. `reach`: two points of a strand closer than this to each other are in one knot, m.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a nonexistent strand, or an arclength that is negative or not finite; nothing is changed
    /// then.
    pub fn set(&mut self, ties: &[Tie], strands: usize, reach: impl Fn(u32) -> f64) -> Result<()> {
        for (index, tie) in ties.iter().enumerate() {
            for end in 0..2 {
                if tie.strands[end] as usize >= strands {
                    let allowed = format!("below {strands}, the number of wisps");
                    return Err(Error::invalid(format!("ties[{index}].strands[{end}]"), tie.strands[end], allowed));
                }
                check_not_negative(|| format!("ties[{index}].along[{end}]"), tie.along[end])?;
            }
        }
        self.points.clear();
        for (knot, tie) in ties.iter().enumerate() {
            for end in 0..2 {
                self.points.push(Point { strand: tie.strands[end], along: tie.along[end], knot: knot as u32, reach: 0.0 });
            }
        }
        self.points.sort_by(|a, b| a.strand.cmp(&b.strand).then(a.along.total_cmp(&b.along)).then(a.knot.cmp(&b.knot)));
        self.leader.clear();
        self.leader.extend(0..ties.len() as u32);
        for pair in self.points.windows(2) {
            if pair[0].strand == pair[1].strand && pair[1].along - pair[0].along <= reach(pair[0].strand) {
                let [a, b] = [0, 1].map(|k| find(&mut self.leader, pair[k].knot));
                self.leader[a.max(b) as usize] = a.min(b);
            }
        }
        // The number of points of each; points of one place on a strand count once.
        let Self { points, leader, members } = self;
        members.clear();
        members.resize(ties.len(), 0);
        for k in 0..points.len() {
            points[k].knot = find(leader, points[k].knot);
            let again = k > 0 && points[k - 1].strand == points[k].strand && points[k - 1].knot == points[k].knot;
            members[points[k].knot as usize] += u32::from(!again);
        }
        for point in points {
            point.reach = GATHERED * (0.5 * f64::from(members[point.knot as usize].max(2))).sqrt();
        }
        Ok(())
    }

    /// Whether a strand is tied to anything.
    pub fn holds(&self, strand: u32) -> bool {
        !self.of(strand).is_empty()
    }

    fn of(&self, strand: u32) -> &[Point] {
        let from = self.points.partition_point(|point| point.strand < strand);
        let to = self.points.partition_point(|point| point.strand <= strand);
        &self.points[from..to]
    }

    /// What is left of the sum of the radii, `radii` (m), where points at these arclengths of two strands meet: 1 away from
    /// their knots, less beside one; `None` next to it.
    pub fn fraction_left(&self, strands: [u32; 2], along: [f64; 2], radii: f64) -> Option<f64> {
        let mut left = 1.0_f64;
        for a in self.of(strands[0]) {
            for b in self.of(strands[1]).iter().filter(|b| b.knot == a.knot) {
                // Both must be near it: another part of a strand that comes by is kept out as everywhere.
                let off = (along[0] - a.along).abs().max((along[1] - b.along).abs());
                if off <= TIED * radii {
                    return None;
                }
                left = left.min(off / (a.reach * radii));
            }
        }
        Some(left)
    }
}

fn find(leader: &mut [u32], mut knot: u32) -> u32 {
    while leader[knot as usize] != knot {
        leader[knot as usize] = leader[leader[knot as usize] as usize];
        knot = leader[knot as usize];
    }
    knot
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tie(a: u32, b: u32, along: [f64; 2]) -> Tie {
        Tie { strands: [a, b], along }
    }

    #[test]
    fn ties_in_a_row_make_one_knot() {
        let mut knots = Knots::default();
        let ties = [tie(0, 1, [0.1, 0.1]), tie(2, 1, [0.08, 0.1005]), tie(3, 1, [0.05, 0.02])];
        knots.set(&ties, 5, |_| 1e-3).unwrap();
        let left = |a, b, along| knots.fraction_left([a, b], along, 2e-3);
        let three = 1.5_f64.sqrt();
        // In the knot of 0, 1 and 2, in either order; halfway out of it; and away from it along either strand.
        assert_eq!(left(0, 2, [0.1, 0.08]), None);
        assert_eq!(left(2, 0, [0.0801, 0.1015]), None);
        assert!((left(0, 1, [0.096, 0.1001]).unwrap() - 0.5 / three).abs() < 1e-9);
        assert_eq!(left(0, 1, [0.08, 0.1]), Some(1.0));
        assert_eq!(left(0, 1, [0.1, 0.09]), Some(1.0));
        assert!((left(1, 3, [0.02, 0.054]).unwrap() - 0.5).abs() < 1e-9);
        // Strand 3 is tied to strand 1 elsewhere, and to no other; 4 to none.
        assert_eq!(left(1, 3, [0.02, 0.05]), None);
        assert_eq!(left(1, 3, [0.1, 0.05]), Some(1.0));
        assert_eq!(left(0, 3, [0.1, 0.05]), Some(1.0));
        assert!(knots.holds(3) && !knots.holds(4));
    }

    #[test]
    fn bad_ties_are_refused_and_change_nothing() {
        let mut knots = Knots::default();
        knots.set(&[tie(0, 1, [0.1, 0.1])], 2, |_| 1e-3).unwrap();
        for (bad, named) in [
            (tie(0, 2, [0.1, 0.1]), "ties[1].strands[1]"),
            (tie(0, 1, [f64::NAN, 0.1]), "ties[1].along[0]"),
            (tie(0, 1, [0.0, -0.1]), "ties[1].along[1]"),
        ] {
            let error = knots.set(&[tie(0, 1, [0.0, 0.0]), bad], 2, |_| 1e-3).unwrap_err().to_string();
            assert!(error.contains(named), "{error}");
            assert_eq!(knots.fraction_left([0, 1], [0.1, 0.1], 1e-3), None);
        }
    }
}
