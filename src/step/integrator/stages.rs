//! Runge–Kutta steps as minimisations (`docs/theory/integrators.md`).
//!
//! Stage i of step h ends where Φ(q) = Σ w ρS/(2k²) |r(q) − r̃ − k ṽ|² − Σ w ρS g·r + Σ w ν/(2k) |r − r̃ − k·wind|² + ½
//! (q−qⁿ)ᵀK(q−qⁿ) + (q−q̃)ᵀD(q−q̃)/(2k) is least, with k = γh. This is implicit Euler over k from a displaced start r̃ = r_t +
//! hΣaᵢⱼVⱼ, ṽ = v_t + hΣaᵢⱼAⱼ, q̃ = q_t + hΣaᵢⱼq̇ⱼ, where Vᵢ = (r − r̃)/k, Aᵢ = (Vᵢ − ṽ)/k, q̇ᵢ = (q − q̃)/k. r̃ need not be a
//! shape of the strand: each point is drawn to its own r̃. Velocity products need no code: they are in r(q). The root moves
//! first, rigidly; r̃ stays in the world.
//!
//! r, r̃, q and q̃ are differences from the start of the step: what the step changes keeps its digits however short the step is.
//! In f32 curvatures are pairs of a rounded part, which places the points, and a remainder, which moves them by J·remainder to
//! first order.
//!
//! Files:
//!
//! - `terms.rs`: What Newton's iteration of a stage begins with: its two starts, and the terms of all points and curvatures.

mod terms;

use super::local_error;
use super::tableau::{self, Tableau};
use crate::chain::displacement;
use crate::chain::system::LinearSolve;
use crate::math::lane::{Kernel, Lane, MAX_LANES, Precision};
use crate::math::quadrature::Rule;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::freedoms::Freedoms;
use crate::rod::kinematics::{self, Kinematics};
use crate::step::at_points::contacts::Touching;
use crate::step::context::StepContext;
use crate::step::newton;
use crate::step::newton::iterate::{Iterate, Problem, choose_start};
use crate::step::pack::loaded::{self, Loaded, Reads};
use crate::step::pack::members::Pack;
use crate::step::state::StrandState;
use crate::step::workspace::{Stage, Workspace};
use crate::step::{Setting, StrandOutcome};
pub(in crate::step) use terms::{assemble_terms, lead};

/// Takes strands through a step of `h` seconds; the workspace then holds the result. See [`crate::step::pack::whole::Take`].
#[inline(always)]
pub fn take<T: Lane, S: LinearSolve<T>>(tableau: &Tableau, context: &mut StepContext<'_, T, S>) {
    let (members, setting, h) = (context.members, context.setting, context.h);
    let workspace = &mut *context.workspace;
    let rule = setting.rules.rule(members.state(0).rule);
    workspace.loaded.load(members, setting.surroundings, h, Reads { velocities: true, history: false });
    base(rule, workspace);
    *context.outcomes = [StrandOutcome { converged: true, ..StrandOutcome::default() }; MAX_LANES];
    for index in 0..tableau.stages {
        let workspace = &mut *context.workspace;
        displace(index, tableau, workspace);
        let span = tableau.times[index] - if index == 0 { 0.0 } else { tableau.times[index - 1] };
        let step = workspace.loaded.step;
        let times = StageTimes { index, k: T::splat(tableau.gamma) * step, span: T::splat(span) * step };
        solve_stage(times, tableau.times[index] * h, context);
    }
    if setting.options.error_tolerance > 0.0 {
        let error = local_error::of_stages(tableau, context.workspace);
        store_error(error, members, context.workspace, context.outcomes);
    }
}

/// One step of the two-step backward differentiation formula: one stage over k = h/a₀ from the extrapolation of the past two
/// positions, velocities and curvatures, r̃ = ((1+ω)² r_t − ω² r_{t−1})/(1+2ω) and likewise ṽ and q̃, where ω is the ratio of
/// this step to the last and a₀ = (1+2ω)/(1+ω). Needs a history: see [`uses_history`].
#[inline(always)]
fn backward_difference<T: Lane, S: LinearSolve<T>>(context: &mut StepContext<'_, T, S>) {
    let (members, setting, h) = (context.members, context.setting, context.h);
    let (times, ratio) = start_backward_difference(members, setting, h, context.workspace);
    *context.outcomes = [StrandOutcome { converged: true, ..StrandOutcome::default() }; MAX_LANES];
    let offset = solve_stage(times, h, context);
    if setting.options.error_tolerance > 0.0 {
        let error = local_error::of_backward_differences(ratio, offset, context.workspace);
        store_error(error, members, context.workspace, context.outcomes);
    }
}

