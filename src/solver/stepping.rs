//! Time: all strands through a step, and what came of it.

use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use super::Solver;
use super::constraints::ConstraintStatus;
use super::holding::{Account, ContactTally, Holding, Scene};
use super::id::BodyId;
use super::report::{StepReport, Wrench};
use super::side_by_side;
use super::strand::Tally;
use crate::contact::body::{Body, BodyAt};
use crate::contact::options::StrandContact;
use crate::error::{Error, Result, check_positive};
use crate::step::options::Integrator;
use crate::step::{Setting, Surroundings, packs, subdivision};

/// The shortest substep, s: below it rounding of the positions, divided by the step's square, drowns every acceleration.
pub const SHORTEST_STEP: f64 = 1e-9;

impl Solver {
    /// Takes all strands through `dt` seconds in `substeps` equal parts.
    ///
    /// A strand that does not converge keeps its best state and is counted; one whose numbers turn non-finite, or that goes astray in
    /// touches or constraints without end, is rolled back to the substep's start and counted; the others go on.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a time that is not finite and above zero, no substeps, or substeps below [`SHORTEST_STEP`];
    /// [`Error::Unsupported`] where strands may touch something or constraints hold them and the integrator is
    /// [`Integrator::Reference`], which steps free strands only.
    pub fn step(&mut self, dt: f64, substeps: u32) -> Result<StepReport> {
        let started = Instant::now();
        check_positive(|| "dt".into(), dt)?;
        if substeps == 0 {
            return Err(Error::invalid("substeps", substeps, "1 or more"));
        }
        let h = dt / f64::from(substeps);
        if h < SHORTEST_STEP {
            return Err(Error::invalid("dt / substeps", h, format!("{SHORTEST_STEP} s or more")));
        }
        self.check_integrator()?;
        let total = Mutex::new(Tally::default());
        if self.holds_strands() {
            let contact = self.step_holding(h, substeps, &total);
            let total = total.into_inner().unwrap_or_else(PoisonError::into_inner);
            return Ok(StepReport { contact, ..self.report(&total, substeps, started) });
        }
        self.holding.forget_contacts();
        let surroundings = Surroundings { gravity: self.options.gravity.into(), wind: self.options.wind.into() };
        let setting = Setting { surroundings: &surroundings, options: &self.options.step, rules: &self.rules };
        let set = self.instruction_set();
        let width = packs::width(self.options.step.precision, set);
        self.crew.for_each_task(&mut self.strands, width, side_by_side::MAX_TASK, |strands, scratch| {
            let mut tally = Tally::default();
            for _ in 0..substeps {
                side_by_side::take(strands, &setting, h, set, &mut tally, &mut scratch.step);
            }
            total.lock().unwrap_or_else(PoisonError::into_inner).merge(&tally);
        });
        let total = total.into_inner().unwrap_or_else(PoisonError::into_inner);
        Ok(self.report(&total, substeps, started))
    }

    /// Whether something may hold strands. Bodies and constraints are on their ways whether they do or not.
    fn holds_strands(&self) -> bool {
        let hair = self.options.contact.hair && self.strands.iter().any(|strand| strand.contact.is_some());
        hair || !self.bodies.is_empty() || !self.constraints.is_empty()
    }

    /// Held strands take their steps by implicit Euler, which would be silent where the reference was asked for. What decides are what strands
    /// are to contact and the constraints, not where things are: a scene does not run for a while and is refused then.
    fn check_integrator(&self) -> Result<()> {
        if self.options.step.integrator != Integrator::Reference {
            return Ok(());
        }
        let hair = self.options.contact.hair;
        let touches = |contact: &StrandContact| {
            let body = self.bodies.iter().any(|body| body.body.meets(contact.groups, contact.mask));
            body || (hair && contact.wisp_radius > 0.0)
        };
        let by = if self.constraints.iter().any(|constraint| constraint.state.status != ConstraintStatus::Released) {
            "constraints"
        } else if self.strands.iter().filter_map(|strand| strand.contact.as_deref()).any(touches) {
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

    /// The substeps of a scene in which something may hold strands: all strands go through each before any begins the next.
    fn step_holding(&mut self, h: f64, substeps: u32, total: &Mutex<Tally>) -> ContactTally {
        let set = self.instruction_set();
        let surroundings = Surroundings { gravity: self.options.gravity.into(), wind: self.options.wind.into() };
        let setting = Setting { surroundings: &surroundings, options: &self.options.step, rules: &self.rules };
        let width = packs::width(self.options.step.precision, set);
        let mut contact = ContactTally::default();
        for body in &mut self.bodies {
            body.wrench = Wrench::default();
        }
        for _ in 0..substeps {
            for scene_body in &mut self.bodies {
                scene_body.body.begin(h);
            }
            let bodies: Vec<BodyAt> = self.bodies.iter().enumerate().map(|(k, body)| body.body.at(k as u32, h)).collect();
            let body_ids: Vec<BodyId> = self.bodies.iter().map(|body| body.id).collect();
            let copies = || -> Vec<Body> { self.bodies.iter().map(|body| body.body.clone()).collect() };
            let mut wrenches = vec![Wrench::default(); bodies.len()];
            let mut scene = Scene {
                strands: &mut self.strands,
                slots: &self.slots,
                constraints: &mut self.constraints,
                bodies: &bodies,
                copies: &copies,
                body_ids: &body_ids,
                options: &self.options.contact,
                setting: &setting,
                crew: &self.crew,
                is_part: false,
            };
            Holding::mark(&mut scene, h);
            self.crew.for_each_task(scene.strands, width, side_by_side::MAX_TASK, |strands, scratch| {
                let mut tally = Tally::default();
                side_by_side::take(strands, &setting, h, set, &mut tally, &mut scratch.step);
                total.lock().unwrap_or_else(PoisonError::into_inner).merge(&tally);
            });
            let mut tally = Tally::default();
            let account = Account { tally: &mut tally, contact: &mut contact, wrenches: &mut wrenches };
            self.holding.take(&mut scene, h, subdivision::levels(&self.options.step), account);
            total.lock().unwrap_or_else(PoisonError::into_inner).merge(&tally);
            for (body, wrench) in self.bodies.iter_mut().zip(wrenches) {
                body.wrench = wrench;
                body.body.finish(h);
            }
        }
        // Where nothing holds strands any more the next step looks for none.
        for strand in &mut self.strands {
            strand.held = false;
        }
        contact
    }

    fn report(&self, tally: &Tally, substeps: u32, started: Instant) -> StepReport {
        let mut report = StepReport {
            substeps,
            quarantined: tally.quarantined,
            unconverged: tally.unconverged,
            max_iterations: tally.most_iterations,
            max_residual: tally.residual,
            max_condition: tally.condition,
            subdivided: tally.subdivided,
            max_error: tally.error,
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
