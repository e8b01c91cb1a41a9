//! The contact-space problem solved by nonsmooth block Gauss–Seidel: touch after touch, each by its law's exact solve
//! (Daviet, Bertails-Descoubes and Boissieux 2011, without their change of variables), accelerated (`conjugate.rs`); small problems,
//! and patches of large ones where that is slow, by Newton's iteration on all their touches at once (`block_newton.rs`).

use nalgebra::Vector3;

use super::block_newton::BlockNewton;
use super::bonds::DependentBond;
use super::conjugate::Conjugate;
use super::contact_space::ContactSpace;
use super::patch::Patches;
use super::system::System;
use crate::math::lane::{Kernel, Lane};

/// When to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The residual asked for, see [`Report::residual`].
    pub tolerance: f64,
    /// Most sweeps over all touches.
    pub max_sweeps: u32,
    /// The least scales of force (N) and length (m): those of a larger problem that this one is part of, else zero.
    pub least: [f64; 2],
}

impl Default for Settings {
    fn default() -> Self {
        Self { tolerance: 1e-6, max_sweeps: 2000, least: [0.0; 2] }
    }
}

/// What came of a solve.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    /// Sweeps made.
    pub sweeps: u32,
    /// The largest residual of any touch ([`super::law::Law::residual`]), forces measured in `force`, displacements in `length`.
    pub residual: f64,
    /// The largest force of any touch, N; where all are zero, what would move the most mobile touch by `length`.
    pub force: f64,
    /// The largest free displacement of any touch, m.
    pub length: f64,
    /// Held directions that depend on others.
    pub dependent: Vec<DependentBond>,
}

/// Sweeps in which the residual must halve.
const PATIENCE: u32 = 60;
/// Problems of at most so many touches are taken whole by Newton's iteration first (its price grows with their cube: 400 take a second).
const WHOLE: usize = 100;
/// So many where they are one block's,
const ONE_BLOCK: usize = 400;
/// and so many where sweeps are slow.
const RESCUE: usize = 150;
/// Sweeps between looks at the residual: the first time, and of what is taken whole, between Newton's tries; and later.
const FIRST_ROUND: u32 = 5;
const ROUND: u32 = 20;
/// A round that leaves more than this part of the residual is slow: then it is for a few touches, and so many patches of so many around the
/// worst are solved, each with its neighbours as they are (`patch.rs`), before the next round.
const SLOW: f64 = 0.5;
const PATCHES: usize = 8;
const PATCH: usize = 40;
/// That is of use only near the solution: elsewhere a patch, of the price of some sweeps, is soon undone by others.
const NEAR: f64 = 0.1;
/// The residual, as a part of what is asked for, and the part of its own residual that a patch may leave.
const AIM: f64 = 0.3;
const PART: f64 = 0.1;

/// The solver; keeps its memory.
#[derive(Debug, Clone, Default)]
pub struct GaussSeidel {
    /// The problem, ready.
    pub system: System,
    forces: Vec<Vector3<f64>>,
    newton: BlockNewton,
    conjugate: Conjugate,
    patches: Patches,
    rows: Vec<u32>,
}

