//! `superhelix fit-friction`: friction coefficients from a recorded curve.

use std::fs;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use nalgebra::Vector3;
use serde::Serialize;
use superhelix::error::Error;
use superhelix::files::motion::Motion;
use superhelix::files::recorded_curve::{Measured, RecordedCurve};
use superhelix::math::frame::Frame;
use superhelix::math::pose_spline::PoseSpline;
use superhelix::study::friction_fit::{Coefficient, FrictionFit, FrictionFitOptions, Sought, Start, Verdict, fit_friction};
use superhelix::study::recording::{Observable, Recording, RootMotion};

use crate::failure::Failure;
use crate::scene::{self, Scene};

/// Fits friction coefficients to a recorded curve (docs/friction_fit.md): internal friction to the span of a curl shaken up and down,
/// air drag to a pendulum's decay.
///
/// Exit status: 0 when a fit was found, whether or not the curve determines the coefficient (the answer says), 2 for a bad scene,
/// 1 for anything else.
#[derive(Debug, Args)]
pub struct FitFrictionArguments {
    /// The curve: a table time_s, then span_m, depth_m, offset_m or angle_rad, then root_x_m,root_y_m,root_z_m if recorded.
    #[arg(value_name = "CURVE.csv")]
    curve: PathBuf,
    /// A scene file with the strand; its time_step, gravity, wind, integrator, newton and threads are used, its duration,
    /// output_interval and output are not.
    #[arg(long, value_name = "SCENE.json")]
    scene: PathBuf,
    /// Which of the scene's strands, from 0.
    #[arg(long, value_name = "INDEX", default_value_t = 0)]
    strand: usize,
    /// What to fit; give it again for a second one.
    #[arg(long = "fit", value_enum, value_name = "COEFFICIENT", required = true)]
    coefficients: Vec<CoefficientName>,
    /// Smallest and largest internal friction looked at, kg m3/s.
    #[arg(long, value_name = "LOW,HIGH", value_delimiter = ',', allow_hyphen_values = true)]
    internal_friction_range: Option<Vec<f64>>,
    /// Smallest and largest Kelvin-Voigt time looked at, s.
    #[arg(long, value_name = "LOW,HIGH", value_delimiter = ',', allow_hyphen_values = true)]
    viscosity_range: Option<Vec<f64>>,
    /// Smallest and largest air drag looked at, kg/(m s).
    #[arg(long, value_name = "LOW,HIGH", value_delimiter = ',', allow_hyphen_values = true)]
    air_drag_range: Option<Vec<f64>>,
    /// Direction of offset_m, or in which angle_rad is positive.
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', allow_hyphen_values = true)]
    direction: Option<Vec<f64>>,
    /// The root oscillates about the scene's pose: amplitude, m.
    #[arg(long, value_name = "M", requires = "frequency", conflicts_with = "motion", allow_hyphen_values = true)]
    amplitude: Option<f64>,
    /// Frequency of that oscillation, Hz.
    #[arg(long, value_name = "HZ", requires = "amplitude", allow_hyphen_values = true)]
    frequency: Option<f64>,
    /// Its phase: the root is at amplitude sin(2 pi frequency t + phase), rad.
    #[arg(long, value_name = "RAD", requires = "amplitude", default_value_t = 0.0, allow_hyphen_values = true)]
    phase: f64,
    /// Its direction; without it, up.
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', requires = "amplitude", allow_hyphen_values = true)]
    oscillation_direction: Option<Vec<f64>>,
    /// The root's recorded poses (a table of head motion or a .bvh file), in the scene's axes.
    #[arg(long, value_name = "MOTION")]
    motion: Option<PathBuf>,
    /// Where the simulation starts: hanging at rest, or as the scene has it (initial_curvatures, initial_rates).
    #[arg(long, value_enum, value_name = "STATE", default_value_t = StartName::Settled)]
    start: StartName,
    /// Start the simulation so long before the first sample, s.
    #[arg(long, value_name = "S", default_value_t = 0.0, allow_hyphen_values = true)]
    lead_in: f64,
    /// Do not compare samples in the first so many seconds, s.
    #[arg(long, value_name = "S", default_value_t = 0.0, allow_hyphen_values = true)]
    discard: f64,
    /// Points of the grid over each range.
    #[arg(long, value_name = "COUNT", default_value_t = 9)]
    grid_points: u32,
    /// Fit a constant added to the simulated values as well: for a marker that is not quite on the tip.
    #[arg(long)]
    offset: bool,
    /// Write the fitted curve beside the recorded one: a table time_s,recorded,fitted.
    #[arg(long, value_name = "FITTED.csv")]
    out: Option<PathBuf>,
    /// The answer as JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
enum CoefficientName {
    /// gamma, kg m3/s.
    InternalFriction,
    /// Kelvin-Voigt time mu, s.
    Viscosity,
    /// nu, kg/(m s).
    AirDrag,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum StartName {
    /// At rest in its equilibrium.
    Settled,
    /// As the scene has it.
    AsDefined,
}

#[derive(Debug, Serialize)]
struct FittedAnswer {
    name: &'static str,
    unit: &'static str,
    verdict: &'static str,
    value: f64,
    /// null: infinite.
    standard_error: Option<f64>,
    step_shift: Option<f64>,
    excluded_below: Option<f64>,
    excluded_above: Option<f64>,
}

#[derive(Debug, Serialize)]
struct Answer {
    version: u32,
    curve: String,
    coefficients: Vec<FittedAnswer>,
    converged: bool,
    rms_residual: f64,
    noise: f64,
    residual_unit: &'static str,
    residual_correlation: f64,
    offset: f64,
    samples: usize,
    compared: usize,
    simulations: u32,
    unconverged: u32,
}

/// Runs the command.
pub fn run(arguments: &FitFrictionArguments) -> Result<(), Failure> {
    let path = &arguments.scene;
    let bytes = fs::read(path).map_err(|error| Failure::file(path, format!("cannot be read: {error}")))?;
    let text =
        String::from_utf8(bytes).map_err(|error| Failure::BadScene(format!("{}: is not UTF-8: {error}", path.display())))?;
    let scene = scene::parse(&text).map_err(|complaint| Failure::scene(path, &complaint))?;
    let Some(strand) = scene.strands.get(arguments.strand) else {
        let count = scene.strands.len();
        return Err(Failure::Other(format!("--strand is {}; {} has {count} strands", arguments.strand, path.display())));
    };
    let curve = RecordedCurve::read(&arguments.curve)?;
    let options = options(arguments, &scene)?;
    let motion = motion(arguments, &curve, strand)?;
    let recording =
        Recording { times: curve.times.clone(), values: curve.values.clone(), observable: observable(arguments, &curve)? };
    let mut definition = strand.definition.clone();
    if strand.motion.is_none() {
        // The scene's strand starts at rest; how the root moves is the recording's matter.
        definition.root_velocity = Vector3::zeros();
    }
    let fit = fit_friction(&definition, &recording, &motion, &options).map_err(in_words_of_the_command_line)?;
    if let Some(out) = &arguments.out {
        write_curve(out, &recording, &fit)?;
    }
    let answer = answer(arguments, &curve, &fit);
    let text = if arguments.json {
        serde_json::to_string_pretty(&answer).map_err(|error| Failure::Other(error.to_string()))?
    } else {
        in_words(&answer)
    };
    crate::print_line(&text)
}
