//! The golden hashes of the scene's course on every machine, and its settings.

use superhelix::{InstructionSet, Integrator, Precision, SolverOptions};

/// The state's hash at the end of the scene. The same on any machine: a change here is a change of numerical results, and belongs into
/// CHANGELOG.md. They may change with the method, the order of sums, tolerances, quadrature rules, what a state consists of, and with
/// the snapshot's layout, which the hash goes by; never with lanes, threads, compilers or machines.
pub const GOLDEN: [(Integrator, Precision, u64); 6] = [
    (Integrator::LinearlyImplicit, Precision::F64, 0xe70d_7d6d_9209_4b08),
    (Integrator::ImplicitEuler, Precision::F64, 0x1dc5_d929_cd34_563a),
    (Integrator::SecondOrder, Precision::F64, 0xf485_719e_b07b_2cdd),
    (Integrator::LinearlyImplicit, Precision::F32, 0xd241_fba0_4f0b_dac2),
    (Integrator::ImplicitEuler, Precision::F32, 0x63a4_2450_6649_1fde),
    (Integrator::SecondOrder, Precision::F32, 0x3764_4031_3129_0e22),
];

/// Settings in which strands may fail as the scene wants them to.
pub fn options(precision: Precision, set: InstructionSet) -> SolverOptions {
    // Roots that go further than hair can follow are what makes strands fail here.
    let mut options = SolverOptions { instruction_set: Some(set), jump_acceleration: f64::INFINITY, ..SolverOptions::default() };
    options.step.precision = precision;
    options
}

/// The settings of a golden course.
pub fn golden_options(integrator: Integrator, precision: Precision, set: InstructionSet) -> SolverOptions {
    let mut options = options(precision, set);
    (options.step.integrator, options.step.max_iterations) = (integrator, 12);
    if integrator == Integrator::SecondOrder {
        options.step.error_tolerance = 3e-3;
    }
    options
}
