//! Checked identifiers: a slot, its generation, and a mark of the solver.

use std::marker::PhantomData;

use crate::error::Result;
use crate::memory;

/// An identifier as bits.
#[doc(hidden)]
pub trait Identifier: Copy {
    /// Sixteen bits that distinguish this type of identifier.
    const SORT: u16;
    /// From the bits of the C ABI.
    fn from_bits(bits: u64) -> Self;
    /// The bits of the C ABI.
    fn bits(self) -> u64;
}

macro_rules! identifier {
    ($(#[$doc:meta])* $name:ident, $sort:literal) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(u64);

        impl $name {
            /// From the bits of the C ABI.
            pub fn from_bits(bits: u64) -> Self {
                Self(bits)
            }

            /// The bits of the C ABI.
            pub fn bits(self) -> u64 {
                self.0
            }
        }

        impl Identifier for $name {
            const SORT: u16 = $sort;
            fn from_bits(bits: u64) -> Self {
                Self(bits)
            }
            fn bits(self) -> u64 {
                self.0
            }
        }
    };
}

identifier! {
    /// Names a strand of one solver. Zero bits are the null identifier; a removed strand's identifier is never reused.
    StrandId, 0
}
identifier! {
    /// Names a body of one solver, as [`StrandId`] names a strand.
    BodyId, 0x5555
}
identifier! {
    /// Names a constraint of one solver, as [`StrandId`] names a strand.
    ConstraintId, 0x3c3c
}

const SLOT_BITS: u32 = 26;
const GENERATION_BITS: u32 = 22;
const MAX_GENERATION: u32 = (1 << GENERATION_BITS) - 1;
/// The number of slots of a solver: the most strands at a time.
pub(super) const MAX_SLOTS: usize = 1 << SLOT_BITS;

/// Which slot holds which strand, and which identifiers are valid.
#[derive(Debug, Clone)]
pub(super) struct SlotMap<I = StrandId> {
    /// Sixteen bits that distinguish this solver's identifiers.
    pub mark: u16,
    pub slots: Vec<Slot>,
    /// Empty slots whose generation may still grow.
    pub free: Vec<u32>,
    sort: PhantomData<fn() -> I>,
}

/// One slot.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Slot {
    /// Generation of the current strand, or of the last one.
    pub generation: u32,
    /// The highest generation ever issued here: more than `generation` after restoring a snapshot.
    pub highest: u32,
    /// The index of its strand.
    pub index: Option<u32>,
}

impl<I: Identifier> SlotMap<I> {
    pub fn new(mark: u16) -> Self {
        Self { mark, slots: Vec::new(), free: Vec::new(), sort: PhantomData }
    }

    /// Reserves space for `count` more identifiers.
    pub fn reserve(&mut self, count: usize) -> Result<()> {
        memory::grow(&mut self.slots, count.saturating_sub(self.free.len()))
    }

    /// A new identifier for the strand at `index`, or `None` when all slots are taken.
    pub fn insert(&mut self, index: usize) -> Option<I> {
        let slot = match self.free.pop() {
            Some(slot) => slot as usize,
            None if self.slots.len() < MAX_SLOTS => {
                self.slots.push(Slot::default());
                self.slots.len() - 1
            }
            None => return None,
        };
        // Generations start at 1, so no identifier is zero.
        let here = &mut self.slots[slot];
        here.highest += 1;
        here.generation = here.highest;
        here.index = Some(index as u32);
        Some(self.id_of(slot))
    }

    fn id_of(&self, slot: usize) -> I {
        let generation = u64::from(self.slots[slot].generation);
        I::from_bits(u64::from(self.mark ^ I::SORT) << (SLOT_BITS + GENERATION_BITS) | generation << SLOT_BITS | slot as u64)
    }

    /// The slot of a valid identifier.
    fn slot(&self, id: I) -> Option<usize> {
        let slot = (id.bits() & (MAX_SLOTS as u64 - 1)) as usize;
        (slot < self.slots.len() && self.slots[slot].index.is_some() && self.id_of(slot).bits() == id.bits()).then_some(slot)
    }

