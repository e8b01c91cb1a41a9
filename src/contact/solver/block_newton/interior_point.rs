//! Contacts that friction jams, at once: an interior-point method on Coulomb's law itself.
//!
//! Where two strands touch at places half a millimetre apart with nearly opposite normals, the forces that hold them may be many times
//! those that act on them, and neither sweeps nor Newton's iteration find them. In the scaled forces x = (λ_n, λ_t/μ) and displacements
//! y = (u_n + |μ u_t|, μ u_t) Coulomb's law says that both are in the Lorentz cone and x∘y = 0 (De Saxcé and Feng 1998; Acary and Brogliato
//! 2008, chapter 13): y = M x + b + |y_t| e is solved with it by a primal-dual method with the scaling of Nesterov and Todd and the predictor
//! and corrector of Mehrotra. The term |y_t| makes the problem non-convex: its derivative is left out of an iteration whose last step was
//! short, without which the method gets stuck at the boundary.
//!
//! Files:
//!
//! - `tests.rs`: Contacts that friction jams, and what is known in closed form.

use nalgebra::{Matrix3, Vector3};

use crate::contact::constraint::law::Law;
use crate::contact::constraint::law::contact::{Contact, Friction};
use crate::contact::constraint::law::response::Response;
use crate::contact::solver::dense::Factors;
use crate::contact::solver::gauss_seidel::Report;
use crate::meter::Meter;

/// The largest number of iterations.
const MAX_ITERATIONS: usize = 60;
/// The fraction of the way to the cones' boundary that a step goes.
const STEP: f64 = 0.7;
/// The derivative of |y_t| counts after steps of at least this length.
const LONG: f64 = 0.3;

/// Costs in nanoseconds or so of a contact's scaling, and the number of multiplications of an elimination per nanosecond.
const WORK_A_CONTACT: u64 = 700;
const MULTIPLICATIONS: u64 = 6;

type Three = Vector3<f64>;

/// The solver's memory, and its solution.
#[derive(Debug, Clone, Default)]
pub(in crate::contact) struct InteriorPoint {
    /// The best forces found, N, and the displacements by them, m, world.
    pub(in crate::contact) forces: Vec<Three>,
    pub(in crate::contact) moved: Vec<Three>,
    /// The cost of the last solve.
    pub(in crate::contact) work: u64,
    /// Normal and tangents of each contact as rows.
    frames: Vec<Matrix3<f64>>,
    /// Displacements per force in these, in the report's scales; row after row.
    coupling: Vec<f64>,
    /// Unconstrained displacements, in the same.
    unconstrained: Vec<Three>,
    coefficients: Vec<f64>,
    x: Vec<Three>,
    y: Vec<Three>,
    scaling: Vec<Scaling>,
    /// The residual of y = M x + b + |y_t| e.
    residual: Vec<Three>,
    /// The derivative of |y_t| e with respect to y, without the sign: its first row.
    by_slip: Vec<Three>,
    matrix: Vec<f64>,
    factors: Factors,
    directions: [Vec<Three>; 2],
    complementarity: Vec<Three>,
    rhs: Vec<f64>,
    refined: Vec<f64>,
    trial_forces: Vec<Three>,
    trial_moved: Vec<Three>,
}

/// Nesterov and Todd's scaling of one contact: W x = W⁻¹ y.
#[derive(Debug, Clone, Copy)]
struct Scaling {
    w: Matrix3<f64>,
    inverse: Matrix3<f64>,
    square: Matrix3<f64>,
    /// W x.
    scaled: Three,
}

/// Contacts whose law the method can take, with the displacements of their rows without forces.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Jammed<'a> {
    pub(in crate::contact) laws: &'a [Contact],
    /// World, m.
    pub(in crate::contact) unconstrained: &'a [Three],
    /// Displacement per force, m/N: the column of component c of contact j has that of component r of contact i at
    /// (3 j + c) 3 m + 3 i + r.
    pub(in crate::contact) coupling: &'a [f64],
    /// The step, s.
    pub(in crate::contact) step: f64,
}

/// A contact, if its law is one that the method takes: hard or a linear spring, with Coulomb's friction or none.
pub(in crate::contact) fn suitable(law: &Law) -> Option<Contact> {
    match law {
        Law::Contact(
            contact @ Contact {
                response: Response::Hard | Response::Penalty { .. },
                friction: Friction::Coulomb(_) | Friction::None,
                ..
            },
        ) => Some(*contact),
        _ => None,
    }
}

