//! USD as text (`.usda`): reads and writes curves. [`mesh_cache`](crate::files::mesh_cache) reads meshes over time.
//!
//! The reader takes `BasisCurves` (linear; cubic Bézier, B-spline and Catmull–Rom, open or pinned) and `NurbsCurves` anywhere
//! among the prims, with widths, velocities, `displayColor`, `displayOpacity` and `st`, their time samples, the `xformOp`s of
//! their ancestors, and the layer's units, axes and time. It reads one layer by itself, and refuses one with sublayers,
//! references, payloads, inherits, specializes or variant sets. The writer makes one prim of linear curves.
//! docs/reference/files.md says why the binary forms (`.usdc`, `.usdz`) are not read.

use std::io::Write;
use std::path::Path;

use super::usda_layer::{Layer, Wanted};
use super::{usd_curves, usd_primvars};
use crate::error::{Error, Result};
use crate::files::curves::{Curves, UpAxis};
use crate::files::io::bytes;
use crate::files::strands::strand_attributes::FileAttribute;

/// Reads the curves of a `.usda` file, at its first time sample if it has any.
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
    if let Some(what) = other_scene_format(bytes) {
        return Err(Error::file(name, what));
    }
    let layer = Layer::read(name, bytes, Wanted::Curves)?;
    let first = usd_curves::times(&layer).first().copied().unwrap_or(0.0);
    usd_curves::at(&layer, name, first)
}

/// The numeric primvars of the curves of a file that [`read_from_bytes`] reads, at the same time.
pub(in crate::files) fn attributes(name: &str, bytes: &[u8]) -> Result<Vec<FileAttribute>> {
    let layer = Layer::read(name, bytes, Wanted::CurvesAndPrimvars)?;
    let first = usd_curves::times(&layer).first().copied().unwrap_or(0.0);
    Ok(usd_primvars::at(&layer, first))
}

/// What a file is that starts like a scene in another format.
pub(in crate::files) fn other_scene_format(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [b'P', b'X', b'R', b'-', b'U', b'S', b'D', b'C', ..] => Some(
            "is a binary USD file: make it text first (python -m superhelix.usd convert groom.usdc groom.usda), or read it with superhelix.usd in Python (pip install \"superhelix[usd]\")",
        ),
        [b'P', b'K', 3, 4, ..] => Some(
            "is an archive (.usdz?): make it text first (python -m superhelix.usd convert groom.usdz groom.usda), or read it with superhelix.usd in Python (pip install \"superhelix[usd]\")",
        ),
        [b'O', b'g', b'a', b'w', b'a', ..] => Some("is an Alembic file: export .usda instead"),
        [0x89, b'H', b'D', b'F', ..] => Some("is an HDF5 file (Alembic's old form?): export .usda instead"),
        _ => None,
    }
}

/// Writes curves as a `.usda` file: one `BasisCurves` of linear curves, `/groom/strands`, with the curves' widths, velocities,
/// colours, opacities and texture coordinates. Reading the numbers back gives the same floats; opacity is one minus transparency.
/// Data without a USD name (held points, thickness factors) goes into primvars `superhelix:held` and
/// `superhelix:strandThickness`. The defaults in a `.hair` file's header become constant widths, opacity and colour where there
/// is no list. Curves without a unit are in metres, those without an axis have y up.
///
/// # Errors
/// [`Error::File`] naming the path when it cannot be written.
pub fn write(path: impl AsRef<Path>, curves: &Curves) -> Result<()> {
    bytes::write_file(path.as_ref(), &write_to_bytes(curves))
}

/// [`write()`] into memory.
pub fn write_to_bytes(curves: &Curves) -> Vec<u8> {
    let mut out = Vec::with_capacity(32 * curves.point_count());
    let extras = curves.extras();
    let layer =
        LayerHead { metres_per_unit: extras.metres_per_unit.unwrap_or(1.0), up: extras.up.unwrap_or(UpAxis::Y), times: None };
    // Writing to a Vec cannot fail, so results can be ignored.
    let _ = layer.write(&mut out);
    let _ = write_counts(&mut out, curves.counts());
    let (low, high) = extent(curves);
    let _ = writeln!(out, "        float3[] extent = [{}, {}]", Vector(low), Vector(high));
    let _ = write!(out, "        point3f[] points = ");
    let _ = write_list(&mut out, curves.points().iter().map(|point| Vector(*point)));
    out.push(b'\n');
    if let Some(velocities) = &extras.velocities {
        let _ = write!(out, "        vector3f[] velocities = ");
        let _ = write_list(&mut out, velocities.iter().map(|vector| Vector(*vector)));
        out.push(b'\n');
    }
    let _ = write_constant(&mut out, curves);
    let _ = writeln!(out, "    }}\n}}");
    out
}

