//! Where a shape's surface is nearest to a point.

use nalgebra::Vector3;

/// The point of a surface that is nearest to a point asked for. All in the shape's own axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// On the surface, m.
    pub point: Vector3<f64>,
    /// Unit vector along which the signed distance grows: outward, from the surface towards a point outside.
    pub normal: Vector3<f64>,
    /// Signed distance of the point asked for, m: negative inside.
    pub distance: f64,
    /// Which triangle of a mesh or hull; 0 for shapes that have none.
    pub feature: u32,
    /// Weights of that triangle's three vertices in `point`; 1, 0, 0 for shapes that have none.
    pub weights: [f64; 3],
}

impl Surface {
    /// A place on a shape without triangles.
    pub(super) fn smooth(point: Vector3<f64>, normal: Vector3<f64>, distance: f64) -> Self {
        Self { point, normal, distance, feature: 0, weights: [1.0, 0.0, 0.0] }
    }
}
