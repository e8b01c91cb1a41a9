//! Strand against body: where a strand's elements touch a body, or soon may.
//!
//! Along an element the body's signed distance is a function of arclength. Its minima are found between nodes, from its values and slopes
//! there, and refined on the exact helix. Where a piece of the element may have gone through the body within the step, its way is swept
//! (`sweep.rs`), and the side that it came from counts.

use nalgebra::Vector3;

use super::body::BodyAt;
use super::descent::{self, Sample};
use super::element_path::ElementPath;
use super::shape::{Bounds, Candidate, Kind, Mesh, Sides, Surface};
use super::sweep::{Hit, MovingChord, Near, first_hit};
use super::touch::{Partner, Place, StrandPath, Touch};

/// How much deeper than an element's end or its neighbour a minimum must be to count as a touch of its own, and to what it is found, m:
/// once the touches are resolved, nothing in between is deeper than about twice this.
const PROMINENCE: f64 = 2e-7;

/// Most pieces into which an element is cut.
const MOST_PIECES: usize = 64;

/// How often a piece is halved where its ends' slopes do not tell what lies between.
const DEEPEST_SPLIT: usize = 4;

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
    candidates: Vec<Candidate>,
    nodes: Vec<Node>,
    hits: Vec<(f64, Surface)>,
    pieces: Vec<(Sample<Surface>, Sample<Surface>, usize)>,
}

/// A node of an element: the element is looked at there first.
#[derive(Debug, Clone, Copy)]
struct Node {
    s: f64,
    before: Vector3<f64>,
    now: Vector3<f64>,
    tangent: Vector3<f64>,
    sample: Option<Sample<Surface>>,
}

