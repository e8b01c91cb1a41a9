//! A scene full of contact, and the golden hashes of its course on every machine.

use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::internals::math::rotation::from_rotation_vector;
use superhelix::{
    BodyDef, ConstraintDef, ContactModel, Frame, Friction, Hold, InstructionSet, Phases, Shape, Solver, SolverOptions,
    StepReport, StrandContact, StrandDef, Workers,
};

const STEP: f64 = 1.0 / 60.0;
const STRANDS: usize = 96;
/// Where they hang together: enough for their problem to be parted among threads.
const MANY: usize = 320;

/// A pose by our own sine: the standard library's differs from machine to machine.
fn at(x: f64, y: f64, z: f64, turn: f64) -> Frame {
    Frame { origin: Vector3::new(x, y, z), rotation: from_rotation_vector(Vector3::new(0.0, 0.0, turn)) }
}

/// Sheaves of four strands that fall across each other over a rod that turns, a box and a ball; one slides through a ring, two are tied. Or so many so close
/// together that each sheaf lies on the next, and no constraints.
pub fn course(
    model: ContactModel,
    workers: Workers,
    set: Option<InstructionSet>,
    together: bool,
) -> (Vec<StepReport>, usize, u64) {
    let mut options = SolverOptions { workers, instruction_set: set, ..SolverOptions::default() };
    (options.contact.model, options.contact.hair) = (model, true);
    let mut solver = Solver::new(options).unwrap();
    let (count, apart) = if together { (MANY, 0.0035) } else { (STRANDS, 0.012) };
    let defs: Vec<StrandDef> = (0..count)
        .map(|k| {
            let (sheaf, level) = ((k / 4) as f64 - 0.125 * count as f64 + 0.5, (k % 4) as f64 - 1.5);
            let mut def = StrandDef::straight(0.06, 4);
            def.natural = vec![[0.0, 4.0, 3.0 * level]; 4];
            def.initial = Some(vec![[0.0; 3]; 4]);
            def.material.youngs_modulus = 1e8;
            def.root = at(-0.02, apart * sheaf - 0.002 * level, 0.0075 + 0.0014 * level, 0.1 * level);
            def
        })
        .collect();
    let strands = solver.add_strands(&defs).unwrap();
    let contact = StrandContact {
        wisp_radius: 5e-4,
        exempt_length: 0.005,
        friction: Friction { along: 0.2, against: 0.3 },
        hair_friction: Friction { along: 0.1, against: 0.15 },
        ..StrandContact::default()
    };
    solver.set_contact(&strands, Some(&contact)).unwrap();
    let rod = Shape::new_capsule(Vector3::y() * -0.2, Vector3::y() * 0.2, 0.005).unwrap();
    let shapes = [
        (rod, at(0.0, 0.0, 0.0, 0.0)),
        (Shape::new_sphere(0.02).unwrap(), at(0.02, -0.03, -0.016, 0.0)),
        (Shape::new_box(Vector3::new(0.02, 0.06, 0.01)).unwrap(), at(0.04, 0.08, -0.008, 0.0)),
    ];
    let bodies = solver.add_bodies(shapes.map(|(shape, pose)| BodyDef { pose, ..BodyDef::new(Arc::new(shape)) }).into()).unwrap();
    let hold = |strand: usize, arclength: f64, hold: Hold, compliance: f64| {
        let mut target = Frame::default();
        solver.sample_at(strands[strand], &[arclength], |_, sample| target.origin = sample.position).unwrap();
        ConstraintDef { strand: strands[strand], arclength, hold, target, compliance }
    };
    let ring = Hold::Ring { friction: Friction::uniform(0.2) };
    let tie = Hold::Tie { other: strands[1], arclength: 0.06 };
    let holds = [hold(40, 0.02, ring, 0.0), hold(0, 0.06, tie, 1.0)];
    if !together {
        solver.add_constraints(&holds).unwrap();
    }
    let (mut reports, mut contacts) = (Vec::new(), 0);
    for step in 1..=8 {
        let turn = from_rotation_vector(Vector3::new(0.0, 0.05 * f64::from(step), 0.0));
        solver.set_body_frames(&bodies[..1], &[Frame { rotation: turn, ..Frame::default() }], STEP).unwrap();
        let report = solver.step(STEP, 1 + step / 8).unwrap();
        contacts = contacts.max(solver.contacts().len());
        reports.push(StepReport { seconds: 0.0, phases: Phases::default(), ..report });
    }
    (reports, contacts, solver.state_hash())
}

/// The state's hash at the end. A change here is a change of numerical results: see the other golden hashes, in `tests/solver/lanes/mod.rs`.
pub const GOLDEN: [(ContactModel, bool, u64); 4] = [
    (ContactModel::Penalty, false, 0x81bf_1e90_64a8_272c),
    (ContactModel::AtPoints, false, 0x554d_73a6_7157_aeaf),
    (ContactModel::Coulomb, false, 0x56e1_b1d1_3070_3d6a),
    (ContactModel::Coulomb, true, 0xa7a2_8f3e_52fd_1eb4),
];
