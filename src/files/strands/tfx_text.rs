//! TressFX 2 `.tfx` files: text.
//!
//! Lines `name value`, starting with `version 2.0` and including `numStrands`; then for each strand a line `strand I numVerts N
//! texcoord U V` and N lines `x, y, z` (or without commas).

use std::io::Write;

use super::tfx::{held_ends, holds_both_ends};
use crate::error::{Error, Result};
use crate::files::curves::{Curves, CurvesFormat, Extras};
use crate::files::io::text::{Quote, Text, count, single};

/// The shortest line of a point: `0 0 0` and its end.
const LEAST_POINT_LINE: usize = 6;
/// Header lines that say how to make more hairs, or how many there are at most: skipped.
const LEFT: [&str; 3] = ["maxNumVerticesInStrand", "numFollowHairsPerGuideHair", "maxRadiusAroundGuideHair"];

/// Reads version 2.
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Curves> {
    let mut text = Text::new(name, bytes);
    let head = read_head(&mut text)?;
    let mut counts = Vec::new();
    let mut points = Vec::new();
    let mut uvs = Vec::new();
    let mut next = head.first_strand;
    while let Some((line, words)) = next {
        let (count, uv) = strand_line(&text, line, words, counts.len())?;
        if count as usize > text.remaining().div_ceil(LEAST_POINT_LINE) {
            return Err(text.error(
                line,
                format_args!("strand {} has {count} points; only {} bytes are left for them", counts.len(), text.remaining()),
            ));
        }
        points.try_reserve(count as usize).map_err(|_| Error::OutOfMemory { bytes: 12 * count as usize })?;
        for index in 0..count {
            let Some((line, words)) = text.next_full_line()? else {
                return Err(text.error(
                    text.line(),
                    format_args!("the file ends after {index} of the {count} points of strand {}", counts.len()),
                ));
            };
            points.push(point_line(&text, line, words)?);
        }
        counts.push(count);
        uvs.push(uv);
        next = text.next_full_line()?;
    }
    if counts.len() != head.strands as usize {
        return Err(text.error(
            head.strands_line,
            format_args!("numStrands is {}, and the file has {} strands", head.strands, counts.len()),
        ));
    }
    if counts.is_empty() {
        return Err(text.error(head.strands_line, "numStrands is 0; expected at least one"));
    }
    let held = held_ends(head.both_ends_held, &counts, points.len())?;
    Curves::from_parts(CurvesFormat::TfxV2Text, counts, points, Extras { held, strand_uvs: Some(uvs), ..Extras::default() })
}

/// The header, and the first line after it.
struct Head<'a> {
    both_ends_held: bool,
    strands: u32,
    strands_line: usize,
    first_strand: Option<(usize, &'a str)>,
}

fn read_head<'a>(text: &mut Text<'a>) -> Result<Head<'a>> {
    let mut strands = None;
    let mut both_ends_held = false;
    let mut version = None;
    let first_strand = loop {
        let Some((line, content)) = text.next_full_line()? else { break None };
        let mut words = content.split_ascii_whitespace();
        let key = words.next().unwrap_or_default();
        if key == "strand" {
            break Some((line, content));
        }
        let values: Vec<&str> = words.take(4).collect();
        let expect = |expected: &[&str]| -> Result<()> {
            let right = values.len() == expected.len()
                && values.iter().zip(expected).all(|(value, expected)| {
                    value == expected || matches!((value.parse::<f64>(), expected.parse::<f64>()), (Ok(a), Ok(b)) if a == b)
                });
            if right {
                return Ok(());
            }
            let expected = expected.join(" ");
            Err(text.error(line, format_args!("{}; only \"{key} {expected}\" is supported", Quote(content.trim()))))
        };
        match key {
            "version" => {
                expect(&["2.0"])?;
                version = Some(line);
            }
            // A placement of the whole groom that TressFX applies when it draws: refused rather than ignored.
            "scale" => expect(&["1.0"])?,
            "rotation" | "translation" => expect(&["0", "0", "0"])?,
            "bothEndsImmovable" => {
                both_ends_held = match values[..] {
                    ["0"] => false,
                    ["1"] => true,
                    _ => return Err(text.error(line, format_args!("{}; expected 0 or 1", Quote(content.trim())))),
                }
            }
            "numStrands" => {
                let [value] = values[..] else {
                    return Err(text.error(line, format_args!("{}; expected one number", Quote(content.trim()))));
                };
                strands = Some((line, count(text, line, "numStrands", value)?));
            }
            // Whether strands are sorted for drawing.
            "is" if values.first() == Some(&"sorted") && values.len() == 2 => {}
            _ if LEFT.contains(&key) => {
                let [value] = values[..] else {
                    return Err(text.error(line, format_args!("{}; expected one number", Quote(content.trim()))));
                };
                single(text, line, key, value)?;
            }
            _ => return Err(text.error(line, format_args!("{} is not a line of a version 2 .tfx file", Quote(content.trim())))),
        }
        if version.is_none() {
            return Err(text.error(line, format_args!("{}; expected \"version 2.0\" first", Quote(content.trim()))));
        }
    };
    let Some((strands_line, strands)) = strands else {
        let line = first_strand.map_or(text.line(), |(line, _)| line);
        return Err(text.error(line, "\"numStrands N\" is missing before the first strand"));
    };
    Ok(Head { both_ends_held, strands, strands_line, first_strand })
}

