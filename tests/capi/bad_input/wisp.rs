//! Bad input to the functions of wisps: function, argument, fault, expected result code, call.

use super::*;

fn filled<T>(init: unsafe extern "C" fn(*mut T, usize) -> shx_result) -> T {
    let mut made = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(init(made.as_mut_ptr(), size_of::<T>()), SHX_OK);
        made.assume_init()
    }
}

fn new_wisp() -> shx_wisp {
    filled(shx_wisp_init)
}

fn hair() -> shx_material {
    filled(shx_material_init)
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_wisp_init", "wisp", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_wisp_init(null_mut(), size_of::<shx_wisp>()));
    case!(cases, "shx_wisp_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_wisp_init(s.out(), 0));
    case!(cases, "shx_wisp_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_wisp_init(s.out(), 4));
    case!(cases, "shx_wisp_init", "size", "one too many", SHX_ERROR_STRUCT_SIZE, |s| shx_wisp_init(s.out(), size_of::<shx_wisp>() + 1));
    case!(cases, "shx_wisp_init", "size", "four too many", SHX_ERROR_STRUCT_SIZE, |s| shx_wisp_init(s.out(), size_of::<shx_wisp>() + 4));
    case!(cases, "shx_wisp_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_wisp_init(s.out(), 1 << 20));
    case!(cases, "shx_wisp_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_wisp_init(s.out(), usize::MAX));
    case!(cases, "shx_wisp_material", "wisp", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_wisp_material(null(), &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| shx_wisp_material(&shx_wisp { struct_size: 0, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "reserved0 1", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&shx_wisp { reserved0: 1, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "hairs 0.9", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&shx_wisp { hairs: 0.9, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "hairs 0.0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&shx_wisp { hairs: 0.0, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "hairs -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&shx_wisp { hairs: -1.0, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "hairs 1.1e6", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&shx_wisp { hairs: 1.1e6, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "hairs f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&shx_wisp { hairs: f64::NAN, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "hairs f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&shx_wisp { hairs: f64::INFINITY, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "hold -0.1", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&shx_wisp { hold: -0.1, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "hold 1.1", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&shx_wisp { hold: 1.1, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "hold f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&shx_wisp { hold: f64::NAN, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "wisp", "hold f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&shx_wisp { hold: f64::INFINITY, ..new_wisp() }, &hair(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "hair", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_wisp_material(&new_wisp(), null(), &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "hair", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| shx_wisp_material(&new_wisp(), &shx_material { struct_size: 0, ..hair() }, &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "hair", "density 0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&new_wisp(), &shx_material { density: 0.0, ..hair() }, &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "hair", "no ordinary product", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&new_wisp(), &shx_material { youngs_modulus: f64::MAX, ..hair() }, &mut hair(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "out_material", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_wisp_material(&new_wisp(), &hair(), null_mut(), null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "out_material", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| shx_wisp_material(&new_wisp(), &hair(), &mut shx_material { struct_size: 0, ..hair() }, null_mut(), null_mut()));
    case!(cases, "shx_wisp_material", "out_radius", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&new_wisp(), &hair(), &mut hair(), s.out::<u8>().wrapping_add(1).cast(), null_mut()));
    case!(cases, "shx_wisp_material", "out_margin", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| shx_wisp_material(&new_wisp(), &hair(), &mut hair(), null_mut(), s.out::<u8>().wrapping_add(1).cast()));
}
