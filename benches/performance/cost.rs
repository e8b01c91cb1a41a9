//! The cost of a step per element: over N, by instructions, precision, threads, integrator, Hessian, linear solve and scene.

use superhelix::{InstructionSet, Integrator, LinearSolver, Precision};

use crate::crowd::{Crowd, Setting, Timed};
use crate::scene::{Hair, Scene};
use crate::statistics::Summary;
use crate::table::{Table, digits};

/// All numbers of elements.
const COUNTS: [usize; 9] = [1, 5, 10, 20, 50, 100, 200, 500, 1000];
const PRECISIONS: [Precision; 2] = [Precision::F64, Precision::F32];

/// The sets of instructions that this machine has.
fn sets() -> impl Iterator<Item = InstructionSet> {
    [InstructionSet::Scalar, InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512]
        .into_iter()
        .filter(|set| *set <= InstructionSet::detected())
}

fn precision_name(precision: Precision) -> &'static str {
    if precision == Precision::F64 { "f64" } else { "f32" }
}

/// Crowds that take turns.
struct Contest {
    crowds: Vec<(Vec<String>, Crowd, Vec<Timed>)>,
}

impl Contest {
    fn new(settings: Vec<(Vec<String>, Setting)>, warm: u32) -> Self {
        Self { crowds: settings.into_iter().map(|(name, setting)| (name, Crowd::warm(&setting, warm), Vec::new())).collect() }
    }

    /// Rounds in which every crowd takes a sample of some steps.
    fn run(&mut self, rounds: usize, steps: u32) {
        for _ in 0..rounds {
            for (_, crowd, samples) in &mut self.crowds {
                samples.push(crowd.take(steps));
            }
        }
    }

    /// Rows: the name, iterations, µs per element-step, µs per element-iteration, spread, fraction of strand-steps that failed.
    fn rows(&self, table: &mut Table) {
        for (name, crowd, samples) in &self.crowds {
            let elements = crowd.elements() as f64;
            let step = Summary::of(&samples.iter().map(|timed| timed.seconds / elements * 1e6).collect::<Vec<_>>());
            let each: Vec<_> = samples.iter().map(|timed| timed.seconds / timed.iterations / elements * 1e6).collect();
            let mean = |value: fn(&Timed) -> f64| samples.iter().map(value).sum::<f64>() / samples.len() as f64;
            let mut cells = name.clone();
            cells.extend([
                format!("{:.3}", mean(|timed| timed.iterations)),
                digits(step.median),
                digits(Summary::of(&each).median),
                format!("{:.3}", step.spread),
                digits(mean(|timed| timed.failed)),
            ]);
            table.row(cells);
        }
    }
}

/// Over N, for every set of instructions and both precisions; and the dense solve beside it.
pub fn over_elements(rounds: usize) -> Table {
    let title = "Cost over N: calm scene, second order, one thread, as many strands as make about 2000 elements";
    let mut table = Table::new(
        "cost",
        title,
        &["solver", "set", "precision", "N", "iterations", "us_element_step", "us_element_iter", "spread", "failed"],
    );
    let named = |solver: &str, set: &str, precision, count: usize| {
        vec![solver.to_owned(), set.to_owned(), precision_name(precision).to_owned(), count.to_string()]
    };
    for precision in PRECISIONS {
        for set in sets() {
            let settings = COUNTS.map(|count| {
                let setting = Setting::new(count).precision(precision).instructions(set);
                (named("linear time", set.name(), precision, count), setting)
            });
            let mut contest = Contest::new(settings.into(), 20);
            contest.run(rounds, 2);
            contest.rows(&mut table);
        }
    }
    let dense = [5, 10, 20, 50, 100].map(|count| {
        let mut setting = Setting::new(count).strands((100 / count).max(1));
        setting.options.step.linear_solver = LinearSolver::DenseCholesky;
        (named("dense cholesky", "scalar", Precision::F64, count), setting)
    });
    let mut contest = Contest::new(dense.into(), 10);
    contest.run(3, 1);
    contest.rows(&mut table);
    table
}

