//! One view of one moment, in the manner asked for.

use clap::ValueEnum;
use tiny_skia::Pixmap;

use super::colour::{self, Colour};
use super::framing::Framing;
use super::lines;
use super::lit::{self, HairColour, Look};
use super::moment::Moment;

/// How strands are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Manner {
    /// As hair, lit, with its shadows.
    Hair,
    /// As lines coloured by their roots.
    Lines,
}

/// What cells are drawn with: the same for all moments.
#[derive(Debug, Clone)]
pub enum Pen {
    /// As hair.
    Hair(Look),
    /// As lines, each strand with its colour.
    Lines(Vec<Colour>),
}

impl Pen {
    /// Made by the first moment; `framing` has at least one view.
    pub fn new(manner: Manner, hair: HairColour, first: &Moment, framing: &Framing) -> Self {
        let view = &framing.views[0].0;
        match manner {
            Manner::Hair => Pen::Hair(Look::fitting(hair, first, view)),
            Manner::Lines => {
                let roots: Vec<[f32; 3]> = first.strands.iter().map(|strand| view.look(strand[0])).collect();
                Pen::Lines(colour::by_root(&roots))
            }
        }
    }

    /// Draws view number `view` of a moment; none where a picture of that size cannot be had.
    pub fn draw(&self, moment: &Moment, framing: &Framing, view: usize) -> Option<Pixmap> {
        let (window, looking) = (framing.window(view, moment), &framing.views[view].0);
        match self {
            Pen::Hair(look) => lit::draw(moment, looking, &window, look),
            Pen::Lines(colours) => lines::draw(moment, looking, &window, colours),
        }
    }
}
