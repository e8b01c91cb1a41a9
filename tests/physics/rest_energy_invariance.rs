//! The solver against theory: a resting strand stays, a falling one keeps its energy to the order of the step, the follicle carries the weight,
//! frozen freedoms, frames of reference.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::natural_under_gravity;
use superhelix::{Frame, Freedoms, Integrator, LinearSolver, Material, Solver, SolverOptions, StrandDef, StrandId, StrandStatus};

const GRAVITY: Vector3<f64> = Vector3::new(0.0, 0.0, -9.81);

fn turn(x: f64, y: f64, z: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(Vector3::new(x, y, z))
}

/// A curl with its natural shape chosen so that it rests under gravity in the shape `curl`.
fn resting_curl(count: usize, curl: [f64; 3]) -> StrandDef {
    let mut def = StrandDef::straight(0.12, count);
    def.material = Material { radius: [60e-6, 50e-6], youngs_modulus: 4e9, ..Material::default() };
    def.root = Frame { origin: Vector3::new(0.3, -0.2, 1.6), rotation: turn(0.4, 1.9, -0.3) };
    let shape = vec![curl; count];
    def.natural = natural_under_gravity(&def, &shape, GRAVITY).unwrap();
    def.initial = Some(shape);
    def
}

fn one(options: SolverOptions, def: &StrandDef) -> (Solver, StrandId) {
    let mut solver = Solver::new(options).unwrap();
    let id = solver.add_strands(std::slice::from_ref(def)).unwrap()[0];
    (solver, id)
}

fn points(solver: &Solver, id: StrandId, count: usize) -> Vec<Vector3<f64>> {
    let mut out = Vec::new();
    solver.sample_strands(&[id], count, |_, _, sample| out.push(sample.position)).unwrap();
    out
}

fn furthest(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

fn with(integrator: Integrator) -> SolverOptions {
    let mut options = SolverOptions::default();
    options.step.integrator = integrator;
    options
}

#[test]
fn a_balanced_strand_rests_to_rounding_for_ten_seconds() {
    for def in [resting_curl(5, [0.0; 3]), resting_curl(5, [3.0, 20.0, 5.0]), resting_curl(20, [20.0, 150.0, 0.0])] {
        for integrator in [Integrator::ImplicitEuler, Integrator::SecondOrder] {
            let (mut solver, id) = one(with(integrator), &def);
            let before = points(&solver, id, 40);
            for _ in 0..600 {
                let report = solver.step(1.0 / 60.0, 1).unwrap();
                assert_eq!((report.unconverged, report.quarantined), (0, 0));
            }
            let moved = furthest(&before, &points(&solver, id, 40));
            assert!(moved < 1e-12, "{integrator:?}: moved {moved:e} m");
        }
    }
}

#[test]
fn the_follicle_feels_the_weight_at_rest() {
    for integrator in [Integrator::ImplicitEuler, Integrator::LinearlyImplicit, Integrator::SecondOrder] {
        for curl in [[0.0; 3], [3.0, 20.0, 5.0], [20.0, 150.0, 0.0]] {
            let def = resting_curl(6, curl);
            let (mut solver, id) = one(with(integrator), &def);
            solver.step(1.0 / 60.0, 1).unwrap();
            let wrench = solver.root_wrench(id).unwrap();
            let weight = GRAVITY * (def.material.linear_density() * def.length());
            assert!((wrench.force - weight).norm() < 1e-9 * weight.norm(), "{integrator:?}: {} {weight}", wrench.force);
            // The moment is the weight at the centre of mass, found here by sampling (trapezoidal rule on 2000 points: 1e-6).
            let all = points(&solver, id, 2001);
            let mut centre = Vector3::zeros();
            for (k, point) in all.iter().enumerate() {
                centre += point * if k == 0 || k == 2000 { 0.5 } else { 1.0 } / 2000.0;
            }
            let torque = (centre - def.root.origin).cross(&weight);
            assert!((wrench.torque - torque).norm() < 1e-5 * weight.norm() * def.length(), "{} {torque}", wrench.torque);
        }
    }
}

#[test]
fn undamped_energy_is_lost_at_first_order_in_the_step() {
    // A curved strand of three elements let go: total energy is a constant of the motion, and implicit Euler loses a fraction of it that
    // halves with the step.
    let mut def = StrandDef::straight(0.1, 3);
    def.material = Material { radius: [80e-6, 60e-6], youngs_modulus: 3e9, ..Material::default() };
    def.natural = vec![[5.0, 20.0, 0.0]; 3];
    let mut losses = Vec::new();
    for steps in [400, 800, 1600, 3200] {
        let (mut solver, id) = one(with(Integrator::ImplicitEuler), &def);
        let total = |solver: &Solver| {
            let e = solver.energies(id).unwrap();
            e.kinetic + e.elastic + e.gravity
        };
        let start = total(&solver);
        let mut exchanged = 0.0_f64;
        let mut worst = 0.0_f64;
        for _ in 0..steps {
            let before = total(&solver);
            let report = solver.step(0.1 / f64::from(steps), 1).unwrap();
            assert!(total(&solver) <= before + 1e-15 * start.abs().max(1e-9), "energy grew");
            exchanged = exchanged.max(report.energies.kinetic);
            worst = worst.max((total(&solver) - start).abs());
        }
        losses.push(worst / exchanged);
    }
    println!("energy lost, of the largest kinetic energy: {losses:?}");
    for pair in losses.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((0.85..1.15).contains(&order), "{losses:?}");
    }
    assert!(losses[3] < 0.02);
}

