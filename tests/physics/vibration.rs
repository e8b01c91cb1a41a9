//! Small vibrations against independent solutions: rods that hang or stand, droop or are curved, and how they die away. The same
//! frequencies are the critical rates of whirling shafts (`whirl.rs`). `--nocapture` prints the tables of
//! `docs/theory/validation_physics.md`.

use crate::rods::judge::{judge, record};
use crate::rods::modes::{matrices, modes};
use crate::rods::*;
use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::EquilibriumOptions;
use superhelix::internals::step::equilibrium::of_strand;
use superhelix::{Integrator, Material, Solver, SolverOptions, StrandDef};

/// What frequencies are measured in, rad/s: √(EI1/(ρS L⁴)).
fn unit(def: &StrandDef) -> f64 {
    (def.material.stiffness()[1] / (def.material.linear_density() * def.length().powi(4))).sqrt()
}

/// The slowest modes about the rest that is found from the natural shape, in the reference's unit.
fn frequencies(def: &StrandDef, gravity: Vector3<f64>, axes: &[usize]) -> Vec<f64> {
    let (curvatures, found) = of_strand(def, gravity, &EquilibriumOptions::default()).unwrap();
    assert!(found.converged, "{found:?}");
    modes(&matrices(def, &curvatures, gravity, axes)).iter().map(|mode| mode.omega / unit(def)).collect()
}

const COUNTS: [usize; 3] = [10, 20, 40];

/// Hanging (Γ > 0) and standing (Γ < 0): tension stiffens, compression softens, and at Γ = −7.84 nothing is left.
#[test]
fn vertical_rods() {
    for row in rows(&reference()["frequencies"]["vertical_rod"]) {
        let gamma = number(&row["Gamma"]);
        let root = clamp(if gamma > 0.0 { -Vector3::z() } else { Vector3::z() }, Vector3::x());
        // The boundary layer of a limp rod, L/√Γ, wants elements shorter than itself.
        let counts = if gamma < 100.0 { COUNTS } else { [20, 40, 80] };
        for mode in 0..2 {
            let errors = counts.map(|count| {
                let def = strand(count, material(gamma.abs().max(1.0), 1.0, 0.48), root, [0.0; 3]);
                let gravity = if gamma == 0.0 { Vector3::zeros() } else { GRAVITY };
                // Bending about n1 alone: about n2 it is the same.
                let (omega, exact) = (frequencies(&def, gravity, &[1])[mode], number(&row["omega"][mode]));
                record(
                    "vertical",
                    "gamma,mode,elements,omega,reference",
                    format!("{gamma},{},{count},{omega:.6},{exact:.6}", mode + 1),
                );
                (omega / exact - 1.0).abs()
            });
            judge("vertical", &format!("mode {}, Γ = {gamma}", mode + 1), &counts, &errors, 2e-2);
        }
    }
}

/// About the drooped rest of a horizontal rod: in its plane, and out of it, where twist takes part.
#[test]
fn drooped_rods() {
    for row in rows(&reference()["frequencies"]["drooped_horizontal"]) {
        let gamma = number(&row["Gamma"]);
        let def =
            |count| strand(count, material(gamma, 1.0, number(&row["poisson"])), clamp(Vector3::x(), Vector3::y()), [0.0; 3]);
        for (key, name, axes) in [("omega_inplane", "in its plane", &[1][..]), ("omega_outofplane", "out of it", &[0, 2])] {
            let counts = if gamma < 100.0 { COUNTS } else { [20, 40, 80] };
            let errors = counts.map(|count| (frequencies(&def(count), GRAVITY, axes)[0] / number(&row[key][0]) - 1.0).abs());
            judge("drooped", &format!("drooped, Γ = {gamma}, {name}"), &counts, &errors, 5e-3);
        }
    }
}

/// Circular arcs without gravity.
#[test]
fn arcs() {
    for row in rows(&reference()["frequencies"]["circular_arc"]) {
        let phi = number(&row["phi"]);
        for (key, name, axes) in [("omega_inplane", "in its plane", &[1][..]), ("omega_outofplane", "out of it", &[0, 2])] {
            let errors = COUNTS.map(|count| {
                let def = strand(count, material(1.0, 1.0, number(&row["poisson"])), down(), [0.0, phi, 0.0]);
                (frequencies(&def, Vector3::zeros(), axes)[0] / number(&row[key][0]) - 1.0).abs()
            });
            let name = format!("arc φ = {:.1}π, {name}", phi / std::f64::consts::PI);
            judge("arc", &name, &COUNTS, &errors, 5e-3);
        }
    }
}

/// A plucked mode of a straight rod dies away as γ and ν say: its decay and its frequency against the exact ones of the mode of N
/// elements, by the reference integrator; and the rod's own rates.
#[test]
fn damping_of_a_mode() {
    for row in rows(&reference()["frequencies"]["damped_straight"]) {
        let (mode, overdamped) = (number(&row["mode"]) as usize - 1, row["overdamped"].as_bool().unwrap());
        if mode > 0 || overdamped {
            continue;
        }
        let count = 6;
        let mut def = StrandDef::straight(number(&row["L"]), count);
        def.material = Material {
            radius: [number(&row["r"]); 2],
            youngs_modulus: number(&row["E"]),
            density: number(&row["rho"]),
            internal_friction: number(&row["gamma"]),
            air_drag: number(&row["nu"]),
            ..Material::default()
        };
        def.root.rotation = UnitQuaternion::identity();
        let natural = def.natural.clone();
        let shape = &modes(&matrices(&def, &natural, Vector3::zeros(), &[1]))[mode];
        // Exact for N elements: γ acts as elasticity does, ν as inertia does.
        let material = &def.material;
        let decay = 0.5
            * (material.air_drag / material.linear_density()
                + material.internal_friction / material.stiffness()[1] * shape.omega.powi(2));
        let omega = (shape.omega.powi(2) - decay.powi(2)).sqrt();
        // Of the rod itself N = 6 elements are 0.54 % in the frequency, twice that in γ's decay.
        assert!(
            (decay / number(&row["decay_rate"]) - 1.0).abs() < 1.2e-2
                && (omega / number(&row["omega_damped"]) - 1.0).abs() < 6e-3
        );
        let amplitude = 1e-4 / shape.shape.amax() / def.length();
        let mut initial = natural;
        for (element, curvatures) in initial.iter_mut().enumerate() {
            curvatures[1] += amplitude * shape.shape[element];
        }
        def.initial = Some(initial);
        let mut options = SolverOptions { gravity: Vector3::zeros(), ..SolverOptions::default() };
        (options.step.integrator, options.step.reference_tolerance) = (Integrator::Reference, 1e-9);
        let mut solver = Solver::new(options).unwrap();
        let id = solver.add_strands(std::slice::from_ref(&def)).unwrap()[0];
        let start = solver.curvatures(id).unwrap()[0][1];
        let mut worst = 0.0_f64;
        for call in 1..=60 {
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            assert_eq!((report.unconverged, report.quarantined), (0, 0));
            let t = f64::from(call) / 60.0;
            let exact = (-decay * t).exp() * ((omega * t).cos() + decay / omega * (omega * t).sin());
            worst = worst.max((solver.curvatures(id).unwrap()[0][1] / start - exact).abs());
        }
        println!("damped mode {}, γ = {}, ν = {}: within {worst:.1e} of exact over a second", mode + 1, row["gamma"], row["nu"]);
        // The reference keeps positions to 1e-9 L a second: of an amplitude of some 1e-5 L that is 1e-4.
        assert!(worst < 1e-4, "{worst}");
    }
}
