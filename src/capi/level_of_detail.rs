//! Living strands on more or fewer elements.

use super::buffers::{Places, array, strand_ids};
use super::errors::shx_result;
use super::guard::{shx_solver, write};
use super::types::shx_strand_id;
use crate::solver::id::StrandId;

/// Puts count living strands on element_count elements each (1 to 100000), as they are: for level of detail by distance. Shape,
/// velocities and energies stay as well as that many elements can. A multiple of a strand's present number splits every element and
/// is exact; a divisor joins neighbours; anything else keeps the grading of their lengths. The natural shape that the strand was made
/// with, or that was set last, is remembered: nothing of it is lost by going back and forth. Ids stay; roots on their way go on.
/// out_distances: how far each strand's curve has moved at most, m; count numbers, or null.
/// It costs what a few steps cost. Time stands still.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
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
            let distances = Places::optional("out_distances", "count", out_distances, count)?;
            let reports = core.set_element_count(&strand_ids(ids, count)?, element_count as usize)?;
            if let Some(distances) = distances {
                distances.write(&reports.iter().map(|report| report.max_distance).collect::<Vec<_>>())?;
            }
            Ok(())
        })
    }
}

/// The same for one strand with elements of given lengths: count numbers from root to tip, m, each above zero; they sum to the
/// strand's length (within 1e-9 of it). out_distance may be null.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
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
            let distance = Places::optional("out_distance", "out_distance", out_distance, 1)?;
            let report = core.set_element_lengths(StrandId::from_bits(id.bits), array("lengths", "count", lengths, count)?)?;
            if let Some(distance) = distance {
                distance.write(&[report.max_distance])?;
            }
            Ok(())
        })
    }
}
