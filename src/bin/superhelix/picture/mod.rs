//! `superhelix picture`: contact sheets and animations of simulated frames.
//!
//! Files:
//!
//! - `animation.rs`: Animated PNG: what a browser plays, and what shows its first frame where animation is not known.
//! - `body.rs`: Bodies beside a cache of frames: a mesh that goes with the roots, or one for each frame.
//! - `cell.rs`: One view of one moment, in the manner asked for.
//! - `colour.rs`: Colours of equal weight to the eye, one a root position.
//! - `facing.rs`: Which way a head faces: by its relief, or, where that does not say, to where it has no hair.
//! - `footage.rs`: What a picture is made of: frames of a cache or of a scene's result, with bodies and render hair where they are asked for.
//! - `framing.rs`: What the cells of a picture show: every view at one scale, following the middle of the roots.
//! - `grown.rs`: Render hair for pictures of guides: as `interpolate` makes it, in wisps.
//! - `moment.rs`: One moment of a motion, as it is drawn.
//! - `sheet.rs`: The contact sheet: moments from left to right, the views one above the other, all at one scale.
//! - `view.rs`: Views: which axes run right, up and towards the viewer.
//! - `lines/`: Strands as lines that can be told apart.
//! - `lit/`: Hair as it looks: threads lit by lamps and each other, bodies among them, on a quiet ground.

mod animation;
mod body;
mod cell;
pub mod colour;
pub mod facing;
mod footage;
mod framing;
pub mod grown;
mod lines;
mod lit;
pub mod moment;
pub mod sheet;
pub mod view;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use tiny_skia::Pixmap;

use crate::shell::argument_values::{animation_name, png, positive};
use crate::shell::atomic_file::AtomicFile;
use crate::shell::failure::Failure;
use crate::shell::progress;
use crate::shell::up::Up;
use animation::{Animation, MAX_PER_SECOND};
pub use cell::Manner;
use cell::Pen;
use footage::{Footage, Request};
use framing::Finder;
pub use lit::HairColour;
use sheet::SheetOptions;
use view::{Face, Stand, View};

/// Draws simulated frames: a contact sheet of several moments, or an animation, or both; as hair, lit, or as lines.
///
/// All moments are at one scale, and the cells follow the middle of the roots. Hair is grown among strands that are guides.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct PictureArguments {
    /// A directory of frames (name.0001.obj, name.0002.obj ... or .hair), a .usda file, or the files themselves in order; with --scene the
    /// result of that scene.
    #[arg(value_name = "CACHE", required = true)]
    inputs: Vec<PathBuf>,
    /// Where the contact sheet goes.
    #[arg(long, value_name = "SHEET.png", required_unless_present = "animate", value_parser = png)]
    out: Option<PathBuf>,
    /// Where an animation goes: an animated PNG, which browsers play.
    #[arg(long, value_name = "FILE.png|.apng", value_parser = animation_name)]
    animate: Option<PathBuf>,
    /// The scene whose result is drawn (it must have asked for points): with its colliders, in metres.
    #[arg(long, value_name = "SCENE.json", conflicts_with_all = ["fps", "scale", "body"])]
    scene: Option<PathBuf>,
    /// A body: a mesh in the cache's units and axes as it stands at the first frame, which goes with the roots; or a directory of meshes
    /// (head.0001.obj ...), one for each frame, or a .usda mesh with time samples.
    #[arg(long, value_name = "MESH|DIR")]
    body: Option<PathBuf>,
    /// Metres a unit of the body's files. Default: what a .usda file says, else that of the cache.
    #[arg(long, value_name = "METRES", requires_all = ["body", "scale"], value_parser = positive)]
    body_scale: Option<f64>,
    /// Hairs that are grown among the strands, on the body where there is one; 0: none, the strands are drawn themselves. Default: 20000 where a
    /// cache has 30 to 2999 strands, else 0.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    hairs: Option<u32>,
    /// How strands are drawn. As lines nothing is grown unless --hairs says so.
    #[arg(long = "as", value_enum, value_name = "MANNER", default_value_t = Manner::Hair)]
    manner: Manner,
    /// Colour of the hair.
    #[arg(long, visible_alias = "color", value_enum, value_name = "NAME", default_value_t = HairColour::Brown)]
    colour: HairColour,
    /// From where, with commas between: one above the other on the sheet, side by side in the animation. Default: front,side on the sheet,
    /// three-quarter in the animation.
    #[arg(long, value_enum, value_name = "VIEWS", value_delimiter = ',', num_args = 1)]
    views: Vec<Stand>,
    /// Moments on the sheet, evenly spread over the frames.
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=64))]
    moments: u32,
    /// The axis that points up.
    #[arg(long, value_enum, default_value_t = Up::Y)]
    up: Up,
    /// The axis that the face looks along. Default: where the head is bare if there is a --body and that is clear, else +z where y is up, -y
    /// where z is up.
    #[arg(long, value_enum, value_name = "AXIS", allow_hyphen_values = true)]
    face: Option<Face>,
    /// Frames a second of the cache: labels are then times. Needed for an animation of a directory.
    #[arg(long, value_parser = positive)]
    fps: Option<f64>,
    /// Frames a second of the animation, at most 60.
    #[arg(long, value_name = "FPS", default_value_t = 24.0, value_parser = positive, requires = "animate")]
    rate: f64,
    /// Metres a unit of the files: the scale bar is then in centimetres.
    #[arg(long, value_parser = positive)]
    scale: Option<f64>,
    /// Draw each K-th strand only.
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Width of a cell of the sheet, pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 340, value_parser = clap::value_parser!(u32).range(60..=4000))]
    cell: u32,
    /// Width of a view in the animation, pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 480, value_parser = clap::value_parser!(u32).range(60..=4000), requires = "animate")]
    size: u32,
    /// Stands above the sheet.
    #[arg(long)]
    title: Option<String>,
    /// The sheet's cells alone: neither title nor labels nor scale bar.
    #[arg(long, conflicts_with = "title")]
    plain: bool,
    /// Threads. The picture is the same for any number.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=256))]
    threads: u32,
    /// No progress bar.
    #[arg(long, short)]
    quiet: bool,
}

