//! Bad input to what calls the host back: debug drawing, a field of wind, an allocator. Function, argument, what is wrong with it, the code that it must
//! give, the call.

use std::ffi::c_void;

use superhelix::internals::capi::base::allocator::shx_set_allocator;
use superhelix::internals::capi::reading::debug_draw::*;
use superhelix::internals::capi::simulation::wind::shx_solver_set_wind_field;

use super::*;

unsafe extern "C" fn vertices(_: *mut c_void, _: *const shx_debug_vertex, _: usize) {
    std::process::abort();
}

unsafe extern "C" fn wind(_: *mut c_void, _: f64, _: *const f64, _: *mut f64, _: usize) {}

unsafe extern "C" fn alloc(_: *mut c_void, size: usize, alignment: usize) -> *mut c_void {
    // SAFETY: a layout of the test's own call.
    unsafe { std::alloc::alloc(std::alloc::Layout::from_size_align_unchecked(size, alignment)).cast() }
}

unsafe extern "C" fn free(_: *mut c_void, memory: *mut c_void, size: usize, alignment: usize) {
    // SAFETY: as above.
    unsafe { std::alloc::dealloc(memory.cast(), std::alloc::Layout::from_size_align_unchecked(size, alignment)) };
}

fn draw_def() -> shx_debug_draw_def {
    let mut def = std::mem::MaybeUninit::<shx_debug_draw_def>::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_debug_draw_def_init(def.as_mut_ptr(), size_of::<shx_debug_draw_def>()), SHX_OK);
        shx_debug_draw_def { lines: Some(vertices), points: Some(vertices), ..def.assume_init() }
    }
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_debug_draw_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_debug_draw_def_init(null_mut(), size_of::<shx_debug_draw_def>()));
    case!(cases, "shx_debug_draw_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_debug_draw_def_init(s.out(), 0));
    case!(cases, "shx_debug_draw_def_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_debug_draw_def_init(s.out(), 4));
    case!(cases, "shx_debug_draw_def_init", "size", "size_of::<shx_debug_draw_def>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_debug_draw_def_init(s.out(), size_of::<shx_debug_draw_def>() + 1));
    case!(cases, "shx_debug_draw_def_init", "size", "size_of::<shx_debug_draw_def>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_debug_draw_def_init(s.out(), size_of::<shx_debug_draw_def>() + 4));
    case!(cases, "shx_debug_draw_def_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_debug_draw_def_init(s.out(), 1 << 20));
    case!(cases, "shx_debug_draw_def_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_debug_draw_def_init(s.out(), usize::MAX));
    case!(cases, "shx_solver_debug_draw", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = draw_def(); shx_solver_debug_draw(null(), &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_debug_draw(s.solver, null()));
    case!(cases, "shx_solver_debug_draw", "def", "struct_size 4", SHX_ERROR_STRUCT_SIZE, |s| { let def = shx_debug_draw_def { struct_size: 4, ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "layers 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_debug_draw_def { layers: 0, ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "layers 64", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_debug_draw_def { layers: 64, ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "points_per_strand 1", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_debug_draw_def { points_per_strand: 1, ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "points_per_strand 4097", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_debug_draw_def { points_per_strand: 4097, ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "reserved 1", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_debug_draw_def { reserved: 1, ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "frame_length 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_debug_draw_def { frame_length: 0.0, ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "normal_length NaN", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_debug_draw_def { normal_length: f64::NAN, ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "force_scale -1", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_debug_draw_def { force_scale: -1.0, ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "origin[2] infinite", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_debug_draw_def { origin: [0.0, 0.0, f64::INFINITY], ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "y_axis along x", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = shx_debug_draw_def { y_axis: [1.0, 0.0, 0.0], ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_debug_draw", "def", "no callbacks", SHX_ERROR_NULL_ARGUMENT, |s| { let def = shx_debug_draw_def { lines: None, points: None, ..draw_def() }; shx_solver_debug_draw(s.solver, &raw const def) });
    case!(cases, "shx_solver_set_wind_field", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_wind_field(null_mut(), Some(wind), null_mut()));
    case!(cases, "shx_solver_set_wind_field", "function", "null: none", SHX_OK, |s| shx_solver_set_wind_field(s.solver, None, null_mut()));
    case!(cases, "shx_solver_set_wind_field", "user", "null", SHX_OK, |s| shx_solver_set_wind_field(s.solver, Some(wind), null_mut()));
    case!(cases, "shx_set_allocator", "alloc", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_set_allocator(None, Some(free), null_mut()));
    case!(cases, "shx_set_allocator", "free", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_set_allocator(Some(alloc), None, null_mut()));
    case!(cases, "shx_set_allocator", "user", "null, in a program in Rust", SHX_ERROR_UNSUPPORTED, |s| shx_set_allocator(Some(alloc), Some(free), null_mut()));
}
