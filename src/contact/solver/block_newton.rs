//! All contacts of one block (a strand, or strands joined by bilateral constraints) at once, with those of other blocks fixed:
//! a semismooth Newton iteration on the laws' equations ([`crate::contact::constraint::law::linear`]) with a line search, and Gauss–Seidel sweeps
//! inside the block where that makes no progress. What it cannot solve, since friction jams it, goes to an interior-point method
//! (`interior_point.rs`).
//!
//! Contacts near each other on one strand move nearly alike, so that a sweep over contacts exchanges force between them in tiny
//! fractions (1e-3 and less per sweep); a joint solve finds what they have in common at once.
//!
//! Files:
//!
//! - `interior_point.rs`: Contacts that friction jams, at once: an interior-point method on Coulomb's law itself.

mod interior_point;

use nalgebra::{Matrix3, Vector3};

use self::interior_point::{InteriorPoint, Jammed, suitable};
use super::contact_space::ContactSpace;
use super::dense;
use super::gauss_seidel::Report;
use super::system::System;
use crate::contact::constraint::law::LawSolve;
use crate::contact::constraint::law::contact::Contact;
use crate::contact::constraint::law::linear::Linear;
use crate::meter::Meter;

/// Contacts that move alike to within this fraction of their own response share a force nearly as they did before: where W is
/// nearly singular the iteration is damped by this fraction of W, or by the residual if that is less, but at least by the
/// minimum.
const DAMPING: f64 = 1e-4;
const LEAST_DAMPING: f64 = 1e-9;
/// The largest number of Newton iterations of one visit to a block.
const MAX_ITERATIONS: u32 = 30;
/// This many of Newton's first steps are taken in full: a step that increases some residuals finds out which contacts press.
/// The best point is kept.
const FREE: u32 = 12;
/// A problem whose residual has not halved in this many steps is left: bilateral constraints that contradict contacts make
/// problems without solution. (Not before its full steps are taken, and a problem that is solved as a whole gets some more,
/// unless it has more than this many contacts: the cost of a step grows with their cube. Contacts under pressure from bilateral
/// constraints get all steps: if they were left earlier, constraints that can be satisfied would be reported as violated.)
const STEPS: u32 = 8;
const LARGE: usize = 100;
/// Sweeps in the block where Newton's direction leads nowhere.
const SWEEPS: u32 = 4;

/// Contacts up to this number that it cannot solve go to the interior-point method: its cost grows with their cube.
const FEW: usize = 40;

/// Costs in nanoseconds or so: of a row's law and its preparation; of a row in another's column of K; and the number of
/// multiplications of an elimination per nanosecond.
const WORK_A_ROW: u64 = 200;
const WORK_A_BLOCK: u64 = 25;
const MULTIPLICATIONS: u64 = 10;

/// When to stop.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Goal {
    /// At this residual, or
    pub tolerance: f64,
    /// at this fraction of the first one, or
    pub part: f64,
    /// when this cost is spent, nanoseconds or so.
    pub max_work: u64,
    /// Whether what Newton's iteration does not solve goes to the interior-point method. That begins from the problem, not from the present
    /// forces: of the same contacts it finds the same again.
    pub unjams: bool,
}

/// The solver's memory.
#[derive(Debug, Clone, Default)]
pub(in crate::contact) struct BlockNewton {
    /// The cost of the last solve.
    pub(in crate::contact) work: u64,
    /// The block's rows.
    rows: Vec<u32>,
    solves: Vec<LawSolve>,
    /// K: displacement of the rows per force at the rows, 3 rows each, column by column; only columns needed so far.
    coupling: Vec<f64>,
    known: Vec<bool>,
    forces: Vec<Vector3<f64>>,
    moved: Vec<Vector3<f64>>,
    linear: Vec<Linear>,
    /// A point of the line search.
    trial_forces: Vec<Vector3<f64>>,
    trial_moved: Vec<Vector3<f64>>,
    trial_linear: Vec<Linear>,
    direction: Vec<Vector3<f64>>,
    carried: Vec<Vector3<f64>>,
    active: Vec<usize>,
    matrix: Vec<f64>,
    rhs: Vec<f64>,
    best: Vec<Vector3<f64>>,
    interior_point: InteriorPoint,
    laws: Vec<Contact>,
    unconstrained: Vec<Vector3<f64>>,
}

