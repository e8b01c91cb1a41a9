//! Styling tools: their bodies, from a few numbers.

use std::mem::{offset_of, size_of};

use crate::capi::base::buffers::{OutputList, OutputValue, frame_from};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{call, shx_solver, write};
use crate::capi::base::types::{shx_body_id, shx_frame};
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::error::{Error, Result};
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

/// Fills *def with defaults. size is sizeof(shx_tool_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_tool_def_init(def: *mut shx_tool_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
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
                OutputList::optional("out_frames", "capacity", out_frames, capacity)?,
                OutputValue::new("out_count", out_count)?,
            )
        };
        let frames = def.tool()?.frames(&frame, opening)?;
        if let Some(places) = places {
            places.write_all(frames.iter().map(shx_frame::from))?;
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
            unsafe { (read_versioned("def", def)?, OutputValue::new("out_half_edges", out_half_edges.cast::<[f64; 3]>())?) };
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
            let places = OutputList::new("out_ids", "capacity", out_ids, capacity)?;
            let count = OutputValue::new("out_count", out_count)?;
            let (tool, frame) = (read_versioned("def", def)?.tool()?, frame_from("frame", frame)?);
            places.check_room(tool.body_count())?;
            let ids = core.add_bodies(tool.bodies(&frame, opening)?)?;
            places.write_all(ids.iter().map(|id| shx_body_id { bits: id.bits() }))?;
            count.write(ids.len());
            Ok(())
        })
    }
}
