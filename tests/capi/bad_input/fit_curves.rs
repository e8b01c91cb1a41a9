//! Bad arguments of the functions that fit strands to many curves, and of splines.

use super::*;

/// Room for three elements a strand.
fn new_options() -> shx_fit_options {
    let mut options = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one structure, which the call fills.
    unsafe {
        assert_eq!(shx_fit_options_init(options.as_mut_ptr(), size_of::<shx_fit_options>()), SHX_OK);
        shx_fit_options { element_count: 3, ..options.assume_init() }
    }
}

/// Fits with memory that is enough for two strands of three elements.
unsafe fn fit(s: &mut Scene, options: *const shx_fit_options, curves: *const shx_fit_input) -> shx_result {
    // SAFETY: what the case gives; the scene's memory.
    unsafe { shx_fit_strands(options, curves, s.out(), 0, s.out2(), s.out2::<f64>().add(6), 6) }
}

static LENGTHS: [f64; 3] = [0.1; 3];
static ROWS: [[f64; 3]; 3] = [[0.0, 1.0, 2.0]; 3];

/// A strand of three elements.
fn fitted() -> shx_fitted_strand {
    let root = shx_frame { origin: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0] };
    let (length, radius) = (LENGTHS.iter().sum(), 0.0);
    let errors = (0.0, 0.0, 0.0, 0.0);
    let (rms_error, max_error, max_distance, frame_error) = errors;
    shx_fitted_strand { result: SHX_OK, element_count: 3, root, length, rms_error, max_error, max_distance, frame_error, radius }
}

/// Puts it into a definition.
unsafe fn set_fit(def: *mut shx_strand_def, fitted: &shx_fitted_strand) -> shx_result {
    // SAFETY: what the case gives; three lengths and rows.
    unsafe { shx_strand_def_set_fit(def, fitted, LENGTHS.as_ptr(), ROWS.as_ptr().cast()) }
}

impl Scene {
    /// Two curves of two points each.
    fn fit_curves(&self) -> shx_fit_input {
        static COUNTS: [u32; 2] = [2, 2];
        let mut curves = std::mem::MaybeUninit::uninit();
        // SAFETY: room for one structure, which the call fills.
        unsafe {
            assert_eq!(shx_fit_input_init(curves.as_mut_ptr(), size_of::<shx_fit_input>()), SHX_OK);
            shx_fit_input { curve_count: 2, points: self.point_input(), point_counts: COUNTS.as_ptr(), ..curves.assume_init() }
        }
    }
}

fn spline_def() -> shx_spline_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one definition, which the call fills.
    unsafe {
        assert_eq!(shx_spline_def_init(def.as_mut_ptr(), size_of::<shx_spline_def>()), SHX_OK);
        def.assume_init()
    }
}

/// Samples a spline with a definition of these fields.
unsafe fn spline_points(
    kind: u32,
    ends: u32,
    controls: *const shx_input,
    points_per_span: u32,
    points: *const shx_output,
    out_arclengths: *mut f64,
    out_count: *mut usize,
) -> shx_result {
    // SAFETY: an input of the caller's.
    let def = shx_spline_def { kind, ends, points_per_span, controls: unsafe { *controls }, ..spline_def() };
    // SAFETY: as the caller says.
    unsafe { shx_spline_points(&raw const def, points, out_arclengths, out_count) }
}

