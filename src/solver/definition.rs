//! What a host says to make a solver; strands: [`StrandDef`].

use std::sync::Arc;

use nalgebra::Vector3;

use crate::contact::options::ContactOptions;
use crate::error::{Error, Result, check_finite};
use crate::math::lanes::InstructionSet;
pub use crate::rod::definition::{MAX_ELEMENTS, StrandDef};
use crate::step::options::StepOptions;

/// A host's own task system: `run(count, min_range, task)` must call `task(begin, end, worker)` over disjoint ranges that cover
/// `[0, count)` exactly once, on any threads, and return when all are done.
pub trait ParallelFor: Send + Sync {
    /// Runs `task` over `[0, count)`; a range should hold at least `min_range` items (the last may be shorter).
    fn run(&self, count: u32, min_range: u32, task: &(dyn Fn(u32, u32, u32) + Sync));
}

/// Who runs the strands of a step.
#[derive(Clone, Default)]
pub enum Workers {
    /// The calling thread.
    #[default]
    Serial,
    /// A private pool of that many threads (2 to 256), made with the solver and joined when it is dropped.
    Pool(usize),
    /// The host's task system.
    Host(Arc<dyn ParallelFor>),
}

impl std::fmt::Debug for Workers {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Workers::Serial => write!(f, "Serial"),
            Workers::Pool(count) => write!(f, "Pool({count})"),
            Workers::Host(_) => write!(f, "Host"),
        }
    }
}

/// What a solver is made from.
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
        if let Workers::Pool(count) = self.workers
            && !(2..=256).contains(&count)
        {
            return Err(Error::invalid(format!("{argument}.worker_count"), count, "2 to 256 threads, or 0 or 1 for none"));
        }
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
