//! Fits a strand to a curve: finds the Super-Helix whose centreline comes closest at equal arclength.
//!
//! The Levenberg–Marquardt method minimises the squared distance at the curve's points, each weighted by the length around it,
//! over the elements' curvatures, the nodes between them, and the root's direction. Its linear systems take linear time, like
//! those of a step (`fit/linearised.rs`). The fitted length equals the curve's by construction. The search tries several starts
//! until one is good: per element the helix nearest to the curve's own curvature, on nodes that follow the variation of the
//! curvature and on others (`fit/start.rs`). If the largest distance is still too large, reweighted least squares lower it.
//! `docs/notebook/groom_fit.md` compares the errors on real grooms with other methods.
//!
//! Files:
//!
//! - `bulk.rs`: Fits many curves at once.
//! - `linearised.rs`: The linearised least squares of one strand: residuals at the samples, and the Levenberg–Marquardt step in linear time.
//! - `measure.rs`: Distances between a strand and its samples.
//! - `samples.rs`: Samples of a curve to fit, relative to its length.
//! - `search.rs`: The Levenberg–Marquardt search on one strand.
//! - `shape.rs`: The strand under search, relative to its length: root at the origin, total length 1.
//! - `start.rs`: Starts of the search: the curve's curvature in twist-free frames, and for each element the helix that it resembles.
//! - `target.rs`: The target of a fit: the curve's points, checked, relative to its length, and thinned out where there are very many.

pub mod bulk;
mod linearised;
mod measure;
mod samples;
mod search;
mod shape;
mod start;
mod target;

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

pub use super::rest_shape::{natural_under_gravity, natural_under_gravity_with};
use crate::error::{Error, Result, check_finite, check_positive};
use crate::math::frame::Frame;
use crate::rod::definition::MAX_ELEMENTS;
use linearised::{Freedom, Weights};
use measure::Errors;
use samples::Sample;
use search::Search;
use shape::Shape;
use start::{Nodes, Start};
use target::Target;

/// Options of a fit.
///
/// ```
/// use superhelix::hair::{FitOptions, fit_polyline};
/// use superhelix::nalgebra::Vector3;
///
/// let curve: Vec<_> = (0..40).map(|k| 0.1 * f64::from(k)).map(|t| Vector3::new(0.05 * t.sin(), 0.05 * t.cos(), 0.01 * t)).collect();
/// let fit = fit_polyline(&curve, &FitOptions::within(1e-4, 50))?;
/// assert!(fit.max_error <= 1e-4 && fit.element_lengths.len() < 50);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitOptions {
    /// Helical elements of the fitted strand, 1 to [`MAX_ELEMENTS`]; with a tolerance, their largest number. Default 10.
    pub element_count: usize,
    /// The tolerance, m: the fit takes the smallest number of elements for which no point of the curve is farther than this from
    /// the strand at equal arclength. It finds the number by doubling and bisection, so that one element fewer exceeds the
    /// tolerance. If even [`FitOptions::element_count`] exceed it, the fit has that many, and [`Fit::max_error`] shows the error.
    /// Default: none.
    pub tolerance: Option<f64>,
    /// Whether elements may have different lengths. Default [`ElementLengths::WhereNeeded`].
    pub lengths: ElementLengths,
    /// The least length of an element, relative to that of equal elements, 0.05 to 1. Default 0.3.
    pub least_length: f64,
    /// Whether elements may have twist. Without it (κ0 = 0) the material frames are parallel-transported along the centreline,
    /// and elements are circular arcs; with it they have no more twist than brings the centreline closer. Default true.
    pub twist: bool,
    /// The largest number of starts, 1 to [`MAX_STARTS`]. Default 4.
    pub starts: usize,
    /// A start is good, and the last one, when the root mean square distance is below this fraction of the length; 0 to 1.
    /// Default 1e-3. 0 tries every start and finishes every search, at ten times the time.
    pub good: f64,
    /// If the largest distance exceeds this fraction of the length, the fit lowers it, at the cost of the root mean square; 0 to
    /// 1. Default 0.01. 1 never does. A tolerance replaces it.
    pub good_largest: f64,
    /// Noise of the points, m; 0 or above. On a noisy curve the edges add up to more than its length: with this set, the length
    /// and the arclengths follow the means of runs of points eight times as long as the noise. Default 0. Has no effect on curves
    /// with arclengths of their own.
    pub noise: f64,
    /// For curves with frames: the distance, relative to the curve's length, that counts as much as one radian between the
    /// frames; 0 or above. Default 3e-3.
    pub frame_weight: f64,
}

