//! The equations of motion in the curvatures, M(q) q̈ = f(q, q̇, t), as a residual and its derivatives.
//!
//! Continuous time, exact velocity products, dense matrices: for the reference integrator, where accuracy counts and speed does
//! not.
//!
//! Rows and columns are in angles (κℓ), so that elements of very uneven lengths have equal weight.

use faer::Mat;

use crate::chain::force;
use crate::energy::drag;
use crate::math::quadrature::Rule;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::Kinematics;
use crate::rod::strand::StrandModel;
use crate::rod::velocity::{self, RootMotion};
use crate::step::Surroundings;
use crate::step::root_path::RootPath;

/// Rows (twist, κ1, κ2), one per element.
pub type Rows = Vec<[f64; 3]>;

/// Perturbation of the curvatures for differences, as an angle, rad.
const ANGLE_STEP: f64 = 1e-6;

/// A strand whose root moves along a smooth path.
#[derive(Debug, Clone, Copy)]
pub struct Dynamics<'a> {
    /// Constants.
    pub model: &'a StrandModel,
    /// Quadrature rule.
    pub rule: &'a Rule,
    /// Gravity and wind.
    pub surroundings: &'a Surroundings,
    /// The root's path.
    pub path: &'a RootPath,
}

/// Derivatives of the residual, over the free curvatures as angles.
#[derive(Debug, Clone)]
pub struct Derivatives {
    /// M.
    pub inertia: Mat<f64>,
    /// By q.
    pub by_position: Mat<f64>,
    /// By q̇.
    pub by_rate: Mat<f64>,
}