/// The start of [`backward_difference`]'s stage; returns its times, and ω.
#[inline(always)]
pub(in crate::step) fn start_backward_difference<T: Lane>(
    members: &dyn Pack,
    setting: &Setting,
    h: f64,
    workspace: &mut Workspace<T>,
) -> (StageTimes<T>, T) {
    let rule = setting.rules.rule(members.state(0).rule);
    workspace.loaded.load(members, setting.surroundings, h, Reads { velocities: true, history: true });
    past_base(rule, workspace);
    base(rule, workspace);

    let Workspace { loaded, iterate, stages, past_base, base_compensation, past_compensation, .. } = workspace;
    let (one, two) = (T::one(), T::splat(2.0));
    let ratio = loaded.step / loaded.past_step;
    let divisor = one / (one + two * ratio);
    // (1+ω)²/(1+2ω) exceeds 1 by this: the current value plus `then` of the last step's change. What does not change stays exact.
    let then = ratio * ratio * divisor;
    let stage = &mut stages[0];
    stage.resize(loaded.lengths.len(), past_base.len());
    for (p, start) in stage.start_displacements.iter_mut().enumerate() {
        let mut change = (iterate.point_base[p] - past_base[p]) - loaded.past_offset;
        *start = Vec3::zero();
        if T::PRECISION == Precision::F32 {
            change += base_compensation[p] - past_compensation[p];
            *start = base_compensation[p];
        }
        *start += change.scale(then);
    }
    for (p, start) in stage.start_velocities.iter_mut().enumerate() {
        *start = loaded.velocities[p] + (loaded.velocities[p] - loaded.past_velocities[p]).scale(then);
    }
    for (element, start) in stage.start_changes.iter_mut().enumerate() {
        for axis in 0..3 {
            let mut change = loaded.curvatures[element][axis] - loaded.past_curvatures[element][axis];
            start[axis] = T::zero();
            if T::PRECISION == Precision::F32 {
                change += loaded.compensation[element][axis] - loaded.past_compensation[element][axis];
                start[axis] = loaded.compensation[element][axis];
            }
            start[axis] += then * change;
        }
    }

    (StageTimes { index: 0, k: loaded.step * (one + ratio) * divisor, span: loaded.step }, ratio)
}

/// The start of an implicit Euler step; returns its times.
#[inline(always)]
pub(in crate::step) fn start_euler<T: Lane>(
    members: &dyn Pack,
    setting: &Setting,
    h: f64,
    workspace: &mut Workspace<T>,
) -> StageTimes<T> {
    let rule = setting.rules.rule(members.state(0).rule);
    workspace.loaded.load(members, setting.surroundings, h, Reads { velocities: true, history: false });
    base(rule, workspace);
    displace(0, &tableau::IMPLICIT_EULER, workspace);
    StageTimes { index: 0, k: workspace.loaded.step, span: workspace.loaded.step }
}

/// The second-order integrator: backward differences over the last two steps. The first step, and one after a jump of the step's
/// size, has no history and takes two implicit Runge–Kutta stages.
#[inline(always)]
pub fn two_step<T: Lane, S: LinearSolve<T>>(context: &mut StepContext<'_, T, S>) {
    if uses_history(context.members.state(0), context.h) {
        backward_difference(context);
    } else if context.members.point_contact().is_some() {
        // What a surface has stopped shall not be thrown back by what was before.
        take(&tableau::IMPLICIT_EULER, context);
    } else {
        take(&tableau::TWO_STAGES, context);
    }
}

/// Whether a step of `h` seconds of the second-order integrator uses backward differences.
pub fn uses_history(state: &StrandState, h: f64) -> bool {
    state.history.step > 0.0 && h <= LARGEST_RATIO * (1.0 + 1e-9) * state.history.step
}

/// The formula is stable for steps that grow by less than 1 + √2; well below that it is accurate too.
const LARGEST_RATIO: f64 = 2.0;

/// The times of a stage.
#[derive(Debug, Clone, Copy)]
pub(in crate::step) struct StageTimes<T> {
    pub index: usize,
    /// The stage is an implicit Euler step of this length.
    pub k: T,
    /// From the end of the last stage, or the start of the step, to the end of this one.
    pub span: T,
}

