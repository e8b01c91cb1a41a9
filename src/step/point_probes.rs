//! Where the surfaces of bodies are about a strand's quadrature points (`point_contacts.rs`): asked at the points themselves, halfway between
//! two of them, and at the tip.
//!
//! A place between two points has no force of its own: if it is deeper in a body than they are, both bear it.

use super::point_surfaces::{SurfaceAtPoint, Surfaces};
use crate::math::vector::Vec3;

/// Surfaces this near may touch a point that lay on them when the step began, m.
const NEAR: f64 = 1e-3;

/// The most that a gap changes over a distance, see `Shape::distance_slope`.
const SLOPE: f64 = 1.25;

/// The least cosine of the angle between a strand and the normal of a surface that it meets end on.
const END_ON: f64 = 0.7;

/// Places between points are interpolated from this many.
const STENCIL: usize = 4;

/// What is known of a place of one strand.
#[derive(Debug, Clone, Copy)]
struct Place {
    /// Where it was last looked at, m, world.
    at: Vec3<f64>,
    /// Its gap there, or less, m.
    gap: f64,
    /// Its depth when the step began, m; `None` until it is asked for.
    start_depth: Option<f64>,
}

impl Place {
    const NOTHING: Self = Self { at: Vec3([0.0; 3]), gap: f64::NEG_INFINITY, start_depth: None };

    /// No gap of it is smaller than this now.
    fn least(&self, now: Vec3<f64>) -> f64 {
        self.gap - SLOPE * distance(now, self.at)
    }

    /// Its gap now, if that may be below `limit` (m); else infinity.
    fn gap_below(&self, limit: f64, surfaces: &dyn Surfaces, arclength: f64, now: Vec3<f64>) -> f64 {
        if self.least(now) > limit {
            f64::INFINITY
        } else if now == self.at {
            self.gap
        } else {
            gap(surfaces, arclength, now)
        }
    }

    /// Asks which surface is nearest to it; gives it if it is near, and the overlap that is permitted there.
    fn ask(
        &mut self,
        asks: &Asks,
        arclength: f64,
        now: Vec3<f64>,
        start: impl Fn() -> Vec3<f64>,
    ) -> (Option<SurfaceAtPoint>, f64) {
        self.at = now;
        match asks.surfaces.nearest(arclength, now) {
            Err(at_least) => {
                self.gap = at_least;
                (None, 0.0)
            }
            Ok(surface) => {
                self.gap = surface.gap;
                if surface.gap >= NEAR {
                    return (None, surface.permitted);
                }
                if self.start_depth.is_none() {
                    self.start_depth = Some(asks.surfaces.depth_at_start(arclength, surface.body, start()).max(0.0));
                }
                (Some(surface), surface.permitted)
            }
        }
    }
}

/// What is known of a point of one lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    own: Place,
    /// The place between it and the next point; for the last point the tip.
    beside: Place,
    /// The surface that is near, with the smallest gap about the point.
    pub surface: Option<SurfaceAtPoint>,
    /// The gap that its spring leaves, m: zero, or below where the surfaces overlapped when the step began.
    pub rest: f64,
    /// Its depth when the step began, m, as far as surfaces that overlap then come apart.
    pub held: f64,
    /// Whether it presses.
    pub presses: bool,
}

impl Known {
    pub const NOTHING: Self =
        Self { own: Place::NOTHING, beside: Place::NOTHING, surface: None, rest: 0.0, held: 0.0, presses: false };

    /// Takes over a surface at one of its places, if it is the nearest so far.
    fn take(&mut self, surface: SurfaceAtPoint, start_depth: f64, asks: &Asks) {
        let rest = -(start_depth - asks.separation).max(0.0);
        if self.surface.is_some_and(|nearest| nearest.gap - self.rest <= surface.gap - rest) {
            return;
        }
        (self.surface, self.rest, self.held) = (Some(surface), rest, start_depth.min(asks.separation));
        self.presses = surface.gap < rest || (asks.is_first && start_depth > 0.0);
    }
}

/// How a strand's surfaces are asked for.
pub(super) struct Asks<'a> {
    pub surfaces: &'a dyn Surfaces,
    /// Whether nothing has been asked in this step.
    pub is_first: bool,
    /// How far surfaces that overlap when the step begins come apart in it, m.
    pub separation: f64,
}

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
    /// Whether a surface was near it before, and whether it pressed.
    pub was_near: bool,
    /// See `was_near`.
    pub pressed: bool,
    /// No gap of it is smaller than this, overlaps that are permitted counted.
    least: f64,
}

impl Point {
    /// A point of which nothing was known.
    pub fn new(now: Vec3<f64>) -> Self {
        Self { now, was_near: false, pressed: false, least: f64::NEG_INFINITY }
    }
}

/// The points of a strand, from root to tip.
pub(super) struct Line<'a> {
    pub points: &'a mut [Point],
    pub starts: &'a [Start],
    /// What is known of them.
    pub known: &'a mut [Known],
    /// Arclength of the tip, m.
    pub length: f64,
}

