//! Targets: weight 0 is a free strand to the bit, weight 1 is on the curve, between them theory (a beam on an elastic foundation, a critically
//! damped point), and all of it in lanes, under contact, at any step, and across snapshots.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::TargetDef;
use superhelix::{
    BodyDef, Error, Frame, InstructionSet, Integrator, Precision, Shape, Solver, SolverOptions, StrandContact, StrandDef,
    StrandId, StrandStatus, Workers,
};

const FRAME: f64 = 1.0 / 60.0;
/// Points of the curves in these tests.
const POINTS: usize = 41;

fn with(integrator: Integrator, precision: Precision) -> SolverOptions {
    let mut options = SolverOptions::default();
    (options.step.integrator, options.step.precision) = (integrator, precision);
    options
}

fn points(solver: &Solver, id: StrandId, count: usize) -> Vec<Vector3<f64>> {
    let mut out = Vec::new();
    solver.sample_strands(&[id], count, |_, _, sample| out.push(sample.position)).unwrap();
    out
}

fn furthest(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

/// Curls of one to nine elements.
fn hair(count: usize) -> Vec<StrandDef> {
    let curl = |k: usize| {
        let mut def = StrandDef::straight(0.1 + 0.002 * k as f64, 1 + k % 9);
        def.natural.iter_mut().for_each(|row| *row = [2.0, (k % 5) as f64 * 12.0, 1.0]);
        def.material.air_drag = if k.is_multiple_of(4) { 0.0 } else { 1e-5 };
        def.root.origin.y = 0.004 * k as f64;
        def
    };
    (0..count).map(curl).collect()
}

/// Where a root is after a number of frames: it goes back and forth and turns.
fn root(def: &StrandDef, frame: f64) -> Frame {
    let time = frame * FRAME;
    Frame {
        origin: def.root.origin + Vector3::new(0.03 * (9.0 * time).sin(), 0.0, 0.02 * (1.0 - (7.0 * time).cos())),
        rotation: UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.4 * (8.0 * time).sin(), 0.0)) * def.root.rotation,
    }
}

/// A rig: the curve of a strand at a frame, its root's motion and a bend that comes and goes.
fn rigged(def: &StrandDef, frame: f64) -> Vec<Vector3<f64>> {
    let mut shape = def.clone();
    let bend = 6.0 * (5.0 * frame * FRAME).sin();
    shape.initial = Some(def.natural.iter().map(|row| [row[0], row[1] + bend, row[2] - 0.5 * bend]).collect());
    shape.root = root(def, frame);
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let ids = solver.add_strands(&[shape]).unwrap();
    points(&solver, ids[0], POINTS)
}

/// Steps strands by one frame with their roots and their targets.
fn follow(solver: &mut Solver, ids: &[StrandId], defs: &[StrandDef], weights: &[[f64; 2]], frame: f64, substeps: u32) {
    let roots: Vec<Frame> = defs.iter().map(|def| root(def, frame)).collect();
    let curves: Vec<Vec<Vector3<f64>>> = defs.iter().map(|def| rigged(def, frame)).collect();
    let targets: Vec<TargetDef> = curves.iter().map(|points| TargetDef { points, weights, ..TargetDef::default() }).collect();
    solver.set_root_frames(ids, &roots, FRAME).unwrap();
    solver.set_targets(ids, &targets, FRAME).unwrap();
    let report = solver.step(FRAME, substeps).unwrap();
    assert_eq!(report.quarantined, 0, "frame {frame}");
    assert!(report.unconverged == 0 || report.contact.contacts > 0, "frame {frame}");
}

fn ball(solver: &mut Solver, ids: &[StrandId]) {
    let pose = Frame { origin: Vector3::new(0.06, 0.03, -0.06), ..Frame::default() };
    let ball = BodyDef { pose, ..BodyDef::new(Arc::new(Shape::new_sphere(0.05).unwrap())) };
    solver.add_bodies(vec![ball]).unwrap();
    solver.set_contact(ids, Some(&StrandContact { exempt_length: 0.02, ..StrandContact::default() })).unwrap();
}

