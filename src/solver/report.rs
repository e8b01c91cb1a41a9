//! What a step tells afterwards.

use nalgebra::Vector3;

pub use super::holding::ContactTally;
pub use crate::energy::Energies;
pub use crate::meter::Stopped;

/// What happened in a call of [`Solver::step`](super::Solver::step), all its substeps together.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepReport {
    /// Substeps taken.
    pub substeps: u32,
    /// Strand-substeps rolled back because a state turned non-finite, or touches or constraints drove it astray and found no end.
    pub quarantined: u32,
    /// Strand-substeps whose Newton iteration ended at the cap or could not descend further before reaching the tolerance.
    pub unconverged: u32,
    /// Most Newton iterations that a strand took in a substep.
    pub max_iterations: u32,
    /// Mean Newton iterations a strand and substep.
    pub mean_iterations: f64,
    /// How far an element of any strand may still be from where its iteration would end, rad.
    pub max_residual: f64,
    /// Largest condition number met (dense singular-value solver only; otherwise 0).
    pub max_condition: f64,
    /// Strand-substeps that were taken in parts (see [`StepOptions::max_subdivisions`](crate::step::options::StepOptions)).
    pub subdivided: u32,
    /// The most that a strand's substep, or a part of it, added to the error of a point's position, in units of the strand's length; 0
    /// where no error tolerance was given.
    pub max_error: f64,
    /// Energies after the step.
    pub energies: Energies,
    /// What contact and constraints came to.
    pub contact: ContactTally,
    /// Why it was ended before all strands were at their end, if it was, see [`StepLimits`](crate::meter::StepLimits).
    pub stopped: Stopped,
    /// Strand-substeps that were left for that: part of `unconverged`.
    pub left: u32,
    /// Work on strands in contact or held by constraints, in units of [`StepLimits::work`](crate::meter::StepLimits::work); all substeps together.
    pub work: u64,
    /// Strands whose root jumped: they went along with it as they were, see [`SolverOptions::jump_acceleration`](super::definition::SolverOptions::jump_acceleration).
    pub carried: u32,
    /// The most parts that a substep was taken in, since a body went far among strands in it; 1: none was.
    pub parts: u32,
    /// Wall-clock time of the call, s.
    pub seconds: f64,
    /// What the call spent it on.
    pub phases: Phases,
}

/// What a step spent its time on, s. The sum of the first three is at most [`StepReport::seconds`]; the rest is what surrounds these.
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

/// How the elements of a strand are integrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadrature {
    /// Quadrature points an element.
    pub points: u32,
    /// What inertia, drag and weight of the most turned element err by, relative: 1e-12 stands for that or less, infinity for more than
    /// 1e-2.
    pub error: f64,
}

/// What a strand does to its follicle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wrench {
    /// Force on the follicle, N, world axes. At rest: the strand's weight.
    pub force: Vector3<f64>,
    /// Torque on the follicle about its origin, N·m, world axes.
    pub torque: Vector3<f64>,
}

/// How a strand fared in the last step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StrandStatus {
    /// Well.
    #[default]
    Ok,
    /// Newton stopped at the cap, or could not descend further, before reaching the tolerance; the state is usable.
    Unconverged,
    /// The state turned non-finite, or touches or constraints drove it astray and found no end: rolled back to the step's start.
    Quarantined,
}
