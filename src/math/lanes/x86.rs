//! Packed numbers by SSE2, AVX2 and AVX-512. `register` says why the unsafe blocks here are safe.
#![allow(unsafe_code)]

use std::arch::x86_64::*;

use crate::math::lane::{Kernel, Lane, Precision};

pub(super) fn has_avx2() -> bool {
    std::arch::is_x86_feature_detected!("avx2")
}

pub(super) fn has_avx512() -> bool {
    std::arch::is_x86_feature_detected!("avx512f")
        && std::arch::is_x86_feature_detected!("avx512bw")
        && std::arch::is_x86_feature_detected!("avx512dq")
        && std::arch::is_x86_feature_detected!("avx512vl")
}

/// See [`super::call_scalar`]; for machines with AVX2.
#[inline(always)]
pub(super) fn call_scalar<K: Kernel>(kernel: K) -> K::Output {
    #[target_feature(enable = "avx2")]
    #[inline(never)]
    fn with<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }
    unsafe { with(kernel) }
}

/// Defines a packed type: its name, register, scalar, lanes, precision, features, instructions, and the operations of its masks.
macro_rules! packed {
    (
        $(#[$doc:meta])* $name:ident($register:ty), $scalar:ty, $lanes:literal, $precision:ident, $features:literal,
        $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident, $set1:ident,
        negate: |$x:ident| $negate:expr,
        mask: $mask:ty, less: |$a:ident, $b:ident| $less:expr, select: |$m:ident, $yes:ident, $no:ident| $select:expr,
        bits: |$n:ident| $bits:expr, both: |$p:ident, $q:ident| $both:expr, splat_mask: |$v:ident| $splat_mask:expr
    ) => {
        register!(
            $(#[$doc])* $name($register), $scalar, $lanes, $precision,
            $add, $sub, $mul, $div, $sqrt, $set1,
            negate: |$x| $negate,
            {
                type Mask = $mask;

                #[inline(always)]
                fn less(self, other: Self) -> Self::Mask {
                    let ($a, $b) = (self.0, other.0);
                    unsafe { $less }
                }
                #[inline(always)]
                fn select($m: Self::Mask, yes: Self, no: Self) -> Self {
                    let ($yes, $no) = (yes.0, no.0);
                    unsafe { Self($select) }
                }
                #[inline(always)]
                fn bits($n: Self::Mask) -> u32 {
                    #[allow(unused_unsafe)]
                    unsafe {
                        $bits
                    }
                }
                #[inline(always)]
                fn both($p: Self::Mask, $q: Self::Mask) -> Self::Mask {
                    #[allow(unused_unsafe)]
                    unsafe {
                        $both
                    }
                }
                #[inline(always)]
                fn splat_mask($v: bool) -> Self::Mask {
                    #[allow(unused_unsafe)]
                    unsafe {
                        $splat_mask
                    }
                }
                #[inline(always)]
                fn call<K: Kernel>(kernel: K) -> K::Output {
                    #[target_feature(enable = $features)]
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
    /// Two f64, SSE2.
    F64x2(__m128d), f64, 2, F64, "sse2",
    _mm_add_pd, _mm_sub_pd, _mm_mul_pd, _mm_div_pd, _mm_sqrt_pd, _mm_set1_pd,
    negate: |x| _mm_xor_pd(x, _mm_set1_pd(-0.0)),
    mask: __m128d, less: |a, b| _mm_cmplt_pd(a, b),
    select: |m, yes, no| _mm_or_pd(_mm_and_pd(m, yes), _mm_andnot_pd(m, no)),
    bits: |m| _mm_movemask_pd(m) as u32, both: |a, b| _mm_and_pd(a, b),
    splat_mask: |v| _mm_castsi128_pd(_mm_set1_epi64x(-i64::from(v)))
);
packed!(
    /// Four f32, SSE2.
    F32x4(__m128), f32, 4, F32, "sse2",
    _mm_add_ps, _mm_sub_ps, _mm_mul_ps, _mm_div_ps, _mm_sqrt_ps, _mm_set1_ps,
    negate: |x| _mm_xor_ps(x, _mm_set1_ps(-0.0)),
    mask: __m128, less: |a, b| _mm_cmplt_ps(a, b),
    select: |m, yes, no| _mm_or_ps(_mm_and_ps(m, yes), _mm_andnot_ps(m, no)),
    bits: |m| _mm_movemask_ps(m) as u32, both: |a, b| _mm_and_ps(a, b),
    splat_mask: |v| _mm_castsi128_ps(_mm_set1_epi32(-i32::from(v)))
);
packed!(
    /// Four f64, AVX2.
    F64x4(__m256d), f64, 4, F64, "avx2",
    _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd, _mm256_sqrt_pd, _mm256_set1_pd,
    negate: |x| _mm256_xor_pd(x, _mm256_set1_pd(-0.0)),
    mask: __m256d, less: |a, b| _mm256_cmp_pd::<_CMP_LT_OQ>(a, b),
    select: |m, yes, no| _mm256_blendv_pd(no, yes, m),
    bits: |m| _mm256_movemask_pd(m) as u32, both: |a, b| _mm256_and_pd(a, b),
    splat_mask: |v| _mm256_castsi256_pd(_mm256_set1_epi64x(-i64::from(v)))
);
packed!(
    /// Eight f32, AVX2.
    F32x8(__m256), f32, 8, F32, "avx2",
    _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps, _mm256_div_ps, _mm256_sqrt_ps, _mm256_set1_ps,
    negate: |x| _mm256_xor_ps(x, _mm256_set1_ps(-0.0)),
    mask: __m256, less: |a, b| _mm256_cmp_ps::<_CMP_LT_OQ>(a, b),
    select: |m, yes, no| _mm256_blendv_ps(no, yes, m),
    bits: |m| _mm256_movemask_ps(m) as u32, both: |a, b| _mm256_and_ps(a, b),
    splat_mask: |v| _mm256_castsi256_ps(_mm256_set1_epi32(-i32::from(v)))
);
packed!(
    /// Eight f64, AVX-512.
    F64x8(__m512d), f64, 8, F64, "avx512f,avx512bw,avx512dq,avx512vl",
    _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd, _mm512_sqrt_pd, _mm512_set1_pd,
    negate: |x| _mm512_xor_pd(x, _mm512_set1_pd(-0.0)),
    mask: __mmask8, less: |a, b| _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b),
    select: |m, yes, no| _mm512_mask_blend_pd(m, no, yes),
    bits: |m| u32::from(m), both: |a, b| a & b, splat_mask: |v| if v { u8::MAX } else { 0 }
);
packed!(
    /// Sixteen f32, AVX-512.
    F32x16(__m512), f32, 16, F32, "avx512f,avx512bw,avx512dq,avx512vl",
    _mm512_add_ps, _mm512_sub_ps, _mm512_mul_ps, _mm512_div_ps, _mm512_sqrt_ps, _mm512_set1_ps,
    negate: |x| _mm512_xor_ps(x, _mm512_set1_ps(-0.0)),
    mask: __mmask16, less: |a, b| _mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b),
    select: |m, yes, no| _mm512_mask_blend_ps(m, no, yes),
    bits: |m| u32::from(m), both: |a, b| a & b, splat_mask: |v| if v { u16::MAX } else { 0 }
);

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares every operation of a type with the scalar one, to the bit.
    fn check<T: Lane, S: Lane>() {
        struct All<T, S>(std::marker::PhantomData<(T, S)>);
        impl<T: Lane, S: Lane> Kernel for All<T, S> {
            type Output = ();
            #[inline(always)]
            fn run(self) {
                let value = |lane: usize, seed: u32| (f64::from(seed) * 0.37 - 3.0) * (1.0 + lane as f64 * 0.731);
                for seed in 0..40 {
                    let a = T::from_lanes(|lane| value(lane, seed));
                    let b = T::from_lanes(|lane| value(lane + 3, seed + 17));
                    let results = [
                        a + b,
                        a - b,
                        a * b,
                        a / b,
                        -a,
                        (a * a).sqrt(),
                        a.round(),
                        a.floor(),
                        a.larger(b),
                        T::select(a.less(b), a, b),
                        T::select(T::both(a.less(b), T::splat_mask(true)), a, b),
                        T::select(T::both(a.less(b), T::splat_mask(false)), a, b),
                    ];
                    let mut bits = 0;
                    for lane in 0..T::LANES {
                        let (x, y) = (S::splat(value(lane, seed)), S::splat(value(lane + 3, seed + 17)));
                        let expected = [
                            x + y,
                            x - y,
                            x * y,
                            x / y,
                            -x,
                            (x * x).sqrt(),
                            x.round(),
                            x.floor(),
                            x.larger(y),
                            S::select(x.less(y), x, y),
                            S::select(x.less(y), x, y),
                            y,
                        ];
                        for (result, expected) in results.iter().zip(&expected) {
                            assert_eq!(result.lane(lane).to_bits(), expected.lane(0).to_bits(), "lane {lane}, seed {seed}");
                        }
                        bits |= S::bits(x.less(y)) << lane;
                    }
                    assert_eq!(T::bits(a.less(b)), bits);
                    assert_eq!(T::any(a.less(b)), bits != 0);
                    assert!(T::all(T::splat_mask(true)) && !T::any(T::splat_mask(false)));
                }
                // Comparisons with NaN are false.
                assert!(!T::any(T::splat(f64::NAN).less(T::one())) && !T::any(T::one().less(T::splat(f64::NAN))));
            }
        }
        T::call(All::<T, S>(std::marker::PhantomData));
    }

    #[test]
    fn every_width_computes_the_same_as_the_scalar() {
        check::<F64x2, f64>();
        check::<F32x4, f32>();
        if has_avx2() {
            check::<F64x4, f64>();
            check::<F32x8, f32>();
        }
        if has_avx512() {
            check::<F64x8, f64>();
            check::<F32x16, f32>();
        }
    }
}
