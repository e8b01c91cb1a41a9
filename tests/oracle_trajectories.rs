//! Trajectories of the discrete Super-Helix (fixed N, continuous time) by an independent oracle: implicit Euler approaches every one of
//! them at first order.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use serde_json::Value;
use superhelix::math::frame::Frame;
use superhelix::rod::material::Material;
use superhelix::solver::Solver;
use superhelix::solver::definition::{SolverOptions, StrandDef};
use superhelix::step::options::Integrator;

struct Case {
    def: StrandDef,
    root: Option<YawRoot>,
    times: Vec<f64>,
    tips: Vec<Vector3<f64>>,
}

/// The head motion of the references: yaw about z and sway along y, eased in.
#[derive(Clone, Copy)]
struct YawRoot {
    radius: f64,
    tilt: f64,
    amp: f64,
    yaw: f64,
    f: f64,
    ramp: f64,
}

impl YawRoot {
    fn at(&self, t: f64) -> Frame {
        let w = 2.0 * std::f64::consts::PI * self.f;
        let (ct, st) = (self.tilt.cos(), self.tilt.sin());
        let tilted = Matrix3::new(ct, 0.0, st, 0.0, 1.0, 0.0, -st, 0.0, ct);
        let ease = 1.0 - (-(self.ramp * t).powi(2)).exp();
        let (a, y) = (self.yaw * (w * t).sin() * ease, self.amp * (w * t).sin() * ease);
        let turn = Matrix3::new(a.cos(), -a.sin(), 0.0, a.sin(), a.cos(), 0.0, 0.0, 0.0, 1.0);
        let origin = turn * Vector3::new(self.radius, 0.0, 0.0) + Vector3::new(0.0, y, 0.0);
        Frame { origin, rotation: UnitQuaternion::from_matrix(&(turn * tilted)) }
    }
}

fn cases() -> Vec<(String, Case)> {
    let text = include_str!("data/reference/oracle.json");
    let all: Value = serde_json::from_str(text).unwrap();
    let number = |p: &Value, key: &str| p.get(key).and_then(Value::as_f64).unwrap_or(0.0);
    let triple = |v: &Value| Vector3::new(v[0].as_f64().unwrap(), v[1].as_f64().unwrap(), v[2].as_f64().unwrap());
    all.as_object()
        .unwrap()
        .iter()
        .map(|(name, case)| {
            let p = &case["parameters"];
            let count = p["N"].as_u64().unwrap() as usize;
            let mut def = StrandDef::straight(number(p, "L"), count);
            def.material = Material {
                radius: [number(p, "a1"), number(p, "a2")],
                density: number(p, "rho"),
                youngs_modulus: number(p, "E"),
                poisson_ratio: number(p, "poisson"),
                internal_friction: number(p, "gamma"),
                viscosity: number(p, "mu"),
                air_drag: number(p, "drag"),
            };
            if let Some(natural) = p.get("qn") {
                def.natural = vec![triple(natural).into(); count];
            }
            let root = p.get("root").map(|r| YawRoot {
                radius: number(r, "radius"),
                tilt: number(r, "tilt"),
                amp: number(r, "amp"),
                yaw: number(r, "yaw"),
                f: number(r, "f"),
                ramp: number(r, "ramp"),
            });
            if let Some(root) = root {
                def.root = root.at(0.0);
            }
            let times = case["t"].as_array().unwrap().iter().map(|t| t.as_f64().unwrap()).collect();
            let tips = case["tip"].as_array().unwrap().iter().map(triple).collect();
            (name.clone(), Case { def, root, times, tips })
        })
        .collect()
}

/// Tips at the reference's times (each 1/60 s) with `per_output` steps between two of them.
fn simulate(case: &Case, integrator: Integrator, per_output: u32) -> Vec<Vector3<f64>> {
    let mut options = SolverOptions::default();
    options.step.integrator = integrator;
    let mut solver = Solver::new(options).unwrap();
    let id = solver.add_strands(std::slice::from_ref(&case.def)).unwrap()[0];
    let h = 1.0 / 60.0 / f64::from(per_output);
    let mut tips = Vec::new();
    for output in 0..case.times.len() {
        for step in 0..per_output {
            if let Some(root) = case.root {
                let t = h * f64::from(output as u32 * per_output + step + 1);
                solver.set_root_frames(&[id], &[root.at(t)], h).unwrap();
            }
            let report = solver.step(h, 1).unwrap();
            assert_eq!((report.unconverged, report.quarantined), (0, 0));
        }
        solver.sample_at(id, &[case.def.length()], |_, sample| tips.push(sample.position)).unwrap();
    }
    tips
}

fn worst(tips: &[Vector3<f64>], reference: &[Vector3<f64>], length: f64) -> f64 {
    tips.iter().zip(reference).map(|(a, b)| (a - b).norm() / length).fold(0.0, f64::max)
}

#[test]
fn implicit_euler_converges_to_every_reference_trajectory() {
    // Halving the step halves the error; the two smallest steps extrapolated agree to 1e-4 of the length at every output time. The
    // whipping head needs smaller steps for that than the others.
    for (name, case) in cases() {
        let length = case.def.length();
        let finest = if name == "head_yaw_n2" { 512 } else { 128 };
        let tips: Vec<_> =
            [finest / 4, finest / 2, finest].map(|per_output| simulate(&case, Integrator::ImplicitEuler, per_output)).into();
        let errors: Vec<f64> = tips.iter().map(|tips| worst(tips, &case.tips, length)).collect();
        let extrapolated: Vec<Vector3<f64>> = tips[1].iter().zip(&tips[2]).map(|(a, b)| b * 2.0 - a).collect();
        let error = worst(&extrapolated, &case.tips, length);
        println!("{name}: {errors:?} L at {finest}/4, /2, /1 steps a 60th of a second; extrapolated {error:e} L");
        for pair in errors.windows(2) {
            assert!((1.85..2.15).contains(&(pair[0] / pair[1])), "{name}: {errors:?}");
        }
        assert!(error < 1e-4, "{name}: {error:e}");
    }
}

#[test]
fn the_second_order_method_converges_at_second_order() {
    // Halving the step quarters the error, once the step sees the motion. The root's path between two frames is the cubic of
    // `PoseMove`, which is smooth but knows no curvature: it is exact to second order in the step as well.
    for (name, case) in cases() {
        let length = case.def.length();
        let errors: Vec<f64> = [4, 8, 16, 32]
            .map(|per_output| worst(&simulate(&case, Integrator::SecondOrder, per_output), &case.tips, length))
            .into();
        println!("{name}: {errors:?} L at 4, 8, 16, 32 steps a 60th of a second");
        for pair in errors.windows(2) {
            assert!((3.4..4.6).contains(&(pair[0] / pair[1])), "{name}: {errors:?}");
        }
        assert!(errors[3] < 3e-4, "{name}: {errors:?}");
    }
}
