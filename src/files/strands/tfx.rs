//! TressFX `.tfx` files: tells the three versions apart, reads and writes them.
//!
//! Version 2 is text, versions 3 and 4 are binary. Points, held points, thickness, colours and the texture coordinates of roots
//! are kept where the version has them. Texture coordinates per point and lists of guides are checked to lie in the file and
//! skipped, as are settings for the generation of further hairs between the guides.

use std::path::Path;

use super::{tfx_binary, tfx_text};
use crate::error::{Error, Result};
use crate::files::curves::{Curves, CurvesFormat};
use crate::files::io::bytes::{self, f32_at};

/// Reads a `.tfx` file of version 2 (text), 3 or 4 (binary).
///
/// # Errors
/// [`Error::File`], [`Error::OutOfMemory`]: see [`Curves::read`].
pub fn read(path: impl AsRef<Path>) -> Result<Curves> {
    let path = path.as_ref();
    read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?)
}

/// [`read`] from memory. `name` replaces the path in errors.
///
/// # Errors
/// As [`read`].
pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<Curves> {
    if is_text(bytes) {
        return tfx_text::read(name, bytes);
    }
    if bytes.len() < 4 {
        return Err(Error::file(name, format_args!("truncated: no .tfx file has as few as {} bytes", bytes.len())));
    }
    let version = f32_at(bytes, 0);
    if version == 3.0 {
        tfx_binary::read_v3(name, bytes)
    } else if version == 4.0 {
        tfx_binary::read_v4(name, bytes)
    } else {
        Err(Error::file(
            name,
            format_args!(
                "the version at byte 0 is {version} (bytes {:02x?}); expected 3 or 4 as a float, or text that begins with \"version 2\"",
                &bytes[..4]
            ),
        ))
    }
}

/// The version of a `.tfx` file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TfxVersion {
    /// TressFX 2: text; strands may have different numbers of points.
    V2,
    /// TressFX 3: binary, all strands have equal numbers of points.
    V3,
    /// TressFX 4: binary, all strands have equal numbers of points; has a held flag for each point.
    V4,
}

impl TfxVersion {
    /// The version that curves were read from; for other curves the newest that can hold their strands.
    pub fn of(curves: &Curves) -> Self {
        match curves.format() {
            CurvesFormat::TfxV2Text => TfxVersion::V2,
            CurvesFormat::TfxV3 => TfxVersion::V3,
            CurvesFormat::TfxV4 => TfxVersion::V4,
            _ if curves.counts().iter().all(|count| *count == curves.counts()[0]) => TfxVersion::V4,
            _ => TfxVersion::V2,
        }
    }
}

/// Writes curves as a `.tfx` file of this version, with the extras that it can hold ([`Curves::lost_in`] lists the others).
/// Version 3 and 4 files give the same bytes when read and written if their sections follow the order of their headers, without
/// gaps and without skipped data; version 2 files give the same numbers.
///
/// Versions 2 and 3 can only hold both ends of every strand or nothing; other held points are lost. A version 4 file must say
/// which points are held: if the curves do not, the roots are.
///
/// # Errors
/// [`Error::File`] naming the path when it cannot be written, or when the curves exceed the format: strands with different
/// numbers of points (versions 3 and 4), more than 4 GiB.
pub fn write(path: impl AsRef<Path>, curves: &Curves, version: TfxVersion) -> Result<()> {
    let path = path.as_ref();
    bytes::write_file(path, &write_to_bytes(&path.display().to_string(), curves, version)?)
}

/// [`write()`] into memory. `name` replaces the path in errors.
///
/// # Errors
/// As [`write()`].
pub fn write_to_bytes(name: &str, curves: &Curves, version: TfxVersion) -> Result<Vec<u8>> {
    match version {
        TfxVersion::V2 => Ok(tfx_text::write(curves)),
        TfxVersion::V3 => tfx_binary::write_v3(name, curves),
        TfxVersion::V4 => tfx_binary::write_v4(name, curves),
    }
}

/// Whether exactly the first two and the last two points of every strand are held.
pub(in crate::files) fn holds_both_ends(curves: &Curves) -> bool {
    let Some(held) = &curves.extras().held else { return false };
    (0..curves.strand_count()).all(|strand| {
        let held = &held[curves.strand_range(strand)];
        held.iter().enumerate().all(|(index, held_here)| *held_here == (index < 2 || index + 2 >= held.len()))
    })
}

/// Whether these bytes start a version 2 file.
pub(in crate::files) fn is_text(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"version")
}

/// Whether these bytes start a version 3 or 4 file.
pub(in crate::files) fn is_binary(bytes: &[u8]) -> bool {
    bytes.len() >= 4 && [3.0, 4.0].contains(&f32_at(bytes, 0))
}

/// The held points of a file of version 2 or 3 that asks for both ends to be held: TressFX then holds the first two and the last
/// two of every strand. Otherwise TressFX always holds the first two, which says nothing about this file: `None`.
pub(super) fn held_ends(both: bool, counts: &[u32], points: usize) -> Result<Option<Vec<bool>>> {
    if !both {
        return Ok(None);
    }
    let mut held = bytes::list(points)?;
    for count in counts {
        held.extend((0..*count).map(|index| index < 2 || index + 2 >= *count));
    }
    Ok(Some(held))
}
