//! Newton's equations of a problem's contacts, solved directly: multifrontal elimination (Duff and Reid 1983) along the strands
//! that touch each other.
//!
//! With the laws F(λ, u) = 0 linearised, P = ∂F/∂λ and Q = ∂F/∂u of every row, the equations are (P + Q W) Δλ = −F. W is a sum of
//! the blocks' own matrices, of which each makes a front; where two fronts are joined the contacts between them are eliminated.
//! Forces that the laws put to zero whatever moves are known and in no front.

use nalgebra::{Matrix3, Vector3};

use super::order::{Front, Order, Origin};
use crate::contact::constraint::law::linear::Linear;
use crate::contact::solver::contact_space::ContactSpace;
use crate::contact::solver::dense::{eliminate_first, substitute_first};
use crate::contact::solver::system::System;
use crate::meter::Meter;
use crate::workers::WorkerSet;

/// Fronts are eliminated side by side in tasks of at most one in so many parts of the whole cost.
const TASKS: u64 = 16;

/// The equations' memory.
#[derive(Debug, Clone, Default)]
pub(super) struct Multifrontal {
    order: Order,
    active: Vec<bool>,
    /// Displacements by the changes that are known.
    carried: Vec<f64>,
    /// The cost of all fronts.
    work: u64,
    /// By a front's place in the order of elimination: the cost of its elimination and of all that it is made of,
    works: Vec<u64>,
    /// and the number of these, itself included: the places before its own.
    spans: Vec<usize>,
    /// The places that are eliminated side by side, from and to.
    tasks: Vec<(usize, usize)>,
    /// Of every task, and last of the fronts that are in none.
    parts: Vec<Part>,
    known: Vec<f64>,
}

/// Fronts eliminated one after the other.
#[derive(Debug, Clone, Default)]
struct Part {
    /// The front at hand.
    matrix: Vec<f64>,
    rhs: Vec<f64>,
    places: Vec<usize>,
    /// What is left of the fronts that are part of no other yet, a stack.
    left: Vec<f64>,
    left_rhs: Vec<f64>,
    /// All fronts' pivots' rows.
    upper: Vec<f64>,
    upper_rhs: Vec<f64>,
    has_failed: bool,
}

/// A problem linearised.
#[derive(Clone, Copy)]
pub(super) struct Linearised<'a> {
    pub(super) space: &'a ContactSpace,
    pub(super) system: &'a System,
    pub(super) linear: &'a [Linear],
    /// What is added to each contact's own response, as a fraction of it.
    pub(super) damping: f64,
}

/// What the elimination of every front reads.
#[derive(Clone, Copy)]
struct Shared<'a> {
    problem: Linearised<'a>,
    order: &'a Order,
    carried: &'a Vec<f64>,
    meter: &'a Meter<'a>,
}

impl Multifrontal {
    /// Finds the order of elimination and returns the cost, nanoseconds or so; none if that is more than `most`.
    pub(super) fn prepare(&mut self, system: &System, linear: &[Linear], most: u64) -> Option<u64> {
        self.active.clear();
        self.active.extend(linear.iter().map(|linear| linear.by_displacement != Matrix3::zeros()));
        self.work = self.order.find(system, &self.active, most)?;
        self.works.clear();
        self.spans.clear();
        for front in self.order.fronts() {
            let (mut work, mut span) = (front.work(), 1);
            if let Origin::Joined(_) = front.origin {
                for _ in 0..2 {
                    let part = self.spans.len() - span;
                    work += self.works[part];
                    span += self.spans[part];
                }
            }
            self.works.push(work);
            self.spans.push(span);
        }
        Some(self.work)
    }

