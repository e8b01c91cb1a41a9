//! Definitions and options of posing, for the functions of `posing.rs`.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use crate::capi::base::buffers::array;
use crate::capi::base::errors::shx_result;
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::capi::simulation::solver_def::{check_flag, check_reserved};
use crate::error::{Error, Result};
use crate::groom::pose::{Brush, ElementChange, PoseOptions};

/// Options of dragging and brushing. Fill it with shx_pose_options_init, then change what you need.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_pose_options {
    /// Set by shx_pose_options_init.
    pub struct_size: u32,
    /// 1: the direction of the strand at its tip stays. Default 0.
    pub keep_tip_direction: u32,
    /// 1 (default): strands stay out of the solver's bodies, and leave those that they are in. The groups of
    /// shx_strand_contact decide which; strands without contact avoid all bodies. 0: bodies are ignored.
    pub avoid_bodies: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Which shape to stay close to: 0 (default) the current one, 1 the natural one, in between a blend.
    pub natural_pull: f64,
    /// Distance that strands keep from bodies, beyond both thicknesses, m; zero or above. Default 0.
    pub clearance: f64,
    /// Which elements may change: 1 or 0 for each element of each strand of the call, strand by strand. The
    /// others keep their curvatures to the bit. Null (default): all may change.
    pub movable: *const u8,
    /// Number of items of movable: the total number of elements of the strands. Ignored if movable is null.
    pub movable_count: usize,
    /// Must be 0.
    pub reserved: [u64; 4],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles and a pointer only.
unsafe impl Versioned for shx_pose_options {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let options = PoseOptions::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            keep_tip_direction: u32::from(options.keep_tip_direction),
            avoid_bodies: u32::from(options.keep_out),
            reserved0: 0,
            natural_pull: options.natural_pull,
            clearance: options.clearance,
            movable: std::ptr::null(),
            movable_count: 0,
            reserved: [0; 4],
        }
    }
}

/// A sphere that moves and takes along the points inside it. Fill
/// it with shx_brush_init, then set at least radius.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_brush {
    /// Set by shx_brush_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Centre before the movement, world, m. Default 0.
    pub centre: [f64; 3],
    /// Radius, m; above zero. Default 0: set it.
    pub radius: f64,
    /// A point at distance d from the centre follows the fraction (1 - d^2/radius^2)^falloff of the
    /// displacement. Zero or above; 0: all points follow fully. Default 1.
    pub falloff: f64,
    /// Displacement of the sphere, m. Default 0.
    pub displacement: [f64; 3],
    /// Must be 0.
    pub reserved: [u64; 2],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_brush {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved0: 0,
            centre: [0.0; 3],
            radius: 0.0,
            falloff: 1.0,
            displacement: [0.0; 3],
            reserved: [0; 2],
        }
    }
}

/// A change of one element of a strand. Fill it with shx_element_change_init, then change what you need.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_element_change {
    /// Set by shx_element_change_init.
    pub struct_size: u32,
    /// Index of the element, from 0 at the root. Default 0.
    pub element: u32,
    /// Additional twist of the end of the element about the strand, rad. Default 0.
    pub twist: f64,
    /// Additional rotation of the end of the element about n1 and n2, rad. Default 0.
    pub bend: [f64; 2],
    /// Factor on the length of the element; above zero. Default 1.
    pub length_scale: f64,
    /// 1 (default): the element keeps its curvatures when its length changes, so the helix
    /// continues. 0: it keeps the angles by which it turns.
    pub keep_curvature: u32,
    /// Must be 0.
    pub reserved: u32,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_element_change {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let change = ElementChange::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            element: 0,
            twist: change.twist,
            bend: change.bend,
            length_scale: change.stretch,
            keep_curvature: u32::from(change.keep_curvature),
            reserved: 0,
        }
    }
}

const _: () = {
    assert!(size_of::<shx_brush>() == 88 && offset_of!(shx_brush, radius) == 32 && offset_of!(shx_brush, reserved) == 72);
    assert!(size_of::<shx_element_change>() == 48 && offset_of!(shx_element_change, keep_curvature) == 40);
};

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<shx_pose_options>() == 80 && offset_of!(shx_pose_options, movable) == 32);

/// The options of a call; the defaults for null.
///
/// # Safety
/// `options` is null or points to a structure of the size that it states, and what that points to is there.
pub(super) unsafe fn read_options(options: *const shx_pose_options) -> Result<PoseOptions> {
    if options.is_null() {
        return Ok(PoseOptions::default());
    }
    // SAFETY: the same.
    let options = unsafe { read_versioned("options", options)? };
    if options.reserved0 != 0 {
        return Err(Error::invalid("options.reserved0", options.reserved0, "0"));
    }
    check_reserved("options", &options.reserved)?;
    let mut movable = None;
    if !options.movable.is_null() {
        // SAFETY: the same.
        let given = unsafe { array("options.movable", "options.movable_count", options.movable, options.movable_count)? };
        if let Some(element) = given.iter().position(|flag| *flag > 1) {
            return Err(Error::invalid(format!("options.movable[{element}]"), given[element], "0 or 1"));
        }
        movable = Some(given.iter().map(|flag| *flag == 1).collect());
    }
    Ok(PoseOptions {
        movable,
        natural_pull: options.natural_pull,
        keep_tip_direction: check_flag("options.keep_tip_direction", options.keep_tip_direction)?,
        keep_out: check_flag("options.avoid_bodies", options.avoid_bodies)?,
        clearance: options.clearance,
    })
}

/// A brush.
///
/// # Safety
/// `brush` is null or points to a structure of the size that it states.
pub(super) unsafe fn read_brush(brush: *const shx_brush) -> Result<Brush> {
    // SAFETY: the same.
    let brush = unsafe { read_versioned("brush", brush)? };
    if brush.reserved0 != 0 {
        return Err(Error::invalid("brush.reserved0", brush.reserved0, "0"));
    }
    check_reserved("brush", &brush.reserved)?;
    Ok(Brush {
        centre: Vector3::from(brush.centre),
        radius: brush.radius,
        falloff: brush.falloff,
        movement: Vector3::from(brush.displacement),
    })
}

impl shx_element_change {
    /// Which element, and the engine's own change.
    pub(super) fn change(&self, argument: &str) -> Result<(usize, ElementChange)> {
        if self.reserved != 0 {
            return Err(Error::invalid(format!("{argument}.reserved"), self.reserved, "0"));
        }
        let change = ElementChange {
            twist: self.twist,
            bend: self.bend,
            stretch: self.length_scale,
            keep_curvature: check_flag(&format!("{argument}.keep_curvature"), self.keep_curvature)?,
        };
        change.check(argument).map_err(|error| error.with_fields(&[("stretch", "length_scale")]))?;
        Ok((self.element as usize, change))
    }
}

/// Fills *options with defaults. size is sizeof(shx_pose_options).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_pose_options_init(options: *mut shx_pose_options, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that options holds size bytes.
    unsafe { initialise("shx_pose_options_init", "options", options, size) }
}

/// Fills *brush with defaults. size is sizeof(shx_brush).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_brush_init(brush: *mut shx_brush, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that brush holds size bytes.
    unsafe { initialise("shx_brush_init", "brush", brush, size) }
}

/// Fills *change with defaults. size is sizeof(shx_element_change).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_element_change_init(change: *mut shx_element_change, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that change holds size bytes.
    unsafe { initialise("shx_element_change_init", "change", change, size) }
}
