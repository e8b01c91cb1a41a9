//! A mesh over time in one file: the `Mesh` prims of a `.usda` file and the time samples of their points.

use std::path::Path;

use nalgebra::Vector3;

use crate::error::{Error, Result, check_finite};
use crate::files::curves::UpAxis;
use crate::files::obj_mesh::{ObjMesh, Texture};
use crate::files::usda_layer::{Layer, Wanted};
use crate::files::{bytes, usd_mesh, usda};

/// The meshes of a `.usda` file as one triangle mesh in the world, whose vertices may move while its faces stay. Vertices are made when they
/// are asked for; the file's numbers stay in memory.
#[derive(Debug)]
pub struct MeshCache {
    name: String,
    layer: Layer,
    codes: Vec<f64>,
    times: Vec<f64>,
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
        if let Some(what) = usda::other_scene_format(bytes) {
            return Err(Error::file(name, what));
        }
        let layer = Layer::read(name, bytes, Wanted::Meshes)?;
        let mut codes = usd_mesh::times(&layer);
        if codes.is_empty() {
            codes.push(0.0);
        }
        let times: Vec<f64> = codes.iter().map(|code| code / layer.time_codes_per_second).collect();
        if let Some((_, code)) = times.iter().zip(&codes).find(|(time, _)| !time.is_finite()) {
            return Err(Error::file(name, format_args!("time code {code} is no time")));
        }
        let (mesh, texture) = usd_mesh::read(&layer, name, codes[0])?;
        Ok(Self { name: name.to_owned(), layer, codes, times, mesh, texture })
    }

    /// The times at which the file has samples, s, ascending; at least one.
    pub fn times(&self) -> &[f64] {
        &self.times
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
        self.layer.metres_per_unit
    }

    /// The axis that points up; where the file does not say it is y.
    pub fn up(&self) -> UpAxis {
        self.layer.up
    }

    /// The vertices at a time (s), in file units: straight from one sample to the next, held before the first and after the last.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a time that is not finite; [`Error::File`] when there are not as many as at the first time, or one is
    /// not finite in the world.
    pub fn vertices(&self, time: f64) -> Result<Vec<Vector3<f64>>> {
        check_finite(|| "time".to_owned(), time)?;
        let found = self.times.partition_point(|sample| *sample <= time);
        // A sample's own time gives the sample, whatever the division rounded it to.
        let code = match found.checked_sub(1) {
            Some(before) if self.times[before] == time => self.codes[before],
            _ => time * self.layer.time_codes_per_second,
        };
        let vertices = usd_mesh::vertices(&self.layer, &self.name, code)?;
        let (there, wanted) = (vertices.len(), self.mesh.vertices.len());
        if there != wanted {
            let expected = format_args!("expected {wanted}, as at {} s", self.times[0]);
            return Err(Error::file(&self.name, format_args!("has {there} points at {time} s; {expected}")));
        }
        Ok(vertices)
    }
}
