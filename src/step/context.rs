//! What an integrator works on: strands side by side, what acts on them, where their step is taken, and how it goes.

use super::pack::members::Pack;
use super::workspace::Workspace;
use super::{Setting, StrandOutcome};
use crate::math::lane::MAX_LANES;

/// A step of strands side by side, as the integrators take it.
pub struct StepContext<'a, T, S> {
    /// The strands.
    pub members: &'a dyn Pack,
    /// What acts on them, and how.
    pub setting: &'a Setting<'a>,
    /// Seconds of the step.
    pub h: f64,
    /// Where the step is taken; it ends with the step's end.
    pub workspace: &'a mut Workspace<T>,
    /// The linear solve.
    pub solver: &'a mut S,
    /// How the step goes, by lane.
    pub outcomes: &'a mut [StrandOutcome; MAX_LANES],
}
