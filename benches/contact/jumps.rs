//! The worst steps: a head with hair jumps, turns and is thrown about at random, with every model, with and without a budget; and
//! the delay after a cancellation from another thread.

use std::fmt::Write as _;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{
    BodyDef, BodyId, ContactModel, ContactOptions, Frame, Shape, Solver, SolverOptions, StepLimits, StepReport, StrandContact,
    StrandDef, StrandId,
};

use crate::ball::root_on_ball;
use crate::{ELEMENTS, Outcome, STEP};

const GUIDES: usize = 228;
const RADIUS: f64 = 0.09;
/// Steps before the head moves, and after it did.
const CALM: usize = 40;
const AFTER: usize = 60;
/// The budget of a step, s.
const BUDGET: f64 = 0.02;
/// The models, and their largest numbers of iterations.
const MODELS: [(ContactModel, u32, &str); 4] = [
    (ContactModel::Penalty, 1, "penalty, 1 iteration"),
    (ContactModel::Penalty, 2, "penalty, 2 iterations"),
    (ContactModel::RegularisedPenalty, 50, "regularised penalty"),
    (ContactModel::Coulomb, 50, "coulomb"),
];

struct Head {
    solver: Solver,
    ids: Vec<StrandId>,
    roots: Vec<Frame>,
    ball: BodyId,
}

impl Head {
    fn new(model: ContactModel, max_iterations: u32) -> Outcome<Self> {
        let contact = ContactOptions { model, max_iterations, hair: true, ..ContactOptions::default() };
        let mut solver = Solver::new(SolverOptions { contact, ..SolverOptions::default() })?;
        let def = |k: usize| {
            let mut def = StrandDef::straight(0.2, ELEMENTS);
            (def.material.internal_friction, def.material.air_drag) = (1e-10, 1e-5);
            def.root = root_on_ball(k, GUIDES, 0.8, RADIUS);
            def.natural = vec![[3.0, 8.0, 0.0]; ELEMENTS];
            def
        };
        let defs: Vec<StrandDef> = (0..GUIDES).map(def).collect();
        let ids = solver.add_strands(&defs)?;
        let strand = StrandContact { exempt_length: 0.015, wisp_radius: 5e-4, ..StrandContact::default() };
        solver.set_contact(&ids, Some(&strand))?;
        let ball = solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_sphere(RADIUS - 0.002)?))])?[0];
        for _ in 0..CALM {
            solver.step(STEP, 1)?;
        }
        Ok(Self { solver, ids, roots: defs.iter().map(|def| def.root).collect(), ball })
    }

    fn send(&mut self, pose: &Frame) -> Outcome<()> {
        let go =
            |root: &Frame| Frame { origin: pose.origin + pose.rotation * root.origin, rotation: pose.rotation * root.rotation };
        let roots: Vec<Frame> = self.roots.iter().map(go).collect();
        self.solver.set_root_frames(&self.ids, &roots, STEP)?;
        Ok(self.solver.set_body_frames(&[self.ball], &[*pose], STEP)?)
    }

    /// A step and its time, ms, without the time in which the machine ran other threads.
    fn step(&mut self, limits: &StepLimits) -> Outcome<(f64, StepReport)> {
        let (from, waited) = (Instant::now(), seconds_waited());
        let report = self.solver.step_within(STEP, 1, limits)?;
        Ok((1e3 * (from.elapsed().as_secs_f64() - (seconds_waited() - waited)), report))
    }
}

/// The time for which this thread was ready without a processor, s, as counted by Linux. Elsewhere 0.
fn seconds_waited() -> f64 {
    let read = || std::fs::read_to_string("/proc/thread-self/schedstat").ok()?.split(' ').nth(1)?.parse::<f64>().ok();
    1e-9 * read().unwrap_or(0.0)
}

fn away(x: f64, degrees: f64) -> Frame {
    let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), degrees.to_radians());
    Frame { origin: Vector3::x() * x, rotation }
}

