//! Radau IIA of three stages (order 5, L-stable, stiffly accurate) on M(q) q̈ = f(q, q̇, t).
//!
//! The unknowns are the stages' accelerations, and M is never inverted: a curvature without inertia (twist of a straight strand)
//! simply follows its equation.

use faer::Mat;
use faer::linalg::solvers::{PartialPivLu, Solve};

use super::dynamics::{Derivatives, Dynamics, Rows};

const STAGES: usize = 3;
/// √6.
const S6: f64 = 2.449_489_742_783_178;
const A: [[f64; STAGES]; STAGES] = [
    [(88.0 - 7.0 * S6) / 360.0, (296.0 - 169.0 * S6) / 1800.0, (-2.0 + 3.0 * S6) / 225.0],
    [(296.0 + 169.0 * S6) / 1800.0, (88.0 + 7.0 * S6) / 360.0, (-2.0 - 3.0 * S6) / 225.0],
    [(16.0 - S6) / 36.0, (16.0 + S6) / 36.0, 1.0 / 9.0],
];
const TIMES: [f64; STAGES] = [(4.0 - S6) / 10.0, (4.0 + S6) / 10.0, 1.0];
/// The classical order.
pub const ORDER: i32 = 5;
/// An iteration that no longer contracts and changes by less than this (in the measure of `Step::solve`) has reached rounding.
const ROUNDING: f64 = 1e-11;

/// An iteration that contracts more slowly gets the stages' own derivatives instead of those at the start of the step.
const SLOW: f64 = 0.1;

/// An entry of A².
fn squared(i: usize, j: usize) -> f64 {
    (0..STAGES).map(|k| A[i][k] * A[k][j]).sum()
}

/// A strand's state of motion, in curvatures.
#[derive(Debug, Clone)]
pub struct Motion {
    /// q.
    pub curvatures: Rows,
    /// q̇.
    pub rates: Rows,
    /// q̈.
    pub accelerations: Rows,
}

/// Newton's matrix for stages with derivatives of their own.
fn factorise(derivatives: [&Derivatives; STAGES], h: f64) -> PartialPivLu<f64> {
    let size = derivatives[0].inertia.nrows();
    let matrix = Mat::from_fn(STAGES * size, STAGES * size, |row, column| {
        let (i, j, r, c) = (row / size, column / size, row % size, column % size);
        // In units of h² q̈: divided by h².
        let own = if i == j { derivatives[i].inertia[(r, c)] / (h * h) } else { 0.0 };
        own + squared(i, j) * derivatives[i].by_position[(r, c)] + A[i][j] / h * derivatives[i].by_rate[(r, c)]
    });
    matrix.partial_piv_lu()
}

/// The factorised matrix for steps of one size.
pub struct Step {
    h: f64,
    factor: PartialPivLu<f64>,
}

/// How a step's iteration ended.
pub struct Solved {
    /// Newton iterations.
    pub iterations: u32,
    /// The end of the step, if the iteration converged.
    pub motion: Option<Motion>,
    /// The last iteration's change, rad.
    pub residual: f64,
}

impl Step {
    /// Factorises the matrix of simplified Newton iterations for steps of `h` seconds.
    pub fn new(derivatives: &Derivatives, h: f64) -> Self {
        Self { h, factor: factorise([derivatives; STAGES], h) }
    }

    /// Advances `from` by one step from time `t`. Converged when the sum of the elements' turns in an iteration, and of the
    /// changes of their turning rates times `time_scale`, is below `tolerance` (rad), or at rounding.
    pub fn solve(
        &self,
        dynamics: &Dynamics,
        from: &Motion,
        t: f64,
        tolerance: f64,
        time_scale: f64,
        max_iterations: u32,
    ) -> Solved {
        let (h, size) = (self.h, dynamics.size());
        let lengths = &dynamics.model.lengths;
        let mut stages = vec![from.accelerations.clone(); STAGES];
        let weigh = 1.0 + time_scale / h;
        let mut solved = Solved { iterations: 0, motion: None, residual: 0.0 };
        let mut last = f64::INFINITY;
        let mut refined: Option<PartialPivLu<f64>> = None;
        for iteration in 1..=max_iterations {
            solved.iterations = iteration;
            let mut rhs = Mat::zeros(STAGES * size, 1);
            for i in 0..STAGES {
                let (q, w) = self.stage(i, dynamics, from, &stages);
                let residual = dynamics.residual(t + TIMES[i] * h, &q, &w, &stages[i]);
                for (row, value) in residual.iter().enumerate() {
                    if !value.is_finite() {
                        return solved;
                    }
                    rhs[(i * size + row, 0)] = -value;
                }
            }
            let change = refined.as_ref().unwrap_or(&self.factor).solve(&rhs);
            let mut sum = 0.0;
            for i in 0..STAGES {
                for index in 0..size {
                    let (element, axis) = dynamics.freedom(index);
                    let angle = change[(i * size + index, 0)];
                    stages[i][element][axis] += angle / (h * h * lengths[element]);
                    sum += angle.abs();
                }
            }
            if !sum.is_finite() {
                return solved;
            }
            solved.residual = sum;
            let measure = weigh * sum;
            let contraction = measure / last;
            // The remaining error after this iteration, as a geometric series; the first iteration gives no estimate.
            let left = if iteration > 1 && contraction < 0.9 { measure * contraction / (1.0 - contraction) } else { measure };
            let at_rounding = contraction > 0.3 && measure <= ROUNDING * weigh.max(1.0);
            if left.min(measure) <= tolerance || at_rounding {
                let (curvatures, rates) = self.stage(STAGES - 1, dynamics, from, &stages);
                let accelerations = stages.swap_remove(STAGES - 1);
                solved.motion = Some(Motion { curvatures, rates, accelerations });
                return solved;
            }
            if iteration > 3 && contraction > 0.9 && refined.is_some() {
                return solved;
            }
            if iteration > 1 && contraction > SLOW {
                let own = std::array::from_fn::<_, STAGES, _>(|i| {
                    let (q, w) = self.stage(i, dynamics, from, &stages);
                    dynamics.derivatives(t + TIMES[i] * h, &q, &w, &stages[i])
                });
                refined = Some(factorise(own.each_ref(), h));
            }
            last = measure;
        }
        solved
    }

    /// Curvatures and rates of a stage.
    fn stage(&self, i: usize, dynamics: &Dynamics, from: &Motion, stages: &[Rows]) -> (Rows, Rows) {
        let h = self.h;
        let (mut q, mut w) = (from.curvatures.clone(), from.rates.clone());
        for index in 0..dynamics.size() {
            let (element, axis) = dynamics.freedom(index);
            let (mut position, mut rate) = (0.0, 0.0);
            for j in 0..STAGES {
                position += squared(i, j) * stages[j][element][axis];
                rate += A[i][j] * stages[j][element][axis];
            }
            q[element][axis] += h * (TIMES[i] * from.rates[element][axis] + h * position);
            w[element][axis] += h * rate;
        }
        (q, w)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_collocation_conditions_hold() {
        for i in 0..STAGES {
            for k in 0..STAGES as i32 {
                let sum: f64 = (0..STAGES).map(|j| A[i][j] * TIMES[j].powi(k)).sum();
                assert!((sum - TIMES[i].powi(k + 1) / f64::from(k + 1)).abs() < 1e-15);
            }
        }
        for k in 0..ORDER {
            let sum: f64 = (0..STAGES).map(|j| A[2][j] * TIMES[j].powi(k)).sum();
            assert!((sum - 1.0 / f64::from(k + 1)).abs() < 1e-15);
        }
    }
}
