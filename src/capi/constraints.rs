//! Hard constraints: pins, clamps, ties and rings.

use std::mem::{offset_of, size_of};

use super::buffers::{FRAME_FORMATS, Place, Places, Strided, Writer, constraint_ids, each, frames_of};
use super::errors::{SHX_OK, shx_result};
use super::guard::{read, shx_solver, write};
use super::types::{shx_constraint_id, shx_frame, shx_input, shx_output, shx_strand_id};
use super::versioned::{Versioned, definitions, initialise};
use crate::contact::options::Friction;
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::solver::constraints::{ConstraintDef, ConstraintState, ConstraintStatus, Hold};
use crate::solver::id::{ConstraintId, StrandId};

/// The material point stays at the target's origin.
pub const SHX_CONSTRAINT_POINT: u32 = 1;
/// The point, and the strand's tangent stays along the target's first axis; the strand may turn about it.
pub const SHX_CONSTRAINT_DIRECTION: u32 = 2;
/// The point, and the material frame stays that of the target.
pub const SHX_CONSTRAINT_FRAME: u32 = 3;
/// The strand passes through a ring at the target's origin, with Coulomb friction; once its tip has gone through it is free.
pub const SHX_CONSTRAINT_RING: u32 = 4;
/// The point stays at a material point of another strand, or of the same one (a closed loop).
pub const SHX_CONSTRAINT_TIE: u32 = 5;

/// The constraint holds.
pub const SHX_CONSTRAINT_STATUS_SATISFIED: u32 = 1;
/// What it asks is decided by other constraints already, and agrees with them; its force is shared out arbitrarily.
pub const SHX_CONSTRAINT_STATUS_REDUNDANT: u32 = 2;
/// It does not hold: other constraints, or the strand's length, contradict it.
pub const SHX_CONSTRAINT_STATUS_VIOLATED: u32 = 3;
/// A ring that the strand has slipped out of.
pub const SHX_CONSTRAINT_STATUS_RELEASED: u32 = 4;

/// What a constraint is made from. Fill with shx_constraint_def_init, then set strand, arclength, hold and what that needs.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_constraint_def {
    /// Set by shx_constraint_def_init.
    pub struct_size: u32,
    /// SHX_CONSTRAINT_. Default SHX_CONSTRAINT_POINT.
    pub kind: u32,
    /// The strand that is held. Default null: set it.
    pub strand: shx_strand_id,
    /// Where on it, arclength from the root, m; 0 to its length. A ring begins near there. Default 0.
    pub arclength: f64,
    /// Tie: the other strand, or the same. Default null.
    pub other_strand: shx_strand_id,
    /// Tie: arclength on that, m; 0 to its length. Default 0.
    pub other_arclength: f64,
    /// Where the strand is held, world; not looked at by a tie. Default: at the origin, along the world's axes.
    pub target: shx_frame,
    /// Ring: its friction on the strand as it slides over it from root to tip; zero or above. Default 0.
    pub friction_along: f64,
    /// Ring: the same from tip to root. Default 0.
    pub friction_against: f64,
    /// How far the point gives way for a unit of force, m/N; zero or above; 0 for rings. Default 0: not at all.
    pub compliance: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_constraint_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let target = Frame::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            kind: SHX_CONSTRAINT_POINT,
            strand: shx_strand_id { bits: 0 },
            arclength: 0.0,
            other_strand: shx_strand_id { bits: 0 },
            other_arclength: 0.0,
            target: shx_frame { origin: target.origin.into(), rotation: target.rotation_xyzw() },
            friction_along: 0.0,
            friction_against: 0.0,
            compliance: 0.0,
        }
    }
}

/// What a constraint did in the last substep.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_constraint_state {
    /// SHX_CONSTRAINT_.
    pub status: u32,
    /// 0.
    pub reserved: u32,
    /// Where on the strand it holds, arclength, m: a ring's changes as the strand slides.
    pub arclength: f64,
    /// How far the held point is from where it should be, m.
    pub error: f64,
    /// Force on the (first) strand, N, world.
    pub force: [f64; 3],
    /// Torque on the strand about the held point, N m, world; zero but for directions and frames.
    pub torque: [f64; 3],
}

