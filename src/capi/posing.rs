//! Living strands posed: dragged, brushed, an element changed, cut, grown, mirrored.

use nalgebra::Vector3;

use super::buffers::{Places, Reader, VECTOR_FORMATS, array, strand_ids};
use super::errors::shx_result;
use super::guard::{shx_solver, write};
use super::pose_def::{read_brush, read_options, shx_brush, shx_element_change, shx_pose_options};
use super::types::{shx_input, shx_strand_id};
use super::versioned::definitions;
use crate::error::{Error, Result};
use crate::groom::pose::{DragTarget, Growth, Plane};

/// Drags a point of each of count strands to a target: the point at arclengths[i] (m from the root, above 0) to item i of targets
/// (SHX_FORMAT_F32X3, _F64X3; world, m; count items). Roots, lengths and natural shapes stay. Among the shapes that bring the point
/// there one near the present shape is taken (options.natural_pull: near the natural one), bent as the strand's stiffness bends it. A
/// target out of reach is approached; one within a body counts as the nearest place of its surface. The strands are at rest then,
/// relative to their roots, and quarantines are cleared. Gravity, constraints and other strands are not looked at:
/// shx_solver_adopt_rest_shapes makes the pose one that stays. options: null for the defaults. out_distances: how far each point is
/// from its target, m; count numbers, or null. Each strand may be named once. The work is shared among the solver's workers; the
/// results' bits do not depend on them.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Alone with the solver.
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
            let distances = Places::optional("out_distances", "count", out_distances, count)?;
            let ids = strand_ids(ids, count)?;
            let arclengths = array("arclengths", "count", arclengths, count)?;
            let positions = Reader::new("targets", targets, VECTOR_FORMATS)?;
            if positions.count() != count {
                return Err(Error::invalid("targets.count", positions.count(), format!("{count}, one a strand")));
            }
            let target =
                |(k, arclength): (usize, &f64)| DragTarget { arclength: *arclength, position: positions.point(k).into() };
            let targets: Vec<DragTarget> = arclengths.iter().enumerate().map(target).collect();
            let found = core.drag(&ids, &targets, &read_options(options)?).map_err(of_arclength)?;
            if let Some(distances) = distances {
                distances.write(&found.iter().map(|found| found.distance).collect::<Vec<_>>())?;
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

/// Moves a brush over count strands: the points that lie in it before it moves are to follow it, by the brush's falloff; strands bend, by
/// least squares, roots and lengths stay. Strands with no point in the brush are left alone to the bit, velocities included; the others
/// are at rest then, as after shx_solver_drag_strands, which says what is kept out of. options: null for the defaults. out_touched: 1
/// for each strand with a point in the brush, else 0; out_distances: the root mean square distance of each strand's points in the brush
/// from where they were to go, m. Each holds count items or is null. Each strand may be named once. The work is shared among the
/// solver's workers; the results' bits do not depend on them.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_brush_strands(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    brush: *const shx_brush,
    options: *const shx_pose_options,
    out_touched: *mut u8,
    out_distances: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, structures and memory for count items each.
    unsafe {
        write("shx_solver_brush_strands", solver, |core, _| {
            let touched = Places::optional("out_touched", "count", out_touched, count)?;
            let distances = Places::optional("out_distances", "count", out_distances, count)?;
            let ids = strand_ids(ids, count)?;
            let found = core.brush(&ids, &read_brush(brush)?, &read_options(options)?)?;
            if let Some(touched) = touched {
                touched.write(&found.iter().map(|found| u8::from(found.touched)).collect::<Vec<_>>())?;
            }
            if let Some(distances) = distances {
                distances.write(&found.iter().map(|found| found.distance).collect::<Vec<_>>())?;
            }
            Ok(())
        })
    }
}

/// Changes an element of each of count strands: twists, bends and lengthens it; what lies beyond goes along as it is. Change i begins i *
/// def_stride bytes after the first (def_stride: sizeof(shx_element_change)). Twist and bending act on the present shape, the length on
/// the natural one as well. The strands are at rest then, relative to their roots. Each strand may be named once.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (also a frozen freedom, and
/// a strand that a constraint would hold beyond its new length). Alone with the solver.
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

/// Cuts count strands, strand i at arclengths[i] (m from the root, above 0, at most its length), at any moment of a run: what is left keeps
/// its shape, its natural shape and its velocities exactly. The element that is cut is shorter, of the same helix; elements beyond are
/// gone. Each strand may be named once.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (also a strand that a constraint holds beyond the
/// cut). Alone with the solver.
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

/// Lets count strands grow at their tips by length (m, above 0), at any moment of a run: what was there keeps shape and velocities, and what
/// is new moves with the tip. element_count elements are added, all equally long; 0: the last one becomes longer. curvatures: three
/// doubles, rad/m, of the added elements and their natural shape; null: those of the last one, so that the helix goes on (and null where
/// element_count is 0). Each strand may be named once.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
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

/// Adds the images of count strands in a mirror, the plane through point across normal (three doubles each; normal of any length above
/// zero): shape, natural shape and velocities as they are now, curls the other way round; material, contact and user_data are copied.
/// The images' roots stay where they are until they are moved. out_ids receives count ids, in the order of ids.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_OUT_OF_MEMORY. Alone with the solver.
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
            let places = Places::new("out_ids", "count", out_ids, count)?;
            let plane = Plane::new(Vector3::from(three("point", point)?), Vector3::from(three("normal", normal)?))?;
            let made = core.add_mirrored(&strand_ids(ids, count)?, &plane)?;
            places.write(&made.iter().map(|id| shx_strand_id { bits: id.bits() }).collect::<Vec<_>>())
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
