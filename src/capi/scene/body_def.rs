//! Definitions of bodies.

use std::ffi::c_void;
use std::mem::{offset_of, size_of};
use std::sync::Arc;

use nalgebra::Vector3;

use crate::capi::base::buffers::{Reader, VECTOR_FORMATS, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::types::{SHX_FORMAT_F64X3, shx_body_id, shx_frame, shx_input};
use crate::capi::base::versioned::{Versioned, initialise};
use crate::contact::body::BodyDef;
use crate::contact::shape::{Shape, Sides};
use crate::error::{Error, Result, check_finite};
use crate::files::distance_grid;
use crate::math::frame::Frame;
use crate::memory;
use crate::solver::Solver;
use crate::solver::id::BodyId;

/// An upper bound on the bytes per triangle or vertex of a mesh during its creation.
const BYTES_OF_A_TRIANGLE: usize = 1024;

/// A sphere at the body's origin: radius.
pub const SHX_SHAPE_SPHERE: u32 = 1;
/// All points within radius of the segment from a to b.
pub const SHX_SHAPE_CAPSULE: u32 = 2;
/// An ellipsoid at the body's origin: semi_axes.
pub const SHX_SHAPE_ELLIPSOID: u32 = 3;
/// A box at the body's origin: half_extents.
pub const SHX_SHAPE_BOX: u32 = 4;
/// All points behind the plane through the body's origin with the given normal.
pub const SHX_SHAPE_HALF_SPACE: u32 = 5;
/// The convex hull of vertices.
pub const SHX_SHAPE_HULL: u32 = 6;
/// A triangle mesh: vertices, triangles, sides. The only shape that can deform (shx_solver_set_body_vertices).
pub const SHX_SHAPE_MESH: u32 = 7;
/// A signed distance grid from shx_distance_grid_bake: grid. Fast for large meshes that
/// do not deform; edges are rounded by about a cell.
pub const SHX_SHAPE_GRID: u32 = 8;

/// The current shape of another body of the solver: shape_of. Bodies that share a shape
/// store it once; one that deforms gets its own copy.
pub const SHX_SHAPE_SHARED: u32 = 9;

/// The mesh is closed, its triangles counter-clockwise seen from
/// outside. Strands inside are pushed out from any depth.
pub const SHX_SIDES_SOLID: u32 = 1;
/// Strands stay on the side from which triangles appear counter-clockwise. Strands
/// behind it, closer than depth, are pushed to the front.
pub const SHX_SIDES_FRONT: u32 = 2;
/// Two-sided, like a sheet: a strand stays on the side on which it started the step.
pub const SHX_SIDES_BOTH: u32 = 3;

/// Definition of a body. Fill it with shx_body_def_init, then set shape and the fields of that shape; those of
/// other shapes are ignored. The library reads the arrays during the call only.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_body_def {
    /// Set by shx_body_def_init.
    pub struct_size: u32,
    /// SHX_SHAPE_. Default 0: set it.
    pub shape: u32,
    /// Pose of the body in world space. Default: at the origin, aligned with the world axes.
    pub pose: shx_frame,
    /// Sphere, capsule: radius, m; above zero. Default 0: set it.
    pub radius: f64,
    /// Capsule: one end of its axis in body axes, m. Default 0.
    pub a: [f64; 3],
    /// Capsule: the other end, distinct from a. Default 0: set it.
    pub b: [f64; 3],
    /// Ellipsoid: semi-axes along the body axes, m; each above zero. Default 0: set it.
    pub semi_axes: [f64; 3],
    /// Box: half of its edge lengths along the body axes, m; each above zero. Default 0: set it.
    pub half_extents: [f64; 3],
    /// Half-space: outward normal in body axes, any length above zero. Default (0, 0, 1).
    pub normal: [f64; 3],
    /// Hull, mesh: vertices in body axes, m (SHX_FORMAT_F32X3 or _F64X3). Default: none.
    pub vertices: shx_input,
    /// Mesh: three vertex indices per triangle, counter-clockwise seen from
    /// outside; 3 triangle_count numbers. Default null.
    pub triangles: *const u32,
    /// Mesh: number of triangles. Default 0: set it.
    pub triangle_count: usize,
    /// Mesh: SHX_SIDES_. Default SHX_SIDES_SOLID.
    pub sides: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Mesh with SHX_SIDES_FRONT: how far it acts behind its triangles, m; above zero. Default 0: set it.
    pub depth: f64,
    /// Grid: the bytes that shx_distance_grid_bake wrote. Default null.
    pub grid: *const c_void,
    /// Grid: number of bytes. Default 0.
    pub grid_size: usize,
    /// Distance of the body's surface outside its shape, m; zero or above. Default 0.
    pub thickness: f64,
    /// Factor on the Coulomb friction coefficients of strands; zero or above. Default 1.
    pub friction_scale: f64,
    /// Factor on the viscous friction coefficients of strands; zero or above. Default 1.
    pub viscous_friction_scale: f64,
    /// Collision groups of the body, as bits. Default 1.
    pub groups: u32,
    /// Groups that the body collides with, as bits. A body and a strand collide if each
    /// is in a group of the other's mask. Default: all.
    pub mask: u32,
    /// Shared: a body from an earlier call. Its pose, surface
    /// and groups are not copied. Default null id: set it.
    pub shape_of: shx_body_id,
    /// Your own number; the library does not use it. Default 0.
    pub user_data: u64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles and pointers only.
unsafe impl Versioned for shx_body_def {
    const FIRST_SIZE: usize = offset_of!(Self, user_data);

    fn defaults() -> Self {
        let pose = Frame::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            shape: 0,
            pose: (&pose).into(),
            radius: 0.0,
            a: [0.0; 3],
            b: [0.0; 3],
            semi_axes: [0.0; 3],
            half_extents: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
            vertices: shx_input { data: std::ptr::null(), stride: 0, count: 0, format: SHX_FORMAT_F64X3, reserved: 0 },
            triangles: std::ptr::null(),
            triangle_count: 0,
            sides: SHX_SIDES_SOLID,
            reserved0: 0,
            depth: 0.0,
            grid: std::ptr::null(),
            grid_size: 0,
            thickness: 0.0,
            friction_scale: 1.0,
            viscous_friction_scale: 1.0,
            groups: 1,
            mask: u32::MAX,
            shape_of: shx_body_id { bits: 0 },
            user_data: 0,
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_body_def>() == 320 && offset_of!(shx_body_def, user_data) == 312);
    assert!(offset_of!(shx_body_def, radius) == 64 && offset_of!(shx_body_def, vertices) == 192);
    assert!(offset_of!(shx_body_def, sides) == 240 && offset_of!(shx_body_def, groups) == 296);
    assert!(offset_of!(shx_body_def, shape_of) == 304);
};

/// Points of three finite numbers.
///
/// # Safety
/// `vertices` is null or a shx_input whose memory is there.
pub(super) unsafe fn points(argument: &str, vertices: *const shx_input) -> Result<Vec<Vector3<f64>>> {
    // SAFETY: the same.
    let reader = unsafe { Reader::new(argument, vertices, VECTOR_FORMATS)? };
    let mut points = memory::list(reader.count())?;
    for index in 0..reader.count() {
        let point = reader.point(index);
        for (axis, number) in point.iter().enumerate() {
            check_finite(|| format!("{argument}[{index}][{axis}]"), *number)?;
        }
        points.push(Vector3::from(point));
    }
    Ok(points)
}

/// # Safety
/// `triangles` is null or points to three indices for each of `count` triangles.
pub(super) unsafe fn corners(within: &str, triangles: *const u32, count: usize) -> Result<Vec<[u32; 3]>> {
    // SAFETY: the same. A triangle is three indices.
    unsafe { array(&format!("{within}triangles"), &format!("{within}triangle_count"), triangles.cast::<[u32; 3]>(), count) }
        .and_then(memory::copied)
}

impl shx_body_def {
    /// The engine's own definition, for `solver`; the numbers of its surface are checked where it is added.
    ///
    /// # Safety
    /// The arrays that it points to are there.
    pub(super) unsafe fn definition(&self, argument: &str, solver: &Solver) -> Result<BodyDef> {
        if self.reserved0 != 0 {
            return Err(Error::invalid(format!("{argument}.reserved0"), self.reserved0, "0"));
        }
        let shape = if self.shape == SHX_SHAPE_SHARED {
            let body = solver.body(BodyId::from_bits(self.shape_of.bits));
            body.map_err(|error| error.renamed("id", &format!("{argument}.shape_of")))?.shape.clone()
        } else {
            // SAFETY: the same.
            Arc::new(unsafe { self.shape() }.map_err(|error| error.inside(argument))?)
        };
        Ok(BodyDef {
            shape,
            pose: self.pose.checked(&format!("{argument}.pose"))?,
            thickness: self.thickness,
            friction: self.friction_scale,
            viscous_friction: self.viscous_friction_scale,
            group: self.groups,
            mask: self.mask,
        })
    }

    /// # Safety
    /// As [`Self::definition`].
    unsafe fn shape(&self) -> Result<Shape> {
        match self.shape {
            SHX_SHAPE_SPHERE => Shape::new_sphere(self.radius),
            SHX_SHAPE_CAPSULE => Shape::new_capsule(self.a.into(), self.b.into(), self.radius),
            SHX_SHAPE_ELLIPSOID => Shape::new_ellipsoid(self.semi_axes.into()),
            SHX_SHAPE_BOX => {
                Shape::new_box(self.half_extents.into()).map_err(|error| error.renamed("half_edges", "half_extents"))
            }
            SHX_SHAPE_HALF_SPACE => Shape::new_half_space(self.normal.into()),
            SHX_SHAPE_HULL => {
                // SAFETY: the caller's points.
                let points = unsafe { points("vertices", &raw const self.vertices)? };
                Shape::new_hull(&points).map_err(|error| error.renamed("points", "vertices"))
            }
            SHX_SHAPE_MESH => {
                let sides = match self.sides {
                    SHX_SIDES_SOLID => Sides::Solid,
                    SHX_SIDES_FRONT => Sides::Front { depth: self.depth },
                    SHX_SIDES_BOTH => Sides::Both,
                    other => return Err(Error::invalid("sides", other, "one of SHX_SIDES_")),
                };
                // SAFETY: the caller's points and indices.
                let (vertices, triangles) =
                    unsafe { (points("vertices", &raw const self.vertices)?, corners("", self.triangles, self.triangle_count)?) };
                // A mesh with its normals, its tree and what is worked out of its triangles takes less than this.
                memory::check_room((vertices.len() + triangles.len()).saturating_mul(BYTES_OF_A_TRIANGLE))?;
                Shape::new_mesh(vertices, triangles, sides).map_err(|error| error.renamed("sides.depth", "depth"))
            }
            SHX_SHAPE_GRID => {
                // SAFETY: the caller's bytes. A null grid is a mistake even when its size is 0.
                let bytes = unsafe {
                    let size = self.grid_size.max(usize::from(self.grid.is_null()));
                    array("grid", "grid_size", self.grid.cast::<u8>(), size)?
                };
                memory::check_room(bytes.len().saturating_mul(2))?;
                match distance_grid::read_from_bytes("it", bytes) {
                    Ok(grid) => Ok(Shape::new_grid(grid)),
                    Err(Error::File { reason, .. }) => {
                        Err(Error::invalid("grid", format!("no distance grid ({reason})"), "what shx_distance_grid_bake wrote"))
                    }
                    Err(other) => Err(other),
                }
            }
            other => Err(Error::invalid("shape", other, "one of SHX_SHAPE_")),
        }
    }
}

/// Fills *def with defaults. size is sizeof(shx_body_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_body_def_init(def: *mut shx_body_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_body_def_init", "def", def, size) }
}
