//! Studies: what is asked of strands beside their motion, on top of the engine.

pub mod branch;
mod branch_system;
pub mod elements;
