//! Random strands from the whole space of parameters: nothing turns non-finite, nothing hangs, every strand keeps its length and its
//! frames, energy does not grow by itself, and a step that says it converged did. A short slice here; `make soak` makes the table of
//! `docs/extremes.md` from millions of strand-seconds. Environment:
//!
//!     EXTREMES_CASES, EXTREMES_LONG   cases of the strata wide and long (400, 6)
//!     EXTREMES_FIRST                  number of the first case (0); a case is the same wherever it is run
//!     EXTREMES_CSV                    a folder for extremes.csv and extremes_papers.csv

mod checks;
mod draw;
mod run;
mod table;

use std::panic::{AssertUnwindSafe, catch_unwind};

use draw::{Draw, Stratum, case};
use superhelix::step::options::Integrator;
use table::Table;

fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().unwrap_or_else(|_| panic!("{name}: {text}")))
}

/// Cases of either stratum have numbers of their own.
fn draws(stratum: Stratum, number: u64) -> Draw {
    Draw::of_case(2 * number + u64::from(stratum == Stratum::Long))
}

#[test]
fn random_strands_stay_finite_whole_and_honest() {
    let first = number("EXTREMES_FIRST", 0);
    let mut table = Table::default();
    for (stratum, count) in [(Stratum::Wide, number("EXTREMES_CASES", 400)), (Stratum::Long, number("EXTREMES_LONG", 6))] {
        if std::env::var("EXTREMES_ONLY").is_ok_and(|only| only != format!("{stratum:?}")) {
            continue;
        }
        for index in first..first + count {
            let started = std::time::Instant::now();
            if std::env::var("EXTREMES_DEBUG").is_ok() {
                println!("START {stratum:?} {index}");
                let made = case(&mut draws(stratum, index), stratum);
                println!(
                    "{:?} h {:e} N {} L {:e} tol {:e} {:?} {:?}",
                    made.integrator,
                    made.h,
                    made.def.element_lengths.len(),
                    made.def.length(),
                    made.tolerance,
                    made.def.material,
                    made.def.freedoms
                );
            }
            let made = case(&mut draws(stratum, index), stratum);
            let go = || {
                let mut draw = draws(stratum, index);
                case(&mut draw, stratum);
                run::run(&made, &mut draw)
            };
            let Ok(outcome) = catch_unwind(AssertUnwindSafe(go)) else {
                table.panicked(&made, index);
                continue;
            };
            // The same case takes the same steps: now and then it is run again.
            if index % 64 == 0 && outcome.hash != go().hash {
                table.fault(&made, index, "not the same twice");
            }
            table.add(&made, index, &outcome);
            if started.elapsed().as_secs_f64() > 3.0 {
                println!(
                    "SLOW {stratum:?} {index} {:?} {:.1} s of which {:.1} steps N {} h {:e}",
                    made.integrator,
                    started.elapsed().as_secs_f64(),
                    outcome.time,
                    made.def.element_lengths.len(),
                    made.h
                );
            }
        }
    }
    table.print();
    if let Ok(folder) = std::env::var("EXTREMES_CSV") {
        table.write(std::path::Path::new(&folder));
    }
    assert!(table.faults.is_empty(), "{} faults:\n{}", table.faults.len(), table.faults.join("\n"));
    assert!(table.seen(Integrator::SecondOrder) && table.seen(Integrator::ImplicitEuler));
}
