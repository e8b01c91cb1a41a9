//! A scene file (docs/scene_format.md): read, checked, and turned into what the solver is made from.

use std::collections::BTreeSet;

use nalgebra::Vector3;
use serde_json::Value;
use superhelix::contact::options::ContactOptions;
use superhelix::error::Error;
use superhelix::math::frame::Frame;
use superhelix::math::lane::Precision;
use superhelix::math::pose_spline::PoseSpline;
use superhelix::rod::freedoms::Freedoms;
use superhelix::rod::material::Material;
use superhelix::solver::SHORTEST_STEP;
use superhelix::solver::definition::{MAX_ELEMENTS, SolverOptions, StrandDef, Workers};
use superhelix::step::options::{Integrator, LinearSolver, StepOptions};

use crate::json::{self, Complaint, Entries, Node};
use crate::timeline;

/// Samples a strand for `points`, `frames` and `velocities` when the scene does not say.
pub const DEFAULT_SAMPLES: usize = 33;

/// The integrators by their names in a scene and on the command line.
pub const INTEGRATORS: [(&str, Integrator); 4] = [
    ("linearly_implicit", Integrator::LinearlyImplicit),
    ("implicit_euler", Integrator::ImplicitEuler),
    ("second_order", Integrator::SecondOrder),
    ("reference", Integrator::Reference),
];

/// The precisions by their names in a scene and on the command line.
pub const PRECISIONS: [(&str, Precision); 2] = [("f64", Precision::F64), ("f32", Precision::F32)];

/// The linear solvers by their names in a scene and on the command line.
pub const LINEAR_SOLVERS: [(&str, LinearSolver); 4] = [
    ("linear_time", LinearSolver::LinearTime),
    ("dense_cholesky", LinearSolver::DenseCholesky),
    ("dense_cg", LinearSolver::DenseConjugateGradients),
    ("dense_svd", LinearSolver::DenseSingularValues),
];

/// Something that a scene can ask to be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Output {
    /// Tip positions.
    Tips,
    /// Positions of samples along each strand.
    Points,
    /// Positions and material frames of samples.
    Frames,
    /// Velocities of samples.
    Velocities,
    /// Curvature rows.
    Curvatures,
    /// Rates of the curvatures.
    Rates,
    /// Energies of all strands together.
    Energies,
    /// Contacts (always none in this version).
    Contacts,
    /// Wrenches on the follicles.
    Wrenches,
}

const OUTPUTS: [(&str, Output); 9] = [
    ("tips", Output::Tips),
    ("points", Output::Points),
    ("frames", Output::Frames),
    ("velocities", Output::Velocities),
    ("curvatures", Output::Curvatures),
    ("rates", Output::Rates),
    ("energies", Output::Energies),
    ("contacts", Output::Contacts),
    ("wrenches", Output::Wrenches),
];

impl Output {
    /// Whether this one is sampled along the strand.
    fn is_sampled(self) -> bool {
        matches!(self, Output::Points | Output::Frames | Output::Velocities)
    }
}

/// One entry of `output`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Request {
    /// What.
    pub output: Output,
    /// Samples a strand, for the sampled ones.
    pub samples: usize,
}

/// A strand and how its root moves.
#[derive(Debug)]
pub struct SceneStrand {
    /// What the strand is made from; its root and root velocity are already those of the motion's start.
    pub definition: StrandDef,
    /// The root's motion, if it moves.
    pub motion: Option<PoseSpline>,
}

/// A scene that has been checked.
#[derive(Debug)]
pub struct Scene {
    /// Gravity, wind, step options, threads.
    pub options: SolverOptions,
    /// Longest step, s.
    pub time_step: f64,
    /// Length of the run, s.
    pub duration: f64,
    /// Time between written states, s.
    pub output_interval: f64,
    /// The strands.
    pub strands: Vec<SceneStrand>,
    /// What to write.
    pub outputs: Vec<Request>,
}

