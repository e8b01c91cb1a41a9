//! Signed distance grid: a closed surface as distances at the nodes of a lattice, linear in between.

use nalgebra::Vector3;

use super::bake_open;
use super::bounds::Bounds;
use super::lattice::Lattice;
use super::mesh::{Mesh, Sides};
use super::surface::Surface;
use crate::error::{Error, Result, check_finite, check_positive};

/// Most nodes of a grid: 2²⁷, half a gigabyte.
pub const NODE_LIMIT: u64 = 1 << 27;

/// Signed distances on a lattice. Its surface is the zero level of their trilinear interpolation: edges of the mesh are rounded by about
/// a cell.
#[derive(Debug, Clone, PartialEq)]
pub struct DistanceGrid {
    low: Vector3<f64>,
    cell: f64,
    band: f64,
    counts: [u32; 3],
    values: Box<[f32]>,
}

impl DistanceGrid {
    /// Distances of a mesh at the nodes of a lattice of `cell` metres that reaches at least `band` metres beyond the mesh. A strand
    /// is told of the body within that band; inside at any depth.
    ///
    /// Of a [`Sides::Solid`] mesh the inside is known. Of another the inside is where its winding number is above one half, so that heads
    /// that are cut off at the neck, or whose parts do not quite meet, may be baked: an opening is closed by the surface on which the
    /// winding number is one half. Triangles must be wound anticlockwise seen from outside for the most part, those of a
    /// [`Sides::Both`] mesh all but a few either so or the other way.
    ///
    /// Takes one query of the mesh a node, about a microsecond each, and for meshes that are not solid its winding number, some
    /// microseconds; four bytes a node, and eight more while it is baked.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when the mesh is too open for an inside (of the nodes within two cells of it more than a fifth are
    /// neither inside nor outside by their winding numbers), `cell` or `band` is not finite and above zero, or there would be more than
    /// [`NODE_LIMIT`] nodes; [`Error::OutOfMemory`].
    pub fn bake(mesh: &Mesh, cell: f64, band: f64) -> Result<Self> {
        let (bounds, counts) = Self::lattice(mesh, cell, band)?;
        let lattice = Lattice { low: bounds.low, cell, counts };
        let values = if mesh.sides() == Sides::Solid { lattice.distances(mesh)? } else { bake_open::distances(&lattice, mesh)? };
        Ok(Self { low: bounds.low, cell, band, counts, values: values.into() })
    }

    /// How many nodes along x, y and z [`DistanceGrid::bake`] would make.
    ///
    /// # Errors
    /// Those of [`DistanceGrid::bake`] that `cell` and `band` are to blame for.
    pub fn baked_counts(mesh: &Mesh, cell: f64, band: f64) -> Result<[u32; 3]> {
        Ok(Self::lattice(mesh, cell, band)?.1)
    }

    /// The lattice for a mesh: its box, from whose lowest corner it begins, and its numbers of nodes.
    fn lattice(mesh: &Mesh, cell: f64, band: f64) -> Result<(Bounds, [u32; 3])> {
        check_positive(|| "cell".into(), cell)?;
        check_positive(|| "band".into(), band)?;
        // One cell more than asked for, so that all of the band is inside whatever the rounding.
        let bounds =
            Bounds::of_points(mesh.triangles().iter().flatten().map(|vertex| mesh.vertices()[*vertex as usize])).grown(band);
        let counts = ((bounds.high - bounds.low) / cell).map(|cells| cells.ceil() + 2.0);
        let nodes = counts.product();
        if nodes > NODE_LIMIT as f64 {
            return Err(Error::invalid(
                "cell",
                cell,
                format!("a cell size that gives at most {NODE_LIMIT} nodes; this one gives {nodes}"),
            ));
        }
        Ok((bounds, [counts.x as u32, counts.y as u32, counts.z as u32]))
    }

