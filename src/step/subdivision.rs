//! Subdivision: a strand whose step does not converge, turns non-finite or errs by more than allowed takes it in parts, each half as
//! long as the one that failed; parts grow again where they go well. The other strands go on as they are, and the parts depend on nothing
//! but the strand, so that results do not depend on the number of threads.
//!
//! Parts are counted in ticks, the shortest part allowed: a part may double where its start is a multiple of the double, so that all end
//! with the step.

use super::options::{Integrator, StepOptions};
use super::state::StrandState;
use super::workspace::Workspace;
use super::{Setting, StrandOutcome, take_whole};
use crate::math::frame::Frame;

/// A part grows where it errs by less than this share of what is allowed: twice as long a step of second order errs eight times as much.
const GROWS_BELOW: f64 = 0.08;

/// Takes one strand through a step of `h` seconds, whole if that serves; see [`super::take`].
pub fn take(
    setting: &Setting,
    state: &mut StrandState,
    root_at: &dyn Fn(f64) -> Frame,
    h: f64,
    workspace: &mut Workspace,
) -> StrandOutcome {
    let options = setting.options;
    let levels = if matches!(options.integrator, Integrator::ImplicitEuler | Integrator::SecondOrder) {
        options.max_subdivisions
    } else {
        0
    };
    let begin = state.subdivision.min(levels);
    if begin == 0 {
        let whole = take_whole(setting, state, root_at, h, workspace);
        if levels == 0 || serves(options, &whole) {
            state.subdivision = 0;
            return whole;
        }
        state.clone_from(&workspace.rolled_back);
        let mut outcome = in_parts(setting, state, root_at, h, 1, workspace);
        outcome.iterations += whole.iterations;
        return outcome;
    }
    in_parts(setting, state, root_at, h, begin, workspace)
}

/// Takes the step in parts, the first of h/2^`level`; the state is that of the step's start.
fn in_parts(
    setting: &Setting,
    state: &mut StrandState,
    root_at: &dyn Fn(f64) -> Frame,
    h: f64,
    level: u32,
    workspace: &mut Workspace,
) -> StrandOutcome {
    let options = setting.options;
    let levels = options.max_subdivisions;
    let ticks = 1_u32 << levels;
    let (mut done, mut part) = (0, 1_u32 << (levels - level));
    let mut total = StrandOutcome { converged: true, substeps: 0, ..StrandOutcome::default() };
    let mut begin = workspace.before_step.take().unwrap_or_default();
    begin.clone_from(state);
    while done < ticks {
        let from = h * (f64::from(done) / f64::from(ticks));
        let part_root = |seconds: f64| root_at(from + seconds);
        let length = h * (f64::from(part) / f64::from(ticks));
        let outcome = take_whole(setting, state, &part_root, length, workspace);
        total.iterations += outcome.iterations;
        let served = serves(options, &outcome);
        if !served && part > 1 {
            state.clone_from(&workspace.rolled_back);
            part /= 2;
            continue;
        }
        total.add_part(&outcome);
        if outcome.quarantined {
            // The whole step is rolled back: the root is where the host left it.
            state.clone_from(&begin);
            total.quarantined = true;
            total.converged = false;
            break;
        }
        done += part;
        let grows = served && (options.error_tolerance == 0.0 || outcome.error < GROWS_BELOW * options.error_tolerance);
        if grows && done % (2 * part) == 0 && 2 * part <= ticks - done {
            part *= 2;
        }
        state.subdivision = levels - part.ilog2() - u32::from(grows && done == ticks && part < ticks);
    }
    workspace.before_step = Some(begin);
    total
}

/// Whether a step needs no subdivision.
fn serves(options: &StepOptions, outcome: &StrandOutcome) -> bool {
    let errs = options.error_tolerance > 0.0 && outcome.error > options.error_tolerance;
    outcome.converged && !outcome.quarantined && !errs
}