#[test]
fn at_weight_zero_a_strand_is_free_to_the_bit() {
    let defs = hair(24);
    for (integrator, precision, touches) in [
        (Integrator::SecondOrder, Precision::F64, false),
        (Integrator::SecondOrder, Precision::F64, true),
        (Integrator::SecondOrder, Precision::F32, false),
        (Integrator::ImplicitEuler, Precision::F64, false),
        (Integrator::LinearlyImplicit, Precision::F64, false),
    ] {
        let hash = |draw: &dyn Fn(&mut Solver, &[StrandId], f64)| {
            let mut solver = Solver::new(with(integrator, precision)).unwrap();
            let ids = solver.add_strands(&defs).unwrap();
            if touches {
                ball(&mut solver, &ids);
            }
            for frame in 1..=12 {
                draw(&mut solver, &ids, f64::from(frame));
                solver.step(FRAME, 3).unwrap();
            }
            // Whoever had no weight, and nothing else of the scene.
            solver.clear_targets(&ids).unwrap();
            solver.remove_strands(&ids[12..]).unwrap();
            solver.state_hash()
        };
        let roots = |solver: &mut Solver, ids: &[StrandId], frame: f64| {
            let roots: Vec<Frame> = defs.iter().map(|def| root(def, frame)).collect();
            solver.set_root_frames(ids, &roots, FRAME).unwrap();
        };
        let free = hash(&roots);
        let draws = |first: &'static [[f64; 2]], others: &'static [[f64; 2]]| {
            let (roots, defs) = (&roots, &defs);
            move |solver: &mut Solver, ids: &[StrandId], frame: f64| {
                roots(solver, ids, frame);
                let curves: Vec<_> = defs.iter().map(|def| rigged(def, frame)).collect();
                let targets: Vec<_> = curves
                    .iter()
                    .enumerate()
                    .map(|(k, points)| TargetDef { points, weights: if k < 12 { first } else { others }, ..TargetDef::default() })
                    .collect();
                solver.set_targets(ids, &targets, FRAME).unwrap();
            }
        };
        let case = format!("{integrator:?} {precision:?} {touches}");
        assert_eq!(hash(&draws(&[[0.0, 0.0]], &[[0.0, 0.0]])), free, "{case}: no weight");
        if !touches {
            assert_eq!(hash(&draws(&[[0.3, 0.0]], &[[0.0, 1.0], [1.0, 0.2]])), free, "{case}: beside strands with a target");
        }
        assert_ne!(hash(&draws(&[[0.0, 1.0]], &[[0.0, 0.0]])), free, "{case}: with weight");
    }
}

#[test]
fn at_weight_one_a_strand_is_on_its_curve() {
    // The curves bend by up to 55/m: between their points they are straight, which errs by (L/40)²·55/8 = 0.15 mm for the longest.
    for (integrator, precision, allowed) in [
        (Integrator::SecondOrder, Precision::F64, 2e-4),
        (Integrator::ImplicitEuler, Precision::F64, 2e-4),
        // (It takes turns of a step as linear, and makes up for the rest a step later.)
        (Integrator::LinearlyImplicit, Precision::F64, 5e-3),
        (Integrator::SecondOrder, Precision::F32, 2e-4),
    ] {
        let defs = hair(30);
        let mut solver = Solver::new(with(integrator, precision)).unwrap();
        let ids = solver.add_strands(&defs).unwrap();
        let mut worst: f64 = 0.0;
        for frame in 0..30 {
            follow(&mut solver, &ids, &defs, &[[0.0, 1.0]], f64::from(frame), 2);
            for (id, def) in ids.iter().zip(&defs) {
                worst = worst.max(furthest(&points(&solver, *id, POINTS), &rigged(def, f64::from(frame))));
            }
        }
        assert!(worst < allowed, "{integrator:?} {precision:?}: {worst:e} m");
        let distances = solver.target_distances(&ids).unwrap();
        assert!(distances.iter().all(|distance| distance.unwrap() < allowed), "{distances:?}");
    }
}

