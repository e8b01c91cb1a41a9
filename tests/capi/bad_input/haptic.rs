//! Bad input to the functions of haptic objects: function, argument, fault, expected result code, call.

use super::*;

fn def() -> shx_haptic_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one definition, which the call fills.
    unsafe {
        assert_eq!(shx_haptic_def_init(def.as_mut_ptr(), size_of::<shx_haptic_def>()), SHX_OK);
        def.assume_init()
    }
}

/// Calls with a definition in which something is wrong.
fn creating(s: &mut Scene, change: impl FnOnce(&mut shx_haptic_def)) -> shx_result {
    let mut def = def();
    change(&mut def);
    // SAFETY: all that is pointed to is there.
    unsafe { shx_haptic_create(s.solver, &raw const def, s.bodies.as_ptr(), 1, s.out()) }
}

/// Calls with an object of the first body.
fn with(s: &mut Scene, call: impl FnOnce(&mut Scene, *mut shx_haptic) -> shx_result) -> shx_result {
    let mut haptic = null_mut();
    // SAFETY: all that is pointed to is there, and the object is freed once.
    unsafe {
        assert_eq!(shx_haptic_create(s.solver, null(), s.bodies.as_ptr(), 1, &raw mut haptic), SHX_OK);
        let result = call(s, haptic);
        shx_haptic_destroy(haptic);
        result
    }
}

/// Updates it, from numbers of which some may be wrong.
fn update(s: &mut Scene, change: impl FnOnce(&mut [f64; 7], &mut [f64; 6], &mut f64)) -> shx_result {
    with(s, |s, haptic| {
        let (mut pose, mut velocity, mut dt) = ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], [0.0; 6], 1e-3);
        change(&mut pose, &mut velocity, &mut dt);
        // SAFETY: a frame is seven numbers; all that is pointed to is there.
        unsafe { shx_haptic_update(haptic, pose.as_ptr().cast(), velocity.as_ptr(), dt, s.out(), null_mut()) }
    })
}

/// A comb's teeth.
fn teeth() -> shx_tool_def {
    let mut def = std::mem::MaybeUninit::uninit();
    // SAFETY: room for one definition, which the call fills.
    unsafe {
        assert_eq!(shx_tool_def_init(def.as_mut_ptr(), size_of::<shx_tool_def>()), SHX_OK);
        def.assume_init()
    }
}

/// Gives an object a ring comb of these teeth.
fn add(s: &mut Scene, tool: &shx_tool_def) -> shx_result {
    // SAFETY: all that is pointed to is there.
    with(s, |s, haptic| unsafe {
        shx_haptic_add_ring_comb(haptic, s.solver, tool, s.frames.as_ptr(), null(), s.ids.as_ptr(), 2, s.out())
    })
}

/// The same, with options of which some may be wrong.
fn add_with(s: &mut Scene, change: impl FnOnce(&mut shx_ring_comb_def)) -> shx_result {
    let (tool, mut def) = (teeth(), std::mem::MaybeUninit::uninit());
    // SAFETY: room for one definition, which the call fills; all that is pointed to is there.
    with(s, |s, haptic| unsafe {
        assert_eq!(shx_ring_comb_def_init(def.as_mut_ptr(), size_of::<shx_ring_comb_def>()), SHX_OK);
        let mut def = def.assume_init();
        change(&mut def);
        let (solver, ids) = (s.solver, s.ids.as_ptr());
        shx_haptic_add_ring_comb(haptic, solver, &raw const tool, s.frames.as_ptr(), &raw const def, ids, 2, s.out())
    })
}