const _: () = {
    assert!(size_of::<shx_constraint_def>() == 120 && offset_of!(shx_constraint_def, target) == 40);
    assert!(size_of::<shx_constraint_state>() == 72 && offset_of!(shx_constraint_state, force) == 24);
};

impl shx_constraint_def {
    /// The engine's own definition; numbers and strands are looked at where it is added.
    fn definition(&self, argument: &str) -> Result<ConstraintDef> {
        let hold = match self.kind {
            SHX_CONSTRAINT_POINT => Hold::Point,
            SHX_CONSTRAINT_DIRECTION => Hold::Direction,
            SHX_CONSTRAINT_FRAME => Hold::Frame,
            SHX_CONSTRAINT_RING => Hold::Ring { friction: Friction { along: self.friction_along, against: self.friction_against } },
            SHX_CONSTRAINT_TIE => Hold::Tie { other: StrandId::from_bits(self.other_strand.bits), arclength: self.other_arclength },
            other => return Err(Error::invalid(format!("{argument}.kind"), other, "SHX_CONSTRAINT_POINT, _DIRECTION, _FRAME, _RING or _TIE")),
        };
        let target = if self.kind == SHX_CONSTRAINT_TIE {
            Frame::default()
        } else {
            Frame::from_arrays(&format!("{argument}.target"), self.target.origin, self.target.rotation)?
        };
        let strand = StrandId::from_bits(self.strand.bits);
        Ok(ConstraintDef { strand, arclength: self.arclength, hold, target, compliance: self.compliance })
    }
}

impl From<&ConstraintState> for shx_constraint_state {
    fn from(state: &ConstraintState) -> Self {
        Self {
            status: match state.status {
                ConstraintStatus::Holds => SHX_CONSTRAINT_STATUS_SATISFIED,
                ConstraintStatus::Dependent => SHX_CONSTRAINT_STATUS_REDUNDANT,
                ConstraintStatus::Violated => SHX_CONSTRAINT_STATUS_VIOLATED,
                ConstraintStatus::Released => SHX_CONSTRAINT_STATUS_RELEASED,
            },
            reserved: 0,
            arclength: state.arclength,
            error: state.error,
            force: state.force.into(),
            torque: state.torque.into(),
        }
    }
}

/// Fills a definition with the defaults. size is sizeof(shx_constraint_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_constraint_def_init(def: *mut shx_constraint_def, size: usize) -> shx_result {
    // SAFETY: the caller says that def holds size bytes.
    unsafe { initialise("shx_constraint_def_init", "def", def, size) }
}

/// Adds count constraints, all or none. Definition i begins i * def_stride bytes after the first (def_stride:
/// sizeof(shx_constraint_def)). out_ids receives count ids, in the order of the definitions. They hold from the end of the next substep
/// on: a point that is far from its target is drawn there within that substep. A constraint goes with its strands.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID (a strand), SHX_ERROR_INVALID_ARGUMENT (the text names
/// "defs[3].arclength"), SHX_ERROR_OUT_OF_MEMORY. Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_add_constraints(
    solver: *mut shx_solver,
    defs: *const shx_constraint_def,
    def_stride: usize,
    count: usize,
    out_ids: *mut shx_constraint_id,
) -> shx_result {
    // SAFETY: the caller's handle, structures and place for count ids.
    unsafe {
        write("shx_solver_add_constraints", solver, |core, _| {
            let places = Places::new("out_ids", "count", out_ids, count)?;
            let definitions = definitions("shx_constraint_def", defs, def_stride, count, shx_constraint_def::definition)?;
            let ids = core
                .add_constraints(&definitions)
                .map_err(|error| error.renamed("constraints", "defs").renamed_in("friction.", "friction_"))?;
            places.write(&ids.iter().map(|id| shx_constraint_id { bits: id.bits() }).collect::<Vec<_>>())
        })
    }
}

/// Removes count constraints, all or none. Their ids are stale from then on.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_remove_constraints(
    solver: *mut shx_solver,
    ids: *const shx_constraint_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_remove_constraints", solver, |core, _| core.remove_constraints(&constraint_ids(ids, count)?)) }
}

