//! The contacts kept from substep to substep, saved and restored for snapshots.

use super::{ContactDetection, WarmStartForce, With};
use crate::contact::broad_phase::hair_pairs::PairMemory;

/// The last substep's contact forces, and the pairs of strands near each other.
#[derive(Debug, Clone, Default)]
pub(crate) struct ContactMemory {
    pub warm_start: Vec<WarmStartForce>,
    pub pairs: Option<NearStrands>,
}

/// The strands of the search (indices, ascending), and its memory.
#[derive(Debug, Clone)]
pub(crate) struct NearStrands {
    pub of: Vec<u32>,
    pub memory: PairMemory,
}

impl ContactDetection {
    /// What is kept.
    pub fn memory(&self) -> ContactMemory {
        let pairs = self.pairs.memory().filter(|_| self.ready);
        let pairs = pairs.map(|memory| NearStrands { of: self.of.clone(), memory });
        ContactMemory { warm_start: self.warm_start.clone(), pairs }
    }

    /// Restores it. False, with nothing changed, if its contents are inconsistent or do not belong to the scene: `elements`
    /// gives the lengths of a strand's elements, `bodies` is the number of bodies.
    pub fn take_up<'a>(&mut self, memory: ContactMemory, elements: impl Fn(u32) -> Option<&'a [f64]>, bodies: usize) -> bool {
        let there = |seen: &WarmStartForce| {
            let with = match seen.with {
                With::Body(body) => (body as usize) < bodies,
                With::Strand(strand) => elements(strand).is_some(),
            };
            with && elements(seen.strand).is_some() && seen.along.is_finite() && seen.force.iter().all(|x| x.is_finite())
        };
        let key = |seen: &WarmStartForce| (seen.strand, seen.with);
        if !(memory.warm_start.iter().all(there) && memory.warm_start.is_sorted_by_key(key)) {
            return false;
        }
        let mut new = Self { warm_start: memory.warm_start, ..Self::default() };
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
