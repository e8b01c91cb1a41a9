//! Contact against theory: statics and Coulomb's law for strands on bodies.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{BodyDef, ContactModel, Frame, Friction, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId};

const GRAVITY: f64 = 9.81;

pub(super) fn solver(model: ContactModel, gravity: Vector3<f64>) -> Solver {
    let mut options = SolverOptions { gravity, ..SolverOptions::default() };
    options.contact.model = model;
    Solver::new(options).unwrap()
}

/// A limp strand of 20 cm along x whose surface lies on the plane z = 0.
pub(super) fn lying(elements: usize) -> StrandDef {
    let mut def = StrandDef::straight(0.2, elements);
    def.material.youngs_modulus = 1e6;
    def.root = Frame { origin: Vector3::new(0.0, 0.0, def.material.radius[0]), rotation: UnitQuaternion::identity() };
    def
}

pub(super) fn floor() -> BodyDef {
    BodyDef::new(Arc::new(Shape::new_half_space(Vector3::z()).unwrap()))
}

pub(super) fn tip(solver: &Solver, id: StrandId, length: f64) -> Vector3<f64> {
    let mut at = Vector3::zeros();
    solver.sample_at(id, &[length], |_, sample| at = sample.position).unwrap();
    at
}

#[test]
fn contacts_bear_the_weight_of_a_resting_strand() {
    for model in [ContactModel::Penalty, ContactModel::RegularisedPenalty, ContactModel::Coulomb] {
        let mut solver = solver(model, Vector3::new(0.0, 0.0, -GRAVITY));
        let def = lying(10);
        let weight = def.material.linear_density() * def.length() * GRAVITY;
        let id = solver.add_strands(&[def]).unwrap()[0];
        let floor = solver.add_bodies(vec![floor()]).unwrap()[0];
        solver.set_contact(&[id], Some(&StrandContact::default())).unwrap();
        let mut report = Default::default();
        for _ in 0..600 {
            report = solver.step(1.0 / 60.0, 1).unwrap();
        }
        let contacts: Vector3<f64> = solver.contacts().iter().map(|contact| contact.force).sum();
        let wrench = solver.body_wrench(floor).unwrap();
        let root = solver.root_wrench(id).unwrap();
        println!(
            "{model:?}: {} contacts bear {:?} of {weight:e}, root {:?}, {report:?}",
            solver.contacts().len(),
            contacts,
            root.force
        );
        assert!((contacts + wrench.force).norm() < 1e-15);
        // The penalty models are iterated to 2e-3 rad, and still swing a little; Coulomb's law is solved to a ten-thousandth of a weight.
        let allowed = if model == ContactModel::Coulomb { 1e-4 } else { 3e-3 };
        assert!((contacts - root.force - Vector3::new(0.0, 0.0, weight)).norm() < allowed * weight);
    }
}

#[test]
fn few_iterations_of_a_penalty_reach_the_same_rest() {
    let rest = |iterations: u32| {
        let mut options = SolverOptions { gravity: Vector3::new(0.0, 0.0, -GRAVITY), ..SolverOptions::default() };
        (options.contact.model, options.contact.max_iterations) = (ContactModel::Penalty, iterations);
        let mut solver = Solver::new(options).unwrap();
        // From two centimetres above the floor.
        let mut def = lying(10);
        def.root.origin.z = 0.02;
        let (weight, length) = (def.material.linear_density() * def.length() * GRAVITY, def.length());
        let id = solver.add_strands(&[def]).unwrap()[0];
        solver.add_bodies(vec![floor()]).unwrap();
        solver.set_contact(&[id], Some(&StrandContact::default())).unwrap();
        let mut energy = f64::INFINITY;
        for step in 0..600 {
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            assert!(report.contact.iterations <= iterations, "step {step}: {report:?}");
            assert_eq!(report.quarantined, 0, "step {step}");
            let now = report.energies.kinetic + report.energies.elastic + report.energies.gravity;
            assert!(now <= energy + 0.01 * weight * length, "step {step}: energy rose from {energy:e} to {now:e}");
            energy = energy.min(now);
        }
        let contacts: Vector3<f64> = solver.contacts().iter().map(|contact| contact.force).sum();
        let root = solver.root_wrench(id).unwrap().force;
        // Iterated to 2e-3 rad at best, a limp strand goes on trembling by this much.
        let off = (contacts.z - root.z) / weight - 1.0;
        println!("{iterations} iterations: weight off by {off:e}");
        assert!(off.abs() < 0.05);
        tip(&solver, id, length).z
    };
    let (long, short) = (rest(50), [rest(1), rest(2), rest(4)]);
    println!("{:?}", short.map(|tip| tip - long));
    // A hundredth of a millimetre: the springs yield by a tenth of it.
    assert!(short.iter().all(|tip| (tip - long).abs() < 1e-5));
}

