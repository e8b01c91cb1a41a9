//! A comb of seven teeth that strokes a curtain of strands at 1 kHz, as a haptic device leads it, with the forces on its teeth. Latencies of
//! one thread.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;
use std::time::Instant;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{BodyDef, Frame, Freedoms, Shape, Solver, SolverOptions, StepOptions, StrandContact, StrandDef, Workers};

use crate::Outcome;

const STRANDS: usize = 100;
const ELEMENTS: usize = 5;
const TEETH: usize = 7;
/// A step, s.
const STEP: f64 = 1e-3;
/// Steps in which the hair hangs and the comb waits beside it, and steps of a stroke.
const CALM: usize = 300;
const STROKE: usize = 3000;
/// Where the comb waits: beside the hair, and the height of the beginning of a stroke, m.
const BESIDE: f64 = -0.12;
const HIGH: f64 = -0.03;

/// What the comb's steps came to.
#[derive(Default)]
pub struct Combed {
    /// Of all steps, ascending: the poses set, the step, the forces read.
    pub milliseconds: Vec<f64>,
    pub most_contacts: u32,
    pub iterations: f64,
    pub unconverged: u32,
    pub penetration: f64,
    /// The largest force on the comb, N.
    pub force: f64,
}

/// Twenty strands beside each other in five rows, hanging.
fn strands() -> Vec<StrandDef> {
    let freedoms = Freedoms::TWIST.union(Freedoms::BEND2);
    let def = |k: usize| {
        let mut def = StrandDef { freedoms, ..StrandDef::straight(0.15, ELEMENTS) };
        (def.material.internal_friction, def.material.air_drag, def.material.viscosity) = (1e-10, 1e-5, 2e-3);
        let origin = Vector3::new(0.004 * (k / 20) as f64, 0.002 * (k % 20) as f64, 0.0);
        def.root = Frame { origin, rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), FRAC_PI_2) };
        def
    };
    (0..STRANDS).map(def).collect()
}

/// How far a smooth motion has come, a part of its time after its start.
fn way(part: f64) -> f64 {
    0.5 * (1.0 - (PI * part).cos())
}

/// The comb's place across and its height: into the hair in 0.6 s, down through it in 1.8 s, and out of it in 0.6 s, m.
fn place(step: usize) -> (f64, f64) {
    let seconds = (step % STROKE) as f64 * STEP;
    if seconds < 0.6 {
        (BESIDE * (1.0 - way(seconds / 0.6)), HIGH)
    } else if seconds < 2.4 {
        (0.0, HIGH - 0.14 * way((seconds - 0.6) / 1.8))
    } else {
        (BESIDE * way((seconds - 2.4) / 0.6), HIGH - 0.14)
    }
}

/// The teeth of the comb at a place.
fn frames((across, height): (f64, f64)) -> Vec<Frame> {
    let tooth = |k: usize| Vector3::new(across, 0.006 * k as f64 + 0.0005, height);
    (0..TEETH).map(|k| Frame { origin: tooth(k), ..Frame::default() }).collect()
}

/// `steps` steps of strokes, with the hard model.
pub fn combed(steps: usize) -> Outcome<Combed> {
    let step = StepOptions { tolerance: 1e-4, ..StepOptions::default() };
    let mut solver = Solver::new(SolverOptions { step, workers: Workers::Serial, ..SolverOptions::default() })?;
    let ids = solver.add_strands(&strands())?;
    let strand = StrandContact { exempt_length: 0.01, ..StrandContact::default() };
    solver.set_contact(&ids, Some(&strand))?;
    let ends = [-0.03, 0.05].map(|x| Vector3::new(x, 0.0, 0.0));
    let tooth = Arc::new(Shape::new_capsule(ends[0], ends[1], 1e-3)?);
    let waiting = frames((BESIDE, HIGH));
    let teeth = solver.add_bodies(waiting.iter().map(|pose| BodyDef { pose: *pose, ..BodyDef::new(tooth.clone()) }).collect())?;
    for _ in 0..CALM {
        solver.step(STEP, 1)?;
    }
    let mut combed = Combed::default();
    for k in 0..steps {
        let frames = frames(place(k));
        let started = Instant::now();
        // A new stroke begins beside the hair.
        if k > 0 && k % STROKE == 0 {
            solver.teleport_bodies(&teeth, &frames)?;
        } else {
            solver.set_body_frames(&teeth, &frames, STEP)?;
        }
        let report = solver.step(STEP, 1)?;
        let mut force = Vector3::zeros();
        for tooth in &teeth {
            force += solver.body_wrench(*tooth)?.force;
        }
        combed.milliseconds.push(1e3 * started.elapsed().as_secs_f64());
        combed.most_contacts = combed.most_contacts.max(report.contact.contacts);
        combed.iterations += f64::from(report.contact.iterations) / steps as f64;
        combed.unconverged += report.unconverged;
        combed.penetration = combed.penetration.max(report.contact.penetration);
        combed.force = combed.force.max(force.norm());
    }
    combed.milliseconds.sort_by(f64::total_cmp);
    Ok(combed)
}
