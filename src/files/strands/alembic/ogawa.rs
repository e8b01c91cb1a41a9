//! The container of Alembic files (Ogawa): groups of groups and data, objects with properties in them, and their first samples.
//!
//! A group is a number of children and the place of each (64-bit, little-endian); the highest bit of a place marks data, which are a
//! number of bytes and these bytes. Objects are groups: their properties, their children, and last the headers of these. Compound
//! properties are groups: their properties, and last the headers of these. Samples begin with a key of 16 bytes.

use crate::error::{Error, Result};
use crate::files::io::bytes::u32_at;

/// Types of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Kind(u8);

impl Kind {
    pub const UINT32: Self = Self(5);
    pub const INT32: Self = Self(6);
    const FLOAT32: Self = Self(10);
    const FLOAT64: Self = Self(11);
}

const DATA: u64 = 1 << 63;
const KEY: usize = 16;

/// A file whose header has been read.
#[derive(Clone, Copy)]
pub(super) struct Archive<'a> {
    name: &'a str,
    bytes: &'a [u8],
}

/// The places of a group's children.
#[derive(Clone, Copy)]
struct Group<'a> {
    archive: Archive<'a>,
    places: &'a [u8],
}

impl<'a> Archive<'a> {
    pub fn read(name: &'a str, bytes: &'a [u8]) -> Result<Self> {
        let archive = Self { name, bytes };
        if bytes.len() < 16 || !bytes.starts_with(b"Ogawa") {
            return Err(archive.broken("its header is truncated"));
        }
        if bytes[5] != 0xff {
            return Err(archive.broken("it was not finished by the program that wrote it"));
        }
        Ok(archive)
    }

    fn broken(&self, what: &str) -> Error {
        Error::file(self.name, format_args!("is a broken Alembic file: {what}"))
    }

    fn number(&self, at: u64) -> Result<u64> {
        let bytes = usize::try_from(at).ok().and_then(|at| self.bytes.get(at..)?.first_chunk::<8>());
        bytes.map(|bytes| u64::from_le_bytes(*bytes)).ok_or_else(|| self.broken("a place lies beyond its end"))
    }

    /// What stands at a place: so many items of a width, after their number.
    fn counted(&self, at: u64, width: u64) -> Result<&'a [u8]> {
        if at == 0 {
            return Ok(&[]);
        }
        let size = self.number(at)?.checked_mul(width).and_then(|size| usize::try_from(size).ok());
        let begin = at as usize + 8;
        let found = size.and_then(|size| self.bytes.get(begin..)?.get(..size));
        found.ok_or_else(|| self.broken("a group or data end beyond its end"))
    }

    fn group(&self, at: u64) -> Result<Group<'a>> {
        Ok(Group { archive: *self, places: self.counted(at, 8)? })
    }

    /// The object that holds all others.
    pub fn top(&self) -> Result<Object<'a>> {
        let root = self.group(self.number(8)?)?;
        let indexed = root.data(5)?;
        let mut metadata: Vec<&[u8]> = vec![&[]];
        let mut rest = indexed;
        while let Some((size, others)) = rest.split_first() {
            let (text, others) =
                others.split_at_checked(usize::from(*size)).ok_or_else(|| self.broken("its list of metadata"))?;
            metadata.push(text);
            rest = others;
        }
        Ok(Object { group: root.group(2)?, metadata: metadata.into(), name: "ABC".into(), kind: &[] })
    }
}

impl<'a> Group<'a> {
    fn len(&self) -> usize {
        self.places.len() / 8
    }

    fn place(&self, child: usize) -> Result<u64> {
        let place = self.places.as_chunks::<8>().0.get(child);
        place.map(|place| u64::from_le_bytes(*place)).ok_or_else(|| self.archive.broken("a group has too few children"))
    }

