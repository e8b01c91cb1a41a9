//! The cost per contact as contacts grow in number: tufts that hang beside each other without meeting, so that there are more
//! islands of the same size; and one head with more and thinner guides, so that islands grow. Processor time of one thread.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use rustix::time::{ClockId, clock_gettime};
use superhelix::internals::contact::broad_phase::hair_pairs::{HairPairs, HeldRoots, PairOptions};
use superhelix::internals::contact::broad_phase::pieces::Wisp;
use superhelix::internals::contact::contact_point::{StrandCurve, StrandPath};
use superhelix::internals::contact::narrow_phase::strand_contacts::PairScratch;
use superhelix::internals::math::quadrature::Rule;
use superhelix::internals::math::vector::Mat3;
use superhelix::internals::rod::kinematics::Kinematics;
use superhelix::{
    BodyDef, ContactModel, ContactOptions, Frame, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId, Workers,
};

use crate::{CALM, EXEMPT, GRAVITY, Outcome, STEP, WISP, guides, pose};

/// The models, and their largest numbers of iterations.
const MODELS: [(ContactModel, u32, &str); 2] =
    [(ContactModel::Penalty, 4, "penalty, 4 iterations"), (ContactModel::Coulomb, 50, "coulomb")];
/// Side of a tuft in strands, and distance of tufts, m: out of each other's reach.
const SIDE: usize = 4;
const APART: f64 = 0.4;
const TUFTS: [usize; 5] = [8, 16, 32, 64, 128];
const GUIDES: [usize; 5] = [125, 250, 500, 1000, 2000];
/// With the hard model a head has at most this many guides.
const MAX_HARD: usize = 500;
const STEPS: usize = 30;

/// A moving scene, and the radius of its wisps.
struct Scene {
    case: &'static str,
    defs: Vec<StrandDef>,
    head: Option<Arc<Shape>>,
    wisp_radius: f64,
}

fn tufts(count: usize) -> Scene {
    let down = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.5 * PI)
        * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5 * PI);
    let row = (count as f64).sqrt().ceil() as usize;
    let mut defs = Vec::new();
    for tuft in 0..count {
        let middle = Vector3::new((tuft % row) as f64, 0.0, (tuft / row) as f64) * APART;
        for k in 0..SIDE * SIDE {
            // Eight types of tufts, so that every number of tufts has the same mix.
            let number = (k + 16 * (tuft % 8)) as f64;
            let part = |by: f64| 2.0 * (number * by).fract() - 1.0;
            let mut def = StrandDef::straight(0.15, 6);
            def.material.internal_friction = 1e-10;
            def.material.air_drag = 5e-6;
            def.natural = vec![[0.0, 6.0 * part(0.618_034), 6.0 * part(0.754_878)]; 6];
            let place = Vector3::new((k % SIDE) as f64, 0.0, (k / SIDE) as f64) * (2.4 * WISP);
            def.root = Frame { origin: middle + place, rotation: down };
            defs.push(def);
        }
    }
    Scene { case: "tufts", defs, head: None, wisp_radius: WISP }
}

/// Strands as paths, from their states at the start and the end of a step.
struct Poses(Vec<(Vector3<f64>, Kinematics<f64>)>);

impl Poses {
    fn of(solver: &Solver, ids: &[StrandId]) -> Outcome<Self> {
        let rule = Rule::gauss_legendre(1);
        let one = |id: &StrandId| -> Outcome<_> {
            let root = solver.root_frame(*id)?;
            let mut kinematics = Kinematics::default();
            let rotation = Mat3::from(root.rotation.to_rotation_matrix().into_inner());
            kinematics.update(&rotation, solver.element_lengths(*id)?, solver.curvatures(*id)?, &rule);
            Ok((root.origin, kinematics))
        };
        Ok(Self(ids.iter().map(one).collect::<Outcome<_>>()?))
    }

    fn curve(&self, k: usize) -> StrandCurve<'_> {
        StrandCurve { origin: self.0[k].0, elements: &self.0[k].1.elements }
    }
}

/// Processor time of this thread, s: least affected by other programs.
fn seconds() -> f64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

/// One full search for contacts between strands on one thread, as at the start of a step: how many it finds, and its time, s.
fn search(pairs: &mut HairPairs, then: &Poses, now: &Poses) -> Outcome<(usize, f64)> {
    let path = |k| StrandPath { index: k as u32, start: then.curve(k), now: now.curve(k), permitted_overlap: None };
    let paths: Vec<StrandPath> = (0..now.0.len()).map(path).collect();
    let (mut scratch, mut found) = (PairScratch::default(), Vec::new());
    let started = seconds();
    pairs.begin_step();
    pairs.update(&paths)?;
    for group in pairs.groups() {
        pairs.contacts(group, &paths, f64::INFINITY, &mut scratch, &mut found);
    }
    Ok((found.len(), seconds() - started))
}

