//! Least squares in a few parameters between bounds, where each evaluation is dear: Levenberg's and Marquardt's method with central
//! differences.

use nalgebra::{DMatrix, DVector};

use crate::error::Result;

/// Half the distance of the central differences.
const DIFFERENCE: f64 = 0.02;
/// The longest change of a parameter in one iteration.
const LONGEST: f64 = 1.0;
/// Converged when no parameter would change by more than this.
const SHORTEST: f64 = 1e-6;
/// Or when the sum of squares would fall by less than this share of a sample's variance: a thousandth of a standard error.
const INSIGNIFICANT: f64 = 1e-6;
/// Damping beyond this means that no way down was found.
const LARGEST_DAMPING: f64 = 1e8;

/// The end of a search.
#[derive(Debug, Clone)]
pub struct Minimum {
    /// Where.
    pub parameters: Vec<f64>,
    /// The residuals there.
    pub residuals: DVector<f64>,
    /// Their derivatives, a column a parameter.
    pub jacobian: DMatrix<f64>,
    /// Whether it is a minimum (between the bounds).
    pub converged: bool,
}

impl Minimum {
    /// (JᵀJ)⁻¹ over the parameters that the residuals depend on; for the others the diagonal is infinite and the rest zero.
    pub fn covariance(&self) -> DMatrix<f64> {
        let normal = self.jacobian.transpose() * &self.jacobian;
        let live: Vec<usize> = (0..normal.nrows()).filter(|k| normal[(*k, *k)] > 0.0).collect();
        let mut covariance = DMatrix::zeros(normal.nrows(), normal.nrows());
        let part = DMatrix::from_fn(live.len(), live.len(), |i, j| normal[(live[i], live[j])]);
        let inverse = inverse_of_positive(&part);
        for k in 0..normal.nrows() {
            match (live.iter().position(|other| *other == k), &inverse) {
                (Some(i), Some(inverse)) => {
                    for (j, column) in live.iter().enumerate() {
                        covariance[(k, *column)] = inverse[(i, j)];
                    }
                }
                _ => covariance[(k, k)] = f64::INFINITY,
            }
        }
        covariance
    }
}

/// The inverse of a positive definite matrix, scaled before it is judged; `None` where rounding leaves nothing of it.
fn inverse_of_positive(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    if matrix.is_empty() {
        return None;
    }
    let scale = matrix.diagonal().map(f64::sqrt);
    let scaled = DMatrix::from_fn(matrix.nrows(), matrix.nrows(), |i, j| matrix[(i, j)] / (scale[i] * scale[j]));
    let smallest = scaled.clone().symmetric_eigenvalues().min();
    // Parameters that cannot be told apart.
    if smallest < 1e-12 {
        return None;
    }
    let inverse = scaled.cholesky()?.inverse();
    Some(DMatrix::from_fn(matrix.nrows(), matrix.nrows(), |i, j| inverse[(i, j)] / (scale[i] * scale[j])))
}

/// Residuals for each of several sets of parameters; `None` for a set that has none.
pub type Evaluate<'a> = dyn FnMut(&[Vec<f64>]) -> Result<Vec<Option<DVector<f64>>>> + 'a;

/// Searches from `start` within `bounds` (one pair a parameter), in parameters whose differences are to be thought of as relative
/// changes. The sets that differences are taken of may lie just outside the bounds. `None` if there are no residuals at the start.
///
/// # Errors
/// What `evaluate` gives.
pub fn minimise(start: &[f64], bounds: &[[f64; 2]], max_iterations: u32, evaluate: &mut Evaluate<'_>) -> Result<Option<Minimum>> {
    let mut parameters = start.to_vec();
    let Some(mut residuals) = evaluate(std::slice::from_ref(&parameters))?.swap_remove(0) else { return Ok(None) };
    let mut damping = 0.0;
    let mut jacobian = DMatrix::zeros(residuals.len(), parameters.len());
    for _ in 0..max_iterations {
        let Some(columns) = differences(&parameters, evaluate)? else { break };
        jacobian = DMatrix::from_columns(&columns);
        let (normal, slope) = (jacobian.transpose() * &jacobian, jacobian.transpose() * &residuals);
        let variance = residuals.norm_squared() / (residuals.len().saturating_sub(parameters.len()).max(1)) as f64;
        let free: Vec<usize> = (0..parameters.len())
            .filter(|k| normal[(*k, *k)] > 0.0)
            .filter(|k| {
                !(parameters[*k] <= bounds[*k][0] && slope[*k] > 0.0 || parameters[*k] >= bounds[*k][1] && slope[*k] < 0.0)
            })
            .collect();
        loop {
            let next = step(&parameters, bounds, &free, &normal, &slope, damping);
            let way = DVector::from_fn(next.len(), |k, _| next[k] - parameters[k]);
            let promised = -(2.0 * slope.dot(&way) + way.dot(&(&normal * &way)));
            if way.amax() < SHORTEST || promised < INSIGNIFICANT * variance {
                return Ok(Some(Minimum { parameters, residuals, jacobian, converged: true }));
            }
            if let Some(found) = evaluate(std::slice::from_ref(&next))?.swap_remove(0)
                && found.norm_squared() < residuals.norm_squared()
            {
                (parameters, residuals) = (next, found);
                damping = if damping < 1e-6 { 0.0 } else { damping / 10.0 };
                break;
            }
            damping = (damping * 10.0).max(1e-2);
            if damping > LARGEST_DAMPING {
                return Ok(Some(Minimum { parameters, residuals, jacobian, converged: false }));
            }
        }
    }
    if let Some(columns) = differences(&parameters, evaluate)? {
        jacobian = DMatrix::from_columns(&columns);
    }
    Ok(Some(Minimum { parameters, residuals, jacobian, converged: false }))
}

