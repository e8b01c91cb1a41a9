//! Contact begin and end events, in a buffer that the host drains.

use std::mem::{offset_of, size_of};

use super::contacts::shx_contact;
use crate::capi::base::buffers::{OutputValue, Strided};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{shx_solver, write};
use crate::capi::base::types::{shx_body_id, shx_strand_id};
use crate::memory;
use crate::solver::reading::contact_events::{Change, ContactEvent};

/// The two had no contact at the end of the step before, and have one now.
pub const SHX_CONTACT_EVENT_BEGIN: u32 = 1;
/// The two had a contact at the end of the step before, and have none now.
pub const SHX_CONTACT_EVENT_END: u32 = 2;

/// A strand and a body, or two strands, came into contact or lost it. Where and how: the contact of the two
/// with the largest force, at the end of the step in which it began, or of the last step in which there was
/// one.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_contact_event {
    /// SHX_CONTACT_EVENT_.
    pub event: u32,
    /// What the strand is in contact with: SHX_PARTNER_.
    pub partner: u32,
    /// The strand.
    pub strand: shx_strand_id,
    /// Arclength of the contact on the strand, m.
    pub arclength: f64,
    /// Element of the strand on which it lies, counted from the root.
    pub element: u32,
    /// Triangle of a mesh; otherwise 0.
    pub triangle: u32,
    /// The body; null id for a strand.
    pub body: shx_body_id,
    /// The other strand; null id for a body.
    pub other_strand: shx_strand_id,
    /// Arclength on the other strand, m; 0 for a body.
    pub other_arclength: f64,
    /// Point on the centreline of the strand, m, world.
    pub position: [f64; 3],
    /// Unit normal from the partner to the strand, world.
    pub normal: [f64; 3],
    /// Force on the strand, N, world.
    pub force: [f64; 3],
}

const _: () = {
    assert!(size_of::<shx_contact_event>() == 128 && offset_of!(shx_contact_event, body) == 32);
    assert!(offset_of!(shx_contact_event, position) == 56);
};

#[doc(hidden)]
impl From<&ContactEvent> for shx_contact_event {
    fn from(event: &ContactEvent) -> Self {
        let contact = shx_contact::from(&event.contact);
        Self {
            event: match event.change {
                Change::Begin => SHX_CONTACT_EVENT_BEGIN,
                Change::End => SHX_CONTACT_EVENT_END,
            },
            partner: contact.partner,
            strand: contact.strand,
            arclength: contact.arclength,
            element: event.element,
            triangle: contact.triangle,
            body: contact.body,
            other_strand: contact.other_strand,
            other_arclength: contact.other_arclength,
            position: contact.position,
            normal: contact.normal,
            force: contact.force,
        }
    }
}

/// Makes the solver keep up to capacity events (at most 2^24) of contacts that begin and end between one
/// shx_solver_step and the next. 0: none, which is the state of a new solver and costs nothing. What waits is
/// discarded; contacts that exist already begin in the next step. Snapshots do not contain events: restoring
/// discards them.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_OUT_OF_MEMORY.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_keep_contact_events(solver: *mut shx_solver, capacity: usize) -> shx_result {
    // SAFETY: the caller's handle, null or alive.
    unsafe { write("shx_solver_keep_contact_events", solver, |core, _| core.keep_contact_events(capacity)) }
}

/// Moves the oldest events that wait, at most capacity of them, to out_events, which holds capacity items,
/// stride bytes apart (0: tightly packed; any alignment). Writes their number to *out_count, and to *out_lost
/// the number of events since the last call for which there was no room. Events of one step come in an order
/// that does not depend on the number of threads. Strands and bodies that were removed end no contact.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (stride).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_drain_contact_events(
    solver: *mut shx_solver,
    out_events: *mut shx_contact_event,
    stride: usize,
    capacity: usize,
    out_count: *mut usize,
    out_lost: *mut u64,
) -> shx_result {
    // SAFETY: the caller's handle, room for capacity events and places for two numbers.
    unsafe {
        write("shx_solver_drain_contact_events", solver, |core, _| {
            let (count, lost) = (OutputValue::new("out_count", out_count)?, OutputValue::new("out_lost", out_lost)?);
            let places = Strided::new("out_events", "capacity", out_events, stride, capacity)?;
            let mut events = memory::list(core.waiting_contact_events().0.min(capacity))?;
            let missed = core.drain_contact_events(capacity, |event| events.push(shx_contact_event::from(&event)));
            count.write(events.len());
            lost.write(missed);
            places.write_all(events.into_iter())
        })
    }
}
