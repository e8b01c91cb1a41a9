//! The own shapes of strands: what each is at rest beside what its guides make of it, kept in the frames of its first guide.

use nalgebra::Vector3;

use super::curvature::{self, WIDTH};
use super::evaluate::{follow, roots};
use super::position::mix;
use crate::error::{Error, Result, check_finite};
use crate::groom::render_hair::RenderHair;
use crate::groom::render_hair::guides::shape::{N1, N2, Reference, Shape};
use crate::groom::render_hair::map::strand::RenderStrand;

/// Rows of a strand: away from what is mixed, along the tangent, n1 and n2 of the first guide (m); and the arclength at rest (m).
const ROWS: usize = 4;

/// The own shapes of all strands.
#[derive(Debug, Clone)]
pub(in crate::groom::render_hair) struct OwnShapes {
    /// For each strand its rows, each padded with zeros.
    rows: Vec<f32>,
}

/// Gives the strands of a map shapes of their own: while the guides are as they were at binding, each strand has the points of `shapes`
/// (m, one strand after the other, as many points each as the map has). When guides move, what distinguishes a strand from its guides goes
/// with the frames of the first one, and the strand keeps its own length. A strand that is cut short
/// ([`RenderSettings::length_variation`](crate::groom::render_hair::RenderSettings::length_variation)) is so along its own shape; wisps and straying, which
/// the shapes replace at rest, act only by how they change as guides move.
///
/// # Errors
/// [`Error::InvalidArgument`] for another number of points, or points that are not finite.
pub fn with_own_shapes(mut hair: RenderHair, shapes: &[Vector3<f64>]) -> Result<RenderHair> {
    let (points, wanted) = (hair.reference.points, hair.strands.len() * hair.reference.points);
    if shapes.len() != wanted {
        return Err(Error::invalid("shapes (points)", shapes.len(), format!("{wanted}, {points} for each strand")));
    }
    for (index, point) in shapes.iter().enumerate() {
        for axis in 0..3 {
            check_finite(|| format!("shapes[{index}][{axis}]"), point[axis])?;
        }
    }
    hair.own = Some(OwnShapes::of(&hair, &|strand| Some(shapes[strand * points..(strand + 1) * points].to_vec())));
    Ok(hair)
}

impl RenderHair {
    /// A copy of the map whose strands have shapes of their own: see [`with_own_shapes`].
    ///
    /// # Errors
    /// As [`with_own_shapes`]; [`Error::Unsupported`] where threads cannot be started. Keeps a host's parallel loop; creates a new pool.
    pub(crate) fn copied_with_own_shapes(&self, shapes: &[Vector3<f64>]) -> Result<Self> {
        let copy = Self::assembled(self.settings.clone(), self.reference.clone(), self.strands.clone(), self.curls.clone())?;
        with_own_shapes(copy, shapes)
    }
}

/// Calls `each` with every strand and its points as they are mixed while the guides are at rest: rows of x, y and z, relative to the origin
/// that is given with them.
fn mixed_at_rest(hair: &RenderHair, mut each: impl FnMut(usize, &Shape, Vector3<f64>, &[f32])) {
    let Reference { stride, curved, .. } = hair.reference;
    let mut shape = Shape::default();
    shape.update(&hair.reference, &hair.reference.rest, &hair.reference.rotations);
    let (mut rows, mut bends) = (vec![0.0; 4 * stride], curvature::Room::default());
    for first in (0..hair.strands.len()).step_by(WIDTH) {
        let strands = &hair.strands[first..(first + WIDTH).min(hair.strands.len())];
        if curved {
            curvature::bend(hair, &shape, strands, &hair.curls[first..first + strands.len()], &mut bends);
        }
        for (lane, strand) in strands.iter().enumerate() {
            let root = follow(&shape, strand);
            let bent = bends.places.get(3 * stride * lane..3 * stride * (lane + 1)).filter(|_| curved);
            mix(hair, &shape, strand, &roots(&shape, strand, root, root), bent, &mut rows);
            each(first + lane, &shape, root, &rows);
        }
    }
}

