//! What a host says to make a solver; strands: [`StrandDef`].

use nalgebra::Vector3;

use crate::contact::options::ContactOptions;
use crate::error::{Error, Result, check_finite, check_positive};
use crate::math::lanes::InstructionSet;
use crate::platform::HAS_CLOCK;
pub use crate::rod::definition::{MAX_ELEMENTS, StrandDef};
use crate::step::options::StepOptions;
pub use crate::workers::{ParallelFor, Workers};

/// What a solver is made from.
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
    /// Gravity, m/s². Default (0, 0, −9.81): z up. For a y-up host give (0, −9.81, 0).
    pub gravity: Vector3<f64>,
    /// Uniform wind, m/s; felt through [`Material::air_drag`](crate::rod::material::Material::air_drag).
    pub wind: Vector3<f64>,
    /// How a step is taken.
    pub step: StepOptions,
    /// Who runs the strands.
    pub workers: Workers,
    /// The vector instructions to use; `None`: the best that the machine has. Results are the same to the bit with all of them.
    pub instruction_set: Option<InstructionSet>,
    /// How contact is answered; costs nothing where nothing touches.
    pub contact: ContactOptions,
    /// A root that is sent to a place by a velocity change of more than this in a second, m/s², and by more than a quarter of its strand's
    /// length, *jumps*: hair could not follow. Its strand goes along with it as it is, in one step, and swings from there. Above zero; infinite:
    /// no root does. Default 200, twenty times what weighs on hair at rest: heads do less.
    pub jump_acceleration: f64,
    /// What a step may cost where its call does not say.
    pub limits: UsualLimits,
}

/// Limits of the steps that do not come with their own, see [`StepLimits`](crate::meter::StepLimits).
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
    /// Most work a substep; above zero. None: [`usual_work`](crate::meter::usual_work).
    pub work: Option<u64>,
    /// Seconds a call; above zero. None: any.
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
    /// Checks every value; `argument` is the name put before the field in the message.
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
