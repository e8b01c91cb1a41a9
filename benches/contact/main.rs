//! The cost of contact: a thousand guides on Sintel's bust, shaken, hair against hair and bust, with each model. Also each
//! model's error for its cost (`price.rs`), and the cost per contact as contacts grow in number (`scaling.rs`).
//!
//! `cargo bench --bench contact -- --csv FOLDER [--steps N] [--threads N] [--guides N] [--model NAME [--work UNITS]] [--quick] [--scaling-only] [--strands-only] [--walk-only [--scale X] [--case K]]
//! [--jumps-only [--random N]] [--aims-only]`
//!
//! `--aims-only`: what was asked of the performance of contact, in one table (`aims.rs`), which the whole run ends with.

mod aims;
mod ball;
mod comb;
mod jumps;
mod price;
mod scaling;
mod tangle;
mod walk;

use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::{FitOptions, fit_polyline, natural_under_gravity};
use superhelix::io::{Curves, obj_mesh};
use superhelix::shapes::{DistanceGrid, Sides};
use superhelix::{
    BodyDef, ContactModel, ContactOptions, Frame, Phases, Shape, Solver, SolverOptions, StepLimits, StrandContact, StrandDef,
    Workers,
};

const ELEMENTS: usize = 10;
const SCALE: f64 = 0.01;
const STEP: f64 = 1.0 / 60.0;
/// Approximate radius of a guide of a thousand, which represents a hundred hairs of 40 µm lying close together, m.
const WISP: f64 = 5e-4;
/// The length from the root without contact, m: some roots lie in the bust.
const EXEMPT: f64 = 0.015;
/// The bust's distance grid, m.
const CELL: f64 = 3e-3;
const BAND: f64 = 0.02;
const GRAVITY: Vector3<f64> = Vector3::new(0.0, -9.81, 0.0);
/// A step that leaves an overlap deeper than this is a deep one, m.
const DEEP: f64 = 1e-4;
/// Steps of the walk for each row of the table of strands and threads.
const STRANDS_STEPS: usize = 16;
/// Steps before the head begins to shake.
const CALM: usize = 30;
/// A model, its largest number of iterations, its residual, and its name in tables.
type Model = (ContactModel, u32, f64, &'static str);
const MODELS: [Model; 9] = [
    (ContactModel::AtPoints, 1, 1e-4, "at points, 1 iteration"),
    (ContactModel::AtPoints, 4, 1e-4, "at points, 4 iterations"),
    (ContactModel::Penalty, 1, 1e-4, "penalty, 1 iteration"),
    (ContactModel::Penalty, 2, 1e-4, "penalty, 2 iterations"),
    (ContactModel::Penalty, 4, 1e-4, "penalty, 4 iterations"),
    (ContactModel::Penalty, 50, 1e-4, "penalty"),
    (ContactModel::RegularisedPenalty, 50, 1e-4, "regularised penalty"),
    (ContactModel::Coulomb, 50, 1e-4, "coulomb"),
    (ContactModel::Coulomb, 50, 1e-6, "coulomb, residual 1e-6"),
];

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Sintel's hair as guides: 228 strands, and copies of them a few millimetres aside, except those drawn through the bust.
fn guides(head: &Shape, guides: usize) -> Outcome<Vec<StrandDef>> {
    let curves = Curves::read("tests/data/grooms/sintel_hair_001.tfx")?;
    let count = curves.strand_count();
    let mut defs = Vec::new();
    for k in 0.. {
        let (index, copy) = (k % count, k / count);
        let turn = 2.399_963 * k as f64;
        let aside = Vector3::new(turn.cos(), 0.0, turn.sin()) * (1.5e-3 * copy as f64);
        let points: Vec<Vector3<f64>> =
            curves.strand(index).iter().map(|p| Vector3::from(p.map(f64::from)) * SCALE + aside).collect();
        if is_in(head, &points) {
            continue;
        }
        let fit = fit_polyline(&points, &FitOptions::elements(ELEMENTS))?;
        let mut def = StrandDef::straight(1.0, ELEMENTS);
        def.element_lengths.clone_from(&fit.element_lengths);
        def.natural.clone_from(&fit.curvatures);
        def.root = fit.root;
        def.material.internal_friction = 1e-10;
        def.material.air_drag = 5e-6;
        def.natural = natural_under_gravity(&def, &fit.curvatures, GRAVITY)?;
        def.initial = Some(fit.curvatures);
        defs.push(def);
        if defs.len() == guides {
            break;
        }
    }
    Ok(defs)
}

/// Whether a curve enters the head beyond the exempt length from its root.
fn is_in(head: &Shape, points: &[Vector3<f64>]) -> bool {
    let mut along = 0.0;
    points.windows(2).any(|pair| {
        along += (pair[1] - pair[0]).norm();
        along > EXEMPT && head.closest(pair[1], BAND).is_some_and(|surface| surface.distance < 1e-3)
    })
}

/// The head's pose, `seconds` after the start: yaw of ±0.5 rad at 2 Hz about the axis through its middle.
fn pose(seconds: f64) -> UnitQuaternion<f64> {
    let shaking = (seconds - CALM as f64 * STEP).max(0.0);
    UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5 * (2.0 * std::f64::consts::PI * 2.0 * shaking).sin())
}

