//! The cost of a hand-over beside the step that it follows: processor time of the simulation's thread.

use std::fmt::Write as _;

use rustix::time::{ClockId, clock_gettime};
use superhelix::haptic::{HapticOptions, haptic};

use super::scene::{combed_hair, motion, stroke};

const RATE: f64 = 120.0;

/// Processor time of this thread, s.
fn thread_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The times of a stroke's frames.
#[derive(Default)]
struct Cost {
    steps: Vec<f64>,
    hand_overs: Vec<f64>,
    contacts: u32,
}

/// A stroke with this many frames; reads no clock unless `is_timed`.
fn comb(strands: usize, frames: usize, is_timed: bool) -> Cost {
    let (mut solver, teeth) = combed_hair(strands, 15.0);
    let (mut tool, mut device) = haptic(&solver, &teeth, &HapticOptions::default()).expect("a tool");
    let mut cost = Cost::default();
    let clock = || if is_timed { thread_seconds() } else { 0.0 };
    for frame in 0..frames {
        let (pose, velocity, spin) = motion(stroke, frame as f64 / RATE);
        let (_, state) = device.update(&pose, velocity, spin, 1.0 / RATE).expect("a pose");
        tool.before_step(&mut solver, 1.0 / RATE).expect("the tool's bodies");
        let start = clock();
        solver.step(1.0 / RATE, 1).expect("a step");
        let middle = clock();
        tool.after_step(&mut solver).expect("the tool's bodies");
        cost.hand_overs.push(clock() - middle);
        cost.steps.push(middle - start);
        cost.contacts = cost.contacts.max(state.contacts);
    }
    cost
}

/// A stroke without a clock, for a profiler.
pub fn once(strands: usize, frames: usize) {
    comb(strands, frames, false);
}

/// Writes the table.
pub fn table(out: &str) {
    let mut csv = "strands,contacts,step_ms,hand_over_ms,longest_hand_over_ms\n".to_string();
    for strands in [20, 100, 1000] {
        let mut cost = comb(strands, 168, true);
        // From the time at which the comb is in the hair.
        let (mut steps, mut hand_overs) = (cost.steps.split_off(40), cost.hand_overs.split_off(40));
        let longest = hand_overs.iter().copied().fold(0.0, f64::max);
        let line = format!(
            "{strands},{},{:.3},{:.3},{:.3}",
            cost.contacts,
            1e3 * median(&mut steps),
            1e3 * median(&mut hand_overs),
            1e3 * longest
        );
        println!("{line}");
        let _ = writeln!(csv, "{line}");
    }
    std::fs::write(out, csv).expect("a file");
}
