//! Render hair.
//!
//! Files:
//!
//! - `render_def.rs`: Definitions of render hair and of its evaluation.
//! - `render_hair.rs`: Render hair: many strands from few guides.

pub mod render_def;
pub mod render_hair;
