//! What a quadrature tolerance adds to a motion's error, beside the error of the elements and steps.

use nalgebra::Vector3;
use superhelix::internals::math::quadrature::TIGHTEST;
use superhelix::{Solver, SolverOptions, StepOptions, StrandDef};

use crate::path::{FRAMES, POINTS, Path};
use crate::scene::{DURATION, GRAVITY, Scene};
use crate::walk::Walk;

/// Newton's tolerance, rad: its error is far below the measured ones.
const TOLERANCE: f64 = 1e-9;

/// Points at which velocities are compared, root and tip included: off the borders of elements, and on them.
const SAMPLES: usize = 41;

/// A path, and the mean number of points per element over the steps.
pub struct Run {
    /// The path.
    pub path: Path,
    /// Velocities of equally spaced points at every frame that ends a step, m/s.
    pub velocities: Vec<[Vector3<f64>; SAMPLES]>,
    /// Points per element, mean.
    pub points: f64,
}

/// A strand in `rate` steps per second with a quadrature tolerance.
pub fn run(scene: Scene, walk: &Walk, def: &StrandDef, rate: u32, quadrature_tolerance: f64) -> Run {
    let step = StepOptions { tolerance: TOLERANCE, max_iterations: 200, quadrature_tolerance, ..StepOptions::default() };
    let options = SolverOptions { gravity: Vector3::from(GRAVITY), step, ..SolverOptions::default() };
    let mut solver = Solver::new(options).expect("a solver");
    let ids = solver.add_strands(std::slice::from_ref(def)).expect("a strand");
    let arclengths: [f64; POINTS] = std::array::from_fn(|point| def.length() * (point + 1) as f64 / POINTS as f64);
    let h = 1.0 / f64::from(rate);
    let (mut path, mut velocities, mut points, mut frame) = (Path::default(), Vec::new(), 0, 0);
    let steps = (DURATION * f64::from(rate)).round() as u32;
    for number in 1..=steps {
        let t = h * f64::from(number);
        solver.set_wind(scene.wind(t - h)).expect("a wind");
        solver.set_root_frames(&ids, &[scene.root(walk, t)], h).expect("a root");
        let report = solver.step(h, 1).expect("a step");
        assert_eq!((report.unconverged, report.quarantined), (0, 0), "{} at {t} s", scene.name());
        points += solver.quadrature(ids[0]).expect("a strand").points;
        while (frame + 1) * rate <= number * FRAMES {
            let ends_here = (frame + 1) * rate == number * FRAMES;
            if ends_here {
                let mut here = [Vector3::zeros(); SAMPLES];
                solver.sample_strands(&ids, SAMPLES, |_, point, sample| here[point] = sample.velocity).expect("points");
                velocities.push(here);
            }
            path.frames.push(ends_here.then(|| {
                let mut shape = [Vector3::zeros(); POINTS];
                solver.sample_at(ids[0], &arclengths, |point, sample| shape[point] = sample.position).expect("points");
                shape
            }));
            frame += 1;
        }
    }
    Run { path, velocities, points: f64::from(points) / f64::from(steps) }
}

impl Run {
    /// Root mean square over points and the first `frames` frames of the distance of velocities, m/s.
    pub fn velocity_distance(&self, other: &Self, frames: usize) -> f64 {
        let pairs = self.velocities.iter().zip(&other.velocities).take(frames);
        let (mut sum, mut count) = (0.0, 0.0);
        for (one, two) in pairs {
            sum += one.iter().zip(two).map(|(one, two)| (one - two).norm_squared()).sum::<f64>();
            count += SAMPLES as f64;
        }
        (sum / count).sqrt()
    }
}

/// The run to compare the others with.
pub fn exact(scene: Scene, walk: &Walk, def: &StrandDef, rate: u32) -> Run {
    run(scene, walk, def, rate, TIGHTEST)
}
