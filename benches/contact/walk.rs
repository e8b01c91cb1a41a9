//! The first scene that everybody makes: guides all over the scalp of a bust that walks, the bust as a grid, no hair against hair. What contact
//! costs over the same strands without a bust: wall clock of the threads asked for.

use std::fmt::Write as _;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::{Amount, Density, Scalp, ScatterOptions};
use superhelix::io::Motion;
use superhelix::{
    BodyDef, ContactModel, ContactOptions, Frame, Phases, Precision, Shape, Solver, SolverOptions, StepOptions, StrandContact,
    StrandDef, Workers,
};

use crate::{EXEMPT, GRAVITY, Outcome, STEP, aims, quantile};

/// Hair grows this far down from the top of the head, m.
const SCALP: f64 = 0.1;
/// Steps before the head walks off: hair comes down to the head.
const CALM: usize = 60;
/// How often strands are searched for overlaps with the bust, steps, and the depths beyond which they are counted, m.
const LOOK: usize = 6;
const DEEP: [f64; 2] = [5e-4, 2e-3];

/// Numbers of guides, and the cases, of the table of strands and threads.
const GROWING: [usize; 4] = [300, 1000, 3000, 10_000];
const GROWN: [&str; 4] = ["free", "at points, 4 iterations", "penalty, 1 iteration", "hard"];

/// A crowd of guides, and how it is stepped.
pub struct Case {
    pub name: &'static str,
    pub guides: usize,
    pub elements: usize,
    pub precision: Precision,
    /// None: without the bust.
    pub contact: Option<(ContactModel, u32)>,
}

const CASES: [Case; 9] = [
    Case { name: "free", guides: 10_000, elements: 10, precision: Precision::F64, contact: None },
    Case { name: "hard", guides: 10_000, elements: 10, precision: Precision::F64, contact: Some((ContactModel::Coulomb, 50)) },
    Case {
        name: "penalty, 1 iteration",
        guides: 10_000,
        elements: 10,
        precision: Precision::F64,
        contact: Some((ContactModel::Penalty, 1)),
    },
    Case { name: "free, 1 iteration", guides: 150_000, elements: 5, precision: Precision::F32, contact: None },
    Case {
        name: "penalty, 1 iteration",
        guides: 150_000,
        elements: 5,
        precision: Precision::F32,
        contact: Some((ContactModel::Penalty, 1)),
    },
    Case {
        name: "at points, 4 iterations",
        guides: 10_000,
        elements: 10,
        precision: Precision::F64,
        contact: Some((ContactModel::AtPoints, 4)),
    },
    Case {
        name: "at points, 2 iterations",
        guides: 10_000,
        elements: 10,
        precision: Precision::F64,
        contact: Some((ContactModel::AtPoints, 2)),
    },
    Case {
        name: "at points, 1 iteration",
        guides: 10_000,
        elements: 10,
        precision: Precision::F64,
        contact: Some((ContactModel::AtPoints, 1)),
    },
    Case {
        name: "at points, 1 iteration",
        guides: 150_000,
        elements: 5,
        precision: Precision::F32,
        contact: Some((ContactModel::AtPoints, 1)),
    },
];

/// The guides of a case, at the head's pose at the start.
fn guides(case: &Case, bust: (&[Vector3<f64>], &[[u32; 3]])) -> Outcome<Vec<StrandDef>> {
    let top = bust.0.iter().map(|vertex| vertex.y).fold(f64::NEG_INFINITY, f64::max);
    let scalp = Scalp::new(bust.0.to_vec(), bust.1.to_vec(), None, Vector3::x())?;
    let density = Density::Vertices(bust.0.iter().map(|vertex| if vertex.y > top - SCALP { 1.0 } else { 0.0 }).collect());
    let scattered = scalp.scatter(&ScatterOptions { amount: Amount::Count(case.guides), density, seed: 1 })?;
    let roots = scalp.frames(bust.0, &scattered.follicles)?;
    let part = |k: usize, by: f64| ((k + 1) as f64 * by).fract();
    let def = |(k, root): (usize, Frame)| {
        let mut def = StrandDef::straight(0.25, case.elements);
        def.material.internal_friction = 1e-10;
        def.material.air_drag = 5e-6;
        let (one, two) = (part(k, 0.618_034), part(k, 0.754_878));
        def.natural = vec![[6.0 * one, 5.0 + 20.0 * two, 3.0 * one]; case.elements];
        def.root = root;
        def
    };
    Ok(roots.into_iter().enumerate().map(def).collect())
}

