//! Substeps in which the limit of searches is reached before all contacts are found (sixteen searches hardly ever are too few: here the
//! limit is one or two), and substeps within them whose strands meet others that they do not see.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};

use crate::contact::body::BodyDef;
use crate::contact::options::{ContactModel, ContactOptions, StrandContact};
use crate::contact::shape::Shape;
use crate::math::frame::Frame;
use crate::math::functions::trigonometry::sine_cosine;
use crate::solver::Solver;
use crate::solver::definition::{SolverOptions, StrandDef};
use crate::solver::id::StrandId;
use crate::solver::report::StrandStatus;

const BALL: f64 = 0.03;
const H: f64 = 1.0 / 60.0;

/// The same on every machine.
fn sine(x: f64) -> f64 {
    sine_cosine(x).0
}

/// Strands in two layers across each other, 6 mm from each other, over a ball.
fn layers(model: ContactModel, count: usize) -> (Solver, Vec<StrandId>, Vec<StrandDef>) {
    let contact = ContactOptions { model, hair: true, ..ContactOptions::default() };
    let mut solver = Solver::new(SolverOptions { contact, ..SolverOptions::default() }).unwrap();
    let def = |k: usize| {
        let (layer, place) = ((k % 2) as f64, (k / 2) as f64 - 0.25 * (count - 2) as f64);
        let mut def = StrandDef::straight(0.1, 5);
        def.material.youngs_modulus = 1e9;
        def.natural = vec![[0.0, 3.0 * sine(1.7 * k as f64), 3.0 * sine(2.3 * k as f64 + 1.57)]; 5];
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2 * layer);
        let origin = turn * Vector3::new(-0.05, 6e-3 * place, 0.0) + Vector3::z() * (BALL + 4e-3 + 6e-3 * layer);
        def.root = Frame { origin, rotation: turn };
        def
    };
    let defs: Vec<StrandDef> = (0..count).map(def).collect();
    let ids = solver.add_strands(&defs).unwrap();
    let strand = StrandContact { radius: 1e-4, wisp_radius: 1e-3, ..StrandContact::default() };
    solver.set_contact(&ids, Some(&strand)).unwrap();
    solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_sphere(BALL).unwrap()))]).unwrap();
    solver.constrained_substep.coupled.max_searches = Some(1);
    (solver, ids, defs)
}

/// Moves the ball, and the roots the other way.
fn swing(solver: &mut Solver, ids: &[StrandId], defs: &[StrandDef], step: u32) {
    let offset = 0.012 * Vector3::new(sine(0.21 * f64::from(step)), sine(0.13 * f64::from(step)), 0.0);
    let roots: Vec<Frame> = defs.iter().map(|def| Frame { origin: def.root.origin - 0.5 * offset, ..def.root }).collect();
    solver.set_root_frames(ids, &roots, H).unwrap();
    let ball = solver.body_ids()[0];
    solver.set_body_frames(&[ball], &[Frame { origin: offset, ..Frame::default() }], H).unwrap();
}

/// The deepest that anything is in anything, asked again.
fn deepest(solver: &mut Solver, ids: &[StrandId]) -> f64 {
    solver.overlaps(ids).unwrap().iter().fold(0.0, |deepest, overlap| deepest.max(overlap.hair).max(overlap.bodies))
}

/// What the last search finds, and nothing holds any more, is reported: as a step that is not solved, and as deep as it is.
#[test]
fn what_exhausted_searches_leave_is_reported() {
    {
        let model = ContactModel::Coulomb;
        let (mut solver, ids, defs) = layers(model, 12);
        solver.options.step.max_subdivisions = 0;
        let (mut left, mut most, mut before) = (0, 0.0_f64, 0.0);
        before += deepest(&mut solver, &ids);
        for step in 0..60 {
            swing(&mut solver, &ids, &defs, step);
            let report = solver.step(H, 1).unwrap();
            let (deep, tolerance) = (deepest(&mut solver, &ids), ContactOptions::default().tolerance);
            // A tenth: how deep strands are is looked for near the places that a search has found.
            if deep > 1.1 * tolerance {
                let reported = report.contact.penetration;
                // What was deep in each other when the step began parts slowly, and may be solved.
                assert!(
                    report.contact.unconverged > 0 || before > 2.0 * tolerance,
                    "{model:?}, step {step}: {deep:e} deep, and solved"
                );
                assert!(reported > 0.9 * deep, "{model:?}, step {step}: {deep:e} deep, reported as {reported:e}");
                (left, most) = (left + 1, most.max(deep));
            }
            before = deep;
        }
        println!("{model:?}: {left} of 60 steps left {most:e} deep");
        assert!(left >= 5 && most > 1e-4, "{model:?}: {left}, {most:e}");
    }
}

