//! The host's task system behind the engine's [`ParallelFor`].

use std::any::Any;
use std::ffi::c_void;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Arc, Mutex, PoisonError};

use super::floating_point::{DefaultMode, with_host_mode};
use crate::error::{Error, Result};
use crate::workers::{ParallelFor, Workers};

/// A piece of work that the library passes to shx_parallel_for_fn. It processes items begin
/// to end - 1. worker is any number that no other thread uses at the same time. You may
/// call it on any thread, in any floating-point mode.
pub type shx_range_fn = Option<unsafe extern "C" fn(task: *mut c_void, begin: u32, end: u32, worker: u32)>;

/// Your parallel loop. It must call function(task, begin, end, worker) on disjoint ranges that cover 0 to
/// count - 1, and return when all of those calls have returned. Ranges should hold at least min_range
/// items. user is the parallel_for_user of the structure that holds the callback. It runs on the thread
/// that called the library, in that thread's floating-point mode. It must not call the same solver
/// (SHX_ERROR_BUSY), and it must return normally: no exceptions, no longjmp. The calling thread processes
/// items that you skip; items that you pass twice are processed once.
pub type shx_parallel_for_fn =
    Option<unsafe extern "C" fn(user: *mut c_void, count: u32, min_range: u32, function: shx_range_fn, task: *mut c_void)>;

type HostFunction = unsafe extern "C" fn(*mut c_void, u32, u32, shx_range_fn, *mut c_void);

/// The host's function and its pointer.
struct HostParallelFor {
    function: HostFunction,
    user: *mut c_void,
}

// SAFETY: user is the host's pointer, passed back and never read; the host may be called from any thread that steps the solver.
unsafe impl Send for HostParallelFor {}
// SAFETY: as above.
unsafe impl Sync for HostParallelFor {}

/// One loop while it runs.
struct Loop<'a> {
    task: &'a (dyn Fn(u32, u32, u32) + Sync),
    panic: Mutex<Option<Box<dyn Any + Send>>>,
}

/// The host calls this for a range. A panic must not unwind into the host's frames: it is kept for the calling thread.
unsafe extern "C" fn range(task: *mut c_void, begin: u32, end: u32, worker: u32) {
    let _mode = DefaultMode::enter();
    // SAFETY: the pointer that `run` gave to the host, which calls this only until its own function returns.
    let running = unsafe { &*task.cast::<Loop<'_>>() };
    if let Err(payload) = catch_unwind(AssertUnwindSafe(|| (running.task)(begin, end, worker))) {
        running.panic.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(payload);
    }
}

/// The workers that a structure of the host asks for: its parallel loop, a number of threads, or (0 or 1) the calling one.
/// `argument` is the structure's name in errors.
pub(in crate::capi) fn workers(
    argument: &str,
    count: u32,
    parallel_for: shx_parallel_for_fn,
    user: *mut c_void,
) -> Result<Workers> {
    if count > 256 {
        return Err(Error::invalid(format!("{argument}.worker_count"), count, "0 to 256 threads"));
    }
    Ok(match (parallel_for, count) {
        (Some(function), _) => Workers::Host(Arc::new(HostParallelFor { function, user })),
        (None, 0 | 1) => Workers::Serial,
        (None, count) => Workers::Pool(count as usize),
    })
}

impl ParallelFor for HostParallelFor {
    /// Passes ranges on as they come: the solver itself ensures that every item is done once, whatever the host does.
    fn run(&self, count: u32, min_range: u32, task: &(dyn Fn(u32, u32, u32) + Sync)) {
        let running = Loop { task, panic: Mutex::new(None) };
        let pointer = (&raw const running).cast_mut().cast::<c_void>();
        // SAFETY: the host's function, called as its type says; the loop lives until it has returned.
        with_host_mode(|| unsafe { (self.function)(self.user, count, min_range, Some(range), pointer) });
        if let Some(payload) = running.panic.into_inner().unwrap_or_else(PoisonError::into_inner) {
            resume_unwind(payload);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_in_a_task_reaches_the_caller_and_not_the_host() {
        unsafe extern "C" fn all(user: *mut c_void, count: u32, _: u32, function: shx_range_fn, task: *mut c_void) {
            let function = function.expect("the engine's function");
            // SAFETY: called as the contract says; user is the test's number.
            unsafe {
                function(task, 0, 1, 0);
                function(task, 1, count, 0);
                *user.cast::<u32>() += 1;
            }
        }
        let mut returned = 0_u32;
        let host = HostParallelFor { function: all, user: (&raw mut returned).cast() };
        let caught = catch_unwind(AssertUnwindSafe(|| host.run(4, 1, &|_, _, _| panic!("inside"))));
        assert_eq!(caught.expect_err("the panic").downcast_ref::<&str>(), Some(&"inside"));
        assert_eq!(returned, 1);
    }
}
