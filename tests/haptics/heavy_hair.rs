//! Hair that is heavier than what the coupling holds within a step: the tool does not jump between device and hair.

use superhelix::haptic::{HapticOptions, Mode, haptic};

use super::scene::{TICK, combed_strands, motion, stroke};

/// Strands as heavy as wisps, of 0.15 g each: within a step they resist a tooth with up to 20 mass / TICK² = 3 kN/m, the coupling with 0.2.
const RADIUS: [f64; 2] = [5e-4; 2];
const STRANDS: usize = 20;

#[test]
fn heavy_hair_gets_no_more_energy_than_the_hand_gives() {
    let (mut solver, teeth) = combed_strands(STRANDS, 15.0, RADIUS);
    let options = HapticOptions { mode: Mode::Direct, stiffness: 100.0, damping: 0.1, ..HapticOptions::default() };
    let (mut tool, mut device) = haptic(&solver, &teeth, &options).unwrap();
    let (mut start, mut excess, mut most, mut pressed) = (None, 0.0_f64, 0.0_f64, 0);
    for tick in 0..1400 {
        let (pose, velocity, spin) = motion(stroke, f64::from(tick) * TICK);
        let (_, state) = device.update(&pose, velocity, spin, TICK).unwrap();
        tool.before_step(&mut solver, TICK).unwrap();
        let report = solver.step(TICK, 1).unwrap();
        tool.after_step(&mut solver).unwrap();
        let energies = report.energies;
        let energy = energies.kinetic + energies.elastic + energies.gravity;
        let stored = energy - *start.get_or_insert(energy);
        most = most.max(stored);
        excess = excess.max(stored - (state.energy_given - state.energy_got));
        pressed += u32::from(state.contact.force.norm() > 1e-3);
        assert_eq!(report.quarantined + report.unconverged, 0, "tick {tick}");
    }
    // What an update sees is a tick old, and the coupling itself stores some; air and friction take much more.
    println!("{most:e} J stored, {excess:e} J of it from nobody, {pressed} ticks of 1400 pressed");
    assert!(pressed > 500 && excess < 0.1 * most, "{excess:e} of {most:e} J, {pressed} ticks");
}
