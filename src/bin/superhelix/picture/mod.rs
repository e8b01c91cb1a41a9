//! `superhelix picture`: a contact sheet of simulated frames.

mod bodies;
pub mod colour;
mod lettering;
mod replay;
pub mod sheet;
mod strands;
pub mod view;

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use superhelix::files::curve_cache::CurveCache;
use superhelix::files::curves::{Curves, CurvesFormat};

use crate::atomic_file::AtomicFile;
use crate::failure::Failure;
use crate::progress;
use sheet::{Moment, SheetOptions};
use view::{Face, Up};

/// Draws a contact sheet of simulated frames: several moments, each from the front and from the side, all at one scale.
///
/// Strands are coloured by where their root is. The cells follow the middle of the roots.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct PictureArguments {
    /// A directory of frames (name.0001.obj, name.0002.obj ... or .hair), a .usda file, or the files themselves in order; with --scene the
    /// result of that scene.
    #[arg(value_name = "CACHE", required = true)]
    inputs: Vec<PathBuf>,
    /// Where the picture goes.
    #[arg(long, value_name = "SHEET.png", value_parser = crate::argument_values::png)]
    out: PathBuf,
    /// The scene whose result is drawn (it must have asked for points): with its colliders, in metres.
    #[arg(long, value_name = "SCENE.json", conflicts_with_all = ["fps", "scale"])]
    scene: Option<PathBuf>,
    /// Moments on the sheet, evenly spread over the frames.
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=64))]
    moments: u32,
    /// The axis that points up.
    #[arg(long, value_enum, default_value_t = Up::Y)]
    up: Up,
    /// The axis that the face looks along. Default: +z where y is up, -y where z is up.
    #[arg(long, value_enum, value_name = "AXIS", allow_hyphen_values = true)]
    face: Option<Face>,
    /// Frames a second of the cache: labels are then times.
    #[arg(long, value_parser = crate::argument_values::positive)]
    fps: Option<f64>,
    /// Metres a unit of the files: the scale bar is then in centimetres.
    #[arg(long, value_parser = crate::argument_values::positive)]
    scale: Option<f64>,
    /// Draw each K-th strand only.
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Width of a cell, pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 340, value_parser = clap::value_parser!(u32).range(60..=4000))]
    cell: u32,
    /// Stands above the sheet.
    #[arg(long)]
    title: Option<String>,
    /// No progress bar.
    #[arg(long, short)]
    quiet: bool,
}

/// Runs the command.
pub fn run(arguments: &PictureArguments) -> Result<(), Failure> {
    let mut out = AtomicFile::create(&arguments.out)?;
    let (moments, frame_count) = match (&arguments.scene, &arguments.inputs[..]) {
        (None, [file]) if CurvesFormat::of_name(file) == Some(CurvesFormat::Usda) => moments_of_cache(arguments, file)?,
        (None, inputs) => moments_of_frames(arguments, &list_frames(inputs)?)?,
        (Some(scene), [result]) => {
            let moments = replay::moments(result, scene, arguments.moments as usize, arguments.every as usize)?;
            let count = moments.len();
            (moments, count)
        }
        (Some(_), inputs) => {
            return Err(Failure::Other(format!("{} files are given with --scene; expected one result", inputs.len())));
        }
    };
    let title = arguments.title.clone().unwrap_or_else(|| {
        let name = arguments.inputs[0].file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        format!("{name}   {} strands   {} frames", moments[0].strands.len(), frame_count)
    });
    let options = SheetOptions {
        title,
        up: arguments.up,
        face: arguments.face,
        cell_width: arguments.cell,
        metres_per_unit: arguments.scale.or(arguments.scene.as_ref().map(|_| 1.0)),
    };
    write_png(&mut out, &arguments.out, &moments, &options)?;
    out.commit()
}

