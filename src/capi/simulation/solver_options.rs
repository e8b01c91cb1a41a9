//! Reads and changes a solver's options.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use super::solver_def::{
    SHX_INSTRUCTION_SET_BEST, SHX_PRECISION_F32, SHX_PRECISION_F64, check_flag, instruction_set_from, integrator_from,
    linear_solver_from, precision_from,
};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{read, shx_solver, write};
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::error::{Error, Result, check_not_negative};
use crate::math::lane::Precision;
use crate::solver::definition::{SolverOptions, UsualLimits, Workers};
use crate::step::options::StepOptions;

/// Options of a living solver: shx_solver_get_options reads them, shx_solver_set_options changes them. Meaning
/// and range of a field are those of the field of the same name in shx_solver_def.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_solver_options {
    /// Set by shx_solver_options_init.
    pub struct_size: u32,
    /// SHX_INTEGRATOR_. Default SHX_INTEGRATOR_SECOND_ORDER. After a change strands start as if they had just
    /// been made, as far as the integrator looks back.
    pub integrator: u32,
    /// SHX_LINEAR_SOLVER_. Default SHX_LINEAR_SOLVER_LINEAR_TIME.
    pub linear_solver: u32,
    /// SHX_PRECISION_. Default SHX_PRECISION_F64.
    pub precision: u32,
    /// Maximum number of Newton iterations per substep. Default 50.
    pub max_iterations: u32,
    /// 1 (default): the exact Hessian. 0: Gauss-Newton.
    pub exact_hessian: u32,
    /// How many times a strand's substep may be halved. Default 3.
    pub max_subdivisions: u32,
    /// SHX_INSTRUCTION_SET_. Default SHX_INSTRUCTION_SET_BEST.
    pub instruction_set: u32,
    /// Gravity, m/s^2. Default (0, 0, -9.81).
    pub gravity: [f64; 3],
    /// Uniform wind, m/s. Default 0.
    pub wind: [f64; 3],
    /// Tolerance of Newton's method, rad. Default 1e-6.
    pub tolerance: f64,
    /// Largest error of a substep, as a fraction of the length of the strand. Default 0: not estimated.
    pub error_tolerance: f64,
    /// SHX_INTEGRATOR_REFERENCE only: position error per second. Default 1e-8.
    pub reference_tolerance: f64,
    /// Relative error of the integrals along an element. Default 1e-4.
    pub quadrature_tolerance: f64,
    /// Acceleration above which a root jumps, m/s^2. Default 200.
    pub jump_acceleration: f64,
    /// Maximum work per substep of steps that come without a limit of their own: see shx_step_limits. Default 0:
    /// the library's.
    pub max_work: u64,
    /// Maximum duration of such a call, s. Default 0: no limit.
    pub max_seconds: f64,
    /// Number of threads; 0: those of your task system. It is fixed when the solver is created:
    /// shx_solver_set_options refuses another number. Default 1.
    pub worker_count: u32,
    /// Must be 0.
    pub reserved0: u32,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_solver_options {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self::from_options(&SolverOptions::default())
    }
}

const _: () = {
    assert!(size_of::<shx_solver_options>() == 144 && offset_of!(shx_solver_options, gravity) == 32);
    assert!(offset_of!(shx_solver_options, max_work) == 120 && offset_of!(shx_solver_options, worker_count) == 136);
};

/// The number of threads as the structure has it.
fn worker_count(workers: &Workers) -> u32 {
    match workers {
        Workers::Serial => 1,
        Workers::Pool(count) => *count as u32,
        Workers::Host(_) => 0,
    }
}