/// Sixteen strands clamped level lie over smooth cylinders for ten seconds: the forces on these, N, and the deepest overlap, m.
fn over_cylinders(model: ContactModel, max_iterations: u32) -> (Vec<f64>, f64) {
    let mut options = SolverOptions { gravity: Vector3::new(0.0, 0.0, -GRAVITY), ..SolverOptions::default() };
    (options.contact.model, options.contact.max_iterations) = (model, max_iterations);
    let mut solver = Solver::new(options).unwrap();
    let none = Friction::uniform(0.0);
    let smooth = StrandContact { friction: none, viscous_friction: none, ..StrandContact::default() };
    let cylinder = Arc::new(Shape::new_capsule(Vector3::y() * -0.02, Vector3::y() * 0.02, 0.01).unwrap());
    let mut cylinders = Vec::new();
    for k in (0..16).map(f64::from) {
        let mut def = StrandDef::straight(0.1, 8);
        (def.material.viscosity, def.material.air_drag, def.root.origin.y) = (0.05, 3e-4, 0.1 * k);
        let id = solver.add_strands(&[def]).unwrap();
        solver.set_contact(&id, Some(&smooth)).unwrap();
        let mut body = BodyDef::new(cylinder.clone());
        body.pose.origin = Vector3::new(0.03 + 2e-3 * k, 0.1 * k, -0.012 - 4e-4 * k);
        cylinders.extend(solver.add_bodies(vec![body]).unwrap());
    }
    let mut deepest = 0.0;
    for _ in 0..600 {
        deepest = solver.step(1.0 / 60.0, 1).unwrap().contact.penetration;
    }
    (cylinders.iter().map(|id| solver.body_wrench(*id).unwrap().force.norm()).collect(), deepest)
}

/// Contact problems of springs are solved roughly, but each step goes on from the one before, so that at rest nothing is left of that: forces are
/// the exact model's to two thousandths, whatever the number of iterations, and springs of 10 N/m that bear 8 to 16 µN are 2 to 3 µm deep.
#[test]
fn at_rest_the_forces_of_springs_are_exact() {
    let (exact, _) = over_cylinders(ContactModel::Coulomb, 50);
    for max_iterations in [1, 50] {
        let (forces, deepest) = over_cylinders(ContactModel::Penalty, max_iterations);
        let off: f64 = forces.iter().zip(&exact).map(|(force, exact)| (force / exact - 1.0).abs()).fold(0.0, f64::max);
        println!("{max_iterations} iterations: off by {off:e}, {deepest:e} m deep, bearing {exact:?}");
        assert!(off < 2e-3 && deepest < 5e-6);
    }
}

#[test]
fn friction_holds_below_its_angle_and_not_above() {
    let mu = 0.4;
    {
        let model = ContactModel::Coulomb;
        for (share, sticks) in [(0.99_f64, true), (1.01, false)] {
            // The slope is along y, across the strand: only its root and what stiffness it has hold it there.
            let angle = (mu * share).atan();
            let gravity = Vector3::new(0.0, angle.sin(), -angle.cos()) * GRAVITY;
            let mut solver = solver(model, gravity);
            let id = solver.add_strands(&[lying(10)]).unwrap()[0];
            solver.add_bodies(vec![floor()]).unwrap();
            let contact = StrandContact { friction: Friction::uniform(mu), ..StrandContact::default() };
            solver.set_contact(&[id], Some(&contact)).unwrap();
            let start = tip(&solver, id, 0.2);
            let mut worst = 0;
            for _ in 0..180 {
                let report = solver.step(1.0 / 60.0, 1).unwrap();
                worst += report.contact.unconverged;
            }
            let way = tip(&solver, id, 0.2) - start;
            println!("{model:?} {share}: {way:?}, unconverged {worst}");
            if sticks {
                assert!(way.norm() < 1e-5, "{way:?}");
            } else {
                assert!(way.y > 1e-2, "{way:?}");
            }
        }
    }
}

