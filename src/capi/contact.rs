//! How contact is answered, and what strands are to it.

use std::mem::{offset_of, size_of};

use super::buffers::{Place, strand_ids};
use super::errors::shx_result;
use super::guard::{read, shx_solver, write};
use super::solver_def::check_flag;
use super::types::shx_strand_id;
use super::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::contact::options::{ContactModel, ContactOptions, Friction, StrandContact};
use crate::error::{Error, Result};
use crate::solver::id::StrandId;

/// The papers' penalty: a spring and a damper along the normal, viscous friction along the surface. The cheap model: surfaces sink into
/// each other by their force over stiffness.
pub const SHX_CONTACT_PENALTY: u32 = 1;
/// The same with a spring that begins softly, down to regularisation_depth.
pub const SHX_CONTACT_REGULARISED_PENALTY: u32 = 2;
/// Signorini's and Coulomb's laws: surfaces do not pass through each other, to tolerance at the end of every step, and friction is Coulomb's; both solved to
/// residual.
pub const SHX_CONTACT_COULOMB: u32 = 3;

/// How contact is answered in a solver. Fill with shx_contact_options_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_contact_options {
    /// Set by shx_contact_options_init.
    pub struct_size: u32,
    /// SHX_CONTACT_. Default SHX_CONTACT_COULOMB.
    pub model: u32,
    /// 1: strands that have a wisp_radius touch each other. 0 (default): only bodies, and costs nothing.
    pub hair_contact: u32,
    /// Newton iterations that strands which touch may take together in a substep, 1 to 10000. Default 50. With the penalty models up to
    /// ten are a choice of what to pay for a step: what springs have not pushed out by then they do in the next ones, and nothing is reported for it. More, and
    /// with SHX_CONTACT_COULOMB any, are a limit: what has not converged by then is tried again with touches that give way.
    pub max_iterations: u32,
    /// Sweeps of the contact problem's solver in each of them, 1 to 1000000. Default 500.
    pub max_sweeps: u32,
    /// 0.
    pub reserved0: u32,
    /// Penalty models: of one touch, N/m; above zero. Default 10.
    pub stiffness: f64,
    /// Penalty: what stiffness is multiplied by to damp approach and parting, s; zero or above. Default 1e-3.
    pub damping: f64,
    /// Regularised penalty: m; above zero. Default 1e-4.
    pub regularisation_depth: f64,
    /// Coulomb: how deep surfaces may be in each other at the end of a step, m; above zero. Default 5e-5.
    pub tolerance: f64,
    /// Coulomb: what the laws of contact and friction may err by in a converged step, 1e-12 to 1: at every contact they hold exactly for a force within residual
    /// times the force (or the lightest strand's weight, where that is more) of the one that acts, and a sliding speed within residual times 0.01 m/s of the one that
    /// there is. Default 1e-4: a ten-thousandth of the force, and a micrometre a second.
    pub residual: f64,
    /// Coulomb: how fast surfaces that are in each other when a step begins are parted, m/s; above zero. Default 0.1.
    pub separation_speed: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_contact_options {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self::from_options(&ContactOptions::default())
    }
}

const _: () = {
    assert!(size_of::<shx_contact_options>() == 72 && offset_of!(shx_contact_options, stiffness) == 24);
};

impl shx_contact_options {
    fn from_options(options: &ContactOptions) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            model: match options.model {
                ContactModel::Penalty => SHX_CONTACT_PENALTY,
                ContactModel::RegularisedPenalty => SHX_CONTACT_REGULARISED_PENALTY,
                ContactModel::Coulomb => SHX_CONTACT_COULOMB,
            },
            hair_contact: u32::from(options.hair),
            max_iterations: options.max_iterations,
            max_sweeps: options.max_sweeps,
            reserved0: 0,
            stiffness: options.stiffness,
            damping: options.damping,
            regularisation_depth: options.regularisation_depth,
            tolerance: options.tolerance,
            residual: options.residual,
            separation_speed: options.separation_speed,
        }
    }

    /// The engine's own options.
    fn options(&self, argument: &str) -> Result<ContactOptions> {
        if self.reserved0 != 0 {
            return Err(Error::invalid(format!("{argument}.reserved0"), self.reserved0, "0"));
        }
        let model = match self.model {
            SHX_CONTACT_PENALTY => ContactModel::Penalty,
            SHX_CONTACT_REGULARISED_PENALTY => ContactModel::RegularisedPenalty,
            SHX_CONTACT_COULOMB => ContactModel::Coulomb,
            other => return Err(Error::invalid(format!("{argument}.model"), other, "one of SHX_CONTACT_")),
        };
        Ok(ContactOptions {
            model,
            hair: check_flag(&format!("{argument}.hair_contact"), self.hair_contact)?,
            stiffness: self.stiffness,
            damping: self.damping,
            regularisation_depth: self.regularisation_depth,
            tolerance: self.tolerance,
            residual: self.residual,
            separation_speed: self.separation_speed,
            max_iterations: self.max_iterations,
            max_sweeps: self.max_sweeps,
        })
    }
}