    /// A grid from its numbers: the lowest node (m), the cell size (m), how far it reaches beyond the surface (m), nodes along x, y
    /// and z, and the distances (m) with x running fastest.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when a number is not finite, a size is not above zero, there are fewer than two nodes along an axis,
    /// more than [`NODE_LIMIT`] in all, or another number of distances than nodes.
    pub fn from_parts(low: Vector3<f64>, cell: f64, band: f64, counts: [u32; 3], values: Box<[f32]>) -> Result<Self> {
        for axis in 0..3 {
            check_finite(|| format!("low[{axis}]"), low[axis])?;
            if counts[axis] < 2 {
                return Err(Error::invalid(format!("counts[{axis}]"), counts[axis], "two nodes or more"));
            }
        }
        check_positive(|| "cell".into(), cell)?;
        check_positive(|| "band".into(), band)?;
        let nodes = node_count(counts);
        if nodes.is_none_or(|nodes| nodes > NODE_LIMIT) {
            return Err(Error::invalid("counts", format!("{counts:?}"), format!("at most {NODE_LIMIT} nodes")));
        }
        if nodes != Some(values.len() as u64) {
            return Err(Error::invalid(
                "values",
                format!("{} long", values.len()),
                format!("a distance for each of {counts:?} nodes"),
            ));
        }
        if let Some(index) = values.iter().position(|value| !value.is_finite()) {
            return Err(Error::invalid(format!("values[{index}]"), values[index], "a finite number"));
        }
        Ok(Self { low, cell, band, counts, values })
    }

    /// The lowest node, m.
    pub fn low(&self) -> Vector3<f64> {
        self.low
    }

    /// Distance of neighbouring nodes, m.
    pub fn cell(&self) -> f64 {
        self.cell
    }

    /// How far the grid reaches beyond the surface, m.
    pub fn band(&self) -> f64 {
        self.band
    }

    /// Nodes along x, y and z.
    pub fn counts(&self) -> [u32; 3] {
        self.counts
    }

    /// Distances at the nodes, m; x runs fastest.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// The box of the nodes.
    pub fn bounds(&self) -> Bounds {
        let cells = Vector3::from(self.counts.map(|count| f64::from(count - 1)));
        Bounds { low: self.low, high: self.low + cells * self.cell }
    }

    /// The surface as seen from a point: the interpolated distance and its direction of steepest growth. None outside the grid, where
    /// the surface is farther than the band.
    pub fn closest(&self, point: Vector3<f64>) -> Option<Surface> {
        let place = (point - self.low) / self.cell;
        let mut base = [0usize; 3];
        let mut part = [0.0; 3];
        for axis in 0..3 {
            let last = f64::from(self.counts[axis] - 1);
            if !(place[axis] >= 0.0 && place[axis] <= last) {
                return None;
            }
            let floor = place[axis].floor().min(last - 1.0);
            base[axis] = floor as usize;
            part[axis] = place[axis] - floor;
        }
        let (row, sheet) = (self.counts[0] as usize, self.counts[0] as usize * self.counts[1] as usize);
        let first = base[0] + base[1] * row + base[2] * sheet;
        let value = |i: usize, j: usize, k: usize| f64::from(self.values[first + i + j * row + k * sheet]);
        let [x, y, z] = part;
        let mix = |a: f64, b: f64, u: f64| a + (b - a) * u;
        // Along x at the four edges, then along y at the two faces.
        let edge = [[0, 0], [1, 0], [0, 1], [1, 1]]
            .map(|[j, k]| (mix(value(0, j, k), value(1, j, k), x), value(1, j, k) - value(0, j, k)));
        let (low, high) = (mix(edge[0].0, edge[1].0, y), mix(edge[2].0, edge[3].0, y));
        let distance = mix(low, high, z);
        let gradient = Vector3::new(
            mix(mix(edge[0].1, edge[1].1, y), mix(edge[2].1, edge[3].1, y), z),
            mix(edge[1].0 - edge[0].0, edge[3].0 - edge[2].0, z),
            high - low,
        );
        let normal = gradient.try_normalize(0.0).unwrap_or_else(Vector3::x);
        Some(Surface::smooth(point - normal * distance, normal, distance))
    }

    /// A distance that the surface surely has from a point outside the grid, m.
    pub(in crate::contact) fn clearance(&self, point: &Vector3<f64>) -> f64 {
        self.bounds().grown(-self.band).distance(point)
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        size_of_val::<[f32]>(&self.values)
    }
}

/// How many nodes a grid has, unless beyond 2⁶⁴.
pub(crate) fn node_count(counts: [u32; 3]) -> Option<u64> {
    (u64::from(counts[0]) * u64::from(counts[1])).checked_mul(u64::from(counts[2]))
}
