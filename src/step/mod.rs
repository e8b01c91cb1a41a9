//! Time integration of one strand.

pub mod damping;
pub mod dynamics;
pub mod equilibrium;
pub mod linearly_implicit;
pub mod local_error;
pub mod newton;
pub mod options;
pub mod radau;
pub mod reference;
pub mod regrid;
pub mod root_path;
pub mod stages;
pub mod state;
pub mod subdivision;
pub mod tableau;
pub mod workspace;

use crate::math::frame::Frame;
use crate::math::quadrature::Rules;
use crate::math::vector::Vec3;
use crate::rod::strand::StrandModel;
use options::{Integrator, StepOptions};
use state::StrandState;
use workspace::Workspace;

/// What acts on all strands alike.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings {
    /// Gravity, m/s².
    pub gravity: Vec3<f64>,
    /// Uniform wind, m/s.
    pub wind: Vec3<f64>,
}

/// What a strand's step needs to know beside its state.
#[derive(Debug, Clone, Copy)]
pub struct Setting<'a> {
    /// The strand's constants.
    pub model: &'a StrandModel,
    /// What acts on it.
    pub surroundings: &'a Surroundings,
    /// How the step is taken.
    pub options: &'a StepOptions,
    /// The quadrature rules, made for the options' `quadrature_tolerance`.
    pub rules: &'a Rules,
}

/// How one strand's step went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrandOutcome {
    /// Newton iterations, those of attempts that were given up included.
    pub iterations: u32,
    /// Parts that the step was taken in.
    pub substeps: u32,
    /// Reached the tolerance.
    pub converged: bool,
    /// A number turned non-finite; the state is that of the step's start.
    pub quarantined: bool,
    /// How far an element may still be from where the iteration would end, rad.
    pub residual: f64,
    /// Condition number of the last matrix (dense singular values only).
    pub condition: f64,
    /// What the step, or the worst of its parts, added to the error of a point's position, in units of the strand's length; 0 where
    /// [`StepOptions::error_tolerance`] is 0.
    pub error: f64,
}

impl Default for StrandOutcome {
    fn default() -> Self {
        Self { iterations: 0, substeps: 1, converged: false, quarantined: false, residual: 0.0, condition: 0.0, error: 0.0 }
    }
}

impl StrandOutcome {
    /// Counts a part of the step that was kept; its iterations are counted apart.
    fn add_part(&mut self, part: &Self) {
        self.substeps += 1;
        self.converged &= part.converged;
        self.residual = self.residual.max(part.residual);
        self.condition = self.condition.max(part.condition);
        self.error = self.error.max(part.error);
    }
}

/// Takes one strand through a step of `h` seconds; `root_at(seconds)` is the root's pose that long after the step's start. A strand that
/// turns non-finite is rolled back.
///
/// A step that does not serve is taken in parts; see [`StepOptions::max_subdivisions`].
pub fn take(
    setting: &Setting,
    state: &mut StrandState,
    root_at: &dyn Fn(f64) -> Frame,
    h: f64,
    workspace: &mut Workspace,
) -> StrandOutcome {
    subdivision::take(setting, state, root_at, h, workspace)
}

/// Takes one strand through a step in one piece; `workspace.rolled_back` is then the state at its start.
fn take_whole(
    setting: &Setting,
    state: &mut StrandState,
    root_at: &dyn Fn(f64) -> Frame,
    h: f64,
    workspace: &mut Workspace,
) -> StrandOutcome {
    workspace.rolled_back.clone_from(state);
    if setting.options.integrator != Integrator::SecondOrder {
        state.past.step = 0.0;
    }
    state.adapt_rule(setting.model, setting.rules, &mut workspace.rule_scratch);
    let mut outcome = match setting.options.integrator {
        Integrator::LinearlyImplicit => linearly_implicit::take(setting, state, &root_at(h), h, workspace),
        Integrator::ImplicitEuler => stages::take(&tableau::IMPLICIT_EULER, setting, state, root_at, h, workspace),
        Integrator::SecondOrder => stages::two_step(setting, state, root_at, h, workspace),
        Integrator::Reference => reference::take(setting, state, root_at, h, workspace),
    };
    if outcome.quarantined || !state.is_finite() {
        state.clone_from(&workspace.rolled_back);
        outcome.quarantined = true;
        outcome.converged = false;
    }
    outcome
}
