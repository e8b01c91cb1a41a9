//! Constrained strands side by side with the scene's strands: how their step begins and ends, pack by pack
//! (`coupled/packs.rs`).

use super::Scene;
use crate::coupled::constrained_strand::ConstrainedStrand;
use crate::coupled::packs::{MAX_LANES, Packs, Work, with_work};
use crate::math::frame::Frame;
use crate::math::lane::Precision;
use crate::rod::strand::StrandModel;
use crate::rod::target::TargetAt;
use crate::solver::strands::strand::{Strand, drawn_by, root_after};
use crate::step::Setting;
use crate::step::constrained::step::running;
use crate::step::pack::members::{Pack, PackKey};
use crate::step::pack::packs::width;
use crate::step::state::StrandState;

/// A constrained strand with its scene strand.
pub(super) type Pair<'a> = (&'a mut Strand, &'a mut ConstrainedStrand);

/// Memory for lists of packs with pairs.
pub(super) type PairWork = Vec<Work<'static, Pair<'static>>>;

/// The marked strands of a scene, each with its entry in `constrained`.
pub(super) fn pairs<'a>(strands: &'a mut [Strand], constrained: &'a mut [ConstrainedStrand]) -> impl Iterator<Item = Pair<'a>> {
    strands.iter_mut().filter(|strand| strand.is_constrained()).zip(constrained)
}

/// Runs something on the packs of pairs.
pub(super) fn with_pairs<'a>(
    packs: &'a mut Packs,
    memory: &mut PairWork,
    pairs: impl Iterator<Item = Pair<'a>>,
    run: impl FnOnce(&mut [Work<'a, Pair<'a>>]),
) {
    let place = |(_, constrained): &Pair| (constrained.pack, constrained.lane);
    with_work(packs.all(), memory, pairs, place, run);
}

/// Packs the constrained strands for which `begins` is true, and begins their step of `h` seconds.
pub(super) fn begin(
    packs: &mut Packs,
    memory: &mut PairWork,
    scene: &mut Scene,
    constrained: &mut [ConstrainedStrand],
    h: f64,
    begins: impl Fn(&ConstrainedStrand) -> bool,
) {
    if constrained.is_empty() {
        return;
    }
    let (setting, set) = (scene.setting, scene.set);
    let width = width(Precision::F64, set).min(MAX_LANES);
    for (place, (strand, constrained)) in pairs(scene.strands, constrained).enumerate() {
        if begins(constrained) {
            strand.begin_moves(h);
            let kind = PackKey::of(
                &strand.model,
                &strand.state,
                [drawn_by(&strand.target).is_some(), false],
                setting.options.integrator,
                h,
            );
            packs.begins(place, constrained, kind, strand.last.iterations);
        }
    }
    packs.place(constrained, width);
    let members = pairs(scene.strands, constrained).filter(|(_, constrained)| begins(constrained));
    // (Bilateral constraints are reported with the paths of their strands, whatever halted the step.)
    let (constrained, meter, workers) = (!scene.constraints.is_empty(), scene.meter, scene.workers);
    let begin = |Work { pack, members }: &mut Work<Pair>| {
        if !constrained && meter.is_halted() {
            return;
        }
        let first_order = members.iter().flatten().any(|(_, constrained)| constrained.formula.is_first_order());
        let mut strands = [const { None }; MAX_LANES];
        let mut lanes = [const { None }; MAX_LANES];
        for (lane, (strand, constrained)) in running(members) {
            (strands[lane], lanes[lane]) = (Some(&mut **strand), Some(&mut constrained.step));
        }
        pack.begin(&Present(strands), setting, h, first_order, set, &mut lanes);
        members.iter_mut().flatten().for_each(|(_, constrained)| constrained.begun());
    };
    with_pairs(packs, memory, members, |work| workers.for_each(work, |work, _| begin(work)));
}

/// Computes the ends of a pack's strands for which `ends` is true.
pub(super) fn finish(work: &mut Work<Pair>, setting: &Setting, h: f64, ends: impl Fn(&ConstrainedStrand) -> bool) {
    let mut strands = [const { None }; MAX_LANES];
    let mut lanes = [const { None }; MAX_LANES];
    for (lane, (strand, constrained)) in running(&mut work.members).filter(|(_, (_, constrained))| ends(constrained)) {
        (strands[lane], lanes[lane]) = (Some(&mut **strand), Some(&mut constrained.step));
    }
    if lanes.iter().any(Option::is_some) {
        work.pack.finish(&Present(strands), setting, h, &mut lanes);
    }
}

/// Strands by their lanes; unused lanes show one of them.
struct Present<'a>([Option<&'a mut Strand>; MAX_LANES]);

impl Present<'_> {
    fn strand(&self, lane: usize) -> &Strand {
        let of_lane = self.0.get(lane).and_then(Option::as_deref);
        of_lane.or_else(|| self.0.iter().find_map(Option::as_deref)).expect("a pack has a strand")
    }
}

impl Pack for Present<'_> {
    fn count(&self) -> usize {
        self.0.iter().rposition(Option::is_some).map_or(0, |last| last + 1)
    }
    fn model(&self, lane: usize) -> &StrandModel {
        &self.strand(lane).model
    }
    fn state(&self, lane: usize) -> &StrandState {
        &self.strand(lane).state
    }
    fn parts(&mut self, lane: usize) -> (&StrandModel, &mut StrandState) {
        let strand = self.0[lane].as_deref_mut().expect("a lane with a strand");
        (&strand.model, &mut strand.state)
    }
    fn root_at(&self, lane: usize, seconds: f64) -> Frame {
        let strand = self.strand(lane);
        root_after(&strand.root_move, &strand.state.root, seconds)
    }
    fn target(&self, lane: usize) -> Option<TargetAt<'_>> {
        drawn_by(&self.strand(lane).target)
    }
}
