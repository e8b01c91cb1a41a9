//! `.data` files of strands, as in the hair data sets of the University of Southern California and of Digital Salon.
//!
//! The number of strands as a 32-bit number, then for each strand its number of points as another and as many triples of floats,
//! all little-endian. Root first; no unit, no axis. The library reads them and does not write them: every other format holds
//! more.

use std::path::Path;

use crate::error::{Error, Result};
use crate::files::bytes::{self, Section, u32_at};
use crate::files::curves::{Curves, CurvesFormat, Extras};

/// Reads a `.data` file.
///
/// # Errors
/// [`Error::File`], [`Error::OutOfMemory`]: see [`Curves::read`]. Some data sets have strands of a single point for hairs that
/// were not grown. Like every strand of fewer than two points they are refused.
pub fn read(path: impl AsRef<Path>) -> Result<Curves> {
    let path = path.as_ref();
    read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?)
}

/// [`read`] from memory. `name` replaces the path in errors.
///
/// # Errors
/// As [`read`].
pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<Curves> {
    let error = |reason: std::fmt::Arguments<'_>| Err(Error::file(name, reason));
    let strands = u32_at(Section::of(name, bytes, "number of strands", 0, 1, 4)?.bytes, 0);
    if strands == 0 {
        return error(format_args!("the number of strands at byte 0 is 0; expected at least one"));
    }
    // Finds all strands, and so the file's length, before anything is allocated: the lists are smaller than the file.
    let (mut end, mut points) = (4_u64, 0_usize);
    for strand in 0..strands {
        let section = strand_at(name, bytes, strand, end)?;
        points += section.bytes.len() / 12;
        end = section.end() as u64;
    }
    if end != bytes.len() as u64 {
        return error(format_args!("oversized: {strands} strands end at byte {end}, and the file has {} bytes", bytes.len()));
    }
    let (mut counts, mut all) = (bytes::list(strands as usize)?, bytes::list(points)?);
    end = 4;
    for strand in 0..strands {
        let section = strand_at(name, bytes, strand, end)?;
        counts.push((section.bytes.len() / 12) as u32);
        all.extend(section.floats::<3>("point")?);
        end = section.end() as u64;
    }
    Curves::from_parts(CurvesFormat::StrandData, counts, all, Extras::default())
}

/// The points of a strand whose number of points is at byte `at`.
fn strand_at<'a>(name: &'a str, bytes: &'a [u8], strand: u32, at: u64) -> Result<Section<'a>> {
    let count = u32_at(Section::of(name, bytes, "numbers of points of a strand", at, 1, 4)?.bytes, 0);
    if count < 2 {
        return Err(Error::file(name, format_args!("strand {strand} has {count} points (at byte {at}); expected at least two")));
    }
    Section::of(name, bytes, "points", at + 4, u64::from(count), 12)
}
