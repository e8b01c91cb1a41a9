//! The meshes of a USD layer as triangles in the world: faces, texture coordinates, and vertices at a time.
//!
//! All meshes of the layer become one, as do all objects of an OBJ file. A subdivision surface counts as the polygons in its
//! file.

use nalgebra::{Matrix4, Vector3};

use super::usda_layer::Layer;
use super::usda_scan::Scan;
use super::usda_values::{Attribute, Interpolation, indexed, list, tuple};
use crate::error::{Error, Result};
use crate::files::wavefront::obj_mesh::{MAX_CORNERS, ObjMesh, Texture};
use crate::files::wavefront::polygon;

/// The mesh of a prim, as in the file.
#[derive(Debug, Default)]
pub(in crate::files) struct MeshPrim {
    /// rightHanded or leftHanded.
    pub orientation: Option<Box<str>>,
    pub counts: Attribute<Vec<u32>>,
    pub indices: Attribute<Vec<u32>>,
    pub holes: Attribute<Vec<u32>>,
    pub points: Attribute<Vec<[f32; 3]>>,
    pub uvs: Attribute<Vec<[f32; 2]>>,
    pub uv_indices: Attribute<Vec<u32>>,
}

impl MeshPrim {
    /// Whether to read an attribute of this name.
    pub fn wants(name: &str) -> bool {
        const WANTED: [&str; 7] = [
            "orientation",
            "faceVertexCounts",
            "faceVertexIndices",
            "holeIndices",
            "points",
            "primvars:st",
            "primvars:st:indices",
        ];
        WANTED.contains(&name)
    }

    /// Reads an attribute; returns whether it is a wanted one.
    pub fn take(&mut self, scan: &mut Scan<'_>, name: &str, over_time: bool) -> Result<bool> {
        let (to, what) = match name {
            "faceVertexCounts" => (&mut self.counts, "a face's number of corners"),
            "faceVertexIndices" => (&mut self.indices, "a corner's vertex"),
            "holeIndices" => (&mut self.holes, "a hole's face"),
            "primvars:st:indices" => (&mut self.uv_indices, "a texture coordinate's index"),
            "orientation" if !over_time => {
                self.orientation = Some(scan.string()?.into());
                return Ok(true);
            }
            "points" => {
                let read = |scan: &mut Scan<'_>| list(scan, "a point", |scan| tuple(scan, "a point"));
                return self.points.read(scan, over_time, read).map(|()| true);
            }
            "primvars:st" => {
                let what = "a texture coordinate";
                let read = |scan: &mut Scan<'_>| list(scan, what, |scan| tuple(scan, what));
                return self.uvs.read(scan, over_time, read).map(|()| true);
            }
            _ => return Ok(false),
        };
        to.read(scan, over_time, |scan| list(scan, what, |scan| scan.count(what))).map(|()| true)
    }
}

/// The times at which any mesh of the layer, or its placement, has samples, in time codes, ascending; empty for static meshes.
pub(in crate::files) fn times(layer: &Layer) -> Vec<f64> {
    let mut times: Vec<f64> = Vec::new();
    for (index, mesh) in layer.meshes() {
        times.extend(mesh.points.times());
        for prim in layer.ancestry(index) {
            times.extend(prim.placement.iter().flat_map(|placement| placement.times()));
        }
    }
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// The meshes with faces at a time, as one, and their texture coordinates if all of them have some.
pub(in crate::files) fn read(layer: &Layer, file: &str, time: f64) -> Result<(ObjMesh, Option<Texture>)> {
    let mut all = ObjMesh { vertices: Vec::new(), triangles: Vec::new() };
    let mut texture = Some(Texture { coordinates: Vec::new(), triangles: Vec::new() });
    for (index, prim) in layer.meshes() {
        One { layer, file, index, prim, time }.add(&mut all, &mut texture)?;
    }
    if all.triangles.is_empty() {
        return Err(Error::file(file, "has no meshes: no Mesh with faces"));
    }
    Ok((all, texture))
}

/// The vertices of the same meshes at a time.
pub(in crate::files) fn vertices(layer: &Layer, file: &str, time: f64) -> Result<Vec<Vector3<f64>>> {
    let mut all = Vec::new();
    for (index, prim) in layer.meshes() {
        let one = One { layer, file, index, prim, time };
        if !one.counts().is_empty() {
            all.append(&mut one.vertices()?.0);
        }
    }
    Ok(all)
}

/// The mesh of a prim at a time.
struct One<'a> {
    layer: &'a Layer,
    file: &'a str,
    index: usize,
    prim: &'a MeshPrim,
    time: f64,
}

