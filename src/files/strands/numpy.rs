//! NumPy's `.npy` and `.npz` files that hold strands: an array of strands by points by three, root first.
//!
//! Floats of 16, 32 or 64 bits, little-endian, in C order. Of an `.npz` file, which is an archive of arrays, the array
//! `positions` is read, else the only one of that shape. Compressed archives (`savez_compressed`) are refused.

use super::strand_attributes::{Domain, FileAttribute};
use crate::error::{Error, Result};
use crate::files::io::bytes::{self, u32_at};

/// What an array of strands holds.
#[derive(Debug)]
pub(super) struct NumpyStrands {
    /// All points, in the file's unit; numbers may be infinite or not numbers.
    pub points: Vec<[f32; 3]>,
    /// Points of every strand.
    pub points_per_strand: u32,
}

const MAGIC: &[u8] = b"\x93NUMPY";

/// The member of an archive that holds the strands.
const POSITIONS: &str = "positions.npy";

/// Most numbers for each strand or point that are attributes.
const WIDEST: usize = 16;

/// Whether a file begins as an array.
pub(in crate::files) fn is_npy(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Whether a file is an archive whose first member is an array.
pub(in crate::files) fn is_npz(bytes: &[u8]) -> bool {
    let header = bytes.starts_with(b"PK\x03\x04") && bytes.len() > 30;
    header && bytes[30..].get(..u16_at(bytes, 26)).is_some_and(|member| member.ends_with(b".npy"))
}

/// Reads the strands of an `.npy` file.
pub(super) fn read_npy(name: &str, bytes: &[u8]) -> Result<NumpyStrands> {
    let array = Array::read(name, bytes)?;
    array.strands(name).unwrap_or_else(|| {
        Err(Error::file(name, format_args!("is an array of shape {:?}; expected strands by points by 3", array.shape)))
    })
}

/// Reads the strands of an `.npz` file.
pub(super) fn read_npz(name: &str, bytes: &[u8]) -> Result<NumpyStrands> {
    let members = members(name, bytes)?;
    if let Some((member, content)) = members.iter().find(|(member, _)| member == POSITIONS) {
        return read_npy(&format!("{name}, {member}"), content.as_ref().map_err(|_| compressed(name, member))?);
    }
    let mut found = None;
    for (member, content) in &members {
        let content = content.as_ref().map_err(|_| compressed(name, member))?;
        if !member.ends_with(".npy") || !is_npy(content) {
            continue;
        }
        let inner = format!("{name}, {member}");
        let Ok(array) = Array::read(&inner, content) else { continue };
        if let Some(strands) = array.strands(&inner) {
            if found.is_some() {
                return Err(Error::file(name, "has several arrays of strands by points by 3, and none is called \"positions\""));
            }
            found = Some(strands);
        }
    }
    let names: Vec<&str> = members.iter().map(|(member, _)| member.as_str()).collect();
    found.unwrap_or_else(|| {
        Err(Error::file(name, format_args!("has no array of strands by points by 3; its members are {}", names.join(", "))))
    })
}

/// The arrays of an `.npz` file of so many strands of so many points beside the strands: numbers for each strand or point.
pub(super) fn attributes(name: &str, bytes: &[u8], [strands, points]: [usize; 2]) -> Result<Vec<FileAttribute>> {
    let members = members(name, bytes)?;
    let named = members.iter().any(|(member, _)| member == POSITIONS);
    let mut attributes = Vec::new();
    for (member, content) in &members {
        let (Ok(content), Some(member)) = (content, member.strip_suffix(".npy")) else { continue };
        let Ok(array) = Array::parse(name, content) else { continue };
        let (domain, width) = match array.shape[..] {
            [first] if first == strands => (Domain::Strands, 1),
            [first, second] if first == strands && second == points => (Domain::Points, 1),
            [first, width] if first == strands && width <= WIDEST => (Domain::Strands, width),
            [first, second, width] if first == strands && second == points && width <= WIDEST => (Domain::Points, width),
            _ => continue,
        };
        let is_strands = if named { POSITIONS.strip_suffix(".npy") == Some(member) } else { array.shape == [strands, points, 3] };
        if is_strands {
            continue;
        }
        let mut numbers = bytes::list(array.content.len() / array.kind.width())?;
        numbers.extend(array.content.chunks_exact(array.kind.width()).map(|bytes| array.kind.number(bytes)));
        attributes.push(FileAttribute { name: member.to_owned(), domain, width, numbers });
    }
    Ok(attributes)
}

fn compressed(name: &str, member: &str) -> Error {
    Error::file(name, format_args!("holds {member} compressed; save it without compression (numpy.savez)"))
}

/// A member's content is compressed.
#[derive(Debug)]
struct Compressed;

type Members<'a> = Vec<(String, std::result::Result<&'a [u8], Compressed>)>;

