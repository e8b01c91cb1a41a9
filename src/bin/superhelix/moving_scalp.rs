//! A scalp that deforms, and the roots that stand on it.

use std::path::{Path, PathBuf};

use nalgebra::Vector3;
use superhelix::files::obj_mesh;
use superhelix::groom::scalp::Follicle;

use crate::failure::Failure;
use crate::picture::list_frames;
use crate::region::Mesh;

/// The meshes of a scalp: one, or one a frame.
#[derive(Debug)]
pub struct ScalpFiles(Vec<PathBuf>);

impl ScalpFiles {
    /// A mesh, or the meshes of a directory in the order of their numbers.
    pub fn list(path: &Path) -> Result<Self, Failure> {
        Ok(Self(list_frames(&[path.to_owned()])?))
    }

    /// The mesh at rest: the first.
    pub fn rest(&self, scale: f64) -> Result<Mesh, Failure> {
        Mesh::read(&self.0[0], scale)
    }

    /// The follicles on a scalp that has a mesh for each of `frames` frames; none if it stands still.
    pub fn moving(
        self,
        path: &Path,
        frames: usize,
        mesh: Mesh,
        follicles: Vec<Follicle>,
    ) -> Result<Option<MovingScalp>, Failure> {
        match self.0.len() {
            1 => Ok(None),
            meshes if meshes == frames => Ok(Some(MovingScalp { files: self.0, mesh, follicles })),
            meshes => Err(Failure::file(
                path,
                format!("has {meshes} meshes; expected one, or one for each of the guides' {frames} frames"),
            )),
        }
    }
}

/// Follicles on a mesh that deforms.
pub struct MovingScalp {
    files: Vec<PathBuf>,
    mesh: Mesh,
    follicles: Vec<Follicle>,
}

impl MovingScalp {
    /// Where the follicles are at a frame, m.
    pub fn roots(&self, frame: usize, scale: f64) -> Result<Vec<Vector3<f64>>, Failure> {
        let path = &self.files[frame];
        let read = obj_mesh::read(path)?;
        let scalp = &self.mesh.scalp;
        if read.triangles != scalp.triangles() {
            return Err(Failure::file(path, format!("has other faces than {}", self.files[0].display())));
        }
        let vertices: Vec<_> = read.vertices.iter().map(|vertex| vertex * scale).collect();
        let frames = scalp.frames(&vertices, &self.follicles).map_err(|error| Failure::file(path, error))?;
        Ok(frames.into_iter().map(|frame| frame.origin).collect())
    }
}
