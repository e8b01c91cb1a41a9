//! Roots in bodies, without exempt lengths: the host places the root, and no force moves it. It is reported, and the rest of the strand is
//! solved as if it were not there.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::PermittedOverlap;
use superhelix::shapes::Sides;
use superhelix::{
    BodyDef, BodyId, ContactModel, Frame, Shape, Solver, SolverOptions, StepReport, StrandContact, StrandDef, StrandId,
};

use super::random_bodies::{Dice, bumpy};

const MODELS: [ContactModel; 3] = [ContactModel::Penalty, ContactModel::RegularisedPenalty, ContactModel::Coulomb];
const RADIUS: f64 = 50e-6;

/// A limp strand of a decimetre over the plane z = 0, its root at `height` and turned up from it by `rise` (rad).
fn scene(model: ContactModel, height: f64, rise: f64, contact: StrandContact) -> (Solver, StrandId, BodyId, f64) {
    let mut options = SolverOptions { gravity: Vector3::new(0.0, 0.0, -9.81), ..SolverOptions::default() };
    // A root counts as inside from this on.
    (options.contact.model, options.contact.tolerance) = (model, 1e-5);
    let mut solver = Solver::new(options).unwrap();
    let mut def = StrandDef::straight(0.1, 10);
    def.material.air_drag = 1e-4;
    let rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -rise);
    def.root = Frame { origin: Vector3::new(0.0, 0.0, height), rotation };
    let weight = 9.81 * def.material.linear_density() * def.length();
    let id = solver.add_strands(&[def]).unwrap()[0];
    let floor = solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_half_space(Vector3::z()).unwrap()))]).unwrap()[0];
    solver.set_contact(&[id], Some(&contact)).unwrap();
    (solver, id, floor, weight)
}

fn steps(solver: &mut Solver, count: u32) -> Vec<StepReport> {
    (0..count).map(|_| solver.step(1.0 / 60.0, 1).unwrap()).collect()
}

/// A strand that stands on a scalp: its root 30 µm over it, nearer than it is thick. As a contact that was to hold it made every step of the hard
/// models unconverged.
#[test]
fn a_root_on_the_surface_is_reported_and_does_not_affect_the_strand() {
    for model in MODELS {
        let (mut solver, id, floor, weight) = scene(model, 30e-6, 1.5, StrandContact::default());
        for (step, report) in steps(&mut solver, 30).iter().enumerate() {
            let contact = report.contact;
            assert_eq!((report.unconverged, contact.unconverged, contact.contacts), (0, 0, 0), "{model:?} {step}: {report:?}");
            assert_eq!(contact.roots_inside, 1, "{model:?} {step}: {report:?}");
            assert!((contact.penetration - (RADIUS - 30e-6)).abs() < 1e-12, "{model:?} {step}: {report:?}");
        }
        assert_eq!(solver.body_wrench(floor).unwrap().force, Vector3::zeros());
        // The same strand where there is no body.
        let (mut free, other, floor, _) = scene(model, 30e-6, 1.5, StrandContact::default());
        free.remove_bodies(&[floor]).unwrap();
        steps(&mut free, 30);
        let force = |solver: &Solver, id| solver.root_wrench(id).unwrap().force;
        let off = (force(&solver, id) - force(&free, other)).norm();
        assert!(off < 0.05 * weight, "{model:?}: {off:e} of {weight:e}");
    }
}

/// A millimetre deep, upright and slanting: reported with its depth, and no force acts on the body.
#[test]
fn a_root_deep_in_a_body_is_reported() {
    for model in MODELS {
        for rise in [1.5, 0.5] {
            let (mut solver, _, floor, _) = scene(model, -1e-3, rise, StrandContact::default());
            let report = steps(&mut solver, 5)[4];
            assert_eq!((report.contact.roots_inside, report.contact.unconverged), (1, 0), "{model:?} {rise}: {report:?}");
            assert!((report.contact.penetration - (1e-3 + RADIUS)).abs() < 1e-12, "{model:?} {rise}: {report:?}");
            assert_eq!(solver.body_wrench(floor).unwrap().force, Vector3::zeros());
        }
    }
}

/// With contact at points, too; exempt, it is not. The strand leaves the floor at once, so that nothing else of it is as deep.
#[test]
fn contact_at_points_reports_a_root_in_a_body() {
    for (height, rise) in [(30e-6, 1.5), (-1e-3, 1.5)] {
        for (exempt_length, inside) in [(0.0, 1), (0.01, 0)] {
            let contact = StrandContact { exempt_length, ..StrandContact::default() };
            let (mut solver, ..) = scene(ContactModel::AtPoints, height, rise, contact);
            for report in steps(&mut solver, 5) {
                let contact = report.contact;
                assert_eq!((contact.roots_inside, report.unconverged), (inside, 0), "{height} {exempt_length}: {report:?}");
                let depth = if inside == 1 { RADIUS - height } else { 0.0 };
                assert!((contact.penetration - depth).abs() < 1e-12, "{height} {exempt_length}: {report:?}");
            }
        }
    }
    // Nor is it one that a permitted overlap allows for, or one out of all reach.
    for height in [51e-6, 0.5] {
        let (mut solver, ..) = scene(ContactModel::AtPoints, height, 1.5, StrandContact::default());
        assert!(steps(&mut solver, 2).iter().all(|report| report.contact.roots_inside == 0), "{height}");
    }
    let (mut solver, id, ..) = scene(ContactModel::AtPoints, -1e-3, 1.5, StrandContact::default());
    let overlap = PermittedOverlap { along: vec![0.0], wisp_fractions: vec![1.0], sunk: vec![2e-3] };
    solver.set_permitted_overlaps(&[id], &[Some(overlap)]).unwrap();
    assert!(steps(&mut solver, 2).iter().all(|report| report.contact.roots_inside == 0));
}

