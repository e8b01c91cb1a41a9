//! One strand through one motion, in one precision.

use nalgebra::Vector3;
use superhelix::editing::EquilibriumOptions;
use superhelix::{Integrator, Precision, Solver, SolverOptions, StrandDef, StrandId};

use crate::motion::Motion;

/// Compared points, including the root.
pub const POINTS: usize = 17;
/// Comparisons per second.
const FRAMES: u32 = 30;

/// The stepping of a strand.
#[derive(Debug, Clone, Copy)]
pub struct Way<'a> {
    /// The head's motion.
    pub motion: &'a Motion,
    /// Steps per second: a multiple of 30.
    pub rate: u32,
    /// Seconds simulated.
    pub seconds: f64,
    /// Which integrator.
    pub integrator: Integrator,
}

/// The result of a run.
#[derive(Debug, Clone, Default)]
pub struct Course {
    /// The points at every thirtieth of a second.
    pub frames: Vec<[Vector3<f64>; POINTS]>,
    /// Kinetic, elastic and gravitational energy together, then.
    pub energies: Vec<f64>,
    /// Mean iterations a step.
    pub iterations: f64,
    /// Steps that did not converge, were subdivided, were rolled back.
    pub failures: [u32; 3],
    /// The largest residual of a step, rad.
    pub residual: f64,
}

fn points(solver: &Solver, id: StrandId) -> [Vector3<f64>; POINTS] {
    let mut points = [Vector3::zeros(); POINTS];
    solver.sample_strands(&[id], POINTS, |_, point, sample| points[point] = sample.position).expect("samples");
    points
}

/// Steps a strand. `settled`: from its equilibrium, found in f64, at rest; otherwise from its natural shape.
pub fn run(def: &StrandDef, way: &Way, precision: Precision, settled: bool) -> Course {
    let mut options = SolverOptions { gravity: Vector3::new(0.0, -9.81, 0.0), ..SolverOptions::default() };
    (options.step.integrator, options.step.precision) = (way.integrator, precision);
    let mut solver = Solver::new(options).expect("a solver");
    let mut def = def.clone();
    def.root = way.motion.root(0.0);
    (def.root_velocity, def.root_angular_velocity) = way.motion.root_velocity();
    let id = solver.add_strands(&[def]).expect("a strand")[0];
    if settled {
        let found = solver.settle(&[id], &EquilibriumOptions::default()).expect("a rest");
        assert!(found[0].converged, "{found:?}");
    }
    let h = 1.0 / f64::from(way.rate);
    let steps = (way.seconds * f64::from(way.rate)).round() as u32;
    let mut course = Course { frames: vec![points(&solver, id)], energies: vec![total(&solver, id)], ..Course::default() };
    for step in 1..=steps {
        solver.set_root_frames(&[id], &[way.motion.root(h * f64::from(step))], h).expect("a root");
        let report = solver.step(h, 1).expect("a step");
        course.iterations += report.mean_iterations / f64::from(steps);
        course.residual = course.residual.max(report.max_residual);
        for (count, more) in course.failures.iter_mut().zip([report.unconverged, report.subdivided, report.quarantined]) {
            *count += more;
        }
        if step % (way.rate / FRAMES) == 0 {
            course.frames.push(points(&solver, id));
            course.energies.push(total(&solver, id));
        }
    }
    course
}

fn total(solver: &Solver, id: StrandId) -> f64 {
    let energies = solver.energies(id).expect("energies");
    energies.kinetic + energies.elastic + energies.gravity
}

/// The largest distance of corresponding points at corresponding times, and at the end.
pub fn apart(a: &Course, b: &Course) -> (f64, f64) {
    let distance =
        |x: &[Vector3<f64>; POINTS], y: &[Vector3<f64>; POINTS]| x.iter().zip(y).map(|(x, y)| (x - y).norm()).fold(0.0, f64::max);
    let all = a.frames.iter().zip(&b.frames).map(|(x, y)| distance(x, y));
    let last = a.frames.last().zip(b.frames.last()).map_or(0.0, |(x, y)| distance(x, y));
    (all.fold(0.0, f64::max), last)
}
