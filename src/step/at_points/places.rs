//! What is known of the places of a strand at which the surfaces of bodies are asked for (`probes.rs`): its points, places halfway between
//! them, and its tip.

use super::surfaces::{Entered, NEAR, NearestSurfaces, Passage, PassageBounds, Passed, STEEPEST, SURFACES_AT_POINT, Surfaces};
use super::touches::{OtherSides, Side, Sides, Touch, Touches, known_in};
use crate::math::vector::Vec3;

/// A place that has come into a body is still behind the side through which it came if it is deeper there than this, m: what is nearest to it may
/// push it out on the other side.
const BEHIND: f64 = 5e-4;

/// What is known of a place of one strand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Where it was last looked at, m, world.
    pub at: Vec3<f64>,
    /// Its gap there, or less, m.
    pub gap: f64,
    /// Where it is among the places that a surface has been near to, once one has been.
    near: Option<u32>,
}

impl Place {
    const NOTHING: Self = Self { at: Vec3([0.0; 3]), gap: f64::NEG_INFINITY, near: None };

    /// No gap of it is smaller than this now.
    pub fn least(&self, now: Vec3<f64>) -> f64 {
        self.gap - STEEPEST * distance(now, self.at)
    }

    /// Takes in that its gap is no smaller than `least` (m) where it is `now`.
    pub fn take_least(&mut self, now: Vec3<f64>, least: f64) {
        (self.at, self.gap) = (now, least);
    }

    /// Its gap now, if that may be below `limit` (m); else infinity.
    pub fn gap_below(&self, limit: f64, surfaces: &dyn Surfaces, arclength: f64, now: Vec3<f64>) -> f64 {
        if self.least(now) > limit {
            f64::INFINITY
        } else if now == self.at {
            self.gap
        } else {
            gap(surfaces, arclength, now)
        }
    }

    /// The side through which it has come into a body since the step began, if it has, with its gap now. It stays one for the whole step: else
    /// a place that it has sent back would come in again. Also the depth at the start in a body, where that had to be known.
    fn entered(
        &mut self,
        near: &mut NearPlaces,
        look: &Look,
        nearest: &Result<NearestSurfaces, f64>,
    ) -> (Option<Side>, Option<(u32, f64)>) {
        if near.has_entered
            && let Some(side) = self.near.and_then(|at| near.places[at as usize].entered)
        {
            return (Some(side.at(look.passage.now)), None);
        }
        let PassageBounds { way, is_free, .. } = look.bounds;
        if is_free || way < NEAR || self.gap > STEEPEST * way {
            return (None, None);
        }
        let Passed { entered, start } = look.asks.surfaces.passed(&look.passage, nearest);
        let side = entered.map(|Entered { surface, place }| Side::new(&surface, place));
        if side.is_some() {
            known_in(&mut near.places, &mut self.near, NearPlace::NEW).entered = side;
            near.has_entered = true;
        }
        (side.map(|side| side.at(look.passage.now)), start)
    }

    /// Whether it has come into a body in this step.
    pub fn has_entered(&self, near: &Near) -> bool {
        let NearPlaces { places, has_entered, .. } = &near.places;
        *has_entered && self.near.is_some_and(|at| places[at as usize].entered.is_some())
    }

    /// Asks which surfaces are nearest to it. Calls `take` with those that are near, as touches; returns the smallest gap, overlaps that are
    /// permitted counted.
    pub fn ask(&mut self, near: &mut NearPlaces, look: &Look, mut take: impl FnMut(Touch)) -> f64 {
        let Look { asks, passage: Passage { arclength, now, .. }, .. } = *look;
        self.at = now;
        let found = asks.surfaces.nearest(arclength, now);
        self.gap = found.as_ref().map_or_else(|at_least| *at_least, |found| found.nearest.gap);
        let (entered, start) = self.entered(near, look, &found);
        if let Some(side) = entered {
            take(asks.touch(side, 0.0));
        }
        let Ok(found) = found else { return self.gap };
        if self.gap < NEAR {
            let NearPlaces { places, sides, .. } = near;
            let near = known_in(places, &mut self.near, NearPlace::NEW);
            if let Some((body, depth)) = start {
                near.start_depth_or(body, || depth);
            }
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
struct NearPlace {
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
    fn depth_at_start(&mut self, look: &Look, body: u32) -> f64 {
        self.start_depth_or(body, || look.asks.surfaces.depth_at_start(look.passage.arclength, body, look.passage.start))
    }

    /// The same; if it is not known yet, `depth` tells it, or that it is zero or less.
    fn start_depth_or(&mut self, body: u32, depth: impl FnOnce() -> f64) -> f64 {
        if let Some((_, depth)) = self.start_depth.iter().flatten().find(|(of, _)| *of == body) {
            return *depth;
        }
        let depth = depth().max(0.0);
        self.start_depth.rotate_right(1);
        self.start_depth[0] = Some((body, depth));
        depth
    }
}

/// What is known of a point of one lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    /// The point itself.
    pub own: Place,
    /// The place between it and the next point; for the last point the tip.
    pub beside: Place,
    /// The first of its slots in [`Near::touches`], once a surface has been near.
    pub touches: Option<u32>,
}

impl Known {
    pub const NOTHING: Self = Self { own: Place::NOTHING, beside: Place::NOTHING, touches: None };
}

/// What is known of the points and places that surfaces have been near to in this step: few of all.
#[derive(Debug, Clone, Default)]
pub(super) struct Near {
    /// The places.
    pub places: NearPlaces,
    /// The surfaces near the points.
    pub touches: Touches,
}

/// See [`Near`].
#[derive(Debug, Clone, Default)]
pub(super) struct NearPlaces {
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
pub(super) struct Asks<'a> {
    /// Whom to ask.
    pub surfaces: &'a dyn Surfaces,
    /// Whether nothing has been asked in this step.
    pub is_first: bool,
    /// Surfaces that overlap when the step begins come apart by this in it, m.
    pub separation: f64,
}

impl Asks<'_> {
    /// Whether a place has no surface near it and, if nothing has been asked in this step, has come through none.
    pub fn is_away(&self, bounds: &PassageBounds) -> bool {
        if self.is_first { bounds.least > NEAR && (bounds.way < NEAR || bounds.is_free) } else { bounds.least > 0.0 }
    }

    /// The same of a place whose gap is at least this, and its way at most that, m.
    pub fn is_surely_away(&self, least: f64, way: f64) -> bool {
        least > if self.is_first { NEAR.max(STEEPEST * way) } else { 0.0 }
    }

    /// A surface near a place, in which it was so deep when the step began.
    fn touch(&self, side: Side, start_depth: f64) -> Touch {
        let rest = -(start_depth - self.separation).max(0.0);
        let presses = side.surface.gap < rest || (self.is_first && start_depth > 0.0);
        Touch { side, rest, held: start_depth.min(self.separation), presses }
    }
}

/// A look at a place of a strand.
pub(super) struct Look<'a> {
    /// How surfaces are asked for.
    pub asks: &'a Asks<'a>,
    /// The place on its way.
    pub passage: Passage,
    /// What is known of it.
    pub bounds: PassageBounds,
}

/// How far the nearest surface is from a point, or how far it is at least, m.
fn gap(surfaces: &dyn Surfaces, arclength: f64, now: Vec3<f64>) -> f64 {
    surfaces.nearest(arclength, now).map_or_else(|at_least| at_least, |found| found.nearest.gap)
}

/// How far two places are from each other, m.
fn distance(a: Vec3<f64>, b: Vec3<f64>) -> f64 {
    (a - b).norm_squared().sqrt()
}