#[test]
fn the_root_follows_and_the_tip_swings() {
    let mut def = StrandDef::straight(0.2, 12);
    def.root.rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.0, std::f64::consts::FRAC_PI_2, 0.0));
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let ids = solver.add_strands(&[def.clone(), def.clone()]).unwrap();
    let (mut near, mut far, mut differs): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for frame in 0..60 {
        let frame = f64::from(frame);
        let curve = rigged(&def, frame);
        let target = TargetDef { points: &curve, weights: &[[0.4, 1.0], [0.6, 0.0]], ..TargetDef::default() };
        solver.set_root_frames(&ids, &[root(&def, frame); 2], FRAME).unwrap();
        solver.set_targets(&ids[..1], &[target], FRAME).unwrap();
        solver.step(FRAME, 2).unwrap();
        let (drawn, free) = (points(&solver, ids[0], POINTS), points(&solver, ids[1], POINTS));
        near = near.max(furthest(&drawn[..16], &curve[..16]));
        far = far.max((drawn[POINTS - 1] - curve[POINTS - 1]).norm());
        differs = differs.max((drawn[POINTS - 1] - free[POINTS - 1]).norm());
    }
    assert!(near < 1e-3, "the root part leaves its curve by {near} m");
    assert!(far > 0.02, "the tip stays within {far} m of its curve");
    assert!(differs > 0.02, "the tip goes with the free one, to {differs} m");
    assert_eq!(solver.target_distances(&ids[1..]).unwrap(), [None]);
}

/// A horizontal strand of 100 µm, 0.2 m long, and the curve along it, shifted upwards.
fn horizontal(shift: f64) -> (StrandDef, [Vector3<f64>; 2]) {
    let mut def = StrandDef::straight(0.2, 40);
    def.material.radius = [100e-6, 100e-6];
    (def, [Vector3::new(0.0, 0.0, shift), Vector3::new(0.2, 0.0, shift)])
}

#[test]
fn a_strand_sags_from_its_curve_like_a_beam_on_an_elastic_foundation() {
    let (def, curve) = horizontal(0.0);
    let (weight, time_constant, gravity): (f64, f64, f64) = (0.8, 0.02, 9.81);
    let tau = time_constant * (1.0 - weight) / weight + 1e-4;
    // Clamped at the root, long: y = −g τ² (1 − exp(−βx)(cos βx + sin βx)), β⁴ = ρS/(4 EI τ²).
    let inertia = std::f64::consts::PI * 100e-6_f64.powi(4) / 4.0;
    let stiffness = def.material.youngs_modulus * inertia;
    let beta = (def.material.linear_density() / (4.0 * stiffness * tau * tau)).powf(0.25);
    assert!(beta * 0.2 > 6.0, "long enough: {}", beta * 0.2);
    let sag = gravity * tau * tau;
    for h in [1.0 / 60.0, 1.0 / 480.0] {
        let mut solver = Solver::new(SolverOptions::default()).unwrap();
        let ids = solver.add_strands(std::slice::from_ref(&def)).unwrap();
        let target = TargetDef { points: &curve, weights: &[[0.0, weight]], time_constant, ..TargetDef::default() };
        solver.set_targets(&ids, &[target], 0.0).unwrap();
        for _ in 0..(1.0 / h) as usize {
            solver.step(h, 1).unwrap();
        }
        for (k, point) in points(&solver, ids[0], POINTS).iter().enumerate() {
            let x = beta * 0.2 * k as f64 / (POINTS - 1) as f64;
            let expected = -sag * (1.0 - (-x).exp() * (x.cos() + x.sin()));
            assert!((point.z - expected).abs() < 0.01 * sag, "h = {h}, βx = {x}: {} {expected}", point.z);
        }
    }
}

