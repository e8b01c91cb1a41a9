//! A layer of a USD text file: its units, axes and time, its curve or mesh prims, and the placements of their ancestors.
//!
//! A layer is read by itself, without anything that other files or variants would add. If it asks for such things, it is refused
//! rather than read in part.

use nalgebra::Matrix4;

use super::usd_mesh::MeshPrim;
use super::usd_placement::Placement;
use super::usd_primvars::Primvar;
use super::usda_scan::Scan;
use super::usda_values::{Attribute, Interpolation, list, tuple};
use crate::error::{Error, Result};
use crate::files::curves::UpAxis;

/// Metadata that brings in other content.
const ARCS: [&str; 6] = ["subLayers", "references", "payload", "inherits", "specializes", "variantSets"];

/// The curves of a prim, as in the file.
#[derive(Debug, Default)]
pub(in crate::files) struct CurvesPrim {
    /// Whether this is `NurbsCurves` and not `BasisCurves`.
    pub nurbs: bool,
    /// linear or cubic.
    pub kind: Option<Box<str>>,
    /// bezier, bspline, catmullRom.
    pub basis: Option<Box<str>>,
    /// nonperiodic, pinned, periodic.
    pub wrap: Option<Box<str>>,
    pub counts: Attribute<Vec<u32>>,
    pub points: Attribute<Vec<[f32; 3]>>,
    pub velocities: Attribute<Vec<[f32; 3]>>,
    pub widths: Attribute<Vec<f32>>,
    pub colors: Attribute<Vec<[f32; 3]>>,
    pub color_indices: Attribute<Vec<u32>>,
    pub opacities: Attribute<Vec<f32>>,
    pub opacity_indices: Attribute<Vec<u32>>,
    pub uvs: Attribute<Vec<[f32; 2]>>,
    pub uv_indices: Attribute<Vec<u32>>,
    pub strand_thickness: Attribute<Vec<f32>>,
    pub held: Attribute<Vec<u32>>,
    pub orders: Attribute<Vec<u32>>,
    pub knots: Attribute<Vec<f64>>,
    pub weights: Attribute<Vec<f64>>,
    /// Primvars that are not among the above, if they are wanted.
    pub primvars: Vec<Primvar>,
}

/// The attributes of curves that are read.
const WANTED: [&str; 18] = [
    "type",
    "basis",
    "wrap",
    "curveVertexCounts",
    "points",
    "velocities",
    "widths",
    "primvars:displayColor",
    "primvars:displayColor:indices",
    "primvars:displayOpacity",
    "primvars:displayOpacity:indices",
    "primvars:st",
    "primvars:st:indices",
    "primvars:superhelix:strandThickness",
    "primvars:superhelix:held",
    "order",
    "knots",
    "pointWeights",
];

/// What to read of a layer; everything else is skipped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::files) enum Wanted {
    Curves,
    /// Curves with all their numeric primvars.
    CurvesAndPrimvars,
    Meshes,
}

/// The type of a prim, among the wanted ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PrimKind {
    None,
    Basis,
    Nurbs,
    Mesh,
}

/// The purpose of a prim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Purpose {
    /// For rendering: `default`, `render`.
    Seen,
    /// For editing: `guide`, `proxy`.
    Aid,
}

/// A prim: its name, its parent, and its curves, mesh and placement if it has any. Small prims are numerous, so rare fields are
/// created on first use.
#[derive(Debug)]
pub(in crate::files) struct Prim {
    name: Box<str>,
    parent: Option<u32>,
    /// Whether it and all its ancestors are defined, active and not abstract.
    alive: bool,
    kind: PrimKind,
    /// Whether it makes itself and its descendants invisible.
    invisible: bool,
    /// Its own purpose if it has one; else its parent's.
    purpose: Option<Purpose>,
    /// Whether it says that a skeleton moves it and its descendants.
    skinned: bool,
    pub curves: Option<Box<CurvesPrim>>,
    pub mesh: Option<Box<MeshPrim>>,
    pub placement: Option<Box<Placement>>,
}

impl Prim {
    /// Its curves, which it is to have.
    fn curves_to_fill(&mut self) -> &mut CurvesPrim {
        let nurbs = self.kind == PrimKind::Nurbs;
        self.curves.get_or_insert_with(|| Box::new(CurvesPrim { nurbs, ..CurvesPrim::default() }))
    }
}

