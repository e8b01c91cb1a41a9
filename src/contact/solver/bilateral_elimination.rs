//! Direct elimination of bilateral constraints. Strands joined by them are one block, in which they are eliminated: G̃ = G − X
//! W⁻¹ Xᵀ with X = G Eᵀ, W = E G Eᵀ + compliance, E the constrained directions. G̃ is the response of the constrained block, so
//! that the iteration over contacts sees no bilateral constraint, and these hold to rounding whatever it does.
//!
//! W is factorised by Cholesky's method with pivoting (rows scaled to a diagonal of one). Directions that depend on others, or
//! that no force can move, are found, left without force, and reported with their residuals.

use nalgebra::Vector3;

use super::contact_space::{ContactSpace, SpaceConstraint};
use super::rank::{RankFactor, dependence};
use crate::contact::constraint::law::Law;

/// A constrained direction that is not independent of others.
#[derive(Debug, Clone, PartialEq)]
pub struct DependentConstraint {
    /// Index of its bilateral constraint in the problem.
    pub constraint: usize,
    /// The direction, world axes.
    pub direction: Vector3<f64>,
    /// The bilateral constraints (indices, ascending) on which it depends; empty if no force of the constraint moves its points
    /// that way.
    pub decided_by: Vec<usize>,
    /// Its violation, m (rad): rounding if the others happen to agree with it; otherwise they contradict each other.
    pub residual: f64,
}

/// A constrained direction.
#[derive(Debug, Clone, Copy)]
struct ConstrainedDirection {
    constraint: usize,
    direction: Vector3<f64>,
    compliance: f64,
    /// Coordinates of the ends in the block.
    first: usize,
    second: Option<usize>,
    /// Displacement along the direction without any constraint force.
    unconstrained: f64,
}

/// Strands joined by bilateral constraints, as one block.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct BilateralBlock {
    pub(in crate::contact) base: usize,
    pub(in crate::contact) size: usize,
    /// Start of its matrix among the reduced ones.
    pub(in crate::contact) matrix: usize,
    /// Its constrained directions.
    first_direction: usize,
    direction_count: usize,
    /// Start of X (size × directions) and W (directions × directions).
    x: usize,
    w: usize,
}

/// No block.
const NONE: u32 = u32::MAX;

/// The eliminated bilateral constraints of a problem.
#[derive(Debug, Clone, Default)]
pub struct BilateralElimination {
    groups: Vec<BilateralBlock>,
    /// A strand's block; empty in a problem without bilateral constraints.
    group_of: Vec<u32>,
    /// Where a strand's coordinates begin: those of a block are contiguous.
    bases: Vec<usize>,
    /// (block, strand) and (block, bilateral constraint), sorted.
    members: Vec<(u32, u32)>,
    constraints: Vec<(u32, u32)>,
    reduced: Vec<f64>,
    directions: Vec<ConstrainedDirection>,
    x: Vec<f64>,
    w: Vec<f64>,
    factors: Vec<RankFactor>,
    /// Displacements of all coordinates by the bilateral forces that balance the unconstrained displacements.
    carried: Vec<f64>,
}

impl BilateralElimination {
    /// Whether the problem has any.
    pub fn are_there(&self) -> bool {
        !self.groups.is_empty()
    }

    /// Eliminates the bilateral constraints of a problem.
    pub(in crate::contact) fn eliminate(&mut self, space: &ContactSpace) {
        self.groups.clear();
        self.group_of.clear();
        self.bases.clear();
        self.members.clear();
        self.constraints.clear();
        self.reduced.clear();
        self.directions.clear();
        self.x.clear();
        self.w.clear();
        self.factors.clear();
        self.carried.clear();
        if space.constraints().iter().all(|constraint| !matches!(constraint.law, Law::Bilateral(_))) {
            return;
        }
        self.group(space);
        self.carried.resize(space.coordinates(), 0.0);
        for group in 0..self.groups.len() {
            self.assemble(space, group);
            self.reduce(group);
        }
    }

