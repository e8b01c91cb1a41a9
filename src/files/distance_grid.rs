//! Files of signed distance grids, as [`DistanceGrid::bake`] makes them.
//!
//! Little-endian: `SHXDGRID`, version (u32, 1), nodes along x, y and z (u32 each), lowest node (three f64, m), cell size and band
//! (f64, m), then the distances (f32, m) with x running fastest.

use std::path::Path;

use nalgebra::Vector3;

use super::io::bytes::{Section, read_file, reserve, u32_at, write_file};
use crate::contact::shape::{DistanceGrid, NODE_LIMIT, node_count};
use crate::error::{Error, Result};

const MAGIC: &[u8; 8] = b"SHXDGRID";
const VERSION: u32 = 1;
/// Bytes before the distances.
const HEADER: usize = 8 + 4 + 3 * 4 + 5 * 8;

/// Reads a grid from a file.
///
/// # Errors
/// [`Error::File`] when it cannot be read, is not a grid, is truncated or of another version, or has a number that is not finite.
pub fn read(path: impl AsRef<Path>) -> Result<DistanceGrid> {
    let path = path.as_ref();
    read_from_bytes(&path.display().to_string(), &read_file(path)?)
}

/// [`read`] from memory; `name` replaces the path in errors.
///
/// # Errors
/// As [`read`].
pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<DistanceGrid> {
    let header = Section::of(name, bytes, "header", 0, 1, HEADER as u64)?.bytes;
    if &header[..8] != MAGIC {
        return Err(Error::file(name, "is not a distance grid: it does not begin with SHXDGRID"));
    }
    let version = u32_at(header, 8);
    if version != VERSION {
        return Err(Error::file(
            name,
            format_args!("is a distance grid of version {version}; this library reads version {VERSION}"),
        ));
    }
    let counts = [12, 16, 20].map(|at| u32_at(header, at));
    let number = |index: usize| {
        let at = 24 + 8 * index;
        f64::from_bits(u64::from(u32_at(header, at)) | u64::from(u32_at(header, at + 4)) << 32)
    };
    let nodes = node_count(counts).filter(|nodes| *nodes <= NODE_LIMIT);
    let Some(nodes) = nodes else {
        return Err(Error::file(name, format_args!("has {counts:?} nodes; at most {NODE_LIMIT} are read")));
    };
    // The bytes present bound the memory requested.
    let section = Section::of(name, bytes, "distances", HEADER as u64, nodes, 4)?;
    if section.end() != bytes.len() {
        return Err(Error::file(name, format_args!("has {} bytes after its last distance", bytes.len() - section.end())));
    }
    let values = section.singles("distance")?;
    DistanceGrid::from_parts(Vector3::new(number(0), number(1), number(2)), number(3), number(4), counts, values.into())
        .map_err(|error| Error::file(name, error))
}

/// Writes a grid to a file.
///
/// # Errors
/// [`Error::File`] when it cannot be written; [`Error::OutOfMemory`].
pub fn write(path: impl AsRef<Path>, grid: &DistanceGrid) -> Result<()> {
    write_file(path.as_ref(), &write_to_bytes(grid)?)
}

/// How many bytes [`write_to_bytes`] makes from a grid with these numbers of nodes along x, y and z.
pub fn size(counts: [u32; 3]) -> usize {
    HEADER + 4 * counts.iter().map(|count| *count as usize).product::<usize>()
}

/// A grid as bytes; [`read_from_bytes`] restores the same grid, bit for bit.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub fn write_to_bytes(grid: &DistanceGrid) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    reserve(&mut bytes, size(grid.counts()))?;
    write_in_pieces(grid, |piece| bytes.extend_from_slice(piece));
    Ok(bytes)
}

/// The bytes of a grid, piece after piece.
pub(crate) fn write_in_pieces(grid: &DistanceGrid, mut put: impl FnMut(&[u8])) {
    put(MAGIC);
    put(&VERSION.to_le_bytes());
    for count in grid.counts() {
        put(&count.to_le_bytes());
    }
    let low = grid.low();
    for number in [low.x, low.y, low.z, grid.cell(), grid.band()] {
        put(&number.to_le_bytes());
    }
    let mut piece = [0; 1024];
    for values in grid.values().chunks(piece.len() / 4) {
        for (place, value) in piece.chunks_exact_mut(4).zip(values) {
            place.copy_from_slice(&value.to_le_bytes());
        }
        put(&piece[..4 * values.len()]);
    }
}
