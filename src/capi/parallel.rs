//! The host's task system behind the engine's [`ParallelFor`].

use std::any::Any;
use std::ffi::c_void;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use super::floating_point::{DefaultMode, with_host_mode};
use crate::solver::definition::ParallelFor;

/// One piece of a shx_parallel_for_fn's work: items begin to end - 1 on worker (any number that no other thread has at the same
/// time). May be called from any thread of the host, in any floating-point mode.
pub type shx_range_fn = Option<unsafe extern "C" fn(task: *mut c_void, begin: u32, end: u32, worker: u32)>;

/// The host's parallel loop. Must call fn(task, begin, end, worker) over disjoint ranges that cover 0 to count - 1, each item
/// once, and return when all calls have returned. Ranges should hold min_range items or more. user is
/// shx_solver_def.parallel_for_user. Called on the thread that called the library, in its floating-point mode. Calling the same
/// solver from it gives SHX_ERROR_BUSY. It must return: no exception, no longjmp. Items that it leaves out are done by the
/// calling thread, and items that it gives twice are done once.
pub type shx_parallel_for_fn =
    Option<unsafe extern "C" fn(user: *mut c_void, count: u32, min_range: u32, function: shx_range_fn, task: *mut c_void)>;

type HostFunction = unsafe extern "C" fn(*mut c_void, u32, u32, shx_range_fn, *mut c_void);

/// The host's function and its pointer.
pub(crate) struct HostParallelFor {
    function: HostFunction,
    user: *mut c_void,
}

// SAFETY: user is the host's pointer, handed back and never looked at; the host may be called from any thread that steps the solver.
unsafe impl Send for HostParallelFor {}
// SAFETY: as above.
unsafe impl Sync for HostParallelFor {}

/// One loop while it runs.
struct Loop<'a> {
    task: &'a (dyn Fn(u32, u32, u32) + Sync),
    /// Items begun. Two threads on one item would be a data race, so an item given twice is refused the second time.
    begun: Vec<AtomicBool>,
    panic: Mutex<Option<Box<dyn Any + Send>>>,
}

impl Loop<'_> {
    /// Runs what nobody has begun of the items begin to end - 1.
    fn run_range(&self, begin: u32, end: u32, worker: u32) {
        let count = self.begun.len() as u32;
        let (mut item, end) = (begin.min(count), end.min(count));
        while item < end {
            if self.begun[item as usize].swap(true, Ordering::Relaxed) {
                item += 1;
                continue;
            }
            let first = item;
            item += 1;
            while item < end && !self.begun[item as usize].swap(true, Ordering::Relaxed) {
                item += 1;
            }
            self.call(first, item, worker);
            // The item that ended the run, if one did, was begun by another: pass it.
            item += 1;
        }
    }

    fn call(&self, begin: u32, end: u32, worker: u32) {
        if let Err(payload) = catch_unwind(AssertUnwindSafe(|| (self.task)(begin, end, worker))) {
            let mut kept = self.panic.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            kept.get_or_insert(payload);
        }
    }
}

/// What the host calls for a range.
unsafe extern "C" fn range(task: *mut c_void, begin: u32, end: u32, worker: u32) {
    let _mode = DefaultMode::enter();
    // SAFETY: the pointer that `run` gave to the host, which calls this only until its own function returns.
    let running = unsafe { &*task.cast::<Loop<'_>>() };
    running.run_range(begin, end, worker);
}

impl HostParallelFor {
    pub(crate) fn new(function: HostFunction, user: *mut c_void) -> Self {
        Self { function, user }
    }
}

impl ParallelFor for HostParallelFor {
    fn run(&self, count: u32, min_range: u32, task: &(dyn Fn(u32, u32, u32) + Sync)) {
        let running = Loop { task, begun: (0..count).map(|_| AtomicBool::new(false)).collect(), panic: Mutex::new(None) };
        let pointer = (&raw const running).cast_mut().cast::<c_void>();
        // SAFETY: the host's function, called as its type says; the loop lives until it has returned.
        with_host_mode(|| unsafe { (self.function)(self.user, count, min_range, Some(range), pointer) });
        // What the host left out.
        running.run_range(0, count, 0);
        if let Some(payload) = running.panic.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner) {
            resume_unwind(payload);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicU32;

    use super::*;

    fn count_items(function: HostFunction, count: u32) -> Vec<u32> {
        let items: Vec<AtomicU32> = (0..count).map(|_| AtomicU32::new(0)).collect();
        HostParallelFor::new(function, std::ptr::null_mut()).run(count, 1, &|begin, end, _| {
            for item in begin..end {
                items[item as usize].fetch_add(1, Ordering::Relaxed);
            }
        });
        items.into_iter().map(AtomicU32::into_inner).collect()
    }

    #[test]
    fn every_item_is_done_once_whatever_the_host_does() {
        unsafe extern "C" fn nothing(_: *mut c_void, _: u32, _: u32, _: shx_range_fn, _: *mut c_void) {}
        unsafe extern "C" fn twice(_: *mut c_void, count: u32, _: u32, function: shx_range_fn, task: *mut c_void) {
            let function = function.expect("the engine's function");
            // SAFETY: called as the contract says, but for overlaps and ranges that end too late or begin after their end.
            unsafe {
                function(task, 3, 7, 0);
                function(task, 0, 5, 1);
                function(task, 4, 6, 1);
                function(task, 9, 2, 1);
                function(task, count - 1, count + 100, 2);
                function(task, 6, 9, 2);
            }
        }
        assert_eq!(count_items(nothing, 11), [1; 11]);
        assert_eq!(count_items(twice, 23), [1; 23]);
    }

    #[test]
    fn a_panic_in_a_task_reaches_the_caller() {
        unsafe extern "C" fn all(_: *mut c_void, count: u32, _: u32, function: shx_range_fn, task: *mut c_void) {
            // SAFETY: called as the contract says.
            unsafe { function.expect("the engine's function")(task, 0, count, 0) };
        }
        let caught = catch_unwind(|| {
            HostParallelFor::new(all, std::ptr::null_mut()).run(4, 1, &|_, _, _| panic!("inside"));
        });
        assert_eq!(caught.expect_err("the panic").downcast_ref::<&str>(), Some(&"inside"));
    }
}
