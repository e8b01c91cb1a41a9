//! Steps, with or without limits, and their reports.

use std::mem::{offset_of, size_of};

use super::step_limits::shx_step_limits;
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::{shx_solver, write};
use crate::capi::base::log::{LogSink, SHX_LOG_DEBUG, SHX_LOG_WARN};
use crate::capi::base::thread::on_own_thread;
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::error::Result;
use crate::meter::StepLimits;
use crate::solver::Solver;
use crate::solver::definition::Workers;
use crate::solver::report::StepReport;
use crate::step::options::LinearSolver;

/// Report of a step, accumulated over all of its substeps. Fill it with
/// shx_step_report_init once; each step overwrites it.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_step_report {
    /// Set by shx_step_report_init.
    pub struct_size: u32,
    /// Number of strand-substeps that were rolled back because the state became non-finite, or contacts or
    /// constraints made it diverge. shx_solver_strand_status identifies the strands.
    pub quarantined: u32,
    /// Number of strand-substeps in which Newton's method did not reach the tolerance.
    pub unconverged: u32,
    /// Largest number of Newton iterations of a strand in a substep.
    pub max_iterations: u32,
    /// Largest estimated distance of an element from the
    /// solution, rad: compare it with shx_solver_def.tolerance.
    pub max_residual: f64,
    /// Kinetic energy of all strands after the step, J.
    pub kinetic_energy: f64,
    /// Elastic energy, J.
    pub elastic_energy: f64,
    /// Gravitational energy relative to the world origin, J.
    pub gravity_energy: f64,
    /// Wall-clock time of the call, s.
    pub seconds: f64,
    /// Number of substeps taken.
    pub substeps: u32,
    /// Number of strand-substeps that were subdivided: see shx_solver_def.max_subdivisions.
    pub subdivided: u32,
    /// Mean number of Newton iterations per strand and substep.
    pub mean_iterations: f64,
    /// Largest condition number; 0 unless the linear solver is SHX_LINEAR_SOLVER_DENSE_SVD.
    pub max_condition: f64,
    /// Largest error that a strand's substep, or a piece of it, added to the position of a point, as a fraction
    /// of the strand's length. 0 without error_tolerance.
    pub max_local_error: f64,
    /// Number of contacts with non-zero force at the end of the last substep.
    pub contacts: u32,
    /// Number of searches during a substep that found contacts which its first search had missed.
    pub contact_searches: u32,
    /// Largest number of Newton iterations of an island: a set of strands that contacts or constraints couple.
    pub max_contact_iterations: u32,
    /// Number of islands that did not converge. Includes those in which a contact or constraint yields by more
    /// than a fifth of the contact tolerance, and those that take the step in substeps and are left deep in a
    /// body, or in a strand outside the island.
    pub unconverged_islands: u32,
    /// Total number of sweeps of the contact solver.
    pub contact_sweeps: u64,
    /// Largest residual of the contact and friction laws: see shx_contact_options.residual.
    pub max_contact_residual: f64,
    /// Largest penetration depth at the end of a substep, m. Surfaces that penetrate by less than the contact
    /// tolerance are not always contacts, and may be left out.
    pub max_penetration: f64,
    /// Largest constraint error at the end of a substep, m.
    pub max_constraint_error: f64,
    /// Number of strands whose root is deeper in a body than the contact tolerance at the end of
    /// the last substep, and not exempt. Roots are where you put them, so no contact force can
    /// separate the two. max_penetration includes their depth.
    pub roots_inside_bodies: u64,
    /// Why the step stopped before it was complete: SHX_STOP_. SHX_STOP_NONE if it was not stopped.
    pub stop_reason: u32,
    /// Number of strand-substeps left unfinished because the step was stopped; unconverged includes them.
    pub unfinished: u32,
    /// Total work on strands in contact or with constraints, in the units of shx_step_limits.
    pub work: u64,
    /// Number of strands that moved rigidly with a root that jumped: see shx_solver_def.jump_acceleration.
    pub jumped_roots: u32,
    /// Largest number of pieces into which a whole substep was subdivided because a body moved far among
    /// strands; 1 if none was. See shx_solver_def.max_subdivisions.
    pub fast_body_pieces: u32,
    /// Number of contacts whose reported force was capped at what hair can exert: what moves the strand by its
    /// own length within the substep and bends its elements by a radian; twice that where all contact laws hold.
    pub capped_contact_forces: u64,
    /// Time spent on the search for contacts, s. The three phases sum up to less than seconds; 0 where there is
    /// no clock.
    pub search_seconds: f64,
    /// Time spent on the equations of motion of strands, s.
    pub strand_seconds: f64,
    /// Time spent on the contact problems of islands, s.
    pub contact_seconds: f64,
    /// Time that sampling this solver took since the step before, s; calls on several threads add up. Not part
    /// of seconds.
    pub sampling_seconds: f64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_step_report {
    const FIRST_SIZE: usize = offset_of!(shx_step_report, substeps);

    fn defaults() -> Self {
        Self::from_report(&StepReport::default())
    }
}

