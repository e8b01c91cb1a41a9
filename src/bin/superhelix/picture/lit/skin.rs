//! The surface of a body, in a view's axes, with normals that are smooth where the surface is.

use nalgebra::Vector3;

use crate::surfaces::surface::Surface;

/// Cosine of the angle to the mean normal from which on a corner is an edge.
const EDGE: f32 = 0.6;

/// Triangles with normals, in file units.
#[derive(Debug)]
pub struct Skin {
    /// Right, up, towards the viewer.
    pub vertices: Vec<Vector3<f32>>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
    /// Of each triangle's corners, to the side that the viewer sees.
    pub normals: Vec<[Vector3<f32>; 3]>,
}

impl Skin {
    /// A body's surface as `look` sees it.
    pub fn of(surface: &Surface, look: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let vertices: Vec<Vector3<f32>> =
            surface.vertices.iter().map(|vertex| look((*vertex).map(|value| value as f32).into()).into()).collect();
        let triangles = surface.triangles.clone();
        let double_area = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
            (b - a).cross(&(c - a))
        };
        let mut mean = vec![Vector3::zeros(); vertices.len()];
        for triangle in &triangles {
            let normal = double_area(triangle);
            triangle.iter().for_each(|vertex| mean[*vertex as usize] += normal);
        }
        let normals = triangles
            .iter()
            .map(|triangle| {
                let flat = double_area(triangle).try_normalize(0.0).unwrap_or_else(Vector3::z);
                // What shows its back is lit as if that were its front.
                let side = if flat.z < 0.0 { -1.0 } else { 1.0 };
                triangle.map(|vertex| {
                    let smooth = mean[vertex as usize].try_normalize(0.0).unwrap_or(flat);
                    side * if smooth.dot(&flat) < EDGE { flat } else { smooth }
                })
            })
            .collect();
        Self { vertices, triangles, normals }
    }
}
