//! Contacts of a strand's elements with a body.
//!
//! Along an element the body's signed distance is a function of arclength. Its minima are found between nodes, from its values
//! and slopes there, and refined on the exact helix; overlap of a mesh between them is searched for triangle by triangle
//! (`undetected_overlap.rs`). Where a piece of the element may have passed through the body within the step, its motion is
//! swept (`body_sweep.rs`), and the side from which it came counts.
//!
//! Files:
//!
//! - `found.rs`: What a search of a strand and a body adds to its contacts, and the side of the body on which a strand is kept that ran into it.
//! - `scratch.rs`: Memory of a search of a strand and a body, kept from call to call.

mod found;
mod scratch;

use std::cell::Cell;

use nalgebra::Vector3;

pub use scratch::BodySearchScratch;
use scratch::Piece;

use super::across_edge::across_edge;
use super::descent::{self, Sample};
use super::element_path::ElementPath;
use super::ground::{Ground, Node, sample};
use super::path_bounds::PathBounds;
use super::undetected_overlap;
use crate::contact::body_at::BodyAt;
use crate::contact::ccd::body_sweep;
use crate::contact::contact_point::{ContactPoint, StrandPath};
use crate::contact::shape::{Ball, Bounds, Kind, Mesh, Sides, Surface, Tube};

/// How much deeper than an element's end or its neighbour a minimum must be to count as a contact of its own, and to what it is found, m:
/// once the contacts are resolved, nothing in between is deeper than about twice this.
const PROMINENCE: f64 = 1e-6;

/// An end of an element from which the distance falls more steeply than this is no contact.
const STEEP: f64 = 0.5;

/// The largest number of pieces of an element.
const MAX_PIECES: usize = 64;

/// How often a piece is halved if its ends do not determine what lies between.
const DEEPEST_SPLIT: usize = 3;

/// The tree of a mesh is searched in a box larger than an element needs by this fraction of its length, so that the result is
/// valid for a while.
const MARGIN: f64 = 0.3;

/// The part of a strand that takes part in contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Span<'a> {
    /// Arclength from the root, m, without contact: the part in and about the follicle.
    pub exempt: f64,
    /// Elements whose contacts are known, and which are passed over. None beyond the list.
    pub unmoved: &'a [bool],
}

/// Finds the contacts of a strand with a body at the present iterate, up to a gap of `within` (m), and appends them to `out`,
/// sorted by element and arclength. `bounds` are those of `path`; `radius` (m) is the strand's. Nothing is allocated once the
/// lists have grown.
///
/// Every local minimum of the distance along an element is a contact, and every end of an element that is near enough and not
/// steep above a nearer point (the end between two elements belongs to the first). A strand that passed through the body during
/// the step is in contact from the side from which it came, with a negative gap. Distances are signed: a strand inside a solid
/// is in contact at any depth.
#[allow(clippy::too_many_arguments)] // Each is another thing, and all are needed.
pub fn contacts(
    path: &StrandPath,
    bounds: &PathBounds,
    span: Span,
    radius: f64,
    body: &BodyAt,
    within: f64,
    scratch: &mut BodySearchScratch,
    out: &mut Vec<ContactPoint>,
) {
    let thickness = radius + body.thickness;
    let (margin, slack) = (thickness + within, turning_slack(bounds, body));
    if body.is_clear_of(&bounds.whole, margin, slack) {
        return;
    }
    let mut search = Search { path, body, thickness, within, inside: None, first: true, scratch, out };
    let mut from_root = 0.0;
    for (element, state) in path.now.elements.iter().enumerate() {
        let low = (span.exempt - from_root).max(0.0);
        from_root += state.length;
        if low >= state.length {
            continue;
        }
        if span.unmoved.get(element) == Some(&true) {
            (search.inside, search.first) = (None, false);
            continue;
        }
        if body.is_clear_of(&bounds.elements[element], margin, slack) {
            search.inside = Some(false);
        } else {
            search.element(element, low, state.length);
        }
        search.first = false;
    }
}

/// How far the paths of a strand's points that are straight in the body's turning axes may leave those straight in the world,
/// m.
///
/// With a and b a point's positions at start and end relative to the body's origin there, and θ the rotation, the two differ at
/// the fraction τ of the step by τ(1−τ) θ×(a−b) to first order in θ, and by at most θ²/8 max(|a|, |b|) beyond.
fn turning_slack(bounds: &PathBounds, body: &BodyAt) -> f64 {
    if body.turn == 0.0 {
        return 0.0;
    }
    let farthest = |origin: &Vector3<f64>| (bounds.whole.low - origin).abs().sup(&(bounds.whole.high - origin).abs()).norm();
    let (a, b) = (farthest(&body.start.origin), farthest(&body.end.origin));
    body.turn * (0.25 * (a + b) + 0.125 * body.turn * a.max(b))
}

