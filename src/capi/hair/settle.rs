//! Puts strands at rest in their equilibrium under gravity.

use std::mem::{offset_of, size_of};

use super::strands::{SHX_STRAND_CONVERGED, SHX_STRAND_UNCONVERGED, shx_strand_status};
use crate::capi::base::buffers::{OutputList, strand_ids};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{shx_solver, write};
use crate::capi::base::log::{LogSink, SHX_LOG_DEBUG, SHX_LOG_WARN};
use crate::capi::base::thread::on_own_thread;
use crate::capi::base::types::shx_strand_id;
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::error::{Error, Result};
use crate::platform::Instant;
use crate::solver::Solver;
use crate::solver::definition::Workers;
use crate::step::equilibrium::{Equilibrium, EquilibriumOptions};

/// Options of shx_solver_settle. Fill it with shx_settle_def_init, then change what you need.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_settle_def {
    /// Set by shx_settle_def_init.
    pub struct_size: u32,
    /// Maximum number of steps of the search, 1 to 100000. Default 300.
    pub max_steps: u32,
    /// A strand is at rest when no moment is out of balance by more than this, relative to rho S |g| L^2 plus
    /// 1e-4 (1/L + the largest natural curvature) times the largest stiffness; above zero. Default 1e-10.
    pub tolerance: f64,
    /// 1 (default): compute the smallest eigenvalue and leave unstable states. Costs the cube of the number of
    /// elements. 0: a strand that symmetry holds in an unstable state remains there.
    pub check_stability: u32,
    /// Must be 0.
    pub reserved: u32,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_settle_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let options = EquilibriumOptions::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            max_steps: options.max_steps,
            tolerance: options.tolerance,
            check_stability: u32::from(options.check_stability),
            reserved: 0,
        }
    }
}

/// Report of shx_solver_settle for all of its strands. Fill it with
/// shx_settle_report_init once; each call overwrites it.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_settle_report {
    /// Set by shx_settle_report_init.
    pub struct_size: u32,
    /// Number of strands that did not reach the tolerance, or ended in an unstable state.
    /// They are at rest in the best shape that was found.
    pub unconverged: u32,
    /// Number of those whose smallest eigenvalue is negative beyond rounding.
    pub unstable: u32,
    /// Number of unstable states that the searches left.
    pub saddles: u32,
    /// Total number of Newton iterations.
    pub iterations: u64,
    /// Largest residual of a strand, relative as in shx_settle_def.tolerance.
    pub max_residual: f64,
    /// Smallest eigenvalue of a strand (see shx_solver_settle). NaN without check_stability or without strands.
    pub smallest_eigenvalue: f64,
    /// Wall-clock time of the call, s.
    pub seconds: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_settle_report {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            unconverged: 0,
            unstable: 0,
            saddles: 0,
            iterations: 0,
            max_residual: 0.0,
            smallest_eigenvalue: f64::NAN,
            seconds: 0.0,
        }
    }
}

const _: () = {
    assert!(size_of::<shx_settle_def>() == 24 && offset_of!(shx_settle_def, check_stability) == 16);
    assert!(size_of::<shx_settle_report>() == 48 && offset_of!(shx_settle_report, iterations) == 16);
};

impl shx_settle_def {
    fn options(&self) -> Result<EquilibriumOptions> {
        if self.check_stability > 1 {
            return Err(Error::invalid("def.check_stability", self.check_stability, "0 or 1"));
        }
        if self.reserved != 0 {
            return Err(Error::invalid("def.reserved", self.reserved, "0"));
        }
        let options = EquilibriumOptions {
            tolerance: self.tolerance,
            max_steps: self.max_steps,
            check_stability: self.check_stability == 1,
        };
        options.check("def")?;
        Ok(options)
    }
}

impl shx_settle_report {
    fn of(found: &[Equilibrium], seconds: f64) -> Self {
        let mut report = Self { seconds, ..Self::defaults() };
        for strand in found {
            report.unconverged += u32::from(!strand.converged);
            report.unstable += u32::from(strand.is_unstable());
            report.saddles += strand.saddles;
            report.iterations += u64::from(strand.iterations);
            report.max_residual = report.max_residual.max(strand.residual);
            report.smallest_eigenvalue = report.smallest_eigenvalue.min(strand.smallest_eigenvalue.unwrap_or(f64::NAN));
        }
        report
    }
}

