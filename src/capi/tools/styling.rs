//! Styling: clips, scissors, hot plates and frozen styles.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use crate::capi::base::buffers::{OutputList, OutputValue, array, constraint_ids, frame_from, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::types::{shx_constraint_id, shx_frame, shx_strand_id};
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::capi::scene::constraints::{SHX_CONSTRAINT_DIRECTION, SHX_CONSTRAINT_FRAME, SHX_CONSTRAINT_POINT};
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::solver::constraints::Hold;
use crate::solver::shaping::clips::ClipDef;
use crate::solver::shaping::heating::{HeatDef, HeatedShape};

/// Definition of a clip. Fill it with shx_clip_def_init, then set pose and half_edges.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_clip_def {
    /// Set by shx_clip_def_init.
    pub struct_size: u32,
    /// SHX_CONSTRAINT_FRAME (default), _DIRECTION or _POINT: how it holds hair.
    pub kind: u32,
    /// Where it is, world. Default: at the origin, aligned with the world axes.
    pub pose: shx_frame,
    /// Half the edges of the box in which it holds hair, along its axes, m; above 0. Default 0.01
    /// each.
    pub half_edges: [f64; 3],
    /// As in shx_constraint_def. Default 0: rigid.
    pub compliance: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_clip_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            kind: SHX_CONSTRAINT_FRAME,
            pose: (&Frame::default()).into(),
            half_edges: [0.01; 3],
            compliance: 0.0,
        }
    }
}

const _: () = assert!(size_of::<shx_clip_def>() == 96 && offset_of!(shx_clip_def, half_edges) == 64);

impl shx_clip_def {
    fn clip(&self) -> Result<ClipDef> {
        let hold = match self.kind {
            SHX_CONSTRAINT_POINT => Hold::Point,
            SHX_CONSTRAINT_DIRECTION => Hold::Direction,
            SHX_CONSTRAINT_FRAME => Hold::Frame,
            other => {
                return Err(Error::invalid("def.kind", other, "SHX_CONSTRAINT_FRAME, _DIRECTION or _POINT"));
            }
        };
        let frame = self.pose.checked("def.pose")?;
        Ok(ClipDef { frame, half_edges: self.half_edges.into(), hold, compliance: self.compliance })
    }
}

/// Fills *def with defaults. size is sizeof(shx_clip_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_clip_def_init(def: *mut shx_clip_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_clip_def_init", "def", def, size) }
}

/// Closes a clip on count strands: each stretch of a strand inside the box is held, where it is, at its
/// middle. The clip is the constraints that this adds: their ids go to out_ids, which holds capacity ids,
/// their number to out_count. shx_solver_move_constraints moves the clip, shx_solver_remove_constraints opens
/// it. Nothing moves at once. Each strand may appear once.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT,
/// SHX_ERROR_BUFFER_TOO_SMALL (nothing is added then), SHX_ERROR_OUT_OF_MEMORY.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_clip_strands(
    solver: *mut shx_solver,
    def: *const shx_clip_def,
    ids: *const shx_strand_id,
    count: usize,
    out_ids: *mut shx_constraint_id,
    capacity: usize,
    out_count: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle, structure, count ids, and room for capacity ids and one number.
    unsafe {
        write("shx_solver_clip_strands", solver, |core, _| {
            let places = OutputList::new("out_ids", "capacity", out_ids, capacity)?;
            let made = OutputValue::new("out_count", out_count)?;
            let clip = read_versioned("def", def)?.clip()?;
            let defs = core
                .clip_constraints(&strand_ids(ids, count)?, &clip)
                .map_err(|error| error.renamed("clip", "def").renamed("def.frame", "def.pose"))?;
            places.check_room(defs.len())?;
            let ids = core.add_constraints(&defs)?;
            places.write_all(ids.iter().map(|id| shx_constraint_id { bits: id.bits() }))?;
            made.write(ids.len());
            Ok(())
        })
    }
}

/// Moves the targets of count constraints over the next over_seconds of simulated time as something rigid
/// that goes from frame `from` to frame `to`, for example a clip. 0: within the next substep. All or none.
/// Errors: as shx_solver_set_constraint_targets.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_move_constraints(
    solver: *mut shx_solver,
    ids: *const shx_constraint_id,
    count: usize,
    from: *const shx_frame,
    to: *const shx_frame,
    over_seconds: f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and two frames.
    unsafe {
        write("shx_solver_move_constraints", solver, |core, _| {
            let (from, to) = (frame_from("from", from)?, frame_from("to", to)?);
            core.move_constraints(&constraint_ids(ids, count)?, &from, &to, over_seconds)
        })
    }
}

/// A strand that was cut.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_cut {
    /// The strand.
    pub strand: shx_strand_id,
    /// Its length now, m.
    pub length: f64,
    /// Length of what was cut off, m.
    pub removed: f64,
    /// Where it was cut, m, world.
    pub position: [f64; 3],
    /// Number of constraints that held what was cut off: they are removed.
    pub removed_constraints: u64,
}

const _: () = assert!(size_of::<shx_cut>() == 56 && offset_of!(shx_cut, position) == 24);