#[test]
fn a_strand_comes_to_its_curve_with_the_time_constant_in_second_order() {
    let (mut def, curve) = horizontal(1e-4);
    // Limp: what the root holds back does not reach far.
    def.material.youngs_modulus = 1e5;
    let (time_constant, seconds) = (0.05_f64, 0.07_f64);
    let tau = time_constant + 1e-4;
    // Half-way weights. Far from the root a point is on its own: z = d (1 − (1 + t/τ) exp(−t/τ)).
    let expected = 1e-4 * (1.0 - (1.0 + seconds / tau) * (-seconds / tau).exp());
    let error = |h: f64, integrator: Integrator, precision: Precision| {
        let options = SolverOptions { gravity: Vector3::zeros(), ..with(integrator, precision) };
        let mut solver = Solver::new(options).unwrap();
        let ids = solver.add_strands(std::slice::from_ref(&def)).unwrap();
        let target = TargetDef { points: &curve, weights: &[[0.0, 0.5]], time_constant, ..TargetDef::default() };
        solver.set_targets(&ids, &[target], 0.0).unwrap();
        for _ in 0..(seconds / h).round() as usize {
            solver.step(h, 1).unwrap();
        }
        points(&solver, ids[0], POINTS)[34].z - expected
    };
    let second = [0.01, 0.005, 0.0025].map(|h| error(h, Integrator::SecondOrder, Precision::F64));
    assert!(second[2].abs() < 2e-3 * expected, "{second:?}");
    for pair in second.windows(2) {
        assert!(pair[0] / pair[1] > 3.0, "{second:?}");
    }
    for integrator in [Integrator::ImplicitEuler, Integrator::LinearlyImplicit] {
        let first = [0.01, 0.005, 0.0025].map(|h| error(h, integrator, Precision::F64));
        for pair in first.windows(2) {
            assert!((1.6..2.4).contains(&(pair[0] / pair[1])), "{integrator:?}: {first:?}");
        }
    }
    let single = error(0.0025, Integrator::SecondOrder, Precision::F32);
    assert!((single - second[2]).abs() < 1e-2 * expected, "{single:e} {second:?}");
}

#[test]
fn a_target_that_stands_still_adds_no_energy() {
    for integrator in [Integrator::ImplicitEuler, Integrator::SecondOrder] {
        let mut def = StrandDef::straight(0.15, 10);
        def.natural.iter_mut().for_each(|row| *row = [0.0, 15.0, 3.0]);
        let mut solver = Solver::new(with(integrator, Precision::F64)).unwrap();
        let ids = solver.add_strands(std::slice::from_ref(&def)).unwrap();
        let curve = [Vector3::zeros(), Vector3::new(0.06, 0.0, 0.1), Vector3::new(0.13, 0.02, 0.12)];
        let target = TargetDef { points: &curve, weights: &[[0.0, 0.9], [0.5, 0.5], [1.0, 0.0]], ..TargetDef::default() };
        solver.set_targets(&ids, &[target], 0.0).unwrap();
        // The springs' energy by the trapezoidal rule; the curve's points by its own arclength.
        let lengths = [(curve[1] - curve[0]).norm(), (curve[2] - curve[1]).norm()];
        let total = lengths[0] + lengths[1];
        let springs = |solver: &Solver| {
            let all = points(solver, ids[0], 3001);
            let mut sum = 0.0;
            for (k, point) in all.iter().enumerate() {
                let x = k as f64 / 3000.0;
                let weight = if x < 0.5 { 0.9 - 0.8 * x } else { 1.0 - x };
                let rate = weight / (0.1 * (1.0 - weight) + 1e-4 * weight);
                let along = x * total;
                let place = if along < lengths[0] {
                    curve[0].lerp(&curve[1], along / lengths[0])
                } else {
                    curve[1].lerp(&curve[2], (along - lengths[0]) / lengths[1])
                };
                let ends = if k == 0 || k == 3000 { 0.5 } else { 1.0 };
                sum += ends * 0.5 * rate * rate * (point - place).norm_squared() / 3000.0;
            }
            sum * 0.15 * def.material.linear_density()
        };
        let energy = |solver: &Solver| {
            let energies = solver.energies(ids[0]).unwrap();
            energies.kinetic + energies.elastic + energies.gravity + springs(solver)
        };
        let began = energy(&solver);
        let mut before = began;
        for _ in 0..240 {
            solver.step(1.0 / 120.0, 1).unwrap();
            let now = energy(&solver);
            // (The quadrature along elements and the trapezoidal rule differ a little.)
            assert!(now < before + 1e-3 * began.abs(), "{integrator:?}: {before:e} to {now:e} of {began:e}");
            before = now;
        }
        assert!(before < began - 0.2 * began.abs(), "{integrator:?}: {began:e} to {before:e}");
    }
}

