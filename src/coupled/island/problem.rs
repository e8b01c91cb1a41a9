//! The contact problem of an island's Newton iteration: the constraints in it, and its solution.

use nalgebra::Vector3;

use super::Island;
use super::ending::Outcome;
use crate::contact::constraint::step_constraint::ConstraintKind;
use crate::contact::options::{ContactModel, ContactOptions, GRAVITY, SPEED};
use crate::contact::solver::contact_space::{ContactSpace, End, SpaceConstraint};
use crate::contact::solver::gauss_seidel::{GaussSeidel, RelativeTolerance, Scales, Settings};
use crate::contact::solver::subdomains::partition::Partition;
use crate::coupled::constrained_strand::Strands;
use crate::error::Result;
use crate::meter::Meter;
use crate::workers::WorkerSet;

/// Up to this many constraints a contact problem costs less than the iteration of the strand that an exact solution spares. But where
/// surfaces would move by more than this fraction of an element's length, forces that part them in the linear model are far from those
/// that do so.
const SMALL: usize = 8;
const GENTLE: f64 = 0.01;
/// The tolerance of an island's first contact problem if it is larger, and of later ones as a fraction of the laws' residual after the
/// iteration before.
const FIRST: f64 = 1e-2;
const FORCING: f64 = 0.1;
/// The same of an island's first problem with springs: a thousandth of the largest force (root mean square), and less than what its
/// linear model misses. At rest the last step's forces meet it from the beginning, and would never improve: no more than [`FORCING`] of what
/// they begin with may be left, either.
const FIRST_OF_SPRINGS: f64 = 3e-2;
/// The tolerance with bilateral constraints, which hold to the last digit.
const CONSTRAINED: f64 = 1e-8;
/// Viscous friction is in full force where the normal force exceeds this fraction of the lightest strand's weight.
const RUBS_FULLY: f64 = 0.1;
/// In how many of an island's first iterations it may grow with the force: later, a contact lifted off by its own friction
/// would open and close for ever.
const ASKED: u32 = 3;

/// The memory of contact problems, kept by a worker from island to island, in its caches.
#[derive(Debug, Default)]
pub struct ProblemScratch {
    space: ContactSpace,
    solver: GaussSeidel,
    forces: Vec<Vector3<f64>>,
    partition: Partition,
}

impl Island {
    /// Solves the contact problem of an iteration, after the strands' first half. The constraints' forces become its solution,
    /// unless `meter` halts it. It costs at most [`Island::max_work`].
    ///
    /// # Errors
    /// If a number is not finite.
    pub(crate) fn solve<S: Default + Send>(
        &mut self,
        strands: &(impl Strands + ?Sized),
        options: &ContactOptions,
        step: f64,
        scratch: &mut ProblemScratch,
        workers: &WorkerSet<S>,
        meter: &Meter,
    ) -> Result<()> {
        if meter.is_halted() {
            return Ok(());
        }
        let ProblemScratch { space, solver, forces, partition } = scratch;
        self.progress.iterations += 1;
        space.reset(step)?;
        self.choose_included(strands);
        self.partition_included(strands, partition);
        for local in &partition.strands {
            if meter.is_halted() {
                return Ok(());
            }
            if !self.strand_is_included[*local as usize] {
                space.add_strand(0);
                continue;
            }
            let operator = &strands[self.strands[*local as usize] as usize].step.delassus;
            space.add_strand(operator.material_points).copy_from_slice(&operator.columns);
        }
        forces.clear();
        let lightest = self.strands.iter().map(|strand| strands[*strand as usize].mass).fold(f64::INFINITY, f64::min);
        for index in 0..self.included.len() {
            if meter.is_halted_at(index) {
                return Ok(());
            }
            let constraint = self.included[index] as usize;
            let rubs = (self.constraints[constraint].pressure() / (RUBS_FULLY * lightest * GRAVITY)).min(1.0);
            let before = if self.progress.iterations <= ASKED { 1.0 } else { self.constraints[constraint].rubs };
            self.constraints[constraint].rubs = rubs.min(before);
            let (law, mut unconstrained) = self.evaluate(constraint, strands, options, step);
            let [first, second] = self.ends[constraint];
            let at = |end: End| {
                let strand = &strands[self.strands[end.strand as usize] as usize];
                if strand.rest.is_resting() {
                    strand.resting_displacement(end.point, &self.is_included, |_| Vector3::zeros())
                } else {
                    strand.unconstrained(end.point)
                }
            };
            unconstrained += at(first);
            let second = self.constraints[constraint].second.map(|_| second);
            if let Some(end) = second {
                unconstrained -= at(end);
            }
            let placed = |end: End| End { strand: partition.place[end.strand as usize], ..end };
            space.add_constraint(SpaceConstraint { first: placed(first), second: second.map(placed), law, unconstrained })?;
            forces.push(self.constraints[constraint].force);
        }
        // The size of the problem, for tolerances relative to it.
        let longest = space.constraints().iter().map(|constraint| constraint.unconstrained.norm()).fold(0.0, f64::max);
        self.progress.report.size = if options.model.is_soft() { 1.0 } else { (longest / (SPEED * step)).max(1.0) };
        space.part(&partition.strand_ends, &partition.constraint_ends);
        // Springs have no exact laws: their tolerance is relative to the problem.
        let soft = options.model.is_soft();
        let scales = if soft { Scales::OfTheProblem } else { Scales::Fixed { force: lightest * GRAVITY, length: SPEED * step } };
        let part = if options.model == ContactModel::Coulomb && !self.phase.is_rough() { 0.1 } else { 1.0 };
        let tolerance = part * self.asked(options);
        // A large problem not more exactly than the iterate deserves: the next one solves again. (Bilateral constraints hold to
        // the last digit.)
        let size = self.progress.report.size;
        let is_first_of_springs = self.progress.iterations == 1 && options.model.has_linear_springs();
        let deserved = match self.progress.iterations {
            _ if self.included.len() <= SMALL && longest <= GENTLE * self.shortest_element(strands) => 0.0,
            _ if is_first_of_springs => FIRST_OF_SPRINGS,
            1 => FIRST * size,
            _ => (FIRST * size).min(FORCING * self.progress.law_residual),
        };
        let tolerance = if self.has_bilateral() { tolerance.min(CONSTRAINED) } else { tolerance.max(deserved) };
        let relative = is_first_of_springs.then(|| RelativeTolerance { part: FORCING, least: self.asked(options) });
        let settings = Settings { tolerance, relative, max_sweeps: options.max_sweeps, scales, max_work: self.max_work };
        self.progress.report = solver.solve_by(space, &settings, forces, workers, meter);
        self.progress.is_solved = self.progress.report.residual <= tolerance;
        self.sweeps += self.progress.report.sweeps;
        meter.spend(self.progress.report.work);
        if meter.is_halted() {
            return Ok(());
        }
        for (constraint, force) in self.included.iter().zip(&*forces) {
            let (first, constraint) = (self.ends[*constraint as usize][0], &mut self.constraints[*constraint as usize]);
            constraint.force = *force;
            if matches!(constraint.kind, ConstraintKind::Pin { .. }) {
                let strand = &strands[self.strands[first.strand as usize] as usize];
                constraint.force += Vector3::from(strand.step.pulled(first.point as usize));
            }
        }
        Ok(())
    }

