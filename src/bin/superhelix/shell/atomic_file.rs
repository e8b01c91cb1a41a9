//! Files that appear whole or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::shell::failure::Failure;

/// A file being written under another name beside its target. Dropped before [`AtomicFile::commit`], it leaves nothing.
#[derive(Debug)]
pub struct AtomicFile {
    target: PathBuf,
    /// The name in use until the end; none when the target is a pipe or a device, which cannot be replaced.
    temporary: Option<PathBuf>,
    writer: BufWriter<File>,
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
                return Ok(Self { target, temporary: None, writer: BufWriter::new(file) });
            }
            // Replacing needs no right to write to the old file: ask for it, so that read-only files stay as they are.
            Ok(_) => drop(OpenOptions::new().write(true).open(&target).map_err(fail)?),
            Err(_) => {}
        }
        let name = target.file_name().ok_or_else(|| Failure::file(path, "cannot be written: it names no file"))?;
        let mut temporary_name = std::ffi::OsString::from(".");
        temporary_name.push(name);
        temporary_name.push(format!(".{}.part", std::process::id()));
        let temporary = target.with_file_name(temporary_name);
        let file = OpenOptions::new().write(true).create_new(true).open(&temporary).map_err(fail)?;
        Ok(Self { target, temporary: Some(temporary), writer: BufWriter::new(file) })
    }

    /// Ends the file and puts it in its place.
    pub fn commit(mut self) -> Result<(), Failure> {
        let finished = self.finish();
        if finished.is_ok() {
            self.temporary = None;
        }
        finished.map_err(|error| Failure::file(&self.target, format!("cannot be written: {error}")))
    }

    fn finish(&mut self) -> io::Result<()> {
        self.writer.flush()?;
        if let Some(temporary) = &self.temporary {
            self.writer.get_ref().sync_all()?;
            fs::rename(temporary, &self.target)?;
        }
        Ok(())
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

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if let Some(temporary) = &self.temporary {
            // Nothing can be done about a failure here, and nothing depends on it.
            let _ = fs::remove_file(temporary);
        }
    }
}