/// Cuts those of count strands that cross a blade, a quad given by its corners in order (four points, m,
/// world), each at the crossing closest to its root, but no shorter than min_length (m, above 0). Shapes,
/// natural shapes and velocities of what is left stay exactly; nothing else moves. Constraints on what is cut
/// off are removed. Writes what was cut to out_cuts, which holds count items, in the order of ids, and their
/// number to out_count. Each strand may appear once.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
/// cbindgen:ptrs-as-arrays=[[corners; 12]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_scissor_strands(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    corners: *const f64,
    min_length: f64,
    out_cuts: *mut shx_cut,
    out_count: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle, count ids, twelve numbers, and room for count cuts and one number.
    unsafe {
        write("shx_solver_scissor_strands", solver, |core, _| {
            let places = OutputList::new("out_cuts", "count", out_cuts, count)?;
            let number = OutputValue::new("out_count", out_count)?;
            let corners: &[[f64; 3]] = array("corners", "corners", corners.cast::<[f64; 3]>(), 4)?;
            let corners: [Vector3<f64>; 4] = std::array::from_fn(|k| corners[k].into());
            let cuts = core.cut_across(&strand_ids(ids, count)?, &corners, min_length)?;
            let out: Vec<shx_cut> = cuts
                .iter()
                .map(|cut| shx_cut {
                    strand: shx_strand_id { bits: cut.strand.bits() },
                    length: cut.arclength,
                    removed: cut.removed,
                    position: cut.position.into(),
                    removed_constraints: cut.constraints.len() as u64,
                })
                .collect();
            places.write(&out)?;
            number.write(out.len());
            Ok(())
        })
    }
}

/// Heated hair becomes straight: a straightener.
pub const SHX_HEAT_STRAIGHT: u32 = 1;
/// Heated hair keeps the shape in which it is held: a curling iron.
pub const SHX_HEAT_PRESENT: u32 = 2;

/// Where hair is heated, and what it becomes. Fill it with shx_heat_def_init, then set pose and half_edges.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_heat_def {
    /// Set by shx_heat_def_init.
    pub struct_size: u32,
    /// SHX_HEAT_STRAIGHT (default) or _PRESENT.
    pub shape: u32,
    /// Where the hot box is, world. Default: at the origin, aligned with the world axes.
    pub pose: shx_frame,
    /// Half its edges along its axes, m; above 0: see shx_tool_hot_box. Default 0.01 each.
    pub half_edges: [f64; 3],
    /// Rate, 1/s; 0 or above: in a second the distance from the new natural shape falls to exp(-rate). Default
    /// 5.
    pub rate: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_heat_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            shape: SHX_HEAT_STRAIGHT,
            pose: (&Frame::default()).into(),
            half_edges: [0.01; 3],
            rate: 5.0,
        }
    }
}

const _: () = assert!(size_of::<shx_heat_def>() == 96 && offset_of!(shx_heat_def, half_edges) == 64);

/// Fills *def with defaults. size is sizeof(shx_heat_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_heat_def_init(def: *mut shx_heat_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_heat_def_init", "def", def, size) }
}

/// Heats count strands for `seconds`, usually once per step: inside the hot box natural twist and curvatures
/// approach those of the new natural shape. An element that lies in the box in part is slower accordingly.
/// Frozen curvatures stay. Nothing moves at once. Writes the length of each strand that was hot, m, to
/// out_heated: count numbers, or null. Each strand may appear once.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_heat_strands(
    solver: *mut shx_solver,
    def: *const shx_heat_def,
    ids: *const shx_strand_id,
    count: usize,
    seconds: f64,
    out_heated: *mut f64,
) -> shx_result {
    // SAFETY: the caller's handle, structure, count ids, and room for count numbers.
    unsafe {
        write("shx_solver_heat_strands", solver, |core, _| {
            let places = OutputList::optional("out_heated", "count", out_heated, count)?;
            let def = read_versioned("def", def)?;
            let shape = match def.shape {
                SHX_HEAT_STRAIGHT => HeatedShape::Straight,
                SHX_HEAT_PRESENT => HeatedShape::Present,
                other => return Err(Error::invalid("def.shape", other, "SHX_HEAT_STRAIGHT or _PRESENT")),
            };
            let frame = def.pose.checked("def.pose")?;
            let heat = HeatDef { frame, half_edges: def.half_edges.into(), shape, rate: def.rate };
            let hot = core
                .heat_strands(&strand_ids(ids, count)?, &heat, seconds)
                .map_err(|error| error.renamed("heat", "def").renamed("def.frame", "def.pose"))?;
            places.map_or(Ok(()), |places| places.write(&hot))
        })
    }
}

/// Fixes the style of count strands: their current shapes become rest shapes (see
/// shx_solver_adopt_rest_shapes), their velocities zero, and from now on they keep their shape, move with
/// their roots, and cost next to nothing. A frozen strand wakes in the substep in which a body comes closer
/// than 1 mm to it, or closer than it already was, and when a constraint holds it. Other strands do not touch
/// frozen ones. Awake and untouched it stays where it is. Strands that are frozen already stay as they are.
/// Each may appear once.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (also a strand that is
/// too limp for finite natural curvatures to hold it).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_freeze_strands(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_freeze_strands", solver, |core, _| core.freeze_strands(&strand_ids(ids, count)?)) }
}

/// Wakes count strands: they move again from the next step on, from their current shape, at rest relative to
/// their roots. Strands that are awake stay as they are.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_wake_strands(solver: *mut shx_solver, ids: *const shx_strand_id, count: usize) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_wake_strands", solver, |core, _| core.wake_strands(&strand_ids(ids, count)?)) }
}

/// Writes 1 for each of count strands that is frozen, else 0, to out_frozen, which holds count bytes.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_frozen_strands(
    solver: *const shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    out_frozen: *mut u8,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and room for count bytes.
    unsafe {
        read("shx_solver_frozen_strands", solver, |core| {
            let places = OutputList::new("out_frozen", "count", out_frozen, count)?;
            let frozen = core.are_frozen(&strand_ids(ids, count)?)?;
            places.write_all(frozen.into_iter().map(u8::from))
        })
    }
}
