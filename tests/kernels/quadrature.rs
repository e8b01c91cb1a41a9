//! Quadrature to a tolerance: the table of rules against dense quadrature, and the rules' effect on a step.

#[path = "../../examples/quadrature/angles.rs"]
#[allow(dead_code)]
mod angles;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::natural_under_gravity_with;
use superhelix::internals::math::quadrature::{DEFAULT_TOLERANCE, LOOSEST, Rule, Rules, TIGHTEST};
use superhelix::internals::rod::strand::StrandModel;
use superhelix::internals::step::state::{RuleScratch, StrandState};
use superhelix::{Frame, Solver, SolverOptions, StepOptions, StrandDef};

/// Turns of an element from nothing to beyond what the largest rule is for.
fn turns() -> impl Iterator<Item = f64> {
    (0..70).map(|k| 1e-2 * 1.17_f64.powi(k)).take_while(|turn| *turn < 200.0)
}

#[test]
fn every_rule_keeps_its_tolerance() {
    let known = Rules::default();
    let rules: Vec<Rule> = (0..known.count()).map(|index| known.rule(index).clone()).collect();
    for turn in turns() {
        let errors = angles::errors(&rules, turn);
        for exponent in 4..=24 {
            let tolerance = 10.0_f64.powf(-0.5 * f64::from(exponent));
            let rules = Rules::new(tolerance.clamp(TIGHTEST, LOOSEST));
            let chosen = rules.for_angle(turn);
            // Between the table's columns the logarithms are interpolated: measured, up to a half beyond.
            let room = if exponent % 2 == 0 { 1.02 } else { 1.5 };
            assert!(errors[chosen] <= room * tolerance, "{turn} rad to {tolerance:e}: {:e}", errors[chosen]);
            // And no rule is larger than it need be: the next smaller one fails a tolerance ten times as tight.
            if chosen > 0 && turn > 0.2 {
                assert!(errors[chosen - 1] > 0.1 * tolerance, "{turn} rad to {tolerance:e}: {:e}", errors[chosen - 1]);
            }
        }
    }
}

#[test]
fn the_table_is_the_measured_one() {
    let known = Rules::default();
    let csv = include_str!("../../docs/figures/quadrature_angles.csv");
    let mut rows = 0;
    for line in csv.lines().skip(1) {
        let fields: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
        let [points, tolerance, turn] = fields[..] else { panic!("{line}") };
        let index = (0..known.count()).find(|index| known.rule(*index).len() as f64 == points).unwrap();
        let rules = Rules::new(tolerance);
        // Four digits of it, rounded down.
        if turn > 0.0 {
            assert!(
                rules.for_angle(0.999 * turn) <= index && rules.for_angle(turn * 1.000_01) == (index + 1).min(known.count() - 1),
                "{line}"
            );
        } else {
            assert!(rules.for_angle(0.0) > index, "{line}");
        }
        rows += 1;
    }
    assert_eq!(rows, 11 * known.count());
}

fn solver_with(quadrature_tolerance: f64, gravity: Vector3<f64>) -> Solver {
    let step = StepOptions { quadrature_tolerance, tolerance: 1e-9, ..StepOptions::default() };
    Solver::new(SolverOptions { step, gravity, ..SolverOptions::default() }).unwrap()
}

const WEIGHT: Vector3<f64> = Vector3::new(0.0, 0.0, -9.81);

#[test]
fn a_strand_reports_its_points_and_its_error() {
    for (tolerance, turn, points) in
        [(1e-2, 0.5, 3), (1e-4, 0.0, 4), (1e-4, 1.5, 4), (1e-4, 2.5, 5), (1e-6, 0.1, 4), (1e-6, 1.5, 5), (1e-10, 9.0, 14)]
    {
        let mut solver = solver_with(tolerance, WEIGHT);
        let mut def = StrandDef::straight(0.1, 2);
        def.natural = vec![[0.0; 3], [0.0, turn / 0.05, 0.0]];
        let id = solver.add_strands(&[def]).unwrap()[0];
        let found = solver.quadrature(id).unwrap();
        assert_eq!(found.points, points, "{tolerance:e}, {turn} rad");
        assert!(found.error <= tolerance * (1.0 + 1e-9), "{tolerance:e}, {turn} rad: {found:?}");
    }
    // Beyond the largest rule: as good as it gets, and it is said.
    let mut solver = solver_with(1e-4, WEIGHT);
    for (turn, bound) in [(200.0, 1e-4), (235.0, 1e-2), (300.0, f64::INFINITY)] {
        let mut def = StrandDef::straight(0.1, 1);
        def.natural = vec![[0.0, turn / 0.1, 0.0]];
        let id = solver.add_strands(&[def]).unwrap()[0];
        let found = solver.quadrature(id).unwrap();
        assert_eq!(found.points, 128);
        assert!(found.error <= bound && (bound == 1e-4 || found.error > 1e-4), "{turn} rad: {found:?}");
    }
}

