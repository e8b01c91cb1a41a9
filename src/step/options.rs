//! How a step is taken: which integrator, which linear solve, how far Newton goes.

use crate::error::{Error, Result};

/// The time integrator of a solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u32)]
pub enum Integrator {
    /// The papers' step (Bertails et al. 2006, section 3.4): one linear solve, elasticity implicit, gravity, drag, internal
    /// friction γ and velocity products explicit. For calm scenes only: its limits are measured in `docs/integrators.md`.
    LinearlyImplicit = 1,
    /// Implicit Euler: Newton on the incremental potential. First order: it damps, and forgives anything.
    ImplicitEuler = 2,
    /// Two-step backward differences on the same Newton: second order for the price of implicit Euler, and stable where that is.
    #[default]
    SecondOrder = 3,
    /// Radau IIA, order 5, in steps of its own that keep the error below [`StepOptions::reference_tolerance`]. Dense matrices: to
    /// measure the others by, not to animate with.
    Reference = 4,
}

impl Integrator {
    /// The integrator of that number, as the C ABI and snapshots have it.
    pub fn from_u32(value: u32) -> Option<Self> {
        [Self::LinearlyImplicit, Self::ImplicitEuler, Self::SecondOrder, Self::Reference]
            .into_iter()
            .find(|candidate| *candidate as u32 == value)
    }
}

/// How a strand's linear systems are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u32)]
pub enum LinearSolver {
    /// Elimination from tip to root: cost proportional to the number of elements.
    #[default]
    LinearTime = 1,
    /// The dense matrix by Cholesky's factorisation (document 004, "LL"); an indefinite one is repaired by its eigenvalues.
    DenseCholesky = 2,
    /// The dense matrix by conjugate gradients with a diagonal preconditioner (paper 000, section 3.4; document 004, "PCG").
    DenseConjugateGradients = 3,
    /// The dense matrix by singular values (document 004, "SVD"); the step report carries the largest condition number.
    DenseSingularValues = 4,
}

impl LinearSolver {
    /// The solver of that number, as the C ABI and snapshots have it.
    pub fn from_u32(value: u32) -> Option<Self> {
        [Self::LinearTime, Self::DenseCholesky, Self::DenseConjugateGradients, Self::DenseSingularValues]
            .into_iter()
            .find(|candidate| *candidate as u32 == value)
    }
}

/// The knobs of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepOptions {
    /// Which integrator.
    pub integrator: Integrator,
    /// Which linear solve.
    pub linear_solver: LinearSolver,
    /// Newton iterations a solve at most, 1 to 10000. A strand that needs more is reported as unconverged.
    pub max_iterations: u32,
    /// Converged when no element turns by more than this in an iteration, rad; above zero. Newton's convergence is quadratic: what is
    /// left after an iteration that turned by 1e-3 is of the order of 1e-6.
    pub tolerance: f64,
    /// Newton's matrix is the exact Hessian (tension included). False: Gauss–Newton, for comparison.
    pub exact_hessian: bool,
    /// [`Integrator::Reference`] only: the error allowed in positions, in units of the strand's length, for each second of simulated
    /// time; 1e-12 to 1e-2. What a motion makes of an earlier error is not in it. Below 1e-11 rounding has a say.
    pub reference_tolerance: f64,
}

impl Default for StepOptions {
    fn default() -> Self {
        Self {
            integrator: Integrator::default(),
            linear_solver: LinearSolver::default(),
            max_iterations: 50,
            tolerance: 1e-6,
            exact_hessian: true,
            reference_tolerance: 1e-8,
        }
    }
}

impl StepOptions {
    /// Checks every value; `argument` is the name put before the field in the message.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        if !(1..=10_000).contains(&self.max_iterations) {
            return Err(Error::invalid(format!("{argument}.max_iterations"), self.max_iterations, "1 to 10000"));
        }
        if !(self.tolerance.is_finite() && self.tolerance > 0.0) {
            return Err(Error::invalid(format!("{argument}.tolerance"), self.tolerance, "a finite number above zero (rad)"));
        }
        if !(1e-12..=1e-2).contains(&self.reference_tolerance) {
            return Err(Error::invalid(
                format!("{argument}.reference_tolerance"),
                self.reference_tolerance,
                "1e-12 to 1e-2 (of the strand's length, per second)",
            ));
        }
        Ok(())
    }
}
