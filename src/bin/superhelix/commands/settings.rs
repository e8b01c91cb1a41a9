//! `superhelix settings`: what to set for a preset or for an error that may be made.

use clap::{ArgGroup, Args};
use serde::Serialize;
use superhelix::settings::{HairShape, Preset, Scenes, Settings, suggest_settings};

use crate::scene::INTEGRATORS;
use crate::shell::argument_values::{not_negative, positive, preset};
use crate::shell::failure::Failure;

/// Says which integrator, substeps, elements and tolerance a preset means, or which are the cheapest that were measured to keep an error.
///
/// The error is the root mean square distance of a strand's points from where they should be, in units of its length.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true, group = ArgGroup::new("choice").required(true).args(["preset", "error", "error_mm"]))]
pub struct SettingsArguments {
    /// A preset: preview, balanced or accurate.
    #[arg(long, value_name = "NAME", value_parser = preset)]
    preset: Option<Preset>,
    /// The error that may be made, in units of the strand's length.
    #[arg(long, value_name = "SHARE", value_parser = positive)]
    error: Option<f64>,
    /// The error that may be made, mm.
    #[arg(long, value_name = "MM", value_parser = positive)]
    error_mm: Option<f64>,
    /// What the hair is to go through, with commas between: calm_sway, walk, head_shake, curly_bounce, stiff_bristle, wind_gust.
    /// Default: all.
    #[arg(long, value_name = "SCENES", conflicts_with = "preset", value_parser = scenes)]
    scenes: Option<Scenes>,
    /// Length of the strand, m.
    #[arg(long, value_name = "M", default_value_t = 0.2, value_parser = positive)]
    length: f64,
    /// Radius of its natural curl, m. Default: straight hair.
    #[arg(long, value_name = "M", value_parser = positive)]
    curl_radius: Option<f64>,
    /// How far a turn of the curl goes along its axis, m.
    #[arg(long, value_name = "M", default_value_t = 0.0, requires = "curl_radius", value_parser = not_negative)]
    curl_step: f64,
    /// Frames a second.
    #[arg(long, default_value_t = 30.0, value_parser = positive)]
    fps: f64,
    /// The answer as JSON.
    #[arg(long)]
    json: bool,
}

fn scenes(text: &str) -> Result<Scenes, String> {
    let mut bits = 0;
    for name in text.split(',') {
        let index = Scenes::NAMES.iter().position(|known| *known == name.trim());
        bits |= 1 << index.ok_or_else(|| format!("{name:?} is none of {}", Scenes::NAMES.join(", ")))?;
    }
    Scenes::from_bits("scenes", bits).map_err(|error| error.to_string())
}

#[derive(Debug, Serialize)]
struct Answer {
    integrator: &'static str,
    substeps: u32,
    elements: u32,
    tolerance: f64,
    max_iterations: u32,
    quadrature_tolerance: f64,
    measured_error: Option<f64>,
    measured_microseconds_per_strand_and_second: Option<f64>,
}

/// Runs the command.
pub fn run(arguments: &SettingsArguments) -> Result<(), Failure> {
    let curvature =
        arguments.curl_radius.map_or(0.0, |radius| 1.0 / radius.hypot(arguments.curl_step / (2.0 * std::f64::consts::PI)));
    let hair = HairShape { curvature, length: arguments.length };
    let frame_time = 1.0 / arguments.fps;
    let error = arguments.error.or(arguments.error_mm.map(|mm| 1e-3 * mm / arguments.length));
    let settings = match (arguments.preset, error) {
        (Some(preset), _) => preset.settings(&hair, frame_time)?,
        (None, Some(error)) => suggest_settings(error, arguments.scenes.unwrap_or_default(), &hair, frame_time)?,
        (None, None) => return Err(Failure::Other("give --preset, --error or --error-mm".into())),
    };
    crate::shell::answer::print_answer(arguments.json, &answer(&settings), || in_words(&settings, arguments.length))
}

fn answer(settings: &Settings) -> Answer {
    let named = INTEGRATORS.iter().find(|(_, integrator)| *integrator == settings.step.integrator);
    Answer {
        integrator: named.map_or("", |(name, _)| name),
        substeps: settings.substeps,
        elements: settings.elements,
        tolerance: settings.step.tolerance,
        max_iterations: settings.step.max_iterations,
        quadrature_tolerance: settings.step.quadrature_tolerance,
        measured_error: settings.error,
        measured_microseconds_per_strand_and_second: settings.cost,
    }
}

fn in_words(settings: &Settings, length: f64) -> String {
    let answer = answer(settings);
    let mut text = format!(
        "--integrator {} --substeps {} --elements {} --tolerance {} --max-iterations {} --quadrature-tolerance {}\n",
        answer.integrator, answer.substeps, answer.elements, answer.tolerance, answer.max_iterations, answer.quadrature_tolerance
    );
    text += &match (settings.error, settings.cost) {
        (Some(error), Some(cost)) => format!(
            "measured: error {:.2} % of the length ({:.2} mm) in the worst scene, {cost:.0} µs a strand and simulated second in the dearest",
            1e2 * error,
            1e3 * error * length
        ),
        _ => "hair this curly was not measured".to_string(),
    };
    text
}