    fn group(&self, child: usize) -> Result<Group<'a>> {
        match self.place(child)? {
            place if place & DATA == 0 => self.archive.group(place),
            _ => Err(self.archive.broken("data stand where a group was expected")),
        }
    }

    fn data(&self, child: usize) -> Result<&'a [u8]> {
        match self.place(child)? {
            0 => Ok(&[]),
            place if place & DATA != 0 => self.archive.counted(place & !DATA, 1),
            _ => Err(self.archive.broken("a group stands where data were expected")),
        }
    }

    /// The data of the last child.
    fn headers(&self) -> Result<&'a [u8]> {
        match self.len() {
            0 => Ok(&[]),
            count => self.data(count - 1),
        }
    }
}

/// Reads numbers and texts of headers.
struct Headers<'a> {
    archive: Archive<'a>,
    rest: &'a [u8],
}

impl<'a> Headers<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or_else(|| self.archive.broken("headers are truncated"))?;
        self.rest = rest;
        Ok(taken)
    }

    /// A number of 8, 16 or 32 bits.
    fn number(&mut self, hint: u32) -> Result<u32> {
        Ok(match hint {
            0 => u32::from(self.take(1)?[0]),
            1 => self.take(2)?.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte)),
            _ => u32_at(self.take(4)?, 0),
        })
    }

    fn text(&mut self, hint: u32) -> Result<&'a [u8]> {
        let size = self.number(hint)?;
        self.take(size as usize)
    }

    /// A metadata text: one of the archive's list, or its own.
    fn metadata(&mut self, index: u32, hint: u32, list: &[&'a [u8]]) -> Result<&'a [u8]> {
        if index == 0xff {
            return self.text(hint);
        }
        list.get(index as usize).copied().ok_or_else(|| self.archive.broken("metadata are not in its list"))
    }
}

/// An object.
pub(super) struct Object<'a> {
    group: Group<'a>,
    metadata: std::rc::Rc<[&'a [u8]]>,
    name: String,
    kind: &'a [u8],
}

impl<'a> Object<'a> {
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it has that schema, whatever its version.
    pub fn is(&self, schema: &str) -> bool {
        self.kind.windows(schema.len()).any(|part| part == schema.as_bytes())
    }

    pub fn properties(&self) -> Result<Compound<'a>> {
        let group = if self.group.len() == 0 { self.group } else { self.group.group(0)? };
        Compound::read(group, self.metadata.clone())
    }

    pub fn children(&self) -> Result<Vec<Object<'a>>> {
        let archive = self.group.archive;
        let all = self.group.headers()?;
        // A hash of 32 bytes is last.
        let mut headers = Headers { archive, rest: &all[..all.len().saturating_sub(32)] };
        let mut children = Vec::new();
        while !headers.rest.is_empty() {
            let name = String::from_utf8_lossy(headers.text(2)?).into_owned();
            let index = headers.number(0)?;
            let kind = headers.metadata(index, 2, &self.metadata)?;
            let group = self.group.group(children.len() + 1)?;
            children.push(Object { group, metadata: self.metadata.clone(), name, kind });
        }
        Ok(children)
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    Compound,
    Scalar,
    Array,
}

struct Property {
    name: Vec<u8>,
    shape: Shape,
    pod: Kind,
    /// Numbers of a value.
    extent: usize,
}

/// Properties that have names.
pub(super) struct Compound<'a> {
    group: Group<'a>,
    metadata: std::rc::Rc<[&'a [u8]]>,
    properties: Vec<Property>,
}

/// The first sample of a property.
pub(super) struct Values<'a> {
    pub pod: Kind,
    /// Numbers of a value.
    pub extent: usize,
    pub bytes: &'a [u8],
}

