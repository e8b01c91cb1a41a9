//! The cache of `superhelix simulate`: a file a frame, or one file with velocities.

use std::path::Path;

use superhelix::io::{CacheFormat, CurveCacheWriter, Curves, Existing, Extras, SequenceWriter, UpAxis};

use crate::shell::failure::Failure;
use crate::shell::up::Up;
use crate::simulate::arguments::{Format, SimulateArguments};

/// A cache being written.
#[derive(Debug)]
pub enum Cache {
    /// A file a frame.
    Files(SequenceWriter),
    /// One file.
    File(Box<CurveCacheWriter>),
}

impl Cache {
    /// Begins a cache in a directory.
    pub fn create(arguments: &SimulateArguments, directory: &Path, scale: f64, strands: usize) -> Result<Self, Failure> {
        let format = match arguments.format {
            Format::Obj => CacheFormat::Obj,
            Format::Hair => CacheFormat::Hair,
            Format::Usda => return Self::create_file(arguments, directory, scale, strands),
        };
        let existing = if arguments.overwrite { Existing::Replace } else { Existing::Refuse };
        Ok(Cache::Files(SequenceWriter::create(directory, "hair", format, 1, existing)?))
    }

    fn create_file(arguments: &SimulateArguments, directory: &Path, scale: f64, strands: usize) -> Result<Self, Failure> {
        std::fs::create_dir_all(directory).map_err(|error| Failure::file(directory, format!("cannot be made: {error}")))?;
        let path = directory.join("hair.usda");
        if path.exists() && !arguments.overwrite {
            return Err(Failure::file(&path, "is there already"));
        }
        let samples = arguments.samples as usize;
        let radius = arguments.material.groom()?.material.mean_radius();
        let extras = Extras {
            velocities: Some(vec![[0.0; 3]; strands * samples]),
            thickness: Some(vec![(2.0 * radius / scale) as f32; strands * samples]),
            metres_per_unit: Some(scale),
            up: Some(if arguments.up == Up::Y { UpAxis::Y } else { UpAxis::Z }),
            ..Extras::default()
        };
        let still = Curves::from_counts(vec![samples as u32; strands], vec![[0.0; 3]; strands * samples])?.with_extras(extras)?;
        Ok(Cache::File(Box::new(CurveCacheWriter::create(&path, &still, arguments.fps)?)))
    }

    /// Writes a frame.
    pub fn write(&mut self, time: f64, counts: &[u32], points: &[[f32; 3]], velocities: &[[f32; 3]]) -> Result<(), Failure> {
        match self {
            Cache::Files(writer) => writer.write_points(counts, points).map(|_| ())?,
            Cache::File(writer) => writer.write(time, points, Some(velocities))?,
        }
        Ok(())
    }

    /// Ends it; how many frames it has.
    pub fn finish(self) -> Result<u32, Failure> {
        match self {
            Cache::Files(writer) => Ok(writer.frame_count()),
            Cache::File(writer) => {
                let count = writer.frame_count() as u32;
                writer.finish()?;
                Ok(count)
            }
        }
    }
}
