//! Samples cubic curves as points.

use std::mem::size_of;

use nalgebra::Vector3;

use crate::capi::base::buffers::{OutputList, OutputValue, POINT_FORMATS, Reader, VECTOR_FORMATS, Writer};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::types::{shx_input, shx_output};
use crate::capi::base::versioned::{Versioned, initialise, read_versioned};
use crate::capi::render::render_def::NO_INPUT;
use crate::error::{Error, Result};
use crate::groom::spline::{Spline, SplineEnds, SplineKind};

/// Uniform Catmull-Rom spline: interpolates the control
/// points; the first and the last one only give directions.
pub const SHX_SPLINE_CATMULL_ROM: u32 = 1;
/// Uniform cubic B-spline.
pub const SHX_SPLINE_BSPLINE: u32 = 2;
/// Cubic Bezier spans with shared end points: 3 k + 1 control points.
pub const SHX_SPLINE_BEZIER: u32 = 3;

/// One span for every four consecutive control points.
pub const SHX_SPLINE_ENDS_OPEN: u32 = 1;
/// The curve starts at the first control point and ends at
/// the last: one point is extrapolated beyond each end.
pub const SHX_SPLINE_ENDS_PINNED: u32 = 2;

/// A cubic spline to sample. Fill it with shx_spline_def_init, then set at least controls.
/// The library reads the arrays during the call only.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_spline_def {
    /// Set by shx_spline_def_init.
    pub struct_size: u32,
    /// SHX_SPLINE_CATMULL_ROM (default), _BSPLINE or _BEZIER.
    pub kind: u32,
    /// SHX_SPLINE_ENDS_. Default SHX_SPLINE_ENDS_PINNED. No effect on Bezier splines.
    pub ends: u32,
    /// Points per span, 1 to 1024. Default 8.
    pub points_per_span: u32,
    /// Control points: at least 4, or 2 with pinned ends (SHX_FORMAT_F32X3,
    /// _F32X4, _F64X3, _F64X4; a fourth number is ignored).
    pub controls: shx_input,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and a pointer only.
unsafe impl Versioned for shx_spline_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            kind: SHX_SPLINE_CATMULL_ROM,
            ends: SHX_SPLINE_ENDS_PINNED,
            points_per_span: 8,
            controls: NO_INPUT,
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<shx_spline_def>() == 48 && std::mem::offset_of!(shx_spline_def, controls) == 16);

/// Fills *def with defaults. size is sizeof(shx_spline_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_spline_def_init(def: *mut shx_spline_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_spline_def_init", "def", def, size) }
}

/// The engine's error, with the names of the C structure.
fn in_words_of_c(error: Error) -> Error {
    error.with_fields(&[("per_span", "points_per_span")]).inside("def")
}

/// Samples a cubic spline: points_per_span points per span and one more, evenly spaced in the parameter, and
/// the arclength of each along the spline itself. Writes their number to *out_count; with null points and null
/// out_arclengths it only returns that. points: SHX_FORMAT_F32X3, _F64X3. out_arclengths holds as many doubles
/// as there are points, or is null. Pass both to shx_fit_strands.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_spline_points(
    def: *const shx_spline_def,
    points: *const shx_output,
    out_arclengths: *mut f64,
    out_count: *mut usize,
) -> shx_result {
    let body = || -> Result<()> {
        // SAFETY: the caller's structure, of the size that it states.
        let def = unsafe { read_versioned("def", def)? };
        let kind = match def.kind {
            SHX_SPLINE_CATMULL_ROM => SplineKind::CatmullRom,
            SHX_SPLINE_BSPLINE => SplineKind::BSpline,
            SHX_SPLINE_BEZIER => SplineKind::Bezier,
            other => {
                return Err(Error::invalid("def.kind", other, "SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_BSPLINE or SHX_SPLINE_BEZIER"));
            }
        };
        let ends = match def.ends {
            SHX_SPLINE_ENDS_OPEN => SplineEnds::Open,
            SHX_SPLINE_ENDS_PINNED => SplineEnds::Pinned,
            other => return Err(Error::invalid("def.ends", other, "one of SHX_SPLINE_ENDS_")),
        };
        // SAFETY: the caller's points and place for a number.
        let (reader, out_count) = unsafe {
            (Reader::new("def.controls", &raw const def.controls, POINT_FORMATS)?, OutputValue::new("out_count", out_count)?)
        };
        let spline = Spline::new(kind, ends, reader.count()).map_err(|error| error.inside("def"))?;
        let controls: Vec<Vector3<f64>> = (0..reader.count()).map(|index| reader.point(index).into()).collect();
        let (made, arclengths) = spline.points(&controls, def.points_per_span as usize).map_err(in_words_of_c)?;
        if points.is_null() && out_arclengths.is_null() {
            out_count.write(made.len());
            return Ok(());
        }
        // SAFETY: the caller's memory.
        let writer = unsafe { Writer::required("points", points, VECTOR_FORMATS, made.len())? };
        // SAFETY: as many doubles as points, or null.
        let places = unsafe { OutputList::optional("out_arclengths", "points.count", out_arclengths, made.len())? };
        if let Some(places) = places {
            places.write(&arclengths)?;
        }
        for (index, point) in made.iter().enumerate() {
            writer.vector(index, (*point).into());
        }
        out_count.write(made.len());
        Ok(())
    };
    call("shx_spline_points", body)
}
