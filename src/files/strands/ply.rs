//! Stanford `.ply` files as reconstructions of hair write them: text or binary, of either byte order.
//!
//! The points of strands are the element `vertex` with `x`, `y` and `z`, root first, strand after strand. How many points each
//! strand has is in an element `strand` (`nsegs`, the segments of each), in an element `edge` (`vertex1`, `vertex2`), or nowhere:
//! [`RawStrands`](super::raw_strands::RawStrands) then finds it. Other properties are attributes of points
//! and strands.

use super::strand_attributes::{Domain, FileAttribute};
use crate::error::{Error, Result};
use crate::files::io::bytes;
use crate::files::io::text::Text;

/// What a `.ply` file of strands holds.
#[derive(Debug)]
pub(super) struct PlyStrands {
    /// All points, in the file's unit; numbers may be infinite or not numbers.
    pub points: Vec<[f32; 3]>,
    /// Points of each strand, if the file says so.
    pub counts: Option<Vec<u32>>,
    /// Colour of each point, if the file has it.
    pub colours: Option<Vec<[u8; 3]>>,
}

/// Whether a file begins as `.ply` files do.
pub(in crate::files) fn is_ply(bytes: &[u8]) -> bool {
    bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r\n")
}

/// Reads the strands of a `.ply` file.
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<PlyStrands> {
    let file = Ply::read(name, bytes)?;
    if file.elements.iter().any(|element| element.name == "face" && element.count > 0) {
        return Err(Error::file(name, "is a mesh (it has faces); expected the points of strands"));
    }
    let Some([x, y, z]) = file.columns("vertex", ["x", "y", "z"])? else {
        return Err(Error::file(name, "has no element \"vertex\" with x, y and z"));
    };
    let mut points = bytes::list(x.len())?;
    points.extend((0..x.len()).map(|index| [x[index] as f32, y[index] as f32, z[index] as f32]));
    if points.is_empty() {
        return Err(Error::file(name, "has no points: its element \"vertex\" is empty"));
    }
    let mut counts = None;
    if let Some([segments]) = file.columns("strand", ["nsegs"])? {
        counts = Some(counts_of_segments(name, &segments, points.len())?);
    } else if let Some(edges) = file.columns("edge", ["vertex1", "vertex2"])? {
        counts = Some(counts_of_edges(name, &edges, points.len())?);
    }
    let colours = file.columns("vertex", ["red", "green", "blue"])?;
    let colours =
        colours.map(|[red, green, blue]| (0..red.len()).map(|k| [red[k] as u8, green[k] as u8, blue[k] as u8]).collect());
    Ok(PlyStrands { points, counts, colours })
}

/// What a file has for each point and strand beside points and counts.
pub(super) fn attributes(name: &str, bytes: &[u8]) -> Result<Vec<FileAttribute>> {
    let file = Ply::read(name, bytes)?;
    let mut attributes = Vec::new();
    for element in &file.elements {
        let domain = match element.name.as_str() {
            "vertex" => Domain::Points,
            "strand" => Domain::Strands,
            _ => continue,
        };
        for Property { name, .. } in &element.properties {
            if ["x", "y", "z", "nsegs"].contains(&name.as_str()) {
                continue;
            }
            if let Some([numbers]) = file.columns(&element.name, [name])? {
                attributes.push(FileAttribute { name: name.clone(), domain, width: 1, numbers });
            }
        }
    }
    Ok(attributes)
}

fn counts_of_segments(name: &str, segments: &[f64], points: usize) -> Result<Vec<u32>> {
    let mut counts = bytes::list(segments.len())?;
    let mut total = 0_u64;
    for (strand, number) in segments.iter().enumerate() {
        if !(0.0..f64::from(u32::MAX)).contains(number) || number.fract() != 0.0 {
            return Err(Error::file(
                name,
                format_args!("strand {strand} has {number} segments (nsegs); expected a whole number"),
            ));
        }
        counts.push(*number as u32 + 1);
        total += *number as u64 + 1;
    }
    if total == points as u64 {
        return Ok(counts);
    }
    Err(Error::file(
        name,
        format_args!("the segments of its strands make {total} points, and the element \"vertex\" has {points}"),
    ))
}

/// Strands of edges, each from a point to the one after it.
fn counts_of_edges(name: &str, [from, to]: &[Vec<f64>; 2], points: usize) -> Result<Vec<u32>> {
    let mut joined = bytes::list(points)?;
    joined.resize(points, false);
    for (edge, (from, to)) in from.iter().zip(to).enumerate() {
        let known = |vertex: f64| vertex >= 0.0 && vertex < points as f64 && vertex.fract() == 0.0;
        if !known(*from) || !known(*to) || *to != *from + 1.0 {
            return Err(Error::file(
                name,
                format_args!("edge {edge} goes from vertex {from} to {to}; expected a vertex of the file and the one after it"),
            ));
        }
        joined[*to as usize] = true;
    }
    let mut counts: Vec<u32> = bytes::list(joined.iter().filter(|joined| !**joined).count())?;
    for joined in joined {
        match counts.last_mut() {
            Some(count) if joined => *count += 1,
            _ => counts.push(1),
        }
    }
    Ok(counts)
}

