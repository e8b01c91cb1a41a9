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
//! - `minima.rs`: The minima of a body's distance along an element, between nodes and at the ends.
//! - `scratch.rs`: Memory of a search of a strand and a body, kept from call to call.

mod found;
mod minima;
mod scratch;

use std::cell::Cell;

use nalgebra::Vector3;

pub use scratch::BodySearchScratch;

use super::element_path::ElementPath;
use super::ground::{Ground, Node, sample};
use super::path_bounds::PathBounds;
use crate::contact::body_at::BodyAt;
use crate::contact::ccd::body_sweep;
use crate::contact::contact_point::{ContactPoint, StrandPath};
use crate::contact::shape::{Bounds, Kind, Mesh, Sides, Tube};

/// The largest number of pieces of an element.
const MAX_PIECES: usize = 64;

/// The tree of a mesh is searched in a box larger than an element needs by this fraction of its length, so that the result is
/// valid for a while.
const MARGIN: f64 = 0.3;

/// Costs of a search in nanoseconds or so: of an element's bounds; of an element that may be near; of each of its nodes; and
/// of each triangle about it, for every node.
const WORK_A_BOUND: u64 = 100;
const WORK_AN_ELEMENT: u64 = 200;
const WORK_A_NODE: u64 = 400;
const WORK_A_TRIANGLE: u64 = 120;

/// The part of a strand that takes part in contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Span<'a> {
    /// Arclength from the root, m, without contact: the part in and about the follicle.
    pub exempt: f64,
    /// Elements whose contacts are known, and which are passed over. None beyond the list.
    pub unmoved: &'a [bool],
}

/// Finds the contacts of a strand with a body at the present iterate, up to a gap of `within` (m), and appends them to `out`,
/// sorted by element and arclength. `bounds` are those of `path`; `radius` (m) is the strand's. Returns the cost in nanoseconds or
/// so. Nothing is allocated once the lists have grown.
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
) -> u64 {
    let thickness = radius + body.thickness;
    let (margin, slack) = (thickness + within, turning_slack(bounds, body));
    if body.is_clear_of(&bounds.whole, margin, slack) {
        return WORK_A_BOUND;
    }
    let work = WORK_A_BOUND * path.now.elements.len() as u64;
    let mut search = Search { path, body, thickness, within, inside: None, first: true, work, scratch, out };
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
    search.work
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
    /// The cost so far.
    work: u64,
    scratch: &'b mut BodySearchScratch,
    out: &'b mut Vec<ContactPoint>,
}

impl Search<'_, '_> {
    fn element(&mut self, index: usize, low: f64, high: f64) {
        self.work += WORK_AN_ELEMENT;
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
        // Shapes without a mesh are asked on the arc between nodes, too; the sweep of a convex one takes chords for it.
        let sagitta = if mesh.is_some() { self.flat() } else { f64::INFINITY };
        let mut piece = self.place_nodes(&path, low, high, sagitta);
        let swept = self.is_swept();
        if swept && shape.is_smooth_convex() {
            piece = self.place_nodes(&path, low, high, self.flat());
        }
        // Distances at nodes a little beyond the limit show where the distance falls.
        let reach =
            self.thickness + self.within + if mesh.is_some() { 0.1 * piece } else { 0.5 * shape.distance_slope() * piece };
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
        let triangles = if mesh.is_some() { patch.triangles.len() as u64 } else { 0 };
        self.work += nodes.len() as u64 * (WORK_A_NODE + WORK_A_TRIANGLE * triangles);
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

    /// The sagitta with which a piece passes for its chord, m: a quarter of the thickness.
    fn flat(&self) -> f64 {
        (0.25 * self.thickness).max(2e-6)
    }

    /// Whether the nodes move so far within the step that they may pass through the body.
    fn is_swept(&self) -> bool {
        let travel = self.scratch.nodes.iter().map(|node| (node.now - node.before).norm_squared()).fold(0.0, f64::max).sqrt();
        let shape = self.body.shape;
        travel + shape.mesh().map_or(0.0, Mesh::farthest_travel) > 0.5 * self.thickness + shape.thinness()
    }

    /// Cuts the element into pieces that turn by a quarter of a radian at most, have no larger `sagitta` (m), and are no longer
    /// than the body's features; returns their length.
    fn place_nodes(&mut self, path: &ElementPath, low: f64, high: f64, sagitta: f64) -> f64 {
        let bend = path.now.bend().max(path.start.bend());
        let length = high - low;
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
}