/// Roots exactly on the surface, which the defaults put as deep as the tolerance: they are not inside, however rounding has it while the head turns.
#[test]
fn a_root_on_the_surface_is_not_inside_by_the_defaults() {
    for model in [ContactModel::Coulomb, ContactModel::AtPoints] {
        let mut options = SolverOptions::default();
        options.contact.model = model;
        let mut solver = Solver::new(options).unwrap();
        let head = solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_sphere(0.1).unwrap()))]).unwrap()[0];
        let mut def = StrandDef::straight(0.1, 8);
        let roots: Vec<Frame> = (0..40)
            .map(|k| {
                let turn = UnitQuaternion::from_euler_angles(0.3, -0.1 - 0.05 * f64::from(k), 0.7 * f64::from(k));
                Frame { origin: turn * Vector3::x() * 0.1, rotation: turn }
            })
            .collect();
        let ids: Vec<StrandId> = roots
            .iter()
            .map(|root| {
                def.root = *root;
                solver.add_strands(&[def.clone()]).unwrap()[0]
            })
            .collect();
        solver.set_contact(&ids, Some(&StrandContact::default())).unwrap();
        for step in 1..=40 {
            let rotation = UnitQuaternion::from_euler_angles(0.0, 0.0007 * f64::from(step), 0.0006 * f64::from(step));
            let pose = Frame { origin: Vector3::new(0.1, 0.2, 0.3) * 1e-3 * f64::from(step), rotation };
            let turned: Vec<Frame> = roots.iter().map(|root| pose.compose(root)).collect();
            solver.set_root_frames(&ids, &turned, 1.0 / 60.0).unwrap();
            solver.set_body_frames(&[head], &[pose], 1.0 / 60.0).unwrap();
            assert_eq!(solver.step(1.0 / 60.0, 1).unwrap().contact.roots_inside, 0, "{model:?} {step}");
        }
    }
}

/// Hair that grows on a mesh, exactly on its triangles, falls down and is shaken: by the defaults every step converges, though the first tenths
/// of a millimetre of a strand are as deep as the tolerance, and bent skin brings them deeper.
#[test]
fn hair_that_grows_on_a_mesh_converges_by_the_defaults() {
    let (vertices, triangles) = bumpy(0.1, 4);
    let shape = Arc::new(Shape::new_mesh(vertices, triangles, Sides::Solid).unwrap());
    let options = SolverOptions { gravity: Vector3::new(0.0, 0.0, -9.81), ..SolverOptions::default() };
    let mut solver = Solver::new(options).unwrap();
    let head = solver.add_bodies(vec![BodyDef::new(shape.clone())]).unwrap()[0];
    let mut dice = Dice(3);
    let mut def = StrandDef::straight(0.12, 8);
    (def.material.internal_friction, def.material.air_drag) = (5e-10, 1e-5);
    let roots: Vec<Frame> = (0..150)
        .map(|_| {
            let surface = shape.closest(dice.direction() * 0.1, f64::INFINITY).unwrap();
            let lean = surface.normal + 0.9 * dice.direction();
            let rotation = UnitQuaternion::rotation_between(&Vector3::x(), &lean).unwrap();
            Frame { origin: surface.point, rotation }
        })
        .collect();
    let defs: Vec<StrandDef> = roots.iter().map(|root| StrandDef { root: *root, ..def.clone() }).collect();
    let ids = solver.add_strands(&defs).unwrap();
    solver.set_contact(&ids, Some(&StrandContact::default())).unwrap();
    let (mut unconverged, mut contacts) = (0, 0);
    for step in 0..60 {
        let t = f64::from(step + 1) / 60.0;
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.3 * (6.0 * (t - 0.5).max(0.0)).sin());
        let pose = Frame { origin: Vector3::zeros(), rotation: turn };
        let turned: Vec<Frame> = roots.iter().map(|root| pose.compose(root)).collect();
        solver.set_root_frames(&ids, &turned, 1.0 / 60.0).unwrap();
        solver.set_body_frames(&[head], &[pose], 1.0 / 60.0).unwrap();
        let report = solver.step(1.0 / 60.0, 1).unwrap();
        unconverged += report.unconverged + report.contact.unconverged;
        contacts += report.contact.contacts;
    }
    println!("{unconverged} unconverged of {}, {contacts} contacts", 60 * ids.len());
    assert!(contacts > 1000, "{contacts}");
    assert_eq!(unconverged, 0);
}

