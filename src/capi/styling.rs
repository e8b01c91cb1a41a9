//! Styling: the bodies of tools, clips, scissors, hot plates, and styles that are fixed.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use super::buffers::{Place, Places, array, constraint_ids, strand_ids};
use super::constraints::{SHX_CONSTRAINT_DIRECTION, SHX_CONSTRAINT_FRAME, SHX_CONSTRAINT_POINT};
use super::errors::shx_result;
use super::guard::{call, read, shx_solver, write};
use super::types::{shx_body_id, shx_constraint_id, shx_frame, shx_strand_id};
use super::versioned::{Versioned, initialise, read_versioned};
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::solver::clips::ClipDef;
use crate::solver::constraints::Hold;
use crate::solver::heating::{HeatDef, HeatedShape};
use crate::styling::Tool;

/// A row of teeth along the x axis of the tool that point along its z axis; one body per tooth.
pub const SHX_TOOL_COMB: u32 = 1;
/// Rows of bristles, one row after another along the y axis; one body per bristle.
pub const SHX_TOOL_BRUSH: u32 = 2;
/// A finger along the z axis.
pub const SHX_TOOL_FINGER: u32 = 3;
/// The two plates of a straightener, on both sides of the tool's origin along the y axis.
pub const SHX_TOOL_PLATES: u32 = 4;
/// The barrel of a curling iron, along the x axis.
pub const SHX_TOOL_BARREL: u32 = 5;

/// Definition of a tool: bodies from a few numbers. Fill it with shx_tool_def_init, then set kind and what
/// you need. Where a number is 0, that of the kind is used.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_tool_def {
    /// Set by shx_tool_def_init.
    pub struct_size: u32,
    /// SHX_TOOL_COMB (default), _BRUSH, _FINGER, _PLATES or _BARREL.
    pub kind: u32,
    /// Comb: number of teeth (12). Brush: bristles in a row (10). At most 1000.
    pub tooth_count: u32,
    /// Brush: number of rows (4), at most 1000.
    pub row_count: u32,
    /// Comb (0.0025) and brush (0.004): distance from axis to axis in a row, m.
    pub spacing: f64,
    /// Brush: distance from row to row, m (0.005).
    pub row_spacing: f64,
    /// Length of a tooth (0.03), bristle (0.015), finger (0.07) or barrel (0.12), or depth of the plates along
    /// the z axis, the way that hair passes (0.025), m.
    pub length: f64,
    /// Radius of a tooth or bristle (0.0005), finger (0.008) or barrel (0.0125), m.
    pub radius: f64,
    /// Plates: width along the x axis, m (0.09).
    pub width: f64,
    /// Plates: thickness of each, m (0.004).
    pub thickness: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_tool_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            kind: SHX_TOOL_COMB,
            tooth_count: 0,
            row_count: 0,
            spacing: 0.0,
            row_spacing: 0.0,
            length: 0.0,
            radius: 0.0,
            width: 0.0,
            thickness: 0.0,
        }
    }
}

const _: () = assert!(size_of::<shx_tool_def>() == 64 && offset_of!(shx_tool_def, spacing) == 16);

impl shx_tool_def {
    pub(super) fn tool(&self) -> Result<Tool> {
        let given = |value: f64, own: f64| if value == 0.0 { own } else { value };
        let count = |value: u32, own: u32| if value == 0 { own } else { value };
        let own = match self.kind {
            SHX_TOOL_COMB => Tool::COMB,
            SHX_TOOL_BRUSH => Tool::BRUSH,
            SHX_TOOL_FINGER => Tool::FINGER,
            SHX_TOOL_PLATES => Tool::PLATES,
            SHX_TOOL_BARREL => Tool::BARREL,
            other => return Err(Error::invalid("def.kind", other, "one of SHX_TOOL_")),
        };
        let tool = match own {
            Tool::Comb { teeth, spacing, length, radius } => Tool::Comb {
                teeth: count(self.tooth_count, teeth),
                spacing: given(self.spacing, spacing),
                length: given(self.length, length),
                radius: given(self.radius, radius),
            },
            Tool::Brush { bristles, rows, spacing, row_spacing, length, radius } => Tool::Brush {
                bristles: count(self.tooth_count, bristles),
                rows: count(self.row_count, rows),
                spacing: given(self.spacing, spacing),
                row_spacing: given(self.row_spacing, row_spacing),
                length: given(self.length, length),
                radius: given(self.radius, radius),
            },
            Tool::Finger { length, radius } => {
                Tool::Finger { length: given(self.length, length), radius: given(self.radius, radius) }
            }
            Tool::Plates { width, depth, thickness } => Tool::Plates {
                width: given(self.width, width),
                depth: given(self.length, depth),
                thickness: given(self.thickness, thickness),
            },
            Tool::Barrel { length, radius } => {
                Tool::Barrel { length: given(self.length, length), radius: given(self.radius, radius) }
            }
        };
        tool.check("def")?;
        Ok(tool)
    }
}

/// # Safety
/// `frame` is null or points to a frame.
pub(super) unsafe fn frame_from(argument: &str, frame: *const shx_frame) -> Result<Frame> {
    // SAFETY: the same.
    let frame = unsafe { &array(argument, argument, frame, 1)?[0] };
    Frame::from_arrays(argument, frame.origin, frame.rotation)
}

/// Fills *def with defaults. size is sizeof(shx_tool_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_tool_def_init(def: *mut shx_tool_def, size: usize) -> shx_result {
    // SAFETY: the caller says that def holds size bytes.
    unsafe { initialise("shx_tool_def_init", "def", def, size) }
}

