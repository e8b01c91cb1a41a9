//! Versioned structures, which may grow.
//!
//! The first field is the size that the host was compiled with. An older host has a smaller size and gets the defaults for
//! fields that it does not know. A newer host has a larger size and must leave the rest at zero.

use std::mem::size_of;

use super::errors::shx_result;
use super::guard::call;
use super::types::MAX_COUNT;
use crate::error::{Error, Result};
use crate::memory;

/// More than any version of any structure will have: a larger number indicates uninitialised memory.
const LARGEST: usize = 4096;

/// A structure of plain C data that begins with its size.
///
/// # Safety
/// The type is `repr(C)`, begins with a `u32` size, has no padding, and every bit pattern is a value of it.
pub(crate) unsafe trait Versioned: Copy {
    /// The size of its first published form: the fields that every host has.
    const FIRST_SIZE: usize;
    /// The values that its `_init` function sets.
    fn defaults() -> Self;
}

fn check_size<T: Versioned>(argument: &str, size: usize) -> Result<()> {
    // Every structure grows by whole words, of 8 bytes where pointers have 8, so no version has another size.
    if size < T::FIRST_SIZE || size > LARGEST || !size.is_multiple_of(size_of::<usize>()) {
        return Err(Error::StructSize { argument: argument.into(), value: size });
    }
    Ok(())
}

/// The checked size field of a structure.
///
/// # Safety
/// `pointer` is null or points to a structure of the size that it states.
unsafe fn stated_size<T: Versioned>(argument: &str, pointer: *const T) -> Result<usize> {
    if pointer.is_null() {
        return Err(Error::NullArgument { argument: argument.into() });
    }
    // SAFETY: not null, and every version begins with this field. Unaligned, since a stride may be anything.
    let size = unsafe { pointer.cast::<u32>().read_unaligned() } as usize;
    check_size::<T>(argument, size)?;
    Ok(size)
}

/// Reads a structure of any known version.
///
/// # Safety
/// `pointer` is null or points to a structure of the size that it states.
pub(crate) unsafe fn read_versioned<T: Versioned>(argument: &str, pointer: *const T) -> Result<T> {
    // SAFETY: the same.
    let size = unsafe { stated_size(argument, pointer)? };
    for offset in size_of::<T>()..size {
        // SAFETY: inside the size that the structure states.
        if unsafe { *pointer.cast::<u8>().add(offset) } != 0 {
            // A newer host uses a field that this library does not know.
            return Err(Error::StructSize { argument: argument.into(), value: size });
        }
    }
    let mut value = T::defaults();
    // SAFETY: both sides hold that many bytes, and any bytes are a value of T.
    unsafe { std::ptr::copy_nonoverlapping(pointer.cast::<u8>(), (&raw mut value).cast::<u8>(), size.min(size_of::<T>())) };
    Ok(value)
}

/// Definitions in the caller's memory, a stride apart, each read by `read`, which receives its name. `name` is the structure's.
///
/// # Safety
/// `defs` is null or points to `count` structures, `stride` bytes apart, each of the size that it states.
pub(crate) unsafe fn definitions<T: Versioned, D>(
    name: &str,
    defs: *const T,
    stride: usize,
    count: usize,
    read: impl Fn(&T, &str) -> Result<D>,
) -> Result<Vec<D>> {
    if count > MAX_COUNT {
        return Err(Error::invalid("count", count, format!("a count up to {MAX_COUNT}")));
    }
    if count == 0 {
        return Ok(Vec::new());
    }
    if defs.is_null() {
        return Err(Error::NullArgument { argument: "defs".into() });
    }
    if stride == 0 || count.checked_mul(stride).is_none_or(|bytes| bytes > isize::MAX as usize) {
        return Err(Error::invalid(
            "def_stride",
            stride,
            format!("sizeof({name}), or the size of your structure that contains one"),
        ));
    }
    let one = |index: usize, argument: &str| {
        let def = defs.wrapping_byte_add(index * stride);
        // SAFETY: one of the caller's structures, of the size that it states.
        let (def, size) = unsafe { (read_versioned(argument, def)?, stated_size(argument, def)?) };
        if size > stride {
            return Err(Error::invalid("def_stride", stride, format!("at least {argument}.struct_size, {size}")));
        }
        read(&def, argument)
    };
    let mut definitions = memory::list(count)?;
    for index in 0..count {
        // Named only where it is wrong.
        definitions.push(one(index, "defs").or_else(|_| one(index, &format!("defs[{index}]")))?);
    }
    Ok(definitions)
}

/// A host's structure for the library to fill; its size is checked before anything else.
pub(crate) struct VersionedOutput<T: Versioned> {
    pointer: *mut T,
    size: usize,
}

impl<T: Versioned> VersionedOutput<T> {
    /// # Safety
    /// `pointer` points to a structure of the size that it states and stays so until `write`; or it is null.
    pub(crate) unsafe fn new(argument: &str, pointer: *mut T) -> Result<Self> {
        // SAFETY: the same.
        let size = unsafe { stated_size(argument, pointer.cast_const())? };
        Ok(Self { pointer, size })
    }

    /// Fills the fields that the host knows; the size stays the host's.
    pub(crate) fn write(self, value: &T) {
        let (start, end) = (size_of::<u32>(), self.size.min(size_of::<T>()));
        // SAFETY: `new` was promised a structure of self.size bytes; the value has size_of::<T>().
        unsafe {
            std::ptr::copy_nonoverlapping(
                std::ptr::from_ref(value).cast::<u8>().add(start),
                self.pointer.cast::<u8>().add(start),
                end - start,
            );
        }
    }
}

/// The work of every `_init` function: fills the fields that the host knows, sets struct_size, zeroes what only the host knows.
///
/// # Safety
/// `pointer` is null or points to `size` bytes.
pub(crate) unsafe fn initialise<T: Versioned>(
    function: &'static str,
    argument: &'static str,
    pointer: *mut T,
    size: usize,
) -> shx_result {
    call(function, || {
        if pointer.is_null() {
            return Err(Error::NullArgument { argument: argument.into() });
        }
        check_size::<T>(argument, size)?;
        let value = T::defaults();
        // SAFETY: the host says that it holds `size` bytes; T's bytes are read within T.
        unsafe {
            std::ptr::write_bytes(pointer.cast::<u8>(), 0, size);
            std::ptr::copy_nonoverlapping((&raw const value).cast::<u8>(), pointer.cast::<u8>(), size.min(size_of::<T>()));
            pointer.cast::<u32>().write_unaligned(size as u32);
        }
        Ok(())
    })
}
