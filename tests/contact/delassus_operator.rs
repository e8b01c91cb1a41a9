//! A strand's response to forces at material points, against dense matrices and differences of positions.

use nalgebra::{DMatrix, DVector};
use superhelix::internals::chain::delassus::Delassus;
use superhelix::internals::chain::dense;
use superhelix::internals::chain::elimination::Elimination;
use superhelix::internals::chain::load::{Load, MaterialPoint};
use superhelix::internals::chain::response::ResponseScratch;
use superhelix::internals::chain::system::ChainSystem;
use superhelix::internals::math::quadrature::Rule;
use superhelix::internals::math::vector::{Mat3, Vec3};
use superhelix::internals::rod::kinematics::Kinematics;

/// Numbers in (−1, 1).
struct Pseudo(u64);

impl Pseudo {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    fn vector(&mut self) -> Vec3<f64> {
        Vec3([self.next(), self.next(), self.next()])
    }
}

struct Case {
    lengths: Vec<f64>,
    curvatures: Vec<[f64; 3]>,
    rule: Rule,
    material_points: Vec<MaterialPoint>,
    tension: Vec<Vec3<f64>>,
}

impl Case {
    fn kinematics(&self, curvatures: &[[f64; 3]]) -> Kinematics<f64> {
        let mut kinematics = Kinematics::default();
        kinematics.update(&Mat3::identity(), &self.lengths, curvatures, &self.rule);
        kinematics
    }

    fn places(&self, curvatures: &[[f64; 3]]) -> Vec<Vec3<f64>> {
        let elements = self.kinematics(curvatures).elements;
        self.material_points
            .iter()
            .map(|material_point| Load::at(&elements, material_point, Vec3::zero()).position(&elements))
            .collect()
    }

    fn shifted(&self, changes: &[(usize, f64)]) -> Vec<Vec3<f64>> {
        let mut curvatures = self.curvatures.clone();
        for (freedom, step) in changes {
            curvatures[freedom / 3][freedom % 3] += step;
        }
        self.places(&curvatures)
    }
}

fn case(elements: usize, material_points: usize, levers: bool, angle: f64, seed: u64) -> Case {
    let mut pseudo = Pseudo(seed);
    let lengths: Vec<f64> = (0..elements).map(|_| 0.6 + 0.3 * pseudo.next()).collect();
    let curvatures = lengths.iter().map(|length| pseudo.vector().scale(angle / length).0).collect();
    let mut material_points: Vec<MaterialPoint> = (0..material_points)
        .map(|k| {
            let element = ((pseudo.next() * 0.5 + 0.5) * elements as f64) as usize;
            let s = lengths[element] * (pseudo.next() * 0.5 + 0.5);
            let lever = if levers && k % 2 == 0 { pseudo.vector().scale(0.4).0 } else { [0.0; 3] };
            MaterialPoint { element, s, lever }
        })
        .collect();
    material_points.sort_by(|a, b| (a.element, a.s).partial_cmp(&(b.element, b.s)).unwrap());
    let tension = material_points.iter().map(|_| pseudo.vector().scale(0.05)).collect();
    Case { lengths, curvatures, rule: Rule::gauss_legendre(4), material_points, tension }
}

