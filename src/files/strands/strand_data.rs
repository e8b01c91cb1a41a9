//! `.data` files of strands, as in the hair data sets of the University of Southern California and of Digital Salon.
//!
//! The number of strands as a 32-bit number, then for each strand its number of points as another and as many triples of floats,
//! all little-endian. Root first; no unit, no axis. The library reads them and does not write them: every other format holds
//! more.

use std::path::Path;

use crate::error::{Error, Result};
use crate::files::curves::{Curves, CurvesFormat, Extras};
use crate::files::io::bytes::{self, Section, u32_at};

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
    let (counts, mut all) = (counts(name, bytes, 2)?, bytes::list(bytes.len() / 12)?);
    let mut end = 4;
    for strand in 0..counts.len() {
        let section = strand_at(name, bytes, strand, end, 2)?;
        all.extend(section.floats::<3>("point")?);
        end = section.end() as u64;
    }
    Curves::from_parts(CurvesFormat::StrandData, counts, all, Extras::default())
}

/// Numbers of points, 0 and 1 included, and points as they are.
pub(super) fn as_it_is(name: &str, bytes: &[u8]) -> Result<(Vec<u32>, Vec<[f32; 3]>)> {
    let (counts, mut all) = (counts(name, bytes, 0)?, bytes::list(bytes.len() / 12)?);
    let mut end = 4;
    for strand in 0..counts.len() {
        let section = strand_at(name, bytes, strand, end, 0)?;
        all.extend(section.points_as_they_are()?);
        end = section.end() as u64;
    }
    Ok((counts, all))
}

/// Finds all strands, and so the file's length, before anything is allocated: the list is smaller than the file.
fn counts(name: &str, bytes: &[u8], least: u32) -> Result<Vec<u32>> {
    let strands = u32_at(Section::of(name, bytes, "number of strands", 0, 1, 4)?.bytes, 0) as usize;
    if strands == 0 {
        return Err(Error::file(name, "the number of strands at byte 0 is 0; expected at least one"));
    }
    let mut end = 4;
    for strand in 0..strands {
        end = strand_at(name, bytes, strand, end, least)?.end() as u64;
    }
    if end != bytes.len() as u64 {
        let has = bytes.len();
        return Err(Error::file(
            name,
            format_args!("oversized: {strands} strands end at byte {end}, and the file has {has} bytes"),
        ));
    }
    let mut counts = bytes::list(strands)?;
    end = 4;
    for strand in 0..strands {
        let section = strand_at(name, bytes, strand, end, least)?;
        counts.push((section.bytes.len() / 12) as u32);
        end = section.end() as u64;
    }
    Ok(counts)
}

/// The points, at least `least`, of a strand whose number of points is at byte `at`.
fn strand_at<'a>(name: &'a str, bytes: &'a [u8], strand: usize, at: u64, least: u32) -> Result<Section<'a>> {
    let count = u32_at(Section::of(name, bytes, "numbers of points of a strand", at, 1, 4)?.bytes, 0);
    if count < least {
        return Err(Error::file(name, format_args!("strand {strand} has {count} points (at byte {at}); expected at least two")));
    }
    Section::of(name, bytes, "points", at + 4, u64::from(count), 12)
}
