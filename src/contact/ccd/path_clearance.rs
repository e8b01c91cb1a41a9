//! Whether a strand that has stepped unconstrained stayed clear of a body all the time: a bound on the distance, piece by piece
//! and time by time.
//!
//! As in the exact search, points move straight in the body's turning axes. A piece of strand in a part of the step lies within
//! a ball about its middle in the middle of that part, or around its chord then; in a grid, the distance along it is bounded from
//! below by a parabola from either end. Pieces that may meet the surface by that are halved, along the strand or in time.
//!
//! Files:
//!
//! - `balls.rs`: Pieces of an element in balls, for shapes that only know how far they are from a point.
//! - `chords.rs`: Pieces of an element kept apart from a convex shape by planes.
//! - `field.rs`: Pieces of an element in a distance grid.
//! - `tests.rs`: Tests of strands that stay clear of a body, or do not.

mod balls;
mod chords;
mod field;
#[cfg(test)]
mod tests;

use nalgebra::Vector3;

use field::Field;

use crate::contact::body_at::BodyAt;
use crate::contact::permitted_overlap::PermittedOverlap;
use crate::contact::shape::{Bounds, Separator, Sides};
use crate::math::frame::Frame;
use crate::math::rotation::angle_at_most;
use crate::math::vector::Vec3;
use crate::rod::kinematics::{ElementState, element_states};
use crate::step::state::rotation_matrix;

/// The largest number of chords, or of places asked for their distance, for a strand and a body. What passes by needs a few, and more cost as much as a
/// step with contact.
const MAX_CHORDS: u32 = 64;
const MAX_PLACES: u32 = 256;
/// The largest number of pieces of an element in the queue: halves of halves.
const MAX_PIECES: usize = 24;

/// A strand's path through a step, with its contact properties.
#[derive(Debug, Clone, Copy)]
pub struct FreePath<'a> {
    /// The elements' lengths, m.
    pub lengths: &'a [f64],
    /// The root's pose at the start and at the end, world.
    pub root: [Frame; 2],
    /// The curvatures then.
    pub curvatures: [&'a [[f64; 3]]; 2],
    /// Arclength from the root without contact, m.
    pub exempt: f64,
    /// The strand's radius, m.
    pub radius: f64,
    /// Its permitted overlap.
    pub permitted_overlap: Option<&'a PermittedOverlap>,
}

/// Lists that are used again from call to call.
#[derive(Debug, Clone, Default)]
pub struct ClearanceScratch {
    /// Elements at the start and the end, world axes; those at the start only when needed.
    world: [Vec<ElementState<f64>>; 2],
    /// The same in the body's axes.
    elements: [Vec<ElementState<f64>>; 2],
    /// Elements that may be near the body, and the arclengths at which they begin.
    near: Vec<(usize, f64)>,
}

impl ClearanceScratch {
    /// For the elements at the step's end, world axes, about the root. Where they are at hand they need not be placed again; else the list
    /// must be empty.
    pub fn elements_at_end(&mut self) -> &mut Vec<ElementState<f64>> {
        &mut self.world[1]
    }

    /// Brings the elements at one end of the step into the axes of a body that is there then.
    fn turn(&mut self, end: usize, body: &Frame) {
        let axes = rotation_matrix(body);
        let turned = self.world[end].iter().map(|state| ElementState {
            frame_left: axes.transposed_mul(&state.frame_left),
            origin_left: axes.apply_transposed(state.origin_left),
            ..*state
        });
        self.elements[end].clear();
        self.elements[end].extend(turned);
    }
}

/// An element at the start and at the end of the step, each in the body's axes then.
struct Element<'a> {
    states: [&'a ElementState<f64>; 2],
    /// Where the root is.
    origins: [Vector3<f64>; 2],
    /// The arclength at which it begins, m.
    start: f64,
}