impl Line<'_> {
    /// Asks where the surfaces are, as far as it is not known that they are not near.
    pub fn ask(&mut self, asks: &Asks) {
        let margin = if asks.is_first { NEAR } else { 0.0 };
        for (point, known) in self.points.iter_mut().zip(&mut *self.known) {
            (point.was_near, point.pressed) = (known.surface.is_some(), known.presses);
            (known.surface, known.presses) = (None, false);
        }
        self.ask_at_points(asks, margin);
        if self.points.len() >= 2 {
            self.ask_between(asks, margin);
        }
        self.leave_pierced();
    }

    fn ask_at_points(&mut self, asks: &Asks, margin: f64) {
        let mut last: Option<(Vec3<f64>, f64)> = None;
        for ((point, known), start) in self.points.iter_mut().zip(&mut *self.known).zip(self.starts) {
            let now = point.now;
            if !point.pressed {
                let least = known.own.least(now);
                let by_neighbour = last.map_or(f64::NEG_INFINITY, |(at, gap)| gap - SLOPE * distance(now, at));
                if least > margin || by_neighbour > margin {
                    if least <= margin {
                        (known.own.at, known.own.gap) = (now, by_neighbour);
                    }
                    point.least = least.max(by_neighbour);
                    last = Some((now, point.least));
                    continue;
                }
            }
            let (surface, permitted) = known.own.ask(asks, start.arclength, now, || start.at);
            point.least = known.own.gap - permitted;
            last = Some((now, point.least));
            if let Some(surface) = surface {
                known.take(surface, known.own.start_depth.unwrap_or(0.0), asks);
            }
        }
    }

    fn ask_between(&mut self, asks: &Asks, margin: f64) {
        for p in 0..self.points.len() {
            let arclength = self.beside(p);
            let pressed = self.pair(p).iter().any(|point| point.pressed);
            let least = |(point, start): (&Point, &Start)| point.least - SLOPE * (arclength - start.arclength).abs();
            if !pressed && self.pair(p).iter().zip(&self.starts[p..]).map(least).fold(f64::NEG_INFINITY, f64::max) > margin {
                continue;
            }
            let now = self.place(p, arclength, |k| self.points[k].now);
            let mut place = self.known[p].beside;
            if !pressed && place.least(now) > margin {
                continue;
            }
            let (surface, _) = place.ask(asks, arclength, now, || self.place(p, arclength, |k| self.starts[k].at));
            self.known[p].beside = place;
            if let Some(surface) = surface.filter(|surface| !self.meets_end_on(p, surface)) {
                for known in self.known[p..].iter_mut().take(2) {
                    known.take(surface, place.start_depth.unwrap_or(0.0), asks);
                }
            }
        }
    }

    /// Whether a surface between a point and the next faces along the strand, which then goes through something thin: no force along the
    /// strand brings it out.
    fn meets_end_on(&self, p: usize, surface: &SurfaceAtPoint) -> bool {
        let [here, next] = self.pair(p) else { return false };
        let along = next.now - here.now;
        surface.normal.dot(along).abs() > END_ON * along.norm_squared().sqrt()
    }

    /// A point and the next, or the last alone.
    fn pair(&self, p: usize) -> &[Point] {
        &self.points[p..self.points.len().min(p + 2)]
    }

    /// The arclength halfway from point `p` to the next; for the last that of the tip.
    fn beside(&self, p: usize) -> f64 {
        self.starts.get(p + 1).map_or(self.length, |next| 0.5 * (self.starts[p].arclength + next.arclength))
    }

    /// A place at an arclength about point `p`: by the polynomial through the points around it.
    fn place(&self, p: usize, arclength: f64, point: impl Fn(usize) -> Vec3<f64>) -> Vec3<f64> {
        let count = self.starts.len().min(STENCIL);
        let first = p.saturating_sub(1).min(self.starts.len() - count);
        let mut place = Vec3::zero();
        for i in first..first + count {
            let (mut above, mut below) = (1.0, 1.0);
            for j in (first..first + count).filter(|j| *j != i) {
                above *= arclength - self.starts[j].arclength;
                below *= self.starts[i].arclength - self.starts[j].arclength;
            }
            place += point(i).scale(above / below);
        }
        place
    }

    /// Two points next to each other that surfaces push against each other lie on the two sides of something thin, which the strand pierces. No
    /// force along the strand brings it out.
    fn leave_pierced(&mut self) {
        let normal = |of: &Known| of.surface.filter(|_| of.presses).map(|surface| surface.normal);
        let opposed = |here: &Known, next: &Known| Some(normal(here)?.dot(normal(next)?) < 0.0);
        let mut was = false;
        for p in 0..self.known.len() {
            let is = self.known.get(p + 1).and_then(|next| opposed(&self.known[p], next)).unwrap_or(false);
            if was || is {
                let known = &mut self.known[p];
                (known.presses, known.surface) = (false, None);
            }
            was = is;
        }
    }

    /// Measures the gaps of the points near surfaces at the end of a step, and returns the smallest of all places; infinity where
    /// nothing overlaps.
    pub fn measure(&mut self, surfaces: &dyn Surfaces) -> f64 {
        let mut smallest = f64::INFINITY;
        for p in 0..self.points.len() {
            if let Some(surface) = &mut self.known[p].surface {
                surface.gap = gap(surfaces, self.starts[p].arclength, self.points[p].now);
                smallest = smallest.min(surface.gap);
            }
        }
        // Of the others only what is deeper counts.
        for p in 0..self.points.len() {
            let known = &self.known[p];
            if known.surface.is_none() {
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

/// How far the nearest surface is from a point, or how far it is at least, m.
fn gap(surfaces: &dyn Surfaces, arclength: f64, now: Vec3<f64>) -> f64 {
    surfaces.nearest(arclength, now).map_or_else(|at_least| at_least, |surface| surface.gap)
}

fn distance(a: Vec3<f64>, b: Vec3<f64>) -> f64 {
    (a - b).norm_squared().sqrt()
}
