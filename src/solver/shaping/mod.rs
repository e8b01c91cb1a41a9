//! Shaping strands by hand: posing, cutting, heat, clips, frozen styles.
//!
//! Files:
//!
//! - `clips.rs`: Clips: hold strands where they are in a box, and move with the box.
//! - `crossing.rs`: Where strands cross a blade or the surface swept by a tooth, and which parts of them are in a box.
//! - `freezing.rs`: Frozen strands: a fixed style.
//! - `heating.rs`: Heat: hair takes on its shape between hot plates or on a hot barrel.
//! - `mirroring.rs`: Adds mirror images of strands.
//! - `posing.rs`: Poses simulated strands: drag a point, brush, change an element (`groom/pose.rs`).
//! - `restyling.rs`: Restyling: takes current shapes as natural shapes, as rest shapes under gravity, or as shapes to return to.
//! - `scissors.rs`: Scissors: cut strands where a blade crosses them.
//! - `trimming.rs`: Cuts simulated strands and lets them grow.

pub mod clips;
pub(super) mod crossing;
pub(super) mod freezing;
pub mod heating;
pub(super) mod mirroring;
pub(super) mod posing;
pub(super) mod restyling;
pub mod scissors;
pub(super) mod trimming;
