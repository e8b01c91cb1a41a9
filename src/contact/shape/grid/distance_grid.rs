//! Signed distance grid: a closed surface as distances at the nodes of a lattice, cubic in between.

use nalgebra::Vector3;

use super::bake_open;
use super::hessian_bounds::HessianBounds;
use super::lattice::Lattice;
use super::planes::{PlaneField, Planes};
use super::tricubic::Tricubic;
use crate::contact::shape::{Bounds, Mesh, Sides, Surface};
use crate::error::{Error, Result, check_finite, check_positive};
use crate::math::lane::Lane;
use crate::math::lanes::{KernelOfFour, call_of_four};
use crate::math::vector::Vec3;

/// Most nodes of a grid: 2²⁷, half a gigabyte.
pub const NODE_LIMIT: u64 = 1 << 27;

/// Signed distances on a lattice. Its surface is the zero level of their tricubic interpolation: edges of the mesh are rounded by about
/// a cell.
#[derive(Debug, Clone, PartialEq)]
pub struct DistanceGrid {
    low: Vector3<f64>,
    cell: f64,
    band: f64,
    counts: [u32; 3],
    values: Box<[f32]>,
    planes: Planes,
    hessian_bounds: HessianBounds,
}

impl DistanceGrid {
    /// Distances of a mesh at the nodes of a lattice of `cell` metres that reaches at least `band` metres beyond the mesh. A strand
    /// meets the body within that band; inside at any depth.
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
    /// [`Error::InvalidArgument`] when the mesh is too open for an inside (of the nodes within two cells of it, but not on
    /// it, more than a fifth are neither inside nor outside by their winding numbers, or none at all is inside), `cell` or `band` is not finite and above zero, or there would be more than
    /// [`NODE_LIMIT`] nodes; [`Error::OutOfMemory`].
    pub fn bake(mesh: &Mesh, cell: f64, band: f64) -> Result<Self> {
        let (bounds, counts) = Self::lattice(mesh, cell, band)?;
        let lattice = Lattice { low: bounds.low, cell, counts };
        let values = if mesh.sides() == Sides::Solid { lattice.distances(mesh)? } else { bake_open::distances(&lattice, mesh)? };
        Ok(Self {
            low: bounds.low,
            cell,
            band,
            counts,
            values: values.into(),
            planes: Planes::default(),
            hessian_bounds: HessianBounds::default(),
        })
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
        Ok(Self { low, cell, band, counts, values, planes: Planes::default(), hessian_bounds: HessianBounds::default() })
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

    /// The surface as seen from a point: the interpolated distance and its direction of steepest growth, which has no jumps. None outside
    /// the grid, where the surface is farther than the band.
    pub fn closest(&self, point: Vector3<f64>) -> Option<Surface> {
        let (distance, gradient) = call_of_four(Interpolate { grid: self, point })?;
        let normal = gradient.try_normalize(0.0).unwrap_or_else(Vector3::x);
        Some(Surface::smooth(point - normal * distance, normal, distance))
    }

    /// The same if the surface is nearer than `within` (m); else a distance that it surely has, m. `slope` bounds the field's.
    pub(in crate::contact::shape) fn closest_within(
        &self,
        point: Vector3<f64>,
        within: f64,
        slope: f64,
    ) -> std::result::Result<Surface, f64> {
        let outside = || self.clearance(&point);
        let least = self.by_node(&point, slope).ok_or_else(outside)?;
        if least >= within {
            return Err(least);
        }
        let surface = self.closest(point).ok_or_else(outside)?;
        if surface.distance < within { Ok(surface) } else { Err(surface.distance) }
    }

    /// Distances that the surface surely has from places, m: from the nearest nodes alone. `slope` bounds the field's.
    #[inline(always)]
    pub(in crate::contact::shape) fn at_least<T: Lane>(&self, places: &Vec3<T>, slope: f64) -> T {
        let (mut least, outside) = self.by_nodes(places, slope);
        if outside != 0 {
            for lane in (0..T::LANES).filter(|lane| outside >> lane & 1 == 1) {
                least.set_lane(lane, self.clearance(&places.lane(lane).into()));
            }
        }
        least
    }

    /// The interpolated distance, m; `within` where the nearest node tells that it is no less; outside the grid what is surely there. `slope` bounds the
    /// field's.
    pub(in crate::contact::shape) fn distance(&self, point: Vector3<f64>, within: f64, slope: f64) -> f64 {
        if self.by_node(&point, slope).is_some_and(|at_least| at_least >= within) {
            return within;
        }
        self.closest(point).map_or_else(|| self.clearance(&point), |surface| surface.distance)
    }

    /// A place in cells from the lowest node.
    #[inline(always)]
    fn place(&self, point: &Vector3<f64>) -> Vector3<f64> {
        (point - self.low) / self.cell
    }

    #[inline(always)]
    fn field(&self) -> Tricubic<'_> {
        Tricubic { values: &self.values, counts: self.counts }
    }

