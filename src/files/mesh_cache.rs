//! A mesh over time in one file: the `Mesh` prims of a `.usda` file and the time samples of their points.

use std::path::Path;

use nalgebra::Vector3;

use super::io::bytes;
use super::usd::usd_mesh;
use super::usd::usda_layer::Wanted;
use super::usd::usda_samples::SampledLayer;
use super::wavefront::obj_mesh::{ObjMesh, Texture};
use crate::error::{Error, Result};
use crate::files::curves::UpAxis;

/// The meshes of a `.usda` file as one triangle mesh in the world, with fixed faces and moving vertices. Vertices are computed on
/// demand; the file's numbers stay in memory.
#[derive(Debug)]
pub struct MeshCache {
    samples: SampledLayer,
    /// At the first time.
    mesh: ObjMesh,
    texture: Option<Texture>,
}

impl MeshCache {
    /// Reads a `.usda` file; any thread may call it. Polygons become triangles by their shape at the first time, wound
    /// anticlockwise as seen from outside whatever the file's orientation. Placements (`xformOp`s) are applied; texture
    /// coordinates are `primvars:st`. A static mesh is at time 0.
    ///
    /// # Errors
    /// [`Error::File`] naming the path and, where there is one, the line or the prim: when the file cannot be read, is not a USD
    /// text file, or has no faces; when faces have holes, change over time, have fewer than 3 or more than
    /// [`MAX_CORNERS`](crate::files::wavefront::obj_mesh::MAX_CORNERS) corners, name a missing point or one point twice, cross themselves or
    /// have no area; when lists do not match; and when other files or variants would add to it. [`Error::OutOfMemory`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        Self::read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?)
    }

    /// [`MeshCache::read`] from memory. `name` replaces the path in errors.
    ///
    /// # Errors
    /// As [`MeshCache::read`].
    pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<Self> {
        let samples = SampledLayer::read(name, bytes, Wanted::Meshes, usd_mesh::times)?;
        let (mesh, texture) = usd_mesh::read(&samples.layer, name, samples.codes[0])?;
        Ok(Self { samples, mesh, texture })
    }

    /// The times of the file's samples, s, ascending; at least one.
    pub fn times(&self) -> &[f64] {
        &self.samples.times
    }

    /// The mesh at the first time, in file units.
    pub fn first(&self) -> &ObjMesh {
        &self.mesh
    }

    /// Texture coordinates, if all meshes of the file have some.
    pub fn texture(&self) -> Option<&Texture> {
        self.texture.as_ref()
    }

    /// Metres per unit of the file; the format's default is 0.01.
    pub fn metres_per_unit(&self) -> f64 {
        self.samples.layer.metres_per_unit
    }

    /// The up axis; the format's default is y.
    pub fn up(&self) -> UpAxis {
        self.samples.layer.up
    }

    /// The vertices at a time (s), in file units: linear between samples, constant before the first and after the last.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a time that is not finite; [`Error::File`] when the number of vertices differs from that at
    /// the first time, or one is not finite in the world.
    pub fn vertices(&self, time: f64) -> Result<Vec<Vector3<f64>>> {
        let SampledLayer { layer, name, times, .. } = &self.samples;
        let vertices = usd_mesh::vertices(layer, name, self.samples.code_at(time)?)?;
        let (there, wanted) = (vertices.len(), self.mesh.vertices.len());
        if there != wanted {
            let expected = format_args!("expected {wanted}, as at {} s", times[0]);
            return Err(Error::file(name, format_args!("has {there} points at {time} s; {expected}")));
        }
        Ok(vertices)
    }
}