/// Solves the stage that ends `seconds` after the start of the step, for the strands that no earlier stage lost; it becomes the
/// last stage. Returns how far the roots' origins moved.
#[inline(always)]
fn solve_stage<T: Lane, S: LinearSolve<T>>(times: StageTimes<T>, seconds: f64, context: &mut StepContext<'_, T, S>) -> Vec3<T> {
    let (members, setting) = (context.members, context.setting);
    let (workspace, outcomes) = (&mut *context.workspace, &mut *context.outcomes);
    let (rotation, offset) = move_roots(seconds, members, workspace);
    let rule = setting.rules.rule(members.state(0).rule);
    let Loaded { targets, units, .. } = &mut workspace.loaded;
    targets.load(members, seconds, rule, units);
    let freedoms = members.model(0).freedoms;
    let mut active = 0;
    for lane in 0..workspace.loaded.count {
        active |= u32::from(!outcomes[lane].quarantined) << lane;
    }
    workspace.last_stage = times.index;
    T::call(SolveStage {
        times,
        h: context.h,
        members,
        setting,
        rule,
        freedoms,
        rotation: &rotation,
        offset,
        workspace,
        solver: &mut *context.solver,
        active,
        total: outcomes,
    });
    offset
}

/// Assembles, starts and minimises one stage.
struct SolveStage<'a, T, S> {
    times: StageTimes<T>,
    h: f64,
    members: &'a dyn Pack,
    setting: &'a Setting<'a>,
    rule: &'a Rule,
    freedoms: Freedoms,
    rotation: &'a Mat3<T>,
    offset: Vec3<T>,
    workspace: &'a mut Workspace<T>,
    solver: &'a mut S,
    active: u32,
    total: &'a mut [StrandOutcome; MAX_LANES],
}

impl<T: Lane, S: LinearSolve<T>> Kernel for SolveStage<'_, T, S> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { times, h, members, setting, rule, freedoms, rotation, offset, workspace, solver, active, total } = self;
        let (axes, free) = (freedoms.axes(), freedoms.count());
        let Workspace { loaded, iterate, stages, roots, .. } = workspace;
        let (before, stage) = stages.split_at_mut(times.index);
        let stage = &mut stage[0];
        let problem = Problem { root: rotation, lengths: &loaded.lengths, axes: &axes[..free], rule, tension_at_start: false };
        assemble_terms(times.k, offset, &rule.weights, loaded, stage, iterate);
        lead(times.span, freedoms, loaded, before.last(), iterate);
        let start = choose_start(&problem, iterate, before.is_empty().then_some(&loaded.rotation));
        let mut outcomes = [StrandOutcome::default(); MAX_LANES];
        let touching = members.point_contact().map(|options| Touching { members, options, rule, units: &loaded.units, roots });
        newton::minimise(&problem, setting.options, touching.as_ref(), iterate, solver, start, active, &mut outcomes);
        for (total, outcome) in total.iter_mut().zip(&outcomes).take(loaded.count) {
            total.iterations += outcome.iterations;
            total.converged &= outcome.converged;
            total.residual = outcome.residual;
            total.condition = total.condition.max(outcome.condition);
            total.quarantined |= outcome.quarantined;
        }
        finish_stage(times.k, offset, problem.axes, iterate, stage);
        if let Some(touching) = &touching {
            touching.correct_velocities(iterate, h, active, &mut stage.velocities);
        }
    }
}

/// Places the strands at the start of the step.
#[inline(always)]
fn base<T: Lane>(rule: &Rule, workspace: &mut Workspace<T>) {
    let Workspace { loaded, iterate, base_compensation, .. } = workspace;
    T::call(Positions {
        rotation: &loaded.rotation,
        lengths: &loaded.lengths,
        curvatures: &loaded.curvatures,
        compensation: &loaded.compensation,
        rule,
        kinematics: &mut iterate.kinematics,
        positions: &mut iterate.point_base,
        point_compensation: base_compensation,
    });
    iterate.curvature_base.clone_from(&loaded.curvatures);
    iterate.curvatures.clone_from(&loaded.curvatures);
}

/// Places the strands at the start of the last step.
#[inline(always)]
fn past_base<T: Lane>(rule: &Rule, workspace: &mut Workspace<T>) {
    let Workspace { loaded, iterate, past_base, past_compensation, .. } = workspace;
    T::call(Positions {
        rotation: &loaded.past_rotation,
        lengths: &loaded.lengths,
        curvatures: &loaded.past_curvatures,
        compensation: &loaded.past_compensation,
        rule,
        kinematics: &mut iterate.kinematics,
        positions: past_base,
        point_compensation: past_compensation,
    });
}

/// The positions of all points for given curvatures, relative to the root's origin, and in f32 their displacements by the
/// curvatures' remainders.
struct Positions<'a, T> {
    rotation: &'a Mat3<T>,
    lengths: &'a [T],
    curvatures: &'a [[T; 3]],
    compensation: &'a [[T; 3]],
    rule: &'a Rule,
    kinematics: &'a mut Kinematics<T>,
    positions: &'a mut Vec<Vec3<T>>,
    point_compensation: &'a mut Vec<Vec3<T>>,
}

