//! Cold start: empty caches, untouched memory, no earlier calls. Must run first.

use std::time::Instant;

use superhelix::Solver;

use crate::crowd::Setting;
use crate::scene::{STEP, Stage};
use crate::table::{Table, digits};

/// Measures, once.
pub fn measure() -> Table {
    let mut table = Table::new(
        "cold",
        "Cold start: 1000 strands of 10 elements, f64 (measured once, first thing in the process)",
        &["what", "unit", "value"],
    );
    for threads in [1, 2] {
        let setting = Setting::new(10).strands(1000).threads(threads);
        let stage = Stage::new(setting.scene, setting.strands);
        let strands = stage.strands(&setting.hair);
        let clock = Instant::now();
        let mut solver = Solver::new(setting.options).expect("a solver");
        let made = clock.elapsed().as_secs_f64();
        let clock = Instant::now();
        let ids = solver.add_strands(&strands).expect("strands");
        let added = clock.elapsed().as_secs_f64();
        let mut steps = Vec::new();
        for step in 1..=20 {
            solver.set_root_frames(&ids, &stage.roots(STEP * f64::from(step)), STEP).expect("roots");
            let clock = Instant::now();
            solver.step(STEP, 1).expect("a step");
            steps.push(clock.elapsed().as_secs_f64());
        }
        let clock = Instant::now();
        drop(solver);
        let dropped = clock.elapsed().as_secs_f64();
        let mut row = |what: &str, unit: &str, value: f64| {
            table.row(vec![format!("{what}, {threads} threads"), unit.to_owned(), digits(value)]);
        };
        row("a solver", "us", 1e6 * made);
        row("adding a strand", "us", 1e6 * added / 1000.0);
        // The first step has no history and takes two stages.
        row("first step", "ms", 1e3 * steps[0]);
        row("second step", "ms", 1e3 * steps[1]);
        row("20th step", "ms", 1e3 * steps[19]);
        row("dropping all", "us", 1e6 * dropped);
    }
    table
}