/// Side by side, too: of ten strands those three whose roots are in the floor.
#[test]
fn contact_at_points_counts_roots_in_a_body() {
    let (mut solver, first, ..) = scene(ContactModel::AtPoints, 0.01, 1.5, StrandContact::default());
    let mut def = StrandDef::straight(0.1, 10);
    let ids: Vec<StrandId> = (1..10)
        .map(|k| {
            let height = if k % 3 == 0 { -1e-4 } else { 0.01 };
            let rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -1.5);
            def.root = Frame { origin: Vector3::new(0.0, 0.02 * f64::from(k), height), rotation };
            solver.add_strands(&[def.clone()]).unwrap()[0]
        })
        .collect();
    solver.set_contact(&ids, Some(&StrandContact::default())).unwrap();
    for report in steps(&mut solver, 3) {
        assert_eq!(report.contact.roots_inside, 3, "{report:?}");
        assert!((report.contact.penetration - (1e-4 + RADIUS)).abs() < 1e-12, "{report:?}");
    }
    let down = Frame { origin: Vector3::new(0.0, 0.0, -1e-4), rotation: def.root.rotation };
    solver.set_root_frames(&[first], &[down], 1.0 / 60.0).unwrap();
    assert_eq!(steps(&mut solver, 1)[0].contact.roots_inside, 4);
}

/// In a mesh, however deep, by every model.
#[test]
fn a_root_in_a_mesh_is_reported() {
    let corners = [[-0.2, -0.1, 0.0], [0.2, -0.1, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, -0.2]].map(Vector3::from);
    let mesh = Shape::new_mesh(corners.to_vec(), vec![[0, 1, 2], [1, 0, 3], [2, 1, 3], [0, 2, 3]], Sides::Solid).unwrap();
    let mesh = Arc::new(mesh);
    for model in MODELS.into_iter().chain([ContactModel::AtPoints]) {
        for height in [-1e-3, -8e-3, -0.02] {
            let (mut solver, _, floor, _) = scene(model, height, 1.5, StrandContact::default());
            solver.remove_bodies(&[floor]).unwrap();
            solver.add_bodies(vec![BodyDef::new(mesh.clone())]).unwrap();
            let contact = steps(&mut solver, 2)[1].contact;
            assert_eq!(contact.roots_inside, 1, "{model:?} {height}: {contact:?}");
            assert!((contact.penetration - (RADIUS - height)).abs() < 1e-12, "{model:?} {height}: {contact:?}");
        }
    }
}

/// What lies on a floor with its root at the floor's height is borne by it, and converges: the root made the second attempt of every step, in
/// which nothing rubs.
#[test]
fn strands_on_a_body_converge_though_their_roots_are_in_it() {
    {
        let model = ContactModel::Coulomb;
        let (mut solver, id, floor, weight) = scene(model, 30e-6, 0.0, StrandContact::default());
        let reports = steps(&mut solver, 240);
        let unconverged: u32 = reports.iter().map(|report| report.contact.unconverged).sum();
        let (floor, follicle) = (solver.body_wrench(floor).unwrap().force.z, solver.root_wrench(id).unwrap().force.z);
        println!("{model:?}: {unconverged} unconverged, floor {floor:e}, follicle {follicle:e}, weight {weight:e}");
        assert_eq!(unconverged, 0, "{model:?}");
        assert!(reports.iter().all(|report| report.contact.roots_inside == 1), "{model:?}");
        // The follicle draws down, since the first element is bent up to the surface: by 20 µm.
        assert!((floor + follicle + weight).abs() < 1e-2 * weight, "{model:?}");
        assert!(-floor > 0.8 * weight, "{model:?}: {floor:e} of {weight:e}");
    }
}

/// If the first part of a strand is exempt, or may be that deep, nothing is reported; nor for a root within the contact tolerance.
#[test]
fn permitted_roots_are_not_reported() {
    for model in MODELS {
        let exempt = StrandContact { exempt_length: 2e-3, ..StrandContact::default() };
        let (mut solver, ..) = scene(model, -1e-3, 1.5, exempt);
        let contact = steps(&mut solver, 2)[1].contact;
        assert_eq!((contact.roots_inside, contact.unconverged, contact.penetration), (0, 0, 0.0), "{model:?}");
        let (mut solver, ..) = scene(model, RADIUS - 5e-6, 1.5, StrandContact::default());
        let contact = steps(&mut solver, 2)[1].contact;
        assert_eq!((contact.roots_inside, contact.unconverged), (0, 0), "{model:?}");
        let (mut solver, id, ..) = scene(model, -1e-3, 1.5, StrandContact::default());
        let sunk = PermittedOverlap { along: vec![0.0, 0.01], wisp_fractions: vec![1.0; 2], sunk: vec![2e-3; 2] };
        solver.set_permitted_overlaps(&[id], &[Some(sunk)]).unwrap();
        assert_eq!(steps(&mut solver, 2)[1].contact.roots_inside, 0, "{model:?}");
    }
}
