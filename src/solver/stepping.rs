//! Steps all strands through time and reports the results.
//!
//! Files:
//!
//! - `at_points.rs`: Contact at points: strands that only bodies may touch step side by side with others, and their contacts are taken down.
//! - `constrained_substep.rs`: The substep of constrained strands.
//! - `divergence.rs`: Diverged strands: strands that a substep gave up before an iteration, carried over a jump of their root, or rolled back.
//! - `fast_bodies.rs`: Fast bodies: substeps in which a body moves far among strands, or a strand swings far past a thin body, are subdivided for the whole scene.
//! - `jumps.rs`: Root jumps: roots that move farther within a call of `Solver::step` than their strand can follow.
//! - `side_by_side.rs`: Steps the strands of one task: those with equal pack keys side by side in packs, the rest one by one.
//! - `trial_steps.rs`: Trial steps: a strand near a body first steps as a free strand, side by side with others.
//! - `wind.rs`: Wind as a field: a host's function of place and time, looked up once before every substep.
//! - `workers.rs`: The workers of a step and their scratch memory.

pub(super) mod at_points;
pub(super) mod constrained_substep;
pub(super) mod divergence;
pub(super) mod fast_bodies;
pub(super) mod jumps;
pub(super) mod side_by_side;
pub(super) mod trial_steps;
pub(super) mod wind;
pub(super) mod workers;

use std::sync::atomic::Ordering;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::Solver;
use super::constraints::ConstraintStatus;
use super::id::BodyId;
use super::report::{Phases, StepReport, Wrench};
use super::strands::strand::{Constrained, Tally, drawn_by};
use crate::contact::body::Body;
use crate::contact::body_at::BodyAt;
use crate::contact::options::StrandContact;
use crate::error::{Error, Result, check_positive};
use crate::memory::recycled;
use crate::meter::{Meter, StepLimits, Stopped, usual_work};
use crate::platform::{HAS_CLOCK, Instant};
use crate::step::options::Integrator;
use crate::step::pack::packs;
use crate::step::{Setting, Surroundings, subdivision};
use at_points::{AtPoints, Results};
use constrained_substep::{Account, ConstrainedSubstep, ContactTally, Overhead, Scene};
use side_by_side::Task;
use trial_steps::Trials;
use workers::WorkerScratch;

/// The shortest substep, s: below it the rounding of positions, divided by the square of the step, swamps every acceleration.
pub const SHORTEST_STEP: f64 = 1e-9;

/// The longest substep, s: a longer one is taken for another unit. [`Solver::settle`] finds static equilibria.
pub const LONGEST_STEP: f64 = 3600.0;

/// A part of a substep takes at least this many times the time of its overhead, and this much work per element of all strands.
const FRACTION_OF_OVERHEAD: f64 = 3.0;
const WORK_OF_A_PART: f64 = 8.0;

/// The budget of a call's substeps.
struct Clock<'a> {
    limits: &'a StepLimits<'a>,
    end: Option<Instant>,
    substeps: u32,
    /// Of all strands together.
    elements: usize,
}

impl<'a> Clock<'a> {
    fn new(limits: &'a StepLimits<'a>, started: Instant, substeps: u32, elements: usize) -> Self {
        let end = limits.seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        Self { limits, end: end.and_then(|seconds| started.checked_add(seconds)), substeps, elements }
    }

    /// Whether time is up, or the host has cancelled.
    fn is_over(&self) -> bool {
        self.limits.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed) != 0)
            || self.end.is_some_and(|end| Instant::now() >= end)
    }

    /// The largest number of parts of a substep within work and time, with this many substeps `left`, including this one.
    fn max_substeps(&self, left: f64, overhead: Overhead) -> u32 {
        let by_work = self.work() as f64 / (WORK_OF_A_PART * self.elements as f64);
        let seconds = |end: Instant| end.saturating_duration_since(Instant::now()).as_secs_f64() / left;
        let by_time = self.end.map(|end| seconds(end) / (FRACTION_OF_OVERHEAD * (overhead.begin + overhead.end)));
        by_time.map_or(by_work, |by_time| by_work.min(by_time)).clamp(1.0, f64::from(u32::MAX)) as u32
    }

    /// The meter of a part of a substep that starts now and shares the rest with later parts: time, and the substep's `work`.
    /// `end_seconds`: the time for finishing it.
    fn meter(&self, left: &Left, end_seconds: f64) -> Meter<'a> {
        let deadline = self.end.map(|end| {
            let now = Instant::now();
            let fraction = end.saturating_duration_since(now).as_secs_f64() / (left.parts + left.substeps * left.all_parts);
            now + Duration::from_secs_f64((fraction - end_seconds).max(0.0))
        });
        Meter::new((left.work as f64 / left.parts) as u64, deadline, self.limits.cancel)
    }

    /// The work of a substep.
    fn work(&self) -> u64 {
        self.limits.work.unwrap_or_else(|| usual_work(self.elements))
    }
}

