//! The reference integrator meets its tolerance: against the independent oracle, in energy, at rest, with frozen freedoms.

use std::sync::Arc;

use crate::oracle_cases::{self, Case};
use nalgebra::{UnitQuaternion, Vector3};
use superhelix::internals::math::quadrature::Rules;
use superhelix::internals::rod::kinematics::Kinematics;
use superhelix::internals::rod::strand::StrandModel;
use superhelix::internals::step;
use superhelix::internals::step::pack::members::One;
use superhelix::internals::step::scratch::StepScratch;
use superhelix::internals::step::state::{StrandState, rotation_matrix};
use superhelix::internals::step::{Setting, Surroundings};
use superhelix::{
    BodyDef, ConstraintDef, ContactOptions, Frame, Freedoms, Hold, Integrator, Shape, Solver, SolverOptions, StepOptions,
    StrandContact, StrandDef, StrandId,
};

fn options(reference_tolerance: f64) -> StepOptions {
    // Its steps have fine rules of their own; reported energies use those of the options.
    StepOptions { integrator: Integrator::Reference, reference_tolerance, quadrature_tolerance: 1e-12, ..StepOptions::default() }
}

fn solver(tolerance: f64) -> Solver {
    Solver::new(SolverOptions { step: options(tolerance), ..SolverOptions::default() }).unwrap()
}

/// Largest distance of two paths in units of the length.
fn apart(case: &Case, one: &[Vector3<f64>], other: &[Vector3<f64>]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).norm() / case.def.length()).fold(0.0, f64::max)
}

/// The tip at the case's times, and Newton's iterations in all. The root is followed itself: the moves between two
/// frames that a solver makes are exact at the frames only.
fn follow(case: &Case, tolerance: f64, h: f64) -> (Vec<Vector3<f64>>, u32) {
    let rules = Rules::new(options(tolerance).quadrature_tolerance);
    let def = &case.def;
    let model = StrandModel::new(def.element_lengths.clone(), def.natural.clone(), def.material, def.freedoms);
    let count = model.element_count();
    let mut state = StrandState::new(
        &model,
        &rules,
        def.natural.clone(),
        vec![[0.0; 3]; count],
        def.root,
        Vector3::zeros(),
        Vector3::zeros(),
    );
    let surroundings = Surroundings { gravity: Vector3::new(0.0, 0.0, -9.81).into(), wind: Vector3::zeros().into() };
    let options = options(tolerance);
    let setting = Setting { surroundings: &surroundings, options: &options, rules: &rules };
    let mut scratch = StepScratch::default();
    let mut kinematics = Kinematics::default();
    let (mut tips, mut iterations) = (Vec::new(), 0);
    let mut t = 0.0;
    for time in &case.times {
        let steps = ((time - t) / h).round().max(1.0);
        let h = (time - t) / steps;
        for step in 0..steps as u32 {
            let from = t + h * f64::from(step);
            let root_at = |elapsed: f64| case.root.map_or(def.root, |root| root.at(from + elapsed));
            let outcome = step::take(
                &setting,
                &mut One { model: &model, state: &mut state, root_at: &root_at, target: None, touches: None },
                h,
                &mut scratch,
            );
            assert!(outcome.converged && !outcome.quarantined, "{} at {tolerance:e}, {from} s", case.name);
            iterations += outcome.iterations;
        }
        t = *time;
        kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rules.rule(state.rule));
        tips.push(Vector3::from(kinematics.elements[count - 1].origin_right()) + state.root.origin);
    }
    (tips, iterations)
}

#[test]
fn it_meets_its_tolerance_on_every_reference_trajectory() {
    for case in oracle_cases::all() {
        // The accuracy of the oracle.
        let known = case.uncertainty / case.def.length();
        let mut last = f64::INFINITY;
        let tolerances: &[f64] =
            if case.name == "stiff_planar_n1" { &[1e-3, 1e-5, 1e-7, 1e-9, 1e-10] } else { &[1e-3, 1e-5, 1e-7, 1e-9] };
        for &tolerance in tolerances {
            let (tips, iterations) = follow(&case, tolerance, 1.0 / 60.0);
            let error = apart(&case, &tips, &case.tips);
            println!("{} {tolerance:e}: error {error:.2e} L, {iterations} iterations; oracle good to {known:.1e} L", case.name);
            assert!(error <= 10.0 * tolerance + known, "{} at {tolerance:e}: {error:e}", case.name);
            // One step a call is often better than asked.
            assert!(error <= 3.0 * last + known, "{} at {tolerance:e}: {error:e} after {last:e}", case.name);
            last = error;
        }
    }
}

