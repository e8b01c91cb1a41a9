//! The whole state of a solver: images of it, and a hash.

use std::ffi::c_void;

use super::buffers::{Place, Places, array};
use super::errors::shx_result;
use super::guard::{read, shx_solver, write};

/// Writes a snapshot of everything that a step depends on (strands, roots, states, bodies, constraints,
/// gravity, wind, options; not callbacks and threads) to out_image, which holds capacity bytes, and its size
/// to *out_size. With a null out_image and capacity 0 it only returns the size. Snapshots are for this version
/// of the library on machines of the same byte order.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_snapshot(
    solver: *const shx_solver,
    out_image: *mut c_void,
    capacity: usize,
    out_size: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle, place for capacity bytes and for one number.
    unsafe {
        read("shx_solver_snapshot", solver, |core| {
            let size = Place::new("out_size", out_size)?;
            let bytes = if out_image.is_null() && capacity == 0 {
                core.snapshot()
            } else {
                let places = Places::new("out_image", "capacity", out_image.cast::<u8>(), capacity)?;
                let bytes = core.snapshot();
                places.write(&bytes)?;
                bytes
            };
            size.write(bytes.len());
            Ok(())
        })
    }
}

/// Restores a solver from a snapshot of size bytes. The ids that were valid when it was taken are valid again.
/// Further steps give the same bits as they did then.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_SNAPSHOT (not a snapshot, corrupt, of another version).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_restore(solver: *mut shx_solver, image: *const c_void, size: usize) -> shx_result {
    // SAFETY: the caller's handle and size bytes.
    unsafe {
        write("shx_solver_restore", solver, |core, _| {
            // A null image is a mistake even when its size is 0.
            let bytes = array("image", "size", image.cast::<u8>(), size.max(usize::from(image.is_null())))?;
            core.restore(bytes)
        })
    }
}

/// Returns a hash of everything that a step depends on. Equal states have equal hashes.
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_state_hash(solver: *const shx_solver, out_hash: *mut u64) -> shx_result {
    // SAFETY: the caller's handle and place for one number.
    unsafe {
        read("shx_solver_state_hash", solver, |core| {
            Place::new("out_hash", out_hash)?.write(core.state_hash());
            Ok(())
        })
    }
}
