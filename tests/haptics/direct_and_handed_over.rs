//! The same stroke felt directly, with the solver at the device's rate, and handed over from steps at a simulation's.
//!
//! A simulation at 120 Hz differs from one at 1 kHz: hair that is struck takes its blow in one step of 8 ms or in one of 1 ms.
//! The effect of that alone is printed beside: the forces of the simulation's own steps, interpolated linearly, which a hand
//! could not feel before the later one is known.

use superhelix::haptic::HapticOptions;

use super::agreement::{Forces, difference, drawn, rms};
use super::scene::{Rate, combed_hair, direct, handed_over_and_simulated, stroke};

/// The difference between a stroke felt directly and handed over, and between that and the simulation's own steps: for the forces
/// in every tick, and for their means over 8 and 25 ms.
struct Off {
    felt: [f64; 3],
    simulated: [f64; 3],
}

/// A stroke this many times slower than 1.4 s.
fn compare(strands: usize, curvature: f64, slower: f64, rate: f64, late: f64) -> Off {
    let options = HapticOptions::default();
    let (way, seconds) = (|t: f64| stroke(t / slower), 1.4 * slower);
    let forces = |felt: super::scene::Felt| -> Forces { felt.into_iter().map(|felt| felt.0.force).collect() };
    let at_once = forces(direct(&mut combed_hair(strands, curvature), way, seconds, &options));
    let (felt, steps) = handed_over_and_simulated(combed_hair(strands, curvature), way, seconds, Rate::new(rate, late), &options);
    let (felt, steps) = (forces(felt), drawn(&steps, at_once.len()));
    let off = |other: &Forces| [1, 8, 25].map(|ticks| difference(&at_once, other, ticks));
    let off = Off { felt: off(&felt), simulated: off(&steps) };
    println!(
        "{strands} strands, {curvature}/m, {slower} times slower, {rate} Hz, {late} s late: {:.2e} N, felt {:.3?}, simulated {:.3?}",
        rms(&at_once),
        off.felt,
        off.simulated
    );
    off
}

#[test]
fn a_stroke_feels_the_same_directly_and_handed_over() {
    for (strands, curvature, slower, late) in [(20, 15.0, 1.0, 0.0), (20, 15.0, 1.0, 4e-3), (20, 40.0, 2.0, 4e-3)] {
        let off = compare(strands, curvature, slower, 120.0, late);
        for (felt, simulated) in off.felt.into_iter().zip(off.simulated) {
            // Not much worse than the rate itself.
            assert!(felt <= 1.4 * simulated, "{felt} {simulated}");
        }
    }
    // And what the rate costs goes as it rises.
    let off = compare(20, 15.0, 1.0, 1000.0, 0.0);
    assert!(off.felt[2] <= 0.05, "{:?}", off.felt);
}

/// A stroke as a hand combs, 14 cm in some seconds, and a simulation whose steps between hand-overs are as fine as the direct one's.
#[test]
fn a_soft_stroke_feels_the_same_within_five_percent() {
    let options = HapticOptions::default();
    let (slower, ticks) = (8.0, 5600.0);
    let way = |t: f64| stroke(t / slower);
    let forces = |felt: super::scene::Felt| -> Forces { felt.into_iter().map(|felt| felt.0.force).collect() };
    let at_once = forces(direct(&mut combed_hair(40, 40.0), way, 1e-3 * ticks, &options));
    let off = |substeps: u32| {
        let rate = Rate { rate: 120.0, substeps, late: 4e-3 };
        let (felt, _) = handed_over_and_simulated(combed_hair(40, 40.0), way, 1e-3 * ticks, rate, &options);
        let felt = forces(felt);
        let off = [1, 8, 25].map(|ticks| difference(&at_once, &felt, ticks));
        println!("{substeps} substeps at 120 Hz: {off:.3?} of {:.1e} N", rms(&at_once));
        off
    };
    let fine = off(8);
    assert!(fine[0] <= 0.05 && fine[1] <= 0.04 && fine[2] <= 0.02, "{fine:?}");
    assert!(off(2)[1] <= 0.05);
}

/// `cargo test --test haptics table -- --ignored --nocapture`: the table of docs/notebook/haptics.md.
#[test]
#[ignore = "a table, two minutes"]
fn table() {
    for slower in [1.0, 4.0] {
        for (rate, late) in [(60.0, 4e-3), (120.0, 0.0), (120.0, 4e-3), (120.0, 8e-3), (240.0, 2e-3), (1000.0, 0.0)] {
            compare(20, 15.0, slower, rate, late);
        }
    }
    compare(60, 15.0, 4.0, 120.0, 4e-3);
    compare(60, 40.0, 4.0, 120.0, 4e-3);
}
