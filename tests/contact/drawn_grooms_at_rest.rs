//! Drawn grooms are at rest with contact and constraints as well: rest shapes carry all weight, so that pins, rings and contacts carry
//! none, and what was drawn into something is allowed to be there (`Solver::allow_overlaps`).

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::{PermittedOverlap, Stiffening};
use superhelix::hair::{FitOptions, fit_polyline};
use superhelix::io::{Curves, obj_mesh};
use superhelix::shapes::{DistanceGrid, Sides};
use superhelix::{
    BodyDef, ConstraintDef, ConstraintStatus, ContactModel, ContactOptions, Error, Frame, Friction, Hold, Sample, Shape, Solver,
    SolverOptions, StrandContact, StrandDef, StrandId, Workers,
};

const MODELS: [ContactModel; 3] = [ContactModel::Penalty, ContactModel::RegularisedPenalty, ContactModel::Coulomb];
/// What issue and theory ask: rounding alone moves a groom at rest.
const STILL: f64 = 1e-6;
const WISP: f64 = 1e-3;
const UP: Vector3<f64> = Vector3::new(0.0, 0.0, 1.0);

fn solver(model: ContactModel, gravity: Vector3<f64>) -> Solver {
    let contact = ContactOptions { model, hair: true, ..ContactOptions::default() };
    Solver::new(SolverOptions { gravity, contact, workers: Workers::Pool(2), ..SolverOptions::default() }).unwrap()
}

/// A helix of 20 cm that goes down from a root on the x axis.
fn curl(x: f64) -> StrandDef {
    let mut def = StrandDef::straight(0.2, 8);
    def.natural = (0..8).map(|k| [20.0, 25.0 + 2.0 * f64::from(k), 5.0]).collect();
    def.root.origin.x = x;
    def.root.rotation = UnitQuaternion::rotation_between(&Vector3::x(), &-UP).unwrap();
    def
}

/// A straight strand of 10 cm from `origin` along `way`.
fn rod(origin: Vector3<f64>, way: Vector3<f64>) -> StrandDef {
    let mut def = StrandDef::straight(0.1, 6);
    def.root = Frame { origin, rotation: UnitQuaternion::rotation_between(&Vector3::x(), &way).unwrap() };
    def
}

fn points(solver: &Solver, ids: &[StrandId]) -> Vec<Vector3<f64>> {
    let mut out = Vec::new();
    solver.sample_strands(ids, 17, |_, _, sample| out.push(sample.position)).unwrap();
    out
}

/// The largest displacement of any point in some seconds, relative to its strand's length; and the largest contact force relative to the lightest strand's weight.
fn moves(solver: &mut Solver, ids: &[StrandId], seconds: f64) -> (f64, f64) {
    let before = points(solver, ids);
    let lengths: Vec<f64> = ids.iter().map(|id| solver.element_lengths(*id).unwrap().iter().sum()).collect();
    let weight = |id: &StrandId| {
        let material = solver.material(*id).unwrap();
        std::f64::consts::PI * material.radius[0] * material.radius[1] * material.density * 9.81
    };
    let lightest = ids.iter().zip(&lengths).map(|(id, length)| weight(id) * length).fold(f64::INFINITY, f64::min);
    let (mut furthest, mut force) = (0.0_f64, 0.0_f64);
    for _ in 0..(60.0 * seconds) as usize {
        solver.step(1.0 / 60.0, 1).unwrap();
        force = solver.contacts().iter().map(|contact| contact.force.norm() / lightest).fold(force, f64::max);
        let now = points(solver, ids);
        for (k, (a, b)) in now.iter().zip(&before).enumerate() {
            furthest = furthest.max((a - b).norm() / lengths[k / 17]);
        }
    }
    (furthest, force)
}

fn touching(solver: &mut Solver, ids: &[StrandId]) {
    let contact = StrandContact { wisp_radius: WISP, ..StrandContact::default() };
    solver.set_contact(ids, Some(&contact)).unwrap();
}