#[test]
fn any_step_and_any_leap_of_the_target_is_stable() {
    let defs = hair(12);
    for precision in [Precision::F64, Precision::F32] {
        for h in [1e-5, 1e-3, 1.0 / 60.0, 0.5, 10.0] {
            let mut solver = Solver::new(with(Integrator::SecondOrder, precision)).unwrap();
            let ids = solver.add_strands(&defs).unwrap();
            for leap in 0..8 {
                // To and fro by more than the strands' lengths, and longer than they are.
                let far = if leap % 2 == 0 { 0.3 } else { -0.3 };
                let curve = [Vector3::new(0.0, 0.0, far), Vector3::new(far, 0.1, 0.1), Vector3::new(2.0 * far, -far, far)];
                let target = TargetDef { points: &curve, weights: &[[0.0, 0.2], [0.5, 1.0], [1.0, 0.9]], ..TargetDef::default() };
                solver.set_targets(&ids, &vec![target; ids.len()], 0.0).unwrap();
                for _ in 0..6 {
                    let report = solver.step(h, 2).unwrap();
                    assert_eq!(report.quarantined, 0, "{precision:?}, h = {h}, leap {leap}");
                }
            }
            for id in &ids {
                assert_ne!(solver.status(*id).unwrap(), StrandStatus::Quarantined);
                assert!(points(&solver, *id, 9).iter().all(|point| point.norm() < 0.3));
            }
        }
    }
}

#[test]
fn packs_workers_and_splits_of_the_step_do_not_matter() {
    let defs = hair(40);
    let weights = [[0.0, 1.0], [0.3, 0.7], [1.0, 0.0]];
    let run = |instruction_set, workers, touches: bool| {
        let mut solver = Solver::new(SolverOptions { instruction_set, workers, ..SolverOptions::default() }).unwrap();
        let ids = solver.add_strands(&defs).unwrap();
        if touches {
            ball(&mut solver, &ids);
        }
        for frame in 0..8 {
            follow(&mut solver, &ids, &defs, &weights, f64::from(frame), 3);
        }
        solver.state_hash()
    };
    for touches in [false, true] {
        let alone = run(Some(InstructionSet::Scalar), Workers::Serial, touches);
        assert_eq!(run(None, Workers::Serial, touches), alone, "contact {touches}");
        assert_eq!(run(None, Workers::Pool(3), touches), alone, "contact {touches}");
    }
    // Two substeps of one call, or two calls: the target is as far at each.
    let end = |calls: u32, substeps: u32| {
        let mut solver = Solver::new(SolverOptions::default()).unwrap();
        let ids = solver.add_strands(&defs).unwrap();
        for frame in 0..6 {
            let curves: Vec<_> = defs.iter().map(|def| rigged(def, f64::from(frame))).collect();
            let targets: Vec<_> = curves.iter().map(|points| TargetDef { points, ..TargetDef::default() }).collect();
            solver.set_targets(&ids, &targets, FRAME).unwrap();
            for _ in 0..calls {
                solver.step(FRAME / f64::from(calls), substeps).unwrap();
            }
        }
        solver.state_hash()
    };
    assert_eq!(end(1, 2), end(2, 1));
}

#[test]
fn a_body_keeps_a_strand_out_whatever_its_target() {
    let mut def = StrandDef::straight(0.16, 12);
    def.root.origin = Vector3::new(-0.1, 0.0, 0.055);
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let ids = solver.add_strands(std::slice::from_ref(&def)).unwrap();
    solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_sphere(0.05).unwrap()))]).unwrap();
    solver.set_contact(&ids, Some(&StrandContact::default())).unwrap();
    let tolerance = solver.options().contact.tolerance;
    let depth = |solver: &Solver| points(solver, ids[0], 161).iter().map(|p| 0.05 - p.norm()).fold(0.0, f64::max);
    let mut pressed = false;
    for frame in 0..60 {
        // Lowered into the ball by up to 3 cm, from half-way on firmly.
        let down = 0.055 - 0.03 * (f64::from(frame) / 40.0).min(1.0);
        let curve = [Vector3::new(-0.1, 0.0, 0.055), Vector3::new(-0.05, 0.0, down), Vector3::new(0.06, 0.0, down)];
        let target = TargetDef { points: &curve, weights: &[[0.0, 0.0], [0.5, 1.0]], ..TargetDef::default() };
        solver.set_targets(&ids, &[target], FRAME).unwrap();
        let report = solver.step(FRAME, 4).unwrap();
        assert_eq!(report.quarantined, 0, "frame {frame}");
        assert!(depth(&solver) < 2.0 * tolerance, "frame {frame}: {} m deep", depth(&solver));
        pressed |= report.contact.contacts > 0;
    }
    let distance = solver.target_distances(&ids).unwrap()[0].unwrap();
    assert!(pressed && distance > 2e-3, "the target is inside the ball: {distance} m away");
}

