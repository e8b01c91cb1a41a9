//! Where sweeps over a large problem do not get on it is for a few touches that hang together closely: those around the worst are taken
//! out, and solved at once with their neighbours as they are (Schwarz's method, where it is needed). Patches that share no block do not see
//! each other.

use nalgebra::Vector3;

use super::block_newton::{BlockNewton, Goal};
use super::contact_space::ContactSpace;
use super::gauss_seidel::Report;
use super::system::System;
use crate::meter::Meter;
use crate::workers::WorkerSet;

/// Most patches at a time, and most rows of one.
const MAX_PATCHES: usize = 8;
const MAX_ROWS: usize = 40;
/// The residual that is asked of a patch, as a part of what is asked of the problem, and the part of its own that a patch may leave.
const AIM: f64 = 0.3;
const PART: f64 = 0.1;

/// The memory of the search.
#[derive(Debug, Clone, Default)]
pub(super) struct Patches {
    /// The residual of each row.
    residuals: Vec<f64>,
    /// Rows that are in a patch.
    taken: Vec<bool>,
    blocks: Vec<usize>,
    /// The turn of the last patch that has a block.
    turns: Vec<u32>,
    patches: Vec<Patch>,
}

/// Some touches.
#[derive(Debug, Clone, Default)]
struct Patch {
    rows: Vec<u32>,
    /// After the patches before that share a block with it.
    turn: u32,
    newton: BlockNewton,
}

impl Patches {
    /// Finds the patches around the touches that miss their laws most, and solves them for what is asked of the problem, or part of
    /// what they miss it by. Gives the work that it took.
    #[allow(clippy::too_many_arguments, reason = "the problem, where it stands, when to stop and who works")]
    pub(super) fn solve<S: Default + Send>(
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
        let aim = Goal { tolerance: AIM * tolerance, part: PART, max_work: goal.max_work / MAX_PATCHES as u64 };
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

    /// Looks at all rows.
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

    /// A patch: the rows that press, or miss their law, around the one that misses it most of those in no patch yet, nearest first by the blocks
    /// that they share, then ascending. False where none misses by more than `tolerance`.
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