#[test]
fn going_to_fewer_points_adds_no_energy_and_keeps_momentum() {
    let def = StrandDef::straight(0.12, 3);
    let model = StrandModel::new(def.element_lengths.clone(), def.natural.clone(), def.material, def.freedoms);
    let rules = Rules::new(1e-6);
    let curled = vec![[30.0, 120.0, -40.0], [10.0, 200.0, 0.0], [0.0, -50.0, 90.0]];
    let rates = vec![[300.0, -40.0, 100.0], [-200.0, 60.0, 5.0], [50.0, 400.0, -30.0]];
    let still = Vector3::zeros();
    let mut state = StrandState::new(&model, &rules, curled, rates, Frame::default(), still, still);
    let mass = |state: &StrandState, p: usize| {
        let rule = rules.rule(state.rule);
        rule.weights[p % rule.len()] * model.lengths[p / rule.len()]
    };
    let kinetic = |state: &StrandState| -> f64 {
        (0..state.velocities.len()).map(|p| mass(state, p) * state.velocities[p].norm_squared()).sum()
    };
    let momentum = |state: &StrandState| {
        (0..state.velocities.len()).fold(Vector3::zeros(), |sum, p| sum + mass(state, p) * Vector3::from(state.velocities[p]))
    };
    let mut scratch = RuleScratch::default();
    let mut points = rules.rule(state.rule).len();
    let mut fewer = 0;
    // Straightened bit by bit, and curled again.
    for share in [0.7, 0.5, 0.3, 0.1, 0.01, 0.4, 1.0] {
        for row in &mut state.curvatures {
            *row = [0.0, 200.0 * share, 0.0];
        }
        let (energy, pull) = (kinetic(&state), momentum(&state));
        state.adapt_rule(&model, &rules, &mut scratch);
        let now = rules.rule(state.rule).len();
        let (energy_now, pull_now) = (kinetic(&state), momentum(&state));
        if now < points {
            fewer += 1;
            assert!(energy_now <= energy * (1.0 + 1e-14), "{points} to {now}: {energy} {energy_now}");
        } else {
            assert!((energy_now / energy - 1.0).abs() < 1e-12, "{points} to {now}: {energy} {energy_now}");
        }
        assert!((pull_now - pull).norm() < 1e-13 * pull.norm(), "{points} to {now}");
        points = now;
    }
    assert!(fewer >= 4);
}

#[test]
fn energy_does_not_drift_through_changes_of_rule() {
    // One element, undamped, let go from the side: at 1e-6 it goes from four points to five and back every time it swings through straight.
    let run = |tolerance: f64| {
        let mut solver = solver_with(tolerance, WEIGHT);
        let mut def = StrandDef::straight(0.15, 1);
        def.material.radius = [150e-6; 2];
        let id = solver.add_strands(&[def]).unwrap()[0];
        let total = |solver: &Solver| {
            let energies = solver.energies(id).unwrap();
            energies.kinetic + energies.elastic + energies.gravity
        };
        let (start, mut most, mut changes, mut points) = (total(&solver), 0.0_f64, 0, 0);
        for _ in 0..4000 {
            let report = solver.step(1.0 / 4000.0, 1).unwrap();
            most = most.max(report.energies.kinetic);
            let now = solver.quadrature(id).unwrap().points;
            changes += u32::from(now != points);
            points = now;
        }
        ((total(&solver) - start) / most, changes)
    };
    let ((exact, _), (coarse, changes)) = (run(TIGHTEST), run(1e-6));
    println!("lost {exact:e} of the kinetic energy with tight integrals, {coarse:e} at 1e-6 with {changes} changes of rule");
    assert!(changes >= 6, "{changes}");
    // The tolerance itself, once a change; measured 5.5e-8 in all.
    assert!((coarse - exact).abs() < 1e-6 * f64::from(changes), "{coarse:e} {exact:e}");
}

