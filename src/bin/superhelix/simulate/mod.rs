//! `superhelix simulate`: a groom on a moving head, to a cache and a picture.
//!
//! Files:
//!
//! - `arguments.rs`: The flags of `superhelix simulate`.
//! - `body.rs`: `superhelix simulate`: what the hair touches.
//! - `cache.rs`: The cache of `superhelix simulate`: a file a frame, or one file with velocities.
//! - `duration.rs`: How long a run of `superhelix simulate` is, and the motion that it follows.
//! - `film.rs`: The frames of `superhelix simulate` on their way out: to the cache, and some of them to the picture.
//! - `fineness.rs`: How fine `superhelix simulate` is: time step, substeps, elements.
//! - `report.rs`: What `superhelix simulate` tells afterwards.
//! - `style.rs`: How a groom's style held: where strands are beside where they were drawn, in the frame of the head that carries them.

pub mod arguments;
mod body;
mod cache;
mod duration;
mod film;
mod fineness;
mod report;
mod style;

use std::time::Instant;

use nalgebra::Vector3;
use superhelix::hair::{FitOptions, GroomStrand};
use superhelix::io::Curves;
use superhelix::{
    BodyId, Frame, GroomOptions, Material, Solver, SolverOptions, StepOptions, StrandContact, StrandId, StrandStatus, Workers,
};

use self::arguments::SimulateArguments;
use self::body::HeadBody;
use self::duration::{count_frames, read_motion, warn_of_duration};
use self::film::Film;
use self::fineness::Fineness;
use self::report::SimulateReport;
use self::style::Style;
use crate::groom::statistics::GroomStatistics;
use crate::groom::strands::{self as groom_strands, Skipped};
use crate::groom::unit as groom_unit;
use crate::shell::answer::print_answer;
use crate::shell::failure::Failure;
use crate::shell::progress;
use crate::stepping::fitted::{FitReport, Resting};
use crate::stepping::head::Head;
use crate::stepping::report::Report;
use crate::stepping::resolution::{self, Shapes};
use crate::stepping::settled;

