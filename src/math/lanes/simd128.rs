//! Packed numbers by WebAssembly's 128-bit vectors.
//!
//! A module cannot detect its engine's features: one with these instructions runs only where they exist, which is every browser
//! since 2023 and every node since 16. `register` says why the unsafe blocks here are safe.
#![allow(unsafe_code)]
#![allow(unused_unsafe, reason = "needed unless the whole crate is compiled for simd128")]

use std::arch::wasm32::*;

use crate::math::lane::{Kernel, Lane, Precision};

/// Defines a packed type: its name, scalar, lanes, precision and instructions; the last is the mask's scalar.
macro_rules! packed {
    (
        $(#[$doc:meta])* $name:ident, $scalar:ty, $lanes:literal, $precision:ident,
        $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident, $negate:ident, $set1:ident,
        $less:ident, $bitmask:ident, $set_mask:ident, $integer:ty
    ) => {
        register!(
            $(#[$doc])* $name(v128), $scalar, $lanes, $precision,
            $add, $sub, $mul, $div, $sqrt, $set1,
            negate: |x| $negate(x),
            {
                type Mask = v128;

                #[inline(always)]
                fn less(self, other: Self) -> Self::Mask {
                    unsafe { $less(self.0, other.0) }
                }
                #[inline(always)]
                fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
                    unsafe { Self(v128_bitselect(yes.0, no.0, mask)) }
                }
                #[inline(always)]
                fn bits(mask: Self::Mask) -> u32 {
                    u32::from(unsafe { $bitmask(mask) })
                }
                #[inline(always)]
                fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask {
                    unsafe { v128_and(a, b) }
                }
                #[inline(always)]
                fn splat_mask(value: bool) -> Self::Mask {
                    unsafe { $set_mask(-<$integer>::from(value)) }
                }
                #[inline(always)]
                fn call<K: Kernel>(kernel: K) -> K::Output {
                    #[target_feature(enable = "simd128")]
                    #[inline(never)]
                    fn with<K: Kernel>(kernel: K) -> K::Output {
                        kernel.run()
                    }
                    unsafe { with(kernel) }
                }
            }
        );
    };
}

packed!(
    /// Two f64.
    F64x2, f64, 2, F64,
    f64x2_add, f64x2_sub, f64x2_mul, f64x2_div, f64x2_sqrt, f64x2_neg, f64x2_splat, f64x2_lt, i64x2_bitmask, i64x2_splat, i64
);
packed!(
    /// Four f32.
    F32x4, f32, 4, F32,
    f32x4_add, f32x4_sub, f32x4_mul, f32x4_div, f32x4_sqrt, f32x4_neg, f32x4_splat, f32x4_lt, i32x4_bitmask, i32x4_splat, i32
);
