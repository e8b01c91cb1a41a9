//! The guides of `superhelix prepare`: chosen, kept apart, fitted, and watched at rest.

use std::sync::Arc;

use nalgebra::Vector3;
use serde::Serialize;
use superhelix::hair::{
    DrawnCurve, FitOptions, GroomStrand, GuideCandidates, GuideChoice, MovedApart, Represented, bring_out, move_apart,
};
use superhelix::render::resampled;
use superhelix::{BodyDef, ContactOptions, GroomOptions, Solver, SolverOptions, StrandContact, StrandId, Workers};

use super::arguments::PrepareArguments;
use super::head::Body;
use super::strands::Prepared;
use crate::groom::strands::{self as groom_strands, NaturalShape, Skipped};
use crate::shell::failure::Failure;
use crate::stepping::fitted::{FitReport, Resting};

/// Points at which curves are compared with what grows from the guides.
pub const COMPARED: usize = 31;
/// Numbers of guides, relative to the one asked for, of which the report says how well they represent.
const OTHER_NUMBERS: [f64; 3] = [0.25, 0.5, 2.0];
/// How long strands are watched at rest, s, and in how many steps.
const WATCHED: f64 = 1.0;
const STEPS: u32 = 60;
/// Points of a strand that are watched.
const SAMPLES: usize = 17;

/// How well guides represent the other strands.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct RepresentedReport {
    /// How many guides.
    pub guides: usize,
    /// How they were chosen.
    pub way: &'static str,
    /// Root mean square distance of the other strands' points from hair that grows from the guides at their roots, m.
    pub rms: f64,
    /// The root mean square distance that 95 of 100 strands do not exceed, m.
    pub p95: f64,
    /// That of the worst strand, m.
    pub worst: f64,
}

impl RepresentedReport {
    fn of(guides: usize, way: &'static str, represented: Represented) -> Self {
        let Represented { rms, p95, worst } = represented;
        Self { guides, way, rms, p95, worst }
    }
}

/// What was done to keep guides apart.
#[derive(Debug, Serialize)]
pub struct ApartReport {
    /// The radius that a guide has to others, m.
    pub radius: f64,
    /// Pairs of guides that were nearer than two radii, and how many still are.
    pub pairs: usize,
    /// See `pairs`.
    pub pairs_left: usize,
    /// How much nearer than two radii at most, m; before and after.
    pub deepest: f64,
    /// See `deepest`.
    pub deepest_left: f64,
    /// How far a point was moved at most, m.
    pub moved: f64,
}

/// How still the guides are that are to rest.
#[derive(Debug, Serialize)]
pub struct StillReport {
    /// How long they were watched, s.
    pub seconds: f64,
    /// Root mean square distance of their points from where they were prepared, in the end, m.
    pub rms: f64,
    /// The largest distance, m.
    pub max: f64,
    /// The strand (its index in the file) that has it.
    pub strand: usize,
}

/// What the report says of the guides.
#[derive(Debug, Serialize)]
pub struct GuidesReport {
    /// How many were asked for.
    pub asked: usize,
    /// Their indices in the file, in the order of the scene's strands.
    pub strands: Vec<usize>,
    /// How well they represent the others.
    pub represented: RepresentedReport,
    /// The ways of choosing that were tried.
    pub tried: Vec<RepresentedReport>,
    /// Other numbers of guides.
    pub other_numbers: Vec<RepresentedReport>,
    /// Kept apart.
    pub apart: ApartReport,
    /// The fit.
    pub fit: FitReport,
    /// Helical elements a strand: fewest and most.
    pub elements: [usize; 2],
    /// How they rest as drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resting: Option<Resting>,
    /// How still they are.
    pub still: StillReport,
}

/// Guides that can be simulated.
pub struct Guides {
    /// In the order of the scene.
    pub strands: Vec<GroomStrand>,
    /// What they are to contact.
    pub contact: StrandContact,
    /// Chosen guides that no strand could be made of.
    pub skipped: Vec<Skipped>,
    /// Hair that grows from them at the roots of the strands that may be guides, [`COMPARED`] points each, m.
    pub grown: Vec<[f32; 3]>,
    /// What the report says.
    pub report: GuidesReport,
}

