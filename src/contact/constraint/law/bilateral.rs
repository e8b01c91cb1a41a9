//! Bilateral constraints: points or rotations held together (pins, clamps, ties).

use std::fmt::Display;

use nalgebra::{Matrix3, Vector3};

use super::{across, check_unit};
use crate::error::{Result, check_not_negative};

/// The components of `u` that a bilateral constraint keeps at zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ConstrainedAxes {
    /// All three.
    All,
    /// The two across this direction (unit, world): it may slide along the direction, or turn about it.
    Across(Vector3<f64>),
    /// The one along this direction (unit, world).
    Along(Vector3<f64>),
}

/// Two points, or two rotations, held together: u + compliance λ = 0 along the constrained axes, λ = 0 along the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BilateralLaw {
    /// The constrained axes.
    pub axes: ConstrainedAxes,
    /// m/N (between rotations rad/(N·m)), zero or above; zero: rigid.
    pub compliance: f64,
}

impl BilateralLaw {
    /// The constrained directions, unit and perpendicular to each other, world axes.
    pub fn directions(&self) -> impl Iterator<Item = Vector3<f64>> + use<> {
        let (held, count) = match self.axes {
            ConstrainedAxes::All => ([Vector3::x(), Vector3::y(), Vector3::z()], 3),
            ConstrainedAxes::Across(d) => {
                let [s, t] = across(&d);
                ([s, t, d], 2)
            }
            ConstrainedAxes::Along(d) => ([d; 3], 1),
        };
        held.into_iter().take(count)
    }

    /// The component of a vector along the constrained directions.
    fn held(&self, v: Vector3<f64>) -> Vector3<f64> {
        match self.axes {
            ConstrainedAxes::All => v,
            ConstrainedAxes::Across(d) => v - d * v.dot(&d),
            ConstrainedAxes::Along(d) => d * v.dot(&d),
        }
    }

    /// See [`super::Law::check`].
    pub(super) fn check(&self, argument: impl Display) -> Result<()> {
        if let ConstrainedAxes::Across(d) | ConstrainedAxes::Along(d) = &self.axes {
            check_unit(|| format!("{argument}.direction"), d)?;
        }
        check_not_negative(|| format!("{argument}.compliance"), self.compliance)
    }

    /// See [`super::Law::residual`].
    pub(super) fn residual(&self, u: Vector3<f64>, lambda: Vector3<f64>, length: f64, force: f64) -> f64 {
        let held = self.held(lambda);
        let residual = self.held(u) + held * self.compliance;
        (residual.norm() / length).max((lambda - held).norm() / force)
    }
}

/// A bilateral constraint's law with its W.
#[derive(Debug, Clone, Copy)]
pub struct BilateralSolve {
    /// Force per unconstrained displacement, N/m.
    stiffness: Matrix3<f64>,
}

impl BilateralSolve {
    pub(super) fn new(bilateral: &BilateralLaw, response: &Matrix3<f64>) -> Self {
        let mut held = [Vector3::zeros(); 3];
        for (slot, d) in held.iter_mut().zip(bilateral.directions()) {
            *slot = d;
        }
        let basis = Matrix3::from_columns(&held);
        let eigen = (basis.tr_mul(response) * basis + basis.tr_mul(&basis) * bilateral.compliance).symmetric_eigen();
        // No force along directions that do not respond: the pseudoinverse.
        let least = 64.0 * f64::EPSILON * (response.trace().max(0.0) + bilateral.compliance);
        let inverse = eigen.eigenvalues.map(|value| if value > least { 1.0 / value } else { 0.0 });
        let turned = basis * eigen.eigenvectors;
        Self { stiffness: turned * Matrix3::from_diagonal(&inverse) * turned.transpose() }
    }

    /// See [`super::LawSolve::solve`].
    #[inline(always)]
    pub(super) fn solve(&self, unconstrained: Vector3<f64>) -> Vector3<f64> {
        -(self.stiffness * unconstrained)
    }
}
