//! The surfaces near a quadrature point (`contacts.rs`): of two bodies, or the two sides of a crease in one.
//!
//! A body tells only its surface nearest to a point. In a crease that is now one side and now the other, and a point that knew one alone
//! would go to and fro between them. So a place keeps the sides that it knew in the iteration before, if they hold it together with the
//! nearest.

use super::surfaces::{NEAR, NearestSurfaces, SURFACES_AT_POINT, SurfaceAtPoint};
use crate::math::vector::Vec3;
use std::cmp::Ordering;

/// Two normals of a body whose angle has a larger cosine are of the same side.
const SAME_SIDE: f64 = 0.995;

/// A body that is concave with a larger radius than this, and than it rounds its creases, holds a point by its nearest surface alone, m.
const SHARP: f64 = 2e-3;

/// Distances below this are of rounding, m.
const ROUNDING: f64 = 1e-6;

/// A side that was found farther from a place is not kept, m: its tangent plane may be far from the surface there.
const KEPT: f64 = 5e-3;

/// A surface near a place of a strand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    /// The surface, with its gap at the place.
    pub surface: SurfaceAtPoint,
    /// The point of the body's surface, m, world.
    from: Vec3<f64>,
    /// Whether it was found from inside the body.
    inside: bool,
}

impl Side {
    /// A surface that was found at a place, m, world.
    pub fn new(surface: &SurfaceAtPoint, place: Vec3<f64>) -> Self {
        let distance = surface.distance();
        Self { surface: *surface, from: place - surface.normal.scale(distance), inside: distance < 0.0 }
    }

    /// Whether the other is of the same side of the same body: its normal is much the same, or the body is convex between them.
    fn is_same(&self, other: &Self) -> bool {
        self.surface.body == other.surface.body && !self.makes_crease(other)
    }

    /// Whether two surfaces of a body hold a strand between them: their normals come together within a short way. Where both are at the same
    /// edge, that is a crease if they were found from inside, since from there the nearest of a convex body is a face.
    fn makes_crease(&self, other: &Self) -> bool {
        let (one, two) = (self.surface.normal, other.surface.normal);
        let (turn, across) = (one - two, other.from - self.from);
        let together = turn.dot(across);
        let is_edge_inside = together.abs() <= ROUNDING && self.inside && other.inside;
        // (Along a crease its sides may be anywhere; walls that face each other have no such direction.)
        let along = one.cross(two);
        let aside = across.norm_squared() - along.dot(across).powi(2) / along.norm_squared().max(f64::MIN_POSITIVE);
        let is_sharp = aside < SHARP.max(self.surface.rounding).powi(2) * turn.norm_squared();
        one.dot(two) < SAME_SIDE && is_sharp && (together > ROUNDING || is_edge_inside)
    }

    /// The gap of its tangent plane at a place, m.
    fn gap(&self, now: Vec3<f64>) -> f64 {
        self.surface.normal.dot(now - self.from) + self.surface.permitted - self.surface.margin
    }

    /// Its tangent plane, for a place that is now at `now`.
    pub fn at(mut self, now: Vec3<f64>) -> Self {
        self.surface.gap = self.gap(now);
        self
    }

    /// The same, if that still tells of the surface.
    fn carried(&self, now: Vec3<f64>) -> Option<Self> {
        let side = self.at(now);
        (side.surface.gap < NEAR && (now - self.from).norm_squared() < KEPT * KEPT).then_some(side)
    }
}

/// The sides of a body's crease about a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides {
    /// What was found nearest.
    nearest: Option<Side>,
    /// Where the others are in the list of those, once there have been any: few places are in a crease.
    others: Option<u32>,
}

/// The sides of a crease that are kept beside the nearest.
pub(super) type OtherSides = [Option<Side>; 2];

impl Sides {
    pub const NONE: Self = Self { nearest: None, others: None };

