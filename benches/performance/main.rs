//! The cost of the engine, all in one run: the required costs, and tables over N, instructions, precision, threads, integrators,
//! scenes, freedoms, terms and numbers of strands. `docs/notebook/performance.md` shows and explains them.
//!
//! Compared rows take turns: a round takes each through the same steps once, so that other programs affect all alike; figures are
//! medians over the rounds. On one thread the figure is processor time, on two the wall clock.
//!
//! `cargo bench --profile demo --bench performance -- [--csv DIRECTORY] [--rounds 15] [--only aims,cost,…]`
//! `cargo bench … -- --profile N f64|f32 SET exact|gauss_newton|linearly_implicit|head SECONDS`: nothing but steps, for a
//! profiler (of nine iterations; or 50000 strands of 5 elements).
//! `cargo bench … -- --steps COUNT N f64|f32 SET ITERATIONS`: that many steps of 16 strands, for `scripts/instructions.sh`.

mod absent;
mod aims;
mod cold;
mod cost;
mod counted;
mod crowd;
mod machine;
mod marginal;
mod scene;
mod statistics;
mod table;

use std::path::PathBuf;
use std::time::Instant;

use superhelix::{InstructionSet, Integrator, Precision};

use crate::crowd::{Crowd, Setting, processor_seconds};
use crate::machine::Peak;
use crate::scene::Hair;
use crate::table::{Table, digits};

/// All parts, in the order of measurement.
const PARTS: [&str; 8] = ["cold", "machine", "aims", "cost", "options", "scenes", "absent", "scaling"];

fn main() {
    let started = Instant::now();
    let arguments: Vec<String> = std::env::args().collect();
    let value = |name: &str| arguments.iter().position(|a| a == name).and_then(|at| arguments.get(at + 1));
    if let Some(at) = arguments.iter().position(|a| a == "--profile") {
        return profile(&arguments[at + 1..]);
    }
    if let Some(at) = arguments.iter().position(|a| a == "--steps") {
        return steps(&arguments[at + 1..]);
    }
    let rounds: usize = value("--rounds").map_or(15, |text| text.parse().expect("--rounds N"));
    let directory = value("--csv").map(PathBuf::from);
    let only: Vec<_> = value("--only").map_or(PARTS.to_vec(), |text| text.split(',').collect());
    for part in &only {
        assert!(PARTS.contains(part), "{part:?} is none of {}", PARTS.join(", "));
    }
    let wanted = |part: &str| only.contains(&part);
    let short = rounds.div_ceil(2);
    if wanted("cold") {
        cold::measure().write(directory.as_ref());
    }
    // The aims are compared with the machine's peak in the same run.
    if wanted("machine") || wanted("aims") {
        let peak = Peak::measure();
        machine_table(&peak, rounds).write(directory.as_ref());
        if wanted("aims") {
            aims::measure(&peak, rounds).write(directory.as_ref());
        }
    }
    if wanted("cost") {
        cost::over_elements(short).write(directory.as_ref());
    }
    if wanted("options") {
        cost::by_options(short).write(directory.as_ref());
    }
    if wanted("scenes") {
        cost::by_scene(short).write(directory.as_ref());
    }
    if wanted("absent") {
        absent::measure(rounds).write(directory.as_ref());
        absent::parts().write(directory.as_ref());
    }
    if wanted("scaling") {
        cost::over_strands(short).write(directory.as_ref());
    }
    println!(
        "\n{:.0} s in all; the processor was ours for {:.0} s of them (one thread)",
        started.elapsed().as_secs_f64(),
        processor_seconds()
    );
}

fn machine_table(peak: &Peak, rounds: usize) -> Table {
    let mut table = Table::new("machine", "The machine", &["what", "value"]);
    let (processor, commit) = machine::description();
    let cores = std::thread::available_parallelism().map_or(0, usize::from);
    table.row(vec!["processor".into(), format!("{processor}, {cores} cores, {}", InstructionSet::detected().name())]);
    table.row(vec!["commit".into(), commit]);
    table.row(vec!["rounds".into(), rounds.to_string()]);
    table.row(vec!["multiplications and additions a second, f64, one core, 10^9".into(), digits(1e-9 * peak.f64_operations)]);
    table.row(vec!["multiplications and additions a second, f32, one core, 10^9".into(), digits(1e-9 * peak.f32_operations)]);
    table.row(vec!["copying, one core, 10^9 bytes read and written a second".into(), digits(1e-9 * peak.copy)]);
    table.row(vec!["copying, two cores, 10^9 bytes read and written a second".into(), digits(1e-9 * peak.copy_on_two)]);
    table.row(vec!["share of one core that was ours meanwhile".into(), format!("{:.2}", peak.ours)]);
    table
}

/// The setting given by words: elements, precision, instructions.
fn named(words: &[String]) -> Setting {
    let [count, precision, set, ..] = words else { panic!("expected: N, f64 or f32, a set of instructions, …") };
    let precision = if precision == "f32" { Precision::F32 } else { Precision::F64 };
    let sets = [InstructionSet::Scalar, InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512];
    let set = sets.into_iter().find(|known| known.name() == set).expect("a set of instructions");
    Setting::new(count.parse().expect("N")).precision(precision).instructions(set)
}

/// Steps for some seconds, and nothing else.
fn profile(words: &[String]) {
    let setting = match words[3].as_str() {
        "linearly_implicit" => named(words).hair(Hair::viscous(5)).integrator(Integrator::LinearlyImplicit).strands(50_000),
        "head" => named(words).hair(Hair::viscous(5)).strands(50_000),
        hessian => named(words).exact(hessian == "exact").iterations(9),
    };
    let seconds: f64 = words[4].parse().expect("seconds");
    let mut crowd = Crowd::warm(&setting, 3);
    let (mut iterations, mut steps) = (0.0, 0);
    let started = processor_seconds();
    while processor_seconds() - started < seconds {
        iterations += crowd.take(1).iterations;
        steps += 1;
    }
    let each = (processor_seconds() - started) / iterations / crowd.elements() as f64;
    println!("{steps} steps, {iterations} iterations, {} us an element-iteration", digits(1e6 * each));
}

/// Some steps of 16 strands, each with a fixed number of iterations; prints their sum, so that whoever counts instructions can
/// verify it.
fn steps(words: &[String]) {
    let (steps, iterations) = (words[0].parse().expect("steps"), words[4].parse().expect("iterations"));
    let mut crowd = Crowd::new(&named(&words[1..]).strands(16).iterations(iterations));
    println!("{}", crowd.take_untimed(steps).round());
}
