//! Contact at points against theory: the weight that it bears, Coulomb's friction, how deep strands sink, and that nothing is thrown back.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::shapes::{DistanceGrid, Mesh, Sides};
use superhelix::{
    BodyDef, ContactModel, Frame, Friction, Precision, Shape, Solver, SolverOptions, StrandContact, StrandDef, Workers,
};

use super::random_bodies::ball;
use super::rest_slide_capstan::{floor, lying, solver, tip};

const GRAVITY: f64 = 9.81;
const STEP: f64 = 1.0 / 60.0;

#[test]
fn contacts_bear_the_weight_of_a_strand_that_falls_to_the_floor() {
    for precision in [Precision::F64, Precision::F32] {
        let mut options = SolverOptions { gravity: Vector3::new(0.0, 0.0, -GRAVITY), ..SolverOptions::default() };
        options.contact.model = ContactModel::AtPoints;
        options.step.precision = precision;
        let mut solver = Solver::new(options).unwrap();
        let mut def = lying(10);
        def.root.origin.z = 0.02;
        let (weight, length) = (def.material.linear_density() * def.length() * GRAVITY, def.length());
        let id = solver.add_strands(&[def]).unwrap()[0];
        let floor = solver.add_bodies(vec![floor()]).unwrap()[0];
        solver.set_contact(&[id], Some(&StrandContact::default())).unwrap();
        let (mut report, mut energy, mut unconverged) = (Default::default(), f64::INFINITY, 0);
        for step in 0..600 {
            let now: superhelix::StepReport = solver.step(STEP, 1).unwrap();
            report = now;
            unconverged += now.unconverged;
            let sum = now.energies.kinetic + now.energies.elastic + now.energies.gravity;
            assert!(sum <= energy + 0.01 * weight * length, "step {step}: energy rose from {energy:e} to {sum:e}");
            energy = energy.min(sum);
        }
        let contacts: Vector3<f64> = solver.contacts().iter().map(|contact| contact.force).sum();
        let wrench = solver.body_wrench(floor).unwrap();
        let root = solver.root_wrench(id).unwrap();
        let off = (contacts - root.force - Vector3::new(0.0, 0.0, weight)).norm() / weight;
        println!(
            "{precision:?}: {} contacts, weight off by {off:e}, {unconverged} unconverged, {report:?}",
            solver.contacts().len()
        );
        assert!((contacts + wrench.force).norm() < 1e-15);
        assert_eq!(report.contact.contacts as usize, solver.contacts().len());
        assert!(off < 0.05, "{off}");
        // Where it comes down from the root a point bears a tenth of the strand.
        assert!(report.contact.penetration < 5e-4, "{report:?}");
        assert!(tip(&solver, id, length).z.abs() < 2e-4);
    }
}

#[test]
fn friction_holds_below_its_angle_and_not_above() {
    let mu = 0.4;
    for (share, sticks) in [(0.95_f64, true), (1.05, false)] {
        let angle = (mu * share).atan();
        let gravity = Vector3::new(0.0, angle.sin(), -angle.cos()) * GRAVITY;
        let mut solver = solver(ContactModel::AtPoints, gravity);
        let id = solver.add_strands(&[lying(10)]).unwrap()[0];
        solver.add_bodies(vec![floor()]).unwrap();
        let contact = StrandContact { friction: Friction::uniform(mu), ..StrandContact::default() };
        solver.set_contact(&[id], Some(&contact)).unwrap();
        let start = tip(&solver, id, 0.2);
        let mut unconverged = 0;
        let mut ways = Vec::new();
        for _ in 0..180 {
            unconverged += solver.step(STEP, 1).unwrap().unconverged;
            ways.push((tip(&solver, id, 0.2) - start).y);
        }
        println!("{share}: {:?}, unconverged {unconverged}", [ways[10], ways[60], ways[179]]);
        if sticks {
            // It lands without friction and is stopped over some steps; then it creeps, slower than this.
            assert!(ways[179].abs() < 3e-3, "{}", ways[179]);
            assert!((ways[179] - ways[119]).abs() < 1e-4, "{:?}", [ways[119], ways[179]]);
        } else {
            assert!(ways[179] > 1e-2, "{}", ways[179]);
        }
    }
}

