//! What strands overlap as they are, and having it allowed.

use super::buffers::{Place, Places, array, strand_ids};
use super::errors::shx_result;
use super::guard::{read, shx_solver, write};
use super::types::{shx_body_id, shx_strand_id};
use nalgebra::Vector3;

use crate::contact::allowance::Allowance;
use crate::error::Error;
use crate::groom::outside::BroughtOut;
use crate::solver::Overlap;
use crate::solver::id::{BodyId, StrandId};

/// How deep count strands are in others (where the contact options' hair is set) and in bodies as they are now, less what they are allowed.
/// Strands without contact overlap nothing; what is exempt or filtered out does not count. Moves nothing. Each output holds count values
/// or is null:
/// out_hair_depths: m, what the distance of the centrelines lacks to the sum of the wisps' radii where that is most; 0: in none.
/// out_strands: the strand that it is deepest in; bits 0: none.
/// out_body_depths: m, how deep the strand's surface is in a body where that is most; 0: in none.
/// out_bodies: the body that it is deepest in; bits 0: none.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
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
            let hair = Places::optional("out_hair_depths", "count", out_hair_depths, count)?;
            let strands = Places::optional("out_strands", "count", out_strands, count)?;
            let depths = Places::optional("out_body_depths", "count", out_body_depths, count)?;
            let bodies = Places::optional("out_bodies", "count", out_bodies, count)?;
            let found = core.overlaps(&ids)?;
            let list = |of: fn(&Overlap) -> f64| found.iter().map(of).collect::<Vec<f64>>();
            hair.map_or(Ok(()), |places| places.write(&list(|overlap| overlap.hair)))?;
            depths.map_or(Ok(()), |places| places.write(&list(|overlap| overlap.bodies)))?;
            let of_strands = found.iter().map(|overlap| shx_strand_id { bits: overlap.strand.map_or(0, |id| id.bits()) });
            strands.map_or(Ok(()), |places| places.write(&of_strands.collect::<Vec<_>>()))?;
            let of_bodies = found.iter().map(|overlap| shx_body_id { bits: overlap.body.map_or(0, |id| id.bits()) });
            bodies.map_or(Ok(()), |places| places.write(&of_bodies.collect::<Vec<_>>()))
        })
    }
}

/// Allows count strands what they overlap now, so that no touch presses as long as they stay as they are: with
/// shx_solver_take_rest_shapes the groom as it stands is at rest, however its wisps and bodies were drawn into each other. Where two
/// wisps overlap both keep the same share of their radii (of a strand that is not among ids the other one keeps what is left), where a
/// strand is in a body it may be as deep there; to either side as far as the element goes. What was allowed before is forgotten. Away
/// from these places strands touch as before.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a strand named twice). Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_allow_overlaps(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_allow_overlaps", solver, |core, _| core.allow_overlaps(&strand_ids(ids, count)?).map(|_| ())) }
}

/// Says what a strand may overlap, at station_count stations along it, linear between them and constant beyond the first and the last;
/// station_count 0 (the lists may be null then): nothing, which is how strands begin. A host that stores a groom keeps what
/// shx_solver_get_allowance gave for this; snapshots hold it.
/// along: arclengths of the stations from the root, m, rising, the first zero or above.
/// wisp_shares: what is left of the wisp's radius at each, 0 to 1.
/// sunk: how far the strand's surface may be in a body at each, m, zero or above.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (the text names "sunk[2]"). Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_allowance(
    solver: *mut shx_solver,
    id: shx_strand_id,
    along: *const f64,
    wisp_shares: *const f64,
    sunk: *const f64,
    station_count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and lists of station_count numbers.
    unsafe {
        write("shx_solver_set_allowance", solver, |core, _| {
            let list = |name, pointer| array::<f64>(name, "station_count", pointer, station_count).map(<[f64]>::to_vec);
            let allowance = Allowance {
                along: list("along", along)?,
                wisp_shares: list("wisp_shares", wisp_shares)?,
                sunk: list("sunk", sunk)?,
            };
            let allowance = (station_count > 0).then_some(allowance);
            let in_words_of_the_call = |error: Error| match error {
                Error::InvalidId { bits, .. } => Error::InvalidId { argument: "id".into(), bits },
                other => other.renamed_in("allowances[0].", ""),
            };
            core.set_allowances(&[StrandId::from_bits(id.bits)], &[allowance]).map_err(in_words_of_the_call)
        })
    }
}

