//! Shapes of bodies, in their own axes: where their surface is nearest to a point, how large they are.
//!
//! Files:
//!
//! - `bounds.rs`: Boxes along the axes, around what is to be kept apart cheaply.
//! - `outline.rs`: Outlines: a shape as a few segments, for debug drawing.
//! - `parts.rs`: A shape taken apart, for images of a scene, and put together again to the bit.
//! - `separation.rs`: Planes that separate convex shapes from straight segments, for the shapes that know them in closed form.
//! - `surface.rs`: Where a shape's surface is nearest to a point.
//! - `grid/`: Signed distance grids: how they are baked, and what is asked of them.
//! - `mesh/`: Triangle meshes and convex hulls: where they are nearest to a point, over all of them or over a patch.
//! - `primitive/`: Shapes given by a few numbers: the nearest point of each, exact.

mod bounds;
mod grid;
mod mesh;
mod outline;
mod parts;
mod primitive;
mod separation;
mod surface;

use nalgebra::Vector3;

pub use bounds::Bounds;
pub use grid::{DistanceGrid, NODE_LIMIT};
pub(crate) use grid::{PlaneField, node_count};
pub(in crate::contact) use mesh::{Ball, Patch, Region, Tube};
pub use mesh::{Mesh, Sides};
pub(crate) use parts::Parts;
pub(in crate::contact) use separation::Separator;
pub use surface::Surface;

use crate::error::{Error, Result, check_finite, check_positive};
use crate::math::lane::Lane;
use crate::math::vector::Vec3;

/// The largest [`Shape::distance_slope`].
pub(in crate::contact) const STEEPEST_DISTANCE: f64 = 1.25;

/// The shape of a body, in the body's own axes. Made by the functions `new_…`, which check their arguments.
///
/// ```
/// use superhelix::Shape;
/// use superhelix::nalgebra::Vector3;
///
/// let brick = Shape::new_box(Vector3::new(0.1, 0.05, 0.02))?; // half edges, m
/// let nearest = brick.closest(Vector3::new(0.0, 0.0, 0.03), 0.1).expect("within 10 cm");
/// assert!((nearest.distance - 0.01).abs() < 1e-12);
/// assert!(Shape::new_sphere(-1.0).is_err());
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Shape(pub(in crate::contact) Kind);

/// What a shape is.
#[derive(Debug, Clone)]
pub(in crate::contact) enum Kind {
    Sphere {
        radius: f64,
    },
    Capsule {
        a: Vector3<f64>,
        b: Vector3<f64>,
        radius: f64,
    },
    Ellipsoid {
        semi_axes: Vector3<f64>,
    },
    Cuboid {
        half_edges: Vector3<f64>,
    },
    HalfSpace {
        normal: Vector3<f64>,
    },
    /// A convex hull: a closed mesh that is convex.
    Hull(Mesh),
    Mesh(Mesh),
    Grid(DistanceGrid),
}

impl Shape {
    /// A sphere about the origin; its radius in m.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when `radius` is not finite and above zero.
    pub fn new_sphere(radius: f64) -> Result<Self> {
        check_positive(|| "radius".into(), radius)?;
        Ok(Self(Kind::Sphere { radius }))
    }

    /// All points within `radius` (m) of the segment from `a` to `b` (m).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when a number is not finite, the radius is not above zero, or `a` is `b` (then it is a sphere).
    pub fn new_capsule(a: Vector3<f64>, b: Vector3<f64>, radius: f64) -> Result<Self> {
        check_vector("a", &a)?;
        check_vector("b", &b)?;
        check_positive(|| "radius".into(), radius)?;
        if (b - a).norm_squared() == 0.0 {
            return Err(Error::invalid("b", format!("{:?}, as is a", b.as_slice()), "another point than a"));
        }
        Ok(Self(Kind::Capsule { a, b, radius }))
    }

    /// An ellipsoid about the origin with semi-axes (m) along x, y and z.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when a semi-axis is not finite and above zero.
    pub fn new_ellipsoid(semi_axes: Vector3<f64>) -> Result<Self> {
        for axis in 0..3 {
            check_positive(|| format!("semi_axes[{axis}]"), semi_axes[axis])?;
        }
        Ok(Self(Kind::Ellipsoid { semi_axes }))
    }

    /// A box about the origin; half its edges (m) along x, y and z.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when a number is not finite and above zero.
    pub fn new_box(half_edges: Vector3<f64>) -> Result<Self> {
        for axis in 0..3 {
            check_positive(|| format!("half_edges[{axis}]"), half_edges[axis])?;
        }
        Ok(Self(Kind::Cuboid { half_edges }))
    }

