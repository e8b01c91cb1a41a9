//! Whether a strand that has stepped unconstrained stayed clear of a body all the time: a bound on the distance, piece by piece
//! and time by time.
//!
//! As in the exact search, points move straight in the body's turning axes. A piece of strand in a part of the step lies within
//! a ball about its middle in the middle of that part, or around its chord then; pieces whose ball or chord may meet the
//! surface are halved, along the strand or in time.

use nalgebra::Vector3;

use super::body::BodyAt;
use super::permitted_overlap::PermittedOverlap;
use super::shape::{Bounds, Separator, Sides};
use crate::math::frame::Frame;
use crate::math::rotation::angle_at_most;
use crate::math::vector::Vec3;
use crate::rod::kinematics::{ElementState, element_states};
use crate::step::state::rotation_matrix;

/// The largest number of balls, or chords, measured for a strand and a body. What passes by needs a few chords, and more cost as much as a
/// step with contact.
const MAX_BALLS: u32 = 256;
const MAX_CHORDS: u32 = 64;
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

/// A piece of an element during a part of the step.
#[derive(Debug, Clone, Copy, Default)]
struct Piece {
    /// From arclength to arclength of the element.
    along: [f64; 2],
    /// Position of its middle at the beginning and the end of that part, the body's axes.
    path: [Vector3<f64>; 2],
    /// That part of the step, from 0 to 1.
    time: [f64; 2],
}

/// A piece of an element, by its ends.
#[derive(Debug, Clone, Copy, Default)]
struct Chord {
    /// From arclength to arclength of the element.
    along: [f64; 2],
    /// Positions of its first and its second end at the beginning and the end of that part, the body's axes.
    paths: [[Vector3<f64>; 2]; 2],
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
    /// Position of the material point at an arclength of it, at the start and at the end.
    fn path(&self, s: f64) -> [Vector3<f64>; 2] {
        [0, 1].map(|end| self.origins[end] + Vector3::from(self.states[end].point(s).position))
    }

    /// How far, at most, a piece of some length is off its chord, point by point, at the start and at the end.
    fn off_chord(&self, length: f64) -> f64 {
        self.states[0].off_chord_of(length).max(self.states[1].off_chord_of(length))
    }

    fn chord_middles(&self) -> [Vector3<f64>; 2] {
        [0, 1].map(|end| {
            let state = self.states[end];
            self.origins[end] + 0.5 * Vector3::from(state.origin_left + state.origin_right())
        })
    }
}

/// Whether distances decide if a strand is clear of a body: not of a deforming mesh, and not of a one-sided one, behind which
/// distances jump.
pub fn can_decide(body: &BodyAt) -> bool {
    !body.deforms() && body.shape.mesh().is_none_or(|mesh| !matches!(mesh.sides(), Sides::Front { .. }))
}

