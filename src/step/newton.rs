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
//!
//! Files:
//!
//! - `damping.rs`: Levenberg–Marquardt damping of the rotations in Newton's iteration: the parameter λ, N·m/rad, from iteration to iteration.
//! - `iterate.rs`: The state of Newton's iteration: a spring to a target at every quadrature point and every curvature (`energy`), and the strand between them.
//! - `line_search.rs`: The line search of Newton's iteration, for free and for constrained strands.

pub mod damping;
pub mod iterate;
pub(super) mod line_search;

use super::StrandOutcome;
use super::at_points::contacts::{CONTACT_TOLERANCE, Touching};
use super::options::{LinearSolver, StepOptions};
use crate::chain::dense::{Dense, DenseMethod};
use crate::chain::elimination::Elimination;
use crate::chain::system::{Direction, LinearSolve};
use crate::math::lane::{Lane, MAX_LANES, Precision};
use damping::Damping;
use iterate::{Iterate, Problem, evaluate_accepted, forces, place_accepted, place_compensation, predict_tension};
use line_search::{LineSearch, Merit, lanes};

/// A direction that would turn an element by more than this many limits is damped, not only shortened.
const SHORTENED_AT_MOST: f64 = 20.0;
/// In f32 only rounding moves an iteration that is undamped and of full length, turns by no more than this many [`ROUNDING`]s,
/// and turns by no less than [`STALLED`] of the last turn.
const ROUNDING_AT_MOST: f64 = 16.0;
/// See [`ROUNDING_AT_MOST`].
const STALLED: f64 = 0.5;
/// The error of an element that rounding alone may cause in a strand of N elements, rad: this times N + 8 distances from 1 to the
/// next number.
const ROUNDING: f64 = 2.0;
/// A strand whose contacts have not settled after this many iterations may go to and fro between them for ever: from then on it goes ever smaller
/// parts of the way.
const ALL_THE_WAY: u32 = 12;
/// Largest number of dampings in an iteration: 4⁴⁰ spans the relevant range of f64.
pub(super) const MAX_DAMPINGS: u32 = 40;
/// What the iteration tracks for every lane; lanes are sets of bits.
struct Control {
    potential: [Merit; MAX_LANES],
    damping: [Damping; MAX_LANES],
    /// The last iteration's rotation, if it was undamped and of full length.
    before: [Option<f64>; MAX_LANES],
    /// The fraction of the direction that was taken.
    gone: [f64; MAX_LANES],
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
    minimise(problem, options, None, iterate, elimination, start, 1, &mut outcomes);
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
/// there, and with `kinematics` and the system's forces at the minima. Lanes do not affect each other. `touching`: the strands that bodies may
/// touch at their points, whose contacts are asked for in every iteration, and again where it has ended.
#[allow(clippy::too_many_arguments)] // Each is another thing, and all are needed.
#[inline(always)]
pub fn minimise<T: Lane, S: LinearSolve<T>>(
    problem: &Problem<T>,
    options: &StepOptions,
    touching: Option<&Touching>,
    it: &mut Iterate<T>,
    solver: &mut S,
    start: (T, T),
    active: u32,
    outcomes: &mut [StrandOutcome; MAX_LANES],
) {
    it.system.exact = options.exact_hessian && problem.tension_at_start;
    it.system.point_tension.clear();
    place_compensation(it);
    let usual = usual_damping(it);
    let mut control = Control {
        potential: [Merit::default(); MAX_LANES],
        damping: std::array::from_fn(|lane| Damping::new(if lane < T::LANES { usual.lane(lane) } else { 0.0 })),
        before: [None; MAX_LANES],
        gone: [0.0; MAX_LANES],
    };
    let rounding = ROUNDING * T::PRECISION.constants().epsilon * (it.kinematics.elements.len() + 8) as f64;
    let mut running = active;
    // Lanes that have converged if their contacts are still the same, and those that have any.
    let (mut checking, mut pressed) = (0, 0);
    if let Some(touching) = touching {
        touching.begin(it);
    }
    for lane in lanes(active) {
        outcomes[lane] = StrandOutcome::default();
        control.potential[lane] = Merit::of_lane(start, lane);
        if !control.potential[lane].value.is_finite() {
            outcomes[lane].quarantined = true;
            running &= !(1 << lane);
        }
    }
    for iteration in 1..=options.max_iterations {
        if running == 0 {
            break;
        }
        let mut unsettled = 0;
        if let Some(touching) = touching {
            let changed = touching.look(it, running, iteration == 1);
            pressed = touching.with_contacts(it, running);
            unsettled = changed | pressed;
            for lane in lanes(checking & !changed) {
                outcomes[lane].converged = true;
            }
            running &= changed | !checking;
            checking = 0;
            if running == 0 {
                break;
            }
            let potential = evaluate_accepted(problem, it);
            for lane in lanes(running) {
                control.potential[lane] = Merit::of_lane(potential, lane);
            }
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
            part[lane] = line_search::first_fraction(rotation, S::ROTATION_LIMIT);
            if iteration > ALL_THE_WAY && unsettled >> lane & 1 == 1 {
                part[lane] *= f64::from(ALL_THE_WAY) / f64::from(iteration);
            }
            // This near the minimum an f32 potential shows only rounding, and the full step is right.
            if T::PRECISION == Precision::F32 && rotation <= ROUNDING_AT_MOST * rounding && found.repaired.lane(lane) == 0.0 {
                trusted |= 1 << lane;
            }
        }
        // Lanes without a descent that rounding lets us see are as good as their potential can show.
        let from = control.potential;
        let potential = |_: &Iterate<T>, _: usize, potential: Merit| potential;
        let search = LineSearch { problem, descent: found.descent, from: &from, trusted };
        let (failed, next) = search.run(it, &mut part, running, potential);
        running &= !failed;
        for lane in lanes(running) {
            control.gone[lane] = part[lane];
        }
        std::mem::swap(&mut it.kinematics, &mut it.trial);
        std::mem::swap(&mut it.curvatures, &mut it.trial_curvatures);
        std::mem::swap(&mut it.compensation, &mut it.trial_compensation);
        place_compensation(it);
        let (mut to_check, mut ends) = (0, 0);
        for lane in lanes(running) {
            let (outcome, damping, rotation) = (&mut outcomes[lane], &mut control.damping[lane], rotations[lane]);
            let (from, next) = (control.potential[lane], next[lane]);
            let is_pressed = pressed >> lane & 1 == 1;
            if S::DAMPED && !is_pressed {
                line_search::teach(damping, &found, lane, from, next);
            }
            control.potential[lane] = next;
            let newton = damping.value == 0.0 && control.gone[lane] == 1.0;
            outcome.residual = line_search::left(rotation, newton && it.system.exact, control.before[lane]);
            if T::PRECISION == Precision::F32 {
                let stalled = control.before[lane].is_some_and(|before| rotation >= STALLED * before);
                if newton && stalled && rotation <= ROUNDING_AT_MOST * rounding && outcome.residual > options.tolerance {
                    outcome.residual = rotation;
                    ends |= 1 << lane;
                    continue;
                }
            }
            let tolerance = if is_pressed { options.tolerance.max(CONTACT_TOLERANCE) } else { options.tolerance };
            if outcome.residual <= tolerance {
                outcome.residual = outcome.residual.max(rounding);
                if newton || is_pressed {
                    ends |= 1 << lane;
                } else {
                    to_check |= 1 << lane;
                }
            }
            control.before[lane] = newton.then_some(rotation);
        }
        match touching {
            None => {
                for lane in lanes(ends) {
                    outcomes[lane].converged = true;
                }
                running &= !ends;
            }
            Some(touching) => {
                checking = ends;
                if iteration >= touching.options.max_iterations {
                    running &= !pressed;
                }
            }
        }
        if running == 0 {
            break;
        }
        if options.exact_hessian {
            predict_tension(it, problem.axes, &control.gone);
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
    // Of these no iteration is left that could tell.
    for lane in lanes(checking) {
        outcomes[lane].converged = true;
    }
    if let Some(touching) = touching {
        touching.measure(it, active);
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