/// Chooses guides among the strands that are clear of the head, and makes them what a solver takes.
pub fn make(
    arguments: &PrepareArguments,
    prepared: &Prepared,
    body: Option<&Body>,
    workers: &Workers,
    said: impl Fn(&str),
) -> Result<Guides, Failure> {
    let clear: Vec<&DrawnCurve> =
        prepared.curves.iter().zip(&prepared.clear).filter(|(_, clear)| **clear).map(|(curve, _)| curve).collect();
    if clear.is_empty() {
        return Err(Failure::file(&arguments.strands, "no strand is clear of the head"));
    }
    said("choosing guides ...");
    let counts: Vec<u32> = clear.iter().map(|curve| curve.points.len() as u32).collect();
    let points: Vec<Vector3<f64>> = clear.iter().flat_map(|curve| curve.points.iter().copied()).collect();
    let points = resampled(&points, &counts, None, COMPARED)?.points;
    let candidates = GuideCandidates::new(&points, COMPARED, workers.clone())?;
    let asked = arguments.guides as usize;
    let choice = candidates.choose(asked, arguments.material.seed())?;
    let other_numbers = other_numbers(&candidates, asked, arguments.material.seed())?;

    let hair = arguments.wisps.hair(arguments.material.groom()?)?;
    let [a1, a2] = hair.material.radius;
    let radius = a1.max(a2);
    let wisp_radius = arguments.wisps.wisp().radius(&arguments.material.groom()?.material);
    said("keeping guides apart ...");
    let mut curves: Vec<DrawnCurve> = choice.guides.iter().map(|guide| clear[*guide].clone()).collect();
    let apart = keep_apart(&mut curves, wisp_radius, radius, body)?;

    said("fitting guides ...");
    let options = GroomOptions {
        fit: FitOptions::elements(10),
        refine: true,
        stiffening: arguments.wisps.stiffening(NaturalShape::SagFree, &hair),
        gravity: arguments.up.gravity(),
        outside: body.map(|body| (&body.shape, radius)),
        ..hair.options()
    };
    let (strands, skipped) = groom_strands::make(&curves, &options, workers, || ())?;
    if strands.is_empty() {
        let why = skipped.first().map_or_else(|| "it has none".to_owned(), |skipped| skipped.because.clone());
        return Err(Failure::file(&arguments.strands, format!("no guide can be simulated: {why}")));
    }
    let touching = if arguments.hair_contact { wisp_radius } else { 0.0 };
    let contact = StrandContact { radius, wisp_radius: touching, ..arguments.material.contact()? };
    said("watching guides at rest ...");
    let still = watch(&strands, contact, arguments, body, workers)?;
    let elements = strands.iter().map(|strand| strand.definition.element_lengths.len());
    let report = GuidesReport {
        asked,
        strands: strands.iter().map(|strand| strand.index).collect(),
        represented: RepresentedReport::of(choice.guides.len(), choice.way.name(), choice.represented),
        tried: choice.tried.iter().map(|(way, of)| RepresentedReport::of(choice.guides.len(), way.name(), *of)).collect(),
        other_numbers,
        apart,
        fit: FitReport::of(&strands),
        elements: [elements.clone().min().unwrap_or(0), elements.max().unwrap_or(0)],
        resting: Resting::of(&strands, &options.material),
        still,
    };
    let grown = candidates.interpolated(&choice.guides)?;
    Ok(Guides { strands, contact, skipped, grown, report })
}

/// How well other numbers of guides would represent.
fn other_numbers(candidates: &GuideCandidates<'_>, asked: usize, seed: u64) -> Result<Vec<RepresentedReport>, Failure> {
    let mut reports = Vec::new();
    for factor in OTHER_NUMBERS {
        let number = (asked as f64 * factor).round() as usize;
        if number > 0 && number < candidates.count() {
            let GuideChoice { represented, way, .. } = candidates.choose(number, seed)?;
            reports.push(RepresentedReport::of(number, way.name(), represented));
        }
    }
    Ok(reports)
}

/// Moves guides apart that run through each other, and keeps them `radius` out of the head.
fn keep_apart(curves: &mut [DrawnCurve], wisp_radius: f64, radius: f64, body: Option<&Body>) -> Result<ApartReport, Failure> {
    let mut points: Vec<Vec<Vector3<f64>>> = curves.iter().map(|curve| curve.points.clone()).collect();
    let keep_out = |points: &mut Vec<Vector3<f64>>| match body {
        Some(body) => bring_out(points, &body.shape, radius).map(|_| ()),
        None => Ok(()),
    };
    for points in &mut points {
        keep_out(points)?;
    }
    let MovedApart { pairs, pairs_left, deepest, deepest_left, moved } =
        move_apart(&mut points, wisp_radius, |_, points| keep_out(points))?;
    for (curve, points) in curves.iter_mut().zip(points) {
        curve.points = points;
    }
    Ok(ApartReport { radius: wisp_radius, pairs, pairs_left, deepest, deepest_left, moved })
}

/// Lets the guides be, on a head that stands still.
fn watch(
    strands: &[GroomStrand],
    contact: StrandContact,
    arguments: &PrepareArguments,
    body: Option<&Body>,
    workers: &Workers,
) -> Result<StillReport, Failure> {
    let mut solver = Solver::new(SolverOptions {
        gravity: arguments.up.gravity(),
        workers: workers.clone(),
        contact: ContactOptions { hair: arguments.hair_contact, ..ContactOptions::default() },
        ..SolverOptions::default()
    })?;
    let definitions: Vec<_> = strands.iter().map(|strand| strand.definition.clone()).collect();
    let ids = solver.add_strands(&definitions)?;
    if body.is_some() || arguments.hair_contact {
        solver.set_contact(&ids, Some(&contact))?;
        let bodies = body.map(|body| BodyDef::new(Arc::new(body.shape.clone())));
        solver.add_bodies(bodies.into_iter().collect())?;
        solver.allow_overlaps(&ids)?;
    }
    let before = places(&solver, &ids)?;
    solver.step(WATCHED, STEPS)?;
    let after = places(&solver, &ids)?;
    let squares: Vec<f64> = before.iter().zip(&after).map(|(a, b)| (a - b).norm_squared()).collect();
    let mut worst = (0, 0.0);
    for (index, square) in squares.iter().enumerate() {
        if *square > worst.1 {
            worst = (index, *square);
        }
    }
    Ok(StillReport {
        seconds: WATCHED,
        rms: (squares.iter().sum::<f64>() / squares.len() as f64).sqrt(),
        max: worst.1.sqrt(),
        strand: strands[worst.0 / SAMPLES].index,
    })
}

fn places(solver: &Solver, ids: &[StrandId]) -> Result<Vec<Vector3<f64>>, Failure> {
    let mut points = vec![Vector3::zeros(); ids.len() * SAMPLES];
    solver.sample_strands(ids, SAMPLES, |strand, point, sample| points[strand * SAMPLES + point] = sample.position)?;
    Ok(points)
}