/// As in `rest_slide_capstan.rs`: a straight limp strand that lies across its way slides with its root, which slows down as Coulomb's
/// friction slows it, so that the follicle carries no force along the motion.
#[test]
fn a_sliding_strand_slows_by_friction_alone() {
    let (mu, speed) = (0.4, 1.0);
    let slowing = mu * GRAVITY;
    let mut solver = solver(ContactModel::AtPoints, Vector3::new(0.0, 0.0, -GRAVITY));
    let mut def = lying(8);
    def.root_velocity = Vector3::new(0.0, speed, 0.0);
    let root = def.root;
    let friction = mu * def.material.linear_density() * def.length() * GRAVITY;
    let id = solver.add_strands(&[def]).unwrap()[0];
    solver.add_bodies(vec![floor()]).unwrap();
    solver.set_contact(&[id], Some(&StrandContact { friction: Friction::uniform(mu), ..StrandContact::default() })).unwrap();
    let h = 1.0 / 240.0;
    for step in 1..=40 {
        let t = f64::from(step) * h;
        let way = speed * t - 0.5 * slowing * t * (t + h);
        let frame = Frame { origin: root.origin + Vector3::new(0.0, way, 0.0), ..root };
        solver.set_root_frames(&[id], &[frame], 0.0).unwrap();
        let report = solver.step(h, 1).unwrap();
        let forces: Vector3<f64> = solver.contacts().iter().map(|contact| contact.force).sum();
        println!("{step}: {:?} of {friction:e}, its {}", forces.y / -mu / forces.z, report.mean_iterations);
        if step > 3 {
            assert!((forces.y + mu * forces.z).abs() < 0.02 * mu * forces.z, "step {step}: {forces:?}");
        }
    }
    let off = tip(&solver, id, 0.2).y - solver.root_frame(id).unwrap().origin.y;
    assert!(off.abs() < 1e-3, "{off}");
}

/// More strands than a task takes, whose packs mix them: the list of contacts goes from strand to strand and from root to tip all the same, to the
/// same bits on any number of threads.
#[test]
fn contacts_are_listed_from_strand_to_strand() {
    let course = |workers: Workers| {
        let mut options = SolverOptions { gravity: Vector3::new(0.0, 0.0, -GRAVITY), workers, ..SolverOptions::default() };
        options.contact.model = ContactModel::AtPoints;
        let mut solver = Solver::new(options).unwrap();
        let defs: Vec<StrandDef> = (0..2500).map(|k| lying(2 + k % 3)).collect();
        let ids = solver.add_strands(&defs).unwrap();
        let floor = solver.add_bodies(vec![floor()]).unwrap()[0];
        solver.set_contact(&ids, Some(&StrandContact::default())).unwrap();
        (0..3).for_each(|_| _ = solver.step(STEP, 1).unwrap());
        let place = |id| ids.iter().position(|other| *other == id).unwrap();
        let list: Vec<_> = solver.contacts().iter().map(|c| (place(c.strand), c.arclength, c.position, c.force, c.gap)).collect();
        (list, solver.body_wrench(floor).unwrap())
    };
    let (list, wrench) = course(Workers::Serial);
    assert!(list.len() > 5000, "{}", list.len());
    let follows = |pair: &[(usize, f64, _, _, _)]| (pair[0].0, pair[0].1) < (pair[1].0, pair[1].1);
    assert!(list.windows(2).all(follows));
    for threads in [2, 3] {
        assert_eq!(course(Workers::Pool(threads)), (list.clone(), wrench), "{threads} threads");
    }
}