impl<'a> Compound<'a> {
    fn read(group: Group<'a>, metadata: std::rc::Rc<[&'a [u8]]>) -> Result<Self> {
        let mut headers = Headers { archive: group.archive, rest: group.headers()? };
        let mut properties = Vec::new();
        while !headers.rest.is_empty() {
            let info = headers.number(2)?;
            let shape = match info & 3 {
                0 => Shape::Compound,
                1 => Shape::Scalar,
                _ => Shape::Array,
            };
            let hint = info >> 2 & 3;
            if shape != Shape::Compound {
                headers.number(hint)?;
                if info & 0x200 != 0 {
                    headers.number(hint)?;
                    headers.number(hint)?;
                }
                if info & 0x100 != 0 {
                    headers.number(hint)?;
                }
            }
            let name = headers.text(hint)?.to_vec();
            headers.metadata(info >> 20 & 0xff, hint, &metadata)?;
            properties.push(Property { name, shape, pod: Kind((info >> 4 & 15) as u8), extent: (info >> 12 & 0xff) as usize });
        }
        Ok(Self { group, metadata, properties })
    }

    fn find(&self, name: &str) -> Option<(usize, &Property)> {
        self.properties.iter().enumerate().find(|(_, property)| property.name == name.as_bytes())
    }

    /// The names of its properties.
    pub fn names(&self) -> impl Iterator<Item = std::borrow::Cow<'_, str>> {
        self.properties.iter().map(|property| String::from_utf8_lossy(&property.name))
    }

    pub fn compound(&self, name: &str) -> Result<Option<Compound<'a>>> {
        match self.find(name).filter(|(_, property)| property.shape == Shape::Compound) {
            Some((index, _)) => Compound::read(self.group.group(index)?, self.metadata.clone()).map(Some),
            None => Ok(None),
        }
    }

    /// The first sample; `None` for a property that is not there or has none.
    pub fn values(&self, name: &str) -> Result<Option<Values<'a>>> {
        let Some((index, property)) = self.find(name).filter(|(_, property)| property.shape != Shape::Compound) else {
            return Ok(None);
        };
        let samples = self.group.group(index)?;
        if samples.len() == 0 {
            return Ok(None);
        }
        let sample = samples.data(0)?;
        Ok(Some(Values { pod: property.pod, extent: property.extent, bytes: sample.get(KEY..).unwrap_or_default() }))
    }
}

impl Values<'_> {
    /// Numbers of any type but half floats; `None` for those and for texts.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        fn all<const N: usize>(bytes: &[u8], number: impl Fn([u8; N]) -> f64) -> Option<Vec<f64>> {
            Some(bytes.as_chunks::<N>().0.iter().map(|bytes| number(*bytes)).collect())
        }
        let bytes = self.bytes;
        match self.pod.0 {
            0 | 1 => all(bytes, |[byte]| f64::from(byte)),
            2 => all(bytes, |bytes| f64::from(i8::from_le_bytes(bytes))),
            3 => all(bytes, |bytes| f64::from(u16::from_le_bytes(bytes))),
            4 => all(bytes, |bytes| f64::from(i16::from_le_bytes(bytes))),
            5 => all(bytes, |bytes| f64::from(u32::from_le_bytes(bytes))),
            6 => all(bytes, |bytes| f64::from(i32::from_le_bytes(bytes))),
            7 => all(bytes, |bytes| u64::from_le_bytes(bytes) as f64),
            8 => all(bytes, |bytes| i64::from_le_bytes(bytes) as f64),
            10 => all(bytes, |bytes| f64::from(f32::from_le_bytes(bytes))),
            11 => all(bytes, f64::from_le_bytes),
            _ => None,
        }
    }

    /// Floats of 32 or 64 bits.
    pub fn floats(&self, name: &str) -> Result<Vec<f64>> {
        let mut numbers = Vec::new();
        match self.pod {
            Kind::FLOAT32 => {
                numbers = crate::files::io::bytes::list(self.bytes.len() / 4)?;
                numbers.extend(self.bytes.as_chunks::<4>().0.iter().map(|bytes| f64::from(f32::from_le_bytes(*bytes))));
            }
            Kind::FLOAT64 => {
                numbers = crate::files::io::bytes::list(self.bytes.len() / 8)?;
                numbers.extend(self.bytes.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)));
            }
            _ if self.bytes.is_empty() => {}
            Kind(other) => {
                return Err(Error::file(name, format_args!("has points of type {other}; expected floats of 32 or 64 bits")));
            }
        }
        Ok(numbers)
    }
}
