//! Fits friction coefficients to a recorded curve.

use std::mem::{offset_of, size_of};

use nalgebra::Vector3;

use crate::analysis::friction_fit::{Coefficient, FrictionFit, FrictionFitOptions, Sought, Start, Verdict, fit_friction};
use crate::analysis::recording::{Observable, Recording, RootMotion};
use crate::capi::base::buffers::{OutputList, array};
use crate::capi::base::errors::shx_result;
use crate::capi::base::guard::call;
use crate::capi::base::thread::on_own_thread;
use crate::capi::base::types::shx_frame;
use crate::capi::base::versioned::{Versioned, VersionedOutput, initialise, read_versioned};
use crate::capi::hair::strand_def::shx_strand_def;
use crate::capi::simulation::solver_def::{check_flag, check_reserved, shx_solver_def};
use crate::error::{Error, Result};
use crate::math::splines::pose_spline::PoseSpline;

/// Distance from root to tip, m.
pub const SHX_OBSERVABLE_SPAN: u32 = 1;
/// How far the tip hangs below the root along gravity, m.
pub const SHX_OBSERVABLE_DEPTH: u32 = 2;
/// Offset of the tip from the root along shx_friction_fit_def.direction, m.
pub const SHX_OBSERVABLE_OFFSET: u32 = 3;
/// Angle of the line from root to tip from gravity towards shx_friction_fit_def.direction, rad, -pi to pi.
pub const SHX_OBSERVABLE_ANGLE: u32 = 4;

/// Internal friction gamma.
pub const SHX_FRICTION_INTERNAL: u32 = 1;
/// Kelvin-Voigt damping time mu.
pub const SHX_FRICTION_VISCOSITY: u32 = 2;
/// Air drag nu.
pub const SHX_FRICTION_AIR_DRAG: u32 = 4;

/// The strand starts in its stable equilibrium under gravity, moving rigidly with its root. The default.
pub const SHX_FRICTION_START_SETTLED: u32 = 1;
/// The strand starts with the initial curvatures and rates of its definition.
pub const SHX_FRICTION_START_AS_DEFINED: u32 = 2;

/// The coefficient was not fitted: value is that of the strand, the other numbers are 0.
pub const SHX_COEFFICIENT_NOT_FITTED: u32 = 0;
/// The recording determines the coefficient.
pub const SHX_COEFFICIENT_DETERMINED: u32 = 1;
/// It does not: the curve hardly depends on the coefficient (the standard error exceeds half of the value, or
/// no value in the range differs by three standard deviations), or two coefficients cannot be told apart.
pub const SHX_COEFFICIENT_UNDETERMINED: u32 = 2;
/// The best value is the lower bound of the range, and a smaller one would fit better.
pub const SHX_COEFFICIENT_AT_LOWER_BOUND: u32 = 3;
/// The best value is the upper bound of the range, and a larger one would fit better.
pub const SHX_COEFFICIENT_AT_UPPER_BOUND: u32 = 4;

