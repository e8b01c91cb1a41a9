//! One element bent, twisted, lengthened.

use super::StrandShape;
use crate::error::{Error, Result, check_finite, check_positive};

/// A change of one element. What lies beyond it goes along as it is.
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
    /// By how much more the element's end is twisted about the strand, rad.
    pub twist: f64,
    /// By how much more the element turns about n1 and n2, rad.
    pub bend: [f64; 2],
    /// Factor on its length; above zero.
    pub stretch: f64,
    /// Whether a longer element keeps its curvatures, so that the helix goes on; otherwise it keeps the angles that it turns by. What it is
    /// twisted and bent by comes on top, on its new length.
    pub keep_curvature: bool,
}

impl Default for ElementChange {
    fn default() -> Self {
        Self { twist: 0.0, bend: [0.0; 2], stretch: 1.0, keep_curvature: true }
    }
}

impl ElementChange {
    /// Checks every value; `argument` is the name put before the field in the message.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        check_finite(|| format!("{argument}.twist"), self.twist)?;
        check_finite(|| format!("{argument}.bend[0]"), self.bend[0])?;
        check_finite(|| format!("{argument}.bend[1]"), self.bend[1])?;
        check_positive(|| format!("{argument}.stretch"), self.stretch)
    }

    /// The element's length and curvatures after it, from those before.
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
    /// [`Error::InvalidArgument`] for an element that there is not, or values out of range or too large together.
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

/// Checks what came out of a change.
pub(crate) fn check_applied(argument: &str, length: f64, row: &[f64; 3]) -> Result<()> {
    if !(length.is_normal() && row.iter().all(|value| value.is_finite())) {
        let came = format!("a change to the length {length} m and the curvatures {row:?}");
        return Err(Error::invalid(argument, came, "a length above zero and finite curvatures"));
    }
    Ok(())
}