impl shx_solver_options {
    fn from_options(options: &SolverOptions) -> Self {
        let step = &options.step;
        Self {
            struct_size: size_of::<Self>() as u32,
            integrator: step.integrator as u32,
            linear_solver: step.linear_solver as u32,
            precision: match step.precision {
                Precision::F64 => SHX_PRECISION_F64,
                Precision::F32 => SHX_PRECISION_F32,
            },
            max_iterations: step.max_iterations,
            exact_hessian: u32::from(step.exact_hessian),
            max_subdivisions: step.max_subdivisions,
            instruction_set: options.instruction_set.map_or(SHX_INSTRUCTION_SET_BEST, |set| set as u32),
            gravity: options.gravity.into(),
            wind: options.wind.into(),
            tolerance: step.tolerance,
            error_tolerance: step.error_tolerance,
            reference_tolerance: step.reference_tolerance,
            quadrature_tolerance: step.quadrature_tolerance,
            jump_acceleration: options.jump_acceleration,
            max_work: options.limits.work.unwrap_or(0),
            max_seconds: options.limits.seconds.unwrap_or(0.0),
            worker_count: worker_count(&options.workers),
            reserved0: 0,
        }
    }

    /// The engine's own options, for a solver with the options `present`.
    fn options(&self, present: &SolverOptions) -> Result<SolverOptions> {
        let workers = worker_count(&present.workers);
        if self.worker_count != workers {
            return Err(Error::Unsupported {
                argument: "options.worker_count".into(),
                value: self.worker_count.to_string(),
                hint: format!("threads are fixed when a solver is created, and this one has {workers}; create another"),
            });
        }
        if self.reserved0 != 0 {
            return Err(Error::invalid("options.reserved0", self.reserved0, "0"));
        }
        check_not_negative(|| "options.max_seconds".into(), self.max_seconds)?;
        Ok(SolverOptions {
            gravity: Vector3::from(self.gravity),
            wind: Vector3::from(self.wind),
            step: StepOptions {
                integrator: integrator_from("options", self.integrator)?,
                linear_solver: linear_solver_from("options", self.linear_solver)?,
                max_iterations: self.max_iterations,
                tolerance: self.tolerance,
                exact_hessian: check_flag("options.exact_hessian", self.exact_hessian)?,
                reference_tolerance: self.reference_tolerance,
                max_subdivisions: self.max_subdivisions,
                error_tolerance: self.error_tolerance,
                precision: precision_from("options", self.precision)?,
                quadrature_tolerance: self.quadrature_tolerance,
            },
            workers: present.workers.clone(),
            instruction_set: instruction_set_from("options", self.instruction_set)?,
            contact: present.contact,
            jump_acceleration: self.jump_acceleration,
            limits: UsualLimits {
                work: (self.max_work > 0).then_some(self.max_work),
                seconds: (self.max_seconds > 0.0).then_some(self.max_seconds),
            },
        })
    }
}

/// Fills *options with the defaults of a solver. size is sizeof(shx_solver_options). To change one option of a
/// solver read them first: shx_solver_get_options.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_options_init(options: *mut shx_solver_options, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that options holds size bytes.
    unsafe { initialise("shx_solver_options_init", "options", options, size) }
}

/// Writes the options of a solver to *out_options.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: shared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_get_options(solver: *const shx_solver, out_options: *mut shx_solver_options) -> shx_result {
    // SAFETY: the caller's handle and structure, of the size that it states.
    unsafe {
        read("shx_solver_get_options", solver, |core| {
            let output = VersionedOutput::new("out_options", out_options)?;
            output.write(&shx_solver_options::from_options(core.options()));
            Ok(())
        })
    }
}

/// Changes the options of a solver from the next step on, all or none. Setting what shx_solver_get_options
/// gave changes nothing. Snapshots contain all of them but instruction_set and worker_count.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (the message names the
/// field), SHX_ERROR_UNSUPPORTED (another worker_count, a combination or an instruction set that is not
/// available).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_set_options(solver: *mut shx_solver, options: *const shx_solver_options) -> shx_result {
    // SAFETY: the caller's handle and structure, of the size that it states.
    unsafe {
        write("shx_solver_set_options", solver, |core, _| {
            let options = read_versioned("options", options)?.options(core.options())?;
            core.set_options(&options).map_err(|error| error.renamed("options.limits.", "options.max_"))
        })
    }
}