    /// A distance that the surface surely has from a point, m, by the nearest node alone; None outside the grid. `slope` bounds the field's.
    #[inline(always)]
    fn by_node(&self, point: &Vector3<f64>, slope: f64) -> Option<f64> {
        let (least, outside) = self.by_nodes::<f64>(&(*point).into(), slope);
        (outside == 0).then_some(least)
    }

    /// The same for places in lanes, with a bit for each that is outside the grid.
    #[inline(always)]
    fn by_nodes<T: Lane>(&self, places: &Vec3<T>, slope: f64) -> (T, u32) {
        let [x, y, z] = (*places - Vec3::splat(self.low.into())).0;
        let (cell, count) = (T::splat(self.cell), |axis: usize| T::splat(f64::from(self.counts[axis])));
        let cells = Vec3([x / cell, y / cell, z / cell]);
        let mut outside = 0;
        for (axis, along) in cells.0.iter().enumerate() {
            outside |= T::bits(along.less(T::zero())) | T::bits((count(axis) - T::one()).less(*along));
        }
        let [i, j, k] = [cells.0[0].round(), cells.0[1].round(), cells.0[2].round()];
        let index = i + count(0) * (j + count(1) * k);
        // (Of places outside, and of what is no number, any node.)
        let nodes = T::from_lanes(|lane| self.values.get(index.lane(lane) as usize).map_or(f64::NAN, |node| f64::from(*node)));
        (nodes - (cells - Vec3([i, j, k])).norm_squared().sqrt() * T::splat(slope * self.cell), outside)
    }

    /// An upper bound on the norm of the field's Hessian within `reach` metres of a point, 1/m: the gradient changes no faster. None where that leaves the
    /// grid, or is too far.
    pub(in crate::contact) fn hessian_bound(&self, point: &Vector3<f64>, reach: f64) -> Option<f64> {
        self.hessian_bounds.about(self, &self.place(point), reach / self.cell)
    }

    /// The field's value (m) and gradient at a point; None outside the grid.
    pub(in crate::contact) fn with_gradient(&self, point: &Vector3<f64>) -> Option<(f64, Vector3<f64>)> {
        call_of_four(Interpolate { grid: self, point: *point }).map(|(value, gradient)| (value, gradient / self.cell))
    }

    /// A distance that the surface surely has from a point outside the grid, m.
    pub(in crate::contact) fn clearance(&self, point: &Vector3<f64>) -> f64 {
        self.bounds().grown(-self.band).distance(point)
    }

    /// The field to first order about the nearest node, for very many points: off by what it bends over half a cell. Takes some
    /// nanoseconds a node, and 8 bytes, when it is first asked for.
    pub(crate) fn planes(&self) -> PlaneField<'_> {
        PlaneField::new(&self.planes, self)
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        size_of_val::<[f32]>(&self.values) + self.planes.heap_bytes() + self.hessian_bounds.heap_bytes()
    }
}

/// The field's value, and its slopes in cells, at a point; None outside the grid.
struct Interpolate<'a> {
    grid: &'a DistanceGrid,
    point: Vector3<f64>,
}

impl KernelOfFour for Interpolate<'_> {
    type Output = Option<(f64, Vector3<f64>)>;

    #[inline(always)]
    fn run<T: Lane, const REGISTERS: usize>(self) -> Self::Output {
        self.grid.field().at::<T, REGISTERS>(&self.grid.place(&self.point))
    }
}

/// How many nodes a grid has, unless beyond 2⁶⁴.
pub(crate) fn node_count(counts: [u32; 3]) -> Option<u64> {
    (u64::from(counts[0]) * u64::from(counts[1])).checked_mul(u64::from(counts[2]))
}
