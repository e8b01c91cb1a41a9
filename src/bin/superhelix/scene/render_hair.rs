//! `render_hair`: strands to be drawn, which follow those of the scene and are written as it runs.

use std::path::{Path, PathBuf};

use superhelix::Error;
use superhelix::hair::MAX_FOLLICLES;
use superhelix::io::{Curves, time_as_read};
use superhelix::render::{MAX_GUIDES, MAX_POINTS, MAX_WISPS, RenderSettings, Space};

use crate::groom::unit;
use crate::render::output::OutputKind;
use crate::render::roots::{Ground, OwnShapes, Region, Scattering};
use crate::scene::Scene;
use crate::scene::colliders::{file_complaint, path_of};
use crate::scene::outputs::timeline;
use crate::scene::pose::read_pose;
use crate::shell::failure::Failure;
use crate::shell::json::{Complaint, Entries, Node};
use crate::surfaces::moving_scalp::{ScalpFiles, ScalpRequest};
use crate::surfaces::region::{Placement, read_picture, read_vertex_densities};

/// Render hair that a scene asks for.
#[derive(Debug)]
pub struct SceneRenderHair {
    /// How it is made.
    pub settings: RenderSettings,
    /// Each so many-th strand is a guide.
    pub every: usize,
    /// What it grows on.
    pub ground: Ground,
    /// Where it goes.
    pub out: PathBuf,
    /// As what.
    pub kind: OutputKind,
    /// In place of frames that are there already.
    pub overwrite: bool,
    /// Whether it is kept out of the scene's colliders.
    pub bodies: bool,
    /// What complaints are about that come while roots are placed.
    pub keys: Keys,
}

/// Full paths of keys.
#[derive(Debug)]
pub struct Keys {
    section: String,
    count: String,
    /// The one that says how densely roots stand, if one does.
    density: Option<String>,
}

impl Keys {
    /// The library's complaint in the keys of the scene.
    pub fn complaint(&self, error: Error) -> Complaint {
        let density = self.density.as_ref().unwrap_or(&self.section);
        match error {
            Error::InvalidArgument { argument, value, expected } if argument == "count" => {
                Complaint::value(&self.count, value, expected)
            }
            Error::InvalidArgument { ref argument, .. } if argument.starts_with("density") => {
                Complaint::new(density, error.to_string())
            }
            other => Complaint::new(&self.section, other.to_string()),
        }
    }
}

/// Strands when the scene does not say how many.
const DEFAULT_COUNT: usize = 10_000;

/// Reads `render_hair` of a scene that has been read otherwise.
pub fn read(node: &Node, scene: &Scene, directory: &Path) -> Result<SceneRenderHair, Complaint> {
    let entries = node.object(&[
        "out",
        "overwrite",
        "count",
        "every",
        "scalp",
        "roots",
        "points",
        "space",
        "guides_per_strand",
        "curliness",
        "max_tip_distance",
        "max_tip_ratio",
        "wisps",
        "wisp_profile",
        "frizz",
        "frizz_waves",
        "length_variation",
        "preserve_length",
        "flatness",
        "clump_noise",
        "clump_noise_waves",
        "flyaways",
        "flyaway_distance",
        "bodies",
        "clearance",
        "radius",
        "tip_radius",
        "taper_from",
        "taper_shape",
        "radius_variation",
        "seed",
    ])?;
    if scene.strands.is_empty() {
        return Err(Complaint::value("strands", "[]", format!("at least one strand, a guide of {}", node.key)));
    }
    let states = timeline::output_times(scene.duration, scene.output_interval);
    let times: Vec<Option<f64>> = states.iter().map(|time| Some(time_as_read(*time, scene.outputs_per_second()))).collect();
    let settings = read_settings(node, &entries, scene)?;
    let ground = read_ground(&entries, &times, directory)?;
    let out_node = entries.require("out")?;
    let out = path_of(out_node, directory)?;
    let kind = OutputKind::of_name(&out, times.len(), true, Some(scene.outputs_per_second()));
    let kind = kind.map_err(|reason| Complaint::new(&out_node.key, format!("is {}, which {reason}", out_node.value)))?;
    let scalp = entries.get_unless_null("scalp").and_then(|scalp| scalp.value.as_object());
    let density = scalp.and_then(|scalp| DENSITIES.into_iter().find(|key| scalp.get(*key).is_some_and(|map| !map.is_null())));
    Ok(SceneRenderHair {
        settings,
        every: entries.or("every", 1, |node| node.whole(1..=u64::from(u32::MAX)))? as usize,
        ground,
        out,
        kind,
        overwrite: entries.or("overwrite", false, Node::truth)?,
        bodies: entries.or("bodies", true, Node::truth)?,
        keys: Keys {
            section: node.key.clone(),
            count: entries.path("count"),
            density: density.map(|key| format!("{}.{key}", entries.path("scalp"))),
        },
    })
}

