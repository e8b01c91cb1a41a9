//! The force that a hand feels from each hair type: the same stroke through the same number of strands.

use std::fmt::Write as _;

use nalgebra::Vector3;
use superhelix::hair::{CurlFormula, HairType};
use superhelix::haptic::{ForceLaw, HapticOptions};

use super::scene::{Rate, handed_over};
use super::typed_hair::{SLOWER, hair, stroke_of};

/// The force on the comb against its motion, by type and law, along the stroke.
pub fn table(out: &str, summary: &str) {
    let mut csv = "type,law,seconds,force_uN,along_uN\n".to_string();
    let mut means = "type,stiffness_1e-9Nm2,friction,curvature,mean_uN,peak_uN,explicit_mean_uN\n".to_string();
    for hair_type in HairType::ALL {
        let mut of_law = Vec::new();
        for (law, name) in [(ForceLaw::Contact, "contact"), (ForceLaw::Explicit, "explicit")] {
            let options = HapticOptions { force_law: law, ..HapticOptions::default() };
            let way = |t: f64| stroke_of(t / SLOWER);
            let felt = handed_over(hair(hair_type), way, 1.4 * SLOWER, Rate::new(120.0, 4e-3), &options);
            let (mut sum, mut peak, mut count) = (0.0, 0.0_f64, 0);
            for (tick, window) in felt.windows(25).enumerate() {
                let mean = window.iter().map(|felt| felt.0.force).sum::<Vector3<f64>>() * (1e6 / 25.0);
                peak = peak.max(mean.norm());
                if tick as f64 * 1e-3 > 0.4 * SLOWER {
                    (sum, count) = (sum + mean.z, count + 1);
                }
                if tick % 10 == 0 {
                    let _ =
                        writeln!(csv, "{},{name},{:.3},{:.4},{:.4}", hair_type.name(), 1e-3 * tick as f64, mean.norm(), mean.z);
                }
            }
            of_law.push((sum / f64::from(count), peak));
        }
        let measured = hair_type.measured();
        let material = measured.material();
        let line = format!(
            "{},{:.2},{:.2},{:.0},{:.3},{:.3},{:.4}",
            hair_type.name(),
            1e9 * material.stiffness()[1],
            measured.friction,
            measured.natural(CurlFormula::Exact)[1],
            of_law[0].0,
            of_law[0].1,
            of_law[1].0
        );
        println!("{line}");
        let _ = writeln!(means, "{line}");
    }
    std::fs::write(out, csv).expect("a file");
    std::fs::write(summary, means).expect("a file");
}
