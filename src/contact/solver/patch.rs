//! Patches: where sweeps over a large problem make no progress it is for a few closely coupled contacts. Those around the
//! largest residuals are solved at once, with their neighbours fixed (Schwarz's method, where it is needed). Patches that share
//! no block are independent.

use nalgebra::Vector3;

use super::block_newton::{BlockNewton, Goal};
use super::contact_space::ContactSpace;
use super::gauss_seidel::Report;
use super::system::System;
use crate::meter::Meter;
use crate::workers::WorkerSet;

/// The largest number of patches at a time, and of rows in one.
const MAX_PATCHES: usize = 8;
const MAX_ROWS: usize = 40;
/// The tolerance of a patch as a fraction of that of the problem, and as a fraction of its first residual.
const AIM: f64 = 0.3;
const PART: f64 = 0.1;

/// Memory of patches.
#[derive(Debug, Clone, Default)]
pub(in crate::contact) struct Patches {
    /// The residual of each row.
    residuals: Vec<f64>,
    /// Rows that are in a patch.
    taken: Vec<bool>,
    blocks: Vec<usize>,
    /// The turn of the last patch that includes a block.
    turns: Vec<u32>,
    patches: Vec<Patch>,
}

/// Some contacts.
#[derive(Debug, Clone, Default)]
struct Patch {
    rows: Vec<u32>,
    /// Its turn: after the earlier patches that share a block with it.
    turn: u32,
    newton: BlockNewton,
}

impl Patches {
    /// Finds the patches around the largest residuals and solves them to the problem's tolerance, or to a fraction of their
    /// residuals. Returns the cost.
    #[allow(clippy::too_many_arguments, reason = "the problem, where it stands, when to stop and who works")]
    pub(in crate::contact) fn solve<S: Default + Send>(
        &mut self,
        space: &ContactSpace,
        system: &mut System,
        forces: &mut [Vector3<f64>],
        report: &Report,
        goal: Goal,
        workers: &WorkerSet<S>,
        meter: &Meter,
    ) -> u64 {
        let tolerance = goal.tolerance;
        let aim = Goal { tolerance: AIM * tolerance, part: PART, max_work: goal.max_work / MAX_PATCHES as u64, ..goal };
        self.begin(space, system, forces, report);
        let mut patches = std::mem::take(&mut self.patches);
        patches.resize_with(MAX_PATCHES, Patch::default);
        let found =
            patches.iter_mut().map(|patch| self.find(system, forces, tolerance, patch)).take_while(|found| *found).count();
        let mut rest = &mut patches[..found];
        rest.sort_by_key(|patch| patch.turn);
        while let Some(first) = rest.first() {
            let turn = first.turn;
            let (now, later) = rest.split_at_mut(rest.partition_point(|patch| patch.turn == turn));
            let (shared, all) = (&*system, &*forces);
            workers.for_each_task(now, 1, 1, |patches, _| {
                for Patch { rows, newton, .. } in patches {
                    newton.solve(space, shared, all, rows, report, aim, meter);
                }
            });
            for patch in now {
                patch.newton.apply(space, system, forces);
            }
            rest = later;
        }
        let work = patches[..found].iter().map(|patch| patch.newton.work).sum();
        self.patches = patches;
        work
    }

    /// Computes all residuals.
    fn begin(&mut self, space: &ContactSpace, system: &System, forces: &[Vector3<f64>], report: &Report) {
        self.taken.clear();
        self.taken.resize(system.rows.len(), false);
        self.turns.clear();
        self.turns.resize(system.blocks(), 0);
        self.residuals.clear();
        self.residuals.extend(system.rows.iter().zip(forces).map(|(row, force)| {
            let law = &space.constraints()[row.constraint].law;
            report.law_residual(law, system.relative(row), *force, space.step())
        }));
    }

    /// Finds a patch: the rows that press or have a residual, around the one with the largest residual of those in no patch
    /// yet; the nearest by shared blocks first, then ascending. False if no residual exceeds `tolerance`.
    fn find(&mut self, system: &System, forces: &[Vector3<f64>], tolerance: f64, patch: &mut Patch) -> bool {
        let Patch { rows, turn, .. } = patch;
        let free = self.residuals.iter().enumerate().filter(|(row, _)| !self.taken[*row]);
        let Some((worst, _)) =
            free.filter(|(_, law_residual)| **law_residual > tolerance).max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(&a.0)))
        else {
            return false;
        };
        rows.clear();
        self.blocks.clear();
        let blocks_of = |row: usize| {
            let row = &system.rows[row];
            [Some(row.first), row.second].into_iter().flatten().map(|slot| system.block_at(slot.base))
        };
        self.blocks.extend(blocks_of(worst));
        let mut next = 0;
        while next < self.blocks.len() && rows.len() < MAX_ROWS {
            for row in system.rows_of(self.blocks[next]) {
                let index = *row as usize;
                let counts = forces[index] != Vector3::zeros() || self.residuals[index] > tolerance;
                if counts && rows.len() < MAX_ROWS && !rows.contains(row) {
                    rows.push(*row);
                    self.taken[index] = true;
                    for block in blocks_of(index) {
                        if !self.blocks.contains(&block) {
                            self.blocks.push(block);
                        }
                    }
                }
            }
            next += 1;
        }
        rows.sort_unstable();
        *turn = 1 + self.blocks.iter().map(|block| self.turns[*block]).max().unwrap_or(0);
        for block in &self.blocks {
            self.turns[*block] = *turn;
        }
        true
    }
}
