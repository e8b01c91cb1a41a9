//! Contact options, and contact parameters of strands.

use std::mem::{offset_of, size_of};

use crate::capi::base::buffers::{OutputValue, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::log::SHX_LOG_WARN;
use crate::capi::base::types::shx_strand_id;
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::capi::simulation::solver_def::check_flag;
use crate::contact::options::{ContactModel, ContactOptions, Friction, MAX_CHOSEN_ITERATIONS, StrandContact};
use crate::error::{Error, Result};
use crate::solver::id::StrandId;

/// Penalty contact (Bertails et al. 2006): a spring and a damper along the normal, viscous friction along the
/// surface. The cheap model: surfaces penetrate by force over stiffness.
pub const SHX_CONTACT_PENALTY: u32 = 1;
/// Penalty contact with a spring that starts softly, up to regularisation_depth.
pub const SHX_CONTACT_REGULARISED_PENALTY: u32 = 2;
/// Signorini's law of contact and Coulomb's law of friction: surfaces do not penetrate by more than tolerance
/// at the end of a step, and both laws are solved to residual. The default.
pub const SHX_CONTACT_COULOMB: u32 = 3;
/// For games and previews: contact with bodies at the strands' integration points (four or more an element),
/// halfway between them and at the tip, with Coulomb friction, as part of the free step and in single
/// precision too. By default most contacts penetrate by tenths of a millimetre at most. max_iterations 2 to
/// 4 saves a third of the time and leaves some strands a centimetre deep where a body moves fast. Strands
/// pass or pierce what is thinner than their points are apart. Strands that collide with strands or have
/// constraints use the springs of SHX_CONTACT_PENALTY, with Coulomb friction.
pub const SHX_CONTACT_AT_POINTS: u32 = 4;

/// How a solver handles contact. Fill it with shx_contact_options_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_contact_options {
    /// Set by shx_contact_options_init.
    pub struct_size: u32,
    /// SHX_CONTACT_. Default SHX_CONTACT_COULOMB.
    pub model: u32,
    /// 1: strands with a wisp_radius also collide with each
    /// other. 0 (default): strands collide with bodies only.
    pub hair_contact: u32,
    /// Maximum number of Newton iterations per substep of an island (a set of strands that contacts couple), 1
    /// to 10000. Default 50. All but SHX_CONTACT_COULOMB: up to 10 is a choice of cost; the remaining
    /// penetration is resolved in later steps, and only SHX_CONTACT_AT_POINTS reports it. (Strands left deep in
    /// a body go on by themselves, up to four times, with 6 more or max_iterations if that is more.) Larger
    /// values, and any with SHX_CONTACT_COULOMB, are limits: an island that reaches one is solved again with
    /// compliant contacts.
    pub max_iterations: u32,
    /// Maximum number of sweeps of the contact solver per iteration, 1 to 1000000. Default 500.
    pub max_sweeps: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Penalty models: stiffness of a contact, N/m; above zero. Default 10. SHX_CONTACT_AT_POINTS uses it for
    /// strands that collide with strands or have constraints.
    pub stiffness: f64,
    /// SHX_CONTACT_PENALTY: damping along the normal as a multiple of stiffness, s; zero or above. Default 1e-3.
    /// SHX_CONTACT_AT_POINTS uses it where it uses stiffness.
    pub damping: f64,
    /// SHX_CONTACT_REGULARISED_PENALTY: depth up to which the spring starts softly, m; above zero. Default 1e-4.
    pub regularisation_depth: f64,
    /// SHX_CONTACT_COULOMB: allowed penetration at the end of a step, m; above zero. Default 5e-5.
    /// SHX_CONTACT_AT_POINTS: friction grows with the penetration up to twice this.
    pub tolerance: f64,
    /// SHX_CONTACT_COULOMB: allowed error of the contact and friction laws in a converged step, 1e-12 to 1. At
    /// every contact the laws hold exactly for some force within residual times the actual force (or times the
    /// weight of the lightest strand, if larger) and some sliding velocity within residual times 0.01 m/s of the
    /// actual one. Default 1e-4: a ten-thousandth of the force, and a micrometre per second.
    pub residual: f64,
    /// SHX_CONTACT_COULOMB, SHX_CONTACT_AT_POINTS: speed at which surfaces that penetrate at the start of a
    /// step are separated, m/s; above zero. Default 0.1.
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
                ContactModel::AtPoints => SHX_CONTACT_AT_POINTS,
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
            SHX_CONTACT_AT_POINTS => ContactModel::AtPoints,
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

/// Fills *options with defaults. size is sizeof(shx_contact_options).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_contact_options_init(options: *mut shx_contact_options, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that options holds size bytes.
    unsafe { initialise("shx_contact_options_init", "options", options, size) }
}

