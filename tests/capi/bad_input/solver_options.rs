//! Bad input to the functions of a solver's options: function, argument, fault, expected result code, call.

use super::*;

/// The options of the scene's solver.
fn options() -> shx_solver_options {
    let mut options = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_solver_options_init(options.as_mut_ptr(), size_of::<shx_solver_options>()), SHX_OK);
        options.assume_init()
    }
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_solver_options_init", "options", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_options_init(null_mut(), size_of::<shx_solver_options>()));
    case!(cases, "shx_solver_options_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_options_init(s.out(), 0));
    case!(cases, "shx_solver_options_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_options_init(s.out(), 4));
    case!(cases, "shx_solver_options_init", "size", "size_of::<shx_solver_options>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_options_init(s.out(), size_of::<shx_solver_options>() + 1));
    case!(cases, "shx_solver_options_init", "size", "size_of::<shx_solver_options>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_options_init(s.out(), size_of::<shx_solver_options>() + 4));
    case!(cases, "shx_solver_options_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_options_init(s.out(), 1 << 20));
    case!(cases, "shx_solver_options_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_options_init(s.out(), usize::MAX));
    case!(cases, "shx_solver_get_options", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let mut options = options(); shx_solver_get_options(null(), &raw mut options) });
    case!(cases, "shx_solver_get_options", "out_options", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_get_options(s.solver, null_mut()));
    case!(cases, "shx_solver_get_options", "out_options", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| { let mut options = shx_solver_options { struct_size: 0, ..options() }; shx_solver_get_options(s.solver, &raw mut options) });
    case!(cases, "shx_solver_set_options", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let options = options(); shx_solver_set_options(null_mut(), &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_set_options(s.solver, null()));
    case!(cases, "shx_solver_set_options", "options", "struct_size = 0", SHX_ERROR_STRUCT_SIZE, |s| { let options = shx_solver_options { struct_size: 0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "struct_size = 4", SHX_ERROR_STRUCT_SIZE, |s| { let options = shx_solver_options { struct_size: 4, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "struct_size = 77", SHX_ERROR_STRUCT_SIZE, |s| { let options = shx_solver_options { struct_size: 77, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "struct_size = u32::MAX", SHX_ERROR_STRUCT_SIZE, |s| { let options = shx_solver_options { struct_size: u32::MAX, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "integrator = 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { integrator: 0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "integrator = 9", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { integrator: 9, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "integrator = u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { integrator: u32::MAX, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "linear_solver = 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { linear_solver: 0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "linear_solver = 9", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { linear_solver: 9, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "linear_solver = u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { linear_solver: u32::MAX, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "precision = 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { precision: 0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "precision = 9", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { precision: 9, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "precision = u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { precision: u32::MAX, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "instruction_set = 77", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { instruction_set: 77, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "max_iterations = 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { max_iterations: 0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "max_iterations = 10_001", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { max_iterations: 10_001, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "exact_hessian = 2", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { exact_hessian: 2, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "max_subdivisions = 11", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { max_subdivisions: 11, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "reserved0 = 1", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { reserved0: 1, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "worker_count = 2", SHX_ERROR_UNSUPPORTED, |s| { let options = shx_solver_options { worker_count: 2, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "worker_count = 0", SHX_ERROR_UNSUPPORTED, |s| { let options = shx_solver_options { worker_count: 0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "gravity = [f64::NAN, 0.0, 0.0]", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { gravity: [f64::NAN, 0.0, 0.0], ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "gravity = [0.0, f64::INFINITY, 0.0]", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { gravity: [0.0, f64::INFINITY, 0.0], ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "gravity = [0.0, 0.0, f64::NEG_INFINITY]", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { gravity: [0.0, 0.0, f64::NEG_INFINITY], ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "wind = [f64::NAN, 0.0, 0.0]", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { wind: [f64::NAN, 0.0, 0.0], ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "wind = [0.0, f64::INFINITY, 0.0]", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { wind: [0.0, f64::INFINITY, 0.0], ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "wind = [0.0, 0.0, f64::NEG_INFINITY]", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { wind: [0.0, 0.0, f64::NEG_INFINITY], ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "tolerance = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { tolerance: f64::NAN, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "tolerance = -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { tolerance: -1.0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "tolerance = f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { tolerance: f64::NEG_INFINITY, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "error_tolerance = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { error_tolerance: f64::NAN, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "error_tolerance = -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { error_tolerance: -1.0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "error_tolerance = f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { error_tolerance: f64::NEG_INFINITY, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "reference_tolerance = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { reference_tolerance: f64::NAN, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "reference_tolerance = -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { reference_tolerance: -1.0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "reference_tolerance = f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { reference_tolerance: f64::NEG_INFINITY, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "quadrature_tolerance = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { quadrature_tolerance: f64::NAN, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "quadrature_tolerance = -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { quadrature_tolerance: -1.0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "quadrature_tolerance = f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { quadrature_tolerance: f64::NEG_INFINITY, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "jump_acceleration = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { jump_acceleration: f64::NAN, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "jump_acceleration = -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { jump_acceleration: -1.0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "jump_acceleration = f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { jump_acceleration: f64::NEG_INFINITY, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "max_seconds = f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { max_seconds: f64::NAN, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "max_seconds = -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { max_seconds: -1.0, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "max_seconds = f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { max_seconds: f64::NEG_INFINITY, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
    case!(cases, "shx_solver_set_options", "options", "max_seconds = f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let options = shx_solver_options { max_seconds: f64::INFINITY, ..options() }; shx_solver_set_options(s.solver, &raw const options) });
}