/// Where the walk takes the head from its pose at the start.
fn carried(motion: &Motion, seconds: f64, middle: &Vector3<f64>) -> Frame {
    let (first, now) = (motion.at(motion.times()[0]), motion.at(motion.times()[0] + seconds));
    let rotation: UnitQuaternion<f64> = now.rotation * first.rotation.inverse();
    Frame { origin: middle + (now.origin - first.origin) - rotation * middle, rotation }
}

/// What is run.
pub struct Run {
    pub steps: usize,
    pub threads: usize,
    /// The number of guides as a fraction of the table's.
    pub scale: f64,
    /// One case alone, by its place in the table.
    pub only: Option<usize>,
    /// Only the cases for which something was asked.
    pub aims_only: bool,
}

impl Run {
    fn has(&self, place: usize, case: &Case) -> bool {
        self.only.is_none_or(|only| only == place) && (!self.aims_only || aims::has_walk(case.name, case.precision))
    }
}

/// A case that was run.
pub struct Walked {
    pub case: Case,
    /// Of all steps of the walk, ascending.
    milliseconds: Vec<f64>,
    /// For a mean step: search, steps of strands, contact problems.
    phases: [f64; 3],
    contacts: f64,
    pub iterations: f64,
    penetration: f64,
    pub unconverged: u32,
    rolled_back: u32,
    /// The fractions of strands that are somewhere deeper than [`DEEP`], by an exact search that no model of contact takes part in.
    pub deep: [f64; 2],
}

impl Walked {
    pub fn at(&self, share: f64) -> f64 {
        quantile(&self.milliseconds, share)
    }
}

fn walk(head: &Arc<Shape>, bust: (&[Vector3<f64>], &[[u32; 3]]), case: Case, steps: usize, threads: usize) -> Outcome<Walked> {
    let motion = Motion::read("tests/data/grooms/walk_figure8_head.csv", None)?;
    let middle = bust.0.iter().sum::<Vector3<f64>>() / bust.0.len() as f64;
    let defs = guides(&case, bust)?;
    let contact = case.contact.map_or(ContactOptions::default(), |(model, max_iterations)| ContactOptions {
        model,
        max_iterations,
        ..ContactOptions::default()
    });
    let mut step = StepOptions { precision: case.precision, ..StepOptions::default() };
    if case.contact.is_some_and(|(_, most)| most == 1) || case.precision == Precision::F32 {
        (step.max_iterations, step.max_subdivisions) = (1, 0);
    }
    let workers = if threads > 1 { Workers::Pool(threads) } else { Workers::Serial };
    let mut solver = Solver::new(SolverOptions { gravity: GRAVITY, contact, step, workers, ..SolverOptions::default() })?;
    let ids = solver.add_strands(&defs)?;
    let mut bodies = Vec::new();
    if case.contact.is_some() {
        bodies = solver.add_bodies(vec![BodyDef::new(head.clone())])?;
        let strand = StrandContact { exempt_length: EXEMPT, ..StrandContact::default() };
        solver.set_contact(&ids, Some(&strand))?;
    }
    let mut walked = Walked {
        case,
        milliseconds: Vec::new(),
        phases: [0.0; 3],
        contacts: 0.0,
        iterations: 0.0,
        penetration: 0.0,
        unconverged: 0,
        rolled_back: 0,
        deep: [0.0; 2],
    };
    let mut looks = 0.0;
    for k in 0..CALM + steps {
        let pose = carried(&motion, (k + 1).saturating_sub(CALM) as f64 * STEP, &middle);
        let frames: Vec<Frame> = defs.iter().map(|def| pose.compose(&def.root)).collect();
        solver.set_root_frames(&ids, &frames, STEP)?;
        if !bodies.is_empty() {
            solver.set_body_frames(&bodies, &[pose], STEP)?;
        }
        let report = solver.step(STEP, 1)?;
        if k < CALM {
            continue;
        }
        walked.milliseconds.push(1e3 * report.seconds);
        let Phases { search, strands, contact, .. } = report.phases;
        for (sum, seconds) in walked.phases.iter_mut().zip([search, strands, contact]) {
            *sum += 1e3 * seconds / steps as f64;
        }
        walked.contacts += f64::from(report.contact.contacts) / steps as f64;
        walked.iterations += report.mean_iterations / steps as f64;
        walked.penetration = walked.penetration.max(report.contact.penetration);
        walked.unconverged += report.unconverged;
        walked.rolled_back += report.quarantined;
        if !bodies.is_empty() && (k - CALM) % LOOK == LOOK - 1 {
            looks += ids.len() as f64;
            let overlaps = solver.overlaps(&ids)?;
            for (count, limit) in walked.deep.iter_mut().zip(DEEP) {
                *count += overlaps.iter().filter(|overlap| overlap.bodies > limit).count() as f64;
            }
        }
    }
    walked.deep = walked.deep.map(|count| count / f64::max(looks, 1.0));
    walked.milliseconds.sort_by(f64::total_cmp);
    Ok(walked)
}

