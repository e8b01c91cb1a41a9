//! Tricubic interpolation of a lattice of numbers, with its slopes: Catmull and Rom's cubic along each axis.

use nalgebra::Vector3;

use crate::math::lane::Lane;

/// Nodes along an axis that a place is interpolated from.
const NODES: usize = 4;

/// Numbers on a lattice.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tricubic<'a> {
    /// At the nodes, x running fastest.
    pub values: &'a [f32],
    /// Nodes along x, y and z.
    pub counts: [u32; 3],
}

impl Tricubic<'_> {
    /// The value and its slopes at a place, all in cells from the lowest node. None outside the nodes.
    #[inline(always)]
    pub fn at<T: Lane, const REGISTERS: usize>(&self, place: &Vector3<f64>) -> Option<(f64, Vector3<f64>)> {
        let taps = Taps::new::<T, REGISTERS>(place, self.counts)?;
        let copied;
        let nodes = if self.counts.iter().all(|count| *count as usize >= NODES) {
            let (along_y, along_z) = (self.counts[0] as usize, self.counts[0] as usize * self.counts[1] as usize);
            let first = taps.first[2] * along_z + taps.first[1] * along_y + taps.first[0];
            Nodes { values: &self.values[first..], along_y, along_z }
        } else {
            copied = self.copied(taps.first);
            Nodes { values: &copied, along_y: NODES, along_z: NODES * NODES }
        };
        Some(nodes.sum::<T, REGISTERS>(&taps))
    }

    /// The nodes about a place where an axis has fewer than four: beyond its last node that one again.
    #[cold]
    fn copied(&self, first: [usize; 3]) -> [f32; NODES * NODES * NODES] {
        let [nx, ny, _] = self.counts.map(|count| count as usize);
        std::array::from_fn(|node| {
            let of = [node % NODES, node / NODES % NODES, node / (NODES * NODES)];
            let [i, j, k] = [0, 1, 2].map(|axis| (first[axis] + of[axis]).min(self.counts[axis] as usize - 1));
            self.values[(k * ny + j) * nx + i]
        })
    }
}

/// The nodes about a place.
struct Nodes<'a> {
    /// From the lowest on.
    values: &'a [f32],
    /// From a node to the next along y, and along z.
    along_y: usize,
    /// See `along_y`.
    along_z: usize,
}

impl Nodes<'_> {
    /// The value and its slopes: summed along y, then z, the four nodes of a row side by side, and last along x.
    #[inline(always)]
    fn sum<T: Lane, const REGISTERS: usize>(&self, taps: &Taps) -> (f64, Vector3<f64>) {
        let mut value = [T::zero(); REGISTERS];
        let (mut along_y, mut along_z) = (value, value);
        for k in 0..NODES {
            let mut sum = [T::zero(); REGISTERS];
            let mut slope = sum;
            for j in 0..NODES {
                let (weight, by_slope) = (T::splat(taps.weights[j][1]), T::splat(taps.slopes[j][1]));
                let row = self.row::<T, REGISTERS>(j, k);
                for r in 0..REGISTERS {
                    sum[r] += weight * row[r];
                    slope[r] += by_slope * row[r];
                }
            }
            let (weight, by_slope) = (T::splat(taps.weights[k][2]), T::splat(taps.slopes[k][2]));
            for r in 0..REGISTERS {
                value[r] += weight * sum[r];
                along_y[r] += weight * slope[r];
                along_z[r] += by_slope * sum[r];
            }
        }
        let dot = |weights: &[OfAxes; NODES], row: &[T; REGISTERS]| {
            let term = |i: usize| weights[i][0] * row[i / T::LANES].lane(i % T::LANES);
            (term(0) + term(1)) + (term(2) + term(3))
        };
        let slopes = Vector3::new(dot(&taps.slopes, &value), dot(&taps.weights, &along_y), dot(&taps.weights, &along_z));
        (dot(&taps.weights, &value), slopes)
    }

    /// Four nodes along x.
    #[inline(always)]
    fn row<T: Lane, const REGISTERS: usize>(&self, j: usize, k: usize) -> [T; REGISTERS] {
        let from = k * self.along_z + j * self.along_y;
        let nodes: &[f32; NODES] = self.values[from..].first_chunk().expect("rows end within the lattice");
        std::array::from_fn(|r| T::from_lanes(|lane| f64::from(nodes[r * T::LANES + lane])))
    }
}

/// Numbers of the axes x, y and z, and one that is not used.
type OfAxes = [f64; 4];

