//! The laws of constraints, each with its exact solve for one constraint alone.
//!
//! A constraint has a relative displacement `u` over the step (of the first point minus that of its partner, m; between
//! rotations rad) and a force `λ`, which acts as +λ on the first point and −λ on the partner (N; N·m). A law says which pairs
//! (u, λ) are possible. With implicit Euler's velocity, displacement over the step's seconds, this is the formulation of
//! Daviet, Bertails-Descoubes and Boissieux (2011).
//!
//! Files:
//!
//! - `bilateral.rs`: Bilateral constraints: points or rotations held together (pins, clamps, ties).
//! - `coefficient.rs`: Friction coefficients that depend on the direction of sliding.
//! - `contact.rs`: Contact with friction: its exact solve for one contact.
//! - `linear.rs`: The laws as equations F(λ, u) = 0, linearised where (λ, u) is.
//! - `response.rs`: The normal response: the depth of a contact under a normal force.
//! - `ring.rs`: A ring that a strand slides through, with Coulomb friction.
//! - `secular.rs`: The root of a function of one variable above zero that falls from positive to negative: Newton's iteration inside a bracket.

pub mod bilateral;
pub mod coefficient;
pub mod contact;
pub mod linear;
pub mod response;
pub mod ring;
pub mod secular;

use std::fmt::Display;

use nalgebra::{Matrix3, Vector3};

use self::bilateral::BilateralLaw;
use self::contact::{Contact, ContactSolve};
use self::ring::{Ring, RingSolve};
use crate::error::Result;

/// The law of a constraint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// Two surfaces that may part but not pass through each other, with friction.
    Contact(Contact),
    /// Two points, or two rotations, held together along some axes.
    Bilateral(BilateralLaw),
    /// A ring that a strand slides through, with friction.
    Ring(Ring),
}

impl Law {
    /// Checks every number of the law; `argument` names it in errors.
    pub fn check(&self, argument: impl Display) -> Result<()> {
        match self {
            Law::Contact(contact) => contact.check(argument),
            Law::Bilateral(bilateral) => bilateral.check(argument),
            Law::Ring(ring) => ring.check(argument),
        }
    }

    /// How far (u, λ) is from obeying the law, without dimension: displacements in units of `length` (m), forces in units of
    /// `force` (N), both above zero. Zero exactly where the law holds. For inequalities and friction it is the natural map λ −
    /// P(λ − u) of Alart and Curnier (1991), P the projection onto the possible λ; for equations it is their residual. `step`
    /// is the step's seconds.
    pub fn residual(&self, u: Vector3<f64>, lambda: Vector3<f64>, step: f64, length: f64, force: f64) -> f64 {
        match self {
            Law::Contact(contact) => contact.residual(u, lambda, step, length, force),
            Law::Bilateral(bilateral) => bilateral.residual(u, lambda, length, force),
            Law::Ring(ring) => ring.residual(u, lambda, length, force),
        }
    }
}

/// A law with all that its solve for one constraint alone needs of W, the displacement `u` per unit of `λ`.
#[derive(Debug, Clone, Copy)]
pub enum LawSolve {
    /// See [`Law::Contact`].
    Contact(ContactSolve),
    /// See [`Law::Ring`].
    Ring(RingSolve),
    /// See [`Law::Bilateral`].
    Bilateral(bilateral::BilateralSolve),
}

impl LawSolve {
    /// Prepares the solve. `response` is W: symmetric, positive semidefinite up to rounding; `step` the step's seconds.
    pub fn new(law: &Law, response: &Matrix3<f64>, step: f64) -> Self {
        match law {
            Law::Contact(contact) => LawSolve::Contact(ContactSolve::new(contact, response, step)),
            Law::Ring(ring) => LawSolve::Ring(RingSolve::new(ring, response)),
            Law::Bilateral(bilateral) => LawSolve::Bilateral(bilateral::BilateralSolve::new(bilateral, response)),
        }
    }

