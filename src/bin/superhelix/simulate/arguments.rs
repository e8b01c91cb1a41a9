//! The flags of `superhelix simulate`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use nalgebra::Vector3;
use superhelix::settings::Preset;
use superhelix::{Integrator, LinearSolver, Precision};

use super::body::BodyArguments;
use crate::groom::material_arguments::MaterialArguments;
use crate::groom::stiffening_arguments::StiffeningArguments;
use crate::groom::strands::NaturalShape;
use crate::groom::wisp_arguments::WispArguments;
use crate::picture::view::Face;
use crate::scene;
use crate::shell::argument_values::{named, png, positive, preset, triple};
use crate::shell::up::Up;
use crate::stepping::motion_arguments::MotionArguments;

/// Simulates a groom on a moving head: fits strands, steps them, writes a cache of frames and a picture.
///
/// The head's motion moves all roots rigidly: a root at time t is M(t) M(0)^-1 applied to the groom's root, about the joint.
/// Strands that cannot be simulated (without length, shorter than wide) are left out and reported.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct SimulateArguments {
    /// The groom: .hair, .tfx, .obj with lines, .usda, .abc, .data, .ply, .npy or .npz, root first.
    #[arg(value_name = "GROOM")]
    pub groom: PathBuf,
    #[command(flatten)]
    pub head_motion: MotionArguments,
    /// Metres a unit of the groom. Default: what the file says (.usda), else 1, refused when hair of that size could not be.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    pub scale: Option<f64>,
    /// The groom's axis that points up; gravity points the other way.
    #[arg(long, value_enum, value_name = "AXIS", default_value_t = Up::Y)]
    pub up: Up,
    /// Use each K-th strand only.
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub every: u32,
    /// Settings by name: preview, balanced or accurate. Flags given beside it win.
    #[arg(long, value_name = "NAME", value_parser = preset)]
    pub preset: Option<Preset>,
    /// Helical elements a strand. Default: 10, or the preset's for the curl of nine tenths of the strands; more for each strand whose sharpest stretch
    /// needs them.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub elements: Option<u32>,
    /// Natural shape of the strands.
    #[arg(long, value_enum, value_name = "SHAPE", default_value_t = NaturalShape::SagFree)]
    pub natural: NaturalShape,
    #[command(flatten)]
    pub stiffening: StiffeningArguments,
    #[command(flatten)]
    pub wisps: WispArguments,
    /// Start the strands at rest in their static equilibrium under gravity, searched for from the groom's shape.
    #[arg(long)]
    pub settle: bool,
    /// Uniform wind, m/s.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = triple)]
    pub wind: Option<Vector3<f64>>,
    #[command(flatten)]
    pub bodies: BodyArguments,
    #[command(flatten)]
    pub material: MaterialArguments,
    /// Frames a second.
    #[arg(long, default_value_t = 30.0, value_parser = positive)]
    pub fps: f64,
    /// Seconds to simulate. Default: to the motion's end.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub duration: Option<f64>,
    /// Steps a frame. Default: 2, or the preset's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub substeps: Option<u32>,
    /// Time integrator. Default: second_order.
    #[arg(long, value_parser = integrator)]
    pub integrator: Option<Integrator>,
    /// Linear solver.
    #[arg(long, default_value = "linear_time", value_parser = linear_solver)]
    pub solver: LinearSolver,
    /// Precision of the arithmetic: f64 or f32 (docs/theory/lanes.md). Default: f64.
    #[arg(long, value_parser = precision)]
    pub precision: Option<Precision>,
    /// Newton's tolerance, rad. Default: 1e-4, or the preset's.
    #[arg(long, value_name = "RAD", value_parser = positive)]
    pub tolerance: Option<f64>,
    /// Newton iterations a step at most. Default: 50, or the preset's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub max_iterations: Option<u32>,
    /// How often a strand's step may be halved where it does not converge or errs too much, 0 to 10. Default: 3, or the preset's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=10))]
    pub max_subdivisions: Option<u32>,
    /// The error that a step may add to a point's position, in lengths of the strand, before it is halved. Default: not looked at.
    #[arg(long, value_name = "LENGTHS", value_parser = positive)]
    pub error_tolerance: Option<f64>,
    /// Integrator reference: the error allowed in positions, in lengths of the strand, a second; 1e-12 to 1e-2. Default: 1e-8.
    #[arg(long, value_name = "LENGTHS", value_parser = positive)]
    pub reference_tolerance: Option<f64>,
    /// What integrals along an element may err by, relative; 1e-12 to 1e-2. Default: 1e-4, or the preset's.
    #[arg(long, value_name = "SHARE", value_parser = positive)]
    pub quadrature_tolerance: Option<f64>,
    /// Threads.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=256))]
    pub threads: u32,
    /// Directory of the cache: one file a frame, in the groom's units.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Format of the cache: a file a frame (obj, hair), or one file hair.usda with velocities.
    #[arg(long, value_enum, default_value_t = Format::Obj)]
    pub format: Format,
    /// Points a strand in the cache and in the picture.
    #[arg(long, value_name = "N", default_value_t = 33, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub samples: u32,
    /// Replace the frames that the directory already holds.
    #[arg(long, requires = "out")]
    pub overwrite: bool,
    /// A contact sheet of the motion.
    #[arg(long, value_name = "FILE.png", value_parser = png)]
    pub picture: Option<PathBuf>,
    /// The axis that the face looks along, for the contact sheet. Default: where the head is bare if there is a --body and
    /// that is clear, else +z where y is up, -y where z is up.
    #[arg(long, value_enum, value_name = "AXIS", allow_hyphen_values = true)]
    pub face: Option<Face>,
    /// Moments on the contact sheet.
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub moments: u32,
    /// The report as JSON on standard output.
    #[arg(long)]
    pub json: bool,
    /// Neither progress bar nor warnings.
    #[arg(long, short)]
    pub quiet: bool,
}

/// Format of a cache.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Wavefront OBJ lines.
    Obj,
    /// Cem Yuksel's .hair.
    Hair,
    /// One USD text file with time samples and velocities.
    Usda,
}

fn integrator(text: &str) -> Result<Integrator, String> {
    named(text, &scene::INTEGRATORS)
}

fn linear_solver(text: &str) -> Result<LinearSolver, String> {
    named(text, &scene::LINEAR_SOLVERS)
}

fn precision(text: &str) -> Result<Precision, String> {
    named(text, &scene::PRECISIONS)
}
