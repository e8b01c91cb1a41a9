//! Part files: a file is written under a hidden name beside its target, so that no reader ever sees half of it.
//!
//! The next writer of the same path removes what a killed writer left behind.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use crate::error::{Error, Result};
use crate::platform::process_id;

/// The most parts of one target at a time, over all its writers.
const PARTS: u32 = 16;

/// A hidden file beside the target. A lock shows that its writer lives: the system releases it when the process ends, however it
/// ends. Dropping it removes the file.
#[derive(Debug)]
pub struct PartFile {
    path: PathBuf,
    /// The file itself.
    pub file: File,
}

impl PartFile {
    /// A part of `target`, open for reading and writing. Removes parts of the same target whose writers have died.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be created, or 16 others are writing the same target.
    pub fn create(target: &Path) -> Result<Self> {
        if target.file_name().is_none() {
            return Err(Error::file(target, "cannot be written: it has no file name"));
        }
        Self::new(target).map_err(|error| Error::file(target, format_args!("cannot be written: {error}")))
    }

    fn new(target: &Path) -> io::Result<Self> {
        let mut made = None;
        for number in 0..PARTS {
            let path = part_path(target, number);
            remove_stale(&path);
            if made.is_none() {
                made = Self::own(&path)?;
            }
        }
        made.ok_or_else(|| io::Error::new(io::ErrorKind::AlreadyExists, format!("{PARTS} others are writing it")))
    }

    /// A new file of this name, locked; `None` if another writer has the name.
    fn own(path: &Path) -> io::Result<Option<Self>> {
        let create = |path: &Path| File::options().read(true).write(true).create_new(true).open(path);
        let file = match create(path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => return Ok(None),
            opened => opened?,
        };
        match file.try_lock() {
            Ok(()) if is_at(&file, path) => Ok(Some(Self { path: path.to_owned(), file })),
            // Another writer took the file for stale before it was locked.
            Ok(()) | Err(TryLockError::WouldBlock) => Ok(None),
            // This file system has no locks: use a name that no other process has.
            Err(TryLockError::Error(_)) => {
                drop(file);
                fs::remove_file(path)?;
                let path = path.with_extension(format!("{}.part", process_id()));
                Ok(Some(Self { file: create(&path)?, path }))
            }
        }
    }

    /// Moves the file to the target's name.
    ///
    /// # Errors
    /// Those of the system.
    pub fn take_name(self, target: &Path) -> io::Result<()> {
        fs::rename(&self.path, target)
    }
}

impl io::Write for PartFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for PartFile {
    fn drop(&mut self) {
        // Nothing can be done about a failure here, and nothing depends on it; after a rename the file is gone.
        if is_at(&self.file, &self.path) {
            let _ = fs::remove_file(&self.path);
        }
    }
}

fn part_path(target: &Path, number: u32) -> PathBuf {
    let mut name = std::ffi::OsString::from(".");
    name.push(target.file_name().unwrap_or_default());
    name.push(format!(".{number}.part"));
    target.with_file_name(name)
}

/// Removes a part without a lock. A file that cannot be opened stays: the write itself reports what is wrong.
fn remove_stale(path: &Path) {
    if fs::symlink_metadata(path).is_ok_and(|there| there.is_file())
        && let Ok(file) = File::options().read(true).write(true).open(path)
        && file.try_lock().is_ok()
        && is_at(&file, path)
    {
        let _ = fs::remove_file(path);
    }
}

/// Whether an open file is the one with this name.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (file.metadata(), fs::symlink_metadata(path)) {
        (Ok(own), Ok(there)) => (own.dev(), own.ino()) == (there.dev(), there.ino()),
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_at(_file: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    #[test]
    fn stale_parts_go_and_living_ones_stay() {
        let directory = std::env::temp_dir().join(format!("superhelix-parts-{}", process_id()));
        fs::create_dir_all(&directory).expect("a directory");
        let target = directory.join("hair.usda");
        // What a killed process leaves: files without locks.
        for number in [0, 2, 15] {
            fs::write(part_path(&target, number), "half a frame").expect("a stale part");
        }
        fs::write(directory.join(".other.usda.0.part"), "").expect("another's part");
        let mut first = PartFile::create(&target).expect("a part");
        let second = PartFile::create(&target).expect("a second part");
        assert_ne!(first.path, second.path);
        let names = || {
            let entries = fs::read_dir(&directory).expect("a directory").flatten();
            let mut names: Vec<_> = entries.map(|entry| entry.file_name().into_string().expect("UTF-8")).collect();
            names.sort();
            names
        };
        assert_eq!(names(), [".hair.usda.0.part", ".hair.usda.1.part", ".other.usda.0.part"]);
        first.write_all(b"whole").expect("written");
        first.take_name(&target).expect("in its place");
        drop(second);
        assert_eq!(names(), [".other.usda.0.part", "hair.usda"]);
        assert_eq!(fs::read(&target).expect("the file"), b"whole");
        // The largest number, and one more.
        let all: Vec<_> = (0..PARTS).map(|_| PartFile::create(&target).expect("a part")).collect();
        assert!(PartFile::create(&target).expect_err("one too many").to_string().contains("16 others are writing it"));
        drop(all);
        fs::remove_dir_all(&directory).expect("removed");
    }
}
