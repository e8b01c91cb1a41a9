//! A scene file (docs/reference/scene_format.md): read, checked, and turned into what the solver is made from.
//!
//! Files:
//!
//! - `attachments.rs`: `attachments`: what holds strands, as constraints.
//! - `colliders.rs`: `colliders`: bodies, how they move, and where their files are.
//! - `contact.rs`: `contact` and `hair_contact`: how touches are answered, and what strands are to them.
//! - `options.rs`: The keys of a scene that say how it is stepped.
//! - `outputs.rs`: `output`: what a scene asks to be written.
//! - `pose.rs`: Poses and motions, of roots, colliders and targets.
//! - `posing.rs`: `posing`: what is done to the strands before a run begins.
//! - `render_hair.rs`: `render_hair`: strands to be drawn, which follow those of the scene and are written as it runs.
//! - `strands.rs`: `strands`: what each is made from, and how its root moves.
//! - `targets.rs`: `targets`: curves to which strands are drawn, over time or as the strands start.
//! - `words.rs`: The solver's complaints in the words of a scene.

pub mod attachments;
pub mod colliders;
pub mod contact;
pub mod options;
pub mod outputs;
pub mod pose;
pub mod posing;
pub mod render_hair;
pub mod strands;
pub mod targets;
mod words;

use std::fs;
use std::path::Path;

use serde_json::Value;
use superhelix::SolverOptions;
use superhelix::reading::SHORTEST_STEP;

use crate::shell::failure::Failure;
use crate::shell::json;
use crate::shell::json::{Complaint, Node};
use attachments::Attachment;
use colliders::Collider;
use contact::groups::Groups;
pub use options::{INTEGRATORS, LINEAR_SOLVERS, PRECISIONS};
use outputs::timeline;
pub use outputs::{Output, Request};
use pose::motions::Motions;
pub use posing::posed::apply as do_posing;
use render_hair::SceneRenderHair;
pub use strands::SceneStrand;
use targets::SceneTarget;
pub use words::in_words_of_the_scene;

/// A scene that has been checked.
#[derive(Debug)]
pub struct Scene {
    /// Gravity, wind, step options, threads, how contact is answered.
    pub options: SolverOptions,
    /// Longest step, s.
    pub time_step: f64,
    /// Length of the run, s.
    pub duration: f64,
    /// Time between written states, s.
    pub output_interval: f64,
    /// The strands.
    pub strands: Vec<SceneStrand>,
    /// What they may touch.
    pub colliders: Vec<Collider>,
    /// What holds them.
    pub attachments: Vec<Attachment>,
    /// What draws them.
    pub targets: Vec<SceneTarget>,
    /// What strands overlap at the start is allowed.
    pub allow_overlaps: bool,
    /// What to write.
    pub outputs: Vec<Request>,
    /// Samples a strand, where an output does not say its own.
    pub samples: usize,
    /// Render hair that follows the strands.
    pub render_hair: Option<SceneRenderHair>,
}

impl Scene {
    /// What the times of files of its states are counted in, a second.
    pub fn outputs_per_second(&self) -> f64 {
        1.0 / self.output_interval
    }
}

/// Reads a scene file; its strands are posed already.
pub fn load(path: &Path) -> Result<Scene, Failure> {
    let text = read_text(path)?;
    let directory = path.parent().unwrap_or(Path::new(""));
    parse(&text, directory).map_err(|complaint| Failure::scene(path, &complaint))
}

/// The text of a scene file.
pub fn read_text(path: &Path) -> Result<String, Failure> {
    let bytes = fs::read(path).map_err(|error| Failure::file(path, format!("cannot be read: {error}")))?;
    String::from_utf8(bytes).map_err(|error| Failure::BadScene(format!("{}: is not UTF-8: {error}", path.display())))
}

/// Reads a scene from its text; `directory` is where the files are that it names.
fn parse(text: &str, directory: &Path) -> Result<Scene, Complaint> {
    read(&json::parse(text)?, directory)
}

fn read(document: &Value, directory: &Path) -> Result<Scene, Complaint> {
    let scene = Node::root(document).object(&[
        "version",
        "gravity",
        "wind",
        "integrator",
        "time_step",
        "duration",
        "output_interval",
        "precision",
        "threads",
        "newton",
        "reference_tolerance",
        "max_subdivisions",
        "max_work",
        "jump_acceleration",
        "error_tolerance",
        "quadrature_tolerance",
        "solver",
        "strands",
        "colliders",
        "attachments",
        "targets",
        "hair_contact",
        "contact",
        "groups",
        "motions",
        "posing",
        "samples",
        "output",
        "render_hair",
    ])?;
    scene.require("version")?.whole(1..=1)?;

    let time_step = long_enough(scene.require("time_step")?)?;
    let duration = scene.require("duration")?;
    let seconds = duration.number()?;
    if seconds != 0.0 && seconds < SHORTEST_STEP {
        return Err(duration.complain(format!("zero, or {SHORTEST_STEP:e} s or more")));
    }
    let output_interval = scene.or("output_interval", time_step, long_enough)?;
    if seconds / time_step > timeline::MAX_STEPS || seconds / output_interval > timeline::MAX_OUTPUTS {
        return Err(duration.complain(format!(
            "a duration of at most {} times time_step ({time_step}) and {} times output_interval ({output_interval})",
            timeline::MAX_STEPS,
            timeline::MAX_OUTPUTS
        )));
    }

    let groups = Groups::read(&scene)?;
    let (contact, touching) = contact::read(&scene, &groups)?;
    let options = options::read(&scene, contact)?;
    let motions = scene.or("motions", Motions::default(), Motions::read)?;
    let mut strands = Vec::new();
    let mut given = Vec::new();
    for (item, strand) in scene.require("strands")?.list()?.iter().enumerate() {
        strands.extend(strands::read(strand, item, &options, &motions, directory)?);
        given.resize(strands.len(), contact::read_of_strand(strand, &groups)?);
    }
    let colliders = scene.or("colliders", Vec::new(), |list| colliders::read(list, &motions, &groups, directory))?;
    touching.give(&mut strands, given, &colliders)?;
    let attachments = scene.or("attachments", Vec::new(), |list| attachments::read(list, &strands, &motions))?;
    let targets = scene.or("targets", Vec::new(), |list| targets::read(list, &strands, directory))?;
    targets.iter().for_each(|target| target.place(&mut strands));
    let (outputs, samples) = outputs::read(&scene)?;
    let posing = scene.or("posing", Vec::new(), |list| posing::read(list, &strands))?;
    let wanted = scene.get_unless_null("render_hair");
    let mut scene = Scene {
        options,
        time_step,
        duration: seconds,
        output_interval,
        strands,
        colliders,
        attachments,
        targets,
        allow_overlaps: touching.allow_overlaps,
        outputs,
        samples,
        render_hair: None,
    };
    do_posing(&mut scene, &posing)?;
    scene.render_hair = wanted.map(|node| render_hair::read(node, &scene, directory)).transpose()?;
    Ok(scene)
}

/// A time that a step can last.
fn long_enough(node: &Node) -> Result<f64, Complaint> {
    let seconds = node.number()?;
    if seconds >= SHORTEST_STEP { Ok(seconds) } else { Err(node.complain(format!("{SHORTEST_STEP:e} s or more"))) }
}
