//! No force beyond the options' limits, no jump at stick, slip and separation, and the effect of a simulation that stops.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::Frame;
use superhelix::haptic::HapticOptions;

use super::scene::{Felt, Rate, Simulation, TICK, combed_hair, handed_over, motion, stroke};

/// The largest change of force from one update to the next.
fn largest_jump(felt: &Felt) -> f64 {
    felt.windows(2).map(|pair| (pair[1].0.force - pair[0].0.force).norm()).fold(0.0, f64::max)
}

#[test]
fn no_force_jumps_by_more_than_its_rate_allows() {
    // A rate that is no more than a few times what the hair asks for, so that it matters.
    let options = HapticOptions { max_force_rate: 5e-3, max_torque_rate: 1e-4, ..HapticOptions::default() };
    let felt = handed_over(combed_hair(40, 15.0), stroke, 1.4, Rate::new(120.0, 4e-3), &options);
    let step = options.max_force_rate * TICK;
    assert!(largest_jump(&felt) <= step * (1.0 + 1e-9), "{:e} over {step:e}", largest_jump(&felt));
    for pair in felt.windows(2) {
        let torque = (pair[1].0.torque - pair[0].0.torque).norm();
        assert!(torque <= options.max_torque_rate * TICK * (1.0 + 1e-9), "{torque:e}");
    }
    // It was of use, and it let go: the comb leaves the tips before the end.
    assert!(felt.iter().any(|(_, state)| state.rate_limited));
    assert!(felt.iter().any(|(wrench, _)| wrench.force.norm() > 5e-5));
    assert!(felt.last().unwrap().0.force.norm() < 1e-12);
}

#[test]
fn a_hand_over_alone_makes_no_jump() {
    // Nothing limited by rate: what changes within an update is what hair and hand do, where touches close and open; the hand-overs, every eighth
    // update, add nothing to that.
    let options = HapticOptions::default();
    let felt = handed_over(combed_hair(40, 15.0), stroke, 1.4, Rate::new(120.0, 4e-3), &options);
    assert!(felt.iter().all(|(_, state)| !state.rate_limited));
    let (mut at_hand_over, mut between) = (Vec::new(), Vec::new());
    for pair in felt.windows(2) {
        let jump = (pair[1].0.force - pair[0].0.force).norm();
        let list = if pair[1].1.models > pair[0].1.models { &mut at_hand_over } else { &mut between };
        list.push(jump);
    }
    let largest = |list: &[f64]| list.iter().copied().fold(0.0, f64::max);
    println!("at a hand-over {:.1e} N at most, between {:.1e}", largest(&at_hand_over), largest(&between));
    assert!(at_hand_over.len() > 100 && largest(&at_hand_over) <= largest(&between));
}

#[test]
fn force_and_torque_are_cut_to_the_largest() {
    let options = HapticOptions { max_force: 2e-5, max_torque: 2e-7, ..HapticOptions::default() };
    let felt = handed_over(combed_hair(40, 15.0), stroke, 1.4, Rate::new(120.0, 0.0), &options);
    for (wrench, state) in &felt {
        assert!(wrench.force.norm() <= 2e-5 * (1.0 + 1e-9) && wrench.torque.norm() <= 2e-7 * (1.0 + 1e-9));
        let is_more = state.contact.force.norm() > 2e-5 || state.contact.torque.norm() > 2e-7;
        assert!(state.clamped || !is_more || state.rate_limited);
    }
    assert!(felt.iter().any(|(_, state)| state.clamped));
}

#[test]
fn the_force_of_a_simulation_that_stops_fades() {
    let options = HapticOptions::default();
    let (mut simulation, mut device) = Simulation::new(combed_hair(40, 15.0), Rate::new(120.0, 0.0), &options);
    let mut at_stop = 0.0;
    for tick in 0..700 {
        let t = f64::from(tick) * TICK;
        // The hand stands still where the hair is bent most.
        let (pose, velocity, spin) = motion(|t| stroke(t.min(0.38)), t);
        let (wrench, state) = device.update(&pose, velocity, spin, TICK).unwrap();
        if tick < 400 {
            simulation.until(t);
            at_stop = wrench.force.norm();
        }
        assert_eq!(state.stale, state.model_age > options.max_age);
        if tick > 620 {
            assert!(state.stale && wrench.force.norm() == 0.0, "{tick}: {wrench:?}");
        }
    }
    assert!(at_stop > 1e-5, "{at_stop:e}");
}

#[test]
fn a_tool_whose_handle_is_elsewhere_is_the_same_tool() {
    let off = Frame { origin: Vector3::new(-0.08, 0.02, 0.01), rotation: UnitQuaternion::from_euler_angles(0.3, -0.4, 0.5) };
    let options = HapticOptions { handle: off, ..HapticOptions::default() };
    let one = handed_over(combed_hair(20, 15.0), stroke, 0.6, Rate::new(120.0, 0.0), &HapticOptions::default());
    let other = handed_over(combed_hair(20, 15.0), |t| stroke(t).compose(&off), 0.6, Rate::new(120.0, 0.0), &options);
    // (The coupling turns about the handle: the teeth yield a little otherwise.)
    let largest = one.iter().map(|felt| felt.0.force.norm()).fold(0.0, f64::max);
    assert!(largest > 5e-5, "{largest:e}");
    for (tick, (one, other)) in one.iter().zip(&other).enumerate() {
        let arm = stroke(tick as f64 * TICK).compose(&off).origin - stroke(tick as f64 * TICK).origin;
        let torque = one.0.torque - arm.cross(&one.0.force);
        let apart = (one.0.force - other.0.force).norm() / largest;
        let torque_apart = (torque - other.0.torque).norm() / (0.1 * largest);
        assert!(apart < 0.1 && torque_apart < 0.1, "{tick}: {apart} {torque_apart}");
    }
}
