//! Bad input to the functions of curves' optional data: function, argument, fault, expected result code,
//! the call.

use super::*;

/// Two strands of two points each, over the scene's points.
pub fn data(s: &Scene) -> shx_curve_data {
    static COUNTS: [u32; 2] = [2, 2];
    let mut data = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    let data = unsafe {
        assert_eq!(shx_curve_data_init(data.as_mut_ptr(), size_of::<shx_curve_data>()), SHX_OK);
        data.assume_init()
    };
    shx_curve_data { strand_count: 2, point_counts: COUNTS.as_ptr(), points: s.point_input(), ..data }
}

/// Saves what `change` makes of good data.
fn save(s: &mut Scene, change: impl FnOnce(&mut shx_curve_data)) -> shx_result {
    let mut data = data(s);
    change(&mut data);
    // SAFETY: all that is pointed to is there.
    unsafe { shx_curve_data_write(c"no/such/folder/x.usda".as_ptr(), &raw const data) }
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_curve_data_init", "data", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curve_data_init(null_mut(), size_of::<shx_curve_data>()));
    case!(cases, "shx_curve_data_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_curve_data_init(s.out(), 0));
    case!(cases, "shx_curve_data_init", "size", "too small", SHX_ERROR_STRUCT_SIZE, |s| shx_curve_data_init(s.out(), size_of::<shx_curve_data>() - 8));
    case!(cases, "shx_curve_data_init", "size", "odd", SHX_ERROR_STRUCT_SIZE, |s| shx_curve_data_init(s.out(), size_of::<shx_curve_data>() + 1));
    case!(cases, "shx_curve_data_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_curve_data_init(s.out(), usize::MAX));
    case!(cases, "shx_curve_data_write", "path", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let data = data(s); shx_curve_data_write(null(), &raw const data) });
    case!(cases, "shx_curve_data_write", "path", "empty", SHX_ERROR_INVALID_ARGUMENT, |s| { let data = data(s); shx_curve_data_write(c"".as_ptr(), &raw const data) });
    case!(cases, "shx_curve_data_write", "path", "of no known kind", SHX_ERROR_INVALID_ARGUMENT, |s| { let data = data(s); shx_curve_data_write(c"x.png".as_ptr(), &raw const data) });
    case!(cases, "shx_curve_data_write", "path", "in no folder", SHX_ERROR_FILE, |s| save(s, |_| ()));
    case!(cases, "shx_curve_data_write", "data", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curve_data_write(c"x.usda".as_ptr(), null()));
    case!(cases, "shx_curve_data_write", "data", "size 0", SHX_ERROR_STRUCT_SIZE, |s| save(s, |data| data.struct_size = 0));
    case!(cases, "shx_curve_data_write", "data", "up", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| data.up_axis = 3));
    case!(cases, "shx_curve_data_write", "data", "tfx_version", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| data.tfx_version = 5));
    case!(cases, "shx_curve_data_write", "data", "reserved0", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| data.reserved0 = 1));
    case!(cases, "shx_curve_data_write", "data", "reserved", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| data.reserved[3] = 1));
    case!(cases, "shx_curve_data_write", "data", "points count", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| data.points.count = 3));
    case!(cases, "shx_curve_data_write", "data", "points format", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| data.points.format = 5));
    case!(cases, "shx_curve_data_write", "data", "strand_count", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| data.strand_count = 1));
    case!(cases, "shx_curve_data_write", "data", "strand_count huge", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| data.strand_count = usize::MAX));
    case!(cases, "shx_curve_data_write", "data", "no strands", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| (data.strand_count, data.points.count) = (0, 0)));
    case!(cases, "shx_curve_data_write", "data", "velocities count", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| data.velocities = shx_input { count: 3, ..data.points }));
    case!(cases, "shx_curve_data_write", "data", "metres_per_unit", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| data.metres_per_unit = -1.0));
    case!(cases, "shx_curve_data_write", "data", "metres_per_unit NaN", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| data.metres_per_unit = f64::NAN));
    case!(cases, "shx_curve_data_write", "data", "points null", SHX_ERROR_NULL_ARGUMENT, |s| save(s, |data| data.points.data = null()));
    case!(cases, "shx_curve_data_write", "data", "point_counts null", SHX_ERROR_NULL_ARGUMENT, |s| save(s, |data| data.point_counts = null()));
    case!(cases, "shx_curve_data_write", "data", "thickness NaN", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| { static BAD: [f32; 4] = [f32::NAN; 4]; data.thickness = BAD.as_ptr(); }));
    case!(cases, "shx_curve_data_write", "data", "thickness not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| { static BAD: [f32; 5] = [0.0; 5]; data.thickness = BAD.as_ptr().cast::<u8>().wrapping_add(1).cast(); }));
    case!(cases, "shx_curve_data_write", "data", "transparency NaN", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| { static BAD: [f32; 4] = [f32::NAN; 4]; data.transparency = BAD.as_ptr(); }));
    case!(cases, "shx_curve_data_write", "data", "transparency not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| { static BAD: [f32; 5] = [0.0; 5]; data.transparency = BAD.as_ptr().cast::<u8>().wrapping_add(1).cast(); }));
    case!(cases, "shx_curve_data_write", "data", "colors NaN", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| { static BAD: [f32; 12] = [f32::NAN; 12]; data.colors = BAD.as_ptr(); }));
    case!(cases, "shx_curve_data_write", "data", "colors not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| { static BAD: [f32; 13] = [0.0; 13]; data.colors = BAD.as_ptr().cast::<u8>().wrapping_add(1).cast(); }));
    case!(cases, "shx_curve_data_write", "data", "strand_thickness NaN", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| { static BAD: [f32; 2] = [f32::NAN; 2]; data.strand_thickness = BAD.as_ptr(); }));
    case!(cases, "shx_curve_data_write", "data", "strand_thickness not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| { static BAD: [f32; 3] = [0.0; 3]; data.strand_thickness = BAD.as_ptr().cast::<u8>().wrapping_add(1).cast(); }));
    case!(cases, "shx_curve_data_write", "data", "strand_uvs NaN", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| { static BAD: [f32; 4] = [f32::NAN; 4]; data.strand_uvs = BAD.as_ptr(); }));
    case!(cases, "shx_curve_data_write", "data", "strand_uvs not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| save(s, |data| { static BAD: [f32; 5] = [0.0; 5]; data.strand_uvs = BAD.as_ptr().cast::<u8>().wrapping_add(1).cast(); }));
    case!(cases, "shx_curves_attribute", "curves", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_attribute(null(), 1, s.out(), 9, s.out2()));
    case!(cases, "shx_curves_attribute", "attribute", "0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_curves_attribute(s.curves, 0, s.out(), 9, s.out2()));
    case!(cases, "shx_curves_attribute", "attribute", "9", SHX_ERROR_INVALID_ARGUMENT, |s| shx_curves_attribute(s.curves, 9, s.out(), 9, s.out2()));
    case!(cases, "shx_curves_attribute", "attribute", "u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| shx_curves_attribute(s.curves, u32::MAX, s.out(), 9, s.out2()));
    case!(cases, "shx_curves_attribute", "out_values", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_attribute(s.curves, 1, null_mut(), 9, s.out2()));
    case!(cases, "shx_curves_attribute", "out_count", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_attribute(s.curves, 1, s.out(), 9, null_mut()));
    case!(cases, "shx_curves_attribute", "capacity", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_curves_attribute(s.curves, 1, s.out(), usize::MAX, s.out2()));
    case!(cases, "shx_curves_units", "curves", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_units(null(), s.out(), s.out2()));
    case!(cases, "shx_curves_units", "out_metres_per_unit", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_units(s.curves, null_mut(), s.out2()));
    case!(cases, "shx_curves_units", "out_up_axis", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_curves_units(s.curves, s.out(), null_mut()));
}
