//! Sine and cosine with the same bits on every machine and at every lane width.
//!
//! Reduction by π/2 in three parts (Cody and Waite) and the polynomials of fdlibm's `__kernel_sin` and `__kernel_cos`.
//! Error under 1 ulp of 1 for |x| up to a million radians.

use crate::math::lane::Lane;

const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// (sin x, cos x).
#[inline(always)]
pub fn sine_cosine<T: Lane>(x: T) -> (T, T) {
    let quadrant = (x * T::splat(std::f64::consts::FRAC_2_PI)).round();
    let parts = T::PRECISION.constants().half_pi_parts;
    let r = x - quadrant * T::splat(parts[0]) - quadrant * T::splat(parts[1]) - quadrant * T::splat(parts[2]);
    let z = r * r;
    let mut sine = T::splat(SINE[5]);
    let mut cosine = T::splat(COSINE[5]);
    for degree in (0..5).rev() {
        sine = sine * z + T::splat(SINE[degree]);
        cosine = cosine * z + T::splat(COSINE[degree]);
    }
    let sine = r + r * z * sine;
    let half = T::splat(0.5) * z;
    let near_one = T::one() - half;
    let cosine = near_one + (((T::one() - near_one) - half) + z * (z * cosine));
    // The quadrant modulo 4 decides which of the two is which, and the signs.
    let quarter = quadrant - T::splat(4.0) * (quadrant * T::splat(0.25)).floor();
    let odd = {
        let half_turns = quarter - T::splat(2.0) * (quarter * T::splat(0.5)).floor();
        T::less(T::splat(0.5), half_turns)
    };
    let swapped_sine = T::select(odd, cosine, sine);
    let swapped_cosine = T::select(odd, sine, cosine);
    let sine_negative = T::less(T::splat(1.5), quarter);
    let shifted = quarter - T::splat(1.5);
    let cosine_negative = T::less(shifted * shifted, T::one());
    (T::select(sine_negative, -swapped_sine, swapped_sine), T::select(cosine_negative, -swapped_cosine, swapped_cosine))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_standard_library_within_one_ulp_of_one() {
        // The standard library's own sine is good to under 1 ulp; the difference may be the sum of both errors.
        let mut worst: f64 = 0.0;
        for step in -400_000..400_000 {
            let x = f64::from(step) * 0.001_37 + f64::from(step % 7) * 1e-9;
            let (sine, cosine) = sine_cosine(x);
            worst = worst.max((sine - x.sin()).abs()).max((cosine - x.cos()).abs());
        }
        assert!(worst < 2.3e-16, "{worst:e}");
        for x in [0.0, -0.0, 1e-300, 1e5 + 0.25, -9.9e5, std::f64::consts::FRAC_PI_2, std::f64::consts::PI] {
            let (sine, cosine) = sine_cosine(x);
            assert!((sine - f64::sin(x)).abs() < 2.3e-16 && (cosine - f64::cos(x)).abs() < 2.3e-16, "{x}");
        }
    }

    #[test]
    fn keeps_small_arguments_to_their_last_digit() {
        for x in [1e-9, -3e-12, 4e-5] {
            assert_eq!(sine_cosine(x).0, f64::sin(x));
        }
    }
}
