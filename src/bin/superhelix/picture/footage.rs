//! What a picture is made of: frames of a cache or of a scene's result, with bodies and render hair where they are asked for.
//!
//! Files:
//!
//! - `replay.rs`: A scene that was run: strands out of its result, bodies out of the scene.

mod replay;

use std::path::{Path, PathBuf};

use nalgebra::Vector3;
use superhelix::io::{CurveCache, Curves, CurvesFormat, UpAxis};

use super::body::CacheBody;
use super::facing::face_of;
use super::grown::{self, Grown};
use super::moment::Moment;
use super::view::Face;
use crate::shell::failure::Failure;
use crate::shell::frame_files::{frame_number, list_frames};
use crate::shell::up::Up;
use crate::surfaces::moving_scalp::{ScalpFiles, ScalpRequest};
use replay::Replay;

enum Source {
    /// A file a frame.
    Files(Vec<PathBuf>),
    /// All in one.
    Cache(PathBuf, Box<CurveCache>),
    /// A scene's result.
    Replay(Box<Replay>),
}

/// Which frames, and what is drawn beside them.
#[derive(Debug)]
pub struct Request<'a> {
    /// A directory of frames, a `.usda` file, or files in order; with a scene one result.
    pub inputs: &'a [PathBuf],
    /// The scene of the result.
    pub scene: Option<&'a Path>,
    /// Draw each so many-th strand.
    pub every: usize,
    /// Frames a second of files that do not say.
    pub fps: Option<f64>,
    /// Metres a unit, where somebody says it.
    pub scale: Option<f64>,
    /// The axis that points up.
    pub up: Up,
    /// A mesh, or one for each frame, and metres a unit of it, where somebody says it.
    pub body: Option<(&'a Path, Option<f64>)>,
    /// Hairs to grow among the strands; 0: none. Not given, as many as usual where the strands are guides.
    pub hairs: Option<usize>,
    /// Threads.
    pub threads: usize,
}

/// Frames that can be drawn.
pub struct Footage {
    source: Source,
    every: usize,
    fps: Option<f64>,
    strands: usize,
    body: Option<CacheBody>,
    hair: Option<Grown>,
    too_few: bool,
    /// Metres a unit, where that is known.
    pub metres_per_unit: Option<f64>,
}

impl Footage {
    /// Opens it; reads the first frame and the body at rest, and sees where hair grows.
    pub fn open(request: &Request) -> Result<Self, Failure> {
        let mut metres_per_unit = request.scale;
        let source = match (request.scene, request.inputs) {
            (None, [file]) if !file.is_dir() && CurvesFormat::of_name(file) == Some(CurvesFormat::Usda) => {
                let cache = CurveCache::read(file)?;
                metres_per_unit = metres_per_unit.or(cache.frame(0)?.extras().metres_per_unit);
                Source::Cache(file.clone(), Box::new(cache))
            }
            (None, inputs) => Source::Files(list_frames(inputs)?),
            (Some(scene), [result]) => {
                metres_per_unit = Some(1.0);
                Source::Replay(Box::new(Replay::read(result, scene, request.every)?))
            }
            (Some(_), inputs) => {
                return Err(Failure::Other(format!("{} files are given with --scene; expected one result", inputs.len())));
            }
        };
        let (every, fps) = (request.every, request.fps);
        let mut footage = Self { source, every, fps, strands: 0, body: None, hair: None, too_few: false, metres_per_unit };
        let first = footage.guides(0)?;
        footage.strands = first.strands.len();
        footage.find_body(request, &first)?;
        footage.find_hair(request, &first)?;
        Ok(footage)
    }

    fn find_body(&mut self, request: &Request, first: &Moment) -> Result<(), Failure> {
        let times = self.times();
        if let Some(mesh) = self.mesh(request, &times)? {
            self.body = Some(CacheBody::new(mesh, roots(first), self.unit()));
        }
        Ok(())
    }

    fn find_hair(&mut self, request: &Request, first: &Moment) -> Result<(), Failure> {
        let guides = grown::LEAST_GUIDES..grown::MAX_GUIDES;
        let usual = if self.is_replay() || !guides.contains(&first.strands.len()) { 0 } else { grown::USUAL };
        let count = request.hairs.unwrap_or(usual);
        self.too_few = request.hairs.is_none() && !self.is_replay() && first.strands.len() < grown::LEAST_GUIDES;
        if count == 0 {
            return Ok(());
        }
        let times = self.times();
        let scalp = self.mesh(request, &times)?.zip(request.body.map(|(path, _)| path));
        self.hair = Some(Grown::bind(&first.strands, self.unit(), count, scalp, request.threads)?);
        Ok(())
    }

