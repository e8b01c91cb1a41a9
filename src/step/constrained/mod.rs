//! The step of strands that constraints act on, an iteration at a time.
//!
//! Files:
//!
//! - `loads.rs`: The loads of a pack's strands in lanes: those of an element side by side, so that one elimination includes them all.
//! - `pack.rs`: A pack of constrained strands: the work of `super::step` that is the same for all of them, side by side.
//! - `packs.rs`: Packs of constrained strands, in registers of any width.
//! - `single.rs`: A constrained strand that takes its step alone, an iteration at a time.
//! - `step.rs`: The step of one constrained strand, one Newton iteration at a time.
//! - `stretch.rs`: How far a damped iteration of a constrained strand goes along its direction.

pub(super) mod loads;
pub mod pack;
pub mod packs;
pub mod single;
pub mod step;
pub(super) mod stretch;
