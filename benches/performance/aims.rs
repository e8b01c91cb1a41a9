//! The required costs, each with its limit.

use superhelix::{Integrator, Precision};

use crate::counted;
use crate::crowd::{Crowd, Setting, Timed};
use crate::machine::Peak;
use crate::marginal::Marginal;
use crate::scene::{Hair, Scene};
use crate::statistics::Summary;
use crate::table::{Table, digits};

/// Elements of the strands of the rows on an iteration.
const COUNTS: [usize; 5] = [5, 10, 20, 50, 100];

/// The median of the processor time of all threads: twice the wall-clock time if both cores were free.
fn processor_time(timed: &[Timed]) -> f64 {
    Summary::of(&timed.iter().map(|timed| timed.processor).collect::<Vec<_>>()).median
}

struct Aims<'a> {
    table: Table,
    peak: &'a Peak,
    rounds: usize,
}

/// Measures all of them.
pub fn measure(peak: &Peak, rounds: usize) -> Table {
    let header = ["what", "unit", "limit", "measured", "spread", "least", "of_limit", "of_peak", "note"];
    let table = Table::new(
        "aims",
        "What was asked for (spread: quartiles' distance / median; of peak: see docs/notebook/performance.md)",
        &header,
    );
    let mut aims = Aims { table, peak, rounds };
    aims.iterations();
    aims.alone();
    aims.growth();
    aims.head();
    aims.guides();
    aims.table
}

