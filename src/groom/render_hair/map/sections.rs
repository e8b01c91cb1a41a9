//! Maps a patch of scalp to the cross-section of the hair on it: rotates the scalp's normal to the hair's tangent along the
//! shortest arc. (A projection along the tangent would turn patches of hair that lies flat into ribbons.)

use nalgebra::{Matrix3, Vector3};

use crate::groom::render_hair::guides::shape::{N1, N2, Reference, Shape};
use crate::math::point_tree::PointTree;

/// Number of guide roots that determine the scalp's normal.
const NEIGHBOURS: usize = 10;
/// A patch whose second spread is less than this fraction of the first has no normal: its roots lie on a line.
const LINE: f64 = 1e-4;

/// The map from positions on the scalp to positions in a guide's section.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section {
    /// The directions, at binding, that become n1 and n2; `None` if the scalp's normal is unknown.
    rows: Option<[Vector3<f64>; 2]>,
    /// n1 and n2 at the guide's root, at binding.
    pub across: [Vector3<f64>; 2],
    /// The direction in the section along which it is flattened, times the amount.
    flattened: [f64; 2],
    along: [f64; 2],
}

impl Section {
    /// The position in the section of a root at this offset from the guide's, m.
    pub fn place(&self, away: Vector3<f64>) -> [f32; 2] {
        let [a, b] = match self.rows {
            Some([first, second]) => [first.dot(&away), second.dot(&away)],
            None => {
                // Without a normal: the least rotation that brings this root alone into the section.
                let [a, b] = self.across.map(|axis| axis.dot(&away));
                let size = (a * a + b * b).sqrt();
                let factor = if size > 1e-3 * away.norm() { away.norm() / size } else { 1.0 };
                [a * factor, b * factor]
            }
        };
        let along = a * self.along[0] + b * self.along[1];
        [(a - along * self.flattened[0]) as f32, (b - along * self.flattened[1]) as f32]
    }
}

/// The least rotation that takes the unit vector `from` to `to`, applied to any vector.
fn turned(vector: Vector3<f64>, from: Vector3<f64>, to: Vector3<f64>) -> Vector3<f64> {
    let (axis, cosine) = (from.cross(&to), from.dot(&to));
    if cosine < -1.0 + 1e-9 {
        return -vector;
    }
    vector + axis.cross(&vector) + axis.cross(&axis.cross(&vector)) / (1.0 + cosine)
}

/// Normals of the scalp at the guides: from the strands that follow them first, if those are known; else from the plane through
/// the roots around them, on the hair's side.
pub(super) fn normals(
    reference: &Reference,
    shape: &Shape,
    cells: &[Vec<u32>],
    roots: &[Vector3<f64>],
    given: Option<&[Vector3<f64>]>,
) -> Vec<Option<Vector3<f64>>> {
    let tree = PointTree::new(&reference.origins);
    let centre = reference.origins.iter().sum::<Vector3<f64>>() / reference.guides as f64;
    let tangents: Vec<Vector3<f64>> = (0..reference.guides).map(|guide| tangent(reference, shape, guide)).collect();
    let mut found = Vec::new();
    let mut of = |guide: usize| -> Option<Vector3<f64>> {
        if let Some(given) = given {
            let sum: Vector3<f64> = cells[guide].iter().map(|strand| given[*strand as usize]).sum();
            if let Some(normal) = sum.try_normalize(1e-9) {
                return Some(normal);
            }
        }
        tree.nearest(reference.origins[guide], NEIGHBOURS, &mut found);
        let near = || found.iter().map(|(_, other)| *other as usize);
        let places =
            || near().map(|other| reference.origins[other]).chain(cells[guide].iter().map(|strand| roots[*strand as usize]));
        let count = places().count() as f64;
        let middle = places().sum::<Vector3<f64>>() / count;
        let mut spread = Matrix3::zeros();
        places().for_each(|place| spread += (place - middle) * (place - middle).transpose());
        let size = spread.trace();
        if size <= 0.0 || size.is_nan() {
            return None;
        }
        let parts = (spread / size).try_symmetric_eigen(1e-14, 100)?;
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| parts.eigenvalues[*a].total_cmp(&parts.eigenvalues[*b]));
        if parts.eigenvalues[order[1]] < LINE * parts.eigenvalues[order[2]] {
            return None;
        }
        let normal: Vector3<f64> = parts.eigenvectors.column(order[0]).into();
        let outward = (reference.origins[guide] - centre).try_normalize(0.0).unwrap_or_default();
        let side = near().map(|other| tangents[other]).sum::<Vector3<f64>>() / found.len() as f64 + outward;
        Some(if normal.dot(&side) < 0.0 { -normal } else { normal })
    };
    (0..reference.guides).map(&mut of).collect()
}

/// A guide's direction at its root.
fn tangent(reference: &Reference, shape: &Shape, guide: usize) -> Vector3<f64> {
    let [n1, n2] = across(reference, shape, guide);
    n1.cross(&n2)
}

fn across(reference: &Reference, shape: &Shape, guide: usize) -> [Vector3<f64>; 2] {
    let rows = &shape.rows[guide * reference.size()..][..reference.size()];
    [N1, N2].map(|row| Vector3::from([0, 1, 2].map(|axis| f64::from(rows[(row + axis) * reference.stride]))))
}

/// The sections of all guides at binding.
pub(super) fn sections(reference: &Reference, shape: &Shape, normals: &[Option<Vector3<f64>>], flatness: f64) -> Vec<Section> {
    let of = |(guide, normal): (usize, &Option<Vector3<f64>>)| {
        let across = across(reference, shape, guide);
        let tangent = across[0].cross(&across[1]);
        let Some(normal) = normal else {
            return Section { rows: None, across, flattened: [0.0; 2], along: [0.0; 2] };
        };
        let lean = across.map(|axis| axis.dot(normal));
        let size = (lean[0] * lean[0] + lean[1] * lean[1]).sqrt();
        // Hair that stands on end has no flat side of its own.
        let along = if size > 1e-3 { lean.map(|value| value / size) } else { [1.0, 0.0] };
        let rows = Some(across.map(|axis| turned(axis, tangent, *normal)));
        Section { rows, across, flattened: along.map(|value| flatness * value), along }
    };
    normals.iter().enumerate().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_rotation_keeps_the_common_perpendicular() {
        let (from, to) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(-0.8, 0.6, 0.0));
        assert!((turned(from, from, to) - to).norm() < 1e-15);
        let axis = from.cross(&to);
        assert!((turned(axis, from, to) - axis).norm() < 1e-15);
        assert_eq!(turned(Vector3::x(), Vector3::z(), -Vector3::z()), -Vector3::x());
    }
}
