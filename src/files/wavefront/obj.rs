//! Wavefront OBJ with polylines: `v x y z` for each point, `l a b c ...` for each strand.
//!
//! The reader skips groups, objects, materials and comments. It refuses faces and everything else that is not a polyline, and
//! points on no line. [`obj_mesh`](super::obj_mesh) reads meshes.

use std::io::Write;
use std::path::Path;

use super::obj_lines::{is_left, vertex_index};
use crate::error::{Error, Result};
use crate::files::curves::{Curves, CurvesFormat, Extras};
use crate::files::io::bytes;
use crate::files::io::text::{Quote, Text, single};

/// Reads the polylines of an OBJ file.
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
    // A first pass counts, so that one allocation of the right size is enough.
    let (mut vertex_count, mut line_count, mut index_count) = (0, 0, 0);
    let mut text = Text::new(name, bytes);
    while let Some((_, content)) = text.next_full_line()? {
        let mut words = content.split_ascii_whitespace();
        match words.next() {
            Some("v") => vertex_count += 1,
            Some("l") => {
                line_count += 1;
                index_count += words.count();
            }
            _ => {}
        }
    }

    let mut vertices = bytes::list(vertex_count)?;
    let mut on_line = bytes::list(vertex_count)?;
    let mut counts = bytes::list(line_count)?;
    let mut points = bytes::list(index_count)?;
    let mut text = Text::new(name, bytes);
    while let Some((line, content)) = text.next_full_line()? {
        let mut words = content.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let row: [&str; 3] = std::array::from_fn(|_| words.next().unwrap_or_default());
                if row[2].is_empty() || words.next().is_some() {
                    return Err(text.error(line, format_args!("{}; expected \"v x y z\"", Quote(content))));
                }
                vertices.push([
                    single(&text, line, "x", row[0])?,
                    single(&text, line, "y", row[1])?,
                    single(&text, line, "z", row[2])?,
                ]);
                on_line.push(false);
            }
            Some("l") => {
                let mut count = 0_u32;
                for word in words {
                    let index = vertex_index(word, vertices.len()).ok_or_else(|| {
                        let known = vertices.len();
                        text.error(line, format_args!("vertex {}; expected 1 to {known} (those above this line)", Quote(word)))
                    })?;
                    points.push(vertices[index]);
                    on_line[index] = true;
                    count = count.checked_add(1).ok_or_else(|| text.error(line, "more than 4294967295 points"))?;
                }
                if count < 2 {
                    return Err(
                        text.error(line, format_args!("strand {} has {count} points; expected at least two", counts.len()))
                    );
                }
                counts.push(count);
            }
            Some(word) if is_left(word) => {}
            _ => {
                let expected = "only polylines (v and l) are read";
                return Err(text.error(line, format_args!("{}: {expected}", Quote(content))));
            }
        }
    }
    if counts.is_empty() {
        return Err(Error::file(name, "has no polylines (\"l\" lines)"));
    }
    if let Some(index) = on_line.iter().position(|on_line| !on_line) {
        return Err(Error::file(name, format_args!("vertex {} is on no polyline", index + 1)));
    }
    Curves::from_parts(CurvesFormat::Obj, counts, points, Extras::default())
}

/// Writes curves as one OBJ frame: one `v` line per point, then one `l` line per strand. Reading the numbers back gives the same
/// floats. The format cannot hold thickness, colours and the like.
///
/// # Errors
/// [`Error::File`] naming the path when it cannot be written.
pub fn write(path: impl AsRef<Path>, curves: &Curves) -> Result<()> {
    bytes::write_file(path.as_ref(), &write_to_bytes(curves))
}

/// [`write()`] into memory.
pub fn write_to_bytes(curves: &Curves) -> Vec<u8> {
    let mut out = Vec::with_capacity(40 * curves.point_count());
    // Writing to a Vec cannot fail, so results can be ignored.
    let _ = writeln!(out, "# superhelix: {} strands, {} points", curves.strand_count(), curves.point_count());
    for [x, y, z] in curves.points() {
        let _ = writeln!(out, "v {x} {y} {z}");
    }
    for strand in 0..curves.strand_count() {
        out.push(b'l');
        for index in curves.strand_range(strand) {
            let _ = write!(out, " {}", index + 1);
        }
        out.push(b'\n');
    }
    out
}
