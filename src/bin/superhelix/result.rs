//! What a run of a scene gives: the document of docs/scene_format.md, section "Result".

use serde::Serialize;
use superhelix::error::Result;
use superhelix::solver::Solver;
use superhelix::solver::id::StrandId;
use superhelix::solver::report::StepReport;

use crate::scene::{Output, Request};

/// One list entry an output time.
type Series<T> = Option<Vec<T>>;

/// A whole result. Every list beside `strands` has one entry an output time.
#[derive(Debug, Serialize)]
pub struct RunResult {
    version: u32,
    times: Vec<f64>,
    strands: Vec<StrandResult>,
    #[serde(skip_serializing_if = "Option::is_none")]
    energies: Series<EnergiesEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contacts: Series<[(); 0]>,
    report: Report,
    #[serde(skip)]
    requests: Vec<Request>,
}

/// What was asked for of one strand; one entry an output time in every list.
#[derive(Debug, Serialize)]
struct StrandResult {
    #[serde(skip_serializing_if = "Option::is_none")]
    tips: Series<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Series<Vec<[f64; 3]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    frames: Series<Vec<[f64; 7]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    velocities: Series<Vec<[f64; 3]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    curvatures: Series<Vec<[f64; 3]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rates: Series<Vec<[f64; 3]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wrenches: Series<WrenchEntry>,
}

#[derive(Debug, Serialize)]
struct EnergiesEntry {
    kinetic: f64,
    elastic: f64,
    gravity: f64,
}

#[derive(Debug, Serialize)]
struct WrenchEntry {
    force: [f64; 3],
    torque: [f64; 3],
}

/// How the steps went, all together.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Report {
    /// Time steps taken.
    pub steps: u64,
    /// Mean Newton iterations a strand and step.
    pub iterations_mean: f64,
    /// Most Newton iterations of a strand in a step.
    pub iterations_max: u32,
    /// Strand-steps that stopped before reaching the tolerance.
    pub unconverged: u64,
    /// Strand-steps rolled back because the state turned non-finite.
    pub quarantined: u64,
    /// Strand-steps that were taken in parts.
    pub subdivided: u64,
    /// The most that a strand's step added to the error of a position, in its lengths; 0 where errors were not looked at.
    pub error_max: f64,
    /// Wall time of stepping alone, s.
    pub seconds: f64,
}

impl Report {
    /// Adds a step's report.
    pub fn add(&mut self, step: &StepReport) {
        let substeps = u64::from(step.substeps);
        let total = self.steps + substeps;
        if total > 0 {
            self.iterations_mean += (step.mean_iterations - self.iterations_mean) * substeps as f64 / total as f64;
        }
        self.steps = total;
        self.iterations_max = self.iterations_max.max(step.max_iterations);
        self.unconverged += u64::from(step.unconverged);
        self.quarantined += u64::from(step.quarantined);
        self.subdivided += u64::from(step.subdivided);
        self.error_max = self.error_max.max(step.max_error);
        self.seconds += step.seconds;
    }
}

impl RunResult {
    /// An empty result for that many strands.
    pub fn new(strand_count: usize, requests: &[Request]) -> Self {
        let asked = |output: Output| requests.iter().any(|request| request.output == output);
        let strands = (0..strand_count)
            .map(|_| StrandResult {
                tips: asked(Output::Tips).then(Vec::new),
                points: asked(Output::Points).then(Vec::new),
                frames: asked(Output::Frames).then(Vec::new),
                velocities: asked(Output::Velocities).then(Vec::new),
                curvatures: asked(Output::Curvatures).then(Vec::new),
                rates: asked(Output::Rates).then(Vec::new),
                wrenches: asked(Output::Wrenches).then(Vec::new),
            })
            .collect();
        Self {
            version: 1,
            times: Vec::new(),
            strands,
            energies: asked(Output::Energies).then(Vec::new),
            contacts: asked(Output::Contacts).then(Vec::new),
            report: Report::default(),
            requests: requests.to_vec(),
        }
    }

    /// Adds the solver's present state as that of `time`.
    pub fn record(&mut self, time: f64, solver: &Solver, ids: &[StrandId]) -> Result<()> {
        self.times.push(time);
        for request in &self.requests {
            if matches!(request.output, Output::Points | Output::Frames | Output::Velocities) {
                self.strands.iter_mut().for_each(|strand| strand.begin_samples(*request));
                let strands = &mut self.strands;
                solver.sample_strands(ids, request.samples, |strand, _, sample| {
                    strands[strand].add_sample(request.output, sample)
                })?;
            }
        }
        for (strand, id) in self.strands.iter_mut().zip(ids) {
            strand.record_state(solver, *id)?;
        }
        if let Some(energies) = &mut self.energies {
            let mut sum = EnergiesEntry { kinetic: 0.0, elastic: 0.0, gravity: 0.0 };
            for id in ids {
                let strand = solver.energies(*id)?;
                sum.kinetic += strand.kinetic;
                sum.elastic += strand.elastic;
                sum.gravity += strand.gravity;
            }
            energies.push(sum);
        }
        if let Some(contacts) = &mut self.contacts {
            contacts.push([]);
        }
        Ok(())
    }

    /// Sets how the steps went.
    pub fn set_report(&mut self, report: Report) {
        self.report = report;
    }
}

impl StrandResult {
    fn begin_samples(&mut self, request: Request) {
        match request.output {
            Output::Points => self.points.iter_mut().for_each(|series| series.push(Vec::with_capacity(request.samples))),
            Output::Frames => self.frames.iter_mut().for_each(|series| series.push(Vec::with_capacity(request.samples))),
            Output::Velocities => self.velocities.iter_mut().for_each(|series| series.push(Vec::with_capacity(request.samples))),
            _ => {}
        }
    }

    fn add_sample(&mut self, output: Output, sample: &superhelix::solver::Sample) {
        let position: [f64; 3] = sample.position.into();
        match output {
            Output::Points => last(&mut self.points).push(position),
            Output::Frames => {
                let quaternion = sample.rotation.quaternion();
                let ([x, y, z], q) = (position, quaternion);
                last(&mut self.frames).push([x, y, z, q.i, q.j, q.k, q.w]);
            }
            Output::Velocities => last(&mut self.velocities).push(sample.velocity.into()),
            _ => {}
        }
    }

    fn record_state(&mut self, solver: &Solver, id: StrandId) -> Result<()> {
        if let Some(tips) = &mut self.tips {
            let mut tip = [0.0; 3];
            // Two samples are the root and the tip; the tip comes last.
            solver.sample_strands(&[id], 2, |_, _, sample| tip = sample.position.into())?;
            tips.push(tip);
        }
        if let Some(curvatures) = &mut self.curvatures {
            curvatures.push(solver.curvatures(id)?.to_vec());
        }
        if let Some(rates) = &mut self.rates {
            rates.push(solver.rates(id)?.to_vec());
        }
        if let Some(wrenches) = &mut self.wrenches {
            let wrench = solver.root_wrench(id)?;
            wrenches.push(WrenchEntry { force: wrench.force.into(), torque: wrench.torque.into() });
        }
        Ok(())
    }
}

/// The samples being gathered: `begin_samples` made the entry.
fn last<T>(series: &mut Series<Vec<T>>) -> &mut Vec<T> {
    series.as_mut().and_then(|series| series.last_mut()).expect("begin_samples was called for this output")
}
