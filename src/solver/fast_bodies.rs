//! Fast bodies: substeps in which a body moves far among strands, or a strand swings far past a thin body, are subdivided for the
//! whole scene.
//!
//! A strand that is swept along turns, and its contact slides along it. In one step the initial contact says little about the
//! final one, and thin bodies could come out behind the strand.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::Solver;
use super::strand::Strand;
use crate::contact::body::BodyAt;
use crate::math::frame::Frame;
use crate::math::rotation::rotation_vector;

/// In a substep a body moves among strands by at most this fraction of their length, or of half its own least extent, whichever
/// is more.
const PART_OF_LENGTH: f64 = 0.02;
const PART_OF_EXTENT: f64 = 0.5;
/// A body is thin if the first limit applies and half its least extent is at most this, m. A strand moves past a thin body by its
/// own speed by at most this fraction of its length.
const THIN: f64 = 0.05;
const THICK: f64 = 0.02;
const SWING: f64 = 0.25;
/// The largest number of substeps.
const MAX_PARTS: u32 = 32;
/// The largest number of substeps for a body that follows for a strand: it may take several steps.
const MAX_PARTS_TO_FOLLOW: f64 = 4.0;

/// A body that passes a strand in the next substep, as seen from the strand's root.
pub(super) struct Passing {
    /// Its pose if it moved along with the root.
    pub along: Frame,
    /// The largest displacement from there of any of its points in reach of the strand, m.
    pub travel: f64,
    /// The largest displacement per substep, m.
    pub limit: f64,
}

impl Passing {
    /// A body that comes from the pose `from`, past a strand of this `length` whose root moves from pose to pose.
    pub fn new(from: &Frame, body: &BodyAt, [root_from, root_to]: &[Frame; 2], length: f64) -> Self {
        let along = from.carried(root_from, root_to);
        let turned = rotation_vector(&(body.end.rotation * along.rotation.inverse())).norm();
        let arm = body.radius.min((root_from.origin - from.origin).norm() + length);
        let travel = (body.end.origin - along.origin).norm() + arm * turned;
        Self { along, travel, limit: limit(body, length) }
    }
}

/// The largest displacement of a body past a strand of this length per substep, m. (An infinite body is as flat from close up as
/// from afar.)
fn limit(body: &BodyAt, length: f64) -> f64 {
    let extent = body.half_extent();
    if extent.is_finite() { (PART_OF_EXTENT * extent).max(PART_OF_LENGTH * length) } else { f64::INFINITY }
}

impl Solver {
    /// Prepares all motions for a substep of `h` seconds: a motion of duration 0 takes all of it.
    pub(super) fn prepare_motions(&mut self, h: f64) {
        for body in &mut self.bodies {
            body.body.ready(h);
        }
        for constraint in &mut self.constraints {
            constraint.motion.begin(h);
        }
        for strand in &mut self.strands {
            strand.begin_moves(h);
        }
    }

    /// How many substeps the next substep of `h` seconds takes: more than one only if strands' substeps may be halved at all.
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
        most.ceil().min(f64::from(MAX_PARTS)) as u32
    }

    /// The largest speed of any point of a strand, m/s.
    fn fastest(&self) -> f64 {
        let squares = self.strands.iter().flat_map(|strand| &strand.state.velocities).map(|v| v.norm_squared());
        squares.fold(0.0, f64::max).sqrt()
    }
}

impl Strand {
    /// How many substeps a strand and a body of this half extent and displacement need to pass each other; no strand is faster
    /// than `fastest` (m/s).
    fn parts(&self, at: &BodyAt, travel: f64, extent: f64, fastest: f64, h: f64) -> f64 {
        let Some(contact) = self.contact.as_deref() else { return 1.0 };
        let still = travel == 0.0 && self.root_move.is_none() && self.divergence.is_none();
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
            return (passing.travel / passing.limit).min(MAX_PARTS_TO_FOLLOW);
        }
        let turn = root[1].rotation * root[0].rotation.inverse();
        // (An angle is at most π times the sine of its half.)
        let (shift, angle) = ((root[1].origin - root[0].origin).norm(), PI * turn.quaternion().imag().norm());
        let limit = limit(at, length);
        let goes_far = travel + (shift + length * angle) > limit;
        if !(goes_far || is_thin) || !at.is_near(&self.reach(contact, &root)) {
            return 1.0;
        }
        // An upper bound on its motion past the whole body: one substep is enough if that is within the limit.
        let away = (root[0].origin - at.start.origin).norm();
        if travel + shift + (away + at.radius.min(away + length)) * angle <= limit {
            return swings();
        }
        let passing = Passing::new(&at.start, at, &root, length);
        (passing.travel / passing.limit).max(swings())
    }

    /// Its motion past a body in a substep of `h` seconds by its own speed, m; 0 if at most `least`.
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