/// The search along one strand.
struct Search<'a, 'b> {
    path: &'a StrandPath<'a>,
    body: &'a BodyAt<'a>,
    thickness: f64,
    within: f64,
    /// Whether the last node looked at lies inside the solid, if that is known.
    inside: Option<bool>,
    /// Whether the element is the first that takes part in contact: its left end is no element's right end.
    first: bool,
    scratch: &'b mut BodySearchScratch,
    out: &'b mut Vec<ContactPoint>,
}

impl Search<'_, '_> {
    fn element(&mut self, index: usize, low: f64, high: f64) {
        let path = ElementPath::new(&self.path.start, &self.path.now, index, self.body);
        let shape = self.body.shape;
        let mesh = shape.mesh();
        // All of the element during all of its motion.
        let clear = if let Some(separator) = shape.separator() {
            path.least_distance(&separator) >= self.thickness + self.within
        } else {
            let (centre, ball) = path.ball();
            let far = self.thickness + self.within + ball;
            match &shape.0 {
                Kind::Hull(mesh) | Kind::Mesh(mesh) => mesh.bounds().distance(&centre) > far,
                _ => shape.distance(centre, far) >= far,
            }
        };
        if clear {
            self.inside = Some(false);
            return;
        }
        let piece = self.place_nodes(&path, low, high);
        // Distances at nodes a little beyond the limit show where the distance falls.
        let reach =
            self.thickness + self.within + if mesh.is_some() { 0.1 * piece } else { 0.5 * shape.distance_slope() * piece };
        let travel = self.scratch.nodes.iter().map(|node| (node.now - node.before).norm_squared()).fold(0.0, f64::max).sqrt();
        let travel = travel + mesh.map_or(0.0, Mesh::farthest_travel);
        let swept = travel > 0.5 * self.thickness + shape.thinness();
        if let Some(mesh) = mesh {
            self.gather(mesh, index, piece, reach, 0.125 * piece * piece * path.now.bend().max(path.start.bend()), swept);
            let outside = mesh.sides() == Sides::Both || self.inside == Some(false);
            if outside && self.scratch.patch.triangles.is_empty() {
                return;
            }
        }
        let patch = std::mem::take(&mut self.scratch.patch);
        let mut nodes = std::mem::take(&mut self.scratch.nodes);
        let mut hits = std::mem::take(&mut self.scratch.hits);
        let ground = Ground { body: self.body, mesh, patch: &patch, reach, hint: Cell::default() };
        hits.clear();
        match mesh {
            Some(_) => self.ask_of_mesh(&ground, &mut nodes),
            None => self.ask_of_shape(&ground, &mut nodes, piece),
        }
        if swept {
            body_sweep::sweep(&ground, self.thickness, &nodes, &mut hits);
        }
        let from = self.out.len();
        self.minima(index, &ground, &path, &nodes);
        for (s, hit) in &hits {
            self.keep_side(index, &path, piece, from, *s, hit, &ground);
        }
        self.out[from..].sort_by(|a, b| a.point.s.total_cmp(&b.point.s));
        (self.scratch.patch, self.scratch.nodes, self.scratch.hits) = (patch, nodes, hits);
    }

    /// Samples the distance of a mesh at the nodes of an element.
    fn ask_of_mesh(&mut self, ground: &Ground, nodes: &mut [Node]) {
        let mut last = nodes.first().map_or_else(Vector3::zeros, |node| node.now);
        for node in nodes {
            let mut surface = ground.ask(|| node.before, node.now, self.inside);
            if surface.is_none() && ground.is_pierced(&last, &node.now) {
                // Deep inside, though the node before is outside.
                surface = ground.ask(|| node.before, node.now, None);
            }
            last = node.now;
            if let Some(surface) = &surface {
                self.inside = Some(surface.distance < 0.0);
            } else if self.inside.is_none() {
                self.inside = Some(false);
            }
            node.sample = surface.map(|found| sample(node.s, found, &node.tangent));
        }
    }

