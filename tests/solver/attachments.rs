//! Rigid attachments: roots, bodies and targets go where a rigid carrier takes them, by one call; what was removed in the meantime is named and nothing
//! moves. And the numbers that hosts give to bodies and constraints.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{BodyDef, BodyId, ConstraintDef, ConstraintId, Frame, Hold, Shape, Solver, SolverOptions, StrandDef, StrandId};

struct Head {
    solver: Solver,
    strands: Vec<StrandId>,
    bodies: Vec<BodyId>,
    pins: Vec<ConstraintId>,
}

fn head() -> Head {
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let defs: Vec<StrandDef> = (0..7)
        .map(|k| {
            let mut def = StrandDef::straight(0.1, 4);
            let turn = UnitQuaternion::from_euler_angles(0.3 * f64::from(k), 0.1, -0.2 * f64::from(k));
            def.root = Frame { origin: turn * Vector3::new(0.1, 0.0, 0.02), rotation: turn };
            def
        })
        .collect();
    let strands = solver.add_strands(&defs).unwrap();
    let mut skull = BodyDef::new(Arc::new(Shape::new_sphere(0.09).unwrap()));
    skull.pose = Frame { origin: Vector3::new(0.01, -0.02, 0.0), rotation: UnitQuaternion::from_euler_angles(0.5, 0.0, 0.1) };
    let bodies = solver.add_bodies(vec![skull]).unwrap();
    let tip = solver.root_frame(strands[0]).unwrap();
    let target = Frame { origin: tip.origin + tip.rotation * Vector3::new(0.099, 0.0, 0.0), rotation: tip.rotation };
    let pin = ConstraintDef { strand: strands[0], arclength: 0.1, hold: Hold::Point, target, compliance: 0.0 };
    let pins = solver.add_constraints(&[pin]).unwrap();
    Head { solver, strands, bodies, pins }
}

impl Head {
    fn frames(&self) -> Vec<Frame> {
        let roots = self.strands.iter().map(|id| self.solver.root_frame(*id).unwrap());
        let bodies = self.bodies.iter().map(|id| self.solver.body(*id).unwrap().pose);
        roots.chain(bodies).chain(self.pins.iter().map(|id| self.solver.constraint(*id).unwrap().target)).collect()
    }
}

fn apart(a: &Frame, b: &Frame) -> f64 {
    (a.origin - b.origin).norm().max(a.rotation.angle_to(&b.rotation))
}

#[test]
fn all_that_is_attached_goes_along_with_its_carrier() {
    let mut head = head();
    let start = head.frames();
    let pose = Frame { origin: Vector3::new(0.3, 0.1, 1.5), rotation: UnitQuaternion::from_euler_angles(0.2, -0.4, 1.0) };
    let attachment = head.solver.attach(&pose, &head.strands, &head.bodies, &head.pins).unwrap();
    let (mut to, dt) = (pose, 1.0 / 60.0);
    // Nothing drifts, however often it moves.
    for step in 1..=40 {
        let t = dt * f64::from(step);
        to = Frame {
            origin: pose.origin + Vector3::new(0.05 * t, 0.0, 0.02 * t * t),
            rotation: UnitQuaternion::from_euler_angles(0.3 * t, 0.0, 0.5 * t) * pose.rotation,
        };
        head.solver.move_attached(&attachment, &to, dt).unwrap();
        head.solver.step(dt, 2).unwrap();
        for (now, start) in head.frames().iter().zip(&start) {
            assert!(apart(now, &start.carried(&pose, &to)) < 1e-12, "step {step}");
        }
    }
    head.solver.teleport_attached(&attachment, &pose).unwrap();
    head.solver.step(dt, 1).unwrap();
    for (now, start) in head.frames().iter().zip(&start) {
        assert!(apart(now, start) < 1e-12);
    }
    assert!(apart(&to, &pose) > 0.1, "it had gone somewhere");
}

#[test]
fn removed_things_are_named_and_nothing_moves() {
    let mut head = head();
    let pose = Frame::default();
    let attachment = head.solver.attach(&pose, &head.strands, &head.bodies, &head.pins).unwrap();
    let image = head.solver.snapshot();
    head.solver.remove_strands(&head.strands[3..4]).unwrap();
    let hash = head.solver.state_hash();
    let to = Frame { origin: Vector3::new(1.0, 0.0, 0.0), ..pose };
    let error = head.solver.move_attached(&attachment, &to, 0.1).unwrap_err();
    assert!(error.to_string().contains("strands[3]"), "{error}");
    assert!(head.solver.teleport_attached(&attachment, &to).is_err());
    assert!(head.solver.move_attached(&attachment, &to, f64::NAN).is_err());
    assert_eq!(head.solver.state_hash(), hash);
    assert!(head.solver.attach(&pose, &head.strands, &[], &[]).unwrap_err().to_string().contains("strands[3]"));
    // A snapshot makes the identifiers valid again, and the attachment with them.
    head.solver.restore(&image).unwrap();
    head.solver.move_attached(&attachment, &to, 0.0).unwrap();
    head.solver.step(0.01, 1).unwrap();
    assert!((head.solver.body(head.bodies[0]).unwrap().pose.origin.x - 1.01).abs() < 1e-12);
}

#[test]
fn hosts_numbers_stay_with_bodies_and_constraints() {
    let mut head = head();
    let hash = head.solver.state_hash();
    assert_eq!((head.solver.body_user_data(head.bodies[0]), head.solver.constraint_user_data(head.pins[0])), (Ok(0), Ok(0)));
    head.solver.set_body_user_data(head.bodies[0], u64::MAX).unwrap();
    head.solver.set_constraint_user_data(head.pins[0], 7).unwrap();
    assert_eq!(head.solver.state_hash(), hash, "no step depends on them");
    let mut other = Solver::new(SolverOptions::default()).unwrap();
    other.restore(&head.solver.snapshot()).unwrap();
    assert_eq!((other.body_user_data(head.bodies[0]), other.constraint_user_data(head.pins[0])), (Ok(u64::MAX), Ok(7)));
    head.solver.remove_bodies(&head.bodies).unwrap();
    assert!(head.solver.body_user_data(head.bodies[0]).is_err());
}
