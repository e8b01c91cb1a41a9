//! Time integration of one strand.

pub mod dynamics;
pub mod equilibrium;
pub mod linearly_implicit;
pub mod newton;
pub mod options;
pub mod radau;
pub mod reference;
pub mod regrid;
pub mod root_path;
pub mod stages;
pub mod state;
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

/// How one strand's step went.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StrandOutcome {
    /// Newton iterations.
    pub iterations: u32,
    /// Reached the tolerance.
    pub converged: bool,
    /// A number turned non-finite; the state is that of the step's start.
    pub quarantined: bool,
    /// Largest rotation of an element in the last iteration, rad.
    pub residual: f64,
    /// Condition number of the last matrix (dense singular values only).
    pub condition: f64,
}

/// Takes one strand through a step of `h` seconds; `root_at(seconds)` is the root's pose that long after the step's start. A strand that
/// turns non-finite is rolled back.
#[allow(clippy::too_many_arguments)]
pub fn take(
    model: &StrandModel,
    state: &mut StrandState,
    root_at: &dyn Fn(f64) -> Frame,
    h: f64,
    surroundings: &Surroundings,
    options: &StepOptions,
    rules: &Rules,
    workspace: &mut Workspace,
) -> StrandOutcome {
    workspace.rolled_back.clone_from(state);
    if options.integrator != Integrator::SecondOrder {
        state.past.step = 0.0;
    }
    state.adapt_rule(model, rules, &mut workspace.rule_scratch);
    let mut outcome = match options.integrator {
        Integrator::LinearlyImplicit => {
            linearly_implicit::take(model, state, &root_at(h), h, surroundings, options, rules, workspace)
        }
        Integrator::ImplicitEuler => {
            stages::take(&tableau::IMPLICIT_EULER, model, state, root_at, h, surroundings, options, rules, workspace)
        }
        Integrator::SecondOrder => stages::two_step(model, state, root_at, h, surroundings, options, rules, workspace),
        Integrator::Reference => reference::take(model, state, root_at, h, surroundings, options, rules, workspace),
    };
    if outcome.quarantined || !state.is_finite() {
        state.clone_from(&workspace.rolled_back);
        outcome.quarantined = true;
        outcome.converged = false;
    }
    outcome
}
