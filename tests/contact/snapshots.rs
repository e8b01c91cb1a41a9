//! Snapshots of scenes with contacts and constraints: a run continues bit for bit from the middle of one, identifiers stay what they
//! were, and damaged images are refused.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::shapes::{DistanceGrid, Mesh, Sides};
use superhelix::{
    BodyDef, BodyId, ConstraintDef, ConstraintId, ContactModel, Error, Frame, Friction, Hold, Shape, Solver, SolverOptions,
    StrandContact, StrandDef, StrandId, Workers,
};

const STEP: f64 = 1.0 / 60.0;

fn at(x: f64, y: f64, z: f64) -> Frame {
    Frame { origin: Vector3::new(x, y, z), rotation: UnitQuaternion::identity() }
}

/// An octahedron about the origin, wound outward.
fn octahedron(radius: f64) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
    let vertices = [Vector3::x(), -Vector3::x(), Vector3::y(), -Vector3::y(), Vector3::z(), -Vector3::z()].map(|v| v * radius);
    let triangles = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    (vertices.to_vec(), triangles)
}

struct Scene {
    solver: Solver,
    strands: Vec<StrandId>,
    bodies: Vec<BodyId>,
    constraints: Vec<ConstraintId>,
}

/// Wisps of hair that fall onto bodies of every shape, some of them moving, one of them deforming; some strands are held.
fn scene(workers: Workers, model: ContactModel) -> Scene {
    let mut options = SolverOptions { workers, ..SolverOptions::default() };
    options.contact.model = model;
    options.contact.hair = true;
    let mut solver = Solver::new(options).unwrap();
    // Neighbours that would bend towards each other.
    let defs: Vec<StrandDef> = (0..8)
        .map(|k| {
            let mut def = StrandDef::straight(0.12, 5);
            def.natural = vec![[0.0, 0.0, if k % 2 == 0 { 3.0 } else { -3.0 }]; 5];
            def.initial = Some(vec![[0.0; 3]; 5]);
            def.material.viscosity = 0.01;
            def.material.air_drag = 1e-4;
            def.root = at(0.0, 0.01 * f64::from(k), 0.04);
            def
        })
        .collect();
    let strands = solver.add_strands(&defs).unwrap();
    let contact = StrandContact { wisp_radius: 0.004, exempt_length: 0.01, ..StrandContact::default() };
    solver.set_contact(&strands[..7], Some(&contact)).unwrap();
    let rough = StrandContact { friction: Friction::uniform(0.5), radius: 1e-4, ..contact };
    solver.set_contact(&strands[..1], Some(&rough)).unwrap();

    let (vertices, triangles) = octahedron(0.01);
    let mesh = Mesh::new(vertices.clone(), triangles.clone(), Sides::Solid).unwrap();
    let grid = DistanceGrid::bake(&mesh, 0.002, 0.005).unwrap();
    let sphere = Arc::new(Shape::new_sphere(0.01).unwrap());
    let shapes = [
        (sphere.clone(), at(0.04, 0.0, 0.02)),
        (sphere, at(0.09, 0.0, 0.02)),
        (Arc::new(Shape::new_capsule(-Vector3::y() * 0.03, Vector3::y() * 0.03, 0.005).unwrap()), at(0.06, 0.02, 0.02)),
        (Arc::new(Shape::new_ellipsoid(Vector3::new(0.01, 0.02, 0.005)).unwrap()), at(0.03, 0.01, 0.02)),
        (Arc::new(Shape::new_box(Vector3::repeat(0.008)).unwrap()), at(0.1, 0.01, 0.01)),
        (Arc::new(Shape::new_half_space(Vector3::new(0.1, 0.2, 1.0)).unwrap()), at(0.0, 0.0, -0.03)),
        (Arc::new(Shape::new_hull(&vertices).unwrap()), at(0.08, 0.02, 0.02)),
        (Arc::new(Shape::new_mesh(vertices, triangles, Sides::Solid).unwrap()), at(0.11, 0.02, 0.02)),
        (Arc::new(Shape::new_grid(grid)), at(0.05, 0.01, 0.02)),
    ];
    let mut defs: Vec<BodyDef> = shapes.map(|(shape, pose)| BodyDef { pose, ..BodyDef::new(shape) }).into();
    defs[2].thickness = 1e-3;
    defs[3].friction = 2.0;
    defs[4].mask = 3;
    let bodies = solver.add_bodies(defs).unwrap();
    let hold = |strand: usize, arclength: f64, hold: Hold, target: Frame| ConstraintDef {
        strand: strands[strand],
        arclength,
        hold,
        target,
        compliance: 0.0,
    };
    let friction = Friction { along: 0.1, against: 0.2 };
    let tie = Hold::Tie { other: strands[6], arclength: 0.1 };
    let constraints = solver
        .add_constraints(&[
            hold(3, 0.1, Hold::Point, at(0.095, 0.03, 0.04)),
            hold(4, 0.1, Hold::Direction, at(0.095, 0.04, 0.04)),
            hold(5, 0.1, Hold::Frame, at(0.095, 0.05, 0.04)),
            hold(6, 0.06, Hold::Ring { friction }, at(0.06, 0.06, 0.04)),
            hold(7, 0.1, tie, Frame::default()),
        ])
        .unwrap();
    Scene { solver, strands, bodies, constraints }
}