impl InteriorPoint {
    /// Solves for the forces until the residual in the report's scales is `tolerance`, or `max_work` is spent, and returns the
    /// residual of the best.
    pub(in crate::contact) fn solve(
        &mut self,
        jammed: Jammed,
        report: &Report,
        tolerance: f64,
        max_work: u64,
        meter: &Meter,
    ) -> f64 {
        let m = jammed.laws.len();
        let size = 3 * m as u64;
        let work_an_iteration =
            size.pow(3) / (3 * MULTIPLICATIONS) + size.pow(2) * 8 / MULTIPLICATIONS + WORK_A_CONTACT * m as u64;
        self.work = 0;
        self.begin(&jammed, report);
        let (mut best, mut step) = (f64::INFINITY, 1.0);
        for iteration in 0..=MAX_ITERATIONS {
            if iteration > 0 {
                self.update_coefficients(&jammed);
            }
            let worst = self.evaluate(&jammed, report);
            if worst < best {
                best = worst;
                std::mem::swap(&mut self.forces, &mut self.trial_forces);
                std::mem::swap(&mut self.moved, &mut self.trial_moved);
            }
            self.work += work_an_iteration;
            let spent = iteration == MAX_ITERATIONS || self.work > max_work || meter.is_halted();
            if best <= tolerance || spent || !worst.is_finite() || !self.iterate(&mut step) {
                break;
            }
        }
        best
    }

    /// Sets up the problem in the contacts' frames and the report's scales, and the first point.
    fn begin(&mut self, jammed: &Jammed, report: &Report) {
        let m = jammed.laws.len();
        let scale = report.force / report.length;
        self.frames.clear();
        self.frames.extend(jammed.laws.iter().map(|law| {
            let [s, t] = law.tangents();
            Matrix3::from_rows(&[law.normal.transpose(), s.transpose(), t.transpose()])
        }));
        self.unconstrained.clear();
        self.coupling.clear();
        self.coupling.resize(9 * m * m, 0.0);
        for (i, law) in jammed.laws.iter().enumerate() {
            let (compliance, shift) = law.compliance_and_shift(jammed.step);
            let frame = &self.frames[i];
            self.unconstrained.push((frame * jammed.unconstrained[i] + Three::x() * shift) / report.length);
            for j in 0..m {
                let block = Matrix3::from_fn(|r, c| jammed.coupling[(3 * j + c) * 3 * m + 3 * i + r]);
                let mut block = frame * block * self.frames[j].transpose() * scale;
                if i == j {
                    block[(0, 0)] += compliance * scale;
                }
                for r in 0..3 {
                    for c in 0..3 {
                        self.coupling[(3 * i + r) * 3 * m + 3 * j + c] = block[(r, c)];
                    }
                }
            }
        }
        self.coefficients.clear();
        self.coefficients.extend(jammed.laws.iter().map(|law| match &law.friction {
            Friction::Coulomb(coefficient) => coefficient.mean,
            Friction::None | Friction::Viscous(_) => 0.0,
        }));
        let mut trace = 0.0;
        let mut largest = 1.0_f64;
        for i in 0..m {
            let weight = self.weight(i);
            for r in 0..3 {
                trace += weight[r] * weight[r] * self.coupling[(3 * i + r) * (3 * m + 1)];
                largest = largest.max((weight[r] * self.unconstrained[i][r]).abs());
            }
        }
        let mean = (trace / (3 * m) as f64).max(f64::MIN_POSITIVE);
        self.y.clear();
        self.y.resize(m, Three::x() * largest);
        self.x.clear();
        self.x.resize(m, Three::x() * (largest / mean));
    }

    /// What the components of x and y are of forces and displacements.
    fn weight(&self, contact: usize) -> Three {
        Three::new(1.0, self.coefficients[contact], self.coefficients[contact])
    }

    /// The coefficients of friction for the directions in which the present forces would let the contacts slide.
    fn update_coefficients(&mut self, jammed: &Jammed) {
        for (i, law) in jammed.laws.iter().enumerate() {
            if let Friction::Coulomb(coefficient) = &law.friction {
                let across = Three::new(0.0, self.x[i].y, self.x[i].z);
                let size = across.norm();
                let direction = if size > 0.0 { -(self.frames[i].transpose() * across) / size } else { Three::zeros() };
                self.coefficients[i] = coefficient.at(&direction);
            }
        }
    }