impl BlockNewton {
    /// Solves for the forces of `rows` until `goal`, in the scales of `report`. [`BlockNewton::apply`] takes over the result.
    #[allow(clippy::too_many_arguments, reason = "the problem, where it stands, and when to stop")]
    pub(in crate::contact) fn solve(
        &mut self,
        space: &ContactSpace,
        system: &System,
        forces: &[Vector3<f64>],
        rows: &[u32],
        report: &Report,
        goal: Goal,
        meter: &Meter,
    ) {
        let Goal { tolerance, part, max_work, unjams } = goal;
        self.begin(system, forces, rows);
        self.work = WORK_A_ROW * rows.len() as u64;
        let mut worst = self.residual(space, system, report);
        self.best.clone_from(&self.forces);
        if worst <= tolerance {
            return;
        }
        let tolerance = tolerance.max(part * worst);
        let m = rows.len();
        self.coupling.clear();
        self.coupling.resize(9 * m * m, 0.0);
        self.known.clear();
        self.known.resize(m, false);
        let mut best = worst;
        let mut halved = (worst, 0);
        let until = match () {
            () if m > LARGE => 0,
            () if system.bilateral.are_there() => MAX_ITERATIONS,
            () if part > 0.0 => FREE,
            () => FREE + STEPS,
        };
        let mut merit = linearise(space, system, &self.rows, &self.forces, &self.moved, &mut self.linear);
        for k in 0..MAX_ITERATIONS {
            let rows = m as u64;
            let active = self.linear.iter().filter(|linear| linear.by_displacement != Matrix3::zeros()).count() as u64;
            let next = (3 * active).pow(3) / (3 * MULTIPLICATIONS) + WORK_A_BLOCK * active * rows + WORK_A_ROW * rows;
            if self.work + next > max_work || meter.is_halted() {
                break;
            }
            self.work += next;
            let better = self.direction(space, system, (worst / report.size).clamp(LEAST_DAMPING, DAMPING), meter)
                && self.search(space, system, &mut merit, k < FREE);
            if !better {
                for _ in 0..SWEEPS {
                    self.sweep(space, system);
                }
                merit = linearise(space, system, &self.rows, &self.forces, &self.moved, &mut self.linear);
            }
            worst = self.residual(space, system, report);
            if worst < best {
                best = worst;
                self.best.clone_from(&self.forces);
            }
            if worst <= tolerance {
                break;
            }
            if worst < 0.5 * halved.0 {
                halved = (worst, k);
            } else if k >= until.max(halved.1 + STEPS) {
                break;
            }
        }
        if unjams && best > tolerance && m <= FEW {
            self.unjam(space, system, report, Goal { tolerance, part: best, max_work, unjams }, meter);
        }
    }

    /// Solves by the interior-point method, and keeps the result if it leaves less than `goal.part`.
    fn unjam(&mut self, space: &ContactSpace, system: &System, report: &Report, goal: Goal, meter: &Meter) {
        let law_of = |row: &u32| suitable(&space.constraints()[system.rows[*row as usize].constraint].law);
        self.laws.clear();
        self.laws.extend(self.rows.iter().map_while(law_of));
        let m = self.rows.len();
        if self.laws.len() < m || self.work >= goal.max_work {
            return;
        }
        for column in 0..m {
            self.need(space, system, column);
        }
        self.unconstrained.clone_from(&self.moved);
        for i in 0..m {
            for j in 0..m {
                let by_force = self.block(i, j) * self.forces[j];
                self.unconstrained[i] -= by_force;
            }
        }
        let Self { interior_point, laws, unconstrained, coupling, .. } = self;
        let jammed = Jammed { laws, unconstrained, coupling, step: space.step() };
        let left = interior_point.solve(jammed, report, goal.tolerance, goal.max_work - self.work, meter);
        self.work += interior_point.work;
        if left < goal.part {
            self.best.clone_from(&self.interior_point.forces);
        }
    }

