//! Where the surfaces of bodies are about a strand's quadrature points (`contacts.rs`): asked at the points themselves, halfway between
//! two of them, and at the tip.
//!
//! A place between two points has no force of its own: if it is deeper in a body than they are, both bear it.

use super::places::{Asks, Known, Look, Near, distance};
use super::surfaces::{NEAR, STEEPEST, SURFACES_AT_POINT, Surfaces};
use crate::math::vector::Vec3;

/// The least cosine of the angle between a strand and the normal of a surface that it meets end on.
const END_ON: f64 = 0.7;

/// Places between points are interpolated from this many.
const STENCIL: usize = 4;

/// What stays as it is during a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    /// Arclength of a point from the root, m.
    pub arclength: f64,
    /// Where it is at the start of the step, m, world.
    pub at: Vec3<f64>,
}

/// A point of a strand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    /// At the present iterate, m, world.
    pub now: Vec3<f64>,
    /// Whether a surface pressed it in the iteration before.
    pressed: bool,
    /// No gap of it is smaller than this, overlaps that are permitted counted.
    least: f64,
}

impl Point {
    /// A point of which nothing was known.
    pub fn new(now: Vec3<f64>) -> Self {
        Self { now, pressed: false, least: f64::NEG_INFINITY }
    }
}

/// The points of a strand, from root to tip.
pub(super) struct Line<'a> {
    pub points: &'a mut [Point],
    pub starts: &'a [Start],
    /// What is known of them.
    pub known: &'a mut [Known],
    /// What is known of those that surfaces have been near to.
    pub near: &'a mut Near,
    /// Arclength of the tip, m.
    pub length: f64,
}