#[test]
fn drag_alone_brings_the_strand_to_the_wind() {
    // A weightless, limp strand in a steady wind ends up streaming along it.
    let mut def = StrandDef::straight(0.1, 8);
    def.material.air_drag = 1e-3;
    def.root.rotation = turn(0.0, 0.0, 1.2);
    let mut options = with(Integrator::ImplicitEuler);
    options.gravity = Vector3::zeros();
    options.wind = Vector3::new(8.0, 0.0, 0.0);
    let (mut solver, id) = one(options, &def);
    for _ in 0..300 {
        solver.step(1.0 / 60.0, 1).unwrap();
    }
    let all = points(&solver, id, 20);
    let tail = (all[19] - all[14]).normalize();
    assert!(tail.x > 0.999, "{tail}");
    // At rest the follicle carries the drag of the whole strand: ν L wind.
    let wrench = solver.root_wrench(id).unwrap();
    assert!((wrench.force - Vector3::new(1e-3 * 0.1 * 8.0, 0.0, 0.0)).norm() < 1e-6 * 8e-4, "{}", wrench.force);
}

#[test]
fn free_flight_of_the_root_is_the_equivalence_principle() {
    // Gravity g with a fixed root is a root that accelerates by −g without gravity: same motion in the root's frame, step by step.
    let mut def = StrandDef::straight(0.1, 4);
    def.natural = vec![[0.0, 15.0, 4.0]; 4];
    def.material.internal_friction = 1e-10;
    let (mut fixed, a) = one(with(Integrator::ImplicitEuler), &def);
    let mut options = with(Integrator::ImplicitEuler);
    options.gravity = Vector3::zeros();
    // Implicit Euler's own parabola: velocity grows by g h a step, position by the new velocity h.
    let (mut falling, b) = one(options, &def);
    let h = 1.0 / 240.0;
    let mut root = def.root;
    for step in 1..=120 {
        fixed.step(h, 1).unwrap();
        root.origin -= GRAVITY * (h * h * f64::from(step));
        falling.set_root_frames(&[b], &[root], h).unwrap();
        falling.step(h, 1).unwrap();
        let shifted: Vec<_> = points(&falling, b, 10).iter().map(|p| p - root.origin).collect();
        let apart = furthest(&points(&fixed, a, 10), &shifted);
        assert!(apart < 1e-9, "step {step}: {apart:e}");
    }
}

