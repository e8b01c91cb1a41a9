//! The same stroke felt directly, at 1 kHz, and handed over from a slower simulation: what is left between the two.

use std::fmt::Write as _;

use nalgebra::Vector3;
use superhelix::haptics::HapticOptions;

use super::agreement::{Forces, difference, drawn, rms};
use super::groom;
use super::scene::{Felt, Rate, combed_hair, direct, handed_over_and_simulated, stroke};

fn forces(felt: Felt) -> Forces {
    felt.into_iter().map(|felt| felt.0.force).collect()
}

/// Wisps of a groom, every so manieth guide, combed so many times more slowly.
pub fn table(out: &str, every: usize, slownesses: &[f64]) {
    let options = HapticOptions::default();
    let mut csv =
        "slower,rms_mN,rate_hz,substeps,late_ms,felt_1ms,felt_8ms,felt_25ms,simulated_1ms,simulated_8ms,simulated_25ms\n"
            .to_string();
    for slower in slownesses {
        let way = |t: f64| groom::stroke(t / slower);
        let seconds = 2.9 * slower;
        let at_once = forces(direct(&mut groom::combed(every, 4, 1), way, seconds, &options));
        let size = rms(&at_once);
        for (rate, substeps, late) in [
            (60.0, 1, 4e-3),
            (120.0, 1, 0.0),
            (120.0, 1, 4e-3),
            (120.0, 2, 4e-3),
            (120.0, 4, 4e-3),
            (120.0, 8, 4e-3),
            (240.0, 1, 2e-3),
        ] {
            let scene = groom::combed(every, 4, 1);
            let (felt, steps) = handed_over_and_simulated(scene, way, seconds, Rate { rate, substeps, late }, &options);
            let (felt, steps) = (forces(felt), drawn(&steps, at_once.len()));
            let off = |other: &Forces| [1, 8, 25].map(|ticks| difference(&at_once, other, ticks));
            let (felt, simulated) = (off(&felt), off(&steps));
            let line = format!(
                "{slower},{:.3},{rate},{substeps},{:.0},{:.4},{:.4},{:.4},{:.4},{:.4},{:.4}",
                1e3 * size,
                1e3 * late,
                felt[0],
                felt[1],
                felt[2],
                simulated[0],
                simulated[1],
                simulated[2]
            );
            println!("{line}");
            let _ = writeln!(csv, "{line}");
        }
    }
    std::fs::write(out, csv).expect("a file");
}

/// Writes the forces themselves, mN along the stroke: directly and handed over.
pub fn curves(out: &str, every: usize, slower: f64) {
    let options = HapticOptions::default();
    let way = |t: f64| groom::stroke(t / slower);
    let seconds = 2.9 * slower;
    let at_once = forces(direct(&mut groom::combed(every, 4, 1), way, seconds, &options));
    let (felt, _) = handed_over_and_simulated(
        groom::combed(every, 4, 1),
        way,
        seconds,
        Rate { rate: 120.0, substeps: 1, late: 4e-3 },
        &options,
    );
    let felt = forces(felt);
    let mut csv = "seconds,direct_x,direct_y,direct_z,handed_over_x,handed_over_y,handed_over_z\n".to_string();
    for (tick, (a, b)) in at_once.iter().zip(&felt).enumerate() {
        let [a, b]: [Vector3<f64>; 2] = [1e3 * a, 1e3 * b];
        let _ = writeln!(csv, "{:.3},{:.5},{:.5},{:.5},{:.5},{:.5},{:.5}", tick as f64 * 1e-3, a.x, a.y, a.z, b.x, b.y, b.z);
    }
    std::fs::write(out, csv).expect("a file");
}

/// Single hairs of some curvature (1/m), combed so many times more slowly than the scene's stroke.
pub fn single_hairs(strands: usize, curvature: f64, slower: f64) {
    let options = HapticOptions::default();
    let way = |t: f64| stroke(t / slower);
    let seconds = 1.4 * slower;
    let at_once = forces(direct(&mut combed_hair(strands, curvature), way, seconds, &options));
    println!("{strands} of {curvature}/m, {seconds} s: {:.1} uN", 1e6 * rms(&at_once));
    for (rate, substeps, late) in [(1000.0, 4, 0.0), (120.0, 1, 4e-3), (120.0, 2, 4e-3), (120.0, 8, 4e-3), (240.0, 1, 2e-3)] {
        let scene = combed_hair(strands, curvature);
        let (felt, steps) = handed_over_and_simulated(scene, way, seconds, Rate { rate, substeps, late }, &options);
        let (felt, steps) = (forces(felt), drawn(&steps, at_once.len()));
        let off = |other: &Forces| [1, 8, 25].map(|ticks| difference(&at_once, other, ticks));
        println!("  {rate} Hz, {substeps} substeps: felt {:.3?}, simulated {:.3?}", off(&felt), off(&steps));
    }
}
