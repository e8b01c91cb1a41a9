//! The contact-space problem: the strands' responses at their attached points, and the constraints between these.

use std::fmt::Display;

use nalgebra::{Matrix3, Vector3};

use super::subdomains::Subdomains;
use crate::contact::constraint::law::Law;
use crate::error::{Error, Result, check_finite, check_positive};

/// An attached point of a strand: a position, or the rotation at a position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct End {
    /// Index of the strand in the problem.
    pub strand: u32,
    /// Index of the point among the strand's attached points.
    pub point: u32,
}

/// One constraint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpaceConstraint {
    /// Where +λ acts.
    pub first: End,
    /// Where −λ acts; `None` where the partner is a body or the world.
    pub second: Option<End>,
    /// Its law.
    pub law: Law,
    /// The relative displacement over the step without any constraint force, world axes, m (between rotations rad). Its
    /// component along a contact's normal is the gap.
    pub unconstrained: Vector3<f64>,
}

/// The strands' responses and the constraints. Its memory is kept from one use to the next.
#[derive(Debug, Clone, Default)]
pub struct ContactSpace {
    step: f64,
    strands: Vec<StrandBlock>,
    /// Strand after strand, each a symmetric matrix of (3 points)² numbers.
    response: Vec<f64>,
    coordinates: usize,
    constraints: Vec<SpaceConstraint>,
    subdomains: Subdomains,
}

/// Where a strand's numbers are.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct StrandBlock {
    /// Coordinates: three times the points.
    pub(in crate::contact) size: usize,
    /// Its first coordinate among all strands'.
    pub(in crate::contact) base: usize,
    /// Start of its matrix.
    pub(in crate::contact) matrix: usize,
}

impl ContactSpace {
    /// Begins a new problem for a step of `step` seconds (above zero), without strands or constraints.
    pub fn reset(&mut self, step: f64) -> Result<()> {
        check_positive(|| "step".into(), step)?;
        self.step = step;
        self.strands.clear();
        self.response.clear();
        self.constraints.clear();
        self.subdomains.clear();
        self.coordinates = 0;
        Ok(())
    }

    /// Adds a strand with this number of attached points and returns its matrix G, all zero, to be filled in: displacement of
    /// coordinate i (three per point, world axes, m or rad) per unit of force at coordinate j (N or N·m) at `i + j * 3 *
    /// points`. It must be symmetric up to rounding and positive semidefinite.
    pub fn add_strand(&mut self, points: usize) -> &mut [f64] {
        let (size, matrix) = (3 * points, self.response.len());
        self.strands.push(StrandBlock { size, base: self.coordinates, matrix });
        self.coordinates += size;
        self.response.resize(matrix + size * size, 0.0);
        &mut self.response[matrix..]
    }

    /// Adds a constraint. Errors: an end that is not among the strands' points, two equal ends, an unconstrained displacement
    /// that is not finite, a law with a number out of range.
    pub fn add_constraint(&mut self, constraint: SpaceConstraint) -> Result<()> {
        let index = self.constraints.len();
        self.check_end(format_args!("constraints[{index}].first"), constraint.first)?;
        if let Some(second) = constraint.second {
            self.check_end(format_args!("constraints[{index}].second"), second)?;
            if second == constraint.first {
                let value = format!("strand {} point {}", second.strand, second.point);
                return Err(Error::invalid(format!("constraints[{index}].second"), value, "another point than the first"));
            }
        }
        for i in 0..3 {
            check_finite(|| format!("constraints[{index}].unconstrained[{i}]"), constraint.unconstrained[i])?;
        }
        constraint.law.check(format_args!("constraints[{index}].law"))?;
        self.constraints.push(constraint);
        Ok(())
    }

    /// Sets the subdomains that may be swept side by side, after all is added, in problems without bilateral constraints: the
    /// ends of the strands of every lowest subdomain, and of the constraints of every subdomain ([`Subdomains`]).
    pub(crate) fn part(&mut self, strand_ends: &[usize], constraint_ends: &[usize]) {
        // (A problem is one subdomain anyhow, and may then have bilateral constraints.)
        if strand_ends.len() == 1 {
            return;
        }
        let coordinates = |strands: &usize| self.strands.get(*strands).map_or(self.coordinates, |block| block.base);
        self.subdomains.set(strand_ends.iter().map(coordinates), constraint_ends);
    }