const _: () = {
    assert!(size_of::<shx_step_report>() == 208 && offset_of!(shx_step_report, max_residual) == 16);
    assert!(offset_of!(shx_step_report, substeps) == 56 && offset_of!(shx_step_report, contacts) == 88);
};

impl shx_step_report {
    fn from_report(report: &StepReport) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            quarantined: report.quarantined,
            unconverged: report.unconverged,
            max_iterations: report.max_iterations,
            max_residual: report.max_residual,
            kinetic_energy: report.energies.kinetic,
            elastic_energy: report.energies.elastic,
            gravity_energy: report.energies.gravity,
            seconds: report.seconds,
            substeps: report.substeps,
            subdivided: report.subdivided,
            mean_iterations: report.mean_iterations,
            max_condition: report.max_condition,
            max_local_error: report.max_error,
            contacts: report.contact.contacts,
            contact_searches: report.contact.searches,
            max_contact_iterations: report.contact.iterations,
            unconverged_islands: report.contact.unconverged,
            contact_sweeps: report.contact.sweeps,
            max_contact_residual: report.contact.residual,
            max_penetration: report.contact.penetration,
            max_constraint_error: report.contact.constraint_error,
            roots_inside_bodies: u64::from(report.contact.roots_inside),
            stop_reason: report.stopped as u32,
            unfinished: report.left,
            work: report.work,
            jumped_roots: report.carried,
            fast_body_pieces: report.parts,
            capped_contact_forces: u64::from(report.contact.capped),
            search_seconds: report.phases.search,
            strand_seconds: report.phases.strands,
            contact_seconds: report.phases.contact,
            sampling_seconds: report.phases.sampling,
        }
    }
}

/// Fills *report with defaults. size is sizeof(shx_step_report).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_step_report_init(report: *mut shx_step_report, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that report holds size bytes.
    unsafe { initialise("shx_step_report_init", "report", report, size) }
}

/// Steps so that the kernels leave nothing behind on the host's thread, which takes part in a pool's work.
fn step(core: &mut Solver, dt: f64, substeps: u32, limits: &StepLimits) -> Result<StepReport> {
    let options = core.options();
    let dense = options.step.linear_solver != LinearSolver::LinearTime;
    if dense && !matches!(options.workers, Workers::Host(_)) {
        on_own_thread(|| core.step_within(dt, substeps, limits))
    } else {
        core.step_within(dt, substeps, limits)
    }
}

/// What mends contact that does not converge: `tolerance`, m, is that of contact.
fn advice(report: &StepReport, tolerance: f64) -> &'static str {
    let deep = report.contact.penetration > tolerance;
    if deep { " (where strands are drawn through each other or bodies, see shx_solver_permit_overlaps)" } else { "" }
}

