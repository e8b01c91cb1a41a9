//! Strokes through a groom in real time, with the device at 1 kHz and the simulation beside it: the time of an update, and the
//! delays of poses and forces between the two sides.

use std::fmt::Write as _;
use std::time::{Duration, Instant};

use rustix::time::{ClockId, clock_gettime};
use superhelix::haptic::{Device, HapticOptions, Tool, haptic};
use superhelix::{Solver, StepLimits};

use super::groom;
use super::scene::{TICK, motion};

/// Processor time of this thread, s.
fn thread_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// One update: its start and end, s, its processor time, and the age of the pose behind its force.
#[derive(Clone, Copy)]
struct Update {
    began: f64,
    ended: f64,
    own: f64,
    models: u64,
    model_age: f64,
}

/// The times at which a step took its pose and published its result, s.
#[derive(Clone, Copy)]
struct Step {
    began: f64,
    ended: f64,
    own: f64,
}

fn sleep_until(start: Instant, seconds: f64) {
    let until = start + Duration::from_secs_f64(seconds);
    while let Some(left) = until.checked_duration_since(Instant::now()).filter(|left| !left.is_zero()) {
        std::thread::sleep(left);
    }
}

fn updates(mut device: Device, start: Instant, ticks: usize) -> Vec<Update> {
    let mut all = Vec::with_capacity(ticks);
    for tick in 0..ticks {
        let due = tick as f64 * TICK;
        sleep_until(start, due);
        let (pose, velocity, spin) = motion(groom::stroke, due);
        let (began, own) = (start.elapsed().as_secs_f64(), thread_seconds());
        let (_, state) = device.update(&pose, velocity, spin, TICK).expect("a pose");
        let own = thread_seconds() - own;
        let ended = start.elapsed().as_secs_f64();
        all.push(Update { began, ended, own, models: state.models, model_age: state.model_age });
    }
    all
}

fn steps(mut solver: Solver, mut tool: Tool, start: Instant, rate: f64, seconds: f64) -> Vec<Step> {
    let limits = StepLimits { seconds: Some(0.7 / rate), ..StepLimits::default() };
    let mut all = Vec::new();
    let mut frame = 0;
    while frame as f64 / rate < seconds {
        sleep_until(start, frame as f64 / rate);
        let (began, own) = (start.elapsed().as_secs_f64(), thread_seconds());
        tool.before_step(&mut solver, 1.0 / rate).expect("the tool's bodies");
        solver.step_within(1.0 / rate, 1, &limits).expect("a step");
        tool.after_step(&mut solver).expect("the tool's bodies");
        all.push(Step { began, ended: start.elapsed().as_secs_f64(), own: thread_seconds() - own });
        // Skips frames whose time has passed.
        frame = (frame + 1).max((start.elapsed().as_secs_f64() * rate) as usize);
    }
    all
}

/// Median, 99th and 99.9th percentile, and the longest, ms.
fn spread(mut values: Vec<f64>) -> [f64; 4] {
    values.sort_by(f64::total_cmp);
    let at = |part: f64| 1e3 * values[((values.len() as f64 * part) as usize).min(values.len() - 1)];
    [at(0.5), at(0.99), at(0.999), at(1.0)]
}

/// Writes the measurements: one line per quantity, and the latencies' histograms in quarters of a millisecond.
pub fn measure(out: &str, histogram: &str, seconds: f64, rate: f64, threads: usize) {
    let (solver, teeth) = groom::combed(1, 4, threads);
    let options = HapticOptions::default();
    let (tool, device) = haptic(&solver, &teeth, &options).expect("a tool");
    let ticks = (seconds / TICK) as usize;
    let start = Instant::now() + Duration::from_millis(50);
    let (updates, steps) = std::thread::scope(|scope| {
        let device = scope.spawn(move || updates(device, start, ticks));
        let steps = steps(solver, tool, start, rate, seconds);
        (device.join().expect("no panic"), steps)
    });

    // From a pose to the step that takes it: the newest one at the step's start.
    let to_simulation = steps.iter().filter_map(|step| {
        let next = updates.partition_point(|update| update.ended <= step.began);
        (next > 0).then(|| step.began - updates[next - 1].began)
    });
    // From a step's publication to the first update that starts afterwards.
    let to_device = steps.iter().filter_map(|step| {
        let next = updates.partition_point(|update| update.began < step.ended);
        updates.get(next).map(|update| update.ended - step.ended)
    });
    let whole_way = updates.windows(2).filter(|pair| pair[1].models > pair[0].models).map(|pair| pair[1].model_age);
    let (to_simulation, to_device, whole_way) =
        (to_simulation.collect::<Vec<_>>(), to_device.collect::<Vec<_>>(), whole_way.collect::<Vec<_>>());
    let late = updates.iter().enumerate().map(|(tick, update)| (update.began - tick as f64 * TICK).max(0.0));
    let own_misses = updates.iter().filter(|update| update.own > TICK).count();
    let misses = updates.iter().enumerate().filter(|(tick, update)| update.ended > (*tick as f64 + 1.0) * TICK).count();

    let mut csv = "what,median_ms,p99_ms,p99.9_ms,longest_ms\n".to_string();
    let lines = [
        ("an update, processor time", spread(updates.iter().map(|update| update.own).collect())),
        ("an update, by the clock", spread(updates.iter().map(|update| update.ended - update.began).collect())),
        ("how late the device's thread woke", spread(late.collect())),
        ("a step and its hand-over, processor time of its thread", spread(steps.iter().map(|step| step.own).collect())),
        ("a step and its hand-over, by the clock", spread(steps.iter().map(|step| step.ended - step.began).collect())),
        ("from a pose to the step that takes it", spread(to_simulation.clone())),
        ("from a step's end to the force in the hand", spread(to_device.clone())),
        ("from a pose to the first force of a step taken with it", spread(whole_way.clone())),
    ];
    for (what, [median, p99, p999, longest]) in lines {
        let _ = writeln!(csv, "\"{what}\",{median:.4},{p99:.4},{p999:.4},{longest:.4}");
    }
    let _ = writeln!(
        csv,
        "\"{} updates; by their own processor time missed: {own_misses}; by the clock, waking included: {misses}\",,,,",
        updates.len()
    );
    let _ = writeln!(csv, "\"{} steps of {} at {rate} Hz, {threads} threads\",,,,", steps.len(), (seconds * rate) as usize);
    print!("{csv}");
    std::fs::write(out, csv).expect("a file");

    const BIN: f64 = 2.5e-4;
    let mut bins = vec![[0_u32; 3]; 161];
    for (way, latencies) in [to_simulation, to_device, whole_way].iter().enumerate() {
        for latency in latencies {
            // (A model's age is whole milliseconds, except for rounding.)
            bins[(((latency + 1e-9) / BIN) as usize).min(160)][way] += 1;
        }
    }
    let mut csv = "from_ms,to_simulation,to_device,whole_way\n".to_string();
    for (bin, [simulation, device, whole]) in bins.iter().enumerate() {
        let _ = writeln!(csv, "{:.2},{simulation},{device},{whole}", 1e3 * BIN * bin as f64);
    }
    std::fs::write(histogram, csv).expect("a file");
}