    /// Gives the rows the forces found.
    pub(in crate::contact) fn apply(&self, space: &ContactSpace, system: &mut System, forces: &mut [Vector3<f64>]) {
        for (row, force) in self.rows.iter().zip(&self.best) {
            let row = *row as usize;
            let change = force - forces[row];
            if change != Vector3::zeros() {
                forces[row] = *force;
                system.push(space, row, &change);
            }
        }
    }

    fn begin(&mut self, system: &System, forces: &[Vector3<f64>], rows: &[u32]) {
        self.rows.clear();
        self.rows.extend_from_slice(rows);
        self.solves.clear();
        self.solves.extend(rows.iter().map(|row| system.rows[*row as usize].solve));
        self.forces.clear();
        self.forces.extend(rows.iter().map(|row| forces[*row as usize]));
        self.moved.clear();
        self.moved.extend(rows.iter().map(|row| system.relative(&system.rows[*row as usize])));
    }

    fn residual(&self, space: &ContactSpace, system: &System, report: &Report) -> f64 {
        let mut worst = 0.0_f64;
        for ((row, force), u) in self.rows.iter().zip(&self.forces).zip(&self.moved) {
            let law = &space.constraints()[system.rows[*row as usize].constraint].law;
            worst = worst.max(report.law_residual(law, *u, *force, space.step()));
        }
        worst
    }

    /// Computes K's column of a row, if that is still to do.
    fn need(&mut self, space: &ContactSpace, system: &System, column: usize) {
        if self.known[column] {
            return;
        }
        self.known[column] = true;
        let m = self.rows.len();
        let from = &system.rows[self.rows[column] as usize];
        for (i, row) in self.rows.iter().enumerate() {
            let block = system.coupling(space, &system.rows[*row as usize], from);
            for c in 0..3 {
                self.coupling[(3 * column + c) * 3 * m + 3 * i..][..3].copy_from_slice(block.column(c).as_slice());
            }
        }
    }

    fn block(&self, i: usize, j: usize) -> Matrix3<f64> {
        let m = self.rows.len();
        Matrix3::from_fn(|a, b| self.coupling[(3 * j + b) * 3 * m + 3 * i + a])
    }

    /// Newton's direction, and the displacements along it. False where there is none.
    fn direction(&mut self, space: &ContactSpace, system: &System, damping: f64, meter: &Meter) -> bool {
        let m = self.rows.len();
        self.direction.clear();
        self.direction.resize(m, Vector3::zeros());
        self.carried.clear();
        self.carried.resize(m, Vector3::zeros());
        self.active.clear();
        for i in 0..m {
            if self.linear[i].by_displacement != Matrix3::zeros() {
                self.active.push(i);
            } else if self.linear[i].residual != Vector3::zeros() {
                // Without by_displacement the law is λ = 0.
                self.direction[i] = -self.linear[i].residual;
            }
        }
        for j in 0..m {
            if self.direction[j] != Vector3::zeros() {
                self.need(space, system, j);
                self.carry(j, self.direction[j]);
            }
        }
        let n = 3 * self.active.len();
        self.matrix.clear();
        self.matrix.resize(n * n, 0.0);
        self.rhs.clear();
        for a in 0..self.active.len() {
            self.need(space, system, self.active[a]);
        }
        for (a, i) in self.active.iter().enumerate() {
            let Linear { residual, by_force, by_displacement } = &self.linear[*i];
            let rhs = -(residual + by_displacement * self.carried[*i]);
            self.rhs.extend_from_slice(rhs.as_slice());
            for (b, j) in self.active.iter().enumerate() {
                let mut k = self.block(*i, *j);
                if i == j {
                    k += Matrix3::from_diagonal_element(damping * system.rows[self.rows[*i] as usize].response.trace());
                }
                let mut entry = by_displacement * k;
                if i == j {
                    entry += by_force;
                }
                for r in 0..3 {
                    for c in 0..3 {
                        self.matrix[(3 * a + r) * n + 3 * b + c] = entry[(r, c)];
                    }
                }
            }
        }
        if !dense::solve(&mut self.matrix, &mut self.rhs, meter) {
            return false;
        }
        for a in 0..self.active.len() {
            let change = Vector3::new(self.rhs[3 * a], self.rhs[3 * a + 1], self.rhs[3 * a + 2]);
            self.direction[self.active[a]] = change;
            self.carry(self.active[a], change);
        }
        self.carried.iter().all(|u| u.iter().all(|x| x.is_finite()))
    }

