//! The workers of a step and their scratch memory.

use super::at_points::Touched;
use super::trial_steps::TrialScratch;
use crate::coupled::island::problem::ProblemScratch;
use crate::step;

/// The scratch memory of one worker.
#[derive(Debug, Default)]
pub(in crate::solver) struct WorkerScratch {
    /// For strands, one pack at a time.
    pub step: step::scratch::StepScratch,
    /// For islands of constrained strands, one at a time.
    pub problem: ProblemScratch,
    /// For strands near bodies, one at a time.
    pub trial: TrialScratch,
    /// Contacts of a task's strands at their points.
    pub touched: Touched,
}

impl AsMut<ProblemScratch> for WorkerScratch {
    fn as_mut(&mut self) -> &mut ProblemScratch {
        &mut self.problem
    }
}

/// Workers with the scratch memory of a step.
pub(in crate::solver) type WorkerSet = crate::workers::WorkerSet<WorkerScratch>;
