//! Runs work on a separate thread.
//!
//! Some of the engine's dependencies keep thread-local variables with destructors: Rust's thread::spawn on the thread that
//! spawns, the dense matrix kernels on the thread that multiplies. On the host's thread they would keep the library mapped after
//! `dlclose` until that thread ends. So such work runs on a short-lived thread of the system's own, whose
//! thread-local variables are gone when it has been joined. It takes about 20 microseconds.

/// Runs the body on a new thread and waits for it, or on the calling thread if that fails.
#[cfg(unix)]
pub(crate) fn on_own_thread<R: Send>(body: impl FnOnce() -> R + Send) -> R {
    use std::ffi::c_void;
    use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

    struct Job<F, R> {
        body: Option<F>,
        result: Option<std::thread::Result<R>>,
    }

    extern "C" fn start<R, F: FnOnce() -> R>(job: *mut c_void) -> *mut c_void {
        // SAFETY: the job of the caller below, who waits for this thread before it looks at it again.
        let job = unsafe { &mut *job.cast::<Job<F, R>>() };
        if let Some(body) = job.body.take() {
            job.result = Some(catch_unwind(AssertUnwindSafe(body)));
        }
        std::ptr::null_mut()
    }

    fn spawn_and_join<R, F: FnOnce() -> R>(job: &mut Job<F, R>) {
        let argument: *mut c_void = std::ptr::from_mut(job).cast();
        // SAFETY: plain calls of the C library; the argument outlives the thread, which is joined here. Signals are blocked in the
        // new thread and in those that it makes: they are the host's, and a handler of its own must not run on a thread of ours.
        unsafe {
            let mut all: libc::sigset_t = std::mem::zeroed();
            let mut before: libc::sigset_t = std::mem::zeroed();
            libc::sigfillset(&raw mut all);
            libc::pthread_sigmask(libc::SIG_SETMASK, &raw const all, &raw mut before);
            let mut thread: libc::pthread_t = std::mem::zeroed();
            let made = libc::pthread_create(&raw mut thread, std::ptr::null(), start::<R, F>, argument);
            libc::pthread_sigmask(libc::SIG_SETMASK, &raw const before, std::ptr::null_mut());
            if made == 0 {
                libc::pthread_join(thread, std::ptr::null_mut());
            }
        }
    }

    let mut job = Job { body: Some(body), result: None };
    spawn_and_join(&mut job);
    if let Some(body) = job.body {
        return body();
    }
    match job.result {
        Some(Ok(result)) => result,
        Some(Err(payload)) => resume_unwind(payload),
        None => unreachable!("the thread took the body and left no result"),
    }
}

/// Runs the body on the calling thread: the problem that the other version avoids is one of `dlclose`.
#[cfg(not(unix))]
pub(crate) fn on_own_thread<R: Send>(body: impl FnOnce() -> R + Send) -> R {
    body()
}
