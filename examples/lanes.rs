//! What lanes bring: kinematics of strands side by side.
use std::time::Instant;
use superhelix::math::lane::Lane;
use superhelix::math::pack::Pack;
use superhelix::math::quadrature::Rule;
use superhelix::math::vector::Mat3;
use superhelix::rod::kinematics::Kinematics;

#[inline(never)]
fn run<T: Lane>(n: usize, reps: usize, points: usize) -> f64 {
    let rule = Rule::gauss_legendre(points);
    let lengths = vec![T::splat(0.02); n];
    let curv: Vec<[T; 3]> = (0..n).map(|k| [T::splat(1.0), T::splat(5.0 + k as f64 * 0.1), T::splat(-2.0)]).collect();
    let mut k = Kinematics::default();
    let root = Mat3::identity();
    let mut best = f64::MAX;
    for _ in 0..20 {
        let t = Instant::now();
        for _ in 0..reps {
            k.update(&root, &lengths, &curv, &rule);
            std::hint::black_box(&k);
        }
        best = best.min(t.elapsed().as_secs_f64());
    }
    best / (reps * n) as f64 * 1e9
}

fn main() {
    for points in [3, 4, 6] {
        let one = run::<f64>(5, 2000, points);
        let four = run::<Pack<4>>(5, 2000, points) / 4.0;
        let eight = run::<Pack<8>>(5, 2000, points) / 8.0;
        let sixteen = run::<Pack<16>>(5, 1000, points) / 16.0;
        println!("{points} points: ns an element: 1 lane {one:.0}, 4 {four:.0}, 8 {eight:.0}, 16 {sixteen:.0}");
    }
}
