//! The dense reference: the whole 3N×3N matrix, assembled from Jacobians and second derivatives.
//!
//! Solvers are Cholesky's factorisation, conjugate gradients (Bertails et al. 2006, section 3.4) and singular values (Bergbom 2007,
//! section 5.1.5). The cost grows with the cube of the number of elements: for tests, studies and condition numbers.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::system::{ChainSystem, Direction, LinearSolve};
use crate::math::vector::Vec3;
use crate::rod::kinematics::Kinematics;
use crate::rod::segment;

/// How the dense system is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DenseMethod {
    /// Cholesky's factorisation; an indefinite matrix is repaired by taking its eigenvalues' magnitudes.
    Cholesky,
    /// Conjugate gradients, preconditioned by the diagonal, to 1e-12 of the first residual; they stop at a direction of negative
    /// curvature.
    ConjugateGradients,
    /// Singular values; they also repair an indefinite matrix. Gives the condition number.
    SingularValues,
}

/// The dense solve behind the interface of the linear-time one.
#[derive(Debug, Clone, Copy)]
pub struct Dense(pub DenseMethod);

impl LinearSolve<f64> for Dense {
    const DAMPED: bool = false;
    const ROTATION_LIMIT: f64 = 1.0;

    fn solve(
        &mut self,
        kinematics: &Kinematics<f64>,
        system: &ChainSystem<f64>,
        axes: &[usize],
        change: &mut Vec<[f64; 3]>,
    ) -> Direction<f64> {
        solve(kinematics, system, axes, self.0, change)
    }
}

/// The assembled matrix and right-hand side over the free curvatures, element by element.
#[derive(Debug, Clone)]
pub struct DenseSystem {
    /// The symmetric matrix.
    pub matrix: Mat<f64>,
    /// Forces on the free curvatures.
    pub force: Vec<f64>,
    /// Rotation of every element's right end per freedom, world axes: `turns[element][freedom]`; zero for freedoms of elements
    /// farther out.
    pub turns: Vec<Vec<Vec3<f64>>>,
}

/// Variations of one element in world axes.
struct Variations {
    psi: [Vec3<f64>; 3],
    jacobian_end: [Vec3<f64>; 3],
    right: Vec3<f64>,
}

/// Assembles the system over the curvatures `axes` of every element.
pub fn assemble(kinematics: &Kinematics<f64>, system: &ChainSystem<f64>, axes: &[usize]) -> DenseSystem {
    let (count, free) = (kinematics.elements.len(), axes.len());
    let size = count * free;
    let variations: Vec<Variations> = kinematics.elements.iter().map(variations_of).collect();
    let mut matrix = Mat::<f64>::zeros(size, size);
    let mut force = vec![0.0; size];
    let mut jacobian = vec![Vec3::<f64>::zero(); size];
    // For the geometric terms: Σ J×f per freedom over the points of an element and all farther out.
    let mut twisted = vec![Vec3::<f64>::zero(); size];

    for (index, element) in kinematics.elements.iter().enumerate() {
        for p in index * kinematics.points_per_element..(index + 1) * kinematics.points_per_element {
            let point = &kinematics.points[p];
            let z = element.kappa_squared * point.s * point.s;
            let local = segment::chord_gradient(element.kappa.scale(point.s), z, &point.c).scale(point.s * point.s);
            let own = element.frame_left.mul(&local);
            for (upstream, variation) in variations[..index].iter().enumerate() {
                for (slot, axis) in axes.iter().enumerate() {
                    jacobian[upstream * free + slot] =
                        variation.psi[*axis].cross(point.position - variation.right) + variation.jacobian_end[*axis];
                }
            }
            for (slot, axis) in axes.iter().enumerate() {
                jacobian[index * free + slot] = own.column(*axis);
            }
            let active = (index + 1) * free;
            let (stiffness, f, tension) = (system.point_stiffness[p], system.point_force[p], system.tension(p));
            for i in 0..active {
                force[i] += jacobian[i].dot(f);
                let scaled = jacobian[i].scale(stiffness);
                for j in 0..=i {
                    matrix[(i, j)] += scaled.dot(jacobian[j]);
                }
                twisted[i] += jacobian[i].cross(tension);
            }
            if system.exact {
                // An element with itself and with elements upstream; pairs of different elements go through `twisted` below.
                for i in 0..free {
                    for j in 0..=i {
                        let own_second = second_derivative(axes[i], axes[j], |v| {
                            segment::second_variation(element.kappa, v, point.s, element.kappa_squared, &point.c)
                        });
                        matrix[(index * free + i, index * free + j)] -= tension.dot(element.frame_left.apply(own_second));
                    }
                }
                for upstream in 0..index {
                    let at = &kinematics.elements[upstream];
                    let variation = &variations[upstream];
                    let rho = point.position - variation.right;
                    for i in 0..free {
                        for j in 0..=i {
                            let bend = second_derivative(axes[i], axes[j], |v| {
                                segment::second_variation(at.kappa, v, at.length, at.kappa_squared, &at.c)
                            });
                            let turn = second_derivative(axes[i], axes[j], |v| {
                                segment::second_rotation(at.kappa, v, at.length, at.kappa_squared, &at.c)
                            });
                            let (psi_i, psi_j) = (variation.psi[axes[i]], variation.psi[axes[j]]);
                            let swing = (psi_i.cross(psi_j.cross(rho)) + psi_j.cross(psi_i.cross(rho))).scale(0.5);
                            let sum = at.frame_left.apply(bend) + at.frame_left.apply(turn).cross(rho) + swing;
                            matrix[(upstream * free + i, upstream * free + j)] -= tension.dot(sum);
                        }
                    }
                }
            }
        }
    }
    if system.exact {
        // ∂²r/∂κ_Q∂κ_P for Q upstream of P is ψ_Q × J_P: a rotation of all that is downstream.
        for i in 0..size {
            for upstream in 0..i / free {
                for (slot, axis) in axes.iter().enumerate() {
                    // f·(ψ×J) = ψ·(J×f).
                    matrix[(i, upstream * free + slot)] -= variations[upstream].psi[*axis].dot(twisted[i]);
                }
            }
        }
    }
    for index in 0..count {
        for (slot, axis) in axes.iter().enumerate() {
            let i = index * free + slot;
            matrix[(i, i)] += system.curvature_stiffness[index][*axis];
            force[i] += system.curvature_force[index][*axis];
        }
    }
    for i in 0..size {
        for j in 0..i {
            matrix[(j, i)] = matrix[(i, j)];
        }
    }
    let turns = variations.iter().map(|v| axes.iter().map(|axis| v.psi[*axis]).collect()).collect();
    DenseSystem { matrix, force, turns }
}

