//! `suggest_elements` against independent solutions of the continuous rod: the estimated error is the error, and the number of elements is
//! the least that the tables of `docs/theory/validation_physics.md` allow.

use crate::rods::*;
use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::{EquilibriumOptions, LARGEST_TURN};
use superhelix::settings::{Demand, RootMotion, Suggestion, suggest_elements};
use superhelix::{Frame, Solver, SolverOptions, StrandDef, StrandId};

/// Asks for a tolerance in lengths of the strand.
fn ask(def: &StrandDef, tolerance: f64) -> Suggestion {
    suggest_elements(def, &Demand { tolerance: tolerance * LENGTH, ..Demand::default() }).unwrap()
}

/// Distance of the settled tip from a reference, in L; its mirror image and turns about the vertical allowed if `turned`.
fn error_of(def: &StrandDef, reference: Vector3<f64>, turned: bool) -> f64 {
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let id = solver.add_strands(std::slice::from_ref(def)).unwrap()[0];
    assert!(solver.settle(&[id], &EquilibriumOptions::default()).unwrap()[0].converged);
    let mut tip = Vector3::zeros();
    solver.sample_at(id, &[LENGTH], |_, sample| tip = sample.position / LENGTH).unwrap();
    if turned { (tip.xy().norm() - reference.xy().norm()).hypot(tip.z - reference.z) } else { (tip - reference).norm() }
}

#[test]
fn cantilevers_get_what_theory_says() {
    let reference = reference();
    let horizontal = clamp(Vector3::x(), Vector3::y());
    println!("| Γ | tolerance, L | N | estimated, L | error of the tip, L |");
    for (gamma, tolerance) in [(0.1, 1e-2), (10.0, 1e-2), (10.0, 1e-3), (50.0, 1e-3), (100.0, 1e-2), (1000.0, 2e-3)] {
        let row = rows(&reference["cantilever"]["horizontal"]).iter().find(|row| number(&row["Gamma"]) == gamma).unwrap().clone();
        let exact = Vector3::new(number(&row["x_tip"]), 0.0, number(&row["z_tip"]));
        let def = |count| strand(count, material(gamma, 1.0, 0.48), horizontal, [0.0; 3]);
        // It does not matter on how many elements the strand was defined.
        let found = ask(&def(3), tolerance);
        assert_eq!(found.elements, ask(&def(1), tolerance).elements);
        let error = error_of(&def(found.elements), exact, false);
        println!("| {gamma} | {tolerance:.0e} | {} | {:.2e} | {error:.2e} |", found.elements, found.rest_error / LENGTH);
        assert!(found.met && found.motion_error.is_none() && found.rest_error <= tolerance * LENGTH);
        // The tip is the point that is farthest off, or nearly so; on few elements the error is not quite 1/N².
        let ratio = found.rest_error / LENGTH / error;
        assert!((0.9..1.25).contains(&ratio), "{found:?} {error}");
        // One element less does not do.
        if found.elements > 1 {
            let fewer = error_of(&def(found.elements - 1), exact, false);
            assert!(fewer > 0.8 * tolerance, "{found:?} {fewer}");
        }
    }
}

#[test]
fn curls_in_space() {
    let reference = reference();
    for (turns, gamma) in [(2.0, 25.0), (6.0, 300.0)] {
        let row = rows(&reference["hanging_curly"])
            .iter()
            .find(|row| number(&row["Gamma"]) == gamma && (number(&row["phi"]) / std::f64::consts::PI - turns).abs() < 1e-6)
            .unwrap()
            .clone();
        let def = |count| strand(count, material(gamma, 1.0, 0.48), down(), [0.0, number(&row["phi"]), 0.0]);
        let found = ask(&def(2), 3e-3);
        let error = error_of(&def(found.elements), triple(&row["tip"]), true);
        println!("curl of {turns}π, Γ = {gamma}: {found:?}, error of the tip {error:.2e} L");
        assert!(found.met && found.turn <= LARGEST_TURN * (1.0 + 1e-9));
        assert!(error < 3.2e-3, "{error}");
        assert!(
            found.rest_error / LENGTH < 3.0 * error + 1e-4,
            "the worst point is not far worse than the tip: {found:?} {error}"
        );
    }
}

#[test]
fn tight_coils_need_four_elements_a_turn() {
    // Twenty turns, so stiff that its weight does nothing: at rest one element is exact, and would not do.
    let def = strand(1, material(1e-6, 1.0, 0.48), down(), [0.0, 40.0 * std::f64::consts::PI, 0.0]);
    let found = ask(&def, 1e-2);
    assert!(found.met && found.elements == 80, "{found:?}");
    assert!((found.turn - LARGEST_TURN).abs() < 1e-3, "{found:?}");
    // Fewer than it takes: the most, and word that it is not met.
    let capped = suggest_elements(&def, &Demand { tolerance: 1e-3, max_elements: 50, ..Demand::default() }).unwrap();
    assert!(!capped.met && capped.elements == 50 && capped.turn > LARGEST_TURN, "{capped:?}");
    let unmet = suggest_elements(
        &strand(1, material(100.0, 1.0, 0.48), clamp(Vector3::x(), Vector3::y()), [0.0; 3]),
        &Demand { tolerance: 1e-6, max_elements: 20, ..Demand::default() },
    );
    let unmet = unmet.unwrap();
    assert!(!unmet.met && unmet.elements == 20 && unmet.rest_error > 1e-6, "{unmet:?}");
}

