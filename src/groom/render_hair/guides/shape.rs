//! The guides' shapes at one moment, in the form from which strands are mixed.
//!
//! A guide has parallel-transported frames (Bishop 1975): wisps keep their sections in them, and the guide's bends, the angles
//! from edge to edge, are expressed in them.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use super::guide_samples::GuideSamples;
use crate::groom::curves::polyline::Polyline;
use crate::groom::render_hair::points::quaternion::quaternion;
use crate::math::functions::trigonometry::sine_cosine;
use crate::math::rotation::arc_tangent;

/// Rows of a guide: positions relative to its root, and the frames' n1 and n2.
pub(in crate::groom::render_hair) const PLACE: usize = 0;
pub(in crate::groom::render_hair) const N1: usize = 3;
pub(in crate::groom::render_hair) const N2: usize = 6;
/// The total length of the edges from the root to a point.
pub(in crate::groom::render_hair) const ALONG: usize = 9;
/// Length of the edge from a point to the next.
pub(in crate::groom::render_hair) const LENGTH: usize = 10;
/// Rotation at a point from the edge before to the edge after it, along n1 and n2 of the edge before.
pub(in crate::groom::render_hair) const BEND: usize = 11;
/// The same with the curl's phase removed.
pub(in crate::groom::render_hair) const CURL: usize = 13;
/// Rows of a guide without and with the data for mixing curvatures.
const ROWS_OF_POSITIONS: usize = 10;
const ROWS_OF_CURVATURES: usize = 15;

/// What shapes at all moments share.
#[derive(Debug, Clone)]
pub(in crate::groom::render_hair) struct Reference {
    pub points: usize,
    /// Floats per row: the points, padded with zeros.
    pub stride: usize,
    pub guides: usize,
    /// The guides' points at binding.
    pub rest: Vec<Vector3<f64>>,
    /// The roots' positions at binding, and their rotations.
    pub origins: Vec<Vector3<f64>>,
    pub rotations: Vec<UnitQuaternion<f64>>,
    /// Whether the host gave the rotations.
    pub rotations_given: bool,
    /// Whether curvatures are mixed.
    pub curved: bool,
    /// Phases of the guides' curls, one row per guide; empty while unknown.
    pub phases: Vec<f32>,
}

impl Reference {
    /// From checked guides.
    pub fn new(samples: &GuideSamples, points: usize, guides: usize, curved: bool) -> Self {
        let origins: Vec<_> = (0..guides).map(|guide| samples.points[guide * points]).collect();
        let rotations = match samples.roots {
            Some(roots) => roots.to_vec(),
            None => samples
                .points
                .chunks(points)
                .map(|guide| {
                    let direction = first_direction(guide).unwrap_or_else(Vector3::z);
                    Polyline::frame_along(direction, None)
                })
                .collect(),
        };
        let rotations_given = samples.roots.is_some();
        let stride = points.next_multiple_of(8);
        let rest = samples.points.to_vec();
        Self { points, stride, guides, rest, origins, rotations, rotations_given, curved, phases: Vec::new() }
    }

    /// Floats per guide.
    pub fn size(&self) -> usize {
        self.stride * if self.curved { ROWS_OF_CURVATURES } else { ROWS_OF_POSITIONS }
    }
}

/// Guides at one moment.
#[derive(Debug, Clone, Default)]
pub(in crate::groom::render_hair) struct Shape {
    pub origins: Vec<Vector3<f64>>,
    /// The follicles' orientations: columns of rotation matrices.
    pub turns: Vec<[[f32; 3]; 3]>,
    pub rows: Vec<f32>,
    /// Quaternions of the frames on the guides' first edges, if curvatures are mixed.
    pub starts: Vec<[f32; 4]>,
}

fn first_direction(guide: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    guide.windows(2).find_map(|edge| (edge[1] - edge[0]).try_normalize(0.0))
}

