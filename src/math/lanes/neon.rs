//! Packed numbers by NEON, which every AArch64 has.
//!
//! Safety of all blocks here: an intrinsic needs its instructions and nothing else; pointers are to the value itself, which is as large
//! and aligned as the array that it is read as.
#![allow(unsafe_code)]

use std::arch::aarch64::*;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::math::lane::{Kernel, Lane, Precision};

macro_rules! operator {
    ($name:ident, $trait:ident, $function:ident, $intrinsic:ident) => {
        impl $trait for $name {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                // SAFETY: see the file's head.
                unsafe { Self($intrinsic(self.0, other.0)) }
            }
        }
    };
}

macro_rules! packed {
    (
        $(#[$doc:meta])* $name:ident($register:ty), $scalar:ty, $lanes:literal, $precision:ident, $mask:ty,
        $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident, $negate:ident, $set1:ident,
        $less:ident, $select:ident, $and:ident, $set_mask:ident, $integer:ty
    ) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy)]
        #[repr(transparent)]
        pub(crate) struct $name($register);

        operator!($name, Add, add, $add);
        operator!($name, Sub, sub, $sub);
        operator!($name, Mul, mul, $mul);
        operator!($name, Div, div, $div);

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: see the file's head.
                unsafe { Self($negate(self.0)) }
            }
        }
        impl AddAssign for $name {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl SubAssign for $name {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }

        // SAFETY of every block: see the file's head.
        impl Lane for $name {
            type Mask = $mask;
            const LANES: usize = $lanes;
            const PRECISION: Precision = Precision::$precision;

            #[inline(always)]
            fn splat(value: f64) -> Self {
                unsafe { Self($set1(value as $scalar)) }
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                unsafe { Self($sqrt(self.0)) }
            }
            #[inline(always)]
            fn less(self, other: Self) -> Self::Mask {
                unsafe { $less(self.0, other.0) }
            }
            #[inline(always)]
            fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
                unsafe { Self($select(mask, yes.0, no.0)) }
            }
            #[inline(always)]
            fn bits(mask: Self::Mask) -> u32 {
                let lanes = unsafe { &*std::ptr::from_ref(&mask).cast::<[$integer; $lanes]>() };
                let mut bits = 0;
                for (lane, value) in lanes.iter().enumerate() {
                    bits |= u32::from(*value != 0) << lane;
                }
                bits
            }
            #[inline(always)]
            fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask {
                unsafe { $and(a, b) }
            }
            #[inline(always)]
            fn splat_mask(value: bool) -> Self::Mask {
                unsafe { $set_mask(if value { <$integer>::MAX } else { 0 }) }
            }
            #[inline(always)]
            fn lane(&self, index: usize) -> f64 {
                let lanes = unsafe { &*std::ptr::from_ref(self).cast::<[$scalar; $lanes]>() };
                f64::from(lanes[index])
            }
            #[inline(always)]
            fn set_lane(&mut self, index: usize, value: f64) {
                let lanes = unsafe { &mut *std::ptr::from_mut(self).cast::<[$scalar; $lanes]>() };
                lanes[index] = value as $scalar;
            }
            #[inline(always)]
            fn call<K: Kernel>(kernel: K) -> K::Output {
                #[inline(never)]
                fn with<K: Kernel>(kernel: K) -> K::Output {
                    kernel.run()
                }
                with(kernel)
            }
        }
    };
}

packed!(
    /// Two f64.
    F64x2(float64x2_t), f64, 2, F64, uint64x2_t,
    vaddq_f64, vsubq_f64, vmulq_f64, vdivq_f64, vsqrtq_f64, vnegq_f64, vdupq_n_f64, vcltq_f64, vbslq_f64, vandq_u64, vdupq_n_u64, u64
);
packed!(
    /// Four f32.
    F32x4(float32x4_t), f32, 4, F32, uint32x4_t,
    vaddq_f32, vsubq_f32, vmulq_f32, vdivq_f32, vsqrtq_f32, vnegq_f32, vdupq_n_f32, vcltq_f32, vbslq_f32, vandq_u32, vdupq_n_u32, u32
);