/// `strand I numVerts N texcoord U V`: the number of points and the texture coordinates.
fn strand_line(text: &Text<'_>, line: usize, content: &str, strand: usize) -> Result<(u32, [f32; 2])> {
    let mut words = content.split_ascii_whitespace();
    let row: [&str; 7] = std::array::from_fn(|_| words.next().unwrap_or_default());
    let ["strand", index, "numVerts", points, "texcoord", u, v] = row else {
        return Err(
            text.error(line, format_args!("{}; expected \"strand {strand} numVerts N texcoord U V\"", Quote(content.trim())))
        );
    };
    if words.next().is_some() {
        return Err(text.error(line, format_args!("{} has more than \"texcoord U V\"", Quote(content.trim()))));
    }
    if count(text, line, "the strand's index", index)? as usize != strand {
        return Err(text.error(line, format_args!("the strand's index is {index}; expected {strand}")));
    }
    let points = count(text, line, "numVerts", points)?;
    if points < 2 {
        return Err(text.error(line, format_args!("strand {strand} has {points} points; expected at least two")));
    }
    Ok((points, [single(text, line, "u", u)?, single(text, line, "v", v)?]))
}

/// `x, y, z`.
fn point_line(text: &Text<'_>, line: usize, content: &str) -> Result<[f32; 3]> {
    let mut words = content.split(|c: char| c == ',' || c.is_ascii_whitespace()).filter(|word| !word.is_empty());
    let row: [&str; 3] = std::array::from_fn(|_| words.next().unwrap_or_default());
    if row[2].is_empty() || words.next().is_some() {
        return Err(text.error(line, format_args!("{}; expected a point: x, y, z", Quote(content.trim()))));
    }
    let [x, y, z] = row;
    Ok([single(text, line, "x", x)?, single(text, line, "y", y)?, single(text, line, "z", z)?])
}

/// Writes version 2.
pub(super) fn write(curves: &Curves) -> Vec<u8> {
    let mut out = Vec::with_capacity(40 * curves.point_count());
    let most = curves.counts().iter().max().copied().unwrap_or_default();
    // Writing to a Vec cannot fail, so results can be ignored.
    let _ = write!(out, "version 2.0\nscale 1.0\nrotation 0 0 0\ntranslation 0 0 0\n");
    let _ = writeln!(out, "bothEndsImmovable {}", u8::from(holds_both_ends(curves)));
    let _ = writeln!(out, "maxNumVerticesInStrand {most}\nnumFollowHairsPerGuideHair 0\nmaxRadiusAroundGuideHair 0");
    let _ = writeln!(out, "numStrands {}\nis sorted 0", curves.strand_count());
    for (index, strand) in curves.strands().enumerate() {
        let [u, v] = curves.extras().strand_uvs.as_ref().map_or([0.0; 2], |uvs| uvs[index]);
        let _ = writeln!(out, "strand {index} numVerts {} texcoord {u} {v}", strand.len());
        for [x, y, z] in strand {
            let _ = writeln!(out, "{x}, {y}, {z}");
        }
    }
    out
}
