//! Numbers to bytes and back: little-endian, every length checked against the remaining bytes before allocation.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::error::{Error, Result};
use crate::math::frame::Frame;
use crate::math::rotation::PoseMove;
use crate::solver::id::{Identifier, Slot, SlotMap};

/// An error about an image.
pub fn bad(reason: impl Into<String>) -> Error {
    Error::Snapshot { reason: reason.into() }
}

/// An error in a part of an image.
pub fn of_part(part: &str, error: &Error) -> Error {
    bad(format!("{part}: {error}"))
}

/// The destination of numbers.
pub enum Sink {
    /// Into an image.
    Bytes(Vec<u8>),
    /// Nowhere: only counts bytes.
    Count(usize),
    /// Into a 64-bit hash: see [`fnv1a`].
    Hash(u64),
    /// Into a 128-bit hash, which identifies contents.
    Content(u128),
}

/// FNV-1a, 64 bits: the hash of nothing.
pub const FNV_START: u64 = 0xcbf2_9ce4_8422_2325;
const CONTENT_START: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;

/// FNV-1a, 64 bits, continued.
pub fn fnv1a(start: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(start, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// FNV-1a, 128 bits, continued.
fn fnv1a_128(start: u128, bytes: &[u8]) -> u128 {
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    bytes.iter().fold(start, |hash, byte| (hash ^ u128::from(*byte)).wrapping_mul(PRIME))
}

/// The hash of contents.
pub fn content_hash(bytes: &[u8]) -> u128 {
    fnv1a_128(CONTENT_START, bytes)
}

/// Writes numbers.
pub struct Writer {
    pub sink: Sink,
}

impl Writer {
    pub fn into(bytes: Vec<u8>) -> Self {
        Self { sink: Sink::Bytes(bytes) }
    }

    pub fn counting() -> Self {
        Self { sink: Sink::Count(0) }
    }

    pub fn hashing() -> Self {
        Self { sink: Sink::Hash(FNV_START) }
    }

    pub fn hashing_content() -> Self {
        Self { sink: Sink::Content(CONTENT_START) }
    }

    /// The number of bytes written, if they are kept or counted.
    pub fn size(&self) -> usize {
        match &self.sink {
            Sink::Bytes(bytes) => bytes.len(),
            Sink::Count(count) => *count,
            Sink::Hash(_) | Sink::Content(_) => 0,
        }
    }

    /// The bytes written.
    pub fn finished(self) -> Vec<u8> {
        match self.sink {
            Sink::Bytes(bytes) => bytes,
            _ => Vec::new(),
        }
    }

    /// The 64-bit hash.
    pub fn hash(&self) -> u64 {
        match self.sink {
            Sink::Hash(hash) => hash,
            _ => FNV_START,
        }
    }

    /// The 128-bit hash.
    pub fn content_hash(&self) -> u128 {
        match self.sink {
            Sink::Content(hash) => hash,
            _ => CONTENT_START,
        }
    }

    pub fn bytes(&mut self, bytes: &[u8]) {
        match &mut self.sink {
            Sink::Bytes(all) => all.extend_from_slice(bytes),
            Sink::Count(count) => *count += bytes.len(),
            Sink::Hash(hash) => *hash = fnv1a(*hash, bytes),
            Sink::Content(hash) => *hash = fnv1a_128(*hash, bytes),
        }
    }

    /// Adds to the count without making the bytes, if only their number is wanted; returns whether that is so.
    pub fn only_counts(&mut self, bytes: usize) -> bool {
        match &mut self.sink {
            Sink::Count(count) => {
                *count += bytes;
                true
            }
            _ => false,
        }
    }

    pub fn u32(&mut self, value: u32) {
        self.bytes(&value.to_le_bytes());
    }
    pub fn u64(&mut self, value: u64) {
        self.bytes(&value.to_le_bytes());
    }
    pub fn f64(&mut self, value: f64) {
        self.u64(value.to_bits());
    }
    pub fn vector(&mut self, v: Vector3<f64>) {
        v.iter().for_each(|x| self.f64(*x));
    }
    pub fn frame(&mut self, frame: &Frame) {
        self.vector(frame.origin);
        frame.rotation_xyzw().iter().for_each(|x| self.f64(*x));
    }
    pub fn rows(&mut self, rows: &[[f64; 3]]) {
        if self.only_counts(size_of_val(rows)) {
            return;
        }
        rows.iter().flatten().for_each(|x| self.f64(*x));
    }
    pub fn flag(&mut self, value: bool) {
        self.u32(u32::from(value));
    }
    pub fn vectors(&mut self, vectors: &[Vector3<f64>]) {
        if self.only_counts(size_of_val(vectors)) {
            return;
        }
        vectors.iter().for_each(|v| self.vector(*v));
    }

    /// A motion from pose to pose, and its elapsed seconds.
    pub fn pose_move(&mut self, pose_move: Option<&(PoseMove, f64)>) {
        self.flag(pose_move.is_some());
        if let Some((pose_move, elapsed)) = pose_move {
            self.frame(&pose_move.from);
            self.frame(&pose_move.to);
            self.vector(pose_move.velocity);
            self.vector(pose_move.angular_velocity);
            self.f64(pose_move.duration);
            self.f64(*elapsed);
        }
    }

    /// The identifiers of a type.
    pub fn slots<I>(&mut self, slots: &SlotMap<I>) {
        self.u32(u32::from(slots.mark));
        self.u64(slots.slots.len() as u64);
        for slot in &slots.slots {
            self.u32(slot.generation);
            self.u32(slot.highest);
            self.u32(slot.index.unwrap_or(u32::MAX));
        }
        self.u64(slots.free.len() as u64);
        slots.free.iter().for_each(|slot| self.u32(*slot));
    }
}

/// Reads numbers.
pub struct Reader<'a> {
    pub left: &'a [u8],
}

impl<'a> Reader<'a> {
    pub fn take<const COUNT: usize>(&mut self) -> Result<[u8; COUNT]> {
        let Some((head, tail)) = self.left.split_first_chunk::<COUNT>() else {
            return Err(bad("its body ends early"));
        };
        self.left = tail;
        Ok(*head)
    }
    pub fn u32(&mut self) -> Result<u32> {
        Ok(u32::from_le_bytes(self.take()?))
    }
    pub fn u64(&mut self) -> Result<u64> {
        Ok(u64::from_le_bytes(self.take()?))
    }
    pub fn f64(&mut self) -> Result<f64> {
        Ok(f64::from_bits(self.u64()?))
    }
    pub fn flag(&mut self) -> Result<bool> {
        match self.u32()? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(bad(format!("a flag is {other}"))),
        }
    }
    pub fn count(&mut self, bytes_each: usize) -> Result<usize> {
        let count = self.u64()?;
        if count > (self.left.len() / bytes_each) as u64 {
            return Err(bad(format!("it states {count} items where {} bytes are left", self.left.len())));
        }
        Ok(count as usize)
    }
    pub fn vector(&mut self) -> Result<Vector3<f64>> {
        Ok(Vector3::new(self.f64()?, self.f64()?, self.f64()?))
    }
    pub fn frame(&mut self) -> Result<Frame> {
        let origin = self.vector()?;
        let (x, y, z, w) = (self.f64()?, self.f64()?, self.f64()?, self.f64()?);
        // Kept to the bit: normalising again would change it.
        Ok(Frame { origin, rotation: UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z)) })
    }
    pub fn rows(&mut self, count: usize) -> Result<Vec<[f64; 3]>> {
        (0..count).map(|_| Ok([self.f64()?, self.f64()?, self.f64()?])).collect()
    }
    /// The next `count` bytes.
    pub fn bytes(&mut self, count: usize) -> Result<&'a [u8]> {
        let Some((head, tail)) = self.left.split_at_checked(count) else {
            return Err(bad("its body ends early"));
        };
        self.left = tail;
        Ok(head)
    }
    /// A number that must be finite.
    pub fn finite(&mut self, what: &str) -> Result<f64> {
        let value = self.f64()?;
        if value.is_finite() { Ok(value) } else { Err(bad(format!("{what} is {value}"))) }
    }
    pub fn finite_vector(&mut self, what: &str) -> Result<Vector3<f64>> {
        Ok(Vector3::new(self.finite(what)?, self.finite(what)?, self.finite(what)?))
    }
    pub fn finite_frame(&mut self, what: &str) -> Result<Frame> {
        let frame = self.frame()?;
        let unit = (frame.rotation.quaternion().norm() - 1.0).abs() <= 1e-9;
        if unit && frame.origin.iter().all(|x| x.is_finite()) { Ok(frame) } else { Err(bad(format!("{what} is not a pose"))) }
    }

    /// A motion from pose to pose, and its elapsed seconds.
    pub fn pose_move(&mut self) -> Result<Option<(PoseMove, f64)>> {
        if !self.flag()? {
            return Ok(None);
        }
        let pose_move = PoseMove {
            from: self.frame()?,
            to: self.frame()?,
            velocity: self.vector()?,
            angular_velocity: self.vector()?,
            duration: self.f64()?,
        };
        Ok(Some((pose_move, self.f64()?)))
    }

    /// [`Reader::pose_move`] with finite numbers only.
    pub fn finite_pose_move(&mut self, what: &str) -> Result<Option<(PoseMove, f64)>> {
        if !self.flag()? {
            return Ok(None);
        }
        let pose_move = PoseMove {
            from: self.finite_frame(what)?,
            to: self.finite_frame(what)?,
            velocity: self.finite_vector(what)?,
            angular_velocity: self.finite_vector(what)?,
            duration: self.finite(what)?,
        };
        let elapsed = self.finite(what)?;
        if pose_move.duration < 0.0 || elapsed < 0.0 {
            return Err(bad(format!("{what} takes {} s, of which {elapsed} are done", pose_move.duration)));
        }
        Ok(Some((pose_move, elapsed)))
    }

    /// The identifiers of a type.
    pub fn slots<I: Identifier>(&mut self) -> Result<SlotMap<I>> {
        let mark = self.u32()? as u16;
        let slot_count = self.count(12)?;
        let mut slots = SlotMap::new(mark);
        for _ in 0..slot_count {
            let (generation, highest, index) = (self.u32()?, self.u32()?, self.u32()?);
            slots.slots.push(Slot { generation, highest, index: (index != u32::MAX).then_some(index) });
        }
        let free_count = self.count(4)?;
        for _ in 0..free_count {
            let slot = self.u32()?;
            if slots.slots.get(slot as usize).is_none_or(|free| free.index.is_some()) {
                return Err(bad(format!("slot {slot} is marked free")));
            }
            slots.free.push(slot);
        }
        Ok(slots)
    }

    /// The identifier of the thing at `index`, from its slots.
    pub fn id<I: Identifier>(&mut self, what: &str, slots: &SlotMap<I>, index: usize) -> Result<I> {
        let id = I::from_bits(self.u64()?);
        if slots.index(id) == Some(index) { Ok(id) } else { Err(bad(format!("{what} {index} and its identifier disagree"))) }
    }
}