/// What to fit, and how. Fill it with shx_friction_fit_def_init, then set at least coefficients.
/// The library reads the arrays during the call only.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_friction_fit_def {
    /// Set by shx_friction_fit_def_init.
    pub struct_size: u32,
    /// Meaning of the recorded values: SHX_OBSERVABLE_. Default SHX_OBSERVABLE_SPAN.
    pub observable: u32,
    /// Coefficients to fit: SHX_FRICTION_INTERNAL, _VISCOSITY and
    /// _AIR_DRAG bits, at least one. Default 0: set it.
    pub coefficients: u32,
    /// Initial state of the strand: SHX_FRICTION_START_. Default SHX_FRICTION_START_SETTLED.
    pub start: u32,
    /// Direction for SHX_OBSERVABLE_OFFSET and _ANGLE, any length above zero. Default (1, 0, 0).
    pub direction: [f64; 3],
    /// Smallest and largest gamma to try, kg m^3/s; above zero, ascending. Default 1e-12, 1e-8.
    pub internal_friction_range: [f64; 2],
    /// The same for mu, s. Default 1e-4, 1.
    pub viscosity_range: [f64; 2],
    /// The same for nu, kg/(m s). Default 1e-7, 1e-3.
    pub air_drag_range: [f64; 2],
    /// Initial guess of gamma within its range, in addition to the grid. 0 (default): none.
    pub internal_friction_guess: f64,
    /// The same for mu.
    pub viscosity_guess: f64,
    /// The same for nu.
    pub air_drag_guess: f64,
    /// The simulation starts this long before the first recorded time, s; zero or above. Default 0.
    pub lead_in: f64,
    /// Values in this initial time span are simulated but not compared, s; zero or above. Default 0.
    pub discard: f64,
    /// Longest step, s; above zero. Default 1/480.
    pub time_step: f64,
    /// Grid points over each range, 2 to 64. 0: no grid, so every coefficient needs a guess. Default 9.
    pub grid_points: u32,
    /// 1: also fit a constant that is added to the simulated values, for a
    /// marker that is not exactly at the tip. Default 0.
    pub fit_offset: u32,
    /// Maximum number of least-squares iterations, 1 to 1000. Default 50.
    pub max_iterations: u32,
    /// Must be 0.
    pub reserved0: u32,
    /// Amplitude of the root, m: it moves by amplitude * sin(2 pi frequency t
    /// + phase) along oscillation_direction. Default 0.
    pub oscillation_amplitude: f64,
    /// Frequency, Hz; above zero, or 0 (default): the root does not oscillate.
    pub oscillation_frequency: f64,
    /// Phase, rad. Default 0.
    pub oscillation_phase: f64,
    /// Direction, any length. (0, 0, 0) (default): up, against gravity.
    pub oscillation_direction: [f64; 3],
    /// Instead, the root follows recorded frames, which replace the root of the strand: root_count times, s,
    /// strictly increasing. It moves smoothly and is at rest before the first and after the last.
    pub root_times: *const f64,
    /// root_count frames.
    pub root_frames: *const shx_frame,
    /// Number of frames. 0 (default): none.
    pub root_count: usize,
    /// Must be 0.
    pub reserved: [u64; 4],
}

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers, doubles and pointers only.
unsafe impl Versioned for shx_friction_fit_def {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        let options = FrictionFitOptions::of(&[]);
        Self {
            struct_size: size_of::<Self>() as u32,
            observable: SHX_OBSERVABLE_SPAN,
            coefficients: 0,
            start: options.start as u32,
            direction: [1.0, 0.0, 0.0],
            internal_friction_range: Coefficient::InternalFriction.usual_range(),
            viscosity_range: Coefficient::Viscosity.usual_range(),
            air_drag_range: Coefficient::AirDrag.usual_range(),
            internal_friction_guess: 0.0,
            viscosity_guess: 0.0,
            air_drag_guess: 0.0,
            lead_in: options.lead_in,
            discard: options.discard,
            time_step: options.time_step,
            grid_points: options.grid_points,
            fit_offset: u32::from(options.fit_offset),
            max_iterations: options.max_iterations,
            reserved0: 0,
            oscillation_amplitude: 0.0,
            oscillation_frequency: 0.0,
            oscillation_phase: 0.0,
            oscillation_direction: [0.0; 3],
            root_times: std::ptr::null(),
            root_frames: std::ptr::null(),
            root_count: 0,
            reserved: [0; 4],
        }
    }
}

#[cfg(target_pointer_width = "64")]
const _: () = {
    assert!(size_of::<shx_friction_fit_def>() == 256);
    assert!(offset_of!(shx_friction_fit_def, direction) == 16 && offset_of!(shx_friction_fit_def, grid_points) == 136);
    assert!(
        offset_of!(shx_friction_fit_def, oscillation_amplitude) == 152 && offset_of!(shx_friction_fit_def, root_times) == 200
    );
};

/// Result for one coefficient.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_fitted_coefficient {
    /// SHX_COEFFICIENT_: whether the recording determines it.
    pub status: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Best value, in the unit of the coefficient.
    pub value: f64,
    /// Standard error, in the same unit. Infinite if the curve does not depend on the coefficient.
    pub standard_error: f64,
    /// Relative change of the value, to first order, if the steps were
    /// half as long. NaN if standard_error is infinite.
    pub step_sensitivity: f64,
    /// Largest grid value below the best one that the curve
    /// excludes by two standard deviations; 0 if there is none.
    pub excluded_below: f64,
    /// Smallest such grid value above; infinite if there is none.
    pub excluded_above: f64,
}

