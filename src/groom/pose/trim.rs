//! Cuts strands and lets them grow.

use super::StrandShape;
use crate::error::{Error, Result, check_finite, check_positive};
use crate::rod::definition::MAX_ELEMENTS;

/// How a strand grows at its tip.
///
/// ```
/// use superhelix::editing::Growth;
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 8)])?;
/// solver.grow(&ids, &Growth { length: 0.05, elements: 2, curvatures: None })?;
/// assert!((solver.length(ids[0])? - 0.25).abs() < 1e-12);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// By how much, m; above zero.
    pub length: f64,
    /// How many elements to add, all equal. 0 lengthens the last one.
    pub elements: usize,
    /// Curvatures of the added elements, rad/m; `None` for those of the last one, so that the helix continues. Not for 0
    /// elements.
    pub curvatures: Option<[f64; 3]>,
}

impl Growth {
    /// Checks every value for a strand of `count` elements; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str, count: usize) -> Result<()> {
        check_positive(|| format!("{argument}.length"), self.length)?;
        if self.elements > MAX_ELEMENTS - count {
            let expected = format!("0 to {}: a strand has at most {MAX_ELEMENTS}", MAX_ELEMENTS - count);
            return Err(Error::invalid(format!("{argument}.elements"), self.elements, expected));
        }
        if let Some(row) = &self.curvatures {
            if self.elements == 0 {
                let expected = "none, since the last element continues (elements is 0)";
                return Err(Error::invalid(format!("{argument}.curvatures"), format!("{row:?}"), expected));
            }
            (0..3).try_for_each(|axis| check_finite(|| format!("{argument}.curvatures[{axis}]"), row[axis]))?;
        }
        if self.elements > 0 && !(self.length / self.elements as f64).is_normal() {
            return Err(Error::invalid(format!("{argument}.length"), self.length, "more: the elements would have no length"));
        }
        Ok(())
    }

    /// Lengths after the growth.
    pub(crate) fn lengths(&self, lengths: &[f64]) -> Vec<f64> {
        let mut out = lengths.to_vec();
        match (self.elements, out.last_mut()) {
            (0, Some(last)) => *last += self.length,
            (count, _) => out.resize(lengths.len() + count, self.length / count as f64),
        }
        out
    }

    /// Rows after the growth.
    pub(crate) fn rows(&self, rows: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut out = rows.to_vec();
        let last = rows.last().copied().unwrap_or_default();
        out.resize(rows.len() + self.elements, self.curvatures.unwrap_or(last));
        out
    }
}

/// A cut closer to an element's end than this fraction of its length is at that end.
const SLIVER: f64 = 1e-12;

/// The remaining lengths of elements cut at an arclength, which is above zero and at most their sum.
pub(crate) fn cut_lengths(lengths: &[f64], arclength: f64) -> Vec<f64> {
    let mut rest = arclength;
    let mut out = Vec::new();
    for length in lengths {
        if rest >= length * (1.0 - SLIVER) {
            out.push(*length);
            rest = (rest - length).max(0.0);
        } else {
            // A sliver is dropped, unless it is the only element.
            if rest > SLIVER * length || out.is_empty() {
                out.push(rest);
            }
            break;
        }
    }
    out
}

impl StrandShape {
    /// Cuts the strand at an arclength from the root (m); the rest keeps its shape exactly. The cut element becomes shorter, with
    /// the same helix. Returns how many elements remain. Cutting at the strand's length changes nothing.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an invalid shape or an arclength that is not above zero and at most the length.
    pub fn cut(&mut self, arclength: f64) -> Result<usize> {
        self.check("shape")?;
        check_cut("arclength", arclength, self.length(), "the strand")?;
        self.element_lengths = cut_lengths(&self.element_lengths, arclength);
        self.curvatures.truncate(self.element_lengths.len());
        Ok(self.element_lengths.len())
    }

    /// Lets the strand grow at its tip; the existing part keeps its shape.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an invalid shape or a growth out of range.
    pub fn grow(&mut self, growth: &Growth) -> Result<()> {
        self.check("shape")?;
        growth.check("growth", self.curvatures.len())?;
        self.element_lengths = growth.lengths(&self.element_lengths);
        self.curvatures = growth.rows(&self.curvatures);
        Ok(())
    }
}

/// Checks an arclength for a cut of a strand of this length; `strand` is its name in the error.
pub(crate) fn check_cut(argument: &str, arclength: f64, length: f64, strand: impl std::fmt::Display) -> Result<()> {
    if arclength > 0.0 && arclength <= length * (1.0 + 1e-9) {
        return Ok(());
    }
    Err(Error::invalid(argument, arclength, format!("above zero, at most {length} m, the length of {strand}")))
}
