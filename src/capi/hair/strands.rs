//! Adds, removes and lists strands, and reads properties of each.

use std::cell::Cell;

use super::strand_def::shx_strand_def;
use crate::capi::base::buffers::{OutputList, OutputValue, each, strand_ids};
use crate::capi::base::errors::{SHX_OK, shx_result};
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::log::{LogSink, SHX_LOG_WARN};
use crate::capi::base::types::shx_strand_id;
use crate::capi::base::versioned::definitions;
use crate::memory;
use crate::rod::turning::{Shapes, coarse_strands};
use crate::solver::definition::StrandDef;
use crate::solver::id::StrandId;
use crate::solver::report::StrandStatus;

/// One line, whatever the number of strands.
fn warn_of_coarse(log: &LogSink, definitions: &[StrandDef]) {
    let coarse = coarse_strands(definitions.iter(), Shapes::Initial);
    if let Some(worst) = coarse.iter().max_by(|a, b| a.turn.total_cmp(&b.turn)) {
        log.message(
            SHX_LOG_WARN,
            format_args!(
                "shx_solver_add_strands: {} of {} strands have elements that turn by more than pi/2, up to {:.2} rad (defs[{}], \
                 which needs {} elements): they move too stiffly",
                coarse.len(),
                definitions.len(),
                worst.turn,
                worst.strand,
                worst.advised
            ),
        );
    }
}

/// Adds count strands, all or none. Definition i starts i * def_stride bytes after the first; def_stride is
/// usually sizeof(shx_strand_def). Writes count ids to out_ids, in the order of the definitions. If elements
/// turn by more than pi/2 in their initial shape, the strands are added and one SHX_LOG_WARN message gives
/// their number: a helix cannot bend its own axis, so tight coils need about four elements per turn
/// (shx_solver_strand_turning_angles, shx_suggest_elements).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the message
/// names, say, "defs[3].length"), SHX_ERROR_OUT_OF_MEMORY.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_add_strands(
    solver: *mut shx_solver,
    defs: *const shx_strand_def,
    def_stride: usize,
    count: usize,
    out_ids: *mut shx_strand_id,
) -> shx_result {
    // SAFETY: the caller's handle, structures and place for count ids.
    unsafe {
        write("shx_solver_add_strands", solver, |core, log| {
            let places = OutputList::new("out_ids", "count", out_ids, count)?;
            // Checks for the total memory at once: a hundred thousand small lists cannot be reserved as one.
            let bytes = Cell::new(0_usize);
            let count_bytes = |def: &shx_strand_def, argument: &str| {
                bytes.set(bytes.get().saturating_add(def.bytes(argument)?));
                Ok(())
            };
            definitions("shx_strand_def", defs, def_stride, count, count_bytes)?;
            memory::check_room(bytes.get())?;
            let read = |def: &shx_strand_def, argument: &str| def.definition(argument);
            let definitions = definitions("shx_strand_def", defs, def_stride, count, read)?;
            let ids = core.add_strands(&definitions)?;
            warn_of_coarse(log, &definitions);
            places.write_all(ids.iter().map(|id| shx_strand_id { bits: id.bits() }))
        })
    }
}

/// Removes count strands, all or none. Their ids become invalid.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_remove_strands(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_remove_strands", solver, |core, _| core.remove_strands(&strand_ids(ids, count)?)) }
}

/// Returns whether id names a strand of this solver. False for the null id, a removed strand, a strand of
/// another solver, and a null or poisoned solver (shx_last_error then has the message).
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_has_strand(solver: *const shx_solver, id: shx_strand_id) -> bool {
    let mut found = false;
    // SAFETY: the caller's handle, null or alive.
    let result = unsafe {
        read("shx_solver_has_strand", solver, |core| {
            found = core.has_strand(StrandId::from_bits(id.bits));
            Ok(())
        })
    };
    result == SHX_OK && found
}

/// Returns the number of strands.
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_strand_count(solver: *const shx_solver, out_count: *mut usize) -> shx_result {
    // SAFETY: the caller's handle and place for one number.
    unsafe {
        read("shx_solver_strand_count", solver, |core| {
            OutputValue::new("out_count", out_count)?.write(core.strand_count());
            Ok(())
        })
    }
}

/// Writes the ids of all strands, in the order in which they were added, to out_ids, which holds capacity ids.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL (see shx_solver_strand_count).
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_strand_ids(
    solver: *const shx_solver,
    out_ids: *mut shx_strand_id,
    capacity: usize,
) -> shx_result {
    // SAFETY: the caller's handle and place for capacity ids.
    unsafe {
        read("shx_solver_strand_ids", solver, |core| {
            let places = OutputList::new("out_ids", "capacity", out_ids, capacity)?;
            places.check_room(core.strand_count())?;
            places.write_all(core.strand_ids().iter().map(|id| shx_strand_id { bits: id.bits() }))
        })
    }
}

/// Returns the number of elements of a strand.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_element_count(
    solver: *const shx_solver,
    id: shx_strand_id,
    out_count: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle and place for one number.
    unsafe {
        read("shx_solver_get_element_count", solver, |core| {
            let place = OutputValue::new("out_count", out_count)?;
            place.write(core.element_lengths(StrandId::from_bits(id.bits))?.len());
            Ok(())
        })
    }
}

/// Writes the lengths of a strand's elements from root to
/// tip, m, to out_lengths, which holds capacity numbers.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_element_lengths(
    solver: *const shx_solver,
    id: shx_strand_id,
    out_lengths: *mut f64,
    capacity: usize,
) -> shx_result {
    // SAFETY: the caller's handle and place for capacity numbers.
    unsafe {
        read("shx_solver_get_element_lengths", solver, |core| {
            let places = OutputList::new("out_lengths", "capacity", out_lengths, capacity)?;
            places.write(core.element_lengths(StrandId::from_bits(id.bits))?)
        })
    }
}

