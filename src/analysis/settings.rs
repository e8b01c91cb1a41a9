//! Settings of a solver and of its strands that were chosen for a kind of hair, with what they were measured to err and to cost.

use std::f64::consts::PI;

use crate::analysis::measured;
use crate::error::{Error, Result, check_not_negative, check_positive};
use crate::rod::definition::{MAX_ELEMENTS, StrandDef};
use crate::solver::SHORTEST_STEP;
use crate::step::options::StepOptions;

/// What settings are chosen for.
///
/// ```
/// use superhelix::StrandDef;
/// use superhelix::settings::{HairShape, Preset};
///
/// let hair = HairShape::of(&StrandDef::straight(0.2, 1));
/// let settings = Preset::Balanced.settings(&hair, 1.0 / 30.0)?;
/// assert!(settings.substeps >= 1);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HairShape {
    /// Natural curvature and twist together, √(κ0² + κ1² + κ2²), rad/m, the largest along the strand; zero or above. A curl of radius r
    /// and step Δ has 1/√(r² + (Δ/2π)²).
    pub curvature: f64,
    /// Length, m; above zero.
    pub length: f64,
}

impl HairShape {
    /// Of a strand, by its natural curvatures. Where these are there to make up for gravity (`groom::fit::natural_under_gravity`) give the
    /// curvature of the shape that was drawn instead.
    pub fn of(strand: &StrandDef) -> Self {
        let curvature = strand.natural.iter().map(|[k0, k1, k2]| k0.hypot(*k1).hypot(*k2)).fold(0.0, f64::max);
        Self { curvature, length: strand.length() }
    }

    /// Turns that the strand makes about the axis of its curl.
    pub fn turns(&self) -> f64 {
        self.curvature * self.length / (2.0 * PI)
    }

    /// Checks both values.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming `curvature` or `length`.
    pub fn check(&self) -> Result<()> {
        check_not_negative(|| "curvature".into(), self.curvature)?;
        check_positive(|| "length".into(), self.length)
    }

    /// Which of the measured types stands for it: the least curled that is no less curled.
    pub(super) fn measured_type(&self) -> Option<usize> {
        // The curls of real hair are known to a few per cent at best.
        measured::CURVATURES.iter().position(|measured| self.curvature <= measured + 1.0)
    }
}

/// How to step and how fine, with what that was measured to err and to cost (`docs/notebook/tradeoff.md`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// For [`SolverOptions::step`](crate::solver::definition::SolverOptions::step).
    pub step: StepOptions,
    /// Substeps of a frame: for [`Solver::step`](crate::solver::Solver::step), or frames of a root to give a frame.
    pub substeps: u32,
    /// Elements of a strand.
    pub elements: u32,
    /// Root mean square distance of the strand's points from where they should be, in units of its length, over two seconds in the worst of
    /// the measured scenes; `None`: hair of that kind was not measured.
    pub error: Option<f64>,
    /// Processor time a strand and simulated second in the dearest of them, µs, one thread, on the machine of `docs/notebook/tradeoff.md`;
    /// `None`: not measured.
    pub cost: Option<f64>,
}

/// Substeps of a frame of `frame_time` seconds, none longer than `longest` seconds.
pub(super) fn substeps(frame_time: f64, longest: f64) -> Result<u32> {
    check_positive(|| "frame_time".into(), frame_time)?;
    // A frame of a thirtieth of a second is one step of a thirtieth, however either was rounded.
    let substeps = (frame_time / longest * (1.0 - 1e-9)).ceil().max(1.0);
    if substeps > f64::from(u32::MAX) || frame_time / substeps < SHORTEST_STEP {
        let expected = format!("{SHORTEST_STEP} s to {} s", longest * f64::from(u32::MAX));
        return Err(Error::invalid("frame_time", frame_time, expected));
    }
    Ok(substeps as u32)
}

/// A number of elements that a strand may have.
pub(super) fn elements(hair: &HairShape, count: f64) -> Result<u32> {
    if count > MAX_ELEMENTS as f64 {
        let turns = format!("a curl for which {MAX_ELEMENTS} elements do: this one makes {} turns", hair.turns());
        return Err(Error::invalid("length", hair.length, turns));
    }
    Ok(count as u32)
}
