//! Strands cut into pieces that bend little, each known by its chord: what the search for pairs works on.

use nalgebra::Vector3;

use super::touch::StrandCurve;
use crate::error::{Result, check_not_negative};

/// What a strand is to other strands.
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

    pub(super) fn meets(&self, other: &Wisp) -> bool {
        self.group & other.mask != 0 && other.group & self.mask != 0
    }
}

/// A piece bends by at most this, rad: two such arcs have one closest pair, unless they lie along each other.
const MOST_BEND: f64 = 0.5;
/// Less than this share of the contact radius off its chord, a piece may bend by more.
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
    /// Whether a piece of the same strand goes on at either end.
    pub continued: [bool; 2],
}

/// How strands are cut.
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
    let by_bend = bend * length / MOST_BEND;
    let by_sagitta = length * (bend / (8.0 * loose)).sqrt();
    (by_bend.min(by_sagitta).ceil() as usize).max(1)
}

impl Pieces {
    /// Cuts the strands as they are bent in `curve`.
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

    /// Whether some element is bent so much more than when it was cut that it needs more than twice its pieces.
    pub fn outgrown<'a>(&self, wisps: &[Wisp], curve: impl Fn(usize) -> StrandCurve<'a>) -> bool {
        let mut of_element = self.pieces.chunk_by(|a, b| (a.strand, a.element) == (b.strand, b.element));
        of_element.any(|pieces| {
            let (strand, element) = (pieces[0].strand as usize, pieces[0].element as usize);
            let length = pieces[pieces.len() - 1].s[1] - pieces[0].s[0];
            pieces_of(bend(&curve(strand), element), length, wisps[strand].radius) > 2 * pieces.len()
        })
    }

    /// Where the nodes are, m.
    pub fn place<'a>(&self, curve: impl Fn(usize) -> StrandCurve<'a>, nodes: &mut Vec<Vector3<f64>>) {
        nodes.clear();
        for piece in &self.pieces {
            let (element, curve) = (piece.element as usize, curve(piece.strand as usize));
            nodes.push(curve.position(element, piece.s[0]));
            if !piece.continued[1] {
                nodes.push(curve.position(element, piece.s[1]));
            }
        }
    }

    /// How far each piece is off its chord, at most, m: Ωs²/8, and never more than across its circle.
    pub fn sagittas<'a>(&self, curve: impl Fn(usize) -> StrandCurve<'a>, sagittas: &mut Vec<f64>) {
        sagittas.clear();
        sagittas.extend(self.pieces.iter().map(|piece| {
            let bend = bend(&curve(piece.strand as usize), piece.element as usize);
            let length = piece.s[1] - piece.s[0];
            (0.125 * bend * length * length).min(2.0 / bend)
        }));
    }
}