/// The table of jumps, as CSV: the worst step, and what has diverged or is deep a second later; without a budget and with one.
pub fn table(random: usize) -> Outcome<String> {
    let mut csv = String::from("model,what,budget_ms,calm_ms,dearest_ms,p999_ms,left,lost_after,deepest_after_m\n");
    for (model, iterations, name) in MODELS {
        for budget in [None, Some(BUDGET)] {
            let limits = StepLimits { seconds: budget, ..StepLimits::default() };
            for (x, degrees) in [(0.02, 0.0), (0.05, 0.0), (0.1, 0.0), (0.3, 0.0), (1.0, 0.0), (0.0, 30.0), (0.0, 90.0)] {
                let mut head = Head::new(model, iterations)?;
                let calm = head.step(&limits)?.0;
                head.send(&away(x, degrees))?;
                let (mut dearest, mut left, mut last) = (0.0_f64, 0, StepReport::default());
                for _ in 0..AFTER {
                    let (ms, report) = head.step(&limits)?;
                    (dearest, left, last) = (dearest.max(ms), left + report.left, report);
                }
                let budget = budget.map_or(0.0, |budget| 1e3 * budget);
                let row = format!(
                    "\"{name}\",\"{x} m {degrees} degrees\",{budget},{calm:.1},{dearest:.1},,{left},{},{:.1e}",
                    last.quarantined, last.contact.penetration
                );
                println!("{row}");
                writeln!(csv, "{row}")?;
            }
            let row = at_random(model, iterations, name, &limits, random)?;
            println!("{row}");
            writeln!(csv, "{row}")?;
        }
    }
    Ok(csv)
}

/// Random steps: the head goes anywhere within some centimetres, or metres, and turns by anything, or rests.
fn at_random(model: ContactModel, iterations: u32, name: &str, limits: &StepLimits, steps: usize) -> Outcome<String> {
    let mut head = Head::new(model, iterations)?;
    // CONTACT_SEED chooses other moves.
    let mut state: u64 = std::env::var("CONTACT_SEED").map_or(Ok(7), |seed| seed.parse())?;
    // Steele, Lea and Flood's splitmix64.
    let mut unit = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut milliseconds = Vec::new();
    let (mut pose, mut left) = (Frame::default(), 0_u64);
    for _ in 0..steps {
        // Most of the time it moves like a head, or a little faster; now and then it jumps.
        let size = [0.0, 0.0, 0.003, 0.01, 0.03, 0.06, 0.1, 1.0][(8.0 * unit()) as usize % 8];
        let turn = [0.0, 0.0, 0.03, 0.1, 0.3, 0.6, 1.0, 3.0][(8.0 * unit()) as usize % 8];
        let way = Vector3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5);
        pose.origin += way * (2.0 * size);
        pose.rotation =
            UnitQuaternion::from_scaled_axis(Vector3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5) * turn) * pose.rotation;
        head.send(&pose)?;
        let (ms, report) = head.step(limits)?;
        milliseconds.push(ms);
        left += u64::from(report.left);
    }
    for _ in 0..AFTER {
        head.step(limits)?;
    }
    let (_, last) = head.step(limits)?;
    milliseconds.sort_by(f64::total_cmp);
    let at = |share: f64| milliseconds[((milliseconds.len() - 1) as f64 * share) as usize];
    let budget = limits.seconds.map_or(0.0, |budget| 1e3 * budget);
    Ok(format!(
        "\"{name}\",\"{steps} at random\",{budget},{:.1},{:.1},{:.1},{left},{},{:.1e}",
        at(0.5),
        at(1.0),
        at(0.999),
        last.quarantined,
        last.contact.penetration
    ))
}

/// The duration of steps after another thread cancels them: median, 99th percentile and longest, ms.
pub fn cancelled(times: usize) -> Outcome<[f64; 3]> {
    let mut late = Vec::new();
    let start = Instant::now();
    let mut head = Head::new(ContactModel::Coulomb, 50)?;
    for k in 0..times {
        // A hard step, cancelled at a random moment.
        head.send(&away(0.04 * (k % 2) as f64, 0.0))?;
        let (flag, at) = (AtomicU32::new(0), AtomicU64::new(0));
        let limits = StepLimits { cancel: Some(&flag), ..StepLimits::default() };
        let ended = std::thread::scope(|scope| -> Outcome<Option<f64>> {
            scope.spawn(|| {
                std::thread::sleep(Duration::from_micros(500 + 700 * (k as u64 % 40)));
                at.store(start.elapsed().as_nanos() as u64, Ordering::SeqCst);
                flag.store(1, Ordering::SeqCst);
            });
            let waited = seconds_waited();
            let report = head.solver.step_within(STEP, 1, &limits)?;
            let (end, waited) = (start.elapsed().as_nanos() as u64, seconds_waited() - waited);
            let late = 1e-6 * end.saturating_sub(at.load(Ordering::SeqCst)) as f64;
            // (The waits of the whole step may have come before the cancellation: such steps are left out.)
            Ok((report.stopped as u8 == 3 && waited < 1e-4).then_some(late))
        })?;
        late.extend(ended);
        head.solver.step(STEP, 1)?;
    }
    late.sort_by(f64::total_cmp);
    let last = late.len().saturating_sub(1) as f64;
    Ok([0.5, 0.99, 1.0].map(|share| late.get((last * share) as usize).copied().unwrap_or(f64::NAN)))
}
