//! Bad input to the functions of definitions: function, argument, fault, expected result code, call.

use super::*;

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_solver_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_def_init(null_mut(), size_of::<shx_solver_def>()));
    case!(cases, "shx_solver_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_def_init(s.out(), 0));
    case!(cases, "shx_solver_def_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_def_init(s.out(), 4));
    case!(cases, "shx_solver_def_init", "size", "size_of::<shx_solver_def>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_def_init(s.out(), size_of::<shx_solver_def>() + 1));
    case!(cases, "shx_solver_def_init", "size", "size_of::<shx_solver_def>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_def_init(s.out(), size_of::<shx_solver_def>() + 4));
    case!(cases, "shx_solver_def_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_def_init(s.out(), 1 << 20));
    case!(cases, "shx_solver_def_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_solver_def_init(s.out(), usize::MAX));
    case!(cases, "shx_strand_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_strand_def_init(null_mut(), size_of::<shx_strand_def>()));
    case!(cases, "shx_strand_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_strand_def_init(s.out(), 0));
    case!(cases, "shx_strand_def_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_strand_def_init(s.out(), 4));
    case!(cases, "shx_strand_def_init", "size", "size_of::<shx_strand_def>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_strand_def_init(s.out(), size_of::<shx_strand_def>() + 1));
    case!(cases, "shx_strand_def_init", "size", "size_of::<shx_strand_def>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_strand_def_init(s.out(), size_of::<shx_strand_def>() + 4));
    case!(cases, "shx_strand_def_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_strand_def_init(s.out(), 1 << 20));
    case!(cases, "shx_strand_def_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_strand_def_init(s.out(), usize::MAX));
    case!(cases, "shx_sample_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_sample_def_init(null_mut(), size_of::<shx_sample_def>()));
    case!(cases, "shx_sample_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_sample_def_init(s.out(), 0));
    case!(cases, "shx_sample_def_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_sample_def_init(s.out(), 4));
    case!(cases, "shx_sample_def_init", "size", "size_of::<shx_sample_def>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_sample_def_init(s.out(), size_of::<shx_sample_def>() + 1));
    case!(cases, "shx_sample_def_init", "size", "size_of::<shx_sample_def>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_sample_def_init(s.out(), size_of::<shx_sample_def>() + 4));
    case!(cases, "shx_sample_def_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_sample_def_init(s.out(), 1 << 20));
    case!(cases, "shx_sample_def_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_sample_def_init(s.out(), usize::MAX));
    case!(cases, "shx_step_report_init", "report", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_step_report_init(null_mut(), size_of::<shx_step_report>()));
    case!(cases, "shx_step_report_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_step_report_init(s.out(), 0));
    case!(cases, "shx_step_report_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_step_report_init(s.out(), 4));
    case!(cases, "shx_step_report_init", "size", "size_of::<shx_step_report>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_step_report_init(s.out(), size_of::<shx_step_report>() + 1));
    case!(cases, "shx_step_report_init", "size", "size_of::<shx_step_report>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_step_report_init(s.out(), size_of::<shx_step_report>() + 4));
    case!(cases, "shx_step_report_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_step_report_init(s.out(), 1 << 20));
    case!(cases, "shx_step_report_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_step_report_init(s.out(), usize::MAX));
    case!(cases, "shx_step_limits_init", "limits", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_step_limits_init(null_mut(), size_of::<shx_step_limits>()));
    case!(cases, "shx_step_limits_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_step_limits_init(s.out(), 0));
    case!(cases, "shx_step_limits_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_step_limits_init(s.out(), 4));
    case!(cases, "shx_step_limits_init", "size", "size_of::<shx_step_limits>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_step_limits_init(s.out(), size_of::<shx_step_limits>() + 1));
    case!(cases, "shx_step_limits_init", "size", "size_of::<shx_step_limits>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_step_limits_init(s.out(), size_of::<shx_step_limits>() + 4));
    case!(cases, "shx_step_limits_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_step_limits_init(s.out(), 1 << 20));
    case!(cases, "shx_step_limits_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_step_limits_init(s.out(), usize::MAX));
    case!(cases, "shx_polyline_fit_init", "fit", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_polyline_fit_init(null_mut(), size_of::<shx_polyline_fit>()));
    case!(cases, "shx_polyline_fit_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_polyline_fit_init(s.out(), 0));
    case!(cases, "shx_polyline_fit_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_polyline_fit_init(s.out(), 4));
    case!(cases, "shx_polyline_fit_init", "size", "size_of::<shx_polyline_fit>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_polyline_fit_init(s.out(), size_of::<shx_polyline_fit>() + 1));
    case!(cases, "shx_polyline_fit_init", "size", "size_of::<shx_polyline_fit>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_polyline_fit_init(s.out(), size_of::<shx_polyline_fit>() + 4));
    case!(cases, "shx_polyline_fit_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_polyline_fit_init(s.out(), 1 << 20));
    case!(cases, "shx_polyline_fit_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_polyline_fit_init(s.out(), usize::MAX));
}