impl FreePath<'_> {
    /// Whether no point of it was ever deeper in one of the bodies than `spare` metres plus its permitted overlap. False also where
    /// 256 balls, or 64 chords, do not decide it, and for a body whose distances cannot ([`can_decide`]). `scratch` holds its elements at
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
        let (path, spare) = if is_sheet { (Self { permitted_overlap: None, ..*self }, 0.0) } else { (*self, spare) };
        path.stays_out(body, spare, scratch)
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
        let mut pieces = if separator.is_some() { MAX_CHORDS } else { MAX_BALLS };
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
        match separator {
            Some(separator) => self.is_clear_by_chords(body, separator, element, exempt, spare, pieces),
            None => self.is_clear_by_balls(body, element, exempt, spare, pieces),
        }
    }

    /// How near to a body's surface a piece of an element may be: within its own radius, as a rule.
    fn needed(&self, body: &BodyAt, element: &Element, [from, to]: [f64; 2], spare: f64) -> f64 {
        let sunk = self
            .permitted_overlap
            .map_or(0.0, |permitted_overlap| permitted_overlap.least_sunk(element.start + from, element.start + to));
        self.radius + body.thickness - spare - sunk
    }

    /// By chords of pieces: what moves straight from an arc to an arc stays as near to the chord that moves from chord to chord, and a plane
    /// between the shape and that chord in the middle of its motion bounds how near all of them come.
    fn is_clear_by_chords(
        &self,
        body: &BodyAt,
        separator: &Separator,
        element: &Element,
        exempt: f64,
        spare: f64,
        chords: &mut u32,
    ) -> bool {
        let length = element.states[0].length;
        let mut pieces = [Chord::default(); MAX_PIECES];
        pieces[0] = Chord { along: [exempt, length], paths: [element.path(exempt), element.path(length)], time: [0.0, 1.0] };
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let Chord { along: [from, to], paths, time } = pieces[count];
            if *chords == 0 {
                return false;
            }
            *chords -= 1;
            let needed = self.needed(body, element, [from, to], spare);
            let off_chord = element.off_chord(to - from);
            let half_path =
                0.5 * (paths[0][1] - paths[0][0]).norm_squared().max((paths[1][1] - paths[1][0]).norm_squared()).sqrt();
            let midway = paths.map(|[a, b]| 0.5 * (a + b));
            let plane = separator.of_segment(midway);
            if plane.distance_of(paths.into_iter().flatten()) >= needed + off_chord {
                continue;
            }
            if plane.distance < needed - (off_chord + half_path) || count + 2 > MAX_PIECES {
                return false;
            }
            if off_chord >= half_path {
                let s = 0.5 * (from + to);
                let whole = element.path(s);
                let middle = time.map(|t: f64| whole[0] + (whole[1] - whole[0]) * t);
                pieces[count] = Chord { along: [from, s], paths: [paths[0], middle], time };
                pieces[count + 1] = Chord { along: [s, to], paths: [middle, paths[1]], time };
            } else {
                let t = 0.5 * (time[0] + time[1]);
                pieces[count] = Chord { along: [from, to], paths: [0, 1].map(|k| [paths[k][0], midway[k]]), time: [time[0], t] };
                pieces[count + 1] =
                    Chord { along: [from, to], paths: [0, 1].map(|k| [midway[k], paths[k][1]]), time: [t, time[1]] };
            }
            count += 2;
        }
        true
    }

    /// By balls about the middles of pieces, for shapes that only know how far they are from a point.
    fn is_clear_by_balls(&self, body: &BodyAt, element: &Element, exempt: f64, spare: f64, balls: &mut u32) -> bool {
        let (length, slope) = (element.states[0].length, body.shape.distance_slope());
        let mut pieces = [Piece::default(); MAX_PIECES];
        // (The middle of its chord does for the whole element, and is at hand; it is no point of the strand, so that an overlap there proves nothing.)
        let path = if exempt > 0.0 { element.path(0.5 * (exempt + length)) } else { element.chord_middles() };
        pieces[0] = Piece { along: [exempt, length], path, time: [0.0, 1.0] };
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let Piece { along: [from, to], path: [a, b], time } = pieces[count];
            if *balls == 0 {
                return false;
            }
            *balls -= 1;
            let needed = self.needed(body, element, [from, to], spare);
            let (half_piece, half_path) = (0.5 * (to - from), 0.5 * (b - a).norm());
            let enough = needed + slope * (half_piece + half_path);
            let middle = 0.5 * (a + b);
            let distance = body.shape.distance(middle, enough);
            if distance >= enough {
                continue;
            }
            if count + 2 > MAX_PIECES {
                return false;
            }
            if distance < needed && half_piece < 0.5 * length {
                return false;
            }
            if half_piece >= half_path {
                let s = 0.5 * (from + to);
                for along in [[from, s], [s, to]] {
                    let whole = element.path(0.5 * (along[0] + along[1]));
                    let at = |t: f64| whole[0] + (whole[1] - whole[0]) * t;
                    pieces[count] = Piece { along, path: time.map(at), time };
                    count += 1;
                }
            } else {
                let t = 0.5 * (time[0] + time[1]);
                for (path, time) in [([a, middle], [time[0], t]), ([middle, b], [t, time[1]])] {
                    pieces[count] = Piece { along: [from, to], path, time };
                    count += 1;
                }
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;
    use crate::contact::shape::{DistanceGrid, Shape};

    const LENGTH: f64 = 0.1;
    const RADIUS: f64 = 5e-5;

    /// Whether a straight strand along x that moves between these positions stays clear of a body that moves between these
    /// poses.
    fn is_clear(
        shape: &Shape,
        path: [Vector3<f64>; 2],
        radius: f64,
        permitted_overlap: Option<&PermittedOverlap>,
        poses: [Frame; 2],
    ) -> bool {
        let rows = [[0.0; 3]; 4];
        let root = path.map(|origin| Frame { origin, ..Frame::default() });
        let path =
            FreePath { lengths: &[LENGTH / 4.0; 4], root, curvatures: [&rows, &rows], exempt: 0.01, radius, permitted_overlap };
        path.is_clear_of([&BodyAt::new(0, shape, poses[0], poses[1], 0.0)], 1e-5, &mut ClearanceScratch::default())
    }

    fn still(shape: &Shape, path: [Vector3<f64>; 2]) -> bool {
        is_clear(shape, path, RADIUS, None, [Frame::default(); 2])
    }

    fn at(x: f64, y: f64, z: f64) -> Vector3<f64> {
        Vector3::new(x, y, z)
    }

    /// A square of 0.4 m in the plane z = 0.
    fn square(sides: Sides) -> Shape {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| at(0.2 * x, 0.2 * y, 0.0));
        Shape::new_mesh(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]], sides).unwrap()
    }

    /// A ball of 3 cm about (0.05, 0, 0), as it is and as a grid.
    fn balls() -> [Shape; 2] {
        let (count, cell) = (40_u32, 4e-3);
        let low = Vector3::repeat(-0.5 * cell * f64::from(count - 1));
        let node = |k: u32| low + at(f64::from(k % count), f64::from(k / count % count), f64::from(k / (count * count))) * cell;
        let values: Vec<f32> = (0..count.pow(3)).map(|k| (node(k).norm() - 0.03) as f32).collect();
        let grid = DistanceGrid::from_parts(low, cell, 0.03, [count; 3], values.into()).unwrap();
        [Shape::new_sphere(0.03).unwrap(), Shape::new_grid(grid)]
    }

    #[test]
    fn a_ball_is_passed_by_and_met() {
        for ball in balls() {
            let pose = [Frame { origin: at(0.05, 0.0, 0.0), ..Frame::default() }; 2];
            let meets = |from: Vector3<f64>, to: Vector3<f64>| !is_clear(&ball, [from, to], RADIUS, None, pose);
            assert!(!meets(at(0.0, 0.0, 0.033), at(0.0, 0.01, 0.033)));
            assert!(!meets(at(0.0, -0.05, 0.038), at(0.0, 0.05, 0.038)));
            assert!(meets(at(0.0, 0.0, 0.031), at(0.0, 0.0, 0.0299)));
            assert!(meets(at(0.0, 0.0, 0.0299), at(0.0, 0.0, 0.031)));
            // All the way through, and clear of it before and after.
            assert!(meets(at(0.0, -0.05, 0.01), at(0.0, 0.05, 0.01)));
            // What is exempt meets nothing.
            assert!(!meets(at(0.0705, 0.0, 0.0), at(0.0705, 0.0, 0.0)) && meets(at(0.0685, 0.0, 0.0), at(0.0685, 0.0, 0.0)));
        }
    }

    #[test]
    fn an_approaching_body_hits_the_strand() {
        for ball in balls() {
            let strand = [at(0.0, 0.0, 0.05); 2];
            let goes = |to: Vector3<f64>, angle: f64| {
                let rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle);
                let poses = [Frame { origin: at(0.05, 0.0, 0.0), ..Frame::default() }, Frame { origin: to, rotation }];
                is_clear(&ball, strand, RADIUS, None, poses)
            };
            assert!(goes(at(0.05, 0.0, 0.0197), 0.2) && !goes(at(0.05, 0.0, 0.0203), 0.2));
            assert!(!goes(at(0.05, 0.0, 0.12), 0.0));
        }
    }

    #[test]
    fn a_permitted_overlap_with_a_body_may_stay() {
        let permitted_overlap = PermittedOverlap { along: vec![0.0], wisp_fractions: vec![1.0], sunk: vec![0.002] };
        for ball in balls() {
            let pose = [Frame { origin: at(0.05, 0.0, 0.0), ..Frame::default() }; 2];
            let is_clear = |z: f64| is_clear(&ball, [at(0.0, 0.0, z); 2], RADIUS, Some(&permitted_overlap), pose);
            assert!(is_clear(0.0282) && !is_clear(0.0279));
        }
    }

    /// What glides past a tooth of a comb, a micrometre off it, is clear of it; what grazes it is not.
    #[test]
    fn a_tooth_is_passed_closely() {
        let axis = at(0.06, 0.0, -0.004);
        for curvature in [0.0, 8.0] {
            let rows = [[0.0, curvature, 0.0]; 4];
            let mut elements = Vec::new();
            element_states(rotation_matrix(&Frame::default()), [LENGTH / 4.0; 4], &rows, &mut elements);
            let places =
                elements.iter().flat_map(|element| (0..=1000).map(|k| element.point(f64::from(k) * LENGTH / 4000.0).position));
            let nearest = places.map(|place| (axis.xz() - Vector3::from(place).xz()).norm()).fold(f64::INFINITY, f64::min);
            let passes = |gap: f64| {
                let along = Vector3::y() * 0.05;
                let tooth = Shape::new_capsule(axis - along, axis + along, nearest - RADIUS - gap).unwrap();
                let root = [0.0, 3e-4].map(|y| Frame { origin: at(0.0, y, 0.0), ..Frame::default() });
                let lengths = &[LENGTH / 4.0; 4];
                let path =
                    FreePath { lengths, root, curvatures: [&rows, &rows], exempt: 0.01, radius: RADIUS, permitted_overlap: None };
                let body = BodyAt::new(0, &tooth, Frame::default(), Frame::default(), 0.0);
                path.is_clear_of([&body], 0.0, &mut ClearanceScratch::default())
            };
            assert!(passes(1e-6) && !passes(-1e-6), "{curvature}");
        }
    }

    /// There is room on both sides of a sheet, and no path from one to the other, whatever the strand's permitted overlap with
    /// bodies that have an inside.
    #[test]
    fn a_sheet_is_not_passed_through() {
        let (sheet, front) = (square(Sides::Both), square(Sides::Front { depth: 0.01 }));
        let permitted_overlap = PermittedOverlap { along: vec![0.0], wisp_fractions: vec![1.0], sunk: vec![0.002] };
        for (radius, permitted_overlap) in [(RADIUS, None), (0.0, None), (RADIUS, Some(&permitted_overlap))] {
            let is_clear = |from: f64, to: f64| {
                is_clear(&sheet, [at(-0.05, 0.0, from), at(-0.05, 0.01, to)], radius, permitted_overlap, [Frame::default(); 2])
            };
            assert!(is_clear(0.001, 0.02) && is_clear(-0.001, -0.02));
            for depth in [1e-4, 1e-3, 0.05] {
                assert!(!is_clear(0.001, -depth) && !is_clear(-depth, 0.001), "{radius} {depth}");
            }
        }
        // Behind a mesh that acts on one side distances jump.
        assert!(
            !still(&front, [at(-0.05, 0.0, 0.01), at(-0.05, 0.0, -0.1)])
                && !can_decide(&BodyAt::new(0, &front, Frame::default(), Frame::default(), 0.0))
        );
    }
}