#[rustfmt::skip] // a table: one case a line
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_spline_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_spline_def_init(null_mut(), size_of::<shx_spline_def>()));
    case!(cases, "shx_spline_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_spline_def_init(s.out(), 0));
    case!(cases, "shx_spline_def_init", "size", "too small", SHX_ERROR_STRUCT_SIZE, |s| shx_spline_def_init(s.out(), size_of::<shx_spline_def>() - 8));
    case!(cases, "shx_spline_def_init", "size", "odd", SHX_ERROR_STRUCT_SIZE, |s| shx_spline_def_init(s.out(), size_of::<shx_spline_def>() + 1));
    case!(cases, "shx_spline_def_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_spline_def_init(s.out(), usize::MAX));
    case!(cases, "shx_spline_points", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_spline_points(null(), null(), null_mut(), s.out2()));
    case!(cases, "shx_spline_points", "def", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| { let mut def = spline_def(); def.struct_size = 0; shx_spline_points(&raw const def, null(), null_mut(), s.out2()) });
    case!(cases, "shx_spline_points", "def", "as it was made", SHX_ERROR_INVALID_ARGUMENT, |s| shx_spline_points(&spline_def(), null(), null_mut(), s.out2()));
    case!(cases, "shx_fit_options_init", "options", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let _ = &s; shx_fit_options_init(null_mut(), size_of::<shx_fit_options>()) });
    case!(cases, "shx_fit_options_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_fit_options_init(s.out(), 0));
    case!(cases, "shx_fit_options_init", "size", "16 too few", SHX_ERROR_STRUCT_SIZE, |s| shx_fit_options_init(s.out(), size_of::<shx_fit_options>() - 16));
    case!(cases, "shx_fit_options_init", "size", "not of whole fields", SHX_ERROR_STRUCT_SIZE, |s| shx_fit_options_init(s.out(), size_of::<shx_fit_options>() + 4));
    case!(cases, "shx_fit_options_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_fit_options_init(s.out(), usize::MAX));
    case!(cases, "shx_fit_input_init", "curves", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let _ = &s; shx_fit_input_init(null_mut(), size_of::<shx_fit_input>()) });
    case!(cases, "shx_fit_input_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_fit_input_init(s.out(), 0));
    case!(cases, "shx_fit_input_init", "size", "8 too few", SHX_ERROR_STRUCT_SIZE, |s| shx_fit_input_init(s.out(), size_of::<shx_fit_input>() - 8));
    case!(cases, "shx_fit_input_init", "size", "not of whole fields", SHX_ERROR_STRUCT_SIZE, |s| shx_fit_input_init(s.out(), size_of::<shx_fit_input>() + 4));
    case!(cases, "shx_fit_input_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_fit_input_init(s.out(), usize::MAX));
    case!(cases, "shx_fit_strands", "options", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.struct_size = 0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "element_count 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.element_count = 0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "element_count 100_001", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.element_count = 100_001; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "element_count u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.element_count = u32::MAX; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "tolerance -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.tolerance = -1.0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "tolerance f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.tolerance = f64::NAN; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "tolerance f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.tolerance = f64::INFINITY; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "lengths 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.length_mode = 0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "lengths 4", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.length_mode = 4; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "twist 2", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.twist = 2; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "least_length 0.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.min_length_ratio = 0.0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "least_length 1.5", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.min_length_ratio = 1.5; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "least_length f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.min_length_ratio = f64::NAN; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "good -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.target_rms_error = -1.0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "good 2.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.target_rms_error = 2.0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "good f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.target_rms_error = f64::NAN; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "good_largest -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.target_max_error = -1.0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "good_largest 2.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.target_max_error = 2.0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "good_largest f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.target_max_error = f64::NAN; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "noise -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.noise = -1.0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "noise f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.noise = f64::NAN; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "noise f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.noise = f64::INFINITY; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "frame_weight -1.0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.frame_weight = -1.0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "frame_weight f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.frame_weight = f64::NAN; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "starts 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.max_starts = 0; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "starts 9", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.max_starts = 9; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "worker_count 257", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.worker_count = 257; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "options", "reserved", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut options, curves) = (new_options(), s.fit_curves()); options.reserved[3] = 1; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let options = new_options(); fit(s, &options, null()) });
    case!(cases, "shx_fit_strands", "curves", "struct_size 4", SHX_ERROR_STRUCT_SIZE, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.struct_size = 4; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "reserved0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.reserved0 = 1; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "reserved", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.reserved[0] = 1; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "curve_count huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.curve_count = usize::MAX; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "point_counts null", SHX_ERROR_NULL_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.point_counts = null(); fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "points of another number", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.points.count = 3; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "points format 9", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.points.format = 9; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "points data null", SHX_ERROR_NULL_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.points.data = null(); fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "points stride too small", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.points.stride = 23; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "points reserved", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.points.reserved = 1; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "frames of another number", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.frames = s.frame_input(); fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "frames of points", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.frames = s.point_input(); fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "frames that are no rotations", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.frames = s.point_input(); curves.frames.format = SHX_FORMAT_F32X4; curves.frames.stride = 16; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "roots of another number", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.roots = s.point_input(); fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "roots format 9", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.roots = s.point_input(); curves.roots.format = 9; fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "curves", "roots data null", SHX_ERROR_NULL_ARGUMENT, |s| { let (options, mut curves) = (new_options(), s.fit_curves()); curves.roots = s.frame_input(); curves.roots.data = null(); fit(s, &options, &curves) });
    case!(cases, "shx_fit_strands", "out_strands", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let (options, curves) = (new_options(), s.fit_curves()); shx_fit_strands(&raw const options, &raw const curves, null_mut(), 0, s.out2(), s.out2(), 6) });
    case!(cases, "shx_fit_strands", "stride", "111", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, curves) = (new_options(), s.fit_curves()); shx_fit_strands(&raw const options, &raw const curves, s.out(), 111, s.out2(), s.out2(), 6) });
    case!(cases, "shx_fit_strands", "stride", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, curves) = (new_options(), s.fit_curves()); shx_fit_strands(&raw const options, &raw const curves, s.out(), usize::MAX, s.out2(), s.out2(), 6) });
    case!(cases, "shx_fit_strands", "out_element_lengths", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let (options, curves) = (new_options(), s.fit_curves()); shx_fit_strands(&raw const options, &raw const curves, s.out(), 0, null_mut(), s.out2(), 6) });
    case!(cases, "shx_fit_strands", "out_curvatures", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let (options, curves) = (new_options(), s.fit_curves()); shx_fit_strands(&raw const options, &raw const curves, s.out(), 0, s.out2(), null_mut(), 6) });
    case!(cases, "shx_fit_strands", "out_curvatures", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, curves) = (new_options(), s.fit_curves()); shx_fit_strands(&raw const options, &raw const curves, s.out(), 0, s.out2(), s.out2::<u8>().add(1).cast(), 6) });
    case!(cases, "shx_fit_strands", "capacity", "5", SHX_ERROR_BUFFER_TOO_SMALL, |s| { let (options, curves) = (new_options(), s.fit_curves()); shx_fit_strands(&raw const options, &raw const curves, s.out(), 0, s.out2(), s.out2(), 5) });
    case!(cases, "shx_fit_strands", "capacity", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| { let (options, curves) = (new_options(), s.fit_curves()); shx_fit_strands(&raw const options, &raw const curves, s.out(), 0, s.out2(), s.out2(), usize::MAX) });
    case!(cases, "shx_strand_def_set_fit", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let _ = &s; set_fit(null_mut(), &fitted()) });
    case!(cases, "shx_strand_def_set_fit", "def", "struct_size 4", SHX_ERROR_STRUCT_SIZE, |s| { let _ = &s; let mut def = strand(); def.struct_size = 4; set_fit(&raw mut def, &fitted()) });
    case!(cases, "shx_strand_def_set_fit", "fitted", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let _ = &s; let mut def = strand(); shx_strand_def_set_fit(&raw mut def, null(), LENGTHS.as_ptr(), ROWS.as_ptr().cast()) });
    case!(cases, "shx_strand_def_set_fit", "fitted", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| { let _ = &s; let mut def = strand(); shx_strand_def_set_fit(&raw mut def, (&raw const ROWS).cast::<shx_fitted_strand>().wrapping_byte_add(4), LENGTHS.as_ptr(), ROWS.as_ptr().cast()) });
    case!(cases, "shx_strand_def_set_fit", "fitted", "not fitted", SHX_ERROR_INVALID_ARGUMENT, |s| { let _ = &s; let mut def = strand(); set_fit(&raw mut def, &shx_fitted_strand { result: SHX_ERROR_INVALID_ARGUMENT, ..fitted() }) });
    case!(cases, "shx_strand_def_set_fit", "fitted", "element_count 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let _ = &s; let mut def = strand(); set_fit(&raw mut def, &shx_fitted_strand { element_count: 0, ..fitted() }) });
    case!(cases, "shx_strand_def_set_fit", "fitted", "element_count 100_001", SHX_ERROR_INVALID_ARGUMENT, |s| { let _ = &s; let mut def = strand(); set_fit(&raw mut def, &shx_fitted_strand { element_count: 100_001, ..fitted() }) });
    case!(cases, "shx_strand_def_set_fit", "element_lengths", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let _ = &s; let mut def = strand(); shx_strand_def_set_fit(&raw mut def, &raw const *Box::leak(Box::new(fitted())), null(), ROWS.as_ptr().cast()) });
    case!(cases, "shx_strand_def_set_fit", "curvatures", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let _ = &s; let mut def = strand(); shx_strand_def_set_fit(&raw mut def, &raw const *Box::leak(Box::new(fitted())), LENGTHS.as_ptr(), null()) });
    case!(cases, "shx_strand_def_set_fit", "curvatures", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| { let _ = &s; let mut def = strand(); shx_strand_def_set_fit(&raw mut def, &raw const *Box::leak(Box::new(fitted())), LENGTHS.as_ptr(), ROWS.as_ptr().cast::<f64>().wrapping_byte_add(4)) });
    case!(cases, "shx_spline_points", "def", "kind 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(0, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "kind 4", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(4, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "kind u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(u32::MAX, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "ends 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(SHX_SPLINE_CATMULL_ROM, 0, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "ends 3", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(SHX_SPLINE_CATMULL_ROM, 3, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "controls data null", SHX_ERROR_NULL_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); controls.data = null(); spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "controls 3 of 4", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); controls.count = 3; spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "controls none", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); controls.count = 0; spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_PINNED, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "controls not 3 k + 1", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); controls.count = 3; spline_points(SHX_SPLINE_BEZIER, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "controls f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); s.points[1][2] = f64::NAN; spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "controls f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); s.points[0][0] = f64::INFINITY; spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "per_span 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 0, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "per_span 1025", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 1025, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "def", "per_span u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, u32::MAX, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "points", "null beside arclengths", SHX_ERROR_NULL_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, null(), s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "points", "room for 2", SHX_ERROR_BUFFER_TOO_SMALL, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); points.count = 2; spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "points", "format of frames", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); points.format = SHX_FORMAT_FRAME; spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "points", "data null", SHX_ERROR_NULL_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); points.data = null_mut(); spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "points", "stride too small", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); points.stride = 23; spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "out_arclengths", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2::<u8>().add(1).cast(), s.out2::<usize>().add(400)) });
    case!(cases, "shx_spline_points", "out_count", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), null_mut()) });
    case!(cases, "shx_spline_points", "out_count", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| { let (mut controls, mut points) = (s.point_input(), s.output(3)); let _ = (&mut controls, &mut points); spline_points(SHX_SPLINE_CATMULL_ROM, SHX_SPLINE_ENDS_OPEN, &raw const controls, 2, &raw const points, s.out2(), s.out2::<u8>().add(3).cast()) });
}