fn u16_at(bytes: &[u8], at: usize) -> usize {
    usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]))
}

/// The members of an archive by its directory, which is at its end.
fn members<'a>(name: &str, bytes: &'a [u8]) -> Result<Members<'a>> {
    let broken = |what: &str| Error::file(name, format_args!("is a broken archive: {what}"));
    const END: usize = 22;
    let last = bytes.len().checked_sub(END).ok_or_else(|| broken("it is too short"))?;
    let end = (last.saturating_sub(0xffff)..=last).rev().find(|at| bytes[*at..].starts_with(b"PK\x05\x06"));
    let end = end.ok_or_else(|| broken("its directory was not found"))?;
    let (count, mut at) = (u16_at(bytes, end + 10), u32_at(bytes, end + 16) as usize);
    let mut members = Vec::new();
    for _ in 0..count {
        let entry = bytes.get(at..).filter(|entry| entry.len() >= 46 && entry.starts_with(b"PK\x01\x02"));
        let entry = entry.ok_or_else(|| broken("its directory is truncated"))?;
        let [name_length, extra, comment] = [28, 30, 32].map(|at| u16_at(entry, at));
        let member = entry.get(46..46 + name_length).ok_or_else(|| broken("its directory is truncated"))?;
        let [size, start] = [20, 42].map(|at| u32_at(entry, at) as usize);
        if size == u32::MAX as usize || start == u32::MAX as usize {
            return Err(broken("a member is larger than 4 GB"));
        }
        let header = bytes.get(start..).filter(|header| header.len() >= 30 && header.starts_with(b"PK\x03\x04"));
        let header = header.ok_or_else(|| broken("a member was not found"))?;
        let skip = 30 + u16_at(header, 26) + u16_at(header, 28);
        let content = header.get(skip..).and_then(|rest| rest.get(..size)).ok_or_else(|| broken("a member is truncated"))?;
        let stored = u16_at(entry, 10) == 0;
        members.push((String::from_utf8_lossy(member).into_owned(), if stored { Ok(content) } else { Err(Compressed) }));
        at += 46 + name_length + extra + comment;
    }
    Ok(members)
}

/// A number's type.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Float(usize),
    Signed(usize),
    Unsigned(usize),
}

impl Kind {
    fn of(kind: &str) -> Option<Self> {
        Some(match kind {
            "<f2" => Kind::Float(2),
            "<f4" => Kind::Float(4),
            "<f8" => Kind::Float(8),
            "|i1" => Kind::Signed(1),
            "<i2" => Kind::Signed(2),
            "<i4" => Kind::Signed(4),
            "<i8" => Kind::Signed(8),
            "|u1" | "|b1" => Kind::Unsigned(1),
            "<u2" => Kind::Unsigned(2),
            "<u4" => Kind::Unsigned(4),
            "<u8" => Kind::Unsigned(8),
            _ => return None,
        })
    }

    fn width(self) -> usize {
        match self {
            Kind::Float(width) | Kind::Signed(width) | Kind::Unsigned(width) => width,
        }
    }

    /// The number that these bytes, as many as it takes, are.
    fn number(self, bytes: &[u8]) -> f64 {
        let bits = bytes.iter().rev().fold(0_u64, |bits, byte| bits << 8 | u64::from(*byte));
        match self {
            Kind::Float(2) => f64::from(half(bits as u16)),
            Kind::Float(4) => f64::from(f32::from_bits(bits as u32)),
            Kind::Float(_) => f64::from_bits(bits),
            Kind::Unsigned(_) => bits as f64,
            Kind::Signed(width) => {
                let unused = 64 - 8 * width as u32;
                ((bits << unused) as i64 >> unused) as f64
            }
        }
    }
}

/// An array whose header has been read.
struct Array<'a> {
    kind: Kind,
    shape: Vec<usize>,
    content: &'a [u8],
}

