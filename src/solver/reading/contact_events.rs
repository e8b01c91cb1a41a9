//! Contact begin and end events, queued until the host drains them.

use std::collections::VecDeque;

use crate::error::{Error, Result};
use crate::solver::Solver;
use crate::solver::bodies::{Contact, ContactPartner};
use crate::solver::id::StrandId;

/// The largest capacity for events.
pub const MAX_EVENTS: usize = 1 << 24;

/// Whether a contact began or ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// The pair had no contact at the end of the last step.
    Begin,
    /// The pair no longer has one.
    End,
}

/// The start or end of contact between a strand and its partner in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactEvent {
    /// Whether it began or ended.
    pub change: Change,
    /// The pair's contact with the largest force: at the start, or the last one before the end.
    pub contact: Contact,
    /// The strand's element at the contact.
    pub element: u32,
}

/// The pair in contact: the same for all its contacts.
type Pair = (u64, u32, u64);

/// The queued events, and the contacts at the end of the last step.
#[derive(Debug, Default)]
pub(in crate::solver) struct ContactEvents {
    capacity: usize,
    waiting: VecDeque<ContactEvent>,
    /// Events dropped for lack of capacity since the last drain.
    lost: u64,
    /// Sorted by pair.
    present: Vec<(Pair, ContactEvent)>,
    found: Vec<(Pair, ContactEvent)>,
}

fn pair_of(contact: &Contact) -> Pair {
    let strand = contact.strand.bits();
    match contact.partner {
        ContactPartner::Body { body, .. } => (strand, 0, body.bits()),
        ContactPartner::Strand { strand: other, .. } => (strand.min(other.bits()), 1, strand.max(other.bits())),
    }
}

impl ContactEvents {
    fn tell(&mut self, event: ContactEvent) {
        if self.waiting.len() < self.capacity {
            self.waiting.push_back(event);
        } else {
            self.lost += 1;
        }
    }

    /// Processes the contacts at the end of a step; `element` finds the element of an arclength, `lives` whether both sides still
    /// exist.
    fn note(&mut self, contacts: &[Contact], element: impl Fn(StrandId, f64) -> u32, lives: impl Fn(&Contact) -> bool) {
        let mut found = std::mem::take(&mut self.found);
        found.clear();
        found.extend(contacts.iter().map(|contact| {
            let event = ContactEvent { change: Change::Begin, contact: *contact, element: 0 };
            (pair_of(contact), event)
        }));
        // For each pair the contact with the largest force, the first of equals.
        let press = |event: &ContactEvent| event.contact.force.norm_squared();
        found.sort_by(|a, b| a.0.cmp(&b.0).then(press(&b.1).total_cmp(&press(&a.1))));
        found.dedup_by_key(|(pair, _)| *pair);
        for (_, event) in &mut found {
            event.element = element(event.contact.strand, event.contact.arclength);
        }
        let before = std::mem::take(&mut self.present);
        let (mut old, mut new) = (before.iter().peekable(), found.iter().peekable());
        loop {
            let order = match (old.peek(), new.peek()) {
                (Some((a, _)), Some((b, _))) => a.cmp(b),
                (Some(_), None) => std::cmp::Ordering::Less,
                (None, Some(_)) => std::cmp::Ordering::Greater,
                (None, None) => break,
            };
            if order.is_eq() {
                old.next();
                new.next();
            } else if order.is_lt() {
                if let Some((_, event)) = old.next().filter(|(_, event)| lives(&event.contact)) {
                    self.tell(ContactEvent { change: Change::End, ..*event });
                }
            } else if let Some((_, event)) = new.next() {
                self.tell(*event);
            }
        }
        (self.present, self.found) = (found, before);
    }

    pub fn heap_bytes(&self) -> usize {
        self.waiting.capacity() * size_of::<ContactEvent>()
            + (self.present.capacity() + self.found.capacity()) * size_of::<(Pair, ContactEvent)>()
    }
}

impl Solver {
    /// Queues up to `capacity` events of contacts that begin and end in steps from now on; 0 (the default) queues none, at no
    /// cost. Discards the current queue. Contacts that already exist begin in the next step.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for more than [`MAX_EVENTS`]; [`Error::OutOfMemory`].
    pub fn keep_contact_events(&mut self, capacity: usize) -> Result<()> {
        if capacity > MAX_EVENTS {
            return Err(Error::invalid("capacity", capacity, format!("0 to {MAX_EVENTS}")));
        }
        if capacity == 0 {
            self.events = None;
            return Ok(());
        }
        let mut events = ContactEvents { capacity, ..ContactEvents::default() };
        let bytes = capacity.saturating_mul(size_of::<ContactEvent>());
        events.waiting.try_reserve_exact(capacity).map_err(|_| Error::OutOfMemory { bytes })?;
        self.events = Some(Box::new(events));
        Ok(())
    }

    /// The number of queued events, and of events dropped since the last drain.
    pub fn waiting_contact_events(&self) -> (usize, u64) {
        self.events.as_deref().map_or((0, 0), |events| (events.waiting.len(), events.lost))
    }

    /// Takes up to `most` events out, oldest first, and returns how many were dropped since the last drain.
    pub fn drain_contact_events(&mut self, most: usize, mut take: impl FnMut(ContactEvent)) -> u64 {
        let Some(events) = self.events.as_deref_mut() else { return 0 };
        let count = most.min(events.waiting.len());
        events.waiting.drain(..count).for_each(&mut take);
        std::mem::take(&mut events.lost)
    }

    /// Compares the contacts at the end of a step with those of the step before, if events are wanted.
    pub(in crate::solver) fn note_contacts(&mut self) {
        let Some(mut events) = self.events.take() else { return };
        let element = |id: StrandId, arclength: f64| {
            let Ok(strand) = self.strand("id", id) else { return 0 };
            let mut end = 0.0;
            let before = |length: &&f64| {
                end += **length;
                end <= arclength
            };
            (strand.model.lengths.iter().take_while(before).count() as u32).min(strand.model.element_count() as u32 - 1)
        };
        let lives = |contact: &Contact| {
            self.slots.index(contact.strand).is_some()
                && match contact.partner {
                    ContactPartner::Body { body, .. } => self.body_slots.index(body).is_some(),
                    ContactPartner::Strand { strand, .. } => self.slots.index(strand).is_some(),
                }
        };
        events.note(self.constrained_substep.contacts(), element, lives);
        self.events = Some(events);
    }

    /// The scene was replaced: its contacts begin with its first step.
    pub(in crate::solver) fn forget_contact_events(&mut self) {
        if let Some(events) = &mut self.events {
            events.present.clear();
            events.waiting.clear();
            events.lost = 0;
        }
    }
}
