//! The triangles of a mesh that are near a piece of strand.
//!
//! Picked in two looks: the tree of boxes is asked for a box larger than what is needed, and the answer kept for as long as what is needed
//! stays within that box; of those triangles the few are taken that a capsule around the piece reaches.

use nalgebra::Vector3;
use parry3d_f64::partitioning::{BvhNode, TraversalAction};

use super::flat_triangle::FlatTriangle;
use super::triangle_mesh::Mesh;
use crate::contact::shape::Bounds;

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

/// A ball around a triangle.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Ball {
    pub centre: Vector3<f64>,
    pub radius: f64,
    pub triangle: u32,
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
    pub triangles: Vec<u32>,
    /// Those of them that are near the piece as it is now.
    pub near: Vec<Ball>,
}

impl Patch {
    /// Takes the triangles of a region that reach into the tube, and, with a box, those that meet it: these are not near.
    pub fn take(&mut self, mesh: &Mesh, region: &Region, tube: &Tube, wide: Option<&Bounds>) {
        self.triangles.clear();
        self.near.clear();
        for index in &region.triangles {
            let (centre, radius) = mesh.balls[*index as usize];
            if tube.meets(&centre, radius) {
                self.near.push(Ball { centre, radius, triangle: *index });
            } else if wide.is_none_or(|wide| wide.distance_squared(&centre) > radius * radius) {
                continue;
            }
            self.triangles.push(*index);
        }
    }

    /// Picks those of the near triangles that reach into a tube.
    pub fn pick(&self, tube: &Tube, out: &mut Vec<Ball>) {
        out.clear();
        out.extend(self.near.iter().filter(|ball| tube.meets(&ball.centre, ball.radius)));
    }

    /// Whether the path from `from` at the step's start to `to` at its end goes through an odd number of the triangles.
    pub fn is_crossed(&self, mesh: &Mesh, from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
        // As seen from the triangle, which may move itself.
        let from = |index: u32| from + mesh.travel_of(index).iter().sum::<Vector3<f64>>() / 3.0;
        let through = self.triangles.iter().filter(|index| mesh.flat(**index).is_pierced(&from(**index), to));
        through.count() % 2 == 1
    }

    /// Whether something straight between two places at the step's end goes through any of the triangles.
    pub fn is_pierced(&self, mesh: &Mesh, from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
        self.triangles.iter().any(|index| mesh.flat(*index).is_pierced(from, to))
    }
}

impl Mesh {
    /// A triangle at the step's end.
    #[inline]
    pub(in crate::contact) fn flat(&self, triangle: u32) -> &FlatTriangle {
        &self.flats[triangle as usize]
    }

    /// How far its corners go during the step, m.
    #[inline]
    pub(in crate::contact) fn travel_of(&self, triangle: u32) -> [Vector3<f64>; 3] {
        if !self.is_moving() {
            return [Vector3::zeros(); 3];
        }
        let (before, after) = (self.corners_before(triangle), self.corners(triangle));
        std::array::from_fn(|corner| after[corner] - before[corner])
    }
}
