//! Strands cut into pieces that bend little, each represented by its chord: the input of the search for pairs.

use std::ops::Range;

use nalgebra::Vector3;

use crate::contact::contact_point::StrandCurve;
use crate::error::{Result, check_not_negative};
use crate::workers::WorkerSet;

/// The number of tasks that place pieces, whatever the threads.
const PARTS: usize = 32;

/// Contact properties of a strand towards other strands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wisp {
    /// Contact radius, m, zero or above: that of the wisp of hair for which the strand stands. 0: meets no strand.
    pub radius: f64,
    /// Arclength from the root that meets no strand, m, zero or above (near the follicles strands may stand closer than their radii).
    pub exempt: f64,
    /// Bits of the groups it is in.
    pub group: u32,
    /// Bits of the groups it meets. Two strands meet where each one's group has a bit of the other's mask.
    pub mask: u32,
    /// Whether it meets itself: elements with at least one other between them, half a turn of its own radius apart or more.
    pub meets_itself: bool,
}

impl Default for Wisp {
    fn default() -> Self {
        Self { radius: 0.0, exempt: 0.0, group: 1, mask: u32::MAX, meets_itself: false }
    }
}

impl Wisp {
    /// Checks the numbers; `name` goes before the field's in the error.
    ///
    /// # Errors
    /// [`crate::error::Error::InvalidArgument`] for a radius or an exempt length that is negative or not finite.
    pub fn check(&self, name: impl Fn() -> String) -> Result<()> {
        check_not_negative(|| format!("{}.radius", name()), self.radius)?;
        check_not_negative(|| format!("{}.exempt", name()), self.exempt)
    }

    pub(in crate::contact) fn meets(&self, other: &Wisp) -> bool {
        self.group & other.mask != 0 && other.group & self.mask != 0
    }
}

/// A piece bends by at most this, rad: two such arcs have one closest pair, unless they lie along each other.
const MAX_BEND: f64 = 0.5;
/// A piece less than this fraction of the contact radius off its chord may bend by more.
const FINE: f64 = 0.05;

/// A piece of an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Its strand.
    pub strand: u32,
    /// Its element.
    pub element: u32,
    /// Arclength of its ends from the element's left end, m.
    pub s: [f64; 2],
    /// Arclength from the root to its first end, m.
    pub along: f64,
    /// The node at its first end; the next node is at its other end.
    pub node: u32,
    /// Whether a piece of the same strand follows at either end.
    pub continued: [bool; 2],
}

/// The pieces of strands.
#[derive(Debug, Default)]
pub struct Pieces {
    /// From strand to strand, root to tip.
    pub pieces: Vec<Piece>,
    /// Number of nodes: a strand has one more than pieces, and none without pieces.
    pub nodes: usize,
}

/// Curvature of an element's centreline, 1/m.
fn bend(curve: &StrandCurve, element: usize) -> f64 {
    let [_, k1, k2] = curve.elements[element].kappa.0;
    (k1 * k1 + k2 * k2).sqrt()
}

/// Number of pieces of a length of an element.
fn pieces_of(bend: f64, length: f64, radius: f64) -> usize {
    let loose = FINE * radius;
    if bend * loose >= 2.0 {
        // A coil so tight that the whole of it is as good as its axis.
        return 1;
    }
    let by_bend = bend * length / MAX_BEND;
    let by_sagitta = length * (bend / (8.0 * loose)).sqrt();
    (by_bend.min(by_sagitta).ceil() as usize).max(1)
}

