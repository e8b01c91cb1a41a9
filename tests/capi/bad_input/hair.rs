//! Bad input to the functions of hair types: function, argument, fault, expected result code, call.

use super::*;

fn hair() -> shx_hair_type {
    let mut hair = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_hair_type_init(hair.as_mut_ptr(), size_of::<shx_hair_type>()), SHX_OK);
        hair.assume_init()
    }
}

fn sliders() -> shx_hair_sliders {
    let mut sliders = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_hair_sliders_init(sliders.as_mut_ptr(), size_of::<shx_hair_sliders>()), SHX_OK);
        sliders.assume_init()
    }
}

fn strands_def() -> shx_hair_strands_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one definition, which the call fills.
    unsafe {
        assert_eq!(shx_hair_strands_def_init(def.as_mut_ptr(), size_of::<shx_hair_strands_def>()), SHX_OK);
        def.assume_init()
    }
}

/// Generates strands with a definition of these fields.
#[allow(clippy::too_many_arguments)] // the fields of the definition, and the outputs
unsafe fn generate(
    hair_type: *const shx_hair_type,
    sliders: *const shx_hair_sliders,
    first_strand: u64,
    strand_count: usize,
    element_counts: *const u32,
    element_lengths: *const f64,
    out_strands: *mut shx_hair_strand,
    stride: usize,
    out_curvatures: *mut f64,
    capacity: usize,
) -> shx_result {
    let def =
        shx_hair_strands_def { hair_type, sliders, first_strand, strand_count, element_counts, element_lengths, ..strands_def() };
    // SAFETY: as the caller says.
    unsafe { shx_hair_strands(&raw const def, out_strands, stride, out_curvatures, capacity) }
}

