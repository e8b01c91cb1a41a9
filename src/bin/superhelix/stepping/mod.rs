//! What commands that simulate share: how steps went, strands at rest, strands sampled.
//!
//! Files:
//!
//! - `report.rs`: How the steps of a run went, all together.
//! - `resolution.rs`: Says when helical elements are too long for the curl that they carry.
//! - `sampled_frame.rs`: Strands as a solver has them, sampled for files and pictures.
//! - `settled.rs`: `--settle`: strands that start at rest in their static equilibrium under gravity.

pub mod report;
pub mod resolution;
pub mod sampled_frame;
pub mod settled;