/// What is left at the start of a part of a substep.
struct Left {
    /// The substep's work.
    work: u64,
    /// Its parts, including this one.
    parts: f64,
    /// All of its parts.
    all_parts: f64,
    /// Later substeps.
    substeps: f64,
}

/// A substep's lists with one item per body, kept for their memory.
#[derive(Default)]
pub(super) struct BodiesAtWork {
    at: Vec<BodyAt<'static>>,
    ids: Vec<BodyId>,
    wrenches: Vec<Wrench>,
}

/// The position of a substep in its call.
struct SubstepPosition {
    is_last: bool,
    /// Whether it is part of a substep in which a body moves far.
    is_fast: bool,
    /// Seconds from the call's start to its own.
    from: f64,
}

/// The cost of substeps, and why they ended before all strands converged.
#[derive(Debug, Clone, Copy, Default)]
struct Spent {
    work: u64,
    stopped: Stopped,
    /// The largest number of parts of a substep.
    parts: u32,
    phases: Phases,
}

impl Spent {
    /// Counts a substep; `left`: whether it left something undone.
    fn add(&mut self, meter: &Meter, left: bool) {
        self.work += meter.units();
        if left {
            self.stopped = self.stopped.max(meter.stopped());
        }
    }
}

impl Solver {
    /// Takes all strands through `dt` seconds in `substeps` equal substeps.
    ///
    /// A strand that does not converge keeps its best state and is counted. One whose numbers turn non-finite, or that diverges
    /// in contacts or constraints, is rolled back to the start of the substep and counted; the others continue.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a time that is not finite and above zero, no substeps, or substeps below [`SHORTEST_STEP`] or
    /// above [`LONGEST_STEP`];
    /// [`Error::Unsupported`] if strands may be in contact or have constraints and the integrator is [`Integrator::Reference`],
    /// which steps free strands only.
    pub fn step(&mut self, dt: f64, substeps: u32) -> Result<StepReport> {
        self.step_within(dt, substeps, &StepLimits::default())
    }

    /// The same within limits of work or time, or until the host cancels. What has not converged by then keeps the last iterate,
    /// whole and finite, or, without any iteration or after a cancellation, keeps its shape and moves with its root. It counts as
    /// unconverged, and the report says why. Roots and bodies reach their targets in any case.
    ///
    /// # Errors
    /// As [`Solver::step`]; [`Error::InvalidArgument`] for seconds that are not finite and above zero; [`Error::Unsupported`] for
    /// seconds without a clock (`wasm32-unknown-unknown`).
    pub fn step_within(&mut self, dt: f64, substeps: u32, limits: &StepLimits) -> Result<StepReport> {
        let started = Instant::now();
        let usual = self.options.limits;
        let limits =
            &StepLimits { work: limits.work.or(usual.work), seconds: limits.seconds.or(usual.seconds), cancel: limits.cancel };
        if let Some(seconds) = limits.seconds {
            check_positive(|| "limits.seconds".into(), seconds)?;
            if !HAS_CLOCK {
                let hint = "there is no clock on this platform; limit the work".into();
                return Err(Error::Unsupported { argument: "limits.seconds".into(), value: seconds.to_string(), hint });
            }
        }
        check_positive(|| "dt".into(), dt)?;
        if substeps == 0 {
            return Err(Error::invalid("substeps", substeps, "1 or more"));
        }
        let h = dt / f64::from(substeps);
        if !(SHORTEST_STEP..=LONGEST_STEP).contains(&h) {
            return Err(Error::invalid("dt / substeps", h, format!("{SHORTEST_STEP:e} to {LONGEST_STEP} s")));
        }
        self.check_integrator()?;
        let elements = self.strands.iter().map(|strand| strand.model.element_count()).sum();
        let clock = Clock::new(limits, started, substeps, elements);
        let jumped = self.carry_over_jumps(dt);
        let total = Mutex::new(Tally::default());
        let (contact, spent) = if self.holds_strands() {
            self.step_constrained(h, &clock, &total)
        } else {
            self.constrained_substep.forget_contacts();
            (ContactTally::default(), self.step_free(h, &clock, &total))
        };
        let total = total.into_inner().unwrap_or_else(PoisonError::into_inner);
        let Spent { work, stopped, parts, mut phases } = spent;
        phases.sampling = *self.sampling.get_mut() as f64 * 1e-9;
        *self.sampling.get_mut() = 0;
        self.note_contacts();
        let report = self.report(&total, substeps, started);
        Ok(StepReport { contact, work, stopped, carried: jumped, parts: parts.max(1), phases, ..report })
    }

