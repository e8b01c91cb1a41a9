//! A render strand as the map has it: whom it follows, and how.

use super::settings::MOST_GUIDES;

/// What positions are mixed from.
#[derive(Debug, Clone, Copy)]
pub(super) struct RenderStrand {
    /// The guides that it follows, the nearest first; places beyond the last repeat the first, with weight 0.
    pub guides: [u32; MOST_GUIDES],
    /// Weights; their sum is 1.
    pub weights: [f32; MOST_GUIDES],
    /// Its root from each guide's, in the frame of that guide's follicle, m.
    pub roots: [[f32; 3]; MOST_GUIDES],
    /// Its wisp's middle along n1 and n2 of the first guide, m.
    pub middle: [f32; 2],
    /// Its root from there.
    pub offset: [f32; 2],
    /// How far it goes over to its wisp, and one over where on its way it has done so.
    pub gather: [f32; 2],
    /// Which curve it strays along, and how that is turned and scaled, m.
    pub frizz: u32,
    pub frizz_turn: [f32; 2],
    /// The same of its wisp.
    pub clump: u32,
    pub clump_turn: [f32; 2],
    /// Factor on the radius.
    pub radius: f32,
    /// How much of its length it has.
    pub length: f32,
    /// Which of the first guide's wisps it belongs to.
    pub wisp: u32,
}

/// What curvatures are mixed by, beside that.
#[derive(Debug, Clone, Copy)]
pub(super) struct RenderCurl {
    /// How each guide's frame on its first edge is turned about that edge, and its bends with it, before they are mixed: cosine and sine.
    pub turns: [[f32; 2]; MOST_GUIDES],
    /// Cosine and sine of half of that.
    pub halves: [[f32; 2]; MOST_GUIDES],
    /// Whether the bends are mixed with the curls' phases taken off.
    pub curled: bool,
}
