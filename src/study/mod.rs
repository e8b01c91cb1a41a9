//! Studies on top of the solver: what a measurement says about a strand.

pub mod friction_fit;
pub mod least_squares;
pub mod recording;
mod replay;
