//! What is found out at little cost about many places of a strand on their ways past a body, four at a time: how far they go, and what a
//! shape tells of a place without a search (`Shape::at_least`).

use nalgebra::{Matrix3, Vector3};

use super::body_at::BodyAt;
use super::shape::DistanceGrid;
use crate::math::lane::Lane;
use crate::math::lanes::{KernelOfFour, call_of_four};
use crate::math::vector::Vec3;
use crate::step::at_points::surfaces::{Passage, Reach};

/// Puts in what is known of these `passages` by one body, whose surface they touch at a distance of `margin` (m).
pub(super) fn reach(body: &BodyAt, margin: f64, passages: &[Passage], reaches: &mut [Reach]) {
    call_of_four(Reaching { body, margin, passages, reaches });
}

struct Reaching<'a> {
    body: &'a BodyAt<'a>,
    margin: f64,
    passages: &'a [Passage],
    reaches: &'a mut [Reach],
}

impl KernelOfFour for Reaching<'_> {
    type Output = ();

    #[inline(always)]
    fn run<T: Lane, const REGISTERS: usize>(self) {
        let Self { body, margin, passages, reaches } = self;
        let slope = body.shape.distance_slope();
        let (from_start, from_end) =
            (Axes::<T>::of(body.start.origin, &body.axes_start), Axes::of(body.end.origin, &body.axes_end));
        let probe = Probe { body, slope, grid: body.shape.grid().map(|grid| (grid, Lattice::<T>::of(grid))) };
        for (passages, reaches) in passages.chunks(T::LANES).zip(reaches.chunks_mut(T::LANES)) {
            let passage = |lane: usize| &passages[lane.min(passages.len() - 1)];
            let start = from_start.local(load(|lane| &passage(lane).start));
            let now = from_end.local(load(|lane| &passage(lane).now));
            let way = (now - start).norm_squared().sqrt();
            let least = probe.at_least(&now) - T::splat(margin);
            // What ends farther from the surface than it has gone was not near it on the way, wherever it began.
            let may_touch = T::any(least.less(way * T::splat(slope)));
            let before = if may_touch { probe.at_least(&start) - T::splat(margin) } else { T::splat(f64::INFINITY) };
            for (lane, reach) in reaches.iter_mut().enumerate() {
                let (way, before, least) = (way.lane(lane), before.lane(lane), least.lane(lane));
                reach.is_free &= before + least >= slope * way;
                (reach.least, reach.way) = (reach.least.min(least), reach.way.max(way));
            }
        }
    }
}

/// What a body's shape tells of places in its axes.
struct Probe<'a, T> {
    body: &'a BodyAt<'a>,
    slope: f64,
    grid: Option<(&'a DistanceGrid, Lattice<T>)>,
}

impl<T: Lane> Probe<'_, T> {
    #[inline(always)]
    fn at_least(&self, place: &Vec3<T>) -> T {
        match &self.grid {
            Some((grid, lattice)) => lattice.at_least(grid, place, self.slope),
            None => T::from_lanes(|lane| self.body.shape.at_least(lane_of(place, lane))),
        }
    }
}

/// A frame, to whose axes places of the world are brought.
struct Axes<T> {
    origin: Vec3<T>,
    axes: [Vec3<T>; 3],
}

impl<T: Lane> Axes<T> {
    #[inline(always)]
    fn of(origin: Vector3<f64>, axes: &Matrix3<f64>) -> Self {
        let axis = |of: usize| splat(axes.column(of).into());
        Self { origin: splat(origin), axes: [axis(0), axis(1), axis(2)] }
    }

    #[inline(always)]
    fn local(&self, place: Vec3<T>) -> Vec3<T> {
        let from = place - self.origin;
        Vec3([self.axes[0].dot(from), self.axes[1].dot(from), self.axes[2].dot(from)])
    }
}

/// What a grid's nodes are found by.
struct Lattice<T> {
    low: Vec3<T>,
    cell: T,
    last: [T; 3],
    strides: [T; 2],
}

impl<T: Lane> Lattice<T> {
    #[inline(always)]
    fn of(grid: &DistanceGrid) -> Self {
        let [x, y, z] = grid.counts();
        let [x, y, z] = [f64::from(x), f64::from(y), f64::from(z)];
        Self {
            low: splat(grid.low()),
            cell: T::splat(grid.cell()),
            last: [T::splat(x - 1.0), T::splat(y - 1.0), T::splat(z - 1.0)],
            strides: [T::splat(x), T::splat(x * y)],
        }
    }

    /// [`DistanceGrid::at_least`] of places.
    #[inline(always)]
    fn at_least(&self, grid: &DistanceGrid, place: &Vec3<T>, slope: f64) -> T {
        let [x, y, z] = (*place - self.low).0;
        let cells = Vec3([x / self.cell, y / self.cell, z / self.cell]);
        let nodes = Vec3([cells.0[0].round(), cells.0[1].round(), cells.0[2].round()]);
        let mut is_outside = 0;
        for (cell, last) in cells.0.iter().zip(self.last) {
            is_outside |= T::bits(cell.less(T::zero())) | T::bits(last.less(*cell));
        }
        let index = nodes.0[0] + (self.strides[0] * nodes.0[1] + self.strides[1] * nodes.0[2]);
        let off = (cells - nodes).norm_squared().sqrt() * (T::splat(slope) * self.cell);
        T::from_lanes(|lane| match grid.values().get(index.lane(lane) as usize) {
            Some(node) if is_outside >> lane & 1 == 0 => f64::from(*node) - off.lane(lane),
            _ => grid.clearance(&lane_of(place, lane)),
        })
    }
}

/// A vector in each lane.
#[inline(always)]
fn load<'a, T: Lane>(of_lane: impl Fn(usize) -> &'a Vec3<f64>) -> Vec3<T> {
    let axis = |axis: usize| T::from_lanes(|lane| of_lane(lane).0[axis]);
    Vec3([axis(0), axis(1), axis(2)])
}

/// The same vector in all lanes.
#[inline(always)]
fn splat<T: Lane>(vector: Vector3<f64>) -> Vec3<T> {
    Vec3([T::splat(vector.x), T::splat(vector.y), T::splat(vector.z)])
}

#[inline(always)]
fn lane_of<T: Lane>(vector: &Vec3<T>, lane: usize) -> Vector3<f64> {
    Vector3::new(vector.0[0].lane(lane), vector.0[1].lane(lane), vector.0[2].lane(lane))
}
