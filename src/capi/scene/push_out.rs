//! Pushes curves out of a body.

use std::mem::size_of;

use nalgebra::Vector3;

use crate::capi::base::buffers::{OutputList, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{shx_solver, write};
use crate::capi::base::types::shx_body_id;
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::error::Error;
use crate::groom::curves::outside::BroughtOut;
use crate::solver::id::BodyId;

/// Curves to push out of a body. Fill it with shx_push_out_def_init,
/// then set body, point_counts and curve_count.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_push_out_def {
    /// Set by shx_push_out_def_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// The body. Default null id: set it.
    pub body: shx_body_id,
    /// Distance that points keep from the surface, m; zero or above. Default 0.
    pub clearance: f64,
    /// Number of points of each curve; curve_count numbers. Default null: set it.
    pub point_counts: *const u32,
    /// Number of curves. Default 0: set it.
    pub curve_count: usize,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, a double and a pointer only.
unsafe impl Versioned for shx_push_out_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved0: 0,
            body: shx_body_id { bits: 0 },
            clearance: 0.0,
            point_counts: std::ptr::null(),
            curve_count: 0,
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<shx_push_out_def>() == 40 && std::mem::offset_of!(shx_push_out_def, point_counts) == 24);

/// Fills *def with defaults. size is sizeof(shx_push_out_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_push_out_def_init(def: *mut shx_push_out_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_push_out_def_init", "def", def, size) }
}

/// The engine's error, with the names of the C structure.
fn in_words_of_c(error: Error) -> Error {
    match error {
        Error::InvalidId { bits, .. } => Error::InvalidId { argument: "def.body".into(), bits },
        other => other.renamed("clearance", "def.clearance").renamed("counts", "def.point_counts"),
    }
}

/// Pushes curves that are drawn inside a body out of it, where the body is now, by the smallest change. Use it
/// before you fit strands to them. points holds three doubles per point, curve by curve, m, world; they are
/// modified in place. Every point ends at least clearance from the surface. Roots stay; behind a root inside
/// the body the curve may stay as deep as a rise of one in two needs to get out. Edges keep their lengths.
/// Curves that are clear stay unchanged, and so does a curve that would have to move by more than twice its
/// depth plus 5 mm. Each output holds curve_count values or is null.
/// out_depths: depth of the deepest point below the surface, m; 0 if none was inside.
/// out_displacements: largest displacement of a point, m.
/// out_stuck: 1 if no way out was found and the curve is unchanged, else 0.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT. No point has moved then.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_push_out_curves(
    solver: *mut shx_solver,
    def: *const shx_push_out_def,
    points: *mut f64,
    out_depths: *mut f64,
    out_displacements: *mut f64,
    out_stuck: *mut u32,
) -> shx_result {
    // SAFETY: the caller's handle, structure, its counts, three doubles a point, and places for a value a curve.
    unsafe {
        write("shx_solver_push_out_curves", solver, |core, _| {
            let def = read_versioned("def", def)?;
            if def.reserved0 != 0 {
                return Err(Error::invalid("def.reserved0", def.reserved0, "0"));
            }
            let count = def.curve_count;
            let counts = array("def.point_counts", "def.curve_count", def.point_counts, count)?;
            let counts: Vec<usize> = counts.iter().map(|count| *count as usize).collect();
            let numbers = counts.iter().try_fold(0usize, |sum, count| sum.checked_add(*count)).and_then(|sum| sum.checked_mul(3));
            let too_many = || Error::invalid("def.point_counts", "too many points", "as many as fit into memory");
            let numbers = numbers.ok_or_else(too_many)?;
            let mut moved: Vec<Vector3<f64>> = array("points", "def.point_counts", points.cast_const(), numbers)?
                .chunks_exact(3)
                .map(Vector3::from_column_slice)
                .collect();
            let depths = OutputList::optional("out_depths", "def.curve_count", out_depths, count)?;
            let displacements = OutputList::optional("out_displacements", "def.curve_count", out_displacements, count)?;
            let stuck = OutputList::optional("out_stuck", "def.curve_count", out_stuck, count)?;
            let body = BodyId::from_bits(def.body.bits);
            let brought = core.bring_out(body, def.clearance, &counts, &mut moved).map_err(in_words_of_c)?;
            OutputList::new("points", "def.point_counts", points, numbers)?
                .write(&moved.iter().flatten().copied().collect::<Vec<_>>())?;
            let list = |of: fn(&BroughtOut) -> f64| brought.iter().map(of).collect::<Vec<f64>>();
            depths.map_or(Ok(()), |places| places.write(&list(|brought| brought.deepest)))?;
            displacements.map_or(Ok(()), |places| places.write(&list(|brought| brought.moved)))?;
            stuck.map_or(Ok(()), |places| places.write_all(brought.iter().map(|brought| u32::from(brought.stuck))))
        })
    }
}
