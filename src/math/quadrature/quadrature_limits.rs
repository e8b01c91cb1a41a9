//! How far an element may turn for each Gauss–Legendre rule to integrate its inertia to a tolerance.

/// The largest relative tolerance.
pub const LOOSEST: f64 = 1e-2;
/// The smallest relative tolerance.
pub const TIGHTEST: f64 = 1e-12;
/// −log₁₀ of the tolerance of the first column of [`RULES`]; later columns count up by one.
const FIRST_EXPONENT: f64 = 2.0;
const COLUMNS: usize = 11;

/// Rules by their number of points, and the largest turn Ωℓ of an element, rad, up to which each is within 10⁻², 10⁻³, … 10⁻¹²; 0
/// for none. From `examples/quadrature`: the largest error of an entry of the 9 × 9 inertia matrix of an element (its left end
/// moves and turns, its curvatures change) over all directions of the curvature, relative to the diagonal entries of its row and
/// column. The work of weight and wind is among the entries.
#[rustfmt::skip]
pub const RULES: [(usize, [f64; COLUMNS]); 18] = [
    (3, [2.793, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    (4, [4.694, 3.117, 2.357, 1.246, 0.2551, 0.0795, 0.02514, 0.00795, 0.002514, 0.000795, 0.0002514]),
    (5, [5.977, 4.92, 3.546, 2.837, 2.216, 1.435, 0.7184, 0.3849, 0.2149, 0.1209, 0.06798]),
    (6, [7.991, 6.103, 5.258, 4.278, 3.275, 2.743, 2.232, 1.623, 1.16, 0.7184, 0.4894]),
    (7, [9.356, 7.969, 6.359, 5.502, 4.705, 3.797, 3.181, 2.734, 2.306, 1.809, 1.417]),
    (8, [11.64, 9.307, 8.167, 6.732, 5.818, 5.209, 4.449, 3.675, 3.167, 2.77, 2.416]),
    (9, [12.95, 11.49, 9.422, 8.464, 7.345, 6.196, 5.537, 4.935, 4.328, 3.648, 3.199]),
    (10, [15.01, 12.65, 11.47, 9.652, 8.67, 7.689, 6.643, 5.921, 5.377, 4.804, 4.282]),
    (12, [18.47, 16.19, 14.72, 12.74, 11.69, 10.59, 9.267, 8.543, 7.703, 6.864, 6.197]),
    (14, [22.06, 20.16, 18.0, 15.96, 14.79, 13.36, 12.1, 11.29, 10.18, 9.252, 8.625]),
    (16, [26.52, 23.85, 21.31, 19.31, 17.96, 16.33, 15.08, 14.05, 12.76, 11.92, 11.19]),
    (20, [33.81, 30.75, 28.09, 26.47, 24.41, 22.78, 21.26, 20.05, 18.51, 17.66, 16.51]),
    (24, [40.97, 37.83, 35.84, 33.54, 31.01, 29.58, 27.63, 26.3, 24.61, 23.54, 22.17]),
    (32, [56.37, 52.93, 49.87, 47.2, 45.4, 43.13, 40.77, 39.37, 37.33, 36.11, 34.63]),
    (40, [71.94, 68.35, 65.07, 62.08, 59.26, 56.75, 55.07, 52.75, 50.68, 49.25, 48.16]),
    (64, [119.0, 114.9, 110.1, 106.5, 103.3, 100.3, 97.57, 95.5, 92.96, 90.69, 90.04]),
    (96, [181.6, 176.3, 171.9, 167.9, 163.6, 159.9, 156.5, 153.4, 150.7, 149.1, 148.4]),
    (128, [244.6, 239.5, 233.6, 229.0, 224.9, 220.7, 217.1, 213.2, 210.6, 208.9, 208.2]),
];

/// The largest turn for which rule `index` is within `tolerance`, itself within [`TIGHTEST`] and [`LOOSEST`]. Between two columns
/// the logarithms are interpolated.
pub fn largest_turn(index: usize, tolerance: f64) -> f64 {
    let limits = &RULES[index].1;
    let place = (-tolerance.log10() - FIRST_EXPONENT).clamp(0.0, (COLUMNS - 1) as f64);
    let nearest = place.round();
    if (place - nearest).abs() < 1e-9 {
        // A column exactly, whatever the machine's logarithm rounds to.
        return limits[nearest as usize];
    }
    let column = place as usize;
    let fraction = place - column as f64;
    // Where the tighter column has no turn, tolerances in between have none either.
    limits[column].powf(1.0 - fraction) * limits[column + 1].powf(fraction)
}

/// The largest error of rule `index` where an element turns by `angle`: [`TIGHTEST`] means that or less; infinite beyond
/// [`LOOSEST`].
pub fn error(index: usize, angle: f64) -> f64 {
    let limits = &RULES[index].1;
    if angle.is_nan() || angle > limits[0] {
        return f64::INFINITY;
    }
    let Some(column) = (1..COLUMNS).find(|column| angle > limits[*column] || limits[*column] == 0.0) else {
        return TIGHTEST;
    };
    let fraction =
        if limits[column] > 0.0 { (limits[column - 1] / angle).ln() / (limits[column - 1] / limits[column]).ln() } else { 0.0 };
    10.0_f64.powf(-(FIRST_EXPONENT + column as f64 - 1.0 + fraction))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_and_largest_turn_are_inverse() {
        for index in 0..RULES.len() {
            for exponent in 4..=24 {
                let tolerance = 10.0_f64.powf(-0.5 * f64::from(exponent));
                let turn = largest_turn(index, tolerance);
                let found = error(index, turn);
                let has_none = turn == 0.0 && found > tolerance;
                assert!(has_none || (found / tolerance - 1.0).abs() < 1e-9, "{} points: {found:e} at {turn}", RULES[index].0);
            }
            assert_eq!(error(index, 0.0), if index == 0 { LOOSEST } else { TIGHTEST });
            assert_eq!(error(index, 1.001 * RULES[index].1[0]), f64::INFINITY);
            assert!(index == 0 || (0..COLUMNS).all(|column| RULES[index].1[column] > RULES[index - 1].1[column]));
            assert!(RULES[index].1.windows(2).all(|pair| pair[0] > pair[1] || pair[0] == 0.0));
        }
    }
}
