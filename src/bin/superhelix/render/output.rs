//! Where render strands go: one groom, a directory of frames, or a cache in one file.

use std::path::{Path, PathBuf};

use superhelix::io::{CacheFormat, CurveCacheWriter, Curves, CurvesFormat, Existing, SequenceWriter};

use crate::shell::failure::Failure;

/// Frames being written.
#[derive(Debug)]
pub enum RenderOutput {
    /// The one frame of a groom.
    Groom(PathBuf),
    /// A file a frame.
    Frames(SequenceWriter),
    /// One file.
    Cache {
        /// Where it goes.
        path: PathBuf,
        /// What times are counted in, a second.
        per_second: f64,
        /// Begun with the first frame, which says how many points there are.
        writer: Option<Box<CurveCacheWriter>>,
    },
}

/// Where frames go, by the name that was given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OutputKind {
    /// The one frame of a groom.
    Groom,
    /// A file a frame, in a directory.
    Frames,
    /// One file, with so many time codes a second.
    Cache(f64),
}

impl OutputKind {
    /// A `.usda` file holds one frame or many, whose times must be known; any other groom one; and a directory takes frames (`directory`).
    /// What does not go together is said in words that follow the name.
    pub fn of_name(path: &Path, frames: usize, directory: bool, per_second: Option<f64>) -> Result<Self, String> {
        match (CurvesFormat::of_name(path), per_second) {
            (Some(CurvesFormat::Usda), None) if frames > 1 => {
                Err("holds frames at times: give --fps, the frames a second".to_string())
            }
            (Some(CurvesFormat::Usda), Some(per_second)) if frames > 1 => Ok(OutputKind::Cache(per_second)),
            (Some(_), _) if frames > 1 => {
                Err(format!("holds one frame, and there are {frames}: give a directory or a .usda file"))
            }
            (None, _) if directory || frames > 1 => Ok(OutputKind::Frames),
            _ => Ok(OutputKind::Groom),
        }
    }
}

impl RenderOutput {
    /// Begins the files, with `overwrite` in place of those that a directory holds.
    pub fn create(path: &Path, kind: OutputKind, overwrite: bool) -> Result<Self, Failure> {
        Ok(match kind {
            OutputKind::Groom => RenderOutput::Groom(path.to_owned()),
            OutputKind::Frames => {
                let existing = if overwrite { Existing::Replace } else { Existing::Refuse };
                RenderOutput::Frames(SequenceWriter::create(path, "render", CacheFormat::Hair, 1, existing)?)
            }
            OutputKind::Cache(per_second) => RenderOutput::Cache { path: path.to_owned(), per_second, writer: None },
        })
    }

    /// Whether velocities have a place in it.
    pub fn holds_velocities(&self) -> bool {
        match self {
            RenderOutput::Groom(path) => CurvesFormat::of_name(path) == Some(CurvesFormat::Usda),
            RenderOutput::Frames(_) => false,
            RenderOutput::Cache { .. } => true,
        }
    }

    /// Writes a frame.
    pub fn write(&mut self, time: f64, curves: &Curves) -> Result<(), Failure> {
        match self {
            RenderOutput::Groom(path) => curves.write(path)?,
            RenderOutput::Frames(writer) => writer.write(curves).map(|_| ())?,
            RenderOutput::Cache { path, per_second, writer } => {
                let writer = match writer {
                    Some(writer) => writer,
                    empty => empty.insert(Box::new(CurveCacheWriter::create(path, curves, *per_second)?)),
                };
                writer.write(time, curves.points(), curves.extras().velocities.as_deref())?;
            }
        }
        Ok(())
    }

    /// Ends it.
    pub fn finish(self) -> Result<(), Failure> {
        match self {
            RenderOutput::Cache { writer: Some(writer), .. } => Ok(writer.finish()?),
            _ => Ok(()),
        }
    }
}
