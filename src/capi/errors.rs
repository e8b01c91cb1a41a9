//! Result codes, and the text of the last error of each thread.

use std::cell::Cell;
use std::ffi::c_char;
use std::fmt::{self, Write};

use crate::error::Error;

/// What a fallible function returns: SHX_OK or one of the negative SHX_ERROR_ codes. Codes are never renumbered and never
/// reused. A function that fails has changed nothing and written nothing; shx_last_error gives the text.
pub type shx_result = i32;

/// Success.
pub const SHX_OK: i32 = 0;
/// A required pointer is null. The text names it.
pub const SHX_ERROR_NULL_ARGUMENT: i32 = -1;
/// A value is out of range: not a number, infinite, negative, an unknown enumerated value, a wrong count. The text names the
/// argument and the value.
pub const SHX_ERROR_INVALID_ARGUMENT: i32 = -2;
/// An id that names nothing in this solver: null, of a removed strand, or of another solver.
pub const SHX_ERROR_INVALID_ID: i32 = -3;
/// A structure's struct_size is not one that this library can read: it was not filled by its _init function.
pub const SHX_ERROR_STRUCT_SIZE: i32 = -4;
/// The caller's buffer is too short. The text says how many items are needed.
pub const SHX_ERROR_BUFFER_TOO_SMALL: i32 = -5;
/// The solver is in use: the call came from one of its own callbacks, or from a second thread at the same time.
pub const SHX_ERROR_BUSY: i32 = -6;
/// A snapshot image is not one, is truncated or damaged, or is of another version.
pub const SHX_ERROR_SNAPSHOT: i32 = -7;
/// Memory could not be had.
pub const SHX_ERROR_OUT_OF_MEMORY: i32 = -8;
/// A request that this version does not serve. The text says what to use instead.
pub const SHX_ERROR_UNSUPPORTED: i32 = -9;
/// A file could not be read, written or understood. The text names the file, the place and what was expected there.
pub const SHX_ERROR_FILE: i32 = -11;
/// A bug of the library was caught at its border. The solver of that call is poisoned: destroy it.
pub const SHX_ERROR_INTERNAL: i32 = -100;
/// An earlier SHX_ERROR_INTERNAL left this solver in an unknown state. Only shx_solver_destroy takes it.
pub const SHX_ERROR_POISONED: i32 = -101;

/// Bytes kept of an error's text, the closing zero included.
const CAPACITY: usize = 1024;

/// A text in a buffer without a destructor: a destructor in thread-local storage would pin the library after `dlclose`.
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

/// Formats into the buffer without allocating: it must work when memory is what ran out.
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

/// Keeps the error's text for this thread and gives its code.
pub(crate) fn remember(function: &str, error: &Error) -> shx_result {
    LAST_ERROR.with(|last| {
        last.length.set(0);
        // The appender never fails: what does not fit is cut.
        let _ = write!(Appender(last), "{function}: {error}");
        last.text[last.length.get()].set(0);
    });
    code(error)
}

/// The name of a result code, "SHX_ERROR_BUSY"; "unknown result" for a number that is none. The text is static: do not free it.
/// Any thread.
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

/// Copies the text of the last error on this thread into buffer, cut to capacity bytes with the closing zero (UTF-8), and
/// returns the length of the whole text without the zero. The text names the function, the argument and the value. It stays
/// until the next error on this thread; a call that succeeds does not clear it. Empty when there was none.
/// buffer may be null or capacity 0: only the length is returned. Any thread; each has its own text.
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