#[test]
fn the_world_has_no_preferred_direction_or_place() {
    let mut def = StrandDef::straight(0.1, 5);
    def.natural = vec![[4.0, 25.0, 0.0]; 5];
    def.material = Material { radius: [50e-6, 40e-6], air_drag: 1e-5, ..Material::default() };
    let pose = Frame { origin: Vector3::new(3.0, -70.0, 12.0), rotation: turn(0.5, -1.1, 2.0) };
    let mut turned = def.clone();
    turned.root = pose.compose(&def.root);
    let mut options = with(Integrator::ImplicitEuler);
    let (mut plain, a) = one(options.clone(), &def);
    options.gravity = pose.rotation * GRAVITY;
    let (mut other, b) = one(options, &turned);
    for _ in 0..60 {
        plain.step(1.0 / 60.0, 1).unwrap();
        other.step(1.0 / 60.0, 1).unwrap();
    }
    let moved: Vec<_> = points(&plain, a, 10).iter().map(|p| pose.origin + pose.rotation * p).collect();
    let apart = furthest(&moved, &points(&other, b, 10));
    assert!(apart < 1e-9, "{apart:e}");
}

#[test]
fn frozen_freedoms_stay_at_their_natural_value_and_the_rest_moves() {
    for bits in 1..8_u32 {
        for integrator in [Integrator::ImplicitEuler, Integrator::LinearlyImplicit, Integrator::SecondOrder] {
            for solver_kind in [LinearSolver::LinearTime, LinearSolver::DenseCholesky] {
                let mut def = StrandDef::straight(0.1, 5);
                def.freedoms = Freedoms::from_bits("freedoms", bits).unwrap();
                def.natural = vec![[3.0, 18.0, -6.0]; 5];
                // Implicit in both integrators; γ is explicit in the papers' step and blows up on twist, which has no inertia.
                def.material.viscosity = 1e-3;
                let mut options = with(integrator);
                options.step.linear_solver = solver_kind;
                let (mut solver, id) = one(options, &def);
                for _ in 0..20 {
                    let report = solver.step(1e-3, 1).unwrap();
                    assert_eq!((report.unconverged, report.quarantined), (0, 0), "{bits} {integrator:?}");
                }
                let now = solver.curvatures(id).unwrap();
                for axis in 0..3 {
                    let moved = now.iter().map(|row| (row[axis] - def.natural[0][axis]).abs()).fold(0.0, f64::max);
                    assert_eq!(moved == 0.0, !def.freedoms.contains(axis), "axis {axis} of {bits}: {moved}");
                }
            }
        }
    }
}

#[test]
fn a_strand_of_three_freedoms_that_stays_planar_is_a_strand_of_one() {
    // Gravity in the plane of κ2: twist and κ1 stay 0 by symmetry, so freezing them changes nothing.
    let mut def = StrandDef::straight(0.1, 6);
    def.root.rotation = turn(std::f64::consts::FRAC_PI_2, 0.0, 0.0); // n1 = z: κ2 bends in the vertical plane
    let (mut three, a) = one(with(Integrator::ImplicitEuler), &def);
    def.freedoms = Freedoms::BEND2;
    let (mut single, b) = one(with(Integrator::ImplicitEuler), &def);
    for _ in 0..60 {
        three.step(1.0 / 120.0, 1).unwrap();
        single.step(1.0 / 120.0, 1).unwrap();
        assert!(furthest(&points(&three, a, 10), &points(&single, b, 10)) < 1e-9);
    }
    assert!(points(&three, a, 2)[1].z < -0.02);
}

