//! Metres a unit of a groom: what a flag says, else what the file says; and strands in metres.

use std::path::Path;

use superhelix::hair::DrawnCurve;
use superhelix::io::Curves;

use crate::shell::failure::Failure;

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
