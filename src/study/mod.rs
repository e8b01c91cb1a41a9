//! Studies on top of the solver: what its settings cost and what they are good for.

pub mod presets;