/// The largest number of starts.
pub const MAX_STARTS: usize = start::STARTS.len();

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            element_count: 10,
            tolerance: None,
            lengths: ElementLengths::WhereNeeded,
            least_length: 0.3,
            twist: true,
            starts: 4,
            good: 1e-3,
            good_largest: 1e-2,
            noise: 0.0,
            frame_weight: 3e-3,
        }
    }
}

impl FitOptions {
    /// The default options for this number of elements.
    pub fn elements(element_count: usize) -> Self {
        Self { element_count, ..Self::default() }
    }

    /// Options for the smallest number of elements up to `most` within a tolerance, m.
    pub fn within(tolerance: f64, most: usize) -> Self {
        Self { element_count: most, tolerance: Some(tolerance), ..Self::default() }
    }

    /// Checks every value; messages put `argument`, with its dot, before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        let name = |field: &str| format!("{argument}{field}");
        if !(1..=MAX_ELEMENTS).contains(&self.element_count) {
            return Err(Error::invalid(name("element_count"), self.element_count, format!("1 to {MAX_ELEMENTS}")));
        }
        if let Some(tolerance) = self.tolerance {
            check_positive(|| name("tolerance"), tolerance)?;
        }
        if !(0.05..=1.0).contains(&self.least_length) {
            return Err(Error::invalid(name("least_length"), self.least_length, "0.05 to 1"));
        }
        if !(1..=MAX_STARTS).contains(&self.starts) {
            return Err(Error::invalid(name("starts"), self.starts, format!("1 to {MAX_STARTS}")));
        }
        for (field, value) in [("good", self.good), ("good_largest", self.good_largest)] {
            if !(0.0..=1.0).contains(&value) {
                return Err(Error::invalid(name(field), value, "0 to 1"));
            }
        }
        for (field, value) in [("noise", self.noise), ("frame_weight", self.frame_weight)] {
            check_finite(|| name(field), value)?;
            if value < 0.0 {
                return Err(Error::invalid(name(field), value, "0 or above"));
            }
        }
        Ok(())
    }
}

/// Whether a strand's elements may have different lengths.
///
/// Free lengths halve the error. A strand steps as fast with them, but
/// [`Solver::sample_tiles`](crate::solver::Solver::sample_tiles) samples strands of equal elements side by side and others one by
/// one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ElementLengths {
    /// All are equal.
    Equal,
    /// Equal where that is good ([`FitOptions::good`], or the tolerance), else free.
    #[default]
    WhereNeeded,
    /// Free.
    Free,
}

/// The source of a strand's root frame. Its origin is the curve's first point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum FitRoot {
    /// From the curve: the fit finds its direction, starting from the first edge's; n1 is as close as possible to a world axis
    /// far from the edge, or to that of the curve's first frame.
    #[default]
    Curve,
    /// The follicle's direction, of any length above zero. n1 as above.
    Direction(Vector3<f64>),
    /// This frame: the scalp's, for example.
    Frame(UnitQuaternion<f64>),
}

/// A curve to fit. Splines are converted to points first: [`crate::groom::spline`].
///
/// ```
/// use superhelix::hair::{FitCurve, FitOptions, FitRoot, FitScratch, fit_curve};
/// use superhelix::nalgebra::Vector3;
///
/// let points: Vec<_> = (0..20).map(|k| 0.01 * f64::from(k)).map(|x| Vector3::new(x, 2.0 * x * x, 0.0)).collect();
/// let curve = FitCurve { root: FitRoot::Direction(Vector3::x()), ..FitCurve::polyline(&points) };
/// let fit = fit_curve(&curve, &FitOptions::elements(6), &mut FitScratch::default())?;
/// assert!((fit.root.rotation * Vector3::x() - Vector3::x()).norm() < 1e-12);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct FitCurve<'a> {
    /// Points in metres, root first; at least two distinct ones. Repeated points are skipped, with their data below.
    pub points: &'a [Vector3<f64>],
    /// The arclength of each point, m, if known better than the sum of the edges: from 0, ascending.
    pub arclengths: Option<&'a [f64]>,
    /// A material frame at each point, of which n1 (the image of the y axis) counts: the strand's frames follow it as well as
    /// possible ([`FitOptions::frame_weight`]). A helix that bends cannot turn its frame freely as well.
    pub frames: Option<&'a [UnitQuaternion<f64>]>,
    /// The hair's width at each point, m, 0 or above.
    pub widths: Option<&'a [f64]>,
    /// The source of the root frame.
    pub root: FitRoot,
}

impl<'a> FitCurve<'a> {
    /// A plain polyline.
    pub fn polyline(points: &'a [Vector3<f64>]) -> Self {
        Self { points, arclengths: None, frames: None, widths: None, root: FitRoot::Curve }
    }
}

