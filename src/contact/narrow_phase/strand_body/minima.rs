//! The minima of a body's distance along an element, between nodes and at the ends.

use super::Search;
use super::scratch::Piece;
use crate::contact::narrow_phase::across_edge::across_edge;
use crate::contact::narrow_phase::descent::{self, Sample};
use crate::contact::narrow_phase::element_path::ElementPath;
use crate::contact::narrow_phase::ground::{Ground, Node};
use crate::contact::narrow_phase::undetected_overlap;
use crate::contact::shape::{Ball, Surface, Tube};

/// How much deeper than an element's end or its neighbour a minimum must be to count as a contact of its own, and to what it is found, m:
/// once the contacts are resolved, nothing in between is deeper than about twice this.
const PROMINENCE: f64 = 1e-6;

/// An end of an element from which the distance falls more steeply than this is no contact.
const STEEP: f64 = 0.5;

/// How often a piece is halved if its ends do not determine what lies between.
const DEEPEST_SPLIT: usize = 3;

/// How often a piece near a convex shape is halved at most where the bound leaves room for an overlap: it leaves none once the
/// piece's sagitta is below the tolerance, which comes sooner.
const DEEPEST_ROOM: usize = 12;

impl Search<'_, '_> {
    /// Adds the minima between nodes, and the ends.
    pub(super) fn minima(&mut self, index: usize, ground: &Ground, path: &ElementPath, nodes: &[Node]) {
        let limit = self.thickness + self.within;
        let (left, right) = (nodes[0], nodes[nodes.len() - 1]);
        // From a steep end the distance falls to something nearer or deeper, which constrains the end: it must not be pushed
        // along the strand.
        let held = |sample: &Sample<Surface>, falls: bool| sample.value < limit && !(falls && sample.slope.abs() > STEEP);
        if self.first
            && let Some(sample) = left.sample.filter(|sample| held(sample, sample.slope < 0.0))
        {
            self.add(index, &sample);
        }
        // A minimum counts if it is lower than the contact to its left, or beyond a crest; the left end is the previous
        // element's contact.
        let mut before = left.sample.map_or(f64::INFINITY, |sample| sample.value);
        let mut crest = before;
        let mut added = 0;
        let from = self.out.len();
        self.scratch.more.clear();
        let mut pieces = std::mem::take(&mut self.scratch.pieces);
        let mut close = std::mem::take(&mut self.scratch.close);
        // Along a chord the distance from a convex shape falls at one end and rises at the other if there is a minimum in between.
        // Along an arc its slope may have turned by then: an overlap is possible where the bound leaves room for it, below what is known.
        let (is_convex, bend, thickness) = (self.body.shape.is_smooth_convex(), path.now.bend(), self.thickness);
        let may_overlap = |known: f64, a: &Sample<Surface>, b: &Sample<Surface>| {
            is_convex && undetected_overlap::lowest_possible(a, b, bend) < thickness.min(known) - undetected_overlap::TOLERANCE
        };
        for pair in nodes.windows(2) {
            if pair.iter().any(|node| node.far.is_some()) {
                (before, crest) = (f64::INFINITY, f64::INFINITY);
                continue;
            }
            close_to(ground, path, pair, limit, &mut close);
            // Between points outside nothing is searched for deep inside, unless the surface is between them.
            let out = |node: &Node| node.sample.is_none_or(|sample| sample.value >= 0.0);
            let outside = out(&pair[0]) && out(&pair[1]) && !ground.is_pierced(&pair[0].now, &pair[1].now);
            let inside = outside.then_some(false);
            let ask = |s: f64| ground.sample_among(&close, path, s, inside);
            let none_close = ground.mesh.is_some() && close.is_empty();
            pieces.clear();
            pieces.push(Piece { ends: [pair[0].s, pair[1].s], samples: [pair[0].sample, pair[1].sample], depth: 0 });
            while let Some(Piece { ends, samples, depth }) = pieces.pop() {
                let length = ends[1] - ends[0];
                // The slope is at most 1; where nothing was found the surface is further away than the reach.
                let value = |end: usize| samples[end].map_or(ground.reach, |sample| sample.value);
                crest = crest.max(value(0));
                if samples[0].is_none() {
                    before = f64::INFINITY;
                }
                if 0.5 * (value(0) + value(1) - length) >= limit || none_close && samples[0].is_none() && samples[1].is_none() {
                    continue;
                }
                let falls_and_rises = matches!(samples, [Some(a), Some(b)] if a.slope < 0.0 && b.slope >= 0.0);
                let (Some(a), Some(b), true) = (samples[0], samples[1], falls_and_rises) else {
                    // Where the mean slope is not between those at the ends, these do not determine the distance.
                    let both = samples[0].zip(samples[1]);
                    let determined = both.is_some_and(|(a, b)| {
                        let mean = (b.value - a.value) / length;
                        mean >= a.slope.min(b.slope) - 1e-3 && mean <= a.slope.max(b.slope) + 1e-3
                    });
                    let room = both.is_some_and(|(a, b)| may_overlap(a.value.min(b.value), &a, &b));
                    if !determined && depth < DEEPEST_SPLIT || room && depth < DEEPEST_ROOM {
                        let s = 0.5 * (ends[0] + ends[1]);
                        let middle = ask(s);
                        pieces.push(Piece { ends: [s, ends[1]], samples: [middle, samples[1]], depth: depth + 1 });
                        pieces.push(Piece { ends: [ends[0], s], samples: [samples[0], middle], depth: depth + 1 });
                    }
                    continue;
                };
                let (mut found, around) = descent::bracketed(a, b, 0.5 * PROMINENCE, ask);
                // An arc may come down to a second minimum beside that.
                let parts = [[a, around[0]], around, [around[1], b]];
                if is_convex && depth < DEEPEST_ROOM && parts.iter().any(|[a, b]| may_overlap(found.value, a, b)) {
                    for [a, b] in parts.iter().rev().filter(|[a, b]| a.s < b.s) {
                        pieces.push(Piece { ends: [a.s, b.s], samples: [Some(*a), Some(*b)], depth: depth + 1 });
                    }
                    continue;
                }
                if found.value < 0.0 {
                    found.found = across_edge(&found, around, ask);
                }
                let counts = found.value < before.max(crest) - PROMINENCE;
                if found.value < limit && counts && found.s > left.s && found.s < right.s {
                    self.push(index, found.s, &found.found, found.found.distance - self.thickness);
                    added += 1;
                    (before, crest) = (found.value, found.value);
                }
            }
            if ground.mesh.is_some() {
                self.add_undetected_overlaps(ground, path, &[pair[0], pair[1]], &close, from);
            }
        }
        if ground.mesh.is_some() {
            self.add_points_below(ground, path, nodes, from);
        }
        (self.scratch.pieces, self.scratch.close) = (pieces, close);
        let tip = index + 1 == self.path.now.elements.len();
        if let Some(sample) = right.sample.filter(|sample| held(sample, !tip || sample.slope > 0.0)) {
            // A minimum from which the distance rises to the end by less than counts is the end's own.
            if added > 0 && crest.max(sample.value) - before < PROMINENCE {
                self.out.pop();
            }
            self.add(index, &sample);
        }
        for place in 0..self.scratch.more.len() {
            let found = self.scratch.more[place];
            let gap = found.value - self.thickness;
            // A deeper contact close by is worth more; what is left then is found when that is resolved.
            let seen = self.out[from..].iter().any(|contact| {
                let off = (contact.point.s - found.s).abs();
                off < 2e-3 && contact.gap <= gap || off < 2e-4 && contact.gap <= gap + undetected_overlap::TOLERANCE
            });
            if !seen {
                self.add(index, &found);
            }
        }
    }
}

/// Picks the triangles of a mesh that can be nearest to a point between two nodes.
fn close_to(ground: &Ground, path: &ElementPath, nodes: &[Node], limit: f64, close: &mut Vec<Ball>) {
    close.clear();
    let Some(mesh) = ground.mesh else { return };
    let (left, right) = (&nodes[0], &nodes[1]);
    let length = right.s - left.s;
    let value = |node: &Node| node.sample.map_or(ground.reach, |sample| sample.value.abs());
    if 0.5 * (value(left) + value(right) - length) >= limit {
        return;
    }
    let sagitta = 0.125 * path.now.bend() * length * length;
    let mut radius = limit + sagitta;
    // Along the chord the distance to one triangle is convex, so that it is nowhere larger than at the further end.
    for (here, there) in [(left, right), (right, left)] {
        if let Some(sample) = here.sample {
            let there = mesh.flat(sample.found.feature).distance_squared(&there.now).sqrt();
            radius = radius.min(sample.value.abs().max(there) + 2.0 * sagitta);
        }
    }
    ground.patch.pick(&Tube { ends: [left.now, right.now], radius }, close);
}
