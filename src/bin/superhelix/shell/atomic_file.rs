//! Files that appear whole or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use superhelix::Error;
use superhelix::internals::files::io::part_file::PartFile;

use crate::shell::failure::Failure;

/// A file being written under another name beside its target. Dropped before [`AtomicFile::commit`], it leaves nothing; what a killed run left, the
/// next one that writes the same target removes.
#[derive(Debug)]
pub struct AtomicFile {
    target: PathBuf,
    writer: BufWriter<Place>,
}

/// Where bytes go until the end.
#[derive(Debug)]
enum Place {
    /// Beside the target.
    Part(PartFile),
    /// A pipe or a device, which cannot be replaced.
    Stream(File),
}

impl Write for Place {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Part(part) => part.write(bytes),
            Self::Stream(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Part(part) => part.flush(),
            Self::Stream(file) => file.flush(),
        }
    }
}

impl AtomicFile {
    /// Begins to write `path`. Fails at once when that cannot end well, so that no long run is lost to a mistyped directory.
    pub fn create(path: &Path) -> Result<Self, Failure> {
        let fail = |error: io::Error| Failure::file(path, format!("cannot be written: {error}"));
        // Through a symbolic link the file behind it is replaced, not the link.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        match fs::metadata(&target) {
            Ok(metadata) if metadata.is_dir() => return Err(Failure::file(path, "cannot be written: it is a directory")),
            Ok(metadata) if !metadata.is_file() => {
                let file = OpenOptions::new().write(true).open(&target).map_err(fail)?;
                return Ok(Self { target, writer: BufWriter::new(Place::Stream(file)) });
            }
            // Replacing needs no right to write to the old file: ask for it, so that read-only files stay as they are.
            Ok(_) => drop(OpenOptions::new().write(true).open(&target).map_err(fail)?),
            Err(_) => {}
        }
        let part = PartFile::create(&target).map_err(|error| match error {
            Error::File { reason, .. } => Failure::file(path, reason),
            other => Failure::file(path, other.to_string()),
        })?;
        Ok(Self { target, writer: BufWriter::new(Place::Part(part)) })
    }

    /// Ends the file and puts it in its place.
    pub fn commit(self) -> Result<(), Failure> {
        let Self { target, writer } = self;
        let finish = || -> io::Result<()> {
            match writer.into_inner().map_err(io::IntoInnerError::into_error)? {
                Place::Part(part) => {
                    part.file.sync_all()?;
                    part.take_name(&target)
                }
                Place::Stream(mut file) => file.flush(),
            }
        };
        finish().map_err(|error| Failure::file(&target, format!("cannot be written: {error}")))
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}