/// Writes where the bodies of a tool are when it is at frame to out_frames, which holds capacity frames, in
/// the order of shx_solver_add_tool, and their number to out_count: pass them to shx_solver_set_body_frames
/// to move the tool. opening: distance between the faces of plates, m, 0 or above; other tools ignore it.
/// out_frames may be null if you need the number only.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT,
/// SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_tool_frames(
    def: *const shx_tool_def,
    frame: *const shx_frame,
    opening: f64,
    out_frames: *mut shx_frame,
    capacity: usize,
    out_count: *mut usize,
) -> shx_result {
    call("shx_tool_frames", || {
        // SAFETY: the caller's structures, and room for capacity frames and one number.
        let (def, frame, places, count) = unsafe {
            (
                read_versioned("def", def)?,
                frame_from("frame", frame)?,
                Places::optional("out_frames", "capacity", out_frames, capacity)?,
                Place::new("out_count", out_count)?,
            )
        };
        let frames = def.tool()?.frames(&frame, opening)?;
        if let Some(places) = places {
            places.write(&frames.iter().map(shx_frame::from).collect::<Vec<_>>())?;
        }
        count.write(frames.len());
        Ok(())
    })
}

/// Writes half the edges, m, along the axes of the tool, of the box about its origin in which plates or a
/// barrel heat hair: see shx_heat_def. opening: as in shx_tool_frames.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_UNSUPPORTED
/// (a tool that is not hot).
/// Threads: any.
/// cbindgen:ptrs-as-arrays=[[out_half_edges; 3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_tool_hot_box(def: *const shx_tool_def, opening: f64, out_half_edges: *mut f64) -> shx_result {
    call("shx_tool_hot_box", || {
        // SAFETY: the caller's structure, and room for three numbers.
        let (def, place) =
            unsafe { (read_versioned("def", def)?, Place::new("out_half_edges", out_half_edges.cast::<[f64; 3]>())?) };
        crate::error::check_not_negative(|| "opening".into(), opening)?;
        let Some((_, half_edges)) = def.tool()?.hot_box(opening) else {
            let hint = "take SHX_TOOL_PLATES or SHX_TOOL_BARREL".into();
            return Err(Error::Unsupported { argument: "def.kind".into(), value: def.kind.to_string(), hint });
        };
        place.write(half_edges.into());
        Ok(())
    })
}

/// Adds the bodies of a tool at frame and writes their ids to out_ids, which holds capacity ids, and their
/// number to out_count (see shx_tool_frames). They are ordinary bodies: move them together, give them to
/// shx_haptic_create, or remove them. opening: as in shx_tool_frames.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT,
/// SHX_ERROR_BUFFER_TOO_SMALL, SHX_ERROR_OUT_OF_MEMORY.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_add_tool(
    solver: *mut shx_solver,
    def: *const shx_tool_def,
    frame: *const shx_frame,
    opening: f64,
    out_ids: *mut shx_body_id,
    capacity: usize,
    out_count: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle, structures, and room for capacity ids and one number.
    unsafe {
        write("shx_solver_add_tool", solver, |core, _| {
            let places = Places::new("out_ids", "capacity", out_ids, capacity)?;
            let count = Place::new("out_count", out_count)?;
            let (tool, frame) = (read_versioned("def", def)?.tool()?, frame_from("frame", frame)?);
            places.check_room(tool.body_count())?;
            let ids = core.add_bodies(tool.bodies(&frame, opening)?)?;
            places.write(&ids.iter().map(|id| shx_body_id { bits: id.bits() }).collect::<Vec<_>>())?;
            count.write(ids.len());
            Ok(())
        })
    }
}

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
        let frame = Frame::from_arrays("def.pose", self.pose.origin, self.pose.rotation)?;
        Ok(ClipDef { frame, half_edges: self.half_edges.into(), hold, compliance: self.compliance })
    }
}

/// Fills *def with defaults. size is sizeof(shx_clip_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_clip_def_init(def: *mut shx_clip_def, size: usize) -> shx_result {
    // SAFETY: the caller says that def holds size bytes.
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
            let places = Places::new("out_ids", "capacity", out_ids, capacity)?;
            let made = Place::new("out_count", out_count)?;
            let clip = read_versioned("def", def)?.clip()?;
            let defs = core
                .clip_constraints(&strand_ids(ids, count)?, &clip)
                .map_err(|error| error.renamed("clip", "def").renamed("def.frame", "def.pose"))?;
            places.check_room(defs.len())?;
            let ids = core.add_constraints(&defs)?;
            places.write(&ids.iter().map(|id| shx_constraint_id { bits: id.bits() }).collect::<Vec<_>>())?;
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
            let places = Places::new("out_cuts", "count", out_cuts, count)?;
            let number = Place::new("out_count", out_count)?;
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
    // SAFETY: the caller says that def holds size bytes.
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
            let places = Places::optional("out_heated", "count", out_heated, count)?;
            let def = read_versioned("def", def)?;
            let shape = match def.shape {
                SHX_HEAT_STRAIGHT => HeatedShape::Straight,
                SHX_HEAT_PRESENT => HeatedShape::Present,
                other => return Err(Error::invalid("def.shape", other, "SHX_HEAT_STRAIGHT or _PRESENT")),
            };
            let frame = Frame::from_arrays("def.pose", def.pose.origin, def.pose.rotation)?;
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
            let places = Places::new("out_frozen", "count", out_frozen, count)?;
            let frozen = core.are_frozen(&strand_ids(ids, count)?)?;
            places.write(&frozen.into_iter().map(u8::from).collect::<Vec<_>>())
        })
    }
}
