//! Strand against body: where a strand's elements touch a body, or soon may.
//!
//! Along an element the body's signed distance is a function of arclength. Its minima are found between nodes, from its values and slopes
//! there, and refined on the exact helix; what overlaps a mesh between them is seen to triangle by triangle (`overlooked.rs`). Where a piece
//! of the element may have gone through the body within the step, its way is swept (`body_sweep.rs`), and the side that it came from counts.

use std::cell::Cell;

use nalgebra::Vector3;

use super::across_edge::across_edge;
use super::body::BodyAt;
use super::body_sweep;
use super::descent::{self, Sample};
use super::element_path::ElementPath;
use super::ground::{Clear, Ground, Node, sample};
use super::overlooked::{self, overlooked};
use super::shape::{Ball, Bounds, Kind, Mesh, Patch, Region, Sides, Surface, Tube};
use super::touch::{Partner, Place, StrandPath, Touch};

/// How much deeper than an element's end or its neighbour a minimum must be to count as a touch of its own, and to what it is found, m:
/// once the touches are resolved, nothing in between is deeper than about twice this.
const PROMINENCE: f64 = 1e-6;

/// An end of an element from which the distance falls more steeply than this is no touch.
const STEEP: f64 = 0.5;

/// Most pieces into which an element is cut.
const MOST_PIECES: usize = 64;

/// How often a piece is halved where its ends do not tell what lies between.
const DEEPEST_SPLIT: usize = 3;

/// The tree of a mesh is asked for a box larger than an element needs by this share of its length, so that the answer holds for a while.
const MARGIN: f64 = 0.3;

/// Which part of a strand is touched.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Span {
    /// Arclength from the root, m, over which nothing is touched: the part in and about the follicle.
    pub exempt: f64,
}

/// Boxes of a strand's way through a step. Made once an iterate, asked by all bodies.
#[derive(Debug, Clone)]
pub struct PathBounds {
    /// Of all of it, world.
    pub whole: Bounds,
    elements: Vec<Bounds>,
}

impl Default for PathBounds {
    fn default() -> Self {
        Self { whole: Bounds::EMPTY, elements: Vec::new() }
    }
}

impl PathBounds {
    /// Brings the boxes to a path.
    pub fn update(&mut self, path: &StrandPath) {
        self.elements.clear();
        self.whole = Bounds::EMPTY;
        for (start, now) in path.start.elements.iter().zip(path.now.elements) {
            let mut bounds = Bounds::EMPTY;
            for (element, origin) in [(start, path.start.origin), (now, path.now.origin)] {
                // An arc lies within half its length of the middle of its ends.
                let left = origin + Vector3::from(element.origin_left);
                let right = origin + Vector3::from(element.origin_right());
                bounds = bounds.union(&Bounds::around(0.5 * (left + right), Vector3::repeat(0.5 * element.length)));
            }
            self.whole = self.whole.union(&bounds);
            self.elements.push(bounds);
        }
    }
}

/// Lists that are used again from call to call.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    /// By body and element.
    regions: Vec<(u32, Vec<Region>)>,
    patch: Patch,
    nodes: Vec<Node>,
    hits: Vec<(f64, Surface)>,
    pieces: Vec<Piece>,
    close: Vec<Ball>,
    more: Vec<Sample<Surface>>,
}

/// A piece between two places, with what was found there, if the surface is near there, and how often it was halved.
#[derive(Debug, Clone, Copy)]
struct Piece {
    ends: [f64; 2],
    samples: [Option<Sample<Surface>>; 2],
    depth: usize,
}

