//! The tangent plane at every node of a distance grid, and how near the surface is at least about it, for look-ups by the hundred thousand.

use std::sync::OnceLock;

use super::grid::DistanceGrid;

/// A plane: its distance (m) in the lower half, the field's slopes along x, y and z as signed bytes of 127 above it. One place in memory is
/// looked at where interpolation looks at 64.
type Plane = u64;

/// Nodes lie in bricks of 4 × 4 × 4, so that what is looked at together lies together: the least distances of a brick are a line of the cache.
const BRICK_BITS: u32 = 2;

/// Steps a cell in which the least distances are told.
const STEPS: f32 = 8.0;

/// The planes of a grid, made when they are first asked for. They come of the distances and are no part of what a grid is.
#[derive(Debug, Clone, Default)]
pub(super) struct Planes(OnceLock<Nodes>);

/// What is kept of the nodes, brick by brick.
#[derive(Debug, Clone)]
struct Nodes {
    planes: Box<[Plane]>,
    /// The least that the plane is where its node is the nearest, in steps, rounded down; 0 also for less, 255 also for more.
    least: Box<[u8]>,
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
        self.0.get().map_or(0, |nodes| size_of_val::<[Plane]>(&nodes.planes) + size_of_val::<[u8]>(&nodes.least))
    }
}

impl Nodes {
    fn new(grid: &DistanceGrid) -> Self {
        let counts = grid.counts().map(|count| count as usize);
        let (values, strides) = (grid.values(), [1, counts[0], counts[0] * counts[1]]);
        let cell = grid.cell() as f32;
        let bricks = Bricks::of(grid.counts());
        let size = bricks.nodes();
        let (mut planes, mut least) = (vec![0; size].into_boxed_slice(), vec![0; size].into_boxed_slice());
        for (index, value) in values.iter().enumerate() {
            let at = [0, 1, 2].map(|axis| index / strides[axis] % counts[axis]);
            let (mut plane, mut steepest) = (Plane::from(value.to_bits()), 0.0);
            for axis in 0..3 {
                let (back, ahead) = (usize::from(at[axis] > 0), usize::from(at[axis] + 1 < counts[axis]));
                let change = values[index + ahead * strides[axis]] - values[index - back * strides[axis]];
                let slope = change / ((back + ahead) as f32 * cell);
                let byte = (slope.clamp(-1.0, 1.0) * 127.0).round() as i8;
                plane |= Plane::from(byte as u8) << (32 + 8 * axis);
                steepest += f32::from(byte).abs() * (1.0 / 127.0);
            }
            let node = bricks.index(at.map(|at| at as u32)) as usize;
            planes[node] = plane;
            // (A cast to a byte stops at its ends.)
            least[node] = (STEPS * (value / cell - 0.5 * steepest)).floor() as u8;
        }
        Self { planes, least }
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

    /// Distance (m) and slopes at a place in cells from the lowest node; none outside the grid.
    #[inline(always)]
    pub fn at(&self, place: [f32; 3]) -> Option<(f32, [f32; 3])> {
        let node = place.map(|value| value + 0.5);
        if !self.is_inside(node) {
            return None;
        }
        let node = node.map(|value| value as u32);
        let plane = *self.nodes.planes.get(self.bricks.index(node) as usize)?;
        let slopes = [32, 40, 48].map(|shift| f32::from((plane >> shift) as i8) * (1.0 / 127.0));
        let away = [0, 1, 2].map(|axis| place[axis] - node[axis] as f32);
        let more = slopes[0] * away[0] + slopes[1] * away[1] + slopes[2] * away[2];
        Some((f32::from_bits(plane as u32) + self.cell * more, slopes))
    }

    /// A distance (m) for [`PlaneField::nearer`], rounded up; 1 for none at all, since what is inside is told as 0.
    pub fn steps(&self, distance: f32) -> u32 {
        (STEPS * distance / self.cell).ceil().max(1.0) as u32
    }

    /// Which of some places may be nearer to the surface than so many steps, a bit each: all that [`PlaneField::at`] says are, and some more.
    #[inline(always)]
    pub fn nearer<const N: usize>(&self, places: &[[f32; N]; 3], steps: u32) -> u32 {
        let (mut index, mut inside) = ([0_u32; N], [false; N]);
        for k in 0..N {
            let node = [places[0][k] + 0.5, places[1][k] + 0.5, places[2][k] + 0.5];
            inside[k] = self.is_inside(node);
            let node = [0, 1, 2].map(|axis| node[axis].max(0.0).min(self.counts[axis] - 1.0) as i32 as u32);
            index[k] = self.bricks.index(node);
        }
        let mut bits = 0;
        for k in 0..N {
            let near = inside[k] && self.nodes.least.get(index[k] as usize).is_some_and(|least| u32::from(*least) < steps);
            bits |= u32::from(near) << k;
        }
        bits
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn planes_follow_the_field() {
        // A sphere of 0.1 m in cells of 5 mm: half a diagonal of a cell from a node, squared, over twice the radius, is 0.1 mm; slopes are
        // told to 1/254, which over that way is 0.02 mm.
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
        // What may be near is what is, and not much more; nothing is outside.
        let (mut near, mut told) = (0, 0);
        let within = 0.003;
        for _ in 0..10_000 {
            let places = [0, 1, 2].map(|_| std::array::from_fn::<f32, 8, _>(|_| (52.0 * noise() - 1.5) as f32));
            let bits = field.nearer(&places, field.steps(within));
            for k in 0..8 {
                let distance = field.at([0, 1, 2].map(|axis| places[axis][k])).map(|(distance, _)| distance);
                let (is, may) = (distance.is_some_and(|distance| distance < within), bits >> k & 1 == 1);
                assert!(may || !is, "{distance:?}");
                assert!(!may || distance.is_some_and(|distance| distance < within + 1.8 * 0.005), "{distance:?}");
                (near, told) = (near + u32::from(is), told + u32::from(may));
            }
        }
        assert!(near > 10_000 && told < near + near / 2, "{near} {told}");
        let inside = [0, 1, 2].map(|_| [24.5]);
        assert!(field.at([24.5; 3]).expect("inside").0 < 0.0 && field.nearer(&inside, field.steps(0.0)) == 1);
        assert_eq!(field.nearer(&[[f32::NAN; 1], [3.0; 1], [3.0; 1]], u32::MAX), 0);
    }
}