/// Integrators, Hessians, precisions and threads, N = 10.
pub fn by_options(rounds: usize) -> Table {
    let header =
        ["integrator", "hessian", "precision", "threads", "iterations", "us_element_step", "us_element_iter", "spread", "failed"];
    let mut table =
        Table::new("options", "Integrators, Hessian, precision, threads: calm scene, 10 elements, 2048 strands", &header);
    let integrators = [
        ("linearly implicit", Integrator::LinearlyImplicit),
        ("implicit Euler", Integrator::ImplicitEuler),
        ("second order", Integrator::SecondOrder),
    ];
    let mut settings = Vec::new();
    for (name, integrator) in integrators {
        for exact in [true, false] {
            if integrator == Integrator::LinearlyImplicit && !exact {
                continue;
            }
            for precision in PRECISIONS {
                for threads in [1, 2] {
                    let hessian = match (integrator, exact) {
                        (Integrator::LinearlyImplicit, _) => "none",
                        (_, true) => "exact",
                        (_, false) => "Gauss-Newton",
                    };
                    let setting = Setting::new(10).strands(2048).hair(Hair::viscous(10)).integrator(integrator).exact(exact);
                    let name =
                        vec![name.to_owned(), hessian.to_owned(), precision_name(precision).to_owned(), threads.to_string()];
                    settings.push((name, setting.precision(precision).threads(threads)));
                }
            }
        }
    }
    let mut contest = Contest::new(settings, 10);
    contest.run(rounds, 1);
    contest.rows(&mut table);
    table
}

/// Scenes.
pub fn by_scene(rounds: usize) -> Table {
    let header = ["scene", "precision", "N", "iterations", "us_element_step", "us_element_iter", "spread", "failed"];
    let mut table = Table::new("scenes", "Scenes: second order, one thread, about 5000 elements", &header);
    let mut settings = Vec::new();
    for scene in [Scene::Sway, Scene::Shake, Scene::Walk] {
        for precision in PRECISIONS {
            for count in [5, 10, 20] {
                let setting = Setting::new(count).scene(scene).precision(precision).strands(5120 / count);
                settings.push((vec![scene.name().to_owned(), precision_name(precision).to_owned(), count.to_string()], setting));
            }
        }
    }
    let mut contest = Contest::new(settings, 60);
    contest.run(rounds, 2);
    contest.rows(&mut table);
    table
}

/// From one strand to every hair of a head, 5 elements each.
pub fn over_strands(rounds: usize) -> Table {
    let header = ["kind", "strands", "threads", "ms_step", "us_element_step", "spread", "bytes_strand", "failed"];
    let mut table = Table::new("scaling", "From one strand to all of a head: calm scene, 5 elements", &header);
    let kinds = [
        ("second order f64", Setting::new(5).hair(Hair::viscous(5))),
        (
            "linearly implicit f32",
            Setting::new(5).hair(Hair::viscous(5)).precision(Precision::F32).integrator(Integrator::LinearlyImplicit),
        ),
    ];
    for (name, setting) in kinds {
        for strands in [1, 2, 4, 8, 16, 32, 64, 256, 1024, 4096, 16_384, 65_536, 150_000] {
            for threads in [1, 2] {
                let setting = setting.clone().strands(strands).threads(threads);
                let few = strands >= 16_384;
                let mut crowd = Crowd::warm(&setting, if few { 3 } else { 20 });
                let steps = (256 / strands as u32).clamp(1, 16);
                let rounds = if few { rounds.min(5) } else { rounds };
                let samples: Vec<_> = (0..rounds).map(|_| crowd.take(steps)).collect();
                let step = Summary::of(&samples.iter().map(|timed| timed.seconds).collect::<Vec<_>>());
                table.row(vec![
                    name.to_owned(),
                    strands.to_string(),
                    threads.to_string(),
                    digits(1e3 * step.median),
                    digits(1e6 * step.median / crowd.elements() as f64),
                    format!("{:.3}", step.spread),
                    digits(crowd.solver.memory_usage() as f64 / strands as f64),
                    digits(samples.iter().map(|timed| timed.failed).sum::<f64>() / samples.len() as f64),
                ]);
            }
        }
    }
    table
}
