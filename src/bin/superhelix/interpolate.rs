//! `superhelix interpolate`: render strands from the guides of a groom or of a cache.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::Instant;

use clap::{Args, ValueEnum};
use nalgebra::Vector3;
use serde_json::json;
use superhelix::error::Error;
use superhelix::files::curve_cache::CurveCache;
use superhelix::files::curves::{Curves, CurvesFormat, Extras};
use superhelix::files::sequence::{CacheFormat, Existing, SequenceWriter};
use superhelix::groom::guide_roots::GuideRoots;
use superhelix::groom::render_hair::{
    GuideSamples, Motion, RenderHair, RenderPose, RenderSettings, Space, StrandPoints, StrandSink, View, resampled,
};
use superhelix::groom::scalp::Amount;
use superhelix::workers::Workers;

use crate::failure::Failure;
use crate::picture::list_frames;
use crate::region::{DensityArguments, Mesh, groom_roots};
use crate::simulate::{not_negative, positive};
use crate::unit;

/// Makes render strands from few guides: interpolated at the root, gathered in wisps at the tip, as curly as the hair is.
#[derive(Debug, Args)]
pub struct InterpolateArguments {
    /// The guides: a groom (.hair, .tfx, .obj with lines, .usda), or a directory of frames (name.0001.hair ...), whose first is the rest pose.
    #[arg(value_name = "GUIDES")]
    guides: PathBuf,
    /// Where the strands go: a .hair or .usda file, with the widths of the strands (or .tfx, .obj, without); of a directory of frames a
    /// directory of .hair files.
    #[arg(long, short, value_name = "OUT")]
    out: PathBuf,
    /// Metres a unit of the files. Lengths below are in metres. Default: what the guides' file says (.usda), else 1.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    scale: Option<f64>,
    /// How many strands.
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    count: u32,
    /// Use each K-th strand as a guide only.
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Roots are scattered over this mesh (.obj with faces, in the guides' units): where --density and --density-picture say, or without them
    /// near the guides' roots. Without a mesh, among the guides' roots.
    #[arg(long, value_name = "MESH.obj")]
    scalp: Option<PathBuf>,
    /// With --scalp: how near to a guide's root, m. Default: with a density anywhere, without one and a half times the distance within which
    /// nine tenths of the guides have another beside them.
    #[arg(long, value_name = "METRES", value_parser = positive, requires = "scalp")]
    within: Option<f64>,
    #[command(flatten)]
    density: DensityArguments,
    /// Roots are those of another groom's strands (in the guides' units).
    #[arg(long, value_name = "GROOM", conflicts_with_all = ["scalp", "count"])]
    roots: Option<PathBuf>,
    /// Points a strand.
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(2..=4096))]
    points: u32,
    /// What is mixed between guides.
    #[arg(long, value_enum, default_value_t = Mixed::Position)]
    space: Mixed,
    /// Guides a strand.
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=4))]
    guides_per_strand: u32,
    /// 0: interpolated all along; 0.5: in wisps at the tip; 1: disjoint locks; "measured": as each guide is.
    #[arg(long, value_name = "U", default_value = "0", value_parser = curliness)]
    curliness: Curliness,
    /// Guides whose tips are farther apart than their roots by more than this are not mixed, m. Default: none is too far.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    max_tip_distance: Option<f64>,
    /// The same as a share of the shorter guide's length; 0: none is too far.
    #[arg(long, value_name = "SHARE", default_value_t = 0.6, value_parser = not_negative)]
    max_tip_ratio: f64,
    /// Wisps a guide.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    wisps: u32,
    /// Radius of a wisp at root, middle and tip, as a share of what it is by the roots' places.
    #[arg(long, value_name = "ROOT,MIDDLE,TIP", value_delimiter = ',', num_args = 1, value_parser = not_negative)]
    wisp_profile: Vec<f64>,
    /// How far strands stray at the tip, m.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, value_parser = not_negative)]
    frizz: f64,
    /// Waves of that along a strand.
    #[arg(long, value_name = "N", default_value_t = 3.0, value_parser = positive)]
    frizz_waves: f64,
    /// By which share strands are cut short at most, each by a random one of its own; 0 to less than 1.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, value_parser = not_negative)]
    length_variation: f64,
    /// Radius at the root, m.
    #[arg(long, value_name = "METRES", default_value_t = 40e-6, value_parser = not_negative)]
    radius: f64,
    /// Radius at the tip, m.
    #[arg(long, value_name = "METRES", default_value_t = 15e-6, value_parser = not_negative)]
    tip_radius: f64,
    /// By which share radii differ between strands at most.
    #[arg(long, value_name = "SHARE", default_value_t = 0.1, value_parser = not_negative)]
    radius_variation: f64,
    /// Seed.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Threads.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=256))]
    threads: u32,
    /// Overwrite frames that OUT holds.
    #[arg(long)]
    overwrite: bool,
    /// The answer as JSON.
    #[arg(long)]
    json: bool,
}

