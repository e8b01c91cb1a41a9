//! Suggests a number of elements for a strand.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use crate::analysis::elements::{Demand, RootMotion, Suggestion, suggest_elements};
use crate::capi::base::buffers::array;
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::thread::on_own_thread;
use crate::capi::base::types::shx_frame;
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::capi::hair::strand_def::shx_strand_def;
use crate::error::Result;

/// Options of shx_suggest_elements. Fill it with shx_suggest_def_init, then change what you need.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_suggest_def {
    /// Set by shx_suggest_def_init.
    pub struct_size: u32,
    /// Maximum number of elements, 1 to 1000. Default 100.
    pub max_elements: u32,
    /// Allowed error, m; above zero. At rest: of the point with the largest error. In
    /// motion: RMS over time and arclength. Default 1e-3.
    pub tolerance: f64,
    /// Gravity, m/s^2. Default (0, 0, -9.81).
    pub gravity: [f64; 3],
    /// Motion of the root: motion_count frames, motion_interval seconds apart. The strand starts at rest in the
    /// first and takes a step to each of the others. Null (default): only the error at rest counts.
    pub motion: *const shx_frame,
    /// Number of frames of motion: 0 (default), or at least 2.
    pub motion_count: u64,
    /// Time between frames of motion, s; 1e-9 or more. Default 1/60.
    pub motion_interval: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles and a pointer only.
unsafe impl Versioned for shx_suggest_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let demand = Demand::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            max_elements: demand.max_elements as u32,
            tolerance: demand.tolerance,
            gravity: demand.gravity.into(),
            motion: std::ptr::null(),
            motion_count: 0,
            motion_interval: 1.0 / 60.0,
        }
    }
}

/// Result of shx_suggest_elements. Fill it with shx_suggestion_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_suggestion {
    /// Set by shx_suggestion_init.
    pub struct_size: u32,
    /// Smallest number of elements that meets the tolerance, or max_elements.
    pub element_count: u32,
    /// 1 if it meets the tolerance and no element turns by more than pi/2, else 0.
    pub meets_tolerance: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Estimated error at rest of the point with the largest error, m.
    pub rest_error: f64,
    /// Estimated RMS error over the motion, m. NaN without a motion, or if the error at rest was too large.
    pub motion_error: f64,
    /// Largest angle by which an element turns in the natural shape or at rest, rad.
    pub max_turning_angle: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_suggestion {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            element_count: 0,
            meets_tolerance: 0,
            reserved: 0,
            rest_error: 0.0,
            motion_error: f64::NAN,
            max_turning_angle: 0.0,
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<shx_suggest_def>() == 64 && offset_of!(shx_suggest_def, motion_count) == 48);
const _: () = assert!(size_of::<shx_suggestion>() == 40 && offset_of!(shx_suggestion, rest_error) == 16);

impl shx_suggest_def {
    /// The engine's own demand.
    ///
    /// # Safety
    /// `motion` is null or points to `motion_count` frames.
    unsafe fn demand(&self) -> Result<Demand> {
        // SAFETY: the caller's frames.
        let frames = unsafe { array("demand.motion", "demand.motion_count", self.motion, self.motion_count as usize)? };
        let motion = if frames.is_empty() {
            None
        } else {
            let read = |(k, frame): (usize, &shx_frame)| frame.checked(&format!("demand.motion[{k}]"));
            let frames = frames.iter().enumerate().map(read).collect::<Result<Vec<_>>>()?;
            Some(RootMotion { frames, interval: self.motion_interval })
        };
        let (tolerance, max_elements) = (self.tolerance, self.max_elements as usize);
        Ok(Demand { tolerance, max_elements, gravity: Vector3::from(self.gravity), motion })
    }
}

/// Fills *def with defaults. size is sizeof(shx_suggest_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_suggest_def_init(def: *mut shx_suggest_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_suggest_def_init", "def", def, size) }
}

/// Fills *suggestion with defaults. size is sizeof(shx_suggestion).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_suggestion_init(suggestion: *mut shx_suggestion, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that suggestion holds size bytes.
    unsafe { initialise("shx_suggestion_init", "suggestion", suggestion, size) }
}

/// Finds the smallest number of elements with which a strand meets a tolerance. demand may be null (defaults).
/// The natural curvatures of strand, on any number of elements, represent a continuous shape: give them as
/// finely as you have them, or one element for a uniform curl. The error is measured by settling the strand on
/// N and on 4 N elements and, with a motion, by simulating it on N and 2 N; elements that turn by more than
/// pi/2 are not considered. Takes some tens of milliseconds at rest.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
/// SHX_ERROR_INVALID_ARGUMENT (also a strand that finds no equilibrium).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_suggest_elements(
    strand: *const shx_strand_def,
    demand: *const shx_suggest_def,
    out_suggestion: *mut shx_suggestion,
) -> shx_result {
    let body = || {
        // SAFETY: the caller's structures, of the sizes that they state, and their arrays.
        let (output, strand, demand) = unsafe {
            let output = VersionedOutput::new("out_suggestion", out_suggestion)?;
            let strand = read_versioned("strand", strand)?.definition("strand")?;
            let demand = if demand.is_null() { Demand::default() } else { read_versioned("demand", demand)?.demand()? };
            (output, strand, demand)
        };
        let Suggestion { elements, met, rest_error, motion_error, turn } = on_own_thread(|| suggest_elements(&strand, &demand))?;
        output.write(&shx_suggestion {
            element_count: elements as u32,
            meets_tolerance: u32::from(met),
            rest_error,
            motion_error: motion_error.unwrap_or(f64::NAN),
            max_turning_angle: turn,
            ..shx_suggestion::defaults()
        });
        Ok(())
    };
    call("shx_suggest_elements", body)
}