#[test]
fn a_teleport_keeps_the_shape_and_gives_no_kick() {
    let def = resting_curl(5, [3.0, 20.0, 5.0]);
    let (mut solver, id) = one(with(Integrator::ImplicitEuler), &def);
    let (mut still, other) = one(with(Integrator::ImplicitEuler), &def);
    let lift = Vector3::new(100.0, -40.0, 7.0);
    let target = Frame { origin: def.root.origin + lift, rotation: def.root.rotation };
    solver.teleport_roots(&[id], &[target]).unwrap();
    for _ in 0..30 {
        solver.step(1.0 / 60.0, 1).unwrap();
        still.step(1.0 / 60.0, 1).unwrap();
        let back: Vec<_> = points(&solver, id, 20).iter().map(|p| p - lift).collect();
        assert!(furthest(&back, &points(&still, other, 20)) < 1e-11);
    }
    // In the middle of a motion the velocity goes along with the turn.
    let mut def = StrandDef::straight(0.1, 4);
    def.natural = vec![[0.0, 12.0, 0.0]; 4];
    let mut options = with(Integrator::ImplicitEuler);
    options.gravity = Vector3::zeros();
    def.initial = Some(vec![[0.0, -12.0, 3.0]; 4]);
    let (mut solver, id) = one(options.clone(), &def);
    let (mut still, other) = one(options, &def);
    solver.step(0.01, 4).unwrap();
    still.step(0.01, 4).unwrap();
    let target = Frame { origin: Vector3::new(1.0, 2.0, 3.0), rotation: turn(1.0, 0.3, -2.0) };
    solver.teleport_roots(&[id], &[target]).unwrap();
    for _ in 0..20 {
        solver.step(0.01, 2).unwrap();
        still.step(0.01, 2).unwrap();
        let expected: Vec<_> = points(&still, other, 20).iter().map(|p| target.origin + target.rotation * p).collect();
        assert!(furthest(&points(&solver, id, 20), &expected) < 1e-9);
    }
}

#[test]
fn substeps_of_a_moving_root_follow_a_smooth_path() {
    // One call with 8 substeps is 8 calls with the frames in between, for a root in uniform motion.
    let mut def = StrandDef::straight(0.1, 4);
    def.material.internal_friction = 1e-9;
    def.root_velocity = Vector3::new(0.4, 0.0, 0.0);
    let (mut coarse, a) = one(with(Integrator::ImplicitEuler), &def);
    let (mut fine, b) = one(with(Integrator::ImplicitEuler), &def);
    let frame = |t: f64| Frame { origin: Vector3::new(0.4 * t, 0.0, 0.0), ..def.root };
    for tick in 1..=20 {
        let t = f64::from(tick) / 30.0;
        coarse.set_root_frames(&[a], &[frame(t)], 1.0 / 30.0).unwrap();
        coarse.step(1.0 / 30.0, 8).unwrap();
        for part in 1..=8 {
            let t = (f64::from(tick - 1) + f64::from(part) / 8.0) / 30.0;
            fine.set_root_frames(&[b], &[frame(t)], 1.0 / 240.0).unwrap();
            fine.step(1.0 / 240.0, 1).unwrap();
        }
        assert!(furthest(&points(&coarse, a, 10), &points(&fine, b, 10)) < 1e-9);
        assert_eq!(coarse.root_frame(a).unwrap().origin, frame(t).origin);
    }
}

#[test]
fn dense_and_linear_time_solvers_take_the_same_path() {
    let mut def = StrandDef::straight(0.15, 6);
    def.natural = vec![[10.0, 40.0, 0.0]; 6];
    def.material = Material { radius: [50e-6, 40e-6], internal_friction: 1e-10, air_drag: 1e-5, ..Material::default() };
    let mut ends = Vec::new();
    for kind in [
        LinearSolver::LinearTime,
        LinearSolver::DenseCholesky,
        LinearSolver::DenseConjugateGradients,
        LinearSolver::DenseSingularValues,
    ] {
        let mut options = with(Integrator::ImplicitEuler);
        options.step.linear_solver = kind;
        options.step.tolerance = 1e-9;
        let (mut solver, id) = one(options, &def);
        let mut condition = 0.0_f64;
        for _ in 0..60 {
            let report = solver.step(1.0 / 120.0, 1).unwrap();
            assert_eq!(report.unconverged, 0, "{kind:?}");
            condition = condition.max(report.max_condition);
        }
        assert_eq!(condition > 1.0, kind == LinearSolver::DenseSingularValues, "{kind:?}: {condition}");
        ends.push(points(&solver, id, 20));
    }
    for end in &ends[1..] {
        let apart = furthest(&ends[0], end);
        assert!(apart < 1e-9, "{apart:e}");
    }
}

