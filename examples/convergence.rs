//! Tip error of implicit Euler and of the second-order integrator against the step, for the four reference trajectories of
//! tests/data/reference/oracle.json (fixed N, continuous time, by independent software): plain, and extrapolated from each step and its
//! half (Richardson).
//!
//! `cargo run --release --example convergence -- docs/figures/convergence.csv`

use std::fmt::Write as _;

use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use serde_json::Value;
use superhelix::{Frame, Integrator, Material, Solver, SolverOptions, StrandDef};

/// The head motion of the references: yaw about z and sway along y, eased in.
struct Root<'a>(&'a Value);

impl Root<'_> {
    fn at(&self, t: f64) -> Frame {
        let number = |key: &str| self.0[key].as_f64().expect("a number");
        let w = 2.0 * std::f64::consts::PI * number("f");
        let (ct, st) = (number("tilt").cos(), number("tilt").sin());
        let tilted = Matrix3::new(ct, 0.0, st, 0.0, 1.0, 0.0, -st, 0.0, ct);
        let ease = 1.0 - (-(number("ramp") * t).powi(2)).exp();
        let (a, y) = (number("yaw") * (w * t).sin() * ease, number("amp") * (w * t).sin() * ease);
        let turn = Matrix3::new(a.cos(), -a.sin(), 0.0, a.sin(), a.cos(), 0.0, 0.0, 0.0, 1.0);
        let origin = turn * Vector3::new(number("radius"), 0.0, 0.0) + Vector3::new(0.0, y, 0.0);
        Frame { origin, rotation: UnitQuaternion::from_matrix(&(turn * tilted)) }
    }
}

fn triple(v: &Value) -> Vector3<f64> {
    Vector3::from_fn(|i, _| v[i].as_f64().expect("a number"))
}

fn definition(p: &Value) -> StrandDef {
    let number = |key: &str| p.get(key).and_then(Value::as_f64).unwrap_or(0.0);
    let count = p["N"].as_u64().expect("N") as usize;
    let mut def = StrandDef::straight(number("L"), count);
    def.material = Material {
        radius: [number("a1"), number("a2")],
        density: number("rho"),
        youngs_modulus: number("E"),
        poisson_ratio: number("poisson"),
        internal_friction: number("gamma"),
        viscosity: number("mu"),
        air_drag: number("drag"),
    };
    if let Some(natural) = p.get("qn") {
        def.natural = vec![triple(natural).into(); count];
    }
    if let Some(root) = p.get("root") {
        def.root = Root(root).at(0.0);
    }
    def
}

/// Tips at the reference's times (every 1/60 s) with `per_output` steps in between.
fn simulate(case: &Value, integrator: Integrator, per_output: usize) -> Vec<Vector3<f64>> {
    let def = definition(&case["parameters"]);
    let mut options = SolverOptions::default();
    options.step.integrator = integrator;
    let mut solver = Solver::new(options).expect("a solver");
    let id = solver.add_strands(std::slice::from_ref(&def)).expect("a strand")[0];
    let h = 1.0 / 60.0 / per_output as f64;
    let mut tips = Vec::new();
    for output in 0..case["t"].as_array().expect("times").len() {
        for step in 0..per_output {
            if let Some(root) = case["parameters"].get("root") {
                let t = h * (output * per_output + step + 1) as f64;
                solver.set_root_frames(&[id], &[Root(root).at(t)], h).expect("a root");
            }
            let report = solver.step(h, 1).expect("a step");
            assert_eq!((report.unconverged, report.quarantined), (0, 0));
        }
        solver.sample_at(id, &[def.length()], |_, sample| tips.push(sample.position)).expect("a tip");
    }
    tips
}

fn worst<'a>(tips: impl Iterator<Item = Vector3<f64>>, reference: impl Iterator<Item = &'a Value>, length: f64) -> f64 {
    tips.zip(reference).map(|(tip, known)| (tip - triple(known)).norm() / length).fold(0.0, f64::max)
}

fn main() {
    let path = std::env::args().nth(1);
    let all: Value = serde_json::from_str(include_str!("../tests/data/reference/oracle.json")).expect("the references");
    let mut csv = String::from("trajectory,integrator,step,tip_error,extrapolated_error\n");
    for (name, case) in all.as_object().expect("trajectories") {
        let length = case["parameters"]["L"].as_f64().expect("L");
        let known = || case["tip"].as_array().expect("tips").iter();
        // Richardson's weight: 1 / (2^order - 1).
        for (integrator, called, weight) in
            [(Integrator::ImplicitEuler, "implicit_euler", 1.0), (Integrator::SecondOrder, "second_order", 1.0 / 3.0)]
        {
            let mut coarser: Option<Vec<Vector3<f64>>> = None;
            for per_output in [1, 2, 4, 8, 16, 32, 64, 128, 256] {
                let tips = simulate(case, integrator, per_output);
                let error = worst(tips.iter().copied(), known(), length);
                // From this step and the one twice as long; none for the first.
                let extrapolated = coarser
                    .as_ref()
                    .map(|coarse| worst(tips.iter().zip(coarse).map(|(a, b)| a + (a - b) * weight), known(), length));
                let step = 1.0 / 60.0 / per_output as f64;
                let said = extrapolated.map_or(String::new(), |e| format!("{e:.6e}"));
                println!("{name:20} {called:15} h = 1/{:<6} tip error {error:.3e} L, extrapolated {said} L", 60 * per_output);
                writeln!(csv, "{name},{called},{step:.9e},{error:.6e},{said}").expect("a string");
                coarser = Some(tips);
            }
        }
    }
    if let Some(path) = path {
        std::fs::write(&path, csv).unwrap_or_else(|error| panic!("{path}: {error}"));
        println!("written: {path}");
    }
}
