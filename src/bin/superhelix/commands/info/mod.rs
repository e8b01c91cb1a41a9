//! `superhelix info`: what a groom file holds.
//!
//! Files:
//!
//! - `suggested.rs`: `superhelix info --suggest`: how many elements the strands of a groom need for their shape.

mod suggested;

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use superhelix::io::{Curves, StrandAttributes, UpAxis};

use crate::commands::info::suggested::Suggested;
use crate::groom::statistics::{GroomStatistics, Spread};
use crate::groom::unit;
use crate::shell::argument_values::positive;
use crate::shell::failure::Failure;

/// Says what a groom file holds: strands, lengths, turning, degenerate strands, and a guess of its unit.
#[derive(Debug, Args)]
pub struct InfoArguments {
    /// The groom: .hair, .tfx, .obj with lines, .usda, .abc, .data, .ply, .npy or .npz.
    #[arg(value_name = "GROOM")]
    groom: PathBuf,
    /// How many elements strands need so that no point of the groom is farther from its strand than this, m, and none turns by more than
    /// pi/2: fitted for 32 of the strands. Needs the groom's unit.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    suggest: Option<f64>,
    /// Metres a unit of the groom, for --suggest. Default: what the file says (.usda).
    #[arg(long, value_name = "METRES", value_parser = positive, requires = "suggest")]
    scale: Option<f64>,
    /// The answer as JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Answer {
    file: String,
    format: &'static str,
    #[serde(flatten)]
    statistics: GroomStatistics,
    held_points: Option<usize>,
    /// Numbers of strands, by name, for maps and groups of scenes.
    attributes: Vec<AttributeAnswer>,
    /// What the file says, if it does.
    metres_per_unit: Option<f64>,
    up: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    suggested: Option<Suggested>,
}

#[derive(Debug, Serialize)]
struct AttributeAnswer {
    name: String,
    min: f64,
    max: f64,
    /// How many numbers differ.
    different: usize,
    /// Strands without such a number.
    without: usize,
}

/// The attributes that any strand has, and between what their numbers are.
fn attributes_of(all: &StrandAttributes) -> Vec<AttributeAnswer> {
    let answer = |name: &str| {
        let values = all.get(name)?;
        let mut numbers: Vec<f64> = values.iter().copied().filter(|value| !value.is_nan()).collect();
        let without = values.len() - numbers.len();
        numbers.sort_by(f64::total_cmp);
        numbers.dedup();
        let (min, max) = (*numbers.first()?, *numbers.last()?);
        Some(AttributeAnswer { name: name.to_owned(), min, max, different: numbers.len(), without })
    };
    all.names().filter_map(answer).collect()
}

/// Runs the command.
pub fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let curves = Curves::read(&arguments.groom)?;
    let suggested = match arguments.suggest {
        Some(tolerance) => {
            let scale = unit::needed(arguments.scale, &curves, &arguments.groom, "--suggest")?;
            Some(Suggested::of(&curves, tolerance, scale))
        }
        None => None,
    };
    let answer = Answer {
        file: arguments.groom.display().to_string(),
        format: curves.format().name(),
        statistics: GroomStatistics::of(&curves),
        attributes: attributes_of(&StrandAttributes::read(&arguments.groom)?),
        metres_per_unit: curves.extras().metres_per_unit,
        up: curves.extras().up.map(|up| if up == UpAxis::Y { "y" } else { "z" }),
        suggested,
        held_points: curves.extras().held.as_ref().map(|held| held.iter().filter(|held| **held).count()),
    };
    crate::shell::answer::print_answer(arguments.json, &answer, || in_words(&answer))
}

fn in_words(answer: &Answer) -> String {
    let statistics = &answer.statistics;
    let row = |name: &str, spread: Option<Spread>| match spread {
        Some(Spread { min, p10, median, p90, p99, max }) => {
            let [min, p10, median, p90, p99, max] = [min, p10, median, p90, p99, max].map(short);
            format!("{name:<22}{min:>10}{p10:>10}{median:>10}{p90:>10}{p99:>10}{max:>10}\n")
        }
        None => String::new(),
    };
    let mut text = format!("{}: {}\n", answer.file, answer.format);
    text += &format!("strands               {:>10}\npoints                {:>10}\n", statistics.strands, statistics.points);
    text += &format!("{:<22}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", "", "min", "10 %", "median", "90 %", "99 %", "max");
    text += &row("points a strand", statistics.points_per_strand);
    text += &row("length (file units)", statistics.length);
    text += &row("turning (degrees)", statistics.turning_degrees);
    if let (Some(low), Some(high)) = (statistics.box_min, statistics.box_max) {
        text += &format!("box (file units)      {low:?} to {high:?}\n");
    }
    text += &format!(
        "degenerate            {} strands without length, {} shorter than a thousandth of the median, {} edges without length\n",
        statistics.strands_without_length, statistics.strands_very_short, statistics.edges_without_length
    );
    if let Some(held) = answer.held_points {
        text += &format!("held points           {held}\n");
    }
    for AttributeAnswer { name, min, max, different, without } in &answer.attributes {
        let values =
            if different == &1 { short(*min) } else { format!("{} to {}, {different} different", short(*min), short(*max)) };
        let lack = if *without > 0 { format!("; {without} strands have none") } else { String::new() };
        text += &format!("attribute             {name}: {values}{lack}\n");
    }
    if let (Some(unit), Some(up)) = (answer.metres_per_unit, answer.up) {
        text += &format!("unit                  {unit} m, {up} up: the file says so\n");
    }
    text += &match &statistics.scale_guess {
        _ if answer.metres_per_unit.is_some() => String::new(),
        Some(guess) => {
            format!(
                "scale                 a guess: {} m a unit ({}); the file does not say\n",
                guess.metres_per_unit, guess.because
            )
        }
        None => {
            "scale                 no guess: at no usual unit do the strands look like hair on a head; the file does not say\n"
                .into()
        }
    };
    if let Some(suggested) = &answer.suggested {
        text += &suggested.in_words();
    }
    text.trim_end().to_string()
}

/// Four significant digits.
fn short(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        let digits = (3 - value.abs().max(1e-3).log10().floor() as i32).clamp(0, 6) as usize;
        let text = format!("{value:.digits$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
    } else {
        format!("{value:.2e}")
    }
}
