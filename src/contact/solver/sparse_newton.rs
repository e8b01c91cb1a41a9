//! Newton's iteration on all contacts of a large problem at once, for where its forces are nearly right: a few contacts between
//! strands that lie on each other may hold up sweeps for hundreds of rounds, and the step from there to the solution is short.
//!
//! The equations are those of [`crate::contact::constraint::law::linear`]; they are solved directly, since the strands that touch
//! each other form chains and layers in which little comes together (`multifrontal.rs`). All steps are taken in full: one that
//! increases residuals finds out which contacts press and which slide. The best point is kept.
//!
//! Files:
//!
//! - `multifrontal.rs`: Newton's equations of a problem's contacts, solved directly: multifrontal elimination (Duff and Reid 1983) along the strands that touch each other.
//! - `order.rs`: The order of elimination: which strands' contacts come together in one front, and where each contact is eliminated.
//! - `tests.rs`: Stacks of strands and random problems, against elimination with all numbers in one matrix.

mod multifrontal;
mod order;
#[cfg(test)]
mod tests;

use nalgebra::Vector3;

use self::multifrontal::{Linearised, Multifrontal};
use super::block_newton::Goal;
use super::contact_space::ContactSpace;
use super::gauss_seidel::{Report, residual};
use super::system::System;
use crate::contact::constraint::law::linear::Linear;
use crate::meter::Meter;
use crate::workers::WorkerSet;

/// Contacts of strands that move alike share a force nearly as they did before: the equations are damped by this fraction of each
/// contact's own response, or by the residual if that is less, but at least by the minimum.
const DAMPING: f64 = 1e-4;
const LEAST_DAMPING: f64 = 1e-9;
/// The largest number of steps.
const STEPS: u32 = 4;

/// The iteration's memory.
#[derive(Debug, Clone, Default)]
pub(super) struct SparseNewton {
    /// The cost of the last solve, nanoseconds or so.
    pub(super) work: u64,
    equations: Multifrontal,
    linear: Vec<Linear>,
    changes: Vec<Vector3<f64>>,
    best_forces: Vec<Vector3<f64>>,
    best_displacements: Vec<f64>,
}

impl SparseNewton {
    /// Improves `forces` until `goal` or leaves them as they are: a step that costs more than `most` is not taken. `report` has their
    /// residual, and its scales. By workers: the same bits.
    #[allow(clippy::too_many_arguments, reason = "the problem, where it stands, when to stop and who works")]
    pub(super) fn solve<S: Default + Send>(
        &mut self,
        space: &ContactSpace,
        system: &mut System,
        forces: &mut [Vector3<f64>],
        report: &Report,
        goal: Goal,
        most: u64,
        workers: &WorkerSet<S>,
        meter: &Meter,
    ) {
        self.work = 0;
        let mut law_residual = report.residual;
        let mut best = law_residual;
        self.best_forces.clear();
        self.best_forces.extend_from_slice(forces);
        self.best_displacements.clone_from(&system.displacements);
        for _ in 0..STEPS {
            self.linear.clear();
            self.linear.extend(system.rows.iter().zip(&*forces).map(|(row, force)| {
                let law = &space.constraints()[row.constraint].law;
                law.linearise(&system.relative(row), force, &row.response, space.step())
            }));
            let most = most.min(goal.max_work.saturating_sub(self.work));
            let Some(work) = self.equations.prepare(system, &self.linear, most).filter(|_| !meter.is_halted()) else { break };
            self.work += work;
            let damping = (law_residual / report.size).clamp(LEAST_DAMPING, DAMPING);
            let problem = Linearised { space, system, linear: &self.linear, damping };
            if !self.equations.solve(problem, &mut self.changes, workers, meter) {
                break;
            }
            for (index, change) in self.changes.iter().enumerate() {
                if *change != Vector3::zeros() {
                    forces[index] += change;
                    system.push(space, index, change);
                }
            }
            law_residual = residual(space, system, forces, report);
            if law_residual < best {
                best = law_residual;
                self.best_forces.copy_from_slice(forces);
                self.best_displacements.clone_from(&system.displacements);
            }
            if law_residual <= goal.tolerance {
                break;
            }
        }
        if law_residual != best {
            forces.copy_from_slice(&self.best_forces);
            system.displacements.clone_from(&self.best_displacements);
        }
    }
}
