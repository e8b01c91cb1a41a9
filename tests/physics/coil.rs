//! Coils and twist against theory: a helical spring that its own weight pulls, and twist that relaxes. `--nocapture` prints the rows of
//! `docs/theory/validation_physics.md`.

use crate::rods::GRAVITY;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use superhelix::editing::EquilibriumOptions;
use superhelix::internals::step::equilibrium::of_strand;
use superhelix::{Material, Solver, SolverOptions, StrandDef};

/// A coil of radius 5 mm whose axis points down from the clamp: `coils` turns of pitch angle `alpha` from the horizontal.
fn coil(coils: f64, alpha: f64, per_turn: usize) -> StrandDef {
    let (sine, cosine) = alpha.sin_cos();
    let radius = 5e-3;
    let (curvature, twist) = (cosine * cosine / radius, sine * cosine / radius);
    let length = coils * std::f64::consts::TAU * radius / cosine;
    let mut def = StrandDef::straight(length, (coils * per_turn as f64).round() as usize);
    def.material = Material { radius: [50e-6; 2], youngs_modulus: 4e9, ..Material::default() };
    def.natural = vec![[twist, curvature, 0.0]; def.element_lengths.len()];
    // κ0 n0 + κ1 n1 lies along the axis.
    let n0 = Vector3::new(cosine, 0.0, -sine);
    let n1 = Vector3::new(-sine, 0.0, -cosine);
    let frame = Matrix3::from_columns(&[n0, n1, n0.cross(&n1)]);
    def.root.rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(frame));
    def
}

fn tip_height(def: &StrandDef, curvatures: &[[f64; 3]]) -> f64 {
    let mut held = def.clone();
    held.initial = Some(curvatures.to_vec());
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let id = solver.add_strands(&[held]).unwrap()[0];
    let mut height = 0.0;
    solver.sample_at(id, &[def.length()], |_, sample| height = sample.position.z).unwrap();
    height
}

/// How much longer the coil is in so weak a gravity that it answers linearly, by Love's spring (A Treatise on the Mathematical Theory of
/// Elasticity, article 271) under the weight below each section: ∫ w(L − s) R² (cos²α/EI0 + sin²α/EI) ds = ½ w L² R² (cos²α/EI0 + sin²α/EI).
fn extension_by_theory(coils: f64, alpha: f64, per_turn: usize) -> f64 {
    let def = coil(coils, alpha, per_turn);
    let [torsion, bending, _] = def.material.stiffness();
    let weight = def.material.linear_density() * 9.81;
    let theory = 0.5 * weight * def.length().powi(2) * 25e-6 * (alpha.cos().powi(2) / torsion + alpha.sin().powi(2) / bending);
    // Gravity so weak that the coil lengthens by a ten-thousandth of its radius.
    let share = 1e-4 * 5e-3 / theory;
    let options = EquilibriumOptions { tolerance: 1e-12, check_stability: false, ..EquilibriumOptions::default() };
    let (curvatures, found) = of_strand(&def, GRAVITY * share, &options).unwrap();
    assert!(found.residual < 1e-10, "{found:?}");
    (tip_height(&def, &def.natural) - tip_height(&def, &curvatures)) / (theory * share)
}

/// Over whole coils the weight's excursions from the axis cancel, and the spring is Love's.
#[test]
fn a_helix_pulled_by_its_weight() {
    for alpha in [0.1, 0.4] {
        for per_turn in [1, 2, 4, 8, 16] {
            let ratios = [5.0, 10.0, 20.0].map(|coils| extension_by_theory(coils, alpha, per_turn));
            println!("| α = {alpha} rad, {per_turn} elements a turn | {:.5} | {:.5} | {:.5} |", ratios[0], ratios[1], ratios[2]);
            // Ends matter less than the linear answer's own rest of a hundred-thousandth, and elements do not matter at all: under a load
            // that is the same all along, a helix stays a helix.
            assert!(ratios.iter().all(|ratio| (ratio - 1.0).abs() < 3e-5), "{ratios:?}");
        }
    }
}

/// Twist of a straight strand has no inertia: EI0 κ0 + (γ + μ EI0) κ̇0 = 0 in every element, whatever its neighbours do. It dies away as
/// exp(−t EI0/(γ + μ EI0)), and follows at once where nothing resists.
#[test]
fn twist_relaxes() {
    for (gamma, viscosity) in [(1e-9, 0.0), (0.0, 0.02), (1e-9, 0.02)] {
        let mut def = StrandDef::straight(0.1, 4);
        def.material = Material { internal_friction: gamma, viscosity, ..Material::default() };
        def.root.rotation = crate::rods::down();
        let twist = [30.0, -10.0, 5.0, 60.0];
        def.initial = Some(twist.map(|k| [k, 0.0, 0.0]).to_vec());
        let torsion = def.material.stiffness()[0];
        let time = (gamma + viscosity * torsion) / torsion;
        let errors = [20, 40, 80].map(|steps| {
            let mut solver = Solver::new(SolverOptions::default()).unwrap();
            let id = solver.add_strands(std::slice::from_ref(&def)).unwrap()[0];
            let report = solver.step(2.0 * time, steps).unwrap();
            assert_eq!((report.unconverged, report.quarantined), (0, 0));
            let curvatures = solver.curvatures(id).unwrap();
            // It hangs straight all the while.
            assert!(curvatures.iter().all(|row| row[1].abs().max(row[2].abs()) < 1e-9));
            curvatures.iter().zip(twist).map(|(row, k)| (row[0] / k - (-2.0_f64).exp()).abs()).fold(0.0, f64::max)
        });
        let order = (errors[1] / errors[2]).log2();
        println!(
            "| γ = {gamma:e}, μ = {viscosity}: time {time:.4} s | {:.1e} | {:.1e} | {:.1e} | {order:.2} |",
            errors[0], errors[1], errors[2]
        );
        assert!((1.8..2.3).contains(&order) && errors[2] < 1e-3, "{errors:?}");
    }
    // Nothing resists: it vanishes in any step, however short.
    for (h, twist) in [(1e-5, 15.0), (1e-3, 15.0), (1.0 / 60.0, 15.0), (1e-5, 60.0), (1e-3, 60.0), (1.0 / 60.0, 60.0)] {
        let mut def = StrandDef::straight(0.1, 4);
        def.root.rotation = crate::rods::down();
        def.initial = Some(vec![[twist, 0.0, 0.0]; 4]);
        let mut solver = Solver::new(SolverOptions::default()).unwrap();
        let id = solver.add_strands(std::slice::from_ref(&def)).unwrap()[0];
        let report = solver.step(h, 1).unwrap();
        let left = solver.curvatures(id).unwrap().iter().map(|row| row[0].abs() / twist).fold(0.0, f64::max);
        println!("{} rad, no friction, a step of {h:e} s: {left:.1e} is left, {} unconverged", 0.1 * twist, report.unconverged);
        assert!(left < 1e-6 && report.unconverged == 0, "h = {h}: {left} {report:?}");
    }
}
