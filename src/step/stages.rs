//! Runge–Kutta steps as minimisations (design, section 5). Stage i of step h ends where
//! Φ(q) = Σ w ρS/(2k²) |r(q) − r̃ − k ṽ|² − Σ w ρS g·r + Σ w ν/(2k) |r − r̃ − k·wind|² + ½ (q−qⁿ)ᵀK(q−qⁿ) + (q−q̃)ᵀD(q−q̃)/(2k)
//! is least, k = γh: implicit Euler over k from a displaced start r̃ = r_t + hΣaᵢⱼVⱼ, ṽ = v_t + hΣaᵢⱼAⱼ, q̃ = q_t + hΣaᵢⱼq̇ⱼ, where
//! Vᵢ = (r − r̃)/k, Aᵢ = (Vᵢ − ṽ)/k, q̇ᵢ = (q − q̃)/k. r̃ need not be a shape of the strand: it is where each point is drawn to.
//! Velocity products need no code: they are in r(q). The root moves first, rigidly; r̃ stays in the world.

use nalgebra::Vector3;

use super::newton::{self, Problem};
use super::state::{StrandState, rotation_matrix};
use super::tableau::{self, Tableau};
use super::workspace::{Stage, Workspace};
use super::{Setting, StrandOutcome, local_error};
use crate::energy::{CurvatureQuadratic, PointQuadratic, drag, elastic, friction, gravity, inertia};
use crate::math::frame::Frame;
use crate::math::rotation::rotation_vector;
use crate::math::vector::Vec3;
use crate::rod::strand::StrandModel;

/// Takes one strand through a step of `h` seconds; `root_at(seconds)` is the root's pose that long after the step's start.
pub fn take(
    tableau: &Tableau,
    setting: &Setting,
    state: &mut StrandState,
    root_at: &dyn Fn(f64) -> Frame,
    h: f64,
    workspace: &mut Workspace,
) -> StrandOutcome {
    let Setting { model, rules, .. } = *setting;
    let rule = rules.rule(state.rule);
    let (axes, free) = (model.freedoms.axes(), model.freedoms.count());
    workspace.kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rule);
    workspace.base.clear();
    workspace.base.extend(workspace.kinematics.points.iter().map(|point| point.position));
    workspace.curvatures.clone_from(&state.curvatures);

    let start = state.root;
    let mut total = StrandOutcome { converged: true, ..StrandOutcome::default() };
    let mut root = state.root;
    for index in 0..tableau.stages {
        root = root_at(tableau.times[index] * h);
        let end_rotation = rotation_matrix(&root);
        let problem =
            Problem { root: &end_rotation, lengths: &model.lengths, axes: &axes[..free], rule, tension_at_start: false };
        displace(index, tableau, state, h, workspace);
        let offset = Vec3::from(root.origin - start.origin);
        let way = if index == 0 { tableau.times[0] * h } else { (tableau.times[index] - tableau.times[index - 1]) * h };
        let k = tableau.gamma * h;
        solve_stage(&StageTimes { index, k, way }, setting, state, offset, &problem, workspace, &mut total);
        if total.quarantined {
            return total;
        }
    }
    if setting.options.error_tolerance > 0.0 {
        total.error = local_error::of_stages(tableau, h, &state.velocities, workspace) / model.length();
    }
    end_step(tableau.stages - 1, state, &root, h, workspace);
    total
}

