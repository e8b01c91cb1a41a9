//! A ring that a strand slides through, with Coulomb friction.
//!
//! Across the tangent the ring holds the strand (two equations); along it |λ_t| ≤ μ |λ_⊥|. With λ_⊥ eliminated, u_t = S (λ_t − λ*) with S ≥ 0
//! and λ* the force that would hold it; where friction cannot hold that, λ_t lies between 0 and λ* where |λ_t| = μ |λ_⊥(λ_t)|, a quadratic
//! equation.

use std::fmt::Display;

use nalgebra::{Matrix3, Vector3};

use super::coefficient::Coefficient;
use super::{across, check_unit, diagonalising};
use crate::error::Result;

/// A ring: the first strand passes through its partner, or a point of the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// The first strand's tangent there, unit, world axes, root to tip.
    pub tangent: Vector3<f64>,
    /// μ; of its `lean` only the part along the tangent counts.
    pub friction: Coefficient,
}

impl Ring {
    /// See [`super::Law::check`].
    pub(super) fn check(&self, argument: impl Display) -> Result<()> {
        check_unit(|| format!("{argument}.tangent"), &self.tangent)?;
        self.friction.check(format_args!("{argument}.friction"))
    }

    /// See [`super::Law::residual`].
    pub(super) fn residual(&self, u: Vector3<f64>, lambda: Vector3<f64>, length: f64, force: f64) -> f64 {
        let t = self.tangent;
        let (u_t, lambda_t) = (u.dot(&t), lambda.dot(&t));
        let trial = lambda_t / force - u_t / length;
        let allowed = self.friction.at(&(-t * trial.signum())) * (lambda - t * lambda_t).norm() / force;
        let along = if trial.abs() <= allowed { u_t / length } else { lambda_t / force - allowed.copysign(trial) };
        along.abs().max((u - t * u_t).norm() / length)
    }
}

/// A ring's law with its W.
#[derive(Debug, Clone, Copy)]
pub struct RingSolve {
    tangent: Vector3<f64>,
    /// Across the tangent, along the axes in which W is diagonal there.
    sides: [Vector3<f64>; 2],
    /// Per side: force per unconstrained displacement (N/m), and force per force along the tangent.
    stiffness: [f64; 2],
    carried: [f64; 2],
    /// S, m/N.
    along: f64,
    /// μ for sliding along the tangent, and against it.
    friction: [f64; 2],
}

impl RingSolve {
    pub(super) fn new(ring: &Ring, response: &Matrix3<f64>) -> Self {
        let t = ring.tangent;
        let [s, r] = across(&t);
        let (ws, wr, wt) = (response * s, response * r, response * t);
        let (cos, sin) = diagonalising(s.dot(&ws), 0.5 * (s.dot(&wr) + r.dot(&ws)), r.dot(&wr));
        let sides = [s * cos + r * sin, r * cos - s * sin];
        let least = 4.0 * f64::EPSILON * response.trace().max(0.0);
        let stiffness = sides.map(|side| {
            let mobility = side.dot(&(response * side));
            if mobility > least { 1.0 / mobility } else { 0.0 }
        });
        let coupling = sides.map(|side| side.dot(&wt));
        let carried = [-stiffness[0] * coupling[0], -stiffness[1] * coupling[1]];
        let along = t.dot(&wt) + carried[0] * coupling[0] + carried[1] * coupling[1];
        Self {
            tangent: t,
            sides,
            stiffness,
            carried,
            along: along.max(least),
            friction: [ring.friction.at(&t), ring.friction.at(&-t)],
        }
    }

    /// See [`super::LawSolve::solve`].
    #[inline(always)]
    pub(super) fn solve(&self, unconstrained: Vector3<f64>) -> Vector3<f64> {
        let b = self.sides.map(|side| side.dot(&unconstrained));
        let p = [-self.stiffness[0] * b[0], -self.stiffness[1] * b[1]];
        let q = self.carried;
        // W_t⊥ W_⊥⁻¹ b_⊥ = −q·b.
        let drive = self.tangent.dot(&unconstrained) + q[0] * b[0] + q[1] * b[1];
        let holding = if self.along > 0.0 { -drive / self.along } else { 0.0 };
        let mu = self.friction[usize::from(holding > 0.0)];
        let side = |x: f64| [p[0] + q[0] * x, p[1] + q[1] * x];
        let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
        let held = holding * holding <= mu * mu * square(side(holding));
        let x = if held { holding } else { self.sliding(p, mu, holding.signum()) };
        let [first, second] = side(x);
        self.tangent * x + self.sides[0] * first + self.sides[1] * second
    }

    /// The smallest x of that sign with |x| = μ |p + q x|.
    fn sliding(&self, p: [f64; 2], mu: f64, sign: f64) -> f64 {
        let q = self.carried;
        let m = mu * mu;
        let a = 1.0 - m * (q[0] * q[0] + q[1] * q[1]);
        let half = m * sign * (p[0] * q[0] + p[1] * q[1]);
        let c = m * (p[0] * p[0] + p[1] * p[1]);
        let root = (half * half + a * c).max(0.0).sqrt();
        let size = if half > 0.0 && a > 0.0 {
            (half + root) / a
        } else if root - half > 0.0 {
            c / (root - half)
        } else {
            0.0
        };
        sign * size
    }
}
