//! Bad input to the functions of friction_fit: function, argument, fault, expected result code, call.

use super::*;

/// A call of shx_fit_friction that works, to be spoilt.
struct Call {
    solver: shx_solver_def,
    strand: shx_strand_def,
    friction: shx_friction_fit_def,
    times: [f64; 8],
    values: [f64; 8],
    count: usize,
    report: shx_friction_fit_report,
    /// Which argument is null.
    null: &'static str,
    /// Which array is not aligned.
    misaligned: &'static str,
}

fn friction_def() -> shx_friction_fit_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one definition, which the call fills.
    unsafe {
        assert_eq!(shx_friction_fit_def_init(def.as_mut_ptr(), size_of::<shx_friction_fit_def>()), SHX_OK);
        def.assume_init()
    }
}

fn friction_report() -> shx_friction_fit_report {
    let mut report = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one report, which the call fills.
    unsafe {
        assert_eq!(shx_friction_fit_report_init(report.as_mut_ptr(), size_of::<shx_friction_fit_report>()), SHX_OK);
        report.assume_init()
    }
}

static ROOT_TIMES: [f64; 2] = [0.0, 0.2];
static BACKWARDS: [f64; 2] = [0.2, 0.0];
const POSE: shx_frame = shx_frame { origin: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0] };
static POSES: [shx_frame; 2] = [POSE; 2];
static BAD_POSES: [shx_frame; 2] = [POSE, shx_frame { rotation: [0.0, 0.0, 0.0, 2.0], ..POSE }];

/// Makes the call after `spoil`; an error must leave report and curve as they were.
fn fit(out_curve: *mut f64, spoil: fn(&mut Call)) -> shx_result {
    let mut call = Call {
        solver: solver_def(),
        strand: strand(),
        friction: shx_friction_fit_def { coefficients: SHX_FRICTION_AIR_DRAG, grid_points: 2, time_step: 0.02, ..friction_def() },
        times: [0.0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.12, 0.14],
        values: [0.1; 8],
        count: 8,
        report: friction_report(),
        null: "",
        misaligned: "",
    };
    // Wavy, so that it has a rest to start from that is not a straight line's.
    let natural = [[1.0, 20.0, 3.0]; 3];
    call.strand.natural_curvatures = natural.as_ptr().cast();
    call.friction.oscillation_amplitude = 0.01;
    call.friction.oscillation_frequency = 4.0;
    spoil(&mut call);
    let Call { solver, strand, friction, times, values, count, mut report, null: gone, misaligned } = call;
    fn or_null<T>(gone: &str, name: &str, pointer: *const T) -> *const T {
        if gone == name { null() } else { pointer }
    }
    let bytes = |report: &shx_friction_fit_report| {
        // SAFETY: plain data without padding.
        unsafe { std::slice::from_raw_parts(std::ptr::from_ref(report).cast::<u8>(), size_of_val(report)) }.to_vec()
    };
    let before = bytes(&report);
    let off = |name: &str| usize::from(misaligned == name);
    let times = times.as_ptr().wrapping_byte_add(off("times"));
    // SAFETY: pointers to what they should point to, but for what the library promises to find.
    let result = unsafe {
        shx_fit_friction(
            or_null(gone, "solver", &raw const solver),
            or_null(gone, "strand", &raw const strand),
            or_null(gone, "friction", &raw const friction),
            or_null(gone, "times", times),
            or_null(gone, "values", values.as_ptr()),
            count,
            if gone == "out_report" { null_mut() } else { &raw mut report },
            out_curve.wrapping_byte_add(off("out_curve")),
        )
    };
    assert!(result == SHX_OK || bytes(&report) == before, "the report was written");
    result
}

