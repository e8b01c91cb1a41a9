//! The host's allocator, for the C libraries: a global allocator that goes to the system until the host gives its own.
//!
//! Only the shared and the static library install it (`scripts/build_lib.sh`): programs in Rust choose their own.

use std::alloc::{GlobalAlloc, Layout, System};
use std::ffi::c_void;
use std::hint::{black_box, spin_loop};
use std::ptr::null_mut;
use std::sync::atomic::{AtomicPtr, AtomicU8, Ordering};

use super::errors::{
    SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_OUT_OF_MEMORY, SHX_ERROR_UNSUPPORTED, SHX_OK, remember_text,
    shx_result,
};

/// Your allocation: size bytes (above zero) at a multiple of alignment (a power of two), or null if there is
/// no memory. Any thread may call it at any time, threads of the library too, in any floating-point mode. It
/// must not call the library, and it must return normally: no exceptions, no longjmp.
pub type shx_alloc_fn = Option<unsafe extern "C" fn(user: *mut c_void, size: usize, alignment: usize) -> *mut c_void>;

/// Frees what shx_alloc_fn returned for this size and alignment. The same rules apply.
pub type shx_free_fn = Option<unsafe extern "C" fn(user: *mut c_void, memory: *mut c_void, size: usize, alignment: usize)>;

type Alloc = unsafe extern "C" fn(*mut c_void, usize, usize) -> *mut c_void;
type Free = unsafe extern "C" fn(*mut c_void, *mut c_void, usize, usize);

/// Nothing was allocated yet.
const UNUSED: u8 = 0;
/// Memory is the system's.
const SYSTEM: u8 = 1;
/// The host's functions are being written down.
const SETTING: u8 = 2;
/// They are, and the next allocation makes memory the host's.
const ASKING: u8 = 3;
/// Memory is the host's.
const HOST: u8 = 4;

static SOURCE: AtomicU8 = AtomicU8::new(UNUSED);
static ALLOC: AtomicPtr<c_void> = AtomicPtr::new(null_mut());
static FREE: AtomicPtr<c_void> = AtomicPtr::new(null_mut());
static USER: AtomicPtr<c_void> = AtomicPtr::new(null_mut());

/// Where memory comes from, which the first allocation decides.
#[inline(always)]
fn is_host() -> bool {
    match SOURCE.load(Ordering::Acquire) {
        SYSTEM => false,
        HOST => true,
        _ => decide(),
    }
}

#[cold]
fn decide() -> bool {
    loop {
        match SOURCE.compare_exchange(UNUSED, SYSTEM, Ordering::AcqRel, Ordering::Acquire) {
            Ok(_) | Err(SYSTEM) => return false,
            Err(HOST) => return true,
            Err(ASKING) => SOURCE.store(HOST, Ordering::Release),
            Err(_) => spin_loop(),
        }
    }
}

#[cold]
fn host_alloc(size: usize, alignment: usize) -> *mut u8 {
    // SAFETY: written by shx_set_allocator, from a function of this type, before the source became the host.
    let alloc = unsafe { std::mem::transmute::<*mut c_void, Alloc>(ALLOC.load(Ordering::Relaxed)) };
    // SAFETY: the host's function, called as its type says.
    unsafe { alloc(USER.load(Ordering::Relaxed), size, alignment).cast() }
}

#[cold]
fn host_free(memory: *mut u8, size: usize, alignment: usize) {
    // SAFETY: as in host_alloc.
    let free = unsafe { std::mem::transmute::<*mut c_void, Free>(FREE.load(Ordering::Relaxed)) };
    // SAFETY: the host's function, called as its type says with memory of the host's.
    unsafe { free(USER.load(Ordering::Relaxed), memory.cast(), size, alignment) }
}

/// The system's allocator, or the host's ([`shx_set_allocator`]). A library in C installs it as its `#[global_allocator]`.
#[derive(Debug, Clone, Copy)]
pub struct HostAllocator;

#[cfg(superhelix_c_library)]
#[global_allocator]
static GLOBAL: HostAllocator = HostAllocator;

