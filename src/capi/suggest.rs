//! How many elements a strand needs.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use super::buffers::array;
use super::errors::shx_result;
use super::guard::call;
use super::strand_def::shx_strand_def;
use super::thread::on_own_thread;
use super::types::shx_frame;
use super::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::error::Result;
use crate::math::frame::Frame;
use crate::study::elements::{Demand, RootMotion, Suggestion, suggest_elements};

/// What shx_suggest_elements is asked for. Fill with shx_suggest_def_init, then change what you need.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_suggest_def {
    /// Set by shx_suggest_def_init.
    pub struct_size: u32,
    /// Elements at most, 1 to 1000. Default 100.
    pub max_elements: u32,
    /// The error allowed, m; above zero. At rest: of the point that is farthest off. In motion: root mean square over time and
    /// arclength. Default 1e-3.
    pub tolerance: f64,
    /// Gravity, m/s^2. Default (0, 0, -9.81).
    pub gravity: [f64; 3],
    /// A motion of the root to be judged by: motion_count poses, motion_interval seconds apart. The strand starts at rest in the
    /// first, and a step is taken to each of the others. Null (default): judged at rest only.
    pub motion: *const shx_frame,
    /// Poses of motion: 0 (default), or 2 or more.
    pub motion_count: u64,
    /// Seconds from one pose to the next; 1e-9 or more. Default 1/60.
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

/// What shx_suggest_elements found. Prepare with shx_suggestion_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_suggestion {
    /// Set by shx_suggestion_init.
    pub struct_size: u32,
    /// The least number of elements that meets the tolerance, or the most allowed.
    pub element_count: u32,
    /// 1 if it meets the tolerance and no element turns by more than pi/2, 0 otherwise.
    pub meets_tolerance: u32,
    /// 0.
    pub reserved: u32,
    /// Estimated error at rest of the point that is farthest off, m.
    pub rest_error: f64,
    /// Estimated root mean square error over the motion, m; not a number without one, or where the error at rest was too large.
    pub motion_error: f64,
    /// The largest angle by which an element turns in the natural shape or at rest, rad.
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
            let read = |(k, frame): (usize, &shx_frame)| {
                Frame::from_arrays(&format!("demand.motion[{k}]"), frame.origin, frame.rotation)
            };
            let frames = frames.iter().enumerate().map(read).collect::<Result<Vec<_>>>()?;
            Some(RootMotion { frames, interval: self.motion_interval })
        };
        let (tolerance, max_elements) = (self.tolerance, self.max_elements as usize);
        Ok(Demand { tolerance, max_elements, gravity: Vector3::from(self.gravity), motion })
    }
}

/// Fills a definition with the defaults. size is sizeof(shx_suggest_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_suggest_def_init(def: *mut shx_suggest_def, size: usize) -> shx_result {
    // SAFETY: the caller says that def holds size bytes.
    unsafe { initialise("shx_suggest_def_init", "def", def, size) }
}

/// Prepares a shx_suggestion. size is sizeof(shx_suggestion).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_suggestion_init(suggestion: *mut shx_suggestion, size: usize) -> shx_result {
    // SAFETY: the caller says that suggestion holds size bytes.
    unsafe { initialise("shx_suggestion_init", "suggestion", suggestion, size) }
}

/// The least number of elements for which a strand meets a tolerance, into *out_suggestion. demand may be null: all defaults. The
/// natural curvatures of strand, on any number of elements, stand for a continuous shape: give them as finely as you have them, or one
/// element for a uniform curl. The error is measured by settling the strand on N and on four times as many elements (and, with a motion, by
/// simulating it on N and 2N); elements that turn by more than pi/2 are not considered. Some tens of milliseconds at rest.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (also: the strand finds no rest). Any thread.
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
