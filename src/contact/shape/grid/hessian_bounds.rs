//! Bounds on the second derivatives of a distance grid's field, block by block of cells.
//!
//! With them a value and a gradient at one point bound the field around it to second order: much closer than its steepest slope does
//! where hair lies along a surface.
//!
//! Along an axis the field is Catmull and Rom's cubic of the nodes, whose second derivative is linear in a cell: between
//! 2a − 5b + 4c − d at the cell's one end and −a + 4b − 5c + 2d at its other, a to d being the four nodes. Its first derivative is a mean of the
//! three differences between them. Across the other axes both are averaged with the cubic's weights. Weights of such means add up to one,
//! their magnitudes to [`SPREAD`] and [`SLOPE_SPREAD`] at most: a mean is no further from the middle of what is averaged than that
//! many times half its range.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

use nalgebra::Vector3;

use super::distance_grid::DistanceGrid;

/// Cells of a block along an axis.
const CELLS: usize = 2;
/// The nodes along an axis from which a block's cells are interpolated.
const NODES: usize = CELLS + 3;
/// There is no bound for balls that meet more blocks than this along an axis.
const MOST_BLOCKS: usize = 3;
/// The most that magnitudes of the cubic's weights add up to, and of the weights of differences in its slope: halfway between nodes.
const SPREAD: f64 = 1.25;
const SLOPE_SPREAD: f64 = 1.5;
/// What rounding to single precision may take from a bound.
const ROUNDING: f64 = 1.0 + 1e-6;

/// The bounds of a grid, each found when it is first asked for. They come of the distances and are no part of what a grid is.
#[derive(Debug, Default)]
pub(super) struct HessianBounds(OnceLock<Blocks>);

/// Bounds of the blocks, 1/m, as the bits of numbers in single precision; [`UNKNOWN`] until they are asked for.
#[derive(Debug)]
struct Blocks {
    counts: [usize; 3],
    bounds: Box<[AtomicU32]>,
}

/// No bound has these bits: it would be below zero.
const UNKNOWN: u32 = u32::MAX;

impl Clone for HessianBounds {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl PartialEq for HessianBounds {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl HessianBounds {
    /// An upper bound on the norm of the Hessian within a ball, given in cells from the lowest node, 1/m. None where the ball leaves the grid, or is too
    /// large.
    pub fn about(&self, grid: &DistanceGrid, place: &Vector3<f64>, radius: f64) -> Option<f64> {
        let blocks = self.0.get_or_init(|| Blocks::new(grid));
        let (mut from, mut to) = ([0; 3], [0; 3]);
        for axis in 0..3 {
            let (low, high) = (place[axis] - radius, place[axis] + radius);
            if !(low >= 0.0 && high <= f64::from(grid.counts()[axis] - 1)) {
                return None;
            }
            (from[axis], to[axis]) = (low as usize / CELLS, (high as usize / CELLS).min(blocks.counts[axis] - 1));
            if to[axis] - from[axis] >= MOST_BLOCKS {
                return None;
            }
        }
        let mut most = 0.0_f64;
        for z in from[2]..=to[2] {
            for y in from[1]..=to[1] {
                for x in from[0]..=to[0] {
                    most = most.max(blocks.bound(grid, [x, y, z]));
                }
            }
        }
        Some(most)
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        self.0.get().map_or(0, |blocks| size_of_val::<[AtomicU32]>(&blocks.bounds))
    }
}

impl Blocks {
    fn new(grid: &DistanceGrid) -> Self {
        let counts = grid.counts().map(|count| (count as usize - 1).div_ceil(CELLS));
        let bounds = (0..counts.iter().product()).map(|_| AtomicU32::new(UNKNOWN)).collect();
        Self { counts, bounds }
    }

    #[inline]
    fn bound(&self, grid: &DistanceGrid, block: [usize; 3]) -> f64 {
        let [x, y, z] = block;
        let kept = &self.bounds[(z * self.counts[1] + y) * self.counts[0] + x];
        let mut bits = kept.load(Ordering::Relaxed);
        if bits == UNKNOWN {
            // (Whoever finds it finds the same.)
            bits = ((find(grid, block) * ROUNDING) as f32).to_bits();
            kept.store(bits, Ordering::Relaxed);
        }
        f64::from(f32::from_bits(bits))
    }
}

/// The least and the greatest of some numbers.
#[derive(Debug, Clone, Copy)]
struct Range([f64; 2]);

impl Range {
    const NONE: Self = Self([f64::INFINITY, f64::NEG_INFINITY]);

    #[inline(always)]
    fn take(&mut self, number: f64) {
        self.0 = [self.0[0].min(number), self.0[1].max(number)];
    }

