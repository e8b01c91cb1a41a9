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
const MAX_LANES: usize = 8;

/// The packs of a substep; more may be kept for their memory.
#[derive(Debug, Default)]
pub(super) struct Packs {
    packs: Vec<AnyPack>,
    count: usize,
    /// Beginning strands, sorted by formula and pack key, then by iterations; the last number is the index among the
    /// constrained strands.
    order: Vec<(bool, PackKey, u32, u32)>,
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
                let kind =
                    PackKey::of(&strand.model, &strand.state, drawn_by(&strand.target).is_some(), setting.options.integrator, h);
                self.order.push((constrained.first_order, kind, strand.last.iterations, place as u32));
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
            let first_order = members.iter().flatten().any(|(_, constrained)| constrained.first_order);
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
            let mut halves = [FirstHalf::None; MAX_LANES];
            for (lane, constrained) in running(members) {
                if asked(constrained) && !meter.is_halted() {
                    halves[lane] = constrained.hold(&islands[constrained.island as usize]);
                    meter.spend(constrained.half_work());
                }
            }
            if !halves.contains(&FirstHalf::ToDo) {
                return;
            }
            let mut lanes = [const { None }; MAX_LANES];
            for (lane, constrained) in running(members).filter(|(lane, _)| halves[*lane] != FirstHalf::None) {
                lanes[lane] = Some(&mut constrained.step);
            }
            pack.linearise(&mut lanes);
        };
        self.with_strands(strands, |work| workers.for_each(work, |work, _| linearise(work)));
    }

    /// The second half, of strands whose islands go on.
    pub fn advance(
        &mut self,
        strands: &mut [ConstrainedStrand],
        islands: &[Island],
        setting: &Setting,
        workers: &WorkerSet,
        meter: &Meter,
    ) {
        let advance = |Work { pack, members }: &mut Work<&mut ConstrainedStrand>| {
            let mut goes = [false; MAX_LANES];
            for (lane, constrained) in running(members) {
                let island = &islands[constrained.island as usize];
                // (Without a solved contact problem there are no forces.)
                if !island.done && !meter.is_halted() {
                    goes[lane] = constrained.advances(island);
                    meter.spend(constrained.half_work());
                }
            }
            if !goes.contains(&true) {
                return;
            }
            let mut lanes: [Option<&mut ConstrainedStep>; MAX_LANES] = [const { None }; MAX_LANES];
            for (lane, constrained) in running(members).filter(|(lane, _)| goes[*lane]) {
                lanes[lane] = Some(&mut constrained.step);
            }
            pack.advance(setting, &mut lanes);
            running(members).filter(|(lane, _)| goes[*lane]).for_each(|(_, constrained)| constrained.advanced());
        };
        self.with_strands(strands, |work| workers.for_each(work, |work, _| advance(work)));
    }

    /// The pack of a strand.
    pub fn pack(&mut self, constrained: &ConstrainedStrand) -> &mut AnyPack {
        &mut self.packs[constrained.pack as usize]
    }
}

/// Runs something on the packs of `items`, whose `place` is a pack and a lane, in a list that keeps its `memory`.
fn with_work<'a, M, S>(
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
