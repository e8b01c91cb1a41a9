//! A hand that grabs: how soon it feels the result, and that stick, slip and separation cause no jump beyond the stated one.

use nalgebra::Vector3;
use superhelix::Frame;
use superhelix::haptic::{HapticOptions, Mode};

use super::scene::{Rate, Simulation, TICK, combed_hair, motion, stroke};

/// The comb rests in the hair from 0.4 s on, and goes sideways by a millimetre within two updates at that tick.
const GRAB: u32 = 900;

fn grab(t: f64) -> Frame {
    let rest = stroke((0.4 + t).min(0.7));
    let part = ((t - f64::from(GRAB) * TICK) / (2.0 * TICK)).clamp(0.0, 1.0);
    Frame { origin: rest.origin + Vector3::y() * (1e-3 * part), ..rest }
}

/// Milliseconds from the grab until the force has changed by nine tenths of what it changes within 30 ms, and by how much that is, N.
fn rise(mode: Mode, rate: Rate) -> (u32, f64) {
    let options = HapticOptions { mode, ..HapticOptions::default() };
    let (mut simulation, mut device) = Simulation::new(combed_hair(40, 15.0), rate, &options);
    let mut forces = Vec::new();
    for tick in 0..GRAB + 30 {
        let t = f64::from(tick) * TICK;
        let (pose, velocity, spin) = motion(grab, t);
        let (wrench, _) = device.update(&pose, velocity, spin, TICK).unwrap();
        simulation.until(t);
        if tick >= GRAB {
            forces.push(wrench.force);
        }
    }
    let change: Vec<f64> = forces.iter().map(|force| (force - forces[0]).norm()).collect();
    let most = change.iter().copied().fold(0.0, f64::max);
    (change.iter().position(|change| *change >= 0.9 * most).unwrap() as u32, most)
}

#[test]
fn a_grab_is_felt_at_once_however_slow_the_simulation_is() {
    let (direct, by_direct) = rise(Mode::Direct, Rate::new(1000.0, 0.0));
    println!("direct: {direct} ms to nine tenths of {by_direct:e} N");
    for (rate, late) in [(60.0, 4e-3), (120.0, 0.0), (120.0, 4e-3), (240.0, 2e-3)] {
        let (handed_over, most) = rise(Mode::HandOver, Rate::new(rate, late));
        println!("{rate} Hz, {late} s late: {handed_over} ms to nine tenths of {most:e} N");
        // The motion itself takes two updates.
        assert!(handed_over <= 4, "{rate}: {handed_over} ms");
        assert!(most > 2e-5, "{rate}: {most:e}");
    }
}

#[test]
fn stick_slip_and_leave_make_no_step_beyond_the_stated_one() {
    // Through the hair and out of it beyond the tips, by a rate of force that each of these events would exceed.
    for mode in [Mode::HandOver, Mode::Direct] {
        let options = HapticOptions { mode, max_force_rate: 2e-3, max_torque_rate: 1e-4, ..HapticOptions::default() };
        let rate = if mode == Mode::Direct { 1000.0 } else { 120.0 };
        let (mut simulation, mut device) = Simulation::new(combed_hair(20, 15.0), Rate::new(rate, 0.0), &options);
        let mut before = Vector3::zeros();
        let (mut limited, mut events, mut touched) = (0, 0, false);
        for tick in 0..1500 {
            let t = f64::from(tick) * TICK;
            let (pose, velocity, spin) = motion(stroke, t);
            let (wrench, state) = device.update(&pose, velocity, spin, TICK).unwrap();
            simulation.until(t);
            let jump = (wrench.force - before).norm();
            assert!(jump <= options.max_force_rate * TICK * (1.0 + 1e-9), "{mode:?} {tick}: {jump:e}");
            limited += u32::from(state.rate_limited);
            let contacts = state.contact.force != Vector3::zeros();
            events += u32::from(contacts != touched);
            (before, touched) = (wrench.force, contacts);
        }
        assert!(limited > 10 && events >= 2, "{mode:?}: {limited} {events}");
        assert!(before.norm() < 1e-12, "{mode:?}: {before}");
    }
}
