//! The caller's memory: arrays, strided inputs and outputs, checked completely before anything is read or written.

use std::ffi::c_void;

use super::types::{
    MAX_COUNT, SHX_FORMAT_F32X3, SHX_FORMAT_F32X4, SHX_FORMAT_F64X3, SHX_FORMAT_F64X4, SHX_FORMAT_FRAME, shx_body_id,
    shx_constraint_id, shx_frame, shx_input, shx_output, shx_strand_id,
};
use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::memory;
use crate::solver::id::{BodyId, ConstraintId, StrandId};

/// Checks a count and a pointer to packed items.
pub(crate) fn check_array<T>(argument: &str, count_argument: &str, data: *const T, count: usize) -> Result<()> {
    if count > MAX_COUNT || count.checked_mul(size_of::<T>()).is_none_or(|bytes| bytes > isize::MAX as usize) {
        return Err(Error::invalid(count_argument, count, format!("a count up to {MAX_COUNT}")));
    }
    if count > 0 && data.is_null() {
        return Err(Error::NullArgument { argument: argument.into() });
    }
    if !data.is_aligned() {
        return Err(Error::invalid(
            argument,
            format!("the address {data:p}"),
            format!("one that is aligned to {} bytes", align_of::<T>()),
        ));
    }
    Ok(())
}

/// The caller's packed array.
///
/// # Safety
/// `data` is null or points to `count` items that stay unchanged during the call.
pub(crate) unsafe fn array<'a, T>(argument: &str, count_argument: &str, data: *const T, count: usize) -> Result<&'a [T]> {
    check_array(argument, count_argument, data, count)?;
    if count == 0 {
        return Ok(&[]);
    }
    // SAFETY: not null, aligned, of a possible size, and the caller guarantees that the items are there.
    Ok(unsafe { std::slice::from_raw_parts(data, count) })
}

/// The caller's frame.
///
/// # Safety
/// `frame` is null or points to a frame.
pub(crate) unsafe fn frame_from(argument: &str, frame: *const shx_frame) -> Result<Frame> {
    // SAFETY: the same.
    unsafe { &array(argument, argument, frame, 1)?[0] }.checked(argument)
}

/// The caller's ids.
///
/// # Safety
/// As [`array`].
pub(crate) unsafe fn strand_ids(ids: *const shx_strand_id, count: usize) -> Result<Vec<StrandId>> {
    // SAFETY: the same.
    let ids = unsafe { array("ids", "count", ids, count)? };
    memory::collected(ids.iter().map(|id| StrandId::from_bits(id.bits)))
}

/// The caller's ids.
///
/// # Safety
/// As [`array`].
pub(crate) unsafe fn body_ids(ids: *const shx_body_id, count: usize) -> Result<Vec<BodyId>> {
    // SAFETY: the same.
    let ids = unsafe { array("ids", "count", ids, count)? };
    memory::collected(ids.iter().map(|id| BodyId::from_bits(id.bits)))
}

/// The caller's ids.
///
/// # Safety
/// As [`array`].
pub(crate) unsafe fn constraint_ids(ids: *const shx_constraint_id, count: usize) -> Result<Vec<ConstraintId>> {
    // SAFETY: the same.
    let ids = unsafe { array("ids", "count", ids, count)? };
    memory::collected(ids.iter().map(|id| ConstraintId::from_bits(id.bits)))
}

/// One frame for each of the caller's `count` ids.
///
/// # Safety
/// `frames` is null or a shx_input whose memory is there.
pub(crate) unsafe fn frames_of(frames: *const shx_input, count: usize) -> Result<Vec<Frame>> {
    // SAFETY: the same.
    let reader = unsafe { frames_reader(frames, count)? };
    let mut frames = memory::list(count)?;
    for index in 0..count {
        frames.push(reader.frame("frames", index)?);
    }
    Ok(frames)
}

/// A reader of one frame for each of the caller's `count` ids.
///
/// # Safety
/// `frames` is null or a shx_input whose memory is there as long as the reader.
pub(crate) unsafe fn frames_reader(frames: *const shx_input, count: usize) -> Result<Reader> {
    // SAFETY: the same.
    let reader = unsafe { Reader::new("frames", frames, &[SHX_FORMAT_FRAME])? };
    if reader.count() != count {
        return Err(Error::invalid("frames.count", reader.count(), format!("{count}, one for each id")));
    }
    Ok(reader)
}

