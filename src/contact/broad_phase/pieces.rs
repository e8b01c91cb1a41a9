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

    /// The length from both roots up to which this strand and another do not touch, m: the sum of their radii if the roots are closer than
    /// that, else 0. `apart`: the distance of the roots, m. Roots are held where they are, and next to them no force of hair's size moves
    /// anything.
    pub fn held_length(&self, other: &Wisp, apart: f64) -> f64 {
        let radii = self.radius + other.radius;
        if apart < radii { radii } else { 0.0 }
    }

    pub(in crate::contact) fn meets(&self, other: &Wisp) -> bool {
        self.group & other.mask != 0 && other.group & self.mask != 0
    }
}

/// A piece bends by at most this, rad: two such arcs have one closest pair, unless they lie along each other.
const MAX_BEND: f64 = 0.5;
/// A piece less than this fraction of the contact radius off its chord may bend by more.
const FINE: f64 = 0.05;

/// A piece has so many chords that it is off none by more than this fraction of the contact radius, or as many as it may have; but by this
/// much it may be, m, since strands move by more in a step.
const OFF_CHORD: f64 = 0.5;
const MIN_OFF_CHORD: f64 = 2.5e-4;
/// The most chords of a piece.
pub(in crate::contact) const MAX_CHORDS: u32 = 8;

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
    /// The node at its first end; as many nodes further on as it has chords is its other end.
    pub node: u32,
    /// How many chords of equal lengths of arc it has in the search for pairs, one at least.
    pub chords: u32,
    /// Whether a piece of the same strand follows at either end.
    pub continued: [bool; 2],
}

impl Piece {
    /// The node at its second end.
    pub fn last_node(&self) -> usize {
        (self.node + self.chords) as usize
    }

    /// Arclength of a node of it from the element's left end, m.
    fn at_node(&self, k: u32) -> f64 {
        let [from, to] = self.s;
        if k == self.chords { to } else { from + (to - from) * f64::from(k) / f64::from(self.chords) }
    }
}

/// A chord of a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chord {
    /// The piece.
    pub piece: u32,
    /// The node at its first end; the next node is at its other end.
    pub node: u32,
}

/// The pieces of strands.
#[derive(Debug, Default)]
pub struct Pieces {
    /// From strand to strand, root to tip.
    pub pieces: Vec<Piece>,
    /// Their chords, in the same order.
    pub chords: Vec<Chord>,
    /// Number of nodes: a strand has one more than chords, and none without pieces.
    pub nodes: usize,
    /// The first chord of each piece, and the first piece of each strand (as if of none: of the next one).
    first_chords: Vec<u32>,
    first_pieces: Vec<u32>,
}

/// Curvature of an element's centreline, 1/m.
fn bend(curve: &StrandCurve, element: usize) -> f64 {
    let [_, k1, k2] = curve.elements[element].kappa.0;
    (k1 * k1 + k2 * k2).sqrt()
}

/// How far a piece is off its chord, at most, m: Ωs²/8, and never more than across its circle (less than
/// [`crate::rod::kinematics::off_chord`] has it for coils, which are one piece).
fn off_chord(bend: f64, length: f64) -> f64 {
    (0.125 * bend * length * length).min(2.0 / bend)
}

/// Number of chords of a piece.
fn chords_of(bend: f64, length: f64, radius: f64) -> u32 {
    let chords = (off_chord(bend, length) / (OFF_CHORD * radius).max(MIN_OFF_CHORD)).sqrt().ceil();
    if chords > 1.0 { chords.min(f64::from(MAX_CHORDS)) as u32 } else { 1 }
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
    /// Pieces that were cut before, with their number of nodes.
    pub fn of(pieces: Vec<Piece>, nodes: usize) -> Self {
        let mut of = Self { pieces, nodes, ..Self::default() };
        of.lay_out_chords();
        of
    }

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
                    let bend = bend(&curve, index);
                    let count = pieces_of(bend, left, wisp.radius);
                    let at = |k: usize| if k == count { element.length } else { begin + left * k as f64 / count as f64 };
                    let chords = chords_of(bend, left / count as f64, wisp.radius);
                    for k in 0..count {
                        self.pieces.push(Piece {
                            strand: strand as u32,
                            element: index as u32,
                            s: [at(k), at(k + 1)],
                            along: along + at(k),
                            node: self.nodes as u32,
                            chords,
                            continued: [self.pieces.len() > first, true],
                        });
                        self.nodes += chords as usize;
                    }
                }
                along += element.length;
            }
            if let Some(last) = self.pieces[first..].last_mut() {
                last.continued[1] = false;
                self.nodes += 1;
            }
        }
        self.lay_out_chords();
    }

    /// Makes the chords of the pieces.
    fn lay_out_chords(&mut self) {
        self.chords.clear();
        self.first_chords.clear();
        self.first_pieces.clear();
        for (index, piece) in self.pieces.iter().enumerate() {
            self.first_pieces.resize(self.first_pieces.len().max(piece.strand as usize + 1), index as u32);
            self.first_chords.push(self.chords.len() as u32);
            self.chords.extend((0..piece.chords).map(|k| Chord { piece: index as u32, node: piece.node + k }));
        }
    }

    /// A number for a pair of chords that orders such pairs by first strand, second strand, first piece, second piece, and chords.
    pub fn order_of(&self, first: u32, second: u32) -> u128 {
        const { assert!(MAX_CHORDS <= 16, "a chord within its piece has four bits") };
        let [first, second] = [first, second].map(|chord| {
            let Chord { piece, .. } = self.chords[chord as usize];
            let strand = self.pieces[piece as usize].strand;
            let within = [piece - self.first_pieces[strand as usize], chord - self.first_chords[piece as usize]];
            (u128::from(strand), within.map(u128::from))
        });
        let ((a, [piece_a, chord_a]), (b, [piece_b, chord_b])) = (first, second);
        a << 96 | b << 64 | piece_a << 36 | piece_b << 8 | chord_a << 4 | chord_b
    }

    /// The pair of chords with this number.
    pub fn pair_of(&self, order: u128) -> (u32, u32) {
        const PIECE: u32 = (1 << 28) - 1;
        let chord = |strand: u32, piece: u32, chord: u32| {
            self.first_chords[(self.first_pieces[strand as usize] + piece) as usize] + chord
        };
        let bits = |from: u32| (order >> from) as u32;
        (chord(bits(96), bits(36) & PIECE, bits(4) & 15), chord(bits(64), bits(8) & PIECE, bits(0) & 15))
    }

    /// The strand of a chord.
    pub fn strand_of(&self, chord: usize) -> usize {
        self.pieces[self.chords[chord].piece as usize].strand as usize
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
            placed.bows.extend_from_slice(&part.bows);
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
    /// How far each piece is off its chords, at most, m.
    pub sagittas: Vec<f64>,
    /// How far it is off the line between its ends, at most, m.
    pub bows: Vec<f64>,
    /// Whether some element is bent so much more than when it was cut that it needs more than twice its pieces.
    pub outgrown: bool,
}

impl PlacedPieces {
    fn clear(&mut self) {
        self.nodes.clear();
        self.sagittas.clear();
        self.bows.clear();
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
                let last = piece.chords + u32::from(!piece.continued[1]);
                self.nodes.extend((1..last).map(|k| curve.position(element, piece.at_node(k))));
                let length = piece.s[1] - piece.s[0];
                self.sagittas.push(off_chord(bend, length / f64::from(piece.chords)));
                self.bows.push(off_chord(bend, length));
            }
        }
    }
}
