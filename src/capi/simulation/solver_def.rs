//! Definitions of solvers.

use std::ffi::c_void;
use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use crate::capi::base::errors::shx_result;
use crate::capi::base::log::{LogSink, SHX_LOG_DEBUG, SHX_LOG_ERROR, SHX_LOG_WARN, shx_log_fn};
use crate::capi::base::parallel::{shx_parallel_for_fn, workers};
use crate::capi::base::versioned::{Versioned, initialise};
use crate::contact::options::ContactOptions;
use crate::error::{Error, Result};
use crate::math::lane::Precision;
use crate::math::lanes::InstructionSet;
use crate::solver::definition::{SolverOptions, UsualLimits};
use crate::step::options::{Integrator, LinearSolver, StepOptions};

/// Linearly implicit step (Bertails et al. 2006): one linear solve per step; gravity, drag and velocity
/// products are explicit. Fast, for calm scenes only.
pub const SHX_INTEGRATOR_LINEARLY_IMPLICIT: u32 = 1;
/// Implicit Euler: Newton's method minimises the incremental
/// potential. First order, strongly damped, the most robust.
pub const SHX_INTEGRATOR_IMPLICIT_EULER: u32 = 2;
/// BDF2: two-step backward differences, second order in the
/// step size, as cheap as implicit Euler. The default.
pub const SHX_INTEGRATOR_SECOND_ORDER: u32 = 3;
/// Radau IIA, order 5, with its own error control: meets reference_tolerance. Slow: use
/// it to measure the other integrators. Free strands only: shx_solver_step fails if
/// strands can come into contact or have constraints.
pub const SHX_INTEGRATOR_REFERENCE: u32 = 4;

/// Elimination from tip to root. Cost is proportional to the number of elements. The default.
pub const SHX_LINEAR_SOLVER_LINEAR_TIME: u32 = 1;
/// Dense matrix, Cholesky factorisation. The dense solvers are
/// references for tests, and slow for many elements.
pub const SHX_LINEAR_SOLVER_DENSE_CHOLESKY: u32 = 2;
/// Dense matrix, conjugate gradients.
pub const SHX_LINEAR_SOLVER_DENSE_CG: u32 = 3;
/// Dense matrix, singular value decomposition. The step report has the largest condition number.
pub const SHX_LINEAR_SOLVER_DENSE_SVD: u32 = 4;

/// Double precision. The default.
pub const SHX_PRECISION_F64: u32 = 1;
/// Single precision: twice as many strands in each vector register. Use it for substeps of 1/240 s or longer
/// and up to 200 elements per strand. After seconds of walking it stays within 1e-3 of a strand's length of
/// double precision, mostly within 1e-4 (docs/theory/lanes.md). Shorter substeps accumulate more rounding
/// error. Requires SHX_LINEAR_SOLVER_LINEAR_TIME; SHX_INTEGRATOR_REFERENCE does not support it.
pub const SHX_PRECISION_F32: u32 = 2;

/// The best vector instructions of this machine. The default.
pub const SHX_INSTRUCTION_SET_BEST: u32 = 0;
/// No vector instructions: one strand at a time.
pub const SHX_INSTRUCTION_SET_SCALAR: u32 = 1;
/// What every machine of the architecture has: SSE2 on x86-64, NEON on AArch64.
pub const SHX_INSTRUCTION_SET_BASELINE: u32 = 2;
/// AVX2.
pub const SHX_INSTRUCTION_SET_AVX2: u32 = 3;
/// AVX-512 (F, BW, DQ, VL).
pub const SHX_INSTRUCTION_SET_AVX512: u32 = 4;

