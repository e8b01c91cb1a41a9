//! Wavefront OBJ with faces: `v x y z` for each vertex, `f a b c ...` for each triangle or polygon.
//!
//! The reader skips groups, objects, materials, normals and comments, and whatever follows x, y and z (a weight, a colour). It
//! cuts polygons into triangles, and refuses lines, points and curved surfaces. Only [`read_textured`] reads texture coordinates:
//! contact does not need them, and no mesh for contact is refused for them.

use std::path::Path;

use nalgebra::Vector3;

use super::obj_lines::{is_left, vertex_index};
use super::polygon;
use crate::error::{Error, Result};
use crate::files::io::bytes;
use crate::files::io::text::{Quote, Text, number};

/// Most corners of a face: the cost of cutting a polygon grows with their square.
pub const MAX_CORNERS: usize = 1000;

/// First words of lines about vertices that a mesh for contact does not need.
const OF_VERTICES: [&str; 3] = ["vn", "vt", "vp"];

/// A triangle mesh in a file's own units; scaled to metres, [`Shape::new_mesh`](crate::contact::shape::Shape::new_mesh) takes it.
/// Every number is finite, every index is that of a vertex, and the three of a triangle differ. The shape checks that the mesh is
/// closed and that its triangles have areas.
///
/// ```
/// use superhelix::Shape;
/// use superhelix::io::obj_mesh;
/// use superhelix::shapes::Sides;
///
/// let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
/// let mesh = obj_mesh::read_from_bytes("plate.obj", text)?;
/// let plate = Shape::new_mesh(mesh.vertices, mesh.triangles, Sides::Both)?;
/// assert!(plate.mesh().is_some());
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ObjMesh {
    /// Vertices in file units, in the file's order; some may belong to no triangle.
    pub vertices: Vec<Vector3<f64>>,
    /// Triangles, three vertex indices each (from 0), wound like the file's faces.
    pub triangles: Vec<[u32; 3]>,
}

/// Texture coordinates of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    /// u and v, in the file's order.
    pub coordinates: Vec<[f64; 2]>,
    /// For each triangle the indices (from 0) of its corners' coordinates. One vertex may have several, so seams may run through
    /// the mesh.
    pub triangles: Vec<[u32; 3]>,
}

impl Texture {
    /// Coordinates of every triangle's corners, as [`Scalp::new`](crate::groom::scalp::Scalp::new) takes them.
    pub fn corners(&self) -> Vec<[[f64; 2]; 3]> {
        self.triangles.iter().map(|triangle| triangle.map(|index| self.coordinates[index as usize])).collect()
    }
}

/// Reads the faces of an OBJ file; any thread may call it.
///
/// # Errors
/// [`Error::File`] naming the path, and the line where there is one: when the file cannot be read, is not an OBJ, has no faces,
/// has more than 2³² − 2 vertices or triangles, has a face of fewer than 3 or more than [`MAX_CORNERS`] corners or one that names
/// a vertex twice, or a polygon that cannot be cut into triangles (it crosses itself, or has no area). [`Error::OutOfMemory`].
pub fn read(path: impl AsRef<Path>) -> Result<ObjMesh> {
    let path = path.as_ref();
    read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?)
}

/// [`read`] from memory. `name` replaces the path in errors.
///
/// # Errors
/// As [`read`].
pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<ObjMesh> {
    Ok(read_parts(name, bytes, false)?.0)
}

/// Reads the faces and their texture coordinates (`vt u v`; v defaults to 0, a third number is skipped). `None` if a corner of a
/// face has none.
///
/// # Errors
/// As [`read`], and for coordinates that are not finite or a corner that names one not above its line.
pub fn read_textured(path: impl AsRef<Path>) -> Result<(ObjMesh, Option<Texture>)> {
    let path = path.as_ref();
    read_textured_from_bytes(&path.display().to_string(), &bytes::read_file(path)?)
}

/// [`read_textured`] from memory. `name` replaces the path in errors.
///
/// # Errors
/// As [`read_textured`].
pub fn read_textured_from_bytes(name: &str, bytes: &[u8]) -> Result<(ObjMesh, Option<Texture>)> {
    read_parts(name, bytes, true)
}

