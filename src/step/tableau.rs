//! Singly diagonally implicit Runge–Kutta methods, stiffly accurate and L-stable: the time integrators that share one Newton.
//!
//! Each stage is an implicit Euler step of γh from a displaced start (see `step::stages`), so that a method is no more than a small
//! table. The last stage is the step's end: nothing is recombined, and twist, which has no inertia on a straight strand, is where the
//! last stage's equations put it.

/// The most stages that a table has.
pub const MAX_STAGES: usize = 3;

/// One method: stage i is at time cᵢh and starts from r_t + h Σⱼ aᵢⱼ Vⱼ, v_t + h Σⱼ aᵢⱼ Aⱼ over the stages j before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tableau {
    /// Number of stages.
    pub stages: usize,
    /// γ, the diagonal.
    pub gamma: f64,
    /// Times of the stages in steps; the last is 1.
    pub times: [f64; MAX_STAGES],
    /// aᵢⱼ below the diagonal.
    pub below: [[f64; MAX_STAGES]; MAX_STAGES],
}

/// Implicit Euler: first order.
pub const IMPLICIT_EULER: Tableau =
    Tableau { stages: 1, gamma: 1.0, times: [1.0, 0.0, 0.0], below: [[0.0; MAX_STAGES]; MAX_STAGES] };

/// γ = 1 − 1/√2.
const GAMMA_2: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// Two stages, second order (Alexander 1977): error constant a fifth of BDF2's, no history, any change of step.
pub const SECOND_ORDER: Tableau = Tableau {
    stages: 2,
    gamma: GAMMA_2,
    times: [GAMMA_2, 1.0, 0.0],
    below: [[0.0; MAX_STAGES], [1.0 - GAMMA_2, 0.0, 0.0], [0.0; MAX_STAGES]],
};

/// The root near 0.436 of γ³ − 3γ² + 3γ/2 − 1/6.
const GAMMA_3: f64 = 0.435_866_521_508_459;

/// Three stages, third order (Alexander 1977).
pub const THIRD_ORDER: Tableau = Tableau {
    stages: 3,
    gamma: GAMMA_3,
    times: [GAMMA_3, 0.5 * (1.0 + GAMMA_3), 1.0],
    below: [
        [0.0; MAX_STAGES],
        [0.5 * (1.0 - GAMMA_3), 0.0, 0.0],
        [-0.25 * (6.0 * GAMMA_3 * GAMMA_3 - 16.0 * GAMMA_3 + 1.0), 0.25 * (6.0 * GAMMA_3 * GAMMA_3 - 20.0 * GAMMA_3 + 5.0), 0.0],
    ],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// Σ bᵢ cᵢᵏ = 1/(k + 1) and, for third order, Σ bᵢ aᵢⱼ cⱼ = 1/6: the order conditions; b is the last row.
    #[test]
    fn order_conditions_hold() {
        for (table, order) in [(IMPLICIT_EULER, 1), (SECOND_ORDER, 2), (THIRD_ORDER, 3)] {
            let last = table.stages - 1;
            let a = |i: usize, j: usize| if i == j { table.gamma } else { table.below[i][j] };
            for i in 0..table.stages {
                let row: f64 = (0..=i).map(|j| a(i, j)).sum();
                assert!((row - table.times[i]).abs() < 1e-15, "{table:?}");
            }
            for k in 0..order {
                let sum: f64 = (0..table.stages).map(|i| a(last, i) * table.times[i].powi(k)).sum();
                assert!((sum - 1.0 / f64::from(k + 1)).abs() < 1e-14, "{table:?} {k}");
            }
            if order == 3 {
                let mut sum = 0.0;
                for i in 0..table.stages {
                    for j in 0..=i {
                        sum += a(last, i) * a(i, j) * table.times[j];
                    }
                }
                assert!((sum - 1.0 / 6.0).abs() < 1e-14);
            }
            assert_eq!(table.times[last], 1.0);
        }
    }
}
