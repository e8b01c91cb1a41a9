//! Where the linearly implicit step holds and where it blows up, and the error of each integrator's tip: three types of hair,
//! three motions, three dissipations, five steps. The table of docs/notebook/integrators.md.
//!
//! "Blown up": a tip faster than 100 m/s, a curvature beyond 1e5 rad/m, or a state that is not finite. The
//! error is the largest distance of the tip, at the tenths of two seconds, from second order at 1/8000 s extrapolated with 1/4000 s.
//!
//! `cargo run --release --example limits -- docs/figures/limits.csv`

use std::fmt::Write as _;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::io::Motion;
use superhelix::{Frame, Integrator, Material, Solver, SolverOptions, StrandDef};

const DURATION: f64 = 2.0;
const LENGTH: f64 = 0.2;
const ELEMENTS: usize = 5;
const RATES: [u32; 5] = [30, 60, 240, 1000, 4000];

#[derive(Clone, Copy)]
enum Move<'a> {
    Sway,
    Walk(&'a Motion),
    Shake,
}

impl Move<'_> {
    /// The head's pose, y up.
    fn at(&self, t: f64) -> Frame {
        let ease = |ramp: f64| 1.0 - (-(ramp * t).powi(2)).exp();
        let wave = |hertz: f64| (2.0 * std::f64::consts::PI * hertz * t).sin();
        match self {
            // A centimetre to each side at ½ Hz.
            Move::Sway => Frame { origin: Vector3::new(0.01 * wave(0.5) * ease(4.0), 0.0, 0.0), ..Frame::default() },
            // Recorded.
            Move::Walk(motion) => motion.at(motion.times()[0] + t),
            // ±46° of yaw and ±8 cm at 2 Hz.
            Move::Shake => Frame {
                origin: Vector3::new(0.0, 0.0, 0.08 * wave(2.0) * ease(4.0)),
                rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.8 * wave(2.0) * ease(4.0)),
            },
        }
    }

    /// The follicle: 9 cm to the side of the head's axis, its strand leaving outwards and a little down; straight down when calm.
    fn root(&self, t: f64) -> Frame {
        let down = if let Move::Sway = self { std::f64::consts::FRAC_PI_2 } else { 0.5 };
        let follicle =
            Frame { origin: Vector3::new(0.09, 0.0, 0.0), rotation: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -down) };
        self.at(t).compose(&follicle)
    }
}

fn strand(hair: &str, dissipation: &str) -> StrandDef {
    let mut def = StrandDef::straight(LENGTH, ELEMENTS);
    let (radius, modulus, natural) = match hair {
        "stiff straight" => (100e-6, 4e9, [0.0; 3]),
        "curly" => (50e-6, 1e9, [10.0, 60.0, 0.0]),
        _ => (35e-6, 0.5e9, [0.0; 3]),
    };
    def.material = Material { radius: [radius; 2], youngs_modulus: modulus, ..Material::default() };
    def.natural = vec![natural; ELEMENTS];
    match dissipation {
        "none" => {}
        "papers'" => (def.material.internal_friction, def.material.air_drag) = (1e-10, 5e-6),
        _ => (def.material.viscosity, def.material.air_drag) = (1e-2, 5e-6),
    }
    def
}

/// The curvatures in which a strand hangs: the result of ten seconds in honey.
fn settled(def: &StrandDef, gravity: Vector3<f64>) -> Vec<[f64; 3]> {
    let mut thick = def.clone();
    (thick.material.viscosity, thick.material.air_drag) = (0.05, 1e-4);
    let mut solver = Solver::new(SolverOptions { gravity, ..SolverOptions::default() }).expect("a solver");
    let id = solver.add_strands(&[thick]).expect("a strand")[0];
    for _ in 0..600 {
        solver.step(1.0 / 60.0, 1).expect("a step");
    }
    solver.curvatures(id).expect("curvatures").to_vec()
}

