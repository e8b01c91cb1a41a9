//! Gauss–Seidel sweeps over a problem's subdomains side by side, accelerated: nonsmooth nonlinear conjugate gradients
//! (Silcowitz-Hansen, Niebe and Erleben 2010). The change by a sweep serves as the negative gradient; after every sweep a
//! fraction of the last direction is added. It costs no product with W: the displacements along directions are kept with them.

use std::ops::{Add, Mul, Sub};
use std::sync::{Mutex, MutexGuard, PoisonError, RwLock};

use nalgebra::Vector3;

use super::bilateral_elimination::BilateralElimination;
use super::contact_space::ContactSpace;
use super::subdomains::{levels, lowest_of};
use super::system::{Displacements, Row, Stretch, System};
use crate::math::lane::{Kernel, Lane};
use crate::meter::Meter;
use crate::workers::{Team, WorkerSet};

/// The iteration's memory.
#[derive(Debug, Clone, Default)]
pub(in crate::contact) struct Conjugate {
    forces: Kept<Vector3<f64>>,
    /// Displacements along the directions.
    displacements: Kept<f64>,
    /// |gradient|² of the last sweep; zero: none yet.
    square: f64,
}

/// What is kept of a list.
#[derive(Debug, Clone, Default)]
struct Kept<T> {
    /// Its values before the last sweep.
    before: Vec<T>,
    /// The last direction.
    direction: Vec<T>,
}

/// A subdomain's section of a list, and of what is kept of it.
struct Section<'a, T> {
    now: &'a mut [T],
    before: &'a mut [T],
    direction: &'a mut [T],
}

/// The coordinates of a lowest subdomain.
struct Coordinates<'a> {
    /// The first one among all.
    from: usize,
    displacements: Section<'a, f64>,
}

/// The contacts of a subdomain.
struct Contacts<'a> {
    rows: &'a mut [Row],
    forces: Section<'a, Vector3<f64>>,
    /// Its contribution to |gradient|².
    square: f64,
}

/// The work of a level's subdomains.
#[derive(Clone, Copy)]
struct Turn {
    level: usize,
    /// The level's first subdomain.
    first: usize,
    /// What follows after the last sweep, first.
    after: AfterSweep,
    /// Whether the sweep is one of the accelerated ones.
    kept: bool,
}

/// What follows after a sweep.
#[derive(Clone, Copy)]
enum AfterSweep {
    /// Nothing.
    Nothing,
    /// This fraction of the last direction is added.
    Along(f64),
    /// It was no descent: the next direction starts afresh.
    Restart,
}

impl Conjugate {
    /// Forgets the direction.
    pub(in crate::contact) fn restart(&mut self, system: &System, forces: &[Vector3<f64>]) {
        self.forces.restart(forces.len());
        self.displacements.restart(system.displacements.len());
        self.square = 0.0;
    }

    /// A number of accelerated sweeps, and one that is not, which brings back what the directions moved outside the laws. By
    /// workers: the same bits. If `meter` halts them there are fewer.
    #[allow(clippy::too_many_arguments, reason = "the problem, where it stands, and who works for how long")]
    pub(in crate::contact) fn sweeps<S: Default + Send>(
        &mut self,
        space: &ContactSpace,
        system: &mut System,
        forces: &mut [Vector3<f64>],
        sweeps: u32,
        workers: &WorkerSet<S>,
        meter: &Meter,
    ) {
        let System { rows, displacements, bilateral, .. } = system;
        let (subdomains, bilateral) = (space.subdomains(), &*bilateral);
        let all = [displacements.len(), rows.len()];
        let mut from = 0;
        let coordinates = self.displacements.sections(displacements, || subdomains.coordinate_ends(all[0]));
        let coordinates = coordinates.map(|displacements| {
            let end = from + displacements.now.len();
            Mutex::new(Coordinates { from: std::mem::replace(&mut from, end), displacements })
        });
        let coordinates: Vec<_> = coordinates.collect();
        let forces = self.forces.sections(forces, || subdomains.constraint_ends(all[1]));
        let constraints = split(rows, subdomains.constraint_ends(all[1])).zip(forces);
        let constraints: Vec<_> = constraints.map(|(rows, forces)| Mutex::new(Contacts { rows, forces, square: 0.0 })).collect();

        let turn = RwLock::new(Turn { level: 0, first: 0, after: AfterSweep::Nothing, kept: true });
        let sweep = |k: usize| {
            let turn = *turn.read().unwrap_or_else(PoisonError::into_inner);
            let constraints = &mut *lock(&constraints[turn.first + k]);
            let own = &coordinates[lowest_of(turn.level, k)];
            if turn.level == 0 {
                let Coordinates { from, displacements } = &mut *lock(&own[0]);
                displacements.begin(turn);
                constraints.sweep(space, bilateral, Stretch { from: *from, values: displacements.now }, turn);
            } else {
                constraints.sweep(space, bilateral, Several(own.iter().map(lock).collect()), turn);
            }
        };
        let mut last = self.square;
        let lead = |team: &Team| {
            let mut after = AfterSweep::Nothing;
            for sweep in 0..=sweeps {
                if meter.is_halted() {
                    break;
                }
                let kept = sweep < sweeps;
                for (level, subdomains) in levels(subdomains.lowest()).enumerate() {
                    *turn.write().unwrap_or_else(PoisonError::into_inner) = Turn { level, first: subdomains.start, after, kept };
                    team.each(subdomains.len());
                }
                if kept {
                    let square: f64 = constraints.iter().map(|part| lock(part).square).sum();
                    let fraction = if last > 0.0 { square / last } else { 0.0 };
                    (after, last) =
                        if fraction > 1.0 { (AfterSweep::Restart, 0.0) } else { (AfterSweep::Along(fraction), square) };
                }
            }
        };
        workers.together(subdomains.lowest(), &sweep, lead);
        self.square = last;
    }
}

