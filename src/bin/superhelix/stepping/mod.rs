//! What commands that simulate share: how steps went, strands at rest, strands sampled.
//!
//! Files:
//!
//! - `drawn_inside.rs`: Strands that are drawn inside a body or through each other: how many, how deep, and what becomes of them.
//! - `fitted.rs`: Strands made of a groom: how well they fit, how they rest.
//! - `head.rs`: A head that carries roots: a motion laid onto a groom.
//! - `motion_arguments.rs`: The motion of a head on the command line.
//! - `report.rs`: How the steps of a run went, all together.
//! - `resolution.rs`: Says when helical elements are too long for the curl that they carry.
//! - `sampled_frame.rs`: Strands as a solver has them, sampled for files and pictures.
//! - `settled.rs`: `--settle`: strands that start at rest in their static equilibrium under gravity.

pub mod drawn_inside;
pub mod fitted;
pub mod head;
pub mod motion_arguments;
pub mod report;
pub mod resolution;
pub mod sampled_frame;
pub mod settled;
