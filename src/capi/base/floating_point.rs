//! The floating-point mode: sets the default of IEEE 754 inside the library, and the host's own outside.
//!
//! A host may have set flush-to-zero, another rounding direction or trapping exceptions. The engine needs the default, both for its
//! accuracy and for the same bits in every host.
//!
//! Implemented for x86-64 (MXCSR) and aarch64 (FPCR, FPSR). WebAssembly has only the default mode. On other machines a host must not
//! change the mode.

use std::cell::Cell;

#[cfg(target_arch = "x86_64")]
mod machine {
    use std::arch::asm;

    pub type Mode = u32;
    /// Round to nearest, no flushing, all exceptions masked, no sticky flag set.
    pub const DEFAULT: Mode = 0x1f80;

    pub fn get() -> Mode {
        let mut mode: u32 = 0;
        // SAFETY: stores four bytes to a u32 of ours.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut mode, options(nostack, preserves_flags)) };
        mode
    }

    pub fn set(mode: Mode) {
        // SAFETY: loads a value that was read from this register, or its documented default: no reserved bit is set.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const mode, options(nostack, preserves_flags, readonly)) };
    }
}

#[cfg(target_arch = "aarch64")]
mod machine {
    use std::arch::asm;

    /// Control and status (sticky flags).
    pub type Mode = (u64, u64);
    pub const DEFAULT: Mode = (0, 0);

    pub fn get() -> Mode {
        let (control, status): (u64, u64);
        // SAFETY: reads two registers that user code may read.
        unsafe {
            asm!("mrs {}, fpcr", "mrs {}, fpsr", out(reg) control, out(reg) status, options(nomem, nostack, preserves_flags));
        }
        (control, status)
    }

    pub fn set((control, status): Mode) {
        // SAFETY: writes values that were read from these registers, or zero, their default.
        unsafe {
            asm!("msr fpcr, {}", "msr fpsr, {}", in(reg) control, in(reg) status, options(nostack, preserves_flags));
        }
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod machine {
    pub type Mode = ();
    pub const DEFAULT: Mode = ();
    pub fn get() -> Mode {}
    pub fn set(_: Mode) {}
}

thread_local! {
    /// The host's mode when it entered the library on this thread. Plain data: no destructor.
    static HOST: Cell<Option<machine::Mode>> = const { Cell::new(None) };
}

/// Sets the default mode during its lifetime; restores the host's, sticky flags included, when dropped.
pub(crate) struct DefaultMode {
    host: machine::Mode,
    outer: Option<machine::Mode>,
}

impl DefaultMode {
    pub(crate) fn enter() -> Self {
        let host = machine::get();
        machine::set(machine::DEFAULT);
        Self { host, outer: HOST.replace(Some(host)) }
    }
}

impl Drop for DefaultMode {
    fn drop(&mut self) {
        HOST.set(self.outer);
        machine::set(self.host);
    }
}

/// Runs a callback of the host in the host's own mode.
pub(crate) fn with_host_mode<R>(callback: impl FnOnce() -> R) -> R {
    let Some(host) = HOST.get() else { return callback() };
    let ours = machine::get();
    machine::set(host);
    let result = callback();
    machine::set(ours);
    result
}
