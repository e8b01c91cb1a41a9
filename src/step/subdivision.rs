//! Subdivision: a strand whose step does not converge, turns non-finite or errs by more than permitted takes it in substeps.
//!
//! Each substep is half as long as the one that failed; substeps grow again where they go well. Other strands are unaffected, and
//! the substeps depend on nothing but the strand, so results do not depend on the number of threads.
//!
//! Substeps are counted in ticks, the shortest substep permitted. A substep may double where its start is a multiple of the
//! double, so that the last one ends with the step.

use super::options::{Integrator, StepOptions};
use super::pack::members::One;
use super::pack::single::Single;
use super::scratch::Bench;
use super::state::{RuleScratch, StrandState};
use super::{Setting, StrandOutcome, keep};
use crate::rod::target::TargetAt;

/// A substep grows where it errs by less than this fraction of the tolerance: a second-order step twice as long errs eight times
/// as much.
const GROWS_BELOW: f64 = 0.08;

/// How often a step may be halved; never that of a strand that bodies may touch at its points (`touches`): what springs leave is left to
/// the next step.
pub fn levels(options: &StepOptions, touches: bool) -> u32 {
    if !touches && matches!(options.integrator, Integrator::ImplicitEuler | Integrator::SecondOrder) {
        options.max_subdivisions
    } else {
        0
    }
}

/// Takes the step in substeps, starting with h/2^`level`; the state is that at the start of the step.
pub fn in_substeps<T: Single>(
    one: &mut One,
    setting: &Setting,
    h: f64,
    level: u32,
    bench: &mut Bench<T>,
    rule: &mut RuleScratch,
    begin: &mut StrandState,
) -> StrandOutcome {
    let options = setting.options;
    let levels = options.max_subdivisions;
    let ticks = 1_u32 << levels;
    let (mut done, mut part) = (0, 1_u32 << (levels - level));
    let mut total = StrandOutcome { converged: true, substeps: 0, ..StrandOutcome::default() };
    begin.clone_from(one.state);
    while done < ticks {
        let from = h * (f64::from(done) / f64::from(ticks));
        let root_at = one.root_at;
        let part_root = |seconds: f64| root_at(from + seconds);
        let length = h * (f64::from(part) / f64::from(ticks));
        let target = one.target.map(|target| TargetAt { from: target.from + from, ..target });
        let mut one_part = One { model: one.model, state: &mut *one.state, root_at: &part_root, target, touches: None };
        let outcome = T::attempt(&one_part, setting, length, bench);
        total.iterations += outcome.iterations;
        let served = serves(options, &outcome);
        if !served && part > 1 {
            part /= 2;
            continue;
        }
        total.add_substep(&outcome);
        if outcome.quarantined {
            // The whole step is rolled back: the root stays where the host left it.
            one.state.clone_from(begin);
            total.quarantined = true;
            total.converged = false;
            break;
        }
        keep(&mut one_part, 0, setting, length, &bench.workspace, rule);
        done += part;
        let grows = served && (options.error_tolerance == 0.0 || outcome.error < GROWS_BELOW * options.error_tolerance);
        if grows && done % (2 * part) == 0 && 2 * part <= ticks - done {
            part *= 2;
        }
        one.state.subdivision = levels - part.ilog2() - u32::from(grows && done == ticks && part < ticks);
    }
    total
}

/// Whether the end of a step in one piece becomes the state: where it is acceptable or, if finite, where the step may not be
/// subdivided.
pub fn is_kept(options: &StepOptions, touches: bool, outcome: &StrandOutcome) -> bool {
    serves(options, outcome) || (levels(options, touches) == 0 && !outcome.quarantined)
}

/// Whether a step needs no subdivision.
pub fn serves(options: &StepOptions, outcome: &StrandOutcome) -> bool {
    let errs = options.error_tolerance > 0.0 && outcome.error > options.error_tolerance;
    outcome.converged && !outcome.quarantined && !errs
}