/// The four nodes along each axis that a place between two of them is interpolated from, by Catmull and Rom's cubic: through all nodes,
/// with slopes that go on from cell to cell. Beyond the last nodes what is interpolated goes on straight.
struct Taps {
    /// The first of the four, by axis. Those that an axis does not have weigh nothing.
    first: [usize; 3],
    /// By node.
    weights: [OfAxes; NODES],
    /// What the weights grow by a cell.
    slopes: [OfAxes; NODES],
}

impl Taps {
    /// For a place in cells from the first of `counts` nodes along the axes. None outside of them.
    #[inline(always)]
    fn new<T: Lane, const REGISTERS: usize>(place: &Vector3<f64>, counts: [u32; 3]) -> Option<Self> {
        let mut first = [0; 3];
        let mut within = [0.0; 4];
        let mut is_at_end = false;
        for axis in 0..3 {
            let (place, last) = (place[axis], counts[axis] - 1);
            if !(place >= 0.0 && place <= f64::from(last)) {
                return None;
            }
            let base = (place as u32).min(last - 1);
            (first[axis], within[axis]) = (base as usize, place - f64::from(base));
            is_at_end |= base == 0 || base + 2 > last;
        }
        let u: [T; REGISTERS] = std::array::from_fn(|r| T::from_lanes(|lane| within[r * T::LANES + lane]));
        let mut taps = Self { first, weights: [[0.0; 4]; NODES], slopes: [[0.0; 4]; NODES] };
        for (r, u) in u.into_iter().enumerate() {
            let number = T::splat;
            let left = T::one() - u;
            // Of the node before, the two around the place, and the one after.
            let weights = [
                number(-0.5) * u * left * left,
                T::one() + u * u * (number(1.5) * u - number(2.5)),
                u * (number(0.5) + u * (number(2.0) - number(1.5) * u)),
                number(-0.5) * u * u * left,
            ];
            let slopes = [
                number(-0.5) * left * (T::one() - number(3.0) * u),
                u * (number(4.5) * u - number(5.0)),
                number(0.5) + u * (number(4.0) - number(4.5) * u),
                u * (number(1.5) * u - T::one()),
            ];
            for node in 0..NODES {
                for lane in 0..T::LANES {
                    taps.weights[node][r * T::LANES + lane] = weights[node].lane(lane);
                    taps.slopes[node][r * T::LANES + lane] = slopes[node].lane(lane);
                }
            }
        }
        if is_at_end {
            for axis in 0..3 {
                taps.end(axis, counts[axis] as usize);
            }
        } else {
            taps.first = first.map(|base| base - 1);
        }
        Some(taps)
    }

