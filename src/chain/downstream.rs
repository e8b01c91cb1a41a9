//! The elimination along a strand for least squares (fits and poses), with the symbols of [`super::elimination`].
//!
//! It works on plain numbers and whole blocks. The time step's own elimination packs symmetric blocks and works on lanes.

use super::elimination::reduced::Reduced;
use crate::math::vector::{Mat3, Vec3};

/// What lies downstream of a node, as seen from there: `[A B; Bᵀ C]` and its pull.
#[derive(Clone, Copy)]
pub(crate) struct Downstream {
    pub a: Mat3<f64>,
    pub b: Mat3<f64>,
    pub c: Mat3<f64>,
    pub moment: Vec3<f64>,
    pub force: Vec3<f64>,
}

impl Downstream {
    /// Downstream of the tip.
    pub fn nothing() -> Self {
        let zero = Mat3::zero();
        Self { a: zero, b: zero, c: zero, moment: Vec3::zero(), force: Vec3::zero() }
    }

    /// In the axes of the frame that `turn` starts from.
    pub fn turned(&self, turn: &Mat3<f64>) -> Self {
        let congruent = |m: &Mat3<f64>| turn.mul(m).mul_transposed(turn);
        Self {
            a: congruent(&self.a),
            b: congruent(&self.b),
            c: congruent(&self.c),
            moment: turn.apply(self.moment),
            force: turn.apply(self.force),
        }
    }

    /// Eliminates an element's freedoms from what lies downstream of its left end. Takes the `factor` of their pivot, their
    /// coupling to ψ and to ρ there, and their pull. Freedoms that are not `free` keep their values.
    pub fn reduce<const D: usize>(
        &mut self,
        factor: [[f64; D]; D],
        psi: &[Vec3<f64>; D],
        rho: &[Vec3<f64>; D],
        pull: &[f64; D],
        free: [bool; D],
    ) -> Reduced<f64, D> {
        let done = Reduced::new(factor, psi, rho, pull, free);
        for (w, y) in done.coupling.iter().zip(done.force) {
            for row in 0..3 {
                for column in 0..3 {
                    self.a.0[row][column] -= w[row] * w[column];
                    self.b.0[row][column] -= w[row] * w[column + 3];
                    self.c.0[row][column] -= w[row + 3] * w[column + 3];
                }
                self.moment.0[row] -= w[row] * y;
                self.force.0[row] -= w[row + 3] * y;
            }
        }
        // Symmetry is enforced: otherwise rounding errors grow along the strand.
        for m in [&mut self.a, &mut self.c] {
            for i in 0..3 {
                for j in 0..i {
                    let middle = 0.5 * (m.0[i][j] + m.0[j][i]);
                    (m.0[i][j], m.0[j][i]) = (middle, middle);
                }
            }
        }
        done
    }
}