    /// Adds the displacements by a force at a row.
    fn carry(&mut self, column: usize, force: Vector3<f64>) {
        let size = 3 * self.rows.len();
        let columns = &self.coupling[3 * column * size..3 * (column + 1) * size];
        for (i, u) in self.carried.iter_mut().enumerate() {
            for c in 0..3 {
                for r in 0..3 {
                    u[r] += columns[c * size + 3 * i + r] * force[c];
                }
            }
        }
    }

    /// Line search along the direction. False if no point is better.
    fn search(&mut self, space: &ContactSpace, system: &System, merit: &mut f64, free: bool) -> bool {
        let mut t = 1.0;
        for _ in 0..5 {
            let along = |a: &[Vector3<f64>], d: &[Vector3<f64>], out: &mut Vec<Vector3<f64>>| {
                out.clear();
                out.extend(a.iter().zip(d).map(|(a, d)| a + d * t));
            };
            along(&self.forces, &self.direction, &mut self.trial_forces);
            along(&self.moved, &self.carried, &mut self.trial_moved);
            let (forces, moved) = (&self.trial_forces, &self.trial_moved);
            let trial = linearise(space, system, &self.rows, forces, moved, &mut self.trial_linear);
            if trial < (1.0 - 0.1 * t) * *merit || free {
                *merit = trial;
                std::mem::swap(&mut self.forces, &mut self.trial_forces);
                std::mem::swap(&mut self.moved, &mut self.trial_moved);
                std::mem::swap(&mut self.linear, &mut self.trial_linear);
                return true;
            }
            t *= 0.4;
        }
        false
    }

    /// A sweep over the block's contacts, each alone.
    fn sweep(&mut self, space: &ContactSpace, system: &System) {
        for i in 0..self.rows.len() {
            let response = &system.rows[self.rows[i] as usize].response;
            let old = self.forces[i];
            let new = self.solves[i].solve(self.moved[i] - response * old);
            if new != old {
                self.need(space, system, i);
                self.forces[i] = new;
                std::mem::swap(&mut self.carried, &mut self.moved);
                self.carry(i, new - old);
                std::mem::swap(&mut self.carried, &mut self.moved);
            }
        }
    }
}

/// Linearises the laws and returns the sum of their squared residuals.
fn linearise(
    space: &ContactSpace,
    system: &System,
    rows: &[u32],
    forces: &[Vector3<f64>],
    moved: &[Vector3<f64>],
    out: &mut Vec<Linear>,
) -> f64 {
    out.clear();
    let mut sum = 0.0;
    for ((row, force), u) in rows.iter().zip(forces).zip(moved) {
        let row = &system.rows[*row as usize];
        let linear = space.constraints()[row.constraint].law.linearise(u, force, &row.response, space.step());
        sum += linear.residual.norm_squared();
        out.push(linear);
    }
    sum
}
