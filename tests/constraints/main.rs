//! Bilateral constraints: points, tangents, frames, ties, loops and rings.

mod contradicting_constraints;
mod moving_targets;
#[path = "../numbers/mod.rs"]
mod numbers;
mod pins_clamps_rings;
