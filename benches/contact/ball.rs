//! Hair all over a ball that turns: what a ball costs that is near and not touched, and one that hair lies on. Wall clock of one thread.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use superhelix::{
    BodyDef, ContactModel, ContactOptions, Frame, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId, Workers,
};

use crate::{Outcome, STEP};

/// Distance of the roots from the middle, m; radius of the ball that hair lies on, and of the one that it is only near, m.
const ROOTS: f64 = 0.09;
const TOUCHED: f64 = ROOTS - 0.002;
const NEAR: f64 = 0.05;
/// The ball turns to and fro by this angle, rad, once in this many steps.
const ANGLE: f64 = 0.3;
const PERIOD: f64 = 60.0;

/// A ball, and how it is answered.
#[derive(Clone, Copy)]
pub struct Ball {
    radius: f64,
    model: ContactModel,
    max_iterations: u32,
}

/// Near the hair, out of reach of almost all of it.
pub const BALL_NEAR: Ball = Ball { radius: NEAR, model: ContactModel::Coulomb, max_iterations: 50 };
/// Under the hair.
pub const BALL_BY_PENALTIES: Ball = Ball { radius: TOUCHED, model: ContactModel::Penalty, max_iterations: 2 };
pub const BALL_HARD: Ball = Ball { radius: TOUCHED, model: ContactModel::Coulomb, max_iterations: 50 };

/// What a scene's steps came to.
#[derive(Default)]
pub struct Turned {
    /// Of all steps, as they were taken.
    pub milliseconds: Vec<f64>,
    /// Of a mean step.
    pub contacts: f64,
    pub iterations: f64,
    pub unconverged: u32,
    pub penetration: f64,
}

/// The `k`th of `count` roots all over a ball of this radius (m) from its pole down by a part of it, where 2 is the whole ball. Hair grows
/// along the normals.
pub fn root_on_ball(k: usize, count: usize, part: f64, radius: f64) -> Frame {
    let (z, turn) = (1.0 - part * (k as f64 + 0.5) / count as f64, 2.399_963 * k as f64);
    let flat = (1.0 - z * z).sqrt();
    let up = Vector3::new(flat * turn.cos(), flat * turn.sin(), z);
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(1.0 + up.x, 0.0, -up.z, up.y));
    Frame { origin: up * radius, rotation }
}

fn strands(count: usize, elements: usize) -> Vec<StrandDef> {
    let def = |k: usize| {
        let mut def = StrandDef::straight(0.2, elements);
        (def.material.internal_friction, def.material.air_drag) = (1e-10, 1e-5);
        def.root = root_on_ball(k, count, 0.7, ROOTS);
        def.natural = vec![[3.0, 8.0 + 3.0 * (k as f64).sin(), 0.0]; elements];
        def
    };
    (0..count).map(def).collect()
}

fn scene(defs: &[StrandDef], ball: Option<Ball>) -> Outcome<(Solver, Vec<StrandId>)> {
    let contact = ball.map_or(ContactOptions::default(), |Ball { model, max_iterations, .. }| ContactOptions {
        model,
        max_iterations,
        ..ContactOptions::default()
    });
    let mut solver = Solver::new(SolverOptions { contact, workers: Workers::Serial, ..SolverOptions::default() })?;
    let ids = solver.add_strands(defs)?;
    if let Some(ball) = ball {
        let strand = StrandContact { exempt_length: 0.01, ..StrandContact::default() };
        solver.set_contact(&ids, Some(&strand))?;
        solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_sphere(ball.radius)?))])?;
    }
    Ok((solver, ids))
}

/// The same hair with each of `balls`. The scenes take their steps in turn, so that what slows the machine down slows all of them
/// down. The ball stands still for `calm` steps and turns for `steps`.
pub fn turned(
    strand_count: usize,
    elements: usize,
    balls: &[Option<Ball>],
    (calm, steps): (usize, usize),
) -> Outcome<Vec<Turned>> {
    let defs = strands(strand_count, elements);
    let mut scenes = balls.iter().map(|ball| scene(&defs, *ball)).collect::<Outcome<Vec<_>>>()?;
    let mut all: Vec<Turned> = balls.iter().map(|_| Turned::default()).collect();
    for k in 0..calm + steps {
        let angle = ANGLE * (2.0 * PI * k.saturating_sub(calm) as f64 / PERIOD).sin();
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
        let frame = |def: &StrandDef| Frame { origin: turn * def.root.origin, rotation: turn * def.root.rotation };
        let frames: Vec<Frame> = defs.iter().map(frame).collect();
        for ((solver, ids), turned) in scenes.iter_mut().zip(&mut all) {
            solver.set_root_frames(ids, &frames, STEP)?;
            let report = solver.step(STEP, 1)?;
            if k < calm {
                continue;
            }
            turned.milliseconds.push(1e3 * report.seconds);
            turned.contacts += f64::from(report.contact.contacts) / steps as f64;
            turned.iterations += report.mean_iterations / steps as f64;
            turned.unconverged += report.unconverged;
            turned.penetration = turned.penetration.max(report.contact.penetration);
        }
    }
    Ok(all)
}