    /// The force λ for which u = W λ + `unconstrained` and λ obey the law; exact to rounding.
    #[inline(always)]
    pub fn solve(&mut self, unconstrained: Vector3<f64>) -> Vector3<f64> {
        self.solve_to(unconstrained, secular::EXACT)
    }

    /// The same for repeated solves with an `unconstrained` that changes less and less, as in sweeps: each solve begins where
    /// the last one ended, so that early ones need not be exact. Friction has the size that the law says; its direction, and
    /// with it the normal force, are exact once `unconstrained` no longer changes.
    #[inline(always)]
    pub(in crate::contact) fn approach(&mut self, unconstrained: Vector3<f64>) -> Vector3<f64> {
        self.solve_to(unconstrained, secular::NEAR)
    }

    #[inline(always)]
    fn solve_to(&mut self, unconstrained: Vector3<f64>, last: f64) -> Vector3<f64> {
        match self {
            LawSolve::Contact(contact) => contact.solve(unconstrained, last),
            LawSolve::Ring(ring) => ring.solve(unconstrained),
            LawSolve::Bilateral(bilateral) => bilateral.solve(unconstrained),
        }
    }
}

/// Checks that a direction has length 1 within a millionth.
fn check_unit(argument: impl Fn() -> String, v: &Vector3<f64>) -> Result<()> {
    if (v.norm() - 1.0).abs() <= 1e-6 {
        Ok(())
    } else {
        Err(crate::error::Error::invalid(argument(), format!("({}, {}, {})", v.x, v.y, v.z), "a direction of length 1"))
    }
}

/// Two directions that with `n` (unit) make a right-handed frame; continuous in n but for the sign of its smallest component.
pub(crate) fn across(n: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let (x, y, z) = (n.x.abs(), n.y.abs(), n.z.abs());
    let helper = if x <= y && x <= z {
        Vector3::x()
    } else if y <= z {
        Vector3::y()
    } else {
        Vector3::z()
    };
    let first = helper.cross(n).normalize();
    [first, n.cross(&first)]
}

/// (cos, sin) of the rotation that makes a symmetric matrix of two rows diagonal (Jacobi's), its larger number first. Roots alone, so that every machine gives the same bits; no rotation where there is nothing to turn.
fn diagonalising(first: f64, across: f64, second: f64) -> (f64, f64) {
    let (difference, twice) = (first - second, 2.0 * across);
    let scale = difference.abs().max(twice.abs());
    if scale == 0.0 {
        return (1.0, 0.0);
    }
    let (difference, twice) = (difference / scale, twice / scale);
    let size = (difference * difference + twice * twice).sqrt();
    // Cosine or sine of the half angle, whichever is larger, and the other by sin 2φ = 2 sin φ cos φ.
    let larger = (0.5 * (1.0 + difference.abs() / size)).sqrt();
    let smaller = 0.5 * twice.abs() / (size * larger);
    let (cos, sin) = if difference >= 0.0 { (larger, smaller) } else { (smaller, larger) };
    (cos, sin.copysign(twice))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rotation_diagonalises_any_matrix() {
        let numbers = [0.0, -0.0, 1.0, -1.0, 1.0 + 1e-15, 0.3, -0.7, 1e-9, -1e-9, 4e-200, 7e180];
        for a in numbers {
            for b in numbers {
                for c in numbers {
                    let (cos, sin) = diagonalising(a, b, c);
                    let scale = a.abs().max(b.abs()).max(c.abs());
                    let (a, b, c) = if scale > 0.0 { (a / scale, b / scale, c / scale) } else { (a, b, c) };
                    let rest = cos * sin * (c - a) + (cos * cos - sin * sin) * b;
                    let [large, small] = [(cos, sin), (-sin, cos)].map(|(x, y)| x * x * a + 2.0 * x * y * b + y * y * c);
                    assert!(
                        (cos * cos + sin * sin - 1.0).abs() < 4e-16 && rest.abs() < 4e-16,
                        "{a} {b} {c}: {cos} {sin} {rest:e}"
                    );
                    assert!(large >= small - 4e-16 && cos >= 0.0, "{a} {b} {c}: {large} {small}");
                }
            }
        }
    }
}