struct Shaken {
    model: &'static str,
    /// Of all steps of the shake, ascending.
    milliseconds: Vec<f64>,
    strand_steps: usize,
    /// For a mean step: search, steps of strands, contact problems, s.
    phases: [f64; 3],
    contacts: f64,
    iterations: f64,
    most_iterations: u32,
    sweeps: f64,
    penetration: f64,
    /// The largest overlap of strands and bust after a step by [`Solver::overlaps`], which is independent of the step's contacts,
    /// m.
    overlap: f64,
    deep_steps: u32,
    residual: f64,
    unconverged: u64,
    rolled_back: u64,
}

fn shake(
    defs: &[StrandDef],
    head: &Arc<Shape>,
    (model, max_iterations, residual, name): Model,
    steps: usize,
    threads: usize,
    work: Option<u64>,
) -> Outcome<Shaken> {
    let contact = ContactOptions { model, max_iterations, residual, hair: true, ..ContactOptions::default() };
    let workers = if threads > 1 { Workers::Pool(threads) } else { Workers::Serial };
    let mut solver = Solver::new(SolverOptions { gravity: GRAVITY, contact, workers, ..SolverOptions::default() })?;
    let ids = solver.add_strands(defs)?;
    let bodies = solver.add_bodies(vec![BodyDef::new(head.clone())])?;
    let strand = StrandContact { wisp_radius: WISP, exempt_length: EXEMPT, ..StrandContact::default() };
    solver.set_contact(&ids, Some(&strand))?;
    let mut out = Shaken {
        model: name,
        milliseconds: Vec::new(),
        strand_steps: steps * ids.len(),
        phases: [0.0; 3],
        contacts: 0.0,
        iterations: 0.0,
        most_iterations: 0,
        sweeps: 0.0,
        penetration: 0.0,
        overlap: 0.0,
        deep_steps: 0,
        residual: 0.0,
        unconverged: 0,
        rolled_back: 0,
    };
    for step in 0..CALM + steps {
        let turn = pose((step + 1) as f64 * STEP);
        let frames: Vec<Frame> =
            defs.iter().map(|def| Frame { origin: turn * def.root.origin, rotation: turn * def.root.rotation }).collect();
        solver.set_root_frames(&ids, &frames, STEP)?;
        solver.set_body_frames(&bodies, &[Frame { origin: Vector3::zeros(), rotation: turn }], STEP)?;
        let report = solver.step_within(STEP, 1, &StepLimits { work, ..StepLimits::default() })?;
        if std::env::var_os("CONTACT_PRINT").is_some() {
            let (ms, units) = (1e3 * report.seconds, report.work);
            println!("{step}: {ms:.1} ms, {units} units, {} unconverged, {:?}", report.unconverged, report.contact);
        }
        // The groom as drawn has hair in hair and in the bust: the cost of separating them is not the shake's.
        if step < CALM {
            continue;
        }
        out.milliseconds.push(report.seconds * 1e3);
        let Phases { search, strands, contact, .. } = report.phases;
        for (sum, seconds) in out.phases.iter_mut().zip([search, strands, contact]) {
            *sum += seconds / steps as f64;
        }
        out.contacts += f64::from(report.contact.contacts) / steps as f64;
        out.iterations += report.mean_iterations / steps as f64;
        out.most_iterations = out.most_iterations.max(report.contact.iterations);
        out.sweeps += report.contact.sweeps as f64 / steps as f64;
        out.penetration = out.penetration.max(report.contact.penetration);
        let overlaps = solver.overlaps(&ids)?;
        out.overlap = overlaps.iter().fold(out.overlap, |deepest, overlap| deepest.max(overlap.hair).max(overlap.bodies));
        out.deep_steps += u32::from(report.contact.penetration > DEEP);
        out.residual = out.residual.max(report.contact.residual);
        out.unconverged += u64::from(report.unconverged);
        out.rolled_back += u64::from(report.quarantined);
    }
    out.milliseconds.sort_by(f64::total_cmp);
    Ok(out)
}

