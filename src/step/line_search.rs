//! The line search of Newton's iteration, for free and constrained strands: the step length along a direction, its effect on the
//! damping, and the estimated error.
//!
//! It halves the step length until the merit function falls enough (Armijo's condition): the potential of a free strand, the
//! Lagrangian of a constrained one.

use super::damping::Damping;
use super::iterate::{Iterate, Problem, place_trial};
use crate::chain::system::Direction;
use crate::math::lane::{Lane, MAX_LANES, Precision};

/// An undamped iteration that turned by θ leaves at most about this times θ² to turn (`docs/theory/newton.md`).
const QUADRATIC: f64 = 50.0;
/// Where the iterations show a larger constant, the estimate takes this many times what they show.
const QUADRATIC_SAFETY: f64 = 3.0;
/// Armijo's fraction of the predicted descent.
const ARMIJO: f64 = 1e-4;
/// Largest number of halvings in an iteration.
const MAX_HALVINGS: u32 = 40;

/// A merit function's value and its rounding error.
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
        // An index that the compiler can prove to be within the arrays.
        let lane = self.0.trailing_zeros() as usize % MAX_LANES;
        self.0 &= self.0 - 1;
        Some(lane)
    }
}

/// The fraction of a direction to try first: less than one where an element would turn by more than the limit.
#[inline(always)]
pub(super) fn first_fraction(rotation: f64, limit: f64) -> f64 {
    if rotation > limit { limit / rotation } else { 1.0 }
}

/// A search along directions, one per lane; lanes are sets of bits.
pub(super) struct LineSearch<'a, T> {
    pub problem: &'a Problem<'a, T>,
    /// The predicted fall of the merit functions along the directions, to first order.
    pub descent: T,
    /// The merit functions at the start of the search.
    pub from: &'a [Merit; MAX_LANES],
    /// Lanes that take the full step unchecked.
    pub trusted: u32,
}

impl<T: Lane> LineSearch<'_, T> {
    /// Searches along the directions of the `running` lanes: starts at the fraction `part` of each and halves it until the merit
    /// function falls enough; the trial state is then the result. `merit` makes a lane's merit from its potential at a trial.
    /// Returns the lanes that found no descent, which stay where they are like those that do not run, and the merits of the
    /// others.
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
            // (Even if none runs: the trial state must be that of all lanes.)
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

/// Updates the damping after an iteration that went from one merit to the other.
#[inline(always)]
pub(super) fn teach<T: Lane>(damping: &mut Damping, found: &Direction<T>, lane: usize, from: Merit, to: Merit) {
    // The model predicted f·d − ½ d·H d, with H d = f − λ·(rotations).
    let promised = 0.5 * (found.descent.lane(lane) + damping.value * found.rotation_sum.lane(lane));
    let seen = promised >= 8.0 * from.noise;
    damping.learn(if seen { (from.value - to.value) / promised } else { 1.0 });
}

/// Estimated distance of an element from convergence after it turned by `rotation`, rad; `quadratic`: in an undamped full step
/// with the exact Hessian, `before`: after one that turned by that.
#[inline(always)]
pub(super) fn left(rotation: f64, quadratic: bool, before: Option<f64>) -> f64 {
    let left = constant(rotation, before) * rotation;
    if quadratic { rotation * left.min(1.0) } else { rotation }
}

/// Moves the trial state the fraction `part` of the direction away from the accepted one, in the lanes of `moving`.
#[inline(always)]
fn place_on_way<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>, part: &[f64; MAX_LANES], moving: u32) -> (T, T) {
    let fraction = T::from_lanes(|lane| part[lane]);
    let moving = T::mask(moving);
    it.trial_curvatures.clone_from(&it.curvatures);
    if T::PRECISION == Precision::F32 {
        it.trial_compensation.clone_from(&it.compensation);
        for (element, row) in it.trial_curvatures.iter_mut().enumerate() {
            for axis in problem.axes {
                let way = fraction * it.change[element][*axis] + it.compensation[element][*axis];
                let (sum, rest) = row[*axis].two_sum(way);
                row[*axis] = T::select(moving, sum, row[*axis]);
                it.trial_compensation[element][*axis] = T::select(moving, rest, it.compensation[element][*axis]);
            }
        }
        return place_trial(problem, it);
    }
    for (row, change) in it.trial_curvatures.iter_mut().zip(&it.change) {
        for axis in 0..3 {
            row[axis] = T::select(moving, row[axis] + fraction * change[axis], row[axis]);
        }
    }
    place_trial(problem, it)
}

/// The constant C of Newton's quadratic convergence, θₖ₊₁ ≤ C θₖ²: the usual one, or the one that the last two rotations show.
fn constant(rotation: f64, before: Option<f64>) -> f64 {
    before.map_or(QUADRATIC, |before| QUADRATIC.max(QUADRATIC_SAFETY * rotation / (before * before)))
}
