//! A strand from a curve: the Super-Helix whose centreline comes closest at equal arclength.
//!
//! The squared distance at the curve's points, weighted by the length that each stands for, is minimised over the elements' curvatures, where
//! the elements begin and end, and the root's direction, by Levenberg and Marquardt's method. Its linear systems take linear time, as those of
//! a step do (`fit/linearised.rs`). The length is the curve's, by construction. Several starts are tried until one is good: helices that the
//! curve's curvature resembles, an element at a time, on nodes where the curvature varies and on others (`fit/start.rs`). Where the largest
//! distance is still too large, least squares with other weights lower it. `docs/notebook/groom_fit.md` has what that leaves on real grooms, beside other
//! methods.
//!
//! Files:
//!
//! - `bulk.rs`: Many curves at once.
//! - `linearised.rs`: The least squares of one strand, linearised: residuals at the samples, and the step of Levenberg and Marquardt's method in linear time.
//! - `measure.rs`: How far a strand is from its samples.
//! - `samples.rs`: The places of a curve that a strand is fitted to, in units of its length.
//! - `search.rs`: Levenberg and Marquardt's method on one strand: what it minimises, and how it is damped.
//! - `shape.rs`: The strand that is sought, in units of its length: root at the origin, total length 1.
//! - `start.rs`: Where the search starts: the curvature of the curve in frames without twist, and the helix that it resembles, an element at a time.
//! - `target.rs`: What a strand is fitted to: the curve's points, checked, in units of its length, and fewer of them where there are very many.

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
use start::{Kind, Nodes};
use target::Target;

/// How to fit.
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
    /// Helical elements of the fitted strand, 1 to [`MAX_ELEMENTS`]; with a tolerance, the most. Default 10.
    pub element_count: usize,
    /// The smallest number of elements for which no point of the curve is farther than this from the strand at equal arclength, m; found by
    /// doubling and halving, so that it keeps the tolerance and one element less does not. Where even [`FitOptions::element_count`] do not keep
    /// it, the fit has that many and its [`Fit::max_error`] says so. Default: none.
    pub tolerance: Option<f64>,
    /// Whether elements may differ in length. Default [`ElementLengths::WhereNeeded`].
    pub lengths: ElementLengths,
    /// The least length of an element in those of equal ones, 0.05 to 1. Default 0.3.
    pub least_length: f64,
    /// Whether elements may be twisted. Without twist (κ0 = 0) the material frames are those carried along the centreline without turning
    /// about it, and elements are arcs of circles; with it there is no more than brings the centreline closer. Default true.
    pub twist: bool,
    /// How many starts are tried at most, 1 to [`MAX_STARTS`]. Default 4.
    pub starts: usize,
    /// A start is good, and the last, when the root mean square distance is below this share of the length; 0 to 1. Default 1e-3.
    /// 0: every start is tried and every search goes on to its end, at ten times the time.
    pub good: f64,
    /// A strand whose largest distance is above this share of the length has it lowered below, or as far as it goes, at the cost of the root mean
    /// square; 0 to 1. Default 0.01. 1: never. With a tolerance that is used in its place.
    pub good_largest: f64,
    /// What the points may be off by, m; 0 or above. Where the curve zigzags by noise its edges add up to more than its length: with this
    /// the length and the arclengths are taken along the means of runs of points that are eight times as long. Default 0. The noise of
    /// curves with arclengths of their own is left as it is.
    pub noise: f64,
    /// Where the curve has frames: how many metres of distance, in units of its length, one radian between the frames is worth; 0 or above.
    /// Default 3e-3.
    pub frame_weight: f64,
}

/// The most starts there are.
pub const MAX_STARTS: usize = start::KINDS.len();

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
    /// The default way to that number of elements.
    pub fn elements(element_count: usize) -> Self {
        Self { element_count, ..Self::default() }
    }

    /// The smallest number of elements up to `most` that keeps a tolerance, m.
    pub fn within(tolerance: f64, most: usize) -> Self {
        Self { element_count: most, tolerance: Some(tolerance), ..Self::default() }
    }

    /// Checks every value; `argument` is the name put before the field in the message, with its dot.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for the first that is out of range.
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

/// Whether a strand's elements may differ in length.
///
/// Free lengths halve the error. A strand steps as fast with them, but [`Solver::sample_tiles`](crate::solver::Solver::sample_tiles) takes
/// strands of equal elements side by side and others one by one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ElementLengths {
    /// All are equally long.
    Equal,
    /// Equally long where that is good ([`FitOptions::good`], or the tolerance), else free.
    #[default]
    WhereNeeded,
    /// Free.
    Free,
}

/// Where a strand's root frame comes from. Its origin is the curve's first point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum FitRoot {
    /// From the curve: its direction is fitted with the rest, beginning with the first edge's; n1 is as near as can be to a world axis that
    /// the edge is far from, or to that of the curve's first frame.
    #[default]
    Curve,
    /// The strand leaves in this direction, of any length above zero: the follicle's. n1 as above.
    Direction(Vector3<f64>),
    /// The root has this frame: the scalp's, for example.
    Frame(UnitQuaternion<f64>),
}

