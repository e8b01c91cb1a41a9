//! Bad input to the functions of rigid attachments: function, argument, fault, expected result code, call.

use super::*;

/// An attachment of the scene's first strand, first body and first constraint, in memory that lives until the process ends.
fn attachment(s: &Scene) -> *mut shx_attachment {
    let mut made = null_mut();
    // SAFETY: living handles, one id each, place for a pointer.
    let result = unsafe {
        let (strand, body, constraint) = (s.ids.as_ptr(), s.bodies.as_ptr(), s.constraints.as_ptr());
        shx_attachment_create(s.solver, &raw const s.frames[0], strand, 1, body, 1, constraint, 1, &raw mut made)
    };
    assert_eq!(result, SHX_OK);
    made
}

#[rustfmt::skip] // a table: one line a case
pub fn cases(cases: &mut Vec<Case>) {
    case!(cases, "shx_attachment_create", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_attachment_create(null(), &raw const s.frames[0], s.ids.as_ptr(), 2, s.bodies.as_ptr(), 2, s.constraints.as_ptr(), 2, s.out()));
    case!(cases, "shx_attachment_create", "pose", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_attachment_create(s.solver, null(), s.ids.as_ptr(), 2, s.bodies.as_ptr(), 2, s.constraints.as_ptr(), 2, s.out()));
    case!(cases, "shx_attachment_create", "pose", "not finite", SHX_ERROR_INVALID_ARGUMENT, |s| { let pose = shx_frame { origin: [f64::NAN, 0.0, 0.0], ..s.frames[0] }; shx_attachment_create(s.solver, &raw const pose, s.ids.as_ptr(), 2, s.bodies.as_ptr(), 2, s.constraints.as_ptr(), 2, s.out()) });
    case!(cases, "shx_attachment_create", "strand_ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_attachment_create(s.solver, &raw const s.frames[0], null(), 2, s.bodies.as_ptr(), 2, s.constraints.as_ptr(), 2, s.out()));
    case!(cases, "shx_attachment_create", "strand_ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.ids[0], s.stale[0]]; shx_attachment_create(s.solver, &raw const s.frames[0], ids.as_ptr(), 2, s.bodies.as_ptr(), 2, s.constraints.as_ptr(), 2, s.out()) });
    case!(cases, "shx_attachment_create", "strand_count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_attachment_create(s.solver, &raw const s.frames[0], s.ids.as_ptr(), usize::MAX, s.bodies.as_ptr(), 2, s.constraints.as_ptr(), 2, s.out()));
    case!(cases, "shx_attachment_create", "body_ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_attachment_create(s.solver, &raw const s.frames[0], s.ids.as_ptr(), 2, null(), 2, s.constraints.as_ptr(), 2, s.out()));
    case!(cases, "shx_attachment_create", "body_ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.bodies[0], s.stale_body]; shx_attachment_create(s.solver, &raw const s.frames[0], s.ids.as_ptr(), 2, ids.as_ptr(), 2, s.constraints.as_ptr(), 2, s.out()) });
    case!(cases, "shx_attachment_create", "body_count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_attachment_create(s.solver, &raw const s.frames[0], s.ids.as_ptr(), 2, s.bodies.as_ptr(), usize::MAX, s.constraints.as_ptr(), 2, s.out()));
    case!(cases, "shx_attachment_create", "constraint_ids", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_attachment_create(s.solver, &raw const s.frames[0], s.ids.as_ptr(), 2, s.bodies.as_ptr(), 2, null(), 2, s.out()));
    case!(cases, "shx_attachment_create", "constraint_ids", "stale", SHX_ERROR_INVALID_ID, |s| { let ids = [s.constraints[0], s.stale_constraint]; shx_attachment_create(s.solver, &raw const s.frames[0], s.ids.as_ptr(), 2, s.bodies.as_ptr(), 2, ids.as_ptr(), 2, s.out()) });
    case!(cases, "shx_attachment_create", "constraint_count", "huge", SHX_ERROR_INVALID_ARGUMENT, |s| shx_attachment_create(s.solver, &raw const s.frames[0], s.ids.as_ptr(), 2, s.bodies.as_ptr(), 2, s.constraints.as_ptr(), usize::MAX, s.out()));
    case!(cases, "shx_attachment_create", "out_attachment", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_attachment_create(s.solver, &raw const s.frames[0], s.ids.as_ptr(), 2, s.bodies.as_ptr(), 2, s.constraints.as_ptr(), 2, null_mut()));
    case!(cases, "shx_attachment_move", "attachment", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_attachment_move(null(), s.solver, &raw const s.frames[0], 0.1));
    case!(cases, "shx_attachment_move", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let attachment = attachment(s); let result = shx_attachment_move(attachment, null_mut(), &raw const s.frames[0], 0.1); shx_attachment_destroy(attachment); result });
    case!(cases, "shx_attachment_move", "attachment", "of another solver", SHX_ERROR_INVALID_ID, |s| { let attachment = attachment(s); let result = shx_attachment_move(attachment, s.other, &raw const s.frames[0], 0.1); shx_attachment_destroy(attachment); result });
    case!(cases, "shx_attachment_move", "pose", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let attachment = attachment(s); let result = shx_attachment_move(attachment, s.solver, null(), 0.1); shx_attachment_destroy(attachment); result });
    case!(cases, "shx_attachment_move", "pose", "not finite", SHX_ERROR_INVALID_ARGUMENT, |s| { let attachment = attachment(s); let pose = shx_frame { origin: [f64::NAN, 0.0, 0.0], ..s.frames[0] }; let result = shx_attachment_move(attachment, s.solver, &raw const pose, 0.1); shx_attachment_destroy(attachment); result });
    case!(cases, "shx_attachment_teleport", "attachment", "null", SHX_ERROR_NULL_ARGUMENT, |s| shx_attachment_teleport(null(), s.solver, &raw const s.frames[0]));
    case!(cases, "shx_attachment_teleport", "solver", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let attachment = attachment(s); let result = shx_attachment_teleport(attachment, null_mut(), &raw const s.frames[0]); shx_attachment_destroy(attachment); result });
    case!(cases, "shx_attachment_teleport", "attachment", "of another solver", SHX_ERROR_INVALID_ID, |s| { let attachment = attachment(s); let result = shx_attachment_teleport(attachment, s.other, &raw const s.frames[0]); shx_attachment_destroy(attachment); result });
    case!(cases, "shx_attachment_teleport", "pose", "null", SHX_ERROR_NULL_ARGUMENT, |s| { let attachment = attachment(s); let result = shx_attachment_teleport(attachment, s.solver, null()); shx_attachment_destroy(attachment); result });
    case!(cases, "shx_attachment_teleport", "pose", "not finite", SHX_ERROR_INVALID_ARGUMENT, |s| { let attachment = attachment(s); let pose = shx_frame { origin: [f64::NAN, 0.0, 0.0], ..s.frames[0] }; let result = shx_attachment_teleport(attachment, s.solver, &raw const pose); shx_attachment_destroy(attachment); result });
    case!(cases, "shx_attachment_move", "over_seconds", "-0.1", SHX_ERROR_INVALID_ARGUMENT, |s| { let attachment = attachment(s); let result = shx_attachment_move(attachment, s.solver, &raw const s.frames[0], -0.1); shx_attachment_destroy(attachment); result });
    case!(cases, "shx_attachment_move", "over_seconds", "f64::NAN", SHX_ERROR_INVALID_ARGUMENT, |s| { let attachment = attachment(s); let result = shx_attachment_move(attachment, s.solver, &raw const s.frames[0], f64::NAN); shx_attachment_destroy(attachment); result });
    case!(cases, "shx_attachment_move", "over_seconds", "f64::INFINITY", SHX_ERROR_INVALID_ARGUMENT, |s| { let attachment = attachment(s); let result = shx_attachment_move(attachment, s.solver, &raw const s.frames[0], f64::INFINITY); shx_attachment_destroy(attachment); result });
    case!(cases, "shx_attachment_destroy", "attachment", "null", SHX_OK, |s| { let _ = s; shx_attachment_destroy(null_mut()); SHX_OK });
}
