//! Bad input to the functions of snapshots: function, argument, fault, expected result code, call.

use super::*;

fn restore_def() -> shx_restore_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_restore_def_init(def.as_mut_ptr(), size_of::<shx_restore_def>()), SHX_OK);
        def.assume_init()
    }
}

fn snapshot_def() -> shx_snapshot_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_snapshot_def_init(def.as_mut_ptr(), size_of::<shx_snapshot_def>()), SHX_OK);
        def.assume_init()
    }
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_restore_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_restore_def_init(null_mut(), size_of::<shx_restore_def>()));
    case!(cases, "shx_restore_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_restore_def_init(s.out(), 0));
    case!(cases, "shx_restore_def_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_restore_def_init(s.out(), 4));
    case!(cases, "shx_restore_def_init", "size", "size_of::<shx_restore_def>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_restore_def_init(s.out(), size_of::<shx_restore_def>() + 1));
    case!(cases, "shx_restore_def_init", "size", "size_of::<shx_restore_def>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_restore_def_init(s.out(), size_of::<shx_restore_def>() + 4));
    case!(cases, "shx_restore_def_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_restore_def_init(s.out(), 1 << 20));
    case!(cases, "shx_restore_def_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_restore_def_init(s.out(), usize::MAX));
    case!(cases, "shx_solver_restore_with", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = restore_def(); shx_solver_restore_with(null_mut(), s.rows.as_ptr().cast(), 24, &raw const def) });
    case!(cases, "shx_solver_restore_with", "image", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = restore_def(); shx_solver_restore_with(s.solver, null(), 0, &raw const def) });
    case!(cases, "shx_solver_restore_with", "image", "nonsense", SHX_ERROR_SNAPSHOT, |s| { let def = restore_def(); shx_solver_restore_with(s.solver, s.rows.as_ptr().cast(), 72, &raw const def) });
    case!(cases, "shx_solver_restore_with", "size", "0", SHX_ERROR_SNAPSHOT, |s| { let def = restore_def(); shx_solver_restore_with(s.solver, s.rows.as_ptr().cast(), 0, &raw const def) });
    case!(cases, "shx_solver_restore_with", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_restore_with(s.solver, s.rows.as_ptr().cast(), 72, null()));
    case!(cases, "shx_solver_restore_with", "def", "struct_size 4", SHX_ERROR_STRUCT_SIZE, |s| { let def = shx_restore_def { struct_size: 4, ..restore_def() }; shx_solver_restore_with(s.solver, s.rows.as_ptr().cast(), 72, &raw const def) });
    case!(cases, "shx_solver_restore_with", "def", "options 3", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_restore_def { options: 3, ..restore_def() }; shx_solver_restore_with(s.solver, s.rows.as_ptr().cast(), 72, &raw const def) });
    case!(cases, "shx_solver_restore_with", "def", "options 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_restore_def { options: 0, ..restore_def() }; shx_solver_restore_with(s.solver, s.rows.as_ptr().cast(), 72, &raw const def) });
    case!(cases, "shx_snapshot_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_snapshot_def_init(null_mut(), size_of::<shx_snapshot_def>()));
    case!(cases, "shx_snapshot_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_snapshot_def_init(s.out(), 0));
    case!(cases, "shx_snapshot_def_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_snapshot_def_init(s.out(), 4));
    case!(cases, "shx_snapshot_def_init", "size", "size_of::<shx_snapshot_def>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_snapshot_def_init(s.out(), size_of::<shx_snapshot_def>() + 1));
    case!(cases, "shx_snapshot_def_init", "size", "size_of::<shx_snapshot_def>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_snapshot_def_init(s.out(), size_of::<shx_snapshot_def>() + 4));
    case!(cases, "shx_snapshot_def_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_snapshot_def_init(s.out(), 1 << 20));
    case!(cases, "shx_snapshot_def_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_snapshot_def_init(s.out(), usize::MAX));
    case!(cases, "shx_solver_snapshot_with", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = snapshot_def(); shx_solver_snapshot_with(null(), &raw const def, s.out(), 8192, s.out2()) });
    case!(cases, "shx_solver_snapshot_with", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_snapshot_with(s.solver, null(), s.out(), 8192, s.out2()));
    case!(cases, "shx_solver_snapshot_with", "def", "struct_size 4", SHX_ERROR_STRUCT_SIZE, |s| { let def = shx_snapshot_def { struct_size: 4, ..snapshot_def() }; shx_solver_snapshot_with(s.solver, &raw const def, s.out(), 8192, s.out2()) });
    case!(cases, "shx_solver_snapshot_with", "def", "shapes 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_snapshot_def { shapes: 0, ..snapshot_def() }; shx_solver_snapshot_with(s.solver, &raw const def, s.out(), 8192, s.out2()) });
    case!(cases, "shx_solver_snapshot_with", "def", "shapes 3", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_snapshot_def { shapes: 3, ..snapshot_def() }; shx_solver_snapshot_with(s.solver, &raw const def, s.out(), 8192, s.out2()) });
    case!(cases, "shx_solver_snapshot_with", "out_image", "null with a capacity", SHX_ERROR_NULL_ARGUMENT, |s| { let def = snapshot_def(); shx_solver_snapshot_with(s.solver, &raw const def, null_mut(), 8192, s.out2()) });
    case!(cases, "shx_solver_snapshot_with", "capacity", "1", SHX_ERROR_BUFFER_TOO_SMALL, |s| { let def = snapshot_def(); shx_solver_snapshot_with(s.solver, &raw const def, s.out(), 1, s.out2()) });
    case!(cases, "shx_solver_snapshot_with", "capacity", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = snapshot_def(); shx_solver_snapshot_with(s.solver, &raw const def, s.out(), usize::MAX, s.out2()) });
    case!(cases, "shx_solver_snapshot_with", "out_size", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = snapshot_def(); shx_solver_snapshot_with(s.solver, &raw const def, s.out(), 4096, null_mut()) });
    case!(cases, "shx_solver_snapshot_shapes", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_snapshot_shapes(null(), s.out(), 8192, s.out2()));
    case!(cases, "shx_solver_snapshot_shapes", "out_image", "null with a capacity", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_snapshot_shapes(s.solver, null_mut(), 8192, s.out2()));
    case!(cases, "shx_solver_snapshot_shapes", "capacity", "1", SHX_ERROR_BUFFER_TOO_SMALL, |s| shx_solver_snapshot_shapes(s.solver, s.out(), 1, s.out2()));
    case!(cases, "shx_solver_snapshot_shapes", "capacity", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_snapshot_shapes(s.solver, s.out(), usize::MAX, s.out2()));
    case!(cases, "shx_solver_snapshot_shapes", "out_size", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_snapshot_shapes(s.solver, s.out(), 4096, null_mut()));
    case!(cases, "shx_solver_restore_with", "def", "shapes null with a size", SHX_ERROR_NULL_ARGUMENT, |s| { let def = shx_restore_def { shapes_size: 8, ..restore_def() }; shx_solver_restore_with(s.solver, s.rows.as_ptr().cast(), 72, &raw const def) });
    case!(cases, "shx_solver_restore_with", "def", "shapes_size huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_restore_def { shapes: s.rows.as_ptr().cast(), shapes_size: usize::MAX, ..restore_def() }; shx_solver_restore_with(s.solver, s.rows.as_ptr().cast(), 72, &raw const def) });
}
