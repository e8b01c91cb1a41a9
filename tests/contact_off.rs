//! Contact that is off is free: the same instructions (counted by callgrind), no allocation and not a byte more than in a scene that never
//! heard of it. Bits: `strands_without_contacts_move_as_if_contact_were_off` in `contact/hair_on_hair.rs`.
#![cfg(target_os = "linux")]
#![allow(unsafe_code)]

mod allocations;

use std::process::Command;
use std::sync::Arc;

use allocations::allocations_so_far;
use nalgebra::Vector3;
use superhelix::{
    BodyDef, ConstraintDef, ContactModel, ContactOptions, Frame, Hold, InstructionSet, Shape, Solver, SolverOptions,
    StrandContact, StrandDef, StrandId,
};

const STRANDS: usize = 64;
const STEPS: u32 = 10;

fn at(z: f64) -> Frame {
    Frame { origin: Vector3::new(0.05, 0.0, z), ..Frame::default() }
}

fn ball() -> BodyDef {
    BodyDef::new(Arc::new(Shape::new_sphere(0.05).unwrap()))
}

/// What is off in a scene, and its permitted cost: a fraction of a step's instructions, and allocations per step.
type Case = (&'static str, fn(&mut Solver, &[StrandId]), f64, u64);

/// The first is the scene without contact; the second shows that the count would notice.
const CASES: [Case; 7] = [
    ("unknown", |_, _| {}, 0.0, 0),
    (
        "a ball that strands lie on",
        |solver, ids| {
            solver.add_bodies(vec![BodyDef { pose: at(-0.051), ..ball() }]).unwrap();
            solver.set_contact(ids, Some(&StrandContact::default())).unwrap();
        },
        f64::INFINITY,
        u64::MAX,
    ),
    (
        "a model and tolerances chosen",
        |solver, _| {
            let model = ContactModel::Coulomb;
            solver.set_contact_options(&ContactOptions { model, tolerance: 1e-6, ..ContactOptions::default() }).unwrap();
        },
        0.0,
        0,
    ),
    (
        "strands that are to touch what there is not",
        |solver, ids| {
            let contact = StrandContact { wisp_radius: 1e-3, ..StrandContact::default() };
            solver.set_contact(ids, Some(&contact)).unwrap();
        },
        0.0,
        0,
    ),
    (
        "strands that touch each other no more, a ball and a pin that are gone",
        |solver, ids| {
            let hair = |solver: &mut Solver, hair| {
                solver.set_contact_options(&ContactOptions { hair, ..ContactOptions::default() }).unwrap();
            };
            hair(solver, true);
            solver.set_contact(ids, Some(&StrandContact { wisp_radius: 1e-3, ..StrandContact::default() })).unwrap();
            let bodies = solver.add_bodies(vec![BodyDef { pose: at(-0.051), ..ball() }]).unwrap();
            let pin = ConstraintDef { strand: ids[0], arclength: 0.1, hold: Hold::Point, target: at(0.0), compliance: 0.0 };
            let pins = solver.add_constraints(&[pin]).unwrap();
            hair(solver, false);
            solver.remove_bodies(&bodies).unwrap();
            solver.remove_constraints(&pins).unwrap();
            solver.set_contact(ids, None).unwrap();
        },
        0.0,
        0,
    ),
    // A scene with a body is one in which strands may be held, and all of them are asked whether they are: one per mille of a step,
    // four where their reach is asked as well. The lists of its bodies are three allocations.
    (
        "a ball that no strand is to touch",
        |solver, _| {
            solver.add_bodies(vec![BodyDef { pose: at(-0.051), ..ball() }]).unwrap();
        },
        2.5e-3,
        3,
    ),
    (
        "a ball out of reach",
        |solver, ids| {
            solver.add_bodies(vec![BodyDef { pose: at(3.0), ..ball() }]).unwrap();
            solver.set_contact(ids, Some(&StrandContact::default())).unwrap();
        },
        4.5e-3,
        3,
    ),
];

fn scene(arrange: fn(&mut Solver, &[StrandId])) -> Solver {
    // Valgrind does not know every instruction set.
    let mut solver =
        Solver::new(SolverOptions { instruction_set: Some(InstructionSet::Baseline), ..SolverOptions::default() }).unwrap();
    let defs: Vec<StrandDef> = (0..STRANDS)
        .map(|k| {
            let mut def = StrandDef::straight(0.1 + 1e-3 * k as f64, 5);
            def.natural = vec![[0.5, 3.0, 1.0]; 5];
            def.root.origin.y = 1e-3 * k as f64;
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    arrange(&mut solver, &ids);
    // Scratch memory grows.
    solver.step(1.0 / 60.0, 3).unwrap();
    solver
}

/// The function that callgrind counts, by this name.
#[inline(never)]
#[unsafe(no_mangle)]
extern "C" fn contact_off_counted_steps(solver: &mut Solver) {
    for _ in 0..STEPS {
        solver.step(1.0 / 60.0, 1).unwrap();
    }
}

/// Not a test of its own: what callgrind looks at, the case of that number.
#[test]
#[ignore = "run by the test below, under callgrind"]
fn case_for_callgrind() {
    let case: usize = std::env::var("CONTACT_OFF_CASE").unwrap().parse().unwrap();
    contact_off_counted_steps(&mut scene(CASES[case].1));
}

fn instructions(case: usize) -> f64 {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--collect-atstart=no"])
        .arg("--toggle-collect=contact_off_counted_steps")
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", "case_for_callgrind", "--ignored", "--test-threads", "1"])
        .env("CONTACT_OFF_CASE", case.to_string())
        .output()
        .unwrap_or_else(|error| panic!("valgrind: {error}. This test needs it: apt-get install valgrind"));
    let log = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{log}");
    let counted = log.lines().find_map(|line| line.split_once("Collected : ")).unwrap_or_else(|| panic!("{log}")).1;
    counted.trim().parse().unwrap()
}

#[test]
fn disabled_contact_costs_nothing() {
    let solver = scene(CASES[0].1);
    let bytes = solver.memory_usage();
    // The first case twice. All side by side, and before any allocation is counted.
    let runs: Vec<f64> = std::thread::scope(|scope| {
        let begun: Vec<_> = (0..=CASES.len()).map(|run| scope.spawn(move || instructions(run % CASES.len()))).collect();
        begun.into_iter().map(|run| run.join().unwrap()).collect()
    });
    let unknown = runs[CASES.len()];
    assert!(unknown > 1e6, "{unknown}");
    for (number, (name, arrange, share, allocations)) in CASES.into_iter().enumerate() {
        let mut solver = scene(arrange);
        let (more, before) = (solver.memory_usage() as i64 - bytes as i64, allocations_so_far());
        contact_off_counted_steps(&mut solver);
        let allocated = allocations_so_far() - before;
        let counted = runs[number] / unknown - 1.0;
        println!("{name}: {counted:+.2e} of the instructions, {allocated} allocations, {more} bytes more");
        if share.is_infinite() {
            assert!(counted > 0.5, "{name}: the count does not tell");
            continue;
        }
        // The only nondeterminism: two clock readings per step.
        assert!(counted.abs() <= share + 1e-4, "{name}: {counted:+.2e}");
        assert!(allocated <= allocations * u64::from(STEPS), "{name}: {allocated}");
        if share == 0.0 && number != 3 && number != 4 {
            assert_eq!(more, 0, "{name}");
        }
    }
}