/// Fills options with the defaults. size is sizeof(shx_contact_options).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_contact_options_init(options: *mut shx_contact_options, size: usize) -> shx_result {
    // SAFETY: the caller says that options holds size bytes.
    unsafe { initialise("shx_contact_options_init", "options", options, size) }
}

/// Changes how contact is answered, from the next step on.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (a value out of range). Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_contact_options(
    solver: *mut shx_solver,
    options: *const shx_contact_options,
) -> shx_result {
    // SAFETY: the caller's handle and structure, of the size that it states.
    unsafe {
        write("shx_solver_set_contact_options", solver, |core, _| {
            core.set_contact_options(&read_versioned("options", options)?.options("options")?)
        })
    }
}

/// How contact is answered, into *out_options.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. May run beside other reading calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_contact_options(
    solver: *const shx_solver,
    out_options: *mut shx_contact_options,
) -> shx_result {
    // SAFETY: the caller's handle and structure, of the size that it states.
    unsafe {
        read("shx_solver_get_contact_options", solver, |core| {
            VersionedOutput::new("out_options", out_options)?.write(&shx_contact_options::from_options(&core.options().contact));
            Ok(())
        })
    }
}

/// What a strand is to contact. Fill with shx_strand_contact_init. Coefficients of friction come in pairs: along for what goes over the
/// strand from root to tip, with the scales, against from tip to root; between them by the cosine of the direction.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_strand_contact {
    /// Set by shx_strand_contact_init.
    pub struct_size: u32,
    /// Bits of the groups that the strand is in. Default 1.
    pub groups: u32,
    /// Bits of the groups that it touches: two things meet where each is in a group that the other touches. Default all.
    pub mask: u32,
    /// 0.
    pub reserved0: u32,
    /// How far from the centreline the strand begins for bodies, m; zero or above. Default 50e-6.
    pub radius: f64,
    /// The same for other strands: the radius of the wisp that it stands for, m; zero or above. Default 0: it touches no strand.
    pub wisp_radius: f64,
    /// Coulomb's coefficient against bodies, multiplied by the body's friction; zero or above. Default 0.2.
    pub friction_along: f64,
    /// Default 0.3.
    pub friction_against: f64,
    /// Coulomb's coefficient against strands, the mean of both; zero or above. Default 0.2.
    pub hair_friction_along: f64,
    /// Default 0.3.
    pub hair_friction_against: f64,
    /// Penalty models: viscous friction of a touch, N s/m, against bodies (multiplied by the body's viscous_friction) and strands (the
    /// mean of both); zero or above. Default 1e-4.
    pub viscous_friction_along: f64,
    /// Default 1.5e-4.
    pub viscous_friction_against: f64,
    /// The first so many metres from the follicle touch nothing; zero or above. Default 0.
    pub exempt_length: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_strand_contact {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self::from_contact(&StrandContact::default())
    }
}

const _: () = {
    assert!(size_of::<shx_strand_contact>() == 88 && offset_of!(shx_strand_contact, radius) == 16);
};