/// The least rotation that takes the unit vector `from` to `to`, applied to a vector across `from`.
pub(super) fn carried(vector: Vector3<f64>, from: Vector3<f64>, to: Vector3<f64>) -> Vector3<f64> {
    let denominator = 1.0 + from.dot(&to);
    // A path that turns straight back does not determine an axis: what is across both stays.
    if denominator < 1e-9 { vector } else { vector - (from + to) * (to.dot(&vector) / denominator) }
}

/// A unit vector across `along`, near `wanted`.
fn across(wanted: Vector3<f64>, along: Vector3<f64>) -> Vector3<f64> {
    (wanted - along * along.dot(&wanted))
        .try_normalize(1e-12)
        .unwrap_or_else(|| Polyline::frame_along(along, None) * Vector3::y())
}

/// The angle between two unit vectors, and the axis times it.
fn turn(from: Vector3<f64>, to: Vector3<f64>) -> Vector3<f64> {
    let axis = from.cross(&to);
    let (sine, cosine) = (axis.norm(), from.dot(&to));
    if sine <= 0.0 {
        return Vector3::zeros();
    }
    let angle = arc_tangent(sine, cosine.abs());
    axis * (if cosine < 0.0 { std::f64::consts::PI - angle } else { angle } / sine)
}

/// The rotation about the points' centroid that best maps one set of points to another (Kabsch 1976; Horn 1987); `None` for
/// points on a line.
pub(super) fn closest_turn(from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Option<UnitQuaternion<f64>> {
    let middle = |points: &[Vector3<f64>]| points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let (a, b) = (middle(from), middle(to));
    let mut products = Matrix3::zeros();
    let (mut size_from, mut size_to) = (0.0, 0.0);
    for (p, q) in from.iter().zip(to) {
        products += (q - b) * (p - a).transpose();
        size_from += (p - a).norm_squared();
        size_to += (q - b).norm_squared();
    }
    let scale = (size_from * size_to).sqrt();
    if scale <= 0.0 {
        return None;
    }
    let parts = (products / scale).try_svd(true, true, 1e-14, 100)?;
    let (u, v_transposed) = (parts.u?, parts.v_t?);
    let mut values: [f64; 3] = parts.singular_values.into();
    values.sort_by(f64::total_cmp);
    // Two directions must be determined, each by more than rounding.
    if values[1] < 1e-9 {
        return None;
    }
    let mut signs = Vector3::repeat(1.0);
    if (u * v_transposed).determinant() < 0.0 {
        signs[parts.singular_values.imin()] = -1.0;
    }
    let rotation = nalgebra::Rotation3::from_matrix_unchecked(u * Matrix3::from_diagonal(&signs) * v_transposed);
    Some(UnitQuaternion::from_rotation_matrix(&rotation))
}

impl Shape {
    /// From checked guides, with the follicles' rotations.
    pub fn update(&mut self, reference: &Reference, points: &[Vector3<f64>], rotations: &[UnitQuaternion<f64>]) {
        self.origins.clear();
        self.turns.clear();
        self.rows.clear();
        self.starts.clear();
        self.rows.resize(reference.guides * reference.size(), 0.0);
        let mut room = Vec::new();
        for (guide, rotation) in rotations.iter().enumerate() {
            let points = &points[guide * reference.points..(guide + 1) * reference.points];
            self.origins.push(points[0]);
            let matrix = rotation.to_rotation_matrix();
            self.turns.push([0, 1, 2].map(|column| [0, 1, 2].map(|row| matrix[(row, column)] as f32)));
            let phases = reference.phases.get(guide * reference.stride..(guide + 1) * reference.stride);
            let rows = &mut self.rows[guide * reference.size()..(guide + 1) * reference.size()];
            let start = fill(reference, points, rotation, phases, rows, &mut room);
            if reference.curved {
                self.starts.push(start);
            }
        }
    }
}

/// Fills the rows of a guide, and returns the rotation of its first edge's frame.
fn fill(
    reference: &Reference,
    points: &[Vector3<f64>],
    rotation: &UnitQuaternion<f64>,
    phases: Option<&[f32]>,
    rows: &mut [f32],
    edges: &mut Vec<Vector3<f64>>,
) -> [f32; 4] {
    let (stride, last) = (reference.stride, points.len() - 1);
    let mut put = |row: usize, k: usize, vector: Vector3<f64>| {
        (0..3).for_each(|axis| rows[(row + axis) * stride + k] = vector[axis] as f32);
    };
    // Directions of the edges; one without length takes that of the edge before it.
    edges.clear();
    let mut direction = first_direction(points).unwrap_or_else(|| rotation * Vector3::x());
    for edge in points.windows(2) {
        direction = (edge[1] - edge[0]).try_normalize(0.0).unwrap_or(direction);
        edges.push(direction);
    }
    let mut tangent = edges[0];
    let mut n1 = across(carried(rotation * Vector3::y(), rotation * Vector3::x(), tangent), tangent);
    let start = n1;
    let single = |v: Vector3<f64>| -> [f32; 3] { v.map(|value| value as f32).into() };
    let first_frame = quaternion(single(tangent), single(n1), single(tangent.cross(&n1)));
    for k in 0..=last {
        let next = if k == 0 {
            edges[0]
        } else if k == last {
            edges[last - 1]
        } else {
            (edges[k - 1] + edges[k]).try_normalize(1e-9).unwrap_or(edges[k])
        };
        n1 = across(carried(n1, tangent, next), next);
        tangent = next;
        put(PLACE, k, points[k] - points[0]);
        put(N1, k, n1);
        put(N2, k, tangent.cross(&n1));
    }
    let mut along = 0.0;
    for k in 0..last {
        along += (points[k + 1] - points[k]).norm();
        rows[ALONG * stride + k + 1] = along as f32;
    }
    if !reference.curved {
        return first_frame;
    }
    let mut n1 = start;
    for k in 0..last {
        rows[LENGTH * stride + k] = (points[k + 1] - points[k]).norm() as f32;
        if k == 0 {
            continue;
        }
        let omega = turn(edges[k - 1], edges[k]);
        let (b1, b2) = (omega.dot(&n1), omega.dot(&edges[k - 1].cross(&n1)));
        rows[BEND * stride + k] = b1 as f32;
        rows[(BEND + 1) * stride + k] = b2 as f32;
        if let Some(phases) = phases {
            let (sine, cosine) = sine_cosine(f64::from(phases[k]));
            rows[CURL * stride + k] = (cosine * b1 + sine * b2) as f32;
            rows[(CURL + 1) * stride + k] = (cosine * b2 - sine * b1) as f32;
        }
        n1 = across(carried(n1, edges[k - 1], edges[k]), edges[k]);
    }
    first_frame
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rotation::from_rotation_vector;

    #[test]
    fn the_closest_turn_is_the_rigid_one() {
        let points: Vec<_> =
            (0..20).map(|k| Vector3::new(f64::from(k * 7 % 5), f64::from(k * 3 % 4), f64::from(k * k % 3))).collect();
        for vector in [Vector3::new(0.3, -1.2, 0.4), Vector3::new(0.0, 3.1, 0.0), Vector3::zeros()] {
            let rotation = from_rotation_vector(vector);
            let there: Vec<_> = points.iter().map(|p| rotation * p + Vector3::new(5.0, -3.0, 2.0)).collect();
            let found = closest_turn(&points, &there).expect("a turn");
            assert!(found.angle_to(&rotation) < 1e-7, "{}", found.angle_to(&rotation));
        }
        // Points in a plane determine the rotation as well; points on a line do not.
        let flat: Vec<_> = points.iter().map(|p| Vector3::new(p.x, p.y, 0.0)).collect();
        let rotation = from_rotation_vector(Vector3::new(0.5, 0.6, -0.7));
        let there: Vec<_> = flat.iter().map(|p| rotation * p).collect();
        assert!(closest_turn(&flat, &there).expect("a turn").angle_to(&rotation) < 1e-7);
        let line: Vec<_> = points.iter().map(|p| Vector3::new(p.x, 2.0 * p.x, 0.0)).collect();
        assert_eq!(closest_turn(&line, &line), None);
    }
}