    /// M x + b, in the scaled components.
    fn displaced(&self, i: usize, forces: &[Three]) -> Three {
        let m = forces.len();
        let mut sum = self.unconstrained[i];
        for r in 0..3 {
            let row = self.coupling[(3 * i + r) * 3 * m..][..3 * m].as_chunks::<3>().0;
            sum[r] += row.iter().zip(forces).map(|(a, f)| a[0] * f.x + a[1] * f.y + a[2] * f.z).sum::<f64>();
        }
        sum
    }

    /// The forces and displacements of the present point, and the largest residual of their laws; the residual of the equations.
    fn evaluate(&mut self, jammed: &Jammed, report: &Report) -> f64 {
        let m = jammed.laws.len();
        self.trial_forces.clear();
        for i in 0..m {
            self.trial_forces.push(self.x[i].component_mul(&self.weight(i)));
        }
        self.trial_moved.clear();
        self.residual.clear();
        for i in 0..m {
            let moved = self.displaced(i, &self.trial_forces);
            let y = &self.y[i];
            let slip = (y.y * y.y + y.z * y.z).sqrt();
            self.residual.push(moved.component_mul(&self.weight(i)) + Three::x() * slip - y);
            self.trial_moved.push(moved);
        }
        let mut worst = 0.0_f64;
        for (i, law) in jammed.laws.iter().enumerate() {
            let (compliance, shift) = law.compliance_and_shift(jammed.step);
            let back = self.frames[i].transpose();
            let force = back * self.trial_forces[i] * report.force;
            let mut moved = self.trial_moved[i] * report.length;
            moved.x -= shift + compliance * self.trial_forces[i].x * report.force;
            (self.trial_forces[i], self.trial_moved[i]) = (force, back * moved);
            let law_residual = report.law_residual(&Law::Contact(*law), self.trial_moved[i], force, jammed.step);
            worst = if law_residual.is_nan() { f64::NAN } else { worst.max(law_residual) };
        }
        worst
    }

    /// One step. False where there is none.
    fn iterate(&mut self, step: &mut f64) -> bool {
        let m = self.x.len();
        let n = 3 * m;
        let gap = self.x.iter().zip(&self.y).map(|(x, y)| x.dot(y)).sum::<f64>() / m as f64;
        self.scaling.clear();
        self.scaling.extend(self.x.iter().zip(&self.y).map(|(x, y)| Scaling::of(x, y)));
        self.by_slip.clear();
        let counts = *step >= LONG;
        self.by_slip.extend(self.y.iter().map(|y| {
            let slip = (y.y * y.y + y.z * y.z).sqrt().max(1e-12);
            if counts { Three::new(0.0, y.y, y.z) / slip } else { Three::zeros() }
        }));
        self.matrix.clear();
        self.matrix.resize(n * n, 0.0);
        for i in 0..m {
            let weight = self.weight(i);
            for r in 0..3 {
                let row = (3 * i + r) * n;
                for j in 0..m {
                    let other = self.weight(j);
                    for c in 0..3 {
                        self.matrix[row + 3 * j + c] = weight[r] * self.coupling[row + 3 * j + c] * other[c];
                    }
                }
            }
            let block = without_slip(&self.by_slip[i]) * self.scaling[i].square;
            for r in 0..3 {
                for c in 0..3 {
                    self.matrix[(3 * i + r) * n + 3 * i + c] += block[(r, c)];
                }
            }
        }
        if !self.factors.factorise(&self.matrix, n) {
            return false;
        }
        self.complementarity.clear();
        self.complementarity.extend(self.scaling.iter().map(|s| -product(&s.scaled, &s.scaled)));
        self.direction();
        let predicted = self.largest_step().min(1.0);
        let centring = (1.0 - predicted).powi(3).clamp(1e-6, 1.0);
        let part = if predicted < 0.1 { predicted } else { 1.0 };
        for (i, s) in self.scaling.iter().enumerate() {
            let second = product(&(s.w * self.directions[0][i]), &(s.inverse * self.directions[1][i]));
            self.complementarity[i] = Three::x() * (centring * gap) - product(&s.scaled, &s.scaled) - second * part;
        }
        self.direction();
        *step = (STEP * self.largest_step()).min(1.0);
        for i in 0..m {
            self.x[i] += self.directions[0][i] * *step;
            self.y[i] += self.directions[1][i] * *step;
        }
        step.is_finite() && self.x.iter().chain(&self.y).all(|v| v.iter().all(|x| x.is_finite()))
    }

