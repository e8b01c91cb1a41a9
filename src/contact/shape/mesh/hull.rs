//! Convex hull of points, as a closed mesh.

use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;

use super::triangle_mesh::{Mesh, Sides};
use crate::error::{Error, Result, check_finite};

/// The hull of points.
///
/// # Errors
/// [`Error::InvalidArgument`] when a number is not finite, there are fewer than four points, or they span no volume.
pub(in crate::contact::shape) fn of_points(points: &[Vector3<f64>]) -> Result<Mesh> {
    for (index, point) in points.iter().enumerate() {
        for axis in 0..3 {
            check_finite(|| format!("points[{index}][{axis}]"), point[axis])?;
        }
    }
    if points.len() < 4 {
        return Err(Error::invalid("points", format!("{} long", points.len()), "four points or more"));
    }
    let flat =
        || Error::invalid("points", format!("{} points without a volume", points.len()), "points that are not all in one plane");
    if !spans_volume(points) {
        return Err(flat());
    }
    let list: Vec<Vector> = points.iter().map(|point| Vector::from_array((*point).into())).collect();
    let (vertices, triangles) = try_convex_hull(&list).map_err(|_| flat())?;
    let vertices = vertices.into_iter().map(|vertex| Vector3::from(vertex.to_array())).collect();
    Mesh::new(vertices, triangles, Sides::Solid).map_err(|_| flat())
}

/// Whether the points leave every plane by more than rounding, measured by their spread.
fn spans_volume(points: &[Vector3<f64>]) -> bool {
    let far = |from: &dyn Fn(&Vector3<f64>) -> f64| {
        points.iter().max_by(|a, b| from(a).total_cmp(&from(b))).copied().unwrap_or_default()
    };
    let first = points[0];
    let second = far(&|p| (p - first).norm_squared());
    let spread = (second - first).norm();
    let along = (second - first) / spread;
    let third = far(&|p| (p - first).cross(&along).norm_squared());
    let normal = along.cross(&(third - first));
    let width = normal.norm();
    let normal = normal / width;
    let height = points.iter().map(|p| (p - first).dot(&normal).abs()).fold(0.0, f64::max);
    spread > 0.0 && width > 1e-9 * spread && height > 1e-9 * spread
}
