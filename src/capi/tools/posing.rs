//! Poses simulated strands: drag, brush, change elements, cut, grow, mirror.

use nalgebra::Vector3;

use super::pose_def::{read_brush, read_options, shx_brush, shx_element_change, shx_pose_options};
use crate::capi::base::buffers::{OutputList, Reader, VECTOR_FORMATS, array, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{shx_solver, write};
use crate::capi::base::types::{shx_input, shx_strand_id};
use crate::capi::base::versioned::definitions;
use crate::error::{Error, Result};
use crate::groom::pose::{DragTarget, Growth, Plane};

/// Drags a point of each of count strands to a target: the point at arclengths[i] (m from the root, above 0)
/// to item i of targets (count items; SHX_FORMAT_F32X3, _F64X3; world, m). Roots, lengths and natural shapes
/// stay. Of the shapes that reach the target it takes one close to the current shape (see natural_pull), bent
/// as the stiffness of the strand bends it. A target that is out of reach is approached; a target inside a
/// body counts as the closest point on its surface. Afterwards the strands are at rest relative to their roots
/// and released from quarantine. Gravity, constraints and other strands are ignored: call
/// shx_solver_adopt_rest_shapes to keep the pose. options may be null (defaults). Writes the remaining
/// distance of each point from its target, m, to out_distances: count numbers, or null. Each strand may appear
/// once. The work runs on the solver's workers; results do not depend on their number.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_drag_strands(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    arclengths: *const f64,
    targets: *const shx_input,
    options: *const shx_pose_options,
    out_distances: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, structures and memory for count items each.
    unsafe {
        write("shx_solver_drag_strands", solver, |core, _| {
            let distances = OutputList::optional("out_distances", "count", out_distances, count)?;
            let ids = strand_ids(ids, count)?;
            let arclengths = array("arclengths", "count", arclengths, count)?;
            let positions = Reader::new("targets", targets, VECTOR_FORMATS)?;
            if positions.count() != count {
                return Err(Error::invalid("targets.count", positions.count(), format!("{count}, one per strand")));
            }
            let target =
                |(k, arclength): (usize, &f64)| DragTarget { arclength: *arclength, position: positions.point(k).into() };
            let targets: Vec<DragTarget> = arclengths.iter().enumerate().map(target).collect();
            let found = core.drag(&ids, &targets, &read_options(options)?).map_err(of_arclength)?;
            if let Some(distances) = distances {
                distances.write_all(found.iter().map(|found| found.distance))?;
            }
            Ok(())
        })
    }
}

/// The names of a target's two parts are those of this call's arguments.
fn of_arclength(error: Error) -> Error {
    match error {
        Error::InvalidArgument { argument, value, expected } => {
            let argument = match argument.strip_suffix(".arclength") {
                Some(target) => target.replacen("targets", "arclengths", 1),
                None => argument.replacen(".position", "", 1),
            };
            Error::InvalidArgument { argument, value, expected }
        }
        other => other,
    }
}

/// Moves a brush over count strands. Points inside the brush before the movement follow it
/// according to its falloff; the strands bend in the least-squares sense, roots and lengths stay.
/// Strands without a point in the brush stay unchanged to the bit, velocities included; the others
/// are at rest afterwards and avoid bodies as in shx_solver_drag_strands. options may be null
/// (defaults). Each output holds count items or is null.
/// out_brushed: 1 for strands with a point in the brush, else 0.
/// out_distances: RMS distance of the strand's points in the brush from where they should be, m.
/// Each strand may appear once. The work runs on the solver's workers; results do not depend on their number.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_brush_strands(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    brush: *const shx_brush,
    options: *const shx_pose_options,
    out_brushed: *mut u8,
    out_distances: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, structures and memory for count items each.
    unsafe {
        write("shx_solver_brush_strands", solver, |core, _| {
            let touched = OutputList::optional("out_brushed", "count", out_brushed, count)?;
            let distances = OutputList::optional("out_distances", "count", out_distances, count)?;
            let ids = strand_ids(ids, count)?;
            let found = core
                .brush(&ids, &read_brush(brush)?, &read_options(options)?)
                .map_err(|error| error.with_fields(&[("movement", "displacement")]))?;
            if let Some(touched) = touched {
                touched.write_all(found.iter().map(|found| u8::from(found.touched)))?;
            }
            if let Some(distances) = distances {
                distances.write_all(found.iter().map(|found| found.distance))?;
            }
            Ok(())
        })
    }
}

