//! Strands, bodies and constraints that follow one pose.

use crate::capi::base::buffers::{OutputValue, body_ids, check_array, constraint_ids, frame_from, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{call, read, shx_solver, write};
use crate::capi::base::types::{shx_body_id, shx_constraint_id, shx_frame, shx_strand_id};
use crate::error::{Error, Result};
use crate::solver::attachment::Attachment;

/// What follows one pose, for example all that belongs to a head. shx_attachment_create makes it, you own it,
/// shx_attachment_destroy frees it. Solver and attachment can be destroyed in any order.
pub struct shx_attachment(Attachment);

/// # Safety
/// `attachment` is null or alive.
unsafe fn attached<'a>(attachment: *const shx_attachment) -> Result<&'a Attachment> {
    // SAFETY: the same.
    let attachment = unsafe { attachment.as_ref() };
    attachment.map(|attachment| &attachment.0).ok_or_else(|| Error::NullArgument { argument: "attachment".into() })
}

/// The engine's error, with the names of this call's arguments.
fn in_words_of_c(error: Error) -> Error {
    error.renamed("strands[", "strand_ids[").renamed("bodies[", "body_ids[").renamed("constraints[", "constraint_ids[")
}

/// Renames the arrays of ids to those of the call.
fn named(error: Error, ids: &str, count: &str) -> Error {
    match error {
        Error::InvalidArgument { argument, value, expected } if argument == "count" => {
            Error::InvalidArgument { argument: count.into(), value, expected }
        }
        other => other.renamed("ids", ids),
    }
}

/// Attaches the roots of strands, bodies, and targets of constraints to something whose pose is `pose` now:
/// from now on shx_attachment_move moves them all as one. Each array may be null if its count is 0. Ties have
/// no targets; they stay as they are. You own *out_attachment. Snapshots do not contain attachments; after
/// shx_solver_restore they hold for the ids that are valid again.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_attachment_create(
    solver: *const shx_solver,
    pose: *const shx_frame,
    strand_ids: *const shx_strand_id,
    strand_count: usize,
    body_ids: *const shx_body_id,
    body_count: usize,
    constraint_ids: *const shx_constraint_id,
    constraint_count: usize,
    out_attachment: *mut *mut shx_attachment,
) -> shx_result {
    // SAFETY: the caller's handle, frame, ids and place for one pointer.
    unsafe {
        read("shx_attachment_create", solver, |core| {
            let place = OutputValue::new("out_attachment", out_attachment)?;
            let pose = frame_from("pose", pose)?;
            check_array("strand_ids", "strand_count", strand_ids, strand_count)?;
            check_array("body_ids", "body_count", body_ids, body_count)?;
            check_array("constraint_ids", "constraint_count", constraint_ids, constraint_count)?;
            let strands = self::strand_ids(strand_ids, strand_count).map_err(|e| named(e, "strand_ids", "strand_count"))?;
            let bodies = self::body_ids(body_ids, body_count).map_err(|e| named(e, "body_ids", "body_count"))?;
            let constraints = self::constraint_ids(constraint_ids, constraint_count)
                .map_err(|e| named(e, "constraint_ids", "constraint_count"))?;
            let made = core.attach(&pose, &strands, &bodies, &constraints).map_err(in_words_of_c)?;
            place.write(Box::into_raw(Box::new(shx_attachment(made))));
            Ok(())
        })
    }
}

/// Moves all that is attached smoothly to where it is when its carrier has the given pose, over the next
/// over_seconds of simulated time. 0: within the next substep. All or none. It does the same as
/// shx_solver_set_root_frames, shx_solver_set_body_frames and shx_solver_set_constraint_targets: each follows
/// its own smooth path to its new place.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID (something was removed since),
/// SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive, for the solver; shared, for the attachment.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_attachment_move(
    attachment: *const shx_attachment,
    solver: *mut shx_solver,
    pose: *const shx_frame,
    over_seconds: f64,
) -> shx_result {
    // SAFETY: the caller's handles and frame.
    unsafe {
        write("shx_attachment_move", solver, |core, _| {
            core.move_attached(attached(attachment)?, &frame_from("pose", pose)?, over_seconds).map_err(in_words_of_c)
        })
    }
}

/// Puts all that is attached at once where it is when its carrier has the given pose: as
/// shx_solver_teleport_roots and shx_solver_teleport_bodies; targets of constraints are there within the next
/// substep. All or none.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID (something was removed since),
/// SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive, for the solver; shared, for the attachment.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_attachment_teleport(
    attachment: *const shx_attachment,
    solver: *mut shx_solver,
    pose: *const shx_frame,
) -> shx_result {
    // SAFETY: the caller's handles and frame.
    unsafe {
        write("shx_attachment_teleport", solver, |core, _| {
            core.teleport_attached(attached(attachment)?, &frame_from("pose", pose)?).map_err(in_words_of_c)
        })
    }
}

/// Frees an attachment; what was attached stays where it is. Null is allowed.
/// Threads: exclusive. The handle must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_attachment_destroy(attachment: *mut shx_attachment) {
    call("shx_attachment_destroy", || {
        if !attachment.is_null() {
            // SAFETY: made by Box::into_raw in shx_attachment_create.
            drop(unsafe { Box::from_raw(attachment) });
        }
        Ok(())
    });
}
