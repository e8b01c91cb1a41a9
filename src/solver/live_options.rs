//! Options of a solver: read them, change them, and choose between two sets when restoring.

use nalgebra::Vector3;

use super::definition::{SolverOptions, Workers};
use super::strands::strand::Strand;
use super::{Solver, check_vector};
use crate::error::{Error, Result};
use crate::step::state::History;

/// The options of a solver after [`Solver::restore_with`]: gravity, wind, those of the step and of contact, limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RestoredOptions {
    /// The snapshot's: further steps give the same bits as after taking it.
    #[default]
    Snapshot,
    /// The solver's previous ones.
    Own,
}

impl Solver {
    /// The solver's options, with later changes.
    pub fn options(&self) -> &SolverOptions {
        &self.options
    }

    /// Changes options from the next step on. If the integrator changes, strands lose their history, as after a jump in time.
    /// Equal options change nothing.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] and [`Error::Unsupported`] naming `options.field`; also for different workers: they are created
    /// with the solver.
    pub fn set_options(&mut self, options: &SolverOptions) -> Result<()> {
        options.check("options")?;
        if !same_workers(&self.options.workers, &options.workers) {
            return Err(Error::Unsupported {
                argument: "options.workers".into(),
                value: format!("{:?}", options.workers),
                hint: format!("workers are made with the solver, which has {:?}: create another solver", self.options.workers),
            });
        }
        let before = std::mem::replace(&mut self.options, options.clone());
        // The workers keep their own task system.
        self.options.workers = before.workers.clone();
        self.options_changed(&before);
        Ok(())
    }

    /// Updates everything that depends on options.
    pub(super) fn options_changed(&mut self, before: &SolverOptions) {
        let (old, new) = (&before.step, self.options.step);
        if old.integrator != new.integrator {
            self.forget_steps();
        }
        if old.quadrature_tolerance != new.quadrature_tolerance {
            self.rules.set_tolerance(new.quadrature_tolerance);
            let rules = &self.rules;
            self.workers.for_each(&mut self.strands, |Strand { model, state, .. }, scratch| {
                state.adapt_rule(model, rules, &mut scratch.step.rule);
            });
        }
        if before.contact != self.options.contact {
            self.constrained_substep.forget_pairs();
        }
        if before.gravity != self.options.gravity {
            self.update_energies();
        }
    }

    /// Deletes the strands' history.
    pub(super) fn forget_steps(&mut self) {
        for strand in &mut self.strands {
            strand.state.history = History::default();
        }
    }

    pub(super) fn update_energies(&mut self) {
        let (gravity, rules) = (self.options.gravity, &self.rules);
        self.workers.for_each(&mut self.strands, |strand, scratch| {
            strand.update_energies(gravity, rules, &mut scratch.step.one.workspace.iterate.kinematics);
        });
    }

    /// Changes gravity, m/s², from the next step on.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a number that is not finite.
    pub fn set_gravity(&mut self, gravity: Vector3<f64>) -> Result<()> {
        check_vector("gravity", gravity)?;
        self.options.gravity = gravity;
        self.update_energies();
        Ok(())
    }

    /// Changes the uniform wind, m/s, from the next step on.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a number that is not finite.
    pub fn set_wind(&mut self, wind: Vector3<f64>) -> Result<()> {
        check_vector("wind", wind)?;
        self.options.wind = wind;
        Ok(())
    }
}

fn same_workers(a: &Workers, b: &Workers) -> bool {
    match (a, b) {
        (Workers::Serial, Workers::Serial) => true,
        (Workers::Pool(a), Workers::Pool(b)) => a == b,
        (Workers::Host(a), Workers::Host(b)) => std::sync::Arc::ptr_eq(a, b),
        _ => false,
    }
}
