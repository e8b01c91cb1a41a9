//! Options of a step: integrator, linear solve, tolerances.

use crate::error::{Error, Result};
use crate::math::lane::Precision;
use crate::math::quadrature;

/// The time integrator of a solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u32)]
pub enum Integrator {
    /// The linearly implicit step of the papers (Bertails et al. 2006, section 3.4): one linear solve; elasticity implicit;
    /// gravity, drag, internal friction γ and velocity products explicit. For calm scenes only: `docs/theory/integrators.md`
    /// measures its limits.
    LinearlyImplicit = 1,
    /// Implicit Euler: Newton on the incremental potential. First order, dissipative and robust.
    ImplicitEuler = 2,
    /// Two-step backward differences with the same Newton iteration: second order at the cost of implicit Euler, and equally
    /// stable.
    #[default]
    SecondOrder = 3,
    /// Radau IIA of order 5, in adaptive steps that keep the error below [`StepOptions::reference_tolerance`]. Uses dense
    /// matrices: a yardstick for the others, not for animation. For free strands only: a step fails where strands may be in
    /// contact or have constraints.
    Reference = 4,
}

impl Integrator {
    /// The integrator of this number in the C ABI and in snapshots.
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
    /// The dense matrix by Cholesky's factorisation (Bergbom 2007, "LL"); eigenvalues repair an indefinite one.
    DenseCholesky = 2,
    /// The dense matrix by conjugate gradients with a diagonal preconditioner (Bertails et al. 2006, section 3.4; Bergbom 2007,
    /// "PCG").
    DenseConjugateGradients = 3,
    /// The dense matrix by singular values (Bergbom 2007, "SVD"); the step report has the largest condition number.
    DenseSingularValues = 4,
}

impl LinearSolver {
    /// The solver of this number in the C ABI and in snapshots.
    pub fn from_u32(value: u32) -> Option<Self> {
        [Self::LinearTime, Self::DenseCholesky, Self::DenseConjugateGradients, Self::DenseSingularValues]
            .into_iter()
            .find(|candidate| *candidate as u32 == value)
    }
}

/// Options of a step.
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
    /// Largest number of Newton iterations per solve, 1 to 10000. A strand that needs more is reported as unconverged.
    pub max_iterations: u32,
    /// Converged when the estimated distance of every element from where the iteration would end is below this, rad; above zero.
    /// The estimate relies on Newton's quadratic convergence (`docs/theory/newton.md`). In f32 a strand also converges where only
    /// rounding still moves it; the outcome's residual then says by how much, possibly more than the tolerance
    /// (`docs/theory/lanes.md`).
    pub tolerance: f64,
    /// Newton's matrix is the exact Hessian (tension included). False: Gauss–Newton, for comparison.
    pub exact_hessian: bool,
    /// [`Integrator::Reference`] only: the permitted error of positions per second of simulated time, relative to the strand's
    /// length; 1e-12 to 1e-2. It excludes the growth of earlier errors by the motion. Below 1e-11 rounding dominates.
    pub reference_tolerance: f64,
    /// How often a strand's step may be halved where it does not converge, turns non-finite or errs by more than
    /// `error_tolerance`; only that strand takes substeps. Strands in contact do so, together with their island, where hard
    /// contact leaves them deep, and islands of at most twenty strands whenever they do not converge. Larger islands take halves
    /// only. 0 to 10; 0 for never. [`Integrator::ImplicitEuler`] and [`Integrator::SecondOrder`] only.
    pub max_subdivisions: u32,
    /// The error that a step or substep may add to a point's position before it is halved, relative to the strand's length; at
    /// least 0. At 0 no error is estimated, at no cost. The estimate comes from the step itself. Where the halvings are not
    /// enough the step is taken nevertheless, and [`StrandOutcome::error`](super::StrandOutcome::error) gives its error.
    pub error_tolerance: f64,
    /// The precision of the step's arithmetic. [`Precision::F32`] works with [`LinearSolver::LinearTime`] and not with
    /// [`Integrator::Reference`]; `docs/theory/lanes.md` says what it is good for. States are kept in f64 either way.
    pub precision: Precision,
    /// Relative tolerance of the integrals along an element (inertia, drag, weight), 1e-12 to 1e-2. With the most turned element
    /// it decides how many quadrature points the elements of a strand get, and so time and memory: `docs/theory/mathematics.md`
    /// has the table. No rule has more than 128 points: beyond a turn of about 200 rad the tolerance cannot be met, and
    /// [`Solver::quadrature`](crate::solver::Solver::quadrature) gives the error. [`Integrator::Reference`] uses finer rules of
    /// its own.
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
    /// Whether elimination solves the linear systems.
    pub fn is_linear_time(&self) -> bool {
        self.linear_solver == LinearSolver::LinearTime
    }

    /// Checks every value; messages put `argument` before the field's name.
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
