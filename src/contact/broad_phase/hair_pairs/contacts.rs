//! The contacts of a pair of strands, from the candidates of the last search.

use super::{Group, HairPairs, HeldRoots};
use crate::contact::contact_point::{ContactPoint, Partner, StrandPath, StrandPoint};
use crate::contact::narrow_phase::strand_contacts::{Encounter, MovingPiece, PairScratch, TwoStrands};

impl HairPairs {
    /// Appends the contacts of a pair of strands to `out`, by arclength of the first strand: gaps up to `within` (m; no
    /// further than the activation). `strands` as in the last [`update`](Self::update). Any number of threads may do
    /// so for different groups; with the groups in their order, contacts are sorted by first strand, second strand, arclength
    /// of the first, of the second.
    pub fn contacts(
        &self,
        group: &Group,
        strands: &[StrandPath],
        within: f64,
        scratch: &mut PairScratch,
        out: &mut Vec<ContactPoint>,
    ) {
        let all = &self.pieces;
        let moving = |piece, ends: [usize; 2], sagitta| {
            let (start, now) = (ends.map(|node| self.carried[node]), ends.map(|node| self.now.nodes[node]));
            MovingPiece { piece, start, now, sagitta }
        };
        let moving_piece = |index: u32| {
            let piece = &all.pieces[index as usize];
            moving(piece, [piece.node as usize, piece.last_node()], self.now.bows[index as usize])
        };
        let moving_chord = |index: u32| {
            let chord = &all.chords[index as usize];
            let (piece, node) = (chord.piece as usize, chord.node as usize);
            moving(&all.pieces[piece], [node, node + 1], self.now.sagittas[piece])
        };
        let piece_of = |chord: u32| all.chords[chord as usize].piece;
        let [a, b] = [group.a, group.b].map(|strand| &strands[strand as usize]);
        let [wisp_a, wisp_b] = [group.a, group.b].map(|strand| &self.wisps[strand as usize]);
        let two = TwoStrands {
            a,
            b,
            wisp_a,
            wisp_b,
            held: match self.held_roots {
                HeldRoots::Ignored => wisp_a.held_length(wisp_b, (a.now.left_end(0) - b.now.left_end(0)).norm()),
                HeldRoots::Counted => 0.0,
            },
            within: within.min(self.activation),
            turned: self.turned,
        };
        let candidates = &self.candidates[group.range()];
        let of_pieces = |(i, j): &(u32, u32)| (piece_of(*i), piece_of(*j));
        let candidates = candidates.chunk_by(|a, b| of_pieces(a) == of_pieces(b)).filter_map(|chords| {
            let (i, j) = of_pieces(&chords[0]);
            let may = Encounter::of_any(chords.iter().map(|(i, j)| two.may_meet(&moving_chord(*i), &moving_chord(*j))));
            may.is_possible().then(|| (moving_piece(i), moving_piece(j), may))
        });
        let first = out.len();
        two.contacts(candidates, scratch, out);
        if self.knots.holds(group.a) && self.knots.holds(group.b) {
            self.gather(group, strands, within, first, out);
        }
    }

    /// Removes contacts from `first` on that are in a knot, and reduces the radii of those beside one.
    fn gather(&self, group: &Group, strands: &[StrandPath], within: f64, first: usize, out: &mut Vec<ContactPoint>) {
        let radii = self.wisps[group.a as usize].radius + self.wisps[group.b as usize].radius;
        let along = |strand: u32, place: &StrandPoint| strands[strand as usize].now.along(place.element as usize, place.s);
        let mut kept = first;
        for index in first..out.len() {
            let mut contact = out[index];
            if let Partner::Strand(other) = &contact.partner {
                let along = [along(group.a, &contact.point), along(group.b, other)];
                let Some(fraction) = self.knots.fraction_left([group.a, group.b], along, radii) else { continue };
                let at =
                    |strand: u32, place: &StrandPoint| strands[strand as usize].now.position(place.element as usize, place.s);
                let apart = at(group.a, &contact.point) - at(group.b, other);
                // Permitted overlaps may leave less.
                contact.gap = contact.gap.max(contact.normal.dot(&apart) - fraction * radii);
                if fraction < 1.0 && contact.gap > within {
                    continue;
                }
            }
            out[kept] = contact;
            kept += 1;
        }
        out.truncate(kept);
    }
}
