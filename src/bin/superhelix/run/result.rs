//! What a run of a scene gives: the document of docs/reference/scene_format.md, section "Result".

use std::collections::HashMap;

use serde::Serialize;
use superhelix::{
    BodyId, ConstraintId, ConstraintState, ConstraintStatus, Contact, ContactPartner, Result, Solver, StrandId, Wrench,
};

use crate::run::things::Things;
use crate::scene::{Output, Request, Scene};
use crate::stepping::report::Report;

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
    contacts: Series<Vec<ContactEntry>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    colliders: Vec<ColliderResult>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    attachments: Vec<AttachmentResult>,
    /// How the steps went.
    pub report: Report,
    state_hash: String,
    #[serde(skip)]
    requests: Vec<Request>,
    #[serde(skip)]
    things: Places,
}

/// The places of identifiers in the scene.
#[derive(Debug)]
struct Places {
    strands: Vec<StrandId>,
    bodies: Vec<BodyId>,
    constraints: Vec<ConstraintId>,
    of_strands: HashMap<StrandId, usize>,
    of_bodies: HashMap<BodyId, usize>,
}

/// A touch at the end of a step.
#[derive(Debug, Serialize)]
struct ContactEntry {
    strand: usize,
    arclength: f64,
    #[serde(flatten)]
    partner: PartnerEntry,
    position: [f64; 3],
    normal: [f64; 3],
    force: [f64; 3],
    gap: f64,
    slip: [f64; 3],
}

/// What it is with.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum PartnerEntry {
    Collider { collider: usize, feature: u32 },
    Strand { other: usize, other_arclength: f64 },
}

/// What strands did to a collider; one entry an output time.
#[derive(Debug, Serialize)]
struct ColliderResult {
    wrenches: Vec<WrenchEntry>,
}

/// How an attachment fared; one entry an output time.
#[derive(Debug, Serialize)]
struct AttachmentResult {
    states: Vec<StateEntry>,
}

#[derive(Debug, Serialize)]
struct StateEntry {
    status: &'static str,
    force: [f64; 3],
    torque: [f64; 3],
    error: f64,
    arclength: f64,
}

/// What was asked for of one strand; one entry an output time in every list.
#[derive(Debug, Serialize)]
struct StrandResult {
    /// That of its item in the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
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

impl RunResult {
    /// An empty result for a scene's things.
    pub fn new(things: &Things, scene: &Scene) -> Self {
        let requests = &scene.outputs;
        let asked = |output: Output| requests.iter().any(|request| request.output == output);
        let strands = things
            .strands
            .iter()
            .enumerate()
            .map(|(index, _)| StrandResult {
                name: scene.strands.get(index).and_then(|strand| strand.name.as_deref().map(str::to_owned)),
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
            colliders: Vec::from_iter(
                things.bodies.iter().filter(|_| asked(Output::Wrenches)).map(|_| ColliderResult { wrenches: Vec::new() }),
            ),
            attachments: Vec::from_iter(
                things.constraints.iter().filter(|_| asked(Output::Attachments)).map(|_| AttachmentResult { states: Vec::new() }),
            ),
            report: Report::default(),
            state_hash: String::new(),
            requests: requests.to_vec(),
            things: Places {
                strands: things.strands.clone(),
                bodies: things.bodies.clone(),
                constraints: things.constraints.clone(),
                of_strands: things.strands.iter().enumerate().map(|(index, id)| (*id, index)).collect(),
                of_bodies: things.bodies.iter().enumerate().map(|(index, id)| (*id, index)).collect(),
            },
        }
    }

    /// Adds the solver's present state as that of `time`.
    pub fn record(&mut self, time: f64, solver: &Solver) -> Result<()> {
        let ids = &self.things.strands;
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
            contacts.push(solver.contacts().iter().map(|contact| self.things.contact(contact)).collect());
        }
        for (collider, id) in self.colliders.iter_mut().zip(&self.things.bodies) {
            collider.wrenches.push(WrenchEntry::from(solver.body_wrench(*id)?));
        }
        for (attachment, id) in self.attachments.iter_mut().zip(&self.things.constraints) {
            attachment.states.push(StateEntry::from(solver.constraint_state(*id)?));
        }
        Ok(())
    }

    /// Sets how the steps went and what state they led to.
    pub fn end(&mut self, report: Report, solver: &Solver) {
        self.report = report;
        self.state_hash = format!("{:016x}", solver.state_hash());
    }
}

impl Places {
    fn contact(&self, contact: &Contact) -> ContactEntry {
        ContactEntry {
            strand: self.of_strands[&contact.strand],
            arclength: contact.arclength,
            partner: match contact.partner {
                ContactPartner::Body { body, feature } => PartnerEntry::Collider { collider: self.of_bodies[&body], feature },
                ContactPartner::Strand { strand, arclength } => {
                    PartnerEntry::Strand { other: self.of_strands[&strand], other_arclength: arclength }
                }
            },
            position: contact.position.into(),
            normal: contact.normal.into(),
            force: contact.force.into(),
            gap: contact.gap,
            slip: contact.slip.into(),
        }
    }
}

impl From<Wrench> for WrenchEntry {
    fn from(wrench: Wrench) -> Self {
        Self { force: wrench.force.into(), torque: wrench.torque.into() }
    }
}

impl From<ConstraintState> for StateEntry {
    fn from(state: ConstraintState) -> Self {
        Self {
            status: match state.status {
                ConstraintStatus::Holds => "holds",
                ConstraintStatus::Dependent => "dependent",
                ConstraintStatus::Violated => "violated",
                ConstraintStatus::Released => "released",
            },
            force: state.force.into(),
            torque: state.torque.into(),
            error: state.error,
            arclength: state.arclength,
        }
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

    fn add_sample(&mut self, output: Output, sample: &superhelix::Sample) {
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
            wrenches.push(WrenchEntry::from(solver.root_wrench(id)?));
        }
        Ok(())
    }
}

/// The samples being gathered: `begin_samples` made the entry.
fn last<T>(series: &mut Series<Vec<T>>) -> &mut Vec<T> {
    series.as_mut().and_then(|series| series.last_mut()).expect("begin_samples was called for this output")
}
