//! Bad input to the functions of styling and of hair handle: function, argument, fault, expected result code, call.

use super::*;

/// A definition as its function makes it.
macro_rules! made {
    ($name:ident, $type:ty, $init:ident) => {
        fn $name() -> $type {
            let mut def = std::mem::MaybeUninit::uninit();
            // SAFETY: room for one structure, which the call fills.
            unsafe {
                assert_eq!($init(def.as_mut_ptr(), size_of::<$type>()), SHX_OK);
                def.assume_init()
            }
        }
    };
}
made!(tool, shx_tool_def, shx_tool_def_init);
made!(clip, shx_clip_def, shx_clip_def_init);
made!(heat, shx_heat_def, shx_heat_def_init);
made!(ring_comb_def, shx_ring_comb_def, shx_ring_comb_def_init);
made!(handle, shx_hair_handle, shx_hair_handle_init);
made!(hair_type, shx_hair_type, shx_hair_type_init);
made!(combing_test, shx_combing_test, shx_combing_test_init);

/// A blade far from all strands.
const BLADE: [f64; 12] = [50.0, 0.0, 0.0, 51.0, 0.0, 0.0, 51.0, 1.0, 0.0, 50.0, 1.0, 0.0];

/// A call with a comb.
fn with(s: &mut Scene, call: impl FnOnce(&mut Scene, *mut shx_ring_comb) -> shx_result) -> shx_result {
    let (def, mut comb) = (tool(), null_mut());
    // SAFETY: structures that the library has filled, and room for a pointer.
    unsafe {
        assert_eq!(shx_ring_comb_create(&raw const def, s.frames.as_ptr().cast(), null(), &raw mut comb), SHX_OK);
        let result = call(s, comb);
        shx_ring_comb_destroy(comb);
        result
    }
}