/// A straight limp strand that lies across its way and slides with its root, which slows down as Coulomb's friction slows it: a = μ g.
/// Then the follicle carries no force along the motion. 1 % of the friction is ten times the step's error.
#[test]
fn a_sliding_strand_slows_by_friction_alone() {
    let (mu, speed) = (0.4, 1.0);
    let slowing = mu * GRAVITY;
    let mut solver = solver(ContactModel::Coulomb, Vector3::new(0.0, 0.0, -GRAVITY));
    let mut def = lying(8);
    def.root_velocity = Vector3::new(0.0, speed, 0.0);
    let friction = mu * def.material.linear_density() * def.length() * GRAVITY;
    let root = def.root;
    let id = solver.add_strands(&[def]).unwrap()[0];
    solver.add_bodies(vec![floor()]).unwrap();
    solver.set_contact(&[id], Some(&StrandContact { friction: Friction::uniform(mu), ..StrandContact::default() })).unwrap();
    let h = 1.0 / 240.0;
    for step in 1..=40 {
        // Where implicit Euler's velocity is, so that the follicle has no part in it.
        let t = f64::from(step) * h;
        let way = speed * t - 0.5 * slowing * t * (t + h);
        let frame = Frame { origin: root.origin + Vector3::new(0.0, way, 0.0), ..root };
        solver.set_root_frames(&[id], &[frame], 0.0).unwrap();
        solver.step(h, 1).unwrap();
        let borne = solver.root_wrench(id).unwrap().force;
        // The follicle carries the weight of its half element, and must slow what the friction of that part would have.
        let normal: f64 = solver.contacts().iter().map(|contact| contact.force.z).sum();
        let missing = friction - mu * normal;
        assert!(missing < 0.06 * friction && (borne.y - missing).abs() < 1e-3 * friction, "step {step}: {borne:?} {missing:e}");
        for contact in solver.contacts() {
            assert!((contact.force.y + mu * contact.force.z).abs() < 1e-3 * mu * contact.force.z, "{contact:?}");
        }
    }
    let off = tip(&solver, id, 0.2).y - solver.root_frame(id).unwrap().origin.y;
    assert!(off.abs() < 1e-4, "{off}");
}

/// A strand drawn over a cylinder by half a turn: T2/T1 = exp(μφ), within 2 %. The load is a spring at the tip, measured by its force; weight,
/// stiffness and the strand's thickness are as good as nothing.
#[test]
fn a_strand_drawn_over_a_cylinder_obeys_the_capstan_equation() {
    use superhelix::{ConstraintDef, Hold};
    let (mu, radius) = (0.3, 0.01);
    let arc = std::f64::consts::PI * radius;
    {
        let model = ContactModel::Coulomb;
        let mut solver = solver(model, Vector3::zeros());
        // Up from the root beside the cylinder, half round it, and down again.
        let (up, elements) = (0.03, 60);
        let length = 2.0 * up + arc;
        let mut def = StrandDef::straight(length, elements);
        def.material.youngs_modulus = 1e5;
        def.material.air_drag = 1e-4;
        let off = radius + def.material.radius[0];
        def.root = Frame {
            origin: Vector3::new(-off, 0.0, -up),
            rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -std::f64::consts::FRAC_PI_2),
        };
        let cell = length / elements as f64;
        let bent = |k: usize| {
            let (from, to) = ((k as f64 * cell).max(up), ((k + 1) as f64 * cell).min(up + arc));
            (to - from).max(0.0) / cell / off
        };
        def.element_lengths = vec![cell; elements];
        def.natural = vec![[0.0; 3]; elements];
        def.initial = Some((0..elements).map(|k| [0.0, bent(k), 0.0]).collect());
        let root = def.root;
        let id = solver.add_strands(&[def]).unwrap()[0];
        let ends = [-0.1, 0.1].map(|y| Vector3::new(0.0, y, 0.0));
        let cylinder = BodyDef::new(Arc::new(Shape::new_capsule(ends[0], ends[1], radius).unwrap()));
        solver.add_bodies(vec![cylinder]).unwrap();
        solver.set_contact(&[id], Some(&StrandContact { friction: Friction::uniform(mu), ..StrandContact::default() })).unwrap();
        let target = Frame { origin: Vector3::new(off, 0.0, -up - 0.05), rotation: UnitQuaternion::identity() };
        let spring = ConstraintDef { strand: id, arclength: length, hold: Hold::Point, target, compliance: 50.0 };
        let spring = solver.add_constraints(&[spring]).unwrap()[0];
        let mut ratio = 0.0;
        for step in 1..=60 {
            let origin = root.origin - Vector3::new(0.0, 0.0, 2e-4 * f64::from(step));
            solver.set_root_frames(&[id], &[Frame { origin, ..root }], 1.0 / 60.0).unwrap();
            solver.step(1.0 / 60.0, 1).unwrap();
            let load = solver.constraint_state(spring).unwrap().force.norm();
            ratio = solver.root_wrench(id).unwrap().force.norm() / load;
        }
        let expected = (mu * std::f64::consts::PI).exp();
        println!("{model:?}: {ratio} of {expected}");
        assert!((ratio / expected - 1.0).abs() < 0.02, "{ratio} {expected}");
    }
}

