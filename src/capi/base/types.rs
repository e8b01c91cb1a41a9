//! Plain data that crosses the border. Layouts are frozen: sizes and offsets are asserted here, in `tests/capi/layout.rs` and in
//! `tests/c/layout.c`.

use std::ffi::c_void;
use std::mem::{offset_of, size_of};

use crate::error::Result;
use crate::math::frame::Frame;

/// Names a strand of one solver. Zero bits is the null id. The
/// id of a removed strand never names another strand.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct shx_strand_id {
    /// Compare, hash or store it; the value has no other meaning.
    pub bits: u64,
}

/// Names a body of one solver, as shx_strand_id names a strand. It
/// never has the same bits as a strand or a constraint.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct shx_body_id {
    /// Compare, hash or store it; the value has no other meaning.
    pub bits: u64,
}

/// Names a constraint of one solver, as shx_strand_id names a strand.
/// It never has the same bits as a strand or a body.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct shx_constraint_id {
    /// Compare, hash or store it; the value has no other meaning.
    pub bits: u64,
}

/// A right-handed frame in world space: position and orientation of a root, a cross-section or a body.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct shx_frame {
    /// Position, m.
    pub origin: [f64; 3],
    /// Unit quaternion x, y, z, w; its length may differ from 1 by up to 1e-5. It rotates the coordinate axes
    /// into n0, n1, n2: n0 is the tangent of the strand, n1 and n2 are the axes of its cross-section.
    pub rotation: [f64; 4],
}

impl shx_frame {
    /// The frame, checked; `argument` names it in errors.
    pub(crate) fn checked(&self, argument: &str) -> Result<Frame> {
        Frame::from_arrays(argument, self.origin, self.rotation)
    }
}

#[doc(hidden)]
impl From<&Frame> for shx_frame {
    fn from(frame: &Frame) -> Self {
        Self { origin: frame.origin.into(), rotation: frame.rotation_xyzw() }
    }
}

/// An array in your memory that the library reads during a call.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_input {
    /// First item, any alignment. May be null if count is 0.
    pub data: *const c_void,
    /// Bytes from one item to the next, at least the size of an item. 0: tightly packed.
    pub stride: usize,
    /// Number of items.
    pub count: usize,
    /// Format of an item: SHX_FORMAT_.
    pub format: u32,
    /// Must be 0.
    pub reserved: u32,
}

/// An array in your memory that the library writes during a call. Bytes between items are left unchanged.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_output {
    /// First item, any alignment.
    pub data: *mut c_void,
    /// Bytes from one item to the next, at least the size of an item. 0: tightly packed.
    pub stride: usize,
    /// Number of items that fit. If more are needed, the call fails with SHX_ERROR_BUFFER_TOO_SMALL.
    pub count: usize,
    /// Format of an item: SHX_FORMAT_.
    pub format: u32,
    /// Must be 0.
    pub reserved: u32,
}

/// Three floats: x, y, z.
pub const SHX_FORMAT_F32X3: u32 = 1;
/// Four floats. Points: x, y, z and the radius of the strand, as Embree and Cycles
/// take curve vertices. Frames: a quaternion x, y, z, w.
pub const SHX_FORMAT_F32X4: u32 = 2;
/// Three doubles: x, y, z.
pub const SHX_FORMAT_F64X3: u32 = 3;
/// Four doubles, as SHX_FORMAT_F32X4.
pub const SHX_FORMAT_F64X4: u32 = 4;
/// A shx_frame.
pub const SHX_FORMAT_FRAME: u32 = 5;

/// The largest count of items or strands that a call takes; a larger number counts as a mistake.
pub(crate) const MAX_COUNT: usize = u32::MAX as usize;

const _: () = {
    assert!(size_of::<shx_strand_id>() == 8 && size_of::<shx_body_id>() == 8 && size_of::<shx_constraint_id>() == 8);
    assert!(size_of::<shx_frame>() == 56 && offset_of!(shx_frame, rotation) == 24);
};

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_input>() == 32 && offset_of!(shx_input, stride) == 8 && offset_of!(shx_input, count) == 16);
    assert!(offset_of!(shx_input, format) == 24 && offset_of!(shx_input, reserved) == 28);
    assert!(size_of::<shx_output>() == 32 && offset_of!(shx_output, stride) == 8 && offset_of!(shx_output, count) == 16);
    assert!(offset_of!(shx_output, format) == 24 && offset_of!(shx_output, reserved) == 28);
};
