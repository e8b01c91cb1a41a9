//! Targets: curves to which strands are drawn, with a weight along their length.

use std::mem::size_of;

use nalgebra::Vector3;

use crate::capi::base::buffers::{OutputList, POINT_FORMATS, Reader, array, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::types::{shx_input, shx_strand_id};
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::capi::simulation::solver_def::check_reserved;
use crate::error::{Error, Result};
use crate::memory;
use crate::rod::target::definition::TargetDef;

/// Curves to which strands are drawn. Fill it with shx_target_def_init, then set curve_count and points. The
/// library reads the arrays during the call only.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_target_def {
    /// Set by shx_target_def_init.
    pub struct_size: u32,
    /// Number of keys of the weight; at least 1 where weights is set. Default 0.
    pub weight_count: u32,
    /// Number of curves: one per id. Default 0: set it.
    pub curve_count: usize,
    /// Points of all curves, curve by curve, root first, m, world: SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4 (a
    /// fourth number is ignored). At least two per curve; straight in between.
    pub points: shx_input,
    /// Number of points of each curve: curve_count numbers that sum to points.count. Null (default): all curves
    /// have equally many.
    pub point_counts: *const u32,
    /// Arclength of the strand's point that belongs to each point of the curves, m; 0 or above, strictly
    /// ascending along each curve. Parts of a strand before its first and beyond its last are free. Null
    /// (default): in proportion to the curve's length, so that the tip belongs to the last point.
    pub arclengths: *const f64,
    /// Positions of the keys on every strand, from 0 (root) to 1 (tip), strictly ascending; weight_count
    /// numbers. Default null: set it with weights.
    pub weight_positions: *const f64,
    /// Weight at each key, 0 (free) to 1 (on the curve); linear between keys, constant beyond them. Default
    /// null: from 1 at the root to 0 at the tip.
    pub weights: *const f64,
    /// Factor of each strand's weights, 0 to 1: curve_count numbers. Null (default): 1.
    pub strand_weights: *const f64,
    /// Time constant with which a point of weight 0.5 comes to its place, s; above 0. Weight w has the time
    /// constant time_constant * (1 - w) / w. Default 0.1.
    pub time_constant: f64,
    /// Must be 0.
    pub reserved: [u64; 4],
}

const NO_INPUT: shx_input = shx_input { data: std::ptr::null(), stride: 0, count: 0, format: 0, reserved: 0 };

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, a double and pointers only.
unsafe impl Versioned for shx_target_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            weight_count: 0,
            curve_count: 0,
            points: NO_INPUT,
            point_counts: std::ptr::null(),
            arclengths: std::ptr::null(),
            weight_positions: std::ptr::null(),
            weights: std::ptr::null(),
            strand_weights: std::ptr::null(),
            time_constant: TargetDef::default().time_constant,
            reserved: [0; 4],
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_target_def>() == 128 && std::mem::offset_of!(shx_target_def, point_counts) == 48);
    assert!(std::mem::offset_of!(shx_target_def, time_constant) == 88);
};

/// Fills *def with defaults. size is sizeof(shx_target_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_target_def_init(def: *mut shx_target_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_target_def_init", "def", def, size) }
}

/// What a definition gives for all strands.
struct Targets {
    points: Vec<Vector3<f64>>,
    /// The first point of each strand, and the number of all.
    starts: Vec<usize>,
    arclengths: Option<Vec<f64>>,
    /// The keys of each strand, or of all.
    keys: Vec<Vec<[f64; 2]>>,
}

impl Targets {
    /// # Safety
    /// The arrays of `def` are those of `count` strands.
    unsafe fn read(def: &shx_target_def, count: usize) -> Result<Self> {
        check_reserved("def", &def.reserved)?;
        if def.curve_count != count {
            return Err(Error::invalid("def.curve_count", def.curve_count, format!("{count}, one for each id")));
        }
        // SAFETY: the caller's input.
        let reader = unsafe { Reader::new("def.points", &raw const def.points, POINT_FORMATS)? };
        let total = reader.count();
        let mut starts = memory::list(count.saturating_add(1))?;
        starts.push(0);
        if def.point_counts.is_null() {
            if count == 0 && total > 0 || count > 0 && total % count != 0 {
                let expected = format!("as many for each of {count} curves, without def.point_counts");
                return Err(Error::invalid("def.points.count", total, expected));
            }
            starts.extend((1..=count).map(|k| k * (total / count)));
        } else {
            // SAFETY: the caller's count numbers.
            let counts = unsafe { array("def.point_counts", "def.curve_count", def.point_counts, count)? };
            let mut end = 0_usize;
            for points in counts {
                end = end.saturating_add(*points as usize);
                starts.push(end);
            }
            if end != total {
                let expected = format!("{total}, the number of points (def.points.count)");
                return Err(Error::invalid("def.point_counts", format!("a sum of {end}"), expected));
            }
        }
        let points = memory::collected((0..total).map(|index| Vector3::from(reader.point(index))))?;
        let arclengths = if def.arclengths.is_null() {
            None
        } else {
            // SAFETY: the caller's number for each point.
            Some(memory::copied(unsafe { array("def.arclengths", "def.points.count", def.arclengths, total)? })?)
        };
        // SAFETY: the caller's keys and factors.
        let keys = unsafe { Self::keys(def, count)? };
        Ok(Self { points, starts, arclengths, keys })
    }