#[test]
fn strands_pinned_where_they_are_drawn_lie_still() {
    let defs: Vec<StrandDef> = (0..4).map(|k| curl(0.05 * f64::from(k))).collect();
    let mut solver = solver(ContactModel::Coulomb, -9.81 * UP);
    let ids = solver.add_strands(&defs).unwrap();
    assert!(moves(&mut solver, &ids, 0.5).0 > 1e-2, "as drawn they sag");
    solver.set_shapes(&ids, &defs.iter().flat_map(|def| def.natural.clone()).collect::<Vec<_>>()).unwrap();
    // These curls are as limp as hair, and would not rest stably where they stand.
    solver.stiffen(&ids, Stiffening::YoungsModulus, 0.05).unwrap();
    let frame = |k: usize, arclength: f64| {
        let mut frame = Frame::default();
        let keep = |_, sample: &Sample| frame = Frame { origin: sample.position, rotation: sample.rotation };
        solver.sample_at(ids[k], &[arclength], keep).unwrap();
        frame
    };
    let ring = Hold::Ring { friction: Friction::uniform(0.3) };
    let constraints: Vec<ConstraintDef> =
        [(0, 0.1, Hold::Point), (0, 0.2, Hold::Point), (1, 0.2, Hold::Frame), (2, 0.12, Hold::Direction), (3, 0.13, ring)]
            .into_iter()
            .map(|(k, arclength, hold)| ConstraintDef {
                strand: ids[k],
                arclength,
                hold,
                target: frame(k, arclength),
                compliance: 0.0,
            })
            .collect();
    let held = solver.add_constraints(&constraints).unwrap();
    let (moved, _) = moves(&mut solver, &ids, 10.0);
    println!("pinned: {moved:.1e} L");
    assert!(moved < STILL, "{moved}");
    for id in held {
        let state = solver.constraint_state(id).unwrap();
        // A hundred-thousandth of a strand's weight, 2e-5 N.
        assert!(state.status == ConstraintStatus::Holds && state.force.norm() < 2e-10 && state.error < 1e-9, "{state:?}");
    }
}

/// Straight strands that lie on a plane, on a ball and across each other at exactly the distance of touching.
fn laid(solver: &mut Solver) -> Vec<StrandId> {
    let y = Vector3::y();
    let defs = [
        rod(Vector3::zeros(), Vector3::x()),
        // Across the first, on it; and along the first beside it.
        rod(Vector3::new(0.05, -0.05, 2.0 * WISP), y),
        rod(Vector3::new(0.01, 2.0 * WISP, 0.0), Vector3::x()),
        // On a ball.
        rod(Vector3::new(0.3, -0.05, 0.0), y),
    ];
    let ids = solver.add_strands(&defs).unwrap();
    let radius = StrandContact::default().radius;
    let plane = Shape::new_half_space(UP).unwrap();
    let below = Frame { origin: -radius * UP, ..Frame::default() };
    let ball = Frame { origin: Vector3::new(0.3, 0.0, -0.02 - radius), ..Frame::default() };
    solver
        .add_bodies(vec![
            BodyDef { pose: below, ..BodyDef::new(Arc::new(plane)) },
            BodyDef { pose: ball, ..BodyDef::new(Arc::new(Shape::new_sphere(0.02).unwrap())) },
        ])
        .unwrap();
    touching(solver, &ids);
    ids
}

#[test]
fn strands_drawn_lying_on_each_other_and_on_bodies_lie_still() {
    for model in MODELS {
        let mut solver = solver(model, -9.81 * UP);
        let ids = laid(&mut solver);
        // Their sections are stiff enough not to fall over.
        solver.stiffen(&ids, Stiffening::YoungsModulus, 0.05).unwrap();
        let overlaps = solver.overlaps(&ids).unwrap();
        assert!(overlaps.iter().all(|overlap| overlap.hair < 1e-15 && overlap.bodies < 1e-15), "{overlaps:?}");
        let (moved, force) = moves(&mut solver, &ids, 10.0);
        println!("{model:?}, laid: {moved:.1e} L, {force:.1e} of the weight");
        assert!(moved < STILL && force < 1e-3, "{model:?} {moved} {force}");
    }
}

/// The same, each a part of a millimetre in what it lay on; and a strand right through the ball.
fn sunk(solver: &mut Solver) -> Vec<StrandId> {
    let mut ids = laid(solver);
    ids.extend(solver.add_strands(&[rod(Vector3::new(0.25, 0.005, -0.015), Vector3::x())]).unwrap());
    touching(solver, &ids);
    let frames: Vec<Frame> = [1e-4, 1e-4 + 0.5 * WISP, 1e-4, 2e-3, 0.0]
        .into_iter()
        .zip(&ids)
        .map(|(down, id)| {
            let root = solver.root_frame(*id).unwrap();
            Frame { origin: root.origin - down * UP, ..root }
        })
        .collect();
    solver.teleport_roots(&ids, &frames).unwrap();
    ids
}

