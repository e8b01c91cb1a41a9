//! Islands are independent of each other.

use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::{
    BodyDef, ConstraintDef, ContactModel, Frame, Friction, Hold, Shape, Solver, SolverOptions, StrandContact, StrandDef,
};

const STEP: f64 = 1.0 / 60.0;
const STEPS: usize = 12;

/// The cost of a step: sweeps, searches, islands that have not converged.
type Tally = (u64, u32, u32);

fn at(x: f64, y: f64, z: f64) -> Frame {
    Frame { origin: Vector3::new(x, y, z), ..Frame::default() }
}

/// Sheaves of curling strands that fall on a rod, far from two strands whose tips are tied together and which are pinned further apart than
/// they are long.
fn course(sheaves: usize, contradicted: bool) -> Vec<Tally> {
    let mut options = SolverOptions::default();
    (options.contact.model, options.contact.hair) = (ContactModel::Coulomb, true);
    let mut solver = Solver::new(options).unwrap();
    let falling = |k: usize| {
        let (sheaf, level) = ((k / 4) as f64, (k % 4) as f64 - 1.5);
        let mut def = StrandDef::straight(0.06, 4);
        def.natural = vec![[0.0, 4.0, 3.0 * level]; 4];
        def.initial = Some(vec![[0.0; 3]; 4]);
        def.material.youngs_modulus = 1e8;
        def.root = at(-0.02, 0.012 * sheaf - 0.002 * level, 0.0075 + 0.0014 * level);
        def
    };
    let tied = |k: usize| StrandDef { root: at(0.0, 1.0 + 0.15 * k as f64, 0.0), ..StrandDef::straight(0.05, 3) };
    let mut defs: Vec<StrandDef> = (0..4 * sheaves).map(falling).collect();
    if contradicted {
        defs.extend([tied(0), tied(1)]);
    }
    let strands = solver.add_strands(&defs).unwrap();
    let friction = Friction { along: 0.2, against: 0.3 };
    let contact = StrandContact { wisp_radius: 5e-4, exempt_length: 0.005, friction, ..StrandContact::default() };
    solver.set_contact(&strands, Some(&contact)).unwrap();
    let rod = Shape::new_capsule(Vector3::y() * -0.2, Vector3::y() * 0.2, 0.005).unwrap();
    solver.add_bodies(vec![BodyDef::new(Arc::new(rod))]).unwrap();
    if contradicted {
        let [.., a, b] = strands[..] else { unreachable!() };
        let hold = Hold::Tie { other: b, arclength: 0.05 };
        solver
            .add_constraints(&[ConstraintDef { strand: a, arclength: 0.05, hold, target: Frame::default(), compliance: 0.0 }])
            .unwrap();
    }
    (0..STEPS)
        .map(|_| {
            let contact = solver.step(STEP, 1).unwrap().contact;
            (contact.sweeps, contact.searches, contact.unconverged)
        })
        .collect()
}

/// Every search that finds something rebuilds all islands: one that was given up must not go through both attempts again each
/// time.
#[test]
fn an_island_given_up_is_not_solved_again_for_contacts_of_others() {
    let (falling, contradicted, both) = (course(6, false), course(0, true), course(6, true));
    let most = falling.iter().map(|(_, searches, _)| *searches).max().unwrap();
    assert!(most >= 1, "nothing is found later: {falling:?}");
    assert!(contradicted.iter().all(|(.., unconverged)| *unconverged == 1), "{contradicted:?}");
    for (step, both) in both.iter().enumerate() {
        assert_eq!(both.0, falling[step].0 + contradicted[step].0, "sweeps of step {step}: {falling:?} {contradicted:?}");
        assert_eq!(both.2, falling[step].2 + contradicted[step].2, "step {step}");
    }
}