#[test]
fn the_call_that_is_spoilt_works_otherwise() {
    // No scene: its file is that of the test beside this one.
    let mut curve = [0.0; 8];
    assert_eq!(fit(curve.as_mut_ptr(), |_| ()), SHX_OK, "{}", last_error());
    assert_eq!(fit(curve.as_mut_ptr(), |c| c.null = "solver"), SHX_OK, "{}", last_error());
    assert!(curve.iter().all(|value| (0.05..0.15).contains(value)), "{curve:?}");
    let through_poses = |c: &mut Call| {
        (c.friction.oscillation_amplitude, c.friction.oscillation_frequency) = (0.0, 0.0);
        (c.friction.root_times, c.friction.root_frames, c.friction.root_count) = (ROOT_TIMES.as_ptr(), POSES.as_ptr(), 2);
    };
    assert_eq!(fit(curve.as_mut_ptr(), through_poses), SHX_OK, "{}", last_error());
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_friction_fit_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_friction_fit_def_init(null_mut(), size_of::<shx_friction_fit_def>()));
    case!(cases, "shx_friction_fit_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_def_init(s.out(), 0));
    case!(cases, "shx_friction_fit_def_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_def_init(s.out(), 4));
    case!(cases, "shx_friction_fit_def_init", "size", "size_of::<shx_friction_fit_def>() - 8", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_def_init(s.out(), size_of::<shx_friction_fit_def>() - 8));
    case!(cases, "shx_friction_fit_def_init", "size", "size_of::<shx_friction_fit_def>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_def_init(s.out(), size_of::<shx_friction_fit_def>() + 1));
    case!(cases, "shx_friction_fit_def_init", "size", "size_of::<shx_friction_fit_def>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_def_init(s.out(), size_of::<shx_friction_fit_def>() + 4));
    case!(cases, "shx_friction_fit_def_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_def_init(s.out(), 1 << 20));
    case!(cases, "shx_friction_fit_def_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_def_init(s.out(), usize::MAX));
    case!(cases, "shx_friction_fit_report_init", "report", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_friction_fit_report_init(null_mut(), size_of::<shx_friction_fit_report>()));
    case!(cases, "shx_friction_fit_report_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_report_init(s.out(), 0));
    case!(cases, "shx_friction_fit_report_init", "size", "4", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_report_init(s.out(), 4));
    case!(cases, "shx_friction_fit_report_init", "size", "size_of::<shx_friction_fit_report>() - 8", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_report_init(s.out(), size_of::<shx_friction_fit_report>() - 8));
    case!(cases, "shx_friction_fit_report_init", "size", "size_of::<shx_friction_fit_report>() + 1", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_report_init(s.out(), size_of::<shx_friction_fit_report>() + 1));
    case!(cases, "shx_friction_fit_report_init", "size", "size_of::<shx_friction_fit_report>() + 4", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_report_init(s.out(), size_of::<shx_friction_fit_report>() + 4));
    case!(cases, "shx_friction_fit_report_init", "size", "1 << 20", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_report_init(s.out(), 1 << 20));
    case!(cases, "shx_friction_fit_report_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_friction_fit_report_init(s.out(), usize::MAX));
    case!(cases, "shx_fit_friction", "strand", "null", SHX_ERROR_NULL_ARGUMENT, |s| fit(s.out(), |c| c.null = "strand"));
    case!(cases, "shx_fit_friction", "friction", "null", SHX_ERROR_NULL_ARGUMENT, |s| fit(s.out(), |c| c.null = "friction"));
    case!(cases, "shx_fit_friction", "times", "null", SHX_ERROR_NULL_ARGUMENT, |s| fit(s.out(), |c| c.null = "times"));
    case!(cases, "shx_fit_friction", "values", "null", SHX_ERROR_NULL_ARGUMENT, |s| fit(s.out(), |c| c.null = "values"));
    case!(cases, "shx_fit_friction", "out_report", "null", SHX_ERROR_NULL_ARGUMENT, |s| fit(s.out(), |c| c.null = "out_report"));
    case!(cases, "shx_fit_friction", "solver", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| fit(s.out(), |c| c.solver.struct_size = 0));
    case!(cases, "shx_fit_friction", "solver", "integrator 9", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.solver.integrator = 9));
    case!(cases, "shx_fit_friction", "solver", "worker_count 257", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.solver.worker_count = 257));
    case!(cases, "shx_fit_friction", "solver", "gravity NaN", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.solver.gravity[2] = f64::NAN));
    case!(cases, "shx_fit_friction", "solver", "no gravity for a depth", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| { c.solver.gravity = [0.0; 3]; c.friction.oscillation_direction[0] = 1.0; c.friction.observable = SHX_OBSERVABLE_DEPTH }));
    case!(cases, "shx_fit_friction", "friction", "no gravity to say what is up", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| { c.solver.gravity = [0.0; 3] }));
    case!(cases, "shx_fit_friction", "solver", "parallel_for", SHX_ERROR_UNSUPPORTED, |s| fit(s.out(), |c| c.solver.parallel_for = Some(never)));
    case!(cases, "shx_fit_friction", "strand", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| fit(s.out(), |c| c.strand.struct_size = 0));
    case!(cases, "shx_fit_friction", "strand", "no length", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.strand.length = 0.0));
    case!(cases, "shx_fit_friction", "strand", "element_count 0", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.strand.element_count = 0));
    case!(cases, "shx_fit_friction", "friction", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| fit(s.out(), |c| c.friction.struct_size = 0));
    case!(cases, "shx_fit_friction", "friction", "observable 0", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.observable = 0));
    case!(cases, "shx_fit_friction", "friction", "observable 5", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.observable = 5));
    case!(cases, "shx_fit_friction", "friction", "observable u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.observable = u32::MAX));
    case!(cases, "shx_fit_friction", "friction", "coefficients 0", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.coefficients = 0));
    case!(cases, "shx_fit_friction", "friction", "coefficients 8", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.coefficients = 8));
    case!(cases, "shx_fit_friction", "friction", "coefficients u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.coefficients = u32::MAX));
    case!(cases, "shx_fit_friction", "friction", "start 0", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.start = 0));
    case!(cases, "shx_fit_friction", "friction", "start 3", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.start = 3));
    case!(cases, "shx_fit_friction", "friction", "direction [0.0; 3]", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| { c.friction.observable = SHX_OBSERVABLE_OFFSET; c.friction.direction = [0.0; 3] }));
    case!(cases, "shx_fit_friction", "friction", "direction [f64::NAN, 0.0, 0.0]", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| { c.friction.observable = SHX_OBSERVABLE_OFFSET; c.friction.direction = [f64::NAN, 0.0, 0.0] }));
    case!(cases, "shx_fit_friction", "friction", "direction [0.0, f64::INFINITY, 0.0]", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| { c.friction.observable = SHX_OBSERVABLE_OFFSET; c.friction.direction = [0.0, f64::INFINITY, 0.0] }));
    case!(cases, "shx_fit_friction", "friction", "direction along gravity", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| { c.friction.observable = SHX_OBSERVABLE_ANGLE; c.friction.direction = [0.0, 0.0, -2.0] }));
    case!(cases, "shx_fit_friction", "friction", "air_drag_range [0.0, 1.0]", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.air_drag_range = [0.0, 1.0]));
    case!(cases, "shx_fit_friction", "friction", "air_drag_range [-1e-6, 1.0]", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.air_drag_range = [-1e-6, 1.0]));
    case!(cases, "shx_fit_friction", "friction", "air_drag_range [1e-5, 1e-5]", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.air_drag_range = [1e-5, 1e-5]));
    case!(cases, "shx_fit_friction", "friction", "air_drag_range [1e-5, 1e-6]", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.air_drag_range = [1e-5, 1e-6]));
    case!(cases, "shx_fit_friction", "friction", "air_drag_range [f64::NAN, 1.0]", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.air_drag_range = [f64::NAN, 1.0]));
    case!(cases, "shx_fit_friction", "friction", "air_drag_range [1e-6, f64::INFINITY]", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.air_drag_range = [1e-6, f64::INFINITY]));
    case!(cases, "shx_fit_friction", "friction", "internal_friction_range", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| { c.friction.coefficients = 1; c.friction.internal_friction_range[0] = -1.0 }));
    case!(cases, "shx_fit_friction", "friction", "viscosity_range", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| { c.friction.coefficients = 2; c.friction.viscosity_range[1] = 0.0 }));
    case!(cases, "shx_fit_friction", "friction", "air_drag_guess -1e-6", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.air_drag_guess = -1e-6));
    case!(cases, "shx_fit_friction", "friction", "air_drag_guess 1e-2", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.air_drag_guess = 1e-2));
    case!(cases, "shx_fit_friction", "friction", "air_drag_guess f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.air_drag_guess = f64::NAN));
    case!(cases, "shx_fit_friction", "friction", "neither grid nor guess", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.grid_points = 0));
    case!(cases, "shx_fit_friction", "friction", "lead_in -0.1", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.lead_in = -0.1));
    case!(cases, "shx_fit_friction", "friction", "lead_in f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.lead_in = f64::NAN));
    case!(cases, "shx_fit_friction", "friction", "lead_in f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.lead_in = f64::INFINITY));
    case!(cases, "shx_fit_friction", "friction", "discard -0.1", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.discard = -0.1));
    case!(cases, "shx_fit_friction", "friction", "discard f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.discard = f64::NAN));
    case!(cases, "shx_fit_friction", "friction", "discard f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.discard = f64::INFINITY));
    case!(cases, "shx_fit_friction", "friction", "time_step 0.0", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.time_step = 0.0));
    case!(cases, "shx_fit_friction", "friction", "time_step -0.01", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.time_step = -0.01));
    case!(cases, "shx_fit_friction", "friction", "time_step f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.time_step = f64::NAN));
    case!(cases, "shx_fit_friction", "friction", "time_step f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.time_step = f64::INFINITY));
    case!(cases, "shx_fit_friction", "friction", "time_step 1e-12", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.time_step = 1e-12));
    case!(cases, "shx_fit_friction", "friction", "grid_points 1", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.grid_points = 1));
    case!(cases, "shx_fit_friction", "friction", "grid_points 65", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.grid_points = 65));
    case!(cases, "shx_fit_friction", "friction", "grid_points u32::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.grid_points = u32::MAX));
    case!(cases, "shx_fit_friction", "friction", "fit_offset 2", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.fit_offset = 2));
    case!(cases, "shx_fit_friction", "friction", "max_iterations 0", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.max_iterations = 0));
    case!(cases, "shx_fit_friction", "friction", "max_iterations 1001", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.max_iterations = 1001));
    case!(cases, "shx_fit_friction", "friction", "reserved0 1", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.reserved0 = 1));
    case!(cases, "shx_fit_friction", "friction", "reserved[3] 1", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.reserved[3] = 1));
    case!(cases, "shx_fit_friction", "friction", "oscillation_amplitude f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.oscillation_amplitude = f64::NAN));
    case!(cases, "shx_fit_friction", "friction", "oscillation_frequency f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.oscillation_frequency = f64::NAN));
    case!(cases, "shx_fit_friction", "friction", "oscillation_phase f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.oscillation_phase = f64::NAN));
    case!(cases, "shx_fit_friction", "friction", "oscillation_direction[1] f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.oscillation_direction[1] = f64::NAN));
    case!(cases, "shx_fit_friction", "friction", "oscillation_amplitude f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.oscillation_amplitude = f64::INFINITY));
    case!(cases, "shx_fit_friction", "friction", "oscillation_frequency f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.oscillation_frequency = f64::INFINITY));
    case!(cases, "shx_fit_friction", "friction", "oscillation_phase f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.oscillation_phase = f64::INFINITY));
    case!(cases, "shx_fit_friction", "friction", "oscillation_direction[1] f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.oscillation_direction[1] = f64::INFINITY));
    case!(cases, "shx_fit_friction", "friction", "oscillation_frequency -1", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.oscillation_frequency = -1.0));
    case!(cases, "shx_fit_friction", "friction", "amplitude without frequency", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.oscillation_frequency = 0.0));
    case!(cases, "shx_fit_friction", "friction", "oscillation and poses", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| poses(c, ROOT_TIMES.as_ptr(), POSES.as_ptr(), 2)));
    case!(cases, "shx_fit_friction", "friction", "root_times null", SHX_ERROR_NULL_ARGUMENT, |s| fit(s.out(), |c| { (c.friction.oscillation_amplitude, c.friction.oscillation_frequency) = (0.0, 0.0); poses(c, null(), POSES.as_ptr(), 2) }));
    case!(cases, "shx_fit_friction", "friction", "root_frames null", SHX_ERROR_NULL_ARGUMENT, |s| fit(s.out(), |c| { (c.friction.oscillation_amplitude, c.friction.oscillation_frequency) = (0.0, 0.0); poses(c, ROOT_TIMES.as_ptr(), null(), 2) }));
    case!(cases, "shx_fit_friction", "friction", "root_count huge", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| { (c.friction.oscillation_amplitude, c.friction.oscillation_frequency) = (0.0, 0.0); poses(c, ROOT_TIMES.as_ptr(), POSES.as_ptr(), usize::MAX) }));
    case!(cases, "shx_fit_friction", "friction", "root_times backwards", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| { (c.friction.oscillation_amplitude, c.friction.oscillation_frequency) = (0.0, 0.0); poses(c, BACKWARDS.as_ptr(), POSES.as_ptr(), 2) }));
    case!(cases, "shx_fit_friction", "friction", "root_frames not unit", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| { (c.friction.oscillation_amplitude, c.friction.oscillation_frequency) = (0.0, 0.0); poses(c, ROOT_TIMES.as_ptr(), BAD_POSES.as_ptr(), 2) }));
    case!(cases, "shx_fit_friction", "times", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.times[3] = f64::NAN));
    case!(cases, "shx_fit_friction", "values", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.values[3] = f64::NAN));
    case!(cases, "shx_fit_friction", "times", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.times[3] = f64::INFINITY));
    case!(cases, "shx_fit_friction", "values", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.values[3] = f64::INFINITY));
    case!(cases, "shx_fit_friction", "times", "twice the same", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.times[3] = c.times[2]));
    case!(cases, "shx_fit_friction", "times", "too close", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.times[3] = c.times[2] + 1e-12));
    case!(cases, "shx_fit_friction", "times", "misaligned", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.misaligned = "times"));
    case!(cases, "shx_fit_friction", "count", "0", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.count = 0));
    case!(cases, "shx_fit_friction", "count", "1", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.count = 1));
    case!(cases, "shx_fit_friction", "count", "2", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.count = 2));
    case!(cases, "shx_fit_friction", "count", "all discarded", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.friction.discard = 1.0));
    case!(cases, "shx_fit_friction", "count", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.count = usize::MAX));
    case!(cases, "shx_fit_friction", "out_report", "struct_size 0", SHX_ERROR_STRUCT_SIZE, |s| fit(s.out(), |c| c.report.struct_size = 0));
    case!(cases, "shx_fit_friction", "out_report", "struct_size too small", SHX_ERROR_STRUCT_SIZE, |s| fit(s.out(), |c| c.report.struct_size -= 8));
    case!(cases, "shx_fit_friction", "out_curve", "misaligned", SHX_ERROR_INVALID_ARGUMENT, |s| fit(s.out(), |c| c.misaligned = "out_curve"));
}

/// A task system that is never asked.
extern "C" fn never(
    _: *mut std::ffi::c_void,
    _: u32,
    _: u32,
    _: superhelix::internals::capi::base::parallel::shx_range_fn,
    _: *mut std::ffi::c_void,
) {
    unreachable!("a fit does not use it")
}

fn poses(c: &mut Call, times: *const f64, frames: *const shx_frame, count: usize) {
    (c.friction.root_times, c.friction.root_frames, c.friction.root_count) = (times, frames, count);
}