/// Definition of a solver. Fill it with shx_solver_def_init, then change what you need.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_solver_def {
    /// Set by shx_solver_def_init.
    pub struct_size: u32,
    /// Number of threads, at most 256. 0 or 1 (default): the calling thread. More: the calling thread and a
    /// private pool of the others, which lives as long as the solver. With parallel_for: the number of threads
    /// your tasks run on, for information. Results are identical to the bit for any number.
    pub worker_count: u32,
    /// Gravity, m/s^2. Default (0, 0, -9.81): z is up. With y up: (0, -9.81, 0).
    pub gravity: [f64; 3],
    /// Uniform wind, m/s. It acts on strands that have air_drag. Default 0.
    pub wind: [f64; 3],
    /// Your task system. Default null: none.
    pub parallel_for: shx_parallel_for_fn,
    /// User pointer of parallel_for.
    pub parallel_for_user: *mut c_void,
    /// Receives messages. Default null: none.
    pub log: shx_log_fn,
    /// User pointer of log.
    pub log_user: *mut c_void,
    /// Messages up to this level go to log: SHX_LOG_ERROR to SHX_LOG_DEBUG. Default SHX_LOG_WARN.
    pub log_level: u32,
    /// SHX_INTEGRATOR_. Default SHX_INTEGRATOR_SECOND_ORDER.
    pub integrator: u32,
    /// SHX_LINEAR_SOLVER_. Default SHX_LINEAR_SOLVER_LINEAR_TIME.
    pub linear_solver: u32,
    /// SHX_PRECISION_. Default SHX_PRECISION_F64.
    pub precision: u32,
    /// Maximum number of Newton iterations per substep, 1 to 10000. Default 50. A
    /// strand that needs more is reported as unconverged.
    pub max_iterations: u32,
    /// 1 (default): Newton's method uses the exact Hessian, tension included. 0: Gauss-Newton, for comparison.
    pub exact_hessian: u32,
    /// Newton's method has converged when no element is estimated to be farther than this
    /// from the solution, rad; above zero. Default 1e-6.
    pub tolerance: f64,
    /// How many times a strand's substep may be halved, 0 to 10, if it does not converge, becomes non-finite
    /// or exceeds error_tolerance. Only that strand is subdivided. Default 3; 0: never. Strands in contact
    /// are subdivided with their whole island: where SHX_CONTACT_COULOMB leaves surfaces too deep in each
    /// other, and islands of up to 20 strands whenever they do not converge; larger islands are halved once
    /// only. Applies to implicit Euler and second order.
    pub max_subdivisions: u32,
    /// SHX_INSTRUCTION_SET_. Default SHX_INSTRUCTION_SET_BEST. Results are identical to the bit for all of them.
    /// One that the machine does not have is SHX_ERROR_UNSUPPORTED.
    pub instruction_set: u32,
    /// Largest error that a substep, or a piece of a subdivided one, may add to the position of a point before
    /// it is halved, as a fraction of the length of the strand. 0 (default): errors are not estimated, which
    /// costs nothing. If max_subdivisions does not suffice, max_local_error in the report shows it.
    pub error_tolerance: f64,
    /// SHX_INTEGRATOR_REFERENCE only: allowed position error per second of simulated time, as a fraction of the
    /// length of the strand: 1e-12 to 1e-2. Default 1e-8.
    pub reference_tolerance: f64,
    /// Allowed relative error of the integrals along an element (inertia, drag, weight): 1e-12 to 1e-2. Default
    /// 1e-4. It determines the number of quadrature points, and with it time and memory.
    pub quadrature_tolerance: f64,
    /// A root jumps if reaching its target needs more than this acceleration, m/s^2, and moves it by more than
    /// a quarter of the strand's length. The strand then moves rigidly with its root in one step and continues
    /// from there; bodies that jump along do not sweep it. The report counts such strands in jumped_roots.
    /// Above zero; INFINITY: no root jumps. Default 200.
    pub jump_acceleration: f64,
    /// Must be 0.
    pub reserved: [u64; 2],
    /// Your own number, for example a pointer; the library does not use it. Default 0.
    /// shx_solver_set_own_user_data changes it.
    pub user_data: u64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles, pointers and nullable functions only.
unsafe impl Versioned for shx_solver_def {
    const FIRST_SIZE: usize = offset_of!(shx_solver_def, linear_solver);

    fn defaults() -> Self {
        let options = SolverOptions::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            worker_count: 0,
            gravity: options.gravity.into(),
            wind: options.wind.into(),
            parallel_for: None,
            parallel_for_user: std::ptr::null_mut(),
            log: None,
            log_user: std::ptr::null_mut(),
            log_level: SHX_LOG_WARN,
            integrator: options.step.integrator as u32,
            linear_solver: options.step.linear_solver as u32,
            precision: SHX_PRECISION_F64,
            max_iterations: options.step.max_iterations,
            exact_hessian: u32::from(options.step.exact_hessian),
            tolerance: options.step.tolerance,
            max_subdivisions: options.step.max_subdivisions,
            instruction_set: SHX_INSTRUCTION_SET_BEST,
            error_tolerance: options.step.error_tolerance,
            reference_tolerance: options.step.reference_tolerance,
            quadrature_tolerance: options.step.quadrature_tolerance,
            jump_acceleration: options.jump_acceleration,
            reserved: [0; 2],
            user_data: 0,
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_solver_def>() == 184 && offset_of!(shx_solver_def, user_data) == 176);
    assert!(offset_of!(shx_solver_def, parallel_for) == 56 && offset_of!(shx_solver_def, log_level) == 88);
    assert!(offset_of!(shx_solver_def, linear_solver) == 96 && offset_of!(shx_solver_def, tolerance) == 112);
};

