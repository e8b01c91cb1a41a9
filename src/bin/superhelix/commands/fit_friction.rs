//! `superhelix fit-friction`: friction coefficients from a recorded curve.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use nalgebra::Vector3;
use serde::Serialize;
use superhelix::experiments::{
    Coefficient, FrictionFit, FrictionFitOptions, Observable, Recording, RootMotion, Sought, Start, Verdict, fit_friction,
};
use superhelix::io::{Measured, Motion, RecordedCurve};
use superhelix::splines::PoseSpline;
use superhelix::{Error, Frame};

use crate::scene;
use crate::scene::Scene;
use crate::shell::atomic_file::AtomicFile;
use crate::shell::failure::Failure;

/// Fits friction coefficients to a recorded curve (docs/theory/friction_fit.md): internal friction to the span of a curl shaken up and down,
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
    let scene = scene::load(path)?;
    if !(scene.colliders.is_empty() && scene.attachments.is_empty()) {
        return Err(Failure::BadScene(format!(
            "{}: has {} colliders and {} attachments; expected none: the fit knows no contact",
            path.display(),
            scene.colliders.len(),
            scene.attachments.len()
        )));
    }
    let Some(strand) = scene.strands.get(arguments.strand) else {
        let count = scene.strands.len();
        return Err(Failure::Other(format!("--strand is {}; {} has {count} strands", arguments.strand, path.display())));
    };
    let curve = RecordedCurve::read(&arguments.curve)?;
    let options = options(arguments, &scene)?;
    let motion = motion(arguments, &curve, strand)?;
    let recording =
        Recording { times: curve.times.clone(), values: curve.values.clone(), observable: observable(arguments, &curve)? };
    let fit = fit_friction(&strand.definition, &recording, &motion, &options).map_err(in_words_of_the_command_line)?;
    if let Some(out) = &arguments.out {
        write_curve(out, &recording, &fit)?;
    }
    let answer = answer(arguments, &curve, &fit);
    crate::shell::answer::print_answer(arguments.json, &answer, || in_words(&answer))
}

/// Three numbers of a flag.
fn triple(flag: &str, numbers: &[f64]) -> Result<Vector3<f64>, Failure> {
    match numbers {
        [x, y, z] if numbers.iter().all(|number| number.is_finite()) => Ok(Vector3::new(*x, *y, *z)),
        _ => Err(Failure::Other(format!("--{flag} is {numbers:?}; expected three finite numbers: X,Y,Z"))),
    }
}

fn options(arguments: &FitFrictionArguments, scene: &Scene) -> Result<FrictionFitOptions, Failure> {
    let mut sought: Vec<Sought> = Vec::new();
    for name in &arguments.coefficients {
        let (coefficient, range, flag) = match name {
            CoefficientName::InternalFriction => {
                (Coefficient::InternalFriction, &arguments.internal_friction_range, "internal-friction-range")
            }
            CoefficientName::Viscosity => (Coefficient::Viscosity, &arguments.viscosity_range, "viscosity-range"),
            CoefficientName::AirDrag => (Coefficient::AirDrag, &arguments.air_drag_range, "air-drag-range"),
        };
        let range = match range.as_deref() {
            None => coefficient.usual_range(),
            Some([low, high]) => [*low, *high],
            Some(other) => return Err(Failure::Other(format!("--{flag} is {other:?}; expected two numbers: LOW,HIGH"))),
        };
        sought.push(Sought { coefficient, range, guess: None });
    }
    for (name, range, flag) in [
        (CoefficientName::InternalFriction, &arguments.internal_friction_range, "internal-friction-range"),
        (CoefficientName::Viscosity, &arguments.viscosity_range, "viscosity-range"),
        (CoefficientName::AirDrag, &arguments.air_drag_range, "air-drag-range"),
    ] {
        if range.is_some() && !arguments.coefficients.contains(&name) {
            return Err(Failure::Other(format!("--{flag} is given; expected --fit of that coefficient with it")));
        }
    }
    Ok(FrictionFitOptions {
        solver: scene.options.clone(),
        sought,
        start: match arguments.start {
            StartName::Settled => Start::Settled,
            StartName::AsDefined => Start::AsDefined,
        },
        lead_in: arguments.lead_in,
        discard: arguments.discard,
        time_step: scene.time_step,
        grid_points: arguments.grid_points,
        fit_offset: arguments.offset,
        ..FrictionFitOptions::of(&[])
    })
}