    /// The half of space behind the plane through the origin across `normal`, which points out of it; normalised to rounding.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when a number is not finite or `normal` has no direction.
    pub fn new_half_space(normal: Vector3<f64>) -> Result<Self> {
        check_vector("normal", &normal)?;
        // By the largest number first: squares of tiny or huge numbers are lost.
        let largest = normal.amax();
        if largest == 0.0 {
            return Err(Error::invalid("normal", format!("{:?}", normal.as_slice()), "a vector with a direction"));
        }
        Ok(Self(Kind::HalfSpace { normal: (normal / largest).normalize() }))
    }

    /// The convex hull of points (m).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] when a number is not finite, there are fewer than four points, or they span no volume.
    pub fn new_hull(points: &[Vector3<f64>]) -> Result<Self> {
        Ok(Self(Kind::Hull(mesh::hull::of_points(points)?)))
    }

    /// A triangle mesh, checked as [`Mesh::new`] says.
    ///
    /// # Errors
    /// Those of [`Mesh::new`].
    pub fn new_mesh(vertices: Vec<Vector3<f64>>, triangles: Vec<[u32; 3]>, sides: Sides) -> Result<Self> {
        Ok(Self(Kind::Mesh(Mesh::new(vertices, triangles, sides)?)))
    }

    /// The shape of a distance grid.
    pub fn new_grid(grid: DistanceGrid) -> Self {
        Self(Kind::Grid(grid))
    }

    /// The mesh of a mesh or hull.
    pub fn mesh(&self) -> Option<&Mesh> {
        match &self.0 {
            Kind::Mesh(mesh) | Kind::Hull(mesh) => Some(mesh),
            _ => None,
        }
    }

    /// The mesh whose vertices may be set. A hull's may not: it would not stay convex.
    pub(in crate::contact) fn deforming_mut(&mut self) -> Option<&mut Mesh> {
        match &mut self.0 {
            Kind::Mesh(mesh) => Some(mesh),
            _ => None,
        }
    }

    /// The grid of a distance grid.
    pub fn grid(&self) -> Option<&DistanceGrid> {
        match &self.0 {
            Kind::Grid(grid) => Some(grid),
            _ => None,
        }
    }

    /// The surface nearest to a point (m, the shape's axes) if the point's signed distance is below `within` (m); inside a solid at any
    /// depth. Where several places are nearest, one of them, always the same. A distance grid knows nothing beyond its band, a
    /// one-sided mesh nothing deeper than its depth, a two-sided mesh no negative distances.
    pub fn closest(&self, point: Vector3<f64>, within: f64) -> Option<Surface> {
        match &self.0 {
            Kind::Hull(mesh) | Kind::Mesh(mesh) => mesh.closest(point, within),
            Kind::Grid(grid) => grid.closest(point).filter(|surface| surface.distance < within),
            _ => Some(self.closest_smooth(point)).filter(|surface| surface.distance < within),
        }
    }

    /// The same, or else a distance (m) that the surface surely has from the point.
    pub(in crate::contact) fn closest_or_least(&self, point: Vector3<f64>, within: f64) -> std::result::Result<Surface, f64> {
        match &self.0 {
            Kind::Hull(mesh) | Kind::Mesh(mesh) => mesh.closest(point, within).ok_or(within),
            Kind::Grid(grid) => grid.closest_within(point, within, self.distance_slope()),
            _ => {
                let surface = self.closest_smooth(point);
                if surface.distance < within { Ok(surface) } else { Err(surface.distance) }
            }
        }
    }

    /// A distance (m) that the surface has from a point at least, or `within`, where it is more; below zero inside a solid. It changes by no more than
    /// [`Shape::distance_slope`] times the distance from point to point.
    pub(in crate::contact) fn distance(&self, point: Vector3<f64>, within: f64) -> f64 {
        match &self.0 {
            Kind::Hull(mesh) | Kind::Mesh(mesh) => mesh.closest(point, within).map_or(within, |surface| surface.distance),
            Kind::Grid(grid) => grid.distance(point, within, self.distance_slope()),
            _ => self.closest_smooth(point).distance,
        }
    }

    /// Distances (m) that the surface surely has from places, found out at little cost; below zero where it may be anywhere.
    #[inline(always)]
    pub(in crate::contact) fn at_least<T: Lane>(&self, places: &Vec3<T>) -> T {
        match &self.0 {
            Kind::Grid(grid) => grid.at_least(places, self.distance_slope()),
            _ => T::from_lanes(|lane| self.at_least_of_one(places.lane(lane).into())),
        }
    }

