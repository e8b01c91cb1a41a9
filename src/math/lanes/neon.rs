//! Packed numbers by NEON, which every AArch64 has. `register` says why the unsafe blocks here are safe.
#![allow(unsafe_code)]

use std::arch::aarch64::*;

use crate::math::lane::{Kernel, Lane, Precision};

/// Defines a packed type: its name, register, scalar, lanes, precision, mask and instructions; the last is the mask's scalar.
macro_rules! packed {
    (
        $(#[$doc:meta])* $name:ident($register:ty), $scalar:ty, $lanes:literal, $precision:ident, $mask:ty,
        $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident, $negate:ident, $set1:ident,
        $less:ident, $select:ident, $and:ident, $set_mask:ident, $integer:ty
    ) => {
        register!(
            $(#[$doc])* $name($register), $scalar, $lanes, $precision,
            $add, $sub, $mul, $div, $sqrt, $set1,
            negate: |x| $negate(x),
            {
                type Mask = $mask;

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
                #[inline(never)]
                fn call<K: Kernel>(kernel: K) -> K::Output {
                    kernel.run()
                }
            }
        );
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