    /// # Safety
    /// As [`Targets::read`].
    unsafe fn keys(def: &shx_target_def, count: usize) -> Result<Vec<Vec<[f64; 2]>>> {
        let keys = if def.weights.is_null() && def.weight_positions.is_null() && def.weight_count == 0 {
            TargetDef::default().weights.to_vec()
        } else {
            let keys = def.weight_count as usize;
            if keys == 0 {
                return Err(Error::invalid("def.weight_count", 0, "1 or above where there are weights"));
            }
            // SAFETY: the caller's weight_count numbers each.
            let (positions, weights) = unsafe {
                let positions = array("def.weight_positions", "def.weight_count", def.weight_positions, keys)?;
                (positions, array("def.weights", "def.weight_count", def.weights, keys)?)
            };
            memory::collected(positions.iter().zip(weights).map(|(position, weight)| [*position, *weight]))?
        };
        if def.strand_weights.is_null() {
            return Ok(vec![keys]);
        }
        // SAFETY: the caller's count numbers.
        let factors = unsafe { array("def.strand_weights", "def.curve_count", def.strand_weights, count)? };
        let mut all = memory::list(count)?;
        for (k, factor) in factors.iter().enumerate() {
            if !(0.0..=1.0).contains(factor) {
                return Err(Error::invalid(format!("def.strand_weights[{k}]"), factor, "0 to 1"));
            }
            let own = keys.iter().map(|[position, weight]| [*position, weight * factor]);
            all.push(memory::collected(own)?);
        }
        Ok(all)
    }

    /// The definition of each strand.
    fn defs(&self, time_constant: f64) -> Result<Vec<TargetDef<'_>>> {
        let strands = self.starts.windows(2).enumerate().map(|(k, ends)| TargetDef {
            points: &self.points[ends[0]..ends[1]],
            arclengths: self.arclengths.as_ref().map(|arclengths| &arclengths[ends[0]..ends[1]]),
            weights: self.keys.get(k).unwrap_or(&self.keys[0]),
            time_constant,
        });
        memory::collected(strands.collect::<Vec<_>>().into_iter())
    }
}

/// The engine's error, with the names of the C structure, whose arrays go through all strands.
fn in_words_of_c(error: Error, starts: &[usize]) -> Error {
    let Error::InvalidArgument { argument, value, expected } = error else { return error };
    let renamed = argument.strip_prefix("targets[").and_then(|rest| {
        let (strand, field) = rest.split_once("].")?;
        let start = *starts.get(strand.parse::<usize>().ok()?)?;
        let (name, indices) = field.split_at(field.find('[').unwrap_or(field.len()));
        let numbers: Vec<usize> = indices.split(['[', ']']).filter_map(|number| number.parse().ok()).collect();
        Some(match (name, &numbers[..]) {
            ("points", [point, axis]) => format!("def.points[{}][{axis}]", start + point),
            ("arclengths", [point]) => format!("def.arclengths[{}]", start + point),
            ("weights", [key, 1]) => format!("def.weights[{key}]"),
            ("weights", [key, ..]) => format!("def.weight_positions[{key}]"),
            _ => format!("def.{name} of strand {strand}"),
        })
    });
    Error::InvalidArgument { argument: renamed.unwrap_or(argument), value, expected }
}

/// Draws count strands to curves: an artist's rig, for example. Call it once per frame before the step, with
/// the curves as they are at the end of that step: the target of a strand moves there from where it is,
/// smoothly like a root (shx_solver_set_root_frames), over the next over_seconds of simulated time. 0: within
/// the next substep. A strand's first target is there at once. A target that is not set again stays where it
/// has arrived. At weight 1 a strand is on its curve within a step, as well as its length and its number of
/// elements permit; at weight 0 it is free, to the bit; in between it is drawn with a time constant, without
/// overshoot, against weight, stiffness and contact. Stable for every weight and step. Roots do not move: set
/// their frames as ever. Frozen strands do not follow. Snapshots contain targets. SHX_INTEGRATOR_REFERENCE
/// refuses to step then.
/// All or none.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_OUT_OF_MEMORY.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_targets(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    def: *const shx_target_def,
    over_seconds: f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids, and a structure with arrays for that many strands.
    unsafe {
        write("shx_solver_set_targets", solver, |core, _| {
            let def = read_versioned("def", def)?;
            let ids = strand_ids(ids, count)?;
            crate::error::check_positive(|| "def.time_constant".into(), def.time_constant)?;
            let targets = Targets::read(&def, count)?;
            let result = core.set_targets(&ids, &targets.defs(def.time_constant)?, over_seconds);
            result.map_err(|error| in_words_of_c(error, &targets.starts))
        })
    }
}

/// Lets count strands go: nothing draws them any more. Strands without a target stay as they are. All or none.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_clear_targets(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_clear_targets", solver, |core, _| core.clear_targets(&strand_ids(ids, count)?)) }
}

/// Writes how far count strands are from their targets to out_distances, which holds count values, m: the root
/// mean square over the length of a strand, where each point counts by its weight. -1 for a strand without a
/// target, or with one that draws no part of it.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_target_distances(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    out_distances: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and room for count values.
    unsafe {
        read("shx_solver_target_distances", solver, |core| {
            let ids = strand_ids(ids, count)?;
            let places = OutputList::new("out_distances", "count", out_distances, count)?;
            let distances = core.target_distances(&ids)?;
            places.write_all(distances.into_iter().map(|distance| distance.unwrap_or(-1.0)))
        })
    }
}
