//! The line search of Newton's iteration, for strands alone and for those that forces hold: how far along its direction an iteration goes,
//! what that says of the damping, and how far the end may still be.
//!
//! The way is halved until the merit function falls enough (Armijo's condition): the potential of a strand alone, the Lagrangian of one that
//! forces hold.

use super::damping::Damping;
use super::iterate::{Iterate, Problem, place_trial};
use crate::chain::system::Direction;
use crate::math::lane::{Lane, MAX_LANES, Precision};

/// An undamped iteration that turned by θ leaves at most about this times θ² to turn: 99 of 100 iterations on shaken and walking heads
/// (`docs/theory/newton.md`).
const QUADRATIC: f64 = 50.0;
/// Where the iterations themselves show a larger constant, this times what they show is taken.
const QUADRATIC_SAFETY: f64 = 3.0;
/// Armijo's fraction of the promised descent.
const ARMIJO: f64 = 1e-4;
/// Halvings of the way before an iteration is given up.
const MAX_HALVINGS: u32 = 40;

/// A merit function's value and how far rounding may move it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Merit {
    pub value: f64,
    pub noise: f64,
}

/// The lanes of a set, ascending.
#[inline(always)]
pub(super) fn lanes(set: u32) -> Lanes {
    Lanes(set)
}

/// See [`lanes`].
pub(super) struct Lanes(u32);

impl Iterator for Lanes {
    type Item = usize;
    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        if self.0 == 0 {
            return None;
        }
        // An index that the compiler sees to be below the length of the arrays.
        let lane = self.0.trailing_zeros() as usize % MAX_LANES;
        self.0 &= self.0 - 1;
        Some(lane)
    }
}

/// The fraction of a direction to go first: less than all where an element would turn by more than the limit.
#[inline(always)]
pub(super) fn first_fraction(rotation: f64, limit: f64) -> f64 {
    if rotation > limit { limit / rotation } else { 1.0 }
}

/// A search along directions, a lane each; lanes are sets of bits.
pub(super) struct LineSearch<'a, T> {
    pub problem: &'a Problem<'a, T>,
    /// What the directions promise the merit functions to fall by, to first order.
    pub descent: T,
    /// The merit functions where the search begins.
    pub from: &'a [Merit; MAX_LANES],
    /// Lanes that go the whole way unseen.
    pub trusted: u32,
}

impl<T: Lane> LineSearch<'_, T> {
    /// Goes along the directions of the `running` lanes, `part` of each at first, which it halves until the merit function falls enough; the trial
    /// state is then there. `merit` makes a lane's merit of its potential at a trial. Gives the lanes that found no way down, which stay where they
    /// are as those that do not run, and the merits of the others.
    #[inline(always)]
    pub fn run(
        &self,
        it: &mut Iterate<T>,
        part: &mut [f64; MAX_LANES],
        running: u32,
        mut merit: impl FnMut(&Iterate<T>, usize, Merit) -> Merit,
    ) -> (u32, [Merit; MAX_LANES]) {
        let mut next = [Merit::default(); MAX_LANES];
        let mut pending = running;
        for _ in 0..MAX_HALVINGS {
            // (Where none runs too: the trial state is to be where all are.)
            let (value, noise) = place_on_way(self.problem, it, part, running);
            for lane in lanes(pending) {
                let from = self.from[lane];
                let trial = merit(it, lane, Merit { value: value.lane(lane), noise: noise.lane(lane) });
                let falls = trial.value <= from.value - ARMIJO * part[lane] * self.descent.lane(lane) + from.noise;
                if falls || self.trusted >> lane & 1 == 1 {
                    next[lane] = trial;
                    pending &= !(1 << lane);
                } else {
                    part[lane] *= 0.5;
                }
            }
            if pending == 0 {
                return (0, next);
            }
        }
        place_on_way(self.problem, it, part, running & !pending);
        (pending, next)
    }
}

/// The damping learns from an iteration that went from merit to merit.
#[inline(always)]
pub(super) fn teach<T: Lane>(damping: &mut Damping, found: &Direction<T>, lane: usize, from: Merit, to: Merit) {
    // The model promised f·d − ½ d·H d with H d = f − λ·(rotations).
    let promised = 0.5 * (found.descent.lane(lane) + damping.value * found.rotation_sum.lane(lane));
    let seen = promised >= 8.0 * from.noise;
    damping.learn(if seen { (from.value - to.value) / promised } else { 1.0 });
}

/// How far an element may still be from the end after it turned by `rotation`, rad; `quadratic`: in an undamped iteration that went its whole way by
/// the exact Hessian, `before`: after one that turned by that.
#[inline(always)]
pub(super) fn left(rotation: f64, quadratic: bool, before: Option<f64>) -> f64 {
    let left = constant(rotation, before) * rotation;
    if quadratic { rotation * left.min(1.0) } else { rotation }
}

/// Puts the trial state `part` of the direction on from the accepted one, in the lanes of `moving`.
#[inline(always)]
fn place_on_way<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>, part: &[f64; MAX_LANES], moving: u32) -> (T, T) {
    let share = T::from_lanes(|lane| part[lane]);
    let moving = T::mask(moving);
    it.trial_curvatures.clone_from(&it.curvatures);
    if T::PRECISION == Precision::F32 {
        it.trial_rests.clone_from(&it.rests);
        for (element, row) in it.trial_curvatures.iter_mut().enumerate() {
            for axis in problem.axes {
                let way = share * it.change[element][*axis] + it.rests[element][*axis];
                let (sum, rest) = row[*axis].sum_and_rest(way);
                row[*axis] = T::select(moving, sum, row[*axis]);
                it.trial_rests[element][*axis] = T::select(moving, rest, it.rests[element][*axis]);
            }
        }
        return place_trial(problem, it);
    }
    for (row, change) in it.trial_curvatures.iter_mut().zip(&it.change) {
        for axis in 0..3 {
            row[axis] = T::select(moving, row[axis] + share * change[axis], row[axis]);
        }
    }
    place_trial(problem, it)
}

/// The constant C of Newton's quadratic convergence, θₖ₊₁ ≤ C θₖ²: the usual one, or what the last two rotations show.
fn constant(rotation: f64, before: Option<f64>) -> f64 {
    before.map_or(QUADRATIC, |before| QUADRATIC.max(QUADRATIC_SAFETY * rotation / (before * before)))
}