#[test]
fn a_natural_shape_given_finely_counts_as_it_is() {
    // A wave of curvature with six periods, no gravity: elements must resolve the wave.
    let mut def = strand(120, material(1.0, 1.0, 0.48), down(), [0.0; 3]);
    for (k, row) in def.natural.iter_mut().enumerate() {
        row[1] = 25.0 / LENGTH * (12.0 * std::f64::consts::PI * (k as f64 + 0.5) / 120.0).sin();
    }
    let demand = Demand { tolerance: 1e-2 * LENGTH, gravity: Vector3::zeros(), ..Demand::default() };
    let found = suggest_elements(&def, &demand).unwrap();
    // Without gravity the rest is the natural shape: its means against itself, by kinematics alone.
    let at_rest = |count: usize| {
        let mut solver = Solver::new(SolverOptions { gravity: Vector3::zeros(), ..SolverOptions::default() }).unwrap();
        let ids = solver.add_strands(&[def.clone(), def.clone()]).unwrap();
        solver.set_element_count(&ids[1..], count).unwrap();
        solver.reset_strands(&ids).unwrap();
        let mut points = [Vec::new(), Vec::new()];
        solver.sample_strands(&ids, 101, |strand, _, sample| points[strand].push(sample.position)).unwrap();
        points[0].iter().zip(&points[1]).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    };
    println!("a wave of six periods: {found:?}, by itself {:.2e} m", at_rest(found.elements));
    assert!(found.met && found.elements > 12);
    assert!((found.rest_error / at_rest(found.elements) - 1.0).abs() < 0.1);
}

#[test]
fn a_motion_asks_for_its_own() {
    // A stiff bristle rests all but straight, and swings: the frequency's error of 1/N² shows in the path.
    let def = |count| {
        let mut def = strand(count, material(1.0, 1.0, 0.48), down(), [0.0; 3]);
        def.material.air_drag = 2e-6;
        def
    };
    let frames: Vec<Frame> = (0..60)
        .map(|k| {
            let time = f64::from(k) / 120.0;
            let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.6 * (12.0 * time).sin());
            Frame { rotation: turn * down(), ..Frame::default() }
        })
        .collect();
    let motion = RootMotion { frames: frames.clone(), interval: 1.0 / 120.0 };
    let demand = Demand { tolerance: 1e-2 * LENGTH, motion: Some(motion), ..Demand::default() };
    let found = suggest_elements(&def(1), &demand).unwrap();
    let resting = suggest_elements(&def(1), &Demand { motion: None, ..demand.clone() }).unwrap();
    assert!(found.met && found.elements > resting.elements, "{found:?} {resting:?}");
    // Against forty elements with the same steps.
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let mut strands = [def(found.elements), def(40)];
    strands.iter_mut().for_each(|strand| strand.root = frames[0]);
    let ids: Vec<StrandId> = solver.add_strands(&strands).unwrap();
    solver.settle(&ids, &EquilibriumOptions::default()).unwrap();
    let mut sum = 0.0;
    for frame in &frames[1..] {
        solver.set_root_frames(&ids, &[*frame; 2], 1.0 / 120.0).unwrap();
        solver.step(1.0 / 120.0, 1).unwrap();
        let mut points = [Vec::new(), Vec::new()];
        solver.sample_strands(&ids, 51, |strand, _, sample| points[strand].push(sample.position)).unwrap();
        sum += points[0].iter().zip(&points[1]).map(|(a, b)| (a - b).norm_squared()).sum::<f64>() / 51.0;
    }
    let error = (sum / 59.0).sqrt();
    println!("motion: {found:?}, against forty elements {error:.2e} m");
    assert!((0.8..1.25).contains(&(found.motion_error.unwrap() / error)), "{found:?} {error}");
}

#[test]
fn bad_input_is_named() {
    let def = strand(3, material(1.0, 1.0, 0.48), down(), [0.0; 3]);
    let frames = vec![Frame::default(); 3];
    let text = |demand: Demand| suggest_elements(&def, &demand).unwrap_err().to_string();
    assert!(text(Demand { tolerance: 0.0, ..Demand::default() }).contains("demand.tolerance"));
    assert!(text(Demand { tolerance: f64::NAN, ..Demand::default() }).contains("demand.tolerance"));
    assert!(text(Demand { max_elements: 0, ..Demand::default() }).contains("demand.max_elements"));
    assert!(text(Demand { gravity: Vector3::new(0.0, f64::INFINITY, 0.0), ..Demand::default() }).contains("demand.gravity[1]"));
    let with = |motion: RootMotion| text(Demand { motion: Some(motion), ..Demand::default() });
    assert!(with(RootMotion { frames: frames[..1].to_vec(), interval: 0.1 }).contains("demand.motion.frames"));
    assert!(with(RootMotion { frames, interval: -0.1 }).contains("demand.motion.interval"));
    let mut bad = def.clone();
    bad.natural[1][2] = f64::NAN;
    assert!(suggest_elements(&bad, &Demand::default()).unwrap_err().to_string().contains("strand.natural[1][2]"));
}
