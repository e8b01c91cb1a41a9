//! The same stroke felt directly, at 1 kHz, and handed over from a slower simulation: the difference between the two.

use std::fmt::Write as _;

use nalgebra::Vector3;
use superhelix::haptic::HapticOptions;
use superhelix::{BodyId, Frame, Solver};

use super::agreement::{Forces, difference, drawn, rms};
use super::groom;
use super::scene::{Felt, Rate, combed_hair, direct, handed_over_and_simulated, stroke};

/// Rates, substeps and the delay of the hand-over, s. The first is the direct stroke's own rate with finer steps: its own error.
const RATES: [(f64, u32, f64); 6] =
    [(1000.0, 4, 0.0), (60.0, 1, 4e-3), (120.0, 1, 4e-3), (120.0, 2, 4e-3), (120.0, 8, 4e-3), (240.0, 1, 2e-3)];

fn forces(felt: Felt) -> Forces {
    felt.into_iter().map(|felt| felt.0.force).collect()
}

/// A scene and a stroke through it.
struct Case<'a> {
    name: &'a str,
    seconds: f64,
    scene: &'a dyn Fn() -> (Solver, Vec<BodyId>),
    way: &'a dyn Fn(f64) -> Frame,
}

impl Case<'_> {
    fn directly(&self) -> Forces {
        forces(direct(&mut (self.scene)(), self.way, self.seconds, &HapticOptions::default()))
    }

    fn handed_over(&self, rate: Rate) -> (Forces, Vec<(f64, Vector3<f64>)>) {
        let (felt, steps) = handed_over_and_simulated((self.scene)(), self.way, self.seconds, rate, &HapticOptions::default());
        (forces(felt), steps)
    }

    fn lines(&self, csv: &mut String) {
        let at_once = self.directly();
        let size = 1e6 * rms(&at_once);
        for (rate, substeps, late) in RATES {
            let (felt, steps) = self.handed_over(Rate { rate, substeps, late });
            let steps = drawn(&steps, at_once.len());
            let off = |other: &Forces| [1, 8, 25].map(|ticks| format!("{:.4}", difference(&at_once, other, ticks))).join(",");
            let Self { name, seconds, .. } = self;
            let (felt, simulated) = (off(&felt), off(&steps));
            let line = format!("\"{name}\",{seconds:.1},{size:.1},{rate},{substeps},{:.0},{felt},{simulated}", 1e3 * late);
            println!("{line}");
            let _ = writeln!(csv, "{line}");
        }
    }
}

/// Forty curly hairs, combed within 3, 6 and 11 s, and wisps of a groom with the comb among their roots.
pub fn table(out: &str, curves: &str) {
    let mut csv =
        "hair,seconds,rms_uN,rate_hz,substeps,late_ms,felt_1ms,felt_8ms,felt_25ms,simulated_1ms,simulated_8ms,simulated_25ms\n"
            .to_string();
    let curly = || combed_hair(40, 40.0);
    for slower in [2.0, 4.0, 8.0] {
        let way = move |t: f64| stroke(t / slower);
        let case = Case { name: "40 hairs of 40/m", seconds: 1.4 * slower, scene: &curly, way: &way };
        case.lines(&mut csv);
        if slower == 4.0 {
            case.curves(curves);
        }
    }
    let wisps = || groom::combed(4, 4, 1);
    let way = |t: f64| groom::stroke(t / 2.0);
    Case { name: "250 wisps", seconds: 5.8, scene: &wisps, way: &way }.lines(&mut csv);
    std::fs::write(out, csv).expect("a file");
}

impl Case<'_> {
    /// Writes the forces themselves, µN along the stroke.
    fn curves(&self, out: &str) {
        let at_once = self.directly();
        let (once, _) = self.handed_over(Rate::new(120.0, 4e-3));
        let (finely, _) = self.handed_over(Rate { rate: 120.0, substeps: 8, late: 4e-3 });
        let mut csv = "seconds,direct,handed_over,handed_over_8\n".to_string();
        for tick in (0..at_once.len()).step_by(4) {
            let size = |forces: &Forces| 1e6 * forces[tick].norm();
            let _ = writeln!(csv, "{:.3},{:.3},{:.3},{:.3}", tick as f64 * 1e-3, size(&at_once), size(&once), size(&finely));
        }
        std::fs::write(out, csv).expect("a file");
    }
}