    /// [`Island::solve`]. A number that is not finite ends the island's iteration: its strand is identified at the end.
    pub(crate) fn solve_or_diverge<S: Default + Send>(
        &mut self,
        strands: &(impl Strands + ?Sized),
        options: &ContactOptions,
        step: f64,
        scratch: &mut ProblemScratch,
        workers: &WorkerSet<S>,
        meter: &Meter,
    ) {
        if self.solve(strands, options, step, scratch, workers, meter).is_err() {
            self.phase = self.phase.ended();
            self.progress.ending.outcome = if self.is_relaxed() { Outcome::Diverged } else { Outcome::Unconverged };
        }
    }

    /// The mean length of an element, of the strand where that is least, m.
    fn shortest_element(&self, strands: &(impl Strands + ?Sized)) -> f64 {
        self.strands.iter().map(|strand| strands[*strand as usize].mean_element()).fold(f64::INFINITY, f64::min)
    }

    /// Selects the constraints of strands that move.
    fn choose_included(&mut self, strands: &(impl Strands + ?Sized)) {
        self.included.clear();
        self.is_included.clear();
        self.strand_is_included.clear();
        self.strand_is_included.resize(self.strands.len(), false);
        for (index, (constraint, ends)) in self.constraints.iter().zip(&self.ends).enumerate() {
            let is_included = !constraint.is_dormant() && constraint.moves(strands) && !self.is_beyond_held(index, strands);
            self.is_included.push(is_included);
            if is_included {
                self.included.push(index as u32);
                self.strand_is_included[ends[0].strand as usize] = true;
                if constraint.second.is_some() {
                    self.strand_is_included[ends[1].strand as usize] = true;
                }
            }
        }
    }

    /// Sorts them by the subdomains of a large problem, which threads sweep side by side. (Bilateral constraints join strands
    /// to blocks: problems with them are not divided.)
    fn partition_included(&mut self, strands: &(impl Strands + ?Sized), partition: &mut Partition) {
        let may = !self.has_bilateral();
        let Self { included, ends, constraints, .. } = self;
        let roots = self.strands.iter().map(|strand| strands[*strand as usize].step.now().0);
        let constraints = included.iter().map(|index| {
            let [first, second] = ends[*index as usize];
            [Some(first.strand), constraints[*index as usize].second.map(|_| second.strand)]
        });
        partition.update(roots, constraints, may);
        partition.put_in_order(included);
    }
}
