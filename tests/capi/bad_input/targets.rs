//! Bad input to the functions of targets: function, argument, fault, expected result code, call.

use super::*;

fn target_def() -> shx_target_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one definition, which the call fills.
    unsafe {
        assert_eq!(shx_target_def_init(def.as_mut_ptr(), size_of::<shx_target_def>()), SHX_OK);
        def.assume_init()
    }
}

/// Draws the scene's two strands to curves of two points each, whose definition is changed first.
unsafe fn draw(s: &mut Scene, change: impl FnOnce(&mut shx_target_def)) -> shx_result {
    let mut def = shx_target_def { curve_count: 2, points: s.point_input(), ..target_def() };
    change(&mut def);
    // SAFETY: as the caller says.
    unsafe { shx_solver_set_targets(s.solver, s.ids.as_ptr(), 2, &raw const def, 0.1) }
}

/// The same with a number of a point in place of a good one.
unsafe fn draw_with(s: &mut Scene, value: f64) -> shx_result {
    let before = std::mem::replace(&mut s.points[3][1], value);
    // SAFETY: as the caller says.
    let result = unsafe { draw(s, |_| ()) };
    s.points[3][1] = before;
    result
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_target_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_target_def_init(null_mut(), size_of::<shx_target_def>()));
    case!(cases, "shx_target_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_target_def_init(s.out(), 0));
    case!(cases, "shx_target_def_init", "size", "too small", SHX_ERROR_STRUCT_SIZE, |s| shx_target_def_init(s.out(), size_of::<shx_target_def>() - 8));
    case!(cases, "shx_target_def_init", "size", "odd", SHX_ERROR_STRUCT_SIZE, |s| shx_target_def_init(s.out(), size_of::<shx_target_def>() + 1));
    case!(cases, "shx_target_def_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_target_def_init(s.out(), usize::MAX));
    case!(cases, "shx_solver_set_targets", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = shx_target_def { curve_count: 2, points: s.point_input(), ..target_def() }; shx_solver_set_targets(null_mut(), s.ids.as_ptr(), 2, &raw const def, 0.1) });
    case!(cases, "shx_solver_set_targets", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = shx_target_def { curve_count: 2, points: s.point_input(), ..target_def() }; shx_solver_set_targets(s.solver, null(), 2, &raw const def, 0.1) });
    case!(cases, "shx_solver_set_targets", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let def = shx_target_def { curve_count: 2, points: s.point_input(), ..target_def() }; let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_set_targets(s.solver, ids.as_ptr(), 2, &raw const def, 0.1) });
    case!(cases, "shx_solver_set_targets", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let def = shx_target_def { curve_count: 2, points: s.point_input(), ..target_def() }; let ids = [s.ids[0], s.stale[0]]; shx_solver_set_targets(s.solver, ids.as_ptr(), 2, &raw const def, 0.1) });
    case!(cases, "shx_solver_set_targets", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let def = shx_target_def { curve_count: 2, points: s.point_input(), ..target_def() }; let ids = [s.ids[0], s.foreign[0]]; shx_solver_set_targets(s.solver, ids.as_ptr(), 2, &raw const def, 0.1) });
    case!(cases, "shx_solver_set_targets", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let def = shx_target_def { curve_count: 2, points: s.point_input(), ..target_def() }; let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_set_targets(s.solver, ids.as_ptr(), 2, &raw const def, 0.1) });
    case!(cases, "shx_solver_set_targets", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_target_def { curve_count: 2, points: s.point_input(), ..target_def() }; shx_solver_set_targets(s.solver, s.ids.as_ptr(), usize::MAX, &raw const def, 0.1) });
    case!(cases, "shx_solver_set_targets", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_targets(s.solver, s.ids.as_ptr(), 2, null(), 0.1));
    case!(cases, "shx_solver_set_targets", "def", "as it was made", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_targets(s.solver, s.ids.as_ptr(), 2, &target_def(), 0.1));
    case!(cases, "shx_solver_set_targets", "def", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| draw(s, |def| def.struct_size = 0));
    case!(cases, "shx_solver_set_targets", "def", "reserved", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.reserved[3] = 1));
    case!(cases, "shx_solver_set_targets", "def", "curve_count 1", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.curve_count = 1));
    case!(cases, "shx_solver_set_targets", "def", "curve_count 3", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.curve_count = 3));
    case!(cases, "shx_solver_set_targets", "def", "curve_count huge", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.curve_count = usize::MAX));
    case!(cases, "shx_solver_set_targets", "def", "points data null", SHX_ERROR_NULL_ARGUMENT, |s| draw(s, |def| def.points.data = null()));
    case!(cases, "shx_solver_set_targets", "def", "points count odd", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.points.count = 3));
    case!(cases, "shx_solver_set_targets", "def", "one point each", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.points.count = 2));
    case!(cases, "shx_solver_set_targets", "def", "points count huge", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.points.count = usize::MAX));
    case!(cases, "shx_solver_set_targets", "def", "points stride too small", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.points.stride = 23));
    case!(cases, "shx_solver_set_targets", "def", "points stride huge", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.points.stride = usize::MAX));
    case!(cases, "shx_solver_set_targets", "def", "points format 0", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.points.format = 0));
    case!(cases, "shx_solver_set_targets", "def", "points format 5", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.points.format = 5));
    case!(cases, "shx_solver_set_targets", "def", "points format u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.points.format = u32::MAX));
    case!(cases, "shx_solver_set_targets", "def", "points reserved", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.points.reserved = 1));
    case!(cases, "shx_solver_set_targets", "def", "points[3][1] f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| draw_with(s, f64::NAN));
    case!(cases, "shx_solver_set_targets", "def", "points[3][1] f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| draw_with(s, f64::INFINITY));
    case!(cases, "shx_solver_set_targets", "def", "points[3][1] f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| draw_with(s, f64::NEG_INFINITY));
    case!(cases, "shx_solver_set_targets", "def", "all points at one place", SHX_ERROR_INVALID_ARGUMENT, |s| { let before = std::mem::replace(&mut s.points, [[0.1; 3]; 4]); let result = draw(s, |_| ()); s.points = before; result });
    case!(cases, "shx_solver_set_targets", "def", "point_counts sum too small", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.point_counts = const { &[2_u32, 1] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "point_counts sum too large", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.point_counts = const { &[2_u32, 3] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "point_counts one point", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.point_counts = const { &[3_u32, 1] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "point_counts no point", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.point_counts = const { &[4_u32, 0] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "point_counts huge", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.point_counts = const { &[u32::MAX, u32::MAX] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "point_counts not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.point_counts = const { &[2_u32, 2, 2] }.as_ptr().cast::<u8>().wrapping_add(1).cast()));
    case!(cases, "shx_solver_set_targets", "def", "arclengths equal", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.arclengths = const { &[0.0, 0.1, 0.1, 0.1] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "arclengths falling", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.arclengths = const { &[0.0, 0.1, 0.1, 0.05] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "arclengths -0.1", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.arclengths = const { &[-0.1, 0.1, 0.0, 0.1] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "arclengths f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.arclengths = const { &[0.0, f64::NAN, 0.0, 0.1] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "arclengths f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.arclengths = const { &[0.0, f64::INFINITY, 0.0, 0.1] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "arclengths not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.arclengths = const { &[0.0_f64, 0.1, 0.0, 0.1, 0.0] }.as_ptr().cast::<u8>().wrapping_add(1).cast()));
    case!(cases, "shx_solver_set_targets", "def", "weights without their number", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0, 1.0] }.as_ptr(), const { &[1.0, 0.0] }.as_ptr(), 0)));
    case!(cases, "shx_solver_set_targets", "def", "weights null", SHX_ERROR_NULL_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0, 1.0] }.as_ptr(), null(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "weight_positions null", SHX_ERROR_NULL_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (null(), const { &[1.0, 0.0] }.as_ptr(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "weight_count without weights", SHX_ERROR_NULL_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (null(), null(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "weight_positions not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0_f64, 1.0, 1.0] }.as_ptr().cast::<u8>().wrapping_add(1).cast(), const { &[1.0, 0.0] }.as_ptr(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "weights not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0, 1.0] }.as_ptr(), const { &[0.0_f64, 1.0, 1.0] }.as_ptr().cast::<u8>().wrapping_add(1).cast(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "weights -0.1", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0, 1.0] }.as_ptr(), const { &[1.0, -0.1] }.as_ptr(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "weight_positions -0.1", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0, -0.1] }.as_ptr(), const { &[1.0, 0.0] }.as_ptr(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "strand_weights -0.1", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.strand_weights = const { &[1.0, -0.1] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "weights 1.1", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0, 1.0] }.as_ptr(), const { &[1.0, 1.1] }.as_ptr(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "weight_positions 1.1", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0, 1.1] }.as_ptr(), const { &[1.0, 0.0] }.as_ptr(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "strand_weights 1.1", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.strand_weights = const { &[1.0, 1.1] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "weights f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0, 1.0] }.as_ptr(), const { &[1.0, f64::NAN] }.as_ptr(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "weight_positions f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0, f64::NAN] }.as_ptr(), const { &[1.0, 0.0] }.as_ptr(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "strand_weights f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.strand_weights = const { &[1.0, f64::NAN] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "weights f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0, 1.0] }.as_ptr(), const { &[1.0, f64::INFINITY] }.as_ptr(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "weight_positions f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.0, f64::INFINITY] }.as_ptr(), const { &[1.0, 0.0] }.as_ptr(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "strand_weights f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.strand_weights = const { &[1.0, f64::INFINITY] }.as_ptr()));
    case!(cases, "shx_solver_set_targets", "def", "weight_positions equal", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| (def.weight_positions, def.weights, def.weight_count) = (const { &[0.5, 0.5] }.as_ptr(), const { &[1.0, 0.0] }.as_ptr(), 2)));
    case!(cases, "shx_solver_set_targets", "def", "strand_weights not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.strand_weights = const { &[1.0_f64, 1.0, 1.0] }.as_ptr().cast::<u8>().wrapping_add(1).cast()));
    case!(cases, "shx_solver_set_targets", "def", "time_constant 0.0", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.time_constant = 0.0));
    case!(cases, "shx_solver_set_targets", "def", "time_constant -0.1", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.time_constant = -0.1));
    case!(cases, "shx_solver_set_targets", "def", "time_constant f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.time_constant = f64::NAN));
    case!(cases, "shx_solver_set_targets", "def", "time_constant f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| draw(s, |def| def.time_constant = f64::INFINITY));
    case!(cases, "shx_solver_set_targets", "over_seconds", "-1e-9", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_target_def { curve_count: 2, points: s.point_input(), ..target_def() }; shx_solver_set_targets(s.solver, s.ids.as_ptr(), 2, &raw const def, -1e-9) });
    case!(cases, "shx_solver_set_targets", "over_seconds", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_target_def { curve_count: 2, points: s.point_input(), ..target_def() }; shx_solver_set_targets(s.solver, s.ids.as_ptr(), 2, &raw const def, f64::NAN) });
    case!(cases, "shx_solver_set_targets", "over_seconds", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_target_def { curve_count: 2, points: s.point_input(), ..target_def() }; shx_solver_set_targets(s.solver, s.ids.as_ptr(), 2, &raw const def, f64::INFINITY) });
    case!(cases, "shx_solver_clear_targets", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_clear_targets(null_mut(), s.ids.as_ptr(), 2));
    case!(cases, "shx_solver_clear_targets", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_clear_targets(s.solver, null(), 2));
    case!(cases, "shx_solver_clear_targets", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_clear_targets(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_clear_targets", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_clear_targets(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_clear_targets", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_clear_targets(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_clear_targets", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_clear_targets(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_clear_targets", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_clear_targets(s.solver, s.ids.as_ptr(), usize::MAX));
    case!(cases, "shx_solver_target_distances", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_target_distances(null(), s.ids.as_ptr(), 2, s.out()));
    case!(cases, "shx_solver_target_distances", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_target_distances(s.solver, null(), 2, s.out()));
    case!(cases, "shx_solver_target_distances", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_target_distances(s.solver, ids.as_ptr(), 2, s.out()) });
    case!(cases, "shx_solver_target_distances", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_target_distances(s.solver, ids.as_ptr(), 2, s.out()) });
    case!(cases, "shx_solver_target_distances", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_target_distances(s.solver, ids.as_ptr(), 2, s.out()) });
    case!(cases, "shx_solver_target_distances", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_target_distances(s.solver, ids.as_ptr(), 2, s.out()) });
    case!(cases, "shx_solver_target_distances", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_target_distances(s.solver, s.ids.as_ptr(), usize::MAX, s.out()));
    case!(cases, "shx_solver_target_distances", "out_distances", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_target_distances(s.solver, s.ids.as_ptr(), 2, null_mut()));
    case!(cases, "shx_solver_target_distances", "out_distances", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_target_distances(s.solver, s.ids.as_ptr(), 2, s.out::<u8>().wrapping_add(1).cast()));
}
