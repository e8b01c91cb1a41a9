//! Creates, steps and destroys a solver.

use std::sync::atomic::Ordering;

use nalgebra::Vector3;

use super::solver_def::shx_solver_def;
use super::summary::Summary;
use crate::capi::base::buffers::{OutputValue, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{call, destroy, read, shx_solver, write};
use crate::capi::base::log::{SHX_LOG_DEBUG, SHX_LOG_INFO};
use crate::capi::base::thread::on_own_thread;
use crate::capi::base::versioned::{Versioned, read_versioned};
use crate::error::{Error, Result};
use crate::solver::Solver;
use crate::solver::definition::Workers;

/// Creates a solver. def may be null: all defaults. You own *out_solver; free it with shx_solver_destroy. The
/// callbacks and user pointers of def must remain valid until then.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (a value
/// out of range), SHX_ERROR_UNSUPPORTED (a combination or an instruction set that is not
/// available, or threads that could not be started).
/// Threads: any. A solver is not bound to the thread that created it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_create(def: *const shx_solver_def, out_solver: *mut *mut shx_solver) -> shx_result {
    call("shx_solver_create", || {
        // SAFETY: the caller's pointer to one pointer.
        let place = unsafe { OutputValue::new("out_solver", out_solver)? };
        let def = if def.is_null() {
            shx_solver_def::defaults()
        } else {
            // SAFETY: the caller's structure, of the size that it states.
            unsafe { read_versioned("def", def)? }
        };
        let log = def.log_sink()?;
        let options = def.options()?;
        let core = match options.workers {
            // Spawning threads leaves thread-local destructors behind on the thread that does it.
            Workers::Pool(_) => on_own_thread(|| Solver::new(options))?,
            _ => Solver::new(options)?,
        };
        log.message(SHX_LOG_INFO, format_args!("shx_solver_create: {}", Summary(core.options())));
        log.message(SHX_LOG_DEBUG, format_args!("shx_solver_create: {:?}", core.options()));
        place.write(Box::into_raw(Box::new(shx_solver::new(core, log, def.user_data))));
        Ok(())
    })
}

/// Frees a solver and joins its threads. Null is allowed. If a callback of the solver calls it, or another
/// thread is using the solver, it frees nothing, and shx_last_error has the message of SHX_ERROR_BUSY.
/// Threads: exclusive. The handle must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_destroy(solver: *mut shx_solver) {
    // SAFETY: the caller's handle, null or alive.
    unsafe { destroy("shx_solver_destroy", solver) };
}

/// Returns the number that shx_solver_def.user_data or shx_solver_set_own_user_data gave the solver. Snapshots
/// do not contain it.
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: shared; also in callbacks of the solver and while it steps.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_own_user_data(solver: *const shx_solver, out_user_data: *mut u64) -> shx_result {
    call("shx_solver_get_own_user_data", || {
        // SAFETY: the caller's handle, null or alive, and place for one number.
        let (solver, place) = unsafe { (solver.as_ref(), OutputValue::new("out_user_data", out_user_data)?) };
        let solver = solver.ok_or_else(|| Error::NullArgument { argument: "solver".into() })?;
        place.write(solver.user_data.load(Ordering::Relaxed));
        Ok(())
    })
}

/// Changes the number that shx_solver_get_own_user_data returns.
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: exclusive for this number alone: also in callbacks of the solver and while it steps.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_own_user_data(solver: *mut shx_solver, user_data: u64) -> shx_result {
    call("shx_solver_set_own_user_data", || {
        // SAFETY: the caller's handle, null or alive.
        let solver = unsafe { solver.as_ref() }.ok_or_else(|| Error::NullArgument { argument: "solver".into() })?;
        solver.user_data.store(user_data, Ordering::Relaxed);
        Ok(())
    })
}

fn vector(argument: &str, numbers: *const f64) -> Result<Vector3<f64>> {
    // SAFETY: the caller's three doubles, or null.
    let numbers: &[f64] = unsafe { array(argument, argument, numbers, 3)? };
    Ok(Vector3::new(numbers[0], numbers[1], numbers[2]))
}

/// Sets gravity, m/s^2, from the next step on.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (not finite).
/// Threads: exclusive.
/// cbindgen:ptrs-as-arrays=[[gravity; 3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_gravity(solver: *mut shx_solver, gravity: *const f64) -> shx_result {
    // SAFETY: the caller's handle, null or alive.
    unsafe { write("shx_solver_set_gravity", solver, |core, _| core.set_gravity(vector("gravity", gravity)?)) }
}

/// Sets the uniform wind, m/s, from the next step on. It acts on strands that have air_drag.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (not finite).
/// Threads: exclusive.
/// cbindgen:ptrs-as-arrays=[[wind; 3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_wind(solver: *mut shx_solver, wind: *const f64) -> shx_result {
    // SAFETY: the caller's handle, null or alive.
    unsafe { write("shx_solver_set_wind", solver, |core, _| core.set_wind(vector("wind", wind)?)) }
}

/// Returns the number of bytes that the solver has allocated, including all strands, bodies and
/// constraints. It excludes allocator overhead, thread stacks, and the scratch memory of each thread;
/// that grows with the longest strand, and with the number of strands in contact or with constraints.
/// Takes time proportional to the number of strands.
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_memory_usage(solver: *const shx_solver, out_bytes: *mut u64) -> shx_result {
    // SAFETY: the caller's handle, null or alive, and place for one number.
    unsafe {
        read("shx_solver_memory_usage", solver, |core| {
            OutputValue::new("out_bytes", out_bytes)?.write(core.memory_usage());
            Ok(())
        })
    }
}