/// Two strands of one and of two elements.
fn make(
    s: &mut Scene,
    change: impl FnOnce(&mut shx_hair_type, &mut shx_hair_sliders, &mut [u32; 2], &mut [f64; 3]),
) -> shx_result {
    let (mut hair, mut sliders, mut counts, mut lengths) = (hair(), sliders(), [1, 2], [0.1; 3]);
    change(&mut hair, &mut sliders, &mut counts, &mut lengths);
    // SAFETY: all that is pointed to is there.
    unsafe { generate(&raw const hair, &raw const sliders, 0, 2, counts.as_ptr(), lengths.as_ptr(), s.out(), 0, s.out2(), 3) }
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_hair_strands_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_hair_strands_def_init(null_mut(), size_of::<shx_hair_strands_def>()));
    case!(cases, "shx_hair_strands_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_strands_def_init(s.out(), 0));
    case!(cases, "shx_hair_strands_def_init", "size", "too small", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_strands_def_init(s.out(), size_of::<shx_hair_strands_def>() - 8));
    case!(cases, "shx_hair_strands_def_init", "size", "odd", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_strands_def_init(s.out(), size_of::<shx_hair_strands_def>() + 1));
    case!(cases, "shx_hair_strands_def_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_strands_def_init(s.out(), usize::MAX));
    case!(cases, "shx_hair_strands", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_hair_strands(null(), s.out(), 0, s.out2(), 3));
    case!(cases, "shx_hair_strands", "def", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| { let mut def = strands_def(); def.struct_size = 0; shx_hair_strands(&raw const def, s.out(), 0, s.out2(), 3) });
    case!(cases, "shx_hair_strands", "def", "reserved0", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut def = strands_def(); def.reserved0 = 1; shx_hair_strands(&raw const def, s.out(), 0, s.out2(), 3) });
    case!(cases, "shx_hair_strands", "def", "as it was made", SHX_ERROR_NULL_ARGUMENT, |s| shx_hair_strands(&strands_def(), s.out(), 0, s.out2(), 3));
    case!(cases, "shx_hair_type_init", "hair", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_hair_type_init(null_mut(), size_of::<shx_hair_type>()));
    case!(cases, "shx_hair_type_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_type_init(s.out(), 0));
    case!(cases, "shx_hair_type_init", "size", "too small", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_type_init(s.out(), size_of::<shx_hair_type>() - 8));
    case!(cases, "shx_hair_type_init", "size", "odd", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_type_init(s.out(), size_of::<shx_hair_type>() + 1));
    case!(cases, "shx_hair_type_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_type_init(s.out(), usize::MAX));
    case!(cases, "shx_hair_sliders_init", "sliders", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_hair_sliders_init(null_mut(), size_of::<shx_hair_sliders>()));
    case!(cases, "shx_hair_sliders_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_sliders_init(s.out(), 0));
    case!(cases, "shx_hair_sliders_init", "size", "too small", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_sliders_init(s.out(), size_of::<shx_hair_sliders>() - 8));
    case!(cases, "shx_hair_sliders_init", "size", "odd", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_sliders_init(s.out(), size_of::<shx_hair_sliders>() + 1));
    case!(cases, "shx_hair_sliders_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_sliders_init(s.out(), usize::MAX));
    case!(cases, "shx_hair_type_from_name", "name", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let mut hair = hair(); shx_hair_type_from_name(null(), &raw mut hair) });
    case!(cases, "shx_hair_type_from_name", "name", "unknown", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut hair = hair(); shx_hair_type_from_name(c"blond".as_ptr(), &raw mut hair) });
    case!(cases, "shx_hair_type_from_name", "name", "not UTF-8", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut hair = hair(); shx_hair_type_from_name(c"\xff".as_ptr(), &raw mut hair) });
    case!(cases, "shx_hair_type_from_name", "out_hair", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_hair_type_from_name(c"asian".as_ptr(), null_mut()));
    case!(cases, "shx_hair_type_from_name", "out_hair", "size 0", SHX_ERROR_STRUCT_SIZE, |s| { let mut hair = hair(); hair.struct_size = 0; shx_hair_type_from_name(c"asian".as_ptr(), &raw mut hair) });
    case!(cases, "shx_hair_strands", "def", "hair null", SHX_ERROR_NULL_ARGUMENT, |s| { let (hair, counts, lengths) = (hair(), [1_u32, 2], [0.1_f64; 3]); let _ = (&hair, &counts, &lengths); generate(null(), null(), 0, 2, counts.as_ptr(), lengths.as_ptr(), s.out(), 0, s.out2(), 3) });
    case!(cases, "shx_hair_strands", "def", "hair size 0", SHX_ERROR_STRUCT_SIZE, |s| make(s, |hair, _, _, _| hair.struct_size = 0));
    case!(cases, "shx_hair_strands", "def", "hair reserved", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.reserved[1] = 7));
    case!(cases, "shx_hair_strands", "def", "hair curl 2", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.curl = 2));
    case!(cases, "shx_hair_strands", "def", "hair mean_radius f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.mean_radius = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair mean_radius f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.mean_radius = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair mean_radius -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.mean_radius = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair ellipticity f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.ellipticity = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair ellipticity f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.ellipticity = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair ellipticity -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.ellipticity = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair helix_radius f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.helix_radius = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair helix_radius f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.helix_radius = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair helix_radius -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.helix_radius = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair helix_pitch f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.helix_pitch = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair helix_pitch f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.helix_pitch = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair helix_pitch -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.helix_pitch = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair youngs_modulus f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.youngs_modulus = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair youngs_modulus f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.youngs_modulus = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair youngs_modulus -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.youngs_modulus = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair poisson_ratio f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.poisson_ratio = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair poisson_ratio f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.poisson_ratio = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair poisson_ratio -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.poisson_ratio = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair density f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.density = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair density f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.density = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair density -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.density = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair internal_friction f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.internal_friction = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair internal_friction f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.internal_friction = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair internal_friction -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.internal_friction = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair air_drag f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.air_drag = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair air_drag f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.air_drag = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair air_drag -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.air_drag = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair friction f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.friction = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair friction f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.friction = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair friction -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.friction = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair variation_between f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_between = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair variation_between f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_between = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair variation_between -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_between = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair variation_along f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_along = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair variation_along f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_along = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair variation_along -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_along = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair variation_thickness f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_thickness = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair variation_thickness f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_thickness = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair variation_thickness -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_thickness = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair frizz f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.frizz = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair frizz f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.frizz = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair frizz -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.frizz = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair variation_period f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_period = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair variation_period f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_period = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair variation_period -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.variation_period = -2.0));
    case!(cases, "shx_hair_strands", "def", "hair root_turn f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.root_turn = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "hair root_turn f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.root_turn = f64::INFINITY));
    case!(cases, "shx_hair_strands", "def", "hair root_turn -2.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |hair, _, _, _| hair.root_turn = -2.0));
    case!(cases, "shx_hair_strands", "def", "sliders size 0", SHX_ERROR_STRUCT_SIZE, |s| make(s, |_, sliders, _, _| sliders.struct_size = 0));
    case!(cases, "shx_hair_strands", "def", "sliders reserved", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.reserved[0] = 7));
    case!(cases, "shx_hair_strands", "def", "sliders reserved0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.reserved0 = 7));
    case!(cases, "shx_hair_strands", "def", "sliders curliness f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.curliness = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "sliders curliness 1.5", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.curliness = 1.5));
    case!(cases, "shx_hair_strands", "def", "sliders curliness -1.5", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.curliness = -1.5));
    case!(cases, "shx_hair_strands", "def", "sliders stiffness f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.stiffness = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "sliders stiffness 1.5", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.stiffness = 1.5));
    case!(cases, "shx_hair_strands", "def", "sliders stiffness -1.5", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.stiffness = -1.5));
    case!(cases, "shx_hair_strands", "def", "sliders discipline f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.discipline = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "sliders discipline 1.5", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.discipline = 1.5));
    case!(cases, "shx_hair_strands", "def", "sliders discipline -1.5", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.discipline = -1.5));
    case!(cases, "shx_hair_strands", "def", "sliders weight f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.weight = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "sliders weight 1.5", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.weight = 1.5));
    case!(cases, "shx_hair_strands", "def", "sliders weight -1.5", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.weight = -1.5));
    case!(cases, "shx_hair_strands", "def", "sliders combing_ease f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.combing_ease = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "sliders combing_ease 1.5", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.combing_ease = 1.5));
    case!(cases, "shx_hair_strands", "def", "sliders combing_ease -1.5", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, sliders, _, _| sliders.combing_ease = -1.5));
    case!(cases, "shx_hair_strands", "def", "first_strand u64::MAX: the numbers go round", SHX_OK, |s| { let mut made = [std::mem::MaybeUninit::<shx_hair_strand>::uninit(); 2]; let made = made.as_mut_ptr().cast::<shx_hair_strand>(); let mut rows = [[0.0_f64; 3]; 3]; let (hair, counts, lengths) = (hair(), [1_u32, 2], [0.1_f64; 3]); let _ = (&hair, &counts, &lengths); generate(&raw const hair, null(), u64::MAX, 2, counts.as_ptr(), lengths.as_ptr(), made, 0, rows.as_mut_ptr().cast(), 3) });
    case!(cases, "shx_hair_strands", "def", "strand_count huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let (hair, counts, lengths) = (hair(), [1_u32, 2], [0.1_f64; 3]); let _ = (&hair, &counts, &lengths); generate(&raw const hair, null(), 0, usize::MAX, counts.as_ptr(), lengths.as_ptr(), s.out(), 0, s.out2(), 3) });
    case!(cases, "shx_hair_strands", "def", "element_counts null", SHX_ERROR_NULL_ARGUMENT, |s| { let (hair, counts, lengths) = (hair(), [1_u32, 2], [0.1_f64; 3]); let _ = (&hair, &counts, &lengths); generate(&raw const hair, null(), 0, 2, null(), lengths.as_ptr(), s.out(), 0, s.out2(), 3) });
    case!(cases, "shx_hair_strands", "def", "element_counts 0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, _, counts, _| counts[1] = 0));
    case!(cases, "shx_hair_strands", "def", "element_counts too many", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, _, counts, _| counts[1] = u32::MAX));
    case!(cases, "shx_hair_strands", "def", "element_lengths null", SHX_ERROR_NULL_ARGUMENT, |s| { let (hair, counts, lengths) = (hair(), [1_u32, 2], [0.1_f64; 3]); let _ = (&hair, &counts, &lengths); generate(&raw const hair, null(), 0, 2, counts.as_ptr(), null(), s.out(), 0, s.out2(), 3) });
    case!(cases, "shx_hair_strands", "def", "element_lengths 0.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, _, _, lengths| lengths[2] = 0.0));
    case!(cases, "shx_hair_strands", "def", "element_lengths -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, _, _, lengths| lengths[2] = -1.0));
    case!(cases, "shx_hair_strands", "def", "element_lengths f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, _, _, lengths| lengths[2] = f64::NAN));
    case!(cases, "shx_hair_strands", "def", "element_lengths f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| make(s, |_, _, _, lengths| lengths[2] = f64::INFINITY));
    case!(cases, "shx_hair_strands", "out_strands", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let (hair, counts, lengths) = (hair(), [1_u32, 2], [0.1_f64; 3]); let _ = (&hair, &counts, &lengths); generate(&raw const hair, null(), 0, 2, counts.as_ptr(), lengths.as_ptr(), null_mut(), 0, s.out2(), 3) });
    case!(cases, "shx_hair_strands", "stride", "too small", SHX_ERROR_INVALID_ARGUMENT, |s| { let (hair, counts, lengths) = (hair(), [1_u32, 2], [0.1_f64; 3]); let _ = (&hair, &counts, &lengths); generate(&raw const hair, null(), 0, 2, counts.as_ptr(), lengths.as_ptr(), s.out(), 80, s.out2(), 3) });
    case!(cases, "shx_hair_strands", "out_curvatures", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let (hair, counts, lengths) = (hair(), [1_u32, 2], [0.1_f64; 3]); let _ = (&hair, &counts, &lengths); generate(&raw const hair, null(), 0, 2, counts.as_ptr(), lengths.as_ptr(), s.out(), 0, null_mut(), 3) });
    case!(cases, "shx_hair_strands", "capacity", "one too few", SHX_ERROR_BUFFER_TOO_SMALL, |s| { let (hair, counts, lengths) = (hair(), [1_u32, 2], [0.1_f64; 3]); let _ = (&hair, &counts, &lengths); generate(&raw const hair, null(), 0, 2, counts.as_ptr(), lengths.as_ptr(), s.out(), 0, s.out2(), 2) });
    case!(cases, "shx_hair_strands", "capacity", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let (hair, counts, lengths) = (hair(), [1_u32, 2], [0.1_f64; 3]); let _ = (&hair, &counts, &lengths); generate(&raw const hair, null(), 0, 2, counts.as_ptr(), lengths.as_ptr(), s.out(), 0, s.out2(), usize::MAX) });
}