/// Tips at 10 Hz, m, or the time at which it blew up, s.
fn simulate(def: &StrandDef, movement: Move, integrator: Integrator, rate: u32) -> Result<Vec<Vector3<f64>>, f64> {
    let mut options = SolverOptions { gravity: Vector3::new(0.0, -9.81, 0.0), ..SolverOptions::default() };
    options.step.integrator = integrator;
    options.step.max_iterations = 200;
    let mut solver = Solver::new(options).expect("a solver");
    let mut def = def.clone();
    def.root = movement.root(0.0);
    if let Move::Sway = movement {
        def.initial = Some(settled(&def, solver.options().gravity));
    }
    if let Move::Walk(_) = movement {
        let h = 1e-4;
        def.root_velocity = (movement.root(h).origin - def.root.origin) / h;
        def.root_angular_velocity = (movement.root(h).rotation * def.root.rotation.inverse()).scaled_axis() / h;
    }
    let id = solver.add_strands(std::slice::from_ref(&def)).expect("a strand")[0];
    let h = 1.0 / f64::from(rate);
    let mut tips: Vec<Vector3<f64>> = Vec::new();
    let mut last = Vector3::zeros();
    for step in 1..=(DURATION * f64::from(rate)).round() as u32 {
        let t = h * f64::from(step);
        solver.set_root_frames(&[id], &[movement.root(t)], h).expect("a root");
        let report = solver.step(h, 1).expect("a step");
        let mut tip = Vector3::zeros();
        solver.sample_at(id, &[LENGTH], |_, sample| tip = sample.position).expect("a tip");
        let largest = solver.curvatures(id).expect("curvatures").iter().flatten().fold(0.0_f64, |a, k| a.max(k.abs()));
        if report.quarantined > 0 || largest > 1e5 || (step > 1 && (tip - last).norm() > 100.0 * h) {
            return Err(t);
        }
        last = tip;
        // Every rate has steps at the tenths of a second.
        if step % (rate / 10) == 0 {
            tips.push(tip);
        }
    }
    Ok(tips)
}

fn furthest(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

fn main() {
    let path = std::env::args().nth(1);
    let walk =
        Motion::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/grooms/walk_figure8_head.csv"), None).expect("the walk");
    let mut csv =
        String::from("hair,motion,dissipation,rate,papers_blown_up_s,papers_error_mm,euler_error_mm,second_order_error_mm\n");
    for hair in ["stiff straight", "curly", "limp"] {
        for (motion, movement) in [("sway", Move::Sway), ("walk", Move::Walk(&walk)), ("shake", Move::Shake)] {
            for dissipation in ["none", "papers'", "Kelvin-Voigt"] {
                let def = strand(hair, dissipation);
                let euler: Vec<_> = RATES.iter().map(|rate| simulate(&def, movement, Integrator::ImplicitEuler, *rate)).collect();
                let second: Vec<_> = RATES.iter().map(|rate| simulate(&def, movement, Integrator::SecondOrder, *rate)).collect();
                let coarse = second[4].as_ref().expect("second order at 1/4000 s");
                let fine = simulate(&def, movement, Integrator::SecondOrder, 8000).expect("second order at 1/8000 s");
                let reference: Vec<_> = fine.iter().zip(coarse).map(|(fine, coarse)| fine + (fine - coarse) / 3.0).collect();
                print!("{hair:15} {motion:6} {dissipation:13}");
                for ((rate, euler), second) in RATES.iter().zip(&euler).zip(&second) {
                    let papers = simulate(&def, movement, Integrator::LinearlyImplicit, *rate);
                    let (blown, error) = match &papers {
                        Ok(tips) => (String::new(), format!("{:.3}", 1e3 * furthest(tips, &reference))),
                        Err(t) => (format!("{t:.4}"), String::new()),
                    };
                    let error_of = |tips: &Vec<Vector3<f64>>| format!("{:.3}", 1e3 * furthest(tips, &reference));
                    let euler = euler.as_ref().map_or(String::new(), error_of);
                    let second = second.as_ref().map_or(String::new(), error_of);
                    let said = papers.map_or_else(|t| format!("x {t:.2}s"), |_| format!("{error}mm"));
                    print!(" | 1/{rate}: {said} ({euler}mm; {second}mm)");
                    writeln!(csv, "{hair},{motion},{dissipation},{rate},{blown},{error},{euler},{second}").expect("a string");
                }
                println!();
            }
        }
    }
    if let Some(path) = path {
        std::fs::write(&path, csv).unwrap_or_else(|error| panic!("{path}: {error}"));
        println!("written: {path}");
    }
}
