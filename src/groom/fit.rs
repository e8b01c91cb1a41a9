//! A strand from a polyline: the Super-Helix whose centreline comes closest.

use nalgebra::Vector3;

use crate::error::Result;
use crate::math::frame::Frame;

/// How to fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitOptions {
    /// Helical elements of the fitted strand.
    pub element_count: usize,
}

/// A fitted strand.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Root frame: first point, n0 along the first segment.
    pub root: Frame,
    /// Element lengths, m; their sum is the polyline's length.
    pub element_lengths: Vec<f64>,
    /// Curvature rows.
    pub curvatures: Vec<[f64; 3]>,
    /// Root mean square of the distance between the polyline and the centreline at equal arclength, m.
    pub rms_error: f64,
    /// The largest such distance, m.
    pub max_error: f64,
}

/// Fits a strand to a polyline of at least two points, in metres, root first. Doubled points are skipped.
///
/// # Errors
/// [`crate::error::Error::InvalidArgument`] for non-finite points, fewer than two distinct ones, or no elements.
#[allow(unused_variables, clippy::todo)]
pub fn fit_polyline(points: &[Vector3<f64>], options: &FitOptions) -> Result<Fit> {
    todo!()
}

/// Natural curvatures for which a strand of this definition is in equilibrium under gravity at `curvatures`:
/// qⁿ = q − K⁻¹ f(q).
///
/// # Errors
/// As [`crate::solver::definition::StrandDef::check`].
#[allow(unused_variables, clippy::todo)]
pub fn natural_under_gravity(
    strand: &crate::solver::definition::StrandDef,
    curvatures: &[[f64; 3]],
    gravity: Vector3<f64>,
) -> Result<Vec<[f64; 3]>> {
    todo!()
}
