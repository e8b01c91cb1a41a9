//! The tangent plane at every node of a distance grid, for look-ups by the hundred thousand.

use std::sync::OnceLock;

use super::distance_grid::DistanceGrid;
use crate::math::prefetch::prefetch;

/// A plane: its distance (m) in the lower half, the field's slopes along x, y and z as signed bytes of 127 above it. One place in memory is
/// looked at where interpolation looks at 64.
type Plane = u64;

/// Nodes lie in bricks of 4 × 4 × 4, so that what is looked at together lies together.
const BRICK_BITS: u32 = 2;

/// The planes of a grid, made when they are first asked for. They come of the distances and are no part of what a grid is.
#[derive(Debug, Clone, Default)]
pub(super) struct Planes(OnceLock<Nodes>);

/// What is kept of the nodes, brick by brick.
#[derive(Debug, Clone)]
struct Nodes {
    planes: Box<[Plane]>,
}

impl PartialEq for Planes {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Planes {
    fn of(&self, grid: &DistanceGrid) -> &Nodes {
        self.0.get_or_init(|| Nodes::new(grid))
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        self.0.get().map_or(0, |nodes| size_of_val::<[Plane]>(&nodes.planes))
    }
}

impl Nodes {
    fn new(grid: &DistanceGrid) -> Self {
        let counts = grid.counts().map(|count| count as usize);
        let (values, strides) = (grid.values(), [1, counts[0], counts[0] * counts[1]]);
        let cell = grid.cell() as f32;
        let bricks = Bricks::of(grid.counts());
        let size = bricks.nodes();
        let mut planes = vec![0; size].into_boxed_slice();
        for (index, value) in values.iter().enumerate() {
            let at = [0, 1, 2].map(|axis| index / strides[axis] % counts[axis]);
            let mut plane = Plane::from(value.to_bits());
            for axis in 0..3 {
                let (back, ahead) = (usize::from(at[axis] > 0), usize::from(at[axis] + 1 < counts[axis]));
                let change = values[index + ahead * strides[axis]] - values[index - back * strides[axis]];
                let slope = change / ((back + ahead) as f32 * cell);
                let byte = (slope.clamp(-1.0, 1.0) * 127.0).round() as i8;
                plane |= Plane::from(byte as u8) << (32 + 8 * axis);
            }
            let node = bricks.index(at.map(|at| at as u32)) as usize;
            planes[node] = plane;
        }
        Self { planes }
    }
}

/// Where nodes lie in memory.
#[derive(Debug, Clone, Copy)]
struct Bricks {
    /// Along x and y, and in all.
    x: u32,
    y: u32,
    all: u32,
}

impl Bricks {
    fn of(counts: [u32; 3]) -> Self {
        let [x, y, z] = counts.map(|count| count.div_ceil(1 << BRICK_BITS));
        Self { x, y, all: x * y * z }
    }

    /// How many nodes, with those that fill up the last bricks.
    fn nodes(&self) -> usize {
        (self.all as usize) << (3 * BRICK_BITS)
    }

    #[inline(always)]
    fn index(&self, node: [u32; 3]) -> u32 {
        let brick = node.map(|at| at >> BRICK_BITS);
        let within = node.map(|at| at & ((1 << BRICK_BITS) - 1));
        let brick = (brick[2] * self.y + brick[1]) * self.x + brick[0];
        (((brick << BRICK_BITS | within[2]) << BRICK_BITS | within[1]) << BRICK_BITS) | within[0]
    }
}

/// A grid's distances to first order about the nearest node.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlaneField<'a> {
    nodes: &'a Nodes,
    bricks: Bricks,
    counts: [f32; 3],
    cell: f32,
}

impl<'a> PlaneField<'a> {
    pub(super) fn new(planes: &'a Planes, grid: &'a DistanceGrid) -> Self {
        let counts = grid.counts();
        Self {
            nodes: planes.of(grid),
            bricks: Bricks::of(counts),
            counts: counts.map(|count| count as f32),
            cell: grid.cell() as f32,
        }
    }

