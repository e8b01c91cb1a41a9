//! Time: all strands through a step, and what came of it.

use std::time::Instant;

use super::Solver;
use super::report::StepReport;
use super::strand::{self, Strand, Tally};
use crate::error::{Error, Result, check_positive};
use crate::step::{self, Setting, Surroundings};

/// The shortest substep, s: below it rounding of the positions, divided by the step's square, drowns every acceleration.
pub const SHORTEST_STEP: f64 = 1e-9;

impl Solver {
    /// Takes all strands through `dt` seconds in `substeps` equal parts.
    ///
    /// A strand that does not converge keeps its best state and is counted; one whose numbers turn non-finite is rolled back to the
    /// substep's start and counted; the others go on.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a time that is not finite and above zero, no substeps, or substeps below [`SHORTEST_STEP`].
    pub fn step(&mut self, dt: f64, substeps: u32) -> Result<StepReport> {
        let started = Instant::now();
        check_positive(|| "dt".into(), dt)?;
        if substeps == 0 {
            return Err(Error::invalid("substeps", substeps, "1 or more"));
        }
        let h = dt / f64::from(substeps);
        if h < SHORTEST_STEP {
            return Err(Error::invalid("dt / substeps", h, format!("{SHORTEST_STEP} s or more")));
        }
        let surroundings = Surroundings { gravity: self.options.gravity.into(), wind: self.options.wind.into() };
        let (options, rules) = (self.options.step, &*self.rules);
        let gravity = self.options.gravity;
        self.crew.for_each(&mut self.strands, |strand, workspace| {
            strand.tally = Tally::default();
            for _ in 0..substeps {
                strand.begin_root_way(h);
                let Strand { model, state, root_move, .. } = strand;
                let start = state.root;
                let root_at = |elapsed: f64| strand::root_after(root_move, &start, elapsed);
                let setting = Setting { model, surroundings: &surroundings, options: &options, rules };
                strand.outcome = step::take(&setting, state, &root_at, h, workspace);
                strand.advance_root(h);
                strand.tally.add(&strand.outcome);
            }
            if strand.outcome.quarantined {
                strand.update_energies(gravity, rules, &mut workspace.kinematics);
            } else {
                strand.energies = strand.energies_from(gravity, rules, &workspace.kinematics);
            }
        });
        Ok(self.report(substeps, started))
    }

    fn report(&self, substeps: u32, started: Instant) -> StepReport {
        let mut report = StepReport { substeps, ..StepReport::default() };
        let mut iterations = 0;
        for strand in &self.strands {
            let tally = &strand.tally;
            iterations += tally.iterations;
            report.max_iterations = report.max_iterations.max(tally.most_iterations);
            report.unconverged += tally.unconverged;
            report.quarantined += tally.quarantined;
            report.max_residual = report.max_residual.max(tally.residual);
            report.max_condition = report.max_condition.max(tally.condition);
            report.subdivided += tally.subdivided;
            report.max_error = report.max_error.max(tally.error);
            report.energies.kinetic += strand.energies.kinetic;
            report.energies.elastic += strand.energies.elastic;
            report.energies.gravity += strand.energies.gravity;
        }
        if !self.strands.is_empty() {
            report.mean_iterations = iterations as f64 / (self.strands.len() as f64 * f64::from(substeps));
        }
        report.seconds = started.elapsed().as_secs_f64();
        report
    }
}
