//! Newton's iteration on a strand's incremental potential: springs at every quadrature point and every curvature (see `energy`),
//! nonlinear because the curvatures determine the points.
//!
//! Each iteration solves with the exact Hessian, whose geometric terms use lagged tension: the forces that the last iteration
//! predicted, not the ones it found. The springs of the points are far stiffer than the strand. A point that went along its
//! tangent instead of its arc feels a force many times the true tension, and a Hessian built from that force is far too stiff.
//! Newton's method treats a constraint and its multiplier the same way. The first iteration predicts nothing and has no geometric
//! terms.
//!
//! Where a pivot is not positive the iteration damps the rotations of all elements (the Levenberg–Marquardt method, measured by
//! rotation) and solves the system again, which holds back a mode of negative curvature. It shortens a direction that turns an
//! element by more than the limit, and damps one that turns it far beyond. It halves the step length until the potential falls
//! enough (Armijo's condition). The minimum is the result of the time step. `docs/theory/newton.md` measures the effect of each.

use super::StrandOutcome;
use super::damping::Damping;
use super::iterate::{Iterate, Problem, forces, foresee, place_accepted, place_compensation, place_trial};
use super::options::{LinearSolver, StepOptions};
use crate::chain::dense::{Dense, DenseMethod};
use crate::chain::elimination::Elimination;
use crate::chain::system::{Direction, LinearSolve};
use crate::math::lane::{Lane, MAX_LANES, Precision};

/// A direction that would turn an element by more than this many limits is damped, not only shortened.
const SHORTENED_AT_MOST: f64 = 20.0;
/// An undamped iteration that turned by θ leaves at most about this times θ² to turn (`docs/theory/newton.md`).
const QUADRATIC: f64 = 50.0;
/// Where the iterations show a larger constant, the estimate takes this many times what they show.
const QUADRATIC_SAFETY: f64 = 3.0;
/// In f32 only rounding moves an iteration that is undamped and of full length, turns by no more than this many [`ROUNDING`]s,
/// and turns by no less than [`STALLED`] of the last turn.
const ROUNDING_AT_MOST: f64 = 16.0;
/// See [`ROUNDING_AT_MOST`].
const STALLED: f64 = 0.5;
/// The error of an element that rounding alone may cause in a strand of N elements, rad: this times N + 8 distances from 1 to the
/// next number.
const ROUNDING: f64 = 2.0;
/// Largest number of dampings in an iteration: 4⁴⁰ spans the relevant range of f64.
pub(super) const MAX_DAMPINGS: u32 = 40;
/// Armijo's fraction of the predicted descent.
pub(super) const ARMIJO: f64 = 1e-4;
/// Largest number of halvings in an iteration.
pub(super) const MAX_HALVINGS: u32 = 40;

/// The potential, and its rounding error.
#[derive(Debug, Clone, Copy, Default)]
struct Potential {
    value: f64,
    noise: f64,
}

/// What the iteration tracks for every lane; lanes are sets of bits.
struct Control {
    potential: [Potential; MAX_LANES],
    next: [Potential; MAX_LANES],
    damping: [Damping; MAX_LANES],
    /// The last iteration's rotation, if it was undamped and of full length.
    before: [Option<f64>; MAX_LANES],
    /// The fraction of the direction that was taken.
    gone: [f64; MAX_LANES],
}

/// The lanes of a set, ascending.
#[inline(always)]
fn lanes(set: u32) -> Lanes {
    Lanes(set)
}

/// See [`lanes`].
struct Lanes(u32);

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

/// Minimises the potential of one strand with the solver that the options name; see [`minimise`].
pub fn minimise_one<T: Lane>(
    problem: &Problem<T>,
    options: &StepOptions,
    iterate: &mut Iterate<T>,
    elimination: &mut Elimination<T>,
) -> StrandOutcome {
    let mut outcomes = [StrandOutcome::default(); MAX_LANES];
    let start = place_accepted(problem, iterate);
    minimise(problem, options, iterate, elimination, start, 1, &mut outcomes);
    outcomes[0]
}

/// The dense solve of this name.
pub fn dense_solver(solver: LinearSolver) -> Option<Dense> {
    match solver {
        LinearSolver::LinearTime => None,
        LinearSolver::DenseCholesky => Some(Dense(DenseMethod::Cholesky)),
        LinearSolver::DenseConjugateGradients => Some(Dense(DenseMethod::ConjugateGradients)),
        LinearSolver::DenseSingularValues => Some(Dense(DenseMethod::SingularValues)),
    }
}

