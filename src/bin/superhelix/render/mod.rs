//! Render strands: from guides over time to files.
//!
//! Files:
//!
//! - `frames.rs`: Render strands from moments of guides, as curves of files, with velocities where it is known how the guides move.
//! - `guide_frames.rs`: Guides over time: a groom, a directory of frames, or a `.usda` file with time samples.
//! - `output.rs`: Where render strands go: one groom, a directory of frames, or a cache in one file.
//! - `roots.rs`: Where render strands grow: given places, among the guides' roots, or scattered over a scalp, which may deform.
//! - `run.rs`: Render strands of one run: bound to the guides at rest, made from every moment of theirs that is handed over, and written.

pub mod frames;
pub mod guide_frames;
pub mod output;
pub mod roots;
pub mod run;
