//! Messages to the host. There is no process-wide logger: each solver has the callback of its definition.

use std::ffi::{CString, c_char, c_void};
use std::fmt;

use super::floating_point::with_host_mode;

/// A call failed. The message is that of shx_last_error.
pub const SHX_LOG_ERROR: u32 = 1;
/// Something needs attention: strands that did not converge or were rolled back, elements
/// that turn too far, a parallel_for that skipped items.
pub const SHX_LOG_WARN: u32 = 2;
/// Rare events, each in one readable line: a solver was created, a snapshot restored.
pub const SHX_LOG_INFO: u32 = 3;
/// One line per step, and every option of a solver when it is created.
pub const SHX_LOG_DEBUG: u32 = 4;

/// Receives log messages of a solver. user is shx_solver_def.log_user, level is one of SHX_LOG_,
/// message is UTF-8 and valid during the call only. It runs on the thread that called the
/// library, in that thread's floating-point mode. It must not call the same solver
/// (SHX_ERROR_BUSY), and it must return normally: no exceptions, no longjmp.
pub type shx_log_fn = Option<unsafe extern "C" fn(user: *mut c_void, level: u32, message: *const c_char)>;

/// A solver's callback and its limit.
pub(crate) struct LogSink {
    pub function: shx_log_fn,
    pub user: *mut c_void,
    pub level: u32,
}

// SAFETY: user is the host's pointer, passed back and never read; the host guarantees (shx_solver_def.log) that its callback
// may be called from any thread that calls the solver.
unsafe impl Send for LogSink {}
// SAFETY: as above.
unsafe impl Sync for LogSink {}

impl LogSink {
    /// Formats and sends a message if the host wants this level; costs nothing otherwise.
    pub(crate) fn message(&self, level: u32, text: fmt::Arguments<'_>) {
        let Some(function) = self.function else { return };
        if level > self.level {
            return;
        }
        let mut bytes = text.to_string().into_bytes();
        bytes.retain(|byte| *byte != 0);
        let Ok(message) = CString::new(bytes) else { return };
        // SAFETY: the function is the host's, called as its type says; message lives until it returns.
        with_host_mode(|| unsafe { function(self.user, level, message.as_ptr()) });
    }
}