/// Most frames a second of an animation that browsers keep up with.
const MAX_RATE: f64 = 60.0;
/// Most frames of an animation.
const MAX_FRAMES: f64 = 10_000.0;
/// What rounding may make of half way between two frames, s.
const HALF_WAY: f64 = 1e-9;
/// Height over width of a view in an animation.
const SHAPE: [f32; 2] = [0.75, 1.35];

/// Runs the command.
pub fn run(arguments: &PictureArguments) -> Result<(), Failure> {
    if arguments.rate > MAX_RATE.min(MAX_PER_SECOND) {
        return Err(Failure::Other(format!("--rate is {}; expected at most {MAX_RATE}", arguments.rate)));
    }
    let open = |path| -> Result<(&Path, AtomicFile), Failure> { Ok((path, AtomicFile::create(path)?)) };
    let sheet = arguments.out.as_deref().map(open).transpose()?;
    let animated = arguments.animate.as_deref().map(open).transpose()?;
    let mut footage = Footage::open(&Request {
        inputs: &arguments.inputs,
        scene: arguments.scene.as_deref(),
        every: arguments.every as usize,
        fps: arguments.fps,
        scale: arguments.scale,
        up: arguments.up,
        body: arguments.body.as_deref().map(|path| (path, arguments.body_scale)),
        hairs: arguments.hairs.map(|hairs| hairs as usize).or((arguments.manner == Manner::Lines).then_some(0)),
        threads: arguments.threads as usize,
    })?;
    if footage.has_too_few_guides() && !arguments.quiet {
        eprintln!(
            "hint: no hair is grown among fewer than {} strands, the {} of the cache are drawn themselves; --hairs says how much to grow",
            grown::LEAST_GUIDES,
            footage.strand_count()
        );
    }
    let face = arguments.face.or(footage.face(arguments.up)?);
    let sheet_views = views(arguments, face, &[Stand::Front, Stand::Side])?;
    let animation_views = views(arguments, face, &[Stand::ThreeQuarter])?;
    with_threads(arguments.threads, || {
        if let Some((path, mut file)) = sheet {
            draw_sheet(arguments, &mut footage, sheet_views, path, &mut file)?;
            file.commit()?;
        }
        if let Some((path, mut file)) = animated {
            draw_animation(arguments, &mut footage, &animation_views, path, &mut file)?;
            file.commit()?;
        }
        Ok(())
    })
}

fn views(arguments: &PictureArguments, face: Option<Face>, usual: &[Stand]) -> Result<Vec<View>, Failure> {
    let stands = if arguments.views.is_empty() { usual } else { &arguments.views };
    stands.iter().map(|stand| View::new(*stand, arguments.up, face)).collect()
}

/// Does something with so many threads at hand.
pub fn with_threads<T: Send>(threads: u32, work: impl FnOnce() -> Result<T, Failure> + Send) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads as usize)
        .build()
        .map_err(|error| Failure::Other(format!("{threads} threads cannot be had: {error}")))?;
    pool.install(work)
}

