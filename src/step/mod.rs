//! Time integration of one strand.
//!
//! Files:
//!
//! - `context.rs`: What an integrator works on: strands side by side, what acts on them, where their step is taken, and how it goes.
//! - `equilibrium.rs`: Static equilibrium of a strand under gravity: a minimum of ½ (q−qⁿ)ᵀK(q−qⁿ) − Σ w ρS g·r(q).
//! - `newton.rs`: Newton's iteration on a strand's incremental potential.
//! - `options.rs`: Options of a step: integrator, linear solve, tolerances.
//! - `regrid.rs`: Moves a strand to other elements while it is in motion: more of them near the camera, fewer far away.
//! - `root_path.rs`: The root's smooth path through a step, with velocities and accelerations, from poses alone.
//! - `root_velocity.rs`: The root's mean velocity over a step.
//! - `scratch.rs`: The scratch memory of one worker: a workspace for each type of lanes, empty until first used.
//! - `state.rs`: The state of a strand: what a step changes.
//! - `subdivision.rs`: Subdivision: a strand whose step does not converge, turns non-finite or errs by more than permitted takes it in substeps.
//! - `workspace.rs`: The scratch memory of a step, one per worker, kept between strands and steps so that nothing is allocated once it has grown.
//! - `at_points/`: Contact at points: the surfaces of bodies near a strand's quadrature points, and the springs that hold the points outside.
//! - `constrained/`: The step of strands that constraints act on, an iteration at a time.
//! - `integrator/`: Integrators: one method of time stepping a file, and what they share.
//! - `pack/`: Strands that take a step side by side, one per lane of a pack.

pub mod at_points;
pub mod constrained;
pub mod context;
pub mod equilibrium;
pub mod integrator;
pub mod newton;
pub mod options;
pub mod pack;
pub mod regrid;
pub mod root_path;
pub mod root_velocity;
pub mod scratch;
pub mod state;
pub mod subdivision;
pub mod workspace;

use crate::energy::Energies;
use crate::math::lane::{Lane, Precision};
use crate::math::quadrature::Rules;
use crate::math::vector::Vec3;
use integrator::reference;
use options::{Integrator, StepOptions};
use pack::members::{One, Pack};
use pack::single::Single;
use pack::whole;
use scratch::{Bench, StepScratch};
use state::RuleScratch;
use workspace::Workspace;

/// The forces of the surroundings, the same for all strands.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings {
    /// Gravity, m/s².
    pub gravity: Vec3<f64>,
    /// Uniform wind, m/s.
    pub wind: Vec3<f64>,
}

/// What a step needs beside the strands.
#[derive(Debug, Clone, Copy)]
pub struct Setting<'a> {
    /// Gravity and wind.
    pub surroundings: &'a Surroundings,
    /// How the step is taken.
    pub options: &'a StepOptions,
    /// The quadrature rules, made for the options' `quadrature_tolerance`.
    pub rules: &'a Rules,
}

/// How one strand's step went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrandOutcome {
    /// Newton iterations, including those of rejected attempts.
    pub iterations: u32,
    /// Substeps that the step took.
    pub substeps: u32,
    /// Reached the tolerance.
    pub converged: bool,
    /// A number turned non-finite; the state is that at the start of the step.
    pub quarantined: bool,
    /// The step's budget ended it before it converged.
    pub left: bool,
    /// Estimated distance of an element from where the iteration would converge, rad.
    pub residual: f64,
    /// Condition number of the last matrix (dense singular values only).
    pub condition: f64,
    /// The error that the step, or the worst of its substeps, added to a point's position, relative to the strand's length; 0
    /// where [`StepOptions::error_tolerance`] is 0.
    pub error: f64,
    /// Energies at the end of the step; unspecified where the state was rolled back.
    pub energies: Energies,
}

impl Default for StrandOutcome {
    fn default() -> Self {
        Self {
            iterations: 0,
            substeps: 1,
            converged: false,
            quarantined: false,
            left: false,
            residual: 0.0,
            condition: 0.0,
            error: 0.0,
            energies: Energies::default(),
        }
    }
}

impl StrandOutcome {
    /// Adds a substep of a constrained strand.
    pub(crate) fn add_constrained_substep(&mut self, part: &Self) {
        self.iterations += part.iterations;
        self.quarantined |= part.quarantined;
        self.add_substep(part);
    }