/// A number's type.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn of(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Kind::I8,
            "uchar" | "uint8" => Kind::U8,
            "short" | "int16" => Kind::I16,
            "ushort" | "uint16" => Kind::U16,
            "int" | "int32" => Kind::I32,
            "uint" | "uint32" => Kind::U32,
            "float" | "float32" => Kind::F32,
            "double" | "float64" => Kind::F64,
            _ => return None,
        })
    }

    fn width(self) -> usize {
        match self {
            Kind::I8 | Kind::U8 => 1,
            Kind::I16 | Kind::U16 => 2,
            Kind::I32 | Kind::U32 | Kind::F32 => 4,
            Kind::F64 => 8,
        }
    }

    /// The number at the start of `bytes`, which are enough.
    fn value(self, bytes: &[u8], big: bool) -> f64 {
        let mut raw = [0_u8; 8];
        let width = self.width();
        raw[..width].copy_from_slice(&bytes[..width]);
        if big {
            raw[..width].reverse();
        }
        let [a, b, c, d, ..] = raw;
        match self {
            Kind::I8 => f64::from(a as i8),
            Kind::U8 => f64::from(a),
            Kind::I16 => f64::from(i16::from_le_bytes([a, b])),
            Kind::U16 => f64::from(u16::from_le_bytes([a, b])),
            Kind::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            Kind::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
            Kind::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
            Kind::F64 => f64::from_le_bytes(raw),
        }
    }
}

#[derive(Debug)]
struct Property {
    name: String,
    kind: Kind,
    /// Type of the number of items, if it is a list.
    list: Option<Kind>,
}

#[derive(Debug)]
struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

impl Element {
    /// Bytes of an item, if it has no lists.
    fn width(&self) -> Option<usize> {
        self.properties.iter().map(|property| property.list.is_none().then(|| property.kind.width())).sum()
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Encoding {
    Text,
    Little,
    Big,
}

/// A file whose header has been read.
struct Ply<'a> {
    name: &'a str,
    encoding: Encoding,
    elements: Vec<Element>,
    body: &'a [u8],
}

impl<'a> Ply<'a> {
    fn read(name: &'a str, bytes: &'a [u8]) -> Result<Self> {
        if !is_ply(bytes) {
            return Err(Error::file(name, "does not begin with the word \"ply\""));
        }
        let mut text = Text::new(name, bytes);
        let (mut encoding, mut elements): (_, Vec<Element>) = (None, Vec::new());
        text.next_line()?;
        loop {
            let Some((line, content)) = text.next_line()? else {
                return Err(Error::file(name, "truncated: its header has no \"end_header\""));
            };
            let words: Vec<&str> = content.split_ascii_whitespace().collect();
            let complain = || Err(text.error(line, format_args!("{content:?} is no line of a header of a .ply file")));
            match words[..] {
                ["end_header"] => break,
                [] | ["comment" | "obj_info", ..] => {}
                ["format", "ascii", _] => encoding = Some(Encoding::Text),
                ["format", "binary_little_endian", _] => encoding = Some(Encoding::Little),
                ["format", "binary_big_endian", _] => encoding = Some(Encoding::Big),
                ["element", element, count] => match count.parse() {
                    Ok(count) => elements.push(Element { name: element.into(), count, properties: Vec::new() }),
                    Err(_) => return complain(),
                },
                ["property", "list", count, kind, property] => match (Kind::of(count), Kind::of(kind), elements.last_mut()) {
                    (Some(count), Some(kind), Some(element)) if !matches!(count, Kind::F32 | Kind::F64) => {
                        element.properties.push(Property { name: property.into(), kind, list: Some(count) });
                    }
                    _ => return complain(),
                },
                ["property", kind, property] => match (Kind::of(kind), elements.last_mut()) {
                    (Some(kind), Some(element)) => {
                        element.properties.push(Property { name: property.into(), kind, list: None });
                    }
                    _ => return complain(),
                },
                _ => return complain(),
            }
        }
        if let Some(empty) = elements.iter().find(|element| element.properties.is_empty() && element.count > 0) {
            return Err(Error::file(name, format_args!("has {} items of \"{}\" without properties", empty.count, empty.name)));
        }
        let body = &bytes[bytes.len() - text.remaining()..];
        let Some(encoding) = encoding else { return Err(Error::file(name, "does not say its format in its header")) };
        Ok(Self { name, encoding, elements, body })
    }

