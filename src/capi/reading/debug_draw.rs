//! Debug drawing by callback.

use std::ffi::c_void;
use std::mem::size_of;

use nalgebra::Vector3;

use super::output_transform::OutputTransform;
use crate::capi::base::errors::shx_result;
use crate::capi::base::floating_point::with_host_mode;
use crate::capi::base::guard::{read, shx_solver};
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::error::{Error, Result, check_finite};
use crate::solver::reading::debug_draw::{DEBUG_BATCH, DebugCanvas, DebugDraw, DebugVertex};

/// Centrelines of strands: beige if the last substep converged, orange if it did not, red if the strand is
/// quarantined, blue if it is frozen.
pub const SHX_DEBUG_CENTRELINES: u32 = 1;
/// Material frames at the root and at the end of every element: tangent red, first normal green, second
/// normal blue.
pub const SHX_DEBUG_FRAMES: u32 = 2;
/// Contacts of the last substep: a point and the normal (yellow), and the force on the strand (magenta).
pub const SHX_DEBUG_CONTACTS: u32 = 4;
/// Centrelines coloured by island, instead of SHX_DEBUG_CENTRELINES: strands that contacts or ties couple
/// share a colour; strands alone are grey.
pub const SHX_DEBUG_ISLANDS: u32 = 8;
/// Outlines of bodies, green: circles of round shapes, edges of boxes, hulls and meshes, a square of 1 m and
/// the normal of a half-space. Of a distance grid the box around its nodes.
pub const SHX_DEBUG_BODIES: u32 = 16;
/// Constraints: a point on the strand and a line to its target (cyan), and the force on the strand (magenta).
pub const SHX_DEBUG_CONSTRAINTS: u32 = 32;

/// A point, or an end of a line.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_debug_vertex {
    /// In the space of shx_debug_draw_def.
    pub position: [f64; 3],
    /// 0xRRGGBB.
    pub color: u32,
    /// The layer that it belongs to: SHX_DEBUG_.
    pub layer: u32,
}

/// Receives a batch of count vertices, at most 1024: for lines, pairs. They are valid during the call only. It
/// runs on the thread that called the library, in that thread's floating-point mode. It may read the same
/// solver but not change it (SHX_ERROR_BUSY), and it must return normally: no exceptions, no longjmp.
pub type shx_debug_vertices_fn = Option<unsafe extern "C" fn(user: *mut c_void, vertices: *const shx_debug_vertex, count: usize)>;

/// What shx_solver_debug_draw draws, and where it goes. Fill it with shx_debug_draw_def_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_debug_draw_def {
    /// Set by shx_debug_draw_def_init.
    pub struct_size: u32,
    /// SHX_DEBUG_ bits. Default centrelines, contacts and bodies.
    pub layers: u32,
    /// Points of a centreline, 2 to 4096. Default 17.
    pub points_per_strand: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Length of the axes of a material frame, m; above zero. Default 0.005.
    pub frame_length: f64,
    /// Length of the normal of a contact, m; above zero. Default 0.005.
    pub normal_length: f64,
    /// Length of a force of 1 N, m/N; 0: forces are not drawn. Default 100.
    pub force_scale: f64,
    /// Subtracted from positions, m. Default 0.
    pub origin: [f64; 3],
    /// The space of the vertices, as in shx_sample_def. Default (1, 0, 0).
    pub x_axis: [f64; 3],
    /// The same of the y axis. Default (0, 1, 0).
    pub y_axis: [f64; 3],
    /// The same of the z axis. Default (0, 0, 1).
    pub z_axis: [f64; 3],
    /// Added to positions at last, in your units. Default 0.
    pub translation: [f64; 3],
    /// Receives lines, two vertices each. Null: lines are not drawn.
    pub lines: shx_debug_vertices_fn,
    /// Receives points. Null: points are not drawn.
    pub points: shx_debug_vertices_fn,
    /// User pointer of lines and points.
    pub user: *mut c_void,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles, pointers and nullable functions only.
