//! Cubic curves sampled as points, for grooms given by control points.
//!
//! Each span uses four control points. Points are evenly spaced in the spans' parameter. Their arclengths are the curve's own, by
//! quadrature of its speed, not those of the edges between them.

use nalgebra::Vector3;

use crate::error::{Error, Result, check_finite};

/// The basis of a curve: what its control points mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SplineKind {
    /// Uniform Catmull–Rom: the curve goes through the control points; the first and the last only give the directions at their
    /// neighbours.
    CatmullRom,
    /// Uniform cubic B-spline: the curve passes near the control points.
    BSpline,
    /// Cubic Bézier spans that share their end points: 3 k + 1 control points.
    Bezier,
}

/// How a Catmull–Rom curve or a B-spline ends; Bézier curves always end at their end points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SplineEnds {
    /// One span for every four successive control points, and no more (USD: `nonperiodic`).
    Open,
    /// The curve begins at the first control point and ends at the last: an extra control point continues the curve straight at
    /// each end (USD: `pinned`).
    Pinned,
}

/// A cubic curve over a number of control points.
///
/// ```
/// use superhelix::nalgebra::Vector3;
/// use superhelix::splines::{Spline, SplineEnds, SplineKind};
///
/// let controls: Vec<_> = [0.0, 1.0, 2.0, 3.0].iter().map(|&x| Vector3::new(0.01 * x, 1e-3 * x * x, 0.0)).collect();
/// let spline = Spline::new(SplineKind::CatmullRom, SplineEnds::Pinned, controls.len())?;
/// let (points, arclengths) = spline.points(&controls, 8)?;
/// assert_eq!((points.len(), arclengths.len()), (spline.point_count(8), spline.point_count(8)));
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Spline {
    kind: SplineKind,
    ends: SplineEnds,
    controls: usize,
}

/// The most points per span.
pub const MAX_POINTS_PER_SPAN: usize = 1024;

/// Nodes and weights of the four-point Gauss–Legendre rule on [0, 1].
const RULE: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

impl Spline {
    /// A curve of this basis over `controls` control points.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a number of control points that gives no such curve: it takes at least 4, pinned at least
    /// 2, and for Bézier spans 3 k + 1.
    pub fn new(kind: SplineKind, ends: SplineEnds, controls: usize) -> Result<Self> {
        let expected = match (kind, ends) {
            (SplineKind::Bezier, _) if controls < 4 || controls % 3 != 1 => "3 k + 1 for k spans, at least 4",
            (SplineKind::CatmullRom | SplineKind::BSpline, SplineEnds::Open) if controls < 4 => "at least 4",
            (SplineKind::CatmullRom | SplineKind::BSpline, SplineEnds::Pinned) if controls < 2 => "at least 2",
            _ => return Ok(Self { kind, ends, controls }),
        };
        Err(Error::invalid("controls", format!("{controls} control points"), expected))
    }

    /// Number of spans.
    pub fn spans(&self) -> usize {
        match (self.kind, self.ends) {
            (SplineKind::Bezier, _) => self.controls / 3,
            (_, SplineEnds::Open) => self.controls - 3,
            (_, SplineEnds::Pinned) => self.controls - 1,
        }
    }

    /// How many points [`Spline::points`] makes: `per_span` per span and one more.
    pub fn point_count(&self, per_span: usize) -> usize {
        self.spans() * per_span + 1
    }

    /// Points of the curve and the arclength at each, from 0.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for control points that are not finite or of the wrong number, and for no point per span or
    /// more than [`MAX_POINTS_PER_SPAN`].
    pub fn points(&self, controls: &[Vector3<f64>], per_span: usize) -> Result<(Vec<Vector3<f64>>, Vec<f64>)> {
        self.check(controls.len(), per_span)?;
        for (index, point) in controls.iter().enumerate() {
            for axis in 0..3 {
                check_finite(|| format!("controls[{index}][{axis}]"), point[axis])?;
            }
        }
        let count = self.point_count(per_span);
        let (mut points, mut arclengths): (Vec<Vector3<f64>>, Vec<f64>) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let step = 1.0 / per_span as f64;
        let mut arclength = 0.0;
        for index in 0..count {
            // The last point is the last span's end.
            let span = (index / per_span).min(self.spans() - 1);
            let u = (index - span * per_span) as f64 * step;
            let point = self.sum(span, self.kind.weights(u), |k| self.control(controls, k));
            if let Some(last) = points.last() {
                let (span, u) = ((index - 1) / per_span, ((index - 1) % per_span) as f64 * step);
                let speed = |u: f64| self.sum(span, self.kind.slopes(u), |k| self.control(controls, k)).norm();
                let arc: f64 = RULE.iter().map(|(node, weight)| weight * speed(u + node * step)).sum::<f64>() * step;
                // At a cusp quadrature may fall short of the chord.
                arclength += arc.max((point - last).norm());
            }
            points.push(point);
            arclengths.push(arclength);
        }
        Ok((points, arclengths))
    }

