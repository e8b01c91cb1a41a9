//! A cache: simulated frames as a sequence of files, `stem.0001.obj`, `stem.0002.obj` and so on.

use std::path::{Path, PathBuf};

use crate::error::Result;
use crate::files::curves::Curves;

/// The format of a cache's frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CacheFormat {
    /// Wavefront OBJ lines.
    Obj,
    /// Cem Yuksel's `.hair`.
    Hair,
}

impl CacheFormat {
    /// The file name's extension, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            CacheFormat::Obj => "obj",
            CacheFormat::Hair => "hair",
        }
    }
}

/// What to do with frames of the same stem and format that a directory already holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Refuse to begin.
    Refuse,
    /// Delete them first, so that frames of an earlier, longer run are not left behind the new ones.
    Replace,
}

/// Writes a cache, one frame a call.
#[derive(Debug)]
pub struct SequenceWriter {
    directory: PathBuf,
    stem: String,
    format: CacheFormat,
    next: u32,
    written: u32,
}

impl SequenceWriter {
    /// Begins a sequence `directory/stem.NNNN.ext`; makes the directory if it is not there. The first frame's number is `first_frame`.
    ///
    /// # Errors
    /// [`crate::error::Error::InvalidArgument`] for a stem that is empty or has a path separator in it;
    /// [`crate::error::Error::File`] when the directory cannot be made or read, or holds frames of this name and `existing` is [`Existing::Refuse`].
    pub fn create(
        directory: impl AsRef<Path>,
        stem: &str,
        format: CacheFormat,
        first_frame: u32,
        existing: Existing,
    ) -> Result<Self> {
        todo!()
    }

    /// Writes the next frame and gives its path.
    ///
    /// # Errors
    /// [`crate::error::Error::File`] naming the path; the frame is then not there, and the next call tries the same number.
    pub fn write(&mut self, curves: &Curves) -> Result<PathBuf> {
        todo!()
    }

    /// [`SequenceWriter::write`] from the number of points of each strand and the points of all strands.
    ///
    /// # Errors
    /// As [`SequenceWriter::write`] and [`Curves::from_counts`].
    pub fn write_points(&mut self, counts: &[u32], points: &[[f32; 3]]) -> Result<PathBuf> {
        todo!()
    }

    /// Frames written so far.
    pub fn frame_count(&self) -> u32 {
        self.written
    }
}

/// A cache on disk: the frames that a directory holds, in order.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    format: CacheFormat,
    frames: Vec<(u32, PathBuf)>,
}

impl Sequence {
    /// Lists the frames `directory/stem.NNNN.ext` by number.
    ///
    /// # Errors
    /// [`crate::error::Error::File`] when the directory cannot be read, holds no such frame, or one is missing in between.
    pub fn list(directory: impl AsRef<Path>, stem: &str, format: CacheFormat) -> Result<Self> {
        todo!()
    }

    /// Frame numbers and paths, in order.
    pub fn frames(&self) -> &[(u32, PathBuf)] {
        &self.frames
    }

    /// Reads the frame at `index` (0 is the first one, whatever its number).
    ///
    /// # Errors
    /// As [`Curves::read`]; [`crate::error::Error::InvalidArgument`] when there is no such frame.
    pub fn read(&self, index: usize) -> Result<Curves> {
        todo!()
    }
}
