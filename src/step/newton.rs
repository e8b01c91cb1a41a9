//! Newton's iteration on a strand's incremental potential: a spring at every quadrature point and at every curvature (see `energy`),
//! nonlinear because the points are where the curvatures put them.
//!
//! Each iteration solves with the exact Hessian, whose geometric terms are of the forces that the iteration before foresaw, not of those
//! that it found: the springs of the points are far stiffer than the strand, so that a point that went by its tangent instead of
//! its arc feels a force many times the true tension, and a Hessian that believes it is far too stiff. So Newton's method treats a
//! constraint and its multiplier. The first iteration foresees nothing and has no geometric terms.
//!
//! Where a pivot is not positive the rotations of all elements are damped (Levenberg and Marquardt's method, measured by rotation) and
//! the system solved again: a mode of negative curvature is then held back where it is. A direction that turns an element by more than
//! the limit is shortened, and one that turns it far beyond is damped too. The way is halved until the potential falls enough (Armijo's
//! condition). The minimum is the step. What each of these brought is in `docs/newton.md`.

use super::StrandOutcome;
use super::damping::Damping;
use super::options::{LinearSolver, StepOptions};
use super::workspace::Workspace;
use crate::chain::dense::{self, DenseMethod};
use crate::chain::displacement;
use crate::chain::system::Direction;
use crate::math::quadrature::Rule;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::Kinematics;

/// No element turns by more than this in an iteration, rad: beyond it the quadratic model says nothing.
const ROTATION_LIMIT: f64 = 2.0;
/// The same for the dense solves.
const DENSE_ROTATION_LIMIT: f64 = 1.0;
/// A direction that would turn an element by more than this many limits is damped, not only shortened.
const SHORTENED_AT_MOST: f64 = 20.0;
/// An undamped iteration that turned by θ leaves at most about this times θ² to turn: 99 of 100 iterations on shaken and walking heads
/// (`docs/newton.md`).
const QUADRATIC: f64 = 50.0;
/// Where the iterations themselves show a larger constant, this times what they show is taken.
const QUADRATIC_SAFETY: f64 = 3.0;
/// Dampings tried in an iteration: 4⁴⁰ spans all of f64 that matters.
const MAX_DAMPINGS: u32 = 40;
/// Armijo's fraction of the promised descent.
const ARMIJO: f64 = 1e-4;
/// Halvings of the way before an iteration is given up.
const MAX_HALVINGS: u32 = 40;

/// The potential and how far rounding may move it.
#[derive(Debug, Clone, Copy)]
struct Potential {
    value: f64,
    noise: f64,
}

/// What does not change during the iteration.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// The root's rotation at the step's end.
    pub root: &'a Mat3<f64>,
    /// Element lengths.
    pub lengths: &'a [f64],
    /// Free curvatures, ascending.
    pub axes: &'a [usize],
    /// Quadrature rule.
    pub rule: &'a Rule,
    /// Whether the springs' forces at the start are the tension to believe: so in a search for a rest, where they are the weight.
    pub tension_at_start: bool,
}

/// Solves the workspace's linear system with the solver that the options name.
pub fn direction(workspace: &mut Workspace, axes: &[usize], solver: LinearSolver) -> Direction<f64> {
    let Workspace { kinematics, system, elimination, change, .. } = workspace;
    let method = match solver {
        LinearSolver::LinearTime => return elimination.solve(kinematics, system, axes, change),
        LinearSolver::DenseCholesky => DenseMethod::Cholesky,
        LinearSolver::DenseConjugateGradients => DenseMethod::ConjugateGradients,
        LinearSolver::DenseSingularValues => DenseMethod::SingularValues,
    };
    dense::solve(kinematics, system, axes, method, change)
}

