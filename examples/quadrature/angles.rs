//! How far an element may turn for a rule of n points to integrate its inertia to a tolerance.
//!
//! The element has nine motions: translation of its left end (in lengths), rotation about it (rad), and its curvatures times its
//! length (rad). Its 9 × 9 matrix of ∫ Xᵀ X ds, X = [I, −[ρ]×, J], contains everything that a step integrates along an element:
//! inertia and drag; in the rows of translation the work of gravity and of a uniform wind; and, with a point's springs in place
//! of its mass, Newton's matrix.

use superhelix::internals::math::quadrature::Rule;
use superhelix::internals::math::vector::{Mat3, Vec3};
use superhelix::internals::rod::kinematics::element_state;
use superhelix::internals::rod::segment;

/// Directions of the rotation vector: angles from the tangent (0: pure twist; a right angle: a plane arc), and about it.
const FROM_TANGENT: [f64; 9] = [0.0, 5.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 90.0];
const ROUND: [f64; 3] = [0.0, 22.5, 45.0];

/// The matrix, row by row.
type Inertia = [[f64; 9]; 9];

/// Of an element of length one that turns by θ.
fn inertia(theta: Vec3<f64>, rule: &Rule) -> Inertia {
    let element = element_state(theta, 1.0, Mat3::identity(), Vec3::zero());
    let mut out = [[0.0; 9]; 9];
    for (s, weight) in rule.nodes.iter().zip(&rule.weights) {
        let point = element.point(*s);
        let gradient = segment::chord_gradient(theta.scale(*s), element.kappa_squared * s * s, &point.c);
        let [x, y, z] = point.local.0;
        // Columns of X: the point's displacement per unit of each motion.
        let mut columns = [[0.0; 3]; 9];
        for axis in 0..3 {
            columns[axis][axis] = 1.0;
            columns[6 + axis] = gradient.column(axis).scale(s * s).0;
        }
        (columns[3], columns[4], columns[5]) = ([0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]);
        for i in 0..9 {
            for j in 0..9 {
                out[i][j] += weight * (0..3).map(|axis| columns[i][axis] * columns[j][axis]).sum::<f64>();
            }
        }
    }
    out
}

/// Rounding error of an entry.
const ROUNDING: f64 = 4e-16;

/// The largest difference of an entry, relative to the geometric mean of the diagonal entries of its two motions: so the small
/// entry of twist counts by itself.
fn difference(one: &Inertia, exact: &Inertia) -> f64 {
    let mut worst = 0.0_f64;
    for i in 0..9 {
        for j in 0..9 {
            let apart = ((one[i][j] - exact[i][j]).abs() - ROUNDING).max(0.0);
            if apart > 0.0 {
                worst = worst.max(apart / (exact[i][i] * exact[j][j]).sqrt());
            }
        }
    }
    worst
}

/// Directions to try.
fn directions() -> Vec<Vec3<f64>> {
    let turned = |from: f64, round: f64| {
        let (from, round) = (from.to_radians(), round.to_radians());
        Vec3([from.cos(), from.sin() * round.cos(), from.sin() * round.sin()])
    };
    FROM_TANGENT.iter().flat_map(|from| ROUND.iter().map(move |round| turned(*from, *round))).collect()
}

/// The error of each rule in the worst direction, for an element that turns by `angle`.
pub fn errors(rules: &[Rule], angle: f64) -> Vec<f64> {
    let exact_rule = Rule::gauss_legendre(40 + (1.2 * angle) as usize);
    let mut worst = vec![0.0_f64; rules.len()];
    for direction in directions() {
        let theta = direction.scale(angle);
        let exact = inertia(theta, &exact_rule);
        for (rule, worst) in rules.iter().zip(&mut worst) {
            *worst = worst.max(difference(&inertia(theta, rule), &exact));
        }
    }
    worst
}

/// The largest turns, rad, up to which each rule is within 1e-2, 1e-3, … 1e-12; 0 for none. Rules ascend.
///
/// At small angles the inertia of twist is θ² times θ⁶ of a polynomial, so the error of n points goes as θ to the power 2n − 6,
/// and that of three is always 1/400. Where rounding hides the error, this law extrapolates it.
pub fn largest_turns(rules: &[Rule]) -> Vec<[f64; 11]> {
    let mut curve: Vec<(f64, Vec<f64>)> = Vec::new();
    let mut angle = 5e-3;
    // Until the largest rule exceeds the loosest tolerance.
    while curve.last().is_none_or(|(_, errors)| *errors.last().expect("a rule") <= 1e-2) {
        curve.push((angle, errors(rules, angle)));
        angle *= if angle < 1.0 { 1.1 } else { 1.01 };
    }
    let found = |rule: usize, tolerance: f64| {
        let beyond = curve.iter().position(|(_, errors)| errors[rule] > tolerance).expect("the largest rule fails last");
        if beyond == 0 {
            return 0.0;
        }
        let ((from, before), (to, after)) = (&curve[beyond - 1], &curve[beyond]);
        let share = (tolerance / before[rule].max(1e-16)).ln() / (after[rule] / before[rule].max(1e-16)).ln();
        from * (to / from).powf(share.clamp(0.0, 1.0))
    };
    let row = |(rule, points): (usize, usize)| {
        let mut limits = [0.0; 11];
        for column in 0..11 {
            limits[column] = found(rule, 10.0_f64.powi(-2 - column as i32));
            if column > 0 && points > 3 && limits[column - 1] < 1.0 {
                let law = limits[column - 1] * 10.0_f64.powf(-1.0 / (2 * points - 6) as f64);
                limits[column] = if limits[column] > 0.0 { limits[column].min(law) } else { law };
            }
        }
        limits
    };
    rules.iter().map(Rule::len).enumerate().map(row).collect()
}
