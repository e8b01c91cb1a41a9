//! Constrained strands side by side: their distribution to packs, and each half of an iteration pack by pack.
//!
//! Strands with one pack key are packed by their numbers of iterations in the last step, so that a pack does not wait for one
//! of its strands. A strand that begins its step again moves to a pack of such strands. No result depends on the pack.

use super::Scene;
use crate::contact::constrained_strand::{ConstrainedStrand, FirstHalf};
use crate::contact::island::Island;
use crate::math::frame::Frame;
use crate::math::lane::Precision;
use crate::memory::recycled;
use crate::meter::Meter;
use crate::rod::strand::StrandModel;
use crate::rod::target::TargetAt;
use crate::solver::strand::{Strand, drawn_by, root_after};
use crate::solver::workers::WorkerSet;
use crate::step::constrained_packs::AnyPack;
use crate::step::constrained_step::{ConstrainedStep, running};
use crate::step::members::{Pack, PackKey};
use crate::step::state::StrandState;
use crate::step::{Setting, packs};

/// The largest number of strands of a pack.
pub(super) const MAX_LANES: usize = 8;

/// The packs of a substep; more may be kept for their memory.
#[derive(Debug, Default)]
pub(super) struct Packs {
    packs: Vec<AnyPack>,
    count: usize,
    /// Beginning strands, sorted by formula and pack key, then by iterations; the last number is the index among the
    /// constrained strands.
    order: Vec<(bool, PackKey, u32, u32)>,
    /// Whether each pack holds coupled and solitary strands.
    holds: Vec<[bool; 2]>,
    /// Memory for lists of packs.
    strand_work: Vec<Work<'static, &'static mut ConstrainedStrand>>,
    pair_work: Vec<Work<'static, Pair<'static>>>,
}

/// A pack, and its strands by their lanes.
#[derive(Debug)]
pub(super) struct Work<'a, M> {
    pub pack: &'a mut AnyPack,
    pub members: [Option<M>; MAX_LANES],
}

/// A constrained strand with its scene strand.
pub(super) type Pair<'a> = (&'a mut Strand, &'a mut ConstrainedStrand);

impl Packs {
    /// Removes all packs.
    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// Runs something on the packs of constrained strands.
    fn with_strands(&mut self, strands: &mut [ConstrainedStrand], run: impl FnOnce(&mut [Work<'_, &mut ConstrainedStrand>])) {
        let place = |constrained: &&mut ConstrainedStrand| (constrained.pack, constrained.lane);
        with_work(&mut self.packs[..self.count], &mut self.strand_work, strands.iter_mut(), place, run);
    }

    /// Runs something on the packs of constrained strands with their scene strands.
    pub fn with_pairs<'a>(&mut self, pairs: impl Iterator<Item = Pair<'a>>, run: impl FnOnce(&mut [Work<'_, Pair<'a>>])) {
        let place = |(_, constrained): &Pair| (constrained.pack, constrained.lane);
        with_work(&mut self.packs[..self.count], &mut self.pair_work, pairs, place, run);
    }

    /// Packs the constrained strands for which `begins` is true, and begins their step of `h` seconds.
    pub fn begin(
        &mut self,
        scene: &mut Scene,
        constrained: &mut [ConstrainedStrand],
        h: f64,
        begins: impl Fn(&ConstrainedStrand) -> bool,
    ) {
        if constrained.is_empty() {
            return;
        }
        let (setting, set) = (scene.setting, scene.set);
        let width = packs::width(Precision::F64, set).min(MAX_LANES);
        self.order.clear();
        for (place, (strand, constrained)) in super::ConstrainedSubstep::pairs(scene.strands, constrained).enumerate() {
            if begins(constrained) {
                strand.begin_moves(h);
                let kind = PackKey::of(
                    &strand.model,
                    &strand.state,
                    [drawn_by(&strand.target).is_some(), false],
                    setting.options.integrator,
                    h,
                );
                self.order.push((constrained.formula.is_first_order(), kind, strand.last.iterations, place as u32));
            }
        }
        self.order.sort_unstable();
        for kind in self.order.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            for pack in kind.chunks(width) {
                for (lane, (.., place)) in pack.iter().enumerate() {
                    let constrained = &mut constrained[*place as usize];
                    (constrained.pack, constrained.lane) = (self.count as u32, lane as u32);
                }
                self.count += 1;
            }
        }
        self.packs.resize_with(self.packs.len().max(self.count), AnyPack::default);
        let pairs = super::ConstrainedSubstep::pairs(scene.strands, constrained).filter(|(_, constrained)| begins(constrained));
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
        self.with_pairs(pairs, |work| workers.for_each(work, |work, _| begin(work)));
    }

    /// The first half of an iteration of the strands that are `asked`.
    pub fn linearise(
        &mut self,
        strands: &mut [ConstrainedStrand],
        islands: &[Island],
        workers: &WorkerSet,
        meter: &Meter,
        asked: impl Fn(&ConstrainedStrand) -> bool + Sync,
    ) {
        let linearise = |Work { pack, members }: &mut Work<&mut ConstrainedStrand>| {
            let members = running(members).filter(|(_, constrained)| asked(constrained) && !meter.is_halted());
            let members = members.map(|(lane, constrained)| (lane, &islands[constrained.island as usize], &mut **constrained));
            first_half(pack, members, meter);
        };
        self.with_strands(strands, |work| workers.for_each(work, |work, _| linearise(work)));
    }