#[test]
fn a_snapshot_goes_on_to_the_bit_in_the_middle_of_a_motion() {
    let defs = hair(10);
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let ids = solver.add_strands(&defs).unwrap();
    follow(&mut solver, &ids, &defs, &[[0.0, 1.0], [1.0, 0.3]], 0.0, 2);
    let curves: Vec<_> = defs.iter().map(|def| rigged(def, 4.0)).collect();
    let targets: Vec<_> = curves.iter().map(|points| TargetDef { points, ..TargetDef::default() }).collect();
    solver.set_targets(&ids, &targets, 4.0 * FRAME).unwrap();
    solver.step(FRAME, 2).unwrap();
    let image = solver.snapshot();
    let go_on = |solver: &mut Solver| {
        for _ in 0..6 {
            solver.step(FRAME, 2).unwrap();
        }
        solver.state_hash()
    };
    let end = go_on(&mut solver);
    let mut other = Solver::new(SolverOptions::default()).unwrap();
    other.restore(&image).unwrap();
    assert_eq!(other.snapshot(), image);
    assert_eq!(other.target_distances(&ids).unwrap().iter().filter(|distance| distance.is_some()).count(), ids.len());
    assert_eq!(go_on(&mut other), end);
    // The target is state: without it the run ends elsewhere.
    other.restore(&image).unwrap();
    other.clear_targets(&ids).unwrap();
    assert_ne!(go_on(&mut other), end);
}

#[test]
fn a_teleport_takes_the_target_along_and_a_jump_takes_it_to_its_end() {
    let def = StrandDef::straight(0.15, 8);
    let curve = [Vector3::zeros(), Vector3::new(0.1, 0.0, 0.1)];
    let made = || {
        let mut solver = Solver::new(SolverOptions::default()).unwrap();
        let ids = solver.add_strands(std::slice::from_ref(&def)).unwrap();
        let target = TargetDef { points: &curve, weights: &[[0.0, 1.0]], ..TargetDef::default() };
        solver.set_targets(&ids, &[target], 0.0).unwrap();
        for _ in 0..30 {
            solver.step(FRAME, 2).unwrap();
        }
        (solver, ids)
    };
    let (mut solver, ids) = made();
    let before = solver.target_distances(&ids).unwrap()[0].unwrap();
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 2.0, -0.5));
    let to = Frame { origin: Vector3::new(3.0, -1.0, 0.5), rotation: turn };
    solver.teleport_roots(&ids, &[to]).unwrap();
    let after = solver.target_distances(&ids).unwrap()[0].unwrap();
    assert!((after - before).abs() < 1e-9, "{before} {after}");

    // A root that goes 2 m within a frame, and its curve with it: nothing is flung about between the two.
    let (mut solver, ids) = made();
    let shift = Vector3::new(0.0, 2.0, 0.0);
    let there = curve.map(|point| point + shift);
    let target = TargetDef { points: &there, weights: &[[0.0, 1.0]], ..TargetDef::default() };
    solver.set_root_frames(&ids, &[Frame { origin: shift, ..Frame::default() }], FRAME).unwrap();
    solver.set_targets(&ids, &[target], FRAME).unwrap();
    let report = solver.step(FRAME, 2).unwrap();
    assert_eq!(report.carried, 1);
    let after = solver.target_distances(&ids).unwrap()[0].unwrap();
    assert!((after - before).abs() < 1e-6, "{before} {after}");
}

