//! Wisps: a guide of a groom represents the hairs around it.

use std::mem::size_of;

use super::materials::shx_material;
use crate::capi::base::buffers::OutputList;
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::error::{Error, Result};
use crate::groom::hair::wisp::Wisp;

/// A wisp: the hairs that one guide represents, which lie and move together. Fill it with shx_wisp_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_wisp {
    /// Set by shx_wisp_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Number of hairs, 1 to 1e6. Default 200.
    pub hairs: f64,
    /// How firmly the hairs hold together and keep their style: 0 (bare hair
    /// that slides freely) to 1 (lacquered). Default 0.6.
    pub hold: f64,
}

const _: () = assert!(size_of::<shx_wisp>() == 24);

// SAFETY: repr(C), a u32 first, no padding (asserted above), integers and doubles only.
unsafe impl Versioned for shx_wisp {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let Wisp { hairs, hold } = Wisp::default();
        Self { struct_size: size_of::<Self>() as u32, reserved0: 0, hairs, hold }
    }
}

impl shx_wisp {
    fn wisp(&self) -> Result<Wisp> {
        if self.reserved0 != 0 {
            return Err(Error::invalid("wisp.reserved0", self.reserved0, "0"));
        }
        let wisp = Wisp { hairs: self.hairs, hold: self.hold };
        wisp.check("wisp")?;
        Ok(wisp)
    }
}

/// Fills *wisp with defaults. size is sizeof(shx_wisp).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_wisp_init(wisp: *mut shx_wisp, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that wisp holds size bytes.
    unsafe { initialise("shx_wisp_init", "wisp", wisp, size) }
}

/// Computes the material of a rod that moves as a wisp of such hairs does, and writes it to
/// out_material, which shx_material_init has filled. Its cross-section is that of all hairs without air
/// between them. Relative to its weight it is hairs^hold times as stiff as one hair. Internal friction
/// scales with stiffness, plus 0.1 hold seconds of viscosity; air drag scales with the number of hairs.
/// (A bundle of n fibres bends with n EI if they slide and n^2 EI if they are bonded: Bathe et al. 2008,
/// Heussinger et al. 2007.) The other outputs may be null.
/// out_radius: radius within which the hairs lie, m; use it as shx_strand_contact.wisp_radius.
/// out_margin: margin for shx_solver_stiffen_strands with which the wisp rests as drawn: 0.9 hold.
/// With hold 0 it is 0: bare hair rests where it can.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_wisp_material(
    wisp: *const shx_wisp,
    hair: *const shx_material,
    out_material: *mut shx_material,
    out_radius: *mut f64,
    out_margin: *mut f64,
) -> shx_result {
    call("shx_wisp_material", || {
        // SAFETY: the caller's structures of the sizes that they state, and places for a value each.
        unsafe {
            let wisp = read_versioned("wisp", wisp)?.wisp()?;
            let hair = read_versioned("hair", hair)?.material("hair")?;
            let place = VersionedOutput::new("out_material", out_material)?;
            let radius = OutputList::optional("out_radius", "one", out_radius, 1)?;
            let margin = OutputList::optional("out_margin", "one", out_margin, 1)?;
            let material = wisp.material(&hair)?;
            place.write(&shx_material::of(&material));
            radius.map_or(Ok(()), |place| place.write(&[wisp.radius(&hair)]))?;
            margin.map_or(Ok(()), |place| place.write(&[wisp.margin().unwrap_or(0.0)]))
        }
    })
}
