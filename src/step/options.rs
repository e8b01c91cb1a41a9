//! How a step is taken: which integrator, which linear solve, how far Newton goes.

use crate::error::{Error, Result};
use crate::math::lane::Precision;
use crate::math::quadrature;

/// The time integrator of a solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u32)]
pub enum Integrator {
    /// The papers' step (Bertails et al. 2006, section 3.4): one linear solve, elasticity implicit, gravity, drag, internal
    /// friction γ and velocity products explicit. For calm scenes only: its limits are measured in `docs/theory/integrators.md`.
    LinearlyImplicit = 1,
    /// Implicit Euler: Newton on the incremental potential. First order: it damps, and forgives anything.
    ImplicitEuler = 2,
    /// Two-step backward differences on the same Newton: second order for the price of implicit Euler, and stable where that is.
    #[default]
    SecondOrder = 3,
    /// Radau IIA, order 5, in steps of its own that keep the error below [`StepOptions::reference_tolerance`]. Dense matrices: to
    /// measure the others by, not to animate with. Free strands only: a step is refused where strands may touch something or
    /// constraints hold them.
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
///
/// ```
/// use superhelix::{Precision, Solver, SolverOptions, StepOptions};
///
/// // Strands halve their step until it adds no more than a thousandth of their length to the error.
/// let step = StepOptions { error_tolerance: 1e-3, precision: Precision::F64, ..StepOptions::default() };
/// let solver = Solver::new(SolverOptions { step, ..SolverOptions::default() })?;
/// assert_eq!(solver.options().step.error_tolerance, 1e-3);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepOptions {
    /// Which integrator.
    pub integrator: Integrator,
    /// Which linear solve.
    pub linear_solver: LinearSolver,
    /// Newton iterations a solve at most, 1 to 10000. A strand that needs more is reported as unconverged.
    pub max_iterations: u32,
    /// Converged when no element is estimated to be further than this from where the iteration would end, rad; above zero. Newton
    /// converges quadratically, and the estimate counts on that (`docs/theory/newton.md`). In f32 also where only rounding moves it on; the
    /// outcome's residual then tells by how much, which may be above the tolerance (`docs/theory/lanes.md`).
    pub tolerance: f64,
    /// Newton's matrix is the exact Hessian (tension included). False: Gauss–Newton, for comparison.
    pub exact_hessian: bool,
    /// [`Integrator::Reference`] only: the error allowed in positions, in units of the strand's length, for each second of simulated
    /// time; 1e-12 to 1e-2. What a motion makes of an earlier error is not in it. Below 1e-11 rounding has a say.
    pub reference_tolerance: f64,
    /// How often a strand's step may be halved where it does not converge, turns non-finite or errs by more than `error_tolerance`; only
    /// that strand takes it in parts. Strands that touches hold do so, with those that hang together with them, where the hard models leave them
    /// deep; twenty of them and fewer whenever they do not converge. More than twenty take halves only. 0 to 10; 0: never. [`Integrator::ImplicitEuler`] and [`Integrator::SecondOrder`] only.
    pub max_subdivisions: u32,
    /// The error that a step, or a part of it, may add to a point's position before it is halved, in units of the strand's length; at
    /// least 0. 0: errors are not looked at, and cost nothing. It is estimated from the step itself. Where the halvings do not
    /// suffice the step is taken nevertheless, and [`StrandOutcome::error`](super::StrandOutcome::error) tells.
    pub error_tolerance: f64,
    /// The precision of the step's arithmetic. [`Precision::F32`] is for [`LinearSolver::LinearTime`] and not for
    /// [`Integrator::Reference`]; what it is good for is in `docs/theory/lanes.md`. States are kept in f64 either way.
    pub precision: Precision,
    /// What the integrals along an element (inertia, drag, weight) may err by, relative; 1e-12 to 1e-2. It decides how many quadrature
    /// points the elements of a strand get, by the most turned of them, and with that time and memory: `docs/theory/mathematics.md` has the
    /// table. No rule has more than 128 points: beyond a turn of about 200 rad the tolerance is missed, and
    /// [`Solver::quadrature`](crate::solver::Solver::quadrature) tells by how much. [`Integrator::Reference`] uses finer rules of its own.
    pub quadrature_tolerance: f64,
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
            max_subdivisions: 3,
            error_tolerance: 0.0,
            precision: Precision::F64,
            quadrature_tolerance: quadrature::DEFAULT_TOLERANCE,
        }
    }
}

impl StepOptions {
    /// Whether the linear systems are solved by elimination.
    pub fn is_linear_time(&self) -> bool {
        self.linear_solver == LinearSolver::LinearTime
    }

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
        if self.max_subdivisions > 10 {
            return Err(Error::invalid(format!("{argument}.max_subdivisions"), self.max_subdivisions, "0 to 10"));
        }
        if !(self.error_tolerance.is_finite() && self.error_tolerance >= 0.0) {
            return Err(Error::invalid(
                format!("{argument}.error_tolerance"),
                self.error_tolerance,
                "a finite number, 0 or more (of the strand's length, per step)",
            ));
        }
        let in_f64 = self.linear_solver != LinearSolver::LinearTime || self.integrator == Integrator::Reference;
        if self.precision == Precision::F32 && in_f64 {
            return Err(Error::Unsupported {
                argument: format!("{argument}.precision"),
                value: "f32".into(),
                hint: "dense linear solvers and the reference integrator compute in f64".into(),
            });
        }
        quadrature::check_tolerance(&format!("{argument}.quadrature_tolerance"), self.quadrature_tolerance)?;
        Ok(())
    }
}
