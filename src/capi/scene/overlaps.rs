//! Overlaps of strands in the current scene, and permitted overlaps.

use crate::capi::base::buffers::{OutputList, OutputValue, array, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::types::{shx_body_id, shx_strand_id};

use crate::contact::permitted_overlap::PermittedOverlap;
use crate::error::Error;
use crate::solver::Overlap;
use crate::solver::id::StrandId;

/// The names of a permitted overlap's lists, and those of the calls' arguments.
const FIELDS: [(&str, &str); 3] = [("along", "arclengths"), ("wisp_fractions", "wisp_fractions"), ("sunk", "body_depths")];

/// Computes how deep count strands currently overlap other strands (if hair_contact is set) and bodies, beyond
/// their permitted overlap. Strands without contact overlap nothing; exempt lengths and filtered pairs do not
/// count. Changes nothing. Each output holds count values or is null.
/// out_hair_depths: largest overlap with a strand, m: the sum of the wisp radii minus
/// the distance of the centrelines; 0 if there is none.
/// out_strands: the strand of that overlap; null id if there is none.
/// out_body_depths: largest depth of the strand's surface in a body, m; 0 if there is none.
/// out_bodies: the body of that depth; null id if there is none.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_overlaps(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    out_hair_depths: *mut f64,
    out_strands: *mut shx_strand_id,
    out_body_depths: *mut f64,
    out_bodies: *mut shx_body_id,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and places for count values.
    unsafe {
        write("shx_solver_overlaps", solver, |core, _| {
            let ids = strand_ids(ids, count)?;
            let hair = OutputList::optional("out_hair_depths", "count", out_hair_depths, count)?;
            let strands = OutputList::optional("out_strands", "count", out_strands, count)?;
            let depths = OutputList::optional("out_body_depths", "count", out_body_depths, count)?;
            let bodies = OutputList::optional("out_bodies", "count", out_bodies, count)?;
            let found = core.overlaps(&ids)?;
            let list = |of: fn(&Overlap) -> f64| found.iter().map(of).collect::<Vec<f64>>();
            hair.map_or(Ok(()), |places| places.write(&list(|overlap| overlap.hair)))?;
            depths.map_or(Ok(()), |places| places.write(&list(|overlap| overlap.bodies)))?;
            let of_strands = found.iter().map(|overlap| shx_strand_id { bits: overlap.strand.map_or(0, |id| id.bits()) });
            strands.map_or(Ok(()), |places| places.write_all(of_strands))?;
            let of_bodies = found.iter().map(|overlap| shx_body_id { bits: overlap.body.map_or(0, |id| id.bits()) });
            bodies.map_or(Ok(()), |places| places.write_all(of_bodies))
        })
    }
}

/// Permits the current overlaps of count strands, so that no contact pushes while they stay as they are.
/// Together with shx_solver_adopt_rest_shapes it lets a groom rest as drawn, however its wisps and bodies
/// intersect. Where two wisps overlap, both keep the same fraction of their radii; if one of them is not among
/// ids, the other one gives way alone. Where a strand is inside a body, that depth is permitted. Both hold
/// along the whole element. Elsewhere strands collide as before. Replaces overlaps that were permitted before.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT (a strand that appears twice).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_permit_overlaps(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_permit_overlaps", solver, |core, _| core.allow_overlaps(&strand_ids(ids, count)?).map(|_| ())) }
}

/// Sets the permitted overlap of a strand at count points along it, linear in between and constant beyond the
/// first and the last. count 0 (the arrays may be null): none, as new strands have. To store a groom, save the
/// output of shx_solver_get_permitted_overlap; snapshots include it.
/// arclengths: positions of the points, m from the root; ascending, zero or above.
/// wisp_fractions: fraction of the wisp radius that remains at each point, 0 to 1.
/// body_depths: permitted depth of the strand's surface in a body at each point, m; zero or above.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT (the message names, say, "body_depths[2]").
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_permitted_overlap(
    solver: *mut shx_solver,
    id: shx_strand_id,
    arclengths: *const f64,
    wisp_fractions: *const f64,
    body_depths: *const f64,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and lists of count numbers.
    unsafe {
        write("shx_solver_set_permitted_overlap", solver, |core, _| {
            let list = |name, pointer| array::<f64>(name, "count", pointer, count).map(<[f64]>::to_vec);
            let permitted = PermittedOverlap {
                along: list("arclengths", arclengths)?,
                wisp_fractions: list("wisp_fractions", wisp_fractions)?,
                sunk: list("body_depths", body_depths)?,
            };
            let permitted = (count > 0).then_some(permitted);
            let in_words_of_the_call = |error: Error| match error {
                Error::InvalidId { bits, .. } => Error::InvalidId { argument: "id".into(), bits },
                other => other.renamed_in("permitted_overlaps[0].", "").with_fields(&FIELDS),
            };
            core.set_permitted_overlaps(&[StrandId::from_bits(id.bits)], &[permitted]).map_err(in_words_of_the_call)
        })
    }
}

/// Writes the permitted overlap of a strand, as shx_solver_set_permitted_overlap
/// takes it: the number of points to *out_count (0: none), and their values to the
/// arrays, which hold capacity numbers each or are null.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_permitted_overlap(
    solver: *const shx_solver,
    id: shx_strand_id,
    out_arclengths: *mut f64,
    out_wisp_fractions: *mut f64,
    out_body_depths: *mut f64,
    capacity: usize,
    out_count: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle, places for capacity numbers each and for one count.
    unsafe {
        read("shx_solver_get_permitted_overlap", solver, |core| {
            let along = OutputList::optional("out_arclengths", "capacity", out_arclengths, capacity)?;
            let wisp_fractions = OutputList::optional("out_wisp_fractions", "capacity", out_wisp_fractions, capacity)?;
            let sunk = OutputList::optional("out_body_depths", "capacity", out_body_depths, capacity)?;
            let count = OutputValue::new("out_count", out_count)?;
            let permitted = core.permitted_overlap(StrandId::from_bits(id.bits))?.cloned().unwrap_or_default();
            let lists = [(along, &permitted.along), (wisp_fractions, &permitted.wisp_fractions), (sunk, &permitted.sunk)];
            for (places, values) in &lists {
                places.as_ref().map_or(Ok(()), |places| places.check_room(values.len()))?;
            }
            for (places, values) in lists {
                places.map_or(Ok(()), |places| places.write(values))?;
            }
            count.write(permitted.along.len());
            Ok(())
        })
    }
}
