//! Identifiers that can be checked: a slot, the generation of what sits in it, and a mark of the solver that gave it out.

/// Names a strand of one solver. Zero bits is the null identifier; a removed strand's identifier never names another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct StrandId(u64);

const SLOT_BITS: u32 = 26;
const GENERATION_BITS: u32 = 22;
/// Slots that a solver can have: the most strands that live at one time.
pub(super) const MAX_SLOTS: usize = 1 << SLOT_BITS;

impl StrandId {
    /// From the bits as the C ABI has them.
    pub fn from_bits(bits: u64) -> Self {
        Self(bits)
    }

    /// The bits as the C ABI has them.
    pub fn bits(self) -> u64 {
        self.0
    }
}

/// Which slot holds which strand, and which identifiers are alive.
#[derive(Debug, Clone)]
pub(super) struct SlotMap {
    /// Sixteen bits that tell this solver's identifiers from another's.
    pub mark: u16,
    /// For each slot its generation and, where one lives there, the index of its strand.
    pub slots: Vec<(u32, Option<u32>)>,
    /// Empty slots whose generation may still grow.
    pub free: Vec<u32>,
}

impl SlotMap {
    pub fn new(mark: u16) -> Self {
        Self { mark, slots: Vec::new(), free: Vec::new() }
    }

    /// A new identifier for the strand at `index`, or `None` when all slots are taken.
    pub fn insert(&mut self, index: usize) -> Option<StrandId> {
        let slot = match self.free.pop() {
            Some(slot) => slot as usize,
            None if self.slots.len() < MAX_SLOTS => {
                self.slots.push((0, None));
                self.slots.len() - 1
            }
            None => return None,
        };
        // Generations begin at 1, so that no identifier is zero.
        self.slots[slot].0 += 1;
        self.slots[slot].1 = Some(index as u32);
        Some(self.id_of(slot))
    }

    fn id_of(&self, slot: usize) -> StrandId {
        let generation = u64::from(self.slots[slot].0);
        StrandId(u64::from(self.mark) << (SLOT_BITS + GENERATION_BITS) | generation << SLOT_BITS | slot as u64)
    }

    /// The slot that a living identifier names.
    fn slot(&self, id: StrandId) -> Option<usize> {
        let slot = (id.0 & (MAX_SLOTS as u64 - 1)) as usize;
        (slot < self.slots.len() && self.slots[slot].1.is_some() && self.id_of(slot) == id).then_some(slot)
    }

    /// The index of the strand that an identifier names.
    pub fn index(&self, id: StrandId) -> Option<usize> {
        self.slot(id).and_then(|slot| self.slots[slot].1).map(|index| index as usize)
    }

    /// Ends an identifier.
    pub fn remove(&mut self, id: StrandId) {
        if let Some(slot) = self.slot(id) {
            self.slots[slot].1 = None;
            // A slot whose generations are used up is retired rather than begun again.
            if self.slots[slot].0 < (1 << GENERATION_BITS) - 1 {
                self.free.push(slot as u32);
            }
        }
    }

    /// Tells a strand's new index.
    pub fn moved(&mut self, id: StrandId, index: usize) {
        if let Some(slot) = self.slot(id) {
            self.slots[slot].1 = Some(index as u32);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stale_and_foreign_identifiers_name_nothing() {
        let (mut map, mut other) = (SlotMap::new(7), SlotMap::new(8));
        let a = map.insert(0).unwrap();
        let b = map.insert(1).unwrap();
        let foreign = other.insert(0).unwrap();
        assert_eq!((map.index(a), map.index(b), map.index(foreign)), (Some(0), Some(1), None));
        assert_ne!(a.bits(), 0);
        map.remove(a);
        let c = map.insert(5).unwrap();
        assert_eq!((map.index(a), map.index(c)), (None, Some(5)));
        assert_eq!(map.index(StrandId::from_bits(0)), None);
        assert_eq!(map.index(StrandId::from_bits(u64::MAX)), None);
    }

    #[test]
    fn a_slot_is_retired_when_its_generations_end() {
        let mut map = SlotMap::new(1);
        let id = map.insert(0).unwrap();
        map.slots[0].0 = (1 << GENERATION_BITS) - 1;
        let last = map.id_of(0);
        map.remove(last);
        assert!(map.free.is_empty() && map.index(id).is_none());
        assert_eq!(map.insert(3).map(|next| map.index(next)), Some(Some(3)));
        assert_eq!(map.slots.len(), 2);
    }
}