/// Writes the lengths of count strands, m, to out_lengths, which holds count numbers.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_strand_lengths(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    out_lengths: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and place for count numbers.
    unsafe {
        read("shx_solver_strand_lengths", solver, |core| {
            let places = OutputList::new("out_lengths", "count", out_lengths, count)?;
            places.write(&each(&strand_ids(ids, count)?, |id| core.length(id))?)
        })
    }
}

/// Returns shx_strand_def.user_data of a strand.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_user_data(
    solver: *const shx_solver,
    id: shx_strand_id,
    out_user_data: *mut u64,
) -> shx_result {
    // SAFETY: the caller's handle and place for one number.
    unsafe {
        read("shx_solver_get_user_data", solver, |core| {
            let place = OutputValue::new("out_user_data", out_user_data)?;
            place.write(core.user_data(StrandId::from_bits(id.bits))?);
            Ok(())
        })
    }
}

/// Status of a strand after a step or after shx_solver_settle: SHX_STRAND_.
pub type shx_strand_status = i32;

/// The strand converged.
pub const SHX_STRAND_CONVERGED: i32 = 0;
/// The solver stopped before it reached the tolerance: it ran out of iterations
/// or could not descend further. The state is usable.
pub const SHX_STRAND_UNCONVERGED: i32 = 1;
/// The state became non-finite, or contacts or constraints made it diverge. The strand was rolled back to the
/// start of the step and moves rigidly with its root. The solver retries it; if that fails for a tenth of a
/// second, the strand returns to its natural shape by itself.
pub const SHX_STRAND_QUARANTINED: i32 = 2;

/// Writes the status of count strands after the last step to out_status.
/// shx_solver_reset_strands releases quarantined strands.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_strand_status(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    out_status: *mut shx_strand_status,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and place for count results.
    unsafe {
        read("shx_solver_strand_status", solver, |core| {
            let places = OutputList::new("out_status", "count", out_status, count)?;
            places.write(&each(&strand_ids(ids, count)?, |id| {
                Ok(match core.status(id)? {
                    StrandStatus::Ok => SHX_STRAND_CONVERGED,
                    StrandStatus::Unconverged => SHX_STRAND_UNCONVERGED,
                    StrandStatus::Quarantined => SHX_STRAND_QUARANTINED,
                })
            })?)
        })
    }
}

/// Writes the number of Newton iterations of count strands in the last substep to out_iterations.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_strand_iterations(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    out_iterations: *mut u32,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and place for count numbers.
    unsafe {
        read("shx_solver_strand_iterations", solver, |core| {
            let places = OutputList::new("out_iterations", "count", out_iterations, count)?;
            places.write(&each(&strand_ids(ids, count)?, |id| core.iterations(id))?)
        })
    }
}

/// Writes the number of quadrature points per element of count strands to out_points. Writes to
/// out_errors the relative error of inertia, drag and weight of the element that turns most in the
/// current shape: 1e-12 stands for that or less, infinity for more than 1e-2. The error is at most the
/// solver's quadrature_tolerance, unless an element turns more than any rule supports (about 200 rad) or
/// has turned further since the start of the last step.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_strand_quadrature(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    out_points: *mut u32,
    out_errors: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and places for count numbers each.
    unsafe {
        read("shx_solver_strand_quadrature", solver, |core| {
            let points = OutputList::new("out_points", "count", out_points, count)?;
            let errors = OutputList::new("out_errors", "count", out_errors, count)?;
            let found = each(&strand_ids(ids, count)?, |id| core.quadrature(id))?;
            points.write_all(found.iter().map(|quadrature| quadrature.points))?;
            errors.write_all(found.iter().map(|quadrature| quadrature.error))
        })
    }
}

/// Writes the largest angle by which an element of each of count strands turns, in its natural or its current
/// shape, rad, to out_turns. A strand above pi/2 moves too stiffly: give it more elements.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_strand_turning_angles(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    out_turns: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and place for count numbers.
    unsafe {
        read("shx_solver_strand_turning_angles", solver, |core| {
            let places = OutputList::new("out_turns", "count", out_turns, count)?;
            places.write(&each(&strand_ids(ids, count)?, |id| core.largest_turn(id))?)
        })
    }
}

/// Writes the energies of count strands, J: kinetic, elastic, and gravitational relative to the world
/// origin. Each output holds count numbers or is null.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_strand_energies(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    out_kinetic: *mut f64,
    out_elastic: *mut f64,
    out_gravity: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and places for count numbers.
    unsafe {
        read("shx_solver_strand_energies", solver, |core| {
            let kinetic = OutputList::optional("out_kinetic", "count", out_kinetic, count)?;
            let elastic = OutputList::optional("out_elastic", "count", out_elastic, count)?;
            let gravity = OutputList::optional("out_gravity", "count", out_gravity, count)?;
            let energies = each(&strand_ids(ids, count)?, |id| core.energies(id))?;
            for (places, field) in [
                (kinetic, energies.iter().map(|energy| energy.kinetic).collect::<Vec<_>>()),
                (elastic, energies.iter().map(|energy| energy.elastic).collect()),
                (gravity, energies.iter().map(|energy| energy.gravity).collect()),
            ] {
                if let Some(places) = places {
                    places.write(&field)?;
                }
            }
            Ok(())
        })
    }
}

/// Resets count strands to their natural curvatures, at rest relative to their
/// roots, and releases them from quarantine. All or none.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_reset_strands(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_reset_strands", solver, |core, _| core.reset_strands(&strand_ids(ids, count)?)) }
}
