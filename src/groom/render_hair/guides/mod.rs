//! The guides of render hair at one moment.
//!
//! Files:
//!
//! - `align.rs`: Aligns the bends of guides before they are mixed.
//! - `guide_samples.rs`: Guides at one moment, as points.
//! - `phase.rs`: The phase of a guide's curl: the angle by which its bend has rotated about the guide from point to point.
//! - `pose.rs`: The guides of render hair at one moment.
//! - `shape.rs`: The guides' shapes at one moment, in the form from which strands are mixed.

pub(super) mod align;
pub(super) mod guide_samples;
pub(super) mod phase;
pub(super) mod pose;
pub(super) mod shape;
