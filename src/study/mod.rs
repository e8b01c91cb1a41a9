//! Studies on top of the solver: what is asked of strands beside their motion, what a measurement says about them, what settings cost and
//! are good for.

pub mod branch;
mod branch_system;
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
