//! Caches: curves over time with velocities, in one .usda file.

use std::ffi::c_char;

use super::curve_data::{narrowed, read_data, shx_curve_data};
use super::curves::{path_from, shx_curves};
use crate::capi::base::buffers::{OutputList, OutputValue, POINT_FORMATS, Reader};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::types::shx_input;
use crate::error::{Error, Result};
use crate::files::curve_cache::{CurveCache, CurveCacheWriter};

/// Curves over time. shx_curve_cache_read makes it, you own it, shx_curve_cache_destroy frees it.
/// Immutable: any number of threads may use it at once.
pub struct shx_curve_cache(CurveCache);

/// A curve cache while it is being written. shx_curve_cache_writer_create makes it
/// and you own it. shx_curve_cache_writer_finish completes the file and frees the
/// writer; shx_curve_cache_writer_abandon discards both.
pub struct shx_curve_cache_writer(CurveCacheWriter);

/// Reads the curves of a .usda file at all of its time samples. Static curves become one frame at time 0. You
/// own *out_cache; free it with shx_curve_cache_destroy.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE, SHX_ERROR_OUT_OF_MEMORY.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curve_cache_read(path: *const c_char, out_cache: *mut *mut shx_curve_cache) -> shx_result {
    call("shx_curve_cache_read", || {
        // SAFETY: the caller's text and place for one pointer.
        let (path, place) = unsafe { (path_from(path)?, OutputValue::new("out_cache", out_cache)?) };
        place.write(Box::into_raw(Box::new(shx_curve_cache(CurveCache::read(path)?))));
        Ok(())
    })
}

/// Frees a cache. Null is allowed.
/// Threads: any. The handle must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curve_cache_destroy(cache: *mut shx_curve_cache) {
    call("shx_curve_cache_destroy", || {
        if !cache.is_null() {
            // SAFETY: made by Box::into_raw in shx_curve_cache_read.
            drop(unsafe { Box::from_raw(cache) });
        }
        Ok(())
    });
}

/// # Safety
/// `cache` is null or alive.
unsafe fn cache_from<'a>(cache: *const shx_curve_cache) -> Result<&'a CurveCache> {
    // SAFETY: the same.
    match unsafe { cache.as_ref() } {
        Some(cache) => Ok(&cache.0),
        None => Err(Error::NullArgument { argument: "cache".into() }),
    }
}

/// Writes the times of the frames, s, ascending, to out_times, which holds capacity numbers, and their number,
/// at least 1, to *out_count. With null out_times and capacity 0 it only returns the number.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curve_cache_times(
    cache: *const shx_curve_cache,
    out_times: *mut f64,
    capacity: usize,
    out_count: *mut usize,
) -> shx_result {
    call("shx_curve_cache_times", || {
        // SAFETY: the caller's handle, and places for one number and for capacity numbers.
        let (cache, count, times) = unsafe {
            let times = if out_times.is_null() && capacity == 0 {
                None
            } else {
                Some(OutputList::new("out_times", "capacity", out_times, capacity)?)
            };
            (cache_from(cache)?, OutputValue::new("out_count", out_count)?, times)
        };
        if let Some(times) = times {
            times.write(cache.times())?;
        }
        count.write(cache.times().len());
        Ok(())
    })
}

/// Returns the curves at a time, s, with velocities if the file has them (shx_curves_attribute). Between
/// frames it interpolates linearly; before the first and after the last frame it returns that frame. You
/// own *out_curves; free it with shx_curves_destroy.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT
/// (time), SHX_ERROR_FILE, SHX_ERROR_OUT_OF_MEMORY.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curve_cache_sample(
    cache: *const shx_curve_cache,
    time: f64,
    out_curves: *mut *mut shx_curves,
) -> shx_result {
    call("shx_curve_cache_sample", || {
        // SAFETY: the caller's handle and place for one pointer.
        let (cache, place) = unsafe { (cache_from(cache)?, OutputValue::new("out_curves", out_curves)?) };
        place.write(Box::into_raw(Box::new(shx_curves::new(cache.at(time)?))));
        Ok(())
    })
}

/// Starts to write a cache, a .usda file. first gives the point counts and what does not change over
/// time (diameters, colours, units, up axis). Its points are not written; if it has velocities, every
/// frame must have them. Times are stored in units of 1/frames_per_second s; above 0. The file
/// appears when you finish the cache. Until then the frames are in hidden files beside it (.name.0.part
/// and on); if your process is killed they remain, and the next writer of the same path removes them.
/// You own *out_writer.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_FILE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curve_cache_writer_create(
    path: *const c_char,
    first: *const shx_curve_data,
    frames_per_second: f64,
    out_writer: *mut *mut shx_curve_cache_writer,
) -> shx_result {
    call("shx_curve_cache_writer_create", || {
        // SAFETY: the caller's text, structure and place for one pointer.
        let (path, place) = unsafe { (path_from(path)?, OutputValue::new("out_writer", out_writer)?) };
        // SAFETY: the same.
        let (curves, _) = unsafe { read_data(first) }.map_err(|error| error.renamed("data", "first"))?;
        let writer = CurveCacheWriter::create(path, &curves, frames_per_second);
        let writer = writer.map_err(|error| error.renamed("time_codes_per_second", "frames_per_second"))?;
        place.write(Box::into_raw(Box::new(shx_curve_cache_writer(writer))));
        Ok(())
    })
}

/// Writes a frame: its time, s, later than that of the previous frame, and the points
/// of all strands (SHX_FORMAT_F32X3, _F32X4, _F64X3, _F64X4). velocities (same formats)
/// are required if first had them, and null otherwise.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT,
/// SHX_ERROR_FILE (the writer is then useless: abandon it).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curve_cache_writer_write(
    writer: *mut shx_curve_cache_writer,
    time: f64,
    points: *const shx_input,
    velocities: *const shx_input,
) -> shx_result {
    call("shx_curve_cache_writer_write", || {
        // SAFETY: the caller's handle, alone with it, and inputs.
        let (writer, points, velocities) = unsafe {
            let Some(writer) = writer.as_mut() else { return Err(Error::NullArgument { argument: "writer".into() }) };
            let points = narrowed("points", &Reader::new("points", points, POINT_FORMATS)?)?;
            let velocities = if velocities.is_null() {
                None
            } else {
                Some(narrowed("velocities", &Reader::new("velocities", velocities, POINT_FORMATS)?)?)
            };
            (writer, points, velocities)
        };
        writer.0.write(time, &points, velocities.as_deref())
    })
}

/// Completes the cache, moves the file to its path, and frees the writer, also if that fails.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ARGUMENT (no frame was written), SHX_ERROR_FILE.
/// Threads: exclusive. The handle must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curve_cache_writer_finish(writer: *mut shx_curve_cache_writer) -> shx_result {
    call("shx_curve_cache_writer_finish", || {
        if writer.is_null() {
            return Err(Error::NullArgument { argument: "writer".into() });
        }
        // SAFETY: made by Box::into_raw in shx_curve_cache_writer_create.
        unsafe { Box::from_raw(writer) }.0.finish().map_err(|error| error.renamed("frames", "writer"))
    })
}

/// Discards the cache and frees the writer; no file remains. Null is allowed.
/// Threads: exclusive. The handle must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_curve_cache_writer_abandon(writer: *mut shx_curve_cache_writer) {
    call("shx_curve_cache_writer_abandon", || {
        if !writer.is_null() {
            // SAFETY: made by Box::into_raw in shx_curve_cache_writer_create.
            drop(unsafe { Box::from_raw(writer) });
        }
        Ok(())
    });
}
