//! The kernels one by one, and the step that they make, with criterion's statistics: for the effect of a change of one of them.
//! Comparisons are in `benches/performance`.
//!
//! A separate package, so that nothing else in the project has to compile criterion:
//! `cargo bench --manifest-path benches/kernels/Cargo.toml -- [FILTER]`

use std::hint::black_box;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use nalgebra::Vector3;
use superhelix::{InstructionSet, Precision, Solver, SolverOptions, StrandDef};
use superhelix::internals::chain::elimination::Elimination;
use superhelix::internals::chain::system::{ChainSystem, LinearSolve};
use superhelix::internals::math::functions::entire::Stumpff;
use superhelix::internals::math::lane::Lane;
use superhelix::internals::math::quadrature::Rules;
use superhelix::internals::math::vector::{Mat3, Vec3};
use superhelix::internals::rod::kinematics::Kinematics;

/// Elements of the strands.
const COUNT: usize = 10;
/// Metres.
const LENGTH: f64 = 0.2;

/// The curvatures of a strand.
fn curvatures<T: Lane>() -> Vec<[T; 3]> {
    (0..COUNT).map(|element| [1.0, 4.0 + 0.1 * element as f64, 0.5].map(T::splat)).collect()
}

fn entire<T: Lane>(c: &mut Criterion, name: &str) {
    let mut group = c.benchmark_group("entire functions");
    // By series, and by sine and cosine.
    for z in [0.5, 40.0] {
        group.bench_function(BenchmarkId::new(name, z), |b| b.iter(|| Stumpff::at(black_box(T::splat(z)))));
    }
}

/// A strand's kinematics, and a system with a force and a stiffness at every point.
fn strand<T: Lane>(rules: &Rules) -> (Kinematics<T>, ChainSystem<T>) {
    let rule = rules.rule(rules.for_angle(0.5));
    let mut kinematics = Kinematics::default();
    let one = |i: usize, j: usize| T::splat(if i == j { 1.0 } else { 0.0 });
    let root = Mat3(std::array::from_fn(|i| std::array::from_fn(|j| one(i, j))));
    kinematics.update(&root, &[T::splat(LENGTH / COUNT as f64); COUNT], &curvatures(), rule);
    let mut system = ChainSystem::default();
    let points = kinematics.points.len();
    system.resize(COUNT, points);
    system.exact = true;
    for p in 0..points {
        system.point_stiffness[p] = T::splat(1e-3);
        system.point_force[p] = Vec3([1e-7, -2e-7, 1e-7].map(T::splat));
    }
    for element in 0..COUNT {
        system.curvature_stiffness[element] = [1e-10; 3].map(T::splat);
        system.curvature_force[element] = [1e-11, 2e-11, -1e-11].map(T::splat);
    }
    (kinematics, system)
}

fn kernels<T: Lane>(c: &mut Criterion, name: &str) {
    let rules = Rules::default();
    let (kinematics, mut system) = strand::<T>(&rules);
    let mut group = c.benchmark_group("an element, alone");
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function(BenchmarkId::new("kinematics", name), |b| {
        let rule = rules.rule(rules.for_angle(0.5));
        let (rows, lengths) = (curvatures::<T>(), [T::splat(LENGTH / COUNT as f64); COUNT]);
        let root = kinematics.elements[0].frame_left;
        let mut scratch = kinematics.clone();
        b.iter(|| scratch.update(black_box(&root), black_box(&lengths), black_box(&rows), rule));
    });
    let (mut elimination, mut change) = (Elimination::default(), Vec::new());
    let kinds: [(&str, &[usize]); 3] = [("three freedoms", &[0, 1, 2]), ("two freedoms", &[1, 2]), ("one freedom", &[1])];
    for (kind, axes) in kinds {
        for exact in [true, false] {
            system.exact = exact;
            let hessian = if exact { "exact" } else { "Gauss-Newton" };
            group.bench_function(BenchmarkId::new(format!("elimination, {kind}, {hessian}"), name), |b| {
                b.iter(|| elimination.solve(black_box(&kinematics), black_box(&system), black_box(axes), &mut change));
            });
        }
    }
}

/// A solver with strands that hang and swing.
fn solver(set: InstructionSet, precision: Precision) -> Solver {
    let mut options = SolverOptions { instruction_set: Some(set), ..SolverOptions::default() };
    options.step.precision = precision;
    // The same work in every sample.
    (options.step.max_iterations, options.step.max_subdivisions, options.step.tolerance) = (2, 0, f64::MIN_POSITIVE);
    let mut solver = Solver::new(options).expect("a solver");
    let strands: Vec<_> = (0..32)
        .map(|index| {
            let mut def = StrandDef::straight(LENGTH, COUNT);
            def.root_velocity = Vector3::new(0.01, 0.0, 0.0);
            def.natural = vec![[1.0, 4.0 + 0.05 * f64::from(index), 0.0]; COUNT];
            def
        })
        .collect();
    solver.add_strands(&strands).expect("strands");
    solver
}

fn steps(c: &mut Criterion) {
    let mut group = c.benchmark_group("a step of two iterations, 32 strands");
    group.throughput(Throughput::Elements(32 * COUNT as u64));
    let sets = [InstructionSet::Scalar, InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512];
    for set in sets.into_iter().filter(|set| *set <= InstructionSet::detected()) {
        for precision in [Precision::F64, Precision::F32] {
            let mut solver = solver(set, precision);
            group.bench_function(BenchmarkId::new(set.name(), format!("{precision:?}")), |b| {
                b.iter(|| solver.step(1.0 / 60.0, 1).expect("a step"));
            });
        }
    }
}

fn cold(c: &mut Criterion) {
    c.bench_function("a solver made and dropped", |b| {
        b.iter_batched(SolverOptions::default, |options| Solver::new(options).expect("a solver"), BatchSize::SmallInput);
    });
}

fn all(c: &mut Criterion) {
    entire::<f64>(c, "f64");
    entire::<f32>(c, "f32");
    kernels::<f64>(c, "f64");
    kernels::<f32>(c, "f32");
    steps(c);
    cold(c);
}

criterion_group!(benches, all);
criterion_main!(benches);