/// What a strand may overlap, as shx_solver_set_allowance takes it: the number of its stations into *out_station_count (0: nothing), and
/// their values into the lists, which hold capacity numbers each or are null.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. May run beside other
/// reading calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_allowance(
    solver: *const shx_solver,
    id: shx_strand_id,
    out_along: *mut f64,
    out_wisp_shares: *mut f64,
    out_sunk: *mut f64,
    capacity: usize,
    out_station_count: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle, places for capacity numbers each and for one count.
    unsafe {
        read("shx_solver_get_allowance", solver, |core| {
            let along = Places::optional("out_along", "capacity", out_along, capacity)?;
            let wisp_shares = Places::optional("out_wisp_shares", "capacity", out_wisp_shares, capacity)?;
            let sunk = Places::optional("out_sunk", "capacity", out_sunk, capacity)?;
            let count = Place::new("out_station_count", out_station_count)?;
            let allowance = core.allowance(StrandId::from_bits(id.bits))?.cloned().unwrap_or_default();
            let lists = [(along, &allowance.along), (wisp_shares, &allowance.wisp_shares), (sunk, &allowance.sunk)];
            for (places, values) in &lists {
                places.as_ref().map_or(Ok(()), |places| places.check_room(values.len()))?;
            }
            for (places, values) in lists {
                places.map_or(Ok(()), |places| places.write(values))?;
            }
            count.write(allowance.along.len());
            Ok(())
        })
    }
}

/// Brings curves that are drawn inside a body out of it, where it is now, by the least that does: before strands are fitted to them. points: world,
/// m, three doubles a point, changed in place; curve after curve, counts[i] points of curve i, count curves. Every point comes to at least clearance
/// (m, 0 or above) from the surface; roots stay, and after one that is inside the curve may be as deep as a way out at one in two needs; edges keep
/// their lengths. A curve that is clear is not touched, nor is one that would have to be moved by more than twice its depth and 5 mm. Each output
/// holds count values or is null:
/// out_depths: m, how deep in the body the deepest point was that was too near; 0: none was in it.
/// out_moved: m, how far a point was moved at most.
/// out_stuck: 1 where no way out was found, and the curve is as it was; else 0.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Then no point has moved. Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_bring_out_curves(
    solver: *mut shx_solver,
    body: shx_body_id,
    clearance: f64,
    counts: *const u32,
    count: usize,
    points: *mut f64,
    out_depths: *mut f64,
    out_moved: *mut f64,
    out_stuck: *mut u32,
) -> shx_result {
    // SAFETY: the caller's handle, count counts, three doubles a point, and places for count values.
    unsafe {
        write("shx_solver_bring_out_curves", solver, |core, _| {
            let counts: Vec<usize> = array("counts", "count", counts, count)?.iter().map(|count| *count as usize).collect();
            let numbers = counts.iter().try_fold(0usize, |sum, count| sum.checked_add(*count)).and_then(|sum| sum.checked_mul(3));
            let numbers = numbers.ok_or_else(|| Error::invalid("counts", "more than can be", "counts of points in memory"))?;
            let mut moved: Vec<Vector3<f64>> = array("points", "counts", points.cast_const(), numbers)?
                .chunks_exact(3)
                .map(Vector3::from_column_slice)
                .collect();
            let depths = Places::optional("out_depths", "count", out_depths, count)?;
            let farthest = Places::optional("out_moved", "count", out_moved, count)?;
            let stuck = Places::optional("out_stuck", "count", out_stuck, count)?;
            let brought = core.bring_out(BodyId::from_bits(body.bits), clearance, &counts, &mut moved)?;
            Places::new("points", "counts", points, numbers)?.write(&moved.iter().flatten().copied().collect::<Vec<_>>())?;
            let list = |of: fn(&BroughtOut) -> f64| brought.iter().map(of).collect::<Vec<f64>>();
            depths.map_or(Ok(()), |places| places.write(&list(|brought| brought.deepest)))?;
            farthest.map_or(Ok(()), |places| places.write(&list(|brought| brought.moved)))?;
            stuck.map_or(Ok(()), |places| {
                places.write(&brought.iter().map(|brought| u32::from(brought.stuck)).collect::<Vec<_>>())
            })
        })
    }
}
