//! The one guard that every entry point goes through: null handle, re-entry, poisoned state, floating-point mode, panics.

use std::cell::UnsafeCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::TryLockError;
use std::sync::atomic::{AtomicBool, AtomicI32, AtomicU64, Ordering};

use super::errors::{SHX_OK, remember, shx_result};
use super::floating_point::DefaultMode;
use super::log::{LogSink, SHX_LOG_ERROR};
use crate::error::{Error, Result};
use crate::solver::Solver;

/// A solver holds strands, bodies, constraints and everything a step needs. shx_solver_create makes it, you
/// own it, shx_solver_destroy frees it. Calls that break the thread rules of a solver return SHX_ERROR_BUSY.
pub struct shx_solver {
    /// -1: a call that changes it is running; n > 0: n reading calls are.
    users: AtomicI32,
    poisoned: AtomicBool,
    core: UnsafeCell<Solver>,
    log: LogSink,
    /// The host's own number: readable at any time, from callbacks too.
    pub(crate) user_data: AtomicU64,
}

const _: () = {
    const fn shared_between_threads<T: Sync + Send>() {}
    shared_between_threads::<Solver>();
};

impl shx_solver {
    pub(crate) fn new(core: Solver, log: LogSink, user_data: u64) -> Self {
        Self {
            users: AtomicI32::new(0),
            poisoned: AtomicBool::new(false),
            core: UnsafeCell::new(core),
            log,
            user_data: AtomicU64::new(user_data),
        }
    }
}

/// Releases the solver at the end of the call.
struct Use<'a> {
    users: &'a AtomicI32,
    change: i32,
}

impl<'a> Use<'a> {
    fn exclusive(users: &'a AtomicI32) -> Result<Self> {
        match users.compare_exchange(0, -1, Ordering::Acquire, Ordering::Relaxed) {
            Ok(_) => Ok(Self { users, change: 1 }),
            Err(_) => Err(Error::Busy),
        }
    }

    fn shared(users: &'a AtomicI32) -> Result<Self> {
        users
            .fetch_update(Ordering::Acquire, Ordering::Relaxed, |count| (0..i32::MAX).contains(&count).then(|| count + 1))
            .map(|_| Self { users, change: -1 })
            .map_err(|_| Error::Busy)
    }
}

impl Drop for Use<'_> {
    fn drop(&mut self) {
        self.users.fetch_add(self.change, Ordering::Release);
    }
}

/// Why a lock is not available.
pub(crate) fn in_use<T>(error: TryLockError<T>) -> Error {
    match error {
        TryLockError::WouldBlock => Error::Busy,
        TryLockError::Poisoned(_) => Error::Poisoned,
    }
}

/// The message of a panic.
pub(crate) fn panic_message(payload: &(dyn std::any::Any + Send)) -> String {
    payload
        .downcast_ref::<&str>()
        .map(|text| (*text).to_string())
        .or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "a panic without a message".to_string())
}

/// Not inlined: arithmetic of the body must not be moved before the floating-point mode is set.
#[inline(never)]
fn run<R>(body: impl FnOnce() -> Result<R>) -> Result<R> {
    catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|payload| {
        let message = panic_message(&*payload);
        // The payload's own destructor might panic again: leak it.
        std::mem::forget(payload);
        Err(Error::Panic { message })
    })
}

/// A call without a solver.
pub(crate) fn call(function: &'static str, body: impl FnOnce() -> Result<()>) -> shx_result {
    let _mode = DefaultMode::enter();
    match run(body) {
        Ok(()) => SHX_OK,
        Err(error) => remember(function, &error),
    }
}

fn finish(function: &'static str, solver: &shx_solver, result: Result<()>) -> shx_result {
    let Err(error) = result else { return SHX_OK };
    if matches!(error, Error::Panic { .. }) {
        solver.poisoned.store(true, Ordering::Release);
    }
    solver.log.message(SHX_LOG_ERROR, format_args!("{function}: {error}"));
    // After the message: a callback may have failed on this thread in between.
    remember(function, &error)
}

/// A call that reads a solver.
///
/// # Safety
/// `solver` is null or alive.
pub(crate) unsafe fn read(
    function: &'static str,
    solver: *const shx_solver,
    body: impl FnOnce(&Solver) -> Result<()>,
) -> shx_result {
    let _mode = DefaultMode::enter();
    // SAFETY: the caller guarantees null or a valid handle.
    let Some(solver) = (unsafe { solver.as_ref() }) else {
        return remember(function, &Error::NullArgument { argument: "solver".into() });
    };
    let _use = match Use::shared(&solver.users) {
        Ok(shared) => shared,
        Err(error) => return remember(function, &error),
    };
    if solver.poisoned.load(Ordering::Acquire) {
        return remember(function, &Error::Poisoned);
    }
    // SAFETY: the count of users says that nobody is changing the solver while this call lasts.
    let core = unsafe { &*solver.core.get() };
    finish(function, solver, run(|| body(core)))
}

/// A call that changes a solver.
///
/// # Safety
/// `solver` is null or alive.
pub(crate) unsafe fn write(
    function: &'static str,
    solver: *mut shx_solver,
    body: impl FnOnce(&mut Solver, &LogSink) -> Result<()>,
) -> shx_result {
    let _mode = DefaultMode::enter();
    // SAFETY: the caller guarantees null or a valid handle. A shared reference: readers on other threads may hold one; the check below finds them.
    let Some(solver) = (unsafe { solver.as_ref() }) else {
        return remember(function, &Error::NullArgument { argument: "solver".into() });
    };
    let _use = match Use::exclusive(&solver.users) {
        Ok(exclusive) => exclusive,
        Err(error) => return remember(function, &error),
    };
    if solver.poisoned.load(Ordering::Acquire) {
        return remember(function, &Error::Poisoned);
    }
    // SAFETY: the count of users says that this call is alone with the solver.
    let core = unsafe { &mut *solver.core.get() };
    finish(function, solver, run(|| body(core, &solver.log)))
}

/// Destroys a solver, poisoned or not; ignores null. Joins its threads.
///
/// # Safety
/// `solver` is null or alive, and nobody uses it after this call unless it failed as busy.
pub(crate) unsafe fn destroy(function: &'static str, solver: *mut shx_solver) -> shx_result {
    let _mode = DefaultMode::enter();
    // SAFETY: the caller guarantees null or a valid handle.
    let Some(alive) = (unsafe { solver.as_ref() }) else { return SHX_OK };
    match Use::exclusive(&alive.users) {
        Ok(exclusive) => std::mem::forget(exclusive), // nobody can enter any more
        Err(error) => return remember(function, &error),
    }
    // SAFETY: made by Box::into_raw in shx_solver_create, and this call is alone with it.
    let owned = unsafe { Box::from_raw(solver) };
    match run(|| {
        drop(owned);
        Ok(())
    }) {
        Ok(()) => SHX_OK,
        Err(error) => remember(function, &error),
    }
}

/// Panics inside a call of this solver, to test what the guard makes of it. An ordinary Rust function: it is in no header and
/// in no export list.
///
/// # Safety
/// `solver` is null or alive.
#[doc(hidden)]
pub unsafe fn panic_inside(solver: *mut shx_solver) -> shx_result {
    // SAFETY: passed on.
    unsafe { write("panic_inside", solver, |_, _| panic!("a panic made for a test")) }
}
