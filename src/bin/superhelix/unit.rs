//! Metres a unit of a groom: what a flag says, else what the file says; and strands in metres.

use std::path::Path;

use nalgebra::Vector3;
use superhelix::files::curves::Curves;
use superhelix::groom::fit::FitCurve;

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

/// A strand of a file, in metres.
pub struct Polyline {
    /// Its index in the file.
    pub index: usize,
    /// Root first.
    pub points: Vec<Vector3<f64>>,
    /// How far along the strand they lie, where that is more than their edges.
    pub arclengths: Option<Vec<f64>>,
}

impl Polyline {
    /// What a strand is fitted to.
    pub fn curve(&self) -> FitCurve<'_> {
        FitCurve { arclengths: self.arclengths.as_deref(), ..FitCurve::polyline(&self.points) }
    }
}

/// Each so many-th strand of a file.
pub fn polylines(curves: &Curves, every: usize, metres_per_unit: f64) -> Vec<Polyline> {
    (0..curves.strand_count()).step_by(every).map(|index| polyline(curves, index, metres_per_unit)).collect()
}

/// A strand of a file.
pub fn polyline(curves: &Curves, index: usize, metres_per_unit: f64) -> Polyline {
    let points = in_metres(curves.strand(index), metres_per_unit);
    let arclengths = curves.extras().arclengths.as_ref().map(|all| {
        let stated = all[curves.strand_range(index)].iter().map(|arclength| f64::from(*arclength) * metres_per_unit);
        let (mut last, mut before) = (0.0, points[0]);
        // Floats of long strands may be too coarse for edges that are short: those count as they are.
        let along = stated.zip(&points).enumerate().map(|(point, (stated, at))| {
            last = if point == 0 { 0.0 } else { stated.max(last + (at - before).norm()) };
            before = *at;
            last
        });
        along.collect()
    });
    Polyline { index, points, arclengths }
}

/// Points of a file in metres.
pub fn in_metres(points: &[[f32; 3]], metres_per_unit: f64) -> Vec<Vector3<f64>> {
    points.iter().map(|point| Vector3::from(point.map(f64::from)) * metres_per_unit).collect()
}
