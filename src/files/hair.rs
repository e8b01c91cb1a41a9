//! Cem Yuksel's `.hair` files.

use std::io::Write;
use std::path::Path;

use crate::error::Result;
use crate::files::curves::Curves;

/// What the head of a `.hair` file says beside the counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HairHeader {
    /// Segments of every strand when the file does not list them; otherwise only kept.
    pub default_segments: u32,
    /// Whether the file lists the segments of each strand, although all may be the same.
    pub lists_segments: bool,
    /// Thickness where the file gives none a point, file units.
    pub thickness: f32,
    /// Transparency where the file gives none a point, 0 to 1.
    pub transparency: f32,
    /// Red, green and blue where the file gives none a point, 0 to 1.
    pub color: [f32; 3],
    /// Free text, padded with zeros.
    pub info: [u8; 88],
}

/// Reads a `.hair` file.
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

/// Writes curves as a `.hair` file, with the thickness, transparency, colours and head that they carry. Curves that were read
/// from a `.hair` file give the same bytes.
///
/// # Errors
/// [`crate::error::Error::File`] naming the path when it cannot be written, or a strand has more points than the format can say (65536).
pub fn write(path: impl AsRef<Path>, curves: &Curves) -> Result<()> {
    todo!()
}

/// [`write`] into memory. `name` stands for the path in errors.
///
/// # Errors
/// As [`write`].
pub fn write_to_bytes(name: &str, curves: &Curves) -> Result<Vec<u8>> {
    todo!()
}