impl<'a> Array<'a> {
    /// An array of floats.
    fn read(name: &str, bytes: &'a [u8]) -> Result<Self> {
        let array = Self::parse(name, bytes)?;
        if !matches!(array.kind, Kind::Float(_)) {
            return Err(Error::file(name, "is an array of integers; expected floats, <f4, <f8 or <f2"));
        }
        Ok(array)
    }

    fn parse(name: &str, bytes: &'a [u8]) -> Result<Self> {
        let error = |reason: std::fmt::Arguments<'_>| Err(Error::file(name, reason));
        if !is_npy(bytes) || bytes.len() < 12 {
            return error(format_args!("is not an array of NumPy, or truncated in its header"));
        }
        let (length, begin) = if bytes[6] == 1 { (u16_at(bytes, 8), 10) } else { (u32_at(bytes, 8) as usize, 12) };
        let header = bytes.get(begin..).and_then(|rest| rest.get(..length)).and_then(|text| std::str::from_utf8(text).ok());
        let Some(header) = header else { return error(format_args!("is truncated in its header")) };
        let after =
            |key: &str| header.split_once(key).and_then(|(_, rest)| rest.split_once(':')).map(|(_, rest)| rest.trim_start());
        let kind = after("'descr'").and_then(|rest| rest.strip_prefix('\'')?.split('\'').next()).unwrap_or_default();
        let Some(kind) = Kind::of(kind) else {
            return error(format_args!("is an array of type {kind:?}; expected floats, <f4, <f8 or <f2"));
        };
        if !after("'fortran_order'").is_some_and(|rest| rest.starts_with("False")) {
            return error(format_args!("is in Fortran order; save it in C order (numpy.ascontiguousarray)"));
        }
        let shape = after("'shape'").and_then(|rest| rest.strip_prefix('(')?.split_once(')')).map(|(inside, _)| inside);
        let shape: Option<Vec<usize>> = shape.and_then(|inside| {
            inside.split(',').map(str::trim).filter(|word| !word.is_empty()).map(|word| word.parse().ok()).collect()
        });
        let Some(shape) = shape else { return error(format_args!("has no shape in its header")) };
        let content = &bytes[begin + length..];
        let width = kind.width();
        let needed = shape.iter().try_fold(width, |all: usize, side| all.checked_mul(*side));
        if needed != Some(content.len()) {
            let (has, what) = (content.len(), &shape);
            return error(format_args!(
                "is truncated or oversized: its shape is {what:?}, {width} bytes a number, and it has {has} bytes"
            ));
        }
        Ok(Self { kind, shape, content })
    }

    /// Its strands, if it has their shape.
    fn strands(&self, name: &str) -> Option<Result<NumpyStrands>> {
        let [strands, points, 3] = self.shape[..] else { return None };
        Some(self.read_points(name, strands, points))
    }

    fn read_points(&self, name: &str, strands: usize, points: usize) -> Result<NumpyStrands> {
        let (Ok(points_per_strand), true) = (u32::try_from(points), strands > 0 && points > 0) else {
            return Err(Error::file(name, format_args!("has {strands} strands of {points} points; expected some")));
        };
        let mut all = bytes::list(strands * points)?;
        let number = |bytes: &[u8]| self.kind.number(bytes) as f32;
        all.extend(self.content.chunks_exact(3 * self.kind.width()).map(|point| {
            let mut axes = point.chunks_exact(self.kind.width()).map(number);
            std::array::from_fn(|_| axes.next().unwrap_or(f32::NAN))
        }));
        Ok(NumpyStrands { points: all, points_per_strand })
    }
}

/// A float of 16 bits.
fn half(bits: u16) -> f32 {
    let (sign, exponent, fraction) = (if bits >> 15 == 1 { -1.0 } else { 1.0 }, bits >> 10 & 31, f32::from(bits & 1023));
    sign * match exponent {
        0 => fraction * (-24_f32).exp2(),
        31 if fraction == 0.0 => f32::INFINITY,
        31 => f32::NAN,
        _ => (1.0 + fraction / 1024.0) * (f32::from(exponent) - 15.0).exp2(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_exact() {
        for (bits, value) in
            [(0x3c00, 1.0), (0xc000, -2.0), (0x3555, 0.333_251_95), (1, 5.960_464_5e-8), (0x7bff, 65504.0), (0, 0.0)]
        {
            assert_eq!(half(bits), value);
        }
        assert!(half(0x7e00).is_nan() && half(0xfc00) == f32::NEG_INFINITY);
    }
}