    /// The same for a shape that is no grid.
    fn at_least_of_one(&self, point: Vector3<f64>) -> f64 {
        match &self.0 {
            Kind::Hull(mesh) | Kind::Mesh(mesh) => match mesh.bounds().distance(&point) {
                0.0 => f64::NEG_INFINITY,
                outside => outside,
            },
            _ => self.closest_smooth(point).distance,
        }
    }

    /// The most that a distance changes over a unit of distance. Between a grid's nodes it is interpolated by cubics, which are steeper here and
    /// there than what they go through.
    pub fn distance_slope(&self) -> f64 {
        match &self.0 {
            Kind::Grid(_) => STEEPEST_DISTANCE,
            _ => 1.0,
        }
    }

    /// [`Shape::closest`] for the shapes that know it everywhere.
    #[inline]
    pub(in crate::contact) fn closest_smooth(&self, point: Vector3<f64>) -> Surface {
        match &self.0 {
            Kind::Sphere { radius } => primitive::sphere::closest(*radius, point),
            Kind::Capsule { a, b, radius } => primitive::capsule::closest(*a, *b, *radius, point),
            Kind::Ellipsoid { semi_axes } => primitive::ellipsoid::closest(semi_axes, point),
            Kind::Cuboid { half_edges } => primitive::cuboid::closest(half_edges, point),
            Kind::HalfSpace { normal } => primitive::half_space::closest(normal, point),
            // Not asked: these have lists of triangles or a band.
            Kind::Hull(_) | Kind::Mesh(_) | Kind::Grid(_) => Surface::smooth(point, Vector3::x(), f64::INFINITY),
        }
    }

    /// A box around the shape; infinite for a half-space.
    pub fn bounds(&self) -> Bounds {
        match &self.0 {
            Kind::Sphere { radius } => Bounds::around(Vector3::zeros(), Vector3::repeat(*radius)),
            Kind::Capsule { a, b, radius } => Bounds::of_points([*a, *b]).grown(*radius),
            Kind::Ellipsoid { semi_axes: half } | Kind::Cuboid { half_edges: half } => Bounds::around(Vector3::zeros(), *half),
            Kind::HalfSpace { .. } => Bounds::EVERYTHING,
            Kind::Hull(mesh) | Kind::Mesh(mesh) => mesh.bounds(),
            Kind::Grid(grid) => grid.bounds(),
        }
    }

    /// The normal of a half-space's plane, out of it.
    pub(in crate::contact) fn plane(&self) -> Option<&Vector3<f64>> {
        match &self.0 {
            Kind::HalfSpace { normal } => Some(normal),
            _ => None,
        }
    }

    /// How deep a point may be inside for the nearest surface to be, surely, that through which it came straight in, m.
    pub(in crate::contact) fn thinness(&self) -> f64 {
        match &self.0 {
            Kind::Sphere { radius } | Kind::Capsule { radius, .. } => *radius,
            Kind::Ellipsoid { semi_axes } => semi_axes.min(),
            Kind::Cuboid { half_edges } => half_edges.min(),
            Kind::HalfSpace { .. } => f64::INFINITY,
            Kind::Hull(_) | Kind::Mesh(_) | Kind::Grid(_) => 0.0,
        }
    }

    /// How long pieces of a strand may be for the distance to have no two minima along one, m: infinite for convex shapes.
    pub(in crate::contact) fn feature_length(&self) -> f64 {
        match &self.0 {
            Kind::Mesh(mesh) => mesh.edge_length(),
            Kind::Grid(grid) => 2.0 * grid.cell(),
            _ => f64::INFINITY,
        }
    }

    /// Whether its distance is known everywhere and convex: along a straight line its slope never falls.
    pub(in crate::contact) fn is_smooth_convex(&self) -> bool {
        !matches!(self.0, Kind::Hull(_) | Kind::Mesh(_) | Kind::Grid(_))
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        match &self.0 {
            Kind::Hull(mesh) | Kind::Mesh(mesh) => mesh.heap_bytes(),
            Kind::Grid(grid) => grid.heap_bytes(),
            _ => 0,
        }
    }
}

impl From<Mesh> for Shape {
    fn from(mesh: Mesh) -> Self {
        Self(Kind::Mesh(mesh))
    }
}

fn check_vector(argument: &str, vector: &Vector3<f64>) -> Result<()> {
    (0..3).try_for_each(|axis| check_finite(|| format!("{argument}[{axis}]"), vector[axis]))
}
