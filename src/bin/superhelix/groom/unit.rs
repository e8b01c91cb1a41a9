//! Metres a unit of a groom: what a flag says, else what the file says; and strands in metres.

use std::path::Path;

use superhelix::hair::DrawnCurve;
use superhelix::io::Curves;

use crate::groom::statistics::{GroomStatistics, is_plausible_length};
use crate::shell::failure::Failure;

/// Median lengths of hair that are taken where a unit is stated, m.
const POSSIBLE_LENGTHS: std::ops::RangeInclusive<f64> = 1e-3..=3.0;

/// Metres a unit, where anybody says it. Of grooms only `.usda` states its unit.
pub fn stated(flag: Option<f64>, curves: &Curves) -> Option<f64> {
    flag.or(curves.extras().metres_per_unit)
}

/// The same for a flag that is given in metres, or for what is written in metres.
pub fn needed(flag: Option<f64>, curves: &Curves, path: &Path, who: &str) -> Result<f64, Failure> {
    stated(flag, curves)
        .ok_or_else(|| Failure::file(path, format!("does not say its unit: {who} needs --scale, the metres a unit of this file")))
}

/// Every so many-th strand of a file, in metres.
pub fn drawn(curves: &Curves, every: usize, metres_per_unit: f64) -> Vec<DrawnCurve> {
    (0..curves.strand_count()).step_by(every).map(|index| DrawnCurve::of(curves, index, metres_per_unit)).collect()
}

/// Metres a file unit where hair is to be simulated. Not stated, it is 1, unless strands of that size could not be hair. `flag`: whether it
/// is the flag that states it.
pub fn plausible(path: &Path, statistics: &GroomStatistics, stated: Option<f64>, flag: bool) -> Result<f64, Failure> {
    let Some(length) = statistics.length else { return Ok(stated.unwrap_or(1.0)) };
    if let Some(scale) = stated {
        let median = length.median * scale;
        if median > 0.0 && !POSSIBLE_LENGTHS.contains(&median) {
            let who = if flag { "--scale" } else { "the file's unit" };
            let reason =
                format!("with {scale} m a unit ({who}) the median strand is {median} m long; expected hair of 1 mm to 3 m");
            return Err(Failure::file(path, reason));
        }
        return Ok(scale);
    }
    if is_plausible_length(length.median) {
        return Ok(1.0);
    }
    let guess = statistics.scale_guess.as_ref();
    let hint = guess.map_or_else(String::new, |guess| format!("; a guess is {} ({})", guess.metres_per_unit, guess.because));
    let median = length.median;
    Err(Failure::file(
        path,
        format!("taken as metres, the median strand is {median} m long: give --scale, the metres a unit of this file{hint}"),
    ))
}
