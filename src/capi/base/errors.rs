//! Result codes, and the text of the last error of each thread.

use std::cell::Cell;
use std::ffi::c_char;
use std::fmt::{self, Write};

use crate::error::Error;

/// Result of a function: SHX_OK or a negative SHX_ERROR_ code. Codes are never renumbered or reused. A
/// function that fails has changed nothing and written nothing; shx_last_error returns the message.
pub type shx_result = i32;

/// Success.
pub const SHX_OK: i32 = 0;
/// A required pointer is null. The message names it.
pub const SHX_ERROR_NULL_ARGUMENT: i32 = -1;
/// A value is invalid: not finite, out of range, an unknown enumerated value, a wrong
/// count. The message names the argument and the value.
pub const SHX_ERROR_INVALID_ARGUMENT: i32 = -2;
/// An id names nothing in this solver: it is null, its object was removed, or it belongs to another solver.
pub const SHX_ERROR_INVALID_ID: i32 = -3;
/// The struct_size of a structure is invalid. Fill structures with their _init functions.
pub const SHX_ERROR_STRUCT_SIZE: i32 = -4;
/// Your buffer is too small. The message gives the required size.
pub const SHX_ERROR_BUFFER_TOO_SMALL: i32 = -5;
/// The object is in use: the call came from one of its own
/// callbacks, or from a second thread at the same time.
pub const SHX_ERROR_BUSY: i32 = -6;
/// The data is not a snapshot, is truncated or corrupt, or has another version.
pub const SHX_ERROR_SNAPSHOT: i32 = -7;
/// Out of memory. Functions that add strands, bodies and constraints, take and restore snapshots, read,
/// sample, keep events, and read files ask for the memory that grows with your numbers before they use it: if
/// there is none, they change nothing. What cannot fail softly, since the program ends where it finds no
/// memory: blocks below 64 KiB, the working memory of shx_solver_step, shx_solver_settle, posing, fitting and
/// render hair, which grows with the longest strand and the number of strands in contact, and the memory that
/// another thread takes between asking and using.
pub const SHX_ERROR_OUT_OF_MEMORY: i32 = -8;
/// This version does not support the request. The message says what to use instead.
pub const SHX_ERROR_UNSUPPORTED: i32 = -9;
/// A file could not be read, written or parsed. The message names
/// the file, the position and what was expected there.
pub const SHX_ERROR_FILE: i32 = -10;
/// A bug in the library, caught before it could reach your program.
/// The solver of this call is now poisoned: destroy it.
pub const SHX_ERROR_INTERNAL: i32 = -100;
/// An earlier SHX_ERROR_INTERNAL left this solver in an unknown
/// state. It accepts no call but shx_solver_destroy.
pub const SHX_ERROR_POISONED: i32 = -101;

/// Capacity of an error's text in bytes, including the closing zero.
const CAPACITY: usize = 1024;

/// A text in a buffer without a destructor: a destructor in thread-local storage would pin the library after
/// `dlclose`.
struct LastError {
    length: Cell<usize>,
    text: [Cell<u8>; CAPACITY],
}

thread_local! {
    static LAST_ERROR: LastError = const { LastError { length: Cell::new(0), text: [const { Cell::new(0) }; CAPACITY] } };
}

const _: () = assert!(!std::mem::needs_drop::<LastError>());

impl LastError {
    fn push(&self, bytes: &[u8]) {
        let start = self.length.get();
        let fits = bytes.len().min(CAPACITY - 1 - start);
        for (cell, byte) in self.text[start..].iter().zip(&bytes[..fits]) {
            cell.set(*byte);
        }
        self.length.set(start + fits);
    }
}

/// Formats into the buffer without allocating, so that it works when memory has run out.
struct Appender<'a>(&'a LastError);

impl Write for Appender<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let room = CAPACITY - 1 - self.0.length.get();
        let mut end = text.len().min(room);
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        self.0.push(&text.as_bytes()[..end]);
        Ok(())
    }
}

