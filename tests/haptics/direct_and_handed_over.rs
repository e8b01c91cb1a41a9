//! The same stroke felt directly, with the solver at the device's rate, and handed over from steps at 120 Hz.

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

/// Rms of the difference of two forces over that of the first.
fn difference(one: &Felt, other: &Felt) -> f64 {
    let apart = one.iter().zip(other).map(|(a, b)| a.0.force - b.0.force);
    rms(apart) / rms(one.iter().map(|felt| felt.0.force))
}

/// The same of the means over `ticks`.
fn difference_of_means(one: &Felt, other: &Felt, ticks: usize) -> f64 {
    let mean = |felt: &[(superhelix::solver::report::Wrench, superhelix::haptics::HapticState)]| {
        felt.iter().map(|felt| felt.0.force).sum::<Vector3<f64>>() / ticks as f64
    };
    let (one, other): (Vec<_>, Vec<_>) = one.windows(ticks).zip(other.windows(ticks)).map(|(a, b)| (mean(a), mean(b))).unzip();
    rms(one.iter().zip(&other).map(|(a, b)| a - b)) / rms(one.iter().copied())
}

#[test]
fn a_stroke_feels_the_same_directly_and_handed_over() {
    let options = HapticOptions::default();
    for (strands, curvature) in [(20, 0.0), (20, 15.0), (60, 15.0)] {
        let felt = direct(&mut combed_hair(strands, curvature), stroke, 1.4, &options);
        let force = rms(felt.iter().map(|felt| felt.0.force));
        for (rate, late) in [(120.0, 0.0), (120.0, 4e-3), (120.0, 8e-3), (240.0, 0.0), (500.0, 0.0), (1000.0, 0.0)] {
            let other = handed_over(combed_hair(strands, curvature), stroke, 1.4, rate, late, &options);
            let off = difference(&felt, &other);
            if late == 0.0 {
                let mut text = String::new();
                for (k, (a, b)) in felt.iter().zip(&other).enumerate() {
                    use std::fmt::Write;
                    let (x, y, c) = (a.0.force, b.0.force, b.1.contact.force);
                    writeln!(
                        text,
                        "{k},{:e},{:e},{:e},{:e},{:e},{:e},{},{},{},{},{:e},{:e},{}",
                        x.x, x.y, x.z, y.x, y.y, y.z, b.1.touches, b.1.pressing, b.1.sweeps, b.1.models, c.x, c.z, b.1.change
                    )
                    .unwrap();
                }
                std::fs::write(format!("/tmp/h29_{strands}_{curvature}_{rate}.csv"), text).unwrap();
            }
            let means = [8, 25, 50].map(|ticks| 100.0 * difference_of_means(&felt, &other, ticks));
            println!(
                "{strands} strands, {curvature}/m: {force:.2e} N, {rate} Hz, {late} s late: {:.1} %, means {means:.1?}",
                100.0 * off
            );
        }
    }
}