/// Reads a scene from its text.
pub fn parse(text: &str) -> Result<Scene, Complaint> {
    read(&json::parse(text)?)
}

fn read(document: &Value) -> Result<Scene, Complaint> {
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
        "error_tolerance",
        "quadrature_tolerance",
        "solver",
        "strands",
        "colliders",
        "attachments",
        "hair_contact",
        "samples",
        "output",
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
    if scene.or("hair_contact", false, Node::boolean)? {
        return Err(Complaint::new("hair_contact", "is true; contact between hairs is not in this version"));
    }
    for absent in ["colliders", "attachments"] {
        if let Some(list) = scene.get(absent)
            && let Some(first) = list.list()?.first()
        {
            let value = first.complain("nothing").reason;
            return Err(Complaint::new(&first.key, format!("{value}: {absent} are not in this version")));
        }
    }

    let options = read_options(&scene)?;
    let mut strands = Vec::new();
    for strand in scene.require("strands")?.list()? {
        strands.push(read_strand(&strand)?);
    }
    Ok(Scene { options, time_step, duration: seconds, output_interval, strands, outputs: read_outputs(&scene)? })
}

/// A time that a step can last.
fn long_enough(node: &Node) -> Result<f64, Complaint> {
    let seconds = node.number()?;
    if seconds >= SHORTEST_STEP { Ok(seconds) } else { Err(node.complain(format!("{SHORTEST_STEP:e} s or more"))) }
}

fn read_options(scene: &Entries) -> Result<SolverOptions, Complaint> {
    let defaults = SolverOptions::default();
    let integrator = scene.or("integrator", Integrator::default(), |node| node.choice(&INTEGRATORS))?;
    let linear_solver = scene.or("solver", LinearSolver::default(), |node| node.choice(&LINEAR_SOLVERS))?;
    let mut step = StepOptions { integrator, linear_solver, ..StepOptions::default() };
    step.precision = scene.or("precision", step.precision, |node| node.choice(&PRECISIONS))?;
    step.reference_tolerance = scene.or("reference_tolerance", step.reference_tolerance, Node::positive)?;
    step.max_subdivisions = scene.or("max_subdivisions", step.max_subdivisions, |node| Ok(node.whole(0..=10)? as u32))?;
    step.error_tolerance = scene.or("error_tolerance", step.error_tolerance, Node::not_negative)?;
    step.quadrature_tolerance = scene.or("quadrature_tolerance", step.quadrature_tolerance, Node::positive)?;
    if let Some(newton) = scene.get("newton") {
        let newton = newton.object(&["max_iterations", "tolerance"])?;
        step.max_iterations = newton.or("max_iterations", step.max_iterations, |node| Ok(node.whole(1..=10_000)? as u32))?;
        step.tolerance = newton.or("tolerance", step.tolerance, Node::positive)?;
    }
    let threads = scene.or("threads", 1, |node| node.whole(1..=256))? as usize;
    let options = SolverOptions {
        gravity: scene.or("gravity", defaults.gravity, |node| Ok(Vector3::from(node.numbers()?)))?,
        wind: scene.or("wind", defaults.wind, |node| Ok(Vector3::from(node.numbers()?)))?,
        step,
        workers: if threads == 1 { Workers::Serial } else { Workers::Pool(threads) },
        instruction_set: None,
        contact: ContactOptions::default(),
    };
    options.check("scene").map_err(in_words_of_the_scene)?;
    Ok(options)
}

