//! A strand's curvatures: natural ones, current ones, and their rates. One row of three doubles per element.

use crate::capi::base::buffers::{OutputList, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::types::shx_strand_id;
use crate::error::{Error, Result};
use crate::solver::id::StrandId;

/// # Safety
/// `rows` is null or points to `count` rows.
unsafe fn curvature_rows<'a>(argument: &str, rows: *const f64, count: usize) -> Result<&'a [[f64; 3]]> {
    // SAFETY: the same. A row is three doubles.
    unsafe { array(argument, "count", rows.cast::<[f64; 3]>(), count) }
}

/// Sets the natural curvatures of a strand: count rows, one per element, rad/m. The strand moves towards them
/// from the next step on; frozen curvatures follow at once.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (count is not
/// the number of elements, a value that is not finite).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_natural_curvatures(
    solver: *mut shx_solver,
    id: shx_strand_id,
    curvatures: *const f64,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count rows.
    unsafe {
        write("shx_solver_set_natural_curvatures", solver, |core, _| {
            core.set_natural_curvatures(StrandId::from_bits(id.bits), curvature_rows("curvatures", curvatures, count)?)
        })
    }
}

/// Writes the natural curvatures of a strand, rad/m, to out_curvatures, which
/// holds count rows: at least the number of elements.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_natural_curvatures(
    solver: *const shx_solver,
    id: shx_strand_id,
    out_curvatures: *mut f64,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and place for count rows.
    unsafe {
        read("shx_solver_get_natural_curvatures", solver, |core| {
            let places = OutputList::new("out_curvatures", "count", out_curvatures.cast::<[f64; 3]>(), count)?;
            places.write(core.natural_curvatures(StrandId::from_bits(id.bits))?)
        })
    }
}

/// Writes the current curvatures of a strand (rad/m) and their rates (rad/(m s)). Both outputs hold count
/// rows, at least the number of elements; one of them may be null.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_curvatures(
    solver: *const shx_solver,
    id: shx_strand_id,
    out_curvatures: *mut f64,
    out_rates: *mut f64,
    count: usize,
) -> shx_result {
    let body = |core: &crate::solver::Solver| {
        if out_curvatures.is_null() && out_rates.is_null() {
            return Err(Error::NullArgument { argument: "out_curvatures (and out_rates)".into() });
        }
        let id = StrandId::from_bits(id.bits);
        // SAFETY: the caller's memory for count rows.
        let curvatures = unsafe { OutputList::optional("out_curvatures", "count", out_curvatures.cast::<[f64; 3]>(), count)? };
        // SAFETY: the same.
        let rates = unsafe { OutputList::optional("out_rates", "count", out_rates.cast::<[f64; 3]>(), count)? };
        let (present, moving) = (core.curvatures(id)?, core.rates(id)?);
        if let Some(curvatures) = curvatures {
            curvatures.write(present)?;
        }
        if let Some(rates) = rates {
            rates.write(moving)?;
        }
        Ok(())
    };
    // SAFETY: the caller's handle, null or alive.
    unsafe { read("shx_solver_get_curvatures", solver, body) }
}

/// Sets the current curvatures of a strand (count rows, rad/m) and their rates (count rows, rad/(m s); null:
/// 0). Frozen curvatures must have their natural value and rate 0.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (count is not the number
/// of elements, a value that is not finite, a frozen curvature).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_curvatures(
    solver: *mut shx_solver,
    id: shx_strand_id,
    curvatures: *const f64,
    rates: *const f64,
    count: usize,
) -> shx_result {
    let body = |core: &mut crate::solver::Solver| {
        // SAFETY: the caller's count rows.
        let present = unsafe { curvature_rows("curvatures", curvatures, count)? };
        // SAFETY: the same, or null.
        let moving = if rates.is_null() { None } else { Some(unsafe { curvature_rows("rates", rates, count)? }) };
        core.set_curvatures(StrandId::from_bits(id.bits), present, moving)
    };
    // SAFETY: the caller's handle, null or alive.
    unsafe { write("shx_solver_set_curvatures", solver, |core, _| body(core)) }
}
