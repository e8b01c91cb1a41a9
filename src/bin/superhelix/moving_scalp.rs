//! A scalp that deforms, and the roots that stand on it.

use std::path::{Path, PathBuf};

use nalgebra::Vector3;
use superhelix::files::obj_mesh;
use superhelix::groom::scalp::Follicle;

use crate::failure::Failure;
use crate::picture::list_frames;
use crate::region::{Mesh, Placement};

/// A scalp: a mesh, or one a frame.
#[derive(Debug)]
pub struct ScalpFiles {
    /// The mesh at rest: the first.
    pub rest: Mesh,
    files: Vec<PathBuf>,
    placed: Placement,
}

impl ScalpFiles {
    /// Reads a mesh, or the first of a directory's in the order of their numbers, which must be as many as there are frames.
    pub fn read(path: &Path, placed: Placement, frames: usize) -> Result<Self, Failure> {
        let files = list_frames(&[path.to_owned()])?;
        let meshes = files.len();
        if meshes != 1 && meshes != frames {
            let expected = format!("expected one, or one for each of the guides' {frames} frames");
            return Err(Failure::file(path, format!("has {meshes} meshes; {expected}")));
        }
        Ok(Self { rest: Mesh::read(&files[0], placed)?, files, placed })
    }

    /// The follicles on the scalp as it deforms; none if it stands still.
    pub fn moving(self, follicles: Vec<Follicle>) -> Option<MovingScalp> {
        (self.files.len() > 1).then_some(MovingScalp { scalp: self, follicles })
    }
}

/// Follicles on a mesh that deforms.
#[derive(Debug)]
pub struct MovingScalp {
    scalp: ScalpFiles,
    follicles: Vec<Follicle>,
}

impl MovingScalp {
    /// Where the follicles are at a frame, m.
    pub fn roots(&self, frame: usize) -> Result<Vec<Vector3<f64>>, Failure> {
        let ScalpFiles { rest, files, placed } = &self.scalp;
        let (path, scalp) = (&files[frame], &rest.scalp);
        // The first was read already.
        let read = if frame == 0 { None } else { Some(obj_mesh::read(path)?) };
        if read.as_ref().is_some_and(|read| read.triangles != scalp.triangles()) {
            return Err(Failure::file(path, format!("has other faces than {}", files[0].display())));
        }
        let moved: Option<Vec<_>> = read.map(|read| read.vertices.iter().map(|vertex| placed.place(vertex)).collect());
        let vertices = moved.as_deref().unwrap_or(scalp.vertices());
        let frames = scalp.frames(vertices, &self.follicles).map_err(|error| Failure::file(path, error))?;
        Ok(frames.into_iter().map(|frame| frame.origin).collect())
    }
}
