//! Steps the strands of one task: those with equal pack keys side by side in packs, the rest one by one.
//!
//! Among equal pack keys strands are packed by their last numbers of iterations, so that a pack does not wait for one of its
//! strands. The other strands of a pack do not affect a strand's result.

use super::at_points::{AtPoints, NearBodies};
use super::trial_steps::Trials;
use crate::math::frame::Frame;
use crate::math::lane::MAX_LANES;
use crate::math::lanes::InstructionSet;
use crate::math::prefetch::prefetch;
use crate::meter::Meter;
use crate::rod::strand::StrandModel;
use crate::rod::target::TargetAt;
use crate::solver::strands::strand::{self, Constrained, Strand, Tally};
use crate::step::at_points::surfaces::{DepthAtPoints, PointContact, PointContactOptions, Surfaces};
use crate::step::options::Integrator;
use crate::step::pack::members::{One, OneTouches, Pack, PackKey, StepEnd};
use crate::step::pack::packs;
use crate::step::scratch::StepScratch;
use crate::step::state::StrandState;
use crate::step::{self, Setting, StrandOutcome, subdivision};

/// The most strands of a task, and of one of long strands: enough to fill packs where pack keys are mixed.
const MAX_TASK: usize = 1024;
const MAX_LONG_TASK: usize = 256;
/// The most elements of a task between the two. A step heeds its limits between tasks: these take some milliseconds.
const TASK_ELEMENTS: usize = 5120;

/// The most strands of a task, of so many strands with so many elements in all.
pub(super) fn task_size(strands: usize, elements: usize) -> usize {
    let mean = elements.div_ceil(strands.max(1));
    (TASK_ELEMENTS / mean.max(1)).clamp(MAX_LONG_TASK, MAX_TASK)
}

/// What the strands of a task may meet in a substep, and the count of their steps.
pub(super) struct Task<'a> {
    pub tally: &'a mut Tally,
    /// What decides about strands on trial, if there may be any.
    pub trials: Option<Trials<'a>>,
    /// What strands touch at their points, if that is how contact is answered.
    pub at_points: Option<AtPoints<'a>>,
}

/// Takes strands, at most [`task_size`], through a step of `h` seconds; constrained strands are stepped elsewhere (`constrained_substep`). If
/// `meter` has already halted the substep, strands move with their roots.
pub(super) fn take(
    strands: &mut [Strand],
    setting: &Setting,
    h: f64,
    set: InstructionSet,
    task: &mut Task,
    scratch: &mut StepScratch,
    meter: &Meter,
) {
    // Nothing else happens to these in this substep.
    let aside: Vec<usize> = (0..strands.len()).filter(|index| strands[*index].is_aside()).collect();
    for index in &aside {
        let strand = &mut strands[*index];
        let stays = strand.frozen.is_some();
        task.tally.add(&if stays {
            strand.stay(setting.surroundings.gravity.into(), h, setting.rules)
        } else {
            strand.step_home(h, setting.rules)
        });
        strand.constrained = Constrained::Yes;
    }
    take_present(strands, setting, h, set, task, scratch, meter);
    for index in &aside {
        strands[*index].constrained = Constrained::No;
    }
}

/// The same for strands that take part.
fn take_present(
    strands: &mut [Strand],
    setting: &Setting,
    h: f64,
    set: InstructionSet,
    task: &mut Task,
    scratch: &mut StepScratch,
    meter: &Meter,
) {
    if meter.is_halted() {
        for strand in strands.iter_mut().filter(|strand| !strand.is_constrained()) {
            if strand.constrained == Constrained::OnTrial {
                // There is no time to try.
                strand.constrained = Constrained::Perhaps;
            } else {
                task.tally.add(&strand.go_with_root(h, &[]));
            }
        }
        return;
    }
    let width = packs::width(setting.options.precision, set);
    for strand in strands.iter_mut().filter(|strand| !strand.is_constrained()) {
        strand.begin_moves(h);
    }
    if width == 1 || setting.options.integrator == Integrator::Reference || !setting.options.is_linear_time() {
        for index in 0..strands.len() {
            if !strands[index].is_constrained() {
                take_one(strands, index, setting, h, task, scratch);
            }
        }
        return;
    }
    let mut order = std::mem::take(&mut scratch.order);
    order.clear();
    for index in 0..strands.len() {
        let strand = &strands[index];
        if strand.is_constrained() {
            continue;
        }
        let touches = strand.constrained == Constrained::AtPoints;
        if strand.state.subdivision.min(subdivision::levels(setting.options, touches)) > 0 {
            take_one(strands, index, setting, h, task, scratch);
        } else {
            let kind = PackKey::of(
                &strand.model,
                &strand.state,
                [strand::drawn_by(&strand.target).is_some(), touches],
                setting.options.integrator,
                h,
            );
            order.push((kind, strand.last.iterations, index as u32));
        }
    }
    order.sort_unstable();
    let mut next = 0;
    for kind in order.chunk_by(|a, b| a.0 == b.0) {
        for pack in kind.chunks(width) {
            next += pack.len();
            for (_, _, index) in order[next..].iter().take(width) {
                foresee(&strands[*index as usize]);
            }
            take_pack(strands, pack, setting, h, set, task, scratch);
        }
    }
    scratch.order = order;
}

