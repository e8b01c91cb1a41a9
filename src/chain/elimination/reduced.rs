//! An element's freedoms once they are eliminated, and their changes from the left end's: the forward and the back substitution of the solves.

use crate::math::lane::Lane;
use crate::math::vector::Vec3;

/// An element's freedoms, eliminated: Cholesky's factor (its diagonal inverted), and, both times the factor's inverse, their coupling to the
/// left end's ψ and ρ and their force.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reduced<T, const D: usize> {
    pub factor: [[T; D]; D],
    /// Rows are freedoms, columns ψ then ρ.
    pub coupling: [[T; 6]; D],
    pub force: [T; D],
}

impl<T: Lane, const D: usize> Reduced<T, D> {
    /// From the `factor` of the freedoms' pivot, their coupling to ψ and to ρ, and what pulls at them. Those that are not `free` stay.
    #[inline(always)]
    pub fn new(factor: [[T; D]; D], psi: &[Vec3<T>; D], rho: &[Vec3<T>; D], pull: &[T; D], free: [bool; D]) -> Self {
        let mut done = Self { factor, coupling: [[T::zero(); 6]; D], force: [T::zero(); D] };
        for i in 0..D {
            if !free[i] {
                continue;
            }
            let ([a, b, c], [d, e, f]) = (psi[i].0, rho[i].0);
            let mut row = [a, b, c, d, e, f];
            let mut value = pull[i];
            for k in 0..i {
                for column in 0..6 {
                    row[column] -= factor[i][k] * done.coupling[k][column];
                }
                value -= factor[i][k] * done.force[k];
            }
            for column in 0..6 {
                done.coupling[i][column] = row[column] * factor[i][i];
            }
            done.force[i] = value * factor[i][i];
        }
        done
    }

    /// The freedoms' changes where the left end turns by ψ and moves by ρ.
    #[inline(always)]
    pub fn change(&self, psi: Vec3<T>, rho: Vec3<T>) -> [T; D] {
        self.substituted(|i| {
            let mut value = self.force[i];
            for axis in 0..3 {
                value -= self.coupling[i][axis] * psi.0[axis] + self.coupling[i][axis + 3] * rho.0[axis];
            }
            value
        })
    }

    /// The changes from their right sides, the last freedom first.
    #[inline(always)]
    pub fn substituted(&self, side: impl Fn(usize) -> T) -> [T; D] {
        let mut delta = [T::zero(); D];
        for i in (0..D).rev() {
            let mut value = side(i);
            for k in i + 1..D {
                value -= self.factor[k][i] * delta[k];
            }
            delta[i] = value * self.factor[i][i];
        }
        delta
    }
}

impl<const D: usize> Reduced<f64, D> {
    /// The squares that the elimination completes, one a freedom: twice what the quadratic model falls by.
    pub fn squares(&self) -> impl Iterator<Item = f64> {
        self.force.into_iter().rev().map(|force| force * force)
    }
}