/// A property of each of the caller's ids; an error names the id.
pub(crate) fn each<I: Copy, T>(ids: &[I], item: impl Fn(I) -> Result<T>) -> Result<Vec<T>> {
    let mut items = memory::list(ids.len())?;
    for index in 0..ids.len() {
        items.push(of_one(ids, index, &item)?);
    }
    Ok(items)
}

/// The same for one of them.
pub(crate) fn of_one<I: Copy, T>(ids: &[I], index: usize, item: &impl Fn(I) -> Result<T>) -> Result<T> {
    item(ids[index]).map_err(|error| match error {
        Error::InvalidId { bits, .. } => Error::InvalidId { argument: format!("ids[{index}]"), bits },
        other => other,
    })
}

/// The destination of one value: checked at once, written on success.
pub(crate) struct OutputValue<T>(*mut T);

impl<T> OutputValue<T> {
    /// # Safety
    /// `pointer` is null or points to room for a T until `write`.
    pub(crate) unsafe fn new(argument: &str, pointer: *mut T) -> Result<Self> {
        if pointer.is_null() {
            return Err(Error::NullArgument { argument: argument.into() });
        }
        check_array(argument, argument, pointer.cast_const(), 1)?;
        Ok(Self(pointer))
    }

    pub(crate) fn write(self, value: T) {
        // SAFETY: `new` was promised room; it is not null and aligned. What was there is plain data or nothing.
        unsafe { self.0.write(value) };
    }
}

/// The destination of a list of values.
pub(crate) struct OutputList<T> {
    argument: &'static str,
    pointer: *mut T,
    capacity: usize,
    /// The name of the values in errors.
    unit: &'static str,
}

impl OutputList<u8> {
    /// The destination of an image, or `None` for a null pointer and capacity 0: the host asks for the size.
    ///
    /// # Safety
    /// `pointer` is null or points to room for `capacity` bytes until `write`.
    pub(crate) unsafe fn image(argument: &'static str, pointer: *mut c_void, capacity: usize) -> Result<Option<Self>> {
        if pointer.is_null() && capacity == 0 {
            return Ok(None);
        }
        // SAFETY: the same.
        let places = unsafe { Self::new(argument, "capacity", pointer.cast(), capacity)? };
        Ok(Some(Self { unit: "bytes", ..places }))
    }
}

impl<T: Copy> OutputList<T> {
    /// # Safety
    /// `pointer` is null or points to room for `capacity` items until `write`.
    pub(crate) unsafe fn new(argument: &'static str, count_argument: &str, pointer: *mut T, capacity: usize) -> Result<Self> {
        check_array(argument, count_argument, pointer.cast_const(), capacity)?;
        Ok(Self { argument, pointer, capacity, unit: "items" })
    }

    /// [`OutputList::new`], or `None` for a null pointer: the host does not want these.
    ///
    /// # Safety
    /// As [`OutputList::new`].
    pub(crate) unsafe fn optional(
        argument: &'static str,
        count_argument: &str,
        pointer: *mut T,
        capacity: usize,
    ) -> Result<Option<Self>> {
        if pointer.is_null() {
            return Ok(None);
        }
        // SAFETY: the same.
        unsafe { Self::new(argument, count_argument, pointer, capacity).map(Some) }
    }

    pub(crate) fn check_room(&self, needed: usize) -> Result<()> {
        if needed > self.capacity {
            let Self { argument, capacity, unit, .. } = *self;
            return Err(Error::BufferTooSmall { argument: argument.into(), capacity, needed, unit });
        }
        Ok(())
    }

    /// Writes an iterator's values directly.
    pub(crate) fn write_all(self, values: impl ExactSizeIterator<Item = T>) -> Result<()> {
        self.check_room(values.len())?;
        for (index, value) in values.enumerate().take(self.capacity) {
            // SAFETY: `new` was promised room for `capacity` items.
            unsafe { self.pointer.add(index).write(value) };
        }
        Ok(())
    }

    pub(crate) fn write(self, values: &[T]) -> Result<()> {
        self.check_room(values.len())?;
        if !values.is_empty() {
            // SAFETY: `new` was promised room for `capacity` items, and there are no more than that.
            unsafe { std::ptr::copy_nonoverlapping(values.as_ptr(), self.pointer, values.len()) };
        }
        Ok(())
    }
}