    /// Interpolates numbers given per control point, such as widths, at the same parameters.
    ///
    /// # Errors
    /// As [`Spline::points`].
    pub fn numbers(&self, numbers: &[f64], per_span: usize) -> Result<Vec<f64>> {
        self.check(numbers.len(), per_span)?;
        for (index, number) in numbers.iter().enumerate() {
            check_finite(|| format!("controls[{index}]"), *number)?;
        }
        let place = |index: usize| {
            let span = (index / per_span).min(self.spans() - 1);
            let u = (index - span * per_span) as f64 / per_span as f64;
            self.sum(span, self.kind.weights(u), |k| self.control(numbers, k))
        };
        Ok((0..self.point_count(per_span)).map(place).collect())
    }

    fn check(&self, controls: usize, per_span: usize) -> Result<()> {
        if controls != self.controls {
            return Err(Error::invalid("controls", format!("{controls} control points"), format!("{}", self.controls)));
        }
        if !(1..=MAX_POINTS_PER_SPAN).contains(&per_span) {
            return Err(Error::invalid("per_span", per_span, format!("1 to {MAX_POINTS_PER_SPAN}")));
        }
        Ok(())
    }

    /// Control point `index` of the spans; a pinned curve's begin one before the first.
    fn control<T>(&self, controls: &[T], index: usize) -> T
    where
        T: Copy + std::ops::Sub<Output = T> + std::ops::Add<Output = T>,
    {
        if self.ends == SplineEnds::Open || self.kind == SplineKind::Bezier {
            return controls[index];
        }
        let last = controls.len() - 1;
        match index {
            0 => controls[0] + (controls[0] - controls[1]),
            index if index == last + 2 => controls[last] + (controls[last] - controls[last - 1]),
            index => controls[index - 1],
        }
    }

    /// The sum of a span's four control points with these weights.
    fn sum<T>(&self, span: usize, weights: [f64; 4], control: impl Fn(usize) -> T) -> T
    where
        T: std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T>,
    {
        let first = if self.kind == SplineKind::Bezier { 3 * span } else { span };
        control(first) * weights[0]
            + control(first + 1) * weights[1]
            + control(first + 2) * weights[2]
            + control(first + 3) * weights[3]
    }
}

impl SplineKind {
    /// Weights of the four control points, at u in [0, 1].
    fn weights(self, u: f64) -> [f64; 4] {
        let (v, u2, u3) = (1.0 - u, u * u, u * u * u);
        match self {
            SplineKind::CatmullRom => {
                [0.5 * (2.0 * u2 - u - u3), 0.5 * (2.0 - 5.0 * u2 + 3.0 * u3), 0.5 * (u + 4.0 * u2 - 3.0 * u3), 0.5 * (u3 - u2)]
            }
            SplineKind::BSpline => {
                let sixth = 1.0 / 6.0;
                [v * v * v * sixth, (4.0 - 6.0 * u2 + 3.0 * u3) * sixth, (1.0 + 3.0 * (u + u2 - u3)) * sixth, u3 * sixth]
            }
            SplineKind::Bezier => [v * v * v, 3.0 * u * v * v, 3.0 * u2 * v, u3],
        }
    }

    /// Derivatives of the weights.
    fn slopes(self, u: f64) -> [f64; 4] {
        let (v, u2) = (1.0 - u, u * u);
        match self {
            SplineKind::CatmullRom => [
                0.5 * (4.0 * u - 1.0 - 3.0 * u2),
                0.5 * (9.0 * u2 - 10.0 * u),
                0.5 * (1.0 + 8.0 * u - 9.0 * u2),
                0.5 * (3.0 * u2 - 2.0 * u),
            ],
            SplineKind::BSpline => [-0.5 * v * v, 0.5 * (3.0 * u2 - 4.0 * u), 0.5 * (1.0 + 2.0 * u - 3.0 * u2), 0.5 * u2],
            SplineKind::Bezier => [-3.0 * v * v, 3.0 * v * (v - 2.0 * u), 3.0 * u * (2.0 * v - u), 3.0 * u2],
        }
    }
}
