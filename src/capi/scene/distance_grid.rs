//! Bakes meshes into signed distance grids.

use std::ffi::c_void;
use std::mem::size_of;

use super::body_def::{corners, points};
use crate::capi::base::buffers::{OutputList, OutputValue};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::types::shx_input;
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::capi::render::render_def::NO_INPUT;
use crate::contact::shape::{DistanceGrid, Mesh};
use crate::error::{Error, Result};
use crate::files::distance_grid;

/// A mesh to bake into a signed distance grid. Fill it with shx_distance_grid_def_init, then set the other
/// fields. The library reads the arrays during the call only.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_distance_grid_def {
    /// Set by shx_distance_grid_def_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Vertices, m (SHX_FORMAT_F32X3 or _F64X3). Default: none, set it.
    pub vertices: shx_input,
    /// Three vertex indices per triangle, counter-clockwise seen from
    /// outside; 3 triangle_count numbers. Default null: set it.
    pub triangles: *const u32,
    /// Number of triangles. Default 0: set it.
    pub triangle_count: usize,
    /// Distance between grid nodes, m; above zero. Default 0: set it.
    pub cell: f64,
    /// Minimum distance by which the grid extends beyond the mesh, m; above zero. A body acts within this
    /// distance outside its surface, and at any depth inside. Default 0: set it.
    pub band: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles and pointers only.
unsafe impl Versioned for shx_distance_grid_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved0: 0,
            vertices: NO_INPUT,
            triangles: std::ptr::null(),
            triangle_count: 0,
            cell: 0.0,
            band: 0.0,
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_distance_grid_def>() == 72 && std::mem::offset_of!(shx_distance_grid_def, triangles) == 40);
};

/// Fills *def with defaults. size is sizeof(shx_distance_grid_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_distance_grid_def_init(def: *mut shx_distance_grid_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_distance_grid_def_init", "def", def, size) }
}

/// Bakes a mesh into a signed distance grid for bodies of SHX_SHAPE_GRID: distances at the nodes of a lattice.
/// The mesh need not be closed (a head cut off at the neck, parts that do not quite meet): its inside is where
/// its generalised winding number exceeds one half, but most of it must be closed. Writes the grid to
/// out_grid, which holds capacity bytes, and its size to *out_size. With a null out_grid and capacity 0 it
/// only returns the size and bakes nothing. You may save the bytes in a file; they are the same on every
/// machine. Takes about a microsecond per node, several microseconds if the mesh is not closed.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (also a mesh too open to
/// have an inside, and more than 2^27 nodes), SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_OUT_OF_MEMORY.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_distance_grid_bake(
    def: *const shx_distance_grid_def,
    out_grid: *mut c_void,
    capacity: usize,
    out_size: *mut usize,
) -> shx_result {
    let body = || -> Result<()> {
        // SAFETY: the caller's structure, what it points to, and place for a number.
        let (place, def, mesh) = unsafe {
            let (place, def) = (OutputValue::new("out_size", out_size)?, read_versioned("def", def)?);
            if def.reserved0 != 0 {
                return Err(Error::invalid("def.reserved0", def.reserved0, "0"));
            }
            let vertices = points("def.vertices", &raw const def.vertices)?;
            let triangles = corners("def.", def.triangles, def.triangle_count)?;
            (place, def, Mesh::for_baking(vertices, triangles).map_err(|error| error.inside("def"))?)
        };
        let counts = DistanceGrid::baked_counts(&mesh, def.cell, def.band).map_err(|error| error.inside("def"))?;
        let size = distance_grid::size(counts);
        // SAFETY: the caller's capacity bytes.
        if let Some(places) = unsafe { OutputList::image("out_grid", out_grid, capacity)? } {
            places.check_room(size)?;
            let grid = DistanceGrid::bake(&mesh, def.cell, def.band)
                .map_err(|error| error.renamed("mesh", "triangles").inside("def"))?;
            places.write(&distance_grid::write_to_bytes(&grid)?)?;
        }
        place.write(size);
        Ok(())
    };
    call("shx_distance_grid_bake", body)
}
