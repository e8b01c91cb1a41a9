//! Bad input to the functions of settle: function, argument, fault, expected result code, call.

use super::*;

fn settle_def() -> shx_settle_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one definition, which the call fills.
    unsafe {
        assert_eq!(shx_settle_def_init(def.as_mut_ptr(), size_of::<shx_settle_def>()), SHX_OK);
        def.assume_init()
    }
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_settle_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_settle_def_init(null_mut(), size_of::<shx_settle_def>()));
    case!(cases, "shx_settle_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_def_init(s.out(), 0));
    case!(cases, "shx_settle_def_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_def_init(s.out(), 4));
    case!(cases, "shx_settle_def_init", "size", "size_of::<shx_settle_def>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_def_init(s.out(), size_of::<shx_settle_def>() + 1));
    case!(cases, "shx_settle_def_init", "size", "size_of::<shx_settle_def>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_def_init(s.out(), size_of::<shx_settle_def>() + 4));
    case!(cases, "shx_settle_def_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_def_init(s.out(), 1 << 20));
    case!(cases, "shx_settle_def_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_def_init(s.out(), usize::MAX));
    case!(cases, "shx_settle_report_init", "report", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_settle_report_init(null_mut(), size_of::<shx_settle_report>()));
    case!(cases, "shx_settle_report_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_report_init(s.out(), 0));
    case!(cases, "shx_settle_report_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_report_init(s.out(), 4));
    case!(cases, "shx_settle_report_init", "size", "size_of::<shx_settle_report>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_report_init(s.out(), size_of::<shx_settle_report>() + 1));
    case!(cases, "shx_settle_report_init", "size", "size_of::<shx_settle_report>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_report_init(s.out(), size_of::<shx_settle_report>() + 4));
    case!(cases, "shx_settle_report_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_report_init(s.out(), 1 << 20));
    case!(cases, "shx_settle_report_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_settle_report_init(s.out(), usize::MAX));
    case!(cases, "shx_solver_settle", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_settle(null_mut(), s.ids.as_ptr(), 2, null(), null_mut(), s.out(), s.out2(), null_mut()));
    case!(cases, "shx_solver_settle", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_settle(s.solver, null(), 2, null(), null_mut(), s.out(), s.out2(), null_mut()));
    case!(cases, "shx_solver_settle", "ids", "zero", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: 0 }]; shx_solver_settle(s.solver, ids.as_ptr(), 2, null(), null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_solver_settle(s.solver, ids.as_ptr(), 2, null(), null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.foreign[0]]; shx_solver_settle(s.solver, ids.as_ptr(), 2, null(), null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "ids", "nonsense", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], shx_strand_id { bits: u64::MAX }]; shx_solver_settle(s.solver, ids.as_ptr(), 2, null(), null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_settle(s.solver, s.ids.as_ptr(), usize::MAX, null(), null_mut(), s.out(), s.out2(), null_mut()));
    case!(cases, "shx_solver_settle", "def", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| { let def = shx_settle_def { struct_size: 0, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "struct_size 4", SHX_ERROR_STRUCT_SIZE, |s| { let def = shx_settle_def { struct_size: 4, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "struct_size 12", SHX_ERROR_STRUCT_SIZE, |s| { let def = shx_settle_def { struct_size: 12, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "struct_size 25", SHX_ERROR_STRUCT_SIZE, |s| { let def = shx_settle_def { struct_size: 25, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "struct_size u32::MAX", SHX_ERROR_STRUCT_SIZE, |s| { let def = shx_settle_def { struct_size: u32::MAX, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "max_steps 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_settle_def { max_steps: 0, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "max_steps 100_001", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_settle_def { max_steps: 100_001, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "tolerance 0.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_settle_def { tolerance: 0.0, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "tolerance -1e-9", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_settle_def { tolerance: -1e-9, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "tolerance f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_settle_def { tolerance: f64::NAN, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "tolerance f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_settle_def { tolerance: f64::INFINITY, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "check_stability 2", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_settle_def { check_stability: 2, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "def", "reserved 1", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_settle_def { reserved: 1, ..settle_def() }; shx_solver_settle(s.solver, s.ids.as_ptr(), 2, &raw const def, null_mut(), s.out(), s.out2(), null_mut()) });
    case!(cases, "shx_solver_settle", "report", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| { s.out::<u32>().write(0); let result = shx_solver_settle(s.solver, s.ids.as_ptr(), 2, null(), s.out(), null_mut(), s.out2(), null_mut()); s.out::<u32>().write(u32::from_ne_bytes([UNTOUCHED; 4])); result });
    case!(cases, "shx_solver_settle", "report", "struct_size 12", SHX_ERROR_STRUCT_SIZE, |s| { s.out::<u32>().write(12); let result = shx_solver_settle(s.solver, s.ids.as_ptr(), 2, null(), s.out(), null_mut(), s.out2(), null_mut()); s.out::<u32>().write(u32::from_ne_bytes([UNTOUCHED; 4])); result });
    case!(cases, "shx_solver_settle", "report", "struct_size 49", SHX_ERROR_STRUCT_SIZE, |s| { s.out::<u32>().write(49); let result = shx_solver_settle(s.solver, s.ids.as_ptr(), 2, null(), s.out(), null_mut(), s.out2(), null_mut()); s.out::<u32>().write(u32::from_ne_bytes([UNTOUCHED; 4])); result });
    case!(cases, "shx_solver_settle", "report", "struct_size u32::MAX", SHX_ERROR_STRUCT_SIZE, |s| { s.out::<u32>().write(u32::MAX); let result = shx_solver_settle(s.solver, s.ids.as_ptr(), 2, null(), s.out(), null_mut(), s.out2(), null_mut()); s.out::<u32>().write(u32::from_ne_bytes([UNTOUCHED; 4])); result });
    case!(cases, "shx_solver_settle", "out_status", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_settle(s.solver, s.ids.as_ptr(), 2, null(), null_mut(), s.out::<u8>().wrapping_add(1).cast(), null_mut(), null_mut()));
    case!(cases, "shx_solver_settle", "out_eigenvalues", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_settle(s.solver, s.ids.as_ptr(), 2, null(), null_mut(), null_mut(), s.out::<u8>().wrapping_add(1).cast(), null_mut()));
    case!(cases, "shx_solver_settle", "out_residuals", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_settle(s.solver, s.ids.as_ptr(), 2, null(), null_mut(), null_mut(), null_mut(), s.out::<u8>().wrapping_add(1).cast()));
}