/// A step that islands take in parts leaves nothing deeper than the same step in one piece: strands that have come into those that had gone on
/// already go back.
#[test]
fn substeps_leave_nothing_deeper_than_the_whole_step() {
    let (mut deeper, mut better, mut subdivided) = (Vec::new(), 0, 0);
    let (mut solver, ids, defs) = layers(ContactModel::Coulomb, 40);
    for step in 0..60 {
        swing(&mut solver, &ids, &defs, 3 * step);
        let before = solver.snapshot();
        let mut left = [0.0; 2];
        for (left, levels) in left.iter_mut().zip([0, 1]) {
            solver.restore(&before).unwrap();
            (solver.options.step.max_subdivisions, solver.constrained_substep.coupled.max_searches) = (levels, Some(2));
            let report = solver.step(H, 1).unwrap();
            subdivided += report.subdivided;
            *left = deepest(&mut solver, &ids);
        }
        let allowed = left[0].max(1e-4) + 1e-5;
        if left[1] > allowed {
            deeper.push((step, left));
        }
        better += u32::from(left[1] < 0.5 * left[0]);
    }
    println!("{subdivided} strand steps in substeps, half as deep in {better} steps");
    assert!(subdivided > 20 && better >= 3, "{subdivided} {better}");
    assert!(deeper.is_empty(), "{deeper:?}");
}

/// A strand whose root turns downwards in a step of a tenth of a second, and stiff ones across it, the first through `across`, if there are any.
/// `risen`: the strand whose end of the whole step is rejected, by its index.
fn turning(across: Option<Vector3<f64>>, risen: Option<u32>) -> (Solver, Vec<StrandId>) {
    let contact = ContactOptions { hair: true, ..ContactOptions::default() };
    let mut solver = Solver::new(SolverOptions { contact, ..SolverOptions::default() }).unwrap();
    let mut defs = vec![StrandDef::straight(0.1, 5)];
    defs[0].material.youngs_modulus = 4e9;
    if let Some(middle) = across {
        let mut def = StrandDef::straight(0.06, 3);
        def.material.youngs_modulus = 1e11;
        def.root.rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
        // Many more keep the common motion of all strands, which no search counts as motion, near none.
        for k in 0..100 {
            def.root.origin = middle + Vector3::new(0.1 * f64::from(k), -0.03, 0.0);
            defs.push(def.clone());
        }
    }
    let ids = solver.add_strands(&defs).unwrap();
    let strand = StrandContact { radius: 1e-4, wisp_radius: 1e-3, ..StrandContact::default() };
    solver.set_contact(&ids, Some(&strand)).unwrap();
    let rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 1.0);
    let root = Frame { origin: -0.05 * Vector3::z(), rotation };
    solver.set_root_frames(&ids[..1], &[root], LONG).unwrap();
    solver.constrained_substep.coupled.risen = risen;
    (solver, ids)
}

/// A step in which one long step ends elsewhere than two short ones, s.
const LONG: f64 = 0.1;

/// The first strand close to its tip, after a step.
fn end_of_turn(risen: Option<u32>) -> Vector3<f64> {
    let (mut solver, ids) = turning(None, risen);
    solver.step(LONG, 1).unwrap();
    let mut end = Vector3::zeros();
    solver.sample_at(ids[0], &[0.098], |_, sample| end = sample.position).unwrap();
    end
}

/// Substeps do not see the strands outside them, and a strand whose end of the whole step is rejected has no other end: it is reported as
/// unconverged where it is left deep in one of them.
#[test]
fn a_strand_that_substeps_leave_deep_in_another_is_not_converged() {
    let [whole, halves] = [None, Some(0)].map(end_of_turn);
    assert!((whole - halves).norm() > 5e-3, "{whole} {halves}");
    let step = |across: Vector3<f64>| {
        let (mut solver, ids) = turning(Some(across), Some(0));
        let report = solver.step(LONG, 1).unwrap();
        let statuses = ids[..2].iter().map(|id| solver.status(*id).unwrap()).collect::<Vec<StrandStatus>>();
        (report, deepest(&mut solver, &ids), statuses)
    };
    let (report, deep, statuses) = step(halves);
    println!("{deep} m deep, {statuses:?}");
    assert!(deep > 1e-3 && report.contact.penetration > 0.9 * deep, "{deep:e}, reported as {:e}", report.contact.penetration);
    assert_eq!((report.unconverged, report.contact.unconverged), (1, 1));
    assert_eq!(statuses, [StrandStatus::Unconverged, StrandStatus::Ok]);
    // Nowhere near the other one the same substeps are what they say.
    let (report, deep, statuses) = step(halves + 0.1 * Vector3::x());
    assert!(deep == 0.0, "{deep:e}");
    assert_eq!((report.unconverged, report.contact.unconverged), (0, 0));
    assert_eq!(statuses, [StrandStatus::Ok; 2]);
}
