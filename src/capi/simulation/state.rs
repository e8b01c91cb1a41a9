//! Snapshots of a solver's state, and a hash of it.

use std::ffi::c_void;
use std::mem::size_of;

use crate::capi::base::buffers::{OutputList, OutputValue, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::log::{LogSink, SHX_LOG_INFO};
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::error::{Error, Result};
use crate::solver::{RestoredOptions, Restoring, SnapshotShapes, Solver};

/// Writes a snapshot of everything that a step depends on (strands, roots, states, bodies, constraints,
/// gravity, wind, options; not callbacks and threads) to out_image, which holds capacity bytes, and its size
/// to *out_size. With a null out_image and capacity 0 it only returns the size, which is computed without
/// writing anything. Snapshots are for this version of the library on any machine. They contain the shapes of
/// bodies; shx_solver_snapshot_with can leave out those that never change.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL,
/// SHX_ERROR_OUT_OF_MEMORY.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_snapshot(
    solver: *const shx_solver,
    out_image: *mut c_void,
    capacity: usize,
    out_size: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle, place for capacity bytes and for one number.
    unsafe { read("shx_solver_snapshot", solver, |core| snapshot(core, SnapshotShapes::Included, out_image, capacity, out_size)) }
}

/// # Safety
/// `out_image` is null or has room for `capacity` bytes, `out_size` is null or has room for a number.
unsafe fn snapshot(
    core: &Solver,
    shapes: SnapshotShapes,
    out_image: *mut c_void,
    capacity: usize,
    out_size: *mut usize,
) -> Result<()> {
    // SAFETY: the same.
    let (place, image) =
        unsafe { (OutputValue::new("out_size", out_size)?, OutputList::image("out_image", out_image, capacity)?) };
    let size = core.snapshot_size(shapes);
    if let Some(image) = image {
        image.check_room(size)?;
        image.write(&core.snapshot_with(shapes)?)?;
    }
    place.write(size);
    Ok(())
}

/// The snapshot contains the shapes of all bodies.
pub const SHX_SNAPSHOT_SHAPES_INCLUDED: u32 = 1;
/// Meshes, hulls and grids that never deformed are referred to by hashes of their contents, 16 bytes each.
/// Restoring finds them in the bodies of the solver that is restored, or in what shx_solver_snapshot_shapes
/// wrote.
pub const SHX_SNAPSHOT_SHAPES_REFERENCED: u32 = 2;

/// What a snapshot contains. Fill it with shx_snapshot_def_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_snapshot_def {
    /// Set by shx_snapshot_def_init.
    pub struct_size: u32,
    /// SHX_SNAPSHOT_SHAPES_. Default SHX_SNAPSHOT_SHAPES_INCLUDED.
    pub shapes: u32,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers only.
unsafe impl Versioned for shx_snapshot_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self { struct_size: size_of::<Self>() as u32, shapes: SHX_SNAPSHOT_SHAPES_INCLUDED }
    }
}

const _: () = assert!(size_of::<shx_snapshot_def>() == 8);

/// Fills *def with defaults. size is sizeof(shx_snapshot_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_snapshot_def_init(def: *mut shx_snapshot_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_snapshot_def_init", "def", def, size) }
}

/// Does the same as shx_solver_snapshot in the way that def says. To keep many snapshots of one scene, take
/// them with SHX_SNAPSHOT_SHAPES_REFERENCED, and shx_solver_snapshot_shapes once.
/// Errors: as shx_solver_snapshot; SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (def).
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_snapshot_with(
    solver: *const shx_solver,
    def: *const shx_snapshot_def,
    out_image: *mut c_void,
    capacity: usize,
    out_size: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle, structure, place for capacity bytes and for one number.
    unsafe {
        read("shx_solver_snapshot_with", solver, |core| {
            let shapes = match read_versioned("def", def)?.shapes {
                SHX_SNAPSHOT_SHAPES_INCLUDED => SnapshotShapes::Included,
                SHX_SNAPSHOT_SHAPES_REFERENCED => SnapshotShapes::Referenced,
                other => return Err(Error::invalid("def.shapes", other, "one of SHX_SNAPSHOT_SHAPES_")),
            };
            snapshot(core, shapes, out_image, capacity, out_size)
        })
    }
}

/// Writes the shapes that snapshots of SHX_SNAPSHOT_SHAPES_REFERENCED refer to, each once, to out_image, which
/// holds capacity bytes, and their size to *out_size. With a null out_image and capacity 0 it only returns the
/// size. What it writes serves all snapshots until a body is added: pass it to shx_solver_restore_with.
/// Errors: as shx_solver_snapshot.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_snapshot_shapes(
    solver: *const shx_solver,
    out_image: *mut c_void,
    capacity: usize,
    out_size: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle, place for capacity bytes and for one number.
    unsafe {
        read("shx_solver_snapshot_shapes", solver, |core| {
            let (place, image) = (OutputValue::new("out_size", out_size)?, OutputList::image("out_image", out_image, capacity)?);
            let size = core.snapshot_shapes_size();
            if let Some(image) = image {
                image.check_room(size)?;
                image.write(&core.snapshot_shapes()?)?;
            }
            place.write(size);
            Ok(())
        })
    }
}