impl<T: Lane> Kernel for Positions<'_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        if T::PRECISION == Precision::F32 {
            self.kinematics.update(self.rotation, self.lengths, self.curvatures, self.rule);
            self.positions.resize(self.kinematics.points.len(), Vec3::zero());
            for (position, point) in self.positions.iter_mut().zip(&self.kinematics.points) {
                *position = point.position;
            }
            let point_compensation = self.point_compensation;
            point_compensation.resize(self.kinematics.points.len(), Vec3::zero());
            displacement::for_each_point(self.kinematics, self.compensation, |p, moved| point_compensation[p] = moved);
            return;
        }
        self.positions.resize(self.lengths.len() * self.rule.len(), Vec3::zero());
        let positions = self.positions;
        kinematics::for_each_position(self.rotation, self.lengths, self.curvatures, self.rule, |p, position| {
            positions[p] = position;
        });
    }
}

/// Moves the roots to their poses `seconds` after the start of the step: sets their rotations, returns how far their origins
/// moved.
#[inline(always)]
pub fn move_roots<T: Lane>(seconds: f64, members: &dyn Pack, workspace: &mut Workspace<T>) -> (Mat3<T>, Vec3<T>) {
    let (mut rotation, mut offset) = (Mat3::zero(), Vec3::zero());
    for lane in 0..T::LANES {
        let member = workspace.loaded.member(lane);
        if lane == member {
            workspace.roots[lane] = members.root_at(lane, seconds);
        }
        let root = &workspace.roots[member];
        loaded::put_rotation(&mut rotation, lane, root);
        loaded::put_offset(&mut offset, lane, &members.state(member).root, root, &workspace.loaded.units[lane]);
    }
    (rotation, offset)
}

/// Stores the error that the step added, relative to the strands' lengths.
#[inline(always)]
fn store_error<T: Lane>(error: T, members: &dyn Pack, workspace: &Workspace<T>, outcomes: &mut [StrandOutcome; MAX_LANES]) {
    for lane in 0..workspace.loaded.count {
        outcomes[lane].error = error.lane(lane) * workspace.loaded.units[lane].length / members.model(lane).length();
    }
}

/// The displaced start of stage `index`, from the stages before it.
#[inline(always)]
fn displace<T: Lane>(index: usize, tableau: &Tableau, workspace: &mut Workspace<T>) {
    let Workspace { loaded, iterate, stages, base_compensation, .. } = workspace;
    let (before, from_here) = stages.split_at_mut(index);
    let stage = &mut from_here[0];
    stage.resize(loaded.lengths.len(), iterate.point_base.len());
    stage.start_velocities.clone_from(&loaded.velocities);
    if T::PRECISION == Precision::F32 {
        stage.start_displacements.clone_from(base_compensation);
        stage.start_changes.clone_from(&loaded.compensation);
    } else {
        stage.start_displacements.fill(Vec3::zero());
        stage.start_changes.fill([T::zero(); 3]);
    }
    for (j, earlier) in before.iter().enumerate() {
        let fraction = loaded.step * T::splat(tableau.below[index][j]);
        for p in 0..stage.start_displacements.len() {
            stage.start_displacements[p] += earlier.velocities[p].scale(fraction);
            stage.start_velocities[p] += earlier.accelerations[p].scale(fraction);
        }
        for (row, rate) in stage.start_changes.iter_mut().zip(&earlier.rates) {
            for axis in 0..3 {
                row[axis] += fraction * rate[axis];
            }
        }
    }
}

/// Velocities, accelerations and rates that follow from the stage's end.
#[inline(always)]
pub(in crate::step) fn finish_stage<T: Lane>(k: T, offset: Vec3<T>, axes: &[usize], iterate: &Iterate<T>, stage: &mut Stage<T>) {
    let inverse = T::one() / k;
    for (p, point) in iterate.kinematics.points.iter().enumerate() {
        let mut moved = point.position - iterate.point_base[p];
        if T::PRECISION == Precision::F32 {
            moved += iterate.point_compensation[p];
        }
        // As a change of ṽ: the last digit's error in k and its inverse must not act on the velocity step after step.
        let start = stage.start_velocities[p];
        let faster = ((moved + (offset - stage.start_displacements[p])) - start.scale(k)).scale(inverse);
        stage.velocities[p] = start + faster;
        stage.accelerations[p] = faster.scale(inverse);
    }
    for (element, row) in iterate.curvatures.iter().enumerate() {
        // A frozen curvature has no rate: the differences of the two-step start would give it one from rounding.
        let mut rate = [T::zero(); 3];
        for axis in axes {
            let mut change = row[*axis] - iterate.curvature_base[element][*axis];
            if T::PRECISION == Precision::F32 {
                change += iterate.compensation[element][*axis];
            }
            rate[*axis] = (change - stage.start_changes[element][*axis]) * inverse;
        }
        stage.rates[element] = rate;
    }
}
