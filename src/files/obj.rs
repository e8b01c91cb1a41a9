//! Wavefront OBJ with polylines: `v` and `l` lines.

use std::path::Path;

use crate::error::Result;
use crate::files::curves::Curves;

/// Reads the polylines of an OBJ file.
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

/// Writes curves as one OBJ frame: a `v` line a point, then an `l` line a strand. Numbers are written so that reading them
/// gives the same floats.
///
/// # Errors
/// [`crate::error::Error::File`] naming the path when it cannot be written.
pub fn write(path: impl AsRef<Path>, curves: &Curves) -> Result<()> {
    todo!()
}

/// [`write`] into memory.
pub fn write_to_bytes(curves: &Curves) -> Vec<u8> {
    todo!()
}
