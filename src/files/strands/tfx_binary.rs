//! TressFX 3 and 4 `.tfx` files: a header of numbers and byte offsets, then sections.
//!
//! Version 3: version (a float), number of strands, points per strand, followers per guide, a one-byte flag "both ends held" in
//! four bytes, 31 reserved words; byte offsets of points (three floats), thickness (a float per strand), texture coordinates (two
//! floats per strand), colours (four floats per point), guide indices (a word per strand), texture coordinates per point; 32
//! reserved words. Version 4: version, number of strands, points per strand; byte offsets of points (four floats: x, y, z and w,
//! which is 0 on held points), texture coordinates (per strand), texture coordinates per point, thickness (per strand), colours
//! (per point); 32 reserved words. An offset of 0 means that the section is absent.
//!
//! Sections may be in any order and have gaps between them, but may not overlap each other or the header. More than seven bytes
//! after the last one (sections are aligned to eight) are refused as oversized: this is how a strand count that is too small
//! looks.

use super::tfx::{held_ends, holds_both_ends};
use crate::error::{Error, Result};
use crate::files::curves::{Curves, CurvesFormat, Extras};
use crate::files::io::bytes::{self, Section, u32_at};

/// Bytes of a version 3 header.
const HEAD_V3: usize = 296;
/// Bytes of a version 4 header.
const HEAD_V4: usize = 160;
/// Bytes that may follow the last section.
const PADDING: usize = 7;

/// The common contents of both versions' headers, and the sections found so far.
struct Head<'a> {
    name: &'a str,
    bytes: &'a [u8],
    length: usize,
    strands: u32,
    points: u64,
    points_each: u32,
    sections: Vec<(Section<'a>, &'static str)>,
}

impl<'a> Head<'a> {
    fn new(name: &'a str, bytes: &'a [u8], version: u32, length: usize) -> Result<Self> {
        if bytes.len() < length {
            return Err(Error::file(
                name,
                format_args!(
                    "truncated: the header of a version {version} .tfx file has {length} bytes, and the file has {}",
                    bytes.len()
                ),
            ));
        }
        let (strands, points_each) = (u32_at(bytes, 4), u32_at(bytes, 8));
        if strands == 0 {
            return Err(Error::file(name, "the number of strands at byte 4 is 0; expected at least one"));
        }
        if points_each < 2 {
            return Err(Error::file(
                name,
                format_args!("the number of points a strand at byte 8 is {points_each}; expected at least two"),
            ));
        }
        let points = u64::from(strands) * u64::from(points_each);
        Ok(Self { name, bytes, length, strands, points, points_each, sections: Vec::new() })
    }

    /// The section whose offset is at byte `at`; `None` if the file has none.
    fn section(&mut self, at: usize, what: &'static str, count: u64, width: u64) -> Result<Option<Section<'a>>> {
        let offset = u32_at(self.bytes, at);
        if offset == 0 {
            return Ok(None);
        }
        if (offset as usize) < self.length {
            return Err(Error::file(
                self.name,
                format_args!(
                    "the {what} (offset at byte {at}) begin at byte {offset}, inside the header of {} bytes",
                    self.length
                ),
            ));
        }
        let section = Section::of(self.name, self.bytes, what, u64::from(offset), count, width)?;
        for (other, other_what) in &self.sections {
            if section.offset < other.end() && other.offset < section.end() {
                return Err(Error::file(
                    self.name,
                    format_args!(
                        "the {what} (bytes {} to {}) overlap the {other_what} (bytes {} to {})",
                        section.offset,
                        section.end(),
                        other.offset,
                        other.end()
                    ),
                ));
            }
        }
        self.sections.push((section, what));
        Ok(Some(section))
    }

    /// The points' section, which is required.
    fn point_section(&mut self, at: usize, width: u64) -> Result<Section<'a>> {
        let (name, points) = (self.name, self.points);
        self.section(at, "points", points, width)?
            .ok_or_else(|| Error::file(name, format_args!("the offset of the points at byte {at} is 0: the file has none")))
    }

