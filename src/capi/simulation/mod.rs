//! Solvers: their options, steps and reports, snapshots, settings, wind.
//!
//! Files:
//!
//! - `settings.rs`: Settings by name, and by permitted error.
//! - `solver.rs`: Creates, steps and destroys a solver.
//! - `solver_def.rs`: Definitions of solvers.
//! - `solver_options.rs`: Reads and changes a solver's options.
//! - `state.rs`: Snapshots of a solver's state, and a hash of it.
//! - `step.rs`: Steps, with or without limits, and their reports.
//! - `step_limits.rs`: Limits on the cost of a step.
//! - `suggest.rs`: Suggests a number of elements for a strand.
//! - `summary.rs`: A one-line summary of a solver for the log.
//! - `wind.rs`: Wind as a field.

pub mod settings;
pub mod solver;
pub mod solver_def;
pub mod solver_options;
pub mod state;
pub mod step;
pub mod step_limits;
pub mod suggest;
pub(super) mod summary;
pub mod wind;