impl<T: Copy + Default> Kept<T> {
    fn restart(&mut self, count: usize) {
        self.before.resize(count, T::default());
        self.direction.clear();
        self.direction.resize(count, T::default());
    }

    /// The list and what is kept of it, subdomain by subdomain.
    fn sections<'a, I: Iterator<Item = usize> + 'a>(
        &'a mut self,
        now: &'a mut [T],
        ends: impl Fn() -> I,
    ) -> impl Iterator<Item = Section<'a, T>> {
        let before = split(&mut self.before, ends()).zip(split(&mut self.direction, ends()));
        split(now, ends()).zip(before).map(|(now, (before, direction))| Section { now, before, direction })
    }
}

impl<T: Copy + Default + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>> Section<'_, T> {
    /// Ends the last sweep, and keeps the values as they are before the next.
    fn begin(&mut self, turn: Turn) {
        match turn.after {
            AfterSweep::Nothing => {}
            AfterSweep::Along(fraction) => {
                for ((now, old), direction) in self.now.iter_mut().zip(&*self.before).zip(&mut *self.direction) {
                    let change = *now - *old;
                    let before = *direction * fraction;
                    *now = *now + before;
                    *direction = before + change;
                }
            }
            AfterSweep::Restart => self.direction.fill(T::default()),
        }
        if turn.kept {
            self.before.copy_from_slice(self.now);
        }
    }
}

impl Contacts<'_> {
    fn sweep(&mut self, space: &ContactSpace, bilateral: &BilateralElimination, displacements: impl Displacements, turn: Turn) {
        let Self { rows, forces, square } = self;
        forces.begin(turn);
        f64::call(Sweep { space, bilateral, rows, forces: forces.now, displacements });
        if turn.kept {
            *square = forces.now.iter().zip(&*forces.before).map(|(new, old)| (new - old).norm_squared()).sum();
        }
    }
}

/// A sweep over some rows.
struct Sweep<'a, D> {
    space: &'a ContactSpace,
    bilateral: &'a BilateralElimination,
    rows: &'a mut [Row],
    forces: &'a mut [Vector3<f64>],
    displacements: D,
}

impl<D: Displacements> Kernel for Sweep<'_, D> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { space, bilateral, rows, forces, mut displacements } = self;
        for (row, force) in rows.iter_mut().zip(forces) {
            let old = *force;
            let u = row.relative(&displacements);
            let new = row.solve.approach(u - row.response * old);
            let change = new - old;
            if change != Vector3::zeros() {
                *force = new;
                row.push(space, bilateral, &change, &mut displacements);
            }
        }
    }
}

/// The coordinates of several lowest subdomains, in order.
struct Several<'a, 'b>(Vec<MutexGuard<'a, Coordinates<'b>>>);

impl Several<'_, '_> {
    /// The subdomain that has a coordinate.
    #[inline(always)]
    fn subdomain_of(&self, at: usize) -> usize {
        (1..self.0.len()).rev().find(|k| self.0[*k].from <= at).unwrap_or(0)
    }
}

impl Displacements for Several<'_, '_> {
    #[inline(always)]
    fn rest(&self, at: usize) -> &[f64] {
        let part = &self.0[self.subdomain_of(at)];
        &part.displacements.now[at - part.from..]
    }

    #[inline(always)]
    fn rest_mut(&mut self, at: usize) -> &mut [f64] {
        let part = self.subdomain_of(at);
        let Coordinates { from, displacements } = &mut *self.0[part];
        &mut displacements.now[at - *from..]
    }
}

/// A list in pieces with these ends.
fn split<'a, T>(mut list: &'a mut [T], ends: impl Iterator<Item = usize> + 'a) -> impl Iterator<Item = &'a mut [T]> {
    let mut from = 0;
    ends.map(move |end| {
        let (own, rest) = std::mem::take(&mut list).split_at_mut(end - from);
        (list, from) = (rest, end);
        own
    })
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