#[test]
fn the_papers_step_converges_where_it_is_stable() {
    // Calm and damped: the linearly implicit step and implicit Euler tend to the same motion as the step shrinks.
    let mut def = StrandDef::straight(0.06, 3);
    def.material = Material { radius: [90e-6; 2], youngs_modulus: 4e8, viscosity: 2e-4, air_drag: 2e-5, ..Material::default() };
    def.natural = vec![[2.0, 10.0, 0.0]; 3];
    let apart: Vec<f64> = [500, 1000, 2000]
        .into_iter()
        .map(|steps| {
            let (mut papers, a) = one(with(Integrator::LinearlyImplicit), &def);
            let (mut euler, b) = one(with(Integrator::ImplicitEuler), &def);
            let start = points(&papers, a, 10);
            for _ in 0..steps {
                papers.step(0.03 / f64::from(steps), 1).unwrap();
                euler.step(0.03 / f64::from(steps), 1).unwrap();
            }
            assert!(furthest(&points(&papers, a, 10), &start) > 1e-3, "nothing moved");
            furthest(&points(&papers, a, 10), &points(&euler, b, 10))
        })
        .collect();
    println!("papers' step against implicit Euler: {apart:?}");
    assert!(apart[2] < 2e-4 && apart[0] / apart[2] > 3.0, "{apart:?}");
}

#[test]
fn a_strand_that_turns_non_finite_is_rolled_back_alone() {
    // The papers' step on a violent motion of limp hair: documented to blow up.
    let good = resting_curl(5, [0.0, 10.0, 0.0]);
    let mut bad = StrandDef::straight(0.25, 20);
    bad.material.youngs_modulus = 1e6;
    bad.initial_rates = Some(vec![[0.0, 1e150, 1e150]; 20]);
    let mut solver = Solver::new(with(Integrator::LinearlyImplicit)).unwrap();
    let ids = solver.add_strands(&[good, bad]).unwrap();
    let before = solver.curvatures(ids[1]).unwrap().to_vec();
    let mut quarantined = 0;
    for _ in 0..3 {
        quarantined += solver.step(1.0 / 30.0, 1).unwrap().quarantined;
    }
    assert!(quarantined > 0);
    assert_eq!(solver.status(ids[1]).unwrap(), StrandStatus::Quarantined);
    assert_eq!(solver.status(ids[0]).unwrap(), StrandStatus::Ok);
    assert_eq!(solver.curvatures(ids[1]).unwrap(), before);
    for row in solver.curvatures(ids[1]).unwrap().iter().chain(solver.rates(ids[1]).unwrap()) {
        assert!(row.iter().all(|x| x.is_finite()));
    }
    solver.reset_strands(&[ids[1]]).unwrap();
    assert_eq!(solver.status(ids[1]).unwrap(), StrandStatus::Ok);
}

#[test]
fn an_iteration_cap_is_reported_when_it_bites() {
    let mut def = StrandDef::straight(0.25, 10);
    def.material.youngs_modulus = 1e9;
    let mut options = with(Integrator::ImplicitEuler);
    options.step.max_iterations = 1;
    options.step.max_subdivisions = 0;
    let (mut solver, id) = one(options, &def);
    let report = solver.step(1.0 / 30.0, 1).unwrap();
    assert_eq!((report.unconverged, report.max_iterations), (1, 1));
    assert!(report.max_residual > 1e-6);
    assert_eq!(solver.status(id).unwrap(), StrandStatus::Unconverged);
}

#[test]
fn strands_from_one_to_a_thousand_elements_step() {
    for count in [1, 2, 3, 7, 100, 1000] {
        let mut def = StrandDef::straight(0.2, count);
        def.natural = vec![[2.0, 30.0, 0.0]; count];
        let (mut solver, id) = one(with(Integrator::ImplicitEuler), &def);
        for _ in 0..3 {
            let report = solver.step(1.0 / 60.0, 1).unwrap();
            assert_eq!((report.unconverged, report.quarantined), (0, 0), "{count}");
        }
        // Inextensible: the path along the samples has the strand's length, minus the chords' shortening.
        let all = points(&solver, id, 4001);
        let way: f64 = all.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
        assert!((way - 0.2).abs() < 1e-7, "{count}: {way}");
    }
}