/// Data that does not change over time: widths, colours and the like.
pub(in crate::files) fn write_constant(out: &mut impl Write, curves: &Curves) -> std::io::Result<()> {
    let extras = curves.extras();
    let header = extras.hair_header.as_ref();
    let one = |value: f32| vec![value];
    let end = |how: &str| format!(" (\n            interpolation = \"{how}\"\n        )\n");
    let (widths, how) = match (&extras.thickness, header) {
        (Some(list), _) => (Some(list.clone()), "vertex"),
        (None, header) => (header.map(|header| one(header.thickness)), "constant"),
    };
    if let Some(widths) = widths {
        write!(out, "        float[] widths = ")?;
        write_list(out, widths.iter())?;
        out.write_all(end(how).as_bytes())?;
    }
    let (colors, how) = match (&extras.colors, header) {
        (Some(list), _) => (Some(list.clone()), "vertex"),
        (None, header) => (header.map(|header| vec![header.color]), "constant"),
    };
    if let Some(colors) = colors {
        write!(out, "        color3f[] primvars:displayColor = ")?;
        write_list(out, colors.iter().map(|color| Vector(*color)))?;
        out.write_all(end(how).as_bytes())?;
    }
    let (transparency, how) = match (&extras.transparency, header) {
        (Some(list), _) => (Some(list.clone()), "vertex"),
        (None, header) => (header.map(|header| one(header.transparency)), "constant"),
    };
    if let Some(transparency) = transparency {
        write!(out, "        float[] primvars:displayOpacity = ")?;
        write_list(out, transparency.iter().map(|transparency| 1.0 - transparency))?;
        out.write_all(end(how).as_bytes())?;
    }
    if let Some(uvs) = &extras.strand_uvs {
        write!(out, "        texCoord2f[] primvars:st = ")?;
        write_list(out, uvs.iter().map(|[u, v]| format!("({u}, {v})")))?;
        out.write_all(end("uniform").as_bytes())?;
    }
    if let Some(thickness) = &extras.strand_thickness {
        write!(out, "        float[] primvars:superhelix:strandThickness = ")?;
        write_list(out, thickness.iter())?;
        out.write_all(end("uniform").as_bytes())?;
    }
    if let Some(held) = &extras.held {
        write!(out, "        int[] primvars:superhelix:held = ")?;
        write_list(out, held.iter().map(|held| u8::from(*held)))?;
        out.write_all(end("vertex").as_bytes())?;
    }
    Ok(())
}

/// The header of a written layer.
pub(in crate::files) struct LayerHead {
    pub metres_per_unit: f64,
    pub up: UpAxis,
    /// Time codes per second, the first and the last time code.
    pub times: Option<(f64, f64, f64)>,
}

impl LayerHead {
    /// From the first byte to the start of the curves.
    pub fn write(&self, out: &mut impl Write) -> std::io::Result<()> {
        let up = if self.up == UpAxis::Y { "Y" } else { "Z" };
        write!(out, "#usda 1.0\n(\n    defaultPrim = \"groom\"\n    doc = \"written by superhelix\"\n")?;
        if let Some((per_second, first, last)) = self.times {
            write!(out, "    startTimeCode = {first}\n    endTimeCode = {last}\n    timeCodesPerSecond = {per_second}\n")?;
            writeln!(out, "    framesPerSecond = {per_second}")?;
        }
        write!(out, "    metersPerUnit = {}\n    upAxis = \"{up}\"\n)\n\n", self.metres_per_unit)?;
        write!(out, "def Xform \"groom\"\n{{\n    def BasisCurves \"strands\"\n    {{\n")?;
        write!(out, "        uniform token type = \"linear\"\n        uniform token wrap = \"nonperiodic\"\n")
    }
}

/// The attribute with the curves' numbers of points.
pub(in crate::files) fn write_counts(out: &mut impl Write, counts: &[u32]) -> std::io::Result<()> {
    write!(out, "        int[] curveVertexCounts = ")?;
    write_list(out, counts.iter())?;
    out.write_all(b"\n")
}

/// The box of all points with half the greatest width around each, as USD requires.
pub(in crate::files) fn extent(curves: &Curves) -> ([f32; 3], [f32; 3]) {
    let extras = curves.extras();
    let default = extras.hair_header.as_ref().map_or(0.0, |header| header.thickness);
    let half = 0.5 * extras.thickness.as_ref().map_or(default, |list| list.iter().copied().fold(0.0, f32::max)).max(0.0);
    let (low, high) = curves.bounding_box();
    (low.map(|value| value - half), high.map(|value| value + half))
}

/// Three numbers in round brackets.
pub(in crate::files) struct Vector(pub [f32; 3]);

impl std::fmt::Display for Vector {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.0;
        write!(f, "({x}, {y}, {z})")
    }
}

/// `[a, b, ...]`.
pub(in crate::files) fn write_list(
    out: &mut impl Write,
    items: impl Iterator<Item = impl std::fmt::Display>,
) -> std::io::Result<()> {
    out.write_all(b"[")?;
    for (index, item) in items.enumerate() {
        write!(out, "{}{item}", if index == 0 { "" } else { ", " })?;
    }
    out.write_all(b"]")
}