    /// Joins the strands and gives every coordinate its place.
    fn group(&mut self, space: &ContactSpace) {
        let strands = space.strands();
        let mut leader: Vec<u32> = (0..strands as u32).collect();
        let mut constrained = vec![false; strands];
        for constraint in space.constraints() {
            if let Law::Bilateral(_) = constraint.law {
                let first = constraint.first.strand;
                let second = constraint.second.map_or(first, |end| end.strand);
                constrained[first as usize] = true;
                constrained[second as usize] = true;
                let (a, b) = (find(&mut leader, first), find(&mut leader, second));
                leader[a.max(b) as usize] = a.min(b);
            }
        }
        self.group_of.resize(strands, NONE);
        self.bases.resize(strands, 0);
        // Leaders are the first of their blocks: blocks come in the order of their first strands.
        let mut count = 0;
        for strand in 0..strands {
            if constrained[strand] {
                let lead = find(&mut leader, strand as u32) as usize;
                if lead == strand {
                    self.group_of[strand] = count;
                    count += 1;
                }
                self.group_of[strand] = self.group_of[lead];
                self.members.push((self.group_of[strand], strand as u32));
            }
        }
        self.members.sort_unstable();
        for (index, constraint) in space.constraints().iter().enumerate() {
            if let Law::Bilateral(_) = constraint.law {
                self.constraints.push((self.group_of[constraint.first.strand as usize], index as u32));
            }
        }
        self.constraints.sort_unstable();
        let mut base = 0;
        for strand in 0..strands {
            let index = self.group_of[strand];
            if index == NONE {
                self.bases[strand] = base;
                base += space.block(strand).size;
            } else if index as usize == self.groups.len() {
                let mut group = BilateralBlock {
                    base,
                    size: 0,
                    matrix: self.reduced.len(),
                    first_direction: 0,
                    direction_count: 0,
                    x: 0,
                    w: 0,
                };
                for (_, member) in of_group(&self.members, index) {
                    self.bases[*member as usize] = base;
                    base += space.block(*member as usize).size;
                    group.size += space.block(*member as usize).size;
                }
                self.reduced.resize(group.matrix + group.size * group.size, 0.0);
                self.groups.push(group);
            }
        }
    }

    /// G of a block, and E, X and W of its bilateral constraints.
    fn assemble(&mut self, space: &ContactSpace, index: usize) {
        let mut group = self.groups[index];
        let size = group.size;
        let g = &mut self.reduced[group.matrix..];
        for (_, strand) in of_group(&self.members, index as u32) {
            let strand = *strand as usize;
            let (block, own, at) = (space.block(strand), space.response(strand), self.bases[strand] - group.base);
            for column in 0..block.size {
                let from = &own[column * block.size..(column + 1) * block.size];
                g[(at + column) * size + at..][..block.size].copy_from_slice(from);
            }
        }
        group.first_direction = self.directions.len();
        for (_, constraint) in of_group(&self.constraints, index as u32) {
            let constraint = *constraint as usize;
            let SpaceConstraint { first, second, law, unconstrained } = &space.constraints()[constraint];
            let Law::Bilateral(bilateral) = law else { continue };
            let place = |end: &super::contact_space::End| self.bases[end.strand as usize] - group.base + 3 * end.point as usize;
            for direction in bilateral.directions() {
                self.directions.push(ConstrainedDirection {
                    constraint,
                    direction,
                    compliance: bilateral.compliance,
                    first: place(first),
                    second: second.as_ref().map(place),
                    unconstrained: direction.dot(unconstrained),
                });
            }
        }
        group.direction_count = self.directions.len() - group.first_direction;
        (group.x, group.w) = (self.x.len(), self.w.len());
        let directions = &self.directions[group.first_direction..];
        for row in directions {
            let at = self.x.len();
            self.x.resize(at + size, 0.0);
            let column = &mut self.x[at..];
            for axis in 0..3 {
                for i in 0..size {
                    column[i] += g[(row.first + axis) * size + i] * row.direction[axis];
                }
            }
            if let Some(second) = row.second {
                for axis in 0..3 {
                    for i in 0..size {
                        column[i] -= g[(second + axis) * size + i] * row.direction[axis];
                    }
                }
            }
        }
        let count = directions.len();
        for j in 0..count {
            let column = &self.x[group.x + j * size..][..size];
            for (i, row) in directions.iter().enumerate() {
                let w = row.project(column);
                self.w.push(if i == j { w + row.compliance } else { w });
            }
        }
        for j in 0..count {
            for i in 0..j {
                let (a, b) = (group.w + i * count + j, group.w + j * count + i);
                let mean = 0.5 * (self.w[a] + self.w[b]);
                (self.w[a], self.w[b]) = (mean, mean);
            }
        }
        // The size expected from the constraint's points: what is below a rounding of that does not move.
        let expected: Vec<f64> = directions
            .iter()
            .map(|row| {
                let own = |at: usize| (0..3).map(|axis| g[(at + axis) * size + at + axis]).sum::<f64>();
                own(row.first) + row.second.map_or(0.0, own) + row.compliance
            })
            .collect();
        self.factors.push(RankFactor::new(&self.w[group.w..], count, &expected));
        self.groups[index] = group;
    }

