//! Restyling: takes current shapes as natural shapes, as rest shapes under gravity, or as shapes to return to.

use crate::capi::base::buffers::{OutputList, array, each, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::thread::on_own_thread;
use crate::capi::base::types::shx_strand_id;
use crate::error::{Error, Result};
use crate::groom::stability::check_margin;
use crate::solver::id::StrandId;
use crate::solver::{Solver, Stiffening};

/// Stiffen strands by raising Young's modulus; Poisson's ratio stays.
pub const SHX_STIFFEN_YOUNGS_MODULUS: u32 = 1;
/// Stiffen strands by scaling both semi-axes of the cross-section, which also makes them heavier.
pub const SHX_STIFFEN_RADIUS: u32 = 2;

/// Total number of elements of strands.
fn total(core: &Solver, ids: &[StrandId]) -> Result<usize> {
    Ok(each(ids, |id| core.element_lengths(id).map(<[f64]>::len))?.iter().sum())
}

/// Makes the current shapes of count strands their natural shapes, at any time during a simulation. Without
/// gravity they would rest in them; with it they sag from there. Nothing moves at once, and velocities stay.
/// The natural shapes that shx_solver_set_element_count remembered are replaced.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_adopt_natural_shapes(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_adopt_natural_shapes", solver, |core, _| core.take_natural_shapes(&strand_ids(ids, count)?)) }
}

/// Makes the current shapes of count strands their rest shapes under gravity, with their roots where
/// they are (sag-free). It sets natural curvatures that balance the weight, in closed form. Velocities
/// stay: moving strands keep moving, about their new rest shape. To stop them, call
/// shx_solver_set_shapes with the output of shx_solver_get_shapes. Wind, contacts and constraints are
/// ignored. The equilibrium need not be stable: see shx_solver_shape_stability. The natural shapes that
/// shx_solver_set_element_count remembered are replaced.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a
/// strand so limp that no finite curvatures support it).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_adopt_rest_shapes(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_adopt_rest_shapes", solver, |core, _| core.take_rest_shapes(&strand_ids(ids, count)?)) }
}

/// Computes how stable count strands would be in their current shapes under
/// gravity, if shx_solver_adopt_rest_shapes made them rest shapes. Changes
/// nothing. Each output holds count values or is null.
/// out_eigenvalues: smallest eigenvalue of the static Hessian relative to the elastic stiffness, as in
/// shx_solver_settle: stable above 0, 1 if gravity has no effect.
/// out_youngs_scales: smallest factor (1 or above) on Young's modulus that raises the eigenvalue to
/// margin (0 to less than 1). With margin 0 a strand ends at the limit of stability and needs
/// slightly more. Choose the natural shape again afterwards.
/// out_radius_scales: the same for a factor on both radii.
/// Costs the cube of the number of elements. The work runs on the solver's own threads, not on parallel_for.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: shared.
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
                OutputList::optional("out_eigenvalues", "count", out_eigenvalues, count)?,
                OutputList::optional("out_youngs_scales", "count", out_youngs_scales, count)?,
                OutputList::optional("out_radius_scales", "count", out_radius_scales, count)?,
            )
        };
        check_margin(margin)?;
        let found = on_own_thread(|| core.shape_stability(&ids))?;
        let youngs_scales = found.iter().map(|f| f.youngs_scale(margin)).collect::<Result<Vec<_>>>()?;
        let radius_scales = found.iter().map(|f| f.radius_scale(margin)).collect::<Result<Vec<_>>>()?;
        if let Some(eigenvalues) = eigenvalues {
            eigenvalues.write_all(found.iter().map(|f| f.smallest_eigenvalue))?;
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

/// Stiffens those of count strands that would not be stable in their current shapes, by no more than
/// necessary, and adopts the current shapes of all of them as rest shapes (shx_solver_adopt_rest_shapes). by
/// is SHX_STIFFEN_. margin, 0 to less than 1, is the smallest eigenvalue of shx_solver_shape_stability
/// afterwards; with 0 a strand ends at the limit of stability. Writes count factors in the order of ids to
/// out_scales, 1 for unchanged strands; it may be null. Each strand may appear once. Costs the cube of the
/// number of elements. The work runs on the solver's own threads, not on parallel_for.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (by, margin, a strand
/// that appears twice or that no finite stiffness supports).
/// Threads: exclusive.
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
            let places = OutputList::optional("out_scales", "count", out_scales, count)?;
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

/// Writes the current curvatures of count strands, rad/m: a row of three doubles per element, strand by strand
/// in the order of ids, to out_curvatures, which holds capacity rows: at least the total number of elements.
/// Keep them as shapes for shx_solver_set_shapes; the solver stores none.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
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
            let places = OutputList::new("out_curvatures", "capacity", out_curvatures.cast::<[f64; 3]>(), capacity)?;
            places.check_room(total(core, &ids)?)?;
            places.write(&core.shapes(&ids)?)
        })
    }
}

/// Sets the shapes of count strands, at rest relative to their roots: row_count rows of
/// curvatures as from shx_solver_get_shapes. Releases quarantined strands. Frozen
/// curvatures must have their natural value. All or none.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (row_count is not the
/// total number of elements, a value that is not finite, a frozen curvature).
/// Threads: exclusive.
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
                return Err(Error::invalid("row_count", row_count, format!("{needed}, one per element")));
            }
            core.set_shapes(&ids, rows)
        })
    }
}
