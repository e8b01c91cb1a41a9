//! Trial steps: a strand near a body first steps as a free strand, side by side with others; if that brings it into contact it is
//! rolled back and steps again with contact.
//!
//! A free step without contact equals the step with contact: no force acts. Only the state decides who tries: a restored snapshot
//! continues with the same bits.

use super::report::Energies;
use super::strand::{Constrained, Strand, SubstepResult, Tally};
use crate::contact::body::BodyAt;
use crate::contact::path_clearance::{self, FreePath};
use crate::math::frame::Frame;
use crate::math::rotation::PoseMove;
use crate::meter::Meter;
use crate::rod::target::TargetMotion;
use crate::step::StrandOutcome;
use crate::step::state::StrandState;

/// A strand inside a body by at most this fraction of the contact tolerance has no contact: where it grows out of a head, or lies
/// on it as drawn, its distance is zero to rounding. More would let a strand that presses gently in, step by step, until a contact throws it out.
const SLACK: f64 = 1e-3;

/// The strands of one task that try a free step.
#[derive(Debug, Default)]
pub(super) struct TrialSteps {
    saved: Vec<Saved>,
    count: usize,
    /// The results of the trials, by the strands' indices in the task.
    outcomes: Vec<StrandOutcome>,
    path: path_clearance::ClearanceScratch,
}

/// A strand before the substep.
#[derive(Debug, Default)]
struct Saved {
    /// Index among the task's strands.
    index: usize,
    state: StrandState,
    energies: Energies,
    last: SubstepResult,
    root_move: Option<(PoseMove, f64)>,
    /// How far its target was.
    target: Option<TargetMotion>,
    /// The root's poses at the start and the end.
    root: [Frame; 2],
}

impl TrialSteps {
    /// Before a substep of `h` seconds: strands that only a near body may constrain try a free step, except those that were under
    /// pressure last, and those that may come near one of the `bodies`. After the meter has halted the substep none does.
    pub fn begin(&mut self, strands: &mut [Strand], bodies: &[BodyAt], h: f64, meter: &Meter) {
        self.count = 0;
        self.outcomes.resize_with(strands.len(), StrandOutcome::default);
        if meter.is_halted() {
            return;
        }
        for (index, strand) in strands.iter_mut().enumerate().filter(|(_, strand)| strand.constrained == Constrained::Perhaps) {
            // (The step after one under pressure uses another formula than the free one.)
            if strand.touched || strand.divergence.is_some() {
                continue;
            }
            let root = strand.root_during(h);
            if near(strand, &root, bodies).any(|body| !path_clearance::can_decide(body)) {
                continue;
            }
            strand.constrained = Constrained::OnTrial;
            if self.count == self.saved.len() {
                self.saved.push(Saved::default());
            }
            let saved = &mut self.saved[self.count];
            saved.state.clone_from(&strand.state);
            (saved.index, saved.energies, saved.last) = (index, strand.energies, strand.last);
            (saved.root, saved.root_move) = (root, strand.root_move.as_deref().cloned());
            saved.target = strand.target.as_deref().map(|target| target.motion);
            self.count += 1;
        }
    }

    /// The results of the trials.
    pub fn outcomes(&mut self) -> &mut [StrandOutcome] {
        &mut self.outcomes
    }

    /// After it: counts the steps of strands that stayed clear of all `bodies`, and rolls the others back to step with contact.
    /// `tolerance`: the permitted depth of contact, m.
    pub fn end(&mut self, strands: &mut [Strand], bodies: &[BodyAt], tolerance: f64, tally: &mut Tally) {
        let Self { saved, count, outcomes, path } = self;
        for saved in &mut saved[..*count] {
            let (strand, outcome) = (&mut strands[saved.index], &outcomes[saved.index]);
            if !outcome.quarantined && saved.stayed_clear(strand, bodies, SLACK * tolerance, path) {
                tally.add(outcome);
                strand.constrained = Constrained::No;
                continue;
            }
            std::mem::swap(&mut strand.state, &mut saved.state);
            (strand.energies, strand.last, strand.divergence) = (saved.energies, saved.last, None);
            strand.root_move = saved.root_move.take().map(Box::new);
            if let (Some(target), Some(motion)) = (&mut strand.target, saved.target) {
                target.motion = motion;
            }
            strand.constrained = Constrained::Perhaps;
        }
    }
}

impl Saved {
    fn stayed_clear(
        &self,
        strand: &Strand,
        bodies: &[BodyAt],
        spare: f64,
        scratch: &mut path_clearance::ClearanceScratch,
    ) -> bool {
        let Some(contact) = strand.contact.as_deref() else { return true };
        let path = FreePath {
            lengths: &strand.model.lengths,
            root: self.root,
            curvatures: [&self.state.curvatures, &strand.state.curvatures],
            exempt: contact.exempt_length,
            radius: contact.radius,
            permitted_overlap: strand.permitted_overlap.as_deref(),
        };
        path.is_clear_of(near(strand, &self.root, bodies), spare, scratch)
    }
}

/// The bodies that a strand collides with and is near, while its root moves from pose to pose.
fn near<'a>(strand: &Strand, root: &[Frame; 2], bodies: &'a [BodyAt<'a>]) -> impl Iterator<Item = &'a BodyAt<'a>> {
    let met = strand.contact.as_deref().map(|contact| (strand.reach(contact, root), contact.groups, contact.mask));
    let is_near =
        move |body: &&BodyAt| met.is_some_and(|(around, groups, mask)| body.meets(groups, mask) && body.is_near(&around));
    bodies.iter().filter(is_near)
}
