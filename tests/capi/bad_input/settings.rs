//! Bad input to the functions of settings: function, argument, fault, expected result code, call.

use super::*;

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_settings_init", "settings", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_settings_init(null_mut(), size_of::<shx_settings>()));
    case!(cases, "shx_settings_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_settings_init(s.out(), 0));
    case!(cases, "shx_settings_init", "size", "too small", SHX_ERROR_STRUCT_SIZE, |s| shx_settings_init(s.out(), size_of::<shx_settings>() - 8));
    case!(cases, "shx_settings_init", "size", "odd", SHX_ERROR_STRUCT_SIZE, |s| shx_settings_init(s.out(), size_of::<shx_settings>() + 1));
    case!(cases, "shx_settings_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_settings_init(s.out(), usize::MAX));
    case!(cases, "shx_settings_from_preset", "preset", "0", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(0, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "preset", "4", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(4, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "preset", "u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(u32::MAX, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "curvature", "-1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, -1.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "curvature", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, f64::NAN, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "curvature", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, f64::INFINITY, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "curvature", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, f64::NEG_INFINITY, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "length", "0.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, 0.0, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "length", "-0.2", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, -0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "length", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, f64::NAN, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "length", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, f64::INFINITY, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "length", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, f64::NEG_INFINITY, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "length", "more turns than elements", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, 1e6, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "frame_time", "0.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, 0.2, 0.0, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "frame_time", "-0.1", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, 0.2, -0.1, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "frame_time", "1e-12", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, 0.2, 1e-12, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "frame_time", "1e12", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, 0.2, 1e12, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "frame_time", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, 0.2, f64::NAN, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "frame_time", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, 0.2, f64::INFINITY, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "frame_time", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, 0.2, f64::NEG_INFINITY, &raw mut settings) });
    case!(cases, "shx_settings_from_preset", "out_settings", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, 0.2, 1.0 / 30.0, null_mut()));
    case!(cases, "shx_settings_from_preset", "out_settings", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| { let mut settings = new_settings(); settings.struct_size = 0; shx_settings_from_preset(SHX_PRESET_BALANCED, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "target_error", "0.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.0, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "target_error", "-0.1", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(-0.1, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "target_error", "below what was measured", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(1e-12, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "target_error", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(f64::NAN, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "target_error", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(f64::INFINITY, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "target_error", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(f64::NEG_INFINITY, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "curvature", "above what was measured", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 1e4, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "curvature", "-1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, -1.0, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "curvature", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, f64::NAN, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "curvature", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, f64::INFINITY, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "curvature", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, f64::NEG_INFINITY, 0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "length", "0.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, 0.0, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "length", "-0.2", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, -0.2, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "length", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, f64::NAN, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "length", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, f64::INFINITY, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "length", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, f64::NEG_INFINITY, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "length", "more turns than elements", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, 1e6, 1.0 / 30.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "frame_time", "0.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, 0.2, 0.0, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "frame_time", "-0.1", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, 0.2, -0.1, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "frame_time", "1e-12", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, 0.2, 1e-12, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "frame_time", "1e12", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, 0.2, 1e12, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "frame_time", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, 0.2, f64::NAN, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "frame_time", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, 0.2, f64::INFINITY, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "frame_time", "f64::NEG_INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut settings = new_settings(); shx_settings_suggest(0.1, 100.0, 0.2, f64::NEG_INFINITY, &raw mut settings) });
    case!(cases, "shx_settings_suggest", "out_settings", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_settings_suggest(0.1, 100.0, 0.2, 1.0 / 30.0, null_mut()));
    case!(cases, "shx_settings_suggest", "out_settings", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| { let mut settings = new_settings(); settings.struct_size = 0; shx_settings_suggest(0.1, 100.0, 0.2, 1.0 / 30.0, &raw mut settings) });
}
