//! The explicit force of Bonanni and Kmoch (2008, section 3.3): F = β ṫ⊥ + f(γ) ṫ∥.
//!
//! The tool's velocity ṫ is split across and along the tangent of the strand in contact. β scales with the bending stiffness, f
//! with the internal friction. Here both are those of a cantilever of the strand's length L: β = τ 3 EI/L³ and f = φ 3 γ/L³.
//!
//! The force is linear in the tool's velocity: one symmetric matrix represents any number of strands.

use nalgebra::{Matrix3, Vector3};

use crate::solver::report::Wrench;

/// The resistance to a tool's motion: hair acts on it with minus this times its velocities, about the handle's origin.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Resistance {
    /// Force by velocity, N·s/m.
    pub linear: Matrix3<f64>,
    /// Force by spin, N·s; transposed, torque by velocity.
    pub coupling: Matrix3<f64>,
    /// Torque by spin, N·m·s.
    pub angular: Matrix3<f64>,
}

impl Resistance {
    /// Adds a strand with this tangent (unit) and a contact at `arm` (m) from the handle's origin: `across` and `along` it,
    /// N·s/m.
    pub fn add(&mut self, tangent: &Vector3<f64>, arm: &Vector3<f64>, across: f64, along: f64) {
        let at_contact = Matrix3::identity() * across + tangent * tangent.transpose() * (along - across);
        // The tool's velocity at the contact is v − [arm]× ω.
        let arm = arm.cross_matrix();
        let by_spin = -at_contact * arm;
        self.linear += at_contact;
        self.coupling += by_spin;
        self.angular += arm * by_spin;
    }

    /// The action of hair on a tool with this velocity, m/s and rad/s.
    pub fn wrench(&self, velocity: &Vector3<f64>, spin: &Vector3<f64>) -> Wrench {
        Wrench {
            force: -(self.linear * velocity + self.coupling * spin),
            torque: -(self.coupling.transpose() * velocity + self.angular * spin),
        }
    }
}
