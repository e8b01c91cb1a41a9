//! Nearest-point queries in space: a balanced k-d tree (Bentley 1975) in one array.

use nalgebra::Vector3;

/// The largest number of points in a leaf.
const LEAF: usize = 8;

/// A tree over points. Its answers do not depend on the order of the points, except that of equally distant points the lower
/// index comes first.
#[derive(Debug, Clone)]
pub(crate) struct PointTree {
    /// Indices, arranged so that the middle of every range splits it along the range's longest axis.
    order: Vec<u32>,
    points: Vec<Vector3<f64>>,
    /// The splitting axis of the range whose middle is here.
    axes: Vec<u8>,
}

impl PointTree {
    /// A tree over finite points.
    pub fn new(points: &[Vector3<f64>]) -> Self {
        let mut tree = Self { order: (0..points.len() as u32).collect(), points: points.to_vec(), axes: vec![0; points.len()] };
        let mut ranges = vec![(0, points.len())];
        while let Some((begin, end)) = ranges.pop() {
            if end - begin <= LEAF {
                continue;
            }
            let (mut low, mut high) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
            for index in &tree.order[begin..end] {
                low = low.inf(&points[*index as usize]);
                high = high.sup(&points[*index as usize]);
            }
            let axis = (high - low).imax();
            let middle = begin.midpoint(end);
            tree.order[begin..end].select_nth_unstable_by(middle - begin, |a, b| {
                points[*a as usize][axis].total_cmp(&points[*b as usize][axis]).then(a.cmp(b))
            });
            tree.axes[middle] = axis as u8;
            ranges.push((begin, middle));
            ranges.push((middle + 1, end));
        }
        tree
    }

    /// Calls `visit` with the index and squared distance of every point within `radius` of a place, boundary included.
    pub fn within(&self, place: Vector3<f64>, radius: f64, mut visit: impl FnMut(u32, f64)) {
        let limit = radius * radius;
        self.search(place, &mut |index, squared| {
            if squared <= limit {
                visit(index, squared);
            }
            limit
        });
    }

    /// The `count` nearest points (fewer if there are no more), nearest first, with their squared distances.
    pub fn nearest(&self, place: Vector3<f64>, count: usize, found: &mut Vec<(f64, u32)>) {
        found.clear();
        if count == 0 {
            return;
        }
        self.search(place, &mut |index, squared| {
            let key = |entry: &(f64, u32)| (entry.0, entry.1);
            if found.len() < count || (squared, index) < key(&found[count - 1]) {
                let at = found.partition_point(|entry| key(entry) < (squared, index));
                found.insert(at, (squared, index));
                found.truncate(count);
            }
            if found.len() < count { f64::INFINITY } else { found[count - 1].0 }
        });
    }

    /// Visits points, first the half that holds the place. `visit` returns the squared distance beyond which points no longer
    /// matter.
    fn search(&self, place: Vector3<f64>, visit: &mut impl FnMut(u32, f64) -> f64) {
        let mut limit = f64::INFINITY;
        // Ranges, and the squared distance from the place to the plane that separates them.
        let mut ranges = [(0_usize, 0_usize, 0.0_f64); 96];
        ranges[0] = (0, self.order.len(), 0.0);
        let mut depth = 1;
        let mut look = |at: usize, limit: &mut f64| {
            let index = self.order[at];
            *limit = visit(index, (self.points[index as usize] - place).norm_squared());
        };
        while depth > 0 {
            depth -= 1;
            let (begin, end, away) = ranges[depth];
            if away > limit {
                continue;
            }
            if end - begin <= LEAF {
                (begin..end).for_each(|at| look(at, &mut limit));
                continue;
            }
            let middle = begin.midpoint(end);
            let axis = self.axes[middle] as usize;
            let beyond = place[axis] - self.points[self.order[middle] as usize][axis];
            look(middle, &mut limit);
            let (low, high) = ((begin, middle), (middle + 1, end));
            let (near, far) = if beyond < 0.0 { (low, high) } else { (high, low) };
            ranges[depth] = (far.0, far.1, beyond * beyond);
            ranges[depth + 1] = (near.0, near.1, away);
            depth += 2;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Seeded;

    #[test]
    fn queries_agree_with_an_exhaustive_search() {
        for count in [0, 1, 7, 9, 100, 1000] {
            let numbers = Seeded::new(3, count);
            // A third of them twice, on a coarse lattice, so that distances tie.
            let coordinate = |index: u64| (numbers.unit(index) * 10.0).floor() * 0.1;
            let points: Vec<Vector3<f64>> =
                (0..count).map(|k| Vector3::new(coordinate(3 * k), coordinate(3 * k + 1), coordinate(3 * k + 2))).collect();
            let tree = PointTree::new(&points);
            for query in 0..50 {
                let at = |axis: u64| numbers.unit(100_000 + 3 * query + axis);
                let place = Vector3::new(at(0), at(1), at(2));
                let mut all: Vec<(f64, u32)> =
                    points.iter().enumerate().map(|(index, p)| ((p - place).norm_squared(), index as u32)).collect();
                all.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
                let mut found = Vec::new();
                for wanted in [0, 1, 5, 2000] {
                    tree.nearest(place, wanted, &mut found);
                    assert_eq!(found, all[..wanted.min(all.len())]);
                }
                let mut near = Vec::new();
                tree.within(place, 0.35, |index, squared| near.push((squared, index)));
                near.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
                assert_eq!(near, all.iter().copied().filter(|(squared, _)| *squared <= 0.35 * 0.35).collect::<Vec<_>>());
            }
        }
    }
}
