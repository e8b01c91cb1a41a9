//! The floating-point mode: a host may have set flush-to-zero, another rounding direction or trapping exceptions. The engine
//! needs the default of IEEE 754, both for its accuracy and to give the same bits in every host.
//!
//! Done on x86-64 (MXCSR) and aarch64 (FPCR, FPSR). WebAssembly has no other mode than the default. On other machines the mode is left alone: a host
//! must not change it there.

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
    /// The mode that the host had when it entered the library on this thread. Plain data: no destructor.
    static HOST: Cell<Option<machine::Mode>> = const { Cell::new(None) };
}

/// The default mode for as long as it lives; then the host's again, its sticky flags included.
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

/// Runs a callback of the host in the mode that the host called us with.
pub(crate) fn with_host_mode<R>(callback: impl FnOnce() -> R) -> R {
    let Some(host) = HOST.get() else { return callback() };
    let ours = machine::get();
    machine::set(host);
    let result = callback();
    machine::set(ours);
    result
}
