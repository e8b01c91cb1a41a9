//! Steps, within limits or not, and what they report.

use std::mem::{offset_of, size_of};

use super::errors::shx_result;
use super::guard::{shx_solver, write};
use super::log::{LogSink, SHX_LOG_DEBUG, SHX_LOG_WARN};
use super::step_limits::shx_step_limits;
use super::thread::on_own_thread;
use super::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::error::Result;
use crate::meter::StepLimits;
use crate::solver::Solver;
use crate::solver::definition::Workers;
use crate::solver::report::StepReport;
use crate::step::options::LinearSolver;

/// What a step tells, all its substeps together. Fill with shx_step_report_init once; each step overwrites it.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_step_report {
    /// Set by shx_step_report_init.
    pub struct_size: u32,
    /// Strand-substeps rolled back because a state turned non-finite, or touches or constraints drove it astray and found no end.
    /// shx_solver_strand_status tells which strands.
    pub quarantined: u32,
    /// Strand-substeps whose iteration ended before it reached the tolerance.
    pub unconverged: u32,
    /// Most Newton iterations that a strand took in a substep.
    pub max_iterations: u32,
    /// How far an element of any strand may still be from where its iteration would end, rad.
    pub max_residual: f64,
    /// Kinetic energy of all strands after the step, J.
    pub kinetic_energy: f64,
    /// Elastic energy, J.
    pub elastic_energy: f64,
    /// Energy of gravity, measured from the world's origin, J.
    pub gravity_energy: f64,
    /// Wall-clock time of the call, s.
    pub seconds: f64,
    /// Substeps taken.
    pub substeps: u32,
    /// Strand-substeps that were taken in parts: see max_subdivisions of shx_solver_def.
    pub subdivided: u32,
    /// Mean Newton iterations a strand and substep.
    pub mean_iterations: f64,
    /// Largest condition number met; 0 unless the linear solver is SHX_LINEAR_SOLVER_DENSE_SVD.
    pub max_condition: f64,
    /// The most that a strand's substep, or a part of it, added to the error of a point's position, in units of the strand's length
    /// (0 where the solver has no error_tolerance).
    pub max_local_error: f64,
    /// Contacts that carried a force at the end of the last substep.
    pub contacts: u32,
    /// Searches that found contacts which the one at a substep's start had not.
    pub contact_searches: u32,
    /// Newton iterations of those strands that touch or are held together that took most.
    pub max_contact_iterations: u32,
    /// Such sets of strands whose iteration ended elsewhere than it should.
    pub unconverged_islands: u32,
    /// Sweeps of the contact problem's solver, all of them together.
    pub contact_sweeps: u64,
    /// Largest residual of the laws of contact and friction: see residual of shx_contact_options.
    pub max_contact_residual: f64,
    /// How deep surfaces were in each other at the end of a substep at most, m.
    pub max_penetration: f64,
    /// The largest distance of a constraint from holding at the end of a substep, m.
    pub max_constraint_error: f64,
    /// Strands whose root was in a body by more than the contact options' tolerance at the end of the last substep, and not exempt: it is where
    /// the host put it, and no force parts the two. max_penetration has how deep.
    pub roots_inside_bodies: u64,
    /// Why the step was ended before all strands were at their end: SHX_STOP_. SHX_STOP_NONE if it was not.
    pub stop_reason: u32,
    /// Strand-substeps that were left for that: part of unconverged.
    pub unfinished: u32,
    /// Work on strands in contact or held by constraints, all substeps together, in the units of shx_step_limits.
    pub work: u64,
    /// Strands whose root jumped, and that went along with it as they were: see jump_acceleration of shx_solver_def.
    pub jumped_roots: u32,
    /// The most parts that a substep was taken in, since a body went far among strands in it; 1: none was. See max_subdivisions of shx_solver_def.
    pub fast_body_pieces: u32,
    /// Contacts whose force is told as no more than hair can do: what takes the strand its own length in the substep and bends its elements by a radian; twice
    /// that where all laws hold.
    pub capped_contact_forces: u64,
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_step_report {
    const FIRST_SIZE: usize = offset_of!(shx_step_report, substeps);

    fn defaults() -> Self {
        Self::from_report(&StepReport::default())
    }
}

const _: () = {
    assert!(size_of::<shx_step_report>() == 176 && offset_of!(shx_step_report, max_residual) == 16);
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
            contacts: report.contact.touches,
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
        }
    }
}

/// Prepares a report. size is sizeof(shx_step_report).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_step_report_init(report: *mut shx_step_report, size: usize) -> shx_result {
    // SAFETY: the caller says that report holds size bytes.
    unsafe { initialise("shx_step_report_init", "report", report, size) }
}

/// Steps where the kernels leave nothing behind on the host's thread, which does its share of a pool's work.
fn step(core: &mut Solver, dt: f64, substeps: u32, limits: &StepLimits) -> Result<StepReport> {
    let options = core.options();
    let dense = options.step.linear_solver != LinearSolver::LinearTime;
    if dense && !matches!(options.workers, Workers::Host(_)) {
        on_own_thread(|| core.step_within(dt, substeps, limits))
    } else {
        core.step_within(dt, substeps, limits)
    }
}

fn tell(log: &LogSink, report: &StepReport) {
    if report.quarantined > 0 {
        log.message(
            SHX_LOG_WARN,
            format_args!("shx_solver_step: {} strand-substeps rolled back (non-finite or astray)", report.quarantined),
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
                "shx_solver_step: contact of {} sets of strands unconverged, penetration up to {:e} m, constraints off by up to {:e} m",
                report.contact.unconverged, report.contact.penetration, report.contact.constraint_error
            ),
        );
    }
    if report.contact.roots_inside > 0 {
        log.message(
            SHX_LOG_WARN,
            format_args!(
                "shx_solver_step: the roots of {} strands are in a body, where no force parts them (see exempt_length)",
                report.contact.roots_inside
            ),
        );
    }
    log.message(
        SHX_LOG_DEBUG,
        format_args!(
            "shx_solver_step: {} substeps, {:.2} iterations (most {}), {:.6} s",
            report.substeps, report.mean_iterations, report.max_iterations, report.seconds
        ),
    );
}

/// Moves time on by dt seconds (above zero) in substeps equal parts (at least 1; each a full solve). report may be null.
/// A strand whose state turns non-finite, or goes astray in touches or constraints without end, is rolled back and marked; the step goes on, and the report and the strand's status say
/// so. Same input, same bits, whatever the number of threads.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE (report), SHX_ERROR_INVALID_ARGUMENT (dt, substeps), SHX_ERROR_UNSUPPORTED
/// (SHX_INTEGRATOR_REFERENCE where strands may touch something or constraints hold them: it steps free strands only).
/// Alone with the solver.
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

/// The same within limits: a budget of work, which gives the same bits on every machine; a budget of seconds, whose bits are the clock's; a flag by which
/// another thread cancels the step. What has not converged by then stays where the iteration has left it; strands for which none was done, and all that touch
/// something where the step was cancelled, keep their shape and go along with their roots. Every strand is whole and finite, roots and bodies are where they were sent,
/// and the report says what was left and why. SHX_OK is returned whichever limit ended it.
/// Errors: as shx_solver_step; SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE, SHX_ERROR_INVALID_ARGUMENT (options). Alone with the solver; *cancel may be written
/// by any thread meanwhile.
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
    tell(log, &told);
    if let Some(output) = output {
        output.write(&shx_step_report::from_report(&told));
    }
    Ok(())
}