    /// Samples the distance of a shape that has no mesh. Leaves out nodes that are, by the distance of the one before, so far
    /// that no surface is in reach between them and their neighbours.
    fn ask_of_shape(&mut self, ground: &Ground, nodes: &mut [Node], piece: f64) {
        let slope = self.body.shape.distance_slope();
        let far = self.thickness + self.within + slope * piece;
        let mut last: Option<(f64, f64)> = None;
        for node in nodes {
            let least = last.map_or(f64::NEG_INFINITY, |(s, distance)| distance - slope * (node.s - s));
            if least > far {
                node.far = Some(least);
                continue;
            }
            let surface = ground.ask(|| node.before, node.now, None);
            last = surface.as_ref().map(|surface| (node.s, surface.distance));
            node.sample = surface.map(|found| sample(node.s, found, &node.tangent));
        }
    }

    /// Picks the triangles near the element: those near the ends of its pieces, and, if it is swept, those near its paths.
    fn gather(&mut self, mesh: &Mesh, index: usize, piece: f64, reach: f64, sagitta: f64, swept: bool) {
        let nodes = &self.scratch.nodes;
        let (first, last) = (nodes[0].now, nodes[nodes.len() - 1].now);
        let along = (last - first).try_normalize(0.0).unwrap_or_default();
        let off = |node: &Node| (node.now - first) - along * along.dot(&(node.now - first));
        let bulge = nodes.iter().map(|node| off(node).norm_squared()).fold(0.0, f64::max).sqrt();
        let tube = Tube { ends: [first, last], radius: reach + bulge + sagitta };
        let points = nodes.iter().flat_map(|node| [node.before, node.now]);
        let bounds = Bounds::of_points(points).grown(reach + bulge + sagitta);
        let margin = MARGIN * piece * (nodes.len() - 1) as f64;
        let mut region = std::mem::take(self.scratch.region(self.body.index, index));
        region.cover(mesh, &bounds, margin);
        self.scratch.patch.take(mesh, &region, &tube, swept.then_some(&bounds));
        *self.scratch.region(self.body.index, index) = region;
    }

    /// Cuts the element into pieces that bend little and are no longer than the body's features; returns their length.
    fn place_nodes(&mut self, path: &ElementPath, low: f64, high: f64) -> f64 {
        let bend = path.now.bend().max(path.start.bend());
        let length = high - low;
        // A quarter of the thickness for the chord's sagitta, a quarter of a radian for its turn. A grid is asked on the curve alone.
        let sagitta = match self.body.shape.0 {
            Kind::Grid(_) => f64::INFINITY,
            _ => (0.25 * self.thickness).max(2e-6),
        };
        let flat = (8.0 * sagitta / bend).sqrt().min(0.25 / bend);
        let longest = flat.min(self.body.shape.feature_length()).max(length / MAX_PIECES as f64);
        let count = ((length / longest).ceil() as usize).clamp(1, MAX_PIECES);
        let nodes = &mut self.scratch.nodes;
        nodes.clear();
        for node in 0..=count {
            let s = if node == count { high } else { low + length * (node as f64 / count as f64) };
            let ((before, _), (now, tangent)) = (path.start.at(s), path.now.at(s));
            nodes.push(Node { s, before, now, tangent, sample: None, far: None });
        }
        length / count as f64
    }

    /// Adds the minima between nodes, and the ends.
    fn minima(&mut self, index: usize, ground: &Ground, path: &ElementPath, nodes: &[Node]) {
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
        // Along an arc its slope may have turned by then: an overlap is possible where the tangents leave room for it.
        let (is_convex, bend, thickness) = (self.body.shape.is_smooth_convex(), path.now.bend(), self.thickness);
        let may_overlap = |a: &Sample<Surface>, b: &Sample<Surface>| {
            let bar = thickness.min(a.value).min(b.value) - undetected_overlap::TOLERANCE;
            is_convex && undetected_overlap::lowest_possible(a, b, bend) < bar
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
            let ask = |s: f64| {
                let (now, tangent) = path.now.at(s);
                ground.ask_among(&close, || path.start.at(s).0, now, inside).map(|surface| sample(s, surface, &tangent))
            };
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
                    let determined = samples[0].zip(samples[1]).is_some_and(|(a, b)| {
                        let mean = (b.value - a.value) / length;
                        mean >= a.slope.min(b.slope) - 1e-3 && mean <= a.slope.max(b.slope) + 1e-3 && !may_overlap(&a, &b)
                    });
                    if !determined && depth < DEEPEST_SPLIT {
                        let s = 0.5 * (ends[0] + ends[1]);
                        let middle = ask(s);
                        pieces.push(Piece { ends: [s, ends[1]], samples: [middle, samples[1]], depth: depth + 1 });
                        pieces.push(Piece { ends: [ends[0], s], samples: [samples[0], middle], depth: depth + 1 });
                    }
                    continue;
                };
                let (mut found, around) = descent::bracketed(a, b, 0.5 * PROMINENCE, ask);
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
