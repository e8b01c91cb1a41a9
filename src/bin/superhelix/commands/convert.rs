//! `superhelix convert`: a groom, or a cache of frames, in another format.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use superhelix::io::{
    CacheFormat, CurveCache, CurveCacheWriter, Curves, CurvesFormat, Existing, Extras, SequenceWriter, TfxVersion, UpAxis, tfx,
};

use crate::shell::argument_values::positive;
use crate::shell::failure::Failure;
use crate::shell::frame_files::list_frames;

/// Writes a groom in another format, chosen by the name's end: .hair, .tfx, .obj, .usda. Says what the format has no place for.
///
/// From and to caches: with --fps a directory of frames (name.0001.obj ...) becomes one .usda file with time samples, and a .usda file with
/// time samples becomes a directory of frames.
#[derive(Debug, Args)]
pub struct ConvertArguments {
    /// The groom: .hair, .tfx, .obj, .usda, .abc, .data, .ply, .npy or .npz; or a directory of frames.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// Where it goes; a directory for the frames of a cache.
    #[arg(value_name = "OUT")]
    output: PathBuf,
    /// Version of a .tfx file: 2 (text), 3, 4. Default: that of the input, else 4, or 2 where strands differ in their number of points.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=4))]
    tfx_version: Option<u32>,
    /// Metres a unit of the groom, for a .usda file. Default: what the input says, else 1.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    unit: Option<f64>,
    /// The axis that points up, for a .usda file. Default: what the input says, else y.
    #[arg(long, value_enum, value_name = "AXIS")]
    up: Option<crate::shell::up::Up>,
    /// Multiplies all lengths (the unit, where it is known, becomes so much less).
    #[arg(long, value_name = "FACTOR", value_parser = positive)]
    scale: Option<f64>,
    /// Turns a groom with y up to z up.
    #[arg(long)]
    to_z_up: bool,
    /// Use each K-th strand only.
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Frames a second, for caches.
    #[arg(long, value_name = "N", value_parser = positive)]
    fps: Option<f64>,
    /// Format of the frames of a cache.
    #[arg(long, value_enum, default_value_t = FrameFormat::Hair)]
    frames: FrameFormat,
    /// Fail where the format has no place for something.
    #[arg(long)]
    strict: bool,
}

/// Format of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FrameFormat {
    /// Wavefront OBJ lines.
    Obj,
    /// Cem Yuksel's .hair.
    Hair,
}

/// Runs the command.
pub fn run(arguments: &ConvertArguments) -> Result<(), Failure> {
    let same = |path: &Path| path.canonicalize().ok();
    if let (Some(input), Some(output)) = (same(&arguments.input), same(&arguments.output))
        && input == output
    {
        return Err(Failure::file(&arguments.output, "is what is read: write to another file"));
    }
    match (arguments.input.is_dir(), arguments.fps) {
        (true, None) => Err(Failure::file(&arguments.input, "is a directory of frames: give --fps")),
        (true, Some(fps)) => frames_to_cache(arguments, fps),
        (false, Some(_)) => cache_to_frames(arguments),
        (false, None) => one(arguments),
    }
}

fn one(arguments: &ConvertArguments) -> Result<(), Failure> {
    let curves = changed(arguments, Curves::read(&arguments.input)?)?;
    let path = &arguments.output;
    let version = arguments.tfx_version.map(|version| match version {
        2 => TfxVersion::V2,
        3 => TfxVersion::V3,
        _ => TfxVersion::V4,
    });
    let format = match (CurvesFormat::of_name(path), version.unwrap_or_else(|| TfxVersion::of(&curves))) {
        (None, _) => {
            return Err(Failure::file(path, "is of no known format: expected a name that ends in .hair, .tfx, .obj or .usda"));
        }
        (Some(CurvesFormat::TfxV4), TfxVersion::V2) => CurvesFormat::TfxV2Text,
        (Some(CurvesFormat::TfxV4), TfxVersion::V3) => CurvesFormat::TfxV3,
        (Some(format), _) => format,
    };
    lost(arguments, &curves, format)?;
    match version {
        Some(version) if CurvesFormat::of_name(path) == Some(CurvesFormat::TfxV4) => tfx::write(path, &curves, version)?,
        Some(_) => return Err(Failure::Other("--tfx-version is given and the output is no .tfx file".into())),
        None => curves.write(path)?,
    }
    said(path, &curves, format)
}

fn said(path: &Path, curves: &Curves, format: CurvesFormat) -> Result<(), Failure> {
    let (strands, points) = (curves.strand_count(), curves.point_count());
    crate::shell::answer::print_line(&format!("{}: {}, {strands} strands, {points} points", path.display(), format.name()))
}

