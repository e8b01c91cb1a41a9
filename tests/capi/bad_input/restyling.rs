//! Bad input to the functions of restyling: function, argument, fault, expected result code, call.

use super::*;

/// Rows for the two strands of the scene.
fn six(s: &Scene) -> [[f64; 3]; 6] {
    std::array::from_fn(|k| s.rows[k % 3])
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_solver_adopt_natural_shapes", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_adopt_natural_shapes(null_mut(), s.ids.as_ptr(), 2));
    case!(cases, "shx_solver_adopt_natural_shapes", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_adopt_natural_shapes(s.solver, null(), 2));
    case!(cases, "shx_solver_adopt_natural_shapes", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_adopt_natural_shapes(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_adopt_natural_shapes", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_adopt_natural_shapes(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_adopt_natural_shapes", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_adopt_natural_shapes(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_adopt_natural_shapes", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_adopt_natural_shapes(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_adopt_natural_shapes", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_adopt_natural_shapes(s.solver, s.ids.as_ptr(), usize::MAX));
    case!(cases, "shx_solver_adopt_rest_shapes", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_adopt_rest_shapes(null_mut(), s.ids.as_ptr(), 2));
    case!(cases, "shx_solver_adopt_rest_shapes", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_adopt_rest_shapes(s.solver, null(), 2));
    case!(cases, "shx_solver_adopt_rest_shapes", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_adopt_rest_shapes(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_adopt_rest_shapes", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_adopt_rest_shapes(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_adopt_rest_shapes", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_adopt_rest_shapes(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_adopt_rest_shapes", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_adopt_rest_shapes(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_adopt_rest_shapes", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_adopt_rest_shapes(s.solver, s.ids.as_ptr(), usize::MAX));
    case!(cases, "shx_solver_shape_stability", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_shape_stability(null(), s.ids.as_ptr(), 2, 0.1, s.out(), s.out2(), null_mut()));
    case!(cases, "shx_solver_shape_stability", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_shape_stability(s.solver, null(), 2, 0.1, s.out(), s.out2(), null_mut()));
    case!(cases, "shx_solver_shape_stability", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_shape_stability(s.solver, ids.as_ptr(), 2, 0.1, s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_shape_stability", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_shape_stability(s.solver, ids.as_ptr(), 2, 0.1, s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_shape_stability", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_shape_stability(s.solver, ids.as_ptr(), 2, 0.1, s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_shape_stability", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_shape_stability(s.solver, ids.as_ptr(), 2, 0.1, s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_shape_stability", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_shape_stability(s.solver, s.ids.as_ptr(), usize::MAX, 0.1, s.out(), s.out2(), null_mut()));
    case!(cases, "shx_solver_shape_stability", "margin", "-0.1", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_shape_stability(s.solver, s.ids.as_ptr(), 2, -0.1, s.out(), s.out2(), null_mut()));
    case!(cases, "shx_solver_shape_stability", "margin", "1.0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_shape_stability(s.solver, s.ids.as_ptr(), 2, 1.0, s.out(), s.out2(), null_mut()));
    case!(cases, "shx_solver_shape_stability", "margin", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_shape_stability(s.solver, s.ids.as_ptr(), 2, f64::NAN, s.out(), s.out2(), null_mut()));
    case!(cases, "shx_solver_shape_stability", "margin", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_shape_stability(s.solver, s.ids.as_ptr(), 2, f64::INFINITY, s.out(), s.out2(), null_mut()));
    case!(cases, "shx_solver_shape_stability", "out_eigenvalues", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_shape_stability(s.solver, s.ids.as_ptr(), 2, 0.1, s.out::<u8>().wrapping_add(1).cast(), null_mut(), null_mut()));
    case!(cases, "shx_solver_shape_stability", "out_youngs_scales", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_shape_stability(s.solver, s.ids.as_ptr(), 2, 0.1, null_mut(), s.out::<u8>().wrapping_add(1).cast(), null_mut()));
    case!(cases, "shx_solver_shape_stability", "out_radius_scales", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_shape_stability(s.solver, s.ids.as_ptr(), 2, 0.1, s.out(), null_mut(), s.out2::<u8>().wrapping_add(1).cast()));
    case!(cases, "shx_solver_stiffen_strands", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_stiffen_strands(null_mut(), s.ids.as_ptr(), 2, SHX_STIFFEN_RADIUS, 0.1, s.out()));
    case!(cases, "shx_solver_stiffen_strands", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_stiffen_strands(s.solver, null(), 2, SHX_STIFFEN_RADIUS, 0.1, s.out()));
    case!(cases, "shx_solver_stiffen_strands", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_stiffen_strands(s.solver, ids.as_ptr(), 2, SHX_STIFFEN_RADIUS, 0.1, s.out()) });
    case!(cases, "shx_solver_stiffen_strands", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_stiffen_strands(s.solver, ids.as_ptr(), 2, SHX_STIFFEN_RADIUS, 0.1, s.out()) });
    case!(cases, "shx_solver_stiffen_strands", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_stiffen_strands(s.solver, ids.as_ptr(), 2, SHX_STIFFEN_RADIUS, 0.1, s.out()) });
    case!(cases, "shx_solver_stiffen_strands", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_stiffen_strands(s.solver, ids.as_ptr(), 2, SHX_STIFFEN_RADIUS, 0.1, s.out()) });
    case!(cases, "shx_solver_stiffen_strands", "ids", "twice", SHX_ERROR_INVALID_ARGUMENT, |s| { let ids = [s.ids[0], s.ids[0]]; shx_solver_stiffen_strands(s.solver, ids.as_ptr(), 2, SHX_STIFFEN_RADIUS, 0.1, s.out()) });
    case!(cases, "shx_solver_stiffen_strands", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_stiffen_strands(s.solver, s.ids.as_ptr(), usize::MAX, SHX_STIFFEN_RADIUS, 0.1, s.out()));
    case!(cases, "shx_solver_stiffen_strands", "by", "0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_stiffen_strands(s.solver, s.ids.as_ptr(), 2, 0, 0.1, s.out()));
    case!(cases, "shx_solver_stiffen_strands", "by", "3", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_stiffen_strands(s.solver, s.ids.as_ptr(), 2, 3, 0.1, s.out()));
    case!(cases, "shx_solver_stiffen_strands", "by", "u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_stiffen_strands(s.solver, s.ids.as_ptr(), 2, u32::MAX, 0.1, s.out()));
    case!(cases, "shx_solver_stiffen_strands", "margin", "-0.1", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_stiffen_strands(s.solver, s.ids.as_ptr(), 2, SHX_STIFFEN_RADIUS, -0.1, s.out()));
    case!(cases, "shx_solver_stiffen_strands", "margin", "1.0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_stiffen_strands(s.solver, s.ids.as_ptr(), 2, SHX_STIFFEN_RADIUS, 1.0, s.out()));
    case!(cases, "shx_solver_stiffen_strands", "margin", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_stiffen_strands(s.solver, s.ids.as_ptr(), 2, SHX_STIFFEN_RADIUS, f64::NAN, s.out()));
    case!(cases, "shx_solver_stiffen_strands", "margin", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_stiffen_strands(s.solver, s.ids.as_ptr(), 2, SHX_STIFFEN_RADIUS, f64::INFINITY, s.out()));
    case!(cases, "shx_solver_stiffen_strands", "out_scales", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_stiffen_strands(s.solver, s.ids.as_ptr(), 2, SHX_STIFFEN_RADIUS, 0.1, s.out::<u8>().wrapping_add(1).cast()));
    case!(cases, "shx_solver_get_shapes", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_shapes(null(), s.ids.as_ptr(), 2, s.out(), 6));
    case!(cases, "shx_solver_get_shapes", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_shapes(s.solver, null(), 2, s.out(), 6));
    case!(cases, "shx_solver_get_shapes", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_get_shapes(s.solver, ids.as_ptr(), 2, s.out(), 6) });
    case!(cases, "shx_solver_get_shapes", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_get_shapes(s.solver, ids.as_ptr(), 2, s.out(), 6) });
    case!(cases, "shx_solver_get_shapes", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_get_shapes(s.solver, ids.as_ptr(), 2, s.out(), 6) });
    case!(cases, "shx_solver_get_shapes", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_get_shapes(s.solver, ids.as_ptr(), 2, s.out(), 6) });
    case!(cases, "shx_solver_get_shapes", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_shapes(s.solver, s.ids.as_ptr(), usize::MAX, s.out(), 6));
    case!(cases, "shx_solver_get_shapes", "out_curvatures", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_shapes(s.solver, s.ids.as_ptr(), 2, null_mut(), 6));
    case!(cases, "shx_solver_get_shapes", "out_curvatures", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_shapes(s.solver, s.ids.as_ptr(), 2, s.out::<u8>().wrapping_add(1).cast(), 6));
    case!(cases, "shx_solver_get_shapes", "capacity", "5", SHX_ERROR_BUFFER_TOO_SMALL, |s| shx_solver_get_shapes(s.solver, s.ids.as_ptr(), 2, s.out(), 5));
    case!(cases, "shx_solver_get_shapes", "capacity", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_shapes(s.solver, s.ids.as_ptr(), 2, s.out(), usize::MAX));
    case!(cases, "shx_solver_set_shapes", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_shapes(null_mut(), s.ids.as_ptr(), 2, six(s).as_ptr().cast(), 6));
    case!(cases, "shx_solver_set_shapes", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_shapes(s.solver, null(), 2, six(s).as_ptr().cast(), 6));
    case!(cases, "shx_solver_set_shapes", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_set_shapes(s.solver, ids.as_ptr(), 2, six(s).as_ptr().cast(), 6) });
    case!(cases, "shx_solver_set_shapes", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_set_shapes(s.solver, ids.as_ptr(), 2, six(s).as_ptr().cast(), 6) });
    case!(cases, "shx_solver_set_shapes", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_set_shapes(s.solver, ids.as_ptr(), 2, six(s).as_ptr().cast(), 6) });
    case!(cases, "shx_solver_set_shapes", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_set_shapes(s.solver, ids.as_ptr(), 2, six(s).as_ptr().cast(), 6) });
    case!(cases, "shx_solver_set_shapes", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_shapes(s.solver, s.ids.as_ptr(), usize::MAX, six(s).as_ptr().cast(), 6));
    case!(cases, "shx_solver_set_shapes", "curvatures", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_shapes(s.solver, s.ids.as_ptr(), 2, null(), 6));
    case!(cases, "shx_solver_set_shapes", "row_count", "0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_shapes(s.solver, s.ids.as_ptr(), 2, six(s).as_ptr().cast(), 0));
    case!(cases, "shx_solver_set_shapes", "row_count", "5", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_shapes(s.solver, s.ids.as_ptr(), 2, six(s).as_ptr().cast(), 5));
    case!(cases, "shx_solver_set_shapes", "row_count", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_shapes(s.solver, s.ids.as_ptr(), 2, six(s).as_ptr().cast(), usize::MAX));
    case!(cases, "shx_solver_set_shapes", "curvatures", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut rows = six(s); rows[4][2] = f64::NAN; shx_solver_set_shapes(s.solver, s.ids.as_ptr(), 2, rows.as_ptr().cast(), 6) });
    case!(cases, "shx_solver_set_shapes", "curvatures", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut rows = six(s); rows[4][2] = f64::INFINITY; shx_solver_set_shapes(s.solver, s.ids.as_ptr(), 2, rows.as_ptr().cast(), 6) });
}