/// Prefetches a strand.
#[inline(always)]
fn foresee(strand: &Strand) {
    let StrandState { curvatures, rates, velocities, history, .. } = &strand.state;
    prefetch(&**curvatures);
    prefetch(&**rates);
    prefetch(&**velocities);
    prefetch(&*strand.model.lengths);
    prefetch(&*strand.model.natural);
    if let Some(root_move) = strand.root_move.as_deref() {
        prefetch(root_move);
    }
    if history.step > 0.0 {
        prefetch(&*history.curvatures);
        prefetch(&*history.velocities);
    }
}

fn take_pack(
    strands: &mut [Strand],
    pack: &[(PackKey, u32, u32)],
    setting: &Setting,
    h: f64,
    set: InstructionSet,
    task: &mut Task,
    scratch: &mut StepScratch,
) {
    if let [(_, _, index)] = pack {
        return take_one(strands, *index as usize, setting, h, task, scratch);
    }
    let mut indices = [0; MAX_LANES];
    for (lane, (_, _, index)) in pack.iter().enumerate() {
        indices[lane] = *index as usize;
    }
    let touches = strands[indices[0]].constrained == Constrained::AtPoints;
    let mut at_points = task.at_points.as_mut().filter(|_| touches);
    let near = at_points.as_mut().map(|at_points| at_points.find_near(indices[..pack.len()].iter().map(|k| &strands[*k]), h));
    let (indices, trials) = (&indices[..pack.len()], task.trials.as_mut());
    let mut picked = Picked { strands, indices, at_points, near: near.as_ref(), trials, refused: 0 };
    let outcomes = packs::take(&mut picked, setting, h, set, scratch);
    let refused = picked.refused;
    if let (Some(at_points), Some(near)) = (task.at_points.as_mut(), near) {
        at_points.give_back(near);
    }
    for (lane, (index, outcome)) in indices.iter().zip(&outcomes).enumerate() {
        let strand = &mut strands[*index];
        if refused & 1 << lane != 0 {
            strand.constrained = Constrained::Perhaps;
        } else if touches {
            strand.state.subdivision = 0;
            end(strand, *outcome, setting, h, task, scratch);
        } else if subdivision::is_kept(setting.options, false, outcome) {
            let outcome = strand.with_one(|one| step::finish(setting, one, h, outcome, scratch));
            end(strand, outcome, setting, h, task, scratch);
        } else {
            take_alone(strand, setting, h, task, scratch, |one, scratch| step::finish(setting, one, h, outcome, scratch));
        }
    }
}

fn take_one(strands: &mut [Strand], index: usize, setting: &Setting, h: f64, task: &mut Task, scratch: &mut StepScratch) {
    let strand = &mut strands[index];
    match task.at_points.as_mut().filter(|_| strand.constrained == Constrained::AtPoints) {
        Some(at_points) => {
            let outcome = take_one_at_points(strand, index, at_points, setting, h, scratch);
            end(strand, outcome, setting, h, task, scratch);
        }
        None => take_alone(strand, setting, h, task, scratch, |one, scratch| step::take(setting, one, h, scratch)),
    }
}

/// Takes a strand by itself, whose state changes on the way. One on trial that meets a body is left as it was.
fn take_alone(
    strand: &mut Strand,
    setting: &Setting,
    h: f64,
    task: &mut Task,
    scratch: &mut StepScratch,
    step: impl FnOnce(&mut One, &mut StepScratch) -> StrandOutcome,
) {
    let outcome = match task.trials.as_mut().filter(|_| strand.constrained == Constrained::OnTrial) {
        Some(trials) => trials.take(strand, h, |strand| strand.with_one(|one| step(one, scratch))),
        None => Some(strand.with_one(|one| step(one, scratch))),
    };
    match outcome {
        Some(outcome) => end(strand, outcome, setting, h, task, scratch),
        None => strand.constrained = Constrained::Perhaps,
    }
}