impl Aims<'_> {
    fn row(&mut self, what: String, unit: &str, limit: Option<f64>, measured: Summary, of_peak: f64, note: String) {
        let share = limit.map_or(String::new(), |limit| format!("{:.2}", measured.median / limit));
        let limit = limit.map_or(String::new(), |limit| limit.to_string());
        let of_peak = if of_peak.is_finite() { format!("{:.2}", of_peak) } else { String::new() };
        let (median, spread, least) = (digits(measured.median), format!("{:.3}", measured.spread), digits(measured.least));
        self.table.row(vec![what, unit.into(), limit, median, spread, least, share, of_peak, note]);
    }

    /// One more iteration, and a whole step over its iterations.
    fn iterations(&mut self) {
        let kinds = [
            ("exact", Precision::F64, true, 0.20),
            ("Gauss-Newton", Precision::F64, false, 0.13),
            ("exact", Precision::F32, true, 0.12),
            ("Gauss-Newton", Precision::F32, false, 0.08),
        ];
        let mut contests = Vec::new();
        for (name, precision, exact, limit) in kinds {
            for count in COUNTS {
                let setting = Setting::new(count).precision(precision).exact(exact);
                let contest = (Marginal::new(&setting, 2), Crowd::warm(&setting, 12), Vec::new());
                contests.push((name, precision, count, limit, setting, contest));
            }
        }
        for _ in 0..self.rounds {
            for (.., (marginal, whole, steps)) in &mut contests {
                marginal.take();
                let timed = whole.take(2);
                steps.push((timed.seconds / timed.iterations / whole.elements() as f64, timed.iterations));
            }
        }
        for (name, precision, count, limit, setting, (marginal, _, steps)) in &contests {
            let operations = counted::iteration(setting);
            let peak = if *precision == Precision::F64 { self.peak.f64_operations } else { self.peak.f32_operations };
            let one_more = Summary::of(&marginal.samples);
            let called = format!("{name} {} N={count}", format!("{precision:?}").to_lowercase());
            let note = format!("{operations:.0} operations");
            self.row(
                format!("iteration {called}"),
                "us",
                Some(*limit),
                one_more.times(1e6),
                operations / one_more.median / peak,
                note,
            );
            let whole = Summary::of(&steps.iter().map(|(seconds, _)| *seconds).collect::<Vec<_>>());
            let iterations = steps.iter().map(|(_, iterations)| iterations).sum::<f64>() / steps.len() as f64;
            let note = format!("{iterations:.2} iterations a step");
            self.row(format!("step / iterations {called}"), "us", None, whole.times(1e6), f64::NAN, note);
        }
    }

    /// A single strand: no packs possible.
    fn alone(&mut self) {
        let setting = Setting::new(5).strands(1);
        let (mut marginal, mut whole) = (Marginal::new(&setting, 50), Crowd::warm(&setting, 12));
        let mut steps = Vec::new();
        for _ in 0..self.rounds {
            marginal.take();
            let timed = whole.take(50);
            steps.push(timed.seconds / timed.iterations);
        }
        self.row(
            "one strand alone, N=5, iteration".into(),
            "us",
            Some(5.0),
            Summary::of(&marginal.samples).times(5e6),
            f64::NAN,
            "f64".into(),
        );
        let note = "f64, second order".into();
        self.row("one strand alone, N=5, step / iterations".into(), "us", None, Summary::of(&steps).times(1e6), f64::NAN, note);
    }

    /// Whether the cost per element grows with N.
    fn growth(&mut self) {
        let mut contests = [10, 1000].map(|count| {
            let setting = Setting::new(count);
            (Crowd::warm(&setting, 30), Marginal::new(&setting, 2))
        });
        let (mut steps, mut iterations) = (Vec::new(), Vec::new());
        for _ in 0..self.rounds {
            let mut step = [0.0; 2];
            for (cost, (whole, marginal)) in step.iter_mut().zip(&mut contests) {
                let timed = whole.take(2);
                *cost = timed.seconds / whole.elements() as f64;
                marginal.take();
            }
            let last = |k: usize| contests[k].1.samples.last().copied().unwrap_or(f64::NAN);
            steps.push(step[1] / step[0]);
            iterations.push(last(1) / last(0));
        }
        let note = || "f64, second order".to_owned();
        self.row("element-step, N=1000 over N=10".into(), "times", Some(1.2), Summary::of(&steps), f64::NAN, note());
        self.row("element-iteration, N=1000 over N=10".into(), "times", Some(1.2), Summary::of(&iterations), f64::NAN, note());
    }

    /// Every hair of a head.
    fn head(&mut self) {
        let base = Setting::new(5).strands(150_000).precision(Precision::F32).hair(Hair::viscous(5));
        let kinds = [
            ("linearly implicit", base.clone().integrator(Integrator::LinearlyImplicit), 2, true),
            ("implicit Euler, one iteration", base.clone().integrator(Integrator::ImplicitEuler).iterations(1), 2, true),
            ("second order, one iteration", base.clone().iterations(1), 2, true),
            ("linearly implicit", base.clone().integrator(Integrator::LinearlyImplicit), 1, false),
        ];
        for (name, setting, threads, asked) in kinds {
            let mut crowd = Crowd::warm(&setting.threads(threads), 3);
            let timed: Vec<_> = (0..self.rounds).map(|_| crowd.take(1)).collect();
            let seconds = Summary::of(&timed.iter().map(|timed| timed.seconds).collect::<Vec<_>>());
            let roots = Summary::of(&timed.iter().map(|timed| timed.roots).collect::<Vec<_>>());
            // As if every byte of the state were read and written once.
            let copy = if threads == 2 { self.peak.copy_on_two } else { self.peak.copy };
            let bytes = crowd.solver.memory_usage() as f64;
            let of_peak = 2.0 * bytes / seconds.median / copy;
            let note = format!(
                "{} B a strand; processor time {} ms; roots in {} ms",
                digits(bytes / 150_000.0),
                digits(1e3 * processor_time(&timed)),
                digits(1e3 * roots.median)
            );
            let what = format!("150000 strands x 5, f32, {threads} {}, {name}", if threads == 1 { "core" } else { "cores" });
            self.row(what, "ms", asked.then_some(35.0), seconds.times(1e3), of_peak, note);
        }
    }

    /// Guides in the walking scene.
    fn guides(&mut self) {
        let base = Setting::new(10).strands(10_000).scene(Scene::Walk).threads(2);
        let mut loose = base.clone();
        loose.options.step.tolerance = 1e-4;
        let kinds = [
            ("f64, 2 cores, to 1e-6 rad", base.clone(), Some(60.0)),
            ("f64, 2 cores, to 1e-4 rad", loose.clone(), None),
            ("f32, 2 cores, to 1e-4 rad", loose.precision(Precision::F32), None),
        ];
        for (name, setting, limit) in kinds {
            let mut crowd = Crowd::warm(&setting, 60);
            let timed: Vec<_> = (0..self.rounds).map(|_| crowd.take(1)).collect();
            let seconds = Summary::of(&timed.iter().map(|timed| timed.seconds).collect::<Vec<_>>());
            let mean = |value: fn(&Timed) -> f64| timed.iter().map(value).sum::<f64>() / timed.len() as f64;
            let note = format!(
                "{:.2} iterations; not converged {}; processor time {} ms",
                mean(|t| t.iterations),
                digits(mean(|t| t.failed)),
                digits(1e3 * processor_time(&timed))
            );
            self.row(format!("10000 guides x 10, walk, {name}"), "ms", limit, seconds.times(1e3), f64::NAN, note);
        }
    }
}
