//! A comb that passes right through a tuft, close to the roots, in long steps: what remains unsolved, by steps and substeps. What docs/notebook/contact.md says of
//! it under "Long steps through rooted hair" is this table: `cargo test --test contact comb -- --ignored --nocapture`.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{BodyDef, ContactModel, Frame, Shape, Solver, SolverOptions, StrandContact, StrandDef};

const STEP: f64 = 1.0 / 60.0;
const SIDE: usize = 4;
/// Of roots from each other; of teeth: their radius, and how far above the plane they end, m.
const APART: f64 = 5e-3;
const TOOTH: f64 = 1e-3;
const ABOVE: f64 = 2e-3;
/// How far the comb goes, m: through the tuft and out of it.
const WAY: f64 = 0.2;

#[derive(Debug, Default)]
struct Outcome {
    steps: u32,
    /// Strands' substeps in all, not converged, and rolled back.
    strand_steps: u32,
    unconverged: u32,
    rolled_back: u32,
    deepest: f64,
}

/// Curved hairs of 5 cm and eight elements stand on a plane; a comb whose teeth are `between` from each other goes through them. Strands that are left
/// deep are subdivided, with at most this many halvings.
fn comb(model: ContactModel, between: f64, speed: f64, substeps: u32, max_subdivisions: u32) -> Outcome {
    let mut options = SolverOptions { gravity: Vector3::new(0.0, 0.0, -9.81), ..SolverOptions::default() };
    (options.contact.model, options.step.max_subdivisions) = (model, max_subdivisions);
    let mut solver = Solver::new(options).unwrap();
    let defs: Vec<StrandDef> = (0..SIDE * SIDE)
        .map(|k| {
            let mut def = StrandDef::straight(0.05, 8);
            def.natural = vec![[0.0, 20.0, 0.0]; 8];
            let origin = Vector3::new((k % SIDE) as f64, (k / SIDE) as f64, 0.0) * APART;
            def.root = Frame { origin, rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -0.5 * PI) };
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    solver.set_contact(&ids, Some(&StrandContact { exempt_length: 2e-3, ..StrandContact::default() })).unwrap();
    solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_half_space(Vector3::z()).unwrap()))]).unwrap();
    let at = |way: f64| Frame { origin: Vector3::x() * (way - 0.03), ..Frame::default() };
    let tooth = |k: usize| {
        let end = |z: f64| Vector3::new(0.0, between * k as f64 - 7e-3, z);
        let shape = Shape::new_capsule(end(ABOVE + TOOTH), end(0.05), TOOTH).unwrap();
        BodyDef { pose: at(0.0), ..BodyDef::new(Arc::new(shape)) }
    };
    let teeth = solver.add_bodies((0..(0.03 / between) as usize).map(tooth).collect()).unwrap();
    let mut out = Outcome { steps: (WAY / speed / STEP).round() as u32, ..Outcome::default() };
    for step in 1..=out.steps {
        let frame = at(speed * STEP * f64::from(step));
        solver.set_body_frames(&teeth, &vec![frame; teeth.len()], STEP).unwrap();
        let report = solver.step(STEP, substeps).unwrap();
        assert!(report.energies.elastic.is_finite() && report.energies.kinetic.is_finite());
        out.strand_steps += ids.len() as u32 * substeps;
        out.unconverged += report.unconverged;
        out.rolled_back += report.quarantined;
        out.deepest = out.deepest.max(report.contact.penetration);
    }
    out
}

/// Slow enough that a tooth goes less than a third of the space between hairs in a substep: solved but for single strands' steps, and nothing deep.
#[test]
fn a_comb_through_rooted_hair_in_short_steps() {
    let out = comb(ContactModel::Coulomb, 2.5e-3, 0.6, 8, 0);
    println!("{out:?}");
    assert!(out.unconverged * 200 <= out.strand_steps && out.rolled_back == 0, "{out:?}");
    assert!(out.deepest < 1e-3, "{out:?}");
}

/// In long steps teeth pass over hairs and leave them deep inside; with substeps most of these steps are solved. The others need none.
#[test]
fn a_comb_through_rooted_hair_in_long_steps() {
    let [whole, in_parts] = [0, 3].map(|levels| comb(ContactModel::Coulomb, 2.5e-3, 0.6, 1, levels));
    println!("whole {whole:?}\nin parts {in_parts:?}");
    assert!(whole.deepest > 1e-3 && whole.unconverged > 20, "{whole:?}");
    assert!(in_parts.deepest < 0.2 * whole.deepest && in_parts.unconverged * 3 < whole.unconverged, "{in_parts:?} {whole:?}");
}

#[test]
#[ignore = "a table for the documentation"]
fn table() {
    {
        let model = ContactModel::Coulomb;
        for (between, speed) in [(2.5e-3, 0.6), (4e-3, 0.6), (2.5e-3, 0.15), (4e-3, 0.15)] {
            for (substeps, halvings) in [1, 2, 4, 8].into_iter().flat_map(|substeps| [(substeps, 0), (substeps, 3)]) {
                let out = comb(model, between, speed, substeps, halvings);
                let Outcome { steps, strand_steps, unconverged, rolled_back, deepest } = out;
                println!(
                    "{model:?}, teeth {:.1} mm apart, {speed} m/s: {steps} steps of {substeps}, {halvings} halvings: {unconverged} of {strand_steps} strand steps not solved, {rolled_back} rolled back, {:.3} mm deep",
                    1e3 * between,
                    1e3 * deepest
                );
            }
        }
    }
}