    /// The body's files.
    fn mesh(&self, request: &Request, times: &[Option<f64>]) -> Result<Option<ScalpFiles>, Failure> {
        let Some((path, scale)) = request.body else { return Ok(None) };
        let up = Some(axis(request.up));
        ScalpFiles::read(&ScalpRequest { path, scale, otherwise: self.unit(), pose: None, up, times }).map(Some)
    }

    /// Metres a unit, 1 where nobody says it.
    fn unit(&self) -> f64 {
        self.metres_per_unit.unwrap_or(1.0)
    }

    fn is_replay(&self) -> bool {
        matches!(self.source, Source::Replay(_))
    }

    /// How many frames there are; at least one.
    pub fn count(&self) -> usize {
        match &self.source {
            Source::Files(paths) => paths.len(),
            Source::Cache(_, cache) => cache.times().len(),
            Source::Replay(replay) => replay.times().len(),
        }
    }

    /// Whether no hair is grown since there are too few strands, and nobody said how much there should be.
    pub fn has_too_few_guides(&self) -> bool {
        self.too_few
    }

    /// How many strands the frames have, before hair is grown.
    pub fn strand_count(&self) -> usize {
        self.strands
    }

    /// When the frames are, s, where that is known.
    pub fn times(&self) -> Vec<Option<f64>> {
        let time = |index: usize| match &self.source {
            Source::Files(_) => self.fps.map(|fps| index as f64 / fps),
            Source::Cache(_, cache) => Some(cache.times()[index]),
            Source::Replay(replay) => Some(replay.times()[index]),
        };
        (0..self.count()).map(time).collect()
    }

    /// A frame as it is in its file.
    fn guides(&self, index: usize) -> Result<Moment, Failure> {
        let (curves, label, name) = match &self.source {
            Source::Replay(replay) => return replay.moment(index),
            Source::Files(paths) => {
                let label = match self.fps {
                    Some(fps) => format!("{:.2} s", index as f64 / fps),
                    None => format!("frame {}", frame_number(&paths[index]).unwrap_or(index as u64)),
                };
                (Curves::read(&paths[index])?, label, &paths[index])
            }
            Source::Cache(path, cache) => (cache.frame(index)?, format!("{:.2} s", cache.times()[index]), path),
        };
        let strands: Vec<Vec<[f32; 3]>> = curves.strands().step_by(self.every).map(<[_]>::to_vec).collect();
        if strands.is_empty() {
            return Err(Failure::file(name, "holds no strands"));
        }
        if self.strands > 0 && strands.len() != self.strands {
            let (here, there) = (strands.len(), self.strands);
            return Err(Failure::file(name, format!("has {here} strands at {label}, where the first frame has {there}")));
        }
        Ok(Moment { label, strands, bodies: Vec::new() })
    }

    /// A frame with the bodies and without grown hair: what a picture must have room for.
    pub fn outline(&self, index: usize) -> Result<Moment, Failure> {
        let mut moment = self.guides(index)?;
        if let Some(body) = &self.body {
            moment.bodies.push(body.surface(index, &roots(&moment))?);
        }
        Ok(moment)
    }

    /// Which way the head faces, where its bare skin says so.
    pub fn face(&self, up: Up) -> Result<Option<Face>, Failure> {
        let Some(body) = &self.body else { return Ok(None) };
        let roots = roots(&self.guides(0)?);
        Ok(face_of(&roots, &body.surface(0, &roots)?, up))
    }

    /// A frame as it is drawn.
    pub fn moment(&mut self, index: usize) -> Result<Moment, Failure> {
        let mut moment = self.outline(index)?;
        if let Some(hair) = &mut self.hair {
            moment.strands = hair.strands(index, &moment.strands)?;
        }
        Ok(moment)
    }
}

fn axis(up: Up) -> UpAxis {
    if up == Up::Y { UpAxis::Y } else { UpAxis::Z }
}

fn roots(moment: &Moment) -> Vec<Vector3<f64>> {
    moment.strands.iter().map(|strand| Vector3::from(strand[0].map(f64::from))).collect()
}
