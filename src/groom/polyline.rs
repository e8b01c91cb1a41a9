//! A polyline by arclength: what a strand is fitted to.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

use crate::error::{Error, Result, check_finite};

/// Distinct points and the arclength at each.
#[derive(Debug, Clone)]
pub(super) struct Polyline {
    pub points: Vec<Vector3<f64>>,
    pub arclengths: Vec<f64>,
}

/// A polyline whose edges sum to less than this cannot be told from a point in f64 arithmetic on metres.
const SHORTEST: f64 = 1e-12;

impl Polyline {
    /// Checks the points and drops the doubled ones.
    pub fn new(points: &[Vector3<f64>]) -> Result<Self> {
        let mut kept: Vec<Vector3<f64>> = Vec::with_capacity(points.len());
        let mut arclengths = Vec::with_capacity(points.len());
        let mut length = 0.0;
        for (index, point) in points.iter().enumerate() {
            for axis in 0..3 {
                check_finite(|| format!("points[{index}][{axis}]"), point[axis])?;
            }
            match kept.last() {
                None => {}
                Some(last) => {
                    let edge = (point - last).norm();
                    if edge == 0.0 {
                        continue;
                    }
                    length += edge;
                }
            }
            kept.push(*point);
            arclengths.push(length);
        }
        if kept.len() < 2 || !(length > SHORTEST && length.is_finite()) {
            return Err(Error::invalid(
                "points",
                format!("{} points, {} of them distinct, of length {length} m", points.len(), kept.len()),
                format!("a polyline of at least two distinct points, longer than {SHORTEST} m"),
            ));
        }
        Ok(Self { points: kept, arclengths })
    }

    pub fn length(&self) -> f64 {
        self.arclengths[self.arclengths.len() - 1]
    }

    /// The point at an arclength, held at both ends.
    pub fn at(&self, arclength: f64) -> Vector3<f64> {
        let next = self.arclengths.partition_point(|s| *s < arclength).clamp(1, self.points.len() - 1);
        let (s0, s1) = (self.arclengths[next - 1], self.arclengths[next]);
        let u = ((arclength - s0) / (s1 - s0)).clamp(0.0, 1.0);
        self.points[next - 1] + (self.points[next] - self.points[next - 1]) * u
    }

    /// Direction of edge `index`.
    pub fn direction(&self, index: usize) -> Vector3<f64> {
        (self.points[index + 1] - self.points[index]).normalize()
    }

    /// Number of edges.
    pub fn edge_count(&self) -> usize {
        self.points.len() - 1
    }

    /// A frame at the root: n0 along the first edge, n1 as near as can be to a world axis that the edge is far from.
    pub fn root_rotation(&self) -> UnitQuaternion<f64> {
        let n0 = self.direction(0);
        let axis = if n0.x.abs() <= n0.y.abs() && n0.x.abs() <= n0.z.abs() {
            Vector3::x()
        } else if n0.y.abs() <= n0.z.abs() {
            Vector3::y()
        } else {
            Vector3::z()
        };
        let n1 = (axis - n0 * n0.dot(&axis)).normalize();
        let n2 = n0.cross(&n1);
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_basis_unchecked(&[n0, n1, n2]))
    }

    /// Turning at each inner point as rotation vectors in frames carried along without twist from `root`, with the arclength of the point.
    pub fn turnings(&self, root: UnitQuaternion<f64>) -> Vec<(f64, Vector3<f64>)> {
        let mut frame = root;
        let mut out = Vec::with_capacity(self.edge_count());
        let first = UnitQuaternion::rotation_between(&(frame * Vector3::x()), &self.direction(0));
        frame = first.map_or(frame, |turn| turn * frame);
        for edge in 1..self.edge_count() {
            let (from, to) = (self.direction(edge - 1), self.direction(edge));
            // Back along itself there is no least rotation: any axis across will do.
            let turn = UnitQuaternion::rotation_between(&from, &to)
                .unwrap_or_else(|| UnitQuaternion::from_scaled_axis(frame * Vector3::y() * std::f64::consts::PI));
            out.push((self.arclengths[edge], frame.inverse() * turn.scaled_axis()));
            frame = turn * frame;
        }
        out
    }
}
