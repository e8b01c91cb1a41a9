//! `superhelix simulate`: a groom on a moving head, to a cache and a picture.

use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};
use nalgebra::Vector3;
use superhelix::editing::coarse_strands;
use superhelix::hair::{FitOptions, GroomStrand};
use superhelix::io::{Curves, Motion, MotionOptions};
use superhelix::settings::{HairShape, Preset};
use superhelix::{
    Frame, GroomOptions, Integrator, LinearSolver, Precision, Solver, SolverOptions, StepOptions, StrandStatus, Workers,
};

use crate::argument_values::{named, not_negative, png, positive, triple};
use crate::failure::Failure;
use crate::film::Film;
use crate::groom_statistics::{GroomStatistics, Spread, is_plausible_length};
use crate::groom_strands::{self, NaturalShape};
use crate::head::Head;
use crate::material_arguments::MaterialArguments;
use crate::picture::view::{Face, Up};
use crate::report::Report;
use crate::resolution::Shapes;
use crate::rest_arguments::StiffeningArguments;
use crate::settings::preset;
use crate::simulate_body::{BodyArguments, HeadBody};
use crate::simulate_report::{DrawnInside, FitReport, Resting, SimulateReport};
use crate::style::Style;
use crate::wisp_arguments::WispArguments;
use crate::{progress, resolution, scene, settled, unit};

/// Simulates a groom on a moving head: fits strands, steps them, writes a cache of frames and a picture.
///
/// The head's motion moves all roots rigidly: a root at time t is M(t) M(0)^-1 applied to the groom's root, about the joint.
/// Strands that cannot be simulated (without length, shorter than wide) are left out and reported.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct SimulateArguments {
    /// The groom: .hair, .tfx, .obj with lines, .usda or .data, root first.
    #[arg(value_name = "GROOM")]
    pub groom: PathBuf,
    /// The head's motion: a .csv of poses or a .bvh. Without it the head stands still.
    #[arg(long, value_name = "HEAD.csv|.bvh")]
    pub motion: Option<PathBuf>,
    /// .bvh: name of the joint that carries the hair. Default: the first with "head" in its name.
    #[arg(long, value_name = "NAME", requires = "motion")]
    motion_joint: Option<String>,
    /// .bvh: metres a unit of the file. Default: 1.
    #[arg(long, value_name = "METRES", requires = "motion", value_parser = positive)]
    motion_scale: Option<f64>,
    /// The motion's axis that points up.
    #[arg(long, value_enum, value_name = "AXIS", default_value_t = Up::Y)]
    motion_up: Up,
    /// Where in the motion to begin, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, requires = "motion", value_parser = not_negative)]
    start: f64,
    /// Where the head's joint sits in the groom, file units. Default: the middle of the roots.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = triple)]
    pivot: Option<Vector3<f64>>,
    /// Metres a unit of the groom. Default: what the file says (.usda), else 1, refused when hair of that size could not be.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    scale: Option<f64>,
    /// The groom's axis that points up; gravity points the other way.
    #[arg(long, value_enum, value_name = "AXIS", default_value_t = Up::Y)]
    pub up: Up,
    /// Use each K-th strand only.
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Settings by name: preview, balanced or accurate. Flags given beside it win.
    #[arg(long, value_name = "NAME", value_parser = preset)]
    preset: Option<Preset>,
    /// Helical elements a strand. Default: 10, or the preset's for the curl of nine tenths of the strands; more for each strand whose sharpest stretch
    /// needs them.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    elements: Option<u32>,
    /// Natural shape of the strands.
    #[arg(long, value_enum, value_name = "SHAPE", default_value_t = NaturalShape::SagFree)]
    natural: NaturalShape,
    #[command(flatten)]
    stiffening: StiffeningArguments,
    #[command(flatten)]
    wisps: WispArguments,
    /// Start the strands at rest in their static equilibrium under gravity, searched for from the groom's shape.
    #[arg(long)]
    settle: bool,
    /// Uniform wind, m/s.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = triple)]
    wind: Option<Vector3<f64>>,
    #[command(flatten)]
    pub bodies: BodyArguments,
    #[command(flatten)]
    pub material: MaterialArguments,
    /// Frames a second.
    #[arg(long, default_value_t = 30.0, value_parser = positive)]
    pub fps: f64,
    /// Seconds to simulate. Default: to the motion's end.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    duration: Option<f64>,
    /// Steps a frame. Default: 2, or the preset's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    substeps: Option<u32>,
    /// Time integrator. Default: second_order.
    #[arg(long, value_parser = integrator)]
    integrator: Option<Integrator>,
    /// Linear solver.
    #[arg(long, default_value = "linear_time", value_parser = linear_solver)]
    solver: LinearSolver,
    /// Precision of the arithmetic: f64 or f32 (docs/theory/lanes.md). Default: f64.
    #[arg(long, value_parser = precision)]
    precision: Option<Precision>,
    /// Newton's tolerance, rad. Default: 1e-4, or the preset's.
    #[arg(long, value_name = "RAD", value_parser = positive)]
    tolerance: Option<f64>,
    /// Newton iterations a step at most. Default: 50, or the preset's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    max_iterations: Option<u32>,
    /// How often a strand's step may be halved where it does not converge or errs too much, 0 to 10. Default: 3, or the preset's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=10))]
    max_subdivisions: Option<u32>,
    /// The error that a step may add to a point's position, in lengths of the strand, before it is halved. Default: not looked at.
    #[arg(long, value_name = "LENGTHS", value_parser = positive)]
    error_tolerance: Option<f64>,
    /// Integrator reference: the error allowed in positions, in lengths of the strand, a second; 1e-12 to 1e-2. Default: 1e-8.
    #[arg(long, value_name = "LENGTHS", value_parser = positive)]
    reference_tolerance: Option<f64>,
    /// What integrals along an element may err by, relative; 1e-12 to 1e-2. Default: 1e-4, or the preset's.
    #[arg(long, value_name = "SHARE", value_parser = positive)]
    quadrature_tolerance: Option<f64>,
    /// Threads.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=256))]
    pub threads: u32,
    /// Directory of the cache: one file a frame, in the groom's units.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Format of the cache: a file a frame (obj, hair), or one file hair.usda with velocities.
    #[arg(long, value_enum, default_value_t = Format::Obj)]
    pub format: Format,
    /// Points a strand in the cache and in the picture.
    #[arg(long, value_name = "N", default_value_t = 33, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub samples: u32,
    /// Replace the frames that the directory already holds.
    #[arg(long, requires = "out")]
    pub overwrite: bool,
    /// A contact sheet of the motion.
    #[arg(long, value_name = "FILE.png", value_parser = png)]
    pub picture: Option<PathBuf>,
    /// The axis that the face looks along, for the contact sheet. Default: where the head is bare if there is a --body and
    /// that is clear, else +z where y is up, -y where z is up.
    #[arg(long, value_enum, value_name = "AXIS", allow_hyphen_values = true)]
    pub face: Option<Face>,
    /// Moments on the contact sheet.
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub moments: u32,
    /// The report as JSON on standard output.
    #[arg(long)]
    json: bool,
    /// Neither progress bar nor warnings.
    #[arg(long, short)]
    quiet: bool,
}