/// A layer.
#[derive(Debug)]
pub(in crate::files) struct Layer {
    /// The format's default is 0.01.
    pub metres_per_unit: f64,
    /// The format's default is y.
    pub up: UpAxis,
    /// The format's default is 24.
    pub time_codes_per_second: f64,
    pub prims: Vec<Prim>,
    wanted: Wanted,
}

impl Layer {
    /// The prims in use that have curves.
    pub fn curves(&self) -> impl Iterator<Item = (usize, &CurvesPrim)> {
        self.in_use(|prim| prim.curves.as_deref())
    }

    /// The prims in use that have meshes.
    pub fn meshes(&self) -> impl Iterator<Item = (usize, &MeshPrim)> {
        self.in_use(|prim| prim.mesh.as_deref())
    }

    /// Prims that are alive, visible and not empty: those for rendering or, if there are none, guides and proxies.
    fn in_use<'a, T: 'a>(&'a self, of: impl Fn(&'a Prim) -> Option<&'a T> + 'a) -> impl Iterator<Item = (usize, &'a T)> {
        let visible = move |index: &usize| self.prims[*index].alive && !self.ancestry(*index).any(|prim| prim.invisible);
        let found: Vec<(usize, &T)> =
            (0..self.prims.len()).filter(visible).filter_map(|index| Some((index, of(&self.prims[index])?))).collect();
        let is_aid = |index: usize| self.ancestry(index).find_map(|prim| prim.purpose) == Some(Purpose::Aid);
        let only_aids = found.iter().all(|(index, _)| is_aid(*index));
        found.into_iter().filter(move |(index, _)| only_aids || !is_aid(*index))
    }

    /// A prim's placement in the world at a time, from its own and its ancestors'.
    pub fn world(&self, prim: usize, time: f64, file: &str) -> Result<Matrix4<f64>> {
        let mut world = Matrix4::identity();
        for above in self.ancestry(prim) {
            if let Some(placement) = &above.placement {
                let (local, anew) = placement.matrix(time, file, &|| self.path(prim))?;
                world = local * world;
                if anew {
                    break;
                }
            }
        }
        Ok(world)
    }

    /// A prim and its ancestors, starting with itself.
    pub fn ancestry(&self, prim: usize) -> impl Iterator<Item = &Prim> {
        std::iter::successors(Some(&self.prims[prim]), |prim| prim.parent.map(|parent| &self.prims[parent as usize]))
    }

    /// A prim's path: `/head/hair`.
    pub fn path(&self, prim: usize) -> String {
        let mut names: Vec<&str> = self.ancestry(prim).map(|prim| &*prim.name).collect();
        names.reverse();
        names.iter().fold(String::new(), |path, name| path + "/" + name)
    }

    /// Reads the wanted part of a layer.
    pub fn read(name: &str, bytes: &[u8], wanted: Wanted) -> Result<Self> {
        if !bytes.starts_with(b"#usda 1.") {
            return Err(Error::file(name, "does not begin with \"#usda 1.\": not a USD text file"));
        }
        let mut layer = Layer { metres_per_unit: 0.01, up: UpAxis::Y, time_codes_per_second: 24.0, prims: Vec::new(), wanted };
        let scan = &mut Scan::new(name, bytes);
        let mut frames_per_second = None;
        let mut time_codes_per_second = None;
        if scan.accept(b'(') {
            metadata(scan, |key, scan| match key {
                "metersPerUnit" => above_zero(scan, key).map(|value| layer.metres_per_unit = value),
                "timeCodesPerSecond" => above_zero(scan, key).map(|value| time_codes_per_second = Some(value)),
                "framesPerSecond" => above_zero(scan, key).map(|value| frames_per_second = Some(value)),
                "upAxis" => {
                    layer.up = match scan.string()? {
                        "Y" | "y" => UpAxis::Y,
                        "Z" | "z" => UpAxis::Z,
                        other => return Err(scan.error(format_args!("upAxis is {other:?}; expected \"Y\" or \"Z\""))),
                    };
                    Ok(())
                }
                _ => scan.skip_value(),
            })?;
        }
        layer.time_codes_per_second = time_codes_per_second.or(frames_per_second).unwrap_or(24.0);
        layer.read_prims(scan)?;
        Ok(layer)
    }

    fn read_prims(&mut self, scan: &mut Scan<'_>) -> Result<()> {
        let mut open: Vec<(u32, usize)> = Vec::new();
        loop {
            match scan.peek() {
                None => match open.last() {
                    None => return Ok(()),
                    Some((prim, place)) => {
                        let (path, line) = (self.path(*prim as usize), scan.line_at(*place));
                        return Err(scan.error(format_args!("the file ends inside {path}, which begins at line {line}")));
                    }
                },
                Some(b'}') if !open.is_empty() => {
                    scan.accept(b'}');
                    open.pop();
                    continue;
                }
                Some(_) => {}
            }
            let word = scan.word()?;
            match word {
                "def" | "over" | "class" => {
                    let place = scan.place();
                    let prim = self.begin_prim(scan, word == "def", open.last().map(|(parent, _)| *parent))?;
                    open.push((prim, place));
                }
                "reorder" => {
                    scan.word()?;
                    scan.expect(b'=', "in reorder")?;
                    scan.skip_value()?;
                }
                "variantSet" => return Err(arc(scan, "variantSet")),
                "custom" | "uniform" | "varying" | "config" | "prepend" | "append" | "add" | "delete" => {}
                "" => return Err(scan.unexpected("def, an attribute, or the end of a prim")),
                _ => match open.last() {
                    Some((prim, _)) => {
                        scan.brackets();
                        let primvars = self.wanted == Wanted::CurvesAndPrimvars && Primvar::is_numeric(word);
                        property(scan, &mut self.prims[*prim as usize], primvars)?;
                    }
                    None => return Err(scan.error(format_args!("{word:?} outside of prims; expected def, over or class"))),
                },
            }
        }
    }

    /// Whether a skeleton moves what is in a prim.
    fn is_skinned(&self, prim: Option<u32>) -> bool {
        prim.is_some_and(|prim| self.ancestry(prim as usize).any(|prim| prim.skinned))
    }

    /// `[Type] "name" [( metadata )] {`.
    fn begin_prim(&mut self, scan: &mut Scan<'_>, defined: bool, parent: Option<u32>) -> Result<u32> {
        let kind_name = if scan.peek() == Some(b'"') { "" } else { scan.word()? };
        let name = scan.string()?;
        let mut active = true;
        if scan.accept(b'(') {
            metadata(scan, |key, scan| match key {
                "active" => {
                    active = !matches!(scan.word()?, "false" | "0");
                    Ok(())
                }
                _ => scan.skip_value(),
            })?;
        }
        scan.expect(b'{', format_args!("to begin {name:?}"))?;
        let above = parent.is_none_or(|parent| self.prims[parent as usize].alive);
        let kind = match (kind_name, self.wanted) {
            ("BasisCurves", Wanted::Curves | Wanted::CurvesAndPrimvars) => PrimKind::Basis,
            ("NurbsCurves", Wanted::Curves | Wanted::CurvesAndPrimvars) => PrimKind::Nurbs,
            ("Mesh", Wanted::Meshes) => PrimKind::Mesh,
            _ => PrimKind::None,
        };
        let alive = above && defined && active;
        if alive && kind_name == "PointInstancer" {
            return Err(scan.error(format_args!(
                "{name:?} is a PointInstancer, whose instances are not read; make them prims of their own first"
            )));
        }
        if alive && kind != PrimKind::None && self.is_skinned(parent) {
            return Err(skeleton(scan));
        }
        let index = u32::try_from(self.prims.len()).map_err(|_| scan.error("more than 4294967295 prims"))?;
        if self.prims.len() == self.prims.capacity() {
            let bytes = 2 * self.prims.len() * size_of::<Prim>();
            self.prims.try_reserve(1).map_err(|_| Error::OutOfMemory { bytes })?;
        }
        self.prims.push(Prim {
            name: name.into(),
            parent,
            alive,
            kind,
            invisible: false,
            purpose: None,
            skinned: false,
            curves: None,
            mesh: None,
            placement: None,
        });
        Ok(index)
    }
}

