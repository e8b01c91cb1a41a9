//! Hair of a measured type under a comb.

use std::f64::consts::PI;

use nalgebra::Vector3;
use superhelix::hair::{CurlFormula, HairType};
use superhelix::{BodyId, Frame, Material, Solver, SolverOptions, StrandContact, StrandDef};

use super::scene::{comb, follicle, stroke};

const STRANDS: usize = 40;
const LENGTH: f64 = 0.15;
/// Times more slowly than the scene's stroke: down by 14 cm in 3 s.
pub const SLOWER: f64 = 3.0;

/// The scene's stroke, begun nearer to the roots: curls hang no further down.
pub fn stroke_of(t: f64) -> Frame {
    let of_scene = stroke(t);
    Frame { origin: of_scene.origin + Vector3::z() * 0.016, ..of_scene }
}

/// Hair of a type that hangs from rows of follicles, at rest, and the comb.
pub fn hair(hair_type: HairType) -> (Solver, Vec<BodyId>) {
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
            def.root = follicle(k);
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).expect("strands");
    solver.set_contact(&ids, Some(&StrandContact { exempt_length: 5e-3, ..parameters.contact() })).expect("contact");
    let teeth = solver.add_bodies(comb(stroke_of(0.0))).expect("teeth");
    for _ in 0..240 {
        solver.step(1.0 / 60.0, 1).expect("a step");
    }
    (solver, teeth)
}
