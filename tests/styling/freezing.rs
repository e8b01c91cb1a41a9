use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::internals::math::rotation::from_rotation_vector;
use superhelix::{BodyDef, Frame, Shape, Solver};

use crate::scene::{STEP, apart, points, row};

const WAVY: [[f64; 3]; 10] = [[3.0, 25.0, 5.0]; 10];
const LENGTH: f64 = 0.12;

/// Dragged into a style and frozen, hair stays the same to the bit while its roots rest; and moves with them, to rounding.
#[test]
fn a_frozen_groom_keeps_its_shape() {
    let (mut solver, ids) = row(6, LENGTH, &WAVY);
    for _ in 0..20 {
        solver.step(STEP, 1).unwrap();
    }
    solver.freeze_strands(&ids).unwrap();
    assert!(solver.are_frozen(&ids).unwrap().iter().all(|frozen| *frozen));
    let before: Vec<_> = ids.iter().map(|id| points(&solver, *id, 30)).collect();
    for _ in 0..200 {
        let report = solver.step(STEP, 1).unwrap();
        assert_eq!(report.max_iterations, 0);
    }
    for (id, before) in ids.iter().zip(&before) {
        assert_eq!(&points(&solver, *id, 30), before);
    }
    // A head that turns and goes.
    let roots: Vec<Frame> = ids.iter().map(|id| solver.root_frame(*id).unwrap()).collect();
    let head = |t: f64| Frame {
        origin: Vector3::new(0.1 * (4.0 * t).sin(), 0.0, 0.02 * t),
        rotation: from_rotation_vector(Vector3::new(0.0, 0.3, 0.8) * (3.0 * t).sin()),
    };
    for step in 1..=200 {
        let now = head(f64::from(step) * STEP);
        let frames: Vec<Frame> = roots.iter().map(|root| now.compose(root)).collect();
        solver.set_root_frames(&ids, &frames, STEP).unwrap();
        solver.step(STEP, 1).unwrap();
    }
    let now = head(200.0 * STEP);
    for (id, before) in ids.iter().zip(&before) {
        let carried: Vec<Vector3<f64>> = before.iter().map(|point| now.origin + now.rotation * point).collect();
        assert!(apart(&points(&solver, *id, 30), &carried) < 1e-9 * LENGTH);
        let velocity = solver.status(*id).unwrap();
        assert_eq!(velocity, superhelix::StrandStatus::Ok);
    }
}

/// Woken and left alone it stands as it stood, to 1e-7 of its length.
#[test]
fn awake_and_without_contact_it_stands() {
    let (mut solver, ids) = row(6, LENGTH, &WAVY);
    // Not at rest: blown aside, frozen in the middle of it.
    solver.set_wind(Vector3::new(0.5, 0.2, 0.0)).unwrap();
    for _ in 0..40 {
        solver.step(STEP, 1).unwrap();
    }
    solver.set_wind(Vector3::zeros()).unwrap();
    solver.freeze_strands(&ids).unwrap();
    let stable = solver.shape_stability(&ids).unwrap();
    let before: Vec<_> = ids.iter().map(|id| points(&solver, *id, 30)).collect();
    solver.wake_strands(&ids).unwrap();
    for _ in 0..600 {
        solver.step(STEP, 1).unwrap();
    }
    for ((id, before), stable) in ids.iter().zip(&before).zip(&stable) {
        assert!(stable.smallest_eigenvalue > 0.0);
        let moved = apart(&points(&solver, *id, 30), before);
        assert!(moved < 1e-7 * LENGTH, "{moved:e}");
    }
}

fn finger(x: f64) -> BodyDef {
    let shape = Shape::new_capsule(Vector3::y() * -0.05, Vector3::y() * 0.05, 4e-3).unwrap();
    let pose = Frame { origin: Vector3::new(x, 0.0, -0.06), rotation: UnitQuaternion::identity() };
    BodyDef { pose, ..BodyDef::new(Arc::new(shape)) }
}

/// A finger wakes the strands that it approaches, one after the other, before contact, however far it moves in a step; the others stay asleep.
#[test]
fn a_contact_wakes() {
    for speed in [0.1, 0.5, 3.0] {
        let (mut solver, ids) = row(6, LENGTH, &WAVY);
        solver.freeze_strands(&ids).unwrap();
        let body = solver.add_bodies(vec![finger(-0.06)]).unwrap();
        let mut x = -0.06;
        while x < 0.0 {
            let was = solver.are_frozen(&ids).unwrap();
            let before: Vec<_> = ids.iter().map(|id| points(&solver, *id, 100)).collect();
            let from = x;
            x = (x + speed * STEP).min(0.0);
            let frame = Frame { origin: Vector3::new(x, 0.0, -0.06), ..Frame::default() };
            solver.set_body_frames(&body, &[frame], STEP).unwrap();
            solver.step(STEP, 1).unwrap();
            for (k, frozen) in solver.are_frozen(&ids).unwrap().into_iter().enumerate() {
                // Where the finger has swept nothing is frozen; what it has not come within 3 mm of is as it was.
                let axis = |point: &Vector3<f64>| {
                    let near = point.x.clamp(from, x);
                    ((point.x - near).powi(2) + (point.z + 0.06).powi(2)).sqrt() - 4e-3
                };
                let gap = before[k].iter().map(axis).fold(f64::INFINITY, f64::min);
                if was[k] && gap > 3e-3 {
                    assert!(frozen, "{speed} strand {k} woke {gap} m from the finger");
                }
                if was[k] && gap < 1e-4 {
                    assert!(!frozen, "{speed} strand {k} sleeps {gap} m from the finger");
                }
            }
        }
        let frozen = solver.are_frozen(&ids).unwrap();
        assert!(frozen.iter().any(|frozen| *frozen) && frozen.iter().any(|frozen| !frozen), "{frozen:?}");
        let report = solver.step(STEP, 1).unwrap();
        assert!(report.contact.penetration < 2e-4, "{report:?}");
    }
}

