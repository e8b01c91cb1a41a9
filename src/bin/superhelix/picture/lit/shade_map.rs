//! How much of a light reaches a place: hairs that it crosses, counted in layers across its way (opacity shadow maps, Kim and Neumann 2001),
//! and bodies in its way (a shadow map).

use nalgebra::{Matrix3, Vector3};

use super::depth_map::{DepthMap, bounds};
use super::skin::Skin;
use super::threads::{Threads, taper};

/// What a distant light sees.
#[derive(Debug)]
pub struct ShadeMap {
    /// Right, up and towards the light, as rows.
    axes: Matrix3<f32>,
    hair: Layers,
    bodies: DepthMap,
}

/// Hairs between a node and the light: columns of nodes, the farthest first.
#[derive(Debug)]
struct Layers {
    low: Vector3<f32>,
    nodes_a_unit: Vector3<f32>,
    counts: [usize; 3],
    crossed: Vec<f32>,
}

/// Nodes about the hair on each side.
const BORDER: usize = 2;
/// Pieces that hair is counted in are at most about twice as long as this many cells.
const PIECE: f32 = 1.5;

impl ShadeMap {
    /// Looks from `light` (of length 1). `fine` is the number of nodes along the longest side of the hair, and half that of texels along
    /// the bodies'.
    pub fn new(light: Vector3<f32>, threads: &Threads, skins: &[Skin], fine: usize) -> Self {
        let right = light.cross(&Vector3::ith(light.iamin(), 1.0)).normalize();
        let axes = Matrix3::from_columns(&[right, light.cross(&right), light]).transpose();
        Self { axes, hair: Layers::of(threads, &axes, fine), bodies: DepthMap::of(skins, threads, &axes, 2 * fine) }
    }

    /// Hairs' widths that light crosses on its way to a place.
    pub fn crossed(&self, place: Vector3<f32>) -> f32 {
        self.hair.crossed(self.axes * place)
    }

    /// How much of the light bodies leave, 0 to 1.
    pub fn open(&self, place: Vector3<f32>) -> f32 {
        self.bodies.open(self.axes * place)
    }
}

impl Layers {
    fn of(threads: &Threads, axes: &Matrix3<f32>, fine: usize) -> Self {
        let turned: Vec<Vector3<f32>> = threads.points.iter().map(|point| axes * point).collect();
        let (low, high) = bounds(&turned);
        let room = fine - 2 * BORDER;
        let across = ((high - low).xy().max() / room as f32).max(f32::MIN_POSITIVE);
        let deep = across.max((high.z - low.z) / room as f32);
        let cell = Vector3::new(across, across, deep);
        let counts = [0, 1, 2].map(|axis| ((high[axis] - low[axis]) / cell[axis]).ceil() as usize + 2 * BORDER);
        let low = low - cell * BORDER as f32;
        let nodes_a_unit = cell.map(|side| 1.0 / side);
        let mut layers = Self { low, nodes_a_unit, counts, crossed: vec![0.0; counts.iter().product()] };
        for (range, width) in threads.strands() {
            let last = range.len() - 1;
            // Neighbouring edges that lie within a cell are taken as one.
            let whole: f32 = (turned[range.end - 1] - turned[range.start]).norm();
            let step = ((across * last as f32 / whole.max(f32::MIN_POSITIVE)) as usize).clamp(1, 4);
            for k in (0..last).step_by(step) {
                let end = (k + step).min(last);
                let (from, to) = (turned[range.start + k], turned[range.start + end]);
                let edge = to - from;
                // Seen from the light an edge is as long as it is across the light.
                let area = edge.xy().norm() * width * taper(k as f32 / last as f32);
                let pieces = ((edge.norm() / (PIECE * across)) as usize).clamp(1, fine);
                let share = area / (across * across) / pieces as f32;
                for piece in 0..pieces {
                    layers.add(from + edge * ((piece as f32 + 0.5) / pieces as f32), share);
                }
            }
        }
        for column in layers.crossed.chunks_exact_mut(counts[2]) {
            let mut nearer = 0.0;
            for node in column.iter_mut().rev() {
                let own = *node;
                *node = nearer + 0.5 * own;
                nearer += own;
            }
        }
        layers
    }