impl Scene {
    /// One frame of a motion in which everything moves that can.
    fn frame(&mut self, k: usize) {
        let t = k as f64 * STEP;
        let sway = 0.005 * (9.0 * t).sin();
        let roots: Vec<Frame> = (0..8).map(|i| at(0.0, 0.01 * f64::from(i) + sway, 0.04)).collect();
        self.solver.set_root_frames(&self.strands, &roots, STEP).unwrap();
        // Longer than a frame: a snapshot is taken in the middle of the motion.
        if k.is_multiple_of(3) {
            let frame =
                Frame { rotation: UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.0, t)), ..at(0.04 + sway, 0.0, 0.02) };
            self.solver.set_body_frames(&self.bodies[..1], &[frame], 4.0 * STEP).unwrap();
            let (mut vertices, _) = octahedron(0.01);
            for vertex in &mut vertices {
                vertex.z *= 1.0 + 20.0 * sway;
            }
            self.solver.set_body_vertices(self.bodies[7], &vertices, 5.0 * STEP).unwrap();
            self.solver.set_constraint_targets(&self.constraints[..1], &[at(0.095, 0.03 + sway, 0.04)], 4.0 * STEP).unwrap();
        }
        self.solver.step(STEP, 1).unwrap();
    }

    fn hashes(&mut self, frames: std::ops::Range<usize>) -> Vec<u64> {
        frames
            .map(|k| {
                self.frame(k);
                self.solver.state_hash()
            })
            .collect()
    }
}

/// Everything that a host reads.
fn readings(scene: &Scene) -> Vec<u64> {
    let mut bits = Vec::new();
    let mut take = |v: Vector3<f64>| bits.extend(v.iter().map(|x| x.to_bits()));
    for contact in scene.solver.contacts() {
        [contact.position, contact.normal, contact.force, contact.slip].into_iter().for_each(&mut take);
    }
    for id in &scene.bodies {
        let wrench = scene.solver.body_wrench(*id).unwrap();
        [wrench.force, wrench.torque, scene.solver.body(*id).unwrap().pose.origin].into_iter().for_each(&mut take);
    }
    for id in &scene.constraints {
        let state = scene.solver.constraint_state(*id).unwrap();
        [state.force, state.torque, Vector3::new(state.error, state.arclength, 0.0)].into_iter().for_each(&mut take);
    }
    bits
}

#[test]
fn a_run_goes_on_bit_for_bit_from_a_snapshot() {
    for model in [ContactModel::Penalty, ContactModel::Coulomb] {
        let mut first = scene(Workers::Serial, model);
        first.hashes(0..10);
        let touching: usize = first.solver.contacts().len();
        let partners = first.solver.contacts().iter().filter(|c| matches!(c.partner, superhelix::ContactPartner::Strand { .. }));
        assert!(touching > 5 && partners.count() > 0, "{model:?}: {touching} contacts");
        let (image, hash, before) = (first.solver.snapshot(), first.solver.state_hash(), readings(&first));
        let expected = first.hashes(10..16);
        let after = readings(&first);
        assert_ne!(before, after);

        first.solver.restore(&image).unwrap();
        assert_eq!(first.solver.state_hash(), hash);
        assert!(first.solver.snapshot() == image, "the image of what was restored is another");
        assert!(first.solver.contacts().is_empty());
        assert_eq!(first.hashes(10..16), expected, "{model:?}: in the solver itself");
        assert_eq!(readings(&first), after);

        // In another one, on threads; its own bodies and constraints go.
        let mut other = scene(Workers::Pool(2), ContactModel::Coulomb);
        other.hashes(0..2);
        other.solver.restore(&image).unwrap();
        assert_eq!(other.solver.options().contact, first.solver.options().contact);
        let ids = (first.solver.strand_ids(), first.solver.body_ids(), first.solver.constraint_ids());
        (other.strands, other.bodies, other.constraints) =
            (other.solver.strand_ids(), other.solver.body_ids(), other.solver.constraint_ids());
        assert_eq!((other.strands.clone(), other.bodies.clone(), other.constraints.clone()), ids);
        assert_eq!(other.hashes(10..16), expected, "{model:?}: in another solver");
        assert_eq!(readings(&other), after);
        // Shapes that were shared are.
        let shape = |id: BodyId| other.solver.body(id).unwrap().shape.clone();
        assert!(Arc::ptr_eq(&shape(other.bodies[0]), &shape(other.bodies[1])));
    }
}