fn tell(log: &LogSink, report: &StepReport, tolerance: f64) {
    if report.quarantined > 0 {
        log.message(
            SHX_LOG_WARN,
            format_args!("shx_solver_step: {} strand-substeps rolled back (non-finite or diverged)", report.quarantined),
        );
    }
    if report.unconverged > 0 {
        log.message(
            SHX_LOG_WARN,
            format_args!(
                "shx_solver_step: {} strand-substeps unconverged, residual up to {:e} rad",
                report.unconverged, report.max_residual
            ),
        );
    }
    if report.contact.unconverged > 0 {
        log.message(
            SHX_LOG_WARN,
            format_args!(
                "shx_solver_step: {} islands unconverged, penetration up to {:e} m, constraint error up to {:e} m{}",
                report.contact.unconverged,
                report.contact.penetration,
                report.contact.constraint_error,
                advice(report, tolerance)
            ),
        );
    }
    if report.contact.roots_inside > 0 {
        log.message(
            SHX_LOG_WARN,
            format_args!(
                "shx_solver_step: the roots of {} strands are inside a body, where no force can separate them (see exempt_length)",
                report.contact.roots_inside
            ),
        );
    }
    log.message(
        SHX_LOG_DEBUG,
        format_args!(
            "shx_solver_step: {} substeps, {:.2} iterations (most {}), {:.6} s (search {:.6}, strands {:.6}, contact {:.6})",
            report.substeps,
            report.mean_iterations,
            report.max_iterations,
            report.seconds,
            report.phases.search,
            report.phases.strands,
            report.phases.contact
        ),
    );
}

/// Advances time by dt seconds in the given number of equal substeps (at least 1); each is a full solve and
/// lasts from 1e-9 to 3600 s. report may be null. A strand whose state becomes non-finite, or that contacts or
/// constraints make diverge, is rolled back and quarantined; the other strands go on, and the report and
/// shx_solver_strand_status say so. The same input gives the same bits for any number of threads. Limits of
/// the call are those of shx_solver_options.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE (report), SHX_ERROR_INVALID_ARGUMENT (dt, substeps),
/// SHX_ERROR_UNSUPPORTED (SHX_INTEGRATOR_REFERENCE with contact or constraints: it steps free strands only).
/// Threads: exclusive.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_step(
    solver: *mut shx_solver,
    dt: f64,
    substeps: u32,
    report: *mut shx_step_report,
) -> shx_result {
    // SAFETY: the caller's handle, null or alive, and its report, null or of the size that it states.
    unsafe {
        write("shx_solver_step", solver, |core, log| step_and_tell(core, log, dt, substeps, &StepLimits::default(), report))
    }
}

/// Does the same as shx_solver_step within limits: on work (identical bits on every machine), on time
/// (results depend on the clock), or by a flag that another thread sets. When a limit is reached, strands
/// that have not converged keep their last iterate. Strands without any iterate, and all strands in
/// contact if the step is cancelled, keep their shape and move with their roots. All states remain
/// finite, roots and bodies reach their targets, and the report says what is unfinished and why. The
/// function returns SHX_OK whichever limit stopped it.
/// Errors: as shx_solver_step; SHX_ERROR_NULL_ARGUMENT,
/// SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (limits).
/// Threads: exclusive; any thread may write *cancel meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_solver_step_with_limits(
    solver: *mut shx_solver,
    dt: f64,
    substeps: u32,
    limits: *const shx_step_limits,
    report: *mut shx_step_report,
) -> shx_result {
    // SAFETY: the caller's handle, null or alive, and its structures, of the sizes that they state; cancel lives as long as the call.
    unsafe {
        write("shx_solver_step_with_limits", solver, |core, log| {
            let limits = read_versioned("limits", limits)?;
            step_and_tell(core, log, dt, substeps, &limits.limits()?, report)
        })
    }
}

/// # Safety
/// `report` is null or a structure of the size that it states.
unsafe fn step_and_tell(
    core: &mut Solver,
    log: &LogSink,
    dt: f64,
    substeps: u32,
    limits: &StepLimits,
    report: *mut shx_step_report,
) -> Result<()> {
    let output = if report.is_null() {
        None
    } else {
        // SAFETY: the caller's structure, of the size that it states.
        Some(unsafe { VersionedOutput::new("report", report)? })
    };
    let told = step(core, dt, substeps, limits)?;
    tell(log, &told, core.options().contact.tolerance);
    if let Some(output) = output {
        output.write(&shx_step_report::from_report(&told));
    }
    Ok(())
}
