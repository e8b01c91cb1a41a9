//! Roots: the host moves them, the strands follow.

use crate::capi::base::buffers::{FRAME_FORMATS, Writer, each, frames_of, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::types::{shx_input, shx_output, shx_strand_id};

/// Moves the roots of count strands smoothly, in position and rotation, to the given frames (SHX_FORMAT_FRAME,
/// one per id) over the next over_seconds of simulated time. 0: within the next substep. All or none. Call it
/// once per frame for all roots. Other strands continue their motion or remain at rest.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a value that is not
/// finite, a quaternion that is not of unit length, negative over_seconds).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_root_frames(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    frames: *const shx_input,
    over_seconds: f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and frames.
    unsafe {
        write("shx_solver_set_root_frames", solver, |core, _| {
            core.set_root_frames(&strand_ids(ids, count)?, &frames_of(frames, count)?, over_seconds)
        })
    }
}

/// Moves the roots of count strands to the given frames at once. Strands keep their shape and their velocity
/// relative to the root, and receive no impulse. Use it for cuts and new takes. All or none.
/// Errors: as shx_solver_set_root_frames.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_teleport_roots(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    frames: *const shx_input,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and frames.
    unsafe {
        write("shx_solver_teleport_roots", solver, |core, _| {
            core.teleport_roots(&strand_ids(ids, count)?, &frames_of(frames, count)?)
        })
    }
}

/// Writes the current root frames of count strands to frames
/// (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for the quaternions alone).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_root_frames(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    frames: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and memory for frames.
    unsafe {
        read("shx_solver_get_root_frames", solver, |core| {
            let ids = strand_ids(ids, count)?;
            let writer = Writer::required("frames", frames, FRAME_FORMATS, count)?;
            let found = each(&ids, |id| core.root_frame(id))?;
            for (index, frame) in found.iter().enumerate() {
                writer.frame(index, frame);
            }
            Ok(())
        })
    }
}