/// Format of a cache.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Wavefront OBJ lines.
    Obj,
    /// Cem Yuksel's .hair.
    Hair,
    /// One USD text file with time samples and velocities.
    Usda,
}

fn integrator(text: &str) -> Result<Integrator, String> {
    named(text, &scene::INTEGRATORS)
}

fn linear_solver(text: &str) -> Result<LinearSolver, String> {
    named(text, &scene::LINEAR_SOLVERS)
}

fn precision(text: &str) -> Result<Precision, String> {
    named(text, &scene::PRECISIONS)
}

/// Most frames of a run: nine hours of film at 30 a second.
const MOST_FRAMES: f64 = 1e6;

/// Runs the command.
pub fn run(arguments: &SimulateArguments) -> Result<(), Failure> {
    let begun = Instant::now();
    groom_strands::check_stiffening(arguments.natural, &arguments.stiffening, &arguments.material)?;
    let (motion, duration) = read_motion(arguments)?;
    let frame_count = count_frames(duration, arguments.fps)?;
    let curves = Curves::read(&arguments.groom)?;
    arguments.up.check_groom(&arguments.groom, &curves)?;
    let scale = choose_scale(arguments, &curves)?;
    let fineness = Fineness::choose(arguments, &curves)?;
    let body = arguments.bodies.read(scale, arguments.quiet)?;
    let hair = arguments.wisps.hair(arguments.material.groom()?)?;
    let contact = arguments.bodies.contact(arguments.material.contact()?, &hair.material);
    let held = arguments.wisps.stiffening(arguments.natural, &hair);
    let recipe = GroomOptions {
        fit: FitOptions::elements(fineness.elements as usize),
        refine: arguments.elements.is_none(),
        natural: arguments.natural.into(),
        stiffening: arguments.stiffening.stiffening().or(held),
        gravity: arguments.up.gravity(),
        quadrature_tolerance: fineness.step.quadrature_tolerance,
        outside: body.as_ref().filter(|_| arguments.bodies.brings_out()).map(|body| (body.shape(), contact.radius)),
        ..hair.options()
    };
    let workers = if arguments.threads == 1 { Workers::Serial } else { Workers::Pool(arguments.threads as usize) };
    let mut solver = Solver::new(SolverOptions {
        gravity: recipe.gravity,
        wind: arguments.wind.unwrap_or(Vector3::zeros()),
        step: StepOptions { linear_solver: arguments.solver, ..fineness.step },
        workers: workers.clone(),
        instruction_set: None,
        contact: arguments.bodies.options(),
        ..SolverOptions::default()
    })?;

    let polylines = unit::drawn(&curves, arguments.every as usize, scale);
    let bar = progress::bar(polylines.len() as u64, "strands fitted", arguments.quiet);
    let (mut strands, skipped) = groom_strands::make(&polylines, &recipe, &workers, || bar.inc(1))?;
    bar.finish_and_clear();
    if strands.is_empty() {
        let why = skipped.first().map_or_else(|| "the file has none".to_string(), |skipped| skipped.because.clone());
        return Err(Failure::file(&arguments.groom, format!("no strand can be simulated: {why}")));
    }
    drop(polylines);

    let at_start: Vec<Frame> = strands.iter().map(|strand| strand.definition.root).collect();
    let joint = match arguments.pivot {
        Some(pivot) => pivot * scale,
        None => at_start.iter().map(|root| root.origin).sum::<Vector3<f64>>() / at_start.len() as f64,
    };
    // A motion's clock may begin anywhere: --start counts from its first sample.
    let start = arguments.start + motion.as_ref().map_or(0.0, |motion| motion.times()[0]);
    let head = Head::new(motion, start, joint);
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
    let body_id = arguments.bodies.begin(&mut solver, &ids, contact, body.as_ref())?;
    let mut style = Style::new(body.as_ref().map(HeadBody::shape), arguments.fps);

    let mut film = Film::create(arguments, scale, ids.len(), frame_count, fineness.elements)?;
    let preparing_seconds = begun.elapsed().as_secs_f64();
    let mut report = Report::default();
    let mut quarantined = vec![false; ids.len()];
    let bar = progress::bar(frame_count as u64, "frames", arguments.quiet);
    let mut roots = Vec::with_capacity(at_start.len());
    film.take(&solver, &ids, 0, || body.as_ref().map(|body| body.surface(&head, 0.0)))?;
    style.look(&solver, &ids, &HeadBody::pose(&head, 0.0))?;
    bar.inc(1);
    let step = 1.0 / (arguments.fps * f64::from(fineness.substeps));
    for frame in 1..frame_count {
        for substep in 0..fineness.substeps {
            let steps = (frame - 1) as f64 * f64::from(fineness.substeps) + f64::from(substep) + 1.0;
            head.roots(steps * step, &at_start, &mut roots);
            solver.set_root_frames(&ids, &roots, step)?;
            if let Some(id) = body_id {
                solver.set_body_frames(&[id], &[HeadBody::pose(&head, steps * step)], step)?;
            }
            let outcome = solver.step(step, 1)?;
            if outcome.quarantined > 0 {
                for (flag, id) in quarantined.iter_mut().zip(&ids) {
                    *flag |= solver.status(*id)? == StrandStatus::Quarantined;
                }
            }
            report.add(&outcome);
        }
        let elapsed = frame as f64 / arguments.fps;
        film.take(&solver, &ids, frame, || body.as_ref().map(|body| body.surface(&head, elapsed)))?;
        style.look(&solver, &ids, &HeadBody::pose(&head, elapsed))?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    let (cache_frames, picture) = film.finish(arguments, &strands, scale)?;

    report.contact = report.contact.filter(|_| arguments.bodies.touches());
    let style = style.report();
    let turns = coarse_strands(strands.iter().map(|strand| &strand.definition), Shapes::Initial).len();
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
        resting: Resting::of(&strands, &recipe.material),
        drawn_inside: DrawnInside::of(&strands),
        skipped,
        fit: FitReport {
            rms_metres: Spread::of(strands.iter().map(|strand| strand.fit_error.0).collect()),
            max_metres: Spread::of(strands.iter().map(|strand| strand.fit_error.1).collect()),
            strands_with_coarse_elements: turns,
        },
        settled,
        body: body.map(|body| body.report),
        frames: frame_count,
        time_step: step,
        simulated_seconds: (frame_count - 1) as f64 / arguments.fps,
        style,
        report,
        quarantined_strands: quarantined
            .iter()
            .zip(&strands)
            .filter(|(flag, _)| **flag)
            .map(|(_, strand)| strand.index)
            .collect(),
        preparing_seconds,
        total_seconds: begun.elapsed().as_secs_f64(),
        cache_frames,
        cache: arguments.out.as_ref().map(|path| path.display().to_string()),
        picture: picture.map(|path| path.display().to_string()),
    };
    crate::print_answer(arguments.json, &answer, || answer.in_words())
}