/// An integer of C that represents a truth value.
pub(in crate::capi) fn check_flag(argument: &str, value: u32) -> Result<bool> {
    match value {
        0 => Ok(false),
        1 => Ok(true),
        _ => Err(Error::invalid(argument, value, "0 or 1")),
    }
}

pub(super) fn integrator_from(argument: &str, value: u32) -> Result<Integrator> {
    Integrator::from_u32(value).ok_or_else(|| Error::invalid(format!("{argument}.integrator"), value, "one of SHX_INTEGRATOR_"))
}

pub(super) fn linear_solver_from(argument: &str, value: u32) -> Result<LinearSolver> {
    LinearSolver::from_u32(value)
        .ok_or_else(|| Error::invalid(format!("{argument}.linear_solver"), value, "one of SHX_LINEAR_SOLVER_"))
}

pub(super) fn precision_from(argument: &str, value: u32) -> Result<Precision> {
    match value {
        SHX_PRECISION_F64 => Ok(Precision::F64),
        SHX_PRECISION_F32 => Ok(Precision::F32),
        other => Err(Error::invalid(format!("{argument}.precision"), other, "one of SHX_PRECISION_")),
    }
}

/// `None` for the best of the machine.
pub(super) fn instruction_set_from(argument: &str, value: u32) -> Result<Option<InstructionSet>> {
    if value == SHX_INSTRUCTION_SET_BEST {
        return Ok(None);
    }
    let unknown = || Error::invalid(format!("{argument}.instruction_set"), value, "one of SHX_INSTRUCTION_SET_");
    InstructionSet::from_u32(value).map(Some).ok_or_else(unknown)
}

/// Reserved fields must be zero, so that a later version can give them a meaning.
pub(in crate::capi) fn check_reserved(argument: &str, reserved: &[u64]) -> Result<()> {
    match reserved.iter().position(|word| *word != 0) {
        Some(index) => Err(Error::invalid(format!("{argument}.reserved[{index}]"), reserved[index], "0")),
        None => Ok(()),
    }
}

impl shx_solver_def {
    /// The engine's own options.
    pub(in crate::capi) fn options(&self) -> Result<SolverOptions> {
        let workers = workers("def", self.worker_count, self.parallel_for, self.parallel_for_user)?;
        let integrator = integrator_from("def", self.integrator)?;
        let linear_solver = linear_solver_from("def", self.linear_solver)?;
        let precision = precision_from("def", self.precision)?;
        let instruction_set = instruction_set_from("def", self.instruction_set)?;
        check_reserved("def", &self.reserved)?;
        let options = SolverOptions {
            gravity: Vector3::from(self.gravity),
            wind: Vector3::from(self.wind),
            step: StepOptions {
                integrator,
                linear_solver,
                max_iterations: self.max_iterations,
                tolerance: self.tolerance,
                exact_hessian: check_flag("def.exact_hessian", self.exact_hessian)?,
                reference_tolerance: self.reference_tolerance,
                max_subdivisions: self.max_subdivisions,
                error_tolerance: self.error_tolerance,
                precision,
                quadrature_tolerance: self.quadrature_tolerance,
            },
            workers,
            instruction_set,
            contact: ContactOptions::default(),
            jump_acceleration: self.jump_acceleration,
            limits: UsualLimits::default(),
        };
        options.check("def")?;
        Ok(options)
    }

    /// The destination of messages.
    pub(super) fn log_sink(&self) -> Result<LogSink> {
        if !(SHX_LOG_ERROR..=SHX_LOG_DEBUG).contains(&self.log_level) {
            return Err(Error::invalid("def.log_level", self.log_level, "SHX_LOG_ERROR (1) to SHX_LOG_DEBUG (4)"));
        }
        Ok(LogSink { function: self.log, user: self.log_user, level: self.log_level })
    }
}

/// Fills *def with defaults. size is sizeof(shx_solver_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_def_init(def: *mut shx_solver_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_solver_def_init", "def", def, size) }
}
