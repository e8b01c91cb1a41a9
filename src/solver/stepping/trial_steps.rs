//! Trial steps: a strand near a body first steps as a free strand, side by side with others; if that would bring it into contact it
//! steps with contact instead.
//!
//! A free step without contact equals the step with contact: no force acts. Only the state decides who tries: a restored snapshot
//! continues with the same bits.

use crate::contact::body_at::BodyAt;
use crate::contact::ccd::path_clearance::{self, ClearanceScratch, FreePath};
use crate::math::frame::Frame;
use crate::meter::Meter;
use crate::solver::strands::strand::{Constrained, Strand};
use crate::step::StrandOutcome;
use crate::step::pack::members::StepEnd;
use crate::step::state::StrandState;

/// A strand inside a body by at most this fraction of the contact tolerance has no contact: where it grows out of a head, or lies
/// on it as drawn, its distance is zero to rounding. More would let a strand that presses gently in, step by step, until a contact throws it out.
const SLACK: f64 = 1e-3;

/// What decides about the trial steps of a task.
pub(super) struct Trials<'a> {
    pub bodies: &'a [BodyAt<'a>],
    /// The permitted depth of contact, m.
    pub tolerance: f64,
    pub scratch: &'a mut TrialScratch,
}

/// Memory for a trial.
#[derive(Debug, Default)]
pub(in crate::solver) struct TrialScratch {
    /// A strand before its step.
    before: StrandState,
    /// Curvatures after it.
    end: Vec<[f64; 3]>,
    path: ClearanceScratch,
}

impl Trials<'_> {
    /// Before a substep of `h` seconds: strands that only a near body may constrain try a free step, except those that were under
    /// pressure last, and those near a body whose distances decide nothing. After the meter has halted the substep none does.
    pub fn begin(&self, strands: &mut [Strand], h: f64, meter: &Meter) {
        if meter.is_halted() {
            return;
        }
        for strand in strands.iter_mut().filter(|strand| strand.constrained == Constrained::Perhaps) {
            // (The step after one under pressure uses another formula than the free one.)
            if strand.touched || strand.divergence.is_some() {
                continue;
            }
            let undecided = |body: &BodyAt| !path_clearance::can_decide(body);
            if self.bodies.iter().any(undecided) && near(strand, &strand.root_during(h), self.bodies).any(undecided) {
                continue;
            }
            strand.constrained = Constrained::OnTrial;
        }
    }

    /// Whether a strand that has its old state still stays clear of all bodies on its way to the `end` of its step.
    pub fn let_stand(&mut self, strand: &Strand, end: &dyn StepEnd) -> bool {
        let TrialScratch { end: curvatures, path, .. } = &mut *self.scratch;
        end.write(&strand.model, curvatures, path.elements_at_end());
        let roots = [strand.state.root, end.root()];
        is_clear(strand, roots, [&strand.state.curvatures, curvatures], self.bodies, SLACK * self.tolerance, path)
    }

    /// Takes a strand through a `step` of `h` seconds that changes it, and gives its outcome if it stayed clear of all bodies. If not, its
    /// state is again what it was.
    pub fn take(
        &mut self,
        strand: &mut Strand,
        h: f64,
        step: impl FnOnce(&mut Strand) -> StrandOutcome,
    ) -> Option<StrandOutcome> {
        let TrialScratch { before, path, .. } = &mut *self.scratch;
        let roots = strand.root_during(h);
        before.clone_from(&strand.state);
        let outcome = step(strand);
        path.elements_at_end().clear();
        let curvatures = [&*before.curvatures, &*strand.state.curvatures];
        if !outcome.quarantined && is_clear(strand, roots, curvatures, self.bodies, SLACK * self.tolerance, path) {
            return Some(outcome);
        }
        std::mem::swap(&mut strand.state, before);
        None
    }
}

fn is_clear(
    strand: &Strand,
    root: [Frame; 2],
    curvatures: [&[[f64; 3]]; 2],
    bodies: &[BodyAt],
    spare: f64,
    scratch: &mut ClearanceScratch,
) -> bool {
    let Some(contact) = strand.contact.as_deref() else { return true };
    let path = FreePath {
        lengths: &strand.model.lengths,
        root,
        curvatures,
        exempt: contact.exempt_length,
        radius: contact.radius,
        permitted_overlap: strand.permitted_overlap.as_deref(),
    };
    path.is_clear_of(near(strand, &root, bodies), spare, scratch)
}

/// The bodies that a strand collides with and is near, while its root moves from pose to pose.
fn near<'a>(strand: &Strand, root: &[Frame; 2], bodies: &'a [BodyAt<'a>]) -> impl Iterator<Item = &'a BodyAt<'a>> {
    let met = strand.contact.as_deref().map(|contact| (strand.reach(contact, root), contact.groups, contact.mask));
    let is_near =
        move |body: &&BodyAt| met.is_some_and(|(around, groups, mask)| body.meets(groups, mask) && body.is_near(&around));
    bodies.iter().filter(is_near)
}