/// Fills *def with defaults. size is sizeof(shx_settle_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_settle_def_init(def: *mut shx_settle_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_settle_def_init", "def", def, size) }
}

/// Fills *report with defaults. size is sizeof(shx_settle_report).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_settle_report_init(report: *mut shx_settle_report, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that report holds size bytes.
    unsafe { initialise("shx_settle_report_init", "report", report, size) }
}

fn tell(log: &LogSink, report: &shx_settle_report, count: usize) {
    if report.unconverged > 0 {
        log.message(
            SHX_LOG_WARN,
            format_args!(
                "shx_solver_settle: {} of {count} strands found no stable equilibrium ({} unstable), residual up to {:e}",
                report.unconverged, report.unstable, report.max_residual
            ),
        );
    }
    log.message(
        SHX_LOG_DEBUG,
        format_args!(
            "shx_solver_settle: {count} strands, {} iterations, {} saddles, {:.6} s",
            report.iterations, report.saddles, report.seconds
        ),
    );
}

/// Moves count strands to their static equilibrium under gravity and leaves them at rest. The
/// search descends from the current shape with the root fixed at its current frame. Wind is
/// ignored, moving roots stop, quarantined strands are released. def may be null (defaults), report
/// may be null. Each output holds count values or is null.
/// out_status: SHX_STRAND_CONVERGED, or SHX_STRAND_UNCONVERGED if no stable equilibrium was found; the strand
/// is then at rest in the best shape that was found.
/// out_eigenvalues: smallest eigenvalue of the static Hessian relative to the elastic stiffness. 1:
/// gravity has no effect (slightly more if it stabilises the whole strand). 0: the limit of
/// stability. Negative: unstable. NaN without check_stability.
/// out_residuals: largest moment out of balance, relative as in shx_settle_def.tolerance.
/// If several stable states exist, the result need not be the lowest. The work runs on the solver's threads or
/// on parallel_for, with identical bits. Each task of yours then waits for a short-lived thread of the
/// library, which keeps thread-local memory off your threads.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ID, SHX_ERROR_INVALID_ARGUMENT.
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_settle(
    solver: *mut shx_solver,
    ids: *const shx_strand_id,
    count: usize,
    def: *const shx_settle_def,
    report: *mut shx_settle_report,
    out_status: *mut shx_strand_status,
    out_eigenvalues: *mut f64,
    out_residuals: *mut f64,
) -> shx_result {
    let body = |core: &mut Solver, log: &LogSink| {
        let options = if def.is_null() {
            EquilibriumOptions::default()
        } else {
            // SAFETY: the caller's structure, of the size that it states.
            unsafe { read_versioned("def", def)? }.options()?
        };
        let output = if report.is_null() {
            None
        } else {
            // SAFETY: the caller's structure, of the size that it states.
            Some(unsafe { VersionedOutput::new("report", report)? })
        };
        // SAFETY: the caller's count ids and places for count values.
        let (ids, status, eigenvalues, residuals) = unsafe {
            (
                strand_ids(ids, count)?,
                OutputList::optional("out_status", "count", out_status, count)?,
                OutputList::optional("out_eigenvalues", "count", out_eigenvalues, count)?,
                OutputList::optional("out_residuals", "count", out_residuals, count)?,
            )
        };
        let started = Instant::now();
        let found = if let Workers::Host(_) = core.options().workers {
            // The host's loop is called on the host's thread, and its tasks hand each piece to a thread of its own.
            core.settle_by(&ids, &options, &|piece| on_own_thread(piece))?
        } else {
            on_own_thread(|| core.settle(&ids, &options))?
        };
        let told = shx_settle_report::of(&found, started.elapsed().as_secs_f64());
        tell(log, &told, count);
        if let Some(status) = status {
            status.write(
                &found
                    .iter()
                    .map(|f| if f.converged { SHX_STRAND_CONVERGED } else { SHX_STRAND_UNCONVERGED })
                    .collect::<Vec<_>>(),
            )?;
        }
        if let Some(eigenvalues) = eigenvalues {
            eigenvalues.write_all(found.iter().map(|f| f.smallest_eigenvalue.unwrap_or(f64::NAN)))?;
        }
        if let Some(residuals) = residuals {
            residuals.write_all(found.iter().map(|f| f.residual))?;
        }
        if let Some(output) = output {
            output.write(&told);
        }
        Ok(())
    };
    // SAFETY: the caller's handle, null or alive.
    unsafe { write("shx_solver_settle", solver, body) }
}
