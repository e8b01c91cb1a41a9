//! Several numbers side by side that go through the same operations: the register of a vector unit, or a few of them.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use super::lane::Lane;

/// `W` numbers. Operations are written element by element, which compilers make vector instructions of.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(64))]
pub struct Pack<const W: usize>(pub [f64; W]);

/// A truth value a lane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PackMask<const W: usize>(pub [bool; W]);

macro_rules! binary {
    ($trait:ident, $function:ident, $operator:tt) => {
        impl<const W: usize> $trait for Pack<W> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                let mut out = self;
                for lane in 0..W {
                    out.0[lane] = self.0[lane] $operator other.0[lane];
                }
                out
            }
        }
    };
}
binary!(Add, add, +);
binary!(Sub, sub, -);
binary!(Mul, mul, *);
binary!(Div, div, /);

impl<const W: usize> Neg for Pack<W> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let mut out = self;
        for lane in 0..W {
            out.0[lane] = -self.0[lane];
        }
        out
    }
}

impl<const W: usize> AddAssign for Pack<W> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const W: usize> SubAssign for Pack<W> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<const W: usize> Lane for Pack<W> {
    type Mask = PackMask<W>;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; W])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let mut out = self;
        for lane in 0..W {
            out.0[lane] = self.0[lane].sqrt();
        }
        out
    }
    #[inline(always)]
    fn round(self) -> Self {
        let mut out = self;
        for lane in 0..W {
            out.0[lane] = Lane::round(self.0[lane]);
        }
        out
    }
    #[inline(always)]
    fn floor(self) -> Self {
        let mut out = self;
        for lane in 0..W {
            out.0[lane] = Lane::floor(self.0[lane]);
        }
        out
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        let mut out = PackMask([false; W]);
        for lane in 0..W {
            out.0[lane] = self.0[lane] < other.0[lane];
        }
        out
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        let mut out = no;
        for lane in 0..W {
            out.0[lane] = if mask.0[lane] { yes.0[lane] } else { no.0[lane] };
        }
        out
    }
    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        mask.0.iter().any(|lane| *lane)
    }
    #[inline(always)]
    fn all(mask: Self::Mask) -> bool {
        mask.0.iter().all(|lane| *lane)
    }
    const LANES: usize = W;
    #[inline(always)]
    fn lane(self, index: usize) -> f64 {
        self.0[index]
    }
    #[inline(always)]
    fn set_lane(&mut self, index: usize, value: f64) {
        self.0[index] = value;
    }
    #[inline(always)]
    fn mask_lane(mask: Self::Mask, index: usize) -> bool {
        mask.0[index]
    }
    #[inline(always)]
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask {
        let mut out = a;
        for lane in 0..W {
            out.0[lane] = a.0[lane] && b.0[lane];
        }
        out
    }
    #[inline(always)]
    fn splat_mask(value: bool) -> Self::Mask {
        PackMask([value; W])
    }
}
