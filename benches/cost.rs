//! What a step costs an element: the linear-time solve from N = 5 to N = 500 elements a strand, and the dense one beside it.
//!
//! Every N takes the same scene: 0.2 m of gently bent hair, sag-free, on a root that sways by a centimetre at ½ Hz, the default
//! integrator (second order) at 1/60 s, Newton to 1e-6 rad, one thread. There are as many strands as make about 2000 elements. A round
//! takes every N through the same steps once, so that what else the machine does falls on all alike; the figures are medians (and
//! minima) over the rounds.
//!
//! `cargo bench --bench cost -- [--csv FILE] [--rounds 15]`

use std::fmt::Write as _;
use std::time::Instant;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::groom::fit::natural_under_gravity;
use superhelix::math::frame::Frame;
use superhelix::rod::material::Material;
use superhelix::solver::Solver;
use superhelix::solver::definition::{SolverOptions, StrandDef};
use superhelix::solver::id::StrandId;
use superhelix::step::options::LinearSolver;

const STEP: f64 = 1.0 / 60.0;
/// Steps timed a round.
const STEPS: usize = 6;
const ELEMENTS: usize = 2000;

struct Contestant {
    name: &'static str,
    count: usize,
    strands: usize,
    solver: Solver,
    ids: Vec<StrandId>,
    rest: Frame,
    step: usize,
    /// Seconds a step of one element, a value a round; the iterations that these steps took.
    seconds: Vec<f64>,
    iterations: Vec<f64>,
}

impl Contestant {
    fn new(name: &'static str, linear_solver: LinearSolver, count: usize) -> Self {
        let mut def = StrandDef::straight(0.2, count);
        def.material = Material { internal_friction: 1e-10, air_drag: 5e-6, ..Material::default() };
        let rest = Frame { origin: Vector3::zeros(), rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 1.2) };
        def.root = rest;
        let shape = vec![[1.0, 4.0, 0.0]; count];
        let gravity = SolverOptions::default().gravity;
        def.natural = natural_under_gravity(&def, &shape, gravity).expect("a natural shape");
        def.initial = Some(shape);
        let mut options = SolverOptions::default();
        options.step.linear_solver = linear_solver;
        let strands = if linear_solver == LinearSolver::LinearTime { (ELEMENTS / count).max(1) } else { (100 / count).max(1) };
        let mut solver = Solver::new(options).expect("a solver");
        let ids = solver.add_strands(&vec![def; strands]).expect("strands");
        let mut new = Self { name, count, strands, solver, ids, rest, step: 0, seconds: Vec::new(), iterations: Vec::new() };
        // Not timed: the first touch of all memory, and the sway's onset.
        new.take(30);
        (new.seconds, new.iterations) = (Vec::new(), Vec::new());
        new
    }

    fn take(&mut self, steps: usize) {
        let (mut seconds, mut iterations) = (0.0, 0.0);
        for _ in 0..steps {
            self.step += 1;
            let t = STEP * self.step as f64;
            let mut root = self.rest;
            root.origin.x += 0.01 * (std::f64::consts::PI * t).sin();
            let roots = vec![root; self.strands];
            self.solver.set_root_frames(&self.ids, &roots, STEP).expect("roots");
            let started = Instant::now();
            let report = self.solver.step(STEP, 1).expect("a step");
            seconds += started.elapsed().as_secs_f64();
            iterations += report.mean_iterations;
            assert_eq!((report.unconverged, report.quarantined), (0, 0), "{} N = {}", self.name, self.count);
        }
        self.seconds.push(seconds / (steps * self.strands * self.count) as f64);
        self.iterations.push(iterations / steps as f64);
    }
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let value = |name: &str| arguments.iter().position(|a| a == name).and_then(|at| arguments.get(at + 1));
    let rounds: usize = value("--rounds").map_or(15, |text| text.parse().expect("--rounds N"));
    let mut contestants: Vec<Contestant> = [5, 10, 20, 50, 100, 200, 500]
        .map(|count| Contestant::new("linear_time", LinearSolver::LinearTime, count))
        .into_iter()
        .chain([5, 10, 20, 50, 100].map(|count| Contestant::new("dense_cholesky", LinearSolver::DenseCholesky, count)))
        .collect();
    for round in 0..rounds {
        for contestant in &mut contestants {
            // The dense solve of long strands is slow and its growth plain: three rounds are enough.
            if contestant.name == "linear_time" || round < 3 {
                contestant.take(STEPS);
            }
        }
    }
    let mut csv = String::from(
        "solver,elements,strands,rounds,iterations,us_per_element_step,us_per_element_iteration,least_us_per_element_step\n",
    );
    println!(
        "{:15} {:>5} {:>11} {:>16} {:>21} {:>8}",
        "solver", "N", "iterations", "us/element/step", "us/element/iteration", "least"
    );
    for c in &contestants {
        let per_iteration: Vec<f64> = c.seconds.iter().zip(&c.iterations).map(|(s, i)| s / i * 1e6).collect();
        let (step, iterations) = (median(&c.seconds) * 1e6, c.iterations.iter().sum::<f64>() / c.iterations.len() as f64);
        let (each, least) = (median(&per_iteration), c.seconds.iter().copied().fold(f64::INFINITY, f64::min) * 1e6);
        println!("{:15} {:5} {iterations:11.3} {step:16.3} {each:21.3} {least:8.3}", c.name, c.count);
        writeln!(csv, "{},{},{},{},{iterations:.4},{step:.4},{each:.4},{least:.4}", c.name, c.count, c.strands, c.seconds.len())
            .expect("a string");
    }
    let steps: Vec<f64> = contestants.iter().filter(|c| c.name == "linear_time").map(|c| median(&c.seconds)).collect();
    let (least, most) = (steps.iter().copied().fold(f64::INFINITY, f64::min), steps.iter().copied().fold(0.0, f64::max));
    println!("linear time: the dearest element-step of all N costs {:.2} times the cheapest", most / least);
    if let Some(path) = value("--csv") {
        std::fs::write(path, csv).unwrap_or_else(|error| panic!("{path}: {error}"));
        println!("written: {path}");
    }
}
