//! Reports of a step.

use nalgebra::Vector3;

pub use super::stepping::constrained_substep::ContactTally;
pub use crate::energy::Energies;
pub use crate::meter::Stopped;

/// The result of a call of [`Solver::step`](super::Solver::step), over all its substeps.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepReport {
    /// Substeps taken.
    pub substeps: u32,
    /// Strand-substeps that were rolled back because a state turned non-finite, or because contacts or constraints made it
    /// diverge.
    pub quarantined: u32,
    /// Strand-substeps whose Newton iteration reached the cap or could not descend further before the tolerance.
    pub unconverged: u32,
    /// Largest number of Newton iterations of a strand in a substep.
    pub max_iterations: u32,
    /// Mean number of Newton iterations per strand and substep.
    pub mean_iterations: f64,
    /// Largest estimated distance of an element from where its iteration would converge, rad.
    pub max_residual: f64,
    /// Largest condition number (dense singular-value solver only; otherwise 0).
    pub max_condition: f64,
    /// Strand-substeps that were subdivided (see [`StepOptions::max_subdivisions`](crate::step::options::StepOptions)).
    pub subdivided: u32,
    /// The largest error that a strand's substep, or a subdivision of it, added to a point's position, relative to the strand's
    /// length; 0 without an error tolerance.
    pub max_error: f64,
    /// Energies after the step.
    pub energies: Energies,
    /// Results of contact and constraints.
    pub contact: ContactTally,
    /// Why it ended before all strands converged, if it did: see [`StepLimits`](crate::meter::StepLimits).
    pub stopped: Stopped,
    /// Strand-substeps that ended for that reason: part of `unconverged`.
    pub left: u32,
    /// Work on strands in contact or with constraints, in units of [`StepLimits::work`](crate::meter::StepLimits::work), over all
    /// substeps.
    pub work: u64,
    /// Strands whose root jumped: they moved with it unchanged, see
    /// [`SolverOptions::jump_acceleration`](super::definition::SolverOptions::jump_acceleration).
    pub carried: u32,
    /// The largest number of parts into which a substep was divided because a body moved far among strands; 1 for none.
    pub parts: u32,
    /// Wall-clock time of the call, s.
    pub seconds: f64,
    /// The time of its phases.
    pub phases: Phases,
}

/// The time of a step's phases, s. The sum of the first three is at most [`StepReport::seconds`]; the rest is overhead.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Phases {
    /// The search for contacts between strands and with bodies.
    pub search: f64,
    /// The equations of motion of single strands.
    pub strands: f64,
    /// The contact problems of islands.
    pub contact: f64,
    /// Sampling since the step before, of all threads together: no part of the step itself.
    pub sampling: f64,
}

impl Phases {
    pub(super) fn add(&mut self, other: &Self) {
        self.search += other.search;
        self.strands += other.strands;
        self.contact += other.contact;
    }
}

/// The quadrature of a strand's elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadrature {
    /// Quadrature points per element.
    pub points: u32,
    /// Relative error of inertia, drag and weight of the most turned element: 1e-12 means that or less, infinity more than 1e-2.
    pub error: f64,
}

/// The action of a strand on its follicle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wrench {
    /// Force on the follicle, N, world axes. At rest: the strand's weight.
    pub force: Vector3<f64>,
    /// Torque on the follicle about its origin, N·m, world axes.
    pub torque: Vector3<f64>,
}

/// The status of a strand after the last step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StrandStatus {
    /// It converged.
    #[default]
    Ok,
    /// Newton reached the cap, or could not descend further, before the tolerance; the state is usable.
    Unconverged,
    /// The state turned non-finite, or contacts or constraints made it diverge: rolled back to the start of the step.
    Quarantined,
}