fn draw_sheet(
    arguments: &PictureArguments,
    footage: &mut Footage,
    views: Vec<View>,
    path: &Path,
    file: &mut AtomicFile,
) -> Result<(), Failure> {
    let chosen = spread(footage.count(), arguments.moments as usize);
    let bar = progress::bar(2 * chosen.len() as u64, "moments read and drawn", arguments.quiet);
    let mut moments = Vec::new();
    for index in chosen {
        moments.push(footage.moment(index)?);
        bar.inc(1);
    }
    let title = arguments.title.clone().unwrap_or_else(|| {
        let name = arguments.inputs[0].file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        format!("{name}   {} strands   {} frames", footage.strand_count(), footage.count())
    });
    let options = SheetOptions {
        title: (!arguments.plain).then_some(title),
        views,
        manner: arguments.manner,
        hair: arguments.colour,
        cell_width: arguments.cell,
        metres_per_unit: footage.metres_per_unit,
    };
    write_png(file, path, &sheet::draw(&moments, &options, || bar.inc(1))?)?;
    bar.finish_and_clear();
    Ok(())
}

fn draw_animation(
    arguments: &PictureArguments,
    footage: &mut Footage,
    views: &[View],
    path: &Path,
    file: &mut AtomicFile,
) -> Result<(), Failure> {
    let chosen = at_rate(&footage.times(), arguments.rate)?;
    let bar = progress::bar(2 * chosen.len() as u64, "frames looked at and drawn", arguments.quiet);
    let mut finder = Finder::new(views);
    for index in &chosen {
        finder.add(&footage.outline(*index)?);
        bar.inc(1);
    }
    let framing = finder.framing(arguments.size, SHAPE, 0.0);
    let fail = |error: png::EncodingError| Failure::file(path, format!("cannot be written: {error}"));
    let too_large = || Failure::Other(format!("--size is {}: a picture of that size cannot be made", arguments.size));
    let size = [framing.cell[0] * views.len() as u32, framing.cell[1]];
    let mut animation = Animation::new(file, size, chosen.len() as u32, arguments.rate).map_err(fail)?;
    let mut pen = None;
    for index in chosen {
        let moment = footage.moment(index)?;
        let pen = pen.get_or_insert_with(|| Pen::new(arguments.manner, arguments.colour, &moment, &framing));
        let mut frame = Pixmap::new(size[0], size[1]).ok_or_else(too_large)?;
        for view in 0..views.len() {
            let cell = pen.draw(&moment, &framing, view).ok_or_else(too_large)?;
            put(&cell, &mut frame, view * framing.cell[0] as usize);
        }
        animation.add(&frame).map_err(fail)?;
        bar.inc(1);
    }
    animation.finish().map_err(fail)?;
    bar.finish_and_clear();
    Ok(())
}

/// Copies a picture into a wider one of the same height.
fn put(cell: &Pixmap, frame: &mut Pixmap, left: usize) {
    let (narrow, wide) = (cell.width() as usize, frame.width() as usize);
    for (from, to) in cell.pixels().chunks_exact(narrow).zip(frame.pixels_mut().chunks_exact_mut(wide)) {
        to[left..left + narrow].copy_from_slice(from);
    }
}

/// The frames that are nearest to every moment of an animation of so many a second.
fn at_rate(times: &[Option<f64>], rate: f64) -> Result<Vec<usize>, Failure> {
    let known: Option<Vec<f64>> = times.iter().copied().collect();
    let times = known.ok_or_else(|| Failure::Other("--animate needs --fps, the frames a second of these files".into()))?;
    let (first, last) = (times[0], times[times.len() - 1]);
    let count = ((last - first) * rate + 1e-6).floor() + 1.0;
    if count > MAX_FRAMES {
        return Err(Failure::Other(format!("--rate is {rate}: {count} frames; expected {MAX_FRAMES} at most")));
    }
    let nearest = |k: usize| {
        let time = first + k as f64 / rate;
        let after = times.partition_point(|at| *at < time).min(times.len() - 1);
        let before = after.saturating_sub(1);
        // Half way between two it is the earlier.
        if time - times[before] <= times[after] - time + HALF_WAY { before } else { after }
    };
    Ok((0..count as usize).map(nearest).collect())
}

/// Writes a picture into a file that is being written.
pub fn write_png(out: &mut AtomicFile, path: &Path, picture: &Pixmap) -> Result<(), Failure> {
    let fail = |error: &dyn std::fmt::Display| Failure::file(path, format!("cannot be written: {error}"));
    let png = picture.encode_png().map_err(|error| fail(&error))?;
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
    fn an_animation_takes_the_nearest_frames() {
        let times = |fps: f64, count: usize| -> Vec<Option<f64>> { (0..count).map(|k| Some(k as f64 / fps)).collect() };
        assert_eq!(at_rate(&times(60.0, 7), 20.0).unwrap(), [0, 3, 6]);
        assert_eq!(at_rate(&times(10.0, 3), 20.0).unwrap(), [0, 0, 1, 1, 2]);
        assert_eq!(at_rate(&times(30.0, 1), 24.0).unwrap(), [0]);
        assert!(at_rate(&[None, None], 24.0).is_err());
    }
}
