//! The same stroke felt directly, with the solver at the device's rate, and handed over from steps at a simulation's.

use nalgebra::Vector3;
use superhelix::haptics::HapticOptions;

use super::scene::{Felt, combed_hair, direct, handed_over, stroke};

fn rms(values: impl Iterator<Item = Vector3<f64>>) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    for value in values {
        sum += value.norm_squared();
        count += 1;
    }
    (sum / f64::from(count.max(1))).sqrt()
}

/// Rms of the difference of two forces' means over `ticks`, over that of the first.
fn difference(one: &Felt, other: &Felt, ticks: usize) -> f64 {
    let means = |felt: &Felt| -> Vec<Vector3<f64>> {
        felt.windows(ticks).map(|felt| felt.iter().map(|felt| felt.0.force).sum::<Vector3<f64>>() / ticks as f64).collect()
    };
    let (one, other) = (means(one), means(other));
    rms(one.iter().zip(&other).map(|(a, b)| a - b)) / rms(one.iter().copied())
}

/// A stroke so many times slower than a second and a half.
fn compare(strands: usize, curvature: f64, slower: f64, rate: f64, late: f64) -> [f64; 3] {
    let options = HapticOptions::default();
    let (way, seconds) = (|t: f64| stroke(t / slower), 1.4 * slower);
    let felt = direct(&mut combed_hair(strands, curvature), way, seconds, &options);
    let other = handed_over(combed_hair(strands, curvature), way, seconds, rate, late, &options);
    let off = [1, 8, 25].map(|ticks| difference(&felt, &other, ticks));
    let force = rms(felt.iter().map(|felt| felt.0.force));
    println!("{strands} strands, {curvature}/m, {slower} times slower, {rate} Hz, {late} s late: {force:.2e} N, off {off:.3?}");
    off
}

#[test]
#[ignore = "a table"]
fn table() {
    for slower in [1.0, 4.0, 8.0] {
        for (rate, late) in [(120.0, 0.0), (120.0, 4e-3), (120.0, 8e-3), (240.0, 2e-3), (1000.0, 0.0)] {
            compare(20, 15.0, slower, rate, late);
        }
    }
    compare(60, 15.0, 4.0, 120.0, 4e-3);
    compare(60, 40.0, 4.0, 120.0, 4e-3);
}