impl Pieces {
    /// Cuts the strands, bent as in `curve`.
    pub fn cut<'a>(&mut self, wisps: &[Wisp], curve: impl Fn(usize) -> StrandCurve<'a>) {
        self.pieces.clear();
        self.nodes = 0;
        for (strand, wisp) in wisps.iter().enumerate().filter(|(_, wisp)| wisp.radius > 0.0) {
            let curve = curve(strand);
            let first = self.pieces.len();
            let mut along = 0.0;
            for (index, element) in curve.elements.iter().enumerate() {
                let begin = (wisp.exempt - along).max(0.0);
                if begin < element.length {
                    let left = element.length - begin;
                    let count = pieces_of(bend(&curve, index), left, wisp.radius);
                    let at = |k: usize| if k == count { element.length } else { begin + left * k as f64 / count as f64 };
                    for k in 0..count {
                        self.pieces.push(Piece {
                            strand: strand as u32,
                            element: index as u32,
                            s: [at(k), at(k + 1)],
                            along: along + at(k),
                            node: self.nodes as u32,
                            continued: [self.pieces.len() > first, true],
                        });
                        self.nodes += 1;
                    }
                }
                along += element.length;
            }
            if let Some(last) = self.pieces[first..].last_mut() {
                last.continued[1] = false;
                self.nodes += 1;
            }
        }
    }

    /// Goes on from where all pieces up to `index` are passed to where the next element begins.
    fn next_element(&self, index: usize) -> usize {
        let same = |a: &Piece, b: &Piece| (a.strand, a.element) == (b.strand, b.element);
        let mut next = index.min(self.pieces.len());
        while next > 0 && next < self.pieces.len() && same(&self.pieces[next - 1], &self.pieces[next]) {
            next += 1;
        }
        next
    }

    /// The positions of all nodes, and the distance of each piece from its chord, for these curves.
    pub(crate) fn place<'a, S: Default + Send>(
        &self,
        wisps: &[Wisp],
        curve: impl Fn(usize) -> StrandCurve<'a> + Sync,
        workers: &WorkerSet<S>,
        parts: &mut Vec<PlacedPieces>,
        placed: &mut PlacedPieces,
    ) {
        parts.resize_with(PARTS, PlacedPieces::default);
        for (k, part) in parts.iter_mut().enumerate() {
            let at = |k: usize| self.next_element(self.pieces.len() * k / PARTS);
            part.pieces = at(k)..at(k + 1);
        }
        workers.for_each_task(parts, 1, 1, |parts, _| {
            for part in parts {
                part.place(self, wisps, &curve);
            }
        });
        placed.clear();
        for part in parts {
            placed.nodes.extend_from_slice(&part.nodes);
            placed.sagittas.extend_from_slice(&part.sagittas);
            placed.outgrown |= part.outgrown;
        }
    }
}

/// The positions of pieces.
#[derive(Debug, Default)]
pub struct PlacedPieces {
    pieces: Range<usize>,
    /// Where the nodes are, m.
    pub nodes: Vec<Vector3<f64>>,
    /// How far each piece is off its chord, at most, m: Ωs²/8, and never more than across its circle.
    pub sagittas: Vec<f64>,
    /// Whether some element is bent so much more than when it was cut that it needs more than twice its pieces.
    pub outgrown: bool,
}

impl PlacedPieces {
    fn clear(&mut self) {
        self.nodes.clear();
        self.sagittas.clear();
        self.outgrown = false;
    }

    fn place<'a>(&mut self, all: &Pieces, wisps: &[Wisp], curve: &impl Fn(usize) -> StrandCurve<'a>) {
        self.clear();
        let mut elements = all.pieces[self.pieces.clone()].chunk_by(|a, b| (a.strand, a.element) == (b.strand, b.element));
        for pieces in &mut elements {
            let (strand, element) = (pieces[0].strand as usize, pieces[0].element as usize);
            let curve = curve(strand);
            let bend = bend(&curve, element);
            let length = pieces[pieces.len() - 1].s[1] - pieces[0].s[0];
            self.outgrown |= pieces_of(bend, length, wisps[strand].radius) > 2 * pieces.len();
            for piece in pieces {
                let at_left_end = piece.s[0] == 0.0;
                self.nodes.push(if at_left_end { curve.left_end(element) } else { curve.position(element, piece.s[0]) });
                if !piece.continued[1] {
                    self.nodes.push(curve.position(element, piece.s[1]));
                }
                let length = piece.s[1] - piece.s[0];
                self.sagittas.push((0.125 * bend * length * length).min(2.0 / bend));
            }
        }
    }
}