/// The destination of plain items, a stride apart; bytes between them stay untouched.
pub(crate) struct Strided<T> {
    argument: &'static str,
    pointer: *mut T,
    stride: usize,
    capacity: usize,
}

impl<T: Copy> Strided<T> {
    /// `stride` 0: packed.
    ///
    /// # Safety
    /// `pointer` is null or points to room for `capacity` items, `stride` bytes apart, until `write`.
    pub(crate) unsafe fn new(
        argument: &'static str,
        count_argument: &str,
        pointer: *mut T,
        stride: usize,
        capacity: usize,
    ) -> Result<Self> {
        let size = size_of::<T>();
        if stride != 0 && stride < size {
            return Err(Error::invalid("stride", stride, format!("0 (packed) or at least {size} bytes")));
        }
        let stride = if stride == 0 { size } else { stride };
        if capacity > MAX_COUNT {
            return Err(Error::invalid(count_argument, capacity, format!("a count up to {MAX_COUNT}")));
        }
        if capacity.checked_mul(stride).is_none_or(|bytes| bytes > isize::MAX as usize) {
            return Err(Error::invalid("stride", stride, "a stride whose items fit into memory"));
        }
        if capacity > 0 && pointer.is_null() {
            return Err(Error::NullArgument { argument: argument.into() });
        }
        Ok(Self { argument, pointer, stride, capacity })
    }

    pub(crate) fn write_all(self, values: impl ExactSizeIterator<Item = T>) -> Result<()> {
        if values.len() > self.capacity {
            let Self { argument, capacity, .. } = self;
            return Err(Error::BufferTooSmall { argument: argument.into(), capacity, needed: values.len(), unit: "items" });
        }
        for (index, value) in values.enumerate().take(self.capacity) {
            // SAFETY: `new` was promised room for `capacity` items, and there are no more than that. Any alignment.
            unsafe { self.pointer.wrapping_byte_add(index * self.stride).write_unaligned(value) };
        }
        Ok(())
    }
}

fn format_size(format: u32) -> Option<usize> {
    Some(match format {
        SHX_FORMAT_F32X3 => 12,
        SHX_FORMAT_F32X4 => 16,
        SHX_FORMAT_F64X3 => 24,
        SHX_FORMAT_F64X4 => 32,
        SHX_FORMAT_FRAME => size_of::<shx_frame>(),
        _ => return None,
    })
}

fn format_name(format: u32) -> &'static str {
    match format {
        SHX_FORMAT_F32X3 => "SHX_FORMAT_F32X3",
        SHX_FORMAT_F32X4 => "SHX_FORMAT_F32X4",
        SHX_FORMAT_F64X3 => "SHX_FORMAT_F64X3",
        SHX_FORMAT_F64X4 => "SHX_FORMAT_F64X4",
        SHX_FORMAT_FRAME => "SHX_FORMAT_FRAME",
        _ => "unknown",
    }
}

/// The common checks of inputs and outputs; returns the stride in bytes.
fn check_view(
    argument: &str,
    data: *const c_void,
    stride: usize,
    count: usize,
    format: u32,
    reserved: u32,
    allowed: &[u32],
) -> Result<usize> {
    let Some(size) = format_size(format).filter(|_| allowed.contains(&format)) else {
        let names: Vec<_> = allowed.iter().map(|format| format_name(*format)).collect();
        return Err(Error::invalid(format!("{argument}.format"), format, names.join(", ")));
    };
    if reserved != 0 {
        return Err(Error::invalid(format!("{argument}.reserved"), reserved, "0"));
    }
    if stride != 0 && stride < size {
        return Err(Error::invalid(format!("{argument}.stride"), stride, format!("0 (packed) or at least {size} bytes")));
    }
    let stride = if stride == 0 { size } else { stride };
    if count > MAX_COUNT {
        return Err(Error::invalid(format!("{argument}.count"), count, format!("a count up to {MAX_COUNT}")));
    }
    if count.checked_mul(stride).is_none_or(|bytes| bytes > isize::MAX as usize) {
        return Err(Error::invalid(format!("{argument}.stride"), stride, "a stride whose items fit into memory"));
    }
    if count > 0 && data.is_null() {
        return Err(Error::NullArgument { argument: format!("{argument}.data") });
    }
    Ok(stride)
}

/// A checked strided input.
pub(crate) struct Reader {
    data: *const u8,
    stride: usize,
    count: usize,
    format: u32,
}