/// One step of the two-step backward differentiation formula: one stage over k = h/a₀ from where the past two positions, velocities and
/// curvatures point, r̃ = ((1+ω)² r_t − ω² r_{t−1})/(1+2ω) and likewise ṽ and q̃, ω the ratio of this step to the last,
/// a₀ = (1+2ω)/(1+ω). Needs a past; see [`two_step`].
fn backward_difference(
    setting: &Setting,
    state: &mut StrandState,
    root_at: &dyn Fn(f64) -> Frame,
    h: f64,
    workspace: &mut Workspace,
) -> StrandOutcome {
    let Setting { model, rules, .. } = *setting;
    let rule = rules.rule(state.rule);
    let (axes, free) = (model.freedoms.axes(), model.freedoms.count());
    let past_offset = Vec3::from(state.past.root.origin - state.root.origin);
    workspace.kinematics.update(&rotation_matrix(&state.past.root), &model.lengths, &state.past.curvatures, rule);
    workspace.past_base.clear();
    workspace.past_base.extend(workspace.kinematics.points.iter().map(|point| point.position + past_offset));
    workspace.kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rule);
    workspace.base.clear();
    workspace.base.extend(workspace.kinematics.points.iter().map(|point| point.position));
    workspace.curvatures.clone_from(&state.curvatures);

    let ratio = h / state.past.step;
    let divisor = 1.0 / (1.0 + 2.0 * ratio);
    let (now, then) = ((1.0 + ratio) * (1.0 + ratio) * divisor, ratio * ratio * divisor);
    let stage = &mut workspace.stages[0];
    stage.start_positions.clear();
    stage.start_velocities.clear();
    stage.start_curvatures.clear();
    for (base, past) in workspace.base.iter().zip(&workspace.past_base) {
        stage.start_positions.push(base.scale(now) - past.scale(then));
    }
    for (velocity, past) in state.velocities.iter().zip(&state.past.velocities) {
        stage.start_velocities.push(velocity.scale(now) - past.scale(then));
    }
    for (row, past) in state.curvatures.iter().zip(&state.past.curvatures) {
        stage.start_curvatures.push(std::array::from_fn(|axis| now * row[axis] - then * past[axis]));
    }

    let root = root_at(h);
    let end_rotation = rotation_matrix(&root);
    let problem = Problem { root: &end_rotation, lengths: &model.lengths, axes: &axes[..free], rule, tension_at_start: false };
    let offset = Vec3::from(root.origin - state.root.origin);
    let k = h * (1.0 + ratio) * divisor;
    let mut total = StrandOutcome { converged: true, ..StrandOutcome::default() };
    solve_stage(&StageTimes { index: 0, k, way: h }, setting, state, offset, &problem, workspace, &mut total);
    if !total.quarantined {
        if setting.options.error_tolerance > 0.0 {
            let past = &state.past.velocities;
            total.error =
                local_error::of_backward_differences(ratio, h, &state.velocities, past, offset, workspace) / model.length();
        }
        end_step(0, state, &root, h, workspace);
    }
    total
}

/// The second-order integrator: backward differences over the last two steps. The first step, and one after a jump of the step's size,
/// has no past to lean on and goes by two stages of implicit Runge and Kutta's kind.
pub fn two_step(
    setting: &Setting,
    state: &mut StrandState,
    root_at: &dyn Fn(f64) -> Frame,
    h: f64,
    workspace: &mut Workspace,
) -> StrandOutcome {
    let has_past = state.past.step > 0.0 && h <= LARGEST_RATIO * (1.0 + 1e-9) * state.past.step;
    let past = &mut workspace.next_past;
    past.curvatures.clone_from(&state.curvatures);
    past.velocities.clone_from(&state.velocities);
    past.root = state.root;
    past.step = h;
    let outcome = if has_past {
        backward_difference(setting, state, root_at, h, workspace)
    } else {
        take(&tableau::TWO_STAGES, setting, state, root_at, h, workspace)
    };
    std::mem::swap(&mut state.past, &mut workspace.next_past);
    outcome
}

/// The formula is stable for steps that grow by less than 1 + √2; well below that it is accurate too.
const LARGEST_RATIO: f64 = 2.0;

/// Which stage, and its times in seconds.
struct StageTimes {
    index: usize,
    /// The stage is an implicit Euler step of this.
    k: f64,
    /// From the last stage's end, or the step's start, to this one's end.
    way: f64,
}

/// Assembles, starts and minimises one stage.
fn solve_stage(
    stage: &StageTimes,
    setting: &Setting,
    state: &StrandState,
    offset: Vec3<f64>,
    problem: &Problem,
    workspace: &mut Workspace,
    total: &mut StrandOutcome,
) {
    let StageTimes { index, k, way } = *stage;
    assemble_terms(index, setting, k, offset, problem.rule.weights.as_slice(), workspace);
    choose_start(index, way, setting.model, state, problem, workspace);
    let outcome = newton::minimise(problem, setting.options, workspace);
    total.iterations += outcome.iterations;
    total.converged &= outcome.converged;
    total.residual = outcome.residual;
    total.condition = total.condition.max(outcome.condition);
    total.quarantined = outcome.quarantined;
    if !outcome.quarantined {
        finish_stage(index, k, offset, problem.axes, workspace);
    }
}

/// Makes a stage's end the strand's state.
fn end_step(index: usize, state: &mut StrandState, root: &Frame, h: f64, workspace: &Workspace) {
    let last = &workspace.stages[index];
    state.curvatures.copy_from_slice(&workspace.curvatures);
    state.rates.copy_from_slice(&last.rates);
    state.velocities.copy_from_slice(&last.velocities);
    (state.wrench_force, state.wrench_torque) = newton::wrench(&workspace.kinematics, &workspace.system.point_force);
    (state.root_velocity, state.root_angular_velocity) = root_velocity(&state.root, root, h);
    state.root = *root;
}

