//! The contact-space problem solved by nonsmooth block Gauss–Seidel: contact after contact, each by its law's exact solve
//! (Daviet, Bertails-Descoubes and Boissieux 2011, without their change of variables), accelerated (`conjugate.rs`). Small
//! problems, and patches of large ones where that is slow, are solved by Newton's iteration on all their contacts at once
//! (`block_newton.rs`), and large ones as a whole from near their solution (`sparse_newton.rs`).

use nalgebra::Vector3;

use super::bilateral_elimination::DependentConstraint;
use super::block_newton::{BlockNewton, Goal};
use super::conjugate::Conjugate;
use super::contact_space::ContactSpace;
use super::patch::Patches;
use super::sparse_newton::SparseNewton;
use super::system::System;
use crate::contact::constraint::law::Law;
use crate::meter::Meter;
use crate::workers::WorkerSet;

/// Cost of setting up a problem, and of the test for convergence after its solution, in sweeps.
const SET_UP: u64 = 8;

/// When to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The tolerance, see [`Report::residual`].
    pub tolerance: f64,
    /// A smaller one, where the forces are good from the beginning.
    pub relative: Option<RelativeTolerance>,
    /// The largest number of sweeps over all contacts.
    pub max_sweeps: u32,
    /// The scales of residuals.
    pub scales: Scales,
    /// The largest cost, nanoseconds or so: the solve ends with the round, or Newton's step, that exceeds it.
    pub max_work: u64,
}

/// A tolerance that follows from the residual that the forces have at the beginning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativeTolerance {
    /// The part of it that may be left.
    pub part: f64,
    /// No less is asked for than this.
    pub least: f64,
}

/// The scales of residuals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scales {
    /// The largest force of the problem and its largest unconstrained displacement.
    OfTheProblem,
    /// The same for every problem: a contact's own force, or `force` (N) if that is more; displacements in `length` (m).
    Fixed {
        /// N.
        force: f64,
        /// m.
        length: f64,
    },
}

impl Default for Settings {
    fn default() -> Self {
        Self { tolerance: 1e-6, relative: None, max_sweeps: 2000, scales: Scales::OfTheProblem, max_work: u64::MAX }
    }
}

/// The result of a solve.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    /// Sweeps made.
    pub sweeps: u32,
    /// The largest residual of any contact ([`crate::contact::constraint::law::Law::residual`]), forces in units of `force`, displacements of
    /// `length`.
    pub residual: f64,
    /// The scale of forces, N: a contact's own force where that is more.
    pub force: f64,
    /// The scale of displacements, m.
    pub length: f64,
    /// The size of the problem in these scales, 1 or more: the measure of what is small in it.
    pub size: f64,
    /// The cost, nanoseconds or so.
    pub work: u64,
    /// Constrained directions that depend on others.
    pub dependent: Vec<DependentConstraint>,
}

/// Sweeps in which the residual must halve.
const PATIENCE: u32 = 60;
/// Problems of at most this many contacts are first solved as a whole by Newton's iteration (its cost grows with their cube:
/// 400 take a second).
const WHOLE: usize = 100;
/// The same for contacts of one block,
const ONE_BLOCK: usize = 400;
/// and where sweeps are slow.
const RESCUE: usize = 150;
/// Sweeps between two checks of the residual: at first, and of a problem solved as a whole between Newton's first two attempts
/// (twice as many before the next, but not with bilateral constraints: most of what it cannot solve at once has no solution);
/// and the most, later.
const FIRST_ROUND: u32 = 5;
const ROUND: u32 = 20;
/// A round that leaves more than this fraction of the residual is slow: patches around the largest residuals are solved before
/// the next (`patch.rs`).
const SLOW: f64 = 0.5;
/// Patches are of use only near the solution: elsewhere a patch, at the cost of some sweeps, is soon undone by others.
const NEAR: f64 = 0.1;
/// A large problem whose residual is less than this is solved as a whole from where it is,
const CLOSE: f64 = 0.1;
/// if the tolerance is less than this fraction of the residual, or sweeps are slow,
const EASY: f64 = 0.3;
/// so many times at most,
const ATTEMPTS: u32 = 3;
/// and if a step costs no more than so many sweeps.
const DEAR: u64 = 60;

