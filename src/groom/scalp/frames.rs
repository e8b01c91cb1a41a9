//! Frames of follicles on the current scalp.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

use super::{Follicle, Scalp, check_vertices, double_area};
use crate::error::{Error, Result};
use crate::groom::curves::polyline::Polyline;
use crate::math::frame::Frame;
use crate::math::rotation::arc_tangent;

/// Normals and directions of u at the vertices.
pub(super) struct Field {
    pub normals: Vec<Vector3<f64>>,
    tangents: Vec<Vector3<f64>>,
}

impl Field {
    /// Sums over the triangles around each vertex of the current mesh, each weighted by its angle there (Thürmer and Wüthrich
    /// 1998).
    pub fn new(scalp: &Scalp, vertices: &[Vector3<f64>]) -> Self {
        let mut field =
            Self { normals: vec![Vector3::zeros(); vertices.len()], tangents: vec![Vector3::zeros(); vertices.len()] };
        for (index, triangle) in scalp.triangles.iter().enumerate() {
            let Some(normal) = double_area(vertices, triangle).try_normalize(0.0) else { continue };
            let corners = triangle.map(|vertex| vertices[vertex as usize]);
            let tangent = scalp.direction(index, &corners, &normal);
            for corner in 0..3 {
                let (ahead, back) = (corners[(corner + 1) % 3] - corners[corner], corners[(corner + 2) % 3] - corners[corner]);
                let (sine, cosine) = (ahead.cross(&back).norm(), ahead.dot(&back));
                let turn = arc_tangent(sine, cosine.abs());
                let angle = if cosine < 0.0 { std::f64::consts::PI - turn } else { turn };
                field.normals[triangle[corner] as usize] += normal * angle;
                field.tangents[triangle[corner] as usize] += tangent * angle;
            }
        }
        for normal in &mut field.normals {
            *normal = normal.try_normalize(1e-12).unwrap_or_default();
        }
        field
    }

    /// The unit normal at a follicle.
    pub fn normal(&self, scalp: &Scalp, vertices: &[Vector3<f64>], follicle: &Follicle) -> Vector3<f64> {
        let triangle = &scalp.triangles[follicle.triangle as usize];
        follicle
            .mix(triangle.map(|vertex| self.normals[vertex as usize]))
            .try_normalize(1e-12)
            .or_else(|| double_area(vertices, triangle).try_normalize(0.0))
            .unwrap_or_else(Vector3::z)
    }

    fn frame(&self, scalp: &Scalp, vertices: &[Vector3<f64>], follicle: &Follicle) -> Frame {
        let triangle = &scalp.triangles[follicle.triangle as usize];
        let normal = self.normal(scalp, vertices, follicle);
        let across = |tangent: Vector3<f64>| (tangent - normal * normal.dot(&tangent)).try_normalize(1e-9);
        let corners = scalp.corners(vertices, follicle.triangle);
        let rotation = across(follicle.mix(triangle.map(|vertex| self.tangents[vertex as usize])))
            .or_else(|| across(scalp.direction(follicle.triangle as usize, &corners, &normal)))
            .map(|n1| UnitQuaternion::from_rotation_matrix(&Rotation3::from_basis_unchecked(&[normal, n1, normal.cross(&n1)])))
            .unwrap_or_else(|| Polyline::frame_along(normal, None));
        Frame { origin: follicle.mix(corners), rotation }
    }
}

impl Scalp {
    /// The unit direction on a triangle in which the coordinate along grows; zero if there is none.
    fn direction(&self, triangle: usize, corners: &[Vector3<f64>; 3], normal: &Vector3<f64>) -> Vector3<f64> {
        let (e1, e2) = (corners[1] - corners[0], corners[2] - corners[0]);
        let u = self.along[triangle];
        let (u1, u2) = (u[1] - u[0], u[2] - u[0]);
        let direction = match self.across.get(triangle) {
            // dp/du: the direction in which the other coordinate stays the same.
            Some(v) => {
                let (v1, v2) = (v[1] - v[0], v[2] - v[0]);
                let turn = u1 * v2 - u2 * v1;
                (e1 * v2 - e2 * v1) * if turn == 0.0 { 0.0 } else { turn.signum() }
            }
            // The direction in which it grows fastest.
            None => normal.cross(&(e1 * u2 - e2 * u1)),
        };
        direction.try_normalize(0.0).unwrap_or_default()
    }

    /// The frames of follicles on the current scalp: `vertices` have the number and order of those at rest, m. n0 is the normal,
    /// n1 the direction of u (or of the scalp's reference axis), both as smooth over the mesh as at its vertices.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for another number of vertices, numbers that are not finite, follicles that are not on the
    /// scalp.
    pub fn frames(&self, vertices: &[Vector3<f64>], follicles: &[Follicle]) -> Result<Vec<Frame>> {
        if vertices.len() != self.vertices.len() {
            return Err(Error::invalid("vertices (count)", vertices.len(), format!("{}, as at rest", self.vertices.len())));
        }
        check_vertices(vertices)?;
        self.check_follicles("follicles", follicles)?;
        let field = Field::new(self, vertices);
        Ok(follicles.iter().map(|follicle| field.frame(self, vertices, follicle)).collect())
    }
}