    /// See [`ContactSpace::part`].
    pub(in crate::contact) fn subdomains(&self) -> &Subdomains {
        &self.subdomains
    }

    fn check_end(&self, argument: impl Display, end: End) -> Result<()> {
        let Some(block) = self.strands.get(end.strand as usize) else {
            let most = self.strands.len();
            return Err(Error::invalid(format!("{argument}.strand"), end.strand, format!("less than the {most} strands")));
        };
        if 3 * end.point as usize >= block.size {
            let most = block.size / 3;
            return Err(Error::invalid(format!("{argument}.point"), end.point, format!("less than the strand's {most} points")));
        }
        Ok(())
    }

    /// The step's seconds.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The number of strands.
    pub fn strands(&self) -> usize {
        self.strands.len()
    }

    /// The number of a strand's attached points.
    pub fn points(&self, strand: usize) -> usize {
        self.strands[strand].size / 3
    }

    /// A strand's matrix, laid out as [`ContactSpace::add_strand`] says.
    pub fn response(&self, strand: usize) -> &[f64] {
        let block = &self.strands[strand];
        &self.response[block.matrix..block.matrix + block.size * block.size]
    }

    /// The constraints in the order in which they were added.
    pub fn constraints(&self) -> &[SpaceConstraint] {
        &self.constraints
    }

    /// Changes a constraint's unconstrained displacement (finite) and keeps its law and all else: the next Newton iteration's
    /// problem.
    pub fn set_unconstrained(&mut self, constraint: usize, unconstrained: Vector3<f64>) -> Result<()> {
        for i in 0..3 {
            check_finite(|| format!("unconstrained[{i}]"), unconstrained[i])?;
        }
        self.constraints[constraint].unconstrained = unconstrained;
        Ok(())
    }

    pub(in crate::contact) fn block(&self, strand: usize) -> &StrandBlock {
        &self.strands[strand]
    }

    pub(in crate::contact) fn responses(&self) -> &[f64] {
        &self.response
    }

    /// Coordinates of all strands together.
    pub(in crate::contact) fn coordinates(&self) -> usize {
        self.coordinates
    }

    /// The displacements of all attached points under the constraints' `forces`, three coordinates per point, strand after
    /// strand: by the full matrices, without what a solver keeps up to date.
    pub fn displacements(&self, forces: &[Vector3<f64>], out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.coordinates, 0.0);
        for (constraint, force) in self.constraints.iter().zip(forces) {
            self.push(constraint.first, force, out);
            if let Some(second) = constraint.second {
                self.push(second, &-force, out);
            }
        }
    }

    fn push(&self, end: End, force: &Vector3<f64>, out: &mut [f64]) {
        let block = self.block(end.strand as usize);
        let columns = block.matrix + 3 * end.point as usize * block.size;
        add_columns(&self.response[columns..], force, &mut out[block.base..block.base + block.size]);
    }

    /// The relative displacement of a constraint under these `displacements` of the points, including its unconstrained one.
    pub fn relative(&self, constraint: usize, displacements: &[f64]) -> Vector3<f64> {
        let constraint = &self.constraints[constraint];
        let at = |end: End| self.block(end.strand as usize).base + 3 * end.point as usize;
        let mut u = constraint.unconstrained + read(displacements, at(constraint.first));
        if let Some(second) = constraint.second {
            u -= read(displacements, at(second));
        }
        u
    }
}

/// The vector at a position of a list of coordinates.
#[inline(always)]
pub(in crate::contact) fn read(values: &[f64], at: usize) -> Vector3<f64> {
    let v = &values[at..at + 3];
    Vector3::new(v[0], v[1], v[2])
}

/// The 3×3 block at row and column of a symmetric matrix of `size` coordinates.
pub(crate) fn read_block(matrix: &[f64], size: usize, row: usize, column: usize) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| matrix[(column + j) * size + row + i])
}

/// Adds three columns of a matrix, `out.len()` numbers each and one after the other, times the components of `force`.
#[inline(always)]
pub(in crate::contact) fn add_columns(columns: &[f64], force: &Vector3<f64>, out: &mut [f64]) {
    let size = out.len();
    let (x, rest) = columns.split_at(size);
    let (y, z) = rest.split_at(size);
    let z = &z[..size];
    for i in 0..size {
        out[i] += (x[i] * force.x + y[i] * force.y) + z[i] * force.z;
    }
}
