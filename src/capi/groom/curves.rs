//! Reads groom files, writes cache frames.

use std::ffi::{CStr, OsStr, c_char};
use std::path::Path;

use crate::capi::base::buffers::{OutputList, OutputValue, POINT_FORMATS, Reader, Writer, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::types::{MAX_COUNT, shx_input, shx_output};
use crate::error::{Error, Result, check_finite};
use crate::files::curves::Curves;

/// Curves of a groom file: polylines, root first, in the units of the file. shx_curves_read
/// and shx_curve_cache_sample make them, you own them, shx_curves_destroy frees them.
/// Immutable: any number of threads may use them at once.
pub struct shx_curves(Curves);

impl shx_curves {
    pub(super) fn new(curves: Curves) -> Self {
        Self(curves)
    }
}

/// # Safety
/// `path` is null or a closed text.
pub(super) unsafe fn path_from<'a>(path: *const c_char) -> Result<&'a Path> {
    if path.is_null() {
        return Err(Error::NullArgument { argument: "path".into() });
    }
    // SAFETY: not null, so a text that is closed by a zero.
    let text = unsafe { CStr::from_ptr(path) };
    if text.is_empty() {
        return Err(Error::invalid("path", "empty", "the path of a file"));
    }
    #[cfg(unix)]
    return Ok(Path::new(<OsStr as std::os::unix::ffi::OsStrExt>::from_bytes(text.to_bytes())));
    #[cfg(not(unix))]
    match text.to_str() {
        Ok(text) => Ok(Path::new(OsStr::new(text))),
        Err(_) => Err(Error::invalid("path", format!("{text:?}"), "UTF-8")),
    }
}

/// # Safety
/// `curves` is null or alive.
pub(super) unsafe fn curves_from<'a>(curves: *const shx_curves) -> Result<&'a Curves> {
    // SAFETY: the same.
    match unsafe { curves.as_ref() } {
        Some(curves) => Ok(&curves.0),
        None => Err(Error::NullArgument { argument: "curves".into() }),
    }
}

/// Reads a groom: .hair (Cem Yuksel), .tfx (TressFX, versions 2, 3, 4), .obj (Wavefront lines), .usda
/// (USD text, first time sample), .abc (Alembic in Ogawa, first sample), .data (strands), .ply (points of
/// strands), .npy or .npz (NumPy, strands by points by three). docs/reference/files.md says what of each.
/// path is UTF-8 (on Unix any bytes). You own *out_curves; free it with shx_curves_destroy.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE (unreadable, unknown format,
/// truncated, too large, malformed), SHX_ERROR_OUT_OF_MEMORY.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curves_read(path: *const c_char, out_curves: *mut *mut shx_curves) -> shx_result {
    call("shx_curves_read", || {
        // SAFETY: the caller's text and place for one pointer.
        let (path, place) = unsafe { (path_from(path)?, OutputValue::new("out_curves", out_curves)?) };
        place.write(Box::into_raw(Box::new(shx_curves(Curves::read(path)?))));
        Ok(())
    })
}

/// Frees curves. Null is allowed.
/// Threads: any. The handle must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curves_destroy(curves: *mut shx_curves) {
    call("shx_curves_destroy", || {
        if !curves.is_null() {
            // SAFETY: made by Box::into_raw in shx_curves_read.
            drop(unsafe { Box::from_raw(curves) });
        }
        Ok(())
    });
}

/// Returns the number of strands and the total number of points. Either output may be null.
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curves_count(
    curves: *const shx_curves,
    out_strands: *mut usize,
    out_points: *mut usize,
) -> shx_result {
    // SAFETY: the caller's handle and places for one number each.
    call("shx_curves_count", || unsafe {
        let curves = curves_from(curves)?;
        if out_strands.is_null() && out_points.is_null() {
            return Err(Error::NullArgument { argument: "out_strands (and out_points)".into() });
        }
        let strands = OutputList::optional("out_strands", "out_strands", out_strands, 1)?;
        let points = OutputList::optional("out_points", "out_points", out_points, 1)?;
        if let Some(strands) = strands {
            strands.write(&[curves.strand_count()])?;
        }
        if let Some(points) = points {
            points.write(&[curves.point_count()])?;
        }
        Ok(())
    })
}

