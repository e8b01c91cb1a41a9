//! Haptic objects: a tool in a hand. One thread steps the solver, another one runs the device; neither waits for the other.

use std::sync::Mutex;

use super::haptic_def::{shx_haptic_def, shx_haptic_state};
use crate::capi::base::buffers::{OutputValue, array, frame_from};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{call, in_use, read, shx_solver, write};
use crate::capi::base::types::{shx_body_id, shx_frame};
use crate::capi::base::versioned::{Versioned, VersionedOutput, read_versioned};
use crate::error::{Error, Result};
use crate::haptics::{Device, Tool, haptic};
use crate::solver::id::BodyId;

/// Bodies of a solver that move as one rigid tool in a hand, and the forces that the hand feels.
/// shx_haptic_create makes it, you own it, shx_haptic_destroy frees it. It has two sides that may be used at
/// the same time: that of the simulation (shx_haptic_before_step, shx_haptic_after_step) and that of the
/// device (shx_haptic_update). Neither waits for the other.
pub struct shx_haptic {
    tool: Mutex<Tool>,
    device: Mutex<Device>,
}

/// Locks one side for one call, without waiting.
fn with<T, R>(side: &Mutex<T>, body: impl FnOnce(&mut T) -> Result<R>) -> Result<R> {
    body(&mut *side.try_lock().map_err(in_use)?)
}

/// # Safety
/// `haptic` is null or alive.
unsafe fn haptic_from<'a>(haptic: *const shx_haptic) -> Result<&'a shx_haptic> {
    // SAFETY: the same.
    unsafe { haptic.as_ref() }.ok_or_else(|| Error::NullArgument { argument: "haptic".into() })
}

/// The simulation's side, for one call.
///
/// # Safety
/// `haptic` is null or alive.
pub(super) unsafe fn with_tool<R>(haptic: *const shx_haptic, body: impl FnOnce(&mut Tool) -> Result<R>) -> Result<R> {
    // SAFETY: the same.
    with(unsafe { &haptic_from(haptic)?.tool }, body)
}

/// Creates a haptic object of count bodies, which move as one rigid tool from their present places. def may
/// be null: all defaults. The device moves the bodies from the first step after its first update on: do not
/// move them yourself. You own *out_haptic; free it with shx_haptic_destroy, before or after the solver.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_UNSUPPORTED (SHX_HAPTIC_MODE_HAND_OVER with a contact model other than SHX_CONTACT_COULOMB).
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_haptic_create(
    solver: *const shx_solver,
    def: *const shx_haptic_def,
    bodies: *const shx_body_id,
    count: usize,
    out_haptic: *mut *mut shx_haptic,
) -> shx_result {
    // SAFETY: the caller's handle, structure of the size that it states, count ids and place for one pointer.
    unsafe {
        read("shx_haptic_create", solver, |core| {
            let place = OutputValue::new("out_haptic", out_haptic)?;
            let def = if def.is_null() { shx_haptic_def::defaults() } else { read_versioned("def", def)? };
            let options = def.options()?;
            let bodies: &[shx_body_id] = array("bodies", "count", bodies, count)?;
            let ids: Vec<BodyId> = bodies.iter().map(|id| BodyId::from_bits(id.bits)).collect();
            let (tool, device) = haptic(core, &ids, &options)
                .map_err(|error| error.renamed("bodies (count)", "count").renamed("options", "def"))?;
            place.write(Box::into_raw(Box::new(shx_haptic { tool: Mutex::new(tool), device: Mutex::new(device) })));
            Ok(())
        })
    }
}

/// Frees a haptic object. Its bodies stay in the solver, and so does what holds strands to the teeth of its
/// ring combs: call shx_haptic_release_ring_combs first. Null is allowed.
/// Threads: exclusive: no call of either side may be running. The handle must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_haptic_destroy(haptic: *mut shx_haptic) {
    call("shx_haptic_destroy", || {
        if !haptic.is_null() {
            // SAFETY: made by Box::into_raw in shx_haptic_create.
            drop(unsafe { Box::from_raw(haptic) });
        }
        Ok(())
    });
}

/// Call it before a step, or several substeps, of dt seconds in all: moves the bodies over dt to where the
/// device is now. The device's first pose is where they are placed at once, without sweeping the space in
/// between. Does nothing before the first shx_haptic_update.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (dt), SHX_ERROR_INVALID_ID (a body was
/// removed, or this is another solver), SHX_ERROR_BUSY.
/// Threads: exclusive for the solver and for this side; shx_haptic_update may run meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_haptic_before_step(haptic: *mut shx_haptic, solver: *mut shx_solver, dt: f64) -> shx_result {
    // SAFETY: the caller's handles, null or alive.
    unsafe { write("shx_haptic_before_step", solver, |core, _| with_tool(haptic, |tool| tool.before_step(core, dt))) }
}

/// Call it after the step: hands what touches the tool, and how it yields, over to the device's side. In
/// SHX_HAPTIC_MODE_HAND_OVER it costs a few Newton iterations of the strands near the tool.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID (a body was removed, or this is another solver),
/// SHX_ERROR_BUSY.
/// Threads: exclusive for the solver and for this side; shx_haptic_update may run meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_haptic_after_step(haptic: *mut shx_haptic, solver: *mut shx_solver) -> shx_result {
    // SAFETY: the caller's handles, null or alive.
    unsafe { write("shx_haptic_after_step", solver, |core, _| with_tool(haptic, |tool| tool.after_step(core))) }
}

/// Gives the device's pose and its velocity (linear, m/s, then angular, rad/s, in world axes), dt seconds
/// (above zero) after the last update, and writes the wrench for the hand: force, N, then torque about the
/// handle's origin, N m, in world axes. It never waits, allocates nothing, and takes bounded time: at most
/// max_sweeps over max_contacts contacts. state may be null. When it fails, keep the last wrench.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE (state), SHX_ERROR_INVALID_ARGUMENT (a value that
/// is not finite, a quaternion that is not of unit length, dt), SHX_ERROR_BUSY.
/// Threads: exclusive for this side: one thread, that of the device. Steps of the solver,
/// shx_haptic_before_step and shx_haptic_after_step may run meanwhile.
/// cbindgen:ptrs-as-arrays=[[velocity; 6], [out_wrench; 6]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_haptic_update(
    haptic: *mut shx_haptic,
    pose: *const shx_frame,
    velocity: *const f64,
    dt: f64,
    out_wrench: *mut f64,
    state: *mut shx_haptic_state,
) -> shx_result {
    call("shx_haptic_update", || {
        // SAFETY: the caller's handle, frame, numbers, place for six numbers, and structure of the size that it states.
        let (haptic, pose, velocity, place, output) = unsafe {
            let haptic = haptic_from(haptic)?;
            let pose = frame_from("pose", pose)?;
            let velocity: &[f64] = array("velocity", "velocity", velocity, 6)?;
            let place = OutputValue::new("out_wrench", out_wrench.cast::<[f64; 6]>())?;
            let output = if state.is_null() { None } else { Some(VersionedOutput::new("state", state)?) };
            (haptic, pose, velocity, place, output)
        };
        let half = |from: usize| nalgebra::Vector3::new(velocity[from], velocity[from + 1], velocity[from + 2]);
        let (wrench, told) = with(&haptic.device, |device| device.update(&pose, half(0), half(3), dt))?;
        let ([fx, fy, fz], [tx, ty, tz]) = (wrench.force.into(), wrench.torque.into());
        place.write([fx, fy, fz, tx, ty, tz]);
        if let Some(output) = output {
            output.write(&shx_haptic_state::of(&told));
        }
        Ok(())
    })
}
