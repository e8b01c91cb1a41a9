//! Ring combs: their teeth hold the strands that they meet until these are combed.

use std::mem::{offset_of, size_of};
use std::sync::Mutex;

use super::styling_tool::shx_tool_def;
use crate::capi::base::buffers::{OutputValue, frame_from, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{call, in_use, shx_solver, write};
use crate::capi::base::types::{shx_frame, shx_strand_id};
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::error::{Error, Result};
use crate::styling::{RingComb, RingCombOptions, RingCombReport};

/// A comb whose teeth hold the strands that they run into: each slides through a ring on its tooth, with
/// friction, until it has been combed to the tip or is let go. It needs no bodies. A strand is on one tooth
/// of a comb at a time; several combs may hold it. shx_ring_comb_create makes it, you own it,
/// shx_ring_comb_destroy frees it.
pub struct shx_ring_comb {
    comb: Mutex<RingComb>,
}

/// Definition of such a comb. Fill it with shx_ring_comb_def_init, then change what you need.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_ring_comb_def {
    /// Set by shx_ring_comb_def_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Factor on the Coulomb coefficients of the strands against bodies; 0 or above. Default 1.
    pub friction: f64,
    /// A strand is let go when its tooth pulls harder than this, N; above 0. Default 0.05.
    pub max_force: f64,
    /// No strand is caught closer to its root than this, m; 0 or above. Default 0.002.
    pub exempt_length: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_ring_comb_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let RingCombOptions { friction, max_force, exempt_length } = RingCombOptions::default();
        Self { struct_size: size_of::<Self>() as u32, reserved0: 0, friction, max_force, exempt_length }
    }
}

/// What a step did to such a comb.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_ring_comb_report {
    /// Number of strands on teeth.
    pub held: u32,
    /// Caught in this step.
    pub caught: u32,
    /// Combed to the tip in this step.
    pub combed: u32,
    /// Let go in this step, because of max_force.
    pub let_go: u32,
    /// Force of the strands on the comb, N, world.
    pub force: [f64; 3],
    /// Torque about the origin of its frame, N m, world.
    pub torque: [f64; 3],
}

const _: () = {
    assert!(size_of::<shx_ring_comb_def>() == 32 && offset_of!(shx_ring_comb_def, friction) == 8);
    assert!(size_of::<shx_ring_comb_report>() == 64 && offset_of!(shx_ring_comb_report, force) == 16);
};

#[doc(hidden)]
impl From<&RingCombReport> for shx_ring_comb_report {
    fn from(report: &RingCombReport) -> Self {
        Self {
            held: report.held,
            caught: report.caught,
            combed: report.combed,
            let_go: report.let_go,
            force: report.wrench.force.into(),
            torque: report.wrench.torque.into(),
        }
    }
}

/// # Safety
/// `comb` is null or alive.
unsafe fn with<R>(comb: *const shx_ring_comb, body: impl FnOnce(&mut RingComb) -> Result<R>) -> Result<R> {
    // SAFETY: the same.
    let comb = unsafe { comb.as_ref() }.ok_or_else(|| Error::NullArgument { argument: "comb".into() })?;
    body(&mut *comb.comb.try_lock().map_err(in_use)?)
}

/// A comb with the teeth of a tool.
///
/// # Safety
/// Each pointer is null or points to what it says.
pub(super) unsafe fn comb_of(
    tool: *const shx_tool_def,
    frame: *const shx_frame,
    def: *const shx_ring_comb_def,
) -> Result<RingComb> {
    // SAFETY: the same.
    let (tool, frame, def) = unsafe {
        let def = if def.is_null() { shx_ring_comb_def::defaults() } else { read_versioned("def", def)? };
        (read_versioned("tool", tool)?, frame_from("frame", frame)?, def)
    };
    if def.reserved0 != 0 {
        return Err(Error::invalid("def.reserved0", def.reserved0, "0"));
    }
    let options = RingCombOptions { friction: def.friction, max_force: def.max_force, exempt_length: def.exempt_length };
    let tool = tool.tool().map_err(|error| error.renamed("def", "tool"))?;
    RingComb::new(&tool, &frame, &options).map_err(|error| error.renamed("options", "def"))
}

/// Fills *def with defaults. size is sizeof(shx_ring_comb_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_ring_comb_def_init(def: *mut shx_ring_comb_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_ring_comb_def_init", "def", def, size) }
}

/// Creates a comb with the teeth of a tool (any but plates) at frame. def may be null: all defaults. You own
/// *out_comb; free it with shx_ring_comb_destroy.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_UNSUPPORTED.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_ring_comb_create(
    tool: *const shx_tool_def,
    frame: *const shx_frame,
    def: *const shx_ring_comb_def,
    out_comb: *mut *mut shx_ring_comb,
) -> shx_result {
    call("shx_ring_comb_create", || {
        // SAFETY: the caller's structures, and room for one pointer.
        let (comb, place) = unsafe { (comb_of(tool, frame, def)?, OutputValue::new("out_comb", out_comb)?) };
        place.write(Box::into_raw(Box::new(shx_ring_comb { comb: Mutex::new(comb) })));
        Ok(())
    })
}

/// Frees a comb. Strands that it holds stay held: call shx_ring_comb_release first. Null is allowed.
/// Threads: exclusive. The handle must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_ring_comb_destroy(comb: *mut shx_ring_comb) {
    call("shx_ring_comb_destroy", || {
        if !comb.is_null() {
            // SAFETY: made by Box::into_raw in shx_ring_comb_create.
            drop(unsafe { Box::from_raw(comb) });
        }
        Ok(())
    });
}

/// Call it before a step of dt seconds: the comb moves to frame meanwhile, and those of count strands that a
/// tooth runs into on the way are caught.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUSY.
/// Threads: exclusive, for the solver and the comb.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_ring_comb_before_step(
    comb: *mut shx_ring_comb,
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    frame: *const shx_frame,
    dt: f64,
) -> shx_result {
    // SAFETY: the caller's handles, count ids and a frame.
    unsafe {
        write("shx_ring_comb_before_step", solver, |core, _| {
            let (ids, frame) = (strand_ids(ids, count)?, frame_from("frame", frame)?);
            with(comb, |comb| comb.before_step(core, &ids, &frame, dt))
        })
    }
}

/// Call it after the step: lets go of strands that are combed to the tip or pulled too hard, and writes what
/// happened to out_report.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUSY.
/// Threads: exclusive, for the solver and the comb.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_ring_comb_after_step(
    comb: *mut shx_ring_comb,
    solver: *mut shx_solver,
    out_report: *mut shx_ring_comb_report,
) -> shx_result {
    // SAFETY: the caller's handles and room for the report.
    unsafe {
        write("shx_ring_comb_after_step", solver, |core, _| {
            let place = OutputValue::new("out_report", out_report)?;
            place.write((&with(comb, |comb| comb.after_step(core))?).into());
            Ok(())
        })
    }
}

/// Lets go of all strands that the comb holds.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUSY.
/// Threads: exclusive, for the solver and the comb.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_ring_comb_release(comb: *mut shx_ring_comb, solver: *mut shx_solver) -> shx_result {
    // SAFETY: the caller's handles.
    unsafe { write("shx_ring_comb_release", solver, |core, _| with(comb, |comb| comb.release(core))) }
}