    /// Makes those of an axis, which are as for a cell between others, those of its cell, which may be at an end.
    #[cold]
    fn end(&mut self, axis: usize, count: usize) {
        let base = self.first[axis];
        // What weighs nothing beyond one end gives way to a node at the other.
        let (whole, kept) = (base as isize - 1, (count as isize - NODES as isize).max(0));
        let first = whole.clamp(0, kept);
        for taps in [&mut self.weights, &mut self.slopes] {
            let mut own = taps.map(|node| node[axis]);
            if base == 0 {
                let [a, b, c, d] = own;
                own = [0.0, b + 2.0 * a, c - a, d];
            }
            if base + 2 >= count {
                let [a, b, c, d] = own;
                own = [a, b - d, c + 2.0 * d, 0.0];
            }
            if first > whole {
                own.rotate_left((first - whole) as usize)
            } else {
                own.rotate_right((whole - first) as usize)
            }
            for (node, weight) in taps.iter_mut().zip(own) {
                node[axis] = weight;
            }
        }
        self.first[axis] = first as usize;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::lane::Kernel;
    #[cfg(target_arch = "x86_64")]
    use crate::math::lanes::{F64x2, F64x4, InstructionSet};
    use crate::math::random::signed_numbers;

    /// Lattices with more nodes along an axis than the cubic takes, as many, and fewer.
    const LATTICES: [[u32; 3]; 5] = [[7, 6, 5], [4, 4, 4], [2, 3, 2], [5, 2, 4], [3, 9, 6]];

    fn values(counts: [u32; 3], number: &mut impl FnMut() -> f64) -> Vec<f32> {
        (0..counts.iter().product()).map(|_| number() as f32).collect()
    }

    /// A place anywhere on a lattice; one in four is at a node of each axis, or at its last.
    fn place(counts: [u32; 3], number: &mut impl FnMut() -> f64) -> Vector3<f64> {
        Vector3::from_fn(|axis, _| {
            let at = 0.5 * (1.0 + number()) * f64::from(counts[axis] - 1);
            if number() < -0.5 { at.round() } else { at }
        })
    }

    struct At<'a, T, const REGISTERS: usize>(Tricubic<'a>, Vector3<f64>, std::marker::PhantomData<T>);
    impl<T: Lane, const REGISTERS: usize> Kernel for At<'_, T, REGISTERS> {
        type Output = Option<(f64, Vector3<f64>)>;
        #[inline(always)]
        fn run(self) -> Self::Output {
            self.0.at::<T, REGISTERS>(&self.1)
        }
    }

    fn at<T: Lane, const REGISTERS: usize>(lattice: Tricubic, place: Vector3<f64>) -> Option<(f64, Vector3<f64>)> {
        T::call(At::<T, REGISTERS>(lattice, place, std::marker::PhantomData))
    }

    /// Catmull and Rom's cubic through numbers along an axis, that go on straight beyond the last, and its slope: by its formula.
    fn cubic(along: &[f64], place: f64) -> [f64; 2] {
        let last = along.len() - 1;
        let base = (place as usize).min(last - 1);
        let before = if base > 0 { along[base - 1] } else { 2.0 * along[0] - along[1] };
        let after = if base + 2 <= last { along[base + 2] } else { 2.0 * along[last] - along[last - 1] };
        let (a, b, c, d, u) = (before, along[base], along[base + 1], after, place - base as f64);
        let (two, three) = (2.0 * a - 5.0 * b + 4.0 * c - d, -a + 3.0 * b - 3.0 * c + d);
        [b + 0.5 * u * (c - a + u * (two + u * three)), 0.5 * (c - a) + u * (two + 1.5 * u * three)]
    }

    #[test]
    fn it_is_the_cubic_of_cubics_and_its_slopes() {
        let mut number = signed_numbers(11);
        for counts in LATTICES {
            let values = values(counts, &mut number);
            let [nx, ny, nz] = counts.map(|count| count as usize);
            for _ in 0..300 {
                let place = place(counts, &mut number);
                let row = |j: usize, k: usize, slope: usize| {
                    let row: Vec<f64> = (0..nx).map(|i| f64::from(values[(k * ny + j) * nx + i])).collect();
                    cubic(&row, place.x)[slope]
                };
                let sheet = |k: usize, slopes: [usize; 2]| {
                    let rows: Vec<f64> = (0..ny).map(|j| row(j, k, slopes[0])).collect();
                    cubic(&rows, place.y)[slopes[1]]
                };
                let whole = |slopes: [usize; 3]| {
                    let sheets: Vec<f64> = (0..nz).map(|k| sheet(k, [slopes[0], slopes[1]])).collect();
                    cubic(&sheets, place.z)[slopes[2]]
                };
                let (value, found) = at::<f64, 4>(Tricubic { values: &values, counts }, place).expect("on the lattice");
                assert!((value - whole([0, 0, 0])).abs() < 1e-13, "{counts:?} {place}");
                let slopes = Vector3::new(whole([1, 0, 0]), whole([0, 1, 0]), whole([0, 0, 1]));
                assert!((found - slopes).norm() < 1e-13, "{counts:?} {place}: {found}, {slopes}");
            }
            for beyond in
                [Vector3::new(-1e-9, 0.0, 0.0), Vector3::new(0.0, ny as f64 - 1.0 + 1e-9, 0.0), Vector3::repeat(f64::NAN)]
            {
                assert!(at::<f64, 4>(Tricubic { values: &values, counts }, beyond).is_none());
            }
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[test]
    fn every_width_gives_the_same_bits() {
        let bits = |found: Option<(f64, Vector3<f64>)>| found.map(|(value, slopes)| (value.to_bits(), slopes.map(f64::to_bits)));
        let mut number = signed_numbers(5);
        for counts in LATTICES {
            let values = values(counts, &mut number);
            let lattice = Tricubic { values: &values, counts };
            for _ in 0..300 {
                let place = place(counts, &mut number);
                let one = bits(at::<f64, 4>(lattice, place));
                assert!(one.is_some());
                assert_eq!(bits(at::<F64x2, 2>(lattice, place)), one);
                if InstructionSet::detected() >= InstructionSet::Avx2 {
                    assert_eq!(bits(at::<F64x4, 1>(lattice, place)), one);
                }
            }
        }
    }
}