/// Minimises the potential that `point_target`, `curvature_target` and the stiffnesses of the workspace's system describe, from
/// `curvatures`, which ends at the minimum; `kinematics` and the system's forces end there too.
pub fn minimise(problem: &Problem, options: &StepOptions, workspace: &mut Workspace) -> StrandOutcome {
    let mut outcome = StrandOutcome::default();
    workspace.system.exact = options.exact_hessian && problem.tension_at_start;
    workspace.system.point_tension.clear();
    place(problem, &mut workspace.kinematics, &workspace.curvatures);
    let mut potential = evaluate(workspace, false);
    if !potential.value.is_finite() {
        outcome.quarantined = true;
        return outcome;
    }
    let dense = options.linear_solver != LinearSolver::LinearTime;
    let limit = if dense { DENSE_ROTATION_LIMIT } else { ROTATION_LIMIT };
    let mut damping = Damping::new(usual_damping(workspace));
    // The last iteration's rotation, if Newton went its whole way undamped.
    let mut before: Option<f64> = None;
    for iteration in 1..=options.max_iterations {
        outcome.iterations = iteration;
        forces(workspace);
        let found = damped_direction(workspace, problem.axes, options.linear_solver, &mut damping);
        outcome.condition = found.condition;
        let rotation = found.rotation_squared.sqrt();
        if !(rotation.is_finite() && found.descent.is_finite()) {
            outcome.quarantined = true;
            return outcome;
        }
        outcome.residual = rotation;
        let part = if rotation > limit { limit / rotation } else { 1.0 };
        let Some((next, gone)) = walk(problem, workspace, potential, found.descent, part) else {
            // No way down that rounding lets us see: the state is as good as this potential can tell.
            return outcome;
        };
        if !dense {
            // The model promised f·d − ½ d·H d with H d = f − λ·(rotations).
            let promised = 0.5 * (found.descent + damping.value * found.rotation_sum);
            let seen = promised >= 8.0 * potential.noise;
            damping.learn(if seen { (potential.value - next.value) / promised } else { 1.0 });
        }
        potential = next;
        std::mem::swap(&mut workspace.kinematics, &mut workspace.trial);
        std::mem::swap(&mut workspace.curvatures, &mut workspace.trial_curvatures);
        let newton = damping.value == 0.0 && gone == 1.0;
        let quadratic = newton && workspace.system.exact;
        outcome.residual = if quadratic { rotation * (constant(rotation, before) * rotation).min(1.0) } else { rotation };
        if outcome.residual <= options.tolerance && (newton || stationary(problem, workspace, options)) {
            outcome.converged = true;
            break;
        }
        before = newton.then_some(rotation);
        foresee(workspace, gone);
        workspace.system.exact = options.exact_hessian;
    }
    forces(workspace);
    outcome
}

/// Of two starts, keeps the one with the lower potential: `curvatures` or `trial_curvatures`.
pub fn choose_start(problem: &Problem, workspace: &mut Workspace) {
    place(problem, &mut workspace.kinematics, &workspace.curvatures);
    place(problem, &mut workspace.trial, &workspace.trial_curvatures);
    let (first, second) = (evaluate(workspace, false), evaluate(workspace, true));
    if second.value < first.value {
        std::mem::swap(&mut workspace.curvatures, &mut workspace.trial_curvatures);
    }
}

/// The forces that the springs would have come to had the points gone `gone` of the direction along their tangents, from the
/// forces at hand and the kinematics of where they went from, which are those on trial now.
fn foresee(workspace: &mut Workspace, gone: f64) {
    let Workspace { trial, system, change, .. } = workspace;
    system.point_tension.clone_from(&system.point_force);
    let (tension, stiffness) = (&mut system.point_tension, &system.point_stiffness);
    displacement::for_each_point(trial, change, |p, moved| tension[p] -= moved.scale(gone * stiffness[p]));
}

/// Newton's direction; the linear-time solve damps it until every pivot is positive and no element turns far beyond the limit.
fn damped_direction(workspace: &mut Workspace, axes: &[usize], solver: LinearSolver, damping: &mut Damping) -> Direction<f64> {
    damping.begin();
    for _ in 0..MAX_DAMPINGS {
        workspace.system.rotation_stiffness = damping.value;
        let found = direction(workspace, axes, solver);
        let good = found.repaired == 0.0 && found.rotation_squared <= (SHORTENED_AT_MOST * ROTATION_LIMIT).powi(2);
        // The dense solves repair by eigenvalues and know no damping; a direction that is not finite stays so.
        if good || solver != LinearSolver::LinearTime || !found.rotation_squared.is_finite() {
            return found;
        }
        damping.grow();
    }
    direction(workspace, axes, solver)
}

