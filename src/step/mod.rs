//! Time integration of one strand.
//!
//! Files:
//!
//! - `constrained_pack.rs`: A pack of constrained strands: the work of `super::constrained_step` that is the same for all of them, side by side.
//! - `constrained_packs.rs`: Packs of constrained strands, in registers of any width.
//! - `constrained_single.rs`: A constrained strand that takes its step alone, an iteration at a time.
//! - `constrained_step.rs`: The step of one constrained strand, one Newton iteration at a time.
//! - `context.rs`: What an integrator works on: strands side by side, what acts on them, where their step is taken, and how it goes.
//! - `damping.rs`: Levenberg–Marquardt damping of the rotations in Newton's iteration: the parameter λ, N·m/rad, from iteration to iteration.
//! - `dynamics.rs`: The equations of motion in the curvatures, M(q) q̈ = f(q, q̇, t), as a residual and its derivatives.
//! - `equilibrium.rs`: Static equilibrium of a strand under gravity: a minimum of ½ (q−qⁿ)ᵀK(q−qⁿ) − Σ w ρS g·r(q).
//! - `iterate.rs`: The state of Newton's iteration: a spring to a target at every quadrature point and every curvature (`energy`), and the strand between them.
//! - `lane_loads.rs`: The loads of a pack's strands in lanes: those of an element side by side, so that one elimination includes them all.
//! - `line_search.rs`: The line search of Newton's iteration, for free and for constrained strands.
//! - `linearly_implicit.rs`: The linearly implicit step of the papers (Bertails et al. 2006, section 3.4; Bergbom 2007, section 4.2.8), with its second-order terms.
//! - `loaded.rs`: The numbers of a pack's strands in lanes, and their transfer into them and back.
//! - `local_error.rs`: The error that one step adds to the positions of a strand's points, estimated from the step itself, world axes (Milne's device; Hairer, Nørsett and Wanner 1993, section III.7).
//! - `members.rs`: Packs: strands that take a step side by side, one per lane.
//! - `newton.rs`: Newton's iteration on a strand's incremental potential.
//! - `options.rs`: Options of a step: integrator, linear solve, tolerances.
//! - `packs.rs`: The choice of lanes for a pack of strands: by precision, by the machine's instructions, and by the number of strands.
//! - `point_contacts.rs`: Contact at the quadrature points.
//! - `point_probes.rs`: Where the surfaces of bodies are about a strand's quadrature points (`point_contacts.rs`).
//! - `point_springs.rs`: The springs that contact gives to the quadrature points (`point_contacts.rs`), in lanes.
//! - `point_surfaces.rs`: What contact at points asks of the bodies' surfaces, and what it finds (`point_contacts.rs`).
//! - `point_touches.rs`: The surfaces near a quadrature point (`point_contacts.rs`): of two bodies, or the two sides of a crease in one.
//! - `radau.rs`: Radau IIA of three stages (order 5, L-stable, stiffly accurate) on M(q) q̈ = f(q, q̇, t).
//! - `reference.rs`: The reference integrator: Radau IIA of order 5 in the curvatures, with step doubling.
//! - `regrid.rs`: Moves a strand to other elements while it is in motion: more of them near the camera, fewer far away.
//! - `root_path.rs`: The root's smooth path through a step, with velocities and accelerations, from poses alone.
//! - `root_velocity.rs`: The root's mean velocity over a step.
//! - `scratch.rs`: The scratch memory of one worker: a workspace for each type of lanes, empty until first used.
//! - `single.rs`: Steps of one strand at a time, for strands outside any pack.
//! - `stages.rs`: Runge–Kutta steps as minimisations.
//! - `state.rs`: The state of a strand: what a step changes.
//! - `stretch.rs`: How far a damped iteration of a constrained strand goes along its direction.
//! - `subdivision.rs`: Subdivision: a strand whose step does not converge, turns non-finite or errs by more than permitted takes it in substeps.
//! - `tableau.rs`: Singly diagonally implicit Runge–Kutta methods, stiffly accurate and L-stable, that share one Newton.
//! - `target_lanes.rs`: The targets of a pack's strands in lanes: what draws each quadrature point at the end of a stage.
//! - `whole.rs`: A step in one piece for strands side by side: computed in the workspace, and made their state only on demand.
//! - `workspace.rs`: The scratch memory of a step, one per worker, kept between strands and steps so that nothing is allocated once it has grown.

pub mod constrained_pack;
pub mod constrained_packs;
pub mod constrained_single;
pub mod constrained_step;
pub mod context;
pub mod damping;
pub mod dynamics;
pub mod equilibrium;
pub mod iterate;
mod lane_loads;
mod line_search;
pub mod linearly_implicit;
pub mod loaded;
pub mod local_error;
pub mod members;
pub mod newton;
pub mod options;
pub mod packs;
pub mod point_contacts;
mod point_probes;
pub mod point_springs;
pub mod point_surfaces;
mod point_touches;
pub mod radau;
pub mod reference;
pub mod regrid;
pub mod root_path;
pub mod root_velocity;
pub mod scratch;
pub mod single;
pub mod stages;
pub mod state;
mod stretch;
pub mod subdivision;
pub mod tableau;
pub mod target_lanes;
pub mod whole;
pub mod workspace;

use crate::energy::Energies;
use crate::math::lane::{Lane, Precision};
use crate::math::quadrature::Rules;
use crate::math::vector::Vec3;
use members::{One, Pack};
use options::{Integrator, StepOptions};
use scratch::{Bench, StepScratch};
use single::Single;
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
