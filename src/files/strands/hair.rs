//! Cem Yuksel's `.hair` files.
//!
//! A header of 128 bytes (little-endian): the letters `HAIR`; number of strands, number of points, a mask and the default number
//! of segments as 32-bit unsigned numbers; default thickness, transparency and three colour values as floats; 88 bytes of text.
//! Then, each only if its bit of the mask is set and in this order: bit 0, segments of each strand (16-bit; a strand has one
//! point more); bit 1, points (three floats); bit 2, thickness and bit 3, transparency (one float per point); bit 4, colours
//! (three floats per point).
//!
//! The header determines the file's length: a shorter file is refused as truncated and a longer one as oversized.

use std::path::Path;

use crate::error::{Error, Result};
use crate::files::curves::{Curves, CurvesFormat, Extras};
use crate::files::io::bytes::{self, Section, f32_at, u32_at};

/// Bytes of the header.
const HEAD: usize = 128;
/// Bits of the mask.
const SEGMENTS: u32 = 1;
const POINTS: u32 = 2;
const THICKNESS: u32 = 4;
const TRANSPARENCY: u32 = 8;
const COLORS: u32 = 16;

/// The header of a `.hair` file, beside the counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HairHeader {
    /// Segments of every strand when the file does not list them; otherwise unused.
    pub default_segments: u32,
    /// Whether the file lists the segments of each strand, even if all are equal.
    pub lists_segments: bool,
    /// Thickness where the file has none per point, file units.
    pub thickness: f32,
    /// Transparency where the file has none per point, 0 to 1.
    pub transparency: f32,
    /// Red, green and blue where the file has none per point, 0 to 1.
    pub color: [f32; 3],
    /// Free text, padded with zeros.
    pub info: [u8; 88],
}

impl Default for HairHeader {
    /// A human hair of 80 micrometres (in metres), opaque and brown.
    fn default() -> Self {
        let mut info = [0; 88];
        let text = b"written by superhelix; metres";
        info[..text.len()].copy_from_slice(text);
        Self { default_segments: 0, lists_segments: false, thickness: 8e-5, transparency: 0.0, color: [0.36, 0.25, 0.2], info }
    }
}

/// Reads a `.hair` file.
///
/// # Errors
/// [`Error::File`], [`Error::OutOfMemory`]: see [`Curves::read`].
pub fn read(path: impl AsRef<Path>) -> Result<Curves> {
    let path = path.as_ref();
    read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?)
}

/// [`read`] from memory. `name` replaces the path in errors.
///
/// # Errors
/// As [`read`].
pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<Curves> {
    let sections = Sections::of(name, bytes, 1)?;
    let extras = Extras {
        thickness: sections.thickness.map(|section| section.singles("thickness")).transpose()?,
        transparency: sections.transparency.map(|section| section.singles("transparency")).transpose()?,
        colors: sections.colors.map(|section| section.floats("colour")).transpose()?,
        hair_header: Some(sections.header),
        ..Extras::default()
    };
    Curves::from_parts(CurvesFormat::Hair, sections.counts, sections.points.floats("point")?, extras)
}

/// Numbers of points, 1 included, and points as they are.
pub(super) fn as_it_is(name: &str, bytes: &[u8]) -> Result<(Vec<u32>, Vec<[f32; 3]>)> {
    let sections = Sections::of(name, bytes, 0)?;
    Ok((sections.counts, sections.points.points_as_they_are()?))
}

/// What a file is made of.
struct Sections<'a> {
    header: HairHeader,
    counts: Vec<u32>,
    points: Section<'a>,
    thickness: Option<Section<'a>>,
    transparency: Option<Section<'a>>,
    colors: Option<Section<'a>>,
}

impl<'a> Sections<'a> {
    /// Finds all sections, and so the file's length, before anything is allocated. `least` is the least number of segments of a strand.
    fn of(name: &'a str, bytes: &'a [u8], least: u32) -> Result<Self> {
        let error = |reason: std::fmt::Arguments<'_>| Err(Error::file(name, reason));
        if bytes.len() < HEAD {
            return error(format_args!(
                "truncated: the header of a .hair file has {HEAD} bytes, and the file has {}",
                bytes.len()
            ));
        }
        if &bytes[..4] != b"HAIR" {
            return error(format_args!("begins with the bytes {:02x?}; expected the letters HAIR", &bytes[..4]));
        }
        let (strands, points, mask, default_segments) =
            (u32_at(bytes, 4), u32_at(bytes, 8), u32_at(bytes, 12), u32_at(bytes, 16));
        if strands == 0 {
            return error(format_args!("the number of strands at byte 4 is 0; expected at least one"));
        }
        if mask & !(SEGMENTS | POINTS | THICKNESS | TRANSPARENCY | COLORS) != 0 {
            return error(format_args!("the mask at byte 12 is {mask:#x}; only bits 0 to 4 have a meaning"));
        }
        if mask & POINTS == 0 {
            return error(format_args!("the mask at byte 12 is {mask:#x}: bit 1 is not set, so the file has no points"));
        }
        let header = HairHeader {
            default_segments,
            lists_segments: mask & SEGMENTS != 0,
            thickness: head_float(name, bytes, 20, "default thickness")?,
            transparency: head_float(name, bytes, 24, "default transparency")?,
            color: [
                head_float(name, bytes, 28, "default red")?,
                head_float(name, bytes, 32, "default green")?,
                head_float(name, bytes, 36, "default blue")?,
            ],
            info: std::array::from_fn(|index| bytes[40 + index]),
        };

        let mut end = HEAD as u64;
        let mut next = |bit: u32, what: &str, count: u32, width: u64| -> Result<Option<Section<'a>>> {
            if mask & bit == 0 {
                return Ok(None);
            }
            let section = Section::of(name, bytes, what, end, u64::from(count), width)?;
            end = section.end() as u64;
            Ok(Some(section))
        };
        let segments = next(SEGMENTS, "numbers of segments", strands, 2)?;
        let point_section = next(POINTS, "points", points, 12)?;
        let thickness = next(THICKNESS, "thicknesses", points, 4)?;
        let transparency = next(TRANSPARENCY, "transparencies", points, 4)?;
        let colors = next(COLORS, "colours", points, 12)?;
        if end != bytes.len() as u64 {
            return error(format_args!("oversized: by its header the file ends at byte {end}, and it has {} bytes", bytes.len()));
        }

