//! The laws as equations F(λ, u) = 0, linearised where (λ, u) is: what a semismooth Newton iteration over many contacts needs
//! (Alart and Curnier 1991; for fibres Bertails-Descoubes, Cadoux, Daviet and Acary 2011).

use nalgebra::{Matrix3, Vector3};

use super::Law;
use super::contact::{Contact, Friction};
use super::response::Response;
use super::ring::Ring;

/// F, N, and a generalised derivative of it.
#[derive(Debug, Clone, Copy)]
pub struct Linear {
    /// F: zero exactly where the law holds.
    pub residual: Vector3<f64>,
    /// ∂F/∂λ.
    pub by_force: Matrix3<f64>,
    /// ∂F/∂u, N/m; zero where the law says λ = 0 whatever u is.
    pub by_displacement: Matrix3<f64>,
}

impl Default for Linear {
    fn default() -> Self {
        Self { residual: Vector3::zeros(), by_force: Matrix3::identity(), by_displacement: Matrix3::zeros() }
    }
}

impl Law {
    /// The law at (λ, u). `response` is the constraint's own W (see [`super::LawSolve::new`]), which weighs displacements
    /// against forces. A contact that nothing moves asks for λ = 0.
    pub fn linearise(&self, u: &Vector3<f64>, lambda: &Vector3<f64>, response: &Matrix3<f64>, step: f64) -> Linear {
        if response.trace() <= 0.0 {
            return Linear { residual: *lambda, ..Linear::default() };
        }
        match self {
            Law::Contact(contact) => contact.linearise(u, lambda, response, step),
            Law::Ring(ring) => ring.linearise(u, lambda, response),
            Law::Bilateral(_) => unreachable!("bilateral constraints are eliminated before any iteration"),
        }
    }
}

/// One over the mean response along the normal and across it; a direction without response gets a hundredth of the other's.
fn weights(n: &Vector3<f64>, response: &Matrix3<f64>) -> [f64; 2] {
    let trace = response.trace();
    let along = n.dot(&(response * n));
    let least = 1e-2 * trace;
    [1.0 / along.max(least), 1.0 / (0.5 * (trace - along)).max(least)]
}

impl Contact {
    fn linearise(&self, u: &Vector3<f64>, lambda: &Vector3<f64>, response: &Matrix3<f64>, step: f64) -> Linear {
        let n = self.normal;
        let [r_n, r_t] = weights(&n, response);
        let (normal, tangential) = (n * n.transpose(), Matrix3::identity() - n * n.transpose());
        let (u_n, lambda_n) = (u.dot(&n), lambda.dot(&n));
        let (u_t, lambda_t) = (u - n * u_n, lambda - n * lambda_n);
        let depth = self.response.depth(step);
        let mut out = Linear::default();
        let pressed = if let Response::Regularised { .. } = self.response {
            // By the depth: the force as a function of it has no infinite slope.
            let (force, stiffness) = (depth.pressed(-u_n), depth.stiffness(-u_n));
            let part = r_n * depth.compliance() / (r_n * depth.compliance() + 1.0);
            out.residual = n * (part * (lambda_n - force));
            out.by_force = normal * part;
            out.by_displacement = normal * (part * stiffness);
            stiffness > 0.0
        } else {
            let gap = u_n + depth.at(lambda_n);
            let pressed = lambda_n - r_n * gap > 0.0;
            if pressed {
                out.residual = n * (r_n * gap);
                out.by_force = normal * (r_n * depth.compliance());
                out.by_displacement = normal * r_n;
            } else {
                out.residual = n * lambda_n;
                out.by_force = normal;
            }
            pressed
        };
        match self.friction {
            Friction::Viscous(c) => {
                // λ_T + (mean u_T + (lean·u_T) d)/h, d the direction of u_T.
                let speed = u_t.norm();
                let (mut force, mut slope) = (u_t * (c.mean / step), tangential * (c.mean / step));
                if speed > 0.0 {
                    let d = u_t / speed;
                    let lean = (c.lean - n * c.lean.dot(&n)) / step;
                    let along = lean.dot(&d);
                    force += u_t * along;
                    slope += d * lean.transpose() + (tangential - d * d.transpose()) * along;
                }
                let part = r_t / (r_t + c.mean / step);
                out.residual += (lambda_t + force) * part;
                out.by_force += tangential * part;
                out.by_displacement += slope * part;
            }
            Friction::Coulomb(mu) if pressed => {
                let trial = lambda_t - u_t * r_t;
                let size = trial.norm();
                let d = if size > 0.0 { trial / size } else { Vector3::zeros() };
                let coefficient = mu.at(&-d);
                let most = lambda_n.max(0.0);
                if size <= coefficient * most {
                    out.residual += u_t * r_t;
                    out.by_displacement += tangential * r_t;
                } else {
                    let turn = tangential - d * d.transpose();
                    let slope = (turn * coefficient - d * (turn * mu.lean).transpose()) * (most / size);
                    out.residual += lambda_t - d * (coefficient * most);
                    out.by_force += tangential - d * n.transpose() * coefficient - slope;
                    out.by_displacement += slope * r_t;
                }
            }
            Friction::Coulomb(_) | Friction::None => {
                out.residual += lambda_t;
                out.by_force += tangential;
            }
        }
        out
    }
}

impl Ring {
    fn linearise(&self, u: &Vector3<f64>, lambda: &Vector3<f64>, response: &Matrix3<f64>) -> Linear {
        let t = self.tangent;
        let [r_t, r_n] = weights(&t, response);
        let across = Matrix3::identity() - t * t.transpose();
        let (u_t, lambda_t) = (u.dot(&t), lambda.dot(&t));
        let mut out = Linear { residual: across * u * r_n, by_force: Matrix3::zeros(), by_displacement: across * r_n };
        let trial = lambda_t - r_t * u_t;
        let held = across * lambda;
        let mu = self.friction.at(&(-t * trial.signum()));
        let size = held.norm();
        if trial.abs() <= mu * size {
            out.residual += t * (r_t * u_t);
            out.by_displacement += t * t.transpose() * r_t;
        } else {
            let sign = trial.signum();
            out.residual += t * (lambda_t - sign * mu * size);
            out.by_force += t * t.transpose();
            if size > 0.0 {
                out.by_force -= t * (held / size).transpose() * (sign * mu);
            }
        }
        out
    }
}
