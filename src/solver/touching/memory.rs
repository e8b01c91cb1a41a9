//! What is kept of touches from substep to substep, taken out and put back, for images of a scene.

use super::{Remembered, Touching, With};
use crate::contact::hair_pairs::PairMemory;

/// The last substep's touches, and the pairs of strands that were near each other.
#[derive(Debug, Clone, Default)]
pub(in crate::solver) struct TouchMemory {
    pub remembered: Vec<Remembered>,
    pub pairs: Option<NearStrands>,
}

/// Which strands the search was for (indices, ascending), and its memory.
#[derive(Debug, Clone)]
pub(in crate::solver) struct NearStrands {
    pub of: Vec<u32>,
    pub memory: PairMemory,
}

impl Touching {
    /// What is kept.
    pub fn memory(&self) -> TouchMemory {
        let pairs = self.pairs.memory().filter(|_| self.ready);
        let pairs = pairs.map(|memory| NearStrands { of: self.of.clone(), memory });
        TouchMemory { remembered: self.remembered.clone(), pairs }
    }

    /// Goes on from there. False, and nothing is done, where its parts do not belong together or to the scene: `elements` gives the
    /// lengths of a strand's elements, `bodies` is their number.
    pub fn take_up<'a>(&mut self, memory: TouchMemory, elements: impl Fn(u32) -> Option<&'a [f64]>, bodies: usize) -> bool {
        let there = |seen: &Remembered| {
            let with = match seen.with {
                With::Body(body) => (body as usize) < bodies,
                With::Strand(strand) => elements(strand).is_some(),
            };
            with && elements(seen.strand).is_some() && seen.along.is_finite() && seen.force.iter().all(|x| x.is_finite())
        };
        let key = |seen: &Remembered| (seen.strand, seen.with);
        if !(memory.remembered.iter().all(there) && memory.remembered.is_sorted_by_key(key)) {
            return false;
        }
        let mut new = Self { remembered: memory.remembered, ..Self::default() };
        if let Some(NearStrands { of, memory }) = memory.pairs {
            let lengths: Option<Vec<&[f64]>> = of.iter().map(|strand| elements(*strand)).collect();
            let ascending = of.is_sorted_by(|a, b| a < b);
            new.wisps.clone_from(&memory.wisps);
            if !lengths.is_some_and(|lengths| ascending && new.pairs.take_up(memory, &lengths)) {
                return false;
            }
            (new.of, new.ready) = (of, true);
        }
        *self = new;
        true
    }
}