unsafe impl Versioned for shx_debug_draw_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let options = DebugDraw::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            layers: options.layers,
            points_per_strand: options.points_per_strand,
            reserved: 0,
            frame_length: options.frame_length,
            normal_length: options.normal_length,
            force_scale: options.force_scale,
            origin: [0.0; 3],
            x_axis: [1.0, 0.0, 0.0],
            y_axis: [0.0, 1.0, 0.0],
            z_axis: [0.0, 0.0, 1.0],
            translation: [0.0; 3],
            lines: None,
            points: None,
            user: std::ptr::null_mut(),
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    use std::mem::offset_of;
    assert!(size_of::<shx_debug_vertex>() == 32 && offset_of!(shx_debug_vertex, color) == 24);
    assert!(size_of::<shx_debug_draw_def>() == 184 && offset_of!(shx_debug_draw_def, lines) == 160);
};

/// Fills *def with defaults. size is sizeof(shx_debug_draw_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_debug_draw_def_init(def: *mut shx_debug_draw_def, size: usize) -> shx_result {
    // SAFETY: the caller says that def holds size bytes.
    unsafe { initialise("shx_debug_draw_def_init", "def", def, size) }
}

/// Hands batches to the host.
struct HostCanvas {
    lines: shx_debug_vertices_fn,
    points: shx_debug_vertices_fn,
    user: *mut c_void,
    origin: Vector3<f64>,
    transform: Option<OutputTransform>,
    batch: Vec<shx_debug_vertex>,
}

impl HostCanvas {
    fn hand_over(&mut self, function: shx_debug_vertices_fn, vertices: &[DebugVertex]) {
        let Some(function) = function else { return };
        self.batch.clear();
        self.batch.extend(vertices.iter().map(|vertex| {
            let position = (vertex.position - self.origin).into();
            let position = self.transform.as_ref().map_or(position, |transform| transform.point(position));
            shx_debug_vertex { position, color: vertex.colour, layer: vertex.layer as u32 }
        }));
        // SAFETY: the host's function, called as its type says; the batch outlives the call.
        with_host_mode(|| unsafe { function(self.user, self.batch.as_ptr(), self.batch.len()) });
    }
}

impl DebugCanvas for HostCanvas {
    fn lines(&mut self, vertices: &[DebugVertex]) {
        self.hand_over(self.lines, vertices);
    }

    fn points(&mut self, vertices: &[DebugVertex]) {
        self.hand_over(self.points, vertices);
    }
}

impl shx_debug_draw_def {
    fn options(&self) -> Result<DebugDraw> {
        if self.reserved != 0 {
            return Err(Error::invalid("def.reserved", self.reserved, "0"));
        }
        let options = DebugDraw {
            layers: self.layers,
            points_per_strand: self.points_per_strand,
            frame_length: self.frame_length,
            normal_length: self.normal_length,
            force_scale: self.force_scale,
        };
        options.check("def")?;
        Ok(options)
    }

    fn canvas(&self) -> Result<HostCanvas> {
        if self.lines.is_none() && self.points.is_none() {
            return Err(Error::NullArgument { argument: "def.lines".into() });
        }
        for axis in 0..3 {
            check_finite(|| format!("def.origin[{axis}]"), self.origin[axis])?;
        }
        Ok(HostCanvas {
            lines: self.lines,
            points: self.points,
            user: self.user,
            origin: Vector3::from(self.origin),
            transform: OutputTransform::new("def", [self.x_axis, self.y_axis, self.z_axis], self.translation)?,
            batch: Vec::with_capacity(DEBUG_BATCH),
        })
    }
}

/// Draws what the solver knows as of the last step through your callbacks: coloured lines and points, in
/// batches, not one by one. Changes nothing; needs memory for one batch, and with SHX_DEBUG_ISLANDS 5 bytes
/// a strand. The order of the vertices does not depend on the number of threads.
/// Errors: SHX_ERROR_NULL_ARGUMENT (also if lines and points are both null), SHX_ERROR_STRUCT_SIZE,
/// SHX_ERROR_INVALID_ARGUMENT. Nothing is drawn then.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_debug_draw(solver: *const shx_solver, def: *const shx_debug_draw_def) -> shx_result {
    // SAFETY: the caller's handle and structure, of the size that it states.
    unsafe {
        read("shx_solver_debug_draw", solver, |core| {
            let def = read_versioned("def", def)?;
            let options = def.options()?;
            core.debug_draw(&options, &mut def.canvas()?)
        })
    }
}