/// The solver; keeps its memory.
#[derive(Debug, Clone, Default)]
pub struct GaussSeidel {
    /// The problem, ready.
    pub system: System,
    forces: Vec<Vector3<f64>>,
    newton: BlockNewton,
    conjugate: Conjugate,
    patches: Patches,
    sparse_newton: SparseNewton,
    rows: Vec<u32>,
}

impl GaussSeidel {
    /// Solves the problem. `forces`: the initial forces, one per constraint, replaced by the solution.
    pub fn solve(&mut self, space: &ContactSpace, settings: &Settings, forces: &mut [Vector3<f64>]) -> Report {
        self.solve_by(space, settings, forces, &WorkerSet::<()>::serial(), &Meter::unlimited())
    }

    /// The same by workers, who sweep the problem's subdomains side by side: the same bits. Where `meter` halts it, it is left
    /// unsolved.
    pub(crate) fn solve_by<S: Default + Send>(
        &mut self,
        space: &ContactSpace,
        settings: &Settings,
        forces: &mut [Vector3<f64>],
        workers: &WorkerSet<S>,
        meter: &Meter,
    ) -> Report {
        self.system.prepare(space);
        let system = &mut self.system;
        self.forces.clear();
        for index in 0..system.rows.len() {
            let force = forces[system.rows[index].constraint];
            self.forces.push(force);
            if force != Vector3::zeros() {
                system.push(space, index, &force);
            }
        }
        let sweep_work = system.sweep_work();
        let mut report = Report { work: SET_UP * sweep_work, ..Report::default() };
        let most = if system.blocks() == 1 { ONE_BLOCK } else { WHOLE };
        let (whole, rescue) = (system.rows.len() <= most, system.rows.len() <= most.max(RESCUE));
        let mut tolerance = settings.tolerance;
        let mut last = f64::INFINITY;
        let (mut best, mut best_at) = (f64::INFINITY, 0);
        let (mut tried_whole, mut tries) = (false, 0_u32);
        let (mut attempts_at_once, mut attempts) = (false, 0);
        self.conjugate.restart(system, &self.forces);
        loop {
            settings.scales.set(system, &self.forces, &mut report);
            report.residual = residual(space, system, &self.forces, &report);
            if report.sweeps == 0
                && let Some(RelativeTolerance { part, least }) = settings.relative
            {
                tolerance = tolerance.min((part * report.residual).max(least));
            }
            let spent = report.sweeps >= settings.max_sweeps || report.work >= settings.max_work;
            if report.residual <= tolerance || spent || meter.is_halted() {
                break;
            }
            // A solve that makes no progress is left: Newton's next iteration asks again, from elsewhere.
            if report.residual < 0.5 * best {
                (best, best_at) = (report.residual, report.sweeps);
            } else if report.sweeps > best_at + PATIENCE {
                break;
            }
            let max_work = settings.max_work - report.work;
            let goal = Goal { tolerance, part: 0.0, max_work, unjams: tries == 0 };
            let slow = report.residual > SLOW * last;
            last = report.residual;
            // Never twice in a row: where Newton's iteration halts, sweeps lead on to where it does not.
            tried_whole = !tried_whole && ((whole && report.sweeps == 0) || (rescue && slow));
            if tried_whole {
                tries += u32::from(!system.bilateral.are_there());
                self.rows.clear();
                self.rows.extend(0..system.rows.len() as u32);
                self.newton.solve(space, system, &self.forces, &self.rows, &report, goal, meter);
                self.newton.apply(space, system, &mut self.forces);
                report.work += self.newton.work;
                self.conjugate.restart(system, &self.forces);
                report.sweeps += 1;
                continue;
            }
            let is_close = report.residual < CLOSE && (slow || tolerance < EASY * report.residual);
            // (Not with bilateral constraints, which make few blocks of many strands.)
            attempts_at_once = !attempts_at_once && !whole && is_close && attempts < ATTEMPTS && !system.bilateral.are_there();
            if attempts_at_once {
                attempts += 1;
                let most = DEAR * sweep_work;
                self.sparse_newton.solve(space, system, &mut self.forces, &report, goal, most, workers, meter);
                report.work += self.sparse_newton.work;
                self.conjugate.restart(system, &self.forces);
                report.sweeps += 1;
                continue;
            }
            if slow && report.residual < NEAR * report.size {
                report.work += self.patches.solve(space, system, &mut self.forces, &report, goal, workers, meter);
                self.conjugate.restart(system, &self.forces);
                report.sweeps += 1;
            }
            let round = match () {
                () if whole => ROUND.min(FIRST_ROUND << (tries.clamp(1, 3) - 1)),
                () if report.sweeps == 0 => FIRST_ROUND,
                () => ROUND,
            };
            self.conjugate.sweeps(space, system, &mut self.forces, round, workers, meter);
            report.sweeps += round + 1;
            report.work += u64::from(round + 1) * sweep_work;
        }
        for (row, force) in system.rows.iter().zip(&self.forces) {
            forces[row.constraint] = *force;
        }
        report.dependent = system.bilateral.finish(space, forces);
        report
    }
}