#[test]
fn it_meets_tolerances_that_the_oracle_cannot_judge() {
    // Against itself at a tolerance a hundred times tighter.
    for case in oracle_cases::all() {
        let exact = follow(&case, 1e-11, 1.0 / 60.0).0;
        let oracle = apart(&case, &exact, &case.tips);
        for tolerance in [1e-7, 1e-8, 1e-9] {
            let (tips, iterations) = follow(&case, tolerance, 1.0 / 60.0);
            let error = apart(&case, &tips, &exact);
            println!(
                "{} {tolerance:e}: {error:.2e} L from 1e-11, {iterations} iterations; oracle {oracle:.2e} L from it",
                case.name
            );
            assert!(error <= 10.0 * tolerance, "{} at {tolerance:e}: {error:e}", case.name);
        }
    }
}

#[test]
fn its_own_steps_do_not_depend_on_the_hosts() {
    // Calls of 1/60 s and of half a second give the same path to the tolerance.
    for case in oracle_cases::all().into_iter().filter(|case| case.name == "curly_elliptic_n3") {
        for h in [1.0 / 600.0, 1.0 / 60.0] {
            let (tips, iterations) = follow(&case, 1e-6, h);
            let error = apart(&case, &tips, &case.tips);
            println!("calls of {h} s: {error:.2e} L, {iterations} iterations");
            assert!(error <= 1e-5);
        }
    }
}

fn hair(count: usize) -> StrandDef {
    let mut def = StrandDef::straight(0.15, count);
    def.natural = vec![[4.0, 25.0, 10.0]; count];
    def
}

#[test]
fn energy_is_kept_to_the_tolerance() {
    // Undamped, released from the side: what is lost is in proportion to the tolerance and far below what the fall turned over.
    for count in [1, 3] {
        let mut first = None;
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let mut solver = solver(tolerance);
            let mut def = StrandDef::straight(0.15, count);
            def.material.radius = [150e-6; 2];
            let id = solver.add_strands(&[def]).unwrap()[0];
            let total = |solver: &Solver| {
                let energies = solver.energies(id).unwrap();
                energies.kinetic + energies.elastic + energies.gravity
            };
            let (start, mut drift, mut turned_over) = (total(&solver), 0.0_f64, 0.0_f64);
            for _ in 0..4 {
                let report = solver.step(0.05, 1).unwrap();
                assert_eq!((report.unconverged, report.quarantined), (0, 0));
                drift = drift.max((total(&solver) - start).abs());
                turned_over = turned_over.max(report.energies.kinetic);
            }
            let relative = drift / turned_over;
            println!("N = {count}, {tolerance:e}: energy off by {relative:e} of the kinetic");
            assert!(relative <= 10.0 * tolerance, "N = {count}, {tolerance:e}: {relative:e}");
            let first = *first.get_or_insert(relative);
            assert!(tolerance > 1e-4 || relative < 0.1 * first, "N = {count}, {tolerance:e}: {relative:e}, {first:e} at first");
        }
    }
}

#[test]
fn a_strand_at_rest_stays_at_rest() {
    // Without weight the natural shape is at rest to the bit; under weight a strand that friction has stopped hangs still.
    let mut weightless =
        Solver::new(SolverOptions { step: options(1e-10), gravity: Vector3::zeros(), ..SolverOptions::default() }).unwrap();
    let id = weightless.add_strands(&[hair(4)]).unwrap()[0];
    for _ in 0..5 {
        assert_eq!(weightless.step(0.1, 1).unwrap().unconverged, 0);
    }
    for row in weightless.curvatures(id).unwrap() {
        for (now, natural) in row.iter().zip([4.0, 25.0, 10.0]) {
            assert!((now - natural).abs() < 1e-10, "{now}");
        }
    }
    let mut hanging = solver(1e-7);
    let mut def = hair(2);
    def.material.viscosity = 0.3;
    def.material.air_drag = 1e-3;
    let id = hanging.add_strands(&[def]).unwrap()[0];
    let tip = |solver: &Solver| {
        let mut tip = (Vector3::zeros(), Vector3::zeros());
        solver.sample_at(id, &[0.15], |_, sample| tip = (sample.position, sample.velocity)).unwrap();
        tip
    };
    hanging.step(20.0, 1).unwrap();
    let before = tip(&hanging);
    let report = hanging.step(1.0, 1).unwrap();
    let after = tip(&hanging);
    assert_eq!(report.unconverged, 0);
    assert!((after.0 - before.0).norm() < 1e-6 * 0.15 && after.1.norm() < 1e-5, "{before:?} {after:?}");
    // What rests pulls at its follicle with its weight.
    let material = hair(1).material;
    let weight = material.density * std::f64::consts::PI * material.radius[0] * material.radius[1] * 0.15 * 9.81;
    let force = hanging.root_wrench(id).unwrap().force;
    assert!((force - Vector3::new(0.0, 0.0, -weight)).norm() < 1e-4 * weight, "{force} {weight}");
}