    /// The directions of x and y for the present complementarity, by the factors, refined once.
    fn direction(&mut self) {
        let m = self.x.len();
        let n = 3 * m;
        let [along_x, along_y] = &mut self.directions;
        along_y.clear();
        along_y.extend(self.scaling.iter().zip(&self.complementarity).map(|(s, c)| s.w * quotient(&s.scaled, c)));
        self.rhs.clear();
        for i in 0..m {
            let rhs = without_slip(&self.by_slip[i]) * along_y[i] - self.residual[i];
            self.rhs.extend_from_slice(rhs.as_slice());
        }
        self.refined.clone_from(&self.rhs);
        self.factors.solve(&mut self.rhs);
        for (row, left) in self.matrix.chunks_exact(n).zip(&mut self.refined) {
            *left -= row.iter().zip(&self.rhs).map(|(a, x)| a * x).sum::<f64>();
        }
        self.factors.solve(&mut self.refined);
        along_x.clear();
        for (i, along_y) in along_y.iter_mut().enumerate() {
            let at = |k: usize| self.rhs[3 * i + k] + self.refined[3 * i + k];
            let x = Three::new(at(0), at(1), at(2));
            *along_y -= self.scaling[i].square * x;
            along_x.push(x);
        }
    }

    /// The largest step along the directions that leaves both in the cones.
    fn largest_step(&self) -> f64 {
        let [along_x, along_y] = &self.directions;
        let both = self.x.iter().zip(along_x).chain(self.y.iter().zip(along_y));
        both.map(|(v, d)| to_boundary(v, d)).fold(f64::INFINITY, f64::min)
    }
}

impl Scaling {
    fn of(x: &Three, y: &Three) -> Self {
        let (root_x, root_y) = (determinant(x).sqrt(), determinant(y).sqrt());
        let (unit_x, unit_y) = (x / root_x, y / root_y);
        let gamma = (0.5 * (1.0 + unit_x.dot(&unit_y))).sqrt();
        let w = (unit_y + Three::new(unit_x.x, -unit_x.y, -unit_x.z)) / (2.0 * gamma);
        let eta = (root_y / root_x).sqrt();
        let of = |sign: f64| {
            let [p, q] = [w.y, w.z];
            let over = 1.0 / (1.0 + w.x);
            Matrix3::new(
                w.x,
                sign * p,
                sign * q,
                sign * p,
                1.0 + p * p * over,
                p * q * over,
                sign * q,
                p * q * over,
                1.0 + q * q * over,
            )
        };
        let (w, inverse) = (of(1.0) * eta, of(-1.0) / eta);
        Self { w, inverse, square: w * w, scaled: w * x }
    }
}

/// 1 − ∂(|y_t| e)/∂y, by the derivative's first row.
fn without_slip(by_slip: &Three) -> Matrix3<f64> {
    Matrix3::identity() - Three::x() * by_slip.transpose()
}

/// a₀² − |a_t|², kept above zero.
fn determinant(a: &Three) -> f64 {
    let across = (a.y * a.y + a.z * a.z).sqrt();
    ((a.x - across) * (a.x + across)).max(1e-300)
}

/// The Jordan product a∘b.
fn product(a: &Three, b: &Three) -> Three {
    Three::new(a.dot(b), a.x * b.y + b.x * a.y, a.x * b.z + b.x * a.z)
}

/// z with a∘z = b.
fn quotient(a: &Three, b: &Three) -> Three {
    let z = (a.x * b.x - a.y * b.y - a.z * b.z) / determinant(a);
    Three::new(z, (b.y - z * a.y) / a.x, (b.z - z * a.z) / a.x)
}

/// The largest step from `v`, inside the cone, along `d` that stays in it.
fn to_boundary(v: &Three, d: &Three) -> f64 {
    let square = d.x * d.x - d.y * d.y - d.z * d.z;
    let half = v.x * d.x - v.y * d.y - v.z * d.z;
    let constant = determinant(v);
    let most = if d.x < 0.0 { -v.x / d.x } else { f64::INFINITY };
    let discriminant = half * half - square * constant;
    if discriminant < 0.0 {
        return most;
    }
    let q = -(half + discriminant.sqrt().copysign(half));
    [q / square, constant / q].into_iter().filter(|step| *step > 0.0).fold(most, f64::min)
}

#[cfg(test)]
mod tests;
