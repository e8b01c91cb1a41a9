//! The triangles of a mesh that are near a piece of strand.
//!
//! Picked in two looks: the tree of boxes is asked for a box larger than what is needed, and the answer kept for as long as what is needed
//! stays within that box; of those triangles the few are taken that a capsule around the piece reaches.

use std::cell::Cell;

use nalgebra::Vector3;
use parry3d_f64::partitioning::{BvhNode, TraversalAction};

use super::bounds::Bounds;
use super::flat_triangle::FlatTriangle;
use super::mesh::Mesh;

/// Triangles whose boxes over the step meet a box.
#[derive(Debug, Clone)]
pub(in crate::contact) struct Region {
    /// Of the mesh, see [`Mesh::stamp`].
    stamp: u64,
    held: Bounds,
    /// In the order of the mesh, so that what comes of them does not depend on the tree.
    triangles: Vec<u32>,
}

impl Default for Region {
    fn default() -> Self {
        Self { stamp: 0, held: Bounds::EMPTY, triangles: Vec::new() }
    }
}

impl Region {
    /// Sees to it that all triangles are known whose boxes meet `bounds`; where they are not, the tree is asked for a box larger by `margin`.
    pub fn cover(&mut self, mesh: &Mesh, bounds: &Bounds, margin: f64) {
        if self.stamp == mesh.stamp() && self.held.holds(&bounds.low) && self.held.holds(&bounds.high) {
            return;
        }
        (self.stamp, self.held) = (mesh.stamp(), bounds.grown(margin));
        self.triangles.clear();
        let (low, high) = (self.held.low, self.held.high);
        mesh.bvh.traverse(|node: &BvhNode| {
            let (mins, maxs) = (node.mins(), node.maxs());
            if mins.x > high.x || maxs.x < low.x || mins.y > high.y || maxs.y < low.y || mins.z > high.z || maxs.z < low.z {
                return TraversalAction::Prune;
            }
            if let Some(index) = node.leaf_data() {
                self.triangles.push(index);
            }
            TraversalAction::Continue
        });
        self.triangles.sort_unstable();
    }
}

/// A triangle near a piece of strand.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Candidate {
    /// Its index.
    pub index: u32,
    /// Its corners at the step's end.
    pub corners: [Vector3<f64>; 3],
    /// How far they go during the step; zero for meshes at rest.
    pub travel: [Vector3<f64>; 3],
    /// The face's unit normal at the end; zero where it has lost its area.
    pub normal: Vector3<f64>,
    /// The same triangle at the end, for its distance.
    pub flat: FlatTriangle,
    /// A box around it over the step.
    pub bounds: Bounds,
}

impl Candidate {
    /// Its corners at the step's start.
    pub fn before(&self) -> [Vector3<f64>; 3] {
        std::array::from_fn(|corner| self.corners[corner] - self.travel[corner])
    }

    /// Height of a point over its plane at the step's end, m.
    #[inline]
    pub fn height(&self, point: &Vector3<f64>) -> f64 {
        self.normal.dot(&(point - self.corners[0]))
    }
}

/// A ball around a candidate.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Ball {
    pub centre: Vector3<f64>,
    pub radius: f64,
    pub candidate: u32,
}

/// A capsule: all within `radius` of a segment, m.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Tube {
    /// The segment's ends.
    pub ends: [Vector3<f64>; 2],
    /// The capsule's radius, m.
    pub radius: f64,
}

impl Tube {
    /// Whether a ball reaches into it.
    #[inline]
    pub fn meets(&self, centre: &Vector3<f64>, radius: f64) -> bool {
        let (along, to) = (self.ends[1] - self.ends[0], centre - self.ends[0]);
        let squared = along.norm_squared();
        let u = if squared > 0.0 { (along.dot(&to) / squared).clamp(0.0, 1.0) } else { 0.0 };
        let far = radius + self.radius;
        (to - along * u).norm_squared() <= far * far
    }
}

/// Triangles near a piece of strand.
#[derive(Debug, Clone, Default)]
pub(in crate::contact) struct Patch {
    /// In the order of the mesh.
    pub candidates: Vec<Candidate>,
    /// Those that are near the piece as it is now.
    pub near: Vec<Ball>,
    /// The candidate found nearest last.
    pub hint: Cell<u32>,
}

impl Patch {
    /// Takes the triangles of a region that reach into the tube, and, with a box, those that meet it: they are candidates, but not near.
    pub fn take(&mut self, mesh: &Mesh, region: &Region, tube: &Tube, wide: Option<&Bounds>) {
        self.candidates.clear();
        self.near.clear();
        self.hint.set(u32::MAX);
        for index in &region.triangles {
            let (centre, radius) = mesh.balls[*index as usize];
            let near = tube.meets(&centre, radius);
            if near {
                self.near.push(Ball { centre, radius, candidate: self.candidates.len() as u32 });
            } else if wide.is_none_or(|wide| wide.distance_squared(&centre) > radius * radius) {
                continue;
            }
            let corners = mesh.corners(*index);
            let mut bounds = Bounds::of_points(corners);
            let mut travel = [Vector3::zeros(); 3];
            if mesh.is_moving() {
                let before = mesh.corners_before(*index);
                travel = std::array::from_fn(|corner| corners[corner] - before[corner]);
                before.into_iter().for_each(|corner| bounds.take(corner));
            }
            let normal = mesh.face_normal(*index);
            let flat = FlatTriangle::new(&corners, &normal);
            self.candidates.push(Candidate { index: *index, corners, travel, normal, flat, bounds });
        }
    }

    /// Whether the way from `from` to `to` goes through an odd number of the candidates.
    pub fn is_crossed(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
        let mut odd = false;
        for candidate in &self.candidates {
            let [a, b, c] = &candidate.corners;
            // As seen from the triangle, which may move itself.
            let [p, q, r] = candidate.travel;
            let from = &(from + (p + q + r) / 3.0);
            if (candidate.height(from) < 0.0) == (candidate.height(to) < 0.0) {
                continue;
            }
            let way = to - from;
            // The signed volumes of the way with the edges: all of one sign when it passes between them.
            let volume = |p: &Vector3<f64>, q: &Vector3<f64>| way.dot(&(p - from).cross(&(q - from)));
            let volumes = [volume(a, b), volume(b, c), volume(c, a)];
            if volumes.iter().all(|volume| *volume >= 0.0) || volumes.iter().all(|volume| *volume < 0.0) {
                odd = !odd;
            }
        }
        odd
    }
}