    /// The substeps of a scene without contacts or constraints: each task takes its own strands through all of them.
    fn step_free(&mut self, h: f64, clock: &Clock, total: &Mutex<Tally>) -> Spent {
        let meter = clock.meter(&Left { work: clock.work(), parts: 1.0, all_parts: 1.0, substeps: 0.0 }, 0.0);
        let task_size = side_by_side::task_size(self.strands.len(), clock.elements);
        let begins = Instant::now();
        if self.wind_field.is_none() {
            self.take_free(h, clock.substeps, task_size, &meter, total);
        } else {
            // The field is looked up for all strands before any begins the next substep.
            for substep in 0..clock.substeps {
                let halted = meter.is_halted();
                let length = if halted { h * f64::from(clock.substeps - substep) } else { h };
                self.look_up_wind(h * f64::from(substep), length);
                self.take_free(length, 1, task_size, &meter, total);
                if halted {
                    break;
                }
            }
        }
        // Work that was done in time does not show that time ran out afterwards.
        let late = total.lock().unwrap_or_else(PoisonError::into_inner).left > 0;
        let phases = Phases { strands: begins.elapsed().as_secs_f64(), ..Phases::default() };
        Spent { stopped: if late { meter.stopped() } else { Stopped::No }, phases, ..Spent::default() }
    }

    /// Takes all strands through this many substeps of `h` seconds, each task its own.
    fn take_free(&mut self, h: f64, substeps: u32, task_size: usize, meter: &Meter, total: &Mutex<Tally>) {
        let surroundings = Surroundings { gravity: self.options.gravity.into(), wind: self.options.wind.into() };
        let setting = Setting { surroundings: &surroundings, options: &self.options.step, rules: &self.rules };
        let set = self.instruction_set();
        let width = packs::width(self.options.step.precision, set);
        self.workers.for_each_task(&mut self.strands, width, task_size, |strands, scratch| {
            let mut tally = Tally::default();
            for substep in 0..substeps {
                let halted = meter.is_halted();
                let h = if halted { h * f64::from(substeps - substep) } else { h };
                let mut task = Task { tally: &mut tally, trials: None, at_points: None };
                side_by_side::take(strands, &setting, h, set, &mut task, &mut scratch.step, meter);
                if halted {
                    break;
                }
            }
            total.lock().unwrap_or_else(PoisonError::into_inner).merge(&tally);
        });
    }

    /// Whether contacts or constraints may act on strands. Bodies and constraints move in either case.
    fn holds_strands(&self) -> bool {
        let hair = self.options.contact.hair && self.strands.iter().any(|strand| strand.contact.is_some());
        hair || !self.bodies.is_empty() || !self.constraints.is_empty()
    }