/// Sets the contact options, from the next step on. SHX_CONTACT_COULOMB with max_iterations of 10 or less is
/// accepted with one SHX_LOG_WARN message: there it is a limit that strands run into, and no choice of cost.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (a value out of range).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_contact_options(
    solver: *mut shx_solver,
    options: *const shx_contact_options,
) -> shx_result {
    // SAFETY: the caller's handle and structure, of the size that it states.
    unsafe {
        write("shx_solver_set_contact_options", solver, |core, log| {
            let options = read_versioned("options", options)?.options("options")?;
            core.set_contact_options(&options)?;
            if !options.model.is_soft() && options.max_iterations <= MAX_CHOSEN_ITERATIONS {
                log.message(
                    SHX_LOG_WARN,
                    format_args!(
                        "shx_solver_set_contact_options: options.max_iterations is {}, which with SHX_CONTACT_COULOMB is a limit and \
                         no choice of cost: strands that have not converged by then yield or are rolled back; a number up to {} is \
                         chosen for SHX_CONTACT_PENALTY",
                        options.max_iterations, MAX_CHOSEN_ITERATIONS
                    ),
                );
            }
            Ok(())
        })
    }
}

/// Writes the contact options to *out_options.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: shared.
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

/// Contact properties of a strand. Fill it with shx_strand_contact_init. Friction coefficients come in pairs:
/// along, for what slides over the strand from root to tip, with the scales; and against, from tip to root. In
/// between they vary with the cosine of the direction.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_strand_contact {
    /// Set by shx_strand_contact_init.
    pub struct_size: u32,
    /// Collision groups of the strand, as bits. Default 1.
    pub groups: u32,
    /// Groups that the strand collides with, as bits. Two objects collide if each
    /// is in a group of the other's mask. Default: all.
    pub mask: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Contact radius against bodies, m; zero or above. Default 50e-6.
    pub radius: f64,
    /// Contact radius against other strands, m: that of the wisp which the strand represents;
    /// zero or above. Default 0: no contact with strands. Strands whose roots are closer than the sum of
    /// their radii touch only beyond that length from their roots: no force parts them there.
    pub wisp_radius: f64,
    /// Coulomb coefficient against bodies, multiplied by their friction_scale; zero or above. Default 0.2.
    pub friction_along: f64,
    /// The same from tip to root. Default 0.3.
    pub friction_against: f64,
    /// Coulomb coefficient against strands, the mean of both strands; zero or above. Default 0.2.
    pub hair_friction_along: f64,
    /// The same from tip to root. Default 0.3.
    pub hair_friction_against: f64,
    /// Penalty models: viscous friction of a contact, N s/m, against bodies (multiplied by their
    /// viscous_friction_scale) and strands (the mean of both strands); zero or above. Default 1e-4.
    pub viscous_friction_along: f64,
    /// The same from tip to root. Default 1.5e-4.
    pub viscous_friction_against: f64,
    /// Length from the follicle on that has no contacts, m; zero or above. Default 0. Roots on the surface of a
    /// body, as those of shx_scalp_root_frames on its own mesh, need some millimetres.
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

/// Fills *contact with defaults. size is sizeof(shx_strand_contact).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_strand_contact_init(contact: *mut shx_strand_contact, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that contact holds size bytes.
    unsafe { initialise("shx_strand_contact_init", "contact", contact, size) }
}

/// Sets the contact properties of count strands. With null contacts they collide with nothing, as new
/// strands do. contact_stride 0: one structure for all strands; otherwise that of strand i starts i *
/// contact_stride bytes after the first. All or none.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT (the message names, say, "contacts[3].radius").
/// Threads: exclusive.
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
            let expected = "0, sizeof(shx_strand_contact), or the size of your structure that contains one";
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

/// Writes the contact properties of a strand to *out_contact and 1 to *out_enabled. For a
/// strand without contact it writes the defaults and 0.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID.
/// Threads: shared.
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
            let touches = OutputValue::new("out_enabled", out_enabled)?;
            let contact = core.contact(StrandId::from_bits(id.bits))?;
            output.write(&shx_strand_contact::from_contact(&contact.copied().unwrap_or_default()));
            touches.write(u32::from(contact.is_some()));
            Ok(())
        })
    }
}