impl Line<'_> {
    /// Asks where the surfaces are, as far as it is not known that they are not near; `is_first`: nothing has been asked in this step.
    /// Surfaces that overlap when the step begins come apart by `separation` (m) in it.
    pub fn ask(&mut self, surfaces: &dyn Surfaces, is_first: bool, separation: f64) {
        let way = self.way(surfaces);
        let asks = &Asks { surfaces, is_first, separation, way };
        // What has gone a long way before anything was asked may be beyond a body by now.
        let margin = match is_first {
            true if asks.leads_far() => STEEPEST * way,
            true => NEAR,
            false => 0.0,
        };
        for (point, known) in self.points.iter_mut().zip(&mut *self.known) {
            point.pressed = self.near.touches.begin(known.touches) || known.own.has_entered(self.near);
        }
        self.ask_at_points(asks, margin);
        if self.points.len() >= 2 {
            self.ask_between(asks, margin);
        }
        self.leave_pierced();
    }

    /// The longest way of a point past a body since the step began, m, by one point in a few.
    fn way(&self, surfaces: &dyn Surfaces) -> f64 {
        let ends = self.points.iter().zip(self.starts).rev().step_by(STENCIL);
        ends.map(|(point, start)| surfaces.way(start.at, point.now)).fold(0.0, f64::max)
    }

    fn ask_at_points(&mut self, asks: &Asks, margin: f64) {
        let mut last: Option<(Vec3<f64>, f64)> = None;
        for ((point, known), start) in self.points.iter_mut().zip(&mut *self.known).zip(self.starts) {
            let now = point.now;
            if !point.pressed {
                let least = known.own.least(now);
                let by_neighbour = last.map_or(f64::NEG_INFINITY, |(at, gap)| gap - STEEPEST * distance(now, at));
                if least > margin || by_neighbour > margin {
                    if least <= margin {
                        (known.own.at, known.own.gap) = (now, by_neighbour);
                    }
                    point.least = least.max(by_neighbour);
                    last = Some((now, point.least));
                    continue;
                }
            }
            let (Known { own, touches: at, .. }, Near { places, touches }) = (known, &mut *self.near);
            let look = Look { asks, arclength: start.arclength, now, start: || start.at };
            point.least = own.ask(places, &look, |touch| touches.take(at, touch, asks.is_first));
            last = Some((now, point.least));
        }
    }

    fn ask_between(&mut self, asks: &Asks, margin: f64) {
        for p in 0..self.points.len() {
            let arclength = self.beside(p);
            let (here, next) = (&self.points[p], self.points.get(p + 1));
            let entered = self.known[p].beside.has_entered(self.near);
            let pressed = entered || here.pressed || next.is_some_and(|next| next.pressed);
            let mut least = here.least - STEEPEST * (arclength - self.starts[p].arclength);
            if let Some(next) = next {
                least = least.max(next.least - STEEPEST * (self.starts[p + 1].arclength - arclength));
            }
            if !pressed && least > margin {
                continue;
            }
            let now = self.place(p, arclength, |k| self.points[k].now);
            let mut place = self.known[p].beside;
            if !pressed && place.least(now) > margin {
                continue;
            }
            let Self { points, known, starts, near: Near { places, touches }, .. } = self;
            let look = Look { asks, arclength, now, start: || interpolate(starts, p, arclength, |k| starts[k].at) };
            let along = points[p..].get(1).map_or(Vec3::zero(), |next| next.now - points[p].now);
            place.ask(places, &look, |touch| {
                // A surface that faces along the strand is that of something thin which the strand goes through: no force along the strand
                // brings it out.
                if touch.side.surface.normal.dot(along).abs() > END_ON * along.norm_squared().sqrt() {
                    return;
                }
                for known in known[p..].iter_mut().take(2) {
                    touches.take(&mut known.touches, touch, asks.is_first);
                }
            });
            self.known[p].beside = place;
        }
    }

    /// The arclength halfway from point `p` to the next; for the last that of the tip.
    fn beside(&self, p: usize) -> f64 {
        self.starts.get(p + 1).map_or(self.length, |next| 0.5 * (self.starts[p].arclength + next.arclength))
    }

    /// A place at an arclength about point `p`.
    fn place(&self, p: usize, arclength: f64, point: impl Fn(usize) -> Vec3<f64>) -> Vec3<f64> {
        interpolate(self.starts, p, arclength, point)
    }

    /// Two points next to each other that a body pushes against each other lie on the two sides of something thin, which the strand
    /// pierces. No force along the strand brings it out.
    fn leave_pierced(&mut self) {
        let mut was = [false; SURFACES_AT_POINT];
        for p in 0..self.known.len() {
            let (here, there) = (self.known[p].touches, self.known.get(p + 1).and_then(|next| next.touches));
            let [pierced, next] = self.near.touches.pierce(here, there);
            self.near.touches.leave(here, |slot| was[slot] || pierced[slot]);
            was = next;
        }
    }

    /// Measures the gaps of the points near surfaces at the end of a step, and returns the smallest of all places; infinity where
    /// nothing overlaps.
    pub fn measure(&mut self, surfaces: &dyn Surfaces) -> f64 {
        let mut smallest = f64::INFINITY;
        for p in 0..self.points.len() {
            if self.near.of(&self.known[p]).next().is_some() {
                let now = self.points[p].now;
                let found = surfaces.nearest(self.starts[p].arclength, now);
                smallest = smallest.min(found.as_ref().map_or_else(|at_least| *at_least, |found| found.nearest.gap));
                self.near.touches.measure(self.known[p].touches, found.ok().as_ref(), now);
            }
        }
        // Of the others only what is deeper counts.
        for p in 0..self.points.len() {
            let known = &self.known[p];
            if self.near.of(known).next().is_none() {
                let (arclength, now) = (self.starts[p].arclength, self.points[p].now);
                smallest = smallest.min(known.own.gap_below(smallest.min(0.0), surfaces, arclength, now));
            }
            // (What was never asked was never near.)
            if known.beside.gap > f64::NEG_INFINITY {
                let arclength = self.beside(p);
                let now = self.place(p, arclength, |k| self.points[k].now);
                smallest = smallest.min(known.beside.gap_below(smallest.min(0.0), surfaces, arclength, now));
            }
        }
        smallest
    }
}

/// A place at an arclength about point `p`: by the polynomial through the points around it.
fn interpolate(starts: &[Start], p: usize, arclength: f64, point: impl Fn(usize) -> Vec3<f64>) -> Vec3<f64> {
    let first = p.saturating_sub(1).min(starts.len().saturating_sub(STENCIL));
    match &starts[first..] {
        [a, b, c, d, ..] => interpolate_by([a, b, c, d], first, arclength, point),
        [a, b, c] => interpolate_by([a, b, c], first, arclength, point),
        [a, b] => interpolate_by([a, b], first, arclength, point),
        [a] => interpolate_by([a], first, arclength, point),
        [] => Vec3::zero(),
    }
}

/// Lagrange's polynomial through N points, of which the first is point `first`.
fn interpolate_by<const N: usize>(
    starts: [&Start; N],
    first: usize,
    arclength: f64,
    point: impl Fn(usize) -> Vec3<f64>,
) -> Vec3<f64> {
    let at = starts.map(|start| start.arclength);
    let mut place = Vec3::zero();
    for i in 0..N {
        let (mut above, mut below) = (1.0, 1.0);
        for j in 0..N {
            if j != i {
                above *= arclength - at[j];
                below *= at[i] - at[j];
            }
        }
        place += point(first + i).scale(above / below);
    }
    place
}