fn observable(arguments: &FitFrictionArguments, curve: &RecordedCurve) -> Result<Observable, Failure> {
    let direction = match (&arguments.direction, curve.measured) {
        (Some(numbers), Measured::Offset | Measured::Angle) => triple("direction", numbers)?,
        (Some(_), Measured::Span | Measured::Depth) => {
            return Err(Failure::Other("--direction is given; expected it with offset_m or angle_rad only".into()));
        }
        (None, Measured::Offset | Measured::Angle) => {
            let what = if curve.measured == Measured::Offset { "offset_m" } else { "angle_rad" };
            return Err(Failure::Other(format!("--direction is missing; the curve's {what} is measured along one")));
        }
        (None, Measured::Span | Measured::Depth) => Vector3::zeros(),
    };
    Ok(match curve.measured {
        Measured::Span => Observable::Span,
        Measured::Depth => Observable::Depth,
        Measured::Offset => Observable::Offset(direction),
        Measured::Angle => Observable::Angle(direction),
    })
}

/// How the root moved: the flags', the curve's or the scene's word, and only one of them.
fn motion(arguments: &FitFrictionArguments, curve: &RecordedCurve, strand: &scene::SceneStrand) -> Result<RootMotion, Failure> {
    let given = [
        (arguments.amplitude.is_some(), "--amplitude"),
        (arguments.motion.is_some(), "--motion"),
        (curve.root.is_some(), "the curve's root_x_m"),
        (strand.motion.is_some(), "the scene's root_motion"),
    ];
    let given: Vec<_> = given.iter().filter(|(given, _)| *given).map(|(_, name)| *name).collect();
    if given.len() > 1 {
        return Err(Failure::Other(format!("the root's motion is given by {}; expected one of them", given.join(" and "))));
    }
    if let (Some(amplitude), Some(frequency)) = (arguments.amplitude, arguments.frequency) {
        let direction = arguments.oscillation_direction.as_deref().map(|numbers| triple("oscillation-direction", numbers));
        return Ok(RootMotion::Oscillation { amplitude, frequency, phase: arguments.phase, direction: direction.transpose()? });
    }
    if let Some(path) = &arguments.motion {
        return Ok(RootMotion::Recorded(Motion::read(path, None)?.spline().clone()));
    }
    if let Some(root) = &curve.root {
        let rotation = strand.definition.root.rotation;
        let frames = root.iter().map(|origin| Frame { origin: *origin, rotation }).collect();
        return Ok(RootMotion::Recorded(PoseSpline::new(curve.times.clone(), frames)?));
    }
    match &strand.motion {
        None => Ok(RootMotion::Still),
        Some(motion) if motion.local == Frame::default() => Ok(RootMotion::Recorded((*motion.spline).clone())),
        Some(_) => Err(Failure::Other("the scene's root_motion has \"local\"; expected the root's own motion".into())),
    }
}

/// The study names its own arguments: the same errors in the names of flags and files.
fn in_words_of_the_command_line(error: Error) -> Failure {
    let Error::InvalidArgument { argument, value, expected } = error else { return Failure::from(error) };
    let rename = |from: &str, to: &str| argument.strip_prefix(from).map(|rest| format!("{to}{}", rest.replace('_', "-")));
    let named = match argument.as_str() {
        "options.time_step" => Some("the scene's time_step".to_string()),
        "options.sought" => Some("the range of".to_string()),
        "strand" => Some("the scene's strand".to_string()),
        _ => None,
    };
    let named = named
        .or_else(|| rename("options.sought", "--fit"))
        .or_else(|| argument.strip_prefix("options.solver.").map(|rest| format!("the scene's {rest}")))
        .or_else(|| rename("options.", "--"))
        .or_else(|| rename("motion.direction", "--oscillation-direction"))
        .or_else(|| rename("motion.", "--"))
        .or_else(|| rename("recording.direction", "--direction"))
        .or_else(|| argument.strip_prefix("recording.").map(|rest| format!("the curve's {rest}")));
    Failure::Other(format!("{} is {value}; expected {expected}", named.unwrap_or(argument)))
}

