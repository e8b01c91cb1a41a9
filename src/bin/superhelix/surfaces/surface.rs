//! Surfaces of bodies as triangles, for pictures.

use nalgebra::Vector3;
use superhelix::shapes::DistanceGrid;

/// Triangles in a body's axes, wound outward.
#[derive(Debug, Clone, Default)]
pub struct Surface {
    /// Vertices, m.
    pub vertices: Vec<Vector3<f64>>,
    /// Three indices of vertices each.
    pub triangles: Vec<[u32; 3]>,
}

/// Rings from pole to pole, and points on each.
const RINGS: u32 = 24;
const AROUND: u32 = 48;

/// Half-spaces are drawn this large, m.
const HALF_SPACE: f64 = 2.0;

impl Surface {
    /// An ellipsoid about the origin.
    pub fn ellipsoid(semi_axes: Vector3<f64>) -> Self {
        Self::rings(|unit| unit.component_mul(&semi_axes))
    }

    /// A capsule.
    pub fn capsule(a: Vector3<f64>, b: Vector3<f64>, radius: f64) -> Self {
        let along = (b - a).normalize();
        let right = along.cross(&Vector3::ith(along.iamin(), 1.0)).normalize();
        let up = along.cross(&right);
        // The rings run along z: its lower half is drawn about a, its upper about b.
        Self::rings(|unit| {
            let middle = if unit.z > 0.0 { b } else { a };
            middle + (right * unit.x + up * unit.y + along * unit.z) * radius
        })
    }

    /// A box about the origin.
    pub fn cuboid(half_edges: Vector3<f64>) -> Self {
        let vertices = (0..8)
            .map(|corner: u32| {
                let side = |axis: u32| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
                Vector3::new(side(0), side(1), side(2)).component_mul(&half_edges)
            })
            .collect();
        let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        Self { vertices, triangles: faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect() }
    }

    /// As much of a half-space as a picture may show.
    pub fn half_space(normal: Vector3<f64>) -> Self {
        let normal = normal.normalize();
        let right = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
        let up = normal.cross(&right);
        let half = HALF_SPACE / 2.0;
        let mut block = Self::cuboid(Vector3::repeat(half));
        for vertex in &mut block.vertices {
            *vertex = right * vertex.x + up * vertex.y + normal * (vertex.z - half);
        }
        block
    }

    /// The sides of those cells about a grid's nodes that are inside: as coarse as the grid.
    pub fn grid(grid: &DistanceGrid) -> Self {
        let [nx, ny, nz] = grid.counts().map(|count| count as i64);
        let inside = |at: [i64; 3]| {
            let [x, y, z] = at;
            let there = (0..nx).contains(&x) && (0..ny).contains(&y) && (0..nz).contains(&z);
            there && grid.values()[((z * ny + y) * nx + x) as usize] < 0.0
        };
        let mut surface = Self::default();
        for z in 0..nz {
            for y in 0..ny {
                for x in (0..nx).filter(|x| inside([*x, y, z])) {
                    for (axis, sign) in (0..3).flat_map(|axis| [(axis, 1), (axis, -1)]) {
                        let mut beside = [x, y, z];
                        beside[axis] += sign;
                        if inside(beside) {
                            continue;
                        }
                        let middle = grid.low() + Vector3::new(x as f64, y as f64, z as f64) * grid.cell();
                        let half = |axis: usize| Vector3::ith(axis, 0.5 * grid.cell());
                        let (out, mut u, v) = (half(axis) * sign as f64, half((axis + 1) % 3), half((axis + 2) % 3));
                        u *= sign as f64;
                        let first = surface.vertices.len() as u32;
                        surface.vertices.extend([-u - v, u - v, u + v, v - u].map(|corner| middle + out + corner));
                        surface.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
                    }
                }
            }
        }
        surface
    }

    /// The unit sphere, with every vertex where `place` puts it.
    fn rings(place: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Self {
        let mut surface = Self::default();
        // Rings are numbered so that none lies on the equator: a capsule's halves part between two.
        for ring in 0..RINGS {
            let (sin, cos) = (std::f64::consts::PI * (f64::from(ring) / f64::from(RINGS - 1))).sin_cos();
            for point in 0..AROUND {
                let (y, x) = (std::f64::consts::TAU * f64::from(point) / f64::from(AROUND)).sin_cos();
                surface.vertices.push(place(Vector3::new(sin * x, sin * y, -cos)));
            }
        }
        for ring in 0..RINGS - 1 {
            for point in 0..AROUND {
                let next = (point + 1) % AROUND;
                let (a, b) = (ring * AROUND + point, ring * AROUND + next);
                surface.triangles.extend([[a, b, b + AROUND], [a, b + AROUND, a + AROUND]]);
            }
        }
        surface
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The volume within: wrong if a triangle is missing or wound inward.
    fn volume(surface: &Surface) -> f64 {
        let of = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| surface.vertices[vertex as usize]);
            a.dot(&b.cross(&c)) / 6.0
        };
        surface.triangles.iter().map(of).sum()
    }

    #[test]
    fn surfaces_are_closed_and_wound_outward() {
        let near = |surface: Surface, expected: f64| {
            let found = volume(&surface);
            assert!((found / expected - 1.0).abs() < 0.02, "{found} for {expected}");
        };
        let ball = 4.0 / 3.0 * std::f64::consts::PI;
        near(Surface::ellipsoid(Vector3::new(1.0, 2.0, 3.0)), 6.0 * ball);
        let (a, b) = (Vector3::new(0.3, 0.1, -1.0), Vector3::new(1.3, 0.1, 2.0));
        near(Surface::capsule(a, b, 0.5), 0.125 * ball + 0.25 * std::f64::consts::PI * (b - a).norm());
        near(Surface::cuboid(Vector3::new(1.0, 2.0, 3.0)), 48.0);
        near(Surface::half_space(Vector3::new(1.0, 2.0, 3.0)), HALF_SPACE.powi(3));
        let values = (0..125).map(|node: u32| if (node % 25).is_multiple_of(2) { -1.0 } else { 1.0 });
        let grid = DistanceGrid::from_parts(Vector3::zeros(), 0.5, 0.1, [5, 5, 5], values.collect()).unwrap();
        let inside = grid.values().iter().filter(|value| **value < 0.0).count();
        near(Surface::grid(&grid), 0.125 * inside as f64);
    }
}
