//! What a hand feels of each kind of hair: the same stroke through the same many strands of it.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::contact::body::BodyDef;
use superhelix::contact::options::StrandContact;
use superhelix::contact::shape::Shape;
use superhelix::groom::hair_parameters::CurlFormula;
use superhelix::groom::hair_type::HairType;
use superhelix::haptics::{ForceLaw, HapticOptions};
use superhelix::math::frame::Frame;
use superhelix::rod::material::Material;
use superhelix::solver::Solver;
use superhelix::solver::definition::{SolverOptions, StrandDef};
use superhelix::solver::id::BodyId;

use super::scene::{Rate, handed_over, stroke};

const STRANDS: usize = 40;
const LENGTH: f64 = 0.15;
/// Times more slowly than the tests' stroke: down by 14 cm in 3 s.
const SLOWER: f64 = 3.0;

/// The tests' stroke, begun nearer to the roots: curls hang no further down.
fn stroke_of(t: f64) -> Frame {
    let tests = stroke(t);
    Frame { origin: tests.origin + Vector3::z() * 0.016, ..tests }
}

/// Hair of a type that hangs from rows of follicles, at rest, and the comb.
fn hair(hair_type: HairType) -> (Solver, Vec<BodyId>) {
    let measured = hair_type.measured();
    let parameters = measured.parameters(CurlFormula::Exact).expect("a type");
    let bend = parameters.natural.iter().map(|k| k * k).sum::<f64>().sqrt() * LENGTH;
    // Four elements a turn.
    let elements = ((bend / (0.5 * PI)).ceil() as usize).max(5);
    let mut solver = Solver::new(SolverOptions::default()).expect("a solver");
    let defs: Vec<StrandDef> = (0..STRANDS)
        .map(|k| {
            let mut def = StrandDef::straight(LENGTH, elements);
            def.natural = vec![parameters.natural; elements];
            // What else damps hair, for all types alike.
            def.material = Material { viscosity: 2e-3, ..parameters.material };
            let origin = Vector3::new(4e-3 * (k / 20) as f64, 2e-3 * (k % 20) as f64, 0.0);
            let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5 * PI);
            let about = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.7 * k as f64);
            def.root = Frame { origin, rotation: down * about };
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).expect("strands");
    solver.set_contact(&ids, Some(&StrandContact { exempt_length: 5e-3, ..parameters.contact() })).expect("contact");
    let tooth = |k: usize| {
        let end = |x: f64| Vector3::new(x, 6e-3 * (k as f64 - 3.0), 0.0);
        let shape = Shape::new_capsule(end(-0.03), end(0.05), 1e-3).expect("a tooth");
        BodyDef { pose: stroke_of(0.0), ..BodyDef::new(Arc::new(shape)) }
    };
    let teeth = solver.add_bodies((0..7).map(tooth).collect()).expect("teeth");
    for _ in 0..240 {
        solver.step(1.0 / 60.0, 1).expect("a step");
    }
    (solver, teeth)
}

/// The force that holds the comb back, by type and law, along the stroke.
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
