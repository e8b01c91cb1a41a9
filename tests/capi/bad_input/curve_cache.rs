//! Bad input to the functions of caches: function, argument, fault, expected result code, call.

use super::curve_data::data;
use super::*;

/// A file of this process alone.
fn path(name: &str) -> std::ffi::CString {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("bad_input_{}_{name}.usda", std::process::id()));
    std::ffi::CString::new(path.to_str().expect("UTF-8")).expect("a path")
}

/// Calls with a writer that has one frame at 1 s.
fn writing(s: &mut Scene, call: impl FnOnce(&mut Scene, *mut shx_curve_cache_writer, &shx_input) -> shx_result) -> shx_result {
    let (path, data, points, mut writer) = (path("writing"), data(s), s.point_input(), null_mut());
    // SAFETY: all that is pointed to is there, and the writer is given up once.
    unsafe {
        assert_eq!(shx_curve_cache_writer_create(path.as_ptr(), &raw const data, 24.0, &raw mut writer), SHX_OK);
        assert_eq!(shx_curve_cache_writer_write(writer, 1.0, &raw const points, null()), SHX_OK);
        let result = call(s, writer, &points);
        shx_curve_cache_writer_abandon(writer);
        result
    }
}

/// Calls with a cache of one frame.
fn reading(s: &mut Scene, call: impl FnOnce(&mut Scene, *const shx_curve_cache) -> shx_result) -> shx_result {
    let (path, data, points, mut writer, mut cache) = (path("reading"), data(s), s.point_input(), null_mut(), null_mut());
    // SAFETY: all that is pointed to is there, and the cache is freed once.
    unsafe {
        assert_eq!(shx_curve_cache_writer_create(path.as_ptr(), &raw const data, 24.0, &raw mut writer), SHX_OK);
        assert_eq!(shx_curve_cache_writer_write(writer, 1.0, &raw const points, null()), SHX_OK);
        assert_eq!(shx_curve_cache_writer_finish(writer), SHX_OK);
        assert_eq!(shx_curve_cache_read(path.as_ptr(), &raw mut cache), SHX_OK);
        let _ = std::fs::remove_file(path.to_str().expect("UTF-8"));
        let result = call(s, cache);
        shx_curve_cache_destroy(cache);
        result
    }
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_curve_cache_read", "path", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curve_cache_read(null(), s.out()));
    case!(cases, "shx_curve_cache_read", "path", "empty", SHX_ERROR_INVALID_ARGUMENT, |s| shx_curve_cache_read(c"".as_ptr(), s.out()));
    case!(cases, "shx_curve_cache_read", "path", "of nothing", SHX_ERROR_FILE, |s| shx_curve_cache_read(c"no/such/cache.usda".as_ptr(), s.out()));
    case!(cases, "shx_curve_cache_read", "path", "of another format", SHX_ERROR_FILE, |s| shx_curve_cache_read(s.groom.as_ptr(), s.out()));
    case!(cases, "shx_curve_cache_read", "out_cache", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curve_cache_read(s.groom.as_ptr(), null_mut()));
    case!(cases, "shx_curve_cache_destroy", "cache", "null", SHX_OK, |s| { shx_curve_cache_destroy(null_mut()); SHX_OK });
    case!(cases, "shx_curve_cache_times", "cache", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curve_cache_times(null(), s.out(), 1, s.out2()));
    case!(cases, "shx_curve_cache_times", "out_times", "null", SHX_ERROR_NULL_ARGUMENT, |s| reading(s, |s, cache| shx_curve_cache_times(cache, null_mut(), 1, s.out2())));
    case!(cases, "shx_curve_cache_times", "capacity", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| reading(s, |s, cache| shx_curve_cache_times(cache, s.out(), usize::MAX, s.out2())));
    case!(cases, "shx_curve_cache_times", "capacity", "0", SHX_ERROR_BUFFER_TOO_SMALL, |s| reading(s, |s, cache| shx_curve_cache_times(cache, s.out(), 0, s.out2())));
    case!(cases, "shx_curve_cache_times", "out_count", "null", SHX_ERROR_NULL_ARGUMENT, |s| reading(s, |s, cache| shx_curve_cache_times(cache, s.out(), 1, null_mut())));
    case!(cases, "shx_curve_cache_sample", "cache", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curve_cache_sample(null(), 0.0, s.out()));
    case!(cases, "shx_curve_cache_sample", "time", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| reading(s, |s, cache| shx_curve_cache_sample(cache, f64::NAN, s.out())));
    case!(cases, "shx_curve_cache_sample", "time", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| reading(s, |s, cache| shx_curve_cache_sample(cache, f64::INFINITY, s.out())));
    case!(cases, "shx_curve_cache_sample", "out_curves", "null", SHX_ERROR_NULL_ARGUMENT, |s| reading(s, |_, cache| shx_curve_cache_sample(cache, 0.0, null_mut())));
    case!(cases, "shx_curve_cache_writer_create", "path", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let data = data(s); shx_curve_cache_writer_create(null(), &raw const data, 24.0, s.out()) });
    case!(cases, "shx_curve_cache_writer_create", "path", "in no folder", SHX_ERROR_FILE, |s| { let data = data(s); shx_curve_cache_writer_create(c"no/such/folder/x.usda".as_ptr(), &raw const data, 24.0, s.out()) });
    case!(cases, "shx_curve_cache_writer_create", "first", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let path = path("none"); shx_curve_cache_writer_create(path.as_ptr(), null(), 24.0, s.out()) });
    case!(cases, "shx_curve_cache_writer_create", "first", "up", SHX_ERROR_INVALID_ARGUMENT, |s| { let path = path("none"); let mut data = data(s); data.up_axis = 3; shx_curve_cache_writer_create(path.as_ptr(), &raw const data, 24.0, s.out()) });
    case!(cases, "shx_curve_cache_writer_create", "frames_per_second", "0.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let path = path("none"); let data = data(s); shx_curve_cache_writer_create(path.as_ptr(), &raw const data, 0.0, s.out()) });
    case!(cases, "shx_curve_cache_writer_create", "frames_per_second", "-1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let path = path("none"); let data = data(s); shx_curve_cache_writer_create(path.as_ptr(), &raw const data, -1.0, s.out()) });
    case!(cases, "shx_curve_cache_writer_create", "frames_per_second", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let path = path("none"); let data = data(s); shx_curve_cache_writer_create(path.as_ptr(), &raw const data, f64::NAN, s.out()) });
    case!(cases, "shx_curve_cache_writer_create", "frames_per_second", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let path = path("none"); let data = data(s); shx_curve_cache_writer_create(path.as_ptr(), &raw const data, f64::INFINITY, s.out()) });
    case!(cases, "shx_curve_cache_writer_create", "out_writer", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let path = path("none"); let data = data(s); shx_curve_cache_writer_create(path.as_ptr(), &raw const data, 24.0, null_mut()) });
    case!(cases, "shx_curve_cache_writer_write", "writer", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let points = s.point_input(); shx_curve_cache_writer_write(null_mut(), 0.0, &raw const points, null()) });
    case!(cases, "shx_curve_cache_writer_write", "time", "1.0", SHX_ERROR_INVALID_ARGUMENT, |s| writing(s, |_, writer, points| shx_curve_cache_writer_write(writer, 1.0, points, null())));
    case!(cases, "shx_curve_cache_writer_write", "time", "0.5", SHX_ERROR_INVALID_ARGUMENT, |s| writing(s, |_, writer, points| shx_curve_cache_writer_write(writer, 0.5, points, null())));
    case!(cases, "shx_curve_cache_writer_write", "time", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| writing(s, |_, writer, points| shx_curve_cache_writer_write(writer, f64::NAN, points, null())));
    case!(cases, "shx_curve_cache_writer_write", "time", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| writing(s, |_, writer, points| shx_curve_cache_writer_write(writer, f64::INFINITY, points, null())));
    case!(cases, "shx_curve_cache_writer_write", "points", "null", SHX_ERROR_NULL_ARGUMENT, |s| writing(s, |_, writer, _| shx_curve_cache_writer_write(writer, 2.0, null(), null())));
    case!(cases, "shx_curve_cache_writer_write", "points", "one too few", SHX_ERROR_INVALID_ARGUMENT, |s| writing(s, |_, writer, points| { let points = shx_input { count: 3, ..*points }; shx_curve_cache_writer_write(writer, 2.0, &raw const points, null()) }));
    case!(cases, "shx_curve_cache_writer_write", "points", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| writing(s, |s, writer, _| { s.points[1][2] = f64::NAN; let points = s.point_input(); let result = shx_curve_cache_writer_write(writer, 2.0, &raw const points, null()); s.points[1][2] = 0.0; result }));
    case!(cases, "shx_curve_cache_writer_write", "velocities", "where there were none", SHX_ERROR_INVALID_ARGUMENT, |s| writing(s, |_, writer, points| shx_curve_cache_writer_write(writer, 2.0, points, points)));
    case!(cases, "shx_curve_cache_writer_finish", "writer", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curve_cache_writer_finish(null_mut()));
    case!(cases, "shx_curve_cache_writer_finish", "writer", "without frames", SHX_ERROR_INVALID_ARGUMENT, |s| { let (path, data, mut writer) = (path("empty"), data(s), null_mut()); assert_eq!(shx_curve_cache_writer_create(path.as_ptr(), &raw const data, 24.0, &raw mut writer), SHX_OK); shx_curve_cache_writer_finish(writer) });
    case!(cases, "shx_curve_cache_writer_abandon", "writer", "null", SHX_OK, |s| { shx_curve_cache_writer_abandon(null_mut()); SHX_OK });
}