    /// Solves for the changes of all rows' forces. The same bits for any number of workers. False where the equations have no
    /// solution, or where `meter` halts it.
    pub(super) fn solve<S: Default + Send>(
        &mut self,
        problem: Linearised,
        changes: &mut Vec<Vector3<f64>>,
        workers: &WorkerSet<S>,
        meter: &Meter,
    ) -> bool {
        let Linearised { space, system, linear, .. } = problem;
        changes.clear();
        changes.resize(linear.len(), Vector3::zeros());
        self.carried.clear();
        self.carried.resize(system.displacements.len(), 0.0);
        for (index, linear) in linear.iter().enumerate() {
            if !self.active[index] && linear.residual != Vector3::zeros() {
                // Without Q the law is λ = 0.
                changes[index] = -linear.residual;
                system.rows[index].push(space, &system.bilateral, &changes[index], &mut self.carried);
            }
        }
        self.find_tasks();
        let is_solved = self.eliminate(problem, workers, meter);
        if is_solved {
            self.substitute(changes);
        }
        is_solved && changes.iter().all(|change| change.iter().all(|x| x.is_finite()))
    }

    /// Finds what threads eliminate side by side: from the last front to what it is made of, until none is too large. Whatever the
    /// tasks, the sums are the same.
    fn find_tasks(&mut self) {
        self.tasks.clear();
        let most = self.work / TASKS;
        let mut place = self.order.len();
        while place > 0 {
            if self.works[place - 1] <= most {
                let first = place - self.spans[place - 1];
                self.tasks.push((first, place));
                place = first;
            } else {
                place -= 1;
            }
        }
        self.tasks.reverse();
        self.parts.resize_with(self.tasks.len() + 1, Part::default);
        self.parts.iter_mut().for_each(Part::clear);
    }

    fn eliminate<S: Default + Send>(&mut self, problem: Linearised, workers: &WorkerSet<S>, meter: &Meter) -> bool {
        let Self { order, carried, tasks, parts, .. } = self;
        let shared = Shared { problem, order, carried, meter };
        let Some((last, parts)) = parts.split_last_mut() else { return false };
        let mut all: Vec<_> = tasks.iter().zip(&mut *parts).collect();
        workers.for_each_task(&mut all, 1, 1, |tasks, _| {
            for ((from, to), part) in tasks {
                part.has_failed = !(*from..*to).all(|place| shared.eliminate(place, part));
            }
        });
        if parts.iter().any(|part| part.has_failed) {
            return false;
        }
        let mut tasks = tasks.iter().zip(parts).peekable();
        let mut place = 0;
        while place < order.len() {
            if let Some(((_, to), part)) = tasks.next_if(|((from, _), _)| *from == place) {
                last.left.append(&mut part.left);
                last.left_rhs.append(&mut part.left_rhs);
                place = *to;
            } else if shared.eliminate(place, last) {
                place += 1;
            } else {
                return false;
            }
        }
        true
    }

    /// After the elimination: finds the changes, from the last front's to the first's.
    fn substitute(&mut self, changes: &mut [Vector3<f64>]) {
        let Some((last, parts)) = self.parts.split_last_mut() else { return };
        let mut task = self.tasks.len();
        for (place, front) in self.order.fronts().enumerate().rev() {
            while task > 0 && self.tasks[task - 1].0 > place {
                task -= 1;
            }
            let is_in_task = task > 0 && place < self.tasks[task - 1].1;
            let Part { upper, upper_rhs, .. } = if is_in_task { &mut parts[task - 1] } else { &mut *last };
            let (n, pivots) = (3 * front.rows(), 3 * front.pivots.len());
            let (rows, rhs) = (upper.len() - pivots * n, upper_rhs.len() - pivots);
            self.known.clear();
            self.known.extend_from_slice(&upper_rhs[rhs..]);
            for row in &front.others {
                self.known.extend_from_slice(changes[*row as usize].as_slice());
            }
            substitute_first(&upper[rows..], &mut self.known, pivots);
            for (row, change) in front.pivots.iter().zip(self.known.as_chunks::<3>().0) {
                changes[*row as usize] = Vector3::from(*change);
            }
            upper.truncate(rows);
            upper_rhs.truncate(rhs);
        }
    }
}

