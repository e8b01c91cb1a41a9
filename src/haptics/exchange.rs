//! A triple buffer: one thread publishes, another takes the newest message, and neither ever waits for the other.
//!
//! There are three slots. The publisher owns one and the taker another; an atomic number holds the third and whether it is new.
//! Publishing and taking are one swap of that number: nobody owns a slot that somebody else writes. A slot consists of 64-bit
//! atomics, so no unsafe code is necessary.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};

/// Set in the third slot's number while its message is untaken.
const NEWS: u8 = 4;

#[derive(Debug)]
struct Slots {
    slots: [Box<[AtomicU64]>; 3],
    third: AtomicU8,
}

/// The side that publishes.
#[derive(Debug)]
pub struct Publisher {
    shared: Arc<Slots>,
    own: u8,
}

/// The side that takes.
#[derive(Debug)]
pub struct Taker {
    shared: Arc<Slots>,
    own: u8,
}

/// Both sides of a buffer for messages of up to `capacity` numbers. Allocates all memory that it ever needs.
pub fn exchange(capacity: usize) -> (Publisher, Taker) {
    let slot = || (0..capacity).map(|_| AtomicU64::new(0)).collect();
    let shared = Arc::new(Slots { slots: [slot(), slot(), slot()], third: AtomicU8::new(2) });
    (Publisher { shared: shared.clone(), own: 0 }, Taker { shared, own: 1 })
}

impl Publisher {
    /// Publishes a message that `write` writes, and replaces one that is untaken. Numbers that `write` does not write come from
    /// an earlier message.
    pub fn publish(&mut self, write: impl FnOnce(&mut Writer)) {
        write(&mut Writer { slot: &self.shared.slots[usize::from(self.own)], at: 0 });
        // Release: the slot's numbers are visible to the taker. Acquire: the previous owner of the slot that comes back has
        // finished with it.
        self.own = self.shared.third.swap(self.own | NEWS, Ordering::AcqRel) & !NEWS;
    }
}

impl Taker {
    /// Takes the newest message, if there is an untaken one, and lets `read` read it.
    pub fn take<R>(&mut self, read: impl FnOnce(&mut Reader) -> R) -> Option<R> {
        if self.shared.third.load(Ordering::Relaxed) & NEWS == 0 {
            return None;
        }
        self.own = self.shared.third.swap(self.own, Ordering::AcqRel) & !NEWS;
        Some(read(&mut Reader { slot: &self.shared.slots[usize::from(self.own)], at: 0 }))
    }
}

/// Writes a message, number by number. Drops what does not fit.
#[derive(Debug)]
pub struct Writer<'a> {
    slot: &'a [AtomicU64],
    at: usize,
}

impl Writer<'_> {
    /// The next number.
    #[inline]
    pub fn number(&mut self, value: f64) {
        if let Some(place) = self.slot.get(self.at) {
            place.store(value.to_bits(), Ordering::Relaxed);
        }
        self.at += 1;
    }

    /// The next numbers.
    pub fn numbers(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.number(*value));
    }

    /// The next number, a count.
    pub fn count(&mut self, value: usize) {
        self.number(value as f64);
    }
}

/// Reads a message, number by number, in the order of writing.
#[derive(Debug)]
pub struct Reader<'a> {
    slot: &'a [AtomicU64],
    at: usize,
}

impl Reader<'_> {
    /// The next number; 0 beyond the slot's end.
    #[inline]
    pub fn number(&mut self) -> f64 {
        let value = self.slot.get(self.at).map_or(0.0, |place| f64::from_bits(place.load(Ordering::Relaxed)));
        self.at += 1;
        value
    }

    /// The next numbers.
    pub fn numbers<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.number())
    }

    /// The next number, a count.
    pub fn count(&mut self) -> usize {
        self.number() as usize
    }
}
