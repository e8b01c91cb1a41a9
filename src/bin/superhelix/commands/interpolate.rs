//! `superhelix interpolate`: render strands from the guides of a groom or of a cache.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::json;
use superhelix::internals::groom::curves::drawn::in_metres;
use superhelix::io::{Curves, Extras, UpAxis, obj_mesh};
use superhelix::render::{RenderSettings, Space};
use superhelix::{Shape, Workers};

use crate::groom::unit;
use crate::render::guide_frames::GuideFrames;
use crate::render::output::{OutputKind, RenderOutput};
use crate::render::roots::{Ground, OwnShapes, Places, Region, Scattering};
use crate::render::run::{BoundHair, RenderRun};
use crate::shell::argument_values::{not_negative, positive};
use crate::shell::failure::Failure;
use crate::surfaces::baked_body;
use crate::surfaces::moving_scalp::{ScalpFiles, ScalpRequest};
use crate::surfaces::region::{DensityArguments, in_flags};

/// Makes render strands from few guides: interpolated at the root, gathered in wisps at the tip, as curly as the hair is.
#[derive(Debug, Args)]
pub struct InterpolateArguments {
    /// The guides: a groom (.hair, .tfx, .obj with lines, .usda, .abc, .data, .ply, .npy or .npz), or frames, whose first is the rest pose: a .usda
    /// file with time samples, or a directory (name.0001.hair ...).
    #[arg(value_name = "GUIDES")]
    guides: PathBuf,
    /// Where the strands go: a .hair or .usda file, with the widths of the strands (or .tfx, .obj, without). Of frames: a .usda file, with
    /// velocities for motion blur as well, or a directory of .hair files.
    #[arg(long, short, value_name = "OUT")]
    out: PathBuf,
    /// Frames a second of a directory of frames: a .usda file says its own.
    #[arg(long, value_name = "N", value_parser = positive)]
    fps: Option<f64>,
    /// Metres a unit of the files. Lengths below are in metres. Default: what the guides' file says (.usda), else 1.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    scale: Option<f64>,
    /// How many strands.
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    count: u32,
    /// Use each K-th strand as a guide only.
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Roots are scattered over this mesh (.obj with faces in the guides' units, or .usda, which says its own): where --density and
    /// --density-picture say, or without them near the guides' roots. A directory of meshes (head.0001.obj ...), one for each frame of the
    /// guides, or a .usda mesh with time samples is a scalp that deforms and takes the roots along. Without a mesh, among the guides' roots.
    #[arg(long, value_name = "MESH|DIR")]
    scalp: Option<PathBuf>,
    /// With --scalp: as near as this to a guide's root, m. Default: with a density anywhere; without what the guides cover, being as far apart as
    /// they are, so that faces, ears and necks stay bare.
    #[arg(long, value_name = "METRES", value_parser = positive, requires = "scalp")]
    within: Option<f64>,
    /// With --scalp: anywhere on it.
    #[arg(long, requires = "scalp", conflicts_with = "within")]
    whole_scalp: bool,
    /// Strands are kept out of this mesh (.obj with faces, in the guides' units), which goes with the guides' roots. It is baked into a grid of
    /// distances, which is kept beside it. Default: the scalp, where it has an inside and does not deform.
    #[arg(long, value_name = "MESH.obj")]
    body: Option<PathBuf>,
    /// Distance of that grid's nodes, m. Default: a hundredth of the body's longest side, 1 to 5 mm.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    body_cell: Option<f64>,
    /// Strands are not kept out of anything.
    #[arg(long, conflicts_with_all = ["body", "body_cell"])]
    no_body: bool,
    /// How near to the body strands come before they are pushed, m: what would lie deeper is brought between this and the surface.
    #[arg(long, value_name = "METRES", default_value_t = 2e-3, value_parser = positive)]
    clearance: f64,
    #[command(flatten)]
    density: DensityArguments,
    /// Roots are those of another groom's strands (in the guides' units).
    #[arg(long, value_name = "GROOM", conflicts_with_all = ["scalp", "count"])]
    roots: Option<PathBuf>,
    /// With --roots: while the guides are as in their first frame, strands are as that groom's, whatever is mixed; what distinguishes a strand
    /// from its guides then goes with them.
    #[arg(long, requires = "roots")]
    shapes: bool,
    /// Points a strand.
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(2..=4096))]
    points: u32,
    /// What is mixed between guides.
    #[arg(long, value_enum, default_value_t = Mixed::Position)]
    space: Mixed,
    /// Guides a strand.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=4))]
    guides_per_strand: u32,
    /// 0: interpolated all along; 0.5: in wisps at the tip; 1: disjoint locks; "measured": as each guide is.
    #[arg(long, value_name = "U", default_value = "0.5", value_parser = curliness)]
    curliness: Curliness,
    /// Guides whose tips are farther apart than their roots by more than this are not mixed, m. Default: none is too far.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    max_tip_distance: Option<f64>,
    /// The same as a share of the shorter guide's length; 0: none is too far.
    #[arg(long, value_name = "SHARE", default_value_t = 0.6, value_parser = not_negative)]
    max_tip_ratio: f64,
    /// Wisps a guide.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    wisps: u32,
    /// Radius of a wisp at root, middle and tip, as a share of what it is by the roots' places.
    #[arg(long, value_name = "ROOT,MIDDLE,TIP", value_delimiter = ',', num_args = 1, value_parser = not_negative)]
    wisp_profile: Vec<f64>,
    /// By which share wisps' sections are flattened, 0 (as round as their patch of scalp) to 1 (ribbons).
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, value_parser = not_negative)]
    flatness: f64,
    /// How far whole wisps stray at the tip, m.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, value_parser = not_negative)]
    clump_noise: f64,
    /// Waves of that along a strand.
    #[arg(long, value_name = "N", default_value_t = 1.5, value_parser = positive)]
    clump_noise_waves: f64,
    /// Share of the strands that leave their wisps, 0 to 1.
    #[arg(long, value_name = "SHARE", default_value_t = 0.02, value_parser = not_negative)]
    flyaways: f64,
    /// How far those stray at the tip, m.
    #[arg(long, value_name = "METRES", default_value_t = 5e-3, value_parser = not_negative)]
    flyaway_distance: f64,
    /// How far all strands stray at the tip, m.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, value_parser = not_negative)]
    frizz: f64,
    /// Waves of that along a strand.
    #[arg(long, value_name = "N", default_value_t = 3.0, value_parser = positive)]
    frizz_waves: f64,
    /// By which share strands are cut short at most, each by a random one of its own; 0 to less than 1.
    #[arg(long, value_name = "SHARE", default_value_t = 0.25, value_parser = not_negative)]
    length_variation: f64,
    /// Mixing, wisps and bodies may shorten strands; without this they are as long as their guides before they are cut short.
    #[arg(long)]
    free_length: bool,
    /// Radius at the root, m.
    #[arg(long, value_name = "METRES", default_value_t = 40e-6, value_parser = not_negative)]
    radius: f64,
    /// Radius at the tip, m.
    #[arg(long, value_name = "METRES", default_value_t = 15e-6, value_parser = not_negative)]
    tip_radius: f64,
    /// From where on, as a share of the length, the radius goes to that of the tip; 0 to less than 1.
    #[arg(long, value_name = "SHARE", default_value_t = 0.5, value_parser = not_negative)]
    taper_from: f64,
    /// How it goes there, above -1 to below 1: 0 linearly; above, strands end bluntly; below, they are thin early.
    #[arg(long, value_name = "SHAPE", default_value_t = 0.0, allow_hyphen_values = true)]
    taper_shape: f64,
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
            taper_from: self.taper_from,
            radius_variation: self.radius_variation,
            length_variation: self.length_variation,
            preserve_length: !self.free_length,
            flatness: self.flatness,
            clump_noise: self.clump_noise,
            clump_noise_waves: self.clump_noise_waves,
            flyaways: self.flyaways,
            flyaway_distance: self.flyaway_distance,
            taper_shape: self.taper_shape,
            clearance: self.clearance,
            seed: self.seed,
            workers: if self.threads == 1 { Workers::Serial } else { Workers::Pool(self.threads as usize) },
            ..RenderSettings::default()
        };
        settings.check("").map_err(in_flags)?;
        Ok(settings)
    }

    /// What the strands grow on, of guides with such frames, metres a unit and perhaps an axis that points up.
    fn ground(&self, frames: &GuideFrames, scale: f64, up: Option<UpAxis>) -> Result<Ground, Failure> {
        if let Some(path) = &self.roots {
            let own = if self.shapes { OwnShapes::Kept } else { OwnShapes::Mixed };
            let curves = Curves::read(path)?;
            return Ok(Ground::Given(curves.strands().map(|strand| in_metres(strand, scale)).collect(), own));
        }
        let count = self.count as usize;
        let Some(path) = &self.scalp else {
            if self.density.is_given() {
                return Err(Failure::Other("--density and --density-picture are of a mesh: give --scalp".into()));
            }
            return Ok(Ground::Among(count));
        };
        let times: Vec<Option<f64>> = (0..frames.count()).map(|index| frames.time(index)).collect();
        let request = ScalpRequest { path, scale: self.scale, otherwise: scale, pose: None, up, times: &times };
        let scalp = ScalpFiles::read(&request)?;
        let maps = self.density.read(&scalp.rest)?;
        let region = match self.within {
            Some(within) => Region::Within(within),
            None if self.whole_scalp => Region::Whole,
            None => Region::Suitable,
        };
        Ok(Ground::Scalp(Box::new(Scattering { scalp, count, maps, region })))
    }
}

