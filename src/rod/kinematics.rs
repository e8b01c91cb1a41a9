//! Positions of all quadrature points of a strand, from the curvatures and the root's rotation: one pass from root to tip.
//!
//! Positions are relative to the root's origin in world axes, so that a strand far from the world's origin loses no digits.

use crate::math::functions::entire::Stumpff;
use crate::math::lane::Lane;
use crate::math::quadrature::Rule;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::segment;

/// One element in its present state. Local: in the axes of its left end.
#[derive(Debug, Clone, Copy)]
pub struct ElementState<T> {
    /// κ.
    pub kappa: Vec3<T>,
    /// κ·κ.
    pub kappa_squared: T,
    /// ℓ.
    pub length: T,
    /// Stumpff's functions at ℓ.
    pub c: Stumpff<T>,
    /// Frame at the left end, world axes.
    pub frame_left: Mat3<T>,
    /// Left end, relative to the root's origin, world axes.
    pub origin_left: Vec3<T>,
    /// Frame of the right end in the left end's axes.
    pub turn: Mat3<T>,
    /// Right end, local.
    pub end: Vec3<T>,
}

/// One quadrature point in its present state.
#[derive(Debug, Clone, Copy)]
pub struct PointState<T> {
    /// Arclength from the element's left end.
    pub s: T,
    /// Stumpff's functions at s.
    pub c: Stumpff<T>,
    /// Position in the element's axes, from its left end.
    pub local: Vec3<T>,
    /// Position relative to the root's origin, world axes.
    pub position: Vec3<T>,
}

/// The state of a strand at all quadrature points.
#[derive(Debug, Clone)]
pub struct Kinematics<T> {
    /// From root to tip.
    pub elements: Vec<ElementState<T>>,
    /// From root to tip, `points_per_element` per element.
    pub points: Vec<PointState<T>>,
    /// Points of the quadrature rule.
    pub points_per_element: usize,
}

impl<T> Default for Kinematics<T> {
    fn default() -> Self {
        Self { elements: Vec::new(), points: Vec::new(), points_per_element: 0 }
    }
}

/// The element of curvature κ and length ℓ with the given left end.
#[inline(always)]
pub fn element_state<T: Lane>(kappa: Vec3<T>, length: T, frame_left: Mat3<T>, origin_left: Vec3<T>) -> ElementState<T> {
    let kappa_squared = kappa.norm_squared();
    let theta = kappa.scale(length);
    let z = kappa_squared * (length * length);
    let c = Stumpff::at(z);
    ElementState {
        kappa,
        kappa_squared,
        length,
        c,
        frame_left,
        origin_left,
        turn: segment::frame(theta, z, &c),
        end: segment::chord(theta, z, &c).scale(length),
    }
}

/// The elements of a strand, each starting where the one before ends; the first has its left end at the origin, with this frame.
#[inline(always)]
pub fn element_states<T: Lane>(
    frame: Mat3<T>,
    lengths: impl IntoIterator<Item = T>,
    curvatures: &[[T; 3]],
    elements: &mut Vec<ElementState<T>>,
) {
    elements.clear();
    let (mut frame, mut origin) = (frame, Vec3::zero());
    for (length, row) in lengths.into_iter().zip(curvatures) {
        let element = element_state(Vec3(*row), length, frame, origin);
        (frame, origin) = (element.frame_right(), element.origin_right());
        elements.push(element);
    }
}

impl ElementState<f64> {
    /// An upper bound on the distance of a point of the element from the point at the same fraction of its chord, m: see
    /// [`Self::off_chord_of`].
    pub fn off_chord(&self) -> f64 {
        self.off_chord_of(self.length)
    }

    /// The same for a piece of this length, m: a curve r(s) differs from its linear interpolation by at most |r''| length²/8, and never
    /// by more than half its length.
    pub fn off_chord_of(&self, length: f64) -> f64 {
        off_chord(self.kappa_squared, length)
    }
}

