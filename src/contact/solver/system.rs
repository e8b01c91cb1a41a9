//! The contact-space problem prepared for iteration: bilateral constraints eliminated, every contact's own response and law
//! computed, displacements kept up to date force by force.

use nalgebra::{Matrix3, Vector3};

use super::bilateral_elimination::BilateralElimination;
use super::contact_space::{ContactSpace, End, add_columns, read, read_block};
use crate::contact::constraint::law::{Law, LawSolve};

/// An end of a constraint, located in the matrices.
#[derive(Debug, Clone, Copy)]
pub struct Slot {
    /// Its block's first coordinate, and the number of them.
    pub base: usize,
    /// See `base`.
    pub size: usize,
    /// Its own first coordinate.
    pub at: usize,
    /// The block's matrix is one of those left by the elimination of bilateral constraints, not a strand's own.
    pub reduced: bool,
    /// Start of the block's matrix.
    pub matrix: usize,
}

/// A contact or a ring, prepared.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    /// Its index in the problem.
    pub constraint: usize,
    /// Where +λ acts.
    pub first: Slot,
    /// Where −λ acts.
    pub second: Option<Slot>,
    /// The solve of its law.
    pub solve: LawSolve,
    /// Displacement without the forces of any contact or ring (bilateral constraints act), m.
    pub unconstrained: Vector3<f64>,
    /// Its own response W, m/N.
    pub response: Matrix3<f64>,
}

/// The prepared problem. Its memory is kept from one use to the next.
#[derive(Debug, Clone, Default)]
pub struct System {
    /// Contacts and rings in the problem's order.
    pub rows: Vec<Row>,
    /// Displacements of all attached points under the rows' forces.
    pub displacements: Vec<f64>,
    /// The eliminated bilateral constraints.
    pub bilateral: BilateralElimination,
    /// Blocks (strands, or strands joined by bilateral constraints) with rows, ascending: where their rows begin in
    /// `block_rows`.
    blocks: Vec<u32>,
    block_rows: Vec<u32>,
    /// (first coordinate of a block, row), sorted.
    members: Vec<(usize, u32)>,
}

/// Cost of a row in a sweep, and of each coordinate that its force displaces, nanoseconds or so.
const SWEEP_A_ROW: u64 = 70;
const SWEEP_A_COORDINATE: u64 = 1;

/// A contact counts as fixed if bilateral constraints reduce its response to this fraction of its points' own.
const FIXED: f64 = 1e-12;

impl System {
    /// Prepares a problem.
    pub fn prepare(&mut self, space: &ContactSpace) {
        self.bilateral.eliminate(space);
        self.rows.clear();
        self.displacements.clear();
        self.displacements.resize(space.coordinates(), 0.0);
        for (index, constraint) in space.constraints().iter().enumerate() {
            if matches!(constraint.law, Law::Bilateral(_)) {
                continue;
            }
            let (first, second) = (self.slot(space, constraint.first), constraint.second.map(|end| self.slot(space, end)));
            let own = |end: End| {
                let block = space.block(end.strand as usize);
                let at = 3 * end.point as usize;
                read_block(&space.responses()[block.matrix..], block.size, at, at).trace()
            };
            let (mut response, mut unbonded) = (self.block(space, &first, &first), own(constraint.first));
            let mut unconstrained = constraint.unconstrained + self.bilateral.carried(first.at);
            if let (Some(second), Some(end)) = (&second, constraint.second) {
                response += self.block(space, second, second);
                unbonded += own(end);
                unconstrained -= self.bilateral.carried(second.at);
                if second.base == first.base {
                    response -= self.block(space, &first, second) + self.block(space, second, &first);
                }
            }
            let constrained = first.reduced || second.is_some_and(|slot| slot.reduced);
            if constrained && response.trace() <= FIXED * unbonded {
                response = Matrix3::zeros();
            }
            let solve = LawSolve::new(&constraint.law, &response, space.step());
            self.rows.push(Row { constraint: index, first, second, solve, unconstrained, response });
        }
        self.find_blocks();
    }

    fn find_blocks(&mut self) {
        self.members.clear();
        for (index, row) in self.rows.iter().enumerate() {
            self.members.push((row.first.base, index as u32));
            if let Some(second) = row.second.filter(|second| second.base != row.first.base) {
                self.members.push((second.base, index as u32));
            }
        }
        self.members.sort_unstable();
        self.blocks.clear();
        self.block_rows.clear();
        for (k, (base, row)) in self.members.iter().enumerate() {
            if k == 0 || self.members[k - 1].0 != *base {
                self.blocks.push(k as u32);
            }
            self.block_rows.push(*row);
        }
        self.blocks.push(self.block_rows.len() as u32);
    }

    /// The cost of a sweep over all rows, nanoseconds or so.
    pub fn sweep_work(&self) -> u64 {
        let of = |row: &Row| row.first.size + row.second.map_or(0, |second| second.size);
        self.rows.iter().map(|row| SWEEP_A_ROW + SWEEP_A_COORDINATE * of(row) as u64).sum()
    }

    /// The number of blocks with rows.
    pub fn blocks(&self) -> usize {
        self.blocks.len().saturating_sub(1)
    }

    /// A block's rows, ascending: contacts of the block, with another or not.
    pub fn rows_of(&self, block: usize) -> &[u32] {
        &self.block_rows[self.blocks[block] as usize..self.blocks[block + 1] as usize]
    }

