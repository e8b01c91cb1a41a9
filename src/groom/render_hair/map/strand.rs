//! A render strand in the map: the guides that it follows, and how.

use crate::groom::render_hair::settings::MAX_GUIDES;

/// The data for mixing positions.
#[derive(Debug, Clone, Copy)]
pub(in crate::groom::render_hair) struct RenderStrand {
    /// The guides that it follows, nearest first; entries beyond the last repeat the first, with weight 0.
    pub guides: [u32; MAX_GUIDES],
    /// Weights; their sum is 1.
    pub weights: [f32; MAX_GUIDES],
    /// Its root relative to each guide's, in the frame of that guide's follicle, m.
    pub roots: [[f32; 3]; MAX_GUIDES],
    /// Its wisp's middle along n1 and n2 of the first guide, m.
    pub middle: [f32; 2],
    /// Its root from there.
    pub offset: [f32; 2],
    /// How far it blends into its wisp, and the reciprocal of where along it that is complete.
    pub gather: [f32; 2],
    /// The index of its random curve, and the curve's rotation and scale, m.
    pub frizz: u32,
    pub frizz_turn: [f32; 2],
    /// The same for its wisp.
    pub clump: u32,
    pub clump_turn: [f32; 2],
    /// Factor on the radius.
    pub radius: f32,
    /// The fraction of its length that remains.
    pub length: f32,
    /// Its wisp among the first guide's.
    pub wisp: u32,
}

/// The data for mixing curvatures, in addition.
#[derive(Debug, Clone, Copy)]
pub(in crate::groom::render_hair) struct RenderCurl {
    /// The rotation of each guide's frame on its first edge about that edge, and of its bends with it, before mixing: cosine and
    /// sine.
    pub turns: [[f32; 2]; MAX_GUIDES],
    /// Cosine and sine of half of that.
    pub halves: [[f32; 2]; MAX_GUIDES],
    /// Whether the bends are mixed with the curls' phases removed.
    pub curled: bool,
}