/// Hair falls on a ball that turns, as every kind of shape, and slides over it: with a few iterations it is hardly in it, the report says how
/// deep it is, and a snapshot goes on with the same bits, on two threads as on one.
#[test]
fn hair_lies_on_a_turning_ball_of_any_shape() {
    let radius = 0.09;
    let (vertices, triangles) = ball(radius, 4);
    let mesh = Shape::new_mesh(vertices.clone(), triangles.clone(), Sides::Solid).unwrap();
    let grid = DistanceGrid::bake(&Mesh::new(vertices, triangles, Sides::Solid).unwrap(), 3e-3, 0.015).unwrap();
    let shapes = [Shape::new_sphere(radius).unwrap(), mesh, Shape::new_grid(grid)];
    for shape in shapes {
        let shape = Arc::new(shape);
        for precision in [Precision::F64, Precision::F32] {
            let mut results = Vec::new();
            // The last: strand 7 by itself, outside any pack.
            for (threads, only) in [(1, None), (2, None), (1, Some(7))] {
                let mut options = SolverOptions { gravity: Vector3::new(0.0, 0.0, -GRAVITY), ..SolverOptions::default() };
                (options.contact.model, options.contact.max_iterations) = (ContactModel::AtPoints, 4);
                options.step.precision = precision;
                options.workers = if threads > 1 { Workers::Pool(threads) } else { Workers::Serial };
                let mut solver = Solver::new(options.clone()).unwrap();
                let defs: Vec<StrandDef> =
                    (0..40).filter(|k| only.is_none_or(|only| only == *k)).map(|k| on_top(k, radius)).collect();
                let ids = solver.add_strands(&defs).unwrap();
                let body = solver.add_bodies(vec![BodyDef::new(shape.clone())]).unwrap();
                solver.set_contact(&ids, Some(&StrandContact { exempt_length: 5e-3, ..StrandContact::default() })).unwrap();
                let (mut deep, mut pressed) = (0, 0);
                for step in 0..180 {
                    let t = f64::from(step + 1) * STEP;
                    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5 * (std::f64::consts::TAU * t).sin());
                    let frame = Frame { origin: Vector3::zeros(), rotation: turn };
                    let roots: Vec<Frame> = defs.iter().map(|def| frame.compose(&def.root)).collect();
                    solver.set_root_frames(&ids, &roots, STEP).unwrap();
                    solver.set_body_frames(&body, &[frame], STEP).unwrap();
                    if threads > 1 && step == 120 {
                        let image = solver.snapshot();
                        solver = Solver::new(options.clone()).unwrap();
                        solver.restore(&image).unwrap();
                    }
                    let report = solver.step(STEP, 1).unwrap();
                    assert_eq!(report.quarantined, 0);
                    if step < 60 {
                        continue;
                    }
                    let gaps = || solver.contacts().iter().map(|contact| contact.gap);
                    pressed += gaps().count();
                    deep += gaps().filter(|gap| *gap < -5e-4).count();
                    let deepest = gaps().fold(0.0, f64::min);
                    assert!(report.contact.penetration >= -deepest - 1e-12, "{report:?} {deepest}");
                }
                // From outside: what the strands' own shapes say, between the points too.
                let mut worst = f64::INFINITY;
                for id in &ids {
                    let along: Vec<f64> = (5..=250).map(|mm| f64::from(mm) * 1e-3).collect();
                    solver.sample_at(*id, &along, |_, sample| worst = worst.min(sample.position.norm() - radius)).unwrap();
                }
                println!("{precision:?} {threads}: {pressed} contacts, {deep} deep, worst {worst:e}");
                assert!(only.is_some() || pressed > 10_000, "{pressed}");
                assert!(100 * deep <= 3 * pressed, "{deep} of {pressed}");
                assert!(worst > -3e-3, "{worst}");
                let tips: Vec<Vector3<f64>> = ids.iter().map(|id| tip(&solver, *id, 0.25)).collect();
                results.push(tips);
            }
            assert_eq!(results[0], results[1]);
            assert_eq!(results[0][7], results[2][0]);
        }
    }
}

/// A strand that comes down on a thin rod hangs over it, wherever between its points that is.
#[test]
fn a_thin_rod_between_the_points_bears_a_strand() {
    let (radius, below) = (4e-3, 4.5e-3);
    let rod = Shape::new_capsule(Vector3::new(0.0, -0.05, 0.0), Vector3::new(0.0, 0.05, 0.0), radius).unwrap();
    let rod = Arc::new(rod);
    for mm in 90..112 {
        let at = Vector3::new(1e-3 * f64::from(mm), 0.0, -below);
        let mut solver = solver(ContactModel::AtPoints, Vector3::new(0.0, 0.0, -GRAVITY));
        let id = solver.add_strands(&[StrandDef::straight(0.2, 10)]).unwrap()[0];
        solver.add_bodies(vec![BodyDef { pose: Frame { origin: at, ..Frame::default() }, ..BodyDef::new(rod.clone()) }]).unwrap();
        solver.set_contact(&[id], Some(&StrandContact::default())).unwrap();
        let (mut report, mut worst) = (superhelix::StepReport::default(), f64::INFINITY);
        for _ in 0..120 {
            report = solver.step(STEP, 1).unwrap();
            let along: Vec<f64> = (0..=400).map(|k| 5e-4 * f64::from(k)).collect();
            let mut gap = f64::INFINITY;
            solver
                .sample_at(id, &along, |_, sample| {
                    let off = sample.position - at;
                    // Below the rod it would have fallen through.
                    gap = gap.min(Vector3::new(off.x, 0.0, off.z).norm() - radius);
                    assert!(off.norm() > 3.0 * radius || off.x.abs() > 1e-3 || off.z > 0.0, "{mm} mm: {off:?}");
                })
                .unwrap();
            worst = worst.min(gap);
        }
        let borne: Vector3<f64> = solver.contacts().iter().map(|contact| contact.force).sum();
        println!("{mm} mm: worst {worst:e}, force {borne:?}, {report:?}");
        assert!(worst > -8e-4, "{mm} mm: {worst}");
        assert!(borne.z > 0.0 && report.contact.penetration < 8e-4, "{mm} mm: {report:?}");
    }
}

