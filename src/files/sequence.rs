//! A cache as a sequence of files: simulated frames in `stem.0001.obj`, `stem.0002.obj` and so on.

use std::fs;
use std::path::{Path, PathBuf};

use super::strands::hair;
use super::wavefront::obj;
use crate::error::{Error, Result};
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

/// What to do with frames of the same stem and format in the directory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Refuse to start.
    Refuse,
    /// Delete them first, so that no frames of an earlier, longer run remain after the new ones.
    Replace,
}

/// Writes a cache, one frame per call.
///
/// ```
/// use superhelix::io::{CacheFormat, Curves, Existing, Sequence, SequenceWriter};
///
/// let directory = std::env::temp_dir().join(format!("superhelix-sequence-example-{}", std::process::id()));
/// std::fs::create_dir_all(&directory).unwrap();
/// let mut writer = SequenceWriter::create(&directory, "hair", CacheFormat::Obj, 1, Existing::Replace)?;
/// for frame in 0..3 {
///     let x = frame as f32;
///     writer.write(&Curves::from_strands(&[[[x, 0.0, 0.0], [x, 0.0, -0.1]]])?)?;
/// }
/// let frames = Sequence::list(&directory, "hair", CacheFormat::Obj)?;
/// assert_eq!(frames.frames().len(), 3);
/// assert_eq!(frames.read(2)?.strand(0)[0][0], 2.0);
/// # std::fs::remove_dir_all(&directory).unwrap();
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug)]
pub struct SequenceWriter {
    directory: PathBuf,
    stem: String,
    format: CacheFormat,
    next: Option<u32>,
    written: u32,
}

impl SequenceWriter {
    /// Starts a sequence `directory/stem.NNNN.ext`; creates the directory if it does not exist. The first frame has the number
    /// `first_frame`; numbers have at least four digits.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a stem that is empty or has a path separator in it; [`Error::File`] when the directory
    /// cannot be created, read or cleared, or has frames of this name and `existing` is [`Existing::Refuse`].
    pub fn create(
        directory: impl AsRef<Path>,
        stem: &str,
        format: CacheFormat,
        first_frame: u32,
        existing: Existing,
    ) -> Result<Self> {
        check_stem(stem)?;
        let directory = directory.as_ref();
        fs::create_dir_all(directory).map_err(|error| Error::file(directory, format_args!("cannot be made: {error}")))?;
        let there = find(directory, stem, format)?;
        match (existing, there.first()) {
            (Existing::Refuse, Some((_, path))) => {
                return Err(Error::file(path, "is there already: a cache of this name would mix with it"));
            }
            (Existing::Replace, _) => {
                for (_, path) in &there {
                    fs::remove_file(path).map_err(|error| Error::file(path, format_args!("cannot be deleted: {error}")))?;
                }
            }
            (Existing::Refuse, None) => {}
        }
        Ok(Self { directory: directory.to_owned(), stem: stem.to_owned(), format, next: Some(first_frame), written: 0 })
    }

    /// Writes the next frame and returns its path.
    ///
    /// # Errors
    /// [`Error::File`] naming the path; the frame is then absent, and the next call tries the same number.
    pub fn write(&mut self, curves: &Curves) -> Result<PathBuf> {
        let Some(number) = self.next else {
            return Err(Error::file(self.directory.join(&self.stem), format_args!("frame {} was the last possible", u32::MAX)));
        };
        let path = self.directory.join(format!("{}.{number:04}.{}", self.stem, self.format.extension()));
        match self.format {
            CacheFormat::Obj => obj::write(&path, curves)?,
            CacheFormat::Hair => hair::write(&path, curves)?,
        }
        self.next = number.checked_add(1);
        self.written += 1;
        Ok(path)
    }

    /// [`SequenceWriter::write`] from the number of points of each strand and the points of all strands.
    ///
    /// # Errors
    /// As [`SequenceWriter::write`] and [`Curves::from_counts`].
    pub fn write_points(&mut self, counts: &[u32], points: &[[f32; 3]]) -> Result<PathBuf> {
        self.write(&Curves::from_counts(counts.to_vec(), points.to_vec())?)
    }

    /// Frames written so far.
    pub fn frame_count(&self) -> u32 {
        self.written
    }
}

/// A cache on disk: the frames in a directory, in order.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    frames: Vec<(u32, PathBuf)>,
}

impl Sequence {
    /// Lists the frames `directory/stem.NNNN.ext` by number.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a stem that is empty or has a path separator in it; [`Error::File`] when the directory
    /// cannot be read, has no such frame, has one twice, or misses one in between.
    pub fn list(directory: impl AsRef<Path>, stem: &str, format: CacheFormat) -> Result<Self> {
        check_stem(stem)?;
        let directory = directory.as_ref();
        let frames = find(directory, stem, format)?;
        let name = |number: u64| format!("{stem}.{number:04}.{}", format.extension());
        if frames.is_empty() {
            return Err(Error::file(directory, format_args!("holds no frame {stem}.NNNN.{}", format.extension())));
        }
        for pair in frames.windows(2) {
            let ((before, _), (after, path)) = (&pair[0], &pair[1]);
            if before == after {
                return Err(Error::file(path, format_args!("is frame {after}, which exists twice")));
            }
            let wanted = u64::from(*before) + 1;
            if u64::from(*after) != wanted {
                return Err(Error::file(directory.join(name(wanted)), "is missing from the sequence"));
            }
        }
        Ok(Self { frames })
    }

    /// Frame numbers and paths, in order.
    pub fn frames(&self) -> &[(u32, PathBuf)] {
        &self.frames
    }

    /// Reads the frame at `index` (0 is the first one, whatever its number).
    ///
    /// # Errors
    /// As [`Curves::read`]; [`Error::InvalidArgument`] when there is no such frame.
    pub fn read(&self, index: usize) -> Result<Curves> {
        match self.frames.get(index) {
            Some((_, path)) => Curves::read(path),
            None => Err(Error::invalid("index", index, format!("below {}, the number of frames", self.frames.len()))),
        }
    }
}

fn check_stem(stem: &str) -> Result<()> {
    // A path that is more than one plain name would write outside the directory.
    let plain = Path::new(stem).file_name().is_some_and(|name| name == stem) && !stem.contains(['/', '\\', '\0']);
    if plain { Ok(()) } else { Err(Error::invalid("stem", format!("{stem:?}"), "a file name without path separators")) }
}

/// The files of a directory that are frames of this stem and format, by number.
fn find(directory: &Path, stem: &str, format: CacheFormat) -> Result<Vec<(u32, PathBuf)>> {
    let cannot = |error: std::io::Error| Error::file(directory, format_args!("cannot be listed: {error}"));
    let mut frames = Vec::new();
    for entry in fs::read_dir(directory).map_err(cannot)? {
        let entry = entry.map_err(cannot)?;
        let name = entry.file_name();
        if let Some(number) = name.to_str().and_then(|name| frame_number(name, stem, format)) {
            frames.push((number, entry.path()));
        }
    }
    frames.sort();
    Ok(frames)
}

/// The number in `stem.NNNN.ext`.
fn frame_number(name: &str, stem: &str, format: CacheFormat) -> Option<u32> {
    let digits = name.strip_prefix(stem)?.strip_prefix('.')?.strip_suffix(format.extension())?.strip_suffix('.')?;
    if digits.len() < 4 || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    digits.parse().ok()
}
