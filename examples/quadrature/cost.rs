//! Steps for counting instructions: calmly swaying strands whose elements turn by four fifths of a radian.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::natural_under_gravity_with;
use superhelix::{Frame, Solver, SolverOptions, StepOptions, StrandDef};

/// Elements per strand.
const ELEMENTS: usize = 10;
/// Length of a strand, m.
const LENGTH: f64 = 0.2;

/// Takes eight strands through `steps` steps; returns points per element, Newton iterations per step and total element-steps.
pub fn run(quadrature_tolerance: f64, steps: u32) -> (u32, f64, f64) {
    let step = StepOptions { quadrature_tolerance, ..StepOptions::default() };
    let options = SolverOptions { step, ..SolverOptions::default() };
    let gravity = options.gravity;
    let mut solver = Solver::new(options).expect("a solver");
    let mut def = StrandDef::straight(LENGTH, ELEMENTS);
    def.material.air_drag = 5e-6;
    def.material.internal_friction = 1e-10;
    def.root.rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 1.2);
    def.material.radius = [80e-6; 2];
    let shape = vec![[10.0, 38.7, 0.0]; ELEMENTS];
    def.natural = natural_under_gravity_with(&def, &shape, gravity, quadrature_tolerance).expect("a natural shape");
    def.initial = Some(shape);
    let strands = vec![def.clone(); 8];
    let ids = solver.add_strands(&strands).expect("strands");
    let h = 1.0 / 60.0;
    let mut iterations = 0.0;
    for number in 1..=steps {
        let sway = 0.01 * (std::f64::consts::PI * h * f64::from(number)).sin();
        let root = Frame { origin: Vector3::new(0.0, sway, 0.0), ..def.root };
        solver.set_root_frames(&ids, &[root; 8], h).expect("roots");
        iterations += solver.step(h, 1).expect("a step").mean_iterations;
    }
    let points = solver.quadrature(ids[0]).expect("a strand").points;
    (points, iterations / f64::from(steps), f64::from(steps) * (8 * ELEMENTS) as f64)
}
