//! A ring comb in the hand: the strands on its teeth pull at the hand as their constraints say, in all modes, and no device gives energy for that.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::haptic::{Device, ForceLaw, HapticOptions, HapticState, Mode, Tool, haptic};
use superhelix::tools::{RingComb, RingCombOptions};
use superhelix::{BodyDef, Error, Frame, Shape, Solver, SolverOptions, StrandId, Wrench};

use super::agreement::rms;
use super::scene::{TICK, combed_hair, motion, stroke};

/// The comb of the scene, without bodies: teeth along x, beside each other along y.
fn comb(handle: Frame) -> RingComb {
    let tool = superhelix::tools::Tool::Comb { teeth: 7, spacing: 6e-3, length: 0.08, radius: 1e-3 };
    let axes = UnitQuaternion::from_scaled_axis(Vector3::repeat(1.0).normalize() * (2.0 * PI / 3.0));
    let place = Frame { origin: Vector3::new(-0.03, 0.0, 0.0), rotation: axes };
    RingComb::new(&tool, &handle.compose(&place), &RingCombOptions::default()).unwrap()
}

/// Hair, and a ring comb in a hand: its handle is a body a metre off, which meets nothing.
fn scene(options: &HapticOptions) -> (Solver, Tool, Device) {
    let (mut solver, teeth) = combed_hair(20, 15.0);
    solver.remove_bodies(&teeth).unwrap();
    let far = Shape::new_capsule(Vector3::x(), Vector3::x() * 1.1, 1e-3).unwrap();
    let body = BodyDef { pose: stroke(0.0), ..BodyDef::new(Arc::new(far)) };
    let bodies = solver.add_bodies(vec![body]).unwrap();
    let (mut tool, device) = haptic(&solver, &bodies, options).unwrap();
    let strands = solver.strand_ids();
    assert_eq!(tool.add_ring_comb(&solver, comb(stroke(0.0)), &strands).unwrap(), 0);
    (solver, tool, device)
}

/// What a stroke came to.
#[derive(Default)]
struct Stroke {
    felt: Vec<(Wrench, HapticState)>,
    /// What the constraints of the rings did to the handle in each step, before any was released.
    pulled: Vec<Wrench>,
    caught: u32,
    combed: u32,
    let_go: u32,
}

/// A stroke with a step every `ticks` of the device.
fn stroked(options: &HapticOptions, ticks: usize) -> Stroke {
    let (mut solver, mut tool, mut device) = scene(options);
    let mut out = Stroke::default();
    for tick in 0..1400 {
        let (pose, velocity, spin) = motion(stroke, tick as f64 * TICK);
        out.felt.push(device.update(&pose, velocity, spin, TICK).unwrap());
        if tick % ticks != 0 {
            continue;
        }
        let seconds = ticks as f64 * TICK;
        tool.before_step(&mut solver, seconds).unwrap();
        solver.step(seconds, 1).unwrap();
        let (mut pulled, handle) = (Wrench::default(), tool.handle().origin);
        for id in solver.constraint_ids() {
            let (state, def) = (solver.constraint_state(id).unwrap(), solver.constraint(id).unwrap());
            pulled.force -= state.force;
            pulled.torque -= (def.target.origin - handle).cross(&state.force);
        }
        out.pulled.push(pulled);
        tool.after_step(&mut solver).unwrap();
        let (_, report) = tool.ring_combs().next().unwrap();
        (out.caught, out.combed, out.let_go) =
            (out.caught + report.caught, out.combed + report.combed, out.let_go + report.let_go);
    }
    out
}

fn forces(felt: &[(Wrench, HapticState)]) -> Vec<Vector3<f64>> {
    felt.iter().map(|(_, state)| state.contact.force).collect()
}

#[test]
fn directly_the_hand_feels_what_the_rings_constraints_bear() {
    let options = HapticOptions { mode: Mode::Direct, ..HapticOptions::default() };
    let stroke = stroked(&options, 1);
    assert!(stroke.caught >= 5 && stroke.combed + stroke.let_go >= stroke.caught / 2, "{} {}", stroke.caught, stroke.combed);
    // An update has the model of the step before it.
    let largest = stroke.pulled.iter().fold(0.0_f64, |most, wrench| most.max(wrench.force.norm()));
    assert!(largest > 1e-4, "{largest}");
    for ((_, state), pulled) in stroke.felt[1..].iter().zip(&stroke.pulled) {
        let off = [state.contact.force - pulled.force, state.contact.torque - pulled.torque].map(|off| off.norm());
        assert!(off[0] <= 1e-12 && off[1] <= 1e-12, "{off:?} {state:?}");
        assert!(state.energy_excess <= options.energy_allowance, "{state:?}");
    }
    // While it goes down, hair holds it up.
    let upward: f64 = stroke.felt[600..1300].iter().map(|(wrench, _)| wrench.force.z).sum();
    assert!(upward > 0.0, "{upward}");
}