#[test]
fn longer_and_shorter_strands_keep_their_places_on_the_curve() {
    let def = StrandDef::straight(0.2, 10);
    let curve = [Vector3::zeros(), Vector3::new(0.0, 0.1, 0.0), Vector3::new(0.1, 0.1, 0.0)];
    let target = TargetDef { points: &curve, weights: &[[0.0, 0.0], [0.2, 1.0]], ..TargetDef::default() };
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let ids = solver.add_strands(&[def.clone(), def.clone()]).unwrap();
    solver.set_targets(&ids, &[target, target], 0.0).unwrap();
    solver.cut(&ids[..1], &[0.12]).unwrap();
    solver.set_element_count(&ids[1..], 20).unwrap();
    for _ in 0..60 {
        solver.step(FRAME, 2).unwrap();
    }
    // (The corner is rounded.)
    for (id, length) in ids.iter().zip([0.12, 0.2]) {
        let tip = points(&solver, *id, 2)[1];
        let expected = Vector3::new(length - 0.1, 0.1, 0.0);
        assert!((tip - expected).norm() < 0.012, "{tip} {expected}");
    }
}

#[test]
fn the_reference_integrator_refuses_targets() {
    let mut solver = Solver::new(with(Integrator::Reference, Precision::F64)).unwrap();
    let ids = solver.add_strands(&[StrandDef::straight(0.1, 3)]).unwrap();
    let curve = [Vector3::zeros(), Vector3::new(0.1, 0.0, 0.0)];
    solver.set_targets(&ids, &[TargetDef { points: &curve, ..TargetDef::default() }], 0.0).unwrap();
    assert!(matches!(solver.step(FRAME, 1), Err(Error::Unsupported { .. })));
    solver.clear_targets(&ids).unwrap();
    solver.step(FRAME, 1).unwrap();
}

#[test]
fn bad_targets_are_named_and_change_nothing() {
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let ids = solver.add_strands(&hair(2)).unwrap();
    let curve = [Vector3::zeros(), Vector3::new(0.1, 0.0, 0.0)];
    let good = TargetDef { points: &curve, ..TargetDef::default() };
    let nowhere = [Vector3::zeros(); 3];
    let broken = [Vector3::zeros(), Vector3::new(f64::NAN, 0.0, 0.0)];
    let cases: &[(TargetDef, &str)] = &[
        (TargetDef { points: &curve[..1], ..good }, "targets[1].points"),
        (TargetDef { points: &nowhere, ..good }, "targets[1].points"),
        (TargetDef { points: &broken, ..good }, "targets[1].points[1][0]"),
        (TargetDef { arclengths: Some(&[0.0]), ..good }, "targets[1].arclengths"),
        (TargetDef { arclengths: Some(&[0.1, 0.1]), ..good }, "targets[1].arclengths[1]"),
        (TargetDef { arclengths: Some(&[-0.1, 0.1]), ..good }, "targets[1].arclengths[0]"),
        (TargetDef { weights: &[], ..good }, "targets[1].weights"),
        (TargetDef { weights: &[[0.0, 1.5]], ..good }, "targets[1].weights[0][1]"),
        (TargetDef { weights: &[[1.1, 1.0]], ..good }, "targets[1].weights[0][0]"),
        (TargetDef { weights: &[[0.5, 1.0], [0.5, 0.0]], ..good }, "targets[1].weights[1]"),
        (TargetDef { time_constant: 0.0, ..good }, "targets[1].time_constant"),
    ];
    for (bad, name) in cases {
        match solver.set_targets(&ids, &[good, *bad], 0.0) {
            Err(Error::InvalidArgument { argument, .. }) => assert_eq!(&argument, name),
            other => panic!("{name}: {other:?}"),
        }
    }
    assert!(solver.set_targets(&ids, &[good], 0.0).is_err());
    assert!(solver.set_targets(&ids, &[good, good], -1.0).is_err());
    assert_eq!(solver.target_distances(&ids).unwrap(), [None, None]);
    let gone = ids[1];
    solver.remove_strands(&[gone]).unwrap();
    assert!(matches!(solver.set_targets(&[gone], &[good], 0.0), Err(Error::InvalidId { .. })));
    assert!(matches!(solver.clear_targets(&[gone]), Err(Error::InvalidId { .. })));
    assert!(matches!(solver.target_distances(&[gone]), Err(Error::InvalidId { .. })));
}