    /// The index of the strand that an identifier names.
    pub fn index(&self, id: I) -> Option<usize> {
        self.slot(id).and_then(|slot| self.slots[slot].index).map(|index| index as usize)
    }

    /// Invalidates an identifier.
    pub fn remove(&mut self, id: I) {
        if let Some(slot) = self.slot(id) {
            self.slots[slot].index = None;
            self.offer(slot);
        }
    }

    /// Offers an empty slot for reuse; one with exhausted generations is retired instead.
    fn offer(&mut self, slot: usize) {
        if self.slots[slot].highest < MAX_GENERATION {
            self.free.push(slot as u32);
        }
    }

    /// Sets a strand's new index.
    pub fn moved(&mut self, id: I, index: usize) {
        if let Some(slot) = self.slot(id) {
            self.slots[slot].index = Some(index as u32);
        }
    }

    /// Bytes on the heap.
    pub fn heap_bytes(&self) -> usize {
        self.slots.capacity() * size_of::<Slot>() + self.free.capacity() * size_of::<u32>()
    }

    /// Records the identifiers issued in `later`: restoring a snapshot must not issue one of them again.
    pub fn remember(&mut self, later: &Self) {
        if later.mark != self.mark {
            return;
        }
        for (slot, seen) in later.slots.iter().enumerate() {
            if slot == self.slots.len() {
                self.slots.push(Slot { generation: seen.generation, highest: seen.highest, index: None });
                self.offer(slot);
            } else {
                self.slots[slot].highest = self.slots[slot].highest.max(seen.highest);
            }
        }
        let slots = &self.slots;
        self.free.retain(|slot| slots[*slot as usize].highest < MAX_GENERATION);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stale_and_foreign_identifiers_name_nothing() {
        let (mut map, mut other): (SlotMap, SlotMap) = (SlotMap::new(7), SlotMap::new(8));
        let a = map.insert(0).unwrap();
        let b = map.insert(1).unwrap();
        let foreign = other.insert(0).unwrap();
        assert_eq!((map.index(a), map.index(b), map.index(foreign)), (Some(0), Some(1), None));
        assert_ne!(a.bits(), 0);
        let mut bodies: SlotMap<BodyId> = SlotMap::new(7);
        let body = bodies.insert(0).unwrap();
        assert_eq!((bodies.index(body), map.index(StrandId::from_bits(body.bits()))), (Some(0), None));
        map.remove(a);
        let c = map.insert(5).unwrap();
        assert_eq!((map.index(a), map.index(c)), (None, Some(5)));
        assert_eq!(map.index(StrandId::from_bits(0)), None);
        assert_eq!(map.index(StrandId::from_bits(u64::MAX)), None);
    }

    #[test]
    fn going_back_gives_no_identifier_out_twice() {
        let mut map: SlotMap = SlotMap::new(3);
        let a = map.insert(0).unwrap();
        let saved = map.clone();
        map.remove(a);
        let later = [map.insert(0).unwrap(), map.insert(1).unwrap()];
        let mut back = saved;
        back.remember(&map);
        assert_eq!(back.index(a), Some(0));
        assert!(later.iter().all(|id| back.index(*id).is_none()));
        let fresh = [back.insert(1).unwrap(), back.insert(2).unwrap()];
        assert!(fresh.iter().all(|id| !later.contains(id)));
        back.remove(a);
        assert!(!later.contains(&back.insert(0).unwrap()));
    }

    #[test]
    fn a_slot_is_retired_when_its_generations_end() {
        let mut map: SlotMap = SlotMap::new(1);
        let id = map.insert(0).unwrap();
        map.slots[0].generation = MAX_GENERATION;
        map.slots[0].highest = MAX_GENERATION;
        let last = map.id_of(0);
        map.remove(last);
        assert!(map.free.is_empty() && map.index(id).is_none());
        assert_eq!(map.insert(3).map(|next| map.index(next)), Some(Some(3)));
        assert_eq!(map.slots.len(), 2);
    }
}
