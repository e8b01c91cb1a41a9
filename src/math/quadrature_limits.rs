//! How far elements may turn for a Gauss–Legendre rule to integrate their inertia to a tolerance.

/// The largest error, relative, that a rule may be chosen for, and the exponents −log₁₀ of the columns of [`RULES`].
pub const LOOSEST: f64 = 1e-2;
/// The smallest.
pub const TIGHTEST: f64 = 1e-12;
const FIRST_EXPONENT: f64 = 2.0;
const COLUMNS: usize = 11;

/// Rules by their number of points, and the largest turn Ωℓ of an element, rad, up to which each errs by no more than 10⁻², 10⁻³, …
/// 10⁻¹². Measured by `examples/quadrature`: the largest error of an entry of the 9 × 9 inertia matrix of an element (its left end moves and
/// turns, its curvatures change; any direction of the curvature), relative to the diagonal entries of its row and column. The gravity's
/// work is among the entries. Three points integrate the inertia of a straight element exactly, two do not.
#[rustfmt::skip]
pub const RULES: [(usize, [f64; COLUMNS]); 18] = [
    (3, [3.438, 2.054, 0.6542, 0.1849, 0.05801, 0.01833, 0.005796, 0.00183, 0.000579, 0.000183, 5.79e-5]),
    (4, [5.426, 3.917, 2.599, 1.632, 0.9662, 0.5348, 0.2929, 0.1635, 0.09174, 0.05155, 0.02898]),
    (5, [6.807, 5.459, 4.211, 3.131, 2.443, 1.699, 1.176, 0.8323, 0.5546, 0.3722, 0.252]),
    (6, [8.699, 6.791, 5.615, 4.569, 3.743, 2.936, 2.415, 1.829, 1.374, 1.049, 0.8043]),
    (7, [10.75, 8.562, 7.076, 5.866, 5.005, 4.237, 3.508, 2.89, 2.448, 1.981, 1.565]),
    (8, [12.28, 10.48, 8.626, 7.323, 6.196, 5.487, 4.679, 4.081, 3.436, 2.914, 2.515]),
    (9, [14.3, 12.0, 10.44, 8.793, 7.604, 6.607, 5.831, 5.18, 4.522, 4.011, 3.44]),
    (10, [16.07, 13.8, 11.94, 10.53, 9.031, 7.969, 7.118, 6.234, 5.627, 5.007, 4.452]),
    (12, [20.09, 17.46, 15.19, 13.66, 12.11, 10.97, 9.777, 8.81, 7.93, 7.227, 6.48]),
    (14, [23.91, 21.13, 18.6, 17.0, 15.21, 13.91, 12.58, 11.71, 10.66, 9.657, 8.856]),
    (16, [27.64, 24.6, 22.1, 20.28, 18.47, 17.09, 15.55, 14.46, 13.37, 12.28, 11.52]),
    (20, [35.24, 31.9, 29.59, 27.17, 25.06, 23.55, 21.77, 20.47, 19.08, 18.01, 16.95]),
    (24, [43.26, 39.49, 36.72, 34.16, 31.97, 30.19, 28.26, 26.78, 25.18, 23.99, 22.69]),
    (32, [58.65, 54.92, 51.62, 48.71, 46.07, 43.82, 42.02, 39.9, 38.11, 36.61, 34.94]),
    (40, [74.33, 69.88, 66.76, 63.07, 60.53, 58.11, 55.77, 53.78, 51.76, 49.73, 48.08]),
    (64, [121.9, 116.8, 112.0, 108.1, 104.7, 101.7, 99.07, 96.46, 93.88, 91.44, 89.09]),
    (96, [184.9, 178.9, 173.8, 169.4, 165.4, 161.9, 158.1, 155.1, 152.3, 149.4, 146.4]),
    (128, [248.8, 241.5, 236.0, 231.3, 226.7, 222.5, 218.7, 215.1, 211.7, 208.4, 204.8]),
];

/// The largest turn for which rule `index` errs by no more than `tolerance`, within [`TIGHTEST`] and [`LOOSEST`]: between two columns
/// the logarithms are interpolated.
pub fn largest_turn(index: usize, tolerance: f64) -> f64 {
    let limits = &RULES[index].1;
    let place = (-tolerance.log10() - FIRST_EXPONENT).clamp(0.0, (COLUMNS - 1) as f64);
    let nearest = place.round();
    if (place - nearest).abs() < 1e-9 {
        // A column itself, whatever the machine's logarithm rounds to.
        return limits[nearest as usize];
    }
    let column = place as usize;
    let share = place - column as f64;
    limits[column].powf(1.0 - share) * limits[column + 1].powf(share)
}

/// What rule `index` errs by where an element turns by `angle`: [`TIGHTEST`] stands for that or less; infinite beyond [`LOOSEST`].
pub fn error(index: usize, angle: f64) -> f64 {
    let limits = &RULES[index].1;
    if angle.is_nan() || angle > limits[0] {
        return f64::INFINITY;
    }
    let Some(column) = (1..COLUMNS).find(|column| angle > limits[*column]) else {
        return TIGHTEST;
    };
    let share = (limits[column - 1] / angle).ln() / (limits[column - 1] / limits[column]).ln();
    10.0_f64.powf(-(FIRST_EXPONENT + column as f64 - 1.0 + share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_and_largest_turn_are_inverse() {
        for index in 0..RULES.len() {
            for exponent in 4..=24 {
                let tolerance = 10.0_f64.powf(-0.5 * f64::from(exponent));
                let found = error(index, largest_turn(index, tolerance));
                assert!((found / tolerance - 1.0).abs() < 1e-9, "{} points: {found:e} for {tolerance:e}", RULES[index].0);
            }
            assert_eq!(error(index, 0.0), TIGHTEST);
            assert_eq!(error(index, 1.001 * RULES[index].1[0]), f64::INFINITY);
            assert!(index == 0 || (0..COLUMNS).all(|column| RULES[index].1[column] > RULES[index - 1].1[column]));
            assert!(RULES[index].1.is_sorted_by(|a, b| a > b));
        }
    }
}