    /// Checks that the file ends where its last section does.
    fn check_end(&self) -> Result<()> {
        let end = self.sections.iter().map(|(section, _)| section.end()).max().unwrap_or(self.length);
        if self.bytes.len() - end > PADDING {
            return Err(Error::file(
                self.name,
                format_args!("oversized: by its header the file ends at byte {end}, and it has {} bytes", self.bytes.len()),
            ));
        }
        Ok(())
    }

    fn counts(&self) -> Result<Vec<u32>> {
        let mut counts = bytes::list(self.strands as usize)?;
        counts.resize(self.strands as usize, self.points_each);
        Ok(counts)
    }
}

/// Colours without their fourth number (opacity, which TressFX does not read either).
fn colors(section: Option<Section<'_>>) -> Result<Option<Vec<[f32; 3]>>> {
    let Some(section) = section else { return Ok(None) };
    let colors = section.floats::<4>("colour")?;
    Ok(Some(colors.into_iter().map(|[red, green, blue, _]| [red, green, blue]).collect()))
}

/// Reads version 3, whose first four bytes have been checked.
pub(super) fn read_v3(name: &str, bytes: &[u8]) -> Result<Curves> {
    let mut head = Head::new(name, bytes, 3, HEAD_V3)?;
    let (strands, points) = (u64::from(head.strands), head.points);
    // The three bytes after this one are a compiler's padding, with any contents.
    let both_ends_held = match bytes[16] {
        0 => false,
        1 => true,
        other => {
            return Err(Error::file(name, format_args!("the flag \"both ends held\" at byte 16 is {other}; expected 0 or 1")));
        }
    };
    let point_section = head.point_section(144, 12)?;
    let thickness = head.section(148, "thicknesses", strands, 4)?;
    let uvs = head.section(152, "texture coordinates", strands, 8)?;
    let color_section = head.section(156, "colours", points, 16)?;
    head.section(160, "guide indices", strands, 4)?;
    head.section(164, "texture coordinates of points", points, 8)?;
    head.check_end()?;
    let counts = head.counts()?;
    let extras = Extras {
        colors: colors(color_section)?,
        held: held_ends(both_ends_held, &counts, points as usize)?,
        strand_thickness: thickness.map(|section| section.singles("thickness")).transpose()?,
        strand_uvs: uvs.map(|section| section.floats("texture coordinate")).transpose()?,
        ..Extras::default()
    };
    Curves::from_parts(CurvesFormat::TfxV3, counts, point_section.floats("point")?, extras)
}

/// Reads version 4, whose first four bytes have been checked.
pub(super) fn read_v4(name: &str, bytes: &[u8]) -> Result<Curves> {
    let mut head = Head::new(name, bytes, 4, HEAD_V4)?;
    let (strands, points) = (u64::from(head.strands), head.points);
    let point_section = head.point_section(12, 16)?;
    let uvs = head.section(16, "texture coordinates", strands, 8)?;
    head.section(20, "texture coordinates of points", points, 8)?;
    let thickness = head.section(24, "thicknesses", strands, 4)?;
    let color_section = head.section(28, "colours", points, 16)?;
    head.check_end()?;
    let rows = point_section.floats::<4>("point")?;
    let mut points = bytes::list(rows.len())?;
    points.extend(rows.iter().map(|[x, y, z, _]| [*x, *y, *z]));
    let mut held = bytes::list(rows.len())?;
    held.extend(rows.iter().map(|row| row[3] == 0.0));
    let extras = Extras {
        colors: colors(color_section)?,
        held: Some(held),
        strand_thickness: thickness.map(|section| section.singles("thickness")).transpose()?,
        strand_uvs: uvs.map(|section| section.floats("texture coordinate")).transpose()?,
        ..Extras::default()
    };
    Curves::from_parts(CurvesFormat::TfxV4, head.counts()?, points, extras)
}