#[test]
fn identifiers_issued_after_a_snapshot_are_not_issued_again() {
    let mut scene = scene(Workers::Serial, ContactModel::Penalty);
    let image = scene.solver.snapshot();
    let body = || BodyDef::new(Arc::new(Shape::new_sphere(0.01).unwrap()));
    let later = scene.solver.add_bodies(vec![body()]).unwrap()[0];
    let def = scene.solver.constraint(scene.constraints[0]).unwrap();
    let held = scene.solver.add_constraints(&[def]).unwrap()[0];
    scene.solver.remove_bodies(&scene.bodies[..1]).unwrap();
    scene.solver.restore(&image).unwrap();
    assert!(scene.solver.body(later).is_err() && scene.solver.constraint_state(held).is_err());
    assert!(scene.solver.body(scene.bodies[0]).is_ok());
    assert_ne!(scene.solver.add_bodies(vec![body()]).unwrap()[0], later);
    assert_ne!(scene.solver.add_constraints(&[def]).unwrap()[0], held);
}

#[test]
fn damaged_contact_snapshots_are_refused_and_change_nothing() {
    let mut scene = scene(Workers::Serial, ContactModel::Penalty);
    scene.hashes(0..4);
    let (image, hash) = (scene.solver.snapshot(), scene.solver.state_hash());
    let sealed = |body: &[u8]| {
        let mut image = image[..12].to_vec();
        image.extend((body.len() as u64).to_le_bytes());
        image.extend(body);
        let sum = body.iter().fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(*b)).wrapping_mul(0x100_0000_01b3));
        image.extend(sum.to_le_bytes());
        image
    };
    let body = &image[20..image.len() - 8];
    assert_eq!(sealed(body), image);
    // Truncated behind a right checksum.
    for length in (0..body.len()).step_by(37) {
        assert!(matches!(scene.solver.restore(&sealed(&body[..length])), Err(Error::Snapshot { .. })), "{length}");
    }
    // The version before.
    let mut old = image.clone();
    old[8..12].copy_from_slice(&3_u32.to_le_bytes());
    assert!(matches!(scene.solver.restore(&old), Err(Error::Snapshot { reason }) if reason.contains("version 3")));
    // Any number replaced behind a right checksum: refused or merely another scene; never a panic, and a step afterwards is safe.
    let mut refused = 0;
    let values = [u32::MAX, 0x7ff0_0000, 0x8000_0001, 1];
    for (k, place) in (0..body.len() - 4).step_by(4).enumerate() {
        // Half of an image is the search's memory: every seventh word of it is enough.
        if place > 16_000 && k % 7 != 0 {
            continue;
        }
        let mut bad = body.to_vec();
        bad[place..place + 4].copy_from_slice(&values[k % 4].to_le_bytes());
        let mut victim = Solver::new(SolverOptions::default()).unwrap();
        match victim.restore(&sealed(&bad)) {
            Ok(()) => {
                if k % 50 == 0 {
                    let _ = victim.step(1e-3, 1);
                    let _ = victim.snapshot();
                }
            }
            Err(Error::Snapshot { .. }) => refused += 1,
            Err(other) => panic!("at {place}: {other}"),
        }
    }
    println!("{} bytes; {refused} damaged images refused", image.len());
    assert!(refused > 100);
    assert_eq!(scene.solver.state_hash(), hash);
}

#[test]
fn strands_move_on_when_they_are_released() {
    let mut scene = scene(Workers::Serial, ContactModel::Penalty);
    scene.hashes(0..3);
    let mut options = scene.solver.options().contact;
    options.hair = false;
    scene.solver.set_contact_options(&options).unwrap();
    scene.solver.remove_bodies(&scene.bodies.clone()).unwrap();
    scene.solver.remove_constraints(&scene.constraints.clone()).unwrap();
    let before = scene.solver.curvatures(scene.strands[1]).unwrap().to_vec();
    scene.solver.step(STEP, 1).unwrap();
    assert_ne!(scene.solver.curvatures(scene.strands[1]).unwrap(), before);
}

#[test]
fn elements_may_change_while_strands_are_in_contact() {
    let mut scene = scene(Workers::Serial, ContactModel::Penalty);
    scene.hashes(0..4);
    for count in [2, 9] {
        scene.solver.set_element_count(&scene.strands.clone(), count).unwrap();
        scene.hashes(4..6);
    }
    assert!(!scene.solver.contacts().is_empty());
}