/// A fitted strand.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Root frame, at the first point.
    pub root: Frame,
    /// Element lengths, m; their sum is the curve's length to rounding.
    pub element_lengths: Vec<f64>,
    /// Curvature rows, rad/m.
    pub curvatures: Vec<[f64; 3]>,
    /// Root mean square of the distance between the curve's points and the centreline at the same arclength, m.
    pub rms_error: f64,
    /// The largest such distance, m.
    pub max_error: f64,
    /// The largest distance of the curve's points from the nearest place of the centreline, m; at most `max_error`. The search
    /// goes downhill from equal arclength, so it never underestimates.
    pub max_distance: f64,
    /// Root mean square of the angle about the tangent between n1 of the strand and of the curve's frames, rad; 0 without frames.
    pub frame_error: f64,
    /// Half the mean width along the curve, m; `None` without widths.
    pub radius: Option<f64>,
}

/// Memory for fitting, reused from strand to strand.
#[derive(Default)]
pub struct FitScratch {
    search: search::SearchScratch,
    start: start::StartScratch,
    target: Target,
    shape: Shape,
    best: Shape,
    /// The samples, with more weight on distant ones.
    weighted: Vec<Sample>,
}

impl std::fmt::Debug for FitScratch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FitScratch").finish_non_exhaustive()
    }
}

/// Fits a strand to a polyline of at least two distinct points, in metres, root first.
///
/// # Errors
/// [`Error::InvalidArgument`] for points that are not finite, fewer than two distinct ones, or options out of range.
pub fn fit_polyline(points: &[Vector3<f64>], options: &FitOptions) -> Result<Fit> {
    fit_curve(&FitCurve::polyline(points), options, &mut FitScratch::default())
}

/// Fits a strand to a curve. The result does not depend on earlier uses of the scratch memory.
///
/// # Errors
/// [`Error::InvalidArgument`] for numbers that are not finite, fewer than two distinct points, lists without exactly one entry
/// per point, arclengths that do not ascend from 0, widths below zero, a direction without length, or options out of range.
pub fn fit_curve(curve: &FitCurve<'_>, options: &FitOptions, scratch: &mut FitScratch) -> Result<Fit> {
    options.check("options.")?;
    scratch.target.set(curve, options)?;
    let Some(tolerance) = options.tolerance else {
        let errors = scratch.fit(options.element_count, options, None);
        return Ok(scratch.result(&errors));
    };
    let tolerance = tolerance / scratch.target.length;
    let (mut low, mut high) = (0, 1);
    let mut errors = scratch.fit(high, options, Some(tolerance));
    while errors.largest > tolerance && high < options.element_count {
        (low, high) = (high, (2 * high).min(options.element_count));
        errors = scratch.fit(high, options, Some(tolerance));
    }
    if errors.largest > tolerance {
        return Ok(scratch.result(&errors));
    }
    let mut least = scratch.result(&errors);
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        let errors = scratch.fit(middle, options, Some(tolerance));
        if errors.largest > tolerance {
            low = middle;
        } else {
            high = middle;
            least = scratch.result(&errors);
        }
    }
    Ok(least)
}

/// Weight of a strand's own twist, ∫ (κ0 L)² ds, against the mean squared distance, both relative to the length. A twist that
/// moves the centreline by less than its cost is noise, and an element that turns by many radians for nothing cannot bend its
/// axis in simulation. The search charges less as the strand comes closer, so that exact helices are found exactly.
const TWIST_WEIGHT: f64 = 1e-8;
/// Weight of (ℓ − L/N)² (N/L)², summed over the elements, against the mean squared distance relative to the length: nodes whose
/// position does not matter stay.
const SPACING_WEIGHT: f64 = 1e-8;
/// Iterations from one start, and of the best start once more.
const ITERATIONS: [usize; 2] = [30, 60];
/// A search ends when two iterations have each reduced the cost by less than this fraction.
const LEAST_GAIN: f64 = 1e-2;
/// The same when every search is to be finished.
const ITERATIONS_TO_THE_END: [usize; 2] = [100, 500];
const LEAST_GAIN_TO_THE_END: f64 = 1e-5;

/// How often to reweight to lower the largest distance, and the iterations of each search.
const REWEIGHED: usize = 16;
const REWEIGHED_ITERATIONS: usize = 2;