/// Minimises the potentials given by `point_target`, `curvature_target` and the system's stiffnesses, for the lanes in `active`.
/// Starts at `curvatures` (already evaluated; `start` is the potentials and their rounding errors) and ends with the minima
/// there, and with `kinematics` and the system's forces at the minima. Lanes do not affect each other.
#[inline(always)]
pub fn minimise<T: Lane, S: LinearSolve<T>>(
    problem: &Problem<T>,
    options: &StepOptions,
    it: &mut Iterate<T>,
    solver: &mut S,
    start: (T, T),
    active: u32,
    outcomes: &mut [StrandOutcome; MAX_LANES],
) {
    it.system.exact = options.exact_hessian && problem.tension_at_start;
    it.system.point_tension.clear();
    place_compensation(it);
    let (value, noise) = start;
    let usual = usual_damping(it);
    let mut control = Control {
        potential: [Potential::default(); MAX_LANES],
        next: [Potential::default(); MAX_LANES],
        damping: std::array::from_fn(|lane| Damping::new(if lane < T::LANES { usual.lane(lane) } else { 0.0 })),
        before: [None; MAX_LANES],
        gone: [0.0; MAX_LANES],
    };
    let rounding = ROUNDING * T::PRECISION.constants().epsilon * (it.kinematics.elements.len() + 8) as f64;
    let mut running = active;
    for lane in lanes(active) {
        outcomes[lane] = StrandOutcome::default();
        control.potential[lane] = Potential { value: value.lane(lane), noise: noise.lane(lane) };
        if !control.potential[lane].value.is_finite() {
            outcomes[lane].quarantined = true;
            running &= !(1 << lane);
        }
    }
    for iteration in 1..=options.max_iterations {
        if running == 0 {
            break;
        }
        forces(it);
        let found = damped_direction(it, problem.axes, solver, &mut control, running);
        let mut part = [0.0; MAX_LANES];
        let mut rotations = [0.0; MAX_LANES];
        let mut trusted = 0;
        for lane in lanes(running) {
            let (outcome, rotation) = (&mut outcomes[lane], found.rotation_squared.lane(lane).sqrt());
            outcome.iterations = iteration;
            outcome.condition = found.condition;
            if !(rotation.is_finite() && found.descent.lane(lane).is_finite()) {
                outcome.quarantined = true;
                running &= !(1 << lane);
                continue;
            }
            outcome.residual = rotation;
            rotations[lane] = rotation;
            part[lane] = if rotation > S::ROTATION_LIMIT { S::ROTATION_LIMIT / rotation } else { 1.0 };
            // This near the minimum an f32 potential shows only rounding, and the full step is right.
            if T::PRECISION == Precision::F32 && rotation <= ROUNDING_AT_MOST * rounding && found.repaired.lane(lane) == 0.0 {
                trusted |= 1 << lane;
            }
        }
        // Lanes without a descent that rounding lets us see are as good as their potential can show.
        running &= !walk(problem, it, &mut control, &found, part, running, trusted);
        std::mem::swap(&mut it.kinematics, &mut it.trial);
        std::mem::swap(&mut it.curvatures, &mut it.trial_curvatures);
        std::mem::swap(&mut it.compensation, &mut it.trial_compensation);
        place_compensation(it);
        let mut to_check = 0;
        for lane in lanes(running) {
            let (outcome, damping, rotation) = (&mut outcomes[lane], &mut control.damping[lane], rotations[lane]);
            let (from, next) = (control.potential[lane], control.next[lane]);
            if S::DAMPED {
                // The model predicted f·d − ½ d·H d, with H d = f − λ·(rotations).
                let promised = 0.5 * (found.descent.lane(lane) + damping.value * found.rotation_sum.lane(lane));
                let seen = promised >= 8.0 * from.noise;
                damping.learn(if seen { (from.value - next.value) / promised } else { 1.0 });
            }
            control.potential[lane] = next;
            let newton = damping.value == 0.0 && control.gone[lane] == 1.0;
            let quadratic = newton && it.system.exact;
            let left = constant(rotation, control.before[lane]) * rotation;
            outcome.residual = if quadratic { rotation * left.min(1.0) } else { rotation };
            if T::PRECISION == Precision::F32 {
                let stalled = control.before[lane].is_some_and(|before| rotation >= STALLED * before);
                if newton && stalled && rotation <= ROUNDING_AT_MOST * rounding && outcome.residual > options.tolerance {
                    (outcome.residual, outcome.converged) = (rotation, true);
                    running &= !(1 << lane);
                    continue;
                }
            }
            if outcome.residual <= options.tolerance {
                outcome.residual = outcome.residual.max(rounding);
                if newton {
                    outcome.converged = true;
                    running &= !(1 << lane);
                } else {
                    to_check |= 1 << lane;
                }
            }
            control.before[lane] = newton.then_some(rotation);
        }
        if running == 0 {
            break;
        }
        if options.exact_hessian {
            foresee(it, problem.axes, &control.gone);
        }
        if S::DAMPED && to_check != 0 {
            let still = stationary(problem, it, solver, options);
            for lane in lanes(to_check) {
                if still.lane(lane).sqrt() <= options.tolerance {
                    outcomes[lane].converged = true;
                    running &= !(1 << lane);
                }
            }
        }
        it.system.exact = options.exact_hessian;
    }
    forces(it);
}

