//! Stumpff's entire functions, from which a helix is made, exact through zero curvature.
//!
//! Stumpff's functions cₖ(z) = Σⱼ (−z)ʲ/(2j+k)!, with z = x², where x = Ωs is the angle turned. In the letters of
//! `docs/theory/mathematics.md`: A = sin x/x = c1, B = (1 − cos x)/x² = c2, C = (x − sin x)/x³ = c3; and from their derivatives
//! 2d/dz, b = (A−2B)/x² = 2c4 − c3, c = (B−3C)/x² = 3c5 − c4, b′ = 2db/dz = c4 − 5c5 + 8c6, c′ = 2dc/dz = c5 − 7c6 + 15c7: no
//! division and no singular case. They follow from the identity cₖ = 1/k! − z cₖ₊₂.

use super::trigonometry::sine_cosine;
use crate::math::lane::Lane;

/// Below this z the series is used (its terms fall quickly; below 1 half of them are enough), above it sine and cosine (by then
/// their cancellation is harmless). At the join both are good to 4 ulp.
const JOIN: f64 = 15.0;

/// Coefficients of c6 and c7: (−1)ʲ/(2j+6)! and (−1)ʲ/(2j+7)!. Truncated at the join, fifteen terms leave 1e-17 of the first term
/// and eight 2e-9 (f32); at 1 eight leave 6e-19 and four 4e-10.
const TERMS: usize = 15;
const SERIES_6: [f64; TERMS] = reciprocal_factorials(6);
const SERIES_7: [f64; TERMS] = reciprocal_factorials(7);

const fn reciprocal_factorials(first: u32) -> [f64; TERMS] {
    let mut out = [0.0; TERMS];
    let mut j = 0;
    while j < TERMS {
        // Factorials to 22! are exact in f64; beyond, the product's rounding is far below the term's weight.
        let mut factorial = 1.0;
        let mut factor = 2;
        while factor <= 2 * j as u32 + first {
            factorial *= factor as f64;
            factor += 1;
        }
        out[j] = if j % 2 == 0 { 1.0 / factorial } else { -1.0 / factorial };
        j += 1;
    }
    out
}

/// c1 … c7 at one z.
#[derive(Debug, Clone, Copy)]
pub struct Stumpff<T> {
    /// sin x/x (A).
    pub c1: T,
    /// (1 − cos x)/x² (B).
    pub c2: T,
    /// (x − sin x)/x³ (C).
    pub c3: T,
    /// (½ − c2)/z.
    pub c4: T,
    /// (1/6 − c3)/z.
    pub c5: T,
    /// (1/24 − c4)/z.
    pub c6: T,
    /// (1/120 − c5)/z.
    pub c7: T,
}

impl<T: Lane> Stumpff<T> {
    /// Evaluates all seven at `z` = x² ≥ 0.
    #[inline(always)]
    pub fn at(z: T) -> Self {
        let tiny = T::less(z, T::one());
        if T::all(tiny) {
            return Self::by_series(z, T::PRECISION.constants().short_series);
        }
        // Each lane chooses by its own z, so its bits do not depend on the other lanes.
        let by_short = Self::by_series(z, T::PRECISION.constants().short_series);
        let by_series = Self::by_series(z, T::PRECISION.constants().series);
        let within = Self::select(tiny, &by_short, &by_series);
        let small = T::less(z, T::splat(JOIN));
        if T::all(small) {
            return within;
        }
        Self::select(small, &within, &Self::by_angle(z))
    }

    #[inline(always)]
    fn select(mask: T::Mask, yes: &Self, no: &Self) -> Self {
        Self {
            c1: T::select(mask, yes.c1, no.c1),
            c2: T::select(mask, yes.c2, no.c2),
            c3: T::select(mask, yes.c3, no.c3),
            c4: T::select(mask, yes.c4, no.c4),
            c5: T::select(mask, yes.c5, no.c5),
            c6: T::select(mask, yes.c6, no.c6),
            c7: T::select(mask, yes.c7, no.c7),
        }
    }

    #[inline(always)]
    fn by_series(z: T, terms: usize) -> Self {
        let mut c6 = T::splat(SERIES_6[terms - 1]);
        let mut c7 = T::splat(SERIES_7[terms - 1]);
        for j in (0..terms - 1).rev() {
            c6 = c6 * z + T::splat(SERIES_6[j]);
            c7 = c7 * z + T::splat(SERIES_7[j]);
        }
        let c5 = T::splat(1.0 / 120.0) - z * c7;
        let c4 = T::splat(1.0 / 24.0) - z * c6;
        let c3 = T::splat(1.0 / 6.0) - z * c5;
        let c2 = T::splat(0.5) - z * c4;
        let c1 = T::one() - z * c3;
        Self { c1, c2, c3, c4, c5, c6, c7 }
    }

    #[inline(always)]
    fn by_angle(z: T) -> Self {
        let x = z.sqrt();
        // Half the angle: 1 − cos x = 2 sin²(x/2) keeps its digits near whole turns.
        let (sine, cosine) = sine_cosine(T::splat(0.5) * x);
        let c1 = T::splat(2.0) * sine * cosine / x;
        let inverse = T::one() / z;
        let c2 = T::splat(2.0) * sine * sine * inverse;
        let c3 = (T::one() - c1) * inverse;
        let c4 = (T::splat(0.5) - c2) * inverse;
        let c5 = (T::splat(1.0 / 6.0) - c3) * inverse;
        let c6 = (T::splat(1.0 / 24.0) - c4) * inverse;
        let c7 = (T::splat(1.0 / 120.0) - c5) * inverse;
        Self { c1, c2, c3, c4, c5, c6, c7 }
    }

    /// b = 2 dB/dz = (A − 2B)/x².
    #[inline(always)]
    pub fn b(&self) -> T {
        T::splat(2.0) * self.c4 - self.c3
    }

    /// c = 2 dC/dz = (B − 3C)/x².
    #[inline(always)]
    pub fn c(&self) -> T {
        T::splat(3.0) * self.c5 - self.c4
    }

    /// b′ = 2 db/dz.
    #[inline(always)]
    pub fn b_prime(&self) -> T {
        self.c4 - T::splat(5.0) * self.c5 + T::splat(8.0) * self.c6
    }

    /// c′ = 2 dc/dz.
    #[inline(always)]
    pub fn c_prime(&self) -> T {
        self.c5 - T::splat(7.0) * self.c6 + T::splat(15.0) * self.c7
    }
}
