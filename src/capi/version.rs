//! Which library this is.

use std::ffi::c_char;

/// Major version: incompatible changes once it is 1 or more.
pub const SHX_VERSION_MAJOR: u32 = 0;
/// Minor version: additions.
pub const SHX_VERSION_MINOR: u32 = 1;
/// Patch version: corrections.
pub const SHX_VERSION_PATCH: u32 = 0;
/// The version of this header as one number that grows: major << 24 | minor << 16 | patch << 8.
pub const SHX_VERSION: u32 = (SHX_VERSION_MAJOR << 24) | (SHX_VERSION_MINOR << 16) | (SHX_VERSION_PATCH << 8);
/// The binary interface that this header describes. It changes only when a program built against an older one could break.
pub const SHX_ABI_VERSION: u32 = 2;

const PLATFORM: &str = if cfg!(target_os = "linux") {
    "linux"
} else if cfg!(target_os = "macos") {
    "macos"
} else if cfg!(windows) {
    "windows"
} else {
    "other"
};

const MACHINE: &str = if cfg!(target_arch = "x86_64") {
    "x86_64"
} else if cfg!(target_arch = "aarch64") {
    "aarch64"
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

/// Closed by the zero that the array begins with.
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

/// The version of the library that runs, in the form of SHX_VERSION. Any thread.
#[unsafe(no_mangle)]
pub extern "C" fn shx_version() -> u32 {
    SHX_VERSION
}

/// The binary interface of the library that runs. A program checks at its start that it equals SHX_ABI_VERSION. Any thread.
#[unsafe(no_mangle)]
pub extern "C" fn shx_abi_version() -> u32 {
    SHX_ABI_VERSION
}

/// One line for bug reports: name, version, machine, system, checks. Static: do not free it. Any thread.
#[unsafe(no_mangle)]
pub extern "C" fn shx_build_info() -> *const c_char {
    BUILD_INFO.as_ptr().cast()
}