impl FitScratch {
    /// The best of the starts, into `best`; distances relative to the length.
    fn fit(&mut self, count: usize, options: &FitOptions, tolerance: Option<f64>) -> Errors {
        let ([iterations, last_iterations], least_gain) =
            if options.good > 0.0 { (ITERATIONS, LEAST_GAIN) } else { (ITERATIONS_TO_THE_END, LEAST_GAIN_TO_THE_END) };
        let search = Search {
            freedom: Freedom { root: self.target.free_root, twist: options.twist, nodes: false },
            weights: Weights { twist: TWIST_WEIGHT, normal: options.frame_weight.powi(2), spacing: SPACING_WEIGHT },
            iterations,
            least_gain,
            // A thousandth of good needs no refinement.
            enough: (1e-3 * options.good).powi(2),
            least_length: options.least_length,
        };
        self.target.coarsen(count);
        self.start.look_at(&self.target, count);
        // For the best: its weighted cost, and whether its nodes are free.
        let mut best: Option<(f64, bool)> = None;
        for (kind, nodes) in attempts(options, count, self.target.has_normals()) {
            let search = Search { freedom: Freedom { nodes, ..search.freedom }, ..search };
            self.shape.root = self.target.root;
            self.start.nodes(kind.nodes, count, options.least_length, &mut self.shape.nodes);
            self.start.curvatures(&mut self.shape, kind.twisted, &self.target);
            let (cost, squared) = self.search.minimise(&mut self.shape, self.target.coarse(), &search);
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, nodes));
                std::mem::swap(&mut self.shape, &mut self.best);
                let good = match tolerance {
                    None => squared.sqrt() <= options.good,
                    Some(tolerance) => measure::errors(&self.best, self.target.coarse()).largest <= tolerance,
                };
                if good {
                    break;
                }
            }
            // Too far off for another start to help.
            if nodes && tolerance.is_some_and(|tolerance| squared.sqrt() > 3.0 * tolerance) {
                break;
            }
        }
        let nodes = best.is_some_and(|(_, nodes)| nodes);
        let last = Search { freedom: Freedom { nodes, ..search.freedom }, iterations: last_iterations, ..search };
        self.search.minimise(&mut self.best, &self.target.samples, &last);
        self.lower_largest(tolerance.unwrap_or(options.good_largest), &last);
        measure::errors(&self.best, &self.target.samples)
    }

    /// Brings the largest distance of `best`, the result of the last [`FitScratch::search`], below `good`, or as low as possible:
    /// repeated least squares, with weights that grow where the strand is far off (Lawson's algorithm; Rice and Usow 1968).
    fn lower_largest(&mut self, good: f64, search: &Search) {
        let mut least = self.search.largest();
        let good = good * good;
        if least <= good {
            return;
        }
        let search = Search { iterations: REWEIGHED_ITERATIONS, ..*search };
        self.shape.copy_from(&self.best);
        self.weighted.clone_from(&self.target.samples);
        for _ in 0..REWEIGHED {
            let scale = 1.0 / self.search.largest();
            let mut sum = 0.0;
            for (sample, squared) in self.weighted.iter_mut().zip(self.search.squared_distances()) {
                sample.weight *= (squared * scale).sqrt();
                sum += sample.weight;
            }
            self.weighted.iter_mut().for_each(|sample| sample.weight /= sum);
            self.search.minimise(&mut self.shape, &self.weighted, &search);
            let now = self.search.largest();
            if now < least {
                least = now;
                self.best.copy_from(&self.shape);
                if least <= good {
                    break;
                }
            }
        }
    }

    /// `best` in metres.
    fn result(&self, errors: &Errors) -> Fit {
        let (target, shape, length) = (&self.target, &self.best, self.target.length);
        let count = shape.rows.len();
        let mut element_lengths: Vec<f64> = (0..count).map(|element| shape.length(element) * length).collect();
        let before: f64 = element_lengths[..count - 1].iter().sum();
        element_lengths[count - 1] = length - before;
        Fit {
            root: Frame {
                origin: target.origin,
                rotation: UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(shape.root.0.into())),
            },
            element_lengths,
            curvatures: shape.rows.iter().map(|row| row.map(|curvature| curvature / length)).collect(),
            rms_error: errors.root_mean_square * length,
            max_error: errors.largest * length,
            max_distance: errors.farthest * length,
            frame_error: errors.frames,
            radius: target.radius,
        }
    }
}

/// The starts to try, and whether their nodes are free.
fn attempts(options: &FitOptions, count: usize, has_normals: bool) -> impl Iterator<Item = (Start, bool)> {
    let FitOptions { starts, twist, lengths, .. } = *options;
    let free = lengths != ElementLengths::Equal && count > 1;
    let allowed = move |kind: &Start| !kind.twisted || twist && !has_normals;
    let first =
        (free && lengths == ElementLengths::WhereNeeded).then_some((Start { nodes: Nodes::Equal, twisted: false }, false));
    let kinds = start::STARTS.into_iter().filter(move |kind| allowed(kind) && (free || kind.nodes == Nodes::Equal));
    first.into_iter().chain(kinds.take(starts).map(move |kind| (kind, free)))
}
