//! The speed of convergence of solvers for the contact problem.

mod problem;

use std::time::Instant;

use nalgebra::Vector3;
use problem::{Kind, build};
use superhelix::internals::contact::solver::gauss_seidel::{GaussSeidel, Settings};

fn main() {
    let base = Kind { strands: 1000, elements: 10, on_head: 5, pairs: 2.5, mu: 0.3, curl: 5.0 };
    let kinds = [
        ("head and hair", base),
        ("curly", Kind { curl: 60.0, ..base }),
        ("head only", Kind { pairs: 0.0, on_head: 10, ..base }),
        ("rough", Kind { mu: 1.0, ..base }),
        ("dense", Kind { on_head: 10, pairs: 10.0, ..base }),
    ];
    for (name, kind) in kinds {
        let (mut space, next) = build(&kind);
        let mut solver = GaussSeidel::default();
        let mut forces = vec![Vector3::zeros(); space.constraints().len()];
        let start = Instant::now();
        solver.system.prepare(&space);
        let prepared = start.elapsed().as_secs_f64();
        for (stage, warm) in [("cold", false), ("warm", true)] {
            if warm {
                for (constraint, unconstrained) in next.iter().enumerate() {
                    space.set_unconstrained(constraint, *unconstrained).unwrap();
                }
            }
            let begin = forces.clone();
            for tolerance in [1e-3, 1e-6] {
                forces.copy_from_slice(&begin);
                let start = Instant::now();
                let report = solver.solve(&space, &Settings { tolerance, max_sweeps: 3000, ..Settings::default() }, &mut forces);
                let time = start.elapsed().as_secs_f64();
                let active = forces.iter().filter(|f| f.norm() > 0.0).count();
                println!(
                    "{name:14} {stage} {tolerance:e}: {:5} sweeps {:8.2} ms (prepare {:.2}), residual {:.1e}, {} contacts, {active} active, force {:.1e} N",
                    report.sweeps,
                    1e3 * time,
                    1e3 * prepared,
                    report.residual,
                    forces.len(),
                    report.force
                );
            }
        }
    }
}