    /// G̃, and the displacements without contacts.
    fn reduce(&mut self, index: usize) {
        let group = self.groups[index];
        let (size, factor) = (group.size, &self.factors[index]);
        let rank = factor.rank();
        // Z = L⁻¹ P Xᵀ, a row of `size` a pivot: G̃ = G − ZᵀZ, symmetric to the bit.
        let mut z = vec![0.0; rank * size];
        for i in 0..size {
            let row: Vec<f64> = (0..group.direction_count).map(|j| self.x[group.x + j * size + i]).collect();
            let solved = factor.forward(&row);
            for (k, value) in solved.iter().enumerate() {
                z[k * size + i] = *value;
            }
        }
        let g = &mut self.reduced[group.matrix..group.matrix + size * size];
        for k in 0..rank {
            let row = &z[k * size..(k + 1) * size];
            for j in 0..size {
                let factor = row[j];
                for (entry, value) in g[j * size..(j + 1) * size].iter_mut().zip(row) {
                    *entry -= value * factor;
                }
            }
        }
        let unconstrained: Vec<f64> =
            self.directions[group.first_direction..].iter().take(group.direction_count).map(|row| row.unconstrained).collect();
        let forces = self.answer(index, &unconstrained);
        let carried = &mut self.carried[group.base..group.base + size];
        for (j, force) in forces.iter().enumerate() {
            for (i, value) in carried.iter_mut().enumerate() {
                *value += self.x[group.x + j * size + i] * force;
            }
        }
    }

    /// The forces that balance displacements along the constrained directions: −W⁻¹ `unconstrained`, once refined.
    fn answer(&self, index: usize, unconstrained: &[f64]) -> Vec<f64> {
        let (group, factor) = (self.groups[index], &self.factors[index]);
        let mut forces: Vec<f64> = factor.solve(unconstrained).iter().map(|f| -f).collect();
        let residuals = self.residuals(&group, unconstrained, &forces);
        for (force, correction) in forces.iter_mut().zip(factor.solve(&residuals)) {
            *force -= correction;
        }
        forces
    }

    fn residuals(&self, group: &BilateralBlock, unconstrained: &[f64], forces: &[f64]) -> Vec<f64> {
        (0..group.direction_count)
            .map(|i| {
                let row = &self.w[group.w + i * group.direction_count..][..group.direction_count];
                unconstrained[i] + row.iter().zip(forces).map(|(w, f)| w * f).sum::<f64>()
            })
            .collect()
    }