/// Restores a solver from a snapshot of size bytes. The ids that were valid when it was taken are valid again.
/// The options of the solver (shx_solver_options, shx_contact_options) become those of the snapshot, but for
/// worker_count and instruction_set: further steps give the same bits as they did then.
/// shx_solver_restore_with can keep the solver's own options.
/// The solver may be another one than the snapshot is of, in another process or on another machine. It then
/// has the same ids as the first: keep beside an id which solver it belongs to. What the solver held before is
/// gone. Ids that it gave out since the snapshot are invalid and are not given out again. Workers, callbacks
/// (a field of wind too) and user data stay the solver's own.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_SNAPSHOT (not a snapshot, corrupt, of another version, or
/// referring to a shape that is not there).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_restore(solver: *mut shx_solver, image: *const c_void, size: usize) -> shx_result {
    // SAFETY: the caller's handle and size bytes.
    unsafe {
        write("shx_solver_restore", solver, |core, log| {
            // A null image is a mistake even when its size is 0.
            let bytes = array("image", "size", image.cast::<u8>(), size.max(usize::from(image.is_null())))?;
            core.restore(bytes)?;
            restored("shx_solver_restore", core, log, size);
            Ok(())
        })
    }
}

fn restored(function: &str, core: &Solver, log: &LogSink, size: usize) {
    let (strands, bodies, constraints) = (core.strand_count(), core.body_ids().len(), core.constraint_ids().len());
    log.message(
        SHX_LOG_INFO,
        format_args!("{function}: {strands} strands, {bodies} bodies, {constraints} constraints from {size} bytes"),
    );
}

/// The options become those of the snapshot: further steps give the same bits as when it was taken.
pub const SHX_RESTORE_OPTIONS_SNAPSHOT: u32 = 1;
/// The solver keeps its own options, contact options included.
pub const SHX_RESTORE_OPTIONS_KEEP: u32 = 2;

/// How a snapshot is restored. Fill it with shx_restore_def_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_restore_def {
    /// Set by shx_restore_def_init.
    pub struct_size: u32,
    /// SHX_RESTORE_OPTIONS_. Default SHX_RESTORE_OPTIONS_SNAPSHOT.
    pub options: u32,
    /// What shx_solver_snapshot_shapes wrote, for a snapshot that refers to shapes which no body of the solver
    /// has. Default null.
    pub shapes: *const c_void,
    /// Number of bytes of shapes. Default 0.
    pub shapes_size: usize,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and pointers only.
unsafe impl Versioned for shx_restore_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            options: SHX_RESTORE_OPTIONS_SNAPSHOT,
            shapes: std::ptr::null(),
            shapes_size: 0,
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<shx_restore_def>() == 24 && std::mem::offset_of!(shx_restore_def, shapes) == 8);

impl shx_restore_def {
    /// # Safety
    /// `shapes` is null or points to `shapes_size` bytes that stay while what is made of them lives.
    unsafe fn restoring<'a>(&self) -> Result<Restoring<'a>> {
        let options = match self.options {
            SHX_RESTORE_OPTIONS_SNAPSHOT => RestoredOptions::Snapshot,
            SHX_RESTORE_OPTIONS_KEEP => RestoredOptions::Own,
            other => return Err(Error::invalid("def.options", other, "SHX_RESTORE_OPTIONS_SNAPSHOT or _KEEP")),
        };
        // SAFETY: the same.
        let shapes = unsafe { array("def.shapes", "def.shapes_size", self.shapes.cast::<u8>(), self.shapes_size)? };
        Ok(Restoring { options, shapes: (!shapes.is_empty()).then_some(shapes) })
    }
}

/// Fills *def with defaults. size is sizeof(shx_restore_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_restore_def_init(def: *mut shx_restore_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_restore_def_init", "def", def, size) }
}

/// Does the same as shx_solver_restore in the way that def says.
/// Errors: as shx_solver_restore; SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (def).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_restore_with(
    solver: *mut shx_solver,
    image: *const c_void,
    size: usize,
    def: *const shx_restore_def,
) -> shx_result {
    // SAFETY: the caller's handle, size bytes and structure of the size that it states.
    unsafe {
        write("shx_solver_restore_with", solver, |core, log| {
            let bytes = array("image", "size", image.cast::<u8>(), size.max(usize::from(image.is_null())))?;
            core.restore_with(bytes, &read_versioned("def", def)?.restoring()?)?;
            restored("shx_solver_restore_with", core, log, size);
            Ok(())
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
            OutputValue::new("out_hash", out_hash)?.write(core.state_hash());
            Ok(())
        })
    }
}
