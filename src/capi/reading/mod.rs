//! Samples of strands, wrenches, and debug drawing.
//!
//! Files:
//!
//! - `debug_draw.rs`: Debug drawing by callback.
//! - `output_transform.rs`: Output transforms from the engine's space to the host's: other units, other axes, mirrored.
//! - `sample_outputs.rs`: Sample outputs in the caller's memory: points, frames, velocities.
//! - `sampling.rs`: Samples strands: points, frames, velocities, and wrenches on follicles.
//! - `wrenches.rs`: Writes wrenches on follicles and bodies to the caller's memory.

pub mod debug_draw;
pub(super) mod output_transform;
pub(super) mod sample_outputs;
pub mod sampling;
pub(super) mod wrenches;