impl Scales {
    /// Sets the scales of a report, and the size of the problem in them.
    fn set(self, system: &System, forces: &[Vector3<f64>], report: &mut Report) {
        let mut force = forces.iter().fold(0.0, |a: f64, f| a.max(f.norm()));
        let mut length = system.rows.iter().fold(0.0, |a: f64, row| a.max(row.unconstrained.norm()));
        if let Self::Fixed { force: least_force, length: fixed } = self {
            // A contact's force is measured in itself, so that the largest is no larger than any.
            report.size = (length / fixed).max(1.0);
            (report.force, report.length) = (least_force, fixed);
            return;
        }
        if length == 0.0 {
            length = 1.0;
        }
        if force == 0.0 {
            let mobility = system.rows.iter().fold(0.0, |a: f64, row| a.max(row.response.trace() / 3.0));
            force = if mobility > 0.0 { length / mobility } else { 1.0 };
        }
        (report.force, report.length, report.size) = (force, length, 1.0);
    }
}

impl Report {
    /// The residual of a law in the report's scales, see [`Law::residual`].
    #[inline(always)]
    pub fn law_residual(&self, law: &Law, u: Vector3<f64>, force: Vector3<f64>, step: f64) -> f64 {
        law.residual(u, force, step, self.length, self.force.max(force.norm()))
    }
}

/// The largest residual of any row.
pub fn residual(space: &ContactSpace, system: &System, forces: &[Vector3<f64>], report: &Report) -> f64 {
    let mut worst = 0.0_f64;
    for (row, force) in system.rows.iter().zip(forces) {
        let law = &space.constraints()[row.constraint].law;
        worst = worst.max(report.law_residual(law, system.relative(row), *force, space.step()));
    }
    worst
}