/// The error that a skeleton moves what is wanted.
fn skeleton(scan: &Scan<'_>) -> Error {
    scan.error("a skeleton moves these points, which is not read; bake them first (one time sample a frame, no skel: properties)")
}

/// The error that a layer needs more than itself.
fn arc(scan: &Scan<'_>, what: &str) -> Error {
    scan.error(format_args!(
        "{what}: other files or variants would add to this one, which is read by itself; make plain curves of it first (python -m superhelix.usd convert), or read it with superhelix.usd in Python (pip install \"superhelix[usd]\")"
    ))
}

fn above_zero(scan: &mut Scan<'_>, what: &str) -> Result<f64> {
    let value = scan.double(what)?;
    if value > 0.0 { Ok(value) } else { Err(scan.error(format_args!("{what} is {value}; expected a number above zero"))) }
}

/// The entries `key = value` to the closing bracket; `entry` takes the value, or skips it.
fn metadata<'a>(scan: &mut Scan<'a>, mut entry: impl FnMut(&'a str, &mut Scan<'a>) -> Result<()>) -> Result<()> {
    while !scan.accept(b')') {
        match scan.peek() {
            // Documentation.
            Some(b'"' | b'\'') => {
                scan.string()?;
            }
            // What follows a value: the path and the offset of a reference.
            Some(b'<' | b'(' | b',') => {
                if !scan.accept(b',') {
                    scan.skip_value()?;
                }
            }
            _ => {
                let key = scan.word()?;
                if matches!(key, "prepend" | "append" | "add" | "delete" | "reorder") && scan.peek() != Some(b'=') {
                    continue;
                }
                if key.is_empty() {
                    return Err(scan.unexpected("metadata: name = value"));
                }
                scan.expect(b'=', format_args!("after {key}"))?;
                if ARCS.contains(&key) && !scan.accept_none() {
                    return Err(arc(scan, key));
                }
                entry(key, scan)?;
            }
        }
    }
    Ok(())
}

