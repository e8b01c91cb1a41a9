//! The small symmetric pivots of the elimination: Cholesky's factorisation, and a repair for one that is not positive definite.

use crate::math::lane::Lane;

/// The lower Cholesky factor of a symmetric D×D matrix, its diagonal inverted, and the lanes in which every pivot exceeded
/// `floor`. In the other lanes the factor is meaningless.
#[inline(always)]
pub fn cholesky<T: Lane, const D: usize>(matrix: &[[T; D]; D], floor: T) -> ([[T; D]; D], T::Mask) {
    let mut factor = [[T::zero(); D]; D];
    let mut good = T::splat_mask(true);
    for j in 0..D {
        let mut pivot = matrix[j][j];
        for k in 0..j {
            pivot -= factor[j][k] * factor[j][k];
        }
        good = T::both(good, T::less(floor, pivot));
        let inverse = T::one() / pivot.sqrt();
        factor[j][j] = inverse;
        for i in j + 1..D {
            let mut value = matrix[i][j];
            for k in 0..j {
                value -= factor[i][k] * factor[j][k];
            }
            factor[i][j] = value * inverse;
        }
    }
    (factor, good)
}

/// The pivot's factor, and the lanes in which it had to be repaired because it was not positive definite (1, else 0). `smallest`
/// is the least stiffness of the element's own curvatures: a smaller eigenvalue is no curvature of the potential worth following.
#[inline(always)]
pub fn factorise<T: Lane, const D: usize>(pivot: &[[T; D]; D], smallest: T) -> ([[T; D]; D], T) {
    let (mut factor, good) = cholesky(pivot, T::splat(1e-3) * smallest);
    let mut repaired = T::zero();
    if !T::all(good) {
        let good = T::bits(good);
        for lane in (0..T::LANES).filter(|lane| good >> lane & 1 == 0) {
            let one: [[f64; D]; D] = std::array::from_fn(|i| std::array::from_fn(|j| pivot[i][j].lane(lane)));
            let one = repair(&one, smallest.lane(lane));
            for i in 0..D {
                for j in 0..D {
                    factor[i][j].set_lane(lane, one[i][j]);
                }
            }
            repaired.set_lane(lane, 1.0);
        }
    }
    (factor, repaired)
}

/// The factor of a repaired pivot. Not finite where the pivot is not: the caller then sees a direction that is not finite, and
/// gives the strand up.
#[cold]
fn repair<const D: usize>(pivot: &[[f64; D]; D], smallest: f64) -> [[f64; D]; D] {
    let mut largest = 0.0_f64;
    for i in 0..D {
        largest = largest.max(pivot[i][i].abs());
    }
    let (factor, good) = cholesky(&reflect(pivot, smallest.max(1e-12 * largest)), 0.0);
    if good { factor } else { [[f64::NAN; D]; D] }
}

/// Eigenvalues and eigenvectors (columns) of a symmetric matrix by Jacobi's rotations.
fn eigen<const D: usize>(matrix: &[[f64; D]; D]) -> ([f64; D], [[f64; D]; D]) {
    let mut a = *matrix;
    let mut vectors = [[0.0; D]; D];
    for i in 0..D {
        vectors[i][i] = 1.0;
    }
    for _ in 0..30 {
        let mut off = 0.0;
        let mut on = 0.0;
        for i in 0..D {
            on += a[i][i] * a[i][i];
            for j in 0..i {
                off += a[i][j] * a[i][j];
            }
        }
        if off <= 1e-32 * on || off == 0.0 {
            break;
        }
        for p in 0..D {
            for q in p + 1..D {
                if a[p][q] == 0.0 {
                    continue;
                }
                let ratio = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                let tangent = if ratio >= 0.0 {
                    1.0 / (ratio + (1.0 + ratio * ratio).sqrt())
                } else {
                    -1.0 / (-ratio + (1.0 + ratio * ratio).sqrt())
                };
                let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
                let sine = tangent * cosine;
                for k in 0..D {
                    let (x, y) = (a[k][p], a[k][q]);
                    a[k][p] = cosine * x - sine * y;
                    a[k][q] = sine * x + cosine * y;
                }
                for k in 0..D {
                    let (x, y) = (a[p][k], a[q][k]);
                    a[p][k] = cosine * x - sine * y;
                    a[q][k] = sine * x + cosine * y;
                }
                for row in vectors.iter_mut() {
                    let (x, y) = (row[p], row[q]);
                    row[p] = cosine * x - sine * y;
                    row[q] = sine * x + cosine * y;
                }
            }
        }
    }
    (std::array::from_fn(|i| a[i][i]), vectors)
}

/// The matrix with every eigenvalue replaced by its magnitude, and none below `floor`. A direction solved with it is one of
/// descent, and its step along strong negative curvature is as long as that curvature calls for.
pub fn reflect<const D: usize>(matrix: &[[f64; D]; D], floor: f64) -> [[f64; D]; D] {
    let (values, vectors) = eigen(matrix);
    let mut out = [[0.0; D]; D];
    for (k, value) in values.iter().enumerate() {
        let value = value.abs().max(floor);
        for i in 0..D {
            for j in 0..D {
                out[i][j] += value * vectors[i][k] * vectors[j][k];
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factorises_and_refuses() {
        let matrix: [[f64; 3]; 3] = [[4.0, 1.0, 0.5], [1.0, 3.0, -0.2], [0.5, -0.2, 2.0]];
        let (factor, good) = cholesky(&matrix, 0.0);
        assert!(good);
        for i in 0..3 {
            for j in 0..=i {
                let mut sum = 0.0;
                for k in 0..=j {
                    let left = if i == k { 1.0 / factor[i][k] } else { factor[i][k] };
                    let right = if j == k { 1.0 / factor[j][k] } else { factor[j][k] };
                    sum += left * right;
                }
                assert!((sum - matrix[i][j]).abs() < 1e-15);
            }
        }
        assert!(!cholesky::<f64, 2>(&[[1.0, 2.0], [2.0, 1.0]], 0.0).1);
        assert!(!cholesky::<f64, 1>(&[[f64::NAN]], 0.0).1);
    }

    #[test]
    fn reflects_negative_eigenvalues_and_keeps_positive_ones() {
        let matrix = [[1.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 5.0]]; // eigenvalues 3, −1, 5
        let out = reflect(&matrix, 1e-3);
        let (mut values, _) = eigen(&out);
        values.sort_by(f64::total_cmp);
        for (value, expected) in values.iter().zip([1.0, 3.0, 5.0]) {
            assert!((value - expected).abs() < 1e-14, "{values:?}");
        }
        let positive = [[2.0, 0.3], [0.3, 1.0]];
        let same = reflect(&positive, 1e-9);
        for i in 0..2 {
            for j in 0..2 {
                assert!((same[i][j] - positive[i][j]).abs() < 1e-15);
            }
        }
    }
}
