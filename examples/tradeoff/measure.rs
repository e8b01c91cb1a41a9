//! One setting in one scene: its error and its cost.

use nalgebra::Vector3;
use rustix::time::{ClockId, clock_gettime};
use superhelix::{Solver, SolverOptions, StepOptions, StrandDef};

use super::path::{Distance, FRAMES, POINTS, Path};
use super::reference::Truth;
use super::scene::{DURATION, GRAVITY, Scene};
use super::setting::Setting;
use super::walk::Walk;

/// Number of strands stepped side by side, on one thread, so that they share the cost of a call as in a groom: one where a step
/// itself is costly.
fn strands(elements: u32) -> usize {
    if elements >= 12 { 1 } else { 3 }
}

/// A step's time is the least of this many runs: the others include effects of other programs on the caches.
const RUNS: usize = 5;
/// Runs stop repeating after this many seconds: long ones average by themselves.
const PATIENCE: f64 = 0.05;

/// The result.
#[derive(Debug, Clone, Copy)]
pub struct Measured {
    /// The error; `None` if it blew up.
    pub error: Option<Distance>,
    /// When it blew up, s.
    pub blown_up: Option<f64>,
    /// Processor time, µs per strand and simulated second.
    pub cost: f64,
    /// Newton iterations per step.
    pub iterations: f64,
    /// Fraction of the steps that did not reach the tolerance.
    pub unconverged: f64,
}

/// One run: its path, the times of its steps, s, total iterations and unconverged strand-steps, and when it blew up.
struct Run {
    path: Path,
    seconds: Vec<f64>,
    iterations: f64,
    unconverged: u32,
    blown_up: Option<f64>,
}

/// Processor time of this thread, s.
fn processor_time() -> f64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

fn run(scene: Scene, walk: &Walk, setting: &Setting, def: &StrandDef) -> Run {
    let step = StepOptions {
        integrator: setting.integrator,
        max_iterations: setting.cap,
        tolerance: setting.tolerance,
        max_subdivisions: setting.subdivisions,
        error_tolerance: setting.error_tolerance,
        quadrature_tolerance: setting.quadrature_tolerance,
        ..StepOptions::default()
    };
    let strands = strands(setting.elements);
    let options = SolverOptions { gravity: Vector3::from(GRAVITY), step, ..SolverOptions::default() };
    let mut solver = Solver::new(options).expect("a solver");
    let ids = solver.add_strands(&vec![def.clone(); strands]).expect("strands");
    let length = def.length();
    let arclengths: [f64; POINTS] = std::array::from_fn(|point| length * (point + 1) as f64 / POINTS as f64);
    let h = 1.0 / f64::from(setting.rate);
    let mut all = Run { path: Path::default(), seconds: Vec::new(), iterations: 0.0, unconverged: 0, blown_up: None };
    // Frames that end a step.
    let mut frame = 0;
    let mut last = None;
    for number in 1..=(DURATION * f64::from(setting.rate)).round() as u32 {
        let t = h * f64::from(number);
        solver.set_wind(scene.wind(t - h)).expect("a wind");
        let root = scene.root(walk, t);
        let began = processor_time();
        solver.set_root_frames(&ids, &vec![root; strands], h).expect("roots");
        let report = solver.step(h, 1).expect("a step");
        all.seconds.push(processor_time() - began);
        all.iterations += report.mean_iterations;
        all.unconverged += report.unconverged;
        let mut points = [Vector3::zeros(); POINTS];
        solver.sample_at(ids[0], &arclengths, |point, sample| points[point] = sample.position).expect("points");
        let tip = points[POINTS - 1];
        let largest = solver.curvatures(ids[0]).expect("curvatures").iter().flatten().fold(0.0_f64, |most, k| most.max(k.abs()));
        let fast = last.is_some_and(|last: Vector3<f64>| (tip - last).norm() > 100.0 * h);
        last = Some(tip);
        if report.quarantined > 0 || largest > 1e6 || fast {
            all.blown_up = Some(t);
            return all;
        }
        // Does step `number` end at, or first pass, a frame?
        if number * FRAMES >= (frame + 1) * setting.rate {
            while (frame + 1) * setting.rate < number * FRAMES {
                all.path.frames.push(None);
                frame += 1;
            }
            if (frame + 1) * setting.rate == number * FRAMES {
                all.path.frames.push(Some(points));
                frame += 1;
            }
        }
    }
    all
}

/// Measures a setting; `def` is the initial strand.
pub fn measure(scene: Scene, walk: &Walk, setting: &Setting, def: &StrandDef, truth: &Truth) -> Measured {
    let began = processor_time();
    let mut first = run(scene, walk, setting, def);
    for _ in 1..RUNS {
        if processor_time() - began > PATIENCE {
            break;
        }
        let again = run(scene, walk, setting, def);
        for (least, seconds) in first.seconds.iter_mut().zip(again.seconds) {
            *least = least.min(seconds);
        }
    }
    let steps = first.seconds.len() as f64;
    let strand_count = strands(setting.elements) as f64;
    let strand_seconds = strand_count * steps / f64::from(setting.rate);
    Measured {
        error: first.blown_up.is_none().then(|| first.path.distance(&truth.path, truth.frames, def.length())),
        blown_up: first.blown_up,
        cost: 1e6 * first.seconds.iter().sum::<f64>() / strand_seconds,
        iterations: first.iterations / steps,
        unconverged: f64::from(first.unconverged) / (strand_count * steps),
    }
}
