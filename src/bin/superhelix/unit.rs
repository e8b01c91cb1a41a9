//! Metres a unit of a groom: what a flag says, else what the file says; and points in metres.

use std::path::Path;

use nalgebra::Vector3;
use superhelix::files::curves::Curves;

use crate::failure::Failure;

/// Metres a unit, where anybody says it. Of grooms only `.usda` states its unit.
pub fn stated(flag: Option<f64>, curves: &Curves) -> Option<f64> {
    flag.or(curves.extras().metres_per_unit)
}

/// The same for a flag that is given in metres, or for what is written in metres.
pub fn needed(flag: Option<f64>, curves: &Curves, path: &Path, who: &str) -> Result<f64, Failure> {
    stated(flag, curves)
        .ok_or_else(|| Failure::file(path, format!("does not say its unit: {who} needs --scale, the metres a unit of this file")))
}

/// Each so many-th strand of a file in metres, with its index in the file.
pub fn polylines(curves: &Curves, every: usize, metres_per_unit: f64) -> Vec<(usize, Vec<Vector3<f64>>)> {
    curves.strands().enumerate().step_by(every).map(|(index, points)| (index, in_metres(points, metres_per_unit))).collect()
}

/// Points of a file in metres.
pub fn in_metres(points: &[[f32; 3]], metres_per_unit: f64) -> Vec<Vector3<f64>> {
    points.iter().map(|point| Vector3::from(point.map(f64::from)) * metres_per_unit).collect()
}