    /// Sets what was found nearest to the place at `now`. Of the other sides that were known it keeps, and returns, the one that presses
    /// and leans most against the nearest, which ends sliding along that, and the nearest of the rest.
    pub fn keep(&mut self, list: &mut Vec<OtherSides>, nearest: Side, now: Vec3<f64>) -> OtherSides {
        let was = self.nearest.replace(nearest);
        if was.is_none() {
            return [None; 2];
        }
        let is_other = |side: &Side| side.surface.body == nearest.surface.body && side.makes_crease(&nearest);
        let [one, two] = self.others.map_or([None; 2], |at| list[at as usize]);
        let mut others = [was, one, two].map(|side| side?.carried(now).filter(is_other));
        let leans = |side: &Side| (side.surface.gap < 0.0).then(|| side.surface.normal.dot(nearest.surface.normal));
        let leaning = take_least(&mut others, leans);
        let kept = [leaning, take_least(&mut others, |side| Some(side.surface.gap))];
        if self.others.is_some() || kept.iter().any(Option::is_some) {
            *known_in(list, &mut self.others, kept) = kept;
        }
        kept
    }
}

/// An item of a list, which is made now if it has no place there yet.
pub(super) fn known_in<'a, V>(list: &'a mut Vec<V>, at: &mut Option<u32>, new: V) -> &'a mut V {
    let at = *at.get_or_insert_with(|| {
        list.push(new);
        list.len() as u32 - 1
    });
    &mut list[at as usize]
}

/// Takes out the side with the least rank, of those that have one.
fn take_least(sides: &mut [Option<Side>], rank: impl Fn(&Side) -> Option<f64>) -> Option<Side> {
    let rank = |side: &Option<Side>| side.as_ref().and_then(&rank);
    let ranked = sides.iter_mut().filter(|side| rank(side).is_some());
    ranked.min_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(Ordering::Equal)).and_then(Option::take)
}

/// A surface near a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    /// The surface, with the smallest gap about the point.
    pub side: Side,
    /// The gap that its spring leaves, m: zero, or below where the surfaces overlapped when the step began.
    pub rest: f64,
    /// The point's depth when the step began, m, as far as surfaces that overlap then come apart.
    pub held: f64,
    /// Whether it presses.
    pub presses: bool,
}

impl Touch {
    /// The gap above where its spring rests, m.
    fn above(&self) -> f64 {
        self.side.surface.gap - self.rest
    }
}

/// A slot for a surface near a point, which the surface keeps from one iteration to the next.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slot {
    /// What is near now.
    pub is: Option<Touch>,
    /// The point's next slot.
    next: Option<u32>,
    /// What was near in the iteration before.
    pub was: Option<Touch>,
}

/// The surfaces near points. A point has a chain of up to [`SURFACES_AT_POINT`] slots, and is known by the first of them; most points
/// have no more, or none.
#[derive(Debug, Clone, Default)]
pub(super) struct Touches(Vec<Slot>);