/// The value that a share of ascending values does not exceed.
fn quantile(ascending: &[f64], share: f64) -> f64 {
    ascending[((ascending.len() - 1) as f64 * share) as usize]
}

/// The rows of `contact_shake.csv` of the models that are wanted by their names, which are also printed; and what they are made of.
fn shakes(
    defs: &[StrandDef],
    head: &Arc<Shape>,
    wanted: impl Fn(&str) -> bool,
    steps: usize,
    threads: usize,
    work: Option<u64>,
) -> Outcome<(String, Vec<Shaken>)> {
    let mut csv = String::from(
        "model,median_ms,ninth_decile_ms,worst_ms,search_ms,strands_ms,contact_ms,contacts,iterations,most_iterations,sweeps,penetration_m,overlap_m,deep_steps,residual,unconverged,rolled_back\n",
    );
    let mut all = Vec::new();
    for model in MODELS.into_iter().filter(|model| wanted(model.3)) {
        let out = shake(defs, head, model, steps, threads, work)?;
        let at = |share: f64| quantile(&out.milliseconds, share);
        let row = format!(
            "\"{}\",{:.1},{:.1},{:.1},{:.1},{:.1},{:.1},{:.0},{:.2},{},{:.0},{:.2e},{:.2e},{},{:.1e},{},{}",
            out.model,
            at(0.5),
            at(0.9),
            at(1.0),
            1e3 * out.phases[0],
            1e3 * out.phases[1],
            1e3 * out.phases[2],
            out.contacts,
            out.iterations,
            out.most_iterations,
            out.sweeps,
            out.penetration,
            out.overlap,
            out.deep_steps,
            out.residual,
            out.unconverged,
            out.rolled_back
        );
        println!("{row}");
        writeln!(csv, "{row}")?;
        all.push(out);
    }
    Ok((csv, all))
}

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().collect();
    let option = |name: &str| arguments.iter().position(|argument| argument == name).and_then(|at| arguments.get(at + 1));
    let folder = option("--csv").map(PathBuf::from);
    let quick = arguments.iter().any(|argument| argument == "--quick");
    let steps: usize = option("--steps").map_or(Ok(if quick { 4 } else { 90 }), |text| text.parse())?;
    let threads: usize = option("--threads").map_or(Ok(2), |text| text.parse())?;
    let only = option("--model");
    let work: Option<u64> = option("--work").map(|text| text.parse()).transpose()?;
    let count: usize = option("--guides").map_or(Ok(if quick { 40 } else { 1000 }), |text| text.parse())?;

    let bust = obj_mesh::read("tests/data/grooms/sintel_bust.obj")?;
    let vertices: Vec<_> = bust.vertices.iter().map(|v| Vector3::from(*v) * SCALE).collect();
    let mesh = Shape::new_mesh(vertices.clone(), bust.triangles.clone(), Sides::Front { depth: 0.02 })?;
    let baked = mesh.mesh().map(|mesh| DistanceGrid::bake(mesh, CELL, BAND)).transpose()?;
    let head = Arc::new(baked.map_or(mesh, Shape::new_grid));
    if arguments.iter().any(|argument| argument == "--jumps-only") {
        let random = option("--random").map_or(Ok(if quick { 100 } else { 10_000 }), |text| text.parse())?;
        let [median, p99, most] = jumps::cancelled(if quick { 40 } else { 400 })?;
        println!("cancelled: median {median:.3} ms, p99 {p99:.3}, at most {most:.3}");
        let jumps = jumps::table(random)?;
        return Ok(folder.map_or(Ok(()), |folder| std::fs::write(folder.join("contact_jumps.csv"), jumps))?);
    }
    if arguments.iter().any(|argument| argument == "--scaling-only") {
        let scaling = scaling::table(&head, quick)?;
        return Ok(folder.map_or(Ok(()), |folder| std::fs::write(folder.join("contact_scaling.csv"), scaling))?);
    }
    let scale = option("--scale").map_or(Ok(if quick { 0.02 } else { 1.0 }), |text| text.parse())?;
    let case = option("--case").map(|text| text.parse()).transpose()?;
    let aims_only = arguments.iter().any(|argument| argument == "--aims-only");
    let run = walk::Run { steps, threads, scale, only: case, aims_only };
    let bust_of = (&vertices[..], &bust.triangles[..]);
    let walk = || walk::table(&head, bust_of, &run);
    let strands = || walk::strands_and_threads(&head, bust_of, if quick { 2 } else { STRANDS_STEPS }, quick);
    if arguments.iter().any(|argument| argument == "--strands-only") {
        let table = strands()?;
        return Ok(folder.map_or(Ok(()), |folder| std::fs::write(folder.join("contact_strands.csv"), table))?);
    }
    if arguments.iter().any(|argument| argument == "--walk-only") {
        let (table, _) = walk()?;
        return Ok(folder.map_or(Ok(()), |folder| std::fs::write(folder.join("contact_walk.csv"), table))?);
    }
    let defs = guides(&head, count)?;
    println!(
        "{} guides x {ELEMENTS} elements on {} triangles, {threads} threads, {steps} steps of 1/60 s",
        defs.len(),
        bust.triangles.len()
    );
    let wanted = |name: &str| only.is_none_or(|only| only == name) && (!aims_only || aims::has_shake(name));
    let (csv, shaken) = shakes(&defs, &head, wanted, steps, threads, work)?;
    if aims_only {
        let table = aims::table(&shaken, &walk()?.1, quick)?;
        return Ok(folder.map_or(Ok(()), |folder| std::fs::write(folder.join("contact_aims.csv"), table))?);
    }
    // For a single model only the table of the head is wanted.
    let (prices, rest) = if only.is_none() { (price::prices(quick)?, price::at_rest()?) } else { Default::default() };
    if let Some(folder) = folder {
        std::fs::write(folder.join("contact_shake.csv"), csv)?;
        if only.is_none() {
            std::fs::write(folder.join("contact_price.csv"), prices)?;
            std::fs::write(folder.join("contact_rest.csv"), rest)?;
            std::fs::write(folder.join("contact_scaling.csv"), scaling::table(&head, quick)?)?;
            let (csv, walked) = walk()?;
            std::fs::write(folder.join("contact_walk.csv"), csv)?;
            std::fs::write(folder.join("contact_strands.csv"), strands()?)?;
            std::fs::write(folder.join("contact_aims.csv"), aims::table(&shaken, &walked, quick)?)?;
        }
    }
    Ok(())
}