/// Some of a cache's frames, and how many it has.
fn moments_of_frames(arguments: &PictureArguments, frames: &[PathBuf]) -> Result<(Vec<Moment>, usize), Failure> {
    let chosen = spread(frames.len(), arguments.moments as usize);
    let bar = progress::bar(chosen.len() as u64, "frames", arguments.quiet);
    let mut moments: Vec<Moment> = Vec::new();
    for index in chosen {
        let path = &frames[index];
        let curves = Curves::read(path)?;
        let strands: Vec<Vec<[f32; 3]>> = curves.strands().step_by(arguments.every as usize).map(<[_]>::to_vec).collect();
        if strands.is_empty() {
            return Err(Failure::file(path, "holds no strands"));
        }
        if let Some(first) = moments.first()
            && first.strands.len() != strands.len()
        {
            let (here, there) = (strands.len(), first.strands.len());
            return Err(Failure::file(path, format!("has {here} strands where the first frame has {there}")));
        }
        let label = match arguments.fps {
            Some(fps) => format!("{:.2} s", index as f64 / fps),
            None => format!("frame {}", frame_number(path).unwrap_or(index as u64)),
        };
        moments.push(Moment { label, strands, bodies: Vec::new() });
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok((moments, frames.len()))
}

/// Some of the time samples of a .usda file, and how many it has.
fn moments_of_cache(arguments: &PictureArguments, path: &Path) -> Result<(Vec<Moment>, usize), Failure> {
    let cache = CurveCache::read(path)?;
    let count = cache.times().len();
    let moments = spread(count, arguments.moments as usize).into_iter().map(|index| {
        let curves = cache.frame(index)?;
        let strands = curves.strands().step_by(arguments.every as usize).map(<[_]>::to_vec).collect();
        Ok(Moment { label: format!("{:.2} s", cache.times()[index]), strands, bodies: Vec::new() })
    });
    let moments = moments.collect::<Result<Vec<Moment>, Failure>>()?;
    if let Some(moment) = moments.iter().find(|moment| moment.strands.len() != moments[0].strands.len()) {
        let (here, there) = (moment.strands.len(), moments[0].strands.len());
        return Err(Failure::file(path, format!("has {here} strands at {}, where the first frame has {there}", moment.label)));
    }
    Ok((moments, count))
}

/// Draws a sheet into a file that is being written.
pub fn write_png(out: &mut AtomicFile, path: &Path, moments: &[Moment], options: &SheetOptions) -> Result<(), Failure> {
    let fail = |error: &dyn std::fmt::Display| Failure::file(path, format!("cannot be written: {error}"));
    let png = sheet::draw(moments, options)?.encode_png().map_err(|error| fail(&error))?;
    out.write_all(&png).map_err(|error| fail(&error))
}

/// Indices of `count` frames out of `length`, evenly spread, the first and the last among them.
pub fn spread(length: usize, count: usize) -> Vec<usize> {
    let count = count.min(length);
    if count < 2 {
        return (0..count).collect();
    }
    (0..count).map(|index| (index * (length - 1) + (count - 1) / 2) / (count - 1)).collect()
}

/// The frames to draw from: those of a directory in the order of their numbers, or the files as given.
pub fn list_frames(inputs: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    match inputs {
        [directory] if directory.is_dir() => list_directory(directory),
        files => {
            if let Some(directory) = files.iter().find(|file| file.is_dir()) {
                return Err(Failure::file(directory, "is a directory: give one directory, or files"));
            }
            Ok(files.to_vec())
        }
    }
}

fn list_directory(directory: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut sequences: BTreeMap<(String, String), Vec<(u64, PathBuf)>> = BTreeMap::new();
    let entries = fs::read_dir(directory).map_err(|error| Failure::file(directory, format!("cannot be read: {error}")))?;
    for entry in entries {
        let path = entry.map_err(|error| Failure::file(directory, format!("cannot be read: {error}")))?.path();
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default();
        if !matches!(extension.as_str(), "obj" | "hair") {
            continue;
        }
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let name = stem.trim_end_matches(|character: char| character.is_ascii_digit()).to_string();
        if let Some(number) = frame_number(&path) {
            sequences.entry((name, extension)).or_default().push((number, path));
        }
    }
    let names: Vec<String> = sequences.keys().map(|(name, extension)| format!("{name}*.{extension}")).collect();
    let mut sequences = sequences.into_values();
    match (sequences.next(), sequences.next()) {
        (Some(mut frames), None) => {
            frames.sort();
            Ok(frames.into_iter().map(|(_, path)| path).collect())
        }
        (None, _) => Err(Failure::file(directory, "holds no numbered .obj or .hair frames")),
        _ => Err(Failure::file(directory, format!("holds several sequences ({}): give the files of one", names.join(", ")))),
    }
}

/// The number at the end of a file's name, before its extension.
fn frame_number(path: &Path) -> Option<u64> {
    let stem = path.file_stem()?.to_str()?;
    stem[stem.trim_end_matches(|character: char| character.is_ascii_digit()).len()..].parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_spread_from_the_first_to_the_last() {
        assert_eq!(spread(100, 4), [0, 33, 66, 99]);
        assert_eq!(spread(3, 6), [0, 1, 2]);
        assert_eq!(spread(9, 1), [0]);
        assert_eq!(spread(2, 2), [0, 1]);
    }

    #[test]
    fn frame_numbers_are_read_from_the_end_of_the_name() {
        assert_eq!(frame_number(Path::new("a2/hair.0012.obj")), Some(12));
        assert_eq!(frame_number(Path::new("hair_7.hair")), Some(7));
        assert_eq!(frame_number(Path::new("hair.obj")), None);
    }
}