/// Result of a fit. Fill it with shx_friction_fit_report_init.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct shx_friction_fit_report {
    /// Set by shx_friction_fit_report_init.
    pub struct_size: u32,
    /// 1: the search ended at a minimum. 0: the values are the best that were found.
    pub converged: u32,
    /// gamma, kg m^3/s.
    pub internal_friction: shx_fitted_coefficient,
    /// mu, s.
    pub viscosity: shx_fitted_coefficient,
    /// nu, kg/(m s).
    pub air_drag: shx_fitted_coefficient,
    /// RMS of the compared residuals, in the unit of the recorded values.
    pub rms_residual: f64,
    /// Standard deviation of the residuals, corrected for the number of fitted coefficients:
    /// the noise of the recording if the model is right.
    pub noise: f64,
    /// Correlation of consecutive residuals, -1 to 1. Near 1 the model lacks
    /// something, and the standard errors are too small.
    pub residual_correlation: f64,
    /// Constant added to the simulated values; 0 unless fitted.
    pub offset: f64,
    /// Number of simulated curves.
    pub simulations: u32,
    /// Number of steps of the best curve that did not converge.
    pub unconverged: u32,
    /// Index of the first value that was compared.
    pub first_compared: u32,
    /// Number of values that were compared: that one and all after it.
    pub compared: u32,
}

const UNFITTED: shx_fitted_coefficient = shx_fitted_coefficient {
    status: SHX_COEFFICIENT_NOT_FITTED,
    reserved: 0,
    value: 0.0,
    standard_error: 0.0,
    step_sensitivity: 0.0,
    excluded_below: 0.0,
    excluded_above: 0.0,
};

// SAFETY: repr(C), a u32 first, no padding (asserted below), integers and doubles only.
unsafe impl Versioned for shx_friction_fit_report {
    const FIRST_SIZE: usize = size_of::<Self>();

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            converged: 0,
            internal_friction: UNFITTED,
            viscosity: UNFITTED,
            air_drag: UNFITTED,
            rms_residual: 0.0,
            noise: 0.0,
            residual_correlation: 0.0,
            offset: 0.0,
            simulations: 0,
            unconverged: 0,
            first_compared: 0,
            compared: 0,
        }
    }
}

const _: () = {
    assert!(size_of::<shx_fitted_coefficient>() == 48 && offset_of!(shx_fitted_coefficient, value) == 8);
    assert!(size_of::<shx_friction_fit_report>() == 200 && offset_of!(shx_friction_fit_report, rms_residual) == 152);
};

impl shx_friction_fit_def {
    fn options(&self, solver: shx_solver_def) -> Result<FrictionFitOptions> {
        if solver.parallel_for.is_some() {
            return Err(Error::Unsupported {
                argument: "solver.parallel_for".into(),
                value: "a function".into(),
                hint: "use worker_count: a fit runs on its own threads".into(),
            });
        }
        if self.coefficients == 0 || self.coefficients > 7 {
            return Err(Error::invalid(
                "friction.coefficients",
                self.coefficients,
                "SHX_FRICTION_INTERNAL, _VISCOSITY and _AIR_DRAG bits, at least one",
            ));
        }
        let settings = [
            (self.internal_friction_range, self.internal_friction_guess),
            (self.viscosity_range, self.viscosity_guess),
            (self.air_drag_range, self.air_drag_guess),
        ];
        let sought = Coefficient::ALL.into_iter().zip(settings);
        let sought = sought.filter(|(coefficient, _)| self.coefficients & *coefficient as u32 != 0);
        let options = FrictionFitOptions {
            solver: solver.options().map_err(in_words_of_c)?,
            sought: sought
                .map(|(coefficient, (range, guess))| Sought { coefficient, range, guess: (guess != 0.0).then_some(guess) })
                .collect(),
            start: match self.start {
                SHX_FRICTION_START_SETTLED => Start::Settled,
                SHX_FRICTION_START_AS_DEFINED => Start::AsDefined,
                other => return Err(Error::invalid("friction.start", other, "one of SHX_FRICTION_START_")),
            },
            lead_in: self.lead_in,
            discard: self.discard,
            time_step: self.time_step,
            grid_points: self.grid_points,
            fit_offset: check_flag("friction.fit_offset", self.fit_offset)?,
            max_iterations: self.max_iterations,
        };
        options.check("friction")?;
        Ok(options)
    }

