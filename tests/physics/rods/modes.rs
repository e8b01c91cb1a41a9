//! Small vibrations about an equilibrium: H x = ω² M x from the engine's dense Hessian and inertia.

use nalgebra::{DMatrix, DVector, Vector3};
use superhelix::StrandDef;
use superhelix::internals::chain::dense;
use superhelix::internals::chain::system::ChainSystem;
use superhelix::internals::math::quadrature::Rules;
use superhelix::internals::math::vector::Vec3;
use superhelix::internals::rod::kinematics::Kinematics;
use superhelix::internals::step::state::rotation_matrix;

/// The matrices over the curvatures `axes` of every element.
pub struct Matrices {
    /// Hessian of elastic energy and weight.
    pub hessian: DMatrix<f64>,
    /// Its elastic part.
    pub elastic: DMatrix<f64>,
    /// Inertia.
    pub mass: DMatrix<f64>,
}

/// The matrices of a strand in the shape `curvatures`.
pub fn matrices(def: &StrandDef, curvatures: &[[f64; 3]], gravity: Vector3<f64>, axes: &[usize]) -> Matrices {
    let rules = Rules::default();
    let angle = curvatures.iter().zip(&def.element_lengths).map(|(row, length)| Vector3::from(*row).norm() * length);
    let rule = rules.rule(rules.next_for_angle(0, angle.fold(0.0, f64::max)));
    let mut kinematics = Kinematics::default();
    kinematics.update(&rotation_matrix(&def.root), &def.element_lengths, curvatures, rule);
    let points = kinematics.points.len();
    let weight = |p: usize| rule.weights[p % rule.len()] * def.element_lengths[p / rule.len()] * def.material.linear_density();
    let taken = |force: Vector3<f64>, stiff: bool, springs: bool| {
        let mut system = ChainSystem::default();
        system.resize(def.element_lengths.len(), points);
        for p in 0..points {
            system.point_force[p] = Vec3::from(force * weight(p));
            system.point_stiffness[p] = if stiff { weight(p) } else { 0.0 };
        }
        if springs {
            for (element, length) in def.element_lengths.iter().enumerate() {
                system.curvature_stiffness[element] = def.material.stiffness().map(|stiffness| stiffness * length);
            }
        }
        let matrix = dense::assemble(&kinematics, &system, axes).matrix;
        DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)])
    };
    let still = Vector3::zeros();
    Matrices { hessian: taken(gravity, false, true), elastic: taken(still, false, true), mass: taken(still, true, false) }
}

/// A mode: its angular frequency, rad/s, and its curvatures, with xᵀ H x = 1.
pub struct Mode {
    pub omega: f64,
    pub shape: DVector<f64>,
}

/// The slowest modes first. Twist has next to no inertia, so that M x = ω⁻² H x is what is solved.
pub fn modes(matrices: &Matrices) -> Vec<Mode> {
    let factor = matrices.hessian.clone().cholesky().expect("a stable equilibrium").l();
    let inverse = factor.clone().try_inverse().unwrap();
    let scaled = &inverse * &matrices.mass * inverse.transpose();
    let eigen = (0.5 * (&scaled + scaled.transpose())).symmetric_eigen();
    let mut found: Vec<Mode> = (0..eigen.eigenvalues.len())
        .filter(|i| eigen.eigenvalues[*i] > 0.0)
        .map(|i| Mode { omega: 1.0 / eigen.eigenvalues[i].sqrt(), shape: inverse.transpose() * eigen.eigenvectors.column(i) })
        .collect();
    found.sort_by(|a, b| a.omega.total_cmp(&b.omega));
    found
}