/// An attribute or a relationship whose type has been read. `primvars`: whether it is taken if it is some primvar of curves.
fn property(scan: &mut Scan<'_>, prim: &mut Prim, primvars: bool) -> Result<()> {
    let full = scan.word()?;
    if full.is_empty() {
        return Err(scan.unexpected("the name of an attribute"));
    }
    let (name, over_time) = match full.strip_suffix(".timeSamples") {
        Some(name) => (name, true),
        None => (full, false),
    };
    if scan.accept(b'=') {
        let taken = if name == "visibility" {
            if over_time {
                return Err(scan.error("visibility over time is not read; leave out what is not always to be seen"));
            }
            prim.invisible = !scan.accept_none() && scan.string()? == "invisible";
            true
        } else if name == "purpose" && !over_time {
            let is_aid = !scan.accept_none() && matches!(scan.string()?, "guide" | "proxy");
            prim.purpose = Some(if is_aid { Purpose::Aid } else { Purpose::Seen });
            true
        } else if name == "primvars:skel:jointIndices" {
            if prim.alive && prim.kind != PrimKind::None {
                return Err(skeleton(scan));
            }
            prim.skinned = true;
            false
        } else if name.starts_with("xformOp") {
            prim.placement.get_or_insert_default().take(scan, name, over_time)?;
            true
        } else if prim.kind == PrimKind::Mesh {
            MeshPrim::wants(name) && prim.mesh.get_or_insert_default().take(scan, name, over_time)?
        } else if prim.kind != PrimKind::None && WANTED.contains(&name) {
            take(scan, prim.curves_to_fill(), name, over_time)?
        } else if let (true, Some(primvar)) = (primvars && prim.kind != PrimKind::None, name.strip_prefix("primvars:")) {
            Primvar::take(scan, &mut prim.curves_to_fill().primvars, primvar, over_time)?
        } else {
            false
        };
        if !taken {
            scan.skip_value()?;
        }
    }
    if scan.accept(b'(') {
        let interpolation = match (&mut prim.curves, &mut prim.mesh) {
            (_, Some(mesh)) => (name == "primvars:st").then_some(&mut mesh.uvs.interpolation),
            (Some(curves), None) => match name {
                "widths" => Some(&mut curves.widths.interpolation),
                "primvars:displayColor" => Some(&mut curves.colors.interpolation),
                "primvars:displayOpacity" => Some(&mut curves.opacities.interpolation),
                "primvars:st" => Some(&mut curves.uvs.interpolation),
                _ => Primvar::interpolation_of(&mut curves.primvars, name),
            },
            (None, None) => None,
        };
        let mut found = None;
        metadata(scan, |key, scan| match key {
            "interpolation" => {
                found = match scan.string()? {
                    "constant" => Some(Interpolation::Constant),
                    "uniform" => Some(Interpolation::Uniform),
                    "varying" => Some(Interpolation::Varying),
                    "vertex" => Some(Interpolation::Vertex),
                    "faceVarying" => Some(Interpolation::FaceVarying),
                    other => {
                        let expected = "constant, uniform, varying, vertex or faceVarying";
                        return Err(scan.error(format_args!("interpolation is {other:?}; expected {expected}")));
                    }
                };
                Ok(())
            }
            _ => scan.skip_value(),
        })?;
        if let Some(interpolation) = interpolation {
            *interpolation = found.or(*interpolation);
        }
    }
    Ok(())
}

