//! Analysis of strands, on top of the solver: settings by error, elements by need, friction from recordings, combing force, equilibria that
//! buckle.
//!
//! Files:
//!
//! - `branch.rs`: Follows a static equilibrium of one strand while its load changes: a stronger weight, a turning clamp.
//! - `combing.rs`: A standard combing experiment: force against stroke.
//! - `elements.rs`: How many elements a strand needs for a tolerance in metres.
//! - `friction_fit.rs`: Friction coefficients from a recorded motion, as Bertails et al. 2006 choose them (section 4.2).
//! - `least_squares.rs`: Least squares in a few parameters between bounds, where each evaluation is dear: Levenberg's and Marquardt's method with central differences.
//! - `measured.rs`: Errors and costs as `make tradeoff` measured them; made by it from docs/figures/tradeoff.csv.
//! - `presets.rs`: Settings by name, for those who do not want to choose: `docs/notebook/tradeoff.md` says what they were distilled from.
//! - `recording.rs`: What was recorded of a strand: a number over time, what it is a measure of, and how the root moved meanwhile.
//! - `replay.rs`: A recording taken again by the solver: the same root motion, the same times, for several materials at once.
//! - `settings.rs`: Settings of a solver and of its strands that were chosen for a kind of hair, with what they were measured to err and to cost.
//! - `suggestion.rs`: From an error that may be made to the cheapest settings that were measured to make no more.

pub mod branch;
pub mod combing;
pub mod elements;
pub mod friction_fit;
pub mod least_squares;
pub mod measured;
pub mod presets;
pub mod recording;
mod replay;
pub mod settings;
pub mod suggestion;