/// See [`Space`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
enum Mixed {
    /// Positions: for straight and wavy hair.
    Position,
    /// Lengths and curvatures: keeps curls.
    Curvature,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Curliness {
    Measured,
    Given(f64),
}

fn curliness(text: &str) -> Result<Curliness, String> {
    if text == "measured" {
        return Ok(Curliness::Measured);
    }
    match not_negative(text) {
        Ok(value) if value <= 1.0 => Ok(Curliness::Given(value)),
        _ => Err("expected 0 to 1, or \"measured\"".to_string()),
    }
}

impl InterpolateArguments {
    fn settings(&self) -> Result<RenderSettings, Failure> {
        let wisp_profile = match self.wisp_profile[..] {
            [] => RenderSettings::default().wisp_profile,
            [root, middle, tip] => [root, middle, tip],
            _ => return Err(Failure::Other("--wisp-profile: expected three numbers: root,middle,tip".to_string())),
        };
        let settings = RenderSettings {
            points_per_strand: self.points as usize,
            space: match self.space {
                Mixed::Position => Space::Position,
                Mixed::Curvature => Space::Curvature,
            },
            guides_per_strand: self.guides_per_strand as usize,
            curliness: if let Curliness::Given(value) = self.curliness { value } else { 0.0 },
            measure_curliness: self.curliness == Curliness::Measured,
            max_tip_distance: self.max_tip_distance.unwrap_or(f64::INFINITY),
            max_tip_ratio: if self.max_tip_ratio > 0.0 { self.max_tip_ratio } else { f64::INFINITY },
            wisps_per_guide: self.wisps as usize,
            wisp_profile,
            frizz: self.frizz,
            frizz_waves: self.frizz_waves,
            radius: self.radius,
            tip_radius: self.tip_radius,
            radius_variation: self.radius_variation,
            length_variation: self.length_variation,
            seed: self.seed,
            workers: if self.threads == 1 { Workers::Serial } else { Workers::Pool(self.threads as usize) },
            ..RenderSettings::default()
        };
        settings.check("--").map_err(|error| match error {
            Error::InvalidArgument { argument, value, expected } => {
                Failure::Other(format!("{} is {value}; expected {expected}", argument.replace('_', "-")))
            }
            other => Failure::from(other),
        })?;
        Ok(settings)
    }

    /// The guides of a frame, sampled, m.
    fn guides(&self, path: &Path, curves: &Curves, scale: f64) -> Result<Vec<Vector3<f64>>, Failure> {
        let strands: Vec<_> = curves.strands().step_by(self.every as usize).collect();
        let counts: Vec<u32> = strands.iter().map(|strand| strand.len() as u32).collect();
        let all: Vec<_> = strands.iter().flat_map(|strand| unit::in_metres(strand, scale)).collect();
        Ok(resampled(&all, &counts, None, self.points as usize).map_err(|error| Failure::file(path, error))?.points)
    }

