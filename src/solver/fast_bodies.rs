//! Bodies that go far among strands within a substep. A strand that is swept along turns as it goes, and the place where it is touched slides along it: in one
//! step the touch that it began with says little of where it ends, and thin things came out behind it. Such a substep is taken in parts, by all.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::Solver;
use super::strand::{self, Strand};
use crate::contact::body::BodyAt;
use crate::contact::shape::Bounds;
use crate::math::frame::Frame;
use crate::math::rotation::rotation_vector;

/// In a part a body goes among strands by no more than this part of their length, or of half its own least extent, where that is more.
const PART_OF_LENGTH: f64 = 0.02;
const PART_OF_EXTENT: f64 = 0.5;
/// Most parts.
const MOST: u32 = 32;

/// A body on its way through the coming substep.
struct Passing<'a> {
    at: BodyAt<'a>,
    radius: f64,
    limit: f64,
    /// How far something of it goes at most.
    travel: f64,
}

impl Solver {
    /// Readies all ways for a substep of `h` seconds: one to be gone at once takes all of it.
    pub(super) fn ready_ways(&mut self, h: f64) {
        for body in &mut self.bodies {
            body.body.ready(h);
        }
        for constraint in &mut self.constraints {
            constraint.way.begin(h);
        }
        for strand in &mut self.strands {
            strand.begin_root_way(h);
        }
    }

    /// In how many parts the coming substep of `h` seconds is taken: more than one only where strands' substeps may be halved at all.
    pub(super) fn parts_of_substep(&self, h: f64) -> u32 {
        if self.options.step.max_subdivisions == 0 {
            return 1;
        }
        let passing = |index: usize| {
            let body = &self.bodies[index].body;
            let (shape, thickness) = (&body.def().shape, body.def().thickness);
            let at = body.at(index as u32, h);
            let bounds = shape.bounds();
            let extent = 0.5 * (bounds.high - bounds.low).min();
            let radius = body.radius();
            // (One without an end is as flat from near as from far.)
            let limit = if extent.is_finite() { PART_OF_EXTENT * (extent + thickness) } else { f64::INFINITY };
            let turn = rotation_vector(&(at.end.rotation * at.start.rotation.inverse())).norm();
            Passing { at, radius, limit, travel: (at.end.origin - at.start.origin).norm() + radius * turn }
        };
        let bodies = (0..self.bodies.len()).map(passing).filter(|body| body.limit.is_finite());
        let most = bodies.fold(1.0, |most, body| self.strands.iter().map(|strand| strand.parts(&body, h)).fold(most, f64::max));
        most.ceil().min(f64::from(MOST)) as u32
    }
}

impl Strand {
    fn parts(&self, Passing { at, radius, limit, travel }: &Passing, h: f64) -> f64 {
        let Some(contact) = self.contact.as_deref() else { return 1.0 };
        if *travel == 0.0 && self.root_move.is_none() && self.astray.is_none() {
            return 1.0;
        }
        let length = self.model.length();
        let (from, to) = (self.state.root, strand::root_after(&self.root_move, &self.state.root, h));
        let turn = to.rotation * from.rotation.inverse();
        // (An angle is at most π times its half's sine.)
        let own = (to.origin - from.origin).norm() + length * PI * turn.quaternion().imag().norm();
        let limit = limit.max(PART_OF_LENGTH * length);
        if travel + own <= limit || !at.meets(contact.groups, contact.mask) {
            return 1.0;
        }
        let reach = Vector3::repeat(length + contact.radius);
        let around = Bounds::around(from.origin, reach).union(&Bounds::around(to.origin, reach));
        if !at.bounds.grown(at.thickness).meets(&around) {
            return 1.0;
        }
        let start = self.bodies_from().get(at.index as usize).unwrap_or(&at.start);
        // Where it would be if it went along with the root.
        let along = Frame { origin: to.origin + turn * (start.origin - from.origin), rotation: turn * start.rotation };
        let turned = rotation_vector(&(at.end.rotation * along.rotation.inverse())).norm();
        let arm = radius.min((from.origin - start.origin).norm() + length);
        ((at.end.origin - along.origin).norm() + arm * turned) / limit
    }
}