impl Scratch {
    /// What is known of a mesh about an element.
    fn region(&mut self, body: u32, element: usize) -> &mut Region {
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

/// Finds where a strand touches a body at the present iterate, or is nearer than `within` (m) to it, and adds the touches to `out`, sorted
/// by element and arclength. `bounds` are those of `path`; `radius` (m) is the strand's. Nothing is allocated once the lists have grown.
///
/// Every local minimum of the distance along an element is a touch, and every end of an element that is near enough and not steep above a
/// nearer place (the end between two elements belongs to the first). A strand that went through the body during the step touches it from the side that it came from, with a
/// negative gap. Distances are signed: a strand inside a solid is touched at any depth.
#[allow(clippy::too_many_arguments)] // Each is another thing, and all are needed.
pub fn touches(
    path: &StrandPath,
    bounds: &PathBounds,
    span: Span,
    radius: f64,
    body: &BodyAt,
    within: f64,
    scratch: &mut Scratch,
    out: &mut Vec<Touch>,
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
        if body.is_clear_of(&bounds.elements[element], margin, slack) {
            search.inside = Some(false);
        } else {
            search.element(element, low, state.length);
        }
        search.first = false;
    }
}

/// How far the ways of points of a strand, straight in the body's turning axes, may leave those in the world, m.
///
/// With a and b a point's places at start and end from the body's origin there, and θ the turn, the two differ at the fraction τ of the step by
/// τ(1−τ) θ×(a−b) to first order in θ, and by at most θ²/8 max(|a|, |b|) beyond.
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
    /// Whether the element is the first that may touch: its left end is nobody's right end.
    first: bool,
    scratch: &'b mut Scratch,
    out: &'b mut Vec<Touch>,
}

impl Search<'_, '_> {
    fn element(&mut self, index: usize, low: f64, high: f64) {
        let path = ElementPath::new(&self.path.start, &self.path.now, index, self.body);
        let shape = self.body.shape;
        let mesh = shape.mesh();
        let (centre, ball) = path.ball();
        let far = self.thickness + self.within + ball;
        // All of the element on all of its way.
        let clear = match &shape.0 {
            Kind::Hull(mesh) | Kind::Mesh(mesh) => mesh.bounds().distance(&centre) > far,
            _ => shape.distance(centre, far) >= far,
        };
        if clear {
            self.inside = Some(false);
            return;
        }
        let piece = self.place_nodes(&path, low, high);
        // The distance at places that are themselves farther than the limit tells where it falls.
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
        self.out[from..].sort_by(|a, b| a.place.s.total_cmp(&b.place.s));
        (self.scratch.patch, self.scratch.nodes, self.scratch.hits) = (patch, nodes, hits);
    }

    /// Finds what lies under the nodes of an element near a mesh.
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

    /// The same near a shape that knows its distance everywhere. Nodes are left out that are, by the distance of the one before, so far that
    /// nothing is in reach between them and their neighbours.
    fn ask_of_shape(&mut self, ground: &Ground, nodes: &mut [Node], piece: f64) {
        let slope = self.body.shape.distance_slope();
        let far = ground.reach + slope * piece;
        let mut last: Option<(f64, f64)> = None;
        for node in nodes {
            let least = last.map_or(f64::NEG_INFINITY, |(s, distance)| distance - slope * (node.s - s));
            if least > far {
                node.clear = Clear::Of(least);
                continue;
            }
            let surface = ground.ask(|| node.before, node.now, self.inside);
            last = surface.as_ref().map(|surface| (node.s, surface.distance));
            node.sample = surface.map(|found| sample(node.s, found, &node.tangent));
        }
    }

    /// Picks the triangles near the element: those that the ends of its pieces are asked for, and, if it is swept, those on its way.
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

    /// Cuts the element into pieces that bend by little and are no longer than the body's features; their length.
    fn place_nodes(&mut self, path: &ElementPath, low: f64, high: f64) -> f64 {
        let bend = path.now.bend().max(path.start.bend());
        let length = high - low;
        // A quarter of the thickness for the chord's sagitta, a quarter of a radian for its turn. A grid is asked on the curve alone.
        let sagitta = match self.body.shape.0 {
            Kind::Grid(_) => f64::INFINITY,
            _ => (0.25 * self.thickness).max(2e-6),
        };
        let flat = (8.0 * sagitta / bend).sqrt().min(0.25 / bend);
        let longest = flat.min(self.body.shape.feature_length()).max(length / MOST_PIECES as f64);
        let count = ((length / longest).ceil() as usize).clamp(1, MOST_PIECES);
        let nodes = &mut self.scratch.nodes;
        nodes.clear();
        for node in 0..=count {
            let s = if node == count { high } else { low + length * (node as f64 / count as f64) };
            let ((before, _), (now, tangent)) = (path.start.at(s), path.now.at(s));
            nodes.push(Node { s, before, now, tangent, sample: None, clear: Clear::OfReach });
        }
        length / count as f64
    }

