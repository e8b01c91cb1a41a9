//! From measured and modelled hair to strands.
pub mod fit;