    /// The largest magnitude of a mean whose weights' magnitudes add up to `spread`.
    fn largest_mean(&self, spread: f64) -> f64 {
        let [least, most] = self.0;
        (0.5 * (least + most)).abs() + spread * 0.5 * (most - least)
    }
}

/// Bounds the norm of the Hessian in a block, 1/m.
#[cold]
fn find(grid: &DistanceGrid, block: [usize; 3]) -> f64 {
    let nodes = gather(grid, block);
    let strides = [1, NODES, NODES * NODES];
    let mut squares = 0.0;
    for axis in 0..3 {
        let (along, [across, beyond]) = (strides[axis], [strides[(axis + 1) % 3], strides[(axis + 2) % 3]]);
        let (mut pure, mut mixed) = (Range::NONE, Range::NONE);
        for k in 0..NODES {
            for j in 0..NODES {
                let row = j * across + k * beyond;
                for i in 0..CELLS {
                    let [a, b, c, d] = [0, 1, 2, 3].map(|node| nodes[row + (i + node) * along]);
                    pure.take(2.0 * a - 5.0 * b + 4.0 * c - d);
                    pure.take(4.0 * b - a - 5.0 * c + 2.0 * d);
                }
                if j + 1 < NODES {
                    for i in 0..NODES - 1 {
                        let corner = row + i * along;
                        let ahead = nodes[corner + along + across] - nodes[corner + across];
                        mixed.take(ahead - (nodes[corner + along] - nodes[corner]));
                    }
                }
            }
        }
        let pure = pure.largest_mean(SPREAD * SPREAD);
        let mixed = mixed.largest_mean(SPREAD * SLOPE_SPREAD * SLOPE_SPREAD);
        squares += pure * pure + 2.0 * mixed * mixed;
    }
    // (The Frobenius norm is no less than the spectral norm.)
    squares.sqrt() / (grid.cell() * grid.cell())
}

/// The values of the nodes from which a block is interpolated, x running fastest. Beyond the last nodes of an axis the field goes on straight.
fn gather(grid: &DistanceGrid, block: [usize; 3]) -> [f64; NODES * NODES * NODES] {
    let counts = grid.counts().map(|count| count as usize);
    // Two nodes, and what each weighs.
    let taps = [0, 1, 2].map(|axis| {
        let last = counts[axis] - 1;
        std::array::from_fn::<_, NODES, _>(|k| match (block[axis] * CELLS + k).checked_sub(1) {
            None => [(0, 2.0), (1, -1.0)],
            Some(node) if node <= last => [(node, 1.0), (node, 0.0)],
            Some(node) => {
                let beyond = (node - last) as f64;
                [(last, 1.0 + beyond), (last - 1, -beyond)]
            }
        })
    });
    let values = grid.values();
    let mut nodes = [0.0; NODES * NODES * NODES];
    let mut index = 0;
    for z in taps[2] {
        for y in taps[1] {
            for x in taps[0] {
                for (k, by_z) in z.into_iter().filter(|tap| tap.1 != 0.0) {
                    for (j, by_y) in y.into_iter().filter(|tap| tap.1 != 0.0) {
                        for (i, by_x) in x.into_iter().filter(|tap| tap.1 != 0.0) {
                            nodes[index] += by_z * by_y * by_x * f64::from(values[(k * counts[1] + j) * counts[0] + i]);
                        }
                    }
                }
                index += 1;
            }
        }
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::signed_numbers;

    const CELL: f64 = 0.005;

    fn grid(counts: [u32; 3], mut value: impl FnMut(Vector3<f64>) -> f64) -> DistanceGrid {
        let node = |k: u32| [k % counts[0], k / counts[0] % counts[1], k / (counts[0] * counts[1])];
        let values = (0..counts.iter().product()).map(|k| value(Vector3::from(node(k).map(f64::from)) * CELL) as f32).collect();
        DistanceGrid::from_parts(Vector3::zeros(), CELL, 0.02, counts, values).unwrap()
    }

    /// Between any two points in a ball, at the grid's ends too, the gradient differs by no more than the bound times their distance; in fields as
    /// rough as can be, the bound is not many times what is found.
    #[test]
    fn no_gradient_changes_faster_than_the_bound() {
        let mut number = signed_numbers(7);
        let mut largest = 0.0_f64;
        for counts in [[9, 14, 6], [2, 3, 5], [4, 4, 17]] {
            let grid = grid(counts, |_| 0.01 * number());
            let extent = Vector3::from(counts.map(|count| f64::from(count - 1)));
            let mut number = signed_numbers(11);
            let gradient = |place: Vector3<f64>| grid.with_gradient(&(place * CELL)).unwrap().1;
            for _ in 0..20_000 {
                let mut place = || extent.map(|extent| extent * (0.5 + 0.5 * number()));
                let (centre, toward) = (place(), (place() - place()).normalize());
                let radius = 0.3;
                let Some(bound) = grid.hessian_bound(&(centre * CELL), radius * CELL) else { continue };
                let turned = (gradient(centre + toward * radius) - gradient(centre - toward * radius)).norm();
                let most = bound * 2.0 * radius * CELL;
                assert!(turned <= most * (1.0 + 1e-9), "{turned} {most} about {centre}");
                largest = largest.max(turned / most);
            }
        }
        assert!(largest > 0.1, "{largest}");
    }

    /// The distance from a ball has second derivatives of 1/R in two directions.
    #[test]
    fn of_a_ball_the_bound_is_little_more_than_its_curvature() {
        let (centre, radius) = (Vector3::repeat(0.1), 0.06);
        let grid = grid([41; 3], |at| (at - centre).norm() - radius);
        let bytes = grid.heap_bytes();
        let about = |y: f64, reach: f64| grid.hessian_bound(&(Vector3::new(20.3, y, 20.1) * CELL), reach * CELL);
        let bound = about(8.2, 0.2).unwrap();
        assert!(bound * radius > 1.0 && bound * radius < 4.0, "{}", bound * radius);
        // There is no bound beyond the grid, about what is not a place, and for what is too large.
        for (y, reach) in [(0.1, 0.2), (39.9, 0.2), (f64::NAN, 0.2), (20.0, 9.0), (20.0, f64::NAN)] {
            assert!(about(y, reach).is_none());
        }
        assert!(grid.heap_bytes() > bytes && grid.clone() == grid);
    }
}
