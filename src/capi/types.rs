//! Plain data that crosses the border. Layouts are frozen: sizes and offsets are asserted here, in `tests/capi/layout.rs` and in
//! `tests/c/layout.c`.

use std::ffi::c_void;
use std::mem::{offset_of, size_of};

/// Names a strand of one solver: a slot and a generation. Zero bits is the null id. The id of a removed strand never names
/// another one.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct shx_strand_id {
    /// For comparing, hashing and storing; the value means nothing else.
    pub bits: u64,
}

/// Names a body of one solver, as shx_strand_id names a strand; never the same bits as a strand's or a constraint's.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct shx_body_id {
    /// For comparing, hashing and storing; the value means nothing else.
    pub bits: u64,
}

/// Names a constraint of one solver, as shx_strand_id names a strand; never the same bits as a strand's or a body's.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct shx_constraint_id {
    /// For comparing, hashing and storing; the value means nothing else.
    pub bits: u64,
}

/// A right-handed pose in the world: where a root or a cross-section sits and how it is turned.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct shx_frame {
    /// Position, m.
    pub origin: [f64; 3],
    /// Unit quaternion x, y, z, w (length 1 within 1e-5). It turns the axes into n0, n1, n2: n0 is the strand's tangent, n1 and
    /// n2 are the axes of its section.
    pub rotation: [f64; 4],
}

/// Items that the library reads from the caller's memory during a call.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_input {
    /// The first item. Any alignment. May be null when count is 0.
    pub data: *const c_void,
    /// Bytes from one item to the next; 0: packed. At least the size of an item.
    pub stride: usize,
    /// How many items there are.
    pub count: usize,
    /// What an item is: SHX_FORMAT_.
    pub format: u32,
    /// 0.
    pub reserved: u32,
}

/// Room for items that the library writes into the caller's memory during a call. Bytes between items are left alone.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_output {
    /// The first item. Any alignment.
    pub data: *mut c_void,
    /// Bytes from one item to the next; 0: packed. At least the size of an item.
    pub stride: usize,
    /// How many items there is room for; fewer than needed is SHX_ERROR_BUFFER_TOO_SMALL.
    pub count: usize,
    /// What an item is: SHX_FORMAT_.
    pub format: u32,
    /// 0.
    pub reserved: u32,
}

/// Three floats: x, y, z.
pub const SHX_FORMAT_F32X3: u32 = 1;
/// Four floats: x, y, z and the strand's radius (points; the curve vertex of Embree and Cycles), or a quaternion x, y, z, w (frames).
pub const SHX_FORMAT_F32X4: u32 = 2;
/// Three doubles: x, y, z.
pub const SHX_FORMAT_F64X3: u32 = 3;
/// Four doubles, as SHX_FORMAT_F32X4.
pub const SHX_FORMAT_F64X4: u32 = 4;
/// A shx_frame.
pub const SHX_FORMAT_FRAME: u32 = 5;

/// The largest count of items or strands that a call takes; above it the number is taken for a mistake.
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