impl Reader {
    /// # Safety
    /// `input` is null or points to a shx_input whose memory is there while this lives.
    pub(crate) unsafe fn new(argument: &str, input: *const shx_input, allowed: &[u32]) -> Result<Self> {
        // SAFETY: null or a shx_input.
        let input = unsafe { array(argument, argument, input, 1)? }[0];
        let stride = check_view(argument, input.data, input.stride, input.count, input.format, input.reserved, allowed)?;
        Ok(Self { data: input.data.cast(), stride, count: input.count, format: input.format })
    }

    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// The number at `position` of the item at `index`.
    fn number(&self, index: usize, position: usize) -> f64 {
        assert!(index < self.count);
        // SAFETY: inside the memory that `new` was promised; the callers below stay inside the format's size.
        unsafe {
            let item = self.data.add(index * self.stride);
            match self.format {
                SHX_FORMAT_F32X3 | SHX_FORMAT_F32X4 => f64::from(item.cast::<f32>().add(position).read_unaligned()),
                _ => item.cast::<f64>().add(position).read_unaligned(),
            }
        }
    }

    /// The first three numbers of an item.
    pub(crate) fn point(&self, index: usize) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.number(index, axis))
    }

    /// The rotation of an item of any format of frames.
    pub(crate) fn rotation(&self, argument: &str, index: usize) -> Result<nalgebra::UnitQuaternion<f64>> {
        let first = if self.format == SHX_FORMAT_FRAME { 3 } else { 0 };
        let rotation = [0, 1, 2, 3].map(|position| self.number(index, first + position));
        Ok(Frame::from_arrays(format_args!("{argument}[{index}]"), [0.0; 3], rotation)?.rotation)
    }

    /// An item of SHX_FORMAT_FRAME.
    pub(crate) fn frame(&self, argument: &str, index: usize) -> Result<Frame> {
        assert_eq!(self.format, SHX_FORMAT_FRAME);
        let rotation = [3, 4, 5, 6].map(|position| self.number(index, position));
        Frame::from_arrays(format_args!("{argument}[{index}]"), self.point(index), rotation)
    }
}

/// Formats of points with or without the radius.
pub(crate) const POINT_FORMATS: &[u32] = &[SHX_FORMAT_F32X3, SHX_FORMAT_F32X4, SHX_FORMAT_F64X3, SHX_FORMAT_F64X4];
/// Formats of vectors.
pub(crate) const VECTOR_FORMATS: &[u32] = &[SHX_FORMAT_F32X3, SHX_FORMAT_F64X3];
/// Formats of places: points, or frames, whose origin counts.
pub(crate) const PLACE_FORMATS: &[u32] =
    &[SHX_FORMAT_F32X3, SHX_FORMAT_F32X4, SHX_FORMAT_F64X3, SHX_FORMAT_F64X4, SHX_FORMAT_FRAME];
/// Formats of frames: whole, or the quaternion alone.
pub(crate) const FRAME_FORMATS: &[u32] = &[SHX_FORMAT_FRAME, SHX_FORMAT_F32X4, SHX_FORMAT_F64X4];

/// Formats of frames along strands: whole, the quaternion alone, or the tangent n0 alone.
pub(crate) const SAMPLED_FRAME_FORMATS: &[u32] =
    &[SHX_FORMAT_FRAME, SHX_FORMAT_F32X4, SHX_FORMAT_F64X4, SHX_FORMAT_F32X3, SHX_FORMAT_F64X3];

/// The axis n0 of a frame with the quaternion x, y, z, w: of unit length, though that of the quaternion is rounded.
#[inline(always)]
pub(crate) fn tangent([x, y, z, w]: [f64; 4]) -> [f64; 3] {
    let (along, across) = (w * w + x * x, y * y + z * z);
    [along - across, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)].map(|number| number / (along + across))
}

/// A checked strided output with room for everything to be written.
pub(crate) struct Writer {
    data: *mut u8,
    stride: usize,
    needed: usize,
    format: u32,
}

impl Writer {
    /// `None` if `output` is null: the host does not want these.
    ///
    /// # Safety
    /// `output` is null or points to a shx_output whose memory is there, and is the caller's, while this lives.
    pub(crate) unsafe fn optional(
        argument: &str,
        output: *const shx_output,
        allowed: &[u32],
        needed: usize,
    ) -> Result<Option<Self>> {
        if output.is_null() {
            return Ok(None);
        }
        // SAFETY: not null, so a shx_output.
        let output = unsafe { array(argument, argument, output, 1)? }[0];
        let stride = check_view(argument, output.data, output.stride, output.count, output.format, output.reserved, allowed)?;
        if needed > output.count {
            return Err(Error::BufferTooSmall { argument: argument.into(), capacity: output.count, needed, unit: "items" });
        }
        Ok(Some(Self { data: output.data.cast(), stride, needed, format: output.format }))
    }