/// Whether an id names a constraint of this solver. False for the null id, a removed constraint, one whose strand was removed, another
/// solver's, a null or poisoned solver (shx_last_error then has the text). May run beside other reading calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_has_constraint(solver: *const shx_solver, id: shx_constraint_id) -> bool {
    let mut found = false;
    // SAFETY: the caller's handle, null or alive.
    let result = unsafe {
        read("shx_solver_has_constraint", solver, |core| {
            found = core.constraint(ConstraintId::from_bits(id.bits)).is_ok();
            Ok(())
        })
    };
    result == SHX_OK && found
}

/// How many constraints there are.
/// Errors: SHX_ERROR_NULL_ARGUMENT. May run beside other reading calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_constraint_count(solver: *const shx_solver, out_count: *mut usize) -> shx_result {
    // SAFETY: the caller's handle and place for one number.
    unsafe {
        read("shx_solver_constraint_count", solver, |core| {
            Place::new("out_count", out_count)?.write(core.constraint_ids().len());
            Ok(())
        })
    }
}

/// The ids of all constraints, in the order they were added, into out_ids, which holds capacity ids.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL (ask shx_solver_constraint_count). May run beside other reading calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_constraint_ids(
    solver: *const shx_solver,
    out_ids: *mut shx_constraint_id,
    capacity: usize,
) -> shx_result {
    // SAFETY: the caller's handle and place for capacity ids.
    unsafe {
        read("shx_solver_constraint_ids", solver, |core| {
            let places = Places::new("out_ids", "capacity", out_ids, capacity)?;
            let ids = core.constraint_ids();
            places.write(&ids.iter().map(|id| shx_constraint_id { bits: id.bits() }).collect::<Vec<_>>())
        })
    }
}

/// Moves the targets of count constraints smoothly to the given frames (SHX_FORMAT_FRAME, one for each id) over the next over_seconds of
/// simulated time (0 or above; 0: within the next substep). All or none. Targets of constraints that are not named stay on their way or
/// still; ties have none, and theirs are not looked at.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a number that is not finite, a quaternion whose
/// length is not 1, over_seconds below 0). Alone with the solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_constraint_targets(
    solver: *mut shx_solver,
    ids: *const shx_constraint_id,
    count: usize,
    frames: *const shx_input,
    over_seconds: f64,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and frames.
    unsafe {
        write("shx_solver_set_constraint_targets", solver, |core, _| {
            core.set_constraint_targets(&constraint_ids(ids, count)?, &frames_of(frames, count)?, over_seconds)
        })
    }
}

/// The targets of count constraints as they are now, into frames (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for the quaternions alone).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// May run beside other reading calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_constraint_targets(
    solver: *const shx_solver,
    ids: *const shx_constraint_id,
    count: usize,
    frames: *const shx_output,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and memory for frames.
    unsafe {
        read("shx_solver_get_constraint_targets", solver, |core| {
            let ids = constraint_ids(ids, count)?;
            let writer = Writer::required("frames", frames, FRAME_FORMATS, count)?;
            let found = each(&ids, |id| core.constraint(id).map(|def| def.target))?;
            for (index, frame) in found.iter().enumerate() {
                writer.frame(index, frame);
            }
            Ok(())
        })
    }
}

/// What each of count constraints did in the last substep, into states, which has room for count of them, stride bytes apart (0: packed;
/// any alignment).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT. May run beside other reading calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_constraint_states(
    solver: *const shx_solver,
    ids: *const shx_constraint_id,
    count: usize,
    out_states: *mut shx_constraint_state,
    stride: usize,
) -> shx_result {
    // SAFETY: the caller's handle, count ids and room for count states.
    unsafe {
        read("shx_solver_constraint_states", solver, |core| {
            let places = Strided::new("out_states", "count", out_states, stride, count)?;
            let found = each(&constraint_ids(ids, count)?, |id| core.constraint_state(id))?;
            places.write(&found.iter().map(shx_constraint_state::from).collect::<Vec<_>>())
        })
    }
}
