//! Bilateral constraints: pins, clamps, ties and rings.

use std::mem::{offset_of, size_of};

use crate::capi::base::buffers::{FRAME_FORMATS, OutputList, OutputValue, Strided, Writer, constraint_ids, each, frames_of};
use crate::capi::base::errors::{SHX_OK, shx_result};
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::types::{shx_constraint_id, shx_frame, shx_input, shx_output, shx_strand_id};
use crate::capi::base::versioned::{Versioned, definitions, initialise};
use crate::contact::options::Friction;
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::memory;
use crate::solver::constraints::{ConstraintDef, ConstraintState, ConstraintStatus, Hold};
use crate::solver::id::{ConstraintId, StrandId};

/// The material point stays at the origin of the target.
pub const SHX_CONSTRAINT_POINT: u32 = 1;
/// As SHX_CONSTRAINT_POINT, and the tangent stays along the first
/// axis of the target. The strand can rotate about it.
pub const SHX_CONSTRAINT_DIRECTION: u32 = 2;
/// As SHX_CONSTRAINT_POINT, and the material frame stays that of the target.
pub const SHX_CONSTRAINT_FRAME: u32 = 3;
/// The strand slides through a ring at the origin of the target, with
/// Coulomb friction, and is free once its tip has passed.
pub const SHX_CONSTRAINT_RING: u32 = 4;
/// The material point stays at a material point of another strand, or of the same one (a closed loop).
pub const SHX_CONSTRAINT_TIE: u32 = 5;

/// The constraint is satisfied.
pub const SHX_CONSTRAINT_STATUS_SATISFIED: u32 = 1;
/// Other constraints imply it, and agree with it. The distribution of force among them is arbitrary.
pub const SHX_CONSTRAINT_STATUS_REDUNDANT: u32 = 2;
/// It is violated: other constraints or the length of the strand contradict it.
pub const SHX_CONSTRAINT_STATUS_VIOLATED: u32 = 3;
/// The strand has slipped out of the ring.
pub const SHX_CONSTRAINT_STATUS_RELEASED: u32 = 4;

/// Definition of a constraint. Fill it with shx_constraint_def_init, then set
/// strand, arclength, kind and what that kind needs.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_constraint_def {
    /// Set by shx_constraint_def_init.
    pub struct_size: u32,
    /// SHX_CONSTRAINT_POINT (default), _DIRECTION, _FRAME, _RING or _TIE.
    pub kind: u32,
    /// The constrained strand. Default null id: set it.
    pub strand: shx_strand_id,
    /// Arclength of the constrained point from the root, m; 0 to the length
    /// of the strand. A ring starts near it. Default 0.
    pub arclength: f64,
    /// Tie: the other strand, or the same one. Default null id.
    pub other_strand: shx_strand_id,
    /// Tie: arclength on the other strand, m; 0 to its length. Default 0.
    pub other_arclength: f64,
    /// Target frame in world space; ignored by a tie. Default: at the origin, aligned with the world axes.
    pub target: shx_frame,
    /// Ring: Coulomb coefficient for sliding over the strand from root to tip; zero or above. Default 0.
    pub friction_along: f64,
    /// Ring: the same from tip to root. Default 0.
    pub friction_against: f64,
    /// Displacement of the point per unit of force, m/N; zero or above; must be 0 for rings. Default 0: rigid.
    pub compliance: f64,
    /// Your own number; the library does not use it. Default 0.
    pub user_data: u64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_constraint_def {
    const FIRST_SIZE: usize = offset_of!(Self, user_data);

    fn defaults() -> Self {
        let target = Frame::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            kind: SHX_CONSTRAINT_POINT,
            strand: shx_strand_id { bits: 0 },
            arclength: 0.0,
            other_strand: shx_strand_id { bits: 0 },
            other_arclength: 0.0,
            target: (&target).into(),
            friction_along: 0.0,
            friction_against: 0.0,
            compliance: 0.0,
            user_data: 0,
        }
    }
}

/// State of a constraint in the last substep.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_constraint_state {
    /// SHX_CONSTRAINT_STATUS_.
    pub status: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Arclength of the constrained point, m. That of a ring changes as the strand slides.
    pub arclength: f64,
    /// Distance of the constrained point from its target, m.
    pub error: f64,
    /// Force on the (first) strand, N, world.
    pub force: [f64; 3],
    /// Torque on the strand about the constrained point, N m, world. Non-zero for directions and frames only.
    pub torque: [f64; 3],
}

const _: () = {
    assert!(size_of::<shx_constraint_def>() == 128 && offset_of!(shx_constraint_def, target) == 40);
    assert!(size_of::<shx_constraint_state>() == 72 && offset_of!(shx_constraint_state, force) == 24);
};

impl shx_constraint_def {
    /// The engine's own definition; numbers and strands are checked where it is added.
    fn definition(&self, argument: &str) -> Result<ConstraintDef> {
        let hold = match self.kind {
            SHX_CONSTRAINT_POINT => Hold::Point,
            SHX_CONSTRAINT_DIRECTION => Hold::Direction,
            SHX_CONSTRAINT_FRAME => Hold::Frame,
            SHX_CONSTRAINT_RING => {
                Hold::Ring { friction: Friction { along: self.friction_along, against: self.friction_against } }
            }
            SHX_CONSTRAINT_TIE => {
                Hold::Tie { other: StrandId::from_bits(self.other_strand.bits), arclength: self.other_arclength }
            }
            other => {
                return Err(Error::invalid(
                    format!("{argument}.kind"),
                    other,
                    "SHX_CONSTRAINT_POINT, _DIRECTION, _FRAME, _RING or _TIE",
                ));
            }
        };
        let target = if self.kind == SHX_CONSTRAINT_TIE {
            Frame::default()
        } else {
            self.target.checked(&format!("{argument}.target"))?
        };
        let strand = StrandId::from_bits(self.strand.bits);
        Ok(ConstraintDef { strand, arclength: self.arclength, hold, target, compliance: self.compliance })
    }
}