impl InterpolateArguments {
    /// What the strands are kept out of: in metres, in the world's axes at rest.
    fn head(&self, places: &Places, scale: f64) -> Result<Option<Shape>, Failure> {
        if self.no_body {
            return Ok(None);
        }
        if let Some(path) = &self.body {
            let file = obj_mesh::read(path)?;
            let vertices: Vec<_> = file.vertices.iter().map(|vertex| vertex * scale).collect();
            let baked = baked_body::bake(path, &vertices, &file.triangles, self.body_cell, self.json)?;
            return Ok(Some(Shape::new_grid(baked.grid)));
        }
        let (Some(path), Some((vertices, triangles))) = (&self.scalp, &places.still) else { return Ok(None) };
        match baked_body::bake(path, vertices, triangles, self.body_cell, self.json) {
            Ok(baked) => Ok(Some(Shape::new_grid(baked.grid))),
            Err(error) if self.body_cell.is_some() => Err(error),
            Err(error) => {
                eprintln!("warning: strands are not kept out of the scalp (--no-body says so): {error}");
                Ok(None)
            }
        }
    }
}

/// Runs the command.
pub fn run(arguments: &InterpolateArguments) -> Result<(), Failure> {
    let settings = arguments.settings()?;
    let frames = GuideFrames::open(&arguments.guides, arguments.fps)?;
    let first = frames.curves(0)?;
    let of = Extras { metres_per_unit: unit::stated(arguments.scale, &first), up: first.extras().up, ..Extras::default() };
    let scale = of.metres_per_unit.unwrap_or(1.0);
    let guides =
        |index: usize, curves: &Curves| frames.guides(index, curves, arguments.every as usize, arguments.points as usize, scale);
    let rest = guides(0, &first)?;
    let point_count = rest.points.len();
    let places = arguments.ground(&frames, scale, of.up)?.places(&rest.points, settings.points_per_strand, settings.seed);
    let places = places.map_err(in_flags)?;
    let head = arguments.head(&places, scale)?;
    let kept_out = head.is_some();
    let bound = BoundHair::bind(&settings, places, &rest)?;
    let kind = OutputKind::of_name(&arguments.out, frames.count(), arguments.guides.is_dir(), frames.per_second());
    let kind = kind.map_err(|reason| Failure::file(&arguments.out, reason))?;
    let out = RenderOutput::create(&arguments.out, kind, arguments.overwrite)?;
    let mut run = RenderRun::new(bound, head, scale, of, out);
    run.take(frames.name(0), frames.time(0), rest, Vec::new())?;
    for index in 1..frames.count() {
        let (name, guides) = (frames.name(index), guides(index, &frames.curves(index)?)?);
        if guides.points.len() != point_count {
            let [here, first] = [guides.points.len(), point_count].map(|points| points / settings.points_per_strand);
            return Err(Failure::Other(format!("{name}: has {here} guides where the first frame has {first}")));
        }
        run.take(name, frames.time(index), guides, Vec::new())?;
    }
    let done = run.finish()?;
    let answer = json!({
        "guides": done.guides,
        "strands": done.strands,
        "points_per_strand": settings.points_per_strand,
        "frames": done.frames,
        "velocities": done.with_velocities,
        "kept_out_of_body": kept_out,
        "bind_seconds": done.bind_seconds,
        "evaluate_seconds": done.evaluate_seconds,
    });
    crate::shell::answer::print_answer(arguments.json, &answer, || {
        format!(
            "{}: {} strands of {} points from {} guides, {} frames{}{}",
            arguments.out.display(),
            done.strands,
            settings.points_per_strand,
            done.guides,
            done.frames,
            if done.with_velocities { " with velocities" } else { "" },
            if kept_out { ", kept out of the body" } else { "" }
        )
    })
}