#[test]
fn frozen_freedoms_stay_and_the_others_meet_the_tolerance() {
    // Bending about one axis only, in the plane: the same as the whole strand, whose motion from this shape stays in that plane.
    let tip = |freedoms: Freedoms| {
        let mut solver = solver(1e-8);
        let mut def = StrandDef::straight(0.15, 3);
        def.material.radius = [150e-6; 2];
        def.material.air_drag = 2e-5;
        def.freedoms = freedoms;
        let id = solver.add_strands(&[def]).unwrap()[0];
        for _ in 0..6 {
            assert_eq!(solver.step(1.0 / 60.0, 1).unwrap().unconverged, 0);
        }
        for row in solver.curvatures(id).unwrap() {
            for axis in (0..3).filter(|axis| !freedoms.contains(*axis)) {
                assert_eq!(row[axis], 0.0);
            }
        }
        let mut tip = Vector3::zeros();
        solver.sample_at(id, &[0.15], |_, sample| tip = sample.position).unwrap();
        tip
    };
    let all = tip(Freedoms::ALL);
    assert!(all.z < -0.01);
    // n0 = x, n1 = y, n2 = z: falling along z bends about n1.
    for freedoms in [Freedoms::BEND1, Freedoms::BEND1.union(Freedoms::TWIST), Freedoms::BEND1.union(Freedoms::BEND2)] {
        let some = tip(freedoms);
        assert!((some - all).norm() < 1e-7 * 0.15, "{freedoms:?}: {}", (some - all).norm());
    }
}

#[test]
fn steps_are_as_short_as_the_motion_asks() {
    // A host's steps of one length cost many iterations while the strand whips and few once friction has calmed it.
    let mut solver = solver(1e-6);
    let mut def = StrandDef::straight(0.15, 2);
    def.material.radius = [150e-6; 2];
    def.material.air_drag = 3e-4;
    def.material.viscosity = 0.02;
    let id = solver.add_strands(&[def]).unwrap()[0];
    let work: Vec<u32> = (0..40)
        .map(|_| {
            solver.step(0.05, 1).unwrap();
            solver.iterations(id).unwrap()
        })
        .collect();
    println!("{work:?}");
    assert!(work[0] > 3 * work[39], "{work:?}");
}

#[test]
fn a_root_that_starts_with_a_jerk_strikes_the_strand() {
    // A resting root with a new target starts smoothly; one with an initial velocity that does not move stops at once.
    // The strand keeps its generalised momenta: the follicle alone can push.
    let mut solver =
        Solver::new(SolverOptions { step: options(1e-8), gravity: Vector3::zeros(), ..SolverOptions::default() }).unwrap();
    let mut def = StrandDef::straight(0.1, 1);
    def.material.radius = [200e-6; 2];
    def.root_velocity = Vector3::new(0.0, 0.0, 0.2);
    let id = solver.add_strands(&[def]).unwrap()[0];
    let before = solver.energies(id).unwrap().kinetic;
    let h = 1e-6;
    assert_eq!(solver.step(h, 1).unwrap().unconverged, 0);
    // A straight element that starts to bend about its root: r = (s, 0, −κ s²/2), so that ∫ s² v ds/2 is kept and κ̇ = −(10/3) v/L².
    let rate = solver.rates(id).unwrap()[0][1];
    let expected = -10.0 / 3.0 * 0.2 / (0.1 * 0.1);
    assert!((rate - expected).abs() < 1e-3 * expected.abs(), "{rate} {expected}");
    // Of ½ m v² the clamp takes 1 − 5/9.
    let after = solver.energies(id).unwrap().kinetic;
    assert!((after / before - 5.0 / 9.0).abs() < 1e-3, "{after} {before}");
}

