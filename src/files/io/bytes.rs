//! Reading and writing whole files, and little-endian numbers in bytes.

use std::fs::{self, File};
use std::io::{Read, Write};
use std::path::Path;

use super::part_file::PartFile;
use crate::error::{Error, Result};
pub(in crate::files) use crate::memory::{list, reserve};

/// The most to read from something without a size of its own (a pipe): 1 GiB.
const PIPE_LIMIT: u64 = 1 << 30;

/// Reads a whole file. Allocates once, by the size that the file system reports; reads a pipe to its end, up to [`PIPE_LIMIT`].
/// Refuses directories and devices.
pub(in crate::files) fn read_file(path: &Path) -> Result<Vec<u8>> {
    let cannot = |error: std::io::Error| Error::file(path, format_args!("cannot be read: {error}"));
    // Checked before it is opened: opening a device may already have an effect.
    let kind = fs::metadata(path).map_err(cannot)?.file_type();
    if !(kind.is_file() || is_pipe(&kind)) {
        return Err(Error::file(path, if kind.is_dir() { "is a directory" } else { "is neither a file nor a pipe" }));
    }
    let mut file = File::open(path).map_err(cannot)?;
    let stated = file.metadata().map_err(cannot)?.len();
    let mut bytes = Vec::new();
    if kind.is_file() {
        let size = usize::try_from(stated).map_err(|_| Error::OutOfMemory { bytes: usize::MAX })?;
        reserve(&mut bytes, size)?;
        // Reads one byte more than the reported size, to notice a file that grows.
        let read = (&mut file).take(stated).read_to_end(&mut bytes).map_err(cannot)?;
        if read != size || file.read(&mut [0]).map_err(cannot)? != 0 {
            return Err(Error::file(path, format_args!("changed while it was read ({size} bytes at first)")));
        }
    } else {
        let mut chunk = vec![0; 1 << 16];
        loop {
            let read = match file.read(&mut chunk) {
                Ok(0) => break,
                Ok(read) => read,
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(cannot(error)),
            };
            if (bytes.len() + read) as u64 > PIPE_LIMIT {
                return Err(Error::file(path, format_args!("is a pipe that gave more than {PIPE_LIMIT} bytes")));
            }
            bytes.try_reserve(read).map_err(|_| Error::OutOfMemory { bytes: bytes.len() + read })?;
            bytes.extend_from_slice(&chunk[..read]);
        }
    }
    Ok(bytes)
}

#[cfg(unix)]
fn is_pipe(kind: &fs::FileType) -> bool {
    std::os::unix::fs::FileTypeExt::is_fifo(kind)
}

#[cfg(not(unix))]
fn is_pipe(_kind: &fs::FileType) -> bool {
    false
}

/// Writes a whole file: first to a hidden part file beside it, which then takes its name, so that no reader ever sees half a
/// file. A target that is not a regular file (a pipe, a device, a link) is written directly.
pub(in crate::files) fn write_file(path: &Path, bytes: &[u8]) -> Result<()> {
    let cannot = |error: std::io::Error| Error::file(path, format_args!("cannot be written: {error}"));
    if fs::symlink_metadata(path).is_ok_and(|there| !there.is_file()) {
        let mut file = File::options().write(true).truncate(true).open(path).map_err(cannot)?;
        return file.write_all(bytes).and_then(|()| file.flush()).map_err(cannot);
    }
    let mut part = PartFile::create(path)?;
    part.file.write_all(bytes).and_then(|()| part.file.flush()).map_err(cannot)?;
    part.take_name(path).map_err(cannot)
}

/// A part of a binary file, known to be inside it.
#[derive(Clone, Copy)]
pub(in crate::files) struct Section<'a> {
    /// The file's name, for errors.
    pub name: &'a str,
    /// Its offset in the file.
    pub offset: usize,
    /// Its bytes.
    pub bytes: &'a [u8],
}

impl<'a> Section<'a> {
    /// The part of `bytes` at `offset` with `count` items of `width` bytes, or the error that the file is too short. `what` names
    /// the part: "points".
    pub fn of(name: &'a str, bytes: &'a [u8], what: &str, offset: u64, count: u64, width: u64) -> Result<Self> {
        let end = count.checked_mul(width).and_then(|size| offset.checked_add(size));
        match end {
            Some(end) if end <= bytes.len() as u64 => {
                Ok(Self { name, offset: offset as usize, bytes: &bytes[offset as usize..end as usize] })
            }
            _ => Err(Error::file(
                name,
                format_args!(
                    "truncated: {count} {what} of {width} bytes from byte {offset} end at byte {}, and the file has {} bytes",
                    end.map_or("2^64 or beyond".to_owned(), |end| end.to_string()),
                    bytes.len()
                ),
            )),
        }
    }

    /// One past its last byte.
    pub fn end(&self) -> usize {
        self.offset + self.bytes.len()
    }

    /// All its floats, `N` per item, checked to be finite. `what` names an item: "point".
    pub fn floats<const N: usize>(&self, what: &str) -> Result<Vec<[f32; N]>> {
        let mut items = list(self.bytes.len() / (4 * N))?;
        for (index, item) in self.bytes.chunks_exact(4 * N).enumerate() {
            let mut values = [0.0; N];
            for (axis, value) in values.iter_mut().enumerate() {
                *value = f32::from_bits(u32_at(item, 4 * axis));
                if !value.is_finite() {
                    return Err(Error::file(
                        self.name,
                        format_args!(
                            "{}{what} {index} at byte {} is {value}; expected a finite number",
                            if N == 1 { String::new() } else { format!("number {axis} of ") },
                            self.offset + (index * N + axis) * 4
                        ),
                    ));
                }
            }
            items.push(values);
        }
        Ok(items)
    }

    /// All its points as they are: numbers may be infinite or not numbers.
    pub fn points_as_they_are(&self) -> Result<Vec<[f32; 3]>> {
        let mut points = list(self.bytes.len() / 12)?;
        points.extend(self.bytes.chunks_exact(12).map(|point| [0, 4, 8].map(|at| f32_at(point, at))));
        Ok(points)
    }

    /// [`Section::floats`] with one float per item.
    pub fn singles(&self, what: &str) -> Result<Vec<f32>> {
        // The layouts are the same: the compiler turns this into a copy.
        Ok(self.floats::<1>(what)?.into_iter().map(|[value]| value).collect())
    }
}

/// The 32-bit number at an offset that the caller has checked.
pub(in crate::files) fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

/// The float at an offset that the caller has checked.
pub(in crate::files) fn f32_at(bytes: &[u8], at: usize) -> f32 {
    f32::from_bits(u32_at(bytes, at))
}