/// The result code of an error.
pub(crate) fn code(error: &Error) -> shx_result {
    match error {
        Error::NullArgument { .. } => SHX_ERROR_NULL_ARGUMENT,
        Error::InvalidArgument { .. } => SHX_ERROR_INVALID_ARGUMENT,
        Error::InvalidId { .. } => SHX_ERROR_INVALID_ID,
        Error::StructSize { .. } => SHX_ERROR_STRUCT_SIZE,
        Error::BufferTooSmall { .. } => SHX_ERROR_BUFFER_TOO_SMALL,
        Error::Busy => SHX_ERROR_BUSY,
        Error::Snapshot { .. } => SHX_ERROR_SNAPSHOT,
        Error::OutOfMemory { .. } => SHX_ERROR_OUT_OF_MEMORY,
        Error::Unsupported { .. } => SHX_ERROR_UNSUPPORTED,
        Error::File { .. } => SHX_ERROR_FILE,
        Error::Panic { .. } => SHX_ERROR_INTERNAL,
        Error::Poisoned => SHX_ERROR_POISONED,
    }
}

/// Stores the error's text for this thread and returns its code.
pub(crate) fn remember(function: &str, error: &Error) -> shx_result {
    remember_text(function, code(error), format_args!("{error}"))
}

/// Keeps a text for this thread, without allocating, and gives the code.
pub(crate) fn remember_text(function: &str, code: shx_result, text: impl fmt::Display) -> shx_result {
    LAST_ERROR.with(|last| {
        last.length.set(0);
        // The appender never fails: what does not fit is cut.
        let _ = write!(Appender(last), "{function}: {text}");
        last.text[last.length.get()].set(0);
    });
    code
}

/// Returns the name of a result code, such as "SHX_ERROR_BUSY",
/// or "unknown result". Static text: do not free it.
/// Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn shx_result_name(result: shx_result) -> *const c_char {
    let name = match result {
        SHX_OK => c"SHX_OK",
        SHX_ERROR_NULL_ARGUMENT => c"SHX_ERROR_NULL_ARGUMENT",
        SHX_ERROR_INVALID_ARGUMENT => c"SHX_ERROR_INVALID_ARGUMENT",
        SHX_ERROR_INVALID_ID => c"SHX_ERROR_INVALID_ID",
        SHX_ERROR_STRUCT_SIZE => c"SHX_ERROR_STRUCT_SIZE",
        SHX_ERROR_BUFFER_TOO_SMALL => c"SHX_ERROR_BUFFER_TOO_SMALL",
        SHX_ERROR_BUSY => c"SHX_ERROR_BUSY",
        SHX_ERROR_SNAPSHOT => c"SHX_ERROR_SNAPSHOT",
        SHX_ERROR_OUT_OF_MEMORY => c"SHX_ERROR_OUT_OF_MEMORY",
        SHX_ERROR_UNSUPPORTED => c"SHX_ERROR_UNSUPPORTED",
        SHX_ERROR_FILE => c"SHX_ERROR_FILE",
        SHX_ERROR_INTERNAL => c"SHX_ERROR_INTERNAL",
        SHX_ERROR_POISONED => c"SHX_ERROR_POISONED",
        _ => c"unknown result",
    };
    name.as_ptr()
}

/// Copies the message of this thread's last error into buffer: UTF-8, truncated to capacity bytes
/// including the terminating zero. Returns the length of the whole message without the zero. The
/// message names the function, the argument and the value. It remains until the next error on this
/// thread; successful calls do not clear it. It is empty if there was no error. With a null buffer
/// or capacity 0 the function only returns the length.
/// Threads: any. Each thread has its own message.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_last_error(buffer: *mut c_char, capacity: usize) -> usize {
    LAST_ERROR.with(|last| {
        let length = last.length.get();
        if !buffer.is_null() && capacity > 0 {
            let mut copied = length.min(capacity - 1);
            // Never cut inside a UTF-8 sequence.
            while copied < length && copied > 0 && (last.text[copied].get() & 0xc0) == 0x80 {
                copied -= 1;
            }
            for (index, cell) in last.text[..copied].iter().enumerate() {
                // SAFETY: index < copied < capacity, and the caller's buffer holds capacity bytes.
                unsafe { *buffer.add(index) = cell.get() as c_char };
            }
            // SAFETY: copied < capacity.
            unsafe { *buffer.add(copied) = 0 };
        }
        length
    })
}