/// Matrices by differences of positions: second differences over 1e-4 err by 1e-8 both from rounding and from the third derivative;
/// with stiffnesses of order one 3e-6 of the largest entry is ample, and a wrong term is off by its whole size.
#[test]
fn the_operator_and_the_direction_are_those_of_the_dense_matrices() {
    let mut worst = (0.0_f64, 0.0_f64);
    for seed in 0..24 {
        let axes: &[usize] = [&[0, 1, 2][..], &[1, 2], &[0, 2], &[1]][seed as usize % 4];
        let case = case(1 + seed as usize % 6, 1 + seed as usize % 5, seed % 3 != 0, 1.0 + 0.1 * seed as f64, seed + 5);
        let mut pseudo = Pseudo(seed + 1000);
        let kinematics = case.kinematics(&case.curvatures);
        let (count, n) = (case.lengths.len(), case.rule.len());
        let mut system = ChainSystem { exact: true, ..ChainSystem::default() };
        system.resize(count, count * n);
        for p in 0..count * n {
            let weight = case.rule.weights[p % n] * case.lengths[p / n];
            system.point_stiffness[p] = weight * (1.0 + 0.5 * pseudo.next());
            system.point_force[p] = pseudo.vector().scale(0.1 * weight);
        }
        for element in 0..count {
            for axis in 0..3 {
                system.curvature_stiffness[element][axis] = case.lengths[element] * (1.0 + 0.9 * pseudo.next());
                system.curvature_force[element][axis] = case.lengths[element] * pseudo.next();
            }
        }
        // Dense: the springs' matrix, and −Σ f·∂²r by second differences.
        let springs = dense::assemble(&kinematics, &system, axes);
        let size = springs.force.len();
        let freedom = |i: usize| i / axes.len() * 3 + axes[i % axes.len()];
        let step = 1e-4;
        let mut matrix = DMatrix::from_fn(size, size, |i, j| springs.matrix[(i, j)]);
        let mut jacobian = DMatrix::zeros(3 * case.material_points.len(), size);
        for i in 0..size {
            let (up, down) = (case.shifted(&[(freedom(i), step)]), case.shifted(&[(freedom(i), -step)]));
            for (k, (a, b)) in up.iter().zip(&down).enumerate() {
                for axis in 0..3 {
                    jacobian[(3 * k + axis, i)] = (a.0[axis] - b.0[axis]) / (2.0 * step);
                }
            }
            for j in 0..size {
                let corner = |a: f64, b: f64| case.shifted(&[(freedom(i), a * step), (freedom(j), b * step)]);
                let (pp, pm, mp, mm) = (corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, 1.0), corner(-1.0, -1.0));
                for (k, f) in case.tension.iter().enumerate() {
                    matrix[(i, j)] -= f.dot(((pp[k] - pm[k]) - (mp[k] - mm[k])).scale(1.0 / (4.0 * step * step)));
                }
            }
        }
        // Every second case has springs at some of its material points, JᵀKJ.
        let springs_at: Vec<Option<Mat3<f64>>> = (0..case.material_points.len())
            .map(|k| {
                let (a, b) = (pseudo.vector(), pseudo.vector().scale(0.5));
                let outer = |i: usize, j: usize| a.0[i] * a.0[j] + b.0[i] * b.0[j];
                (seed % 2 == 1 && k % 3 != 1).then(|| Mat3(std::array::from_fn(|i| std::array::from_fn(|j| outer(i, j)))))
            })
            .collect();
        for (k, spring) in springs_at.iter().enumerate().filter_map(|(k, spring)| Some((k, spring.as_ref()?))) {
            let own = jacobian.rows(3 * k, 3).into_owned();
            matrix += own.transpose() * DMatrix::from_fn(3, 3, |i, j| spring.0[i][j]) * own;
        }
        let factor = matrix.clone().cholesky().expect("a positive definite case");
        let expected = &jacobian * factor.solve(&jacobian.transpose());

        let loads: Vec<_> = case
            .material_points
            .iter()
            .zip(case.tension.iter().zip(&springs_at))
            .map(|(material_point, (f, spring))| {
                let load = Load::at(&kinematics.elements, material_point, *f);
                spring.as_ref().map_or(load, |spring| load.with_stiffness(&kinematics.elements, spring))
            })
            .collect();
        let (mut elimination, mut change) = (Elimination::default(), Vec::new());
        let (mut scratch, mut operator) = (ResponseScratch::default(), Delassus::default());
        assert_eq!(elimination.solve_loaded(&kinematics, &system, &loads, axes, &mut change).repaired, 0.0);
        operator.update(&elimination, &kinematics, 0, &loads, axes);
        let scale = expected.amax();
        let rows = 3 * loads.len();
        assert_eq!((operator.material_points, operator.columns.len()), (loads.len(), rows * rows));
        for (c, column) in operator.columns.chunks(rows).enumerate() {
            for (r, entry) in column.iter().enumerate() {
                let error = (entry - expected[(r, c)]).abs() / scale;
                worst.0 = worst.0.max(error);
                assert!(error < 3e-6, "seed {seed}: row {r} column {c} off by {error:e}");
                assert_eq!(*entry, operator.columns[r * rows + c]);
            }
        }

        let forces: Vec<Vec3<f64>> = loads.iter().map(|_| pseudo.vector()).collect();
        let stacked = DVector::from_iterator(3 * forces.len(), forces.iter().flat_map(|f| f.0));
        let pull = DVector::from_vec(springs.force.clone()) + jacobian.transpose() * &stacked;
        let expected = factor.solve(&pull);
        let mut moved = Vec::new();
        let found = elimination.direction(&kinematics, &loads, &forces, axes, &mut scratch, &mut change, &mut moved);
        let scale = expected.amax();
        for i in 0..size {
            let error = (change[freedom(i) / 3][freedom(i) % 3] - expected[i]).abs() / scale;
            worst.1 = worst.1.max(error);
            assert!(error < 3e-6, "seed {seed}: direction {i} off by {error:e}");
        }
        assert!((found.descent - pull.dot(&expected)).abs() < 1e-5 * pull.dot(&expected));
        let ways = &jacobian * &expected;
        let scale = ways.amax();
        for (k, way) in moved.iter().enumerate() {
            for axis in 0..3 {
                assert!((way.0[axis] - ways[3 * k + axis]).abs() < 1e-5 * scale);
            }
        }
    }
    println!("worst: operator {:e}, direction {:e}", worst.0, worst.1);
}