impl OwnShapes {
    /// From the points of each strand at rest; a strand without any is as it is mixed.
    fn of(hair: &RenderHair, points_of: &dyn Fn(usize) -> Option<Vec<Vector3<f64>>>) -> Self {
        let Reference { stride, points, .. } = hair.reference;
        let mut all = vec![0.0; ROWS * stride * hair.strands.len()];
        mixed_at_rest(hair, |strand, shape, origin, mixed| {
            let own = &mut all[ROWS * stride * strand..][..ROWS * stride];
            let place = |k: usize| Vector3::new(mixed[k], mixed[stride + k], mixed[2 * stride + k]);
            let wanted: Vec<Vector3<f32>> = match points_of(strand) {
                Some(wanted) => wanted.iter().map(|point| (point - origin).map(|value| value as f32)).collect(),
                None => (0..points).map(place).collect(),
            };
            let mut along = 0.0;
            for k in 0..points {
                let away = wanted[k] - place(k);
                let axes = axes(&hair.reference, shape, &hair.strands[strand], k);
                (0..3).for_each(|row| own[row * stride + k] = axes[row].dot(&away));
                own[3 * stride + k] = along;
                along += wanted.get(k + 1).map_or(0.0, |next| (next - wanted[k]).norm());
            }
        });
        Self { rows: all }
    }

    /// Adds a strand's own shape to its points as they are mixed, rows of x, y and z, and puts its own arclengths into the row after them.
    #[inline(always)]
    pub fn add(&self, reference: &Reference, shape: &Shape, index: usize, strand: &RenderStrand, rows: &mut [f32]) {
        let (stride, size) = (reference.stride, reference.size());
        let own = &self.rows[ROWS * stride * index..][..ROWS * stride];
        let (along, rest) = own.split_at(stride);
        let (across1, rest) = rest.split_at(stride);
        let (across2, lengths) = rest.split_at(stride);
        let guide = &shape.rows[strand.guides[0] as usize * size..][..size];
        for axis in 0..3 {
            let row = |first: usize, axis: usize| &guide[(first + axis) * stride..][..stride];
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            let (n1, n2) = (row(N1, axis), row(N2, axis));
            let (a, b, c, d) = (row(N1, next), row(N2, last), row(N1, last), row(N2, next));
            let out = &mut rows[axis * stride..][..stride];
            for k in 0..stride {
                // The tangent is n1 × n2.
                let tangent = a[k] * b[k] - c[k] * d[k];
                out[k] += along[k] * tangent + across1[k] * n1[k] + across2[k] * n2[k];
            }
        }
        rows[3 * stride..4 * stride].copy_from_slice(lengths);
    }

    /// The same for the strands of a map of other guides: those of `changed` at rest where they were.
    pub fn rebound(&self, old: &RenderHair, new: &RenderHair, changed: &[usize]) -> Self {
        let Reference { stride, points, .. } = old.reference;
        let mut rest = vec![Vec::new(); old.strands.len()];
        mixed_at_rest(old, |strand, shape, origin, mixed| {
            if changed.binary_search(&strand).is_ok() {
                let mut rows = mixed.to_vec();
                self.add(&old.reference, shape, strand, &old.strands[strand], &mut rows);
                let place = |k: usize| origin + Vector3::new(rows[k], rows[stride + k], rows[2 * stride + k]).map(f64::from);
                rest[strand] = (0..points).map(place).collect();
            }
        });
        let mut made = Self::of(new, &|strand| Some(rest[strand].clone()).filter(|points| !points.is_empty()));
        let size = ROWS * stride;
        for strand in (0..old.strands.len()).filter(|strand| changed.binary_search(strand).is_err()) {
            made.rows[size * strand..][..size].copy_from_slice(&self.rows[size * strand..][..size]);
        }
        made
    }

    /// All numbers but padding, for files.
    pub fn numbers<'a>(&'a self, reference: &Reference) -> impl Iterator<Item = &'a f32> + use<'a> {
        let points = reference.points;
        self.rows.chunks(reference.stride).flat_map(move |row| &row[..points])
    }

    /// From these numbers of so many strands; `None` for another number of them.
    pub fn from_numbers(reference: &Reference, strands: usize, numbers: &[f32]) -> Option<Self> {
        if numbers.len() != ROWS * reference.points * strands {
            return None;
        }
        let mut rows = vec![0.0; ROWS * reference.stride * strands];
        for (row, numbers) in rows.chunks_mut(reference.stride).zip(numbers.chunks(reference.points)) {
            row[..reference.points].copy_from_slice(numbers);
        }
        Some(Self { rows })
    }

    /// Memory, bytes.
    pub fn memory_usage(&self) -> usize {
        4 * self.rows.capacity()
    }
}

/// The tangent, n1 and n2 of a strand's first guide at a point.
fn axes(reference: &Reference, shape: &Shape, strand: &RenderStrand, point: usize) -> [Vector3<f32>; 3] {
    let guide = &shape.rows[strand.guides[0] as usize * reference.size()..][..reference.size()];
    let vector = |row: usize| Vector3::from([0, 1, 2].map(|axis| guide[(row + axis) * reference.stride + point]));
    let (n1, n2) = (vector(N1), vector(N2));
    [n1.cross(&n2), n1, n2]
}
