//! Bad input to the functions of overlaps: function, argument, what is wrong with it, the code that it must give, the call.

use super::*;

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_solver_overlaps", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_overlaps(null_mut(), s.ids.as_ptr(), 2, s.out(), null_mut(), s.out2(), null_mut()));
    case!(cases, "shx_solver_overlaps", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_overlaps(s.solver, null(), 2, s.out(), null_mut(), s.out2(), null_mut()));
    case!(cases, "shx_solver_overlaps", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_overlaps(s.solver, ids.as_ptr(), 2, s.out(), null_mut(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_overlaps", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_overlaps(s.solver, ids.as_ptr(), 2, s.out(), null_mut(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_overlaps", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_overlaps(s.solver, ids.as_ptr(), 2, s.out(), null_mut(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_overlaps", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_overlaps(s.solver, ids.as_ptr(), 2, s.out(), null_mut(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_overlaps", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_overlaps(s.solver, s.ids.as_ptr(), usize::MAX, s.out(), null_mut(), s.out2(), null_mut()));
    case!(cases, "shx_solver_overlaps", "out_hair_depths", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_overlaps(s.solver, s.ids.as_ptr(), 2, s.out::<u8>().wrapping_add(1).cast(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_overlaps", "out_strands", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_overlaps(s.solver, s.ids.as_ptr(), 2, null_mut(), s.out::<u8>().wrapping_add(1).cast(), null_mut(), null_mut()));
    case!(cases, "shx_solver_overlaps", "out_body_depths", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_overlaps(s.solver, s.ids.as_ptr(), 2, null_mut(), null_mut(), s.out::<u8>().wrapping_add(1).cast(), null_mut()));
    case!(cases, "shx_solver_overlaps", "out_bodies", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_overlaps(s.solver, s.ids.as_ptr(), 2, null_mut(), null_mut(), null_mut(), s.out::<u8>().wrapping_add(1).cast()));
    case!(cases, "shx_solver_allow_overlaps", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_allow_overlaps(null_mut(), s.ids.as_ptr(), 2));
    case!(cases, "shx_solver_allow_overlaps", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_allow_overlaps(s.solver, null(), 2));
    case!(cases, "shx_solver_allow_overlaps", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_allow_overlaps(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_allow_overlaps", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_allow_overlaps(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_allow_overlaps", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_allow_overlaps(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_allow_overlaps", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_allow_overlaps(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_allow_overlaps", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_allow_overlaps(s.solver, s.ids.as_ptr(), usize::MAX));
    case!(cases, "shx_solver_allow_overlaps", "ids", "twice", SHX_ERROR_INVALID_ARGUMENT, |s| { let ids = [s.ids[0], s.ids[0]]; shx_solver_allow_overlaps(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_set_allowance", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_allowance(null_mut(), s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "id", "zero", SHX_ERROR_INVALID_ID, |s| shx_solver_set_allowance(s.solver, shx_strand_id { bits: 0 }, [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "id", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_set_allowance(s.solver, s.stale[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "id", "foreign", SHX_ERROR_INVALID_ID, |s| shx_solver_set_allowance(s.solver, s.foreign[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "id", "nonsense", SHX_ERROR_INVALID_ID, |s| shx_solver_set_allowance(s.solver, shx_strand_id { bits: u64::MAX }, [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "along", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], null(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "along", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], s.rows.as_ptr().cast::<u8>().wrapping_add(1).cast(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "along", "[1] = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, f64::NAN].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "along", "[1] = f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, f64::INFINITY].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "along", "[1] = -1e-9", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, -1e-9].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "wisp_shares", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), null(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "wisp_shares", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), s.rows.as_ptr().cast::<u8>().wrapping_add(1).cast(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "wisp_shares", "[1] = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [0.0, f64::NAN].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "wisp_shares", "[1] = f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [0.0, f64::INFINITY].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "wisp_shares", "[1] = -1e-9", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [0.0, -1e-9].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "sunk", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), null(), 2));
    case!(cases, "shx_solver_set_allowance", "sunk", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), s.rows.as_ptr().cast::<u8>().wrapping_add(1).cast(), 2));
    case!(cases, "shx_solver_set_allowance", "sunk", "[1] = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, f64::NAN].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "sunk", "[1] = f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, f64::INFINITY].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "sunk", "[1] = -1e-9", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, -1e-9].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "along", "not rising", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.1, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "wisp_shares", "[0] = 1.1", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.1, 0.1].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_allowance", "station_count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_allowance(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), usize::MAX));
    case!(cases, "shx_solver_get_allowance", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_allowance(null(), s.ids[0], s.out(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_allowance", "id", "zero", SHX_ERROR_INVALID_ID, |s| shx_solver_get_allowance(s.solver, shx_strand_id { bits: 0 }, s.out(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_allowance", "id", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_get_allowance(s.solver, s.stale[0], s.out(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_allowance", "id", "foreign", SHX_ERROR_INVALID_ID, |s| shx_solver_get_allowance(s.solver, s.foreign[0], s.out(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_allowance", "id", "nonsense", SHX_ERROR_INVALID_ID, |s| shx_solver_get_allowance(s.solver, shx_strand_id { bits: u64::MAX }, s.out(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_allowance", "out_along", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_allowance(s.solver, s.ids[0], s.out::<u8>().wrapping_add(1).cast(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_allowance", "out_wisp_shares", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_allowance(s.solver, s.ids[0], null_mut(), s.out::<u8>().wrapping_add(1).cast(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_allowance", "out_sunk", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_allowance(s.solver, s.ids[0], null_mut(), null_mut(), s.out::<u8>().wrapping_add(1).cast(), 8, s.out2()));
    case!(cases, "shx_solver_get_allowance", "capacity", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_allowance(s.solver, s.ids[0], s.out(), null_mut(), null_mut(), usize::MAX, s.out2()));
    case!(cases, "shx_solver_get_allowance", "out_station_count", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_allowance(s.solver, s.ids[0], s.out(), null_mut(), null_mut(), 8, null_mut()));
    case!(cases, "shx_solver_get_allowance", "out_station_count", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_allowance(s.solver, s.ids[0], s.out(), null_mut(), null_mut(), 8, s.out2::<u8>().wrapping_add(1).cast()));
}
