//! TressFX `.tfx` files: which of the three versions one is.
//!
//! Version 2 is text, versions 3 and 4 are binary. Points, held points, thickness, colours and the texture coordinates of roots are
//! kept where the version has them. Texture coordinates a point and lists of guides are checked to lie in the file and left there;
//! settings for the generation of further hairs between the guides are left as well.

use std::path::Path;

use crate::error::{Error, Result};
use crate::files::bytes::{self, f32_at};
use crate::files::curves::Curves;
use crate::files::{tfx_binary, tfx_text};

/// Reads a `.tfx` file of version 2 (text), 3 or 4 (binary).
///
/// # Errors
/// [`Error::File`], [`Error::OutOfMemory`]: see [`Curves::read`].
pub fn read(path: impl AsRef<Path>) -> Result<Curves> {
    let path = path.as_ref();
    read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?)
}

/// [`read`] from memory. `name` stands for the path in errors.
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

/// Whether these bytes begin a version 2 file.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"version")
}

/// Whether these bytes begin a version 3 or 4 file.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    bytes.len() >= 4 && [3.0, 4.0].contains(&f32_at(bytes, 0))
}

/// Which points are held in a file of version 2 or 3 that asks for both ends to be held: TressFX then holds the first two and the
/// last two of every strand. Without that request it holds the first two always, which says nothing of this file: `None`.
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
