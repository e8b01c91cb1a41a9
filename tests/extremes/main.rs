//! Random strands from the whole space of parameters: nothing turns non-finite, nothing hangs, every strand keeps its length and its
//! frames, energy left alone stays within what the scheme allows, and a step that says it converged did. A short slice here; `make soak` makes the table of
//! `docs/theory/extremes.md`, a million strand-seconds and more. Environment:
//!
//!     EXTREMES_CASES, EXTREMES_LONG   cases of the strata wide and long (160, 4)
//!     EXTREMES_FIRST                  number of the first case (0); a case is the same on every machine
//!     EXTREMES_MINUTES                no further case is begun after that time
//!     EXTREMES_CSV                    a folder for extremes.csv and extremes_papers.csv

mod checks;
mod draw;
mod run;
mod table;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use draw::{Draw, Stratum, case};
use superhelix::Integrator;
use table::Table;

/// Cases beyond the slice that are always run: strands that Newton's iteration finds hard.
const KEPT: [(Stratum, u64); 3] = [(Stratum::Wide, 175), (Stratum::Wide, 523), (Stratum::Wide, 619)];
/// One in this many cases runs twice and is compared.
const REPEATED: u64 = 64;

fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().unwrap_or_else(|_| panic!("{name}: {text}")))
}

/// The draws of a case; the strata have numbers of their own.
fn draws(stratum: Stratum, number: u64) -> Draw {
    Draw::of_case(2 * number + u64::from(stratum == Stratum::Long))
}

fn run_case(table: &mut Table, stratum: Stratum, index: u64) {
    let go = || {
        let mut draw = draws(stratum, index);
        let made = case(&mut draw, stratum);
        run::run(&made, &mut draw)
    };
    let made = case(&mut draws(stratum, index), stratum);
    match catch_unwind(AssertUnwindSafe(go)) {
        Ok(outcome) => {
            if index.is_multiple_of(REPEATED) && outcome.hash != go().hash {
                table.fault(&made, index, "not the same twice");
            }
            table.add(&made, index, &outcome);
        }
        Err(_) => table.fault(&made, index, "panicked"),
    }
}

#[test]
fn random_strands_stay_finite_whole_and_honest() {
    let started = Instant::now();
    let first = number("EXTREMES_FIRST", 0);
    let (wide, long) = (number("EXTREMES_CASES", 160), number("EXTREMES_LONG", 4));
    let seconds = 60 * number("EXTREMES_MINUTES", u64::MAX / 60);
    let mut table = Table::default();
    let (mut wide_done, mut long_done) = (0, 0);
    // Side by side, so that an end by the clock leaves their shares as they are.
    while (wide_done < wide || long_done < long) && started.elapsed().as_secs() < seconds {
        if long_done >= long || wide_done * long < long_done * wide {
            run_case(&mut table, Stratum::Wide, first + wide_done);
            wide_done += 1;
        } else {
            run_case(&mut table, Stratum::Long, first + long_done);
            long_done += 1;
        }
    }
    for (stratum, index) in KEPT {
        if !(first..first + wide_done).contains(&index) {
            run_case(&mut table, stratum, index);
        }
    }
    table.print();
    if let Ok(folder) = std::env::var("EXTREMES_CSV") {
        table.write(std::path::Path::new(&folder));
    }
    assert!(table.faults.is_empty(), "{} faults:\n{}", table.faults.len(), table.faults.join("\n"));
    assert!(table.seen(Integrator::SecondOrder) && table.seen(Integrator::ImplicitEuler));
}