#[rustfmt::skip]
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_tool_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_tool_def_init(null_mut(), size_of::<shx_tool_def>()));
    case!(cases, "shx_tool_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_tool_def_init(s.out(), 0));
    case!(cases, "shx_tool_def_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_tool_def_init(s.out(), usize::MAX));
    case!(cases, "shx_clip_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_clip_def_init(null_mut(), size_of::<shx_clip_def>()));
    case!(cases, "shx_clip_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_clip_def_init(s.out(), 0));
    case!(cases, "shx_clip_def_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_clip_def_init(s.out(), usize::MAX));
    case!(cases, "shx_heat_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_heat_def_init(null_mut(), size_of::<shx_heat_def>()));
    case!(cases, "shx_heat_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_heat_def_init(s.out(), 0));
    case!(cases, "shx_heat_def_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_heat_def_init(s.out(), usize::MAX));
    case!(cases, "shx_ring_comb_def_init", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_ring_comb_def_init(null_mut(), size_of::<shx_ring_comb_def>()));
    case!(cases, "shx_ring_comb_def_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_ring_comb_def_init(s.out(), 0));
    case!(cases, "shx_ring_comb_def_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_ring_comb_def_init(s.out(), usize::MAX));
    case!(cases, "shx_hair_handle_init", "handle", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_hair_handle_init(null_mut(), size_of::<shx_hair_handle>()));
    case!(cases, "shx_hair_handle_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_handle_init(s.out(), 0));
    case!(cases, "shx_hair_handle_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_hair_handle_init(s.out(), usize::MAX));
    case!(cases, "shx_combing_test_init", "test", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_combing_test_init(null_mut(), size_of::<shx_combing_test>()));
    case!(cases, "shx_combing_test_init", "size", "0", SHX_ERROR_STRUCT_SIZE, |s| shx_combing_test_init(s.out(), 0));
    case!(cases, "shx_combing_test_init", "size", "huge", SHX_ERROR_STRUCT_SIZE, |s| shx_combing_test_init(s.out(), usize::MAX));
    case!(cases, "shx_tool_frames", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_tool_frames(null(), s.frames.as_ptr(), 0.0, null_mut(), 0, s.out()));
    case!(cases, "shx_tool_frames", "def", "kind 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = tool(); let def = shx_tool_def { kind: 0, ..def }; shx_tool_frames(&raw const def, s.frames.as_ptr(), 0.0, null_mut(), 0, s.out()) });
    case!(cases, "shx_tool_frames", "def", "radius f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = tool(); let def = shx_tool_def { radius: f64::NAN, ..def }; shx_tool_frames(&raw const def, s.frames.as_ptr(), 0.0, null_mut(), 0, s.out()) });
    case!(cases, "shx_tool_frames", "frame", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = tool(); shx_tool_frames(&raw const def, null(), 0.0, null_mut(), 0, s.out()) });
    case!(cases, "shx_tool_frames", "opening", "-1", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = tool(); shx_tool_frames(&raw const def, s.frames.as_ptr(), -1.0, null_mut(), 0, s.out()) });
    case!(cases, "shx_tool_frames", "out_frames", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = tool(); shx_tool_frames(&raw const def, s.frames.as_ptr(), 0.0, s.out::<u8>().wrapping_add(1).cast(), 1, s.out2()) });
    case!(cases, "shx_tool_frames", "capacity", "too small", SHX_ERROR_BUFFER_TOO_SMALL, |s| { let def = tool(); shx_tool_frames(&raw const def, s.frames.as_ptr(), 0.0, s.out(), 3, s.out2()) });
    case!(cases, "shx_tool_frames", "out_count", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = tool(); shx_tool_frames(&raw const def, s.frames.as_ptr(), 0.0, null_mut(), 0, null_mut()) });
    case!(cases, "shx_tool_hot_box", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_tool_hot_box(null(), 0.0, s.out()));
    case!(cases, "shx_tool_hot_box", "def", "a comb", SHX_ERROR_UNSUPPORTED, |s| { let def = tool(); shx_tool_hot_box(&raw const def, 0.0, s.out()) });
    case!(cases, "shx_tool_hot_box", "opening", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = tool(); let def = shx_tool_def { kind: SHX_TOOL_PLATES, ..def }; shx_tool_hot_box(&raw const def, f64::NAN, s.out()) });
    case!(cases, "shx_tool_hot_box", "out_half_edges", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = tool(); let def = shx_tool_def { kind: SHX_TOOL_PLATES, ..def }; shx_tool_hot_box(&raw const def, 0.0, null_mut()) });
    case!(cases, "shx_solver_add_tool", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = tool(); shx_solver_add_tool(null_mut(), &raw const def, s.frames.as_ptr(), 0.0, s.out(), 12, s.out2()) });
    case!(cases, "shx_solver_add_tool", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_add_tool(s.solver, null(), s.frames.as_ptr(), 0.0, s.out(), 12, s.out2()));
    case!(cases, "shx_solver_add_tool", "frame", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = tool(); shx_solver_add_tool(s.solver, &raw const def, null(), 0.0, s.out(), 12, s.out2()) });
    case!(cases, "shx_solver_add_tool", "opening", "-1", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = tool(); shx_solver_add_tool(s.solver, &raw const def, s.frames.as_ptr(), -1.0, s.out(), 12, s.out2()) });
    case!(cases, "shx_solver_add_tool", "out_ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = tool(); shx_solver_add_tool(s.solver, &raw const def, s.frames.as_ptr(), 0.0, null_mut(), 12, s.out2()) });
    case!(cases, "shx_solver_add_tool", "capacity", "too small", SHX_ERROR_BUFFER_TOO_SMALL, |s| { let def = tool(); shx_solver_add_tool(s.solver, &raw const def, s.frames.as_ptr(), 0.0, s.out(), 11, s.out2()) });
    case!(cases, "shx_solver_add_tool", "out_count", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = tool(); shx_solver_add_tool(s.solver, &raw const def, s.frames.as_ptr(), 0.0, s.out(), 12, null_mut()) });
    case!(cases, "shx_solver_clip_strands", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = clip(); shx_solver_clip_strands(null_mut(), &raw const def, s.ids.as_ptr(), 2, s.out(), 4, s.out2()) });
    case!(cases, "shx_solver_clip_strands", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_clip_strands(s.solver, null(), s.ids.as_ptr(), 2, s.out(), 4, s.out2()));
    case!(cases, "shx_solver_clip_strands", "def", "kind of a ring", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = clip(); let def = shx_clip_def { kind: 4, ..def }; shx_solver_clip_strands(s.solver, &raw const def, s.ids.as_ptr(), 2, s.out(), 4, s.out2()) });
    case!(cases, "shx_solver_clip_strands", "def", "half_edges 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = clip(); let def = shx_clip_def { half_edges: [0.0; 3], ..def }; shx_solver_clip_strands(s.solver, &raw const def, s.ids.as_ptr(), 2, s.out(), 4, s.out2()) });
    case!(cases, "shx_solver_clip_strands", "def", "compliance -1", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = clip(); let def = shx_clip_def { compliance: -1.0, ..def }; shx_solver_clip_strands(s.solver, &raw const def, s.ids.as_ptr(), 2, s.out(), 4, s.out2()) });
    case!(cases, "shx_solver_clip_strands", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let def = clip(); shx_solver_clip_strands(s.solver, &raw const def, s.stale.as_ptr(), 1, s.out(), 4, s.out2()) });
    case!(cases, "shx_solver_clip_strands", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = clip(); shx_solver_clip_strands(s.solver, &raw const def, s.ids.as_ptr(), usize::MAX, s.out(), 4, s.out2()) });
    case!(cases, "shx_solver_clip_strands", "out_ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = clip(); shx_solver_clip_strands(s.solver, &raw const def, s.ids.as_ptr(), 2, null_mut(), 4, s.out2()) });
    case!(cases, "shx_solver_clip_strands", "capacity", "too small", SHX_ERROR_BUFFER_TOO_SMALL, |s| { let def = clip(); let def = shx_clip_def { half_edges: [10.0; 3], ..def }; shx_solver_clip_strands(s.solver, &raw const def, s.ids.as_ptr(), 2, s.out(), 1, s.out2()) });
    case!(cases, "shx_solver_clip_strands", "out_count", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = clip(); shx_solver_clip_strands(s.solver, &raw const def, s.ids.as_ptr(), 2, s.out(), 4, null_mut()) });
    case!(cases, "shx_solver_move_constraints", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_move_constraints(null_mut(), s.constraints.as_ptr(), 2, s.frames.as_ptr(), s.frames.as_ptr(), 0.1));
    case!(cases, "shx_solver_move_constraints", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_move_constraints(s.solver, null(), 2, s.frames.as_ptr(), s.frames.as_ptr(), 0.1));
    case!(cases, "shx_solver_move_constraints", "ids", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_move_constraints(s.solver, &raw const s.stale_constraint, 1, s.frames.as_ptr(), s.frames.as_ptr(), 0.1));
    case!(cases, "shx_solver_move_constraints", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_move_constraints(s.solver, s.constraints.as_ptr(), usize::MAX, s.frames.as_ptr(), s.frames.as_ptr(), 0.1));
    case!(cases, "shx_solver_move_constraints", "from", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_move_constraints(s.solver, s.constraints.as_ptr(), 2, null(), s.frames.as_ptr(), 0.1));
    case!(cases, "shx_solver_move_constraints", "to", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_move_constraints(s.solver, s.constraints.as_ptr(), 2, s.frames.as_ptr(), null(), 0.1));
    case!(cases, "shx_solver_move_constraints", "over_seconds", "-1", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_move_constraints(s.solver, s.constraints.as_ptr(), 2, s.frames.as_ptr(), s.frames.as_ptr(), -1.0));
    case!(cases, "shx_solver_scissor_strands", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_scissor_strands(null_mut(), s.ids.as_ptr(), 2, BLADE.as_ptr(), 1e-3, s.out(), s.out2()));
    case!(cases, "shx_solver_scissor_strands", "ids", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_scissor_strands(s.solver, s.stale.as_ptr(), 1, BLADE.as_ptr(), 1e-3, s.out(), s.out2()));
    case!(cases, "shx_solver_scissor_strands", "ids", "twice", SHX_ERROR_INVALID_ARGUMENT, |s| { let ids = [s.ids[0]; 2]; shx_solver_scissor_strands(s.solver, ids.as_ptr(), 2, BLADE.as_ptr(), 1e-3, s.out(), s.out2()) });
    case!(cases, "shx_solver_scissor_strands", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_scissor_strands(s.solver, s.ids.as_ptr(), usize::MAX, BLADE.as_ptr(), 1e-3, s.out(), s.out2()));
    case!(cases, "shx_solver_scissor_strands", "corners", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_scissor_strands(s.solver, s.ids.as_ptr(), 2, null(), 1e-3, s.out(), s.out2()));
    case!(cases, "shx_solver_scissor_strands", "corners", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut blade = BLADE; blade[7] = f64::NAN; shx_solver_scissor_strands(s.solver, s.ids.as_ptr(), 2, blade.as_ptr(), 1e-3, s.out(), s.out2()) });
    case!(cases, "shx_solver_scissor_strands", "min_length", "0", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_scissor_strands(s.solver, s.ids.as_ptr(), 2, BLADE.as_ptr(), 0.0, s.out(), s.out2()));
    case!(cases, "shx_solver_scissor_strands", "out_cuts", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_scissor_strands(s.solver, s.ids.as_ptr(), 2, BLADE.as_ptr(), 1e-3, null_mut(), s.out2()));
    case!(cases, "shx_solver_scissor_strands", "out_count", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_scissor_strands(s.solver, s.ids.as_ptr(), 2, BLADE.as_ptr(), 1e-3, s.out(), null_mut()));
    case!(cases, "shx_solver_heat_strands", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = heat(); shx_solver_heat_strands(null_mut(), &raw const def, s.ids.as_ptr(), 2, 0.1, null_mut()) });
    case!(cases, "shx_solver_heat_strands", "def", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_heat_strands(s.solver, null(), s.ids.as_ptr(), 2, 0.1, null_mut()));
    case!(cases, "shx_solver_heat_strands", "def", "shape 3", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = heat(); let def = shx_heat_def { shape: 3, ..def }; shx_solver_heat_strands(s.solver, &raw const def, s.ids.as_ptr(), 2, 0.1, null_mut()) });
    case!(cases, "shx_solver_heat_strands", "def", "rate -1", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = heat(); let def = shx_heat_def { rate: -1.0, ..def }; shx_solver_heat_strands(s.solver, &raw const def, s.ids.as_ptr(), 2, 0.1, null_mut()) });
    case!(cases, "shx_solver_heat_strands", "ids", "stale", SHX_ERROR_INVALID_ID, |s| { let def = heat(); shx_solver_heat_strands(s.solver, &raw const def, s.stale.as_ptr(), 1, 0.1, null_mut()) });
    case!(cases, "shx_solver_heat_strands", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = heat(); shx_solver_heat_strands(s.solver, &raw const def, s.ids.as_ptr(), usize::MAX, 0.1, null_mut()) });
    case!(cases, "shx_solver_heat_strands", "seconds", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = heat(); shx_solver_heat_strands(s.solver, &raw const def, s.ids.as_ptr(), 2, f64::NAN, null_mut()) });
    case!(cases, "shx_solver_heat_strands", "out_heated", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = heat(); shx_solver_heat_strands(s.solver, &raw const def, s.ids.as_ptr(), 2, 0.1, s.out::<u8>().wrapping_add(1).cast()) });
    case!(cases, "shx_solver_freeze_strands", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_freeze_strands(null_mut(), s.ids.as_ptr(), 2));
    case!(cases, "shx_solver_freeze_strands", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_freeze_strands(s.solver, null(), 2));
    case!(cases, "shx_solver_freeze_strands", "ids", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_freeze_strands(s.solver, s.stale.as_ptr(), 1));
    case!(cases, "shx_solver_freeze_strands", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_freeze_strands(s.solver, s.ids.as_ptr(), usize::MAX));
    case!(cases, "shx_solver_wake_strands", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_wake_strands(null_mut(), s.ids.as_ptr(), 2));
    case!(cases, "shx_solver_wake_strands", "ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_wake_strands(s.solver, null(), 2));
    case!(cases, "shx_solver_wake_strands", "ids", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_wake_strands(s.solver, s.stale.as_ptr(), 1));
    case!(cases, "shx_solver_wake_strands", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_wake_strands(s.solver, s.ids.as_ptr(), usize::MAX));
    case!(cases, "shx_solver_freeze_strands", "ids", "twice", SHX_ERROR_INVALID_ARGUMENT, |s| { let ids = [s.ids[0]; 2]; shx_solver_freeze_strands(s.solver, ids.as_ptr(), 2) });
    case!(cases, "shx_solver_frozen_strands", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_frozen_strands(null(), s.ids.as_ptr(), 2, s.out()));
    case!(cases, "shx_solver_frozen_strands", "ids", "stale", SHX_ERROR_INVALID_ID, |s| shx_solver_frozen_strands(s.solver, s.stale.as_ptr(), 1, s.out()));
    case!(cases, "shx_solver_frozen_strands", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_solver_frozen_strands(s.solver, s.ids.as_ptr(), usize::MAX, s.out()));
    case!(cases, "shx_solver_frozen_strands", "out_frozen", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_solver_frozen_strands(s.solver, s.ids.as_ptr(), 2, null_mut()));
    case!(cases, "shx_ring_comb_create", "tool", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_ring_comb_create(null(), s.frames.as_ptr(), null(), s.out()));
    case!(cases, "shx_ring_comb_create", "tool", "plates", SHX_ERROR_UNSUPPORTED, |s| { let def = tool(); let def = shx_tool_def { kind: SHX_TOOL_PLATES, ..def }; shx_ring_comb_create(&raw const def, s.frames.as_ptr(), null(), s.out()) });
    case!(cases, "shx_ring_comb_create", "frame", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = tool(); shx_ring_comb_create(&raw const def, null(), null(), s.out()) });
    case!(cases, "shx_ring_comb_create", "def", "max_force 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let def = tool(); let options = shx_ring_comb_def { max_force: 0.0, ..ring_comb_def() }; shx_ring_comb_create(&raw const def, s.frames.as_ptr(), &raw const options, s.out()) });
    case!(cases, "shx_ring_comb_create", "out_comb", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let def = tool(); shx_ring_comb_create(&raw const def, s.frames.as_ptr(), null(), null_mut()) });
    case!(cases, "shx_ring_comb_destroy", "comb", "null", SHX_OK, |s| { shx_ring_comb_destroy(null_mut()); SHX_OK });
    case!(cases, "shx_ring_comb_before_step", "comb", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_ring_comb_before_step(null_mut(), s.solver, s.ids.as_ptr(), 2, s.frames.as_ptr(), 1e-2));
    case!(cases, "shx_ring_comb_before_step", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, comb| shx_ring_comb_before_step(comb, null_mut(), s.ids.as_ptr(), 2, s.frames.as_ptr(), 1e-2)));
    case!(cases, "shx_ring_comb_before_step", "ids", "stale", SHX_ERROR_INVALID_ID, |s| with(s, |s, comb| shx_ring_comb_before_step(comb, s.solver, s.stale.as_ptr(), 1, s.frames.as_ptr(), 1e-2)));
    case!(cases, "shx_ring_comb_before_step", "count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| with(s, |s, comb| shx_ring_comb_before_step(comb, s.solver, s.ids.as_ptr(), usize::MAX, s.frames.as_ptr(), 1e-2)));
    case!(cases, "shx_ring_comb_before_step", "frame", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, comb| shx_ring_comb_before_step(comb, s.solver, s.ids.as_ptr(), 2, null(), 1e-2)));
    case!(cases, "shx_ring_comb_before_step", "dt", "0", SHX_ERROR_INVALID_ARGUMENT, |s| with(s, |s, comb| shx_ring_comb_before_step(comb, s.solver, s.ids.as_ptr(), 2, s.frames.as_ptr(), 0.0)));
    case!(cases, "shx_ring_comb_after_step", "comb", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_ring_comb_after_step(null_mut(), s.solver, s.out()));
    case!(cases, "shx_ring_comb_after_step", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, comb| shx_ring_comb_after_step(comb, null_mut(), s.out())));
    case!(cases, "shx_ring_comb_after_step", "out_report", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |s, comb| shx_ring_comb_after_step(comb, s.solver, null_mut())));
    case!(cases, "shx_ring_comb_release", "comb", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_ring_comb_release(null_mut(), s.solver));
    case!(cases, "shx_ring_comb_release", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| with(s, |_, comb| shx_ring_comb_release(comb, null_mut())));
    case!(cases, "shx_hair_handle_from_name", "name", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let mut hair = handle(); shx_hair_handle_from_name(null(), &raw mut hair) });
    case!(cases, "shx_hair_handle_from_name", "name", "unknown", SHX_ERROR_INVALID_ARGUMENT, |s| { let mut hair = handle(); shx_hair_handle_from_name(c"blond".as_ptr(), &raw mut hair) });
    case!(cases, "shx_hair_handle_from_name", "out_handle", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_hair_handle_from_name(c"h1".as_ptr(), null_mut()));
    case!(cases, "shx_hair_handle_adjust", "handle", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let mut hair = handle(); shx_hair_handle_adjust(null(), 0.0, 0.0, &raw mut hair) });
    case!(cases, "shx_hair_handle_adjust", "handle", "ellipticity 0.5", SHX_ERROR_INVALID_ARGUMENT, |s| { let (own, mut hair) = (handle(), handle()); let own = shx_hair_handle { ellipticity: 0.5, ..own }; shx_hair_handle_adjust(&raw const own, 0.0, 0.0, &raw mut hair) });
    case!(cases, "shx_hair_handle_adjust", "curliness", "2", SHX_ERROR_INVALID_ARGUMENT, |s| { let (own, mut hair) = (handle(), handle()); shx_hair_handle_adjust(&raw const own, 2.0, 0.0, &raw mut hair) });
    case!(cases, "shx_hair_handle_adjust", "combing_ease", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let (own, mut hair) = (handle(), handle()); shx_hair_handle_adjust(&raw const own, 0.0, f64::NAN, &raw mut hair) });
    case!(cases, "shx_hair_handle_adjust", "out_handle", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let own = handle(); shx_hair_handle_adjust(&raw const own, 0.0, 0.0, null_mut()) });
    case!(cases, "shx_hair_handle_to_type", "handle", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let mut hair = hair_type(); shx_hair_handle_to_type(null(), &raw mut hair) });
    case!(cases, "shx_hair_handle_to_type", "out_hair", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let own = handle(); shx_hair_handle_to_type(&raw const own, null_mut()) });
    case!(cases, "shx_combing_test_run", "test", "strand_count 0", SHX_ERROR_INVALID_ARGUMENT, |s| { let own = handle(); let test = shx_combing_test { strand_count: 0, ..combing_test() }; shx_combing_test_run(&raw const test, &raw const own, null_mut(), null_mut(), null_mut(), 0, s.out()) });
    case!(cases, "shx_combing_test_run", "test", "stroke too long", SHX_ERROR_INVALID_ARGUMENT, |s| { let own = handle(); let test = shx_combing_test { stroke: 1.0, ..combing_test() }; shx_combing_test_run(&raw const test, &raw const own, null_mut(), null_mut(), null_mut(), 0, s.out()) });
    case!(cases, "shx_combing_test_run", "handle", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_combing_test_run(null(), null(), null_mut(), null_mut(), null_mut(), 0, s.out()));
    case!(cases, "shx_combing_test_run", "out_stroke", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| { let own = handle(); shx_combing_test_run(null(), &raw const own, s.out::<u8>().wrapping_add(1).cast(), null_mut(), null_mut(), 1, s.out2()) });
    case!(cases, "shx_combing_test_run", "out_force", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| { let own = handle(); shx_combing_test_run(null(), &raw const own, null_mut(), s.out::<u8>().wrapping_add(1).cast(), null_mut(), 1, s.out2()) });
    case!(cases, "shx_combing_test_run", "out_pressure", "not aligned", SHX_ERROR_INVALID_ARGUMENT, |s| { let own = handle(); shx_combing_test_run(null(), &raw const own, null_mut(), null_mut(), s.out::<u8>().wrapping_add(1).cast(), 1, s.out2()) });
    case!(cases, "shx_combing_test_run", "capacity", "too small", SHX_ERROR_BUFFER_TOO_SMALL, |s| { let own = handle(); shx_combing_test_run(null(), &raw const own, s.out(), null_mut(), null_mut(), 3, s.out2()) });
    case!(cases, "shx_combing_test_run", "out_result", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let own = handle(); shx_combing_test_run(null(), &raw const own, null_mut(), null_mut(), null_mut(), 0, null_mut()) });
}
