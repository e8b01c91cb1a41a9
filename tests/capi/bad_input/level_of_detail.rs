//! Bad input to the functions of level_of_detail: function, argument, fault, expected result code, call.

use super::*;

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_solver_set_element_count", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_element_count(null_mut(), s.ids.as_ptr(), 2, 6, s.out()));
    case!(cases, "shx_solver_set_element_count", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_element_count(s.solver, null(), 2, 6, s.out()));
    case!(cases, "shx_solver_set_element_count", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_set_element_count(s.solver, ids.as_ptr(), 2, 6, s.out()) });
    case!(cases, "shx_solver_set_element_count", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_set_element_count(s.solver, ids.as_ptr(), 2, 6, s.out()) });
    case!(cases, "shx_solver_set_element_count", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_set_element_count(s.solver, ids.as_ptr(), 2, 6, s.out()) });
    case!(cases, "shx_solver_set_element_count", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_set_element_count(s.solver, ids.as_ptr(), 2, 6, s.out()) });
    case!(cases, "shx_solver_set_element_count", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_element_count(s.solver, s.ids.as_ptr(), usize::MAX, 6, null_mut()));
    case!(cases, "shx_solver_set_element_count", "element_count", "0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_element_count(s.solver, s.ids.as_ptr(), 2, 0, s.out()));
    case!(cases, "shx_solver_set_element_count", "element_count", "100_001", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_element_count(s.solver, s.ids.as_ptr(), 2, 100_001, s.out()));
    case!(cases, "shx_solver_set_element_count", "element_count", "u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_element_count(s.solver, s.ids.as_ptr(), 2, u32::MAX, s.out()));
    case!(cases, "shx_solver_set_element_count", "out_distances", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_element_count(s.solver, s.ids.as_ptr(), 2, 6, s.out::<u8>().wrapping_add(1).cast()));
    case!(cases, "shx_solver_set_element_lengths", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let lengths = [0.04_f64, 0.04, 0.02]; let _ = &lengths; shx_solver_set_element_lengths(null_mut(), s.ids[0], lengths.as_ptr(), lengths.len(), s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "id", "zero", SHX_ERROR_INVALID_ID, |s| { let lengths = [0.04_f64, 0.04, 0.02]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, shx_strand_id { bits: 0 }, lengths.as_ptr(), lengths.len(), s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "id", "stale", SHX_ERROR_INVALID_ID, |s| { let lengths = [0.04_f64, 0.04, 0.02]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, s.stale[0], lengths.as_ptr(), lengths.len(), s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "id", "foreign", SHX_ERROR_INVALID_ID, |s| { let lengths = [0.04_f64, 0.04, 0.02]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, s.foreign[0], lengths.as_ptr(), lengths.len(), s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "lengths", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let lengths = [0.04_f64, 0.04, 0.02]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, s.ids[0], null(), lengths.len(), s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "lengths", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let lengths = [0.04, f64::NAN, 0.02]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, s.ids[0], lengths.as_ptr(), lengths.len(), s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "lengths", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let lengths = [0.04, f64::INFINITY, 0.02]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, s.ids[0], lengths.as_ptr(), lengths.len(), s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "lengths", "zero", SHX_ERROR_INVALID_ARGUMENT, |s| { let lengths = [0.05, 0.0, 0.05]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, s.ids[0], lengths.as_ptr(), lengths.len(), s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "lengths", "negative", SHX_ERROR_INVALID_ARGUMENT, |s| { let lengths = [0.06, -0.02, 0.06]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, s.ids[0], lengths.as_ptr(), lengths.len(), s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "lengths", "of another sum", SHX_ERROR_INVALID_ARGUMENT, |s| { let lengths = [0.04_f64, 0.04, 0.0201]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, s.ids[0], lengths.as_ptr(), lengths.len(), s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let lengths = [0.04_f64, 0.04, 0.02]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, s.ids[0], lengths.as_ptr(), usize::MAX, s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "lengths", "none", SHX_ERROR_INVALID_ARGUMENT, |s| { let lengths = [0.04_f64, 0.04, 0.02]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, s.ids[0], lengths.as_ptr(), 0, s.out()) });
    case!(cases, "shx_solver_set_element_lengths", "out_distance", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| { let lengths = [0.04_f64, 0.04, 0.02]; let _ = &lengths; shx_solver_set_element_lengths(s.solver, s.ids[0], lengths.as_ptr(), lengths.len(), s.out::<u8>().wrapping_add(1).cast()) });
}
