//! TressFX `.tfx` files: which of the three versions one is.

use std::path::Path;

use crate::error::Result;
use crate::files::curves::Curves;

/// Reads a `.tfx` file of version 2 (text), 3 or 4 (binary).
///
/// # Errors
/// [`crate::error::Error::File`], [`crate::error::Error::OutOfMemory`]: see [`Curves::read`].
pub fn read(path: impl AsRef<Path>) -> Result<Curves> {
    todo!()
}

/// [`read`] from memory. `name` stands for the path in errors.
///
/// # Errors
/// As [`read`].
pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<Curves> {
    todo!()
}