/// A file under construction: a header, and sections one after the other.
struct Sections {
    bytes: Vec<u8>,
}

impl Sections {
    /// The header's first three words, and zeros to its end.
    fn new(name: &str, curves: &Curves, version: f32, head: usize, point_width: usize) -> Result<Self> {
        let each = curves.counts()[0];
        if let Some(strand) = curves.counts().iter().position(|count| *count != each) {
            return Err(Error::file(
                name,
                format_args!(
                    "strand {strand} has {} points and strand 0 has {each}: in a .tfx file of version {version} all have as many",
                    curves.counts()[strand]
                ),
            ));
        }
        let strands = u32::try_from(curves.strand_count()).map_err(|_| {
            Error::file(name, format_args!("{} strands are more than a .tfx file can have", curves.strand_count()))
        })?;
        // Points, colours, and two per-strand sections.
        let most = curves.point_count().saturating_mul(point_width + 16).saturating_add(12 * curves.strand_count());
        let mut bytes = bytes::list(head.saturating_add(most))?;
        bytes.extend_from_slice(&version.to_le_bytes());
        bytes.extend_from_slice(&strands.to_le_bytes());
        bytes.extend_from_slice(&each.to_le_bytes());
        bytes.resize(head, 0);
        Ok(Self { bytes })
    }

    /// Adds a section, and its offset at byte `at` of the header.
    fn add(&mut self, name: &str, at: usize, numbers: impl Iterator<Item = f32>) -> Result<()> {
        let offset = u32::try_from(self.bytes.len())
            .map_err(|_| Error::file(name, "has more than the 4 GiB that a .tfx file can have"))?;
        self.bytes[at..at + 4].copy_from_slice(&offset.to_le_bytes());
        numbers.for_each(|number| self.bytes.extend_from_slice(&number.to_le_bytes()));
        Ok(())
    }
}

fn flat_colors(colors: &[[f32; 3]]) -> impl Iterator<Item = f32> + '_ {
    colors.iter().flat_map(|[red, green, blue]| [*red, *green, *blue, 1.0])
}

/// Writes version 3.
pub(super) fn write_v3(name: &str, curves: &Curves) -> Result<Vec<u8>> {
    let extras = curves.extras();
    let mut out = Sections::new(name, curves, 3.0, HEAD_V3, 12)?;
    out.bytes[16] = u8::from(holds_both_ends(curves));
    out.add(name, 144, curves.points().iter().flatten().copied())?;
    if let Some(thickness) = &extras.strand_thickness {
        out.add(name, 148, thickness.iter().copied())?;
    }
    if let Some(uvs) = &extras.strand_uvs {
        out.add(name, 152, uvs.iter().flatten().copied())?;
    }
    if let Some(colors) = &extras.colors {
        out.add(name, 156, flat_colors(colors))?;
    }
    Ok(out.bytes)
}

/// Writes version 4.
pub(super) fn write_v4(name: &str, curves: &Curves) -> Result<Vec<u8>> {
    let extras = curves.extras();
    let mut out = Sections::new(name, curves, 4.0, HEAD_V4, 16)?;
    let each = curves.counts()[0] as usize;
    let is_held = |index: usize| extras.held.as_ref().map_or(index.is_multiple_of(each), |held| held[index]);
    let points = curves.points().iter().enumerate();
    out.add(name, 12, points.flat_map(|(index, [x, y, z])| [*x, *y, *z, if is_held(index) { 0.0 } else { 1.0 }]))?;
    if let Some(uvs) = &extras.strand_uvs {
        out.add(name, 16, uvs.iter().flatten().copied())?;
    }
    if let Some(thickness) = &extras.strand_thickness {
        out.add(name, 24, thickness.iter().copied())?;
    }
    if let Some(colors) = &extras.colors {
        out.add(name, 28, flat_colors(colors))?;
    }
    Ok(out.bytes)
}