#[doc(hidden)]
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

/// Fills *def with defaults. size is sizeof(shx_constraint_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_constraint_def_init(def: *mut shx_constraint_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_constraint_def_init", "def", def, size) }
}

/// The engine's error, with the names of the C structure.
fn in_words_of_c(error: Error) -> Error {
    error.renamed("constraints", "defs").renamed_in("friction.", "friction_").with_fields(&[("other", "other_strand")])
}

/// Adds count constraints, all or none. Definition i starts i * def_stride bytes after the first; def_stride
/// is usually sizeof(shx_constraint_def). Writes count ids to out_ids, in the order of the definitions.
/// Constraints hold from the end of the next substep on: a point far from its target is pulled there within
/// that substep. Removing a strand removes its constraints.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID (a strand),
/// SHX_ERROR_INVALID_ARGUMENT (the message names, say, "defs[3].arclength"), SHX_ERROR_OUT_OF_MEMORY.
/// Threads: exclusive.
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
            let places = OutputList::new("out_ids", "count", out_ids, count)?;
            let read = |def: &shx_constraint_def, argument: &str| Ok((def.definition(argument)?, def.user_data));
            let definitions = definitions("shx_constraint_def", defs, def_stride, count, read)?;
            let user_data = memory::collected(definitions.iter().map(|(_, user_data)| *user_data))?;
            let definitions = memory::collected(definitions.into_iter().map(|(definition, _)| definition))?;
            let ids = core.add_constraints(&definitions).map_err(in_words_of_c)?;
            for (id, user_data) in ids.iter().zip(user_data) {
                core.set_constraint_user_data(*id, user_data)?;
            }
            places.write_all(ids.iter().map(|id| shx_constraint_id { bits: id.bits() }))
        })
    }
}

/// Removes count constraints, all or none. Their ids become invalid.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_remove_constraints(
    solver: *mut shx_solver,
    ids: *const shx_constraint_id,
    count: usize,
) -> shx_result {
    // SAFETY: the caller's handle and count ids.
    unsafe { write("shx_solver_remove_constraints", solver, |core, _| core.remove_constraints(&constraint_ids(ids, count)?)) }
}

/// Returns whether id names a constraint of this solver. False for the null id, a removed
/// constraint, one whose strand was removed, one of another solver, and a null or
/// poisoned solver (shx_last_error then has the message).
/// Threads: shared.
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

/// Returns shx_constraint_def.user_data of a constraint.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_constraint_user_data(
    solver: *const shx_solver,
    id: shx_constraint_id,
    out_user_data: *mut u64,
) -> shx_result {
    // SAFETY: the caller's handle and place for one number.
    unsafe {
        read("shx_solver_get_constraint_user_data", solver, |core| {
            let place = OutputValue::new("out_user_data", out_user_data)?;
            place.write(core.constraint_user_data(ConstraintId::from_bits(id.bits))?);
            Ok(())
        })
    }
}

/// Returns the number of constraints.
/// Errors: SHX_ERROR_NULL_ARGUMENT.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_constraint_count(solver: *const shx_solver, out_count: *mut usize) -> shx_result {
    // SAFETY: the caller's handle and place for one number.
    unsafe {
        read("shx_solver_constraint_count", solver, |core| {
            OutputValue::new("out_count", out_count)?.write(core.constraint_ids().len());
            Ok(())
        })
    }
}

/// Writes the ids of all constraints, in the order in which they
/// were added, to out_ids, which holds capacity ids.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL (see shx_solver_constraint_count).
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_constraint_ids(
    solver: *const shx_solver,
    out_ids: *mut shx_constraint_id,
    capacity: usize,
) -> shx_result {
    // SAFETY: the caller's handle and place for capacity ids.
    unsafe {
        read("shx_solver_constraint_ids", solver, |core| {
            let places = OutputList::new("out_ids", "capacity", out_ids, capacity)?;
            let ids = core.constraint_ids();
            places.write_all(ids.iter().map(|id| shx_constraint_id { bits: id.bits() }))
        })
    }
}

/// Moves the targets of count constraints smoothly to the given frames (SHX_FORMAT_FRAME, one per id) over the
/// next over_seconds of simulated time. 0: within the next substep. All or none. Other targets continue their
/// motion or remain at rest. Ties have no targets; their frames are ignored.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT (a value that is not
/// finite, a quaternion that is not of unit length, negative over_seconds).
/// Threads: exclusive.
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

/// Writes the current targets of count constraints to frames
/// (SHX_FORMAT_FRAME, or _F32X4 and _F64X4 for the quaternions alone).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID,
/// SHX_ERROR_INVALID_ARGUMENT, SHX_ERROR_BUFFER_TOO_SMALL.
/// Threads: shared.
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

/// Writes the states of count constraints in the last substep to out_states, which holds count items,
/// stride bytes apart (0: tightly packed; any alignment).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: shared.
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
            places.write_all(found.iter().map(shx_constraint_state::from))
        })
    }
}