#[test]
fn strands_drawn_into_each_other_and_into_bodies_lie_still_where_overlap_is_permitted() {
    for model in MODELS {
        let run = |allowed: bool| {
            let mut solver = solver(model, -9.81 * UP);
            let ids = sunk(&mut solver);
            solver.stiffen(&ids, Stiffening::YoungsModulus, 0.05).unwrap();
            let drawn = solver.overlaps(&ids).unwrap();
            if allowed {
                assert_eq!(solver.allow_overlaps(&ids).unwrap(), drawn);
                let left = solver.overlaps(&ids).unwrap();
                assert!(left.iter().all(|overlap| overlap.hair < 1e-15 && overlap.bodies < 1e-15), "{left:?}");
            }
            // By construction: how deep the second is in the first, the fourth in the ball.
            assert!((drawn[1].hair - 0.5 * WISP).abs() < 1e-12 && drawn[1].strand == Some(ids[0]), "{drawn:?}");
            assert!((drawn[3].bodies - 2e-3).abs() < 1e-9, "{drawn:?}");
            (moves(&mut solver, &ids, if allowed { 10.0 } else { 0.5 }), solver, ids)
        };
        let ((pushed, _), ..) = run(false);
        assert!(pushed > 1e-3, "{model:?} {pushed}");
        let ((moved, force), mut solver, ids) = run(true);
        println!("{model:?}, drawn into each other: {moved:.1e} L, {force:.1e} of the weight; {pushed:.1e} L without");
        assert!(moved < STILL && force < 1e-3, "{model:?} {moved} {force}");

        // A snapshot holds what is allowed.
        let image = solver.snapshot();
        let hash = solver.state_hash();
        solver.step(1.0 / 60.0, 3).unwrap();
        let after = solver.state_hash();
        solver.restore(&image).unwrap();
        assert_eq!(solver.state_hash(), hash);
        solver.step(1.0 / 60.0, 3).unwrap();
        assert_eq!(solver.state_hash(), after);
        // Permitted overlaps can be removed, and then contact acts.
        solver.set_permitted_overlaps(&ids, &vec![None; ids.len()]).unwrap();
        assert!(moves(&mut solver, &ids, 0.5).0 > 1e-3, "{model:?}");
    }
}

#[test]
fn permitted_overlaps_end_where_nothing_overlapped_in_the_drawing() {
    // A level rod, drawn 1 mm into a floor at its middle only: the floor is a ball's top there. Let go under gravity it sinks no deeper, though
    // it would without the ball.
    let mut solver = solver(ContactModel::Coulomb, -9.81 * UP);
    let mut def = rod(Vector3::zeros(), Vector3::x());
    def.material.youngs_modulus *= 1e-2;
    let ids = solver.add_strands(&[def]).unwrap();
    let ball = Frame { origin: Vector3::new(0.05, 0.0, 1e-3 - 0.02 - 50e-6), ..Frame::default() };
    let body = BodyDef { pose: ball, ..BodyDef::new(Arc::new(Shape::new_sphere(0.02).unwrap())) };
    solver.add_bodies(vec![body]).unwrap();
    touching(&mut solver, &ids);
    assert!((solver.allow_overlaps(&ids).unwrap()[0].bodies - 1e-3).abs() < 1e-9);
    for _ in 0..600 {
        solver.step(1.0 / 60.0, 1).unwrap();
    }
    // It hangs over the ball: at the allowed depth there, not below, and its tip is far down.
    let overlap = solver.overlaps(&ids).unwrap()[0];
    assert!(overlap.bodies < 2e-5, "{overlap:?}");
    let (mut tip, mut nearest) = (Vector3::zeros(), f64::INFINITY);
    solver
        .sample_strands(&ids, 101, |_, _, sample| {
            (tip, nearest) = (sample.position, nearest.min((sample.position - ball.origin).norm()));
        })
        .unwrap();
    assert!(tip.z < -0.02 && (nearest - 0.019_05).abs() < 1e-4, "{tip} {nearest}");
}