/// Frames of a run, the one at the start included.
fn count_frames(duration: f64, fps: f64) -> Result<usize, Failure> {
    let frames = (duration * fps + 1e-9).floor() + 1.0;
    if frames > MOST_FRAMES {
        return Err(Failure::Other(format!(
            "{duration} s at {fps} frames a second are {frames:.0} frames; expected {MOST_FRAMES} at most"
        )));
    }
    Ok(frames as usize)
}

/// The motion in the groom's axes, and how long to simulate.
fn read_motion(arguments: &SimulateArguments) -> Result<(Option<Motion>, f64), Failure> {
    let Some(path) = &arguments.motion else {
        let duration = arguments
            .duration
            .ok_or_else(|| Failure::Other("without --motion, --duration must say how long to simulate".into()))?;
        return Ok((None, duration));
    };
    let options = MotionOptions { joint: arguments.motion_joint.clone(), metres_per_unit: arguments.motion_scale };
    let motion = Motion::read_with(path, &options)?;
    let motion = match (arguments.motion_up, arguments.up) {
        (Up::Y, Up::Z) => motion.to_z_up(),
        (Up::Z, Up::Y) => {
            return Err(Failure::Other("--motion-up z with --up y is not in this version: turn the groom to z up".into()));
        }
        _ => motion,
    };
    let left = motion.duration() - arguments.start;
    if left <= 0.0 {
        let length = motion.duration();
        return Err(Failure::Other(format!("--start is {}; expected less than the motion's {length} s", arguments.start)));
    }
    Ok((Some(motion), arguments.duration.unwrap_or(left)))
}