impl shx_strand_contact {
    fn from_contact(contact: &StrandContact) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            groups: contact.groups,
            mask: contact.mask,
            reserved0: 0,
            radius: contact.radius,
            wisp_radius: contact.wisp_radius,
            friction_along: contact.friction.along,
            friction_against: contact.friction.against,
            hair_friction_along: contact.hair_friction.along,
            hair_friction_against: contact.hair_friction.against,
            viscous_friction_along: contact.viscous_friction.along,
            viscous_friction_against: contact.viscous_friction.against,
            exempt_length: contact.exempt_length,
        }
    }

    /// The engine's own, checked.
    fn contact(&self, argument: &str) -> Result<StrandContact> {
        if self.reserved0 != 0 {
            return Err(Error::invalid(format!("{argument}.reserved0"), self.reserved0, "0"));
        }
        let contact = StrandContact {
            radius: self.radius,
            wisp_radius: self.wisp_radius,
            friction: Friction { along: self.friction_along, against: self.friction_against },
            hair_friction: Friction { along: self.hair_friction_along, against: self.hair_friction_against },
            viscous_friction: Friction { along: self.viscous_friction_along, against: self.viscous_friction_against },
            exempt_length: self.exempt_length,
            groups: self.groups,
            mask: self.mask,
        };
        // The engine has pairs where the structure has two fields.
        contact.check(argument).map_err(|error| error.renamed_in("friction.", "friction_"))?;
        Ok(contact)
    }
}

/// Fills a structure with the defaults. size is sizeof(shx_strand_contact).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_strand_contact_init(contact: *mut shx_strand_contact, size: usize) -> shx_result {
    // SAFETY: the caller says that contact holds size bytes.
    unsafe { initialise("shx_strand_contact_init", "contact", contact, size) }
}

/// Says what count strands are to contact. contacts null: they touch nothing, which is how strands begin. contact_stride 0: one structure
/// for all; else strand i has the one that begins i * contact_stride bytes after the first. All or none.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (the text names
/// "contacts[3].radius"). Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_strand_contact(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    contacts: *const shx_strand_contact,
    contact_stride: usize,
) -> shx_result {
    let body = |core: &mut crate::solver::Solver| {
        // SAFETY: the caller's count ids.
        let ids = unsafe { strand_ids(ids, count)? };
        if contacts.is_null() {
            return core.set_contact(&ids, None);
        }
        if count.checked_mul(contact_stride).is_none_or(|bytes| bytes > isize::MAX as usize) {
            let expected = "0, sizeof(shx_strand_contact), or the stride of a structure that holds one";
            return Err(Error::invalid("contact_stride", contact_stride, expected));
        }
        let one = |index: usize, argument: &str| {
            let place = contacts.wrapping_byte_add(index * contact_stride);
            // SAFETY: one of the caller's structures, of the size that it states.
            let contact: shx_strand_contact = unsafe { read_versioned(argument, place)? };
            contact.contact(argument)
        };
        if contact_stride == 0 {
            let contact = one(0, "contacts")?;
            return core.set_contact(&ids, Some(&contact));
        }
        if contact_stride < shx_strand_contact::FIRST_SIZE {
            let expected = format!("0 or at least {} bytes", shx_strand_contact::FIRST_SIZE);
            return Err(Error::invalid("contact_stride", contact_stride, expected));
        }
        let read = (0..count).map(|index| one(index, &format!("contacts[{index}]"))).collect::<Result<Vec<_>>>()?;
        core.set_contacts(&ids, &read)
    };
    // SAFETY: the caller's handle, null or alive.
    unsafe { write("shx_solver_set_strand_contact", solver, |core, _| body(core)) }
}

/// What a strand is to contact, into *out_contact; 1 into *out_enabled, or 0 where it touches nothing (then *out_contact has the
/// defaults).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID. May run beside other reading calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_strand_contact(
    solver: *const shx_solver,
    id: shx_strand_id,
    out_contact: *mut shx_strand_contact,
    out_enabled: *mut u32,
) -> shx_result {
    // SAFETY: the caller's handle, structure of the size that it states, and place for a number.
    unsafe {
        read("shx_solver_get_strand_contact", solver, |core| {
            let output = VersionedOutput::new("out_contact", out_contact)?;
            let touches = Place::new("out_enabled", out_enabled)?;
            let contact = core.contact(StrandId::from_bits(id.bits))?;
            output.write(&shx_strand_contact::from_contact(&contact.copied().unwrap_or_default()));
            touches.write(u32::from(contact.is_some()));
            Ok(())
        })
    }
}
