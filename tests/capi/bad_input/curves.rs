//! Bad input to the functions of curves: function, argument, fault, expected result code, call.

use super::*;

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_curves_read", "path", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_read(null(), s.out()));
    case!(cases, "shx_curves_read", "path", "empty", SHX_ERROR_INVALID_ARGUMENT, |s| shx_curves_read(c"".as_ptr(), s.out()));
    case!(cases, "shx_curves_read", "path", "of nothing", SHX_ERROR_FILE, |s| shx_curves_read(c"no/such/groom.tfx".as_ptr(), s.out()));
    case!(cases, "shx_curves_read", "path", "of a folder", SHX_ERROR_FILE, |s| shx_curves_read(c"/".as_ptr(), s.out()));
    case!(cases, "shx_curves_read", "out_curves", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_read(s.groom.as_ptr(), null_mut()));
    case!(cases, "shx_curves_destroy", "curves", "null", SHX_OK, |s| { shx_curves_destroy(null_mut()); SHX_OK });
    case!(cases, "shx_curves_count", "curves", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_count(null(), s.out(), s.out2()));
    case!(cases, "shx_curves_count", "out_strands", "both null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_count(s.curves, null_mut(), null_mut()));
    case!(cases, "shx_curves_count", "out_points", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_curves_count(s.curves, null_mut(), s.out::<u8>().wrapping_add(1).cast()));
    case!(cases, "shx_curves_point_counts", "curves", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_point_counts(null(), s.out(), 2));
    case!(cases, "shx_curves_point_counts", "out_counts", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_point_counts(s.curves, null_mut(), 2));
    case!(cases, "shx_curves_point_counts", "capacity", "1", SHX_ERROR_BUFFER_TOO_SMALL, |s| shx_curves_point_counts(s.curves, s.out(), 1));
    case!(cases, "shx_curves_point_counts", "capacity", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_curves_point_counts(s.curves, s.out(), usize::MAX));
    case!(cases, "shx_curves_points", "curves", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let output = s.output(5); shx_curves_points(null(), 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "first_strand", "3", SHX_ERROR_INVALID_ARGUMENT, |s| { let output = s.output(5); shx_curves_points(s.curves, 3, 0, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "first_strand", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| { let output = s.output(5); shx_curves_points(s.curves, usize::MAX, 0, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "strand_count", "3", SHX_ERROR_INVALID_ARGUMENT, |s| { let output = s.output(5); shx_curves_points(s.curves, 0, 3, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "strand_count", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| { let output = s.output(5); shx_curves_points(s.curves, 0, usize::MAX, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "scale", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let output = s.output(5); shx_curves_points(s.curves, 0, 2, f64::NAN, &raw const output) });
    case!(cases, "shx_curves_points", "scale", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let output = s.output(5); shx_curves_points(s.curves, 0, 2, f64::INFINITY, &raw const output) });
    case!(cases, "shx_curves_points", "scale", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let output = s.output(5); shx_curves_points(s.curves, 0, 2, f64::NEG_INFINITY, &raw const output) });
    case!(cases, "shx_curves_points", "scale", "0.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let output = s.output(5); shx_curves_points(s.curves, 0, 2, 0.0, &raw const output) });
    case!(cases, "shx_curves_points", "scale", "-1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let output = s.output(5); shx_curves_points(s.curves, 0, 2, -1.0, &raw const output) });
    case!(cases, "shx_curves_points", "points", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_points(s.curves, 0, 2, 1.0, null()));
    case!(cases, "shx_curves_points", "points", "data null", SHX_ERROR_NULL_ARGUMENT, |s| { let mut output = s.output(5); output.data = null_mut(); shx_curves_points(s.curves, 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "points", "one too few", SHX_ERROR_BUFFER_TOO_SMALL, |s| { let mut output = s.output(5); output.count = 5 - 1; shx_curves_points(s.curves, 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "points", "count 0", SHX_ERROR_BUFFER_TOO_SMALL, |s| { let mut output = s.output(5); output.count = 0; shx_curves_points(s.curves, 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "points", "count huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut output = s.output(5); output.count = usize::MAX; shx_curves_points(s.curves, 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "points", "stride too small", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut output = s.output(5); output.stride = 24 - 1; shx_curves_points(s.curves, 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "points", "stride huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut output = s.output(5); output.stride = usize::MAX; shx_curves_points(s.curves, 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "points", "reserved", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut output = s.output(5); output.reserved = 7; shx_curves_points(s.curves, 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "points", "format 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut output = s.output(5); output.format = 0; shx_curves_points(s.curves, 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "points", "format 2", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut output = s.output(5); output.format = 2; shx_curves_points(s.curves, 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "points", "format 4", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut output = s.output(5); output.format = 4; shx_curves_points(s.curves, 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_points", "points", "format 5", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut output = s.output(5); output.format = 5; shx_curves_points(s.curves, 0, 2, 1.0, &raw const output) });
    case!(cases, "shx_curves_write_points", "path", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let points = s.point_input(); let counts = [4]; shx_curves_write_points(null(), &raw const points, counts.as_ptr(), 1) });
    case!(cases, "shx_curves_write_points", "path", "of no known kind", SHX_ERROR_INVALID_ARGUMENT, |s| { let points = s.point_input(); let counts = [4]; shx_curves_write_points(c"x.png".as_ptr(), &raw const points, counts.as_ptr(), 1) });
    case!(cases, "shx_curves_write_points", "path", "in no folder", SHX_ERROR_FILE, |s| { let points = s.point_input(); let counts = [4]; shx_curves_write_points(c"no/such/folder/x.obj".as_ptr(), &raw const points, counts.as_ptr(), 1) });
    case!(cases, "shx_curves_write_points", "points", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let counts = [4]; shx_curves_write_points(s.groom.as_ptr(), null(), counts.as_ptr(), 1) });
    case!(cases, "shx_curves_write_points", "points", "count 3", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut points = s.point_input(); points.count = 3; let counts = [4]; shx_curves_write_points(s.groom.as_ptr(), &raw const points, counts.as_ptr(), 1) });
    case!(cases, "shx_curves_write_points", "points", "format 5", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut points = s.point_input(); points.format = 5; let counts = [4]; shx_curves_write_points(s.groom.as_ptr(), &raw const points, counts.as_ptr(), 1) });
    case!(cases, "shx_curves_write_points", "points", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { s.points[1][2] = f64::NAN; let points = s.point_input(); let counts = [4]; let result = shx_curves_write_points(s.groom.as_ptr(), &raw const points, counts.as_ptr(), 1); s.points[1][2] = 0.0; result });
    case!(cases, "shx_curves_write_points", "points", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { s.points[1][2] = f64::INFINITY; let points = s.point_input(); let counts = [4]; let result = shx_curves_write_points(s.groom.as_ptr(), &raw const points, counts.as_ptr(), 1); s.points[1][2] = 0.0; result });
    case!(cases, "shx_curves_write_points", "points", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { s.points[1][2] = f64::NEG_INFINITY; let points = s.point_input(); let counts = [4]; let result = shx_curves_write_points(s.groom.as_ptr(), &raw const points, counts.as_ptr(), 1); s.points[1][2] = 0.0; result });
    case!(cases, "shx_curves_write_points", "points", "1e300", SHX_ERROR_INVALID_ARGUMENT, |s| { s.points[1][2] = 1e300; let points = s.point_input(); let counts = [4]; let result = shx_curves_write_points(s.groom.as_ptr(), &raw const points, counts.as_ptr(), 1); s.points[1][2] = 0.0; result });
    case!(cases, "shx_curves_write_points", "point_counts", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let points = s.point_input(); shx_curves_write_points(s.groom.as_ptr(), &raw const points, null(), 1) });
    case!(cases, "shx_curves_write_points", "point_counts", "a strand of one point", SHX_ERROR_INVALID_ARGUMENT, |s| { let points = s.point_input(); let counts = [3, 1]; shx_curves_write_points(s.groom.as_ptr(), &raw const points, counts.as_ptr(), 2) });
    case!(cases, "shx_curves_write_points", "strand_count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let points = s.point_input(); let counts = [4]; shx_curves_write_points(s.groom.as_ptr(), &raw const points, counts.as_ptr(), usize::MAX) });
}