/// What lay on the hair when it was frozen does not wake it, also when both go along with a head; only coming nearer does.
#[test]
fn what_lies_there_does_not_wake_it() {
    let (mut solver, ids) = row(1, LENGTH, &WAVY);
    let at = points(&solver, ids[0], 11)[6];
    let shape = Arc::new(Shape::new_sphere(0.01).unwrap());
    let ball = |way: f64| Frame { origin: at + Vector3::x() * (0.0101 - way), ..Frame::default() };
    let body = solver.add_bodies(vec![BodyDef { pose: ball(0.0), ..BodyDef::new(shape) }]).unwrap();
    for _ in 0..60 {
        solver.step(STEP, 1).unwrap();
    }
    solver.freeze_strands(&ids).unwrap();
    let root = solver.root_frame(ids[0]).unwrap();
    let ball_then = solver.body(body[0]).unwrap().pose;
    for step in 1..=120 {
        let head = Frame {
            origin: Vector3::z() * 1e-3 * f64::from(step),
            rotation: from_rotation_vector(Vector3::new(0.2, 0.5, 0.9) * (0.02 * f64::from(step))),
        };
        solver.set_root_frames(&ids, &[head.compose(&root)], STEP).unwrap();
        solver.set_body_frames(&body, &[head.compose(&ball_then)], STEP).unwrap();
        solver.step(STEP, 1).unwrap();
    }
    let frozen = solver.are_frozen(&ids).unwrap();
    let pose = solver.body(body[0]).unwrap().pose;
    let nearer = Frame { origin: pose.origin - pose.rotation * Vector3::x() * 1e-3, ..pose };
    solver.set_body_frames(&body, &[nearer], STEP).unwrap();
    solver.step(STEP, 1).unwrap();
    assert_eq!((frozen[0], solver.are_frozen(&ids).unwrap()[0]), (true, false));
}

/// A snapshot has them: restored, they sleep, and go on by the same bits.
#[test]
fn snapshots_keep_frozen_strands() {
    let (mut solver, ids) = row(4, LENGTH, &WAVY);
    let body = solver.add_bodies(vec![finger(-0.03)]).unwrap();
    solver.freeze_strands(&ids).unwrap();
    solver.step(STEP, 1).unwrap();
    let image = solver.snapshot();
    let go = |solver: &mut Solver| {
        let frame = Frame { origin: Vector3::new(0.0, 0.0, -0.06), ..Frame::default() };
        solver.set_body_frames(&body, &[frame], 0.2).unwrap();
        for _ in 0..40 {
            solver.step(STEP, 1).unwrap();
        }
        (solver.are_frozen(&ids).unwrap(), ids.iter().map(|id| points(solver, *id, 10)).collect::<Vec<_>>())
    };
    let first = go(&mut solver);
    solver.restore(&image).unwrap();
    assert!(solver.are_frozen(&ids).unwrap().iter().all(|frozen| *frozen));
    assert_eq!(go(&mut solver), first);
    assert!(first.0.iter().any(|frozen| !frozen));
}

/// A constraint wakes what it holds.
#[test]
fn a_constraint_wakes() {
    let (mut solver, ids) = row(2, LENGTH, &WAVY);
    solver.freeze_strands(&ids).unwrap();
    let tip = points(&solver, ids[0], 2)[1];
    let def = superhelix::ConstraintDef {
        strand: ids[0],
        arclength: LENGTH,
        hold: superhelix::Hold::Point,
        target: Frame { origin: tip, ..Frame::default() },
        compliance: 0.0,
    };
    solver.add_constraints(&[def]).unwrap();
    solver.step(STEP, 1).unwrap();
    assert_eq!(solver.are_frozen(&ids).unwrap(), [false, true]);
    // So does a shape given by hand; scissors do not.
    solver.cut(&ids[1..], &[0.1]).unwrap();
    assert!(solver.are_frozen(&ids).unwrap()[1]);
    solver.reset_strands(&ids[1..]).unwrap();
    assert!(!solver.are_frozen(&ids).unwrap()[1]);
}

/// A thousand frozen strands on a head cost less than a fiftieth of the same awake.
#[test]
fn frozen_strands_cost_next_to_nothing() {
    let (mut solver, _) = row(0, LENGTH, &WAVY);
    let defs: Vec<_> = (0..1000)
        .map(|k| {
            crate::scene::hanging(
                Vector3::new(4e-3 * f64::from(k % 32), 4e-3 * f64::from(k / 32), 0.0),
                f64::from(k),
                LENGTH,
                &WAVY,
            )
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    solver.set_contact(&ids, Some(&Default::default())).unwrap();
    let head = Shape::new_sphere(0.1).unwrap();
    let pose = Frame { origin: Vector3::new(0.06, 0.06, 0.101), ..Frame::default() };
    solver.add_bodies(vec![BodyDef { pose, ..BodyDef::new(Arc::new(head)) }]).unwrap();
    for _ in 0..10 {
        let report = solver.step(STEP, 1).unwrap();
        assert!(report.mean_iterations >= 1.0, "awake: {report:?}");
    }
    solver.freeze_strands(&ids).unwrap();
    for _ in 0..10 {
        let report = solver.step(STEP, 1).unwrap();
        assert_eq!((report.mean_iterations, report.work, report.contact.contacts), (0.0, 0, 0), "frozen: {report:?}");
    }
}