    fn places(&self, guides: &[Vector3<f64>], scale: f64) -> Result<Vec<Vector3<f64>>, Failure> {
        if let Some(path) = &self.roots {
            return groom_roots(path, scale);
        }
        let roots = GuideRoots::new(guides.iter().step_by(self.points as usize).copied().collect())?;
        let Some(path) = &self.scalp else {
            if self.density.is_given() {
                return Err(Failure::Other("--density and --density-picture are of a mesh: give --scalp".into()));
            }
            return Ok(roots.among(self.count as usize, self.seed));
        };
        let mesh = Mesh::read(path, scale)?;
        // A map of where hair grows needs no help from the guides.
        let within = self.within.or_else(|| (!self.density.is_given()).then(|| 1.5 * roots.spacing().unwrap_or(LONE)));
        let amount = Amount::Count(self.count as usize);
        let scattered = mesh.scatter(amount, &self.density, within.map(|within| (&roots, within)), self.seed)?;
        Ok(scattered.follicles.iter().map(|follicle| mesh.scalp.place(follicle)).collect())
    }
}

/// How far guides count that have no other beside them, m.
const LONE: f64 = 0.01;

/// Points and widths in file units.
struct Frame {
    per_strand: usize,
    scale: f64,
    room: Mutex<(Vec<[f32; 3]>, Vec<f32>)>,
}

impl StrandSink for Frame {
    fn take(&self, strand: &StrandPoints) {
        let mut room = self.room.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let unit = |value: f32| (f64::from(value) / self.scale) as f32;
        for k in 0..self.per_strand {
            let at = strand.strand * self.per_strand + k;
            room.0[at] = strand.positions.map(|row| unit(row[k]));
            room.1[at] = 2.0 * unit(strand.radius_factor * strand.radii[k]);
        }
    }
}

/// The strands of a pose, as curves with widths, of the unit and axis that `of` has.
fn evaluated(pose: &RenderPose, scale: f64, of: &Extras) -> Result<Curves, Failure> {
    let (count, per_strand) = (pose.hair().strand_count(), pose.hair().settings().points_per_strand);
    let room = Mutex::new((vec![[0.0; 3]; count * per_strand], vec![0.0; count * per_strand]));
    let frame = Frame { per_strand, scale, room };
    let view = View { first: 0, count, origin: Vector3::zeros(), roots: None, rotations: false, motion: Motion::None };
    pose.evaluate(&view, &frame)?;
    let (points, widths) = frame.room.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    let curves = Curves::from_counts(vec![per_strand as u32; count], points)?;
    Ok(curves.with_extras(Extras { thickness: Some(widths), ..of.clone() })?)
}

/// Runs the command.
pub fn run(arguments: &InterpolateArguments) -> Result<(), Failure> {
    let settings = arguments.settings()?;
    let frames = list_frames(std::slice::from_ref(&arguments.guides))?;
    let first = Curves::read(&frames[0])?;
    if first.format() == CurvesFormat::Usda {
        let samples = CurveCache::read(&frames[0])?.times().len();
        if samples > 1 {
            eprintln!(
                "warning: {}: has {samples} frames, of which the first is taken: superhelix convert makes a directory of frames of it",
                frames[0].display()
            );
        }
    }
    let of = Extras { metres_per_unit: unit::stated(arguments.scale, &first), up: first.extras().up, ..Extras::default() };
    let scale = of.metres_per_unit.unwrap_or(1.0);
    let guides = arguments.guides(&frames[0], &first, scale)?;
    let roots = arguments.places(&guides, scale)?;
    let begun = Instant::now();
    let hair = RenderHair::bind(&settings, &GuideSamples::at_rest(&guides), &roots)?;
    let (bound, guide_count) = (begun.elapsed().as_secs_f64(), hair.guide_count());
    let mut pose = RenderPose::new(Arc::new(hair));
    let mut seconds = 0.0;
    let mut frame = |guides: &[Vector3<f64>]| -> Result<Curves, Failure> {
        let begun = Instant::now();
        pose.set(&GuideSamples::at_rest(guides))?;
        let curves = evaluated(&pose, scale, &of)?;
        seconds += begun.elapsed().as_secs_f64();
        Ok(curves)
    };
    if arguments.guides.is_dir() {
        let existing = if arguments.overwrite { Existing::Replace } else { Existing::Refuse };
        let mut writer = SequenceWriter::create(&arguments.out, "render", CacheFormat::Hair, 1, existing)?;
        writer.write(&frame(&guides)?)?;
        for path in &frames[1..] {
            let guides = arguments.guides(path, &Curves::read(path)?, scale)?;
            let made = frame(&guides).map_err(|failure| Failure::file(path, failure))?;
            writer.write(&made)?;
        }
    } else {
        frame(&guides)?.write(&arguments.out)?;
    }
    let answer = json!({
        "guides": guide_count,
        "strands": roots.len(),
        "points_per_strand": settings.points_per_strand,
        "frames": frames.len(),
        "bind_seconds": bound,
        "evaluate_seconds": seconds,
    });
    crate::print_line(&if arguments.json {
        serde_json::to_string_pretty(&answer).map_err(|error| Failure::Other(error.to_string()))?
    } else {
        format!(
            "{}: {} strands of {} points from {guide_count} guides, {} frames",
            arguments.out.display(),
            roots.len(),
            settings.points_per_strand,
            frames.len()
        )
    })
}
