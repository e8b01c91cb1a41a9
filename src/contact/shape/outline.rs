//! Outlines: a shape as a few segments, for debug drawing.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::primitive::capsule::across;
use super::{Kind, Mesh, Shape};
use crate::math::functions::trigonometry::sine_cosine;

/// Segments of a circle.
const SEGMENTS: usize = 24;
/// Half the edge of the square that stands for a half-space, m.
const SQUARE: f64 = 0.5;

impl Shape {
    /// Segments that show the shape, in its own axes (m): circles of spheres, ellipsoids and capsules, edges of boxes, hulls and meshes (at their
    /// present vertices), a square of 1 m with its normal for a half-space, and of a distance grid the box around its nodes.
    pub fn outline(&self, mut segment: impl FnMut(Vector3<f64>, Vector3<f64>)) {
        let segment = &mut segment;
        match &self.0 {
            Kind::Sphere { radius } => great_circles(&Vector3::repeat(*radius), segment),
            Kind::Ellipsoid { semi_axes } => great_circles(semi_axes, segment),
            Kind::Capsule { a, b, radius } => capsule(a, b, *radius, segment),
            Kind::Cuboid { half_edges } => cuboid(-half_edges, *half_edges, segment),
            Kind::HalfSpace { normal } => half_space(normal, segment),
            Kind::Hull(mesh) | Kind::Mesh(mesh) => edges(mesh, segment),
            Kind::Grid(grid) => {
                let size = grid.counts().map(|count| f64::from(count - 1) * grid.cell());
                cuboid(grid.low(), grid.low() + Vector3::from(size), segment);
            }
        }
    }
}

/// An arc of an ellipse about a centre, of the two semi-axes, over a fraction of its circle.
fn arc(centre: Vector3<f64>, axes: [Vector3<f64>; 2], of: f64, segment: &mut impl FnMut(Vector3<f64>, Vector3<f64>)) {
    let count = (of * SEGMENTS as f64) as usize;
    let at = |k: usize| {
        let (sin, cos) = sine_cosine(TAU * k as f64 / SEGMENTS as f64);
        centre + axes[0] * cos + axes[1] * sin
    };
    (0..count).for_each(|k| segment(at(k), at(k + 1)));
}

fn great_circles(semi_axes: &Vector3<f64>, segment: &mut impl FnMut(Vector3<f64>, Vector3<f64>)) {
    let axis = |k: usize| Vector3::ith(k % 3, semi_axes[k % 3]);
    (0..3).for_each(|k| arc(Vector3::zeros(), [axis(k), axis(k + 1)], 1.0, segment));
}

fn capsule(a: &Vector3<f64>, b: &Vector3<f64>, radius: f64, segment: &mut impl FnMut(Vector3<f64>, Vector3<f64>)) {
    let along = (b - a).normalize() * radius;
    let side = across(&along) * radius;
    let other = along.cross(&side) / radius;
    for (end, out) in [(a, -along), (b, along)] {
        arc(*end, [side, other], 1.0, segment);
        arc(*end, [side, out], 0.5, segment);
        arc(*end, [other, out], 0.5, segment);
    }
    [side, other, -side, -other].into_iter().for_each(|out| segment(a + out, b + out));
}

fn cuboid(low: Vector3<f64>, high: Vector3<f64>, segment: &mut impl FnMut(Vector3<f64>, Vector3<f64>)) {
    let corner = |bits: usize| Vector3::from_fn(|axis, _| if bits >> axis & 1 == 1 { high[axis] } else { low[axis] });
    for bits in 0..8 {
        (0..3).filter(|axis| bits >> axis & 1 == 0).for_each(|axis| segment(corner(bits), corner(bits | 1 << axis)));
    }
}

fn half_space(normal: &Vector3<f64>, segment: &mut impl FnMut(Vector3<f64>, Vector3<f64>)) {
    let side = across(normal) * SQUARE;
    let other = normal.cross(&side);
    let corners = [side + other, other - side, -side - other, side - other];
    (0..4).for_each(|k| segment(corners[k], corners[(k + 1) % 4]));
    segment(Vector3::zeros(), normal * SQUARE);
}

/// Each edge once.
fn edges(mesh: &Mesh, segment: &mut impl FnMut(Vector3<f64>, Vector3<f64>)) {
    let vertices = mesh.vertices();
    for (triangle, (corners, neighbours)) in mesh.triangles().iter().zip(&mesh.neighbours).enumerate() {
        for k in 0..3 {
            // An edge with a neighbour belongs to the first of the two; a rim, which is none, comes after all triangles.
            if neighbours[k] as usize > triangle {
                segment(vertices[corners[k] as usize], vertices[corners[(k + 1) % 3] as usize]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::shape::Sides;

    fn outline(shape: &Shape) -> Vec<[Vector3<f64>; 2]> {
        let mut all = Vec::new();
        shape.outline(|a, b| all.push([a, b]));
        all
    }

    /// Ends of segments lie on the surface.
    #[test]
    fn outlines_lie_on_their_shapes() {
        let corners: Vec<_> = (0..8).map(|k| Vector3::from_fn(|axis, _| f64::from(k >> axis & 1))).collect();
        let shapes = [
            Shape::new_sphere(0.3).unwrap(),
            Shape::new_ellipsoid(Vector3::new(0.1, 0.2, 0.3)).unwrap(),
            Shape::new_capsule(Vector3::new(0.1, 0.0, 0.2), Vector3::new(-0.3, 0.5, 0.0), 0.05).unwrap(),
            Shape::new_box(Vector3::new(0.1, 0.2, 0.3)).unwrap(),
            Shape::new_hull(&corners).unwrap(),
        ];
        for shape in &shapes {
            let segments = outline(shape);
            assert!(segments.len() >= 12, "{shape:?}");
            for end in segments.iter().flatten() {
                let surface = shape.closest(*end, 1.0).expect("a surface");
                assert!(surface.distance.abs() < 1e-12, "{shape:?}: {}", surface.distance);
            }
        }
    }

    #[test]
    fn every_edge_of_a_mesh_is_listed_once() {
        let vertices = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::x() + Vector3::y()];
        let square = Shape::new_mesh(vertices, vec![[0, 1, 2], [1, 3, 2]], Sides::Both).unwrap();
        assert_eq!(outline(&square).len(), 5);
        assert_eq!(outline(&Shape::new_box(Vector3::repeat(1.0)).unwrap()).len(), 12);
    }
}