    /// Adds the minima between nodes and the ends.
    fn minima(&mut self, index: usize, ground: &Ground, path: &ElementPath, nodes: &[Node]) {
        let limit = self.thickness + self.within;
        let (left, right) = (nodes[0], nodes[nodes.len() - 1]);
        // From a steep end it falls to something that is nearer or deeper: the end is held by that, and must not be pushed along the strand.
        let held = |sample: &Sample<Surface>, falls: bool| sample.value < limit && !(falls && sample.slope.abs() > STEEP);
        if self.first
            && let Some(sample) = left.sample.filter(|sample| held(sample, sample.slope < 0.0))
        {
            self.add(index, &sample);
        }
        // A minimum counts when it lies lower than the touch to its left, or beyond a crest; the left end is the element before's touch.
        let mut before = left.sample.map_or(f64::INFINITY, |sample| sample.value);
        let mut crest = before;
        let mut added = 0;
        let from = self.out.len();
        self.scratch.more.clear();
        let mut pieces = std::mem::take(&mut self.scratch.pieces);
        let mut close = std::mem::take(&mut self.scratch.close);
        for pair in nodes.windows(2) {
            if pair.iter().any(|node| matches!(node.clear, Clear::Of(_))) {
                (before, crest) = (f64::INFINITY, f64::INFINITY);
                continue;
            }
            close_to(ground, path, pair, limit, &mut close);
            // Between places outside nothing is looked for deep inside, unless the surface is between them.
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
                // The slope is at most 1; where nothing was found the surface is farther than the reach.
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
                    // Where the mean slope is none between those at the ends, there is more to it than they tell.
                    let told = samples[0].zip(samples[1]).is_some_and(|(a, b)| {
                        let mean = (b.value - a.value) / length;
                        mean >= a.slope.min(b.slope) - 1e-3 && mean <= a.slope.max(b.slope) + 1e-3
                    });
                    if !told && depth < DEEPEST_SPLIT {
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
                self.overlooked(ground, path, &[pair[0], pair[1]], &close, from);
            }
        }
        (self.scratch.pieces, self.scratch.close) = (pieces, close);
        let tip = index + 1 == self.path.now.elements.len();
        if let Some(sample) = right.sample.filter(|sample| held(sample, !tip || sample.slope > 0.0)) {
            // A minimum from which it rises to the end by nothing that counts is the end's own.
            if added > 0 && crest.max(sample.value) - before < PROMINENCE {
                self.out.pop();
            }
            self.add(index, &sample);
        }
        for place in 0..self.scratch.more.len() {
            let found = self.scratch.more[place];
            let gap = found.value - self.thickness;
            // A deeper touch close by is worth more; what is left then is found when that is resolved.
            let seen = self.out[from..].iter().any(|touch| {
                let off = (touch.place.s - found.s).abs();
                off < 2e-3 && touch.gap <= gap || off < 2e-4 && touch.gap <= gap + overlooked::TOLERANCE
            });
            if !seen {
                self.add(index, &found);
            }
        }
    }

    /// Takes down what overlaps between two nodes on triangles that have no touch there.
    fn overlooked(&mut self, ground: &Ground, path: &ElementPath, nodes: &[Node; 2], close: &[Ball], from: usize) {
        for ball in close {
            // A triangle has one minimum.
            let of_it = |touch: &Touch| matches!(touch.partner, Partner::Body { feature, .. } if feature == ball.triangle);
            if self.out[from..].iter().any(|touch| of_it(touch) && touch.place.s >= nodes[0].s) {
                continue;
            }
            if let Some(found) = overlooked(ground, path, nodes, ball, self.thickness) {
                self.scratch.more.push(found);
            }
        }
    }