    /// The second half of those that are `asked`.
    pub fn advance(
        &mut self,
        strands: &mut [ConstrainedStrand],
        islands: &[Island],
        setting: &Setting,
        workers: &WorkerSet,
        meter: &Meter,
        asked: impl Fn(&ConstrainedStrand) -> bool + Sync,
    ) {
        let advance = |Work { pack, members }: &mut Work<&mut ConstrainedStrand>| {
            // (Without a solved contact problem there are no forces.)
            let at_work = running(members).filter(|(_, constrained)| asked(constrained) && !meter.is_halted());
            let at_work = at_work.map(|(lane, constrained)| (lane, &islands[constrained.island as usize], &mut **constrained));
            let advanced = second_half(pack, setting, at_work, meter);
            running(members).filter(|(lane, _)| advanced[*lane]).for_each(|(_, constrained)| constrained.advanced());
        };
        self.with_strands(strands, |work| workers.for_each(work, |work, _| advance(work)));
    }

    /// All packs.
    pub fn all(&mut self) -> &mut [AnyPack] {
        &mut self.packs[..self.count]
    }

    /// Where solitary and coupled strands share a pack, these iterate at different times: what was done ahead for one would be
    /// overwritten for another, and is done again.
    pub fn forget_mixed_look_ahead(&mut self, strands: &mut [ConstrainedStrand]) {
        if !strands.iter().any(|constrained| constrained.looked_ahead) {
            return;
        }
        self.holds.clear();
        self.holds.resize(self.count, [false; 2]);
        for constrained in &*strands {
            self.holds[constrained.pack as usize][usize::from(constrained.is_solitary)] = true;
        }
        for constrained in strands {
            constrained.looked_ahead &= self.holds[constrained.pack as usize] != [true; 2];
        }
    }

    /// The pack of a strand.
    pub fn pack(&mut self, constrained: &ConstrainedStrand) -> &mut AnyPack {
        &mut self.packs[constrained.pack as usize]
    }
}

/// The first half of an iteration of a pack's strands, by their lanes, each with its island.
pub(super) fn first_half<'a>(
    pack: &mut AnyPack,
    members: impl Iterator<Item = (usize, &'a Island, &'a mut ConstrainedStrand)>,
    meter: &Meter,
) {
    let mut lanes: [Option<&mut ConstrainedStep>; MAX_LANES] = [const { None }; MAX_LANES];
    let mut is_to_do = false;
    for (lane, island, constrained) in members {
        let half = constrained.hold(island);
        meter.spend(constrained.half_work());
        is_to_do |= half == FirstHalf::ToDo;
        if half != FirstHalf::None {
            lanes[lane] = Some(&mut constrained.step);
        }
    }
    if is_to_do {
        pack.linearise(&mut lanes);
    }
}

/// The second half. True for the lanes that have advanced: [`ConstrainedStrand::advanced`] follows for these.
pub(super) fn second_half<'a>(
    pack: &mut AnyPack,
    setting: &Setting,
    members: impl Iterator<Item = (usize, &'a Island, &'a mut ConstrainedStrand)>,
    meter: &Meter,
) -> [bool; MAX_LANES] {
    let mut lanes: [Option<&mut ConstrainedStep>; MAX_LANES] = [const { None }; MAX_LANES];
    for (lane, island, constrained) in members {
        let goes = constrained.advances(island);
        meter.spend(constrained.half_work());
        if goes {
            lanes[lane] = Some(&mut constrained.step);
        }
    }
    let advanced = std::array::from_fn(|lane| lanes[lane].is_some());
    if advanced.contains(&true) {
        pack.advance(setting, &mut lanes);
    }
    advanced
}

/// Runs something on the packs of `items`, whose `place` is a pack and a lane, in a list that keeps its `memory`.
pub(super) fn with_work<'a, M, S>(
    packs: &'a mut [AnyPack],
    memory: &mut Vec<S>,
    items: impl Iterator<Item = M>,
    place: impl Fn(&M) -> (u32, u32),
    run: impl FnOnce(&mut [Work<'a, M>]),
) {
    let mut work: Vec<Work<M>> = recycled(std::mem::take(memory));
    work.extend(packs.iter_mut().map(|pack| Work { pack, members: [const { None }; MAX_LANES] }));
    for item in items {
        let (pack, lane) = place(&item);
        work[pack as usize].members[lane as usize] = Some(item);
    }
    work.retain(|work| work.members.iter().any(Option::is_some));
    run(&mut work);
    *memory = recycled(work);
}

impl Work<'_, Pair<'_>> {
    /// Computes the ends of the strands for which `ends` is true.
    pub fn finish(&mut self, setting: &Setting, h: f64, ends: impl Fn(&ConstrainedStrand) -> bool) {
        let mut strands = [const { None }; MAX_LANES];
        let mut lanes = [const { None }; MAX_LANES];
        for (lane, (strand, constrained)) in running(&mut self.members).filter(|(_, (_, constrained))| ends(constrained)) {
            (strands[lane], lanes[lane]) = (Some(&mut **strand), Some(&mut constrained.step));
        }
        if lanes.iter().any(Option::is_some) {
            self.pack.finish(&Present(strands), setting, h, &mut lanes);
        }
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
