//! Bends, twists and lengthens one element.

use super::StrandShape;
use crate::error::{Error, Result, check_finite, check_positive};

/// A change of one element. Everything beyond it moves along rigidly.
///
/// ```
/// use superhelix::editing::ElementChange;
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 8)])?;
/// let bend = ElementChange { twist: 0.0, bend: [0.3, 0.0], stretch: 1.0, keep_curvature: true };
/// solver.change_elements(&ids, &[3], &[bend])?;
/// assert!(solver.curvatures(ids[0])?[3][1] != 0.0);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElementChange {
    /// Additional twist of the element's end about the strand, rad.
    pub twist: f64,
    /// Additional turn of the element about n1 and n2, rad.
    pub bend: [f64; 2],
    /// Factor on its length; above zero.
    pub stretch: f64,
    /// Whether a longer element keeps its curvatures, so that the helix continues; otherwise it keeps its angles. Additional
    /// twist and bend apply on top, to its new length.
    pub keep_curvature: bool,
}

impl Default for ElementChange {
    fn default() -> Self {
        Self { twist: 0.0, bend: [0.0; 2], stretch: 1.0, keep_curvature: true }
    }
}

impl ElementChange {
    /// Checks every value; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        check_finite(|| format!("{argument}.twist"), self.twist)?;
        check_finite(|| format!("{argument}.bend[0]"), self.bend[0])?;
        check_finite(|| format!("{argument}.bend[1]"), self.bend[1])?;
        check_positive(|| format!("{argument}.stretch"), self.stretch)
    }

    /// The element's new length and curvatures.
    pub(crate) fn applied(&self, length: f64, row: [f64; 3]) -> (f64, [f64; 3]) {
        let new = if self.stretch == 1.0 { length } else { length * self.stretch };
        let keep = if self.keep_curvature || self.stretch == 1.0 { 1.0 } else { 1.0 / self.stretch };
        let more = [self.twist, self.bend[0], self.bend[1]];
        (new, std::array::from_fn(|axis| if more[axis] == 0.0 { keep * row[axis] } else { keep * row[axis] + more[axis] / new }))
    }
}

impl StrandShape {
    /// Bends, twists and lengthens one element; the others keep lengths and curvatures.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a nonexistent element, or values out of range or too large together.
    pub fn change_element(&mut self, element: usize, change: &ElementChange) -> Result<()> {
        self.check("shape")?;
        change.check("change")?;
        if element >= self.curvatures.len() {
            return Err(Error::invalid("element", element, format!("0 to {}", self.curvatures.len() - 1)));
        }
        let (length, row) = change.applied(self.element_lengths[element], self.curvatures[element]);
        check_applied("change", length, &row)?;
        (self.element_lengths[element], self.curvatures[element]) = (length, row);
        Ok(())
    }
}

/// Checks the result of a change.
pub(crate) fn check_applied(argument: &str, length: f64, row: &[f64; 3]) -> Result<()> {
    if !(length.is_normal() && row.iter().all(|value| value.is_finite())) {
        let came = format!("a change to the length {length} m and the curvatures {row:?}");
        return Err(Error::invalid(argument, came, "a length above zero and finite curvatures"));
    }
    Ok(())
}
