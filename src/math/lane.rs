//! The number type that kernels are written over: one `f64`, or several strands side by side in a vector register.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A number, or a pack of numbers that all go through the same operations. No fused multiply-add is used anywhere, so that every
/// width gives the same bits.
pub trait Lane:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// A truth value a lane.
    type Mask: Copy;

    /// The same value in every lane.
    fn splat(value: f64) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Nearest whole number.
    fn round(self) -> Self;
    /// Largest whole number not above.
    fn floor(self) -> Self;
    /// Lanes in which `self < other`.
    fn less(self, other: Self) -> Self::Mask;
    /// Lane by lane: `yes` where the mask holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Whether the mask holds in any lane.
    fn any(mask: Self::Mask) -> bool;
    /// Whether the mask holds in all lanes.
    fn all(mask: Self::Mask) -> bool;
    /// How many lanes there are.
    const LANES: usize;
    /// One lane.
    fn lane(self, index: usize) -> f64;
    /// Changes one lane.
    fn set_lane(&mut self, index: usize, value: f64);
    /// Whether the mask holds in lane `index`.
    fn mask_lane(mask: Self::Mask, index: usize) -> bool;
    /// Lanes in which both masks hold.
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// The same truth in every lane.
    fn splat_mask(value: bool) -> Self::Mask;
    /// Lane by lane the larger of the two; `self` where `other` is not a number.
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Self::select(self.less(other), other, self)
    }
    /// Lane by lane the smaller of the two; `self` where `other` is not a number.
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        Self::select(other.less(self), other, self)
    }
    /// Zero in every lane.
    fn zero() -> Self {
        Self::splat(0.0)
    }
    /// One in every lane.
    fn one() -> Self {
        Self::splat(1.0)
    }
}

impl Lane for f64 {
    type Mask = bool;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn round(self) -> Self {
        // Adding and taking away 1.5·2⁵² rounds to the nearest whole number in the default rounding mode, without a library call.
        const SHIFT: f64 = 6_755_399_441_055_744.0;
        (self + SHIFT) - SHIFT
    }
    #[inline(always)]
    fn floor(self) -> Self {
        let nearest = Lane::round(self);
        if nearest > self { nearest - 1.0 } else { nearest }
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn all(mask: bool) -> bool {
        mask
    }
    const LANES: usize = 1;
    #[inline(always)]
    fn lane(self, _index: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn set_lane(&mut self, _index: usize, value: f64) {
        *self = value;
    }
    #[inline(always)]
    fn mask_lane(mask: bool, _index: usize) -> bool {
        mask
    }
    #[inline(always)]
    fn both(a: bool, b: bool) -> bool {
        a && b
    }
    #[inline(always)]
    fn splat_mask(value: bool) -> bool {
        value
    }
}
