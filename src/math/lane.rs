//! The number type of the kernels: one `f64`, or one number per strand, side by side in a vector register.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A number, or a pack of numbers that go through the same operations. No fused multiply-add is used anywhere, so every width
/// gives the same bits.
pub trait Lane:
    Copy
    + std::fmt::Debug
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// A truth value per lane.
    type Mask: Copy;

    /// How many lanes there are; at most [`MAX_LANES`].
    const LANES: usize;
    /// The precision of a lane.
    const PRECISION: Precision;

    /// The same value in every lane, rounded to the lane's precision.
    fn splat(value: f64) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Lanes in which `self < other`.
    fn less(self, other: Self) -> Self::Mask;
    /// Lane by lane: `yes` where the mask holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// The mask's truth values as bits, lane 0 lowest.
    fn bits(mask: Self::Mask) -> u32;
    /// Lanes in which both masks hold.
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// The same truth in every lane.
    fn splat_mask(value: bool) -> Self::Mask;
    /// One lane.
    fn lane(&self, index: usize) -> f64;
    /// Changes one lane; the value is rounded to the lane's precision.
    fn set_lane(&mut self, index: usize, value: f64);
    /// Runs a kernel as a function of its own, compiled for this type's instructions.
    fn call<K: Kernel>(kernel: K) -> K::Output;

    /// Nearest whole number; |self| below 2⁵¹ (f32: 2²²).
    #[inline(always)]
    fn round(self) -> Self {
        // Adding and subtracting 1.5·2⁵² rounds to the nearest whole number in the default rounding mode.
        let shift = Self::splat(Self::PRECISION.constants().round_shift);
        (self + shift) - shift
    }
    /// Largest whole number not above `self`; same range.
    #[inline(always)]
    fn floor(self) -> Self {
        let nearest = self.round();
        Self::select(self.less(nearest), nearest - Self::one(), nearest)
    }
    /// Whether the mask holds in any lane.
    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        Self::bits(mask) != 0
    }
    /// Whether the mask holds in all lanes.
    #[inline(always)]
    fn all(mask: Self::Mask) -> bool {
        Self::bits(mask) == (1 << Self::LANES) - 1
    }
    /// Lane by lane the larger of the two; `self` where `other` is not a number.
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Self::select(self.less(other), other, self)
    }
    /// The rounded sum of two numbers, and its exact rounding error (Knuth's two-sum).
    #[inline(always)]
    fn two_sum(self, other: Self) -> (Self, Self) {
        let sum = self + other;
        let gone = sum - self;
        (sum, (self - (sum - gone)) + (other - gone))
    }
    /// One value per lane.
    #[inline(always)]
    fn from_lanes(mut value: impl FnMut(usize) -> f64) -> Self {
        let mut out = Self::zero();
        for lane in 0..Self::LANES {
            out.set_lane(lane, value(lane));
        }
        out
    }
    /// The mask that holds in the lanes whose bits are set in `bits`.
    #[inline(always)]
    fn mask(bits: u32) -> Self::Mask {
        Self::splat(0.5).less(Self::from_lanes(|lane| f64::from(bits >> lane & 1)))
    }
    /// Zero in every lane.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(0.0)
    }
    /// One in every lane.
    #[inline(always)]
    fn one() -> Self {
        Self::splat(1.0)
    }
}

/// The largest number of lanes of any type.
pub const MAX_LANES: usize = 16;

/// A piece of work that compiles to a machine function of its own, whatever is inlined around it. Its `run` must be
/// `#[inline(always)]`, and so must every generic function over lanes that it calls.
pub trait Kernel {
    /// Its result.
    type Output;
    /// Does the work.
    fn run(self) -> Self::Output;
}

/// The precision of a lane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// 53 binary digits.
    F64,
    /// 24 binary digits.
    F32,
}

/// Constants that depend on the precision.
#[derive(Debug)]
pub struct Constants {
    /// The distance from 1 to the next number.
    pub epsilon: f64,
    /// 1.5 times the power of two above which every number is whole.
    pub round_shift: f64,
    /// Terms of the series of Stumpff's functions, up to the join.
    pub series: usize,
    /// Terms that suffice below 1.
    pub short_series: usize,
    /// π/2 as the sum of three numbers; the first two times a quadrant's number are exact (f64: to 2²⁰; f32: to 2¹¹).
    pub half_pi_parts: [f64; 3],
}

impl Precision {
    /// The constants of this precision.
    #[inline(always)]
    pub(crate) const fn constants(self) -> &'static Constants {
        match self {
            Self::F64 => &Constants {
                epsilon: f64::EPSILON,
                round_shift: 6_755_399_441_055_744.0,
                series: 15,
                short_series: 8,
                half_pi_parts: [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21],
            },
            Self::F32 => &Constants {
                epsilon: f32::EPSILON as f64,
                round_shift: 12_582_912.0,
                series: 8,
                short_series: 4,
                half_pi_parts: [1.570_312_5, 4.837_512_969_970_703e-4, 7.549_789_954_891_88e-8],
            },
        }
    }
}

macro_rules! scalar {
    ($float:ty, $precision:ident) => {
        impl Lane for $float {
            type Mask = bool;
            const LANES: usize = 1;
            const PRECISION: Precision = Precision::$precision;

            #[inline(always)]
            fn splat(value: f64) -> Self {
                value as $float
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                <$float>::sqrt(self)
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
            fn bits(mask: bool) -> u32 {
                u32::from(mask)
            }
            #[inline(always)]
            fn both(a: bool, b: bool) -> bool {
                a && b
            }
            #[inline(always)]
            fn splat_mask(value: bool) -> bool {
                value
            }
            #[inline(always)]
            fn lane(&self, _index: usize) -> f64 {
                f64::from(*self)
            }
            #[inline(always)]
            fn set_lane(&mut self, _index: usize, value: f64) {
                *self = value as $float;
            }
            #[inline(always)]
            fn call<K: Kernel>(kernel: K) -> K::Output {
                super::lanes::call_scalar(kernel)
            }
        }
    };
}
scalar!(f64, F64);
scalar!(f32, F32);