/// The solver names its own fields: the same complaint in the keys of a scene.
pub fn in_words_of_the_scene(error: Error) -> Complaint {
    let key = |argument: &str| {
        let argument =
            argument.split_once('.').map_or(argument, |(first, rest)| if first.contains('[') { argument } else { rest });
        let mut key = argument.replace(" (count)", "");
        for (field, name) in
            [("natural", "natural_curvatures"), ("initial", "initial_curvatures"), ("max_iterations", "newton.max_iterations")]
        {
            let mut parts: Vec<String> = key.split('.').map(str::to_string).collect();
            for part in &mut parts {
                let (stem, index) = part.find('[').map_or((part.as_str(), ""), |at| part.split_at(at));
                if stem == field {
                    *part = format!("{name}{index}");
                }
            }
            key = parts.join(".");
        }
        key
    };
    match error {
        Error::Unsupported { argument, value, hint } => {
            Complaint::new(key(&argument), format!("is {value}, which is unsupported in this version: {hint}"))
        }
        Error::InvalidArgument { argument, value, expected } => Complaint::value(key(&argument), value, expected),
        other => Complaint::new("", other.to_string()),
    }
}

fn read_strand(node: &Node) -> Result<SceneStrand, Complaint> {
    let strand = node.object(&[
        "elements",
        "length",
        "element_lengths",
        "radius",
        "density",
        "youngs_modulus",
        "poisson_ratio",
        "internal_friction",
        "viscosity",
        "air_drag",
        "natural_curvatures",
        "initial_curvatures",
        "initial_rates",
        "freedoms",
        "root",
        "root_motion",
    ])?;
    let element_lengths = read_lengths(&strand)?;
    let count = element_lengths.len();
    let defaults = Material::default();
    let material = Material {
        radius: strand.or("radius", defaults.radius, Node::numbers)?,
        density: strand.or("density", defaults.density, Node::number)?,
        youngs_modulus: strand.or("youngs_modulus", defaults.youngs_modulus, Node::number)?,
        poisson_ratio: strand.or("poisson_ratio", defaults.poisson_ratio, Node::number)?,
        internal_friction: strand.or("internal_friction", 0.0, Node::number)?,
        viscosity: strand.or("viscosity", 0.0, Node::number)?,
        air_drag: strand.or("air_drag", 0.0, Node::number)?,
    };
    let rows = |name: &str| strand.get_unless_null(name).map(|rows| read_rows(rows, count)).transpose();
    let mut definition = StrandDef {
        element_lengths,
        material,
        freedoms: strand.or("freedoms", Freedoms::ALL, read_freedoms)?,
        natural: strand.or("natural_curvatures", vec![[0.0; 3]; count], |node| read_rows(node, count))?,
        initial: rows("initial_curvatures")?,
        initial_rates: rows("initial_rates")?,
        ..StrandDef::straight(1.0, 1)
    };
    if let Some(root) = strand.get("root") {
        let entries = root.object(&["origin", "rotation"])?;
        let origin = entries.or("origin", [0.0; 3], Node::numbers)?;
        let rotation = entries.or("rotation", [0.0, 0.0, 0.0, 1.0], Node::numbers)?;
        definition.root = read_frame(&root.key, origin, rotation)?;
    }
    let motion = strand.get_unless_null("root_motion").map(read_motion).transpose()?;
    if let Some(motion) = &motion {
        definition.root = motion.at(0.0);
        (definition.root_velocity, definition.root_angular_velocity) = motion.velocity(0.0);
    }
    definition.check(&node.key).map_err(in_words_of_the_scene)?;
    Ok(SceneStrand { definition, motion })
}

/// `elements` and `length`, or `element_lengths` in place of both.
fn read_lengths(strand: &Entries) -> Result<Vec<f64>, Complaint> {
    if let Some(lengths) = strand.get("element_lengths") {
        for other in ["elements", "length"] {
            if let Some(other) = strand.get(other) {
                return Err(other.complain("no such key beside element_lengths, which stands in place of elements and length"));
            }
        }
        let items = lengths.list()?;
        if items.is_empty() || items.len() > MAX_ELEMENTS {
            return Err(lengths.complain(format!("1 to {MAX_ELEMENTS} lengths")));
        }
        return items.iter().map(Node::positive).collect();
    }
    let count = strand.require("elements")?.whole(1..=MAX_ELEMENTS as u64)? as usize;
    let length = strand.require("length")?.positive()?;
    Ok(vec![length / count as f64; count])
}

