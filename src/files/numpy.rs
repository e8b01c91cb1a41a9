//! NumPy's `.npy` and `.npz` files that hold strands: an array of strands by points by three, root first.
//!
//! Floats of 16, 32 or 64 bits, little-endian, in C order. Of an `.npz` file, which is an archive of arrays, the array
//! `positions` is read, else the only one of that shape. Compressed archives (`savez_compressed`) are refused.

use crate::error::{Error, Result};
use crate::files::bytes::{self, u32_at};

/// What an array of strands holds.
#[derive(Debug)]
pub(super) struct NumpyStrands {
    /// All points, in the file's unit; numbers may be infinite or not numbers.
    pub points: Vec<[f32; 3]>,
    /// Points of every strand.
    pub points_per_strand: u32,
}

const MAGIC: &[u8] = b"\x93NUMPY";

/// Whether a file begins as an array.
pub(super) fn is_npy(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Whether a file is an archive whose first member is an array.
pub(super) fn is_npz(bytes: &[u8]) -> bool {
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
    if let Some((member, content)) = members.iter().find(|(member, _)| member == "positions.npy") {
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

/// An array whose header has been read.
struct Array<'a> {
    width: usize,
    shape: Vec<usize>,
    content: &'a [u8],
}

impl<'a> Array<'a> {
    fn read(name: &str, bytes: &'a [u8]) -> Result<Self> {
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
        let width = match kind {
            "<f2" => 2,
            "<f4" => 4,
            "<f8" => 8_usize,
            _ => return error(format_args!("is an array of type {kind:?}; expected floats, <f4, <f8 or <f2")),
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
        let needed = shape.iter().try_fold(width, |all: usize, side| all.checked_mul(*side));
        if needed != Some(content.len()) {
            let (has, what) = (content.len(), &shape);
            return error(format_args!(
                "is truncated or oversized: its shape is {what:?}, {width} bytes a number, and it has {has} bytes"
            ));
        }
        Ok(Self { width, shape, content })
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
        let number = |bytes: &[u8]| match self.width {
            2 => half(u16::from_le_bytes([bytes[0], bytes[1]])),
            4 => f32::from_bits(u32_at(bytes, 0)),
            _ => f64::from_bits(u64::from(u32_at(bytes, 0)) | u64::from(u32_at(bytes, 4)) << 32) as f32,
        };
        all.extend(self.content.chunks_exact(3 * self.width).map(|point| {
            let mut axes = point.chunks_exact(self.width).map(number);
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
