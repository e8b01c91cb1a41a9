//! A scalp that deforms, and the roots that stand on it.

use std::path::{Path, PathBuf};

use nalgebra::Vector3;
use superhelix::Frame;
use superhelix::hair::Follicle;
use superhelix::io::{MeshCache, UpAxis, obj_mesh};

use crate::shell::failure::Failure;
use crate::shell::frame_files::list_frames;
use crate::surfaces::region::{Mesh, Placement};

/// Which scalp, and for which frames of guides.
#[derive(Debug)]
pub struct ScalpRequest<'a> {
    /// A mesh, a directory of one a frame, or a `.usda` file.
    pub path: &'a Path,
    /// Metres a unit, where somebody says it.
    pub scale: Option<f64>,
    /// Metres a unit of a file that does not say it either.
    pub otherwise: f64,
    /// Where the file's origin and axes are, if not the world's.
    pub pose: Option<Frame>,
    /// The axis that must point up in files that say which does.
    pub up: Option<UpAxis>,
    /// When the guides' frames are, s, where that is known.
    pub times: &'a [Option<f64>],
}

/// A scalp: a mesh, or one a frame.
#[derive(Debug)]
pub struct ScalpFiles {
    /// The mesh at rest: at the first frame.
    pub rest: Mesh,
    placed: Placement,
    over_time: OverTime,
}

/// The meshes of the frames after the first.
#[derive(Debug)]
enum OverTime {
    Still,
    /// A file a frame, the first included.
    Files(Vec<PathBuf>),
    /// One file, and the time of each frame, s.
    Cache(PathBuf, Box<MeshCache>, Vec<f64>),
}

/// How far beyond the samples of a file a frame may be by rounding, s.
const ROUNDING: f64 = 1e-6;

impl ScalpFiles {
    /// Reads the mesh at rest, and finds out whether there are as many as there are frames.
    pub fn read(request: &ScalpRequest) -> Result<Self, Failure> {
        let path = request.path;
        if !path.is_dir() && path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("usda")) {
            return Self::read_cache(request);
        }
        let placed = Placement { scale: request.scale.unwrap_or(request.otherwise), pose: request.pose };
        let files = list_frames(&[path.to_owned()])?;
        check_count(path, files.len(), "meshes", request.times.len())?;
        let rest = Mesh::read(&files[0], placed)?;
        let over_time = if files.len() > 1 { OverTime::Files(files) } else { OverTime::Still };
        Ok(Self { rest, placed, over_time })
    }

    fn read_cache(request: &ScalpRequest) -> Result<Self, Failure> {
        let path = request.path;
        let cache = MeshCache::read(path)?;
        if let Some(up) = request.up.filter(|up| *up != cache.up()) {
            let name = |up| if up == UpAxis::Y { "y" } else { "z" };
            let (here, there) = (name(cache.up()), name(up));
            return Err(Failure::file(path, format!("has {here} up, and the guides have {there}")));
        }
        let placed = Placement { scale: request.scale.unwrap_or(cache.metres_per_unit()), pose: request.pose };
        let mesh = |time: f64| -> Result<Mesh, Failure> {
            let first = cache.first();
            let mesh = obj_mesh::ObjMesh { vertices: cache.vertices(time)?, triangles: first.triangles.clone() };
            Mesh::new(path, mesh, cache.texture().cloned(), placed)
        };
        let samples = cache.times();
        let [begin, end] = [samples[0], samples[samples.len() - 1]];
        if samples.len() == 1 {
            return Ok(Self { rest: mesh(begin)?, placed, over_time: OverTime::Still });
        }
        let known: Option<Vec<f64>> = request.times.iter().copied().collect();
        let times = match known {
            Some(times) => times,
            // Frames without times are taken one by one.
            None => {
                check_count(path, samples.len(), "samples", request.times.len())?;
                samples.to_vec()
            }
        };
        if let Some(time) = times.iter().find(|time| !(begin - ROUNDING..=end + ROUNDING).contains(*time)) {
            let reason = format!("has samples from {begin} to {end} s, and the guides have a frame at {time} s");
            return Err(Failure::file(path, reason));
        }
        let rest = mesh(times[0])?;
        Ok(Self { rest, placed, over_time: OverTime::Cache(path.to_owned(), Box::new(cache), times) })
    }

    /// The follicles on the scalp as it deforms; none if it stands still.
    pub fn moving(self, follicles: Vec<Follicle>) -> Option<MovingScalp> {
        self.moves().then_some(MovingScalp { scalp: self, follicles })
    }

    /// Whether there is more than one mesh.
    pub fn moves(&self) -> bool {
        !matches!(self.over_time, OverTime::Still)
    }

    /// The vertices at a frame, m.
    pub fn vertices(&self, frame: usize) -> Result<Vec<Vector3<f64>>, Failure> {
        let scalp = &self.rest.scalp;
        let vertices = match &self.over_time {
            // The first was read already.
            _ if frame == 0 => return Ok(scalp.vertices().to_vec()),
            OverTime::Still => return Ok(scalp.vertices().to_vec()),
            OverTime::Files(files) => {
                let read = obj_mesh::read(&files[frame])?;
                if read.triangles != scalp.triangles() {
                    return Err(Failure::file(&files[frame], format!("has other faces than {}", files[0].display())));
                }
                read.vertices
            }
            OverTime::Cache(_, cache, times) => cache.vertices(times[frame])?,
        };
        Ok(vertices.iter().map(|vertex| self.placed.place(vertex)).collect())
    }

    /// The file of a frame after the first; empty where there is none.
    fn path_of(&self, frame: usize) -> &Path {
        match &self.over_time {
            OverTime::Still => Path::new(""),
            OverTime::Files(files) => &files[frame],
            OverTime::Cache(path, ..) => path,
        }
    }
}

fn check_count(path: &Path, there: usize, what: &str, frames: usize) -> Result<(), Failure> {
    if there == 1 || there == frames {
        return Ok(());
    }
    let expected = format!("expected one, or one for each of the guides' {frames} frames");
    Err(Failure::file(path, format!("has {there} {what}; {expected}")))
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
        let scalp = &self.scalp.rest.scalp;
        if frame == 0 {
            return Ok(self.follicles.iter().map(|follicle| scalp.place(follicle)).collect());
        }
        let vertices = self.scalp.vertices(frame)?;
        let frames = scalp.frames(&vertices, &self.follicles);
        let frames = frames.map_err(|error| Failure::file(self.scalp.path_of(frame), error))?;
        Ok(frames.into_iter().map(|frame| frame.origin).collect())
    }
}