    /// Whether there is a node there, in cells from half a cell below the lowest.
    #[inline(always)]
    fn is_inside(&self, node: [f32; 3]) -> bool {
        let inside = |axis: usize| (node[axis] >= 0.0) & (node[axis] < self.counts[axis]);
        inside(0) & inside(1) & inside(2)
    }

    /// The node nearest to a place in cells from the lowest, and its plane; none outside the grid.
    #[inline(always)]
    fn nearest(&self, place: [f32; 3]) -> Option<([u32; 3], &Plane)> {
        let node = place.map(|value| value + 0.5);
        if !self.is_inside(node) {
            return None;
        }
        let node = node.map(|value| value as u32);
        Some((node, self.nodes.planes.get(self.bricks.index(node) as usize)?))
    }

    /// Distance (m) and slopes at a place in cells from the lowest node; none outside the grid.
    #[inline(always)]
    pub fn at(&self, place: [f32; 3]) -> Option<(f32, [f32; 3])> {
        let (node, &plane) = self.nearest(place)?;
        let slopes = [32, 40, 48].map(|shift| f32::from((plane >> shift) as i8) * (1.0 / 127.0));
        let away = [0, 1, 2].map(|axis| place[axis] - node[axis] as f32);
        let more = slopes[0] * away[0] + slopes[1] * away[1] + slopes[2] * away[2];
        Some((f32::from_bits(plane as u32) + self.cell * more, slopes))
    }

    /// Asks memory for what [`PlaneField::at`] looks at.
    #[inline(always)]
    pub fn ask_for(&self, place: [f32; 3]) {
        if let Some((_, plane)) = self.nearest(place) {
            prefetch(plane);
        }
    }

    /// How far a place outside the grid is from it at least, in cells; 0 inside.
    pub fn outside(&self, place: [f32; 3]) -> f32 {
        let beyond = |axis: usize| (-0.5 - place[axis]).max(place[axis] + 0.5 - self.counts[axis]);
        [0, 1, 2].map(beyond).into_iter().fold(0.0, f32::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn planes_follow_the_field() {
        // A sphere of 0.1 m in cells of 5 mm: half a diagonal of a cell from a node, squared, over twice the radius, is 0.1 mm; slopes are
        // stored to 1/254, which over that distance is 0.02 mm.
        let (counts, cell, low) = ([50_u32; 3], 0.005, Vector3::repeat(-0.1225));
        let at = |k: usize| Vector3::new((k % 50) as f64, (k / 50 % 50) as f64, (k / 2500) as f64) * cell + low;
        let values = (0..125_000).map(|k| (at(k).norm() - 0.1) as f32).collect();
        let grid = DistanceGrid::from_parts(low, cell, 0.02, counts, values).expect("a grid");
        let field = grid.planes();
        let mut seed = 1_u64;
        let mut noise = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        for _ in 0..10_000 {
            let point = Vector3::from_fn(|_, _| 0.24 * noise() - 0.12);
            if point.norm() < 0.06 {
                continue;
            }
            let place = ((point - low) / cell).map(|value| value as f32);
            let (distance, slopes) = field.at(place.into()).expect("inside");
            assert!((f64::from(distance) - (point.norm() - 0.1)).abs() < 2.5e-4, "{point}");
            let slopes = Vector3::from(slopes.map(f64::from));
            assert!((slopes - point.normalize()).norm() < 0.1);
        }
        assert!(
            field.at([-0.6, 3.0, 3.0]).is_none() && field.at([3.0, 49.6, 3.0]).is_none() && field.at([f32::NAN; 3]).is_none()
        );
        assert!(field.at([-0.4, 49.4, 0.0]).is_some());
        assert_eq!(field.outside([-2.5, 3.0, 51.0]), 2.0);
        assert_eq!(field.outside([-0.4, 49.4, 0.0]), 0.0);
        assert!(field.at([24.5; 3]).expect("inside").0 < 0.0);
    }
}