/// The rows of `contact_walk.csv`, which are also printed; and what they are made of.
pub fn table(head: &Arc<Shape>, bust: (&[Vector3<f64>], &[[u32; 3]]), run: &Run) -> Outcome<(String, Vec<Walked>)> {
    let mut csv = String::from(
        "case,guides,elements,precision,median_ms,ninth_decile_ms,worst_ms,search_ms,strands_ms,contact_ms,contacts,iterations,penetration_m,unconverged,rolled_back,deeper_than_half_mm,deeper_than_2_mm\n",
    );
    let mut all = Vec::new();
    print!("{csv}");
    for (_, mut case) in CASES.into_iter().enumerate().filter(|(k, case)| run.has(*k, case)) {
        case.guides = (case.guides as f64 * run.scale) as usize;
        let walked = walk(head, bust, case, run.steps, run.threads)?;
        let Case { name, guides, elements, precision, .. } = walked.case;
        let ([search, strands, contact], [half, two]) = (walked.phases, walked.deep);
        let Walked { contacts, iterations, penetration, unconverged, rolled_back, .. } = walked;
        let row = format!(
            "\"{name}\",{guides},{elements},{precision:?},{:.1},{:.1},{:.1},{search:.1},{strands:.1},{contact:.1},{contacts:.0},{iterations:.2},{penetration:.1e},{unconverged},{rolled_back},{half:.4},{two:.4}",
            walked.at(0.5),
            walked.at(0.9),
            walked.at(1.0),
        );
        println!("{row}");
        writeln!(csv, "{row}")?;
        all.push(walked);
    }
    Ok((csv, all))
}

/// The cost of the walk as strands grow in number, with one thread and with two: `contact_strands.csv`, which is also printed.
pub fn strands_and_threads(
    head: &Arc<Shape>,
    bust: (&[Vector3<f64>], &[[u32; 3]]),
    steps: usize,
    quick: bool,
) -> Outcome<String> {
    let mut csv = String::from("case,guides,one_thread_ms,two_threads_ms\n");
    print!("{csv}");
    for guides in if quick { &GROWING[..1] } else { &GROWING[..] } {
        for case in CASES.into_iter().filter(|case| GROWN.contains(&case.name) && case.precision == Precision::F64) {
            let name = case.name;
            let median = |threads| -> Outcome<f64> {
                let case = Case { guides: *guides, ..case };
                Ok(walk(head, bust, case, steps, threads)?.at(0.5))
            };
            let row = format!("\"{name}\",{guides},{:.2},{:.2}", median(1)?, median(2)?);
            println!("{row}");
            writeln!(csv, "{row}")?;
        }
    }
    Ok(csv)
}