    /// Constrained strands step by implicit Euler, which would silently replace the reference integrator. The strands' contact
    /// parameters and the constraints decide, not positions: a scene does not run for a while before it is refused.
    fn check_integrator(&self) -> Result<()> {
        if self.options.step.integrator != Integrator::Reference {
            return Ok(());
        }
        if self.wind_field.is_some() && self.strands.iter().any(|strand| strand.model.material.air_drag > 0.0) {
            return Err(Error::Unsupported {
                argument: "the solver's integrator".into(),
                value: "reference".into(),
                hint: "its error control cannot see a field of wind; take second order or implicit Euler".into(),
            });
        }
        if self.strands.iter().any(|strand| drawn_by(&strand.target).is_some()) {
            return Err(Error::Unsupported {
                argument: "the solver's integrator".into(),
                value: "reference".into(),
                hint: "its equations of motion have no targets; take second order or implicit Euler".into(),
            });
        }
        let hair = self.options.contact.hair;
        let contacts = |contact: &StrandContact| {
            let body = self.bodies.iter().any(|body| body.body.meets(contact.groups, contact.mask));
            body || (hair && contact.wisp_radius > 0.0)
        };
        let by = if self.constraints.iter().any(|constraint| constraint.state.status != ConstraintStatus::Released) {
            "constraints"
        } else if self.strands.iter().filter_map(|strand| strand.contact.as_deref()).any(contacts) {
            "contact"
        } else {
            return Ok(());
        };
        Err(Error::Unsupported {
            argument: "the solver's integrator".into(),
            value: "reference".into(),
            hint: format!("it steps free strands only, and {by} may hold some here; take second order or implicit Euler"),
        })
    }