/// [`ElementState::off_chord_of`], for a curvature with this square, 1/m².
pub fn off_chord(kappa_squared: f64, length: f64) -> f64 {
    0.5 * length * (0.25 * kappa_squared.sqrt() * length).min(1.0)
}

/// One lane's elements.
#[inline(always)]
pub fn lane_of_elements<T: Lane>(elements: &[ElementState<T>], lane: usize, out: &mut Vec<ElementState<f64>>) {
    out.clear();
    // (Number by number: whole arrays would be copied first.)
    let row = |row: &[T; 3]| [row[0].lane(lane), row[1].lane(lane), row[2].lane(lane)];
    let vector = |v: &Vec3<T>| Vec3(row(&v.0));
    let matrix = |m: &Mat3<T>| Mat3([row(&m.0[0]), row(&m.0[1]), row(&m.0[2])]);
    out.extend(elements.iter().map(|element| {
        let c = &element.c;
        ElementState {
            kappa: vector(&element.kappa),
            kappa_squared: element.kappa_squared.lane(lane),
            length: element.length.lane(lane),
            c: Stumpff {
                c1: c.c1.lane(lane),
                c2: c.c2.lane(lane),
                c3: c.c3.lane(lane),
                c4: c.c4.lane(lane),
                c5: c.c5.lane(lane),
                c6: c.c6.lane(lane),
                c7: c.c7.lane(lane),
            },
            frame_left: matrix(&element.frame_left),
            origin_left: vector(&element.origin_left),
            turn: matrix(&element.turn),
            end: vector(&element.end),
        }
    }));
}

impl<T: Lane> ElementState<T> {
    /// Right end, relative to the root's origin, world axes.
    #[inline(always)]
    pub fn origin_right(&self) -> Vec3<T> {
        self.origin_left + self.frame_left.apply(self.end)
    }

    /// Frame at the right end, world axes.
    #[inline(always)]
    pub fn frame_right(&self) -> Mat3<T> {
        self.frame_left.mul(&self.turn)
    }

    /// The material point at arclength s from the left end.
    #[inline(always)]
    pub fn point(&self, s: T) -> PointState<T> {
        let z = self.kappa_squared * (s * s);
        let c = Stumpff::at(z);
        let local = segment::chord(self.kappa.scale(s), z, &c).scale(s);
        PointState { s, c, local, position: self.origin_left + self.frame_left.apply(local) }
    }
}

/// Calls `emit(point index, position)` for every quadrature point and stores nothing; positions as in [`PointState::position`].
#[inline(always)]
pub fn for_each_position<T: Lane>(
    root: &Mat3<T>,
    lengths: &[T],
    curvatures: &[[T; 3]],
    rule: &Rule,
    mut emit: impl FnMut(usize, Vec3<T>),
) {
    let (mut frame, mut origin) = (*root, Vec3::zero());
    for (index, (length, row)) in lengths.iter().zip(curvatures).enumerate() {
        let element = element_state(Vec3(*row), *length, frame, origin);
        for (node, place) in rule.nodes.iter().enumerate() {
            emit(index * rule.len() + node, element.point(*length * T::splat(*place)).position);
        }
        (frame, origin) = (element.frame_right(), element.origin_right());
    }
}

impl<T: Lane> Kinematics<T> {
    /// Computes all elements and points for `curvatures` (one row per element).
    #[inline(always)]
    pub fn update(&mut self, root: &Mat3<T>, lengths: &[T], curvatures: &[[T; 3]], rule: &Rule) {
        self.elements.clear();
        self.points.clear();
        self.points_per_element = rule.len();
        let (mut frame, mut origin) = (*root, Vec3::zero());
        for (length, row) in lengths.iter().zip(curvatures) {
            let element = element_state(Vec3(*row), *length, frame, origin);
            for node in rule.nodes.iter() {
                self.points.push(element.point(*length * T::splat(*node)));
            }
            (frame, origin) = (element.frame_right(), element.origin_right());
            self.elements.push(element);
        }
    }
}
