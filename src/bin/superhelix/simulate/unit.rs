//! Metres a unit of the groom of `superhelix simulate`.

use superhelix::io::Curves;

use super::arguments::SimulateArguments;
use crate::groom::statistics::{GroomStatistics, is_plausible_length};
use crate::groom::unit;
use crate::shell::failure::Failure;

/// Median lengths of hair that are taken where a unit is stated, m.
const POSSIBLE_LENGTHS: std::ops::RangeInclusive<f64> = 1e-3..=3.0;

/// Metres a file unit. Not given, it is 1, unless strands of that size could not be hair.
pub fn choose_scale(arguments: &SimulateArguments, curves: &Curves) -> Result<f64, Failure> {
    let statistics = GroomStatistics::of(curves);
    let stated = unit::stated(arguments.scale, curves);
    let Some(length) = statistics.length else { return Ok(stated.unwrap_or(1.0)) };
    if let Some(scale) = stated {
        let median = length.median * scale;
        if median > 0.0 && !POSSIBLE_LENGTHS.contains(&median) {
            let who = if arguments.scale.is_some() { "--scale" } else { "the file's unit" };
            let reason =
                format!("with {scale} m a unit ({who}) the median strand is {median} m long; expected hair of 1 mm to 3 m");
            return Err(Failure::file(&arguments.groom, reason));
        }
        return Ok(scale);
    }
    if is_plausible_length(length.median) {
        return Ok(1.0);
    }
    let hint = statistics
        .scale_guess
        .map_or_else(String::new, |guess| format!("; a guess is {} ({})", guess.metres_per_unit, guess.because));
    Err(Failure::file(
        &arguments.groom,
        format!(
            "taken as metres, the median strand is {} m long: give --scale, the metres a unit of this file{hint}",
            length.median
        ),
    ))
}