    /// The four columns about a place with their shares, the node below in each and how far the place is above it; none outside.
    #[inline]
    fn near(&self, place: Vector3<f32>) -> Option<([(usize, f32); 4], f32)> {
        let [nx, ny, nz] = self.counts;
        let x = (place.x - self.low.x) * self.nodes_a_unit.x;
        let y = (place.y - self.low.y) * self.nodes_a_unit.y;
        let z = (place.z - self.low.z) * self.nodes_a_unit.z;
        let inside = x >= 0.0 && y >= 0.0 && z >= 0.0 && x < (nx - 1) as f32 && y < (ny - 1) as f32 && z < (nz - 1) as f32;
        if !inside {
            return None;
        }
        let (column, row, node) = (x as usize, y as usize, z as usize);
        let (u, v) = (x - column as f32, y - row as f32);
        let first = (row * nx + column) * nz + node;
        let next = first + nx * nz;
        let shares = [(first, (1.0 - u) * (1.0 - v)), (first + nz, u * (1.0 - v)), (next, (1.0 - u) * v), (next + nz, u * v)];
        Some((shares, z - node as f32))
    }

    #[inline]
    fn add(&mut self, place: Vector3<f32>, amount: f32) {
        let Some((columns, above)) = self.near(place) else { return };
        for (node, share) in columns {
            let amount = amount * share;
            let pair = &mut self.crossed[node..node + 2];
            pair[0] += amount * (1.0 - above);
            pair[1] += amount * above;
        }
    }

    #[inline]
    fn crossed(&self, mut place: Vector3<f32>) -> f32 {
        // Half a layer towards the light, so that a hair does not shade itself; below the lowest layer there is no more hair.
        place.z = (place.z + 0.5 / self.nodes_a_unit.z).max(self.low.z);
        let Some((columns, above)) = self.near(place) else { return 0.0 };
        let mut sum = 0.0;
        for (node, share) in columns {
            let pair = &self.crossed[node..node + 2];
            sum += share * (pair[0] + (pair[1] - pair[0]) * above);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A curtain of parallel threads in the plane z = 0, of which neighbours leave `gap` widths free.
    fn curtain(gap: f32) -> Threads {
        let width = 0.001;
        let strands: Vec<Vec<[f32; 3]>> =
            (0..200).map(|k| (0..11).map(|j| [k as f32 * width * (1.0 + gap), j as f32 * 0.02, 0.0]).collect()).collect();
        Threads::new(&strands, width, |point| point)
    }

    #[test]
    fn a_curtain_is_crossed_once_by_what_it_covers() {
        let mut threads = curtain(1.0);
        threads.widths.fill(0.001);
        // Hair is counted in pieces: between them there is a little less.
        let mean = |map: &ShadeMap, behind: Vector3<f32>| {
            let places = (0..40).map(|k| Vector3::new(0.2, 0.04 + 0.001 * k as f32, 0.0) + behind);
            places.map(|place| map.crossed(place)).sum::<f32>() / 40.0
        };
        let map = ShadeMap::new(Vector3::z(), &threads, &[], 64);
        let behind = mean(&map, -Vector3::z());
        assert!((behind - 0.5).abs() < 0.03, "{behind}");
        assert_eq!(map.crossed(Vector3::new(0.2, 0.1, 1.0)), 0.0);
        assert_eq!(map.crossed(Vector3::new(0.2, 5.0, -1.0)), 0.0);
        let oblique = Vector3::new(0.0, 0.8, 0.6);
        // Light along the threads by 0.8 meets 0.6 of their length but through a pane that is as much smaller.
        let map = ShadeMap::new(oblique, &threads, &[], 64);
        let behind = mean(&map, -oblique * 0.05);
        assert!((behind - 0.5).abs() < 0.04, "{behind}");
    }

    #[test]
    fn bodies_shade_what_is_behind_them_and_not_their_own_face() {
        let threads = curtain(1.0);
        let ball = Skin::of(&crate::surfaces::surface::Surface::ellipsoid(nalgebra::Vector3::repeat(0.1)), |point| point);
        let map = ShadeMap::new(Vector3::x(), &threads, &[ball], 64);
        assert_eq!(map.open(Vector3::new(-0.2, 0.0, 0.0)), 0.0);
        assert_eq!(map.open(Vector3::new(0.2, 0.0, 0.0)), 1.0);
        assert_eq!(map.open(Vector3::new(0.1, 0.0, 0.0)), 1.0);
        assert_eq!(map.open(Vector3::new(-0.2, 0.2, 0.0)), 1.0);
    }
}
