//! What lanes bring.
use nalgebra::{UnitQuaternion, Vector3};
use std::time::Instant;
use superhelix::math::frame::Frame;
use superhelix::math::lane::Precision;
use superhelix::math::lanes::InstructionSet;
use superhelix::rod::material::Material;
use superhelix::solver::Solver;
use superhelix::solver::definition::{SolverOptions, StrandDef};
use superhelix::step::options::Integrator;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let number = |i: usize, d: usize| arguments.get(i).map_or(d, |a| a.parse().unwrap());
    let (n, strands, steps) = (number(1, 5), number(2, 400), number(3, 60));
    let only = arguments.get(4).cloned().unwrap_or_default();
    for integrator in [Integrator::SecondOrder, Integrator::LinearlyImplicit] {
        for precision in [Precision::F64, Precision::F32] {
            for set in [InstructionSet::Scalar, InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512] {
                if !format!("{integrator:?} {precision:?} {}", set.name()).contains(&only) {
                    continue;
                }
                let mut options = SolverOptions::default();
                options.step.precision = precision;
                options.step.integrator = integrator;
                options.instruction_set = Some(set);
                let mut solver = Solver::new(options).unwrap();
                let rest = Frame { origin: Vector3::zeros(), rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 1.2) };
                let defs: Vec<_> = (0..strands)
                    .map(|k| {
                        let mut def = StrandDef::straight(0.2, n);
                        def.material = Material { internal_friction: 1e-10, air_drag: 5e-6, ..Material::default() };
                        def.root = rest;
                        def.natural = vec![[1.0, 4.0 + 0.01 * k as f64, 0.0]; n];
                        def
                    })
                    .collect();
                let ids = solver.add_strands(&defs).unwrap();
                let h = 1.0 / 60.0;
                let (mut seconds, mut iterations) = (f64::MAX, 0.0);
                let mut total = 0.0;
                let mut unconverged = 0;
                for step in 0..steps {
                    let t = h * step as f64;
                    let mut root = rest;
                    root.origin.x += 0.01 * (std::f64::consts::PI * t).sin();
                    solver.set_root_frames(&ids, &vec![root; strands], h).unwrap();
                    let started = Instant::now();
                    let report = solver.step(h, 1).unwrap();
                    if step > 20 {
                        total += started.elapsed().as_secs_f64();
                        iterations += report.mean_iterations;
                        seconds = seconds.min(started.elapsed().as_secs_f64() / report.mean_iterations);
                        unconverged += report.unconverged + report.quarantined;
                    }
                }
                let per = 1e9 / (strands * n) as f64;
                println!(
                    "{integrator:?} {precision:?} {:8} least {:6.0} ns/element-iteration, mean {:6.0} ns/element-step, {:.2} iterations, unconverged {unconverged}, energy {:?}",
                    set.name(),
                    seconds * per,
                    total * per / (steps - 21) as f64,
                    iterations / (steps - 21) as f64,
                    solver.state_hash()
                );
            }
        }
    }
}
