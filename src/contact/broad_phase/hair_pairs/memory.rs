//! What the search for pairs keeps from step to step, saved and restored for snapshots: the pieces of strands and the
//! candidates affect the last digits of what is found.

use nalgebra::{Matrix3, Vector3};

use super::{HairPairs, Root, Validity};
use crate::contact::broad_phase::pieces::{MAX_CHORDS, Piece, Pieces, Wisp};

/// The memory of a search whose pairs are still valid.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct PairMemory {
    pub activation: f64,
    pub margin: f64,
    pub wisps: Vec<Wisp>,
    pub pieces: Vec<Piece>,
    /// Pairs of indices of the pieces' chords.
    pub candidates: Vec<(u32, u32)>,
    /// Where the chords' ends were when the search was made.
    pub nodes: Vec<Vector3<f64>>,
    /// Where the roots were then, of the strands that take part.
    pub roots: Vec<(Vector3<f64>, Matrix3<f64>)>,
    /// How far each piece was off its chords then.
    pub sagittas: Vec<f64>,
}

impl HairPairs {
    /// Its memory; `None` if the next update searches anyhow.
    pub(crate) fn memory(&self) -> Option<PairMemory> {
        (self.validity != Validity::None).then(|| PairMemory {
            activation: self.activation,
            margin: self.margin,
            wisps: self.wisps.clone(),
            pieces: self.pieces.pieces.clone(),
            candidates: self.candidates.clone(),
            nodes: self.found_at.clone(),
            roots: self.found_roots.iter().map(|root| (root.origin, root.frame)).collect(),
            sagittas: self.found_sagittas.clone(),
        })
    }

    /// Restores a memory; a step begins. False, with nothing changed, if its contents are inconsistent. `elements[k]`: the
    /// lengths of the elements of the kth strand.
    pub(crate) fn take_up(&mut self, memory: PairMemory, elements: &[&[f64]]) -> bool {
        if !memory.is_whole(elements) {
            return false;
        }
        *self = Self {
            wisps: memory.wisps,
            activation: memory.activation,
            margin: memory.margin,
            candidates: memory.candidates,
            found_roots: memory.roots.into_iter().map(|(origin, frame)| Root { origin, frame }).collect(),
            found_sagittas: memory.sagittas,
            validity: Validity::Before,
            ..Self::default()
        };
        self.pieces = Pieces::of(memory.pieces, memory.nodes.len());
        self.found_at = memory.nodes;
        self.group();
        true
    }
}

impl PairMemory {
    fn is_whole(&self, elements: &[&[f64]]) -> bool {
        let counts = self.wisps.len() == elements.len()
            && self.sagittas.len() == self.pieces.len()
            && self.roots.len() == self.wisps.iter().filter(|wisp| wisp.radius > 0.0).count();
        let good = |x: f64| x.is_finite() && x >= 0.0;
        let numbers = good(self.activation) && good(self.margin) && self.wisps.iter().all(|wisp| wisp.check(String::new).is_ok());
        counts && numbers && self.pieces_are_whole(elements) && self.candidates_are_whole()
    }

    /// Pieces as `Pieces::cut` makes them: root to tip, strand by strand, each begun where the one before ends.
    fn pieces_are_whole(&self, elements: &[&[f64]]) -> bool {
        let mut node = 0;
        let mut before: Option<&Piece> = None;
        for piece in &self.pieces {
            let Some(length) = elements.get(piece.strand as usize).and_then(|lengths| lengths.get(piece.element as usize)) else {
                return false;
            };
            let [from, to] = piece.s;
            let inside = 0.0 <= from && from <= to && to <= *length && piece.along.is_finite();
            let goes_on = before.is_some_and(|before| before.continued[1]);
            let place = |piece: &Piece| (piece.strand, piece.element);
            let in_order = match before {
                None => !piece.continued[0],
                Some(before) if goes_on => {
                    piece.strand == before.strand
                        && piece.continued[0]
                        && (piece.element == before.element || piece.element == before.element + 1)
                }
                Some(before) => piece.strand > before.strand && !piece.continued[0] && place(piece) > place(before),
            };
            // Between two strands there is one node more: the end of the last piece.
            node += before.map_or(0, |before| before.chords + u32::from(!goes_on));
            let in_order = in_order && (1..=MAX_CHORDS).contains(&piece.chords);
            if !(inside && in_order && piece.node == node && self.wisps[piece.strand as usize].radius > 0.0) {
                return false;
            }
            before = Some(piece);
        }
        let last = before.map_or(0, |last| if last.continued[1] { usize::MAX } else { last.last_node() + 1 });
        self.nodes.len() == last
    }

    /// Candidates in the order in which groups are made.
    fn candidates_are_whole(&self) -> bool {
        let pieces = Pieces::of(self.pieces.clone(), self.nodes.len());
        let count = pieces.chords.len() as u32;
        let are_pairs = self.candidates.iter().all(|(i, j)| i < j && *j < count);
        are_pairs && self.candidates.is_sorted_by_key(|(i, j)| pieces.order_of(*i, *j))
    }
}