impl Dynamics<'_> {
    /// Number of free curvatures.
    pub fn size(&self) -> usize {
        self.model.element_count() * self.model.freedoms.count()
    }

    /// Element and axis of a free curvature.
    pub fn freedom(&self, index: usize) -> (usize, usize) {
        let free = self.model.freedoms.count();
        (index / free, self.model.freedoms.axes()[index % free])
    }

    /// The strand at time `t` of the path.
    pub fn kinematics(&self, t: f64, curvatures: &[[f64; 3]]) -> (Kinematics<f64>, RootMotion) {
        let (rotation, motion) = self.path.at(t);
        let mut kinematics = Kinematics::default();
        kinematics.update(&Mat3::from(rotation), &self.model.lengths, curvatures, self.rule);
        (kinematics, motion)
    }

    /// A point's mass, and its part of the arclength.
    fn weight(&self, point: usize) -> f64 {
        self.rule.weights[point % self.rule.len()] * self.model.lengths[point / self.rule.len()]
    }

    /// Weight, drag and inertia of every quadrature point, N.
    pub fn point_forces(
        &self,
        t: f64,
        q: &[[f64; 3]],
        rates: &[[f64; 3]],
        accelerations: &[[f64; 3]],
    ) -> (Kinematics<f64>, Vec<Vec3<f64>>) {
        let (kinematics, motion) = self.kinematics(t, q);
        let density = self.model.linear_density;
        let air_drag = self.model.material.air_drag;
        let mut forces = vec![Vec3::zero(); kinematics.points.len()];
        velocity::for_each_point(&kinematics, rates, &motion, |p, v, a| {
            forces[p] = ((self.surroundings.gravity - a).scale(density) - drag::resistance(v, self.surroundings.wind, air_drag))
                .scale(self.weight(p));
        });
        velocity::for_each_point(&kinematics, accelerations, &RootMotion::still(), |p, a, _| {
            forces[p] -= a.scale(density * self.weight(p));
        });
        (kinematics, forces)
    }

    /// M q̈ − f over the free curvatures, as moments, N·m.
    pub fn residual(&self, t: f64, q: &[[f64; 3]], rates: &[[f64; 3]], accelerations: &[[f64; 3]]) -> Vec<f64> {
        let (kinematics, forces) = self.point_forces(t, q, rates, accelerations);
        let generalised = force::generalised(&kinematics, |p| forces[p]);
        (0..self.size())
            .map(|index| {
                let (element, axis) = self.freedom(index);
                let strain = q[element][axis] - self.model.natural[element][axis];
                self.model.stiffness[axis] * strain + self.model.dissipation[axis] * rates[element][axis]
                    - generalised[element][axis] / self.model.lengths[element]
            })
            .collect()
    }

    /// M at a shape, as angles.
    pub fn inertia(&self, kinematics: &Kinematics<f64>) -> Mat<f64> {
        let size = self.size();
        let mut matrix = Mat::zeros(size, size);
        let mut unit = vec![[0.0; 3]; self.model.element_count()];
        for column in 0..size {
            let (element, axis) = self.freedom(column);
            unit[element][axis] = 1.0 / self.model.lengths[element];
            let momenta = self.momenta(kinematics, &unit);
            unit[element][axis] = 0.0;
            for row in 0..size {
                matrix[(row, column)] = momenta[row];
            }
        }
        matrix
    }

    /// M q̇ over the free curvatures, as angles.
    fn momenta(&self, kinematics: &Kinematics<f64>, rates: &[[f64; 3]]) -> Vec<f64> {
        let mut momenta = vec![Vec3::zero(); kinematics.points.len()];
        velocity::for_each_point(kinematics, rates, &RootMotion::still(), |p, v, _| {
            momenta[p] = v.scale(self.model.linear_density * self.weight(p));
        });
        self.gather(kinematics, &momenta)
    }

    /// Jᵀ of one vector per point, over the free curvatures as angles.
    pub fn gather(&self, kinematics: &Kinematics<f64>, vectors: &[Vec3<f64>]) -> Vec<f64> {
        let generalised = force::generalised(kinematics, |p| vectors[p]);
        (0..self.size())
            .map(|index| {
                let (element, axis) = self.freedom(index);
                generalised[element][axis] / self.model.lengths[element]
            })
            .collect()
    }

    /// Momentum of every point for the given velocities, kg·m/s.
    pub fn point_momenta(&self, velocities: impl Iterator<Item = Vec3<f64>>) -> Vec<Vec3<f64>> {
        velocities.enumerate().map(|(p, v)| v.scale(self.model.linear_density * self.weight(p))).collect()
    }

    /// All derivatives by central differences. The residual is quadratic in the rates, so its derivatives by the rates are exact.
    pub fn derivatives(&self, t: f64, q: &Rows, rates: &Rows, accelerations: &Rows) -> Derivatives {
        let size = self.size();
        let lengths = &self.model.lengths;
        let mut by_position = Mat::zeros(size, size);
        let mut by_rate = Mat::zeros(size, size);
        let largest = rates.iter().zip(lengths).flat_map(|(row, length)| row.map(|x| (x * length).abs())).fold(1.0_f64, f64::max);
        let (mut moved, mut faster) = (q.clone(), rates.clone());
        for column in 0..size {
            let (element, axis) = self.freedom(column);
            let angle = ANGLE_STEP;
            let step = angle / lengths[element];
            moved[element][axis] = q[element][axis] + step;
            let above = self.residual(t, &moved, rates, accelerations);
            moved[element][axis] = q[element][axis] - step;
            let below = self.residual(t, &moved, rates, accelerations);
            moved[element][axis] = q[element][axis];
            let step = largest / lengths[element];
            faster[element][axis] = rates[element][axis] + step;
            let quicker = self.residual(t, q, &faster, accelerations);
            faster[element][axis] = rates[element][axis] - step;
            let slower = self.residual(t, q, &faster, accelerations);
            faster[element][axis] = rates[element][axis];
            for row in 0..size {
                by_position[(row, column)] = (above[row] - below[row]) / (2.0 * angle);
                by_rate[(row, column)] = (quicker[row] - slower[row]) / (2.0 * largest);
            }
        }
        let (kinematics, _) = self.kinematics(t, q);
        Derivatives { inertia: self.inertia(&kinematics), by_position, by_rate }
    }
}