fn variations_of(element: &crate::rod::kinematics::ElementState<f64>) -> Variations {
    let theta = element.kappa.scale(element.length);
    let z = element.kappa_squared * element.length * element.length;
    let psi = element.frame_left.mul(&segment::mean_frame(theta, z, &element.c)).scale(element.length);
    let end = element.frame_left.mul(&segment::chord_gradient(theta, z, &element.c)).scale(element.length * element.length);
    Variations {
        psi: std::array::from_fn(|axis| psi.column(axis)),
        jacobian_end: std::array::from_fn(|axis| end.column(axis)),
        right: element.origin_right(),
    }
}

/// The mixed derivative ∂²/∂κᵢ∂κⱼ of a quadratic function by polarisation.
fn second_derivative(i: usize, j: usize, quadratic: impl Fn(Vec3<f64>) -> Vec3<f64>) -> Vec3<f64> {
    let unit = |axis: usize| Vec3(std::array::from_fn(|k| if k == axis { 1.0 } else { 0.0 }));
    if i == j {
        return quadratic(unit(i));
    }
    (quadratic(unit(i) + unit(j)) - quadratic(unit(i)) - quadratic(unit(j))).scale(0.5)
}

/// Assembles and solves. The change of the free curvatures goes to `change`, one row per element.
pub fn solve(
    kinematics: &Kinematics<f64>,
    system: &ChainSystem<f64>,
    axes: &[usize],
    method: DenseMethod,
    change: &mut Vec<[f64; 3]>,
) -> Direction<f64> {
    let dense = assemble(kinematics, system, axes);
    let size = dense.force.len();
    let mut repaired = 0_usize;
    let mut condition = 0.0;
    let solution = if dense.force.iter().all(|f| f.is_finite()) && is_finite(&dense.matrix) {
        match method {
            DenseMethod::Cholesky => by_cholesky(&dense, &mut repaired),
            DenseMethod::ConjugateGradients => by_conjugate_gradients(&dense, &mut repaired),
            DenseMethod::SingularValues => by_singular_values(&dense, &mut repaired, &mut condition),
        }
    } else {
        vec![f64::NAN; size]
    };
    let free = axes.len();
    change.clear();
    change.resize(kinematics.elements.len(), [0.0; 3]);
    let mut rotation = Vec3::<f64>::zero();
    let (mut rotation_squared, mut rotation_sum) = (0.0_f64, 0.0);
    for (index, row) in change.iter_mut().enumerate() {
        for (slot, axis) in axes.iter().enumerate() {
            row[*axis] = solution[index * free + slot];
            rotation += dense.turns[index][slot].scale(row[*axis]);
        }
        rotation_squared = rotation_squared.max(rotation.norm_squared());
        rotation_sum += rotation.norm_squared();
    }
    let descent = solution.iter().zip(&dense.force).map(|(d, f)| d * f).sum();
    Direction { descent, rotation_squared, rotation_sum, repaired: repaired as f64, condition }
}

