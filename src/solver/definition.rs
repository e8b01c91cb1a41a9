//! The options of a solver; strands: [`StrandDef`].

use nalgebra::Vector3;

use crate::contact::options::ContactOptions;
use crate::error::{Error, Result, check_finite, check_positive};
use crate::math::lanes::InstructionSet;
use crate::platform::HAS_CLOCK;
pub use crate::rod::definition::{MAX_ELEMENTS, StrandDef};
use crate::step::options::StepOptions;
pub use crate::workers::{ParallelFor, Workers};

/// Options of a solver.
///
/// ```
/// use superhelix::nalgebra::Vector3;
/// use superhelix::{Integrator, Solver, SolverOptions, StepOptions, Workers};
///
/// // y is up, a light wind, four threads, first order.
/// let options = SolverOptions {
///     gravity: Vector3::new(0.0, -9.81, 0.0),
///     wind: Vector3::new(1.5, 0.0, 0.0),
///     workers: Workers::Pool(4),
///     step: StepOptions { integrator: Integrator::ImplicitEuler, ..StepOptions::default() },
///     ..SolverOptions::default()
/// };
/// let solver = Solver::new(options)?;
/// assert_eq!(solver.options().wind.x, 1.5);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct SolverOptions {
    /// Gravity, m/s². Default (0, 0, −9.81): z up. For a y-up host use (0, −9.81, 0).
    pub gravity: Vector3<f64>,
    /// Uniform wind, m/s; acts through [`Material::air_drag`](crate::rod::material::Material::air_drag).
    pub wind: Vector3<f64>,
    /// Options of a step.
    pub step: StepOptions,
    /// The threads that step strands.
    pub workers: Workers,
    /// The vector instructions to use; `None` for the best of the machine. Results are the same to the bit with all of them.
    pub instruction_set: Option<InstructionSet>,
    /// Contact options; no cost where nothing is in contact.
    pub contact: ContactOptions,
    /// A root *jumps* if its new target changes its velocity by more than this per second, m/s², and its position by more than a
    /// quarter of its strand's length: hair could not follow. The strand moves along unchanged, in one step, and swings from
    /// there. Above zero; infinite for no jumps. Default 200, twenty times gravity: heads stay below it.
    pub jump_acceleration: f64,
    /// Budget of a step where its call has none.
    pub limits: UsualLimits,
}

/// Limits of steps without their own: see [`StepLimits`](crate::meter::StepLimits).
///
/// ```
/// use superhelix::{Solver, SolverOptions, UsualLimits};
///
/// let limits = UsualLimits { work: Some(50_000), seconds: None };
/// let solver = Solver::new(SolverOptions { limits, ..SolverOptions::default() })?;
/// assert_eq!(solver.options().limits.work, Some(50_000));
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct UsualLimits {
    /// Most work per substep; above zero. `None`: [`usual_work`](crate::meter::usual_work).
    pub work: Option<u64>,
    /// Seconds per call; above zero. `None`: no limit.
    pub seconds: Option<f64>,
}

impl Default for SolverOptions {
    fn default() -> Self {
        Self {
            gravity: Vector3::new(0.0, 0.0, -9.81),
            wind: Vector3::zeros(),
            step: StepOptions::default(),
            workers: Workers::default(),
            instruction_set: None,
            contact: ContactOptions::default(),
            jump_acceleration: 200.0,
            limits: UsualLimits::default(),
        }
    }
}

impl SolverOptions {
    /// Checks every value; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] or [`Error::Unsupported`] for the first value that cannot be used.
    pub fn check(&self, argument: &str) -> Result<()> {
        for axis in 0..3 {
            check_finite(|| format!("{argument}.gravity[{axis}]"), self.gravity[axis])?;
            check_finite(|| format!("{argument}.wind[{axis}]"), self.wind[axis])?;
        }
        self.step.check(argument)?;
        self.contact.check(&format!("{argument}.contact"))?;
        self.workers.check(argument)?;
        check_jump_acceleration(&format!("{argument}.jump_acceleration"), self.jump_acceleration)?;
        self.limits.check(&format!("{argument}.limits"))?;
        if let Some(set) = self.instruction_set
            && set > InstructionSet::detected()
        {
            return Err(Error::Unsupported {
                argument: format!("{argument}.instruction_set"),
                value: set.name().into(),
                hint: format!("this machine has {}", InstructionSet::detected().name()),
            });
        }
        Ok(())
    }
}

impl UsualLimits {
    pub(super) fn check(&self, argument: &str) -> Result<()> {
        if self.work == Some(0) {
            return Err(Error::invalid(format!("{argument}.work"), 0, "1 or more"));
        }
        let Some(seconds) = self.seconds else { return Ok(()) };
        check_positive(|| format!("{argument}.seconds"), seconds)?;
        if !HAS_CLOCK {
            let hint = "there is no clock on this platform; limit the work".into();
            return Err(Error::Unsupported { argument: format!("{argument}.seconds"), value: seconds.to_string(), hint });
        }
        Ok(())
    }
}

pub(super) fn check_jump_acceleration(argument: &str, value: f64) -> Result<()> {
    if value > 0.0 { Ok(()) } else { Err(Error::invalid(argument, value, "above 0, or infinite")) }
}