/// One row (twist, k1, k2) for all elements, or one an element.
fn read_rows(node: &Node, count: usize) -> Result<Vec<[f64; 3]>, Complaint> {
    let items = node.list()?;
    if items.len() != 1 && items.len() != count {
        let expected = if count == 1 { "1 row".to_string() } else { format!("1 row, or {count} rows: one an element") };
        return Err(Complaint::value(&node.key, format!("a list of {}", items.len()), expected));
    }
    let rows = items.iter().map(Node::numbers).collect::<Result<Vec<[f64; 3]>, _>>()?;
    Ok(if rows.len() == count { rows } else { vec![rows[0]; count] })
}

fn read_freedoms(node: &Node) -> Result<Freedoms, Complaint> {
    let names = [("twist", Freedoms::TWIST), ("bend1", Freedoms::BEND1), ("bend2", Freedoms::BEND2)];
    let mut freedoms: Option<Freedoms> = None;
    for item in node.list()? {
        let freedom = item.choice(&names)?;
        if freedoms.is_some_and(|seen| seen.bits() & freedom.bits() != 0) {
            return Err(item.complain("each freedom once"));
        }
        freedoms = Some(freedoms.map_or(freedom, |seen| seen.union(freedom)));
    }
    freedoms.ok_or_else(|| node.complain("at least one of \"twist\", \"bend1\", \"bend2\""))
}

fn read_frame(key: &str, origin: [f64; 3], rotation: [f64; 4]) -> Result<Frame, Complaint> {
    Frame::from_arrays(key, origin, rotation).map_err(in_words_of_the_scene)
}

fn read_motion(node: &Node) -> Result<PoseSpline, Complaint> {
    let entries = node.object(&["times", "frames"])?;
    let (times_node, frames_node) = (entries.require("times")?, entries.require("frames")?);
    let items = times_node.list()?;
    let times = items.iter().map(Node::number).collect::<Result<Vec<_>, _>>()?;
    for (item, pair) in items.iter().skip(1).zip(times.windows(2)) {
        if pair[1] <= pair[0] {
            return Err(item.complain(format!("a time after the one before, {}", pair[0])));
        }
    }
    let items = frames_node.list()?;
    if times.is_empty() || items.len() != times.len() {
        let expected = format!("as many as times has ({}), at least one", times.len());
        return Err(Complaint::value(&frames_node.key, format!("a list of {}", items.len()), expected));
    }
    let frames = items
        .iter()
        .map(|item| {
            let [x, y, z, qx, qy, qz, qw] = item.numbers()?;
            read_frame(&item.key, [x, y, z], [qx, qy, qz, qw])
        })
        .collect::<Result<Vec<_>, _>>()?;
    PoseSpline::new(times, frames).map_err(|error| Complaint::new(&node.key, error.to_string()))
}

fn read_samples(node: &Node) -> Result<usize, Complaint> {
    Ok(node.whole(2..=1_000_000)? as usize)
}

fn read_outputs(scene: &Entries) -> Result<Vec<Request>, Complaint> {
    let samples = scene.or("samples", DEFAULT_SAMPLES, read_samples)?;
    let Some(list) = scene.get("output") else { return Ok(vec![Request { output: Output::Tips, samples }]) };
    let mut seen = BTreeSet::new();
    let mut requests = Vec::new();
    for item in list.list()? {
        let request = if item.value.is_object() {
            let entries = item.object(&["kind", "samples"])?;
            let output = entries.require("kind")?.choice(&OUTPUTS)?;
            if let Some(samples) = entries.get("samples")
                && !output.is_sampled()
            {
                return Err(samples.complain("samples only beside \"points\", \"frames\" or \"velocities\""));
            }
            Request { output, samples: entries.or("samples", samples, read_samples)? }
        } else {
            Request { output: item.choice(&OUTPUTS)?, samples }
        };
        if !seen.insert(request.output) {
            return Err(item.complain("each output once"));
        }
        requests.push(request);
    }
    Ok(requests)
}
