//! Cubic curves made into points.

use nalgebra::Vector3;

use super::buffers::{POINT_FORMATS, Place, Places, Reader, VECTOR_FORMATS, Writer};
use super::errors::shx_result;
use super::guard::call;
use super::types::{shx_input, shx_output};
use crate::error::{Error, Result};
use crate::groom::spline::{Spline, SplineEnds, SplineKind};

/// Uniform Catmull-Rom: the curve goes through the control points; the first and the last only give directions.
pub const SHX_SPLINE_CATMULL_ROM: u32 = 1;
/// Uniform cubic B-spline.
pub const SHX_SPLINE_B: u32 = 2;
/// Cubic Bezier spans that share their end points: 3 k + 1 control points.
pub const SHX_SPLINE_BEZIER: u32 = 3;

/// A span for every four successive control points, and no more.
pub const SHX_SPLINE_ENDS_OPEN: u32 = 1;
/// The curve begins at the first control point and ends at the last: one is added beyond both, straight on.
pub const SHX_SPLINE_ENDS_PINNED: u32 = 2;

/// Makes points of a cubic curve: per_span (1 to 1024) a span and one more, evenly spaced in its parameter, and the arclength of each,
/// which is the curve's own. kind is SHX_SPLINE_, ends is SHX_SPLINE_ENDS_ (Bezier: either). controls holds at least 4 control points,
/// pinned at least 2 (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4; a fourth number is not looked at). How many points there are goes to
/// out_count; to ask for it alone give null for points and out_arclengths. points: SHX_FORMAT_F32X3, _F64X3; out_arclengths (null: not
/// wanted) holds as many doubles as there are points. Give both to shx_fit_strands.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_spline_points(
    kind: u32,
    ends: u32,
    controls: *const shx_input,
    per_span: u32,
    points: *const shx_output,
    out_arclengths: *mut f64,
    out_count: *mut usize,
) -> shx_result {
    let body = || -> Result<()> {
        let kind = match kind {
            SHX_SPLINE_CATMULL_ROM => SplineKind::CatmullRom,
            SHX_SPLINE_B => SplineKind::BSpline,
            SHX_SPLINE_BEZIER => SplineKind::Bezier,
            other => return Err(Error::invalid("kind", other, "one of SHX_SPLINE_")),
        };
        let ends = match ends {
            SHX_SPLINE_ENDS_OPEN => SplineEnds::Open,
            SHX_SPLINE_ENDS_PINNED => SplineEnds::Pinned,
            other => return Err(Error::invalid("ends", other, "one of SHX_SPLINE_ENDS_")),
        };
        // SAFETY: the caller's points and place for a number.
        let (reader, out_count) =
            unsafe { (Reader::new("controls", controls, POINT_FORMATS)?, Place::new("out_count", out_count)?) };
        let spline = Spline::new(kind, ends, reader.count())?;
        let controls: Vec<Vector3<f64>> = (0..reader.count()).map(|index| reader.point(index).into()).collect();
        let (made, arclengths) = spline.points(&controls, per_span as usize)?;
        if points.is_null() && out_arclengths.is_null() {
            out_count.write(made.len());
            return Ok(());
        }
        // SAFETY: the caller's memory.
        let writer = unsafe { Writer::required("points", points, VECTOR_FORMATS, made.len())? };
        // SAFETY: as many doubles as points, or null.
        let places = unsafe { Places::optional("out_arclengths", "points.count", out_arclengths, made.len())? };
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