impl Element<'_> {
    /// Position of the material point at an arclength of it, at the start and at the end.
    fn path(&self, s: f64) -> [Vector3<f64>; 2] {
        [0, 1].map(|end| self.origins[end] + Vector3::from(self.states[end].point(s).position))
    }

    /// How far, at most, a piece of some length is off its chord, point by point, at the start and at the end.
    fn off_chord(&self, length: f64) -> f64 {
        self.states[0].off_chord_of(length).max(self.states[1].off_chord_of(length))
    }

    /// The same, at the beginning and the end of a part of the step: points go straight.
    fn path_in(&self, s: f64, time: [f64; 2]) -> [Vector3<f64>; 2] {
        let [start, end] = self.path(s);
        time.map(|t| start + (end - start) * t)
    }

    /// Positions of its left end, at the start and at the end.
    fn left(&self) -> [Vector3<f64>; 2] {
        [0, 1].map(|end| self.origins[end] + Vector3::from(self.states[end].origin_left))
    }

    /// The same of its right end.
    fn right(&self) -> [Vector3<f64>; 2] {
        [0, 1].map(|end| self.origins[end] + Vector3::from(self.states[end].origin_right()))
    }

    fn chord_middles(&self) -> [Vector3<f64>; 2] {
        let (left, right) = (self.left(), self.right());
        [0, 1].map(|end| 0.5 * (left[end] + right[end]))
    }
}

/// Whether distances decide if a strand is clear of a body: not of a deforming mesh, and not of a one-sided one, behind which
/// distances jump.
pub fn can_decide(body: &BodyAt) -> bool {
    !body.deforms() && body.shape.mesh().is_none_or(|mesh| !matches!(mesh.sides(), Sides::Front { .. }))
}

