//! `superhelix info --suggest`: how many elements the strands of a groom need for their shape.

use serde::Serialize;
use superhelix::editing::{LARGEST_TURN, largest_turn};
use superhelix::hair::{DrawnCurve, FitCurve, FitOptions, FitScratch, fit_curve, fit_polyline};
use superhelix::io::Curves;

use crate::groom::statistics::Spread;

/// Elements at most.
const MAX_COUNT: usize = 100;
/// Strands looked at, evenly spread over the file.
const SAMPLE: usize = 32;

/// Elements that strands need so that no point of the groom is farther from its strand than a tolerance.
#[derive(Debug, Serialize)]
pub struct Suggested {
    /// The tolerance, m.
    pub tolerance_metres: f64,
    /// Metres a file unit that were used.
    pub metres_per_unit: f64,
    /// Strands looked at.
    pub strands: usize,
    /// Elements needed, over those that meet the tolerance.
    pub elements: Option<Spread>,
    /// Strands that a hundred elements do not bring within it.
    pub unmet: usize,
}

impl Suggested {
    /// Fits a sample of the strands. Strands that cannot be fitted (without length) are left out.
    pub fn of(curves: &Curves, tolerance_metres: f64, metres_per_unit: f64) -> Self {
        let every = curves.strand_count().div_ceil(SAMPLE).max(1);
        let (mut needed, mut strands, mut unmet) = (Vec::new(), 0, 0);
        for index in (0..curves.strand_count()).step_by(every) {
            let strand = DrawnCurve::of(curves, index, metres_per_unit);
            if fit_polyline(&strand.points, &FitOptions::elements(1)).is_err() {
                continue;
            }
            strands += 1;
            match least(&strand.fit_curve(), tolerance_metres) {
                Some(count) => needed.push(count as f64),
                None => unmet += 1,
            }
        }
        Self { tolerance_metres, metres_per_unit, strands, elements: Spread::of(needed), unmet }
    }

    /// For people.
    pub fn in_words(&self) -> String {
        let mut text = format!(
            "elements              for {} mm, at {} m a unit, {} strands looked at: ",
            self.tolerance_metres * 1e3,
            self.metres_per_unit,
            self.strands
        );
        text += &match &self.elements {
            Some(Spread { median, p90, max, .. }) => format!("{median} (median), {p90} (90 %), {max} (most)"),
            None => "none will do".into(),
        };
        if self.unmet > 0 {
            text += &format!("; {} strands are not met by {MAX_COUNT}", self.unmet);
        }
        text
    }
}

/// The least number of elements, by doubling and halving.
fn least(curve: &FitCurve<'_>, tolerance: f64) -> Option<usize> {
    let length: f64 = curve.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    let mut scratch = FitScratch::default();
    let mut met = |element_count: usize| {
        let options = FitOptions { good: 0.1 * tolerance / length, ..FitOptions::elements(element_count) };
        fit_curve(curve, &options, &mut scratch).is_ok_and(|fit| {
            let turn = largest_turn(&fit.element_lengths, &fit.curvatures);
            fit.max_error <= tolerance && turn <= LARGEST_TURN
        })
    };
    let (mut low, mut high) = (0, 1);
    while !met(high) {
        if high == MAX_COUNT {
            return None;
        }
        (low, high) = (high, (2 * high).min(MAX_COUNT));
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if met(middle) { high = middle } else { low = middle }
    }
    Some(high)
}
