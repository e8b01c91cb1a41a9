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

mod balls;
mod chords;
mod field;

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

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;
    use crate::contact::shape::{DistanceGrid, Shape};
    use crate::math::random::signed_numbers;

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
        [Shape::new_sphere(0.03).unwrap(), field_of(|at| at.norm() - 0.03)]
    }

    /// A grid with cells of 4 mm.
    fn field_of(distance: impl Fn(Vector3<f64>) -> f64) -> Shape {
        let (count, cell) = (40_u32, 4e-3);
        let low = Vector3::repeat(-0.5 * cell * f64::from(count - 1));
        let node = |k: u32| low + at(f64::from(k % count), f64::from(k / count % count), f64::from(k / (count * count))) * cell;
        let values: Vec<f32> = (0..count.pow(3)).map(|k| distance(node(k)) as f32).collect();
        Shape::new_grid(DistanceGrid::from_parts(low, cell, 0.03, [count; 3], values.into()).unwrap())
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

    /// Curved strands on straight paths past a ball with dents, as a grid that stands still or turns, as thick as what a dense sample of places and
    /// times leaves free: a micrometre thicker, none is found clear; a fiftieth of a millimetre thinner, nineteen in twenty are.
    #[test]
    fn in_a_field_strands_are_found_clear_up_to_their_gap() {
        let ball = field_of(|at| at.norm() - 0.03 + 1e-3 * (250.0 * at.x).sin() * (250.0 * at.y).cos() * (250.0 * at.z).cos());
        let grid = ball.grid().unwrap();
        let mut number = signed_numbers(17);
        let (lengths, exempt) = ([0.02; 3], 0.003);
        let permitted_overlap =
            PermittedOverlap { along: vec![0.0, 0.013, 0.05], wisp_fractions: vec![1.0; 3], sunk: vec![0.004, 0.001, 0.0] };
        let (mut cases, mut found) = (0, 0);
        for case in 0..3000 {
            let mut vector = |size: f64| size * at(number(), number(), number());
            let toward = vector(1.0).normalize();
            let start = Frame { origin: toward * 0.034 + vector(0.003), rotation: UnitQuaternion::from_scaled_axis(vector(3.0)) };
            let moved = [0.0, 1e-3, 1e-2][case % 3];
            let end = Frame {
                origin: start.origin + vector(moved),
                rotation: UnitQuaternion::from_scaled_axis(vector(20.0 * moved)) * start.rotation,
            };
            let rows: [[f64; 3]; 3] = std::array::from_fn(|_| vector(25.0).into());
            let rows_after = rows.map(|row| (Vector3::from(row) + vector(500.0 * moved)).into());
            let poses = [
                Frame::default(),
                Frame { rotation: UnitQuaternion::from_scaled_axis(vector(10.0 * moved)), ..Frame::default() },
            ];
            let sunk = (case % 2 == 0).then_some(&permitted_overlap);
            let is_clear = |radius: f64| {
                let path = FreePath {
                    lengths: &lengths,
                    root: [start, end],
                    curvatures: [&rows, &rows_after],
                    exempt,
                    radius,
                    permitted_overlap: sunk,
                };
                let body = BodyAt::new(0, &ball, poses[0], poses[1], 0.0);
                path.is_clear_of([&body], 0.0, &mut ClearanceScratch::default())
            };
            let mut ends = [Vec::new(), Vec::new()];
            for (k, rows) in [rows, rows_after].iter().enumerate() {
                let root = poses[k].inverse().compose(&[start, end][k]);
                element_states(rotation_matrix(&root), lengths, rows, &mut ends[k]);
                ends[k].iter_mut().for_each(|state| state.origin_left += Vec3(root.origin.into()));
            }
            let mut gap = f64::INFINITY;
            for (k, length) in lengths.iter().enumerate() {
                for step in 0..=60 {
                    let s = length * f64::from(step) / 60.0;
                    let along = s + 0.02 * k as f64;
                    if along < exempt {
                        continue;
                    }
                    let [from, to] = [0, 1].map(|end: usize| Vector3::from(ends[end][k].point(s).position));
                    for time in 0..=20 {
                        let distance =
                            grid.closest(from.lerp(&to, f64::from(time) / 20.0)).map_or(1.0, |surface| surface.distance);
                        gap = gap.min(distance + sunk.map_or(0.0, |overlap| overlap.sunk(along)));
                    }
                }
            }
            if gap > 2e-5 {
                assert!(!is_clear(gap + 1e-6), "case {case}: {gap:e} m");
                (cases, found) = (cases + 1, found + usize::from(is_clear(gap - 2e-5)));
            }
        }
        assert!(cases > 1000 && found * 100 >= 95 * cases, "{found} of {cases}");
    }

    /// A strand that lies on a ball along a great circle, from its root in the surface to its tip, a micrometre off or a micrometre in it.
    #[test]
    fn what_lies_on_a_field_all_along_is_found_clear() {
        let [_, ball] = balls();
        let lies = |gap: f64| {
            let radius = 0.03 + RADIUS + gap;
            let root = [Frame { origin: at(0.0, 0.0, radius), ..Frame::default() }; 2];
            let rows = [[0.0, 1.0 / radius, 0.0]; 4];
            let path = FreePath {
                lengths: &[0.01; 4],
                root,
                curvatures: [&rows, &rows],
                exempt: 0.0,
                radius: RADIUS,
                permitted_overlap: None,
            };
            path.is_clear_of(
                [&BodyAt::new(0, &ball, Frame::default(), Frame::default(), 0.0)],
                0.0,
                &mut ClearanceScratch::default(),
            )
        };
        // (Interpolated, the ball is off by some micrometres.)
        assert!(lies(2e-5) && !lies(-2e-5));
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
