//! Bodies, which strands stay outside of. The host moves them, and reads the forces of strands on them.

use super::body_def::{points, shx_body_def};
use crate::capi::base::buffers::{FRAME_FORMATS, OutputList, OutputValue, Writer, array, body_ids, each, frames_reader};
use crate::capi::base::errors::{SHX_OK, shx_result};
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::types::{shx_body_id, shx_input, shx_output};
use crate::capi::base::versioned::definitions;
use crate::capi::reading::wrenches::write_wrenches;
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::memory;
use crate::solver::id::BodyId;

/// The engine's error, with the names of the C structure.
fn in_words_of_c(error: Error) -> Error {
    let fields = [("friction", "friction_scale"), ("viscous_friction", "viscous_friction_scale")];
    error.renamed("bodies", "defs").with_fields(&fields)
}

/// Adds count bodies, all or none. Definition i starts i * def_stride bytes after the first; def_stride is
/// usually sizeof(shx_body_def). Writes count ids to out_ids, in the order of the definitions. Only strands
/// with contact collide with bodies: see shx_solver_set_strand_contact.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the
/// message names, say, "defs[3].radius", or the triangle at which a mesh is open),
/// SHX_ERROR_INVALID_ID (shape_of), SHX_ERROR_OUT_OF_MEMORY.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_add_bodies(
    solver: *mut shx_solver,
    defs: *const shx_body_def,
    def_stride: usize,
    count: usize,
    out_ids: *mut shx_body_id,
) -> shx_result {
    // SAFETY: the caller's handle, structures, their arrays, and place for count ids.
    unsafe {
        write("shx_solver_add_bodies", solver, |core, _| {
            let places = OutputList::new("out_ids", "count", out_ids, count)?;
            let read = |def: &shx_body_def, argument: &str| Ok((def.definition(argument, core)?, def.user_data));
            let definitions = definitions("shx_body_def", defs, def_stride, count, read)?;
            let user_data = memory::collected(definitions.iter().map(|(_, user_data)| *user_data))?;
            let definitions = memory::collected(definitions.into_iter().map(|(definition, _)| definition))?;
            let ids = core.add_bodies(definitions).map_err(in_words_of_c)?;
            for (id, user_data) in ids.iter().zip(user_data) {
                core.set_body_user_data(*id, user_data)?;
            }
            places.write_all(ids.iter().map(|id| shx_body_id { bits: id.bits() }))
        })
    }
}

/// Removes count bodies, all or none. Their ids become invalid.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_remove_bodies(solver: *mut shx_solver, ids: *const shx_body_id, count: usize) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_remove_bodies", solver, |core, _| core.remove_bodies(&body_ids(ids, count)?)) }
}

/// Returns whether id names a body of this solver. False for the null id, a removed body, a body of another
/// solver, and a null or poisoned solver (shx_last_error then has the message).
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_has_body(solver: *const shx_solver, id: shx_body_id) -> bool {
    let mut found = false;
    // SAFETY: the caller's handle, null or alive.
    let result = unsafe {
        read("shx_solver_has_body", solver, |core| {
            found = core.body(BodyId::from_bits(id.bits)).is_ok();
            Ok(())
        })
    };
    result == SHX_OK && found
}

/// Returns shx_body_def.user_data of a body.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_body_user_data(
    solver: *const shx_solver,
    id: shx_body_id,
    out_user_data: *mut u64,
) -> shx_result {
    // SAFETY: the caller's handle and place for one number.
    unsafe {
        read("shx_solver_get_body_user_data", solver, |core| {
            let place = OutputValue::new("out_user_data", out_user_data)?;
            place.write(core.body_user_data(BodyId::from_bits(id.bits))?);
            Ok(())
        })
    }
}

/// Returns the number of bodies.
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_body_count(solver: *const shx_solver, out_count: *mut usize) -> shx_result {
    // SAFETY: the caller's handle and place for one number.
    unsafe {
        read("shx_solver_body_count", solver, |core| {
            OutputValue::new("out_count", out_count)?.write(core.body_ids().len());
            Ok(())
        })
    }
}

/// Writes the ids of all bodies, in the order in which they were added, to out_ids, which holds capacity ids.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL (see shx_solver_body_count).
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_body_ids(
    solver: *const shx_solver,
    out_ids: *mut shx_body_id,
    capacity: usize,
) -> shx_result {
    // SAFETY: the caller's handle and place for capacity ids.
    unsafe {
        read("shx_solver_body_ids", solver, |core| {
            let places = OutputList::new("out_ids", "capacity", out_ids, capacity)?;
            places.write_all(core.body_ids().iter().map(|id| shx_body_id { bits: id.bits() }))
        })
    }
}

