//! Memory of a search of a strand and a body, kept from call to call.

use crate::contact::narrow_phase::descent::Sample;
use crate::contact::narrow_phase::ground::Node;
use crate::contact::shape::{Ball, Patch, Region, Surface};

/// Lists that are used again from call to call.
#[derive(Debug, Clone, Default)]
pub struct BodySearchScratch {
    /// By body and element.
    pub(super) regions: Vec<(u32, Vec<Region>)>,
    pub(super) patch: Patch,
    pub(super) nodes: Vec<Node>,
    pub(super) hits: Vec<(f64, Surface)>,
    pub(super) pieces: Vec<Piece>,
    pub(super) close: Vec<Ball>,
    pub(super) more: Vec<Sample<Surface>>,
}

/// A piece between two places, with what was found there, if the surface is near there, and how often it was halved.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) ends: [f64; 2],
    pub(super) samples: [Option<Sample<Surface>>; 2],
    pub(super) depth: usize,
}

impl BodySearchScratch {
    /// What is known of a mesh about an element.
    pub(super) fn region(&mut self, body: u32, element: usize) -> &mut Region {
        let place = match self.regions.iter().position(|(of, _)| *of == body) {
            Some(place) => place,
            None => {
                self.regions.push((body, Vec::new()));
                self.regions.len() - 1
            }
        };
        let regions = &mut self.regions[place].1;
        if regions.len() <= element {
            regions.resize_with(element + 1, Region::default);
        }
        &mut regions[element]
    }
}
