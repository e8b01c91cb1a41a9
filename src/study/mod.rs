//! Studies on top of the solver: what its settings cost and what they are good for.

pub mod measured;
pub mod presets;
pub mod settings;
pub mod suggestion;
