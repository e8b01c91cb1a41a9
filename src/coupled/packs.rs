//! Constrained strands side by side: their distribution to packs, and each half of an iteration pack by pack.
//!
//! Strands with one pack key are packed by their numbers of iterations in the last step, so that a pack does not wait for one
//! of its strands. A strand that begins its step again moves to a pack of such strands. No result depends on the pack.

use super::constrained_strand::{ConstrainedStrand, FirstHalf, LookAhead};
use super::island::Island;
use crate::memory::recycled;
use crate::meter::Meter;
use crate::step::Setting;
use crate::step::constrained::packs::AnyPack;
use crate::step::constrained::step::{ConstrainedStep, running};
use crate::step::pack::members::PackKey;
use crate::workers::WorkerSet;

/// The largest number of strands of a pack.
pub const MAX_LANES: usize = 8;

/// The packs of a substep; more may be kept for their memory.
#[derive(Debug, Default)]
pub struct Packs {
    packs: Vec<AnyPack>,
    count: usize,
    /// Beginning strands, sorted by formula and pack key, then by iterations; the last number is the index among the
    /// constrained strands.
    order: Vec<(bool, PackKey, u32, u32)>,
    /// Whether each pack holds coupled and solitary strands.
    holds: Vec<[bool; 2]>,
    /// Memory for lists of packs.
    strand_work: Vec<Work<'static, &'static mut ConstrainedStrand>>,
}

/// A pack, and its strands by their lanes.
#[derive(Debug)]
pub struct Work<'a, M> {
    /// The pack.
    pub pack: &'a mut AnyPack,
    /// Its strands, and what goes with each.
    pub members: [Option<M>; MAX_LANES],
}

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

    /// Has a beginning strand placed by [`Packs::place`]: the one with this index, by whether its step is of first order, its pack
    /// key and its number of iterations in the last step.
    pub fn begins(&mut self, index: usize, strand: &ConstrainedStrand, key: PackKey, iterations: u32) {
        self.order.push((strand.formula.is_first_order(), key, iterations, index as u32));
    }

    /// Distributes the beginning strands to new packs of at most `width`.
    pub fn place(&mut self, strands: &mut [ConstrainedStrand], width: usize) {
        self.order.sort_unstable();
        for kind in self.order.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            for pack in kind.chunks(width.min(MAX_LANES)) {
                for (lane, (.., place)) in pack.iter().enumerate() {
                    let constrained = &mut strands[*place as usize];
                    (constrained.pack, constrained.lane) = (self.count as u32, lane as u32);
                }
                self.count += 1;
            }
        }
        self.order.clear();
        self.packs.resize_with(self.packs.len().max(self.count), AnyPack::default);
    }

    /// The first half of an iteration of the strands that are `asked`.
    pub fn linearise<S: Default + Send>(
        &mut self,
        strands: &mut [ConstrainedStrand],
        islands: &[Island],
        workers: &WorkerSet<S>,
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
    pub fn advance<S: Default + Send>(
        &mut self,
        strands: &mut [ConstrainedStrand],
        islands: &[Island],
        setting: &Setting,
        workers: &WorkerSet<S>,
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
    pub fn forget_mixed_look_ahead(&mut self, strands: &mut [ConstrainedStrand], islands: &[Island]) {
        if !strands.iter().any(|constrained| constrained.look_ahead == LookAhead::Done) {
            return;
        }
        self.holds.clear();
        self.holds.resize(self.count, [false; 2]);
        for constrained in &*strands {
            self.holds[constrained.pack as usize][usize::from(islands[constrained.island as usize].turn.is_alone())] = true;
        }
        for constrained in strands {
            if constrained.look_ahead == LookAhead::Done && self.holds[constrained.pack as usize] == [true; 2] {
                constrained.look_ahead = LookAhead::ToRepeat;
            }
        }
    }

    /// The pack of a strand.
    pub fn pack(&mut self, constrained: &ConstrainedStrand) -> &mut AnyPack {
        &mut self.packs[constrained.pack as usize]
    }
}

/// The first half of an iteration of a pack's strands, by their lanes, each with its island.
pub fn first_half<'a>(
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
pub fn second_half<'a>(
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
pub fn with_work<'a, M, S>(
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
