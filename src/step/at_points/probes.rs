//! Where the surfaces of bodies are about a strand's quadrature points (`contacts.rs`): asked at the points themselves, halfway between
//! two of them, and at the tip.
//!
//! A place between two points has no force of its own: if it is deeper in a body than they are, both bear it.

use super::surfaces::{Entered, NEAR, STEEPEST, SURFACES_AT_POINT, Surfaces};
use super::touches::{OtherSides, Side, Sides, Touch, Touches, known_in};
use crate::math::vector::Vec3;

/// The least cosine of the angle between a strand and the normal of a surface that it meets end on.
const END_ON: f64 = 0.7;

/// A place that has come into a body is still behind the side through which it came if it is deeper there than this, m: what is nearest to it may
/// push it out on the other side.
const BEHIND: f64 = 5e-4;

/// Places between points are interpolated from this many.
const STENCIL: usize = 4;

/// What is known of a place of one strand.
#[derive(Debug, Clone, Copy)]
struct Place {
    /// Where it was last looked at, m, world.
    at: Vec3<f64>,
    /// Its gap there, or less, m.
    gap: f64,
    /// Where it is among the places that a surface has been near to, once one has been.
    near: Option<u32>,
}

impl Place {
    const NOTHING: Self = Self { at: Vec3([0.0; 3]), gap: f64::NEG_INFINITY, near: None };

    /// No gap of it is smaller than this now.
    fn least(&self, now: Vec3<f64>) -> f64 {
        self.gap - STEEPEST * distance(now, self.at)
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

    /// The side through which it has come into a body since the step began, if it has, with its gap now. It stays one for the whole step: else
    /// a place that it has sent back would come in again.
    fn entered(&mut self, near: &mut NearPlaces, look: &Look<impl Fn() -> Vec3<f64>>) -> Option<Side> {
        if near.has_entered
            && let Some(side) = self.near.and_then(|at| near.places[at as usize].entered)
        {
            return Some(side.at(look.now));
        }
        if !look.asks.leads_far() || self.gap > STEEPEST * look.asks.way {
            return None;
        }
        let Entered { surface, place } = look.asks.surfaces.entered(look.arclength, [(look.start)(), look.now], self.gap)?;
        let side = Side::new(&surface, place);
        known_in(&mut near.places, &mut self.near, NearPlace::NEW).entered = Some(side);
        near.has_entered = true;
        Some(side.at(look.now))
    }

    /// Whether it has come into a body in this step.
    fn has_entered(&self, near: &Near) -> bool {
        let NearPlaces { places, has_entered, .. } = &near.places;
        *has_entered && self.near.is_some_and(|at| places[at as usize].entered.is_some())
    }

    /// Asks which surfaces are nearest to it. Calls `take` with those that are near, as touches; returns the smallest gap, overlaps that are
    /// permitted counted.
    fn ask(&mut self, near: &mut NearPlaces, look: &Look<impl Fn() -> Vec3<f64>>, mut take: impl FnMut(Touch)) -> f64 {
        let Look { asks, now, .. } = *look;
        self.at = now;
        let found = asks.surfaces.nearest(look.arclength, now);
        self.gap = found.as_ref().map_or_else(|at_least| *at_least, |found| found.nearest.gap);
        let entered = self.entered(near, look);
        if let Some(side) = entered {
            take(asks.touch(side, 0.0));
        }
        let Ok(found) = found else { return self.gap };
        if self.gap < NEAR {
            let NearPlaces { places, sides, .. } = near;
            let near = known_in(places, &mut self.near, NearPlace::NEW);
            let nearest = Side::new(&found.nearest, now);
            let next = found.next.filter(|next| next.gap < NEAR).map(|next| Side::new(&next, now));
            let [leaning, other] = near.sides.keep(sides, nearest, now);
            let behind = entered.filter(|side| side.surface.gap < -BEHIND).map(|side| side.surface.body);
            for side in [Some(nearest), next, leaning, other].into_iter().flatten() {
                if behind != Some(side.surface.body) {
                    take(asks.touch(side, near.depth_at_start(look, side.surface.body)));
                }
            }
        }
        self.gap - found.nearest.permitted
    }
}

/// What is known of a place that a surface has been near to.
#[derive(Debug, Clone, Copy)]
pub(super) struct NearPlace {
    /// Its depth in bodies when the step began, m, as far as it has been asked for.
    start_depth: [Option<(u32, f64)>; SURFACES_AT_POINT],
    /// The sides of a crease that it is in.
    sides: Sides,
    /// The side through which it has come into a body in this step, where it had not been near.
    entered: Option<Side>,
}

impl NearPlace {
    const NEW: Self = Self { start_depth: [None; SURFACES_AT_POINT], sides: Sides::NONE, entered: None };