    /// The block whose coordinates begin at `base`; it has rows.
    pub(in crate::contact) fn block_at(&self, base: usize) -> usize {
        self.blocks[..self.blocks()].partition_point(|first| self.members[*first as usize].0 < base)
    }

    fn slot(&self, space: &ContactSpace, end: End) -> Slot {
        let block = space.block(end.strand as usize);
        let base = self.bilateral.base(end.strand as usize, block.base);
        let at = base + 3 * end.point as usize;
        match self.bilateral.group_of(end.strand as usize) {
            Some(group) => Slot { base: group.base, size: group.size, at, reduced: true, matrix: group.matrix },
            None => Slot { base, size: block.size, at, reduced: false, matrix: block.matrix },
        }
    }

    fn block(&self, space: &ContactSpace, row: &Slot, column: &Slot) -> Matrix3<f64> {
        let matrix = if row.reduced { self.bilateral.reduced() } else { space.responses() };
        read_block(&matrix[row.matrix..], row.size, row.at - row.base, column.at - column.base)
    }

    /// Displacement of a row per force at another (or itself).
    pub(in crate::contact) fn coupling(&self, space: &ContactSpace, row: &Row, from: &Row) -> Matrix3<f64> {
        self.coupling_where(space, row, from, |_| true)
    }

    /// The same by one block's response alone.
    pub(in crate::contact) fn coupling_in(&self, space: &ContactSpace, block: usize, row: &Row, from: &Row) -> Matrix3<f64> {
        let base = self.members[self.blocks[block] as usize].0;
        self.coupling_where(space, row, from, |end| end.base == base)
    }

    #[inline(always)]
    fn coupling_where(&self, space: &ContactSpace, row: &Row, from: &Row, counts: impl Fn(&Slot) -> bool) -> Matrix3<f64> {
        // Both ends, the second a copy of the first where there is none, so that nothing beyond the lists is read.
        let ends = |row: &Row| ([row.first, row.second.unwrap_or(row.first)], 1 + usize::from(row.second.is_some()));
        let ((at, places), (force, forces)) = (ends(row), ends(from));
        let mut sum = Matrix3::zeros();
        for i in 0..places {
            for j in 0..forces {
                if at[i].base == force[j].base && counts(&at[i]) {
                    let block = self.block(space, &at[i], &force[j]);
                    if i == j { sum += block } else { sum -= block }
                }
            }
        }
        sum
    }

    /// The relative displacement of a row now.
    #[inline(always)]
    pub fn relative(&self, row: &Row) -> Vector3<f64> {
        row.relative(&self.displacements)
    }

    /// Changes a row's force by `change`: displaces all points of its blocks.
    #[inline(always)]
    pub fn push(&mut self, space: &ContactSpace, index: usize, change: &Vector3<f64>) {
        self.rows[index].push(space, &self.bilateral, change, &mut self.displacements);
    }
}

/// Displacements of a problem's coordinates, or of some.
pub trait Displacements {
    /// The displacements from a coordinate on, at least to its block's last.
    fn rest(&self, at: usize) -> &[f64];
    /// The same, mutable.
    fn rest_mut(&mut self, at: usize) -> &mut [f64];
}

/// The displacements from a coordinate on.
#[derive(Debug)]
pub struct Stretch<'a> {
    /// That coordinate.
    pub from: usize,
    /// m or rad.
    pub values: &'a mut [f64],
}

impl Displacements for Stretch<'_> {
    #[inline(always)]
    fn rest(&self, at: usize) -> &[f64] {
        &self.values[at - self.from..]
    }

    #[inline(always)]
    fn rest_mut(&mut self, at: usize) -> &mut [f64] {
        &mut self.values[at - self.from..]
    }
}

impl Displacements for Vec<f64> {
    #[inline(always)]
    fn rest(&self, at: usize) -> &[f64] {
        &self[at..]
    }

    #[inline(always)]
    fn rest_mut(&mut self, at: usize) -> &mut [f64] {
        &mut self[at..]
    }
}

impl Row {
    /// Its relative displacement under these `displacements` of its blocks' coordinates.
    #[inline(always)]
    pub fn relative(&self, displacements: &impl Displacements) -> Vector3<f64> {
        let mut u = self.unconstrained + read(displacements.rest(self.first.at), 0);
        if let Some(second) = &self.second {
            u -= read(displacements.rest(second.at), 0);
        }
        u
    }

    /// Adds the displacements by a change of its force to its blocks' coordinates.
    #[inline(always)]
    pub fn push(
        &self,
        space: &ContactSpace,
        bilateral: &BilateralElimination,
        change: &Vector3<f64>,
        displacements: &mut impl Displacements,
    ) {
        push_end(space, bilateral, &self.first, change, displacements);
        if let Some(second) = &self.second {
            push_end(space, bilateral, second, &-change, displacements);
        }
    }
}

#[inline(always)]
fn push_end(
    space: &ContactSpace,
    bilateral: &BilateralElimination,
    slot: &Slot,
    change: &Vector3<f64>,
    displacements: &mut impl Displacements,
) {
    let matrix = if slot.reduced { bilateral.reduced() } else { space.responses() };
    let columns = slot.matrix + (slot.at - slot.base) * slot.size;
    add_columns(&matrix[columns..], change, &mut displacements.rest_mut(slot.base)[..slot.size]);
}