fn row(scene: &Scene, (model, max_iterations, name): (ContactModel, u32, &str), steps: usize) -> Outcome<String> {
    let contact = ContactOptions { model, max_iterations, hair: true, ..ContactOptions::default() };
    let mut solver =
        Solver::new(SolverOptions { gravity: GRAVITY, contact, workers: Workers::Serial, ..SolverOptions::default() })?;
    let ids = solver.add_strands(&scene.defs)?;
    let bodies = match &scene.head {
        Some(head) => solver.add_bodies(vec![BodyDef::new(head.clone())])?,
        None => Vec::new(),
    };
    let exempt_length = if scene.head.is_some() { EXEMPT } else { 0.0 };
    solver
        .set_contact(&ids, Some(&StrandContact { wisp_radius: scene.wisp_radius, exempt_length, ..StrandContact::default() }))?;
    let mut pairs = HairPairs::default();
    let wisp = Wisp { radius: scene.wisp_radius, exempt: exempt_length, ..Wisp::default() };
    pairs.set(
        &vec![wisp; ids.len()],
        &PairOptions { activation: 0.1 * scene.wisp_radius, margin: 0.5 * scene.wisp_radius, held_roots: HeldRoots::Ignored },
    )?;
    let (mut milliseconds, mut contacts, mut iterations, mut unconverged) = (Vec::new(), 0.0, 0.0, 0);
    let (mut searched, mut found) = (Vec::new(), 0.0);
    let mut work = 0.0;
    for step in 0..CALM + steps {
        let at = (step + 1) as f64 * STEP;
        let (turn, shift) = match scene.head {
            Some(_) => (pose(at), Vector3::zeros()),
            None => (UnitQuaternion::identity(), Vector3::x() * (0.02 * (2.0 * PI * 2.0 * at).sin())),
        };
        let frame = |def: &StrandDef| Frame { origin: turn * def.root.origin + shift, rotation: turn * def.root.rotation };
        let frames: Vec<Frame> = scene.defs.iter().map(frame).collect();
        solver.set_root_frames(&ids, &frames, STEP)?;
        solver.set_body_frames(&bodies, &vec![Frame { origin: shift, rotation: turn }; bodies.len()], STEP)?;
        let then = Poses::of(&solver, &ids)?;
        let started = seconds();
        let report = solver.step(STEP, 1)?;
        let took = seconds() - started;
        let (count, searching) = search(&mut pairs, &then, &Poses::of(&solver, &ids)?)?;
        if step < CALM {
            continue;
        }
        milliseconds.push(took * 1e3);
        contacts += f64::from(report.contact.contacts) / steps as f64;
        iterations += report.mean_iterations / steps as f64;
        unconverged += report.unconverged;
        work += report.work as f64;
        searched.push(searching * 1e3);
        found += count as f64 / steps as f64;
    }
    let median = |values: &mut Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let units = 1e-3 * work / milliseconds.iter().sum::<f64>();
    let (step, search) = (median(&mut milliseconds), median(&mut searched));
    Ok(format!(
        "{},\"{name}\",{},{contacts:.0},{step:.2},{:.1},{iterations:.2},{found:.0},{search:.3},{:.2},{units:.2},{unconverged}",
        scene.case,
        scene.defs.len(),
        1e3 * step / contacts.max(1.0),
        1e3 * search / found.max(1.0),
    ))
}

/// The table; `quick`: its smallest rows, a few steps.
pub fn table(head: &Arc<Shape>, quick: bool) -> Outcome<String> {
    let mut csv = String::from(
        "case,model,strands,contacts,ms_a_step,us_a_contact,iterations,contacts_found,search_ms,search_us_a_contact_found,units_a_us,unconverged\n",
    );
    let (rows, steps) = if quick { (1, 4) } else { (TUFTS.len(), STEPS) };
    let mut add = |scene: &Scene| -> Outcome<()> {
        for model in MODELS {
            if scene.head.is_some() && model.0 == ContactModel::Coulomb && scene.defs.len() > MAX_HARD {
                continue;
            }
            let row = row(scene, model, steps)?;
            println!("{row}");
            writeln!(csv, "{row}")?;
        }
        Ok(())
    };
    for count in &TUFTS[..rows] {
        add(&tufts(*count))?;
    }
    for count in &GUIDES[..rows] {
        // The same amount of hair for any number of guides.
        let wisp_radius = WISP * (1000.0 / *count as f64).sqrt();
        add(&Scene { case: "head", defs: guides(head, *count)?, head: Some(head.clone()), wisp_radius })?;
    }
    Ok(csv)
}
