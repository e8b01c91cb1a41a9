//! The compared methods of fitting. Curves have length one.

use nalgebra::Vector3;
use superhelix::hair::{ElementLengths, FitCurve, FitOptions, FitScratch, fit_curve};

use crate::{floating_tangents, sequential};

/// Distances between the curve's points and the strand at equal fractions of the length.
pub struct Errors {
    pub root_mean_square: f64,
    pub largest: f64,
}

impl Errors {
    /// Of distances at the points.
    pub fn of(distances: &[f64]) -> Self {
        let sum: f64 = distances.iter().map(|distance| distance * distance).sum();
        Self { root_mean_square: (sum / distances.len() as f64).sqrt(), largest: distances.iter().copied().fold(0.0, f64::max) }
    }
}

type Method = fn(&[Vector3<f64>], usize) -> Option<Errors>;

/// The methods.
pub const METHODS: [(&str, Method); 8] = [
    ("sequential", sequential::fit),
    ("floating tangents", floating_tangents::fit),
    ("whole curve: equal lengths; one start", |points, elements| {
        ours(points, FitOptions { lengths: ElementLengths::Equal, starts: 1, ..FitOptions::elements(elements) })
    }),
    ("whole curve: equal lengths; no twist", |points, elements| {
        ours(points, FitOptions { lengths: ElementLengths::Equal, twist: false, ..FitOptions::elements(elements) })
    }),
    ("whole curve: free lengths; one start", |points, elements| {
        ours(points, FitOptions { lengths: ElementLengths::Free, starts: 1, ..FitOptions::elements(elements) })
    }),
    ("whole curve: lengths where needed; four starts; largest as it comes", |points, elements| {
        ours(points, FitOptions { good_largest: 1.0, ..FitOptions::elements(elements) })
    }),
    ("whole curve: lengths where needed; four starts (the default)", |points, elements| {
        ours(points, FitOptions::elements(elements))
    }),
    ("whole curve: free lengths; eight starts to the end", |points, elements| {
        ours(points, FitOptions { lengths: ElementLengths::Free, starts: 8, good: 0.0, ..FitOptions::elements(elements) })
    }),
];

fn ours(points: &[Vector3<f64>], options: FitOptions) -> Option<Errors> {
    let fit = fit_curve(&FitCurve::polyline(points), &options, &mut FitScratch::default()).ok()?;
    Some(Errors { root_mean_square: fit.rms_error, largest: fit.max_error })
}
