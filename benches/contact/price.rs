//! Error and cost of each model: strands that fall on a ball, rough and smooth, and strands at rest over a cylinder.

use std::fmt::Write as _;
use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::{
    BodyDef, ContactModel, ContactOptions, Friction, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId,
};

use crate::{ELEMENTS, MODELS, Outcome};

const STRANDS: usize = 16;
/// The reference's step is 1/960 s, and its error in the contact laws is negligible.
const FINE: f64 = 960.0;

/// Rough: a hair's friction. Smooth: none, so that only the normal part of each model acts.
const CASES: [(&str, bool); 2] = [("rough", true), ("smooth", false)];

fn reference() -> ContactOptions {
    ContactOptions {
        model: ContactModel::Coulomb,
        tolerance: 1e-7,
        residual: 1e-9,
        max_iterations: 200,
        ..ContactOptions::default()
    }
}

fn solver(contact: ContactOptions) -> Outcome<Solver> {
    Ok(Solver::new(SolverOptions { gravity: Vector3::new(0.0, 0.0, -9.81), contact, ..SolverOptions::default() })?)
}

fn touched(rough: bool) -> StrandContact {
    let none = Friction::uniform(0.0);
    let contact = StrandContact { friction: Friction { along: 0.2, against: 0.3 }, ..StrandContact::default() };
    if rough { contact } else { StrandContact { friction: none, viscous_friction: none, ..contact } }
}

fn tips(solver: &Solver, ids: &[StrandId]) -> Outcome<Vec<Vector3<f64>>> {
    let mut tips = Vec::new();
    solver.sample_strands(ids, 2, |_, point, sample| {
        if point == 1 {
            tips.push(sample.position);
        }
    })?;
    Ok(tips)
}

/// Strands that fall on a ball and slide off it: the displacement of their tips in a second, and the processor time per strand
/// and simulated second, s.
fn fall(contact: ContactOptions, step: f64, rough: bool) -> Outcome<(Vec<Vector3<f64>>, f64)> {
    let mut solver = solver(contact)?;
    let mut defs = Vec::new();
    for k in 0..STRANDS {
        let k = k as f64;
        let mut def = StrandDef::straight(0.2, ELEMENTS);
        def.natural = vec![[0.0, 2.0 + 0.5 * k, 0.0]; ELEMENTS];
        // Initially straight, a centimetre above the ball: bent strands would start inside it, and be thrown out.
        def.initial = Some(vec![[0.0; 3]; ELEMENTS]);
        def.material.internal_friction = 1e-9;
        def.material.air_drag = 2e-5;
        def.root.origin = Vector3::new(-0.08, 0.004 * k - 0.03, 0.09);
        defs.push(def);
    }
    let ids = solver.add_strands(&defs)?;
    solver.add_bodies(vec![BodyDef::new(Arc::new(Shape::new_sphere(0.08)?))])?;
    solver.set_contact(&ids, Some(&touched(rough)))?;
    let (mut way, mut seconds) = (Vec::new(), 0.0);
    let frames = 60;
    for _ in 0..frames {
        seconds += solver.step(1.0 / 60.0, (1.0 / 60.0 / step).round() as u32)?.seconds;
        way.extend(tips(&solver, &ids)?);
    }
    Ok((way, seconds / f64::from(frames) * 60.0 / STRANDS as f64))
}

/// The rest of strands over a smooth cylinder: their tips, and the load on each cylinder, N.
struct Rest {
    tips: Vec<Vector3<f64>>,
    borne: Vec<Vector3<f64>>,
    deepest: f64,
}

/// Strands clamped level over a smooth cylinder of their own, each somewhat higher and farther away than the one before.
fn rest(contact: ContactOptions) -> Outcome<Rest> {
    let mut solver = solver(contact)?;
    let mut defs = Vec::new();
    for k in 0..STRANDS {
        let mut def = StrandDef::straight(0.1, ELEMENTS);
        def.material.viscosity = 0.05;
        def.material.air_drag = 3e-4;
        def.root.origin = Vector3::new(0.0, 0.1 * k as f64, 0.0);
        defs.push(def);
    }
    let ids = solver.add_strands(&defs)?;
    let ends = [-0.02, 0.02].map(|y| Vector3::new(0.0, y, 0.0));
    let cylinder = Arc::new(Shape::new_capsule(ends[0], ends[1], 0.01)?);
    let bodies = (0..STRANDS).map(|k| {
        let mut def = BodyDef::new(cylinder.clone());
        def.pose.origin = Vector3::new(0.03 + 2e-3 * k as f64, 0.1 * k as f64, -0.012 - 4e-4 * k as f64);
        def
    });
    let bodies = solver.add_bodies(bodies.collect())?;
    solver.set_contact(&ids, Some(&touched(false)))?;
    let mut deepest = 0.0;
    for _ in 0..600 {
        deepest = solver.step(1.0 / 60.0, 1)?.contact.penetration;
    }
    let borne = bodies.iter().map(|id| solver.body_wrench(*id).map(|wrench| wrench.force));
    Ok(Rest { tips: tips(&solver, &ids)?, borne: borne.collect::<Result<_, _>>()?, deepest })
}

fn root_mean_square(one: &[Vector3<f64>], other: &[Vector3<f64>]) -> f64 {
    let squares: f64 = one.iter().zip(other).map(|(a, b)| (a - b).norm_squared()).sum();
    (squares / one.len() as f64).sqrt()
}

/// The price list: `contact_price.csv`. `quick`: one step size, and a less precise reference.
pub fn prices(quick: bool) -> Outcome<String> {
    let mut csv = String::from("case,model,step_s,rms_error_m,ms_a_strand_second\n");
    let (fine, steps) = if quick { (240.0, &[60.0][..]) } else { (FINE, &[60.0, 120.0, 240.0][..]) };
    for (case, rough) in CASES {
        let (truth, _) = fall(reference(), 1.0 / fine, rough)?;
        for (model, max_iterations, residual, name) in MODELS {
            for parts in steps {
                let contact = ContactOptions { model, max_iterations, residual, ..ContactOptions::default() };
                let (way, seconds) = fall(contact, 1.0 / parts, rough)?;
                let error = root_mean_square(&way, &truth);
                let row = format!("{case},\"{name}\",{:.6},{error:.3e},{:.3}", 1.0 / parts, seconds * 1e3);
                println!("{row}");
                writeln!(csv, "{row}")?;
            }
        }
    }
    Ok(csv)
}

/// The models' results at rest, which no step size affects: `contact_rest.csv`.
pub fn at_rest() -> Outcome<String> {
    let mut csv = String::from("model,tip_error_m,force_error,deepest_m\n");
    let truth = rest(reference())?;
    let weight = truth.borne.iter().map(Vector3::norm).sum::<f64>() / STRANDS as f64;
    for (model, max_iterations, residual, name) in MODELS {
        let at = rest(ContactOptions { model, max_iterations, residual, ..ContactOptions::default() })?;
        let (tip, force) = (root_mean_square(&at.tips, &truth.tips), root_mean_square(&at.borne, &truth.borne) / weight);
        let row = format!("\"{name}\",{tip:.3e},{force:.3e},{:.3e}", at.deepest);
        println!("{row}");
        writeln!(csv, "{row}")?;
    }
    Ok(csv)
}
