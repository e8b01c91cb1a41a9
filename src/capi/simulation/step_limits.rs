//! Limits on the cost of a step.

use std::mem::size_of;
use std::sync::atomic::AtomicU32;

use crate::capi::base::errors::shx_result;
use crate::capi::base::versioned::{Versioned, initialise};
use crate::error::{Result, check_not_negative};
use crate::meter::StepLimits;

/// The step ran to completion.
pub const SHX_STOP_NONE: u32 = 0;
/// The step reached max_work.
pub const SHX_STOP_WORK: u32 = 1;
/// The step reached max_seconds.
pub const SHX_STOP_TIME: u32 = 2;
/// The step was cancelled.
pub const SHX_STOP_CANCELLED: u32 = 3;

/// Limits on the cost of a step. Fill it with shx_step_limits_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_step_limits {
    /// Set by shx_step_limits_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Maximum work per substep on strands in contact or with constraints, in units of about one microsecond of
    /// one core. Work is counted, not timed, so results are identical to the bit on every machine and for any
    /// number of threads. 0 (default): shx_solver_options.max_work, or where that is 0 too 500 per element,
    /// and at least 450000: about half a second of one core for up to 900 elements, up to three times that in
    /// a tangle. A search for contacts is always finished: a step may spend more by one of them, and limits
    /// below its cost stop every step before a strand moves.
    pub max_work: u64,
    /// Maximum duration of the call, s. Results then depend on the clock. 0 (default):
    /// shx_solver_options.max_seconds, or where that is 0 too no limit. A step needs some time to finish after
    /// its last iteration; the solver learns how much from earlier steps and reserves it.
    pub max_seconds: f64,
    /// Null (default), or a flag that another thread sets to a non-zero value to cancel
    /// the step. It is polled many times per millisecond.
    pub cancel: *const u32,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles and pointers only.
unsafe impl Versioned for shx_step_limits {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self { struct_size: size_of::<Self>() as u32, reserved0: 0, max_work: 0, max_seconds: 0.0, cancel: std::ptr::null() }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_step_limits>() == 32 && std::mem::offset_of!(shx_step_limits, max_seconds) == 16);
};

impl shx_step_limits {
    /// The engine's own limits.
    ///
    /// # Safety `cancel` is null or lives as long as what is made of the limits, and whoever writes to it does
    /// so in one piece.
    pub(super) unsafe fn limits<'a>(&self) -> Result<StepLimits<'a>> {
        if self.reserved0 != 0 {
            return Err(crate::error::Error::invalid("limits.reserved0", self.reserved0, "0"));
        }
        check_not_negative(|| "limits.max_seconds".into(), self.max_seconds)?;
        // SAFETY: as the caller guarantees; an AtomicU32 has a u32's size and alignment.
        let cancel = unsafe { self.cancel.cast::<AtomicU32>().as_ref() };
        Ok(StepLimits {
            work: (self.max_work > 0).then_some(self.max_work),
            seconds: (self.max_seconds > 0.0).then_some(self.max_seconds),
            cancel,
        })
    }
}

/// Fills *limits with defaults. size is sizeof(shx_step_limits).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_step_limits_init(limits: *mut shx_step_limits, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that options holds size bytes.
    unsafe { initialise("shx_step_limits_init", "limits", limits, size) }
}
