//! Whether a strand that has stepped freely stayed clear of a body all the way: a bound on the distance, place by place and time by time.
//!
//! As in the exact search, points go straight in the body's turning axes. A piece of strand in a part of the step lies within a ball about where its
//! middle is in the middle of that part; pieces whose ball may meet the surface are halved, along the strand or in time.

use nalgebra::Vector3;

use super::allowance::Allowance;
use super::body::BodyAt;
use crate::math::frame::Frame;
use crate::math::rotation::rotation_vector;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::{ElementState, element_states};

/// Most balls of a strand and a body whose distance is measured.
const MOST_BALLS: u32 = 256;
/// Most pieces of an element that wait to be measured: halves of halves.
const MOST_PIECES: usize = 24;

/// A strand's way through a step, and what of it touches bodies.
#[derive(Debug, Clone, Copy)]
pub struct FreePath<'a> {
    /// The elements' lengths, m.
    pub lengths: &'a [f64],
    /// Where the root is at the start and at the end, world.
    pub root: [Frame; 2],
    /// The curvatures then.
    pub curvatures: [&'a [[f64; 3]]; 2],
    /// Arclength from the root over which nothing is touched, m.
    pub exempt: f64,
    /// The strand's radius, m.
    pub radius: f64,
    /// How far it may be in bodies.
    pub allowance: Option<&'a Allowance>,
}

/// Lists that are used again from call to call.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    /// At the start and the end, the body's axes.
    elements: [Vec<ElementState<f64>>; 2],
    /// Elements that may be near the body, and the arclengths at which they begin.
    near: Vec<(usize, f64)>,
}

/// A piece of an element during a part of the step.
#[derive(Debug, Clone, Copy, Default)]
struct Piece {
    /// From arclength to arclength of the element.
    along: [f64; 2],
    /// Where its middle is when that part begins and ends, the body's axes.
    way: [Vector3<f64>; 2],
    /// That part of the step, from 0 to 1.
    time: [f64; 2],
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
    /// Where the material point at an arclength of it is.
    fn way(&self, s: f64) -> [Vector3<f64>; 2] {
        [0, 1].map(|end| self.origins[end] + Vector3::from(self.states[end].point(s).position))
    }

    fn chord_middles(&self) -> [Vector3<f64>; 2] {
        [0, 1].map(|end| {
            let state = self.states[end];
            self.origins[end] + 0.5 * Vector3::from(state.origin_left + state.origin_right())
        })
    }
}

impl FreePath<'_> {
    /// Whether no point of it was ever deeper in a body than `spare` metres. False where that takes long to tell, and beside a mesh that deforms.
    pub fn is_clear_of(&self, body: &BodyAt, spare: f64, scratch: &mut Scratch) -> bool {
        if body.deforms() {
            return false;
        }
        let roots = [body.start.inverse().compose(&self.root[0]), body.end.inverse().compose(&self.root[1])];
        self.place(&roots, 1, scratch);
        self.find_near(&roots, body, spare, scratch);
        if scratch.near.is_empty() {
            return true;
        }
        self.place(&roots, 0, scratch);
        let origins = roots.map(|root| root.origin);
        let Scratch { elements: [first, second], near } = scratch;
        let mut balls = MOST_BALLS;
        near.iter().all(|(k, start)| {
            let element = Element { states: [&first[*k], &second[*k]], origins, start: *start };
            self.is_element_clear(body, &element, spare, &mut balls)
        })
    }

    /// Places the elements at the step's start (0) or end (1), in the body's axes.
    fn place(&self, roots: &[Frame; 2], end: usize, scratch: &mut Scratch) {
        let rotation = roots[end].rotation.to_rotation_matrix();
        let axes = Mat3(std::array::from_fn(|i| std::array::from_fn(|j| rotation[(i, j)])));
        element_states(axes, self.lengths.iter().copied(), self.curvatures[end], &mut scratch.elements[end]);
    }

    /// Finds the elements that may be near the body, from where they end and from how far they can have come: at arclength s the displacement is no more
    /// than the integral, up to s, of the angle by which tangents turned.
    fn find_near(&self, roots: &[Frame; 2], body: &BodyAt, spare: f64, scratch: &mut Scratch) {
        let [from, to] = roots;
        let (shift, turn) = ((to.origin - from.origin).norm(), rotation_vector(&(to.rotation * from.rotation.inverse())).norm());
        let (slope, needed) = (body.shape.distance_slope(), self.radius + body.thickness - spare);
        let (mut start, mut angle, mut displacement) = (0.0, turn, shift);
        scratch.near.clear();
        for (k, state) in scratch.elements[1].iter().enumerate() {
            let (length, [before, after]) = (state.length, self.curvatures.map(|rows| rows[k]));
            let turned = Vec3(std::array::from_fn(|axis| after[axis] - before[axis])).norm_squared().sqrt() * length;
            displacement += (angle + 0.5 * turned) * length;
            angle += turned;
            let middle = to.origin + 0.5 * Vector3::from(state.origin_left + state.origin_right());
            let enough = needed + slope * (0.5 * length + displacement);
            if start + length > self.exempt && body.shape.distance(middle, enough) < enough {
                scratch.near.push((k, start));
            }
            start += length;
        }
    }

    fn is_element_clear(&self, body: &BodyAt, element: &Element, spare: f64, balls: &mut u32) -> bool {
        let (length, slope) = (element.states[0].length, body.shape.distance_slope());
        let exempt = (self.exempt - element.start).max(0.0);
        if exempt >= length {
            return true;
        }
        let mut pieces = [Piece::default(); MOST_PIECES];
        // (The middle of its chord does for the whole element, and is at hand; what is overlapped there tells nothing.)
        let way = if exempt > 0.0 { element.way(0.5 * (exempt + length)) } else { element.chord_middles() };
        pieces[0] = Piece { along: [exempt, length], way, time: [0.0, 1.0] };
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let Piece { along: [from, to], way: [a, b], time } = pieces[count];
            if *balls == 0 {
                return false;
            }
            *balls -= 1;
            let sunk = self.allowance.map_or(0.0, |allowance| allowance.least_sunk(element.start + from, element.start + to));
            let needed = self.radius + body.thickness - spare - sunk;
            let (half_piece, half_way) = (0.5 * (to - from), 0.5 * (b - a).norm());
            let enough = needed + slope * (half_piece + half_way);
            let middle = 0.5 * (a + b);
            let distance = body.shape.distance(middle, enough);
            if distance >= enough {
                continue;
            }
            if count + 2 > MOST_PIECES {
                return false;
            }
            if distance < needed && half_piece < 0.5 * length {
                return false;
            }
            if half_piece >= half_way {
                let s = 0.5 * (from + to);
                for along in [[from, s], [s, to]] {
                    let whole = element.way(0.5 * (along[0] + along[1]));
                    let at = |t: f64| whole[0] + (whole[1] - whole[0]) * t;
                    pieces[count] = Piece { along, way: time.map(at), time };
                    count += 1;
                }
            } else {
                let t = 0.5 * (time[0] + time[1]);
                for (way, time) in [([a, middle], [time[0], t]), ([middle, b], [t, time[1]])] {
                    pieces[count] = Piece { along: [from, to], way, time };
                    count += 1;
                }
            }
        }
        true
    }
}
