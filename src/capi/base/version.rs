//! The library's version and build.

use std::ffi::c_char;

/// Major version. From 1 on it changes with every incompatible release.
pub const SHX_VERSION_MAJOR: u32 = 0;
/// Minor version: additions.
pub const SHX_VERSION_MINOR: u32 = 1;
/// Patch version: fixes.
pub const SHX_VERSION_PATCH: u32 = 0;
/// Version of this header as one increasing number: major << 24 | minor << 16 | patch << 8.
pub const SHX_VERSION: u32 = (SHX_VERSION_MAJOR << 24) | (SHX_VERSION_MINOR << 16) | (SHX_VERSION_PATCH << 8);
/// Binary interface of this header. It changes only when a program built against an older header could break.
pub const SHX_ABI_VERSION: u32 = 2;

const PLATFORM: &str = if cfg!(target_os = "linux") {
    "linux"
} else if cfg!(target_os = "macos") {
    "macos"
} else if cfg!(windows) {
    "windows"
} else if cfg!(target_os = "unknown") {
    "without a system"
} else {
    "other"
};

const MACHINE: &str = if cfg!(target_arch = "x86_64") {
    "x86_64"
} else if cfg!(target_arch = "aarch64") {
    "aarch64"
} else if cfg!(target_arch = "wasm32") {
    "wasm32"
} else {
    "other"
};

const CHECKS: &str = if cfg!(debug_assertions) { "debug assertions on" } else { "debug assertions off" };

const BUILD_INFO_PARTS: [&str; 7] = ["superhelix ", env!("CARGO_PKG_VERSION"), " ", MACHINE, " ", PLATFORM, ", "];

const BUILD_INFO_LENGTH: usize = {
    let mut length = CHECKS.len() + 1;
    let mut part = 0;
    while part < BUILD_INFO_PARTS.len() {
        length += BUILD_INFO_PARTS[part].len();
        part += 1;
    }
    length
};

const fn append(mut text: [u8; BUILD_INFO_LENGTH], start: usize, part: &str) -> [u8; BUILD_INFO_LENGTH] {
    let mut index = 0;
    while index < part.len() {
        text[start + index] = part.as_bytes()[index];
        index += 1;
    }
    text
}

/// Terminated by the array's initial zeros.
static BUILD_INFO: [u8; BUILD_INFO_LENGTH] = {
    let mut text = [0; BUILD_INFO_LENGTH];
    let mut start = 0;
    let mut part = 0;
    while part < BUILD_INFO_PARTS.len() {
        text = append(text, start, BUILD_INFO_PARTS[part]);
        start += BUILD_INFO_PARTS[part].len();
        part += 1;
    }
    append(text, start, CHECKS)
};

/// Returns the version of the loaded library, in the form of SHX_VERSION.
/// Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn shx_version() -> u32 {
    SHX_VERSION
}

/// Returns the binary interface of the loaded library. Compare
/// it with SHX_ABI_VERSION when your program starts.
/// Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn shx_abi_version() -> u32 {
    SHX_ABI_VERSION
}

/// Returns one line for bug reports: name, version, CPU,
/// operating system, checks. Static text: do not free it.
/// Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn shx_build_info() -> *const c_char {
    BUILD_INFO.as_ptr().cast()
}