/// What the arguments change.
fn changed(arguments: &ConvertArguments, curves: Curves) -> Result<Curves, Failure> {
    let mut curves = if arguments.every > 1 { every(&curves, arguments.every as usize)? } else { curves };
    if arguments.unit.is_some() || arguments.up.is_some() {
        let mut extras = curves.extras().clone();
        extras.metres_per_unit = arguments.unit.or(extras.metres_per_unit);
        extras.up = arguments.up.map(|up| if up == crate::shell::up::Up::Y { UpAxis::Y } else { UpAxis::Z }).or(extras.up);
        curves = curves.with_extras(extras)?;
    }
    if let Some(factor) = arguments.scale {
        curves = curves.scaled(factor)?;
    }
    if arguments.to_z_up {
        if curves.extras().up == Some(UpAxis::Z) {
            return Err(Failure::file(&arguments.input, "has z up already, by what it says: --to-z-up would lay it down"));
        }
        curves = curves.to_z_up();
    }
    Ok(curves)
}

/// Each so many-th strand, with what goes along.
fn every(curves: &Curves, step: usize) -> Result<Curves, Failure> {
    let kept: Vec<usize> = (0..curves.strand_count()).step_by(step).collect();
    let strands: Vec<&[[f32; 3]]> = kept.iter().map(|strand| curves.strand(*strand)).collect();
    let own = curves.extras();
    fn points<T: Copy>(curves: &Curves, kept: &[usize], list: &Option<Vec<T>>) -> Option<Vec<T>> {
        list.as_ref().map(|list| kept.iter().flat_map(|strand| list[curves.strand_range(*strand)].iter().copied()).collect())
    }
    fn strands_of<T: Copy>(kept: &[usize], list: &Option<Vec<T>>) -> Option<Vec<T>> {
        list.as_ref().map(|list| kept.iter().map(|strand| list[*strand]).collect())
    }
    let extras = Extras {
        thickness: points(curves, &kept, &own.thickness),
        transparency: points(curves, &kept, &own.transparency),
        colors: points(curves, &kept, &own.colors),
        velocities: points(curves, &kept, &own.velocities),
        arclengths: points(curves, &kept, &own.arclengths),
        held: points(curves, &kept, &own.held),
        strand_thickness: strands_of(&kept, &own.strand_thickness),
        strand_uvs: strands_of(&kept, &own.strand_uvs),
        hair_header: own.hair_header,
        metres_per_unit: own.metres_per_unit,
        up: own.up,
    };
    Ok(Curves::from_strands(&strands)?.with_extras(extras)?)
}

/// Says what the format has no place for, or fails.
fn lost(arguments: &ConvertArguments, curves: &Curves, format: CurvesFormat) -> Result<(), Failure> {
    let lost = curves.lost_in(format);
    if lost.is_empty() {
        return Ok(());
    }
    let text = format!("{} has no place for {}", format.name(), lost.join(", "));
    if arguments.strict {
        return Err(Failure::file(&arguments.output, text));
    }
    eprintln!("warning: {}: {text}", arguments.output.display());
    Ok(())
}

fn frames_to_cache(arguments: &ConvertArguments, fps: f64) -> Result<(), Failure> {
    if CurvesFormat::of_name(&arguments.output) != Some(CurvesFormat::Usda) {
        return Err(Failure::file(&arguments.output, "is no .usda file: no other format has frames"));
    }
    let paths = list_frames(std::slice::from_ref(&arguments.input))?;
    let mut writer: Option<(CurveCacheWriter, Curves)> = None;
    for (index, path) in paths.iter().enumerate() {
        let curves = changed(arguments, Curves::read(path)?)?;
        let (writer, first) = match &mut writer {
            Some(pair) => pair,
            empty => empty.insert((CurveCacheWriter::create(&arguments.output, &curves, fps)?, curves.clone())),
        };
        if curves.counts() != first.counts() {
            return Err(Failure::file(path, "has other strands, or other numbers of points, than the first frame"));
        }
        writer.write(index as f64 / fps, curves.points(), curves.extras().velocities.as_deref())?;
    }
    let Some((writer, first)) = writer else { return Err(Failure::file(&arguments.input, "holds no frames")) };
    writer.finish()?;
    said(&arguments.output, &first, CurvesFormat::Usda)
}

fn cache_to_frames(arguments: &ConvertArguments) -> Result<(), Failure> {
    let cache = CurveCache::read(&arguments.input)?;
    let format = match arguments.frames {
        FrameFormat::Obj => (CacheFormat::Obj, CurvesFormat::Obj),
        FrameFormat::Hair => (CacheFormat::Hair, CurvesFormat::Hair),
    };
    let mut writer = SequenceWriter::create(&arguments.output, "hair", format.0, 1, Existing::Refuse)?;
    for index in 0..cache.times().len() {
        let curves = changed(arguments, cache.frame(index)?)?;
        if index == 0 {
            lost(arguments, &curves, format.1)?;
        }
        writer.write(&curves)?;
    }
    crate::shell::answer::print_line(&format!("{}: {} frames", arguments.output.display(), writer.frame_count()))
}
