//! The line search of Newton's iteration, for free and for constrained strands.
//!
//! The step is halved until the merit function falls enough (Armijo's condition): the potential of a free strand, the Lagrangian of a
//! constrained one. The result also updates the damping and the estimate of the error left.

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
pub(in crate::step) struct Merit {
    pub value: f64,
    pub noise: f64,
}

impl Merit {
    /// That of a lane.
    #[inline(always)]
    pub fn of_lane<T: Lane>((value, noise): (T, T), lane: usize) -> Self {
        Self { value: value.lane(lane), noise: noise.lane(lane) }
    }
}

/// The lanes of a set, ascending.
#[inline(always)]
pub(in crate::step) fn lanes(set: u32) -> Lanes {
    Lanes(set)
}

/// See [`lanes`].
pub(in crate::step) struct Lanes(u32);

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

/// The fraction of a direction to try first: below one if an element would turn by more than the limit.
#[inline(always)]
pub(in crate::step) fn first_fraction(rotation: f64, limit: f64) -> f64 {
    if rotation > limit { limit / rotation } else { 1.0 }
}

/// A search along directions, one per lane; lanes are sets of bits.
pub(in crate::step) struct LineSearch<'a, T> {
    pub problem: &'a Problem<'a, T>,
    /// The predicted descent of the merit functions, to first order.
    pub descent: T,
    /// The merit functions where the search begins.
    pub from: &'a [Merit; MAX_LANES],
    /// Lanes that take the full step unchecked.
    pub trusted: u32,
}

impl<T: Lane> LineSearch<'_, T> {
    /// Starts at the fraction `part` of the directions of the `running` lanes and halves it until the merit function falls enough; the trial
    /// state is then the result. `merit` turns a lane's potential at a trial into its merit. Returns the lanes that found no descent, which stay
    /// where they are, as do lanes that do not run; and the merits of the others.
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
            // (Also if none runs: the trial state then equals the accepted one.)
            let potential = place_trial_at(self.problem, it, part, running);
            for lane in lanes(pending) {
                let from = self.from[lane];
                let trial = merit(it, lane, Merit::of_lane(potential, lane));
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
        place_trial_at(self.problem, it, part, running & !pending);
        (pending, next)
    }
}

/// Updates the damping by what an iteration predicted and what the merit function did.
#[inline(always)]
pub(in crate::step) fn teach<T: Lane>(damping: &mut Damping, found: &Direction<T>, lane: usize, from: Merit, to: Merit) {
    // The model predicted f·d − ½ d·H d with H d = f − λ·(rotations).
    let promised = 0.5 * (found.descent.lane(lane) + damping.value * found.rotation_sum.lane(lane));
    let seen = promised >= 8.0 * from.noise;
    damping.learn(if seen { (from.value - to.value) / promised } else { 1.0 });
}

/// Estimate of the error left after an iteration that turned an element by `rotation`, rad. `quadratic`: the iteration was undamped, of full
/// length and used the exact Hessian. `before`: the rotation of the iteration before, if that was undamped and of full length.
#[inline(always)]
pub(in crate::step) fn left(rotation: f64, quadratic: bool, before: Option<f64>) -> f64 {
    let left = constant(rotation, before) * rotation;
    if quadratic { rotation * left.min(1.0) } else { rotation }
}

/// Puts the trial state `part` of the direction on from the accepted one, in the lanes of `moving`.
#[inline(always)]
fn place_trial_at<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>, part: &[f64; MAX_LANES], moving: u32) -> (T, T) {
    let fraction = T::from_lanes(|lane| part[lane]);
    let moving = T::mask(moving);
    it.trial_curvatures.clone_from(&it.curvatures);
    if T::PRECISION == Precision::F32 {
        it.trial_compensation.clone_from(&it.compensation);
        for (element, row) in it.trial_curvatures.iter_mut().enumerate() {
            for axis in problem.axes {
                let change = fraction * it.change[element][*axis] + it.compensation[element][*axis];
                let (sum, rest) = row[*axis].two_sum(change);
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

/// The constant C of Newton's quadratic convergence, θₖ₊₁ ≤ C θₖ²: the usual one, or what the last two rotations show.
fn constant(rotation: f64, before: Option<f64>) -> f64 {
    before.map_or(QUADRATIC, |before| QUADRATIC.max(QUADRATIC_SAFETY * rotation / (before * before)))
}