    /// Columns of the element of that name; `None` if it, or one of the columns, is not there.
    fn columns<const N: usize>(&self, element: &str, names: [&str; N]) -> Result<Option<[Vec<f64>; N]>> {
        let Some(index) = self.elements.iter().position(|other| other.name == element) else { return Ok(None) };
        let element = &self.elements[index];
        let find = |name: &str| element.properties.iter().position(|property| property.name == name && property.list.is_none());
        let mut places = [0; N];
        for (place, name) in places.iter_mut().zip(names) {
            let Some(found) = find(name) else { return Ok(None) };
            *place = found;
        }
        match self.encoding {
            Encoding::Text => self.text_columns(index, places),
            Encoding::Little => self.binary_columns(index, places, false),
            Encoding::Big => self.binary_columns(index, places, true),
        }
        .map(Some)
    }

    /// Empty columns for an element that takes at least `least` bytes an item.
    fn lists<const N: usize>(&self, element: &Element, least: usize) -> Result<[Vec<f64>; N]> {
        if element.count > self.body.len() / least.max(1) {
            return Err(Error::file(
                self.name,
                format_args!(
                    "truncated: {} items of \"{}\" take at least {least} bytes each, and {} bytes follow the header",
                    element.count,
                    element.name,
                    self.body.len()
                ),
            ));
        }
        let mut columns: [Vec<f64>; N] = std::array::from_fn(|_| Vec::new());
        for column in &mut columns {
            *column = bytes::list(element.count)?;
        }
        Ok(columns)
    }

    fn truncated(&self, element: &Element, item: usize) -> Error {
        Error::file(self.name, format_args!("truncated: ends within item {item} of {} of \"{}\"", element.count, element.name))
    }

    fn text_columns<const N: usize>(&self, index: usize, places: [usize; N]) -> Result<[Vec<f64>; N]> {
        let mut columns = self.lists(&self.elements[index], 2 * self.elements[index].properties.len())?;
        let mut words = std::str::from_utf8(self.body)
            .map_err(|error| Error::file(self.name, format_args!("is not text after its header: {error}")))?
            .split_ascii_whitespace();
        for (number, element) in self.elements[..=index].iter().enumerate() {
            for item in 0..element.count {
                for (place, property) in element.properties.iter().enumerate() {
                    let mut next = || {
                        let word = words.next().ok_or_else(|| self.truncated(element, item))?;
                        word.parse::<f64>().map_err(|_| {
                            let (of, property) = (&element.name, &property.name);
                            Error::file(
                                self.name,
                                format_args!("{property} of item {item} of \"{of}\" is {word:?}; expected a number"),
                            )
                        })
                    };
                    let value = next()?;
                    if property.list.is_some() {
                        for _ in 0..value.max(0.0) as u64 {
                            next()?;
                        }
                    }
                    if number == index {
                        for (column, _) in columns.iter_mut().zip(places).filter(|(_, wanted)| *wanted == place) {
                            column.push(value);
                        }
                    }
                }
            }
        }
        Ok(columns)
    }

    fn binary_columns<const N: usize>(&self, index: usize, places: [usize; N], big: bool) -> Result<[Vec<f64>; N]> {
        let least = |element: &Element| -> usize {
            element.properties.iter().map(|property| property.list.unwrap_or(property.kind).width()).sum()
        };
        let mut columns = self.lists(&self.elements[index], least(&self.elements[index]))?;
        let mut at = 0_usize;
        for (number, element) in self.elements[..=index].iter().enumerate() {
            if let Some(width) = element.width().filter(|_| number < index) {
                let end = width.checked_mul(element.count).and_then(|bytes| bytes.checked_add(at));
                at = end.filter(|end| *end <= self.body.len()).ok_or_else(|| self.truncated(element, 0))?;
                continue;
            }
            for item in 0..element.count {
                for (place, property) in element.properties.iter().enumerate() {
                    let kind = property.list.unwrap_or(property.kind);
                    let mut take = |width: usize| {
                        let taken = self.body.get(at..).and_then(|rest| rest.get(..width));
                        at += width;
                        taken.ok_or_else(|| self.truncated(element, item))
                    };
                    let value = kind.value(take(kind.width())?, big);
                    if property.list.is_some() {
                        take((value.max(0.0) as usize).saturating_mul(property.kind.width()).min(self.body.len() + 1))?;
                    }
                    if number == index {
                        for (column, _) in columns.iter_mut().zip(places).filter(|(_, wanted)| *wanted == place) {
                            column.push(value);
                        }
                    }
                }
            }
        }
        Ok(columns)
    }
}