#[test]
fn second_order_keeps_energy_better_by_the_square_of_the_step() {
    // The same curved strand as above, let go: the energy's error falls by four when the step is halved, and at 1/4000 s is a hundredth of
    // implicit Euler's.
    let mut def = StrandDef::straight(0.1, 3);
    def.material = Material { radius: [80e-6, 60e-6], youngs_modulus: 3e9, ..Material::default() };
    def.natural = vec![[5.0, 20.0, 0.0]; 3];
    let mut errors = Vec::new();
    for steps in [400, 800, 1600] {
        let (mut solver, id) = one(with(Integrator::SecondOrder), &def);
        let total = |solver: &Solver| {
            let e = solver.energies(id).unwrap();
            e.kinetic + e.elastic + e.gravity
        };
        let start = total(&solver);
        let (mut exchanged, mut worst) = (0.0_f64, 0.0_f64);
        for step in 0..steps {
            let report = solver.step(0.1 / f64::from(steps), 1).unwrap();
            exchanged = exchanged.max(report.energies.kinetic);
            // The release from rest is not smooth: its few steps are of first order in the velocity.
            if step > steps / 10 {
                worst = worst.max((total(&solver) - start).abs());
            }
        }
        errors.push(worst / exchanged);
    }
    println!("energy's error, of the largest kinetic energy: {errors:?}");
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1]).log2() > 1.7, "{errors:?}");
    }
    assert!(errors[2] < 5e-4, "{errors:?}");
}

#[test]
fn the_second_order_method_bears_changes_of_step_teleports_and_new_states() {
    let mut def = StrandDef::straight(0.1, 5);
    def.natural = vec![[4.0, 25.0, 0.0]; 5];
    def.material.internal_friction = 1e-10;
    let fine = {
        let (mut solver, id) = one(with(Integrator::SecondOrder), &def);
        solver.step(0.2, 4000).unwrap();
        points(&solver, id, 10)
    };
    // Steps that grow and shrink, within and beyond what the two-step formula bears: as accurate as even ones of their mean size.
    let apart = |sizes: &[f64]| {
        let (mut solver, id) = one(with(Integrator::SecondOrder), &def);
        let (mut time, mut k) = (0.0, 0);
        while time < 0.2 - 1e-9 {
            let h = sizes[k % sizes.len()].min(0.2 - time);
            assert_eq!(solver.step(h, 1).unwrap().unconverged, 0);
            time += h;
            k += 1;
        }
        furthest(&fine, &points(&solver, id, 10))
    };
    let even = apart(&[0.001]);
    for sizes in [&[0.0008, 0.0012][..], &[0.0005, 0.0009, 0.0016], &[0.0002, 0.0018, 0.001], &[1e-5, 0.002]] {
        let uneven = apart(sizes);
        println!("{sizes:?}: {uneven:e} against {even:e}");
        assert!(uneven < 8.0 * even, "{sizes:?}: {uneven:e} against {even:e}");
    }
    // A teleport turns the past along; a new state forgets it: both as if nothing had been before.
    let target = Frame { origin: Vector3::new(1.0, 2.0, 3.0), rotation: turn(1.0, 0.3, -2.0) };
    let mut options = with(Integrator::SecondOrder);
    options.gravity = Vector3::zeros();
    def.initial = Some(vec![[0.0, -12.0, 3.0]; 5]);
    let (mut moved, a) = one(options.clone(), &def);
    let (mut still, b) = one(options.clone(), &def);
    for step in 0..20 {
        moved.step(0.005, 1).unwrap();
        still.step(0.005, 1).unwrap();
        if step == 9 {
            moved.teleport_roots(&[a], &[target]).unwrap();
        }
    }
    let expected: Vec<_> = points(&still, b, 20).iter().map(|p| target.origin + target.rotation * p).collect();
    assert!(furthest(&points(&moved, a, 20), &expected) < 1e-9);
    let (mut fresh, c) = one(options, &def);
    still.set_curvatures(b, def.initial.as_deref().unwrap(), None).unwrap();
    for _ in 0..10 {
        still.step(0.005, 1).unwrap();
        fresh.step(0.005, 1).unwrap();
    }
    assert_eq!(points(&still, b, 20), points(&fresh, c, 20));
}