#[test]
fn handed_over_the_forces_are_those_of_the_steps() {
    let options = HapticOptions::default();
    let stroke = stroked(&options, 4);
    assert!(stroke.caught >= 5);
    // Half a step after a hand-over it is blended in, and stays until the next.
    for (k, pulled) in stroke.pulled.iter().enumerate().take(stroke.pulled.len() - 1) {
        let (_, state) = &stroke.felt[4 * k + 4];
        let off = (state.contact.force - pulled.force).norm();
        assert!(off <= 1e-9 || state.stale, "step {k}: {off}");
        assert!(state.energy_excess <= options.energy_allowance, "{state:?}");
    }
    // And they are much like those of a simulation at the device's rate.
    let direct = stroked(&HapticOptions { mode: Mode::Direct, ..options }, 1);
    let [handed, direct] = [&stroke, &direct].map(|stroke| rms(&forces(&stroke.felt)));
    assert!((handed / direct - 1.0).abs() < 0.5, "{handed} {direct}");
}

/// F = β ṫ⊥ + f(γ) ṫ∥ of the strands on the teeth: against the tool's velocity, nothing at rest, each of them counted.
#[test]
fn the_explicit_law_counts_strands_on_teeth() {
    let options = HapticOptions { force_law: ForceLaw::Explicit, mode: Mode::Direct, ..HapticOptions::default() };
    let stroke = stroked(&options, 1);
    assert!(stroke.felt.iter().any(|(_, state)| state.pressing > 3 && state.contact.force.norm() > 0.0));
    for (tick, (_, state)) in stroke.felt.iter().enumerate() {
        let (_, velocity, _) = motion(super::scene::stroke, tick as f64 * TICK);
        assert!(state.contact.force.dot(&velocity) <= 1e-12, "{tick}: {state:?}");
        assert_eq!(state.contact.force == Vector3::zeros(), state.pressing == 0 || velocity == Vector3::zeros(), "{tick}");
    }
}

#[test]
fn strands_are_checked_released_and_forgotten() {
    let (mut solver, mut tool, mut device) = scene(&HapticOptions::default());
    let ids = solver.strand_ids();
    let stale = StrandId::from_bits(u64::MAX);
    let error = tool.add_ring_comb(&solver, comb(stroke(0.0)), &[ids[0], stale]).unwrap_err();
    assert!(matches!(&error, Error::InvalidId { argument, .. } if argument == "strands[1]"), "{error:?}");
    let (mut other, foreign) = (Solver::new(SolverOptions::default()).unwrap(), |argument: &str| argument == "bodies[0]");
    let error = tool.add_ring_comb(&other, comb(stroke(0.0)), &[]).unwrap_err();
    assert!(matches!(&error, Error::InvalidId { argument, .. } if foreign(argument)), "{error:?}");
    let error = tool.release_ring_combs(&mut other).unwrap_err();
    assert!(matches!(&error, Error::InvalidId { argument, .. } if foreign(argument)), "{error:?}");
    assert_eq!(tool.ring_combs().len(), 1);
    let mut held = 0;
    for tick in 0..700 {
        let (pose, velocity, spin) = motion(stroke, tick as f64 * TICK);
        device.update(&pose, velocity, spin, TICK).unwrap();
        if held == 0 && tool.ring_combs().next().unwrap().1.held >= 3 {
            held = tool.ring_combs().next().unwrap().1.held;
            tool.release_ring_combs(&mut solver).unwrap();
            assert!(solver.constraint_ids().is_empty());
            solver.remove_strands(&ids[..10]).unwrap();
        }
        tool.before_step(&mut solver, TICK).unwrap();
        solver.step(TICK, 1).unwrap();
        tool.after_step(&mut solver).unwrap();
    }
    assert!(held >= 3 && tool.ring_combs().next().unwrap().0.held().all(|(id, _)| !ids[..10].contains(&id)));
}
