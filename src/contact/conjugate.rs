//! Sweeps of Gauss–Seidel, accelerated: nonsmooth nonlinear conjugate gradients (Silcowitz-Hansen, Niebe and Erleben 2010). What a sweep
//! changes is taken for minus a gradient; part of the last direction is gone again after every sweep. It costs no product with W: what the
//! directions displace is kept with them.

use nalgebra::Vector3;

use super::contact_space::ContactSpace;
use super::gauss_seidel::sweep;
use super::system::System;
use crate::workers::Crew;

/// The iteration's memory.
#[derive(Debug, Clone, Default)]
pub(super) struct Conjugate {
    /// Forces and displacements before a sweep.
    forces: Vec<Vector3<f64>>,
    displacements: Vec<f64>,
    /// The last direction, and what it displaces.
    direction: Vec<Vector3<f64>>,
    carried: Vec<f64>,
    /// |gradient|² of the last sweep; zero: none yet.
    square: f64,
}

impl Conjugate {
    /// Forgets the direction.
    pub(super) fn restart(&mut self, system: &System, forces: &[Vector3<f64>]) {
        self.direction.clear();
        self.direction.resize(forces.len(), Vector3::zeros());
        self.carried.clear();
        self.carried.resize(system.displacements.len(), 0.0);
        self.square = 0.0;
    }

    /// A sweep, and part of the last direction.
    pub(super) fn sweep<S: Default + Send>(
        &mut self,
        space: &ContactSpace,
        system: &mut System,
        forces: &mut [Vector3<f64>],
        crew: &Crew<S>,
    ) {
        self.forces.clear();
        self.forces.extend_from_slice(forces);
        self.displacements.clear();
        self.displacements.extend_from_slice(&system.displacements);
        sweep(space, system, forces, crew);
        let square: f64 = forces.iter().zip(&self.forces).map(|(new, old)| (new - old).norm_squared()).sum();
        let share = if self.square > 0.0 { square / self.square } else { 0.0 };
        self.square = square;
        if share > 1.0 {
            // Not a descent: begin again from the sweep.
            self.restart(system, forces);
            return;
        }
        for ((force, old), direction) in forces.iter_mut().zip(&self.forces).zip(&mut self.direction) {
            let change = *force - old;
            let before = *direction * share;
            *force += before;
            *direction = before + change;
        }
        for ((now, old), carried) in system.displacements.iter_mut().zip(&self.displacements).zip(&mut self.carried) {
            let change = *now - old;
            let before = *carried * share;
            *now += before;
            *carried = before + change;
        }
    }
}