impl Shared<'_> {
    /// Eliminates the front at a place; what it is made of is on top of the part's stack.
    fn eliminate(&self, place: usize, part: &mut Part) -> bool {
        let front = self.order.front(place);
        let (n, pivots) = (3 * front.rows(), 3 * front.pivots.len());
        part.matrix.clear();
        part.matrix.resize(n * n, 0.0);
        part.rhs.clear();
        part.rhs.resize(n, 0.0);
        match front.origin {
            Origin::Block(block) => self.problem.assemble(front, block, &mut part.matrix),
            Origin::Joined(two) => {
                for joined in two.into_iter().rev() {
                    part.join(&self.order.part(joined).others, front);
                }
            }
        }
        let Part { matrix, rhs, .. } = part;
        for (k, row) in front.pivots.iter().enumerate() {
            let Linear { residual, by_force, by_displacement } = &self.problem.linear[*row as usize];
            let row = &self.problem.system.rows[*row as usize];
            let carried = row.relative(self.carried) - row.unconstrained;
            let own = by_force + by_displacement * (self.problem.damping * row.response.trace());
            let known = residual + by_displacement * carried;
            for r in 0..3 {
                rhs[3 * k + r] -= known[r];
                for c in 0..3 {
                    matrix[(3 * k + r) * n + 3 * k + c] += own[(r, c)];
                }
            }
        }
        if self.meter.is_halted_at(place) || !eliminate_first(matrix, rhs, pivots, self.meter) {
            return false;
        }
        part.keep(pivots);
        true
    }
}

impl Linearised<'_> {
    /// A block's own front: Q W.
    fn assemble(&self, front: &Front, block: usize, matrix: &mut [f64]) {
        let n = 3 * front.rows();
        let rows = || front.pivots.iter().chain(&front.others).map(|row| *row as usize).enumerate();
        for (i, row) in rows() {
            let by_displacement = &self.linear[row].by_displacement;
            for (j, from) in rows() {
                let response = self.system.coupling_in(self.space, block, &self.system.rows[row], &self.system.rows[from]);
                let entry = by_displacement * response;
                for r in 0..3 {
                    for c in 0..3 {
                        matrix[(3 * i + r) * n + 3 * j + c] = entry[(r, c)];
                    }
                }
            }
        }
    }
}

impl Part {
    fn clear(&mut self) {
        self.left.clear();
        self.left_rhs.clear();
        self.upper.clear();
        self.upper_rhs.clear();
        self.has_failed = false;
    }

    /// Adds what is on top of the stack, left of a front with these `others`, to the front at hand.
    fn join(&mut self, others: &[u32], front: &Front) {
        let Self { matrix, rhs, places, left, left_rhs, .. } = self;
        find_places(others, front, places);
        let (n, m) = (rhs.len(), 3 * others.len());
        let (rows, first) = (left.len() - m * m, left_rhs.len() - m);
        for (k, row) in left[rows..].chunks_exact(m.max(1)).enumerate() {
            let to = 3 * places[k / 3] + k % 3;
            rhs[to] += left_rhs[first + k];
            let out = &mut matrix[to * n..(to + 1) * n];
            for (from, column) in row.as_chunks::<3>().0.iter().zip(&*places) {
                for (x, y) in out[3 * column..3 * column + 3].iter_mut().zip(from) {
                    *x += y;
                }
            }
        }
        left.truncate(rows);
        left_rhs.truncate(first);
    }

    /// Keeps the front at hand after its elimination.
    fn keep(&mut self, pivots: usize) {
        let n = self.rhs.len();
        self.upper.extend_from_slice(&self.matrix[..pivots * n]);
        self.upper_rhs.extend_from_slice(&self.rhs[..pivots]);
        self.left_rhs.extend_from_slice(&self.rhs[pivots..]);
        for row in self.matrix[pivots * n..].chunks_exact(n) {
            self.left.extend_from_slice(&row[pivots..]);
        }
    }
}

/// The places of `rows`, ascending, in a front that has them all.
fn find_places(rows: &[u32], front: &Front, places: &mut Vec<usize>) {
    places.clear();
    let (mut pivot, mut other) = (0, 0);
    for row in rows {
        while front.pivots.get(pivot).is_some_and(|pivot| pivot < row) {
            pivot += 1;
        }
        if front.pivots.get(pivot) == Some(row) {
            places.push(pivot);
            continue;
        }
        while front.others.get(other).is_some_and(|other| other < row) {
            other += 1;
        }
        places.push(front.pivots.len() + other);
    }
}