/// Runs the command.
pub fn run(arguments: &SimulateArguments) -> Result<(), Failure> {
    let begun = Instant::now();
    groom_strands::check_stiffening(arguments.natural, &arguments.stiffening, &arguments.material)?;
    let (motion, duration) = read_motion(arguments)?;
    let frame_count = count_frames(duration, arguments.fps)?;
    warn_of_duration(arguments, frame_count);
    let curves = Curves::read(&arguments.groom)?;
    arguments.up.check_groom(&arguments.groom, &curves)?;
    let statistics = GroomStatistics::of(&curves);
    let stated = groom_unit::stated(arguments.scale, &curves);
    let scale = groom_unit::plausible(&arguments.groom, &statistics, stated, arguments.scale.is_some())?;
    let fineness = Fineness::choose(arguments, &curves)?;
    let body = arguments.bodies.read(scale, arguments.quiet)?;
    let Made { mut solver, mut strands, skipped, material, contact } =
        make_strands(arguments, &curves, scale, &fineness, body.as_ref())?;

    let at_start: Vec<Frame> = strands.iter().map(|strand| strand.definition.root).collect();
    let head = arguments.head_motion.head(motion, at_start.iter().map(|root| root.origin), scale);
    for strand in &mut strands {
        let definition = &mut strand.definition;
        (definition.root_velocity, definition.root_angular_velocity) = head.velocity_at_start(&definition.root);
    }
    warn(arguments, &strands, skipped.len());
    let mut definitions: Vec<_> = strands.iter().map(|strand| strand.definition.clone()).collect();
    let settled = arguments.settle.then(|| settled::settle(&mut definitions, solver.options())).transpose()?;
    if let Some(settled) = settled.filter(|_| !arguments.quiet) {
        settled.warn(&arguments.groom.display().to_string(), definitions.len());
    }
    let ids = solver.add_strands(&definitions)?;
    let (body_id, drawn_inside) = arguments.bodies.begin(&mut solver, &ids, &strands, contact, body.as_ref())?;
    if let (Some(drawn), Some(body), false) = (&drawn_inside, &body, arguments.quiet) {
        let to_keep = "--allow-overlaps (--drawn-inside kept)";
        drawn.warn(&arguments.groom.display().to_string(), strands.len(), &body.report.mesh, to_keep);
    }
    let mut style = Style::new(body.as_ref().map(HeadBody::shape), arguments.fps);

    let mut film = Film::create(arguments, scale, ids.len(), frame_count, fineness.elements)?;
    let preparing_seconds = begun.elapsed().as_secs_f64();
    let bar = progress::bar(frame_count as u64, "frames", arguments.quiet);
    let step = 1.0 / (arguments.fps * f64::from(fineness.substeps));
    let quarantined = vec![false; ids.len()];
    let substeps = fineness.substeps;
    let mut run = Run { solver, ids, body_id, head, at_start, step, substeps, quarantined, report: Report::default() };
    for frame in 0..frame_count {
        if frame > 0 {
            run.advance_to(frame)?;
        }
        let elapsed = frame as f64 / arguments.fps;
        film.take(&run.solver, &run.ids, frame, || body.as_ref().map(|body| body.surface(&run.head, elapsed)))?;
        style.look(&run.solver, &run.ids, &HeadBody::pose(&run.head, elapsed))?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    let (cache_frames, picture) = film.finish(arguments, &strands, scale)?;

    let Run { mut report, quarantined, .. } = run;
    report.contact = report.contact.filter(|_| arguments.bodies.touches());
    let style = style.report();
    let quarantined = quarantined.iter().zip(&strands).filter(|(flag, _)| **flag);
    let answer = SimulateReport {
        version: 1,
        groom: arguments.groom.display().to_string(),
        format: curves.format().name(),
        metres_per_unit: scale,
        strands_in_file: curves.strand_count(),
        strands: strands.len(),
        elements: fineness.elements,
        most_elements: strands.iter().map(|strand| strand.definition.element_lengths.len()).max().unwrap_or(0),
        wisps: arguments.wisps.report(),
        resting: Resting::of(&strands, &material),
        drawn_inside,
        skipped,
        fit: FitReport::of(&strands),
        settled,
        body: body.map(|body| body.report),
        frames: frame_count,
        time_step: step,
        simulated_seconds: (frame_count - 1) as f64 / arguments.fps,
        style,
        report,
        quarantined_strands: quarantined.map(|(_, strand)| strand.index).collect(),
        preparing_seconds,
        total_seconds: begun.elapsed().as_secs_f64(),
        cache_frames,
        cache: arguments.out.as_ref().map(|path| path.display().to_string()),
        picture: picture.map(|path| path.display().to_string()),
    };
    print_answer(arguments.json, &answer, || answer.in_words())
}

/// The strands of a groom, and the solver that will have them.
struct Made {
    solver: Solver,
    strands: Vec<GroomStrand>,
    skipped: Vec<Skipped>,
    /// What the strands are made of where they need not be stiffer.
    material: Material,
    contact: StrandContact,
}

/// Makes strands of the groom's curves as the flags say; at least one.
fn make_strands(
    arguments: &SimulateArguments,
    curves: &Curves,
    scale: f64,
    fineness: &Fineness,
    body: Option<&HeadBody>,
) -> Result<Made, Failure> {
    let hair = arguments.wisps.hair(arguments.material.groom()?)?;
    let contact = arguments.bodies.contact(arguments.material.contact()?, &hair.material);
    let held = arguments.wisps.stiffening(arguments.natural, &hair);
    let options = GroomOptions {
        fit: FitOptions::elements(fineness.elements as usize),
        refine: arguments.elements.is_none(),
        natural: arguments.natural.into(),
        stiffening: arguments.stiffening.stiffening().or(held),
        gravity: arguments.up.gravity(),
        quadrature_tolerance: fineness.step.quadrature_tolerance,
        outside: body.filter(|_| arguments.bodies.brings_out()).map(|body| (body.shape(), contact.radius)),
        ..hair.options()
    };
    let workers = if arguments.threads == 1 { Workers::Serial } else { Workers::Pool(arguments.threads as usize) };
    let solver = Solver::new(SolverOptions {
        gravity: options.gravity,
        wind: arguments.wind.unwrap_or(Vector3::zeros()),
        step: StepOptions { linear_solver: arguments.solver, ..fineness.step },
        workers: workers.clone(),
        contact: arguments.bodies.options(),
        ..SolverOptions::default()
    })?;

    let drawn = groom_unit::drawn(curves, arguments.every as usize, scale);
    let bar = progress::bar(drawn.len() as u64, "strands fitted", arguments.quiet);
    let (strands, skipped) = groom_strands::make(&drawn, &options, &workers, || bar.inc(1))?;
    bar.finish_and_clear();
    if strands.is_empty() {
        let why = skipped.first().map_or_else(|| "the file has none".to_string(), |skipped| skipped.because.clone());
        return Err(Failure::file(&arguments.groom, format!("no strand can be simulated: {why}")));
    }
    Ok(Made { solver, strands, skipped, material: options.material, contact })
}

/// A run on its way from frame to frame.
struct Run {
    solver: Solver,
    ids: Vec<StrandId>,
    body_id: Option<BodyId>,
    head: Head,
    at_start: Vec<Frame>,
    /// Seconds a substep.
    step: f64,
    /// Substeps a frame.
    substeps: u32,
    /// Which strands were quarantined in any substep.
    quarantined: Vec<bool>,
    report: Report,
}

impl Run {
    /// Steps from the frame before to this one.
    fn advance_to(&mut self, frame: usize) -> Result<(), Failure> {
        let mut roots = Vec::with_capacity(self.at_start.len());
        for substep in 0..self.substeps {
            let steps = (frame - 1) as f64 * f64::from(self.substeps) + f64::from(substep) + 1.0;
            let time = steps * self.step;
            self.head.roots(time, &self.at_start, &mut roots);
            self.solver.set_root_frames(&self.ids, &roots, self.step)?;
            if let Some(id) = self.body_id {
                self.solver.set_body_frames(&[id], &[HeadBody::pose(&self.head, time)], self.step)?;
            }
            let outcome = self.solver.step(self.step, 1)?;
            if outcome.quarantined > 0 {
                for (flag, id) in self.quarantined.iter_mut().zip(&self.ids) {
                    *flag |= self.solver.status(*id)? == StrandStatus::Quarantined;
                }
            }
            self.report.add(&outcome);
        }
        Ok(())
    }
}

fn warn(arguments: &SimulateArguments, strands: &[GroomStrand], skipped: usize) {
    if arguments.quiet {
        return;
    }
    if skipped > 0 {
        eprintln!(
            "warning: {}: {skipped} strands cannot be simulated and are left out (--json lists them)",
            arguments.groom.display()
        );
    }
    resolution::warn(strands.iter().map(|strand| &strand.definition), Shapes::Initial, |index| {
        format!("{}: strand {}", arguments.groom.display(), strands[index].index)
    });
}
