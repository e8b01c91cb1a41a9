//! Winding numbers: how often a surface goes around a point, also a surface that is not quite closed.
//!
//! The generalised winding number (Jacobson, Kavan and Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding
//! numbers", 2013) is the solid angle under which the triangles are seen over 4π: 1 inside and 0 outside a closed surface, in between about
//! the rims of an open one. Far triangles are taken together as a dipole (Barill, Dickson, Schmidt, Levin and Jacobson, "Fast winding
//! numbers for soups and clouds", 2018).

use nalgebra::Vector3;

use crate::math::rotation::rough_arc_tangent;

/// Triangles are taken together that are seen from farther than so many times their ball's radius. The error is then of some thousandths,
/// where one half is what is asked for.
const FAR: f64 = 2.5;
/// Triangles of a leaf.
const LEAF: usize = 8;

/// Triangles seen as one from afar.
#[derive(Debug)]
struct Cluster {
    /// Mean of the triangles' centres by area, m.
    centre: Vector3<f64>,
    /// Of the ball about it that holds the triangles, m.
    radius: f64,
    /// Sum of the triangles' areas times normals, m².
    area: Vector3<f64>,
    /// Range of triangles.
    from: usize,
    to: usize,
    /// First of two clusters that it is made of; 0 for a leaf.
    children: usize,
}

/// A surface prepared for its winding numbers.
#[derive(Debug)]
pub(in crate::contact::shape) struct Winding {
    triangles: Vec<[Vector3<f64>; 3]>,
    clusters: Vec<Cluster>,
}

impl Winding {
    /// Prepares triangles, of which there is at least one.
    pub fn new(mut triangles: Vec<[Vector3<f64>; 3]>) -> Self {
        let mut clusters = vec![cluster(&triangles, 0, triangles.len())];
        let mut next = 0;
        while next < clusters.len() {
            let Cluster { from, to, .. } = clusters[next];
            if to - from > LEAF {
                let part = &mut triangles[from..to];
                let middles = part.iter().map(|corners| corners.iter().sum::<Vector3<f64>>());
                let (low, high) = middles
                    .fold((Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)), |(low, high), x| {
                        (low.inf(&x), high.sup(&x))
                    });
                let axis = (high - low).imax();
                let key = |corners: &[Vector3<f64>; 3]| corners[0][axis] + corners[1][axis] + corners[2][axis];
                let half = part.len() / 2;
                part.select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)));
                clusters[next].children = clusters.len();
                clusters.push(cluster(&triangles, from, from + half));
                clusters.push(cluster(&triangles, from + half, to));
            }
            next += 1;
        }
        Self { triangles, clusters }
    }

    /// The winding number about a point.
    pub fn at(&self, point: &Vector3<f64>) -> f64 {
        let mut angle = 0.0;
        let mut stack = [0; 64];
        let mut open = 1;
        while open > 0 {
            open -= 1;
            let cluster = &self.clusters[stack[open]];
            let offset = cluster.centre - point;
            let distance = offset.norm();
            if distance > FAR * cluster.radius {
                angle += cluster.area.dot(&offset) / (distance * distance * distance);
            } else if cluster.children == 0 {
                angle += self.triangles[cluster.from..cluster.to].iter().map(|corners| solid_angle(corners, point)).sum::<f64>();
            } else {
                // Halves: never deeper than the logarithm of their number.
                stack[open] = cluster.children;
                stack[open + 1] = cluster.children + 1;
                open += 2;
            }
        }
        angle / (4.0 * std::f64::consts::PI)
    }
}

fn cluster(triangles: &[[Vector3<f64>; 3]], from: usize, to: usize) -> Cluster {
    let part = &triangles[from..to];
    let (mut area, mut centre, mut whole) = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for [a, b, c] in part {
        let of = 0.5 * (b - a).cross(&(c - a));
        let size = of.norm();
        area += of;
        centre += (a + b + c) * (size / 3.0);
        whole += size;
    }
    let centre = if whole > 0.0 { centre / whole } else { part[0][0] };
    let radius = part.iter().flatten().map(|corner| (corner - centre).norm_squared()).fold(0.0, f64::max).sqrt();
    Cluster { centre, radius, area, from, to, children: 0 }
}

/// The solid angle under which a triangle is seen, positive from behind (van Oosterom and Strackee 1983).
fn solid_angle(corners: &[Vector3<f64>; 3], point: &Vector3<f64>) -> f64 {
    let [a, b, c] = corners.map(|corner| corner - point);
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let volume = a.dot(&b.cross(&c));
    let below = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
    if volume == 0.0 {
        return 0.0;
    }
    // The arc tangent of the quotient in the half plane where the sine is positive.
    let half = rough_arc_tangent(volume.abs(), below.abs());
    2.0 * (if below < 0.0 { std::f64::consts::PI - half } else { half }).copysign(volume)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An octahedron, wound outward, each face cut in four `levels` times and not rounded.
    fn octahedron(levels: usize) -> Vec<[Vector3<f64>; 3]> {
        let mut triangles = Vec::new();
        for corner in 0..8 {
            let sign = |bit: usize| if corner >> bit & 1 == 0 { 1.0 } else { -1.0 };
            let [a, b, c] = [Vector3::x() * sign(0), Vector3::y() * sign(1), Vector3::z() * sign(2)];
            triangles.push(if sign(0) * sign(1) * sign(2) > 0.0 { [a, b, c] } else { [a, c, b] });
        }
        for _ in 0..levels {
            triangles = triangles
                .iter()
                .flat_map(|[a, b, c]| {
                    let (ab, bc, ca) = (0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a));
                    [[*a, ab, ca], [*b, bc, ab], [*c, ca, bc], [ab, bc, ca]]
                })
                .collect();
        }
        triangles
    }

    #[test]
    fn it_is_one_inside_and_zero_outside() {
        let winding = Winding::new(octahedron(4));
        for k in 0..500 {
            let turn = f64::from(k);
            let direction = Vector3::new((1.3 * turn).sin(), (2.1 * turn).cos(), (0.7 * turn).sin());
            let point = direction / direction.abs().sum() * (0.05 + 1.9 * (turn / 500.0));
            let depth = 1.0 - point.abs().sum();
            if depth.abs() > 1e-6 {
                let expected = if depth > 0.0 { 1.0 } else { 0.0 };
                // What the dipoles of far triangles leave; a side is decided at one half.
                assert!((winding.at(&point) - expected).abs() < 0.03, "{point}: {}", winding.at(&point));
            }
        }
    }

    #[test]
    fn half_a_surface_is_seen_as_half() {
        // The upper half alone: from the middle of its rim's plane it fills half the sphere of directions.
        let half: Vec<_> = octahedron(3).into_iter().filter(|corners| corners.iter().sum::<Vector3<f64>>().z > 0.0).collect();
        assert!((Winding::new(half).at(&Vector3::zeros()) - 0.5).abs() < 5e-3);
    }
}
