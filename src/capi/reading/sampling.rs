//! Samples strands: points, frames, velocities, and wrenches on follicles.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use super::output_transform::OutputTransform;
use super::sample_outputs::{OutputPlace, Outputs};
use super::wrenches::write_wrenches;
use crate::capi::base::buffers::{array, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver};
use crate::capi::base::types::{MAX_COUNT, shx_output, shx_strand_id};
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::error::{Error, Result, check_finite};
use crate::memory;
use crate::solver::Solver;
use crate::solver::id::StrandId;

/// How strands are sampled. Fill it with shx_sample_def_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_sample_def {
    /// Set by shx_sample_def_init.
    pub struct_size: u32,
    /// Points per strand, uniform in arclength, including root and tip; at least 2. Default 33.
    pub points_per_strand: u32,
    /// Subtracted from positions before they are rounded to floats, m. Default 0.
    pub origin: [f64; 3],
    /// What one metre along the world's x axis becomes in the outputs, for hosts with other units and axes. The
    /// three axes must be at right angles and of one length, that of your unit: a rotation with a scale, or a
    /// reflection with a scale for left-handed hosts. Positions become origin-relative positions times these
    /// axes, plus translation; velocities the same without translation; radii are scaled; frames turn along and
    /// tangents stay of unit length. Reflected frames keep n0 and n1 and reverse n2, since quaternions are
    /// rotations. Default (1, 0, 0). Centimetres with y up, from z up: (100, 0, 0), (0, 0, -100), (0, 100, 0).
    pub x_axis: [f64; 3],
    /// The same of the y axis. Default (0, 1, 0).
    pub y_axis: [f64; 3],
    /// The same of the z axis. Default (0, 0, 1).
    pub z_axis: [f64; 3],
    /// Added to positions at last, in your units. Default 0.
    pub translation: [f64; 3],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_sample_def {
    const FIRST_SIZE: usize = offset_of!(shx_sample_def, origin);

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            points_per_strand: 33,
            origin: [0.0; 3],
            x_axis: [1.0, 0.0, 0.0],
            y_axis: [0.0, 1.0, 0.0],
            z_axis: [0.0, 0.0, 1.0],
            translation: [0.0; 3],
        }
    }
}

const _: () = assert!(size_of::<shx_sample_def>() == 128 && offset_of!(shx_sample_def, x_axis) == 32);

/// Fills *def with defaults. size is sizeof(shx_sample_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_sample_def_init(def: *mut shx_sample_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_sample_def_init", "def", def, size) }
}

/// Samples count strands uniformly: item i * points_per_strand + j of each output is point j (0 is the root,
/// the last is the tip) of strand ids[i]. One call per frame suffices for everything you draw.
/// points: SHX_FORMAT_F32X3, _F32X4 (with the radius of the strand), _F64X3, _F64X4.
/// frames: SHX_FORMAT_FRAME; _F32X4 and _F64X4 for the quaternions alone; _F32X3 and _F64X3 for n0 alone, the
/// unit tangent towards the tip.
/// velocities of the material points, m/s: SHX_FORMAT_F32X3, _F64X3.
/// One or two of the three may be null. If no output holds doubles, the library computes in single precision
/// within an element, accurate to 1e-6 of the strand's length before rounding (measured: 2e-7). Calls for more
/// than about 1000 points run on the solver's threads (shx_solver_def.worker_count) or on parallel_for, with
/// identical bits. Several threads may sample at once; parallel_for is then called on each of them.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_sample_strands(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    def: *const shx_sample_def,
    points: *const shx_output,
    frames: *const shx_output,
    velocities: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handle, ids, structure and memory for the outputs.
    unsafe {
        read("shx_solver_sample_strands", solver, |core| {
            let def = read_versioned("def", def)?;
            let per_strand = def.points_per_strand as usize;
            if per_strand < 2 {
                return Err(Error::invalid("def.points_per_strand", per_strand, "at least 2: root and tip"));
            }
            let ids = strand_ids(ids, count)?;
            let needed = per_strand
                .checked_mul(count)
                .filter(|needed| *needed <= MAX_COUNT)
                .ok_or_else(|| Error::invalid("def.points_per_strand", per_strand, "fewer points per call"))?;
            let place = def.place("def")?;
            let outputs = Outputs::new(points, frames, velocities, needed, place)?;
            // All ids are checked before the first point is written.
            outputs.bulk(core, &ids, per_strand)
        })
    }
}

