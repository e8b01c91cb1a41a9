//! What lanes bring: kinematics and elimination of strands side by side.
use std::time::Instant;
use superhelix::chain::elimination::Elimination;
use superhelix::chain::system::ChainSystem;
use superhelix::math::lane::Lane;
use superhelix::math::avx512::{V4, V8};
use superhelix::math::quadrature::Rule;
use superhelix::math::vector::{Mat3, Vec3};
use superhelix::rod::kinematics::Kinematics;

#[inline(never)]
fn run<T: Lane>(n: usize, reps: usize, points: usize) -> [f64; 2] {
    let rule = Rule::gauss_legendre(points);
    let lengths = vec![T::splat(0.02); n];
    let curv: Vec<[T; 3]> = (0..n).map(|k| [T::splat(1.0), T::splat(5.0 + k as f64 * 0.1), T::splat(-2.0)]).collect();
    let mut k = Kinematics::default();
    let root = Mat3::identity();
    let mut best = [f64::MAX; 2];
    let mut system = ChainSystem::<T>::default();
    system.resize(n, n * points);
    for s in &mut system.point_stiffness { *s = T::splat(3.0); }
    for f in &mut system.point_force { *f = Vec3([T::splat(0.01), T::splat(-0.02), T::splat(0.003)]); }
    for c in &mut system.curvature_stiffness { *c = [T::splat(1e-2); 3]; }
    let mut elimination = Elimination::default();
    let mut change = Vec::new();
    for _ in 0..20 {
        let t = Instant::now();
        for _ in 0..reps {
            k.update(&root, &lengths, &curv, &rule);
            std::hint::black_box(&k);
        }
        best[0] = best[0].min(t.elapsed().as_secs_f64());
        let t = Instant::now();
        for _ in 0..reps {
            std::hint::black_box(elimination.solve(&k, &system, &[0, 1, 2], &mut change));
        }
        best[1] = best[1].min(t.elapsed().as_secs_f64());
    }
    best.map(|b| b / (reps * n * T::LANES) as f64 * 1e9)
}

fn main() {
    for points in [3, 4, 6] {
        println!("{points} points, ns an element [kinematics, elimination]: 1 lane {:.0?}, 4 {:.0?}, 8 {:.0?}", run::<f64>(5, 2000, points), run::<V4>(5, 1000, points), run::<V8>(5, 1000, points));
    }
}
