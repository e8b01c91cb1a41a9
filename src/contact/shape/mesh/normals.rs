//! Normals that tell a mesh's sides: of faces, edges and vertices.
//!
//! The nearest point of a mesh may lie on an edge or a vertex. Which side a point is on then follows from the sum of the two faces' normals,
//! and by that of all the vertex's faces weighted by their angle there (Bærentzen and Aanæs, "Signed distance computation using the
//! angle weighted pseudonormal", 2005).

use nalgebra::Vector3;

use super::triangle::Part;
use super::triangle_mesh::RIM;
use crate::math::rotation::arc_tangent;

/// Normals of a mesh's faces and vertices; those of edges are made when they are asked for.
#[derive(Debug, Clone, Default)]
pub(super) struct Normals {
    /// Unit; zero where a triangle has lost its area.
    faces: Vec<Vector3<f64>>,
    /// Of any length.
    vertices: Vec<Vector3<f64>>,
    /// Vertices on a rim.
    rim: Vec<bool>,
}

impl Normals {
    /// Computes them all.
    pub fn update(&mut self, vertices: &[Vector3<f64>], triangles: &[[u32; 3]], neighbours: &[[u32; 3]]) {
        self.faces.clear();
        self.vertices.clear();
        self.vertices.resize(vertices.len(), Vector3::zeros());
        self.rim.clear();
        self.rim.resize(vertices.len(), false);
        for (triangle, beside) in triangles.iter().zip(neighbours) {
            let corners = triangle.map(|vertex| vertices[vertex as usize]);
            let area = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
            let length = area.norm();
            let normal = if length > 0.0 { area / length } else { Vector3::zeros() };
            self.faces.push(normal);
            for corner in 0..3 {
                let (along, back) = (corners[(corner + 1) % 3] - corners[corner], corners[(corner + 2) % 3] - corners[corner]);
                let (sine, cosine) = (length, along.dot(&back));
                if sine > 0.0 {
                    let turn = arc_tangent(sine, cosine.abs());
                    let angle = if cosine < 0.0 { std::f64::consts::PI - turn } else { turn };
                    self.vertices[triangle[corner] as usize] += normal * angle;
                }
                if beside[corner] == RIM {
                    self.rim[triangle[corner] as usize] = true;
                    self.rim[triangle[(corner + 1) % 3] as usize] = true;
                }
            }
        }
    }

    /// The normal that tells the side at a part of a triangle, of any length, and whether the part lies on a rim.
    #[inline]
    pub fn at(&self, triangle: u32, corners: &[u32; 3], neighbours: &[u32; 3], part: Part) -> (Vector3<f64>, bool) {
        let face = self.faces[triangle as usize];
        match part {
            Part::Face => (face, false),
            Part::Edge(edge) => match neighbours[edge as usize] {
                RIM => (face, true),
                other => (face + self.faces[other as usize], false),
            },
            Part::Vertex(corner) => {
                let vertex = corners[corner as usize] as usize;
                (self.vertices[vertex], self.rim[vertex])
            }
        }
    }

    /// A face's unit normal.
    #[inline]
    pub fn face(&self, triangle: u32) -> Vector3<f64> {
        self.faces[triangle as usize]
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        (self.faces.capacity() + self.vertices.capacity()) * size_of::<Vector3<f64>>() + self.rim.capacity()
    }
}