/// A curve to fit a strand to. Splines are made into points first: [`crate::groom::spline`].
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
    /// Points in metres, root first; at least two distinct ones. Doubled points are skipped, with what is given for them below.
    pub points: &'a [Vector3<f64>],
    /// The arclength of each point, m, where it is known better than by the sum of the edges: from 0, ascending.
    pub arclengths: Option<&'a [f64]>,
    /// A material frame at each point, of which n1 counts (the image of the y axis): the strand's frames follow them as well as they can
    /// ([`FitOptions::frame_weight`]). A helix that bends cannot also turn its frame freely.
    pub frames: Option<&'a [UnitQuaternion<f64>]>,
    /// The hair's width at each point, m, 0 or above.
    pub widths: Option<&'a [f64]>,
    /// Where the root frame comes from.
    pub root: FitRoot,
}

impl<'a> FitCurve<'a> {
    /// A polyline and no more.
    pub fn polyline(points: &'a [Vector3<f64>]) -> Self {
        Self { points, arclengths: None, frames: None, widths: None, root: FitRoot::Curve }
    }
}

/// A fitted strand.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Root frame: at the first point.
    pub root: Frame,
    /// Element lengths, m; their sum is the curve's length to rounding.
    pub element_lengths: Vec<f64>,
    /// Curvature rows, rad/m.
    pub curvatures: Vec<[f64; 3]>,
    /// Root mean square of the distance between the curve's points and the centreline at the same arclength, m.
    pub rms_error: f64,
    /// The largest such distance, m.
    pub max_error: f64,
    /// The largest distance of the curve's points from the centreline, wherever on it the nearest place is, m; no more than `max_error`.
    /// Searched for downhill from equal arclength: not below the true distance.
    pub max_distance: f64,
    /// Root mean square of the angle between n1 of the strand and of the curve's frames about the tangent, rad; 0 without frames.
    pub frame_error: f64,
    /// Half the mean width along the curve, m; `None` without widths.
    pub radius: Option<f64>,
}

/// Memory for fitting, used again from strand to strand.
#[derive(Default)]
pub struct FitScratch {
    search: search::Scratch,
    start: start::Scratch,
    target: Target,
    shape: Shape,
    best: Shape,
    /// The samples, those far off with more weight.
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

/// Fits a strand to a curve. The result does not depend on what the scratch was used for before.
///
/// # Errors
/// [`Error::InvalidArgument`] for numbers that are not finite, fewer than two distinct points, lists that do not have one entry a point,
/// arclengths that do not ascend from 0, widths below zero, a direction without length, or options out of range.
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

/// Weight of a strand's own twist, ∫ (κ0 L)² ds against the mean squared distance, both in units of the length: a twist that moves the
/// centreline by less than what it costs is noise, and an element that turns by many radians for nothing cannot bend its axis when it is
/// simulated. The search charges less of it the closer the strand comes, so that exact helices are found exactly.
const TWIST_WEIGHT: f64 = 1e-8;
/// Weight of (ℓ − L/N)² (N/L)², summed over the elements, against the mean squared distance in units of the length: nodes whose place does not
/// matter stay.
const SPACING_WEIGHT: f64 = 1e-8;
/// Iterations from one start, and of the best once more.
const ITERATIONS: [usize; 2] = [30, 60];
/// A search ends when two iterations have gained less of the cost than this each.
const LEAST_GAIN: f64 = 1e-2;
/// The same for those who are content with nothing.
const ITERATIONS_TO_THE_END: [usize; 2] = [100, 500];
const LEAST_GAIN_TO_THE_END: f64 = 1e-5;

/// How often the largest distance is lowered by weighing anew, and the iterations of each search.
const REWEIGHED: usize = 16;
const REWEIGHED_ITERATIONS: usize = 2;

impl FitScratch {
    /// The best of the starts, into `best`; distances in units of the length.
    fn fit(&mut self, count: usize, options: &FitOptions, tolerance: Option<f64>) -> Errors {
        let ([iterations, last_iterations], least_gain) =
            if options.good > 0.0 { (ITERATIONS, LEAST_GAIN) } else { (ITERATIONS_TO_THE_END, LEAST_GAIN_TO_THE_END) };
        let search = Search {
            freedom: Freedom { root: self.target.free_root, twist: options.twist, nodes: false },
            weights: Weights { twist: TWIST_WEIGHT, normal: options.frame_weight.powi(2), spacing: SPACING_WEIGHT },
            iterations,
            least_gain,
            // What is a thousandth of good needs no polish.
            enough: (1e-3 * options.good).powi(2),
            least_length: options.least_length,
        };
        self.target.coarsen(count);
        self.start.look_at(&self.target, count);
        // Of the best: what is left of all that is weighed, and whether its nodes are free.
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
            // So far off that no other start will do.
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

    /// Brings the largest distance of `best`, where [`FitScratch::search`] has just ended, below `good`, or as low as it comes: least squares
    /// again and again, with weights that grow where the strand is far off (Lawson's algorithm; Rice and Usow 1968).
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

/// The starts to try, and whether nodes are free from there.
fn attempts(options: &FitOptions, count: usize, has_normals: bool) -> impl Iterator<Item = (Kind, bool)> {
    let FitOptions { starts, twist, lengths, .. } = *options;
    let free = lengths != ElementLengths::Equal && count > 1;
    let allowed = move |kind: &Kind| !kind.twisted || twist && !has_normals;
    let first = (free && lengths == ElementLengths::WhereNeeded).then_some((Kind { nodes: Nodes::Equal, twisted: false }, false));
    let kinds = start::KINDS.into_iter().filter(move |kind| allowed(kind) && (free || kind.nodes == Nodes::Equal));
    first.into_iter().chain(kinds.take(starts).map(move |kind| (kind, free)))
}