#[cfg(test)]
pub(super) mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::contact::constraint::law::coefficient::Coefficient;
    use crate::contact::constraint::law::contact::{Contact, Friction};
    use crate::contact::constraint::law::response::Response;
    use crate::contact::solver::contact_space::{End, SpaceConstraint};
    use crate::workers::{ParallelFor, Workers};

    pub(in crate::contact::solver) const POINTS: u32 = 5;

    /// A host with one thread, which runs tasks in reverse order.
    pub(in crate::contact::solver) struct Backwards;

    impl ParallelFor for Backwards {
        fn run(&self, count: u32, _: u32, task: &(dyn Fn(u32, u32, u32) + Sync)) {
            (0..count).rev().for_each(|k| task(k, k + 1, 0));
        }
    }

    /// Cantilevers of unit stiffness with [`POINTS`] attached points, 1 m apart.
    pub(in crate::contact::solver) fn cantilevers(count: u32) -> ContactSpace {
        let mut space = ContactSpace::default();
        space.reset(1.0 / 60.0).unwrap();
        for _ in 0..count {
            let size = 3 * POINTS as usize;
            let matrix = space.add_strand(POINTS as usize);
            for k in 0..size * size {
                let (i, j) = (k % size, k / size);
                let (s, t) = ((i / 3).min(j / 3) as f64 + 1.0, (i / 3).max(j / 3) as f64 + 1.0);
                matrix[k] = if i % 3 == j % 3 { s * s * (3.0 * t - s) / 6.0 } else { 0.0 };
            }
        }
        space
    }

    /// A hard contact with Coulomb friction between two points, each of a strand, or of one with the ground.
    pub(in crate::contact::solver) fn touch(
        space: &mut ContactSpace,
        first: (u32, u32),
        second: Option<(u32, u32)>,
        normal: Vector3<f64>,
        unconstrained: Vector3<f64>,
    ) {
        let end = |(strand, point)| End { strand, point };
        let friction = Friction::Coulomb(Coefficient::uniform(0.3));
        let law = Law::Contact(Contact { normal, response: Response::Hard, friction });
        space.add_constraint(SpaceConstraint { first: end(first), second: second.map(end), law, unconstrained }).unwrap();
    }

    /// Cantilevers side by side that are pressed on the ground and against each other, in four subdomains; too many to be
    /// solved as a whole.
    fn four_parts() -> (ContactSpace, Vec<Vector3<f64>>) {
        let mut space = cantilevers(20);
        let add = |space: &mut ContactSpace, first: u32, second: Option<u32>, point: u32| {
            let normal = if second.is_some() { -Vector3::y() } else { Vector3::z() };
            let unconstrained =
                Vector3::new(0.01 * f64::from(point), 0.0, 0.0) - normal * (1.0 + 0.1 * f64::from((first * 7 + point) % 5));
            touch(space, (first, point), second.map(|second| (second, point)), normal, unconstrained);
        };
        let mut ends = Vec::new();
        for part in 0..4 {
            for strand in 5 * part..5 * part + 5 {
                for point in 0..POINTS {
                    add(&mut space, strand, None, point);
                    if strand % 5 < 4 {
                        add(&mut space, strand, Some(strand + 1), point);
                    }
                }
            }
            ends.push(space.constraints().len());
        }
        for strand in [4, 14, 9] {
            for point in 0..POINTS {
                add(&mut space, strand, Some(strand + 1), point);
            }
            ends.push(space.constraints().len());
        }
        space.part(&[5, 10, 15, 20], &ends);
        let forces = vec![Vector3::zeros(); space.constraints().len()];
        (space, forces)
    }

    #[test]
    fn subdomains_swept_side_by_side_satisfy_the_laws_with_the_same_bits_for_any_number_of_threads() {
        let (space, zeros) = four_parts();
        let settings = Settings { tolerance: 1e-9, ..Settings::default() };
        let mut alone = zeros.clone();
        let report = GaussSeidel::default().solve(&space, &settings, &mut alone);
        let mut displacements = Vec::new();
        space.displacements(&alone, &mut displacements);
        for (k, (constraint, force)) in space.constraints().iter().zip(&alone).enumerate() {
            let u = space.relative(k, &displacements);
            let law_residual = report.law_residual(&constraint.law, u, *force, space.step());
            assert!(law_residual < 2e-9, "contact {k}: {law_residual:e}");
        }
        // Contacts between subdomains press too.
        for between in alone.chunks(POINTS as usize).rev().take(3) {
            assert!(between.iter().any(|force| force.norm() > 1e-3 * report.force));
        }
        let others = [Workers::Pool(2), Workers::Pool(3), Workers::Pool(8), Workers::Host(Arc::new(Backwards))];
        for setting in others {
            let workers = WorkerSet::<()>::new(&setting).unwrap();
            let mut forces = zeros.clone();
            assert_eq!(GaussSeidel::default().solve_by(&space, &settings, &mut forces, &workers, &Meter::unlimited()), report);
            assert_eq!(forces, alone, "{setting:?}");
        }
    }
}
