//! Points of rational B-splines of any order, by de Boor's algorithm.

use nalgebra::Vector3;

use crate::error::{Error, Result};

/// The highest order (degree plus one) that is supported.
pub const MAX_ORDER: usize = 16;

/// A rational B-spline: order, knots and weights.
#[derive(Debug, Clone, Copy)]
pub struct Nurbs<'a> {
    order: usize,
    knots: &'a [f64],
    weights: Option<&'a [f64]>,
    controls: usize,
}

impl<'a> Nurbs<'a> {
    /// A curve over `controls` control points; `weights` has one per control point, or is absent where all are equal.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an order below 2, above 16 or above the number of control points; for knots that descend,
    /// leave the curve no parameter, or do not number as many as control points plus order; for weights that are not above zero
    /// or not one per control point.
    pub fn new(order: usize, knots: &'a [f64], weights: Option<&'a [f64]>, controls: usize) -> Result<Self> {
        if !(2..=MAX_ORDER).contains(&order) || order > controls {
            return Err(Error::invalid("order", order, format!("2 to {MAX_ORDER}, and at most {controls}, the control points")));
        }
        if knots.len() != controls + order {
            let expected = format!("{}, one per control point and as many more as the order", controls + order);
            return Err(Error::invalid("knots", format!("{} knots", knots.len()), expected));
        }
        if let Some(index) = knots.windows(2).position(|pair| !(pair[0] <= pair[1] && pair[1].is_finite() && pair[0].is_finite()))
        {
            return Err(Error::invalid(format!("knots[{}]", index + 1), knots[index + 1], "finite numbers that do not descend"));
        }
        if knots[order - 1] >= knots[controls] {
            return Err(Error::invalid("knots", format!("{} twice", knots[controls]), "a curve between the inner knots"));
        }
        if let Some(weights) = weights {
            if weights.len() != controls {
                return Err(Error::invalid("weights", format!("{} weights", weights.len()), format!("{controls}")));
            }
            if let Some(index) = weights.iter().position(|weight| !(*weight > 0.0 && weight.is_finite())) {
                return Err(Error::invalid(format!("weights[{index}]"), weights[index], "a finite number above zero"));
            }
        }
        Ok(Self { order, knots, weights, controls })
    }

    /// The parameters at which to evaluate the curve with [`Nurbs::at`]: `per_span` in every span of nonzero length, evenly
    /// spaced, and the end. A span's number is that of its last knot.
    pub fn parameters(&self, per_span: usize) -> Vec<(usize, f64)> {
        let spans = (self.order - 1..self.controls).filter(|span| self.knots[*span] < self.knots[span + 1]);
        let mut places = Vec::new();
        let mut last = (self.order - 1, self.knots[self.order - 1]);
        for span in spans {
            let (begin, end) = (self.knots[span], self.knots[span + 1]);
            places.extend((0..per_span).map(|step| (span, begin + (end - begin) * (step as f64 / per_span as f64))));
            last = (span, end);
        }
        places.push(last);
        places
    }

    /// The curve at a parameter of a span, both from [`Nurbs::parameters`]. `control` returns control points by number.
    pub fn at(&self, (span, parameter): (usize, f64), control: impl Fn(usize) -> Vector3<f64>) -> Vector3<f64> {
        let degree = self.order - 1;
        let mut points = [(Vector3::zeros(), 0.0); MAX_ORDER];
        for (index, point) in points.iter_mut().enumerate().take(self.order) {
            let number = span - degree + index;
            let weight = self.weights.map_or(1.0, |weights| weights[number]);
            *point = (control(number) * weight, weight);
        }
        for level in 1..=degree {
            for index in (level..=degree).rev() {
                let begin = self.knots[span - degree + index];
                let end = self.knots[span + 1 + index - level];
                let fraction = if end > begin { (parameter - begin) / (end - begin) } else { 0.0 };
                let (before, after) = (points[index - 1], points[index]);
                points[index] = (before.0 + (after.0 - before.0) * fraction, before.1 + (after.1 - before.1) * fraction);
            }
        }
        points[degree].0 / points[degree].1
    }
}