    /// How deep it was in a body when the step began, m; zero for outside.
    fn depth_at_start(&mut self, look: &Look<impl Fn() -> Vec3<f64>>, body: u32) -> f64 {
        if let Some((_, depth)) = self.start_depth.iter().flatten().find(|(of, _)| *of == body) {
            return *depth;
        }
        let depth = look.asks.surfaces.depth_at_start(look.arclength, body, (look.start)()).max(0.0);
        self.start_depth.rotate_right(1);
        self.start_depth[0] = Some((body, depth));
        depth
    }
}

/// What is known of a point of one lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    own: Place,
    /// The place between it and the next point; for the last point the tip.
    beside: Place,
    /// The first of its slots in [`Near::touches`], once a surface has been near.
    pub touches: Option<u32>,
}

impl Known {
    pub const NOTHING: Self = Self { own: Place::NOTHING, beside: Place::NOTHING, touches: None };
}

/// What is known of the points and places that surfaces have been near to in this step: few of all.
#[derive(Debug, Clone, Default)]
pub(super) struct Near {
    places: NearPlaces,
    /// The surfaces near the points.
    pub touches: Touches,
}

/// See [`Near`].
#[derive(Debug, Clone, Default)]
struct NearPlaces {
    places: Vec<NearPlace>,
    /// Sides of creases that some of them are in.
    sides: Vec<OtherSides>,
    /// Whether one of them has come into a body in this step.
    has_entered: bool,
}

impl Near {
    /// Forgets everything.
    pub fn clear(&mut self) {
        self.places.places.clear();
        self.places.sides.clear();
        self.places.has_entered = false;
        self.touches.clear();
    }

    /// The surfaces near a point.
    pub fn of(&self, known: &Known) -> impl Iterator<Item = &Touch> {
        self.touches.of(known.touches)
    }
}

/// How a strand's surfaces are asked for.
struct Asks<'a> {
    surfaces: &'a dyn Surfaces,
    is_first: bool,
    separation: f64,
    /// The longest way of a point past a body since the step began, m.
    way: f64,
}

impl Asks<'_> {
    /// Whether a way since the step began may lead through something.
    fn leads_far(&self) -> bool {
        self.way >= NEAR
    }

    /// A surface near a place, in which it was so deep when the step began.
    fn touch(&self, side: Side, start_depth: f64) -> Touch {
        let rest = -(start_depth - self.separation).max(0.0);
        let presses = side.surface.gap < rest || (self.is_first && start_depth > 0.0);
        Touch { side, rest, held: start_depth.min(self.separation), presses }
    }
}

/// A look at a place of a strand.
struct Look<'a, S> {
    asks: &'a Asks<'a>,
    arclength: f64,
    /// Where it is now, m, world.
    now: Vec3<f64>,
    /// Where it was when the step began: few places need it.
    start: S,
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

/// How far the nearest surface is from a point, or how far it is at least, m.
fn gap(surfaces: &dyn Surfaces, arclength: f64, now: Vec3<f64>) -> f64 {
    surfaces.nearest(arclength, now).map_or_else(|at_least| at_least, |found| found.nearest.gap)
}

fn distance(a: Vec3<f64>, b: Vec3<f64>) -> f64 {
    (a - b).norm_squared().sqrt()
}
