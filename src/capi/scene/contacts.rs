//! The list of contacts at the end of the last substep.

use std::mem::{offset_of, size_of};

use crate::capi::base::buffers::{OutputValue, Strided};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver};
use crate::capi::base::types::{shx_body_id, shx_strand_id};
use crate::solver::bodies::{Contact, ContactPartner};

/// The contact is with a body.
pub const SHX_PARTNER_BODY: u32 = 1;
/// The contact is with another strand, or with another part of the same one.
pub const SHX_PARTNER_STRAND: u32 = 2;

/// A contact of a strand at the end of the last substep.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_contact {
    /// The strand.
    pub strand: shx_strand_id,
    /// Arclength of the contact on the strand, m.
    pub arclength: f64,
    /// What the strand is in contact with: SHX_PARTNER_.
    pub partner: u32,
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
    /// Force on the strand, N, world. The partner receives the opposite force.
    pub force: [f64; 3],
    /// How far the strand slid over its partner during the substep, m, world, along the surface.
    pub slip: [f64; 3],
    /// Distance between the surfaces along the normal, m; negative if they penetrate. A body's surface counts as
    /// flat about the contact: a strand that slides past an edge within the substep may be farther from it.
    pub gap: f64,
}

const _: () = {
    assert!(size_of::<shx_contact>() == 152 && offset_of!(shx_contact, body) == 24);
    assert!(offset_of!(shx_contact, position) == 48 && offset_of!(shx_contact, gap) == 144);
};

#[doc(hidden)]
impl From<&Contact> for shx_contact {
    fn from(contact: &Contact) -> Self {
        let (none, nothing) = (shx_strand_id { bits: 0 }, shx_body_id { bits: 0 });
        let (partner, feature, body, other, other_arclength) = match contact.partner {
            ContactPartner::Body { body, feature } => (SHX_PARTNER_BODY, feature, shx_body_id { bits: body.bits() }, none, 0.0),
            ContactPartner::Strand { strand, arclength } => {
                (SHX_PARTNER_STRAND, 0, nothing, shx_strand_id { bits: strand.bits() }, arclength)
            }
        };
        Self {
            strand: shx_strand_id { bits: contact.strand.bits() },
            arclength: contact.arclength,
            partner,
            triangle: feature,
            body,
            other_strand: other,
            other_arclength,
            position: contact.position.into(),
            normal: contact.normal.into(),
            force: contact.force.into(),
            slip: contact.slip.into(),
            gap: contact.gap,
        }
    }
}

/// Returns the number of contacts with non-zero force at the end of the last
/// substep: the capacity that shx_solver_contacts needs.
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_contact_count(solver: *const shx_solver, out_count: *mut usize) -> shx_result {
    // SAFETY: the caller's handle and place for one number.
    unsafe {
        read("shx_solver_contact_count", solver, |core| {
            OutputValue::new("out_count", out_count)?.write(core.contacts().len());
            Ok(())
        })
    }
}

/// Writes the contacts with non-zero force at the end of the last substep to out_contacts, which holds
/// capacity items, stride bytes apart (0: tightly packed; any alignment), and their number to *out_count.
/// Their order does not depend on the number of threads. The list is empty after shx_solver_restore, and after
/// strands or bodies were removed, until the next step.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (stride),
/// SHX_ERROR_BUFFER_TOO_SMALL (see shx_solver_contact_count).
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_contacts(
    solver: *const shx_solver,
    out_contacts: *mut shx_contact,
    stride: usize,
    capacity: usize,
    out_count: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle, room for capacity contacts and place for one number.
    unsafe {
        read("shx_solver_contacts", solver, |core| {
            let count = OutputValue::new("out_count", out_count)?;
            let places = Strided::new("out_contacts", "capacity", out_contacts, stride, capacity)?;
            let found = core.contacts();
            places.write_all(found.iter().map(shx_contact::from))?;
            count.write(found.len());
            Ok(())
        })
    }
}
