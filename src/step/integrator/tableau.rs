//! Singly diagonally implicit Runge–Kutta methods, stiffly accurate and L-stable, that share one Newton.
//!
//! Each stage is an implicit Euler step of γh from a displaced start (see `step::stages`), so a method is no more than a small
//! table. The last stage is the end of the step: nothing is recombined, and twist, which has no inertia on a straight strand,
//! follows the last stage's equations.

/// The most stages of any table.
pub const MAX_STAGES: usize = 2;

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
pub const IMPLICIT_EULER: Tableau = Tableau { stages: 1, gamma: 1.0, times: [1.0, 0.0], below: [[0.0; MAX_STAGES]; MAX_STAGES] };

/// γ = 1 − 1/√2.
const GAMMA_2: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// Two stages (Alexander 1977), second order on ordinary differential equations. The shape of a strand constrains its points
/// (index 3). On such a system every method of this kind keeps its order in the position over one step and loses one in the
/// velocity, and over many steps it is of first order (`docs/theory/integrators.md`). It starts the two-step method, where that
/// does not show.
pub const TWO_STAGES: Tableau =
    Tableau { stages: 2, gamma: GAMMA_2, times: [GAMMA_2, 1.0], below: [[0.0; MAX_STAGES], [1.0 - GAMMA_2, 0.0]] };

#[cfg(test)]
mod tests {
    use super::*;

    /// Σ bᵢ cᵢᵏ = 1/(k + 1): the order conditions; b is the last row.
    #[test]
    fn order_conditions_hold() {
        for (table, order) in [(IMPLICIT_EULER, 1), (TWO_STAGES, 2)] {
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
            assert_eq!(table.times[last], 1.0);
        }
    }
}