fn read_parts(name: &str, bytes: &[u8], textured: bool) -> Result<(ObjMesh, Option<Texture>)> {
    // A first pass counts, so that one allocation of the right size is enough.
    let (mut vertex_count, mut coordinate_count, mut triangle_count) = (0, 0, 0);
    let mut text = Text::new(name, bytes);
    while let Some((_, content)) = text.next_full_line()? {
        let mut words = content.split_ascii_whitespace();
        match words.next() {
            Some("v") => vertex_count += 1,
            Some("vt") => coordinate_count += usize::from(textured),
            Some("f") => triangle_count += words.count().saturating_sub(2),
            _ => {}
        }
    }
    let most = u32::MAX as usize - 1;
    if vertex_count > most || coordinate_count > most || triangle_count > most {
        return Err(Error::file(
            name,
            format_args!(
                "has {vertex_count} vertices, {coordinate_count} texture coordinates and {triangle_count} triangles; at most {most}"
            ),
        ));
    }

    let mut vertices: Vec<Vector3<f64>> = bytes::list(vertex_count)?;
    let mut triangles = bytes::list(triangle_count)?;
    let mut coordinates: Vec<[f64; 2]> = bytes::list(coordinate_count)?;
    // As long as every corner has one.
    let mut texture: Option<Vec<[u32; 3]>> = if textured { Some(bytes::list(triangle_count)?) } else { None };
    let (mut corners, mut sorted): (Vec<u32>, Vec<u32>) = (Vec::new(), Vec::new());
    let mut texture_corners: Vec<Option<u32>> = Vec::new();
    let mut text = Text::new(name, bytes);
    while let Some((line, content)) = text.next_full_line()? {
        let mut words = content.split_ascii_whitespace();
        match words.next() {
            Some("v") => vertices.push(vertex(&text, line, content)?),
            Some("vt") if textured => coordinates.push(coordinate(&text, line, content)?),
            Some("f") => {
                corners.clear();
                texture_corners.clear();
                for word in words {
                    corners.push(corner(&text, line, word, vertices.len())?);
                    if texture.is_some() {
                        texture_corners.push(texture_corner(&text, line, word, coordinates.len())?);
                    }
                    if corners.len() > MAX_CORNERS {
                        return Err(text.error(line, format_args!("a face of more than {MAX_CORNERS} corners")));
                    }
                }
                if corners.len() < 3 {
                    let count = corners.len();
                    return Err(text.error(line, format_args!("a face of {count} corners; expected at least three")));
                }
                sorted.clone_from(&corners);
                if let Some(twice) = polygon::named_twice(&mut sorted) {
                    return Err(text.error(line, format_args!("a face that names vertex {} twice", twice + 1)));
                }
                let first = triangles.len();
                if !polygon::cut(&vertices, &corners, &mut triangles) {
                    let count = corners.len();
                    return Err(text.error(
                        line,
                        format_args!("a face of {count} corners that crosses itself or has no area; expected a simple polygon"),
                    ));
                }
                if let Some(list) = &mut texture {
                    // A face names each of its vertices once: the vertex identifies the corner.
                    let of = |vertex: &u32| corners.iter().position(|corner| corner == vertex).and_then(|at| texture_corners[at]);
                    for [a, b, c] in &triangles[first..] {
                        match (of(a), of(b), of(c)) {
                            (Some(a), Some(b), Some(c)) => list.push([a, b, c]),
                            _ => {
                                texture = None;
                                break;
                            }
                        }
                    }
                }
            }
            Some(word) if is_left(word) || OF_VERTICES.contains(&word) => {}
            _ => {
                let expected = "only faces (v and f) are read";
                return Err(text.error(line, format_args!("{}: {expected}", Quote(content))));
            }
        }
    }
    if triangles.is_empty() {
        return Err(Error::file(name, "has no faces (\"f\" lines)"));
    }
    let texture = texture.map(|triangles| Texture { coordinates, triangles });
    Ok((ObjMesh { vertices, triangles }, texture))
}

/// A texture coordinate.
fn coordinate(text: &Text<'_>, line: usize, content: &str) -> Result<[f64; 2]> {
    let words: Vec<&str> = content.split_ascii_whitespace().skip(1).take(4).collect();
    match words[..] {
        [u] => Ok([number(text, line, "u", u)?, 0.0]),
        [u, v] | [u, v, _] => Ok([number(text, line, "u", u)?, number(text, line, "v", v)?]),
        _ => Err(text.error(line, format_args!("{}; expected \"vt u v\"", Quote(content)))),
    }
}

/// The texture coordinate of a face's corner, if it has one.
fn texture_corner(text: &Text<'_>, line: usize, word: &str, known: usize) -> Result<Option<u32>> {
    let Some(part) = word.split('/').nth(1).filter(|part| !part.is_empty()) else { return Ok(None) };
    match vertex_index(part, known) {
        Some(index) => Ok(Some(index as u32)),
        None => {
            let expected = format_args!("expected 1 to {known} (those above this line)");
            Err(text.error(line, format_args!("texture coordinate {}; {expected}", Quote(part))))
        }
    }
}

/// A vertex's position. A weight, a colour, or both may follow it.
fn vertex(text: &Text<'_>, line: usize, content: &str) -> Result<Vector3<f64>> {
    let mut words = content.split_ascii_whitespace().skip(1);
    let row: [&str; 3] = std::array::from_fn(|_| words.next().unwrap_or_default());
    let more = words.clone().count();
    if row[2].is_empty() || ![0, 1, 3, 4].contains(&more) {
        return Err(text.error(line, format_args!("{}; expected \"v x y z\"", Quote(content))));
    }
    for word in words {
        number(text, line, "a vertex's weight or colour", word)?;
    }
    Ok(Vector3::new(number(text, line, "x", row[0])?, number(text, line, "y", row[1])?, number(text, line, "z", row[2])?))
}

/// The vertex of a face's corner: `a`, `a/t`, `a//n` or `a/t/n`.
fn corner(text: &Text<'_>, line: usize, word: &str, known: usize) -> Result<u32> {
    let mut parts = word.split('/');
    let index = parts.next().and_then(|word| vertex_index(word, known));
    let rest = parts.clone().all(|part| part.is_empty() || part.parse::<i64>().is_ok()) && parts.count() <= 2;
    match index.filter(|_| rest) {
        Some(index) => Ok(index as u32),
        None => Err(text.error(line, format_args!("vertex {}; expected 1 to {known} (those above this line)", Quote(word)))),
    }
}
