//! Bytes of a file, and numbers out of them.

use std::path::Path;

use crate::error::Result;

/// Reads a whole file.
pub(super) fn read_file(path: &Path) -> Result<Vec<u8>> {
    todo!()
}