/// Writes the number of points of each strand to out_counts, which holds capacity numbers.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curves_point_counts(curves: *const shx_curves, out_counts: *mut u32, capacity: usize) -> shx_result {
    // SAFETY: the caller's handle and place for capacity numbers.
    call("shx_curves_point_counts", || unsafe {
        let curves = curves_from(curves)?;
        OutputList::new("out_counts", "capacity", out_counts, capacity)?.write(curves.counts())
    })
}

/// Writes the points of strand_count strands from first_strand on, strand by strand, multiplied by scale
/// (metres per file unit; above zero). points: SHX_FORMAT_F32X3 or _F64X3.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (strands that
/// do not exist, scale), SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curves_points(
    curves: *const shx_curves,
    first_strand: usize,
    strand_count: usize,
    scale: f64,
    points: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handle and memory for the points.
    call("shx_curves_points", || unsafe {
        let curves = curves_from(curves)?;
        if first_strand > curves.strand_count() {
            let expected = format!("at most {}, the number of strands", curves.strand_count());
            return Err(Error::invalid("first_strand", first_strand, expected));
        }
        let left = curves.strand_count() - first_strand;
        if strand_count > left {
            return Err(Error::invalid("strand_count", strand_count, format!("at most {left} from strand {first_strand} on")));
        }
        crate::error::check_positive(|| "scale".into(), scale)?;
        let strands = first_strand..first_strand + strand_count;
        let needed = strands.clone().map(|strand| curves.strand(strand).len()).sum();
        let writer = Writer::required("points", points, crate::capi::base::buffers::VECTOR_FORMATS, needed)?;
        let copied = strands.flat_map(|strand| curves.strand(strand));
        for (index, point) in copied.enumerate() {
            writer.vector(index, point.map(|number| f64::from(number) * scale));
        }
        Ok(())
    })
}

/// Writes polylines to a file: .obj (Wavefront lines), .hair (Cem Yuksel), .tfx (TressFX) or .usda
/// (USD text), by the ending of its name. Use it for the frames of a cache with one file per
/// frame. points holds the points of all strands, strand by strand (SHX_FORMAT_F32X3, _F32X4,
/// _F64X3, _F64X4; rounded to floats, a fourth number is ignored). point_counts holds strand_count
/// numbers, each at least 2, that sum to points.count.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curves_write_points(
    path: *const c_char,
    points: *const shx_input,
    point_counts: *const u32,
    strand_count: usize,
) -> shx_result {
    // SAFETY: the caller's text, points and counts.
    call("shx_curves_write_points", || unsafe {
        let path = path_from(path)?;
        let reader = Reader::new("points", points, POINT_FORMATS)?;
        let counts = array("point_counts", "strand_count", point_counts, strand_count)?;
        let total = counts.iter().try_fold(0_usize, |sum, count| sum.checked_add(*count as usize));
        if let Some(strand) = counts.iter().position(|count| *count < 2) {
            return Err(Error::invalid(format!("point_counts[{strand}]"), counts[strand], "at least 2 points per strand"));
        }
        if total.is_none_or(|total| total > MAX_COUNT || total != reader.count()) {
            return Err(Error::invalid("points.count", reader.count(), "the sum of point_counts"));
        }
        let mut narrowed = Vec::with_capacity(reader.count());
        for index in 0..reader.count() {
            let point = reader.point(index).map(|number| number as f32);
            for number in point {
                check_finite(|| format!("points[{index}]"), f64::from(number))?;
            }
            narrowed.push(point);
        }
        let curves = Curves::from_counts(counts.to_vec(), narrowed)?;
        curves.write(path)
    })
}