/// Median lengths of hair that are taken where a unit is stated, m.
const POSSIBLE_LENGTHS: std::ops::RangeInclusive<f64> = 1e-3..=3.0;

/// Metres a file unit. Not given, it is 1, unless strands of that size could not be hair.
fn choose_scale(arguments: &SimulateArguments, curves: &Curves) -> Result<f64, Failure> {
    let statistics = GroomStatistics::of(curves);
    let stated = unit::stated(arguments.scale, curves);
    let Some(length) = statistics.length else { return Ok(stated.unwrap_or(1.0)) };
    if let Some(scale) = stated {
        let median = length.median * scale;
        if median > 0.0 && !POSSIBLE_LENGTHS.contains(&median) {
            let who = if arguments.scale.is_some() { "--scale" } else { "the file's unit" };
            let reason =
                format!("with {scale} m a unit ({who}) the median strand is {median} m long; expected hair of 1 mm to 3 m");
            return Err(Failure::file(&arguments.groom, reason));
        }
        return Ok(scale);
    }
    if is_plausible_length(length.median) {
        return Ok(1.0);
    }
    let hint = statistics
        .scale_guess
        .map_or_else(String::new, |guess| format!("; a guess is {} ({})", guess.metres_per_unit, guess.because));
    Err(Failure::file(
        &arguments.groom,
        format!(
            "taken as metres, the median strand is {} m long: give --scale, the metres a unit of this file{hint}",
            length.median
        ),
    ))
}

/// How fine: what the flags say, else the preset, else this command's own defaults.
struct Fineness {
    step: StepOptions,
    substeps: u32,
    elements: u32,
}

impl Fineness {
    fn choose(arguments: &SimulateArguments, curves: &Curves) -> Result<Self, Failure> {
        let (mut step, mut substeps, mut elements) = (StepOptions { tolerance: 1e-4, ..StepOptions::default() }, 2, 10);
        if let Some(preset) = arguments.preset {
            // The turns of a strand do not depend on the unit of its file.
            let turning = GroomStatistics::of(curves).turning_degrees.map_or(0.0, |turning| turning.p90.to_radians());
            let settings = preset.settings(&HairShape { curvature: turning, length: 1.0 }, 1.0 / arguments.fps)?;
            (step, substeps, elements) = (settings.step, settings.substeps, settings.elements);
        }
        step.integrator = arguments.integrator.unwrap_or(step.integrator);
        step.precision = arguments.precision.unwrap_or(step.precision);
        step.tolerance = arguments.tolerance.unwrap_or(step.tolerance);
        step.max_subdivisions = arguments.max_subdivisions.unwrap_or(step.max_subdivisions);
        step.error_tolerance = arguments.error_tolerance.unwrap_or(step.error_tolerance);
        step.reference_tolerance = arguments.reference_tolerance.unwrap_or(step.reference_tolerance);
        step.quadrature_tolerance = arguments.quadrature_tolerance.unwrap_or(step.quadrature_tolerance);
        step.max_iterations = arguments.max_iterations.unwrap_or(step.max_iterations);
        Ok(Self { step, substeps: arguments.substeps.unwrap_or(substeps), elements: arguments.elements.unwrap_or(elements) })
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
