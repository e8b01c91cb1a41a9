//! A mesh over time in one file: the `Mesh` prims of a `.usda` file and the time samples of their points.

use std::path::Path;

use nalgebra::Vector3;

use crate::error::{Error, Result};
use crate::files::curves::UpAxis;
use crate::files::obj_mesh::{ObjMesh, Texture};
use crate::files::usda_layer::Wanted;
use crate::files::usda_samples::SampledLayer;
use crate::files::{bytes, usd_mesh};

/// The meshes of a `.usda` file as one triangle mesh in the world, whose vertices may move while its faces stay. Vertices are made when they
/// are asked for; the file's numbers stay in memory.
#[derive(Debug)]
pub struct MeshCache {
    samples: SampledLayer,
    /// At the first time.
    mesh: ObjMesh,
    texture: Option<Texture>,
}

impl MeshCache {
    /// Reads a `.usda` file. May be called from any thread. Polygons are cut into triangles as they are at the first of the times, wound
    /// anticlockwise seen from outside whatever the file's orientation; placements (`xformOp`s) are applied; texture coordinates are
    /// `primvars:st`. A mesh that stands still is there at time 0.
    ///
    /// # Errors
    /// [`Error::File`] naming the path and, where there is one, the line or the prim: when the file cannot be read, is no USD text file, has
    /// no faces, or holes, or faces that change over time, have fewer than 3 or more than
    /// [`MAX_CORNERS`](crate::files::obj_mesh::MAX_CORNERS) corners, name a point that is not there or one twice, cross themselves or have no
    /// area; when lists do not fit together; and when other files or variants would add to it. [`Error::OutOfMemory`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        Self::read_from_bytes(&path.display().to_string(), &bytes::read_file(path)?)
    }

    /// [`MeshCache::read`] from memory. `name` stands for the path in errors.
    ///
    /// # Errors
    /// As [`MeshCache::read`].
    pub fn read_from_bytes(name: &str, bytes: &[u8]) -> Result<Self> {
        let samples = SampledLayer::read(name, bytes, Wanted::Meshes, usd_mesh::times)?;
        let (mesh, texture) = usd_mesh::read(&samples.layer, name, samples.codes[0])?;
        Ok(Self { samples, mesh, texture })
    }

    /// The times at which the file has samples, s, ascending; at least one.
    pub fn times(&self) -> &[f64] {
        &self.samples.times
    }

    /// The mesh at the first of the times, in file units.
    pub fn first(&self) -> &ObjMesh {
        &self.mesh
    }

    /// Texture coordinates, where all meshes of the file have some.
    pub fn texture(&self) -> Option<&Texture> {
        self.texture.as_ref()
    }

    /// Metres a unit of the file; what the format means where the file does not say is 0.01.
    pub fn metres_per_unit(&self) -> f64 {
        self.samples.layer.metres_per_unit
    }

    /// The axis that points up; where the file does not say it is y.
    pub fn up(&self) -> UpAxis {
        self.samples.layer.up
    }

    /// The vertices at a time (s), in file units: straight from one sample to the next, held before the first and after the last.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a time that is not finite; [`Error::File`] when there are not as many as at the first time, or one is
    /// not finite in the world.
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