impl shx_sample_def {
    /// The checked origin and axes of outputs.
    fn place(&self, argument: &str) -> Result<OutputPlace> {
        let origin = origin(&format!("{argument}.origin"), self.origin)?;
        let transform = OutputTransform::new(argument, [self.x_axis, self.y_axis, self.z_axis], self.translation)?;
        Ok(OutputPlace { origin, transform })
    }
}

fn origin(argument: &str, origin: [f64; 3]) -> Result<Vector3<f64>> {
    for axis in 0..3 {
        check_finite(|| format!("{argument}[{axis}]"), origin[axis])?;
    }
    Ok(Vector3::from(origin))
}

/// Samples one strand at count arclengths from the root (m, 0 to the length of the strand, in any order): item
/// i of each output belongs to arclengths[i]. origin (three doubles, m) is subtracted from positions; null: 0.
/// The outputs are those of shx_solver_sample_strands.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (an
/// arclength outside the strand), SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
/// cbindgen:ptrs-as-arrays=[[origin; 3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_sample_at(
    solver: *const shx_solver,
    id: shx_strand_id,
    arclengths: *const f64,
    count: usize,
    origin: *const f64,
    points: *const shx_output,
    frames: *const shx_output,
    velocities: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handle, arclengths, origin and memory for the outputs.
    unsafe {
        read("shx_solver_sample_at", solver, |core| {
            let id = StrandId::from_bits(id.bits);
            let arclengths = array("arclengths", "count", arclengths, count)?;
            let origin = if origin.is_null() {
                Vector3::zeros()
            } else {
                let numbers = array("origin", "origin", origin, 3)?;
                self::origin("origin", [numbers[0], numbers[1], numbers[2]])?
            };
            let outputs = Outputs::new(points, frames, velocities, count, OutputPlace { origin, transform: None })?;
            sample(core, id, arclengths, &outputs)
        })
    }
}

fn sample(core: &Solver, id: StrandId, arclengths: &[f64], outputs: &Outputs) -> Result<()> {
    let radius = core.radius(id)?;
    // Collected first: an arclength out of range must leave the outputs unchanged.
    let mut samples = memory::list(arclengths.len())?;
    core.sample_at(id, arclengths, |index, sample| samples.push((index, *sample)))?;
    for (index, sample) in &samples {
        outputs.write(*index, sample, radius);
    }
    Ok(())
}

/// Does the same as shx_solver_sample_at, with the origin and the axes of def; its points_per_strand is
/// ignored.
/// Errors: as shx_solver_sample_at; SHX_ERROR_STRUCT_SIZE.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_sample_at_with(
    solver: *const shx_solver,
    id: shx_strand_id,
    arclengths: *const f64,
    count: usize,
    def: *const shx_sample_def,
    points: *const shx_output,
    frames: *const shx_output,
    velocities: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handle, arclengths, structure and memory for the outputs.
    unsafe {
        read("shx_solver_sample_at_with", solver, |core| {
            let arclengths = array("arclengths", "count", arclengths, count)?;
            let place = read_versioned("def", def)?.place("def")?;
            let outputs = Outputs::new(points, frames, velocities, count, place)?;
            sample(core, StrandId::from_bits(id.bits), arclengths, &outputs)
        })
    }
}

/// Writes the wrench that each of count strands exerts on its follicle as of the last step: force (N) and
/// torque about the root's origin (N m), in world axes. At rest the force is the weight of the strand.
/// SHX_FORMAT_F32X3 or _F64X3; one of the two may be null.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_root_wrenches(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    forces: *const shx_output,
    torques: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handle, ids and memory for the outputs.
    unsafe {
        read("shx_solver_root_wrenches", solver, |core| {
            write_wrenches(forces, torques, array("ids", "count", ids, count)?, |id| {
                core.root_wrench(StrandId::from_bits(id.bits))
            })
        })
    }
}
