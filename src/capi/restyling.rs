//! Shapes taken as they are: as natural shapes, as rest shapes under gravity, as shapes to come back to.

use super::buffers::{Places, array, each, strand_ids};
use super::errors::shx_result;
use super::guard::{read, shx_solver, write};
use super::thread::on_own_thread;
use super::types::shx_strand_id;
use crate::error::{Error, Result};
use crate::groom::stability::check_margin;
use crate::solver::id::StrandId;
use crate::solver::{Solver, Stiffening};

/// Strands are made stiffer by Young's modulus, Poisson's ratio as it is.
pub const SHX_STIFFEN_YOUNGS_MODULUS: u32 = 1;
/// Strands are made stiffer by both semi-axes of their section, and with them heavier.
pub const SHX_STIFFEN_RADIUS: u32 = 2;

/// Elements of strands together.
fn total(core: &Solver, ids: &[StrandId]) -> Result<usize> {
    Ok(each(ids, |id| core.element_lengths(id).map(<[f64]>::len))?.iter().sum())
}

/// Makes the present shapes of count strands their natural ones, at any moment of a run: without weight they would rest in them,
/// with it they sag from here. Nothing moves at once, velocities stay. What shx_solver_set_element_count remembers of the natural
/// shapes before is forgotten.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_adopt_natural_shapes(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_adopt_natural_shapes", solver, |core, _| core.take_natural_shapes(&strand_ids(ids, count)?)) }
}

/// Makes the present shapes of count strands those in which they rest under the solver's gravity with their roots held where they
/// are, by natural curvatures that balance their weight in closed form. Velocities stay: what moves goes on to move, about its new
/// rest; shx_solver_set_shapes with what shx_solver_get_shapes gave stops it. Wind, touches and constraints are not counted: a
/// strand that leans on something is held up as if nothing were there. The rest need not be stable: shx_solver_shape_stability
/// tells. What shx_solver_set_element_count remembers of the natural shapes before is forgotten.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a strand so limp that no finite curvatures
/// hold it). Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_adopt_rest_shapes(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_adopt_rest_shapes", solver, |core, _| core.take_rest_shapes(&strand_ids(ids, count)?)) }
}

/// How firmly count strands would rest in their present shapes under the solver's gravity, once shx_solver_adopt_rest_shapes has
/// made them rest shapes; changes nothing. Each output holds count values or is null:
/// out_eigenvalues: the smallest eigenvalue of the static Hessian against the elastic stiffness, as shx_solver_settle has it: above
/// 0 stable, 1 where gravity does nothing.
/// out_youngs_scales: the smallest factor, 1 or above, on Young's modulus with which that eigenvalue is at least margin (0 to less
/// than 1; at 0 a strand is put on the very border and needs a little more). The natural shape is to be chosen anew then.
/// out_radius_scales: the same on both radii.
/// Costs the cube of the number of elements. The work is shared among the solver's own threads; a parallel_for is not used.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. May run beside other reading calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_shape_stability(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    margin: f64,
    out_eigenvalues: *mut f64,
    out_youngs_scales: *mut f64,
    out_radius_scales: *mut f64,
) -> shx_result {
    let body = |core: &Solver| {
        // SAFETY: the caller's count ids and places for count values.
        let (ids, eigenvalues, youngs, radii) = unsafe {
            (
                strand_ids(ids, count)?,
                Places::optional("out_eigenvalues", "count", out_eigenvalues, count)?,
                Places::optional("out_youngs_scales", "count", out_youngs_scales, count)?,
                Places::optional("out_radius_scales", "count", out_radius_scales, count)?,
            )
        };
        check_margin(margin)?;
        let found = on_own_thread(|| core.shape_stability(&ids))?;
        let youngs_scales = found.iter().map(|f| f.youngs_scale(margin)).collect::<Result<Vec<_>>>()?;
        let radius_scales = found.iter().map(|f| f.radius_scale(margin)).collect::<Result<Vec<_>>>()?;
        if let Some(eigenvalues) = eigenvalues {
            eigenvalues.write(&found.iter().map(|f| f.smallest_eigenvalue).collect::<Vec<_>>())?;
        }
        if let Some(youngs) = youngs {
            youngs.write(&youngs_scales)?;
        }
        if let Some(radii) = radii {
            radii.write(&radius_scales)?;
        }
        Ok(())
    };
    // SAFETY: the caller's handle, null or alive.
    unsafe { read("shx_solver_shape_stability", solver, body) }
}

/// Makes those of count strands that would not rest stably in their present shapes as much stiffer as that takes, and no more, and takes the
/// shapes of all of them as rest shapes (shx_solver_adopt_rest_shapes). by: SHX_STIFFEN_. margin, 0 to less than 1, is what the smallest
/// eigenvalue of shx_solver_shape_stability is at least afterwards; at 0 a strand stands on the very border. out_scales receives count
/// factors, 1 where nothing was changed, in the order of ids, or is null. An identifier may be given once only.
/// Costs the cube of the number of elements. The work is shared among the solver's own threads; a parallel_for is not used.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (by, margin, an identifier given twice, a strand
/// that no finite stiffness holds up); then nothing has changed. Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_stiffen_strands(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    by: u32,
    margin: f64,
    out_scales: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and place for count values.
    unsafe {
        write("shx_solver_stiffen_strands", solver, |core, _| {
            let ids = strand_ids(ids, count)?;
            let places = Places::optional("out_scales", "count", out_scales, count)?;
            let by = match by {
                SHX_STIFFEN_YOUNGS_MODULUS => Stiffening::YoungsModulus,
                SHX_STIFFEN_RADIUS => Stiffening::Radius,
                other => return Err(Error::invalid("by", other, "one of SHX_STIFFEN_")),
            };
            check_margin(margin)?;
            let scales = on_own_thread(|| core.stiffen(&ids, by, margin))?;
            places.map_or(Ok(()), |places| places.write(&scales))
        })
    }
}

/// The present curvatures of count strands (rad/m): a row of three doubles an element, strand after strand in the order of ids, into
/// out_curvatures, which holds capacity rows (at least the strands' elements together). Kept by the host they are initial shapes for
/// shx_solver_set_shapes; the solver itself remembers none.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. May run beside
/// other reading calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_shapes(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    out_curvatures: *mut f64,
    capacity: usize,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and place for capacity rows.
    unsafe {
        read("shx_solver_get_shapes", solver, |core| {
            let ids = strand_ids(ids, count)?;
            let places = Places::new("out_curvatures", "capacity", out_curvatures.cast::<[f64; 3]>(), capacity)?;
            places.check_room(total(core, &ids)?)?;
            places.write(&core.shapes(&ids)?)
        })
    }
}

/// Puts count strands into shapes, at rest relative to their roots, all or none: row_count rows of curvatures as
/// shx_solver_get_shapes gives them. Clears quarantines. Frozen freedoms must hold their natural value.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (row_count is not the strands' elements
/// together, a number that is not finite, a frozen freedom). Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_shapes(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    curvatures: *const f64,
    row_count: usize,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and row_count rows.
    unsafe {
        write("shx_solver_set_shapes", solver, |core, _| {
            let ids = strand_ids(ids, count)?;
            let rows: &[[f64; 3]] = array("curvatures", "row_count", curvatures.cast::<[f64; 3]>(), row_count)?;
            let needed = total(core, &ids)?;
            if row_count != needed {
                return Err(Error::invalid("row_count", row_count, format!("{needed}, one an element")));
            }
            core.set_shapes(&ids, rows)
        })
    }
}
