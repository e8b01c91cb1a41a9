//! The results of all cases, one row per integrator; and where the linearly implicit step fails.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use superhelix::Integrator;

use crate::draw::{Case, Stratum};
use crate::run::Outcome;

/// Lengths and frames are kept to this.
const WHOLE: f64 = 1e-9;
/// A step that says it converged is as near to the converged one as this, in L.
const HONEST: f64 = 1e-3;

#[derive(Default)]
struct Row {
    cases: u64,
    sum: Outcome,
    failed_cases: u64,
    wound: u64,
}

#[derive(Default)]
pub struct Table {
    rows: BTreeMap<(String, String), Row>,
    /// The papers' step: cases and failures by decade of h and by γ/(h EI0).
    papers: BTreeMap<(i32, &'static str), (u64, u64)>,
    pub faults: Vec<String>,
}

fn name(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::LinearlyImplicit => "linearly implicit",
        Integrator::ImplicitEuler => "implicit Euler",
        Integrator::SecondOrder => "second order",
        Integrator::Reference => "reference",
    }
}

impl Table {
    pub fn seen(&self, integrator: Integrator) -> bool {
        self.rows.keys().any(|(row, _)| row == name(integrator))
    }

    pub fn fault(&mut self, case: &Case, index: u64, what: &str) {
        let Case { stratum, integrator, h, def, tolerance, max_iterations, max_subdivisions, error_tolerance, .. } = case;
        let text = format!(
            "{stratum:?} {index}: {what}; {integrator:?} h {h:e} N {} L {:e} tolerance {tolerance:e} cap {max_iterations} halvings {max_subdivisions} allowed {error_tolerance:e} {:?} {:?}",
            def.element_lengths.len(),
            def.length(),
            def.freedoms,
            def.material,
        );
        println!("{text}");
        self.faults.push(text);
    }

    /// Counts a case and checks what must hold of it.
    pub fn add(&mut self, case: &Case, index: u64, outcome: &Outcome) {
        let papers = case.integrator == Integrator::LinearlyImplicit;
        // The papers' step has also failed when a strand left alone has ten times the energy that it had.
        let failed = outcome.quarantined > 0 || outcome.blown_up || outcome.growth > 10.0;
        if papers {
            let friction = case.def.material.internal_friction / (case.h * case.def.material.stiffness()[0]);
            let bin = match friction {
                0.0 => "0",
                f if f < 0.5 => "below 1/2",
                f if f < 50.0 => "1/2 to 50",
                _ => "above 50",
            };
            let cell = self.papers.entry((case.h.log10().floor() as i32, bin)).or_default();
            cell.0 += 1;
            cell.1 += u64::from(failed);
        } else if outcome.quarantined > 0 {
            self.fault(case, index, "a state turned non-finite");
        }
        if outcome.whole.stretch.is_nan() || outcome.whole.stretch > WHOLE {
            self.fault(case, index, &format!("stretched by {:e}", outcome.whole.stretch));
        }
        if outcome.whole.skew.is_nan() || outcome.whole.skew > WHOLE {
            self.fault(case, index, &format!("frames off by {:e}", outcome.whole.skew));
        }
        if outcome.dishonesty > HONEST {
            self.fault(case, index, &format!("said converged, {:e} L off", outcome.dishonesty));
        }
        // What theory bounds them by (`docs/theory/extremes.md`): one step of implicit Euler, and Dahlquist's G-norm of two states.
        let most = match case.integrator {
            Integrator::ImplicitEuler => 4.0,
            Integrator::SecondOrder => 10.0,
            Integrator::LinearlyImplicit | Integrator::Reference => f64::INFINITY,
        };
        if outcome.growth > most {
            self.fault(case, index, &format!("left alone, its energy grew to {:e} times what it was", outcome.growth));
        }
        let stratum = if case.stratum == Stratum::Wide { "wide" } else { "long" };
        let row = self.rows.entry((name(case.integrator).into(), stratum.into())).or_default();
        row.cases += 1;
        row.failed_cases += u64::from(failed);
        row.wound += u64::from(outcome.wound);
        let sum = &mut row.sum;
        sum.steps += outcome.steps;
        sum.seconds += outcome.seconds;
        sum.unconverged += outcome.unconverged;
        sum.subdivided += outcome.subdivided;
        sum.quarantined += outcome.quarantined;
        sum.iterations += outcome.iterations;
        sum.quiet += outcome.quiet;
        sum.grew += outcome.grew;
        sum.growth = sum.growth.max(outcome.growth);
        sum.grew_unconverged += outcome.grew_unconverged;
        sum.growth_unconverged = sum.growth_unconverged.max(outcome.growth_unconverged);
        sum.whole.worsen(&outcome.whole);
        sum.probes += outcome.probes;
        sum.dishonesty = sum.dishonesty.max(outcome.dishonesty);
        sum.slowest = sum.slowest.max(outcome.slowest);
        sum.time += outcome.time;
    }

    /// The table as comma-separated values.
    fn csv(&self) -> String {
        let mut text = String::from(
            "integrator,stratum,cases,failed_cases,wound,steps,strand_seconds,iterations_a_step,unconverged,subdivided,quarantined,quiet_stretches,\
             grew,worst_growth,grew_unconverged,worst_growth_unconverged,worst_stretch,worst_skew,probes,worst_probe,slowest_call_s,time_s\n",
        );
        for ((integrator, stratum), Row { cases, sum, failed_cases, wound }) in &self.rows {
            let Outcome { steps, seconds, unconverged, subdivided, quarantined, quiet, grew, growth, probes, .. } = sum;
            writeln!(
                text,
                "{integrator},{stratum},{cases},{failed_cases},{wound},{steps},{seconds:.1},{:.2},{unconverged},{subdivided},{quarantined},{quiet},{grew},\
                 {growth:.4e},{},{:.4e},{:.1e},{:.1e},{probes},{:.1e},{:.3},{:.1}",
                sum.iterations / *steps as f64,
                sum.grew_unconverged,
                sum.growth_unconverged,
                sum.whole.stretch,
                sum.whole.skew,
                sum.dishonesty,
                sum.slowest,
                sum.time
            )
            .unwrap();
        }
        text
    }

    fn papers_csv(&self) -> String {
        let mut text = String::from("h_decade,friction_number,cases,failed\n");
        for ((decade, friction), (cases, failed)) in &self.papers {
            writeln!(text, "{decade},{friction},{cases},{failed}").unwrap();
        }
        text
    }

    pub fn print(&self) {
        println!("{}\n{}", self.csv(), self.papers_csv());
    }

    pub fn write(&self, folder: &Path) {
        std::fs::write(folder.join("extremes.csv"), self.csv()).unwrap();
        std::fs::write(folder.join("extremes_papers.csv"), self.papers_csv()).unwrap();
    }
}
