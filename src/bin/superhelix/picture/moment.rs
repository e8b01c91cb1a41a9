//! One moment of a motion, as it is drawn.

use crate::surfaces::surface::Surface;

/// Strands and bodies, in file units.
#[derive(Debug, Clone)]
pub struct Moment {
    /// What stands above it: a time or a frame number.
    pub label: String,
    /// Points of each strand, root first; the same strands in every moment.
    pub strands: Vec<Vec<[f32; 3]>>,
    /// Bodies among them.
    pub bodies: Vec<Surface>,
}