fn write_curve(path: &std::path::Path, recording: &Recording, fit: &FrictionFit) -> Result<(), Failure> {
    let mut out = AtomicFile::create(path)?;
    let mut text = String::from("time_s,recorded,fitted\n");
    for (index, fitted) in fit.curve.iter().enumerate() {
        let sample = fit.first_compared + index;
        text += &format!("{},{},{fitted}\n", recording.times[sample], recording.values[sample]);
    }
    out.write_all(text.as_bytes()).map_err(|error| Failure::file(path, format!("cannot be written: {error}")))?;
    out.commit()
}

fn answer(arguments: &FitFrictionArguments, curve: &RecordedCurve, fit: &FrictionFit) -> Answer {
    let finite = |number: f64| number.is_finite().then_some(number);
    let fitted = fit.coefficients.iter().map(|found| FittedAnswer {
        name: found.coefficient.name(),
        unit: found.coefficient.unit(),
        verdict: match found.verdict {
            Verdict::Determined => "determined",
            Verdict::Undetermined => "undetermined",
            Verdict::AtLowerEnd => "at_lower_end",
            Verdict::AtUpperEnd => "at_upper_end",
        },
        value: found.value,
        standard_error: finite(found.standard_error),
        step_shift: finite(found.step_shift),
        excluded_below: (found.excluded[0] > 0.0).then_some(found.excluded[0]),
        excluded_above: finite(found.excluded[1]),
    });
    Answer {
        version: 1,
        curve: arguments.curve.display().to_string(),
        coefficients: fitted.collect(),
        converged: fit.converged,
        rms_residual: fit.rms_residual,
        noise: fit.noise,
        residual_unit: if curve.measured == Measured::Angle { "rad" } else { "m" },
        residual_correlation: fit.residual_correlation,
        offset: fit.offset,
        samples: curve.times.len(),
        compared: fit.curve.len(),
        simulations: fit.simulations,
        unconverged: fit.unconverged,
    }
}

fn in_words(answer: &Answer) -> String {
    let mut text = String::new();
    for found in &answer.coefficients {
        let FittedAnswer { name, unit, value, .. } = found;
        let share = match found.standard_error {
            Some(error) if error > 10.0 * value => "standard error above 1000 %".into(),
            Some(error) => format!("standard error {:.2} %", 100.0 * error / value),
            None => "the curve does not change with it".into(),
        };
        text += &match found.verdict {
            "determined" => format!("{name}: {value:.4e} {unit}, {share}\n"),
            "undetermined" => format!("{name}: not determined by this curve (best {value:.2e} {unit}; {share})\n"),
            end => {
                let end = if end == "at_lower_end" { "lower" } else { "upper" };
                format!("{name}: the best is the {end} end of the range, {value:.4e} {unit}: widen the range\n")
            }
        };
        text += &match (found.excluded_below, found.excluded_above) {
            (None, None) => "  no value of the grid is excluded\n".to_string(),
            (below, above) => {
                let both: Vec<_> = below.into_iter().chain(above).map(|value| format!("{value:.1e}")).collect();
                format!("  the nearest values of the grid that the curve excludes: {}\n", both.join(" and "))
            }
        };
        if let Some(shift) = found.step_shift {
            let matters = found.standard_error.is_some_and(|error| shift.abs() > error / value);
            let advice = if matters { ", more than its standard error: take a smaller time_step" } else { "" };
            text += &format!("  half the time step would change it by {:.2} %{advice}\n", 100.0 * shift);
        }
    }
    let unit = answer.residual_unit;
    text += &format!(
        "residual {:.3e} {unit} rms over {} of {} samples, noise {:.3e} {unit}, correlation from one to the next {:.2}\n",
        answer.rms_residual, answer.compared, answer.samples, answer.noise, answer.residual_correlation
    );
    if answer.offset != 0.0 {
        text += &format!("offset {:.3e} {unit}\n", answer.offset);
    }
    if answer.residual_correlation > 0.5 {
        text += "the residuals follow one another: the model misses something, and the standard errors are too small\n";
    }
    if !answer.converged {
        text += "the search did not end at a minimum: these are the best values found\n";
    }
    text += &format!("{} simulations", answer.simulations);
    if answer.unconverged > 0 {
        text += &format!("; {} steps of the best curve did not converge", answer.unconverged);
    }
    text
}