fn is_finite(matrix: &Mat<f64>) -> bool {
    (0..matrix.ncols()).all(|j| (0..matrix.nrows()).all(|i| matrix[(i, j)].is_finite()))
}

fn column(values: &[f64]) -> Mat<f64> {
    Mat::from_fn(values.len(), 1, |i, _| values[i])
}

fn by_cholesky(dense: &DenseSystem, repaired: &mut usize) -> Vec<f64> {
    let rhs = column(&dense.force);
    if let Ok(factor) = dense.matrix.llt(Side::Lower) {
        let solution = factor.solve(&rhs);
        return (0..rhs.nrows()).map(|i| solution[(i, 0)]).collect();
    }
    let Ok(eigen) = dense.matrix.self_adjoint_eigen(Side::Lower) else {
        return vec![f64::NAN; dense.force.len()];
    };
    let values: Vec<f64> = eigen.S().column_vector().iter().copied().collect();
    let largest = values.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
    let along = eigen.U().transpose() * &rhs;
    let scaled = Mat::from_fn(values.len(), 1, |i, _| {
        *repaired += usize::from(values[i] <= 0.0);
        along[(i, 0)] / values[i].abs().max(1e-14 * largest)
    });
    let solution = eigen.U() * scaled;
    (0..rhs.nrows()).map(|i| solution[(i, 0)]).collect()
}

fn by_conjugate_gradients(dense: &DenseSystem, repaired: &mut usize) -> Vec<f64> {
    let size = dense.force.len();
    let inverse_diagonal: Vec<f64> = (0..size).map(|i| 1.0 / dense.matrix[(i, i)].abs().max(f64::MIN_POSITIVE)).collect();
    let mut solution = vec![0.0; size];
    let mut residual = dense.force.clone();
    let mut direction: Vec<f64> = residual.iter().zip(&inverse_diagonal).map(|(r, d)| r * d).collect();
    let mut product: f64 = residual.iter().zip(&direction).map(|(r, z)| r * z).sum();
    let target = 1e-24 * product;
    for iteration in 0..20 * size {
        if product <= target || product == 0.0 {
            break;
        }
        let image = &dense.matrix * column(&direction);
        let curvature: f64 = (0..size).map(|i| direction[i] * image[(i, 0)]).sum();
        if curvature <= 0.0 {
            *repaired += 1;
            if iteration == 0 {
                return direction;
            }
            break;
        }
        let step = product / curvature;
        for i in 0..size {
            solution[i] += step * direction[i];
            residual[i] -= step * image[(i, 0)];
        }
        let next: f64 = (0..size).map(|i| residual[i] * residual[i] * inverse_diagonal[i]).sum();
        for i in 0..size {
            direction[i] = residual[i] * inverse_diagonal[i] + next / product * direction[i];
        }
        product = next;
    }
    solution
}

fn by_singular_values(dense: &DenseSystem, repaired: &mut usize, condition: &mut f64) -> Vec<f64> {
    let Ok(svd) = dense.matrix.svd() else {
        return vec![f64::NAN; dense.force.len()];
    };
    let values: Vec<f64> = svd.S().column_vector().iter().copied().collect();
    let largest = values.first().copied().unwrap_or(0.0);
    let smallest = values.last().copied().unwrap_or(0.0);
    *condition = if smallest > 0.0 { largest / smallest } else { f64::INFINITY };
    let size = values.len();
    // For a symmetric matrix u = ±v, where the sign is the eigenvalue's. V Σ⁻¹ Vᵀ is the matrix repaired by its eigenvalues'
    // magnitudes.
    let (u, v) = (svd.U(), svd.V());
    for k in 0..size {
        let sign: f64 = (0..size).map(|i| u[(i, k)] * v[(i, k)]).sum();
        *repaired += usize::from(sign < 0.0);
    }
    let rhs = column(&dense.force);
    let along = v.transpose() * &rhs;
    let scaled = Mat::from_fn(size, 1, |i, _| along[(i, 0)] / values[i].max(1e-14 * largest));
    let solution = v * scaled;
    (0..size).map(|i| solution[(i, 0)]).collect()
}
