//! What is found out at little cost about many places of a strand on their ways past a body, four at a time: how far they go, and what a
//! shape tells of a place without a search (`Shape::at_least`).

use nalgebra::Matrix3;

use super::body_at::BodyAt;
use crate::math::frame::Frame;
use crate::math::lane::Lane;
use crate::math::lanes::{KernelOfFour, call_of_four};
use crate::math::vector::{Mat3, Vec3, matrix};
use crate::step::at_points::surfaces::{Passage, PassageBounds};

/// Puts what one body adds to what is known of these `passages` in `bounds`; a strand touches its surface at a distance of `margin` (m).
pub(super) fn add(body: &BodyAt, margin: f64, passages: &[Passage], bounds: &mut [PassageBounds]) {
    call_of_four(Bounding { body, margin, passages, bounds });
}

struct Bounding<'a> {
    body: &'a BodyAt<'a>,
    margin: f64,
    passages: &'a [Passage],
    bounds: &'a mut [PassageBounds],
}

impl KernelOfFour for Bounding<'_> {
    type Output = ();

    #[inline(always)]
    fn run<T: Lane, const REGISTERS: usize>(self) {
        let Self { body, margin, passages, bounds } = self;
        let slope = body.shape.distance_slope();
        let (axes_at_start, axes_at_end) = (Axes::<T>::of(&body.start, &body.axes_start), Axes::of(&body.end, &body.axes_end));
        for (passages, bounds) in passages.chunks(T::LANES).zip(bounds.chunks_mut(T::LANES)) {
            let passage = |lane: usize| &passages[lane.min(passages.len() - 1)];
            let start = axes_at_start.local(load(|lane| &passage(lane).start));
            let now = axes_at_end.local(load(|lane| &passage(lane).now));
            let way = (now - start).norm_squared().sqrt();
            let least = body.shape.at_least(&now) - T::splat(margin);
            // What ends farther from the surface than it has gone was not near it on the way, wherever it began.
            let may_touch = T::any(least.less(way * T::splat(slope)));
            let before = if may_touch { body.shape.at_least(&start) - T::splat(margin) } else { T::splat(f64::INFINITY) };
            for (lane, bounds) in bounds.iter_mut().enumerate() {
                let (way, before, least) = (way.lane(lane), before.lane(lane), least.lane(lane));
                bounds.is_free &= before + least >= slope * way;
                (bounds.least, bounds.way) = (bounds.least.min(least), bounds.way.max(way));
            }
        }
    }
}

/// A frame, to whose axes places of the world are brought.
struct Axes<T> {
    origin: Vec3<T>,
    rotation: Mat3<T>,
}

impl<T: Lane> Axes<T> {
    #[inline(always)]
    fn of(frame: &Frame, axes: &Matrix3<f64>) -> Self {
        Self { origin: Vec3::splat(frame.origin.into()), rotation: matrix!(|i, j| T::splat(axes[(i, j)])) }
    }

    #[inline(always)]
    fn local(&self, place: Vec3<T>) -> Vec3<T> {
        self.rotation.apply_transposed(place - self.origin)
    }
}

/// A vector in each lane.
#[inline(always)]
fn load<'a, T: Lane>(of_lane: impl Fn(usize) -> &'a Vec3<f64>) -> Vec3<T> {
    let axis = |axis: usize| T::from_lanes(|lane| of_lane(lane).0[axis]);
    Vec3([axis(0), axis(1), axis(2)])
}
