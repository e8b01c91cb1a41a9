//! Studies on top of the solver: what is asked of strands beside their motion, and what a measurement says about them.

pub mod branch;
mod branch_system;
pub mod elements;
pub mod friction_fit;
pub mod least_squares;
pub mod recording;
mod replay;