/// The displaced start of stage `index`: where it would be after the stages before it.
fn displace(index: usize, tableau: &Tableau, state: &StrandState, h: f64, workspace: &mut Workspace) {
    let (before, from_here) = workspace.stages.split_at_mut(index);
    let stage = &mut from_here[0];
    stage.start_positions.clone_from(&workspace.base);
    stage.start_velocities.clone_from(&state.velocities);
    stage.start_curvatures.clone_from(&state.curvatures);
    for (j, earlier) in before.iter().enumerate() {
        let share = h * tableau.below[index][j];
        for p in 0..stage.start_positions.len() {
            stage.start_positions[p] += earlier.velocities[p].scale(share);
            stage.start_velocities[p] += earlier.accelerations[p].scale(share);
        }
        for (row, rate) in stage.start_curvatures.iter_mut().zip(&earlier.rates) {
            for axis in 0..3 {
                row[axis] += share * rate[axis];
            }
        }
    }
}

/// What the stage's end says about velocities, accelerations and rates.
fn finish_stage(index: usize, k: f64, offset: Vec3<f64>, axes: &[usize], workspace: &mut Workspace) {
    let Workspace { stages, kinematics, curvatures, .. } = workspace;
    let Stage { start_positions, start_velocities, start_curvatures, velocities, accelerations, rates } = &mut stages[index];
    let inverse = 1.0 / k;
    velocities.clear();
    accelerations.clear();
    rates.clear();
    for ((point, position), velocity) in kinematics.points.iter().zip(start_positions).zip(start_velocities) {
        let reached = (point.position + offset - *position).scale(inverse);
        velocities.push(reached);
        accelerations.push((reached - *velocity).scale(inverse));
    }
    for (row, start) in curvatures.iter().zip(start_curvatures) {
        // A frozen curvature has no rate: the differences of the two-step start would leave it one, of rounding.
        let mut rate = [0.0; 3];
        for axis in axes {
            rate[*axis] = (row[*axis] - start[*axis]) * inverse;
        }
        rates.push(rate);
    }
}

/// Starts Newton from where the rates lead, or from where it is, whichever is nearer to the minimum. Frozen curvatures are natural.
fn choose_start(index: usize, way: f64, model: &StrandModel, state: &StrandState, problem: &Problem, workspace: &mut Workspace) {
    for (row, natural) in workspace.curvatures.iter_mut().zip(&model.natural) {
        for axis in 0..3 {
            if !model.freedoms.contains(axis) {
                row[axis] = natural[axis];
            }
        }
    }
    workspace.trial_curvatures.clone_from(&workspace.curvatures);
    let rates = if index == 0 { &state.rates } else { &workspace.stages[index - 1].rates };
    for (row, rate) in workspace.trial_curvatures.iter_mut().zip(rates) {
        for axis in problem.axes {
            row[*axis] += way * rate[*axis];
        }
    }
    newton::choose_start(problem, workspace);
}

/// Sums the terms of every point and curvature into a stiffness and a target.
fn assemble_terms(index: usize, setting: &Setting, k: f64, offset: Vec3<f64>, weights: &[f64], workspace: &mut Workspace) {
    let Setting { model, surroundings, .. } = *setting;
    let points = workspace.stages[index].start_positions.len();
    workspace.system.resize(model.element_count(), points);
    workspace.point_target.resize(points, Vec3::zero());
    workspace.curvature_target.resize(model.element_count(), [0.0; 3]);
    let stage = &workspace.stages[index];
    let per_element = weights.len();
    for (element, length) in model.lengths.iter().enumerate() {
        for (node, weight) in weights.iter().enumerate() {
            let p = element * per_element + node;
            let mut quadratic = PointQuadratic::zero();
            inertia::add(&mut quadratic, model.linear_density, k, stage.start_velocities[p]);
            gravity::add(&mut quadratic, model.linear_density, surroundings.gravity);
            if model.material.air_drag > 0.0 {
                drag::add(&mut quadratic, model.material.air_drag, k, surroundings.wind);
            }
            workspace.system.point_stiffness[p] = quadratic.stiffness * (weight * length);
            workspace.point_target[p] = stage.start_positions[p] - offset + quadratic.pull.scale(1.0 / quadratic.stiffness);
        }
        for axis in 0..3 {
            let start = stage.start_curvatures[element][axis];
            let mut quadratic = CurvatureQuadratic::zero();
            elastic::add(&mut quadratic, model.stiffness[axis], model.natural[element][axis], start);
            if model.dissipation[axis] > 0.0 {
                friction::add(&mut quadratic, model.dissipation[axis], k);
            }
            workspace.system.curvature_stiffness[element][axis] = quadratic.stiffness * length;
            workspace.curvature_target[element][axis] = start + quadratic.pull / quadratic.stiffness;
        }
    }
}

/// The root's mean velocity over a step, for steps that do not go through stages.
pub fn root_velocity(from: &Frame, to: &Frame, h: f64) -> (Vector3<f64>, Vector3<f64>) {
    let angular = from.rotation * (rotation_vector(&(from.rotation.inverse() * to.rotation)) / h);
    ((to.origin - from.origin) / h, angular)
}
