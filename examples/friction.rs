//! Friction coefficients fitted to the oracle's curves: the table and the figure of docs/theory/friction_fit.md.
//!
//! `cargo run --release --example friction -- docs/figures/friction.csv docs/figures/friction_curve.csv`

use std::fmt::Write as _;

#[path = "../tests/friction_cases/mod.rs"]
mod friction_cases;

use friction_cases::{Case, case, truth};
use superhelix::experiments::Coefficient::{AirDrag, InternalFriction, Viscosity};
use superhelix::experiments::{Coefficient, FrictionFit, FrictionFitOptions, Sought, fit_friction};

fn fit(case: &Case, options: &FrictionFitOptions) -> FrictionFit {
    fit_friction(&case.strand, &case.recording, &case.motion, options).expect("a fit")
}

/// The curve with the given internal friction.
fn curve_with(case: &Case, internal_friction: f64) -> Vec<f64> {
    let held = Sought {
        coefficient: InternalFriction,
        range: [internal_friction, internal_friction * (1.0 + 1e-9)],
        guess: Some(internal_friction),
    };
    fit(case, &FrictionFitOptions { sought: vec![held], grid_points: 0, ..FrictionFitOptions::of(&[]) }).curve
}

fn main() {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    let [table_path, curve_path] = &paths[..] else { panic!("usage: friction TABLE.csv CURVE.csv") };
    let curves: [(&str, &[Coefficient]); 6] = [
        ("curl_shaken", &[InternalFriction]),
        ("curl_shaken_viscous", &[Viscosity]),
        ("pendulum", &[AirDrag]),
        ("curl_swung", &[InternalFriction, AirDrag]),
        ("pendulum", &[InternalFriction]),
        ("straight_shaken", &[InternalFriction]),
    ];
    let mut table = String::from(
        "curve,noise_permille,coefficient,truth,value,standard_error,step_shift,excluded_below,excluded_above,verdict,\
         noise,true_noise,correlation,samples,simulations\n",
    );
    for (name, coefficients) in curves {
        for permille in [0, 5, 20] {
            let file = format!("{name}_{permille:02}.csv");
            if permille == 20 && !matches!(name, "curl_shaken" | "pendulum") {
                continue;
            }
            let case = case(&file);
            let fit = fit(&case, &FrictionFitOptions::of(coefficients));
            for found in &fit.coefficients {
                let _ = writeln!(
                    table,
                    "{name},{permille},{},{:e},{:e},{:e},{:e},{:e},{:e},{:?},{:e},{:e},{:.3},{},{}",
                    found.coefficient.name(),
                    truth(&case, found.coefficient),
                    found.value,
                    found.standard_error,
                    found.step_shift,
                    found.excluded[0],
                    found.excluded[1],
                    found.verdict,
                    fit.noise,
                    case.noise,
                    fit.residual_correlation,
                    fit.curve.len(),
                    fit.simulations,
                );
            }
        }
    }
    std::fs::write(table_path, table).expect("the table");

    let case = case("curl_shaken_20.csv");
    let best = fit(&case, &FrictionFitOptions::of(&[InternalFriction]));
    let value = best.coefficients[0].value;
    let (low, high) = (curve_with(&case, value / 4.0), curve_with(&case, value * 4.0));
    let mut curves = String::from("time,recorded,best,quarter,fourfold\n");
    for (k, time) in case.recording.times.iter().enumerate() {
        let _ = writeln!(curves, "{time},{},{},{},{}", case.recording.values[k], best.curve[k], low[k], high[k]);
    }
    std::fs::write(curve_path, curves).expect("the curves");
}
