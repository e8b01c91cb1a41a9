//! The loop of Levenberg and Marquardt's method: iterations of trial steps with more and more damping, until one of them lowers the cost.

/// What is minimised: a state with a cost, and a trial beside it. How steps are made, and how much damping they have, is its own affair.
pub(crate) trait DampedLeastSquares {
    /// The cost of the state.
    fn cost(&self) -> f64;
    /// Prepares an iteration; false where the state is good enough.
    fn begin(&mut self) -> bool;
    /// Makes the step that the present damping allows, and places the trial at its end.
    fn trial(&mut self) -> Trial;
    /// Takes the trial for the state, and adapts the damping to `ratio`, the fall of the cost over the one that the model promised.
    fn accept(&mut self, ratio: f64);
    /// Damps more, after a trial that did not lower the cost.
    fn damp(&mut self);
    /// Whether an iteration that lowered the cost by this fraction of it (0: not at all) was the last.
    fn ends(&mut self, gained: f64) -> bool;
}

/// What came of a trial.
pub(crate) enum Trial {
    /// The model promises nothing more.
    Exhausted,
    /// The step is too long to say anything.
    TooLong,
    /// The cost at the trial, and by how much the model promised to lower it.
    Placed { cost: f64, promised: f64 },
}

/// Iterates at most `iterations` times, each with at most `trials` steps.
pub(crate) fn minimise(problem: &mut impl DampedLeastSquares, iterations: usize, trials: usize) {
    for _ in 0..iterations {
        if !problem.begin() {
            break;
        }
        let gained = iterate(problem, trials);
        if problem.ends(gained) {
            break;
        }
    }
}

/// Lowers the cost by a step; returns by which fraction of it.
fn iterate(problem: &mut impl DampedLeastSquares, trials: usize) -> f64 {
    for _ in 0..trials {
        match problem.trial() {
            Trial::Exhausted => break,
            Trial::TooLong => {}
            Trial::Placed { cost, promised } => {
                let before = problem.cost();
                let fall = before - cost;
                if fall > 0.0 {
                    problem.accept(fall / promised);
                    return fall / before;
                }
            }
        }
        problem.damp();
    }
    0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley as two residuals, 10 (y − x²) and 1 − x.
    struct Valley {
        at: [f64; 2],
        next: [f64; 2],
        damping: f64,
        trials: usize,
    }

    fn residuals([x, y]: [f64; 2]) -> [f64; 2] {
        [10.0 * (y - x * x), 1.0 - x]
    }

    fn cost(at: [f64; 2]) -> f64 {
        let [a, b] = residuals(at);
        0.5 * (a * a + b * b)
    }

    impl DampedLeastSquares for Valley {
        fn cost(&self) -> f64 {
            cost(self.at)
        }

        fn begin(&mut self) -> bool {
            self.cost() > 1e-24
        }

        fn trial(&mut self) -> Trial {
            self.trials += 1;
            let ([a, b], x) = (residuals(self.at), self.at[0]);
            // Jᵀ J + k I and −Jᵀ r, J = [−20 x, 10; −1, 0].
            let (m00, m01, m11) = (400.0 * x * x + 1.0 + self.damping, -200.0 * x, 100.0 + self.damping);
            let (g0, g1) = (20.0 * x * a + b, -10.0 * a);
            let determinant = m00 * m11 - m01 * m01;
            let step = [(m11 * g0 - m01 * g1) / determinant, (m00 * g1 - m01 * g0) / determinant];
            self.next = [self.at[0] + step[0], self.at[1] + step[1]];
            let promised = 0.5 * (step[0] * g0 + step[1] * g1 + self.damping * (step[0] * step[0] + step[1] * step[1]));
            if promised > 0.0 { Trial::Placed { cost: cost(self.next), promised } } else { Trial::Exhausted }
        }

        fn accept(&mut self, ratio: f64) {
            assert!(ratio > 0.0);
            (self.at, self.damping) = (self.next, self.damping / 10.0);
        }

        fn damp(&mut self) {
            self.damping = (10.0 * self.damping).max(1e-3);
        }

        fn ends(&mut self, gained: f64) -> bool {
            gained == 0.0
        }
    }

    #[test]
    fn the_valley_is_followed_to_its_lowest_point() {
        let mut valley = Valley { at: [-1.2, 1.0], next: [0.0; 2], damping: 1e-3, trials: 0 };
        minimise(&mut valley, 100, 10);
        assert!((valley.at[0] - 1.0).abs() < 1e-9 && (valley.at[1] - 1.0).abs() < 1e-9, "{:?}", valley.at);
        assert!(valley.trials > 5);
    }

    #[test]
    fn trials_are_bounded_where_none_lowers_the_cost() {
        struct Flat(usize);
        impl DampedLeastSquares for Flat {
            fn cost(&self) -> f64 {
                1.0
            }
            fn begin(&mut self) -> bool {
                true
            }
            fn trial(&mut self) -> Trial {
                if self.0.is_multiple_of(2) { Trial::TooLong } else { Trial::Placed { cost: 1.0, promised: 1.0 } }
            }
            fn accept(&mut self, _: f64) {
                unreachable!("nothing is gained");
            }
            fn damp(&mut self) {
                self.0 += 1;
            }
            fn ends(&mut self, gained: f64) -> bool {
                gained == 0.0
            }
        }
        let mut flat = Flat(0);
        minimise(&mut flat, 100, 7);
        assert_eq!(flat.0, 7);
    }
}