#[test]
fn a_balance_made_for_a_tolerance_rests_there() {
    for tolerance in [1e-2, 1e-4, 1e-8] {
        let mut def = StrandDef::straight(0.2, 6);
        // Thick enough for the balance to be stable.
        def.material.radius = [150e-6; 2];
        def.root.rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.4);
        let shape: Vec<[f64; 3]> = (0..6).map(|k| [3.0, 12.0 + f64::from(k), -6.0]).collect();
        def.natural = natural_under_gravity_with(&def, &shape, WEIGHT, tolerance).unwrap();
        def.initial = Some(shape);
        let mut solver = solver_with(tolerance, WEIGHT);
        let id = solver.add_strands(&[def]).unwrap()[0];
        let tip = |solver: &Solver| {
            let mut tip = Vector3::zeros();
            solver.sample_at(id, &[0.2], |_, sample| tip = sample.position).unwrap();
            tip
        };
        let start = tip(&solver);
        for _ in 0..120 {
            solver.step(1.0 / 60.0, 1).unwrap();
        }
        assert!((tip(&solver) - start).norm() < 1e-12, "{tolerance:e}");
    }
    for wrong in [0.0, -1e-3, 0.1, f64::NAN] {
        let error = natural_under_gravity_with(&StrandDef::straight(0.1, 1), &[[0.0; 3]], WEIGHT, wrong).unwrap_err();
        assert!(error.to_string().contains("quadrature_tolerance"), "{error}");
        let step = StepOptions { quadrature_tolerance: wrong, ..StepOptions::default() };
        let error = Solver::new(SolverOptions { step, ..SolverOptions::default() }).err().unwrap();
        assert!(error.to_string().contains("options.quadrature_tolerance"), "{error}");
    }
}

/// Positions and velocities along a strand.
type Curve = Vec<(Vector3<f64>, Vector3<f64>)>;

/// A wavy strand on a root that turns to and fro, after `seconds`.
fn shaken(count: usize, tolerance: f64, seconds: f64) -> (Solver, Curve) {
    let mut solver = solver_with(tolerance, WEIGHT);
    let mut def = StrandDef::straight(0.2, count);
    def.natural = vec![[8.0, 60.0, 0.0]; count];
    (def.material.internal_friction, def.material.air_drag) = (1e-10, 5e-6);
    let id = solver.add_strands(&[def]).unwrap()[0];
    let h = 1.0 / 120.0;
    for step in 1..=(seconds / h).round() as u32 {
        let angle = 0.5 * (12.0 * h * f64::from(step)).sin();
        let root = Frame { rotation: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle), ..Frame::default() };
        solver.set_root_frames(&[id], &[root], h).unwrap();
        let report = solver.step(h, 1).unwrap();
        assert_eq!((report.unconverged, report.quarantined), (0, 0));
    }
    let mut curve = Vec::new();
    solver.sample_strands(&[id], 41, |_, _, sample| curve.push((sample.position, sample.velocity))).unwrap();
    (solver, curve)
}

#[test]
fn the_default_adds_less_than_a_twentieth_of_what_the_elements_err_by() {
    let rms = |one: &Curve, two: &Curve| {
        let squares = one.iter().zip(two).map(|(a, b)| ((a.0 - b.0).norm_squared(), (a.1 - b.1).norm_squared()));
        let (r, v) = squares.fold((0.0, 0.0), |sum, here| (sum.0 + here.0, sum.1 + here.1));
        (r.sqrt(), v.sqrt())
    };
    for count in [10, 20] {
        let exact = shaken(count, TIGHTEST, 0.8).1;
        let added = rms(&shaken(count, DEFAULT_TOLERANCE, 0.8).1, &exact);
        let error = rms(&exact, &shaken(60, TIGHTEST, 0.8).1);
        println!("N = {count}: positions {:.1e} of the error, velocities {:.1e}", added.0 / error.0, added.1 / error.1);
        // Measured over more motions (docs/notebook/quadrature.md): 4.6e-6 and 1.7e-2.
        assert!(added.0 < 1e-4 * error.0 && added.1 < error.1 / 20.0, "N = {count}: {added:?} {error:?}");
    }
}

#[test]
fn a_snapshot_brings_its_tolerance() {
    let (mut one, _) = shaken(8, 1e-8, 0.1);
    let mut other = solver_with(1e-2, WEIGHT);
    other.restore(&one.snapshot()).unwrap();
    assert_eq!(other.options().step.quadrature_tolerance, 1e-8);
    for _ in 0..30 {
        one.step(1.0 / 60.0, 1).unwrap();
        other.step(1.0 / 60.0, 1).unwrap();
    }
    assert_eq!(one.state_hash(), other.state_hash());
}
