//! The points of render strands, mixed from their guides.
//!
//! Files:
//!
//! - `bodies.rs`: Keeps render strands out of bodies: points that are too close move out along the distance field.
//! - `curvature.rs`: Strands mixed from their guides' lengths and bends: integrated from root to tip, sixteen strands side by side.
//! - `evaluate.rs`: Evaluates the strands' points, in tiles and with many threads.
//! - `frames.rs`: Material frames along a strand, from its points.
//! - `lengths.rs`: Restores the lengths of render strands: moves points along their path to their target arclengths.
//! - `own_shapes.rs`: The own shapes of strands: what each is at rest beside what its guides make of it, kept in the frames of its first guide.
//! - `position.rs`: Strands mixed from their guides' positions, and blended into their wisps.
//! - `profile.rs`: Profiles along a strand that do not depend on the guides.
//! - `quaternion.rs`: Quaternions of frames in f32.
//! - `reach.rs`: The distance around a guide within which no body lies: it spares most of a groom's points further checks.
//! - `silhouette.rs`: Moves strands of mixed curvatures to where mixed positions lead.

pub(super) mod bodies;
pub(super) mod curvature;
pub(super) mod evaluate;
pub(super) mod frames;
pub(super) mod lengths;
pub mod own_shapes;
pub(super) mod position;
pub(super) mod profile;
pub(super) mod quaternion;
pub(super) mod reach;
pub(super) mod silhouette;
