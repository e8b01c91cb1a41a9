//! How the steps of a run went, all together.

use serde::Serialize;
use superhelix::StepReport;
use superhelix::internals::solver::report::ContactTally;

/// How the steps went, all together.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Report {
    /// Time steps taken.
    pub steps: u64,
    /// Mean Newton iterations a strand and step.
    pub iterations_mean: f64,
    /// Most Newton iterations of a strand in a step.
    pub iterations_max: u32,
    /// Strand-steps that stopped before reaching the tolerance.
    pub unconverged: u64,
    /// Those of them that a limit of work left as they were.
    pub unfinished: u64,
    /// Strand-steps rolled back: the state turned non-finite, or contacts and constraints made it diverge.
    pub quarantined: u64,
    /// Strand-steps that were taken in substeps of their own.
    pub subdivided: u64,
    /// The most that a strand's step added to the error of a position, in its lengths; 0 where errors were not looked at.
    pub error_max: f64,
    /// What contact and constraints came to, where there were any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactReport>,
    /// Wall time of stepping alone, s.
    pub seconds: f64,
}

/// What contact and constraints came to, all steps together.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct ContactReport {
    /// Touches that carried a force at the end of a step, at most.
    pub contacts_max: u32,
    /// The same, on average.
    pub contacts_mean: f64,
    /// How deep surfaces were in each other at the end of a step at most, m.
    pub penetration_max: f64,
    /// Newton iterations that strands tied together took in a step at most.
    pub iterations_max: u32,
    /// Sweeps of the contact problem's solver.
    pub sweeps: u64,
    /// Searches for contacts beyond the first of each step.
    pub searches: u64,
    /// Largest residual of the laws of contact and friction, relative.
    pub residual_max: f64,
    /// Largest distance of a constraint from holding at the end of a step, m.
    pub constraint_error_max: f64,
    /// Groups of strands tied together whose step ended elsewhere than it should.
    pub unconverged: u64,
    /// Strands whose roots were in a body and not exempt at the end of a step, at most.
    pub roots_inside_max: u32,
}

impl ContactReport {
    /// Adds a step's tally; `steps` have been taken with it, `of_this` of them in it.
    fn add(&mut self, step: &ContactTally, of_this: u64, steps: u64) {
        self.contacts_max = self.contacts_max.max(step.contacts);
        if steps > 0 {
            self.contacts_mean += (f64::from(step.contacts) - self.contacts_mean) * of_this as f64 / steps as f64;
        }
        self.penetration_max = self.penetration_max.max(step.penetration);
        self.iterations_max = self.iterations_max.max(step.iterations);
        self.sweeps += step.sweeps;
        self.searches += u64::from(step.searches);
        self.residual_max = self.residual_max.max(step.residual);
        self.constraint_error_max = self.constraint_error_max.max(step.constraint_error);
        self.unconverged += u64::from(step.unconverged);
        self.roots_inside_max = self.roots_inside_max.max(step.roots_inside);
    }
}

/// Overlaps below this are not told of, m: they print as none.
const TOLD: f64 = 5e-6;

/// Fewer unconverged strand-steps than this part of all are of violent motion, now and then.
const NOW_AND_THEN: f64 = 0.01;

impl Report {
    /// Adds a step's report.
    pub fn add(&mut self, step: &StepReport) {
        let substeps = u64::from(step.substeps);
        let total = self.steps + substeps;
        if total > 0 {
            self.iterations_mean += (step.mean_iterations - self.iterations_mean) * substeps as f64 / total as f64;
        }
        self.steps = total;
        self.iterations_max = self.iterations_max.max(step.max_iterations);
        self.unconverged += u64::from(step.unconverged);
        self.unfinished += u64::from(step.left);
        self.quarantined += u64::from(step.quarantined);
        self.subdivided += u64::from(step.subdivided);
        self.error_max = self.error_max.max(step.max_error);
        self.contact.get_or_insert_default().add(&step.contact, substeps, total);
        self.seconds += step.seconds;
    }

    /// One line on standard error where many of the steps of so many strands have not converged.
    pub fn warn(&self, name: &str, strands: usize) {
        let (failed, all) = (self.unconverged + self.quarantined, self.steps * strands as u64);
        if failed as f64 <= NOW_AND_THEN * all as f64 {
            return;
        }
        let cut = match self.unfinished {
            0 => String::new(),
            cut => format!(", {cut} of them because a step has only so much work (\"max_work\")"),
        };
        let deep = self.contact.map(|contact| contact.penetration_max).filter(|depth| *depth > TOLD);
        let deep = deep.map_or(String::new(), |depth| format!("; surfaces overlapped by up to {:.2} mm", depth * 1e3));
        eprintln!("warning: {name}: {failed} of {all} strand steps did not converge{cut}{deep}");
    }
}
