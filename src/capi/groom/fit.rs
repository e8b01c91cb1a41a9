//! Fits strands to polylines, and finds natural shapes that hold them up.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use crate::capi::base::buffers::{OutputList, POINT_FORMATS, Reader, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::thread::on_own_thread;
use crate::capi::base::types::{shx_frame, shx_input};
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::capi::hair::strand_def::shx_strand_def;
use crate::error::{Error, Result};
use crate::groom::fit::{FitOptions, fit_polyline, natural_under_gravity};
use crate::rod::definition::{MAX_ELEMENTS, check_rows};

/// A strand fitted to a polyline, apart from its element lengths
/// and curvatures. Fill it with shx_polyline_fit_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_polyline_fit {
    /// Set by shx_polyline_fit_init.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Root frame: the first point, with n0 along the first segment.
    pub root: shx_frame,
    /// Length of the polyline, m.
    pub length: f64,
    /// RMS distance between polyline and strand at equal arclength, m.
    pub rms_error: f64,
    /// Largest such distance, m.
    pub max_error: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_polyline_fit {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved: 0,
            root: shx_frame { origin: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0] },
            length: 0.0,
            rms_error: 0.0,
            max_error: 0.0,
        }
    }
}

const _: () = assert!(size_of::<shx_polyline_fit>() == 88 && offset_of!(shx_polyline_fit, length) == 64);

/// Fills *fit with defaults. size is sizeof(shx_polyline_fit).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_polyline_fit_init(fit: *mut shx_polyline_fit, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that fit holds size bytes.
    unsafe { initialise("shx_polyline_fit_init", "fit", fit, size) }
}

/// Fits a strand of element_count helical elements (1 to 100000) to a polyline of at least two distinct
/// points, m, root first (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4; a fourth number is ignored).
/// Repeated points are skipped. Writes the root frame, the length and the errors to out_fit,
/// element_count lengths (m) to out_element_lengths, and element_count rows of curvatures (rad/m) to
/// out_curvatures. Both arrays hold capacity elements. Use them as shx_strand_def.root, .element_lengths
/// and .natural_curvatures (or .initial_curvatures).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_fit_polyline(
    polyline: *const shx_input,
    element_count: u32,
    out_fit: *mut shx_polyline_fit,
    out_element_lengths: *mut f64,
    out_curvatures: *mut f64,
    capacity: usize,
) -> shx_result {
    let body = || {
        let element_count = element_count as usize;
        if element_count == 0 || element_count > MAX_ELEMENTS {
            return Err(Error::invalid("element_count", element_count, format!("1 to {MAX_ELEMENTS}")));
        }
        // SAFETY: the caller's points, structure and memory for capacity elements.
        let (reader, fit_output, lengths, rows) = unsafe {
            (
                Reader::new("polyline", polyline, POINT_FORMATS)?,
                VersionedOutput::new("out_fit", out_fit)?,
                OutputList::new("out_element_lengths", "capacity", out_element_lengths, capacity)?,
                OutputList::new("out_curvatures", "capacity", out_curvatures.cast::<[f64; 3]>(), capacity)?,
            )
        };
        lengths.check_room(element_count)?;
        let points: Vec<Vector3<f64>> = (0..reader.count()).map(|index| reader.point(index).into()).collect();
        let fit = fit_polyline(&points, &FitOptions::elements(element_count))?;
        lengths.write(&fit.element_lengths)?;
        rows.write(&fit.curvatures)?;
        fit_output.write(&shx_polyline_fit {
            root: (&fit.root).into(),
            length: fit.element_lengths.iter().sum(),
            rms_error: fit.rms_error,
            max_error: fit.max_error,
            ..shx_polyline_fit::defaults()
        });
        Ok(())
    };
    call("shx_fit_polyline", body)
}

/// Computes the natural curvatures with which a strand rests under gravity (three doubles, m/s^2) in a given
/// shape: curvatures, count rows, rad/m; count is def.element_count. Writes count rows to out_natural. Only
/// the material, the lengths and the root of def matter. The strand is in balance to rounding in a solver with
/// the default quadrature_tolerance, and to that tolerance in others.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: any.
/// cbindgen:ptrs-as-arrays=[[gravity; 3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_sag_free_curvatures(
    def: *const shx_strand_def,
    curvatures: *const f64,
    count: usize,
    gravity: *const f64,
    out_natural: *mut f64,
) -> shx_result {
    let body = || -> Result<()> {
        // SAFETY: the caller's structure, count rows, three doubles and memory for count rows.
        unsafe {
            let definition = read_versioned("def", def)?.definition("def")?;
            let rows: &[[f64; 3]] = array("curvatures", "count", curvatures.cast::<[f64; 3]>(), count)?;
            check_rows("curvatures", rows, definition.element_lengths.len())?;
            let gravity = array("gravity", "gravity", gravity, 3)?;
            for axis in 0..3 {
                crate::error::check_finite(|| format!("gravity[{axis}]"), gravity[axis])?;
            }
            let places = OutputList::new("out_natural", "count", out_natural.cast::<[f64; 3]>(), count)?;
            let gravity = Vector3::new(gravity[0], gravity[1], gravity[2]);
            places.write(&on_own_thread(|| natural_under_gravity(&definition, rows, gravity))?)
        }
    };
    call("shx_sag_free_curvatures", body)
}
