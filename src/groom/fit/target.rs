//! The target of a fit: the curve's points, checked, relative to its length, and thinned out where there are very many.

use nalgebra::{UnitQuaternion, Vector3};

use super::samples::Sample;
use super::shape::Root;
use super::{FitCurve, FitOptions, FitRoot};
use crate::error::{Error, Result, check_finite};
use crate::groom::curves::polyline::Polyline;
use crate::math::vector::{Mat3, Vec3};

/// A curve relative to its length, from its first point.
#[derive(Debug, Default)]
pub(super) struct Target {
    /// m.
    pub length: f64,
    pub origin: Vector3<f64>,
    /// The root's initial frame, or its fixed one.
    pub root: Root,
    pub free_root: bool,
    /// The points without repetitions.
    pub samples: Vec<Sample>,
    /// The means of runs of points; empty where the points are few enough.
    means: Vec<Sample>,
    /// m.
    pub radius: Option<f64>,
}

/// Runs of points per element that the search uses.
const RUNS: usize = 12;

impl Target {
    /// Reads a curve.
    pub fn set(&mut self, curve: &FitCurve<'_>, options: &FitOptions) -> Result<()> {
        let points = curve.points.len();
        let entries = |name: &str, count: Option<usize>| match count {
            Some(count) if count != points => {
                Err(Error::invalid(name, format!("{count} entries"), format!("{points}, one per point")))
            }
            _ => Ok(()),
        };
        entries("arclengths", curve.arclengths.map(<[f64]>::len))?;
        entries("frames", curve.frames.map(<[_]>::len))?;
        entries("widths", curve.widths.map(<[f64]>::len))?;
        let mut polyline = Polyline::new(curve.points)?;
        match curve.arclengths {
            Some(arclengths) => polyline.set_arclengths(arclengths)?,
            None if options.noise > 0.0 => polyline.measure_along_runs(8.0 * options.noise),
            None => {}
        }
        self.radius = match curve.widths {
            None => None,
            Some(widths) => Some(0.5 * mean_width(&polyline, widths)?),
        };
        if let Some(frames) = curve.frames
            && let Some(index) = frames.iter().position(|frame| !frame.coords.iter().all(|number| number.is_finite()))
        {
            return Err(Error::invalid(
                format!("frames[{index}]"),
                format!("{:?}", frames[index].coords.as_slice()),
                "finite numbers",
            ));
        }
        let normal = |index: usize| curve.frames.map(|frames| frames[polyline.kept[index]] * Vector3::y());
        self.free_root = curve.root == FitRoot::Curve;
        self.root = Root(Mat3::from(root_rotation(&polyline, &curve.root, normal(0))?.to_rotation_matrix().into_inner()));
        self.length = polyline.length();
        self.origin = polyline.points[0];
        let scale = 1.0 / self.length;
        let last = polyline.points.len() - 1;
        self.samples.clear();
        self.samples.extend((0..=last).map(|index| {
            let (before, after) = (polyline.arclengths[index.saturating_sub(1)], polyline.arclengths[(index + 1).min(last)]);
            Sample {
                arclength: if index == last { 1.0 } else { polyline.arclengths[index] * scale },
                target: Vec3::from((polyline.points[index] - self.origin) * scale),
                weight: 0.5 * (after - before) * scale,
                normal: normal(index).map(Vec3::from),
            }
        }));
        self.means.clear();
        Ok(())
    }

    /// Prepares the search with this many elements.
    pub fn coarsen(&mut self, elements: usize) {
        self.means.clear();
        let runs = RUNS * elements;
        if self.samples.len() <= 2 * runs + 2 {
            return;
        }
        // The two ends stay as they are; their weight is that of half an edge.
        let (first, last) = (self.samples[0], self.samples[self.samples.len() - 1]);
        self.means.push(first);
        let inner = &self.samples[1..self.samples.len() - 1];
        for run in inner.chunk_by(|a, b| (a.arclength * runs as f64).floor() == (b.arclength * runs as f64).floor()) {
            let weight: f64 = run.iter().map(|sample| sample.weight).sum();
            let (mut arclength, mut target) = (0.0, Vec3::zero());
            for sample in run {
                arclength += sample.weight * sample.arclength;
                target += sample.target.scale(sample.weight);
            }
            // A run's middle normal will do.
            let normal = run[run.len() / 2].normal;
            self.means.push(Sample { arclength: arclength / weight, target: target.scale(1.0 / weight), weight, normal });
        }
        self.means.push(last);
    }

    /// The samples that the search uses.
    pub fn coarse(&self) -> &[Sample] {
        if self.means.is_empty() { &self.samples } else { &self.means }
    }

    /// Whether the curve has frames.
    pub fn has_normals(&self) -> bool {
        self.samples[0].normal.is_some()
    }
}

/// The initial rotation of the root's frame, or its fixed one.
fn root_rotation(polyline: &Polyline, root: &FitRoot, normal: Option<Vector3<f64>>) -> Result<UnitQuaternion<f64>> {
    let along = match root {
        FitRoot::Frame(frame) => {
            if !frame.coords.iter().all(|number| number.is_finite()) {
                return Err(Error::invalid("root.frame", format!("{:?}", frame.coords.as_slice()), "finite numbers"));
            }
            return Ok(*frame);
        }
        FitRoot::Curve => polyline.direction(),
        FitRoot::Direction(direction) => {
            for axis in 0..3 {
                check_finite(|| format!("root.direction[{axis}]"), direction[axis])?;
            }
            // Scaled by its largest number first: squares of tiny numbers would vanish.
            let largest = direction.amax();
            if largest == 0.0 {
                return Err(Error::invalid("root.direction", format!("{:?}", direction.as_slice()), "a vector with a length"));
            }
            (direction / largest).normalize()
        }
    };
    Ok(Polyline::frame_along(along, normal))
}

/// The mean of the widths along a polyline.
fn mean_width(polyline: &Polyline, widths: &[f64]) -> Result<f64> {
    for (index, width) in widths.iter().enumerate() {
        check_finite(|| format!("widths[{index}]"), *width)?;
        if *width < 0.0 {
            return Err(Error::invalid(format!("widths[{index}]"), *width, "0 or above"));
        }
    }
    let edges = polyline.arclengths.windows(2).zip(polyline.kept.windows(2));
    let sum: f64 = edges.map(|(ends, kept)| 0.5 * (widths[kept[0]] + widths[kept[1]]) * (ends[1] - ends[0])).sum();
    Ok(sum / polyline.length())
}