/// Reads an attribute of curves; returns whether it is a wanted one.
fn take(scan: &mut Scan<'_>, curves: &mut CurvesPrim, name: &str, over_time: bool) -> Result<bool> {
    fn counts(scan: &mut Scan<'_>, attribute: &mut Attribute<Vec<u32>>, what: &'static str, over_time: bool) -> Result<()> {
        attribute.read(scan, over_time, |scan| list(scan, what, |scan| scan.count(what)))
    }
    fn vectors<const N: usize>(
        scan: &mut Scan<'_>,
        attribute: &mut Attribute<Vec<[f32; N]>>,
        what: &'static str,
        over_time: bool,
    ) -> Result<()> {
        attribute.read(scan, over_time, |scan| list(scan, what, |scan| tuple(scan, what)))
    }
    fn singles(scan: &mut Scan<'_>, attribute: &mut Attribute<Vec<f32>>, what: &'static str, over_time: bool) -> Result<()> {
        attribute.read(scan, over_time, |scan| list(scan, what, |scan| scan.single(what)))
    }
    fn doubles(scan: &mut Scan<'_>, attribute: &mut Attribute<Vec<f64>>, what: &'static str, over_time: bool) -> Result<()> {
        attribute.read(scan, over_time, |scan| list(scan, what, |scan| scan.double(what)))
    }
    match name {
        "type" if !over_time => curves.kind = Some(scan.string()?.into()),
        "basis" if !over_time => curves.basis = Some(scan.string()?.into()),
        "wrap" if !over_time => curves.wrap = Some(scan.string()?.into()),
        "curveVertexCounts" => counts(scan, &mut curves.counts, "a curve's number of points", over_time)?,
        "points" => vectors(scan, &mut curves.points, "a point", over_time)?,
        "velocities" => vectors(scan, &mut curves.velocities, "a velocity", over_time)?,
        "widths" => singles(scan, &mut curves.widths, "a width", over_time)?,
        "primvars:displayColor" => vectors(scan, &mut curves.colors, "a colour", over_time)?,
        "primvars:displayColor:indices" => counts(scan, &mut curves.color_indices, "a colour's index", over_time)?,
        "primvars:displayOpacity" => singles(scan, &mut curves.opacities, "an opacity", over_time)?,
        "primvars:displayOpacity:indices" => counts(scan, &mut curves.opacity_indices, "an opacity's index", over_time)?,
        "primvars:st" => vectors(scan, &mut curves.uvs, "a texture coordinate", over_time)?,
        "primvars:st:indices" => counts(scan, &mut curves.uv_indices, "a texture coordinate's index", over_time)?,
        "primvars:superhelix:strandThickness" => singles(scan, &mut curves.strand_thickness, "a thickness", over_time)?,
        "primvars:superhelix:held" => counts(scan, &mut curves.held, "held", over_time)?,
        "order" if curves.nurbs => counts(scan, &mut curves.orders, "an order", over_time)?,
        "knots" if curves.nurbs => doubles(scan, &mut curves.knots, "a knot", over_time)?,
        "pointWeights" if curves.nurbs => doubles(scan, &mut curves.weights, "a weight", over_time)?,
        _ => return Ok(false),
    }
    Ok(true)
}