#[test]
fn a_moving_root_is_followed_through_the_solver_and_snapshots_keep_the_tolerance() {
    let frame = |t: f64| Frame {
        origin: Vector3::new(0.0, 0.02 * (9.0 * t).sin(), 0.0),
        rotation: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5 * (9.0 * t).sin()),
    };
    let run = |tolerance: f64, substeps: u32| {
        let mut solver = solver(tolerance);
        let id = solver.add_strands(&[hair(2)]).unwrap()[0];
        for step in 1..=6 {
            solver.set_root_frames(&[id], &[frame(f64::from(step) / 60.0)], 1.0 / 60.0).unwrap();
            let report = solver.step(1.0 / 60.0, substeps).unwrap();
            assert_eq!((report.unconverged, report.quarantined), (0, 0));
            if step == 3 {
                let image = solver.snapshot();
                let mut other = Solver::new(SolverOptions::default()).unwrap();
                other.restore(&image).unwrap();
                assert_eq!(other.options().step, options(tolerance));
                assert_eq!(other.state_hash(), solver.state_hash());
                solver = other;
            }
        }
        let mut tip = Vector3::zeros();
        solver.sample_at(id, &[0.15], |_, sample| tip = sample.position).unwrap();
        tip
    };
    let exact = run(1e-8, 1);
    // However the host cuts its steps, and to each tolerance.
    for (tolerance, substeps) in [(1e-8, 3), (1e-5, 1), (1e-3, 1)] {
        let error = (run(tolerance, substeps) - exact).norm() / 0.15;
        println!("{tolerance:e} in {substeps}: {error:e}");
        assert!(error <= 10.0 * tolerance, "{tolerance:e} in {substeps}: {error:e}");
    }
}

#[test]
fn a_tolerance_out_of_range_is_named() {
    for value in [0.0, 1e-13, 0.1, -1e-8, f64::NAN, f64::INFINITY] {
        let error = Solver::new(SolverOptions { step: options(value), ..SolverOptions::default() }).unwrap_err().to_string();
        assert!(error.contains("reference_tolerance"), "{error}");
    }
}

/// It has no step for strands that are in contact or constrained, and says so in place of taking another integrator's; what could touch and is not
/// to, a body without strands for it or hair without wisps, is no reason.
#[test]
fn constrained_strands_are_refused_and_nothing_is_changed() {
    let refused = |arrange: &dyn Fn(&mut Solver, StrandId), by: &str| {
        let mut solver = solver(1e-6);
        let id = solver.add_strands(&[hair(1)]).unwrap()[0];
        arrange(&mut solver, id);
        let before = solver.state_hash();
        let told = solver.step(1.0 / 60.0, 1).map_err(|error| error.to_string());
        match told {
            Ok(_) => assert_eq!(by, "", "it stepped"),
            Err(told) => {
                assert!(!by.is_empty() && told.contains("integrator is reference") && told.contains(by), "{told}");
                assert_eq!(solver.state_hash(), before, "{told}");
            }
        }
    };
    let ball = |solver: &mut Solver, group| {
        let def = BodyDef::new(Arc::new(Shape::new_sphere(0.01).unwrap()));
        let pose = Frame { origin: Vector3::new(0.0, 9.0, 0.0), ..Frame::default() };
        solver.add_bodies(vec![BodyDef { pose, group, ..def }]).unwrap();
    };
    let hair = |solver: &mut Solver, id, wisp_radius| {
        solver.set_contact_options(&ContactOptions { hair: true, ..ContactOptions::default() }).unwrap();
        solver.set_contact(&[id], Some(&StrandContact { wisp_radius, mask: 1, ..StrandContact::default() })).unwrap();
    };
    refused(&|solver, _| ball(solver, 1), "");
    refused(&|solver, id| (ball(solver, 2), hair(solver, id, 0.0)).1, "");
    refused(&|solver, id| (ball(solver, 1), hair(solver, id, 0.0)).1, "contact may");
    refused(&|solver, id| hair(solver, id, 1e-3), "contact may");
    let pin = |solver: &mut Solver, strand| {
        let target = Frame::default();
        let pin = ConstraintDef { strand, arclength: 0.0, hold: Hold::Point, target, compliance: 0.0 };
        solver.add_constraints(&[pin]).unwrap();
    };
    refused(&|solver, id| pin(solver, id), "constraints may");
}
