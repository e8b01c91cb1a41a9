//! Bodies that go far among strands within a substep, and strands that swing far past thin bodies. A strand that is swept along turns as it
//! goes, and the place where it is touched slides along it: in one step the touch that it began with says little of where it ends, and thin things
//! came out behind it. Such a substep is taken in parts, by all.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::Solver;
use super::strand::Strand;
use crate::contact::body::BodyAt;
use crate::math::frame::Frame;
use crate::math::rotation::rotation_vector;

/// In a part a body goes among strands by no more than this part of their length, or of half its own least extent, where that is more.
const PART_OF_LENGTH: f64 = 0.02;
const PART_OF_EXTENT: f64 = 0.5;
/// A body is thin where it may not go further than this part of a strand's length in a part, and half its least extent is no more than this, m. A strand
/// goes past it by its own speed by no more than that part of its length.
const THIN: f64 = 0.05;
const THICK: f64 = 0.02;
const SWING: f64 = 0.25;
/// Most parts.
const MOST: u32 = 32;
/// Most parts for a body that comes after a strand: it may take several substeps.
const MOST_TO_COME_AFTER: f64 = 4.0;

/// A body that goes past a strand in the coming substep, as the strand's root sees it.
pub(super) struct Passing {
    /// Where it would be if it went along with the root.
    pub along: Frame,
    /// How far something of it that the strand can reach goes away from there, m.
    pub travel: f64,
    /// How far it may go at once, m.
    pub limit: f64,
}

impl Passing {
    /// Of a body that comes `from` there, past a strand of some `length` whose root goes from pose to pose.
    pub fn new(from: &Frame, body: &BodyAt, [root_from, root_to]: &[Frame; 2], length: f64) -> Self {
        let along = from.carried(root_from, root_to);
        let turned = rotation_vector(&(body.end.rotation * along.rotation.inverse())).norm();
        let arm = body.radius.min((root_from.origin - from.origin).norm() + length);
        let travel = (body.end.origin - along.origin).norm() + arm * turned;
        Self { along, travel, limit: limit(body, length) }
    }
}

/// How far a body may go past a strand of some length at once, m. (One without an end is as flat from near as from far.)
fn limit(body: &BodyAt, length: f64) -> f64 {
    let extent = body.half_extent();
    if extent.is_finite() { (PART_OF_EXTENT * extent).max(PART_OF_LENGTH * length) } else { f64::INFINITY }
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
        let going = |index: usize| {
            let body = self.bodies[index].body.at(index as u32, h);
            let turn = rotation_vector(&(body.end.rotation * body.start.rotation.inverse())).norm();
            (body, (body.end.origin - body.start.origin).norm() + body.radius * turn, body.half_extent())
        };
        let bodies = (0..self.bodies.len()).map(going).filter(|(.., extent)| extent.is_finite());
        let mut fastest = None;
        let most = bodies.fold(1.0, |most, (body, travel, extent)| {
            let fastest = if extent <= THICK { *fastest.get_or_insert_with(|| self.fastest()) } else { f64::INFINITY };
            self.strands.iter().map(|strand| strand.parts(&body, travel, extent, fastest, h)).fold(most, f64::max)
        });
        most.ceil().min(f64::from(MOST)) as u32
    }

    /// The fastest that some point of a strand goes, m/s.
    fn fastest(&self) -> f64 {
        let squares = self.strands.iter().flat_map(|strand| &strand.state.velocities).map(|v| v.norm_squared());
        squares.fold(0.0, f64::max).sqrt()
    }
}

impl Strand {
    /// In how many parts it and a body of some half extent that goes so far itself are to pass each other; no strand is faster than `fastest` (m/s).
    fn parts(&self, at: &BodyAt, travel: f64, extent: f64, fastest: f64, h: f64) -> f64 {
        let Some(contact) = self.contact.as_deref() else { return 1.0 };
        let still = travel == 0.0 && self.root_move.is_none() && self.astray.is_none();
        if still && extent > THICK {
            return 1.0;
        }
        let length = self.model.length();
        let is_thin = extent <= THICK && PART_OF_EXTENT * extent < THIN * length;
        if still && !is_thin || !at.meets(contact.groups, contact.mask) {
            return 1.0;
        }
        let swings = || if is_thin { self.swings_by(at, SWING * length, fastest, h) / (SWING * length) } else { 0.0 };
        if still {
            return if at.is_near(&self.reach(contact, &[self.state.root; 2])) { swings() } else { 1.0 };
        }
        let root = self.root_during(h);
        if let Some(from) = self.bodies_from().get(at.index as usize) {
            let passing = Passing::new(from, at, &root, length);
            return (passing.travel / passing.limit).min(MOST_TO_COME_AFTER);
        }
        let turn = root[1].rotation * root[0].rotation.inverse();
        // (An angle is at most π times its half's sine.)
        let (shift, angle) = ((root[1].origin - root[0].origin).norm(), PI * turn.quaternion().imag().norm());
        let limit = limit(at, length);
        let goes_far = travel + (shift + length * angle) > limit;
        if !(goes_far || is_thin) || !at.is_near(&self.reach(contact, &root)) {
            return 1.0;
        }
        // What it goes at most, past all of the body: no part more than one where that is within the limit.
        let away = (root[0].origin - at.start.origin).norm();
        if travel + shift + (away + at.radius.min(away + length)) * angle <= limit {
            return swings();
        }
        let passing = Passing::new(&at.start, at, &root, length);
        (passing.travel / passing.limit).max(swings())
    }

    /// How far it goes past a body in a substep of `h` seconds by its own speed, m; 0 where that is no more than `least`.
    fn swings_by(&self, body: &BodyAt, least: f64, fastest: f64, h: f64) -> f64 {
        let root = self.state.root.origin;
        let carried_to = body.end.origin + body.end.rotation * (body.start.rotation.inverse() * (root - body.start.origin));
        let carried = (carried_to - root) / h;
        if (fastest + carried.norm()) * h <= least {
            return 0.0;
        }
        let squares = self.state.velocities.iter().map(|v| (Vector3::from(*v) - carried).norm_squared());
        squares.fold(0.0, f64::max).sqrt() * h
    }
}