/// Moves count bodies smoothly to the given frames (SHX_FORMAT_FRAME, one per id) over the next over_seconds
/// of simulated time. 0: within the next substep. They sweep the space in between and push strands along. All
/// or none. Other bodies continue their motion or remain at rest.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a value that is not
/// finite, a quaternion that is not of unit length, negative over_seconds).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_body_frames(
    solver: *mut shx_solver,
    ids: *const shx_body_id,
    count: usize,
    frames: *const shx_input,
    over_seconds: f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and frames.
    unsafe {
        write("shx_solver_set_body_frames", solver, |core, _| {
            core.set_body_frames_of(count, body_frames(ids, count, frames)?, over_seconds)
        })
    }
}

/// Moves count bodies to the given frames at once, at rest,
/// without sweeping the space in between. All or none.
/// Errors: as shx_solver_set_body_frames.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_teleport_bodies(
    solver: *mut shx_solver,
    ids: *const shx_body_id,
    count: usize,
    frames: *const shx_input,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and frames.
    unsafe {
        write("shx_solver_teleport_bodies", solver, |core, _| core.teleport_bodies_of(count, body_frames(ids, count, frames)?))
    }
}

/// Writes the current frames of count bodies to frames
/// (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for the quaternions alone).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_body_frames(
    solver: *const shx_solver,
    ids: *const shx_body_id,
    count: usize,
    frames: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and memory for frames.
    unsafe {
        read("shx_solver_get_body_frames", solver, |core| {
            let ids = body_ids(ids, count)?;
            let writer = Writer::required("frames", frames, FRAME_FORMATS, count)?;
            let found = each(&ids, |id| core.body(id).map(|body| body.pose))?;
            for (index, frame) in found.iter().enumerate() {
                writer.frame(index, frame);
            }
            Ok(())
        })
    }
}

/// Moves the vertices of a mesh to new positions over the next over_seconds of simulated time (0: within the
/// next substep), each on a straight line at constant speed. vertices are in body axes, m (SHX_FORMAT_F32X3 or
/// _F64X3), as many as the mesh was created with. For deforming skin, call it once per frame.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (another count, a value
/// that is not finite, negative over_seconds), SHX_ERROR_UNSUPPORTED (the body is not a mesh).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_body_vertices(
    solver: *mut shx_solver,
    id: shx_body_id,
    vertices: *const shx_input,
    over_seconds: f64,
) -> shx_result {
    // SAFETY: the caller's handle and points.
    unsafe {
        write("shx_solver_set_body_vertices", solver, |core, _| {
            let vertices = points("vertices", vertices)?;
            core.set_body_vertices(BodyId::from_bits(id.bits), &vertices, over_seconds)
                .map_err(|error| error.renamed("body", "id"))
        })
    }
}

/// Sets thickness (m), friction_scale and viscous_friction_scale
/// of a body, as in shx_body_def; all zero or above.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_body_surface(
    solver: *mut shx_solver,
    id: shx_body_id,
    thickness: f64,
    friction_scale: f64,
    viscous_friction_scale: f64,
) -> shx_result {
    // SAFETY: the caller's handle, null or alive.
    unsafe {
        write("shx_solver_set_body_surface", solver, |core, _| {
            core.set_body_surface(BodyId::from_bits(id.bits), thickness, friction_scale, viscous_friction_scale)
                .map_err(in_words_of_c)
        })
    }
}

/// Sets the collision groups of a body and the groups that it
/// collides with, as in shx_body_def. Any bits are valid.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_body_filter(
    solver: *mut shx_solver,
    id: shx_body_id,
    groups: u32,
    mask: u32,
) -> shx_result {
    // SAFETY: the caller's handle, null or alive.
    unsafe {
        write("shx_solver_set_body_filter", solver, |core, _| core.set_body_filter(BodyId::from_bits(id.bits), groups, mask))
    }
}

/// Writes the wrench that strands exerted on each of count bodies in the last substep: force (N) and torque
/// about the body's origin (N m), in world axes. SHX_FORMAT_F32X3 or _F64X3; one of the two may be null.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_body_wrenches(
    solver: *const shx_solver,
    ids: *const shx_body_id,
    count: usize,
    forces: *const shx_output,
    torques: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handle, ids and memory for the outputs.
    unsafe {
        read("shx_solver_body_wrenches", solver, |core| {
            write_wrenches(forces, torques, array("ids", "count", ids, count)?, |id| core.body_wrench(BodyId::from_bits(id.bits)))
        })
    }
}

/// The caller's ids and frames, one by one.
///
/// # Safety
/// `ids` is null or has `count` items that outlive what is returned, and so has `frames`, null or a shx_input.
unsafe fn body_frames(
    ids: *const shx_body_id,
    count: usize,
    frames: *const shx_input,
) -> Result<impl Fn(usize) -> Result<(BodyId, Frame)>> {
    // SAFETY: the same.
    let (ids, frames) = unsafe { (array("ids", "count", ids, count)?, frames_reader(frames, count)?) };
    Ok(move |index: usize| Ok((BodyId::from_bits(ids[index].bits), frames.frame("frames", index)?)))
}
