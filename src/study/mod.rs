//! Studies on top of the solver: what a measurement says about a strand; what settings cost and what they are good for.

pub mod friction_fit;
pub mod least_squares;
pub mod measured;
pub mod presets;
pub mod recording;
mod replay;
pub mod settings;
pub mod suggestion;
