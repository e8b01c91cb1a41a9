//! Bad input to the functions of shape: function, argument, fault, expected result code, call.

use super::*;

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_solver_set_natural_curvatures", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_natural_curvatures(null_mut(), s.ids[0], s.rows.as_ptr().cast(), 3));
    case!(cases, "shx_solver_set_natural_curvatures", "id", "zero", SHX_ERROR_INVALID_ID, |s| shx_solver_set_natural_curvatures(s.solver, shx_strand_id { bits: 0 }, s.rows.as_ptr().cast(), 3));
    case!(cases, "shx_solver_set_natural_curvatures", "id", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_set_natural_curvatures(s.solver, s.stale[0], s.rows.as_ptr().cast(), 3));
    case!(cases, "shx_solver_set_natural_curvatures", "id", "foreign", SHX_ERROR_INVALID_ID, |s| shx_solver_set_natural_curvatures(s.solver, s.foreign[0], s.rows.as_ptr().cast(), 3));
    case!(cases, "shx_solver_set_natural_curvatures", "curvatures", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_natural_curvatures(s.solver, s.ids[0], null(), 3));
    case!(cases, "shx_solver_set_natural_curvatures", "count", "0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_natural_curvatures(s.solver, s.ids[0], s.rows.as_ptr().cast(), 0));
    case!(cases, "shx_solver_set_natural_curvatures", "count", "2", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_natural_curvatures(s.solver, s.ids[0], s.rows.as_ptr().cast(), 2));
    case!(cases, "shx_solver_set_natural_curvatures", "count", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_natural_curvatures(s.solver, s.ids[0], s.rows.as_ptr().cast(), usize::MAX));
    case!(cases, "shx_solver_set_natural_curvatures", "count", "4", SHX_ERROR_INVALID_ARGUMENT, |s| { let rows = [[0.0_f64; 3]; 4]; shx_solver_set_natural_curvatures(s.solver, s.ids[0], rows.as_ptr().cast(), 4) });
    case!(cases, "shx_solver_set_natural_curvatures", "curvatures", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut rows = s.rows; rows[1][2] = f64::NAN; shx_solver_set_natural_curvatures(s.solver, s.ids[0], rows.as_ptr().cast(), 3) });
    case!(cases, "shx_solver_set_natural_curvatures", "curvatures", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut rows = s.rows; rows[1][2] = f64::INFINITY; shx_solver_set_natural_curvatures(s.solver, s.ids[0], rows.as_ptr().cast(), 3) });
    case!(cases, "shx_solver_set_natural_curvatures", "curvatures", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut rows = s.rows; rows[1][2] = f64::NEG_INFINITY; shx_solver_set_natural_curvatures(s.solver, s.ids[0], rows.as_ptr().cast(), 3) });
    case!(cases, "shx_solver_set_curvatures", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_curvatures(null_mut(), s.ids[0], s.rows.as_ptr().cast(), null(), 3));
    case!(cases, "shx_solver_set_curvatures", "id", "zero", SHX_ERROR_INVALID_ID, |s| shx_solver_set_curvatures(s.solver, shx_strand_id { bits: 0 }, s.rows.as_ptr().cast(), null(), 3));
    case!(cases, "shx_solver_set_curvatures", "id", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_set_curvatures(s.solver, s.stale[0], s.rows.as_ptr().cast(), null(), 3));
    case!(cases, "shx_solver_set_curvatures", "id", "foreign", SHX_ERROR_INVALID_ID, |s| shx_solver_set_curvatures(s.solver, s.foreign[0], s.rows.as_ptr().cast(), null(), 3));
    case!(cases, "shx_solver_set_curvatures", "curvatures", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_curvatures(s.solver, s.ids[0], null(), null(), 3));
    case!(cases, "shx_solver_set_curvatures", "count", "0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_curvatures(s.solver, s.ids[0], s.rows.as_ptr().cast(), null(), 0));
    case!(cases, "shx_solver_set_curvatures", "count", "2", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_curvatures(s.solver, s.ids[0], s.rows.as_ptr().cast(), null(), 2));
    case!(cases, "shx_solver_set_curvatures", "count", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_curvatures(s.solver, s.ids[0], s.rows.as_ptr().cast(), null(), usize::MAX));
    case!(cases, "shx_solver_set_curvatures", "curvatures", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut rows = s.rows; rows[1][2] = f64::NAN; shx_solver_set_curvatures(s.solver, s.ids[0], rows.as_ptr().cast(), null(), 3) });
    case!(cases, "shx_solver_set_curvatures", "rates", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut rows = s.rows; rows[1][2] = f64::NAN; shx_solver_set_curvatures(s.solver, s.ids[0], s.rows.as_ptr().cast(), rows.as_ptr().cast(), 3) });
    case!(cases, "shx_solver_set_curvatures", "curvatures", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut rows = s.rows; rows[1][2] = f64::INFINITY; shx_solver_set_curvatures(s.solver, s.ids[0], rows.as_ptr().cast(), null(), 3) });
    case!(cases, "shx_solver_set_curvatures", "rates", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut rows = s.rows; rows[1][2] = f64::INFINITY; shx_solver_set_curvatures(s.solver, s.ids[0], s.rows.as_ptr().cast(), rows.as_ptr().cast(), 3) });
    case!(cases, "shx_solver_set_curvatures", "curvatures", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut rows = s.rows; rows[1][2] = f64::NEG_INFINITY; shx_solver_set_curvatures(s.solver, s.ids[0], rows.as_ptr().cast(), null(), 3) });
    case!(cases, "shx_solver_set_curvatures", "rates", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut rows = s.rows; rows[1][2] = f64::NEG_INFINITY; shx_solver_set_curvatures(s.solver, s.ids[0], s.rows.as_ptr().cast(), rows.as_ptr().cast(), 3) });
    case!(cases, "shx_solver_get_natural_curvatures", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_natural_curvatures(null(), s.ids[0], s.out(), 3));
    case!(cases, "shx_solver_get_natural_curvatures", "id", "zero", SHX_ERROR_INVALID_ID, |s| shx_solver_get_natural_curvatures(s.solver, shx_strand_id { bits: 0 }, s.out(), 3));
    case!(cases, "shx_solver_get_natural_curvatures", "id", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_get_natural_curvatures(s.solver, s.stale[0], s.out(), 3));
    case!(cases, "shx_solver_get_natural_curvatures", "id", "foreign", SHX_ERROR_INVALID_ID, |s| shx_solver_get_natural_curvatures(s.solver, s.foreign[0], s.out(), 3));
    case!(cases, "shx_solver_get_natural_curvatures", "out_curvatures", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_natural_curvatures(s.solver, s.ids[0], null_mut(), 3));
    case!(cases, "shx_solver_get_natural_curvatures", "count", "2", SHX_ERROR_BUFFER_TOO_SMALL, |s| shx_solver_get_natural_curvatures(s.solver, s.ids[0], s.out(), 2));
    case!(cases, "shx_solver_get_curvatures", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_curvatures(null(), s.ids[0], s.out(), s.out2(), 3));
    case!(cases, "shx_solver_get_curvatures", "id", "zero", SHX_ERROR_INVALID_ID, |s| shx_solver_get_curvatures(s.solver, shx_strand_id { bits: 0 }, s.out(), s.out2(), 3));
    case!(cases, "shx_solver_get_curvatures", "id", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_get_curvatures(s.solver, s.stale[0], s.out(), s.out2(), 3));
    case!(cases, "shx_solver_get_curvatures", "id", "foreign", SHX_ERROR_INVALID_ID, |s| shx_solver_get_curvatures(s.solver, s.foreign[0], s.out(), s.out2(), 3));
    case!(cases, "shx_solver_get_curvatures", "out_curvatures", "both null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_curvatures(s.solver, s.ids[0], null_mut(), null_mut(), 3));
    case!(cases, "shx_solver_get_curvatures", "out_rates", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_curvatures(s.solver, s.ids[0], null_mut(), s.out::<u8>().wrapping_add(1).cast(), 3));
    case!(cases, "shx_solver_get_curvatures", "count", "2", SHX_ERROR_BUFFER_TOO_SMALL, |s| shx_solver_get_curvatures(s.solver, s.ids[0], s.out(), s.out2(), 2));
}