    /// Adds the bilateral forces to `forces` (one entry per constraint; their own entries are replaced), when all others are
    /// known, and returns the dependent directions.
    pub(in crate::contact) fn finish(&self, space: &ContactSpace, forces: &mut [Vector3<f64>]) -> Vec<DependentConstraint> {
        let mut dependent = Vec::new();
        if self.groups.is_empty() {
            return dependent;
        }
        let mut applied = vec![0.0; space.coordinates()];
        for (constraint, force) in space.constraints().iter().zip(forces.iter_mut()) {
            if matches!(constraint.law, Law::Bilateral(_)) {
                *force = Vector3::zeros();
                continue;
            }
            for axis in 0..3 {
                applied[self.bases[constraint.first.strand as usize] + 3 * constraint.first.point as usize + axis] += force[axis];
                if let Some(second) = constraint.second {
                    applied[self.bases[second.strand as usize] + 3 * second.point as usize + axis] -= force[axis];
                }
            }
        }
        for (index, group) in self.groups.iter().enumerate() {
            let directions = &self.directions[group.first_direction..group.first_direction + group.direction_count];
            let applied = &applied[group.base..group.base + group.size];
            let unconstrained: Vec<f64> = directions
                .iter()
                .enumerate()
                .map(|(j, row)| {
                    let x = &self.x[group.x + j * group.size..][..group.size];
                    row.unconstrained + x.iter().zip(applied).map(|(x, f)| x * f).sum::<f64>()
                })
                .collect();
            let answer = self.answer(index, &unconstrained);
            for (row, force) in directions.iter().zip(&answer) {
                forces[row.constraint] += row.direction * *force;
            }
            let residuals = self.residuals(group, &unconstrained, &answer);
            for (row, on) in dependence(&self.factors[index]) {
                let mut decided_by: Vec<usize> = on.iter().map(|other| directions[*other].constraint).collect();
                decided_by.sort_unstable();
                decided_by.dedup();
                dependent.push(DependentConstraint {
                    constraint: directions[row].constraint,
                    direction: directions[row].direction,
                    decided_by,
                    residual: residuals[row].abs(),
                });
            }
        }
        dependent
    }

    /// A strand's block, if bilateral constraints act on it.
    pub(in crate::contact) fn group_of(&self, strand: usize) -> Option<&BilateralBlock> {
        let group = *self.group_of.get(strand)?;
        self.groups.get(group as usize)
    }

    /// Where a strand's coordinates begin, `own` in a problem without bilateral constraints.
    pub(in crate::contact) fn base(&self, strand: usize, own: usize) -> usize {
        self.bases.get(strand).copied().unwrap_or(own)
    }

    /// The blocks' matrices after the elimination.
    pub(in crate::contact) fn reduced(&self) -> &[f64] {
        &self.reduced
    }

    /// Displacement of the point at a coordinate (in the order of the blocks) by the bilateral constraints alone.
    pub(in crate::contact) fn carried(&self, at: usize) -> Vector3<f64> {
        if self.carried.is_empty() { Vector3::zeros() } else { super::contact_space::read(&self.carried, at) }
    }
}

impl ConstrainedDirection {
    /// Displacement along the direction under these displacements of the block's coordinates.
    fn project(&self, displacements: &[f64]) -> f64 {
        let at = |at: usize| (0..3).map(|axis| displacements[at + axis] * self.direction[axis]).sum::<f64>();
        at(self.first) - self.second.map_or(0.0, at)
    }
}

/// A block's entries of a sorted list.
fn of_group(list: &[(u32, u32)], group: u32) -> &[(u32, u32)] {
    let first = list.partition_point(|(of, _)| *of < group);
    let end = list.partition_point(|(of, _)| *of <= group);
    &list[first..end]
}

/// The leader of a strand's set; halves paths as it goes.
fn find(leader: &mut [u32], mut strand: u32) -> u32 {
    while leader[strand as usize] != strand {
        leader[strand as usize] = leader[leader[strand as usize] as usize];
        strand = leader[strand as usize];
    }
    strand
}