/// Goes along the direction, `part` of it at first, halving until the potential falls enough; the trial state is then where it is.
fn walk(problem: &Problem, workspace: &mut Workspace, from: Potential, descent: f64, mut part: f64) -> Option<(Potential, f64)> {
    for _ in 0..MAX_HALVINGS {
        workspace.trial_curvatures.clone_from(&workspace.curvatures);
        for (row, change) in workspace.trial_curvatures.iter_mut().zip(&workspace.change) {
            for axis in 0..3 {
                row[axis] += part * change[axis];
            }
        }
        place(problem, &mut workspace.trial, &workspace.trial_curvatures);
        let trial = evaluate(workspace, true);
        if trial.value <= from.value - ARMIJO * part * descent + from.noise {
            return Some((trial, part));
        }
        part *= 0.5;
    }
    None
}

/// Whether the accepted state, which damped iterations crept to, solves the step's equations without being a minimum: a strand that
/// symmetry balances on its end, in a step too long for inertia to hold it there. Reflected pivots turn the direction, not its size.
fn stationary(problem: &Problem, workspace: &mut Workspace, options: &StepOptions) -> bool {
    if options.linear_solver != LinearSolver::LinearTime {
        return false;
    }
    forces(workspace);
    workspace.system.point_tension.clear();
    workspace.system.exact = options.exact_hessian;
    workspace.system.rotation_stiffness = 0.0;
    let found = direction(workspace, problem.axes, options.linear_solver);
    found.rotation_squared.sqrt() <= options.tolerance
}

/// The constant C of Newton's quadratic convergence, θₖ₊₁ ≤ C θₖ²: the usual one, or what the last two rotations show.
fn constant(rotation: f64, before: Option<f64>) -> f64 {
    before.map_or(QUADRATIC, |before| QUADRATIC.max(QUADRATIC_SAFETY * rotation / (before * before)))
}

/// The damping to try first: a hundredth of what the points' springs hold the rotation of one element's share with.
fn usual_damping(workspace: &Workspace) -> f64 {
    let stiffness: f64 = workspace.system.point_stiffness.iter().sum();
    let length: f64 = workspace.kinematics.elements.iter().map(|element| element.length).sum();
    0.01 * stiffness * length * length / workspace.kinematics.elements.len() as f64
}

fn place(problem: &Problem, kinematics: &mut Kinematics<f64>, curvatures: &[[f64; 3]]) {
    kinematics.update(problem.root, problem.lengths, curvatures, problem.rule);
}

/// The potential at the accepted state or at the one on trial.
fn evaluate(workspace: &Workspace, trial: bool) -> Potential {
    let (kinematics, curvatures) =
        if trial { (&workspace.trial, &workspace.trial_curvatures) } else { (&workspace.kinematics, &workspace.curvatures) };
    let mut value = 0.0;
    let mut lever = 0.0;
    for (p, point) in kinematics.points.iter().enumerate() {
        let stiffness = workspace.system.point_stiffness[p];
        let off = point.position - workspace.point_target[p];
        let square = off.norm_squared();
        value += 0.5 * stiffness * square;
        lever += stiffness * (square * point.position.norm_squared()).sqrt();
    }
    for (element, row) in curvatures.iter().enumerate() {
        for axis in 0..3 {
            let off = row[axis] - workspace.curvature_target[element][axis];
            value += 0.5 * workspace.system.curvature_stiffness[element][axis] * off * off;
        }
    }
    Potential { value, noise: 4.0 * f64::EPSILON * (value + lever) }
}

/// The forces of the springs at the accepted state.
pub fn forces(workspace: &mut Workspace) {
    let Workspace { kinematics, system, point_target, curvature_target, curvatures, .. } = workspace;
    for (p, point) in kinematics.points.iter().enumerate() {
        system.point_force[p] = (point_target[p] - point.position).scale(system.point_stiffness[p]);
    }
    for (element, row) in curvatures.iter().enumerate() {
        for axis in 0..3 {
            system.curvature_force[element][axis] =
                system.curvature_stiffness[element][axis] * (curvature_target[element][axis] - row[axis]);
        }
    }
}

/// Sum of the forces on the points and of their moments about the root.
pub fn wrench(kinematics: &Kinematics<f64>, forces: &[Vec3<f64>]) -> (Vec3<f64>, Vec3<f64>) {
    let (mut force, mut torque) = (Vec3::zero(), Vec3::zero());
    for (point, f) in kinematics.points.iter().zip(forces) {
        force += *f;
        torque += point.position.cross(*f);
    }
    (force, torque)
}