    fn observable(&self) -> Result<Observable> {
        let direction = Vector3::from(self.direction);
        Ok(match self.observable {
            SHX_OBSERVABLE_SPAN => Observable::Span,
            SHX_OBSERVABLE_DEPTH => Observable::Depth,
            SHX_OBSERVABLE_OFFSET => Observable::Offset(direction),
            SHX_OBSERVABLE_ANGLE => Observable::Angle(direction),
            other => return Err(Error::invalid("friction.observable", other, "one of SHX_OBSERVABLE_")),
        })
    }

    /// # Safety
    /// `root_times` and `root_frames` are null or point to `root_count` items.
    unsafe fn motion(&self) -> Result<RootMotion> {
        // SAFETY: the same.
        let (times, frames) = unsafe {
            (
                array("friction.root_times", "friction.root_count", self.root_times, self.root_count)?,
                array("friction.root_frames", "friction.root_count", self.root_frames, self.root_count)?,
            )
        };
        let oscillates = self.oscillation_frequency != 0.0 || self.oscillation_amplitude != 0.0;
        if times.is_empty() {
            let up = self.oscillation_direction == [0.0; 3];
            return Ok(if oscillates {
                RootMotion::Oscillation {
                    amplitude: self.oscillation_amplitude,
                    frequency: self.oscillation_frequency,
                    phase: self.oscillation_phase,
                    direction: (!up).then_some(Vector3::from(self.oscillation_direction)),
                }
            } else {
                RootMotion::Still
            });
        }
        if oscillates {
            let expected = "0: the root either oscillates or follows frames";
            return Err(Error::invalid("friction.root_count", self.root_count, expected));
        }
        let frame = |(index, frame): (usize, &shx_frame)| frame.checked(&format!("friction.root_frames[{index}]"));
        let frames = frames.iter().enumerate().map(frame).collect::<Result<Vec<_>>>()?;
        let spline = PoseSpline::new(times.to_vec(), frames).map_err(|error| match error {
            Error::InvalidArgument { argument, value, expected } => {
                Error::InvalidArgument { argument: format!("friction.root_{argument}"), value, expected }
            }
            other => other,
        })?;
        Ok(RootMotion::Recorded(spline))
    }
}

/// Renames the arguments of the analysis to those of shx_fit_friction.
fn in_words_of_c(error: Error) -> Error {
    let rename = |argument: String| {
        for (ours, theirs) in [
            ("options.solver.", "solver."),
            ("options.sought", "friction.coefficients"),
            ("options.", "friction."),
            ("recording.direction", "friction.direction"),
            ("recording.", ""),
            ("motion.", "friction.oscillation_"),
            ("def.", "solver."),
        ] {
            if let Some(rest) = argument.strip_prefix(ours) {
                return format!("{theirs}{rest}");
            }
        }
        argument
    };
    match error {
        Error::InvalidArgument { argument, value, expected } => {
            Error::InvalidArgument { argument: rename(argument), value, expected }
        }
        Error::Unsupported { argument, value, hint } => Error::Unsupported { argument: rename(argument), value, hint },
        other => other,
    }
}

fn report(fit: &FrictionFit, strand: &shx_strand_def) -> shx_friction_fit_report {
    let fitted = |coefficient: Coefficient, own: f64| {
        let found = fit.coefficients.iter().find(|fitted| fitted.coefficient == coefficient);
        found.map_or(shx_fitted_coefficient { value: own, ..UNFITTED }, |found| shx_fitted_coefficient {
            status: match found.verdict {
                Verdict::Determined => SHX_COEFFICIENT_DETERMINED,
                Verdict::Undetermined => SHX_COEFFICIENT_UNDETERMINED,
                Verdict::AtLowerEnd => SHX_COEFFICIENT_AT_LOWER_BOUND,
                Verdict::AtUpperEnd => SHX_COEFFICIENT_AT_UPPER_BOUND,
            },
            reserved: 0,
            value: found.value,
            standard_error: found.standard_error,
            step_sensitivity: found.step_shift,
            excluded_below: found.excluded[0],
            excluded_above: found.excluded[1],
        })
    };
    shx_friction_fit_report {
        struct_size: size_of::<shx_friction_fit_report>() as u32,
        converged: u32::from(fit.converged),
        internal_friction: fitted(Coefficient::InternalFriction, strand.internal_friction),
        viscosity: fitted(Coefficient::Viscosity, strand.viscosity),
        air_drag: fitted(Coefficient::AirDrag, strand.air_drag),
        rms_residual: fit.rms_residual,
        noise: fit.noise,
        residual_correlation: fit.residual_correlation,
        offset: fit.offset,
        simulations: fit.simulations,
        unconverged: fit.unconverged,
        first_compared: fit.first_compared as u32,
        compared: fit.curve.len() as u32,
    }
}