impl Touches {
    /// Forgets everything.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    fn slot(&self, at: u32) -> &Slot {
        &self.0[at as usize]
    }

    /// Where the slots of a point are.
    fn chain(&self, first: Option<u32>) -> impl Iterator<Item = u32> {
        std::iter::successors(first, |at| self.slot(*at).next)
    }

    /// The slots of a point.
    pub fn slots(&self, first: Option<u32>) -> impl Iterator<Item = &Slot> {
        self.chain(first).map(|at| self.slot(at))
    }

    /// The surfaces near a point.
    pub fn of(&self, first: Option<u32>) -> impl Iterator<Item = &Touch> {
        self.slots(first).filter_map(|slot| slot.is.as_ref())
    }

    /// Calls `work` with each slot of a point and which of them it is.
    fn change(&mut self, first: Option<u32>, mut work: impl FnMut(usize, &mut Slot)) {
        let (mut next, mut number) = (first, 0);
        while let Some(at) = next {
            let slot = &mut self.0[at as usize];
            work(number, slot);
            (next, number) = (slot.next, number + 1);
        }
    }

    /// Begins an iteration: nothing is near a point so far. Returns whether a surface pressed it in the iteration before.
    pub fn begin(&mut self, first: Option<u32>) -> bool {
        let mut pressed = false;
        self.change(first, |_, slot| {
            slot.was = slot.is.take();
            pressed |= slot.was.is_some_and(|touch| touch.presses);
        });
        pressed
    }

    /// Takes over a surface in one of the point's slots, if none of the same side is nearer so far; or, before anything else is known of the
    /// body, none of the same body.
    pub fn take(&mut self, first: &mut Option<u32>, touch: Touch, is_first: bool) {
        let is_known = |slot: &Slot| slot.is.is_some_and(|other| other.side.surface.body == touch.side.surface.body);
        let known = if is_first { self.find(*first, is_known) } else { None };
        let at = known.unwrap_or_else(|| self.slot_for(first, &touch));
        let slot = &mut self.0[at as usize];
        if slot.is.is_none_or(|nearest| touch.above() < nearest.above()) {
            slot.is = Some(touch);
        }
    }

    /// Where a surface goes: where the same side is or was; else where none is, was, or is nearest.
    fn slot_for(&mut self, first: &mut Option<u32>, touch: &Touch) -> u32 {
        let same = |other: &Option<Touch>| other.is_some_and(|other| other.side.is_same(&touch.side));
        let found = (self.find(*first, |slot| same(&slot.is)))
            .or_else(|| self.find(*first, |slot| slot.is.is_none() && same(&slot.was)))
            .or_else(|| self.find(*first, |slot| slot.is.is_none() && slot.was.is_none()))
            .or_else(|| self.add_slot(first))
            .or_else(|| self.find(*first, |slot| slot.is.is_none()));
        found.unwrap_or_else(|| self.highest(*first))
    }

    /// Where the first slot of a point is that is so.
    fn find(&self, first: Option<u32>, is_so: impl Fn(&Slot) -> bool) -> Option<u32> {
        self.chain(first).find(|at| is_so(self.slot(*at)))
    }

    /// Where the surface of a point is that is highest above where its spring rests.
    fn highest(&self, first: Option<u32>) -> u32 {
        let above = |at: &u32| self.slot(*at).is.map_or(f64::INFINITY, |touch| touch.above());
        self.chain(first).max_by(|a, b| above(a).total_cmp(&above(b))).unwrap_or(0)
    }

    /// Adds a slot to a point, unless it has all that it may.
    fn add_slot(&mut self, first: &mut Option<u32>) -> Option<u32> {
        let new = (self.chain(*first).count() < SURFACES_AT_POINT).then_some(self.0.len() as u32)?;
        match self.chain(*first).last() {
            Some(last) => self.0[last as usize].next = Some(new),
            None => *first = Some(new),
        }
        self.0.push(Slot { is: None, next: None, was: None });
        Some(new)
    }

    /// Which slots of a point and of the next have a body's surfaces that push them against each other, not into a crease.
    pub fn pierce(&self, here: Option<u32>, there: Option<u32>) -> [Which; 2] {
        let mut pierced = [Which::default(); 2];
        for (here, touch) in self.slots(here).enumerate() {
            for (there, other) in self.slots(there).enumerate() {
                let (Some(touch), Some(other)) = (&touch.is, &other.is) else { continue };
                let opposed = touch.side.surface.normal.dot(other.side.surface.normal) < 0.0;
                if touch.presses && other.presses && opposed && touch.side.is_same(&other.side) {
                    (pierced[0][here], pierced[1][there]) = (true, true);
                }
            }
        }
        pierced
    }

    /// Takes away the surfaces in some slots of a point.
    pub fn leave(&mut self, first: Option<u32>, is_left: impl Fn(usize) -> bool) {
        self.change(first, |number, slot| {
            if is_left(number) {
                slot.is = None;
            }
        });
    }

    /// Measures the gaps of a point at `now`, where these surfaces were found.
    pub fn measure(&mut self, first: Option<u32>, found: Option<&NearestSurfaces>, now: Vec3<f64>) {
        self.change(first, |_, slot| {
            let Some(touch) = &mut slot.is else { return };
            let found = found.and_then(|found| found.iter().find(|found| Side::new(found, now).is_same(&touch.side)));
            touch.side.surface.gap = found.map_or_else(|| touch.side.gap(now), |found| found.gap);
        });
    }
}

/// For each slot of a point whether it is one of some.
pub(super) type Which = [bool; SURFACES_AT_POINT];

#[cfg(test)]
mod tests {
    use super::*;

    const MARGIN: f64 = 5e-5;