/// The damped step of Gauss and Newton in the free parameters, of bounded length, and kept between the bounds.
fn step(
    parameters: &[f64],
    bounds: &[[f64; 2]],
    free: &[usize],
    normal: &DMatrix<f64>,
    slope: &DVector<f64>,
    damping: f64,
) -> Vec<f64> {
    let mut next = parameters.to_vec();
    // A floor under the damping keeps parameters that cannot be told apart from running off.
    let lift = 1.0 + damping.max(1e-9);
    let part = DMatrix::from_fn(free.len(), free.len(), |i, j| normal[(free[i], free[j])] * if i == j { lift } else { 1.0 });
    let Some(factors) = part.cholesky() else { return next };
    let way = factors.solve(&DVector::from_fn(free.len(), |i, _| -slope[free[i]]));
    let shortened = if way.is_empty() { 1.0 } else { (LONGEST / way.amax()).min(1.0) };
    for (i, k) in free.iter().enumerate() {
        next[*k] = (parameters[*k] + shortened * way[i]).clamp(bounds[*k][0], bounds[*k][1]);
    }
    next
}

/// Derivatives of the residuals, a column a parameter; `None` where some could not be found.
fn differences(parameters: &[f64], evaluate: &mut Evaluate<'_>) -> Result<Option<Vec<DVector<f64>>>> {
    let mut sets = Vec::with_capacity(2 * parameters.len());
    for k in 0..parameters.len() {
        for sign in [1.0, -1.0] {
            let mut set = parameters.to_vec();
            set[k] += sign * DIFFERENCE;
            sets.push(set);
        }
    }
    let found = evaluate(&sets)?;
    Ok(found.chunks(2).map(|pair| Some((pair[0].as_ref()? - pair[1].as_ref()?) / (2.0 * DIFFERENCE))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A decaying oscillation e^(−a t) cos(b t) at 40 times, with a fixed error that no parameter can follow.
    fn decay(parameters: &[f64], error: f64) -> DVector<f64> {
        let (rate, turn) = (parameters[0].exp(), parameters[1].exp());
        DVector::from_fn(40, |i, _| {
            let t = 0.1 * i as f64;
            (-rate * t).exp() * (turn * t).cos() - (-0.7 * t).exp() * (3.0 * t).cos() + error * ((i * i * 7) as f64).sin()
        })
    }

    fn search(start: &[f64], bounds: &[[f64; 2]], error: f64) -> Minimum {
        minimise(start, bounds, 50, &mut |sets| Ok(sets.iter().map(|set| Some(decay(set, error))).collect())).unwrap().unwrap()
    }

    #[test]
    fn two_parameters_are_found_with_their_errors() {
        let bounds = [[-5.0, 5.0], [0.0, 2.0]];
        let exact = search(&[-2.0, 1.3], &bounds, 0.0);
        assert!(exact.converged);
        assert!((exact.parameters[0] - 0.7_f64.ln()).abs() < 1e-5 && (exact.parameters[1] - 3.0_f64.ln()).abs() < 1e-5);
        let noisy = search(&[-2.0, 1.3], &bounds, 0.05);
        assert!(noisy.converged);
        let variance = noisy.residuals.norm_squared() / 38.0;
        let covariance = noisy.covariance() * variance;
        for (k, truth) in [0.7_f64, 3.0].into_iter().enumerate() {
            let deviation = covariance[(k, k)].sqrt();
            assert!((noisy.parameters[k] - truth.ln()).abs() < 3.0 * deviation && deviation < 0.2, "{deviation}");
        }
        // At a minimum no derivative is left; they are central differences, exact to their square.
        let slope = noisy.jacobian.transpose() * &noisy.residuals;
        assert!(slope.amax() < 1e-3 * noisy.residuals.norm(), "{slope}");
    }

    #[test]
    fn bounds_hold_and_are_a_minimum_where_the_path_leads_out() {
        let found = search(&[1.0, 1.3], &[[0.0, 2.0], [0.0, 2.0]], 0.0);
        assert!(found.converged && found.parameters[0] == 0.0, "{:?}", found.parameters);
    }

    #[test]
    fn parameters_without_effect_have_no_error_bar() {
        let mut evaluate = |sets: &[Vec<f64>]| {
            Ok(sets.iter().map(|set| Some(DVector::from_fn(9, |i, _| set[0] - 0.1 * i as f64))).collect::<Vec<_>>())
        };
        let found = minimise(&[0.0, 0.3], &[[-1.0, 1.0]; 2], 50, &mut evaluate).unwrap().unwrap();
        assert!(found.converged && (found.parameters[0] - 0.4).abs() < 1e-6 && found.parameters[1] == 0.3);
        let covariance = found.covariance();
        assert!((covariance[(0, 0)] - 1.0 / 9.0).abs() < 1e-9 && covariance[(1, 1)].is_infinite());
    }

    #[test]
    fn indistinguishable_parameters_have_no_error_bar_either() {
        let mut evaluate = |sets: &[Vec<f64>]| {
            Ok(sets.iter().map(|set| Some(DVector::from_fn(9, |i, _| set[0] + set[1] - 0.1 * i as f64))).collect::<Vec<_>>())
        };
        let found = minimise(&[0.0, 0.3], &[[-1.0, 1.0]; 2], 50, &mut evaluate).unwrap().unwrap();
        assert!((found.parameters[0] + found.parameters[1] - 0.4).abs() < 1e-5, "{:?}", found.parameters);
        assert!(found.covariance()[(0, 0)].is_infinite());
    }
}