impl GaussSeidel {
    /// Solves. `forces`: one a touch, where to start from, replaced by the solution.
    pub fn solve(&mut self, space: &ContactSpace, settings: &Settings, forces: &mut [Vector3<f64>]) -> Report {
        self.system.prepare(space);
        let system = &mut self.system;
        self.forces.clear();
        for index in 0..system.rows.len() {
            let force = forces[system.rows[index].touch];
            self.forces.push(force);
            if force != Vector3::zeros() {
                system.push(space, index, &force);
            }
        }
        let mut report = Report::default();
        let most = if system.blocks() == 1 { ONE_BLOCK } else { WHOLE };
        let (whole, rescue) = (system.rows.len() <= most, system.rows.len() <= most.max(RESCUE));
        let mut last = f64::INFINITY;
        let (mut best, mut best_at) = (f64::INFINITY, 0);
        let mut tried_whole = false;
        self.conjugate.restart(system, &self.forces);
        loop {
            scales(system, &self.forces, settings.least, &mut report);
            report.residual = residual(space, system, &self.forces, &report);
            if report.residual <= settings.tolerance || report.sweeps >= settings.max_sweeps {
                break;
            }
            // What does not get on will not: Newton's next iteration asks again, from elsewhere.
            if report.residual < 0.5 * best {
                (best, best_at) = (report.residual, report.sweeps);
            } else if report.sweeps > best_at + PATIENCE {
                break;
            }
            let slow = report.residual > SLOW * last;
            last = report.residual;
            // Never twice in a row: where Newton's iteration halts, sweeps lead on to where it does not.
            tried_whole = !tried_whole && ((whole && report.sweeps == 0) || (rescue && slow));
            if tried_whole {
                self.rows.clear();
                self.rows.extend(0..system.rows.len() as u32);
                self.newton.solve(space, system, &mut self.forces, &self.rows, &report, settings.tolerance, 0.0);
                self.conjugate.restart(system, &self.forces);
                report.sweeps += 1;
                continue;
            }
            if slow && report.residual < NEAR {
                self.patches.begin(space, system, &self.forces, &report);
                for _ in 0..PATCHES {
                    if !self.patches.next(system, &self.forces, settings.tolerance, PATCH, &mut self.rows) {
                        break;
                    }
                    self.newton.solve(space, system, &mut self.forces, &self.rows, &report, AIM * settings.tolerance, PART);
                }
                self.conjugate.restart(system, &self.forces);
                report.sweeps += 1;
            }
            let round = if whole || report.sweeps == 0 { FIRST_ROUND } else { ROUND };
            for _ in 0..round {
                self.conjugate.sweep(space, system, &mut self.forces);
            }
            // What the direction left outside the laws comes back.
            f64::call(Sweep { space, system, forces: &mut self.forces });
            report.sweeps += round + 1;
        }
        for (row, force) in system.rows.iter().zip(&self.forces) {
            forces[row.touch] = *force;
        }
        report.dependent = system.bonds.finish(space, forces);
        report
    }
}

/// One sweep.
pub(super) struct Sweep<'a> {
    pub space: &'a ContactSpace,
    pub system: &'a mut System,
    pub forces: &'a mut [Vector3<f64>],
}

impl Kernel for Sweep<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { space, system, forces } = self;
        for index in 0..system.rows.len() {
            let old = forces[index];
            let u = system.relative(&system.rows[index]);
            let row = &mut system.rows[index];
            let new = row.solve.solve(u - row.response * old);
            let change = new - old;
            if change != Vector3::zeros() {
                forces[index] = new;
                system.push(space, index, &change);
            }
        }
    }
}

/// The scales of force and length, `least` at least.
pub fn scales(system: &System, forces: &[Vector3<f64>], least: [f64; 2], report: &mut Report) {
    report.force = forces.iter().fold(least[0], |a: f64, f| a.max(f.norm()));
    report.length = system.rows.iter().fold(least[1], |a: f64, row| a.max(row.free.norm()));
    if report.length == 0.0 {
        report.length = 1.0;
    }
    if report.force == 0.0 {
        let mobility = system.rows.iter().fold(0.0, |a: f64, row| a.max(row.response.trace() / 3.0));
        report.force = if mobility > 0.0 { report.length / mobility } else { 1.0 };
    }
}

/// The largest residual of any row.
pub fn residual(space: &ContactSpace, system: &System, forces: &[Vector3<f64>], report: &Report) -> f64 {
    let mut worst = 0.0_f64;
    for (row, force) in system.rows.iter().zip(forces) {
        let law = &space.touches()[row.touch].law;
        worst = worst.max(law.residual(system.relative(row), *force, space.step(), report.length, report.force));
    }
    worst
}