/// Newton's direction. The linear-time solve damps it until every pivot is positive and no element turns far beyond the limit.
#[inline(always)]
fn damped_direction<T: Lane, S: LinearSolve<T>>(
    it: &mut Iterate<T>,
    axes: &[usize],
    solver: &mut S,
    control: &mut Control,
    running: u32,
) -> Direction<T> {
    for lane in lanes(running) {
        control.damping[lane].begin();
    }
    let largest = (SHORTENED_AT_MOST * S::ROTATION_LIMIT) * (SHORTENED_AT_MOST * S::ROTATION_LIMIT);
    let mut tries = 0;
    loop {
        it.system.rotation_stiffness = T::from_lanes(|lane| control.damping[lane].value);
        let found = solver.solve(&it.kinematics, &it.system, axes, &mut it.change);
        // The dense solves repair by eigenvalues and know no damping. A good lane keeps its damping, and gets the same direction
        // again.
        let mut good = true;
        if S::DAMPED && tries < MAX_DAMPINGS {
            for lane in lanes(running) {
                let squared = found.rotation_squared.lane(lane);
                // An overflow counts as too large.
                if found.repaired.lane(lane) != 0.0 || squared > largest || !squared.is_finite() {
                    control.damping[lane].grow();
                    good = false;
                }
            }
        }
        if good {
            return found;
        }
        tries += 1;
    }
}

/// Line search along the direction: starts at the fraction `part` and halves it until the potential falls enough; the trial state
/// is then the result. Returns the lanes that found no descent; they stay where they are, as do lanes that do not run. `trusted`
/// lanes take the full step unchecked.
#[inline(always)]
fn walk<T: Lane>(
    problem: &Problem<T>,
    it: &mut Iterate<T>,
    control: &mut Control,
    found: &Direction<T>,
    mut part: [f64; MAX_LANES],
    running: u32,
    trusted: u32,
) -> u32 {
    let mut pending = running;
    let mut moving = running;
    for _ in 0..MAX_HALVINGS {
        let (value, noise) = place_on_way(problem, it, &part, moving);
        for lane in lanes(pending) {
            let from = control.potential[lane];
            let trial = Potential { value: value.lane(lane), noise: noise.lane(lane) };
            let falls = trial.value <= from.value - ARMIJO * part[lane] * found.descent.lane(lane) + from.noise;
            if falls || trusted >> lane & 1 == 1 {
                control.next[lane] = trial;
                control.gone[lane] = part[lane];
                pending &= !(1 << lane);
            } else {
                part[lane] *= 0.5;
            }
        }
        if pending == 0 {
            return 0;
        }
    }
    moving &= !pending;
    place_on_way(problem, it, &part, moving);
    pending
}

/// Moves the trial state the fraction `part` of the direction away from the accepted one, in the lanes of `moving`.
#[inline(always)]
pub(super) fn place_on_way<T: Lane>(problem: &Problem<T>, it: &mut Iterate<T>, part: &[f64; MAX_LANES], moving: u32) -> (T, T) {
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

/// Whether the accepted states, to which damped iterations crept, solve the step's equations without being minima: gives the
/// squared rotation of the undamped direction. A strand that symmetry balances on its end is such a state when the step is too
/// long for inertia to keep it there. Reflected pivots change the direction, not its size.
#[inline(always)]
fn stationary<T: Lane, S: LinearSolve<T>>(problem: &Problem<T>, it: &mut Iterate<T>, solver: &mut S, options: &StepOptions) -> T {
    forces(it);
    std::mem::swap(&mut it.system.point_tension, &mut it.spare_tension);
    it.system.point_tension.clear();
    it.system.exact = options.exact_hessian;
    it.system.rotation_stiffness = T::zero();
    let found = solver.solve(&it.kinematics, &it.system, problem.axes, &mut it.change);
    std::mem::swap(&mut it.system.point_tension, &mut it.spare_tension);
    found.rotation_squared
}

/// The constant C of Newton's quadratic convergence, θₖ₊₁ ≤ C θₖ²: the usual one, or the one that the last two rotations show.
pub(super) fn constant(rotation: f64, before: Option<f64>) -> f64 {
    before.map_or(QUADRATIC, |before| QUADRATIC.max(QUADRATIC_SAFETY * rotation / (before * before)))
}

/// The damping to try first: a hundredth of the stiffness with which one element's points resist its rotation.
#[inline(always)]
pub(super) fn usual_damping<T: Lane>(it: &Iterate<T>) -> T {
    let mut stiffness = T::zero();
    for value in &it.system.point_stiffness {
        stiffness += *value;
    }
    let mut length = T::zero();
    for element in &it.kinematics.elements {
        length += element.length;
    }
    T::splat(0.01) * stiffness * length * length / T::splat(it.kinematics.elements.len() as f64)
}