impl FreePath<'_> {
    /// Whether no point of it was ever deeper in one of the bodies than `spare` metres plus its permitted overlap. False also where
    /// 256 places, or 64 chords, do not decide it, and for a body whose distances cannot ([`can_decide`]). `scratch` holds its elements at
    /// the end, or none ([`ClearanceScratch::elements_at_end`]).
    pub fn is_clear_of<'a>(
        &self,
        bodies: impl IntoIterator<Item = &'a BodyAt<'a>>,
        spare: f64,
        scratch: &mut ClearanceScratch,
    ) -> bool {
        let (mut around, length) = (None, self.lengths.iter().sum::<f64>());
        bodies.into_iter().all(|body| {
            let around = around.get_or_insert_with(|| self.around(scratch));
            // A point that goes straight in the body's axes, which turn by φ, leaves its chord by at most r φ²/8.
            let arm = (self.root[0].origin - body.start.origin).norm() + length;
            let aside = arm * (0.125 * body.turn * body.turn).min(1.0);
            !body.is_near(&around.grown(aside)) || self.is_clear_of_one(body, spare, scratch)
        })
    }

    /// A box around its surface at all times.
    fn around(&self, scratch: &mut ClearanceScratch) -> Bounds {
        scratch.world[0].clear();
        if scratch.world[1].is_empty() {
            self.place(1, scratch);
        }
        let (mut around, mut start) = (Bounds::EMPTY, 0.0);
        let to = self.root[1].origin;
        for (state, displacement) in scratch.world[1].iter().zip(self.displacements(&self.root)) {
            start += state.length;
            if start > self.exempt {
                let ends = [state.origin_left, state.origin_right()].map(|end| to + Vector3::from(end));
                around = around.union(&Bounds::of_points(ends).grown(state.off_chord() + displacement));
            }
        }
        around.grown(self.radius)
    }

    fn is_clear_of_one(&self, body: &BodyAt, spare: f64, scratch: &mut ClearanceScratch) -> bool {
        if !can_decide(body) {
            return false;
        }
        // A sheet has no inside: what goes through it is on its other side.
        let is_sheet = body.shape.mesh().is_some_and(|mesh| mesh.sides() == Sides::Both);
        // (Most strands are permitted no depth, and need not be asked all along.)
        let is_sunk = |overlap: &&PermittedOverlap| !is_sheet && overlap.sunk.iter().any(|sunk| *sunk > 0.0);
        let path = Self { permitted_overlap: self.permitted_overlap.filter(is_sunk), ..*self };
        path.stays_out(body, if is_sheet { 0.0 } else { spare }, scratch)
    }

    fn stays_out(&self, body: &BodyAt, spare: f64, scratch: &mut ClearanceScratch) -> bool {
        let roots = [body.start.inverse().compose(&self.root[0]), body.end.inverse().compose(&self.root[1])];
        scratch.turn(1, &body.end);
        let separator = body.shape.separator();
        self.find_near(&roots, body, separator.as_ref(), spare, scratch);
        if scratch.near.is_empty() {
            return true;
        }
        if scratch.world[0].is_empty() {
            self.place(0, scratch);
        }
        scratch.turn(0, &body.start);
        let origins = roots.map(|root| root.origin);
        let ClearanceScratch { elements: [first, second], near, .. } = scratch;
        let mut pieces = if separator.is_some() { MAX_CHORDS } else { MAX_PLACES };
        near.iter().all(|(k, start)| {
            let element = Element { states: [&first[*k], &second[*k]], origins, start: *start };
            self.is_element_clear(body, separator.as_ref(), &element, spare, &mut pieces)
        })
    }

    /// Places the elements at the step's start (0) or end (1).
    fn place(&self, end: usize, scratch: &mut ClearanceScratch) {
        let lengths = self.lengths.iter().copied();
        element_states(rotation_matrix(&self.root[end]), lengths, self.curvatures[end], &mut scratch.world[end]);
    }

    /// How far points of each element can have come while the root went from pose to pose: at arclength s no farther than the integral, up to s, of
    /// the angle by which tangents turned.
    fn displacements(&self, [from, to]: &[Frame; 2]) -> impl Iterator<Item = f64> {
        let mut displacement = (to.origin - from.origin).norm();
        let mut angle = angle_at_most(&(to.rotation * from.rotation.inverse()));
        self.lengths.iter().zip(self.curvatures[0].iter().zip(self.curvatures[1])).map(move |(length, (before, after))| {
            let turned = Vec3(std::array::from_fn(|axis| after[axis] - before[axis])).norm_squared().sqrt() * length;
            displacement += (angle + 0.5 * turned) * length;
            angle += turned;
            displacement
        })
    }

    /// Finds the elements that may be near the body, from where they end and from how far they can have come.
    fn find_near(
        &self,
        roots: &[Frame; 2],
        body: &BodyAt,
        separator: Option<&Separator>,
        spare: f64,
        scratch: &mut ClearanceScratch,
    ) {
        let to = &roots[1];
        let (slope, needed) = (body.shape.distance_slope(), self.radius + body.thickness - spare);
        let mut start = 0.0;
        scratch.near.clear();
        for (k, (state, displacement)) in scratch.elements[1].iter().zip(self.displacements(roots)).enumerate() {
            let length = state.length;
            if start + length > self.exempt {
                let chord = [state.origin_left, state.origin_right()].map(|end| to.origin + Vector3::from(end));
                // The shape knows either how far a whole chord is, or how far its middle is.
                let (distance, enough) = match separator {
                    Some(separator) => (separator.of_segment(chord).distance, needed + state.off_chord() + displacement),
                    None => {
                        let enough = needed + slope * (0.5 * length + displacement);
                        (body.shape.distance(0.5 * (chord[0] + chord[1]), enough), enough)
                    }
                };
                if distance < enough {
                    scratch.near.push((k, start));
                }
            }
            start += length;
        }
    }

    fn is_element_clear(
        &self,
        body: &BodyAt,
        separator: Option<&Separator>,
        element: &Element,
        spare: f64,
        pieces: &mut u32,
    ) -> bool {
        let length = element.states[0].length;
        let exempt = (self.exempt - element.start).max(0.0);
        if exempt >= length {
            return true;
        }
        match (separator, body.shape.grid()) {
            (Some(separator), _) => self.is_clear_by_chords(body, separator, element, exempt, spare, pieces),
            (None, Some(grid)) => {
                let field = Field { grid, slope: body.shape.distance_slope(), places: pieces };
                self.is_clear_in_field(body, field, element, exempt, spare)
            }
            (None, None) => self.is_clear_by_balls(body, element, exempt, spare, pieces),
        }
    }

    /// How near to a body's surface the ends of a piece of an element may be, and what is between them by a straight line: within its own radius, as a
    /// rule.
    fn needed(&self, body: &BodyAt, element: &Element, [from, to]: [f64; 2], spare: f64) -> [f64; 2] {
        let line = |overlap: &PermittedOverlap| overlap.line_below(element.start + from, element.start + to);
        self.permitted_overlap.map_or([0.0; 2], line).map(|sunk| self.radius + body.thickness - spare - sunk)
    }
}
