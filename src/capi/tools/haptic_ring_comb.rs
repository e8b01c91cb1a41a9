//! Ring combs in the hand: a haptic object leads them, and the hand feels what the strands on their teeth pull with.

use super::haptic::{shx_haptic, with_tool};
use super::ring_comb::{comb_of, shx_ring_comb_def, shx_ring_comb_report};
use super::styling_tool::shx_tool_def;
use crate::capi::base::buffers::{OutputValue, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{call, read, shx_solver, write};
use crate::capi::base::types::{shx_frame, shx_strand_id};
use crate::error::{Error, Result};
use crate::haptics::Tool;
use crate::styling::{RingComb, RingCombReport};

/// The ring comb at an index, with its report.
fn comb_at(tool: &Tool, index: usize) -> Result<(&RingComb, &RingCombReport)> {
    let mut combs = tool.ring_combs();
    let count = combs.len();
    let expected = || format!("an index of shx_haptic_add_ring_comb, which has made {count}");
    combs.nth(index).ok_or_else(|| Error::invalid("index", index, expected()))
}

/// Gives the hand a ring comb: one with the teeth of a tool (any but plates), which is at frame now. It keeps
/// its place in the hand: from the next step on it goes with the bodies, catches those of count strands that
/// its teeth run into, and the hand feels what they pull with. Between shx_haptic_before_step and
/// shx_haptic_after_step the haptic object does all that shx_ring_comb_before_step and
/// shx_ring_comb_after_step do. The comb is part of the haptic object, which frees it: there is no
/// shx_ring_comb to keep. Nothing is kept of tool, def and ids. Ids of strands that are removed later are
/// forgotten. def may be null: all defaults. *out_index is the number of combs that it had before.
/// Bodies where the teeth are push the strands off them: give these strands no contact, or let the tool have
/// a body only where it is held. In SHX_HAPTIC_MODE_HAND_OVER the forces of strands on teeth change with each
/// step, not between steps.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_UNSUPPORTED,
/// SHX_ERROR_INVALID_ID (a strand; or a body was removed, or this is another solver), SHX_ERROR_BUSY.
/// Nothing has changed then.
/// Threads: shared for the solver, exclusive for the simulation's side of the haptic object;
/// shx_haptic_update may run meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_haptic_add_ring_comb(
    haptic: *mut shx_haptic,
    solver: *const shx_solver,
    tool: *const shx_tool_def,
    frame: *const shx_frame,
    def: *const shx_ring_comb_def,
    ids: *const shx_strand_id,
    count: usize,
    out_index: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handles, structures, count ids and place for one number.
    unsafe {
        read("shx_haptic_add_ring_comb", solver, |core| {
            let place = OutputValue::new("out_index", out_index)?;
            let comb = comb_of(tool, frame, def)?;
            let ids = strand_ids(ids, count)?;
            let add = |tool: &mut Tool| tool.add_ring_comb(core, comb, &ids);
            place.write(with_tool(haptic, add).map_err(|error| error.renamed("strands", "ids"))?);
            Ok(())
        })
    }
}

/// What the last step did to a ring comb in the hand; all zero before the first. Its torque is about the
/// origin of the comb's frame. index comes from shx_haptic_add_ring_comb.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (index), SHX_ERROR_BUSY.
/// Threads: exclusive for the simulation's side of the haptic object; shx_haptic_update may run meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_haptic_ring_comb_report(
    haptic: *const shx_haptic,
    index: usize,
    out_report: *mut shx_ring_comb_report,
) -> shx_result {
    call("shx_haptic_ring_comb_report", || {
        // SAFETY: the caller's handle and room for the report.
        let (place, report) = unsafe {
            let place = OutputValue::new("out_report", out_report)?;
            (place, with_tool(haptic, |tool| Ok(shx_ring_comb_report::from(comb_at(tool, index)?.1)))?)
        };
        place.write(report);
        Ok(())
    })
}

/// Where a ring comb in the hand is: where the last shx_haptic_before_step has sent it. index comes from
/// shx_haptic_add_ring_comb.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (index), SHX_ERROR_BUSY.
/// Threads: exclusive for the simulation's side of the haptic object; shx_haptic_update may run meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_haptic_ring_comb_frame(
    haptic: *const shx_haptic,
    index: usize,
    out_frame: *mut shx_frame,
) -> shx_result {
    call("shx_haptic_ring_comb_frame", || {
        // SAFETY: the caller's handle and room for the frame.
        let (place, frame) = unsafe {
            let place = OutputValue::new("out_frame", out_frame)?;
            (place, with_tool(haptic, |tool| Ok(comb_at(tool, index)?.0.pose()))?)
        };
        place.write(shx_frame::from(&frame));
        Ok(())
    })
}

/// Lets go of all strands on the teeth of the hand's ring combs. They may be caught again in the next step.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID (a body was removed, or this is another solver),
/// SHX_ERROR_BUSY.
/// Threads: exclusive for the solver and for the simulation's side of the haptic object; shx_haptic_update
/// may run meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_haptic_release_ring_combs(haptic: *mut shx_haptic, solver: *mut shx_solver) -> shx_result {
    // SAFETY: the caller's handles.
    unsafe { write("shx_haptic_release_ring_combs", solver, |core, _| with_tool(haptic, |tool| tool.release_ring_combs(core))) }
}