    /// Adds a kept substep, without its iterations, which are counted separately.
    fn add_substep(&mut self, part: &Self) {
        self.substeps += 1;
        self.converged &= part.converged;
        self.residual = self.residual.max(part.residual);
        self.condition = self.condition.max(part.condition);
        self.error = self.error.max(part.error);
        self.energies = part.energies;
    }
}

/// Takes one strand through a step of `h` seconds. A strand that turns non-finite is rolled back.
///
/// A step that fails is taken in substeps: see [`StepOptions::max_subdivisions`].
pub fn take(setting: &Setting, one: &mut One, h: f64, scratch: &mut StepScratch) -> StrandOutcome {
    if setting.options.integrator == Integrator::Reference {
        return take_reference(setting, one, h, scratch);
    }
    let begin = one.state.subdivision.min(subdivision::levels(setting.options, one.touches.is_some()));
    if begin > 0 {
        return take_in_substeps(setting, one, h, begin, scratch);
    }
    let whole = match setting.options.precision {
        Precision::F64 => take_whole(setting, one, h, &mut scratch.one, &mut scratch.rule),
        Precision::F32 => take_whole(setting, one, h, &mut scratch.one_f32, &mut scratch.rule),
    };
    finish(setting, one, h, &whole, scratch)
}

/// Finishes the step of a strand that tried it in one piece: in substeps if that failed.
pub fn finish(setting: &Setting, one: &mut One, h: f64, whole: &StrandOutcome, scratch: &mut StepScratch) -> StrandOutcome {
    if subdivision::levels(setting.options, one.touches.is_some()) == 0 || subdivision::serves(setting.options, whole) {
        one.state.subdivision = 0;
        return *whole;
    }
    let mut outcome = take_in_substeps(setting, one, h, 1, scratch);
    outcome.iterations += whole.iterations;
    outcome
}

fn take_in_substeps(setting: &Setting, one: &mut One, h: f64, level: u32, scratch: &mut StepScratch) -> StrandOutcome {
    let StepScratch { one: bench, one_f32, rule, before_step, .. } = scratch;
    let begin = before_step.get_or_insert_default();
    match setting.options.precision {
        Precision::F64 => subdivision::in_substeps(one, setting, h, level, bench, rule, begin),
        Precision::F32 => subdivision::in_substeps(one, setting, h, level, one_f32, rule, begin),
    }
}

/// Takes one strand through a step in one piece. The result becomes the state where it is acceptable, or where the step may not
/// be subdivided.
fn take_whole<T: Single>(
    setting: &Setting,
    one: &mut One,
    h: f64,
    bench: &mut Bench<T>,
    rule: &mut RuleScratch,
) -> StrandOutcome {
    let outcome = T::attempt(one, setting, h, bench);
    if subdivision::is_kept(setting.options, one.touches.is_some(), &outcome) {
        keep(one, 0, setting, h, &bench.workspace, rule);
    }
    outcome
}

/// Makes the end of a step in one piece the strand's state, at the quadrature rule of its new shape.
fn keep<T: Lane>(
    members: &mut dyn Pack,
    lane: usize,
    setting: &Setting,
    h: f64,
    workspace: &Workspace<T>,
    rule: &mut RuleScratch,
) {
    whole::save(members, lane, setting, h, workspace);
    whole::give_contacts(members, lane, workspace);
    let (model, state) = members.parts(lane);
    state.adapt_rule(model, setting.rules, rule);
}

/// A step of the reference integrator, which works on the state itself.
fn take_reference(setting: &Setting, one: &mut One, h: f64, scratch: &mut StepScratch) -> StrandOutcome {
    let before = scratch.before_step.get_or_insert_default();
    before.clone_from(one.state);
    one.state.history.step = 0.0;
    let mut outcome = reference::take(setting, one, h, &mut scratch.one, &mut scratch.rule);
    if outcome.quarantined || !one.state.is_finite() {
        one.state.clone_from(before);
        outcome.quarantined = true;
        outcome.converged = false;
    }
    one.state.adapt_rule(one.model, setting.rules, &mut scratch.rule);
    outcome
}