/// Ends the step of a strand that it keeps.
fn end(strand: &mut Strand, outcome: StrandOutcome, setting: &Setting, h: f64, task: &mut Task, scratch: &mut StepScratch) {
    task.tally.add(&outcome);
    strand.ended(outcome, setting, h, &[], scratch);
    if strand.constrained == Constrained::OnTrial {
        strand.constrained = Constrained::No;
    }
}

fn take_one_at_points(
    strand: &mut Strand,
    index: usize,
    at_points: &mut AtPoints,
    setting: &Setting,
    h: f64,
    scratch: &mut StepScratch,
) -> StrandOutcome {
    let near = at_points.find_near(std::iter::once(&*strand), h);
    let (mut contacts, mut depth) = (Vec::new(), DepthAtPoints::NONE);
    let Strand { model, state, root_move, target, contact, permitted_overlap, .. } = &mut *strand;
    let start = state.root;
    let root_at = |elapsed: f64| strand::root_after(root_move, &start, elapsed);
    let surfaces = at_points.surfaces_of(&near, 0, contact.as_deref(), permitted_overlap.as_deref());
    let touches = surfaces.as_ref().map(|surfaces| OneTouches {
        options: at_points.options,
        surfaces,
        contacts: &mut contacts,
        depth: &mut depth,
    });
    let mut one = One { model, state, root_at: &root_at, target: strand::drawn_by(target), touches };
    let outcome = step::take(setting, &mut one, h, scratch);
    at_points.give_back(near);
    contacts.iter().for_each(|contact| at_points.take_contact(index, strand, contact));
    at_points.take_depth(depth);
    outcome
}

/// Strands picked from a task's.
struct Picked<'a, 'b> {
    strands: &'a mut [Strand],
    indices: &'a [usize],
    /// What they may touch at their points.
    at_points: Option<&'a mut AtPoints<'b>>,
    near: Option<&'a NearBodies<'b>>,
    /// What decides about those on trial, and lanes of those that may not keep their steps.
    trials: Option<&'a mut Trials<'b>>,
    refused: u32,
}

impl Pack for Picked<'_, '_> {
    fn count(&self) -> usize {
        self.indices.len()
    }
    fn model(&self, lane: usize) -> &StrandModel {
        &self.strands[self.indices[lane]].model
    }
    fn state(&self, lane: usize) -> &StrandState {
        &self.strands[self.indices[lane]].state
    }
    fn parts(&mut self, lane: usize) -> (&StrandModel, &mut StrandState) {
        let strand = &mut self.strands[self.indices[lane]];
        (&strand.model, &mut strand.state)
    }
    fn root_at(&self, lane: usize, seconds: f64) -> Frame {
        let strand = &self.strands[self.indices[lane]];
        strand::root_after(&strand.root_move, &strand.state.root, seconds)
    }
    fn target(&self, lane: usize) -> Option<TargetAt<'_>> {
        strand::drawn_by(&self.strands[self.indices[lane]].target)
    }
    fn point_contact(&self) -> Option<PointContactOptions> {
        self.at_points.as_ref().map(|at_points| at_points.options)
    }
    fn with_surfaces(&self, lane: usize, ask: &mut dyn FnMut(&dyn Surfaces)) {
        let (Some(at_points), Some(near)) = (&self.at_points, self.near) else { return };
        let Strand { contact, permitted_overlap, .. } = &self.strands[self.indices[lane]];
        if let Some(surfaces) = at_points.surfaces_of(near, lane, contact.as_deref(), permitted_overlap.as_deref()) {
            ask(&surfaces);
        }
    }
    fn take_contact(&mut self, lane: usize, contact: &PointContact) {
        if let Some(at_points) = &mut self.at_points {
            let index = self.indices[lane];
            at_points.take_contact(index, &mut self.strands[index], contact);
        }
    }
    fn take_depth(&mut self, _lane: usize, depth: DepthAtPoints) {
        if let Some(at_points) = &mut self.at_points {
            at_points.take_depth(depth);
        }
    }
    fn may_keep(&mut self, lane: usize, end: &dyn StepEnd) -> bool {
        let strand = &self.strands[self.indices[lane]];
        let trials = self.trials.as_mut().filter(|_| strand.constrained == Constrained::OnTrial);
        let may_keep = trials.is_none_or(|trials| trials.let_stand(strand, end));
        self.refused |= u32::from(!may_keep) << lane;
        may_keep
    }
}