        let counts = counts(name, strands, points, default_segments, segments, least)?;
        let Some(points) = point_section else { return error(format_args!("has no points")) };
        Ok(Self { header, counts, points, thickness, transparency, colors })
    }
}

/// The number of points of each strand; they add up to `points`.
fn counts(
    name: &str,
    strands: u32,
    points: u32,
    default_segments: u32,
    segments: Option<Section<'_>>,
    least: u32,
) -> Result<Vec<u32>> {
    let error = |reason: std::fmt::Arguments<'_>| Err(Error::file(name, reason));
    let Some(segments) = segments else {
        let total = u64::from(strands) * (u64::from(default_segments) + 1);
        if default_segments < least {
            return error(format_args!("the default number of segments at byte 16 is {default_segments}; expected at least one"));
        }
        if total != u64::from(points) {
            return error(format_args!(
                "{strands} strands of {default_segments} segments have {total} points, and the number of points at byte 8 is {points}"
            ));
        }
        // Each strand has at least one point, found in the file: this list is smaller than the file.
        let mut counts = bytes::list(strands as usize)?;
        counts.resize(strands as usize, default_segments + 1);
        return Ok(counts);
    };
    let mut counts = bytes::list(strands as usize)?;
    let mut total = 0;
    for (strand, pair) in segments.bytes.chunks_exact(2).enumerate() {
        let number = u32::from(u16::from_le_bytes([pair[0], pair[1]]));
        if number < least {
            return error(format_args!(
                "strand {strand} has {number} segments (at byte {}); expected at least one",
                segments.offset + 2 * strand
            ));
        }
        counts.push(number + 1);
        total += u64::from(number) + 1;
    }
    if total != u64::from(points) {
        return error(format_args!(
            "the segments listed from byte {} make {total} points, and the number of points at byte 8 is {points}",
            segments.offset
        ));
    }
    Ok(counts)
}

fn head_float(name: &str, bytes: &[u8], at: usize, what: &str) -> Result<f32> {
    let value = f32_at(bytes, at);
    if value.is_finite() {
        Ok(value)
    } else {
        Err(Error::file(name, format_args!("the {what} at byte {at} is {value}; expected a finite number")))
    }
}

/// Writes curves as a `.hair` file, with their thickness, transparency, colours and header. Curves read from a `.hair` file give
/// the same bytes.
///
/// # Errors
/// [`Error::File`] naming the path when it cannot be written, or when the curves exceed the format: 65536 points on a strand
/// where strands differ, 4294967295 points in total.
pub fn write(path: impl AsRef<Path>, curves: &Curves) -> Result<()> {
    let path = path.as_ref();
    bytes::write_file(path, &write_to_bytes(&path.display().to_string(), curves)?)
}

/// [`write()`] into memory. `name` replaces the path in errors.
///
/// # Errors
/// As [`write()`].
pub fn write_to_bytes(name: &str, curves: &Curves) -> Result<Vec<u8>> {
    let extras = curves.extras();
    let header = extras.hair_header.unwrap_or_default();
    let points = u32::try_from(curves.point_count())
        .map_err(|_| Error::file(name, format_args!("{} points are more than a .hair file can have", curves.point_count())))?;
    let uniform = curves.counts().iter().all(|count| *count == curves.counts()[0]);
    let lists_segments = header.lists_segments || !uniform;
    let default_segments = if lists_segments { header.default_segments } else { curves.counts()[0] - 1 };
    let bits = [
        (lists_segments, SEGMENTS),
        (true, POINTS),
        (extras.thickness.is_some(), THICKNESS),
        (extras.transparency.is_some(), TRANSPARENCY),
        (extras.colors.is_some(), COLORS),
    ];
    let mask = bits.iter().map(|(set, bit)| if *set { *bit } else { 0 }).sum::<u32>();

    let mut out = bytes::list(HEAD + 2 * curves.strand_count() + (12 + 4 + 4 + 12) * curves.point_count())?;
    out.extend_from_slice(b"HAIR");
    for number in [curves.strand_count() as u32, points, mask, default_segments] {
        out.extend_from_slice(&number.to_le_bytes());
    }
    for number in [header.thickness, header.transparency].iter().chain(&header.color) {
        out.extend_from_slice(&number.to_le_bytes());
    }
    out.extend_from_slice(&header.info);
    if lists_segments {
        for (strand, count) in curves.counts().iter().enumerate() {
            let segments = u16::try_from(count - 1).map_err(|_| {
                Error::file(
                    name,
                    format_args!("strand {strand} has {count} points; a .hair file can have 65536 where strands differ"),
                )
            })?;
            out.extend_from_slice(&segments.to_le_bytes());
        }
    }
    let mut write = |number: &f32| out.extend_from_slice(&number.to_le_bytes());
    curves.points().iter().flatten().for_each(&mut write);
    extras.thickness.iter().flatten().for_each(&mut write);
    extras.transparency.iter().flatten().for_each(&mut write);
    extras.colors.iter().flatten().flatten().for_each(&mut write);
    Ok(out)
}