/// Fills *def with defaults. size is sizeof(shx_friction_fit_def).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_friction_fit_def_init(def: *mut shx_friction_fit_def, size: usize) -> shx_result {
    // SAFETY: the caller guarantees size bytes at def.
    unsafe { initialise("shx_friction_fit_def_init", "def", def, size) }
}

/// Fills *report with defaults. size is sizeof(shx_friction_fit_report).
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE.
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_friction_fit_report_init(report: *mut shx_friction_fit_report, size: usize) -> shx_result {
    // SAFETY: the caller guarantees that report holds size bytes.
    unsafe { initialise("shx_friction_fit_report_init", "report", report, size) }
}

/// Fits friction coefficients of a strand to a recorded curve (Bertails et al. 2006, section 4.2):
/// internal friction from the span of a curl that is shaken vertically, air drag from a pendulum that
/// comes to rest. The recording has count times, s, strictly increasing, and as many values; at least two
/// more of them are compared than there are unknowns. The fit simulates it with the strand and minimises
/// the squared difference over the logarithms of the coefficients; the strand's own values of fitted
/// coefficients have no effect. solver gives gravity, wind, integrator and worker_count; null: defaults.
/// Its log is not used. docs/theory/friction_fit.md explains how to record. The result goes to out_report.
/// out_curve is null or holds count doubles: the best curve, starting with value first_compared. Takes
/// some 20 simulations of the recording for one coefficient, 120 for two. A coefficient that the
/// recording does not determine is not an error: see status.
/// Errors: SHX_ERROR_NULL_ARGUMENT, SHX_ERROR_STRUCT_SIZE,
/// SHX_ERROR_INVALID_ARGUMENT (also a strand that finds no equilibrium, and a range
/// in which no simulation stays finite), SHX_ERROR_UNSUPPORTED (parallel_for).
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shx_fit_friction(
    solver: *const shx_solver_def,
    strand: *const shx_strand_def,
    friction: *const shx_friction_fit_def,
    times: *const f64,
    values: *const f64,
    count: usize,
    out_report: *mut shx_friction_fit_report,
    out_curve: *mut f64,
) -> shx_result {
    let body = || -> Result<()> {
        let solver = if solver.is_null() {
            shx_solver_def::defaults()
        } else {
            // SAFETY: the caller's structure, of the size that it states.
            unsafe { read_versioned("solver", solver)? }
        };
        // SAFETY: the caller's structures, of the sizes that they state, and what they point to; count numbers, and room for as many.
        let (strand, definition, friction, motion, times, values, output, curve) = unsafe {
            let strand = read_versioned("strand", strand)?;
            let friction = read_versioned("friction", friction)?;
            (
                strand,
                strand.definition("strand")?,
                friction,
                friction.motion()?,
                array("times", "count", times, count)?,
                array("values", "count", values, count)?,
                VersionedOutput::new("out_report", out_report)?,
                OutputList::optional("out_curve", "count", out_curve, count)?,
            )
        };
        if friction.reserved0 != 0 {
            return Err(Error::invalid("friction.reserved0", friction.reserved0, "0"));
        }
        check_reserved("friction", &friction.reserved)?;
        let options = friction.options(solver)?;
        let recording = Recording { times: times.to_vec(), values: values.to_vec(), observable: friction.observable()? };
        let fit = on_own_thread(|| fit_friction(&definition, &recording, &motion, &options)).map_err(in_words_of_c)?;
        if let Some(curve) = curve {
            curve.write(&fit.curve)?;
        }
        output.write(&report(&fit, &strand));
        Ok(())
    };
    call("shx_fit_friction", body)
}