#[test]
fn bad_permitted_overlaps_are_named_and_change_nothing() {
    let mut solver = solver(ContactModel::Coulomb, -9.81 * UP);
    let ids = sunk(&mut solver);
    solver.allow_overlaps(&ids).unwrap();
    let hash = solver.state_hash();
    let good = solver.permitted_overlap(ids[0]).unwrap().cloned();
    assert!(good.is_some());
    let bad = PermittedOverlap { sunk: vec![f64::NAN; 7], ..good.clone().unwrap() };
    for (result, named) in [
        (solver.set_permitted_overlaps(&ids[..2], &[good.clone(), Some(bad)]), "permitted_overlaps[1].sunk[0]"),
        (solver.set_permitted_overlaps(&ids[..2], std::slice::from_ref(&good)), "permitted_overlaps (count)"),
        (solver.allow_overlaps(&[ids[0], ids[0]]).map(|_| ()), "ids[1]"),
        (solver.allow_overlaps(&[ids[0], StrandId::from_bits(7)]).map(|_| ()), "ids[1]"),
        (solver.overlaps(&[StrandId::from_bits(7)]).map(|_| ()), "ids[0]"),
    ] {
        let error = result.unwrap_err();
        assert!(matches!(error, Error::InvalidArgument { .. } | Error::InvalidId { .. }));
        assert!(error.to_string().contains(named), "{error}");
        assert_eq!(solver.state_hash(), hash, "{named}");
    }
    solver.set_permitted_overlaps(&ids[..1], &[None]).unwrap();
    assert_ne!(solver.state_hash(), hash);
    solver.set_permitted_overlaps(&ids[..1], &[good]).unwrap();
    assert_eq!(solver.state_hash(), hash);
}

/// Metres a unit of Sintel's files.
const SCALE: f64 = 0.01;

fn file(name: &str) -> String {
    format!("{}/tests/data/grooms/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn bust() -> Arc<Shape> {
    let bust = obj_mesh::read(file("sintel_bust.obj")).unwrap();
    let vertices = bust.vertices.iter().map(|v| Vector3::from(*v) * SCALE).collect();
    let mesh = Shape::new_mesh(vertices, bust.triangles, Sides::Front { depth: 0.02 }).unwrap();
    Arc::new(Shape::new_grid(DistanceGrid::bake(mesh.mesh().unwrap(), 5e-3, 0.02).unwrap()))
}

/// Sintel's hair and her bust, as they are drawn.
fn sintel(model: ContactModel, bust: &Arc<Shape>, every: usize, wisp_radius: f64) -> (Solver, Vec<StrandId>) {
    let curves = Curves::read(file("sintel_hair_001.tfx")).unwrap();
    let strand = |points: &[[f32; 3]]| {
        let points: Vec<_> = points.iter().map(|p| Vector3::from(p.map(f64::from)) * SCALE).collect();
        let fit = fit_polyline(&points, &FitOptions::elements(10)).unwrap();
        let mut def = StrandDef::straight(1.0, 10);
        (def.element_lengths, def.root, def.natural) = (fit.element_lengths, fit.root, fit.curvatures);
        def
    };
    let defs: Vec<StrandDef> = curves.strands().step_by(every).map(strand).collect();
    let mut solver = solver(model, Vector3::new(0.0, -9.81, 0.0));
    let ids = solver.add_strands(&defs).unwrap();
    solver.add_bodies(vec![BodyDef::new(Arc::clone(bust))]).unwrap();
    // None of it is exempt: what is drawn into the bust at the roots counts too.
    let contact = StrandContact { wisp_radius, ..StrandContact::default() };
    solver.set_contact(&ids, Some(&contact)).unwrap();
    solver.stiffen(&ids, Stiffening::YoungsModulus, 0.05).unwrap();
    (solver, ids)
}

#[test]
fn a_real_groom_drawn_into_itself_and_into_a_head_lies_still() {
    let every = std::env::var("AS_DRAWN_EVERY").map_or(4, |text| text.parse().unwrap());
    let bust = bust();
    for model in [ContactModel::Coulomb, ContactModel::Penalty] {
        // A quarter of the strands or more are in others, some in the bust.
        let (mut solver, ids) = sintel(model, &bust, every, 2e-3);
        let drawn = solver.allow_overlaps(&ids).unwrap();
        let deep = |of: fn(&superhelix::editing::Overlap) -> f64| {
            let all: Vec<f64> = drawn.iter().map(of).filter(|depth| *depth > 0.0).collect();
            (all.len(), all.into_iter().fold(0.0, f64::max))
        };
        let (hair, bodies) = (deep(|overlap| overlap.hair), deep(|overlap| overlap.bodies));
        assert!(hair.0 > ids.len() / 5 && hair.1 > 1e-3 && bodies.0 > 2 && bodies.1 > 2e-3, "{hair:?} {bodies:?}");
        let started = std::time::Instant::now();
        let (moved, force) = moves(&mut solver, &ids, 10.0);
        println!(
            "{model:?}: {} strands, {} in hair to {:.2} mm, {} in the bust to {:.2} mm: {moved:.1e} L, {force:.1e} of the weight; {:.1} s",
            ids.len(),
            hair.0,
            1e3 * hair.1,
            bodies.0,
            1e3 * bodies.1,
            started.elapsed().as_secs_f64()
        );
        assert!(moved < STILL, "{model:?} {moved}");
    }
}
