//! Bad input to the functions of overlaps: function, argument, fault, expected result code, call.

use super::*;

fn push_out_def() -> shx_push_out_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one definition, which the call fills.
    unsafe {
        assert_eq!(shx_push_out_def_init(def.as_mut_ptr(), size_of::<shx_push_out_def>()), SHX_OK);
        def.assume_init()
    }
}

/// Pushes curves out with a definition of these fields.
#[allow(clippy::too_many_arguments)] // the fields of the definition, and the outputs
unsafe fn push_out(
    solver: *mut shx_solver,
    body: shx_body_id,
    clearance: f64,
    point_counts: *const u32,
    curve_count: usize,
    points: *mut f64,
    out_depths: *mut f64,
    out_displacements: *mut f64,
    out_stuck: *mut u32,
) -> shx_result {
    let def = shx_push_out_def { body, clearance, point_counts, curve_count, ..push_out_def() };
    // SAFETY: as the caller says.
    unsafe { shx_solver_push_out_curves(solver, &raw const def, points, out_depths, out_displacements, out_stuck) }
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_push_out_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_push_out_def_init(null_mut(), size_of::<shx_push_out_def>()));
    case!(cases, "shx_push_out_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_push_out_def_init(s.out(), 0));
    case!(cases, "shx_push_out_def_init", "size", "too small", SHX_ERROR_STRUCT_SIZE, |s| shx_push_out_def_init(s.out(), size_of::<shx_push_out_def>() - 8));
    case!(cases, "shx_push_out_def_init", "size", "odd", SHX_ERROR_STRUCT_SIZE, |s| shx_push_out_def_init(s.out(), size_of::<shx_push_out_def>() + 1));
    case!(cases, "shx_push_out_def_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_push_out_def_init(s.out(), usize::MAX));
    case!(cases, "shx_solver_push_out_curves", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_push_out_curves(s.solver, null(), s.out(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "def", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| { let mut def = push_out_def(); def.struct_size = 0; shx_solver_push_out_curves(s.solver, &raw const def, s.out(), null_mut(), null_mut(), null_mut()) });
    case!(cases, "shx_solver_push_out_curves", "def", "as it was made", SHX_ERROR_INVALID_ID, |s| shx_solver_push_out_curves(s.solver, &push_out_def(), s.out(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "def", "reserved0", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut def = push_out_def(); def.reserved0 = 1; shx_solver_push_out_curves(s.solver, &raw const def, s.out(), null_mut(), null_mut(), null_mut()) });
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
    case!(cases, "shx_solver_permit_overlaps", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_permit_overlaps(null_mut(), s.ids.as_ptr(), 2));
    case!(cases, "shx_solver_permit_overlaps", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_permit_overlaps(s.solver, null(), 2));
    case!(cases, "shx_solver_permit_overlaps", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_permit_overlaps(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_permit_overlaps", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_permit_overlaps(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_permit_overlaps", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_permit_overlaps(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_permit_overlaps", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_permit_overlaps(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_permit_overlaps", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_permit_overlaps(s.solver, s.ids.as_ptr(), usize::MAX));
    case!(cases, "shx_solver_permit_overlaps", "ids", "twice", SHX_ERROR_INVALID_ARGUMENT, |s| { let ids = [s.ids[0], s.ids[0]]; shx_solver_permit_overlaps(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_set_permitted_overlap", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_permitted_overlap(null_mut(), s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "id", "zero", SHX_ERROR_INVALID_ID, |s| shx_solver_set_permitted_overlap(s.solver, shx_strand_id { bits: 0 }, [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "id", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_set_permitted_overlap(s.solver, s.stale[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "id", "foreign", SHX_ERROR_INVALID_ID, |s| shx_solver_set_permitted_overlap(s.solver, s.foreign[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "id", "nonsense", SHX_ERROR_INVALID_ID, |s| shx_solver_set_permitted_overlap(s.solver, shx_strand_id { bits: u64::MAX }, [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "arclengths", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], null(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "arclengths", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], s.rows.as_ptr().cast::<u8>().wrapping_add(1).cast(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "arclengths", "[1] = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, f64::NAN].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "arclengths", "[1] = f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, f64::INFINITY].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "arclengths", "[1] = -1e-9", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, -1e-9].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "wisp_fractions", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), null(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "wisp_fractions", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), s.rows.as_ptr().cast::<u8>().wrapping_add(1).cast(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "wisp_fractions", "[1] = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [0.0, f64::NAN].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "wisp_fractions", "[1] = f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [0.0, f64::INFINITY].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "wisp_fractions", "[1] = -1e-9", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [0.0, -1e-9].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "body_depths", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), null(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "body_depths", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), s.rows.as_ptr().cast::<u8>().wrapping_add(1).cast(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "body_depths", "[1] = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, f64::NAN].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "body_depths", "[1] = f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, f64::INFINITY].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "body_depths", "[1] = -1e-9", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, -1e-9].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "arclengths", "not rising", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.1, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "wisp_fractions", "[0] = 1.1", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.1, 0.1].as_ptr(), [0.0, 1e-3].as_ptr(), 2));
    case!(cases, "shx_solver_set_permitted_overlap", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_set_permitted_overlap(s.solver, s.ids[0], [0.0, 0.1].as_ptr(), [1.0, 0.5].as_ptr(), [0.0, 1e-3].as_ptr(), usize::MAX));
    case!(cases, "shx_solver_get_permitted_overlap", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_permitted_overlap(null(), s.ids[0], s.out(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_permitted_overlap", "id", "zero", SHX_ERROR_INVALID_ID, |s| shx_solver_get_permitted_overlap(s.solver, shx_strand_id { bits: 0 }, s.out(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_permitted_overlap", "id", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_get_permitted_overlap(s.solver, s.stale[0], s.out(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_permitted_overlap", "id", "foreign", SHX_ERROR_INVALID_ID, |s| shx_solver_get_permitted_overlap(s.solver, s.foreign[0], s.out(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_permitted_overlap", "id", "nonsense", SHX_ERROR_INVALID_ID, |s| shx_solver_get_permitted_overlap(s.solver, shx_strand_id { bits: u64::MAX }, s.out(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_permitted_overlap", "out_arclengths", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_permitted_overlap(s.solver, s.ids[0], s.out::<u8>().wrapping_add(1).cast(), null_mut(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_permitted_overlap", "out_wisp_fractions", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_permitted_overlap(s.solver, s.ids[0], null_mut(), s.out::<u8>().wrapping_add(1).cast(), null_mut(), 8, s.out2()));
    case!(cases, "shx_solver_get_permitted_overlap", "out_body_depths", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_permitted_overlap(s.solver, s.ids[0], null_mut(), null_mut(), s.out::<u8>().wrapping_add(1).cast(), 8, s.out2()));
    case!(cases, "shx_solver_get_permitted_overlap", "capacity", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_permitted_overlap(s.solver, s.ids[0], s.out(), null_mut(), null_mut(), usize::MAX, s.out2()));
    case!(cases, "shx_solver_get_permitted_overlap", "out_count", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_permitted_overlap(s.solver, s.ids[0], s.out(), null_mut(), null_mut(), 8, null_mut()));
    case!(cases, "shx_solver_get_permitted_overlap", "out_count", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_get_permitted_overlap(s.solver, s.ids[0], s.out(), null_mut(), null_mut(), 8, s.out2::<u8>().wrapping_add(1).cast()));
    case!(cases, "shx_solver_push_out_curves", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| push_out(null_mut(), s.bodies[0], 1e-3, [2_u32].as_ptr(), 1, [0.0_f64; 6].as_mut_ptr(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "def", "body zero", SHX_ERROR_INVALID_ID, |s| push_out(s.solver, shx_body_id { bits: 0 }, 1e-3, [2_u32].as_ptr(), 1, [0.0_f64; 6].as_mut_ptr(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "def", "body nonsense", SHX_ERROR_INVALID_ID, |s| push_out(s.solver, shx_body_id { bits: u64::MAX }, 1e-3, [2_u32].as_ptr(), 1, [0.0_f64; 6].as_mut_ptr(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "def", "clearance -1e-9", SHX_ERROR_INVALID_ARGUMENT, |s| push_out(s.solver, s.bodies[0], -1e-9, [2_u32].as_ptr(), 1, [0.0_f64; 6].as_mut_ptr(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "def", "clearance f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| push_out(s.solver, s.bodies[0], f64::NAN, [2_u32].as_ptr(), 1, [0.0_f64; 6].as_mut_ptr(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "def", "clearance f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| push_out(s.solver, s.bodies[0], f64::INFINITY, [2_u32].as_ptr(), 1, [0.0_f64; 6].as_mut_ptr(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "def", "counts null", SHX_ERROR_NULL_ARGUMENT, |s| push_out(s.solver, s.bodies[0], 1e-3, null(), 1, [0.0_f64; 6].as_mut_ptr(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "def", "counts not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| push_out(s.solver, s.bodies[0], 1e-3, [2_u32, 2].as_ptr().cast::<u8>().wrapping_add(1).cast(), 1, [0.0_f64; 6].as_mut_ptr(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "def", "count huge", SHX_ERROR_INVALID_ARGUMENT, |s| push_out(s.solver, s.bodies[0], 1e-3, [2_u32].as_ptr(), usize::MAX, [0.0_f64; 6].as_mut_ptr(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "points", "null", SHX_ERROR_NULL_ARGUMENT, |s| push_out(s.solver, s.bodies[0], 1e-3, [2_u32].as_ptr(), 1, null_mut(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "points", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| push_out(s.solver, s.bodies[0], 1e-3, [2_u32].as_ptr(), 1, s.out::<u8>().wrapping_add(1).cast(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "points", "[4] = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| push_out(s.solver, s.bodies[0], 1e-3, [2_u32].as_ptr(), 1, [0.0, 0.0, 0.0, 0.0, f64::NAN, 0.0].as_mut_ptr(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "out_depths", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| push_out(s.solver, s.bodies[0], 1e-3, [2_u32].as_ptr(), 1, [0.0_f64; 6].as_mut_ptr(), s.out::<u8>().wrapping_add(1).cast(), null_mut(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "out_displacements", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| push_out(s.solver, s.bodies[0], 1e-3, [2_u32].as_ptr(), 1, [0.0_f64; 6].as_mut_ptr(), null_mut(), s.out::<u8>().wrapping_add(1).cast(), null_mut()));
    case!(cases, "shx_solver_push_out_curves", "out_stuck", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| push_out(s.solver, s.bodies[0], 1e-3, [2_u32].as_ptr(), 1, [0.0_f64; 6].as_mut_ptr(), null_mut(), null_mut(), s.out::<u8>().wrapping_add(1).cast()));
}
