//! Where the surfaces of bodies are about a strand's quadrature points (`contacts.rs`): asked at the points themselves, halfway between
//! two of them, and at the tip.
//!
//! A place between two points has no force of its own: if it is deeper in a body than they are, both bear it.

use super::halfway::HalfwayPlaces;
use super::places::{Asks, Known, Look, Near};
use super::surfaces::{Passage, PassageBounds, STEEPEST, SURFACES_AT_POINT, Surfaces};
use crate::math::vector::Vec3;

/// The least cosine of the angle between a strand and the normal of a surface that it meets end on.
const END_ON: f64 = 0.7;

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
    /// No gap of it is smaller than this, overlaps that are permitted counted, m.
    least: f64,
    /// The longest way past a body, m, as far as it had to be known.
    way: f64,
}

impl Point {
    /// A point of which nothing was known.
    pub fn new(now: Vec3<f64>) -> Self {
        Self { now, pressed: false, least: f64::NEG_INFINITY, way: 0.0 }
    }
}

/// Places of a strand that may have surfaces near them, with what is found out about them at little cost, one after the other.
#[derive(Debug, Clone, Default)]
pub(super) struct Candidates {
    /// Of which point each is, and whether a surface presses there.
    places: Vec<(usize, bool)>,
    passages: Vec<Passage>,
    bounds: Vec<PassageBounds>,
}

impl Candidates {
    fn clear(&mut self) {
        self.places.clear();
        self.passages.clear();
    }

    fn push(&mut self, p: usize, pressed: bool, passage: Passage) {
        self.places.push((p, pressed));
        self.passages.push(passage);
    }

    /// Finds out about them.
    fn bound(&mut self, surfaces: &dyn Surfaces) -> impl Iterator<Item = (usize, bool, Passage, PassageBounds)> {
        surfaces.bound(&self.passages, &mut self.bounds);
        let places = self.places.iter().zip(&self.passages).zip(&self.bounds);
        places.map(|((&(p, pressed), passage), bounds)| (p, pressed, *passage, *bounds))
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
    /// Memory for those that are asked about.
    pub candidates: &'a mut Candidates,
    /// Its places between points.
    pub halfway: &'a HalfwayPlaces,
    /// Arclength of the tip, m.
    pub length: f64,
}

impl Line<'_> {
    /// Asks where the surfaces are, as far as it is not known that they are not near; `is_first`: nothing has been asked in this step.
    /// Surfaces that overlap when the step begins come apart by `separation` (m) in it.
    pub fn ask(&mut self, surfaces: &dyn Surfaces, is_first: bool, separation: f64) {
        let asks = &Asks { surfaces, is_first, separation };
        for (point, known) in self.points.iter_mut().zip(&mut *self.known) {
            point.pressed = self.near.touches.begin(known.touches) || known.own.has_entered(self.near);
        }
        self.ask_at_points(asks);
        if self.points.len() >= 2 {
            self.ask_between(asks);
        }
        self.leave_pierced();
    }

    fn ask_at_points(&mut self, asks: &Asks) {
        let Self { points, starts, known, near: Near { places, touches }, candidates, .. } = self;
        candidates.clear();
        for (p, ((point, known), start)) in points.iter_mut().zip(&**known).zip(*starts).enumerate() {
            point.least = known.own.least(point.now);
            if point.pressed || point.least <= 0.0 {
                candidates.push(p, point.pressed, Passage { arclength: start.arclength, start: start.at, now: point.now });
            }
        }
        for (p, pressed, passage, bounds @ PassageBounds { least, way, .. }) in candidates.bound(asks.surfaces) {
            let (point, Known { own, touches: at, .. }) = (&mut points[p], &mut known[p]);
            point.way = way;
            if !pressed && asks.is_away(&bounds) {
                own.take_least(passage.now, least);
                point.least = least;
                continue;
            }
            point.least = own.ask(places, &Look { asks, passage, bounds }, |touch| touches.take(at, touch, asks.is_first));
        }
    }

    fn ask_between(&mut self, asks: &Asks) {
        self.candidates.clear();
        for p in 0..self.points.len() {
            let (arclength, place) = (self.beside(p), self.halfway.about(p));
            let (here, next) = (&self.points[p], self.points.get(p + 1));
            let entered = self.known[p].beside.has_entered(self.near);
            let pressed = entered || here.pressed || next.is_some_and(|next| next.pressed);
            let mut least = here.least - STEEPEST * (arclength - self.starts[p].arclength);
            if let Some(next) = next {
                least = least.max(next.least - STEEPEST * (self.starts[p + 1].arclength - arclength));
            }
            if !pressed && asks.is_surely_away(least, place.at_most(|k| self.points[k].way)) {
                continue;
            }
            let now = place.between(|k| self.points[k].now);
            if pressed || self.known[p].beside.least(now) <= 0.0 {
                let start = place.between(|k| self.starts[k].at);
                self.candidates.push(p, pressed, Passage { arclength, start, now });
            }
        }
        let Self { points, known, near: Near { places, touches }, candidates, .. } = self;
        for (p, pressed, passage, bounds @ PassageBounds { least, .. }) in candidates.bound(asks.surfaces) {
            if !pressed && asks.is_away(&bounds) {
                known[p].beside.take_least(passage.now, least);
                continue;
            }
            let mut place = known[p].beside;
            let along = points[p..].get(1).map_or(Vec3::zero(), |next| next.now - points[p].now);
            place.ask(places, &Look { asks, passage, bounds }, |touch| {
                // A surface that faces along the strand is that of something thin which the strand goes through: no force along the strand
                // brings it out.
                if touch.side.surface.normal.dot(along).abs() > END_ON * along.norm_squared().sqrt() {
                    return;
                }
                for known in known[p..].iter_mut().take(2) {
                    touches.take(&mut known.touches, touch, asks.is_first);
                }
            });
            known[p].beside = place;
        }
    }

    /// The arclength halfway from point `p` to the next; for the last that of the tip.
    fn beside(&self, p: usize) -> f64 {
        self.starts.get(p + 1).map_or(self.length, |next| 0.5 * (self.starts[p].arclength + next.arclength))
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
                let now = self.halfway.about(p).between(|k| self.points[k].now);
                smallest = smallest.min(known.beside.gap_below(smallest.min(0.0), surfaces, arclength, now));
            }
        }
        smallest
    }
}
