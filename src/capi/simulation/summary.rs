//! A one-line summary of a solver for the log.

use std::fmt;

use crate::math::lane::Precision;
use crate::math::lanes::InstructionSet;
use crate::solver::definition::{SolverOptions, Workers};
use crate::step::options::Integrator;

/// The options that distinguish solvers.
pub(crate) struct Summary<'a>(pub &'a SolverOptions);

impl fmt::Display for Summary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let SolverOptions { gravity, step, workers, instruction_set, .. } = self.0;
        let integrator = match step.integrator {
            Integrator::LinearlyImplicit => "linearly implicit",
            Integrator::ImplicitEuler => "implicit Euler",
            Integrator::SecondOrder => "second order",
            Integrator::Reference => "reference",
        };
        let precision = match step.precision {
            Precision::F64 => "double",
            Precision::F32 => "single",
        };
        let set = instruction_set.unwrap_or_else(InstructionSet::detected).name();
        write!(f, "superhelix {}: {integrator}, {precision} precision, {set}, ", env!("CARGO_PKG_VERSION"))?;
        match workers {
            Workers::Serial => write!(f, "1 thread")?,
            Workers::Pool(threads) => write!(f, "{threads} threads")?,
            Workers::Host(_) => write!(f, "the host's tasks")?,
        }
        write!(f, ", gravity ({}, {}, {}) m/s^2", gravity.x, gravity.y, gravity.z)
    }
}