fn read_settings(node: &Node, entries: &Entries, scene: &Scene) -> Result<RenderSettings, Complaint> {
    let defaults = RenderSettings::default();
    let count = |name: &str, default: usize, low: usize, high: usize| {
        entries.or(name, default, |node| Ok(node.whole(low as u64..=high as u64)? as usize))
    };
    let number = |name: &str, default: f64| entries.or(name, default, Node::not_negative);
    let curliness = entries.get("curliness");
    let measured = curliness.is_some_and(|node| node.value.as_str() == Some("measured"));
    let given = curliness.filter(|_| !measured).map(|node| match node.value.as_f64() {
        Some(value) if (0.0..=1.0).contains(&value) => Ok(value),
        _ => Err(node.complain("a number, 0 to 1, or \"measured\"")),
    });
    let ratio = number("max_tip_ratio", defaults.max_tip_ratio)?;
    let settings = RenderSettings {
        points_per_strand: count("points", defaults.points_per_strand, 2, MAX_POINTS)?,
        space: entries
            .or("space", defaults.space, |node| node.choice(&[("position", Space::Position), ("curvature", Space::Curvature)]))?,
        guides_per_strand: count("guides_per_strand", defaults.guides_per_strand, 1, MAX_GUIDES)?,
        curliness: given.transpose()?.unwrap_or(defaults.curliness),
        measure_curliness: measured,
        max_tip_distance: entries.get_unless_null("max_tip_distance").map_or(Ok(f64::INFINITY), Node::positive)?,
        max_tip_ratio: if ratio > 0.0 { ratio } else { f64::INFINITY },
        wisps_per_guide: count("wisps", defaults.wisps_per_guide, 1, MAX_WISPS)?,
        wisp_profile: entries.or("wisp_profile", defaults.wisp_profile, Node::numbers)?,
        frizz: number("frizz", defaults.frizz)?,
        frizz_waves: entries.or("frizz_waves", defaults.frizz_waves, Node::positive)?,
        radius: number("radius", defaults.radius)?,
        tip_radius: number("tip_radius", defaults.tip_radius)?,
        taper_from: number("taper_from", defaults.taper_from)?,
        radius_variation: number("radius_variation", defaults.radius_variation)?,
        length_variation: number("length_variation", defaults.length_variation)?,
        preserve_length: entries.or("preserve_length", defaults.preserve_length, Node::truth)?,
        flatness: number("flatness", defaults.flatness)?,
        clump_noise: number("clump_noise", defaults.clump_noise)?,
        clump_noise_waves: entries.or("clump_noise_waves", defaults.clump_noise_waves, Node::positive)?,
        flyaways: number("flyaways", defaults.flyaways)?,
        flyaway_distance: number("flyaway_distance", defaults.flyaway_distance)?,
        taper_shape: entries.or("taper_shape", defaults.taper_shape, Node::number)?,
        clearance: entries.or("clearance", defaults.clearance, Node::positive)?,
        seed: entries.or("seed", defaults.seed, |node| node.whole(0..=u64::MAX))?,
        workers: scene.options.workers.clone(),
        ..defaults
    };
    settings.check(&format!("{}.", node.key)).map_err(|error| match error {
        Error::InvalidArgument { argument, value, expected } => Complaint::value(argument, value, expected),
        other => Complaint::new(&node.key, other.to_string()),
    })?;
    Ok(settings)
}