    fn add(&mut self, index: usize, sample: &Sample<Surface>) {
        self.push(index, sample.s, &sample.found, sample.value - self.thickness);
    }

    fn push(&mut self, index: usize, s: f64, surface: &Surface, gap: f64) {
        self.out.push(Touch {
            place: Place { strand: self.path.index, element: index as u32, s },
            partner: Partner::Body { body: self.body.index, feature: surface.feature },
            normal: self.body.axes_end * surface.normal,
            gap,
            carried: self.body.carried(surface),
        });
    }

    /// Sees to it that a piece of strand that ran into the body stays on the side that it came from.
    #[allow(clippy::too_many_arguments)] // Each is another thing, and all are needed.
    fn keep_side(&mut self, index: usize, path: &ElementPath, piece: f64, from: usize, s: f64, hit: &Surface, ground: &Ground) {
        /// Cosine of the angle up to which the nearest surface's normal counts as that of the side that was hit.
        const ALIKE: f64 = 0.7;
        let (now, _) = path.now.at(s);
        let gap = hit.normal.dot(&(now - hit.point)) - self.thickness;
        if gap >= self.within {
            return;
        }
        // It is still on the side that it came from where the nearest surface is much like the one that it ran into; outside, even where a
        // corner lies between: hair that is drawn round a chin goes through it on the straight way of a step. How deep it is the nearest
        // surface tells then, not the plane of where it was hit.
        let nearest = ground.ask(|| path.start.at(s).0, now, None).filter(|nearest| {
            let same = nearest.normal.dot(&hit.normal);
            same >= ALIKE || same > 0.0 && nearest.distance >= self.thickness
        });
        let least = if nearest.is_some() { 0.0 } else { ALIKE };
        let normal = self.body.axes_end * hit.normal;
        let mut kept = from;
        let mut deepest: Option<Touch> = None;
        for touch in from..self.out.len() {
            let other = self.out[touch];
            if (other.place.s - s).abs() > piece || other.normal.dot(&normal) >= least {
                self.out[kept] = other;
                kept += 1;
            } else if deepest.is_none_or(|deepest| other.gap < deepest.gap) {
                deepest = Some(other);
            }
        }
        self.out.truncate(kept);
        match nearest {
            Some(nearest) => {
                let gap = nearest.distance - self.thickness;
                let is_beside = |out: &[Touch], gap: f64| {
                    out.iter().any(|touch| (touch.place.s - s).abs() <= piece && touch.gap <= 0.5 * gap)
                };
                // Outside there is none but those that are near.
                if gap < 0.0 && !is_beside(&self.out[from..], gap) {
                    self.push(index, s, &nearest, gap);
                }
                // What is deeper in the body, up to its far side, came with it: the plane that was hit holds it off.
                if let Some(lost) = deepest.filter(|lost| lost.gap < gap.min(0.0) && !is_beside(&self.out[from..], lost.gap)) {
                    let gap = hit.normal.dot(&(path.now.at(lost.place.s).0 - hit.point)) - self.thickness;
                    if gap < 0.0 {
                        self.push(index, lost.place.s, hit, gap);
                    }
                }
            }
            None => self.push(index, s, hit, gap),
        }
    }
}

/// Picks the triangles of a mesh that can be nearest to a place between two nodes.
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
    // Along the chord the distance to one triangle is convex, so that it is nowhere farther than at the farther end.
    for (here, there) in [(left, right), (right, left)] {
        if let Some(sample) = here.sample {
            let there = mesh.flat(sample.found.feature).distance_squared(&there.now).sqrt();
            radius = radius.min(sample.value.abs().max(there) + 2.0 * sagitta);
        }
    }
    ground.patch.pick(&Tube { ends: [left.now, right.now], radius }, close);
}