/// A comb tooth of 1 mm goes 2 m/s against a hanging strand and would be on its far side after one step unless contact stops it.
#[test]
fn a_fast_thin_tooth_does_not_pass_through() {
    for h in [1.0 / 60.0, 1.0 / 30.0] {
        for direction in [Vector3::x(), Vector3::y(), Vector3::new(0.6, -0.8, 0.0)] {
            {
                let model = ContactModel::Coulomb;
                let mut solver = solver(model, Vector3::new(0.0, 0.0, -GRAVITY));
                let mut def = StrandDef::straight(0.2, 10);
                def.root.rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::FRAC_PI_2);
                let id = solver.add_strands(&[def]).unwrap()[0];
                let along = direction.cross(&Vector3::z()) * 0.05;
                let tooth = Shape::new_capsule(along, -along, 5e-4).unwrap();
                let at = |way: f64| Frame {
                    origin: Vector3::new(0.0, 0.0, -0.1) + direction * way,
                    rotation: UnitQuaternion::identity(),
                };
                let start = -0.4 * 2.0 * h;
                let bodies = solver.add_bodies(vec![BodyDef { pose: at(start), ..BodyDef::new(Arc::new(tooth)) }]).unwrap();
                solver.set_contact(&[id], Some(&StrandContact::default())).unwrap();
                solver.set_body_frames(&bodies, &[at(start + 2.0 * h)], h).unwrap();
                let report = solver.step(h, 1).unwrap();
                // Where the strand is at the tooth's height it must be ahead of the tooth.
                let ahead = start + 2.0 * h + 5e-4 + 5e-5 - 1e-5;
                let mut nearest = (f64::INFINITY, 0.0);
                solver
                    .sample_strands(&[id], 2001, |_, _, sample| {
                        let off = (sample.position.z + 0.1).abs();
                        if off < nearest.0 {
                            nearest = (off, sample.position.dot(&direction));
                        }
                    })
                    .unwrap();
                assert!(nearest.1 >= ahead - 1e-5, "{model:?} h {h} {direction:?}: {nearest:?} {ahead} {report:?}");
                assert_eq!(solver.contacts().len().min(1), 1);
            }
        }
    }
}