/// Finds where a strand touches a body at the present iterate, or is nearer than `within` (m) to it, and adds the touches to `out`, sorted
/// by element and arclength. `bounds` are those of `path`; `radius` (m) is the strand's. Nothing is allocated once the lists have grown.
///
/// Every local minimum of the distance along an element is a touch, and every end of an element that is near enough (the end between two
/// elements belongs to the first). A strand that went through the body during the step touches it from the side that it came from, with a
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
    let near = body.bounds.grown(thickness + within + turning_slack(bounds, body));
    if !bounds.whole.meets(&near) {
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
        if bounds.elements[element].meets(&near) {
            search.element(element, low, state.length);
        } else {
            search.inside = Some(false);
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

/// What is asked for the distance of a point in the body's axes.
struct Ground<'a> {
    body: &'a BodyAt<'a>,
    mesh: Option<&'a Mesh>,
    candidates: &'a [Candidate],
    reach: f64,
}

impl Ground<'_> {
    /// The surface nearest to `now`, for a point that was at `before`; None if it is farther than the reach.
    fn ask(&self, before: impl FnOnce() -> Vector3<f64>, now: Vector3<f64>, inside: Option<bool>) -> Option<Surface> {
        let Some(mesh) = self.mesh else {
            return match &self.body.shape.0 {
                Kind::Grid(grid) => grid.closest(now),
                _ => Some(self.body.shape.closest_smooth(now)),
            };
        };
        let mut surface = mesh.closest_among(self.candidates, self.reach, inside, now)?;
        if mesh.sides() == Sides::Both && Mesh::crosses(self.candidates, &before(), &now) {
            surface.distance = -surface.distance;
            surface.normal = -surface.normal;
        }
        Some(surface)
    }
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
            Kind::Grid(grid) => grid.closest(centre).map_or_else(|| grid.clearance(&centre), |surface| surface.distance) > far,
            _ => shape.closest_smooth(centre).distance > far,
        };
        if clear {
            self.inside = Some(false);
            return;
        }
        let piece = self.place_nodes(&path, low, high);
        let reach = self.thickness + self.within + piece;
        let travel = self.scratch.nodes.iter().map(|node| (node.now - node.before).norm_squared()).fold(0.0, f64::max).sqrt();
        let travel = travel + mesh.map_or(0.0, Mesh::farthest_travel);
        let swept = travel > 0.5 * self.thickness + shape.thinness();
        if let Some(mesh) = mesh {
            let sagitta = 0.125 * piece * piece * path.now.bend().max(path.start.bend());
            let points = self.scratch.nodes.iter().flat_map(|node| [node.before, node.now]);
            mesh.gather(&Bounds::of_points(points).grown(reach + sagitta), &mut self.scratch.candidates);
            if self.scratch.candidates.is_empty() {
                if mesh.sides() != Sides::Solid || self.inside == Some(false) {
                    return;
                }
            }
        }
        let candidates = std::mem::take(&mut self.scratch.candidates);
        let mut nodes = std::mem::take(&mut self.scratch.nodes);
        let mut hits = std::mem::take(&mut self.scratch.hits);
        let ground = Ground { body: self.body, mesh, candidates: &candidates, reach };
        hits.clear();
        if swept {
            self.sweep(&ground, &nodes, &mut hits);
        }
        for node in &mut nodes {
            let surface = ground.ask(|| node.before, node.now, self.inside);
            if let Some(surface) = &surface {
                self.inside = Some(surface.distance < 0.0);
            } else if self.inside.is_none() {
                self.inside = Some(false);
            }
            node.sample = surface.map(|found| sample(node.s, found, &node.tangent));
        }
        let from = self.out.len();
        self.minima(index, &ground, &path, &nodes);
        for (s, hit) in &hits {
            self.keep_side(index, &path, piece, from, *s, hit, &ground);
        }
        self.out[from..].sort_by(|a, b| a.place.s.total_cmp(&b.place.s));
        (self.scratch.candidates, self.scratch.nodes, self.scratch.hits) = (candidates, nodes, hits);
    }

    /// Cuts the element into pieces that bend by little and are no longer than the body's features; their length.
    fn place_nodes(&mut self, path: &ElementPath, low: f64, high: f64) -> f64 {
        let bend = path.now.bend().max(path.start.bend());
        let length = high - low;
        // A quarter of the thickness for the chord's sagitta, a quarter of a radian for its turn.
        let flat = (8.0 * (0.25 * self.thickness).max(2e-6) / bend).sqrt().min(0.25 / bend);
        let longest = flat.min(self.body.shape.feature_length()).max(length / MOST_PIECES as f64);
        let count = ((length / longest).ceil() as usize).clamp(1, MOST_PIECES);
        let nodes = &mut self.scratch.nodes;
        nodes.clear();
        for node in 0..=count {
            let s = if node == count { high } else { low + length * (node as f64 / count as f64) };
            let ((before, _), (now, tangent)) = (path.start.at(s), path.now.at(s));
            nodes.push(Node { s, before, now, tangent, sample: None });
        }
        length / count as f64
    }

    /// Adds the minima between nodes and the ends.
    fn minima(&mut self, index: usize, ground: &Ground, path: &ElementPath, nodes: &[Node]) {
        let limit = self.thickness + self.within;
        let (left, right) = (nodes[0], nodes[nodes.len() - 1]);
        if self.first
            && let Some(sample) = left.sample.filter(|sample| sample.value < limit)
        {
            self.add(index, &sample);
        }
        // A minimum counts when it lies lower than the touch to its left, or beyond a crest; the left end is the element before's touch.
        let mut before = left.sample.map_or(f64::INFINITY, |sample| sample.value);
        let mut crest = before;
        let mut added = 0;
        let ask = |s: f64| {
            let (now, tangent) = path.now.at(s);
            ground.ask(|| path.start.at(s).0, now, None).map(|surface| sample(s, surface, &tangent))
        };
        let mut pieces = std::mem::take(&mut self.scratch.pieces);
        for pair in nodes.windows(2) {
            let (Some(a), Some(b)) = (pair[0].sample, pair[1].sample) else {
                (before, crest) = (f64::INFINITY, f64::INFINITY);
                continue;
            };
            pieces.clear();
            pieces.push((a, b, 0));
            while let Some((a, b, depth)) = pieces.pop() {
                crest = crest.max(a.value);
                // The slope is at most 1.
                let length = b.s - a.s;
                if 0.5 * (a.value + b.value - length) >= limit {
                    continue;
                }
                if !(a.slope < 0.0 && b.slope >= 0.0) {
                    // Where the mean slope is none between those at the ends, there is more to it than they tell.
                    let mean = (b.value - a.value) / length;
                    let told = mean >= a.slope.min(b.slope) - 1e-3 && mean <= a.slope.max(b.slope) + 1e-3;
                    // In contact one look between is always worth it.
                    let look = depth == 0 && a.value.min(b.value) < limit;
                    if (look || !told)
                        && depth < DEEPEST_SPLIT
                        && let Some(middle) = ask(0.5 * (a.s + b.s))
                    {
                        pieces.push((middle, b, depth + 1));
                        pieces.push((a, middle, depth + 1));
                    }
                    continue;
                }
                let found = descent::lowest(a, b, 0.5 * PROMINENCE, ask);
                let counts = found.value < before.max(crest) - PROMINENCE;
                if found.value < limit && counts && found.s > left.s && found.s < right.s {
                    self.add(index, &found);
                    added += 1;
                    (before, crest) = (found.value, found.value);
                }
            }
        }
        self.scratch.pieces = pieces;
        if let Some(sample) = right.sample.filter(|sample| sample.value < limit) {
            // A minimum from which it rises to the end by nothing that counts is the end's own.
            if added > 0 && crest.max(sample.value) - before < PROMINENCE {
                self.out.pop();
            }
            self.add(index, &sample);
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

    /// Finds where the element's pieces run into the body on their way: arclength and the surface there, as it is at the end.
    fn sweep(&self, ground: &Ground, nodes: &[Node], hits: &mut Vec<(f64, Surface)>) {
        let level = (0.5 * self.thickness).max(1e-6);
        for pair in nodes.windows(2) {
            let chord = MovingChord { before: [pair[0].before, pair[1].before], after: [pair[0].now, pair[1].now] };
            if let Some(hit) = self.sweep_chord(ground, &chord, level) {
                let s = pair[0].s + (pair[1].s - pair[0].s) * hit.place;
                // Pieces share their ends.
                if hits.last().is_none_or(|(last, _)| (s - last).abs() > 1e-6) {
                    hits.push((s, hit.near.what));
                }
            }
        }
        // What is flat may be hit all along: where a piece is hit, its ends are seen to as well.
        let chord_hits = hits.len();
        for (k, node) in nodes.iter().enumerate() {
            let beside = |s: f64| s >= nodes[k.saturating_sub(1)].s && s <= nodes[(k + 1).min(nodes.len() - 1)].s;
            if hits[..chord_hits].iter().any(|(s, _)| beside(*s)) && hits.iter().all(|(s, _)| (s - node.s).abs() > 1e-6) {
                let point = MovingChord { before: [node.before; 2], after: [node.now; 2] };
                if let Some(hit) = self.sweep_chord(ground, &point, level) {
                    hits.push((node.s, hit.near.what));
                }
            }
        }
        // Pieces that start within a solid mesh come from where they are nearest to its surface then.
        if let Some(mesh) = ground.mesh.filter(|mesh| mesh.sides() == Sides::Solid && !mesh.is_moving()) {
            for node in nodes {
                let start = mesh.closest_among(ground.candidates, ground.reach, Some(false), node.before);
                if let Some(surface) = start.filter(|surface| surface.distance <= level) {
                    hits.push((node.s, surface));
                }
            }
        }
        if let Kind::Grid(grid) = &self.body.shape.0 {
            super::sweep::along_nodes(
                nodes.iter().map(|node| (node.s, node.before, node.now)),
                level,
                0.5 * grid.cell(),
                |point| grid.closest(point).ok_or_else(|| grid.clearance(&point)),
                hits,
            );
        }
    }

    /// Where a piece that goes straight runs into the body. A half-space has no other side, and a grid is swept by nodes.
    fn sweep_chord(&self, ground: &Ground, chord: &MovingChord, level: f64) -> Option<Hit<Surface>> {
        match (&self.body.shape.0, ground.mesh) {
            (_, Some(mesh)) => self.sweep_mesh(mesh, ground.candidates, chord, level),
            (Kind::Grid(_) | Kind::HalfSpace { .. }, _) => None,
            _ => first_hit(chord, level, |point, _| {
                let surface = self.body.shape.closest_smooth(*point);
                Near { normal: surface.normal, distance: surface.distance, coming: 0.0, what: surface }
            }),
        }
    }

    fn sweep_mesh(&self, mesh: &Mesh, candidates: &[Candidate], chord: &MovingChord, level: f64) -> Option<Hit<Surface>> {
        let swept = Bounds::of_points(chord.before.into_iter().chain(chord.after)).grown(1.1 * level);
        let mut earliest: Option<Hit<Surface>> = None;
        for candidate in candidates {
            let before: [Vector3<f64>; 3] = std::array::from_fn(|corner| candidate.corners[corner] - candidate.travel[corner]);
            if !swept.meets(&Bounds::of_points(candidate.corners.into_iter().chain(before))) {
                continue;
            }
            let hit = first_hit(chord, level, |point, time| {
                let corners: [Vector3<f64>; 3] = std::array::from_fn(|corner| before[corner] + candidate.travel[corner] * time);
                let (weights, on, out) = Mesh::closest_on(&corners, point);
                let distance = out.norm();
                let normal = if distance > 0.0 { out / distance } else { mesh.face_normal(candidate.index) };
                let coming = if mesh.is_moving() {
                    candidate.travel.iter().map(|travel| travel.dot(&normal)).fold(f64::NEG_INFINITY, f64::max)
                } else {
                    0.0
                };
                let what = Surface { point: on, normal, distance, feature: candidate.index, weights };
                Near { normal, distance, coming, what }
            });
            let Some(mut hit) = hit else { continue };
            let face = mesh.face_normal(candidate.index);
            // A one-sided mesh stops nothing that comes from behind.
            if mesh.sides() != Sides::Both && hit.near.normal.dot(&face) <= 0.0 {
                continue;
            }
            if earliest.is_none_or(|earliest| hit.time < earliest.time) {
                let surface = &mut hit.near.what;
                surface.point = (0..3).map(|corner| candidate.corners[corner] * surface.weights[corner]).sum();
                earliest = Some(hit);
            }
        }
        earliest
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
        let normal = self.body.axes_end * hit.normal;
        let mut kept = from;
        for touch in from..self.out.len() {
            let other = self.out[touch];
            if (other.place.s - s).abs() > piece || other.normal.dot(&normal) >= ALIKE {
                self.out[kept] = other;
                kept += 1;
            }
        }
        self.out.truncate(kept);
        // Where the nearest surface is that which was hit, the touches beside it say more.
        let at_place = ground.ask(|| path.start.at(s).0, now, None);
        let beside = self.out[from..].iter().any(|touch| (touch.place.s - s).abs() <= piece);
        let found_anyway = beside
            && at_place.is_some_and(|surface| {
                surface.distance < self.thickness + self.within && surface.normal.dot(&hit.normal) >= ALIKE
            });
        if !found_anyway {
            self.push(index, s, hit, gap);
        }
    }
}

fn sample(s: f64, found: Surface, tangent: &Vector3<f64>) -> Sample<Surface> {
    Sample { s, value: found.distance, slope: found.normal.dot(tangent), found }
}