/// Changes one element of each of count strands: twists, bends and lengthens it. The rest of the strand moves
/// rigidly with its end. Change i starts i * def_stride bytes after the first; def_stride is usually
/// sizeof(shx_element_change). Twist and bend change the current shape, length_scale the natural shape as
/// well. Afterwards the strands are at rest relative to their roots. Each strand may appear once.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT
/// (also a frozen curvature, and a strand with a constraint beyond its new length).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_change_elements(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    defs: *const shx_element_change,
    def_stride: usize,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and structures.
    unsafe {
        write("shx_solver_change_elements", solver, |core, _| {
            let ids = strand_ids(ids, count)?;
            let read = |def: &shx_element_change, argument: &str| def.change(argument);
            let changes = definitions("shx_element_change", defs, def_stride, count, read)?;
            let (elements, changes): (Vec<_>, Vec<_>) = changes.into_iter().unzip();
            core.change_elements(&ids, &elements, &changes).map_err(of_defs)
        })
    }
}

/// The engine's lists are this call's definitions.
fn of_defs(error: Error) -> Error {
    match error {
        Error::InvalidArgument { argument, value, expected } => {
            let argument = match argument.strip_prefix("elements[") {
                Some(rest) => format!("defs[{rest}.element"),
                None => argument.replacen("changes", "defs", 1),
            };
            Error::InvalidArgument { argument, value, expected }
        }
        other => other,
    }
}

/// Cuts count strands, strand i at arclengths[i] (m from the root, above 0, at most its length), at any time
/// during a simulation. The rest keeps its shape, natural shape and velocities exactly. The element at the cut
/// becomes shorter and keeps its helix; elements beyond are removed. Each strand may appear once. All or none:
/// the message names the index and the id of the strand that cannot be cut.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT
/// (an arclength beyond the strand's length, a strand with a constraint beyond the cut).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_cut_strands(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    arclengths: *const f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and numbers.
    unsafe {
        write("shx_solver_cut_strands", solver, |core, _| {
            let ids = strand_ids(ids, count)?;
            core.cut(&ids, array("arclengths", "count", arclengths, count)?)
        })
    }
}

/// Extends count strands at their tips by length (m, above 0), at any time during a simulation. The existing
/// part keeps its shape and velocities; the new part moves with the tip. Adds element_count elements of equal
/// length; 0: the last element becomes longer. curvatures: three doubles, rad/m, the initial and natural
/// curvatures of the new elements. Null: those of the last element, so the helix continues; it must be null
/// if element_count is 0. Each strand may appear once.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_grow_strands(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    length: f64,
    element_count: u32,
    curvatures: *const f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and three numbers.
    unsafe {
        write("shx_solver_grow_strands", solver, |core, _| {
            let ids = strand_ids(ids, count)?;
            let curvatures = if curvatures.is_null() { None } else { Some(three("curvatures", curvatures)?) };
            let growth = Growth { length, elements: element_count as usize, curvatures };
            core.grow(&ids, &growth).map_err(|error| error.renamed("growth.elements", "element_count").renamed("growth.", ""))
        })
    }
}

/// Adds mirror images of count strands, across the plane through point with the given normal (three doubles
/// each; normal of any length above zero). Shape, natural shape and velocities are mirrored as they are now,
/// so curls turn the other way; material, contact and user_data are copied. The roots of the images are at
/// rest until you move them. Writes count ids to out_ids, in the order of ids.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_OUT_OF_MEMORY.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_mirror_strands(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    point: *const f64,
    normal: *const f64,
    out_ids: *mut shx_strand_id,
) -> shx_result {
    // SAFETY: the caller's handle, count ids, three numbers twice and place for count ids.
    unsafe {
        write("shx_solver_mirror_strands", solver, |core, _| {
            let places = OutputList::new("out_ids", "count", out_ids, count)?;
            let plane = Plane::new(Vector3::from(three("point", point)?), Vector3::from(three("normal", normal)?))?;
            let made = core.add_mirrored(&strand_ids(ids, count)?, &plane)?;
            places.write_all(made.iter().map(|id| shx_strand_id { bits: id.bits() }))
        })
    }
}

/// Three numbers.
///
/// # Safety
/// `data` is null or points to three numbers.
unsafe fn three(argument: &str, data: *const f64) -> Result<[f64; 3]> {
    // SAFETY: the same.
    let values = unsafe { array(argument, argument, data, 3)? };
    Ok([values[0], values[1], values[2]])
}