/// A moving body reaches its target whether a strand touches it or not, and an earlier contact is no contact
/// of a step in which nothing does.
#[test]
fn bodies_move_on_and_contacts_end_without_strands_in_contact() {
    let mut solver = solver(ContactModel::Coulomb, Vector3::new(0.0, 0.0, -GRAVITY));
    let id = solver.add_strands(&[lying(6)]).unwrap()[0];
    let floor = solver.add_bodies(vec![floor()]).unwrap()[0];
    let sent = Frame { origin: Vector3::new(0.0, 0.0, -0.5), rotation: UnitQuaternion::identity() };
    solver.set_body_frames(&[floor], &[sent], 0.1).unwrap();
    for _ in 0..12 {
        solver.step(1.0 / 60.0, 1).unwrap();
    }
    assert!((solver.body(floor).unwrap().pose.origin - sent.origin).norm() < 1e-12);
    solver.teleport_bodies(&[floor], &[Frame { origin: Vector3::new(0.0, 0.0, -1.0), ..sent }]).unwrap();
    let ball = BodyDef::new(Arc::new(Shape::new_sphere(0.05).unwrap()));
    let below = Frame { origin: Vector3::new(0.1, 0.0, -0.06), rotation: UnitQuaternion::identity() };
    let ball = solver.add_bodies(vec![BodyDef { pose: below, ..ball }]).unwrap()[0];
    solver.set_contact(&[id], Some(&StrandContact::default())).unwrap();
    solver.set_curvatures(id, &[[0.0; 3]; 6], None).unwrap();
    let mut touched = false;
    for _ in 0..60 {
        solver.step(1.0 / 60.0, 1).unwrap();
        touched |= !solver.contacts().is_empty();
    }
    assert!(touched);
    for away in [true, false] {
        if away {
            solver.teleport_bodies(&[ball], &[Frame { origin: Vector3::new(9.0, 0.0, 0.0), ..below }]).unwrap();
        } else {
            solver.remove_bodies(&[ball, floor]).unwrap();
        }
        solver.step(1.0 / 60.0, 1).unwrap();
        assert!(solver.contacts().is_empty(), "away: {away}");
    }
}

/// As grooms are drawn: what is in a body when the scene begins comes out of it, slowly, and stays out.
#[test]
fn a_strand_drawn_into_a_body_separates_slowly() {
    {
        let model = ContactModel::Coulomb;
        let mut solver = solver(model, Vector3::new(0.0, 0.0, -GRAVITY));
        let id = solver.add_strands(&[lying(10)]).unwrap()[0];
        solver.set_contact(&[id], Some(&StrandContact { exempt_length: 0.02, ..StrandContact::default() })).unwrap();
        // The floor's surface is 2 mm above the strand.
        let above = Frame { origin: Vector3::new(0.0, 0.0, 2e-3), ..Frame::default() };
        solver.add_bodies(vec![BodyDef { pose: above, ..floor() }]).unwrap();
        let mut height = tip(&solver, id, 0.2).z;
        let fastest = solver.options().contact.separation_speed / 60.0;
        for step in 0..60 {
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            assert_eq!(report.quarantined, 0, "{model:?} step {step}: {report:?}");
            let now = tip(&solver, id, 0.2).z;
            assert!(now - height < 1.5 * fastest, "{model:?} step {step}: {height} to {now}");
            height = now;
        }
        assert!(height > 2e-3 - 1e-4, "{model:?}: {height}");
    }
}

/// A strand drawn where two surfaces both push it into the other: no force parts them, and none is looked for without end.
#[test]
fn a_strand_drawn_between_two_surfaces_stays_whole() {
    {
        let model = ContactModel::Coulomb;
        let mut solver = solver(model, Vector3::new(0.0, 0.0, -GRAVITY));
        let id = solver.add_strands(&[lying(10)]).unwrap()[0];
        solver.set_contact(&[id], Some(&StrandContact { exempt_length: 0.02, ..StrandContact::default() })).unwrap();
        let floor_at = |height: f64, up: bool| {
            let rotation = if up {
                UnitQuaternion::identity()
            } else {
                UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
            };
            BodyDef { pose: Frame { origin: Vector3::new(0.0, 0.0, height), rotation }, ..floor() }
        };
        solver.add_bodies(vec![floor_at(1e-3, true), floor_at(-1e-3, false)]).unwrap();
        let start = tip(&solver, id, 0.2);
        for step in 0..30 {
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            assert_eq!(report.quarantined, 0, "{model:?} step {step}: {report:?}");
            let most = solver.contacts().iter().fold(0.0, |most: f64, contact| most.max(contact.force.norm()));
            assert!(most < 1e-2, "{model:?} step {step}: {most} N");
        }
        assert!((tip(&solver, id, 0.2) - start).norm() < 2e-3);
    }
}