/// Calls with an object that has one ring comb.
fn with_comb(s: &mut Scene, call: impl FnOnce(&mut Scene, *mut shx_haptic) -> shx_result) -> shx_result {
    let (tool, mut index) = (teeth(), 7);
    // SAFETY: all that is pointed to is there.
    with(s, |s, haptic| unsafe {
        let (solver, ids) = (s.solver, s.ids.as_ptr());
        let added = shx_haptic_add_ring_comb(haptic, solver, &raw const tool, s.frames.as_ptr(), null(), ids, 2, &raw mut index);
        assert_eq!((added, index), (SHX_OK, 0));
        call(s, haptic)
    })
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_haptic_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_haptic_def_init(null_mut(), size_of::<shx_haptic_def>()));
    case!(cases, "shx_haptic_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_haptic_def_init(s.out(), 0));
    case!(cases, "shx_haptic_def_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_haptic_def_init(s.out(), usize::MAX));
    case!(cases, "shx_haptic_state_init", "state", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_haptic_state_init(null_mut(), size_of::<shx_haptic_state>()));
    case!(cases, "shx_haptic_state_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_haptic_state_init(s.out(), 0));
    case!(cases, "shx_haptic_state_init", "size", "usize::MAX", SHX_ERROR_STRUCT_SIZE, |s| shx_haptic_state_init(s.out(), usize::MAX));
    case!(cases, "shx_haptic_create", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_haptic_create(null(), null(), s.bodies.as_ptr(), 1, s.out()));
    case!(cases, "shx_haptic_create", "def", "of another size", SHX_ERROR_STRUCT_SIZE, |s| creating(s, |def| def.struct_size = 3));
    case!(cases, "shx_haptic_create", "def", "mode 0", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.mode = 0));
    case!(cases, "shx_haptic_create", "def", "mode 3", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.mode = 3));
    case!(cases, "shx_haptic_create", "def", "handle.origin f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.handle.origin[1] = f64::NAN));
    case!(cases, "shx_haptic_create", "def", "handle.rotation zero", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.handle.rotation = [0.0; 4]));
    case!(cases, "shx_haptic_create", "def", "stiffness 0", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.stiffness = 0.0));
    case!(cases, "shx_haptic_create", "def", "damping -1", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.damping = -1.0));
    case!(cases, "shx_haptic_create", "def", "angular_stiffness f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.angular_stiffness = f64::NAN));
    case!(cases, "shx_haptic_create", "def", "angular_damping f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.angular_damping = f64::INFINITY));
    case!(cases, "shx_haptic_create", "def", "max_force 0", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.max_force = 0.0));
    case!(cases, "shx_haptic_create", "def", "max_torque 0", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.max_torque = 0.0));
    case!(cases, "shx_haptic_create", "def", "max_force_rate 0", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.max_force_rate = 0.0));
    case!(cases, "shx_haptic_create", "def", "max_torque_rate 0", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.max_torque_rate = 0.0));
    case!(cases, "shx_haptic_create", "def", "energy_allowance 0", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.energy_allowance = 0.0));
    case!(cases, "shx_haptic_create", "def", "max_energy_credit -1", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.max_energy_credit = -1.0));
    case!(cases, "shx_haptic_create", "def", "max_acceleration -1", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.max_acceleration = -1.0));
    case!(cases, "shx_haptic_create", "def", "max_angular_acceleration f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.max_angular_acceleration = f64::NAN));
    case!(cases, "shx_haptic_create", "def", "max_model_age 0", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.max_model_age = 0.0));
    case!(cases, "shx_haptic_create", "def", "max_contacts 0", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.max_contacts = 0));
    case!(cases, "shx_haptic_create", "def", "max_sweeps 1001", SHX_ERROR_INVALID_ARGUMENT, |s| creating(s, |def| def.max_sweeps = 1001));
    case!(cases, "shx_haptic_create", "bodies", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_haptic_create(s.solver, null(), null(), 1, s.out()));
    case!(cases, "shx_haptic_create", "bodies", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.bodies[0], s.stale_body]; shx_haptic_create(s.solver, null(), ids.as_ptr(), 2, s.out()) });
    case!(cases, "shx_haptic_create", "bodies", "foreign", SHX_ERROR_INVALID_ID, |s| { let ids = [s.bodies[0], s.foreign_body]; shx_haptic_create(s.solver, null(), ids.as_ptr(), 2, s.out()) });
    case!(cases, "shx_haptic_create", "bodies", "twice", SHX_ERROR_INVALID_ARGUMENT, |s| { let ids = [s.bodies[0]; 2]; shx_haptic_create(s.solver, null(), ids.as_ptr(), 2, s.out()) });
    case!(cases, "shx_haptic_create", "count", "0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_haptic_create(s.solver, null(), s.bodies.as_ptr(), 0, s.out()));
    case!(cases, "shx_haptic_create", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_haptic_create(s.solver, null(), s.bodies.as_ptr(), usize::MAX, s.out()));
    case!(cases, "shx_haptic_create", "out_haptic", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_haptic_create(s.solver, null(), s.bodies.as_ptr(), 1, null_mut()));
    case!(cases, "shx_haptic_destroy", "haptic", "null", SHX_OK, |s| { shx_haptic_destroy(null_mut()); SHX_OK });
    case!(cases, "shx_haptic_before_step", "haptic", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_haptic_before_step(null_mut(), s.solver, 1e-2));
    case!(cases, "shx_haptic_before_step", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |_, haptic| shx_haptic_before_step(haptic, null_mut(), 1e-2)));
    case!(cases, "shx_haptic_before_step", "solver", "another", SHX_ERROR_INVALID_ID, |s| with(s, |s, haptic| shx_haptic_before_step(haptic, s.other, 1e-2)));
    case!(cases, "shx_haptic_before_step", "dt", "0", SHX_ERROR_INVALID_ARGUMENT, |s| with(s, |s, haptic| shx_haptic_before_step(haptic, s.solver, 0.0)));
    case!(cases, "shx_haptic_before_step", "dt", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| with(s, |s, haptic| shx_haptic_before_step(haptic, s.solver, f64::NAN)));
    case!(cases, "shx_haptic_after_step", "haptic", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_haptic_after_step(null_mut(), s.solver));
    case!(cases, "shx_haptic_after_step", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |_, haptic| shx_haptic_after_step(haptic, null_mut())));
    case!(cases, "shx_haptic_after_step", "solver", "another", SHX_ERROR_INVALID_ID, |s| with(s, |s, haptic| shx_haptic_after_step(haptic, s.other)));
    case!(cases, "shx_haptic_update", "haptic", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let velocity = [0.0; 6]; shx_haptic_update(null_mut(), s.frames.as_ptr(), velocity.as_ptr(), 1e-3, s.out(), null_mut()) });
    case!(cases, "shx_haptic_update", "pose", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, haptic| { let velocity = [0.0; 6]; shx_haptic_update(haptic, null(), velocity.as_ptr(), 1e-3, s.out(), null_mut()) }));
    case!(cases, "shx_haptic_update", "pose", "origin f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| update(s, |pose, _, _| pose[2] = f64::NAN));
    case!(cases, "shx_haptic_update", "pose", "rotation zero", SHX_ERROR_INVALID_ARGUMENT, |s| update(s, |pose, _, _| pose[6] = 0.0));
    case!(cases, "shx_haptic_update", "velocity", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, haptic| shx_haptic_update(haptic, s.frames.as_ptr(), null(), 1e-3, s.out(), null_mut())));
    case!(cases, "shx_haptic_update", "velocity", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| update(s, |_, velocity, _| velocity[4] = f64::INFINITY));
    case!(cases, "shx_haptic_update", "dt", "0", SHX_ERROR_INVALID_ARGUMENT, |s| update(s, |_, _, dt| *dt = 0.0));
    case!(cases, "shx_haptic_update", "dt", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| update(s, |_, _, dt| *dt = f64::NAN));
    case!(cases, "shx_haptic_update", "out_wrench", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, haptic| { let velocity = [0.0; 6]; shx_haptic_update(haptic, s.frames.as_ptr(), velocity.as_ptr(), 1e-3, null_mut(), null_mut()) }));
    case!(cases, "shx_haptic_update", "state", "of another size", SHX_ERROR_STRUCT_SIZE, |s| with(s, |s, haptic| { let (velocity, mut state) = ([0.0; 6], [0_u64; 32]); shx_haptic_update(haptic, s.frames.as_ptr(), velocity.as_ptr(), 1e-3, s.out(), state.as_mut_ptr().cast()) }));
    case!(cases, "shx_haptic_add_ring_comb", "haptic", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let tool = teeth(); shx_haptic_add_ring_comb(null_mut(), s.solver, &raw const tool, s.frames.as_ptr(), null(), s.ids.as_ptr(), 2, s.out()) });
    case!(cases, "shx_haptic_add_ring_comb", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, haptic| { let tool = teeth(); shx_haptic_add_ring_comb(haptic, null(), &raw const tool, s.frames.as_ptr(), null(), s.ids.as_ptr(), 2, s.out()) }));
    case!(cases, "shx_haptic_add_ring_comb", "solver", "another", SHX_ERROR_INVALID_ID, |s| with(s, |s, haptic| { let tool = teeth(); shx_haptic_add_ring_comb(haptic, s.other, &raw const tool, s.frames.as_ptr(), null(), s.foreign.as_ptr(), 1, s.out()) }));
    case!(cases, "shx_haptic_add_ring_comb", "tool", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, haptic| { shx_haptic_add_ring_comb(haptic, s.solver, null(), s.frames.as_ptr(), null(), s.ids.as_ptr(), 2, s.out()) }));
    case!(cases, "shx_haptic_add_ring_comb", "tool", "of another size", SHX_ERROR_STRUCT_SIZE, |s| add(s, &shx_tool_def { struct_size: 3, ..teeth() }));
    case!(cases, "shx_haptic_add_ring_comb", "tool", "kind 0", SHX_ERROR_INVALID_ARGUMENT, |s| add(s, &shx_tool_def { kind: 0, ..teeth() }));
    case!(cases, "shx_haptic_add_ring_comb", "tool", "plates", SHX_ERROR_UNSUPPORTED, |s| add(s, &shx_tool_def { kind: SHX_TOOL_PLATES, ..teeth() }));
    case!(cases, "shx_haptic_add_ring_comb", "tool", "length f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| add(s, &shx_tool_def { length: f64::NAN, ..teeth() }));
    case!(cases, "shx_haptic_add_ring_comb", "frame", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, haptic| { let tool = teeth(); shx_haptic_add_ring_comb(haptic, s.solver, &raw const tool, null(), null(), s.ids.as_ptr(), 2, s.out()) }));
    case!(cases, "shx_haptic_add_ring_comb", "frame", "rotation zero", SHX_ERROR_INVALID_ARGUMENT, |s| with(s, |s, haptic| { let tool = teeth(); let frame = shx_frame { origin: [0.0; 3], rotation: [0.0; 4] }; shx_haptic_add_ring_comb(haptic, s.solver, &raw const tool, &raw const frame, null(), s.ids.as_ptr(), 2, s.out()) }));
    case!(cases, "shx_haptic_add_ring_comb", "def", "of another size", SHX_ERROR_STRUCT_SIZE, |s| add_with(s, |def| def.struct_size = 3));
    case!(cases, "shx_haptic_add_ring_comb", "def", "reserved0 1", SHX_ERROR_INVALID_ARGUMENT, |s| add_with(s, |def| def.reserved0 = 1));
    case!(cases, "shx_haptic_add_ring_comb", "def", "friction -1", SHX_ERROR_INVALID_ARGUMENT, |s| add_with(s, |def| def.friction = -1.0));
    case!(cases, "shx_haptic_add_ring_comb", "def", "max_force 0", SHX_ERROR_INVALID_ARGUMENT, |s| add_with(s, |def| def.max_force = 0.0));
    case!(cases, "shx_haptic_add_ring_comb", "def", "exempt_length f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| add_with(s, |def| def.exempt_length = f64::INFINITY));
    case!(cases, "shx_haptic_add_ring_comb", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, haptic| { let tool = teeth(); shx_haptic_add_ring_comb(haptic, s.solver, &raw const tool, s.frames.as_ptr(), null(), null(), 2, s.out()) }));
    case!(cases, "shx_haptic_add_ring_comb", "ids", "stale", SHX_ERROR_INVALID_ID, |s| with(s, |s, haptic| { let tool = teeth(); let ids = [s.ids[0], s.stale[0]]; shx_haptic_add_ring_comb(haptic, s.solver, &raw const tool, s.frames.as_ptr(), null(), ids.as_ptr(), 2, s.out()) }));
    case!(cases, "shx_haptic_add_ring_comb", "ids", "foreign", SHX_ERROR_INVALID_ID, |s| with(s, |s, haptic| { let tool = teeth(); shx_haptic_add_ring_comb(haptic, s.solver, &raw const tool, s.frames.as_ptr(), null(), s.foreign.as_ptr(), 1, s.out()) }));
    case!(cases, "shx_haptic_add_ring_comb", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| with(s, |s, haptic| { let tool = teeth(); shx_haptic_add_ring_comb(haptic, s.solver, &raw const tool, s.frames.as_ptr(), null(), s.ids.as_ptr(), usize::MAX, s.out()) }));
    case!(cases, "shx_haptic_add_ring_comb", "out_index", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, haptic| { let tool = teeth(); shx_haptic_add_ring_comb(haptic, s.solver, &raw const tool, s.frames.as_ptr(), null(), s.ids.as_ptr(), 2, null_mut()) }));
    case!(cases, "shx_haptic_ring_comb_report", "haptic", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_haptic_ring_comb_report(null(), 0, s.out()));
    case!(cases, "shx_haptic_ring_comb_report", "index", "without combs", SHX_ERROR_INVALID_ARGUMENT, |s| with(s, |s, haptic| shx_haptic_ring_comb_report(haptic, 0, s.out())));
    case!(cases, "shx_haptic_ring_comb_report", "index", "as many as combs", SHX_ERROR_INVALID_ARGUMENT, |s| with_comb(s, |s, haptic| shx_haptic_ring_comb_report(haptic, 1, s.out())));
    case!(cases, "shx_haptic_ring_comb_report", "index", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| with_comb(s, |s, haptic| shx_haptic_ring_comb_report(haptic, usize::MAX, s.out())));
    case!(cases, "shx_haptic_ring_comb_report", "out_report", "null", SHX_ERROR_NULL_ARGUMENT, |s| with_comb(s, |_, haptic| shx_haptic_ring_comb_report(haptic, 0, null_mut())));
    case!(cases, "shx_haptic_ring_comb_report", "out_report", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| with_comb(s, |s, haptic| shx_haptic_ring_comb_report(haptic, 0, s.out::<u8>().wrapping_add(1).cast())));
    case!(cases, "shx_haptic_ring_comb_frame", "haptic", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_haptic_ring_comb_frame(null(), 0, s.out()));
    case!(cases, "shx_haptic_ring_comb_frame", "index", "without combs", SHX_ERROR_INVALID_ARGUMENT, |s| with(s, |s, haptic| shx_haptic_ring_comb_frame(haptic, 0, s.out())));
    case!(cases, "shx_haptic_ring_comb_frame", "index", "as many as combs", SHX_ERROR_INVALID_ARGUMENT, |s| with_comb(s, |s, haptic| shx_haptic_ring_comb_frame(haptic, 1, s.out())));
    case!(cases, "shx_haptic_ring_comb_frame", "index", "usize::MAX", SHX_ERROR_INVALID_ARGUMENT, |s| with_comb(s, |s, haptic| shx_haptic_ring_comb_frame(haptic, usize::MAX, s.out())));
    case!(cases, "shx_haptic_ring_comb_frame", "out_frame", "null", SHX_ERROR_NULL_ARGUMENT, |s| with_comb(s, |_, haptic| shx_haptic_ring_comb_frame(haptic, 0, null_mut())));
    case!(cases, "shx_haptic_ring_comb_frame", "out_frame", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| with_comb(s, |s, haptic| shx_haptic_ring_comb_frame(haptic, 0, s.out::<u8>().wrapping_add(1).cast())));
    case!(cases, "shx_haptic_release_ring_combs", "haptic", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_haptic_release_ring_combs(null_mut(), s.solver));
    case!(cases, "shx_haptic_release_ring_combs", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| with_comb(s, |_, haptic| shx_haptic_release_ring_combs(haptic, null_mut())));
    case!(cases, "shx_haptic_release_ring_combs", "solver", "another", SHX_ERROR_INVALID_ID, |s| with_comb(s, |s, haptic| shx_haptic_release_ring_combs(haptic, s.other)));
}
