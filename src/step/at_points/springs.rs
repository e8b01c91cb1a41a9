//! The springs that contact gives to the quadrature points (`contacts.rs`), in lanes: each point has one along the normal of a surface and
//! one along the surface. Where several surfaces hold a point of any lane, all points have room for the springs of as many.

use super::halfway::HalfwayPlaces;
use super::places::{Known, Near};
use super::probes::{Candidates, Point, Start};
use super::surfaces::DepthAtPoints;
use crate::chain::system::{ChainSystem, springs_of};
use crate::math::lane::{Lane, MAX_LANES};
use crate::math::vector::Vec3;

/// The springs of contact, with what is known of every point.
///
/// The lists `offsets`, `planes`, `friction` and `anchors`, and the system's normals and their stiffness, hold an item for each
/// point, and as many again for each surface more that holds any point.
#[derive(Debug, Clone)]
pub struct PointContacts<T> {
    /// n·r where a point's normal spring rests; r relative to the root's origin at the end of the step.
    pub offsets: Vec<T>,
    /// k of the points with a surface near them; zero for others.
    pub planes: Vec<T>,
    /// Stiffness c of friction, and where it holds a point, relative to the root's origin at the end of the step.
    pub(super) friction: Vec<T>,
    pub(super) anchors: Vec<Vec3<T>>,
    /// Stiffnesses and targets of the points without contact.
    pub(super) free_stiffness: Vec<T>,
    free_target: Vec<Vec3<T>>,
    /// By lane, its points from root to tip.
    pub(super) known: Vec<Known>,
    pub(super) near: Near,
    pub(super) starts: Vec<Start>,
    /// Memory for the points of a lane, and what is asked of them.
    pub(super) points: Vec<Point>,
    pub(super) candidates: Candidates,
    pub(super) halfway: HalfwayPlaces,
    /// The overlaps at the end, by lane.
    pub depth: [DepthAtPoints; MAX_LANES],
}

impl<T> Default for PointContacts<T> {
    fn default() -> Self {
        Self {
            offsets: Vec::new(),
            planes: Vec::new(),
            friction: Vec::new(),
            anchors: Vec::new(),
            free_stiffness: Vec::new(),
            free_target: Vec::new(),
            known: Vec::new(),
            near: Near::default(),
            starts: Vec::new(),
            points: Vec::new(),
            candidates: Candidates::default(),
            halfway: HalfwayPlaces::default(),
            depth: [DepthAtPoints::NONE; MAX_LANES],
        }
    }
}

/// The springs of one point in one lane against one of the surfaces near it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spring {
    pub lane: usize,
    pub p: usize,
    /// Which of the point's surfaces.
    pub slot: usize,
}

impl Spring {
    /// Its place in the lists of a strand with so many points.
    pub fn index(self, points: usize) -> usize {
        self.slot * points + self.p
    }
}

impl<T: Lane> PointContacts<T> {
    /// Begins a step of so many strands, whose points have the springs of the system alone.
    pub(super) fn begin(&mut self, system: &mut ChainSystem<T>, targets: &[Vec3<T>], strands: usize) {
        let points = targets.len();
        for list in [&mut self.offsets, &mut self.planes, &mut self.friction, &mut system.normal_stiffness] {
            refill(list, points, T::zero());
        }
        for list in [&mut self.anchors, &mut system.normals] {
            refill(list, points, Vec3::zero());
        }
        refill(&mut self.known, points * strands, Known::NOTHING);
        self.near.clear();
        self.free_stiffness.clone_from(&system.point_stiffness);
        self.free_target.clear();
        self.free_target.extend_from_slice(targets);
        self.depth = [DepthAtPoints::NONE; MAX_LANES];
    }

    /// Makes room for the spring at `index`, and its like of all points.
    pub(super) fn make_room(&mut self, system: &mut ChainSystem<T>, index: usize) {
        if index < self.offsets.len() {
            return;
        }
        let points = self.free_stiffness.len();
        let count = (index / points + 1) * points;
        for list in [&mut self.offsets, &mut self.planes, &mut self.friction, &mut system.normal_stiffness] {
            list.resize(count, T::zero());
        }
        for list in [&mut self.anchors, &mut system.normals] {
            list.resize(count, Vec3::zero());
        }
    }

    /// Stiffness along the normal of a point that is `off` above where its spring rests, beside that of its friction, which acts along
    /// the surface alone.
    #[inline(always)]
    pub(in crate::step) fn along_normal(&self, spring: usize, off: T) -> T {
        T::select(off.less(T::zero()), self.planes[spring], T::zero()) - self.friction[spring]
    }

    /// Puts the springs of friction together with those that the points have.
    pub(super) fn add_friction(&self, system: &mut ChainSystem<T>, base: &[Vec3<T>], targets: &mut [Vec3<T>]) {
        let points = targets.len();
        for (p, target) in targets.iter_mut().enumerate() {
            let free = self.free_stiffness[p];
            let mut stiffness = free;
            let mut pull = Vec3::zero();
            for spring in springs_of(p, points, self.friction.len()) {
                let friction = self.friction[spring];
                stiffness += friction;
                let held = (self.anchors[spring] - base[p]) - self.free_target[p];
                pull += held.scale(friction);
            }
            system.point_stiffness[p] = stiffness;
            *target = self.free_target[p] + pull.scale(T::one() / stiffness);
        }
    }
}

/// Gives a list this many items, all alike.
fn refill<V: Clone>(list: &mut Vec<V>, count: usize, item: V) {
    list.clear();
    list.resize(count, item);
}