    /// [`Writer::optional`] for a required output.
    ///
    /// # Safety
    /// The same.
    pub(crate) unsafe fn required(argument: &str, output: *const shx_output, allowed: &[u32], needed: usize) -> Result<Self> {
        // SAFETY: the same.
        unsafe { Self::optional(argument, output, allowed, needed)? }
            .ok_or_else(|| Error::NullArgument { argument: argument.into() })
    }

    /// Writes the leading numbers of a list; a format of three numbers leaves the fourth out.
    fn numbers(&self, index: usize, numbers: &[f64]) {
        assert!(index < self.needed);
        for (position, number) in numbers[..self.width()].iter().enumerate() {
            // SAFETY: index < needed <= count of the memory that `optional` was promised, position inside the format's size.
            unsafe {
                let item = self.data.add(index * self.stride);
                match self.format {
                    SHX_FORMAT_F32X3 | SHX_FORMAT_F32X4 => item.cast::<f32>().add(position).write_unaligned(*number as f32),
                    _ => item.cast::<f64>().add(position).write_unaligned(*number),
                }
            }
        }
    }

    /// A vector (three numbers).
    pub(crate) fn vector(&self, index: usize, vector: [f64; 3]) {
        self.numbers(index, &vector);
    }

    /// A point, with its radius where the format has a place for it.
    pub(crate) fn point(&self, index: usize, point: [f64; 3], radius: f64) {
        self.numbers(index, &[point[0], point[1], point[2], radius]);
    }

    /// A frame; its quaternion alone where the format has four numbers, its tangent alone where it has three.
    pub(crate) fn frame(&self, index: usize, frame: &Frame) {
        self.pose(index, frame.origin.into(), frame.rotation_xyzw());
    }

    /// The same for an origin and a quaternion x, y, z, w.
    pub(crate) fn pose(&self, index: usize, origin: [f64; 3], rotation: [f64; 4]) {
        match self.width() {
            3 => self.numbers(index, &tangent(rotation)),
            4 => self.numbers(index, &rotation),
            _ => {
                let ([x, y, z], [i, j, k, w]) = (origin, rotation);
                self.numbers(index, &[x, y, z, i, j, k, w]);
            }
        }
    }

    /// Whether items are floats.
    pub(crate) fn is_single(&self) -> bool {
        matches!(self.format, SHX_FORMAT_F32X3 | SHX_FORMAT_F32X4)
    }

    /// Numbers of an item.
    pub(crate) fn width(&self) -> usize {
        match self.format {
            SHX_FORMAT_F32X3 | SHX_FORMAT_F64X3 => 3,
            SHX_FORMAT_F32X4 | SHX_FORMAT_F64X4 => 4,
            _ => 7,
        }
    }

    /// Writes `count` items of `WIDTH` floats from `first` on: `item(k)` is the kth of them. Fast for many items.
    #[inline(always)]
    pub(crate) fn singles<const WIDTH: usize>(&self, first: usize, count: usize, item: impl Fn(usize) -> [f32; WIDTH]) {
        assert!(self.is_single() && self.width() == WIDTH);
        self.items(first, count, item);
    }

    /// The same for doubles.
    #[inline(always)]
    pub(crate) fn doubles<const WIDTH: usize>(&self, first: usize, count: usize, item: impl Fn(usize) -> [f64; WIDTH]) {
        assert!(!self.is_single() && self.width() == WIDTH);
        self.items(first, count, item);
    }

    #[inline(always)]
    fn items<T>(&self, first: usize, count: usize, item: impl Fn(usize) -> T) {
        assert!(first <= self.needed && count <= self.needed - first);
        // SAFETY: first <= needed <= count of the memory that `optional` was promised.
        let mut place = unsafe { self.data.add(first * self.stride) };
        for k in 0..count {
            // SAFETY: item first + k of the same memory, and T is as large as the format says.
            unsafe { place.cast::<T>().write_unaligned(item(k)) };
            place = place.wrapping_add(self.stride);
        }
    }
}
