//! Where sweeps over a large problem do not get on it is for a few touches that hang together closely: those around the worst are taken
//! out, and solved at once with their neighbours as they are (Schwarz's method, where it is needed).

use nalgebra::Vector3;

use super::contact_space::ContactSpace;
use super::gauss_seidel::Report;
use super::system::System;

/// The memory of the search.
#[derive(Debug, Clone, Default)]
pub(super) struct Patches {
    /// The residual of each row.
    misses: Vec<f64>,
    /// Rows that were in a patch since the last [`Patches::begin`].
    taken: Vec<bool>,
    blocks: Vec<usize>,
}

impl Patches {
    /// Looks at all rows.
    pub(super) fn begin(&mut self, space: &ContactSpace, system: &System, forces: &[Vector3<f64>], report: &Report) {
        self.taken.clear();
        self.taken.resize(system.rows.len(), false);
        self.misses.clear();
        self.misses.extend(system.rows.iter().zip(forces).map(|(row, force)| {
            let law = &space.touches()[row.touch].law;
            law.residual(system.relative(row), *force, space.step(), report.length, report.force)
        }));
    }

    /// The rows that press, or miss their law, around the one that misses it most of those in no patch yet: `most` of them, nearest first by
    /// the blocks that they share, then ascending. False where none misses by more than `tolerance`.
    pub(super) fn next(
        &mut self,
        system: &System,
        forces: &[Vector3<f64>],
        tolerance: f64,
        most: usize,
        rows: &mut Vec<u32>,
    ) -> bool {
        let free = self.misses.iter().enumerate().filter(|(row, _)| !self.taken[*row]);
        let Some((worst, _)) = free.filter(|(_, miss)| **miss > tolerance).max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(&a.0)))
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
        while next < self.blocks.len() && rows.len() < most {
            for row in system.rows_of(self.blocks[next]) {
                let index = *row as usize;
                let counts = forces[index] != Vector3::zeros() || self.misses[index] > tolerance;
                if counts && rows.len() < most && !rows.contains(row) {
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
        true
    }
}