impl One<'_> {
    fn error(&self, reason: impl std::fmt::Display) -> Error {
        Error::file(self.file, format_args!("{}: {reason}", self.layer.path(self.index)))
    }

    fn counts(&self) -> &[u32] {
        self.prim.counts.at(self.time).map_or(&[], Vec::as_slice)
    }

    /// In the world, and whether that mirrors the file's mesh.
    fn vertices(&self) -> Result<(Vec<Vector3<f64>>, bool)> {
        let points = self.prim.points.vectors_at(self.time).unwrap_or_default();
        let world = self.layer.world(self.index, self.time, self.file)?;
        let own = points.iter().map(|point| Vector3::from(point.map(f64::from)));
        if world == Matrix4::identity() {
            return Ok((own.collect(), false));
        }
        let placed: Vec<Vector3<f64>> = own
            .map(|point| {
                let placed = world * point.push(1.0);
                placed.xyz() / placed.w
            })
            .collect();
        if !placed.iter().flatten().all(|value| value.is_finite()) {
            return Err(self.error("a point is not finite when it is placed"));
        }
        Ok((placed, world.fixed_view::<3, 3>(0, 0).determinant() < 0.0))
    }

    fn add(&self, all: &mut ObjMesh, texture: &mut Option<Texture>) -> Result<()> {
        let (prim, counts) = (self.prim, self.counts());
        for (name, attribute) in
            [("faceVertexCounts", &prim.counts), ("faceVertexIndices", &prim.indices), ("holeIndices", &prim.holes)]
        {
            if !attribute.stands_still() {
                return Err(self.error(format_args!("{name} changes over time; expected the same faces at all times")));
            }
        }
        if counts.is_empty() {
            return Ok(());
        }
        if prim.holes.at(self.time).is_some_and(|holes| !holes.is_empty()) {
            return Err(self.error("holeIndices: faces that are holes are not read"));
        }
        let left_handed = match prim.orientation.as_deref().unwrap_or("rightHanded") {
            "rightHanded" => false,
            "leftHanded" => true,
            other => {
                let expected = "expected \"rightHanded\" or \"leftHanded\"";
                return Err(self.error(format_args!("orientation is {other:?}; {expected}")));
            }
        };
        let (vertices, mirrored) = self.vertices()?;
        let corners = prim.indices.at(self.time).map_or(&[][..], Vec::as_slice);
        let total: u64 = counts.iter().map(|count| u64::from(*count)).sum();
        if total != corners.len() as u64 {
            let (faces, there) = (counts.len(), corners.len());
            return Err(self.error(format_args!(
                "faceVertexCounts has {faces} faces of {total} corners, and faceVertexIndices has {there}"
            )));
        }
        let spread = self.texture(corners.len(), vertices.len())?;
        if spread.is_none() {
            *texture = None;
        }
        let (first_vertex, first_coordinate) = (all.vertices.len(), texture.as_ref().map_or(0, |list| list.coordinates.len()));
        if first_vertex + vertices.len() > u32::MAX as usize - 1 || first_coordinate + corners.len() > u32::MAX as usize - 1 {
            return Err(self.error(format_args!("more than {} vertices or corners", u32::MAX - 1)));
        }
        let mut begun = 0;
        let (mut sorted, mut cut): (Vec<u32>, Vec<[u32; 3]>) = (Vec::new(), Vec::new());
        for (face, count) in counts.iter().enumerate() {
            let own = &corners[begun..begun + *count as usize];
            let bad = |what: &dyn std::fmt::Display| self.error(format_args!("face {face} {what}"));
            if !(3..=MAX_CORNERS).contains(&own.len()) {
                return Err(bad(&format_args!("has {count} corners; expected 3 to {MAX_CORNERS}")));
            }
            if let Some(vertex) = own.iter().find(|vertex| **vertex as usize >= vertices.len()) {
                return Err(bad(&format_args!("names point {vertex}; points has {}", vertices.len())));
            }
            sorted.clear();
            sorted.extend(own);
            if let Some(twice) = polygon::named_twice(&mut sorted) {
                return Err(bad(&format_args!("names point {twice} twice")));
            }
            cut.clear();
            if !polygon::cut(&vertices, own, &mut cut) {
                return Err(bad(&format_args!("of {count} corners crosses itself or has no area; expected a simple polygon")));
            }
            for triangle in &mut cut {
                if left_handed != mirrored {
                    triangle.swap(1, 2);
                }
                if let (Some(texture), Some((_, by_corner))) = (texture.as_mut(), &spread) {
                    // A face names each of its vertices once: the vertex identifies the corner.
                    let of = |vertex: u32| match by_corner {
                        true => begun + own.iter().position(|corner| *corner == vertex).unwrap_or_default(),
                        false => vertex as usize,
                    };
                    texture.triangles.push(triangle.map(|vertex| (first_coordinate + of(vertex)) as u32));
                }
                all.triangles.push(triangle.map(|vertex| first_vertex as u32 + vertex));
            }
            begun += own.len();
        }
        all.vertices.extend(vertices);
        if let (Some(texture), Some((coordinates, _))) = (texture.as_mut(), spread) {
            texture.coordinates.extend(coordinates);
        }
        Ok(())
    }

    /// The texture coordinates, and whether they are per corner and not per vertex; `None` if there are none.
    fn texture(&self, corners: usize, vertices: usize) -> Result<Option<(Vec<[f64; 2]>, bool)>> {
        let prim = self.prim;
        let values = indexed(prim.uvs.at(self.time), prim.uv_indices.at(self.time))
            .map_err(|index| self.error(format_args!("primvars:st:indices has {index}, which is not an entry")))?;
        let Some(values) = values else { return Ok(None) };
        let by_corner = match prim.uvs.interpolation {
            Some(Interpolation::FaceVarying) => true,
            Some(Interpolation::Vertex | Interpolation::Varying) => false,
            None => values.len() == corners,
            Some(Interpolation::Constant | Interpolation::Uniform) => {
                return Err(self.error("primvars:st is constant or uniform; expected faceVarying, vertex or varying"));
            }
        };
        let (wanted, of) = if by_corner { (corners, "corner") } else { (vertices, "vertex") };
        if values.len() != wanted {
            let there = values.len();
            return Err(self.error(format_args!("primvars:st has {there} entries; expected one per {of}, {wanted}")));
        }
        Ok(Some((values.iter().map(|uv| uv.map(f64::from)).collect(), by_corner)))
    }
}
