//! Changes the number of elements of simulated strands.

use crate::capi::base::buffers::{OutputList, array, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{shx_solver, write};
use crate::capi::base::types::shx_strand_id;
use crate::solver::id::StrandId;

/// Changes the number of elements of count living strands to element_count each (1 to 100000), for
/// level of detail. Shape, velocities and energies are kept as well as that many elements allow. A
/// multiple of the current number splits every element and is exact; a divisor merges neighbours; any
/// other number keeps the grading of the lengths. The solver remembers the natural shape that you
/// defined or set last, so switching back and forth loses nothing of it. Ids remain valid and moving
/// roots continue. Writes how far each strand's curve moved, m, to out_distances: the largest
/// distance, not the mean, of points of equal arclength on the old and the new curve; count numbers, or null.
/// Costs as much as a few steps; no time passes.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_element_count(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    element_count: u32,
    out_distances: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and place for count numbers.
    unsafe {
        write("shx_solver_set_element_count", solver, |core, _| {
            let distances = OutputList::optional("out_distances", "count", out_distances, count)?;
            let reports = core.set_element_count(&strand_ids(ids, count)?, element_count as usize)?;
            if let Some(distances) = distances {
                distances.write_all(reports.iter().map(|report| report.max_distance))?;
            }
            Ok(())
        })
    }
}

/// Does the same as shx_solver_set_element_count for one strand and elements of given
/// lengths: count numbers from root to tip, m, each above zero. Their sum is the length of
/// the strand, within 1e-9 of it. out_distance, the largest as above, may be null.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_element_lengths(
    solver: *mut shx_solver,
    id: shx_strand_id,
    lengths: *const f64,
    count: usize,
    out_distance: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, count lengths and place for a number.
    unsafe {
        write("shx_solver_set_element_lengths", solver, |core, _| {
            let distance = OutputList::optional("out_distance", "out_distance", out_distance, 1)?;
            let report = core.set_element_lengths(StrandId::from_bits(id.bits), array("lengths", "count", lengths, count)?)?;
            if let Some(distance) = distance {
                distance.write(&[report.max_distance])?;
            }
            Ok(())
        })
    }
}