/// The tip lies beyond the last point and stays out of a floor on which the strand is let down.
#[test]
fn a_tip_that_is_let_down_stays_out_of_the_floor() {
    let mut solver = solver(ContactModel::AtPoints, Vector3::new(0.0, 0.0, -GRAVITY));
    let mut def = lying(10);
    let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::FRAC_PI_2);
    def.root = Frame { origin: Vector3::new(0.0, 0.0, 0.205), rotation: down };
    def.natural = vec![[0.0, 2.0, 0.0]; 10];
    let id = solver.add_strands(&[def.clone()]).unwrap()[0];
    solver.add_bodies(vec![floor()]).unwrap();
    solver.set_contact(&[id], Some(&StrandContact::default())).unwrap();
    let (mut lowest, mut touched) = (f64::INFINITY, 0);
    for step in 0..180 {
        let origin = def.root.origin - Vector3::z() * (5e-4 * f64::from(step + 1)).min(0.05);
        solver.set_root_frames(&[id], &[Frame { origin, ..def.root }], STEP).unwrap();
        touched += solver.step(STEP, 1).unwrap().contact.contacts;
        lowest = lowest.min(tip(&solver, id, 0.2).z);
    }
    println!("lowest {lowest:e}, {touched} contacts");
    assert!(touched > 100, "{touched}");
    assert!(lowest > -2e-4, "{lowest}");
}

/// A strand that goes through a thin plate, as no force along it could undo, stays there. A plate between two points does not push the
/// strand along itself; a point in the plate still does, with up to 2.4e-5 N.
#[test]
fn a_strand_that_pierces_a_plate_is_not_pushed_along_itself() {
    for mm in 0..20 {
        let mut solver = solver(ContactModel::AtPoints, Vector3::zeros());
        let id = solver.add_strands(&[lying(10)]).unwrap()[0];
        let plate = BodyDef::new(Arc::new(Shape::new_box(Vector3::new(1e-3, 0.05, 0.05)).unwrap()));
        let at = Vector3::new(0.1 + 1e-3 * f64::from(mm), 0.0, 0.0);
        solver.add_bodies(vec![BodyDef { pose: Frame { origin: at, ..Frame::default() }, ..plate }]).unwrap();
        solver.set_contact(&[id], Some(&StrandContact::default())).unwrap();
        let start = tip(&solver, id, 0.2);
        for _ in 0..30 {
            assert_eq!(solver.step(STEP, 1).unwrap().quarantined, 0);
        }
        let (off, pushed) = ((tip(&solver, id, 0.2) - start).norm(), solver.root_wrench(id).unwrap().force.norm());
        println!("{mm} mm: off {off:e}, pushed {pushed:e}");
        assert!(off < 1e-3 && pushed < 4e-5, "{mm} mm: {off} {pushed}");
    }
}

/// A strand drawn into a body stays as it is drawn where that overlap is permitted, and comes out where it is not.
#[test]
fn permitted_overlaps_bear_no_force() {
    let radius = 0.05;
    for permitted in [true, false] {
        let mut solver = solver(ContactModel::AtPoints, Vector3::zeros());
        let id = solver.add_strands(&[lying(10)]).unwrap()[0];
        let at = Vector3::new(0.12, 0.0, -radius + 2e-3);
        let ball = BodyDef::new(Arc::new(Shape::new_sphere(radius).unwrap()));
        solver.add_bodies(vec![BodyDef { pose: Frame { origin: at, ..Frame::default() }, ..ball }]).unwrap();
        solver.set_contact(&[id], Some(&StrandContact::default())).unwrap();
        if permitted {
            let overlaps = solver.allow_overlaps(&[id]).unwrap();
            assert!((overlaps[0].bodies - 2e-3).abs() < 1e-4, "{overlaps:?}");
        }
        let start = tip(&solver, id, 0.2);
        let mut report = superhelix::StepReport::default();
        for _ in 0..60 {
            report = solver.step(STEP, 1).unwrap();
        }
        let off = (tip(&solver, id, 0.2) - start).norm();
        println!("{permitted}: {off:e} {report:?}");
        assert_eq!(off < 1e-6, permitted, "{off}");
        assert!(report.contact.penetration < 1e-4, "{report:?}");
    }
}

/// A strand that stands on the ball and falls over.
fn on_top(k: usize, radius: f64) -> StrandDef {
    let mut def = StrandDef::straight(0.25, 10);
    def.material.internal_friction = 1e-10;
    def.material.air_drag = 5e-6;
    let (one, two) = ((k as f64 * 0.618_034).fract(), (k as f64 * 0.754_878).fract());
    def.natural = vec![[2.0 * one, 5.0 + 5.0 * two, 3.0 * one]; 10];
    let out =
        UnitQuaternion::from_euler_angles(0.0, -std::f64::consts::FRAC_PI_2 + 0.6 * (one - 0.5), std::f64::consts::TAU * two);
    def.root = Frame { origin: out * Vector3::x() * radius, rotation: out };
    def
}
