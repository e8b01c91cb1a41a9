//! Wisps against the theory of bundles and beams.

use nalgebra::Vector3;
use superhelix::{Material, Solver, SolverOptions, StepOptions, StrandDef, Wisp};

fn hair() -> Material {
    Material { radius: [60e-6, 45e-6], internal_friction: 1e-10, air_drag: 5e-6, viscosity: 0.01, ..Material::default() }
}

/// n (1 + h) EI, between n EI (fibres that slide) and n² EI (bonded); n times the weight.
#[test]
fn stiffness_goes_from_that_of_sliding_to_that_of_bonded_fibres() {
    let hair = hair();
    for (hold, power) in [(0.0, 1.0), (0.5, 1.5), (1.0, 2.0)] {
        let n: f64 = 150.0;
        let wisp = Wisp { hairs: n, hold }.material(&hair).unwrap();
        for (one, all) in hair.stiffness().iter().zip(wisp.stiffness()) {
            assert!((all / (one * n.powf(power)) - 1.0).abs() < 1e-12, "hold {hold}: {all} {one}");
        }
        // What holds the hairs together rubs, too: 0.1 h s of their stiffness.
        let calmer = Material { viscosity: hair.viscosity + 0.1 * hold, ..hair };
        for (one, all) in calmer.dissipation().iter().zip(wisp.dissipation()) {
            assert!((all / (one * n.powf(power)) - 1.0).abs() < 1e-12);
        }
        assert!((wisp.linear_density() / (n * hair.linear_density()) - 1.0).abs() < 1e-12);
        assert!((wisp.air_drag / (n * hair.air_drag) - 1.0).abs() < 1e-12);
    }
    assert_eq!(Wisp::bare().material(&hair).unwrap(), hair);
    for (wisp, named) in [(Wisp { hairs: 0.5, hold: 0.5 }, "wisp.hairs"), (Wisp { hairs: 10.0, hold: f64::NAN }, "wisp.hold")] {
        assert!(wisp.material(&hair).unwrap_err().to_string().contains(named));
    }
    let heavy = Material { density: -1.0, ..hair };
    assert!(Wisp::default().material(&heavy).unwrap_err().to_string().contains("hair.density"));
}

/// Where a strand of 5 cm that is let go from the horizontal has its tip after 0.3 s, and at rest.
fn tip(material: Material, steps: u32) -> Vector3<f64> {
    let step = StepOptions { tolerance: 1e-10, ..StepOptions::default() };
    let mut solver = Solver::new(SolverOptions { step, ..SolverOptions::default() }).unwrap();
    let def = StrandDef { material, ..StrandDef::straight(0.05, 6) };
    let id = solver.add_strands(&[def]).unwrap()[0];
    solver.step(f64::from(steps) / 120.0, steps).unwrap();
    let mut tip = Vector3::zeros();
    solver
        .sample_strands(&[id], 2, |_, point, sample| {
            if point == 1 {
                tip = sample.position
            }
        })
        .unwrap();
    tip
}

/// Hairs that slide freely past each other move together as one of them does.
#[test]
fn a_wisp_without_hold_moves_as_its_hairs_do() {
    let hair = hair();
    let loose = Wisp { hairs: 300.0, hold: 0.0 }.material(&hair).unwrap();
    let (one, all) = (tip(hair, 36), tip(loose, 36));
    assert!((one - all).norm() < 1e-8, "{one} {all}");
}

/// A cantilever under its weight w sags by w L⁴/(8 EI): by n^h times less than its hairs.
#[test]
fn a_wisp_sags_less_by_the_power_of_its_hold() {
    let stiff = Material { youngs_modulus: 2e11, viscosity: 0.1, radius: [50e-6; 2], ..hair() };
    let sag = |material: Material| {
        let end = tip(material, 360);
        // Across the strand's own axis, which leaves the root.
        let along = StrandDef::straight(0.05, 6).root.rotation * Vector3::x();
        (end - along * along.dot(&end)).norm()
    };
    let by_theory = stiff.linear_density() * 9.81 * 0.05_f64.powi(4) / (8.0 * stiff.stiffness()[1]);
    let bare = sag(stiff);
    assert!((bare / by_theory - 1.0).abs() < 0.01, "{bare} {by_theory}");
    let held = sag(Wisp { hairs: 100.0, hold: 0.5 }.material(&stiff).unwrap());
    assert!((bare / held - 10.0).abs() < 0.1, "{}", bare / held);
}