/// What a file that the scene names has wrong with it.
fn complaint(file: &Node, failure: &Failure) -> Complaint {
    Complaint::new(&file.key, format!("is {}: {failure}", file.value))
}

fn read_ground(entries: &Entries, times: &[Option<f64>], directory: &Path) -> Result<Ground, Complaint> {
    let (count, scalp, roots) = (entries.get("count"), entries.get_unless_null("scalp"), entries.get_unless_null("roots"));
    if let Some(roots) = roots {
        if let Some(other) = count.or(scalp) {
            return Err(other.complain("no such key beside roots, which say how many and where"));
        }
        return read_roots(roots, directory);
    }
    let count = count.map_or(Ok(DEFAULT_COUNT), |node| Ok(node.whole(1..=MAX_FOLLICLES as u64)? as usize))?;
    scalp.map_or(Ok(Ground::Among(count)), |scalp| read_scalp(scalp, count, times, directory))
}

/// The roots of a groom's strands.
fn read_roots(node: &Node, directory: &Path) -> Result<Ground, Complaint> {
    let entries = node.object(&["file", "metres_per_unit", "pose", "shapes"])?;
    let file = entries.require("file")?;
    let curves = Curves::read(path_of(file, directory)?).map_err(|error| file_complaint(file, &error))?;
    let flag = entries.get("metres_per_unit").map(Node::positive).transpose()?;
    let missing = || Complaint::new(entries.path("metres_per_unit"), "is missing, and the file does not say its unit");
    let scale = unit::stated(flag, &curves).ok_or_else(missing)?;
    let placed = Placement { scale, pose: entries.get_unless_null("pose").map(read_pose).transpose()? };
    let own = if entries.or("shapes", false, Node::truth)? { OwnShapes::Kept } else { OwnShapes::Mixed };
    let place = |point: &[f32; 3]| placed.place(&point.map(f64::from).into());
    Ok(Ground::Given(curves.strands().map(|strand| strand.iter().map(place).collect()).collect(), own))
}

/// Keys of a scalp that say how densely roots stand, the most likely to be wrong first.
const DENSITIES: [&str; 3] = ["density", "density_picture", "within"];

fn read_scalp(node: &Node, count: usize, times: &[Option<f64>], directory: &Path) -> Result<Ground, Complaint> {
    let entries = node.object(&["file", "scale", "pose", "within", "whole", "density", "density_picture"])?;
    let file = entries.require("file")?;
    let scale = entries.get("scale").map(Node::positive).transpose()?;
    let pose = entries.get_unless_null("pose").map(read_pose).transpose()?;
    let within = entries.get_unless_null("within").map(Node::positive).transpose()?;
    let region = match (within, entries.or("whole", false, Node::truth)?) {
        (Some(_), true) => return Err(Complaint::new(entries.path("whole"), "is true beside within, which says another region")),
        (Some(within), false) => Region::Within(within),
        (None, true) => Region::Whole,
        (None, false) => Region::Suitable,
    };
    let path = path_of(file, directory)?;
    let request = ScalpRequest { path: &path, scale, otherwise: 1.0, pose, up: None, times };
    let scalp = ScalpFiles::read(&request).map_err(|failure| complaint(file, &failure))?;
    let mut maps = Vec::new();
    if let Some(map) = entries.get_unless_null("density") {
        maps.push(read_vertex_densities(&path_of(map, directory)?).map_err(|failure| complaint(map, &failure))?);
    }
    if let Some(map) = entries.get_unless_null("density_picture") {
        scalp.rest.check_textured("density_picture").map_err(|failure| complaint(map, &failure))?;
        maps.push(read_picture(&path_of(map, directory)?).map_err(|failure| complaint(map, &failure))?);
    }
    Ok(Ground::Scalp(Box::new(Scattering { scalp, count, maps, region })))
}