// SAFETY: either source keeps the rules of GlobalAlloc, the host by contract; which of the two it is never changes once something was allocated.
unsafe impl GlobalAlloc for HostAllocator {
    #[inline]
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if is_host() {
            return host_alloc(layout.size(), layout.align());
        }
        // SAFETY: passed on.
        unsafe { System.alloc(layout) }
    }

    #[inline]
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        if is_host() {
            let memory = host_alloc(layout.size(), layout.align());
            if !memory.is_null() {
                // SAFETY: the host gave that many bytes.
                unsafe { memory.write_bytes(0, layout.size()) };
            }
            return memory;
        }
        // SAFETY: passed on.
        unsafe { System.alloc_zeroed(layout) }
    }

    #[inline]
    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        if is_host() {
            return host_free(memory, layout.size(), layout.align());
        }
        // SAFETY: passed on.
        unsafe { System.dealloc(memory, layout) }
    }

    #[inline]
    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if is_host() {
            let other = host_alloc(size, layout.align());
            if !other.is_null() {
                // SAFETY: both blocks have as many bytes, and they are two.
                unsafe { other.copy_from_nonoverlapping(memory, layout.size().min(size)) };
                host_free(memory, layout.size(), layout.align());
            }
            return other;
        }
        // SAFETY: passed on.
        unsafe { System.realloc(memory, layout, size) }
    }
}

/// Makes the library take all of its memory from your functions, for the whole process and until it is
/// unloaded. Call it before every other function of the library: what was allocated before could not be freed.
/// The pointers must remain valid until the library is unloaded. Stacks of threads, and what the C library
/// allocates for itself (threads, open files), do not go through your functions.
/// If alloc returns null, a function fails with SHX_ERROR_OUT_OF_MEMORY where it lists that code, and the
/// process aborts elsewhere, as it does without your functions.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (alloc returns memory that is not aligned),
/// SHX_ERROR_OUT_OF_MEMORY (alloc returns null at once), SHX_ERROR_UNSUPPORTED (too late: the library has
/// allocated already, or it has functions by an earlier call; or it is linked into a program in Rust, which
/// has its own allocator). Nothing has changed then.
/// Threads: any, but no other call of the library may run meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_set_allocator(alloc: shx_alloc_fn, free: shx_free_fn, user: *mut c_void) -> shx_result {
    const FUNCTION: &str = "shx_set_allocator";
    // Texts are fixed: to format one would allocate.
    let Some(alloc) = alloc else { return remember_text(FUNCTION, SHX_ERROR_NULL_ARGUMENT, "alloc is null") };
    let Some(free) = free else { return remember_text(FUNCTION, SHX_ERROR_NULL_ARGUMENT, "free is null") };
    match SOURCE.compare_exchange(UNUSED, SETTING, Ordering::AcqRel, Ordering::Acquire) {
        Ok(_) => {}
        Err(SYSTEM) => {
            let late = "too late: the library has allocated memory already; call it before every other function";
            return remember_text(FUNCTION, SHX_ERROR_UNSUPPORTED, late);
        }
        Err(_) => return remember_text(FUNCTION, SHX_ERROR_UNSUPPORTED, "an allocator is set already; it stays"),
    }
    let undo = |code, text| {
        SOURCE.store(UNUSED, Ordering::Release);
        remember_text(FUNCTION, code, text)
    };
    // SAFETY: the host's function, called as its type says.
    let probe = unsafe { alloc(user, 64, 64) };
    if probe.is_null() {
        return undo(SHX_ERROR_OUT_OF_MEMORY, "alloc returned null for 64 bytes");
    }
    let is_aligned = (probe as usize).is_multiple_of(64);
    // SAFETY: the host's function, called as its type says.
    unsafe { free(user, probe, 64, 64) };
    if !is_aligned {
        return undo(SHX_ERROR_INVALID_ARGUMENT, "alloc returned memory that is not at a multiple of 64 when asked for that");
    }
    ALLOC.store(alloc as *mut c_void, Ordering::Relaxed);
    FREE.store(free as *mut c_void, Ordering::Relaxed);
    USER.store(user, Ordering::Relaxed);
    // An allocation that comes here makes the host the source; in a program that has another allocator none does.
    SOURCE.store(ASKING, Ordering::Release);
    let layout = Layout::new::<u64>();
    // SAFETY: the layout has a size; the memory is freed where there is any.
    unsafe {
        let memory = black_box(std::alloc::alloc(layout));
        if !memory.is_null() {
            std::alloc::dealloc(memory, layout);
        }
    }
    if SOURCE.load(Ordering::Acquire) == HOST {
        SHX_OK
    } else {
        undo(
            SHX_ERROR_UNSUPPORTED,
            "alloc, free and user cannot be used: the library is part of a program in Rust, which has its own allocator",
        )
    }
}