    /// The surface of a body that is found at a place `distance` from it, with this normal.
    fn side(normal: [f64; 3], place: [f64; 3], distance: f64) -> Side {
        let length = Vec3(normal).norm_squared().sqrt();
        let surface = SurfaceAtPoint {
            body: 0,
            feature: 0,
            gap: distance - MARGIN,
            permitted: 0.0,
            margin: MARGIN,
            rounding: 0.0,
            normal: Vec3(normal).scale(1.0 / length),
            carried: Vec3::zero(),
            along: 0.0,
            against: 0.0,
        };
        Side::new(&surface, Vec3(place))
    }

    #[test]
    fn sides_hold_a_strand_together_in_creases_and_not_at_edges() {
        let (left, right) = ([0.0, 1.0, 1.0], [0.0, -1.0, 1.0]);
        let d = MARGIN / 2.0_f64.sqrt();
        // A groove along x: from above, from above and inside, and from inside, where its bottom is nearest.
        let above = [side(left, [0.0, -1e-3, 1e-3 + 2.0 * d], MARGIN), side(right, [0.0, 0.0, 2.0 * d], MARGIN)];
        let below = |y: f64| side([0.0, -y, 1e-4], [0.0, y, -1e-4], -y.hypot(1e-4));
        for (one, two) in [(above[0], above[1]), (above[0], below(5e-5)), (below(-5e-5), below(5e-5))] {
            assert!(one.makes_crease(&two) && two.makes_crease(&one), "{one:?} {two:?}");
        }
        // A bowl of 2.5 mm radius, unless the body rounds its creases by more.
        let bowl = |angle: f64, rounding: f64| {
            let (y, z) = angle.sin_cos();
            let mut of = side([0.0, -y, z], [0.0, (2.5e-3 - MARGIN) * y, (MARGIN - 2.5e-3) * z], MARGIN);
            of.surface.rounding = rounding;
            of
        };
        for (rounding, holds) in [(0.0, false), (3e-3, true)] {
            assert_eq!(bowl(-0.2, rounding).makes_crease(&bowl(0.2, rounding)), holds);
        }
        // A slit between walls that face each other, and a plate.
        let wall = |y: f64, normal: f64| side([0.0, normal, 0.0], [0.0, y + normal * MARGIN, 0.0], MARGIN);
        assert!(wall(-1e-4, 1.0).makes_crease(&wall(1e-4, -1.0)));
        assert!(!wall(-1e-4, -1.0).makes_crease(&wall(1e-4, 1.0)));
        // A ridge along x: from its sides, from above, where its edge is nearest, and from inside.
        let sides = |depth: f64| {
            [
                side(right, [0.0, -1e-3, -1e-3 - depth], -depth / 2.0_f64.sqrt()),
                side(left, [0.0, 1e-3, -1e-3 - depth], -depth / 2.0_f64.sqrt()),
            ]
        };
        let over = |y: f64| side([0.0, y, 1e-4], [0.0, y, 1e-4], y.hypot(1e-4));
        for [one, two] in [sides(-1e-4), sides(1e-4), [over(-5e-5), over(5e-5)], [sides(1e-4)[0], over(5e-5)]] {
            assert!(!one.makes_crease(&two) && !two.makes_crease(&one), "{one:?} {two:?}");
        }
    }

    #[test]
    fn a_place_keeps_the_side_that_leans_against_the_nearest() {
        let (mut sides, mut list) = (Sides::NONE, Vec::new());
        let now = |y: f64| Vec3([0.0, y, 1e-5]);
        let of = |y: f64| side([0.0, -y.signum(), 1.0], now(y).0, (1e-5 - y.abs()) / 2.0_f64.sqrt());
        assert!(sides.keep(&mut list, of(-1e-4), now(-1e-4)).iter().all(Option::is_none));
        // Above the left side's plane, and below.
        for (y, leans) in [(1e-4, false), (1e-5, true)] {
            let [leaning, next] = sides.keep(&mut list, of(y), now(y));
            let gap = (if leans { leaning } else { next }).unwrap().surface.gap;
            assert!((gap - ((1e-5 + y) / 2.0_f64.sqrt() - MARGIN)).abs() < 1e-9, "{gap:e}");
            assert_eq!([leaning, next].iter().flatten().count(), 1);
        }
        // Far away nothing is known of it any more.
        let far = Vec3([0.1, 1e-4, 1e-5]);
        assert!(sides.keep(&mut list, side([0.0, -1.0, 1.0], far.0, -1e-4), far).iter().all(Option::is_none));
    }
}