    /// The substeps of a scene with possible contacts or constraints: all strands finish each one before any starts the next. A
    /// substep in which a body moves far among strands is divided.
    fn step_constrained(&mut self, h: f64, clock: &Clock, total: &Mutex<Tally>) -> (ContactTally, Spent) {
        let (mut contact, mut spent) = (ContactTally::default(), Spent::default());
        let task_size = side_by_side::task_size(self.strands.len(), clock.elements);
        for body in &mut self.bodies {
            body.wrench = Wrench::default();
        }
        'substeps: for substep in 0..clock.substeps {
            let substeps = f64::from(clock.substeps - substep);
            self.prepare_motions(h);
            self.constrained_substep.begin_whole();
            let parts = self.parts_of_substep(h).min(clock.max_substeps(substeps, self.constrained_substep.overhead()));
            spent.parts = spent.parts.max(parts);
            let mut work = clock.work();
            for part in 0..parts {
                let (to_do, all_parts) = (f64::from(parts - part), f64::from(parts));
                let left = Left { work, parts: to_do, all_parts, substeps: substeps - 1.0 };
                let meter = clock.meter(&left, self.constrained_substep.overhead().end);
                let from = h * (f64::from(substep) + f64::from(part) / all_parts);
                if clock.is_over() {
                    // Nothing more can be done in any of them: all strands move with their roots, at once.
                    let rest = h * (substeps - 1.0 + to_do / all_parts);
                    self.prepare_motions(rest);
                    let phases = self.take_substep(
                        rest,
                        task_size,
                        &meter,
                        &mut contact,
                        total,
                        SubstepPosition { is_last: true, is_fast: false, from },
                    );
                    spent.phases.add(&phases);
                    spent.add(&meter, true);
                    break 'substeps;
                }
                let is_last = substep + 1 == clock.substeps && part + 1 == parts;
                let place = SubstepPosition { is_last, is_fast: parts > 1, from };
                let phases = self.take_substep(h / all_parts, task_size, &meter, &mut contact, total, place);
                spent.phases.add(&phases);
                let left = total.lock().unwrap_or_else(PoisonError::into_inner).left > 0;
                spent.add(&meter, left);
                work = work.saturating_sub(meter.units());
            }
        }
        // If contacts and constraints are gone, the next step does not look for any.
        for strand in &mut self.strands {
            strand.constrained = Constrained::No;
        }
        (contact, spent)
    }

    /// A substep of `h` seconds, or a part of one. Returns the time of its phases.
    fn take_substep(
        &mut self,
        h: f64,
        task_size: usize,
        meter: &Meter,
        contact: &mut ContactTally,
        total: &Mutex<Tally>,
        place: SubstepPosition,
    ) -> Phases {
        let SubstepPosition { is_last, is_fast, from } = place;
        for scene_body in &mut self.bodies {
            scene_body.body.begin(h);
        }
        self.wake_near_bodies(h);
        let begins = Instant::now();
        self.look_up_wind(from, h);
        let set = self.instruction_set();
        let surroundings = Surroundings { gravity: self.options.gravity.into(), wind: self.options.wind.into() };
        let setting = Setting { surroundings: &surroundings, options: &self.options.step, rules: &self.rules };
        let width = packs::width(self.options.step.precision, set);
        let BodiesAtWork { at, mut ids, mut wrenches } = std::mem::take(&mut self.bodies_at_work);
        let mut bodies: Vec<BodyAt> = recycled(at);
        bodies.extend(self.bodies.iter().enumerate().map(|(k, body)| body.body.at(k as u32, h)));
        ids.clear();
        ids.extend(self.bodies.iter().map(|body| body.id));
        wrenches.clear();
        wrenches.resize(bodies.len(), Wrench::default());
        let copies = || -> Vec<Body> { self.bodies.iter().map(|body| body.body.clone()).collect() };
        let mut scene = Scene {
            strands: &mut self.strands,
            slots: &self.slots,
            constraints: &mut self.constraints,
            bodies: &bodies,
            copies: &copies,
            body_ids: &ids,
            options: &self.options.contact,
            setting: &setting,
            set,
            workers: &self.workers,
            meter,
            is_last,
            is_fast,
            is_nested: false,
            halving_ends: u64::MAX,
        };
        let are_near = ConstrainedSubstep::mark(&mut scene, h);
        let (tolerance, deepest_root) = (scene.options.tolerance, scene.options.deepest_root());
        let at_points = at_points::options(scene.options, h);
        if at_points.is_some() {
            at_points::begin(scene.strands);
        }
        let found = Mutex::new(std::mem::take(&mut self.touched));
        self.workers.for_each_task(scene.strands, width, task_size, |strands, scratch| {
            let mut tally = Tally::default();
            let WorkerScratch { step, trial, touched, .. } = scratch;
            let trials = are_near.then(|| Trials { bodies: &bodies, tolerance, scratch: trial });
            if let Some(trials) = &trials {
                trials.begin(strands, h, meter);
            }
            let at_points = at_points.map(|options| AtPoints { bodies: &bodies, options, deepest_root, found: &mut *touched });
            let mut task = Task { tally: &mut tally, trials, at_points };
            side_by_side::take(strands, &setting, h, set, &mut task, step, meter);
            if !touched.is_empty() {
                touched.end_task();
                found.lock().unwrap_or_else(PoisonError::into_inner).take(touched);
            }
            total.lock().unwrap_or_else(PoisonError::into_inner).merge(&tally);
        });
        let mut tally = Tally::default();
        let account = Account { tally: &mut tally, contact, wrenches: &mut wrenches };
        self.constrained_substep.take(&mut scene, h, subdivision::levels(&self.options.step, false), account);
        let mut touched = found.into_inner().unwrap_or_else(PoisonError::into_inner);
        let contacts = &mut *self.constrained_substep;
        touched.report(&self.slots, &bodies, &ids, Results { contacts, wrenches: &mut wrenches, tally: contact });
        self.touched = touched;
        let taken = begins.elapsed().as_secs_f64();
        total.lock().unwrap_or_else(PoisonError::into_inner).merge(&tally);
        let at = recycled(bodies);
        for (body, wrench) in self.bodies.iter_mut().zip(&wrenches) {
            body.wrench = *wrench;
            body.body.finish(h);
        }
        self.bodies_at_work = BodiesAtWork { at, ids, wrenches };
        // Strands are whatever is neither search nor contact: they step between the two.
        let Phases { search, contact, .. } = self.constrained_substep.take_phases();
        Phases { search, contact, sampling: 0.0, strands: (taken - search - contact).max(0.0) }
    }

    fn report(&self, tally: &Tally, substeps: u32, started: Instant) -> StepReport {
        let mut report = StepReport {
            substeps,
            quarantined: tally.quarantined,
            unconverged: tally.unconverged,
            max_iterations: tally.max_iterations,
            max_residual: tally.residual,
            max_condition: tally.condition,
            subdivided: tally.subdivided,
            max_error: tally.error,
            left: tally.left,
            ..StepReport::default()
        };
        // In the strands' order, so that the sums are the same to the bit for any number of threads.
        for strand in &self.strands {
            report.energies.kinetic += strand.energies.kinetic;
            report.energies.elastic += strand.energies.elastic;
            report.energies.gravity += strand.energies.gravity;
        }
        if !self.strands.is_empty() {
            report.mean_iterations = tally.iterations as f64 / (self.strands.len() as f64 * f64::from(substeps));
        }
        report.seconds = started.elapsed().as_secs_f64();
        report
    }
}
