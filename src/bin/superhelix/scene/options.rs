//! The keys of a scene that say how it is stepped.

use nalgebra::Vector3;
use superhelix::{ContactOptions, Integrator, LinearSolver, Precision, SolverOptions, StepOptions, UsualLimits, Workers};

use crate::scene::words::in_words_of_the_scene;
use crate::shell::json::{Complaint, Entries, Node};

/// The integrators by their names in a scene and on the command line.
pub const INTEGRATORS: [(&str, Integrator); 4] = [
    ("linearly_implicit", Integrator::LinearlyImplicit),
    ("implicit_euler", Integrator::ImplicitEuler),
    ("second_order", Integrator::SecondOrder),
    ("reference", Integrator::Reference),
];

/// The precisions by their names in a scene and on the command line.
pub const PRECISIONS: [(&str, Precision); 2] = [("f64", Precision::F64), ("f32", Precision::F32)];

/// The linear solvers by their names in a scene and on the command line.
pub const LINEAR_SOLVERS: [(&str, LinearSolver); 4] = [
    ("linear_time", LinearSolver::LinearTime),
    ("dense_cholesky", LinearSolver::DenseCholesky),
    ("dense_cg", LinearSolver::DenseConjugateGradients),
    ("dense_svd", LinearSolver::DenseSingularValues),
];

/// Units of work in a step at most: eleven days of one core.
const MOST_WORK: u64 = 1_000_000_000_000;

/// Reads them; how contact is answered is read elsewhere.
pub fn read(scene: &Entries, contact: ContactOptions) -> Result<SolverOptions, Complaint> {
    let defaults = SolverOptions::default();
    let integrator = scene.or("integrator", Integrator::default(), |node| node.choice(&INTEGRATORS))?;
    let linear_solver = scene.or("solver", LinearSolver::default(), |node| node.choice(&LINEAR_SOLVERS))?;
    let mut step = StepOptions { integrator, linear_solver, ..StepOptions::default() };
    step.precision = scene.or("precision", step.precision, |node| node.choice(&PRECISIONS))?;
    step.reference_tolerance = scene.or("reference_tolerance", step.reference_tolerance, Node::positive)?;
    step.max_subdivisions = scene.or("max_subdivisions", step.max_subdivisions, |node| Ok(node.whole(0..=10)? as u32))?;
    step.error_tolerance = scene.or("error_tolerance", step.error_tolerance, Node::not_negative)?;
    step.quadrature_tolerance = scene.or("quadrature_tolerance", step.quadrature_tolerance, Node::positive)?;
    if let Some(newton) = scene.get("newton") {
        let newton = newton.object(&["max_iterations", "tolerance"])?;
        step.max_iterations = newton.or("max_iterations", step.max_iterations, |node| Ok(node.whole(1..=10_000)? as u32))?;
        step.tolerance = newton.or("tolerance", step.tolerance, Node::positive)?;
    }
    let threads = scene.or("threads", 1, |node| node.whole(1..=256))? as usize;
    let options = SolverOptions {
        gravity: scene.or("gravity", defaults.gravity, |node| Ok(Vector3::from(node.numbers()?)))?,
        wind: scene.or("wind", defaults.wind, |node| Ok(Vector3::from(node.numbers()?)))?,
        step,
        workers: if threads == 1 { Workers::Serial } else { Workers::Pool(threads) },
        instruction_set: None,
        contact,
        jump_acceleration: scene.or("jump_acceleration", defaults.jump_acceleration, Node::positive)?,
        limits: UsualLimits {
            work: scene.get_unless_null("max_work").map(|node| node.whole(1..=MOST_WORK)).transpose()?,
            seconds: None,
        },
    };
    options.check("scene").map_err(in_words_of_the_scene)?;
    Ok(options)
}
