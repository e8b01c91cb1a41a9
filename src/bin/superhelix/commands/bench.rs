//! `superhelix bench`: what the engine costs on this machine, on one card.

use std::hint::black_box;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use clap::Args;
use nalgebra::{UnitQuaternion, Vector3};
use serde::Serialize;
use superhelix::reading::{SampleSink, Tile, Wanted};
use superhelix::{Frame, InstructionSet, Material, Precision, Solver, SolverOptions, StrandDef, StrandId, Workers};

use crate::shell::failure::Failure;

/// Frames a second.
const FRAME_RATE: f64 = 60.0;
/// Strands of a measurement: enough to fill the vector registers and the threads.
const STRANDS: usize = 512;
/// Points that a strand is sampled at.
const SAMPLES: usize = 16;
/// Steps before the clock starts, after which the motion is under way, and steps a sample.
const WARM_UP: u32 = 12;
const STEPS: u32 = 4;
/// Samples at least: their median is reported.
const AT_LEAST: usize = 3;

/// Measures what the engine costs on this machine, in about ten seconds: 512 strands of wavy hair on a walking head, the default
/// integrator (second order) at 60 frames a second, to the default tolerance.
#[derive(Debug, Args)]
pub struct BenchArguments {
    /// Seconds for each of the rows (at least three samples are taken).
    #[arg(long, value_name = "S", default_value_t = 0.5, value_parser = crate::shell::argument_values::positive)]
    seconds: f64,
    /// Most threads to use. Default: as many as the machine runs at a time.
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    /// The answer as JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Card {
    version: &'static str,
    instruction_set: &'static str,
    threads: usize,
    strands: usize,
    frame_rate: f64,
    steps: Vec<StepRow>,
    sampling: SamplingRow,
}

#[derive(Debug, Serialize)]
struct StepRow {
    elements: usize,
    precision: &'static str,
    threads: usize,
    /// Newton iterations a strand and step.
    iterations: f64,
    /// Wall-clock time of a step over the strands.
    microseconds_per_strand_and_step: f64,
    /// Strands whose steps take a frame's time.
    strands_in_real_time: f64,
    /// Strand-steps that did not reach the tolerance, of all.
    unconverged_share: f64,
}

#[derive(Debug, Serialize)]
struct SamplingRow {
    points_per_strand: usize,
    microseconds_per_strand: f64,
    million_points_per_second: f64,
}

/// Runs the command.
pub fn run(arguments: &BenchArguments) -> Result<(), Failure> {
    let most =
        arguments.threads.map_or_else(|| std::thread::available_parallelism().map_or(1, usize::from).min(256), usize::from);
    let time = Duration::from_secs_f64(arguments.seconds);
    let mut steps = Vec::new();
    let mut sampling = None;
    for threads in if most > 1 { vec![1, most] } else { vec![1] } {
        for elements in [5, 10, 20] {
            for precision in [Precision::F64, Precision::F32] {
                let mut head = Head::new(elements, precision, threads)?;
                steps.push(head.measure(time)?);
                if threads == 1 && elements == 10 && precision == Precision::F64 {
                    sampling = Some(head.measure_sampling(time)?);
                }
            }
        }
    }
    let card = Card {
        version: env!("CARGO_PKG_VERSION"),
        instruction_set: InstructionSet::detected().name(),
        threads: most,
        strands: STRANDS,
        frame_rate: FRAME_RATE,
        steps,
        sampling: sampling.ok_or_else(|| Failure::Other("nothing was sampled".into()))?,
    };
    crate::shell::answer::print_answer(arguments.json, &card, || in_words(&card))
}

fn in_words(card: &Card) -> String {
    let mut text = format!(
        "superhelix {}, {} instructions, {} threads; {} strands on a walking head, second order, {} frames a second\n\n",
        card.version, card.instruction_set, card.threads, card.strands, card.frame_rate
    );
    text += "elements  precision  threads  iterations  us a strand-step  strands in real time\n";
    for row in &card.steps {
        text += &format!(
            "{:8}  {:>9}  {:7}  {:10.2}  {:16.2}  {:20.0}\n",
            row.elements,
            row.precision,
            row.threads,
            row.iterations,
            row.microseconds_per_strand_and_step,
            row.strands_in_real_time
        );
    }
    text += &format!(
        "\nsampling, one thread: {:.1} million points a second ({} a strand)",
        card.sampling.million_points_per_second, card.sampling.points_per_strand
    );
    text
}

/// A walking head, by formula: 1.2 m/s forwards, up and down twice a second, left and right once, turning with the steps. y up.
fn walking(time: f64) -> Frame {
    let phase = std::f64::consts::TAU * time;
    let yaw = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.08 * phase.sin());
    let nod = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.03 * (2.0 * phase).cos());
    let origin = Vector3::new(0.02 * phase.sin(), 1.6 + 0.02 * (2.0 * phase).sin(), 1.2 * time);
    Frame { origin, rotation: yaw * nod }
}

/// The walking head with its hair.
struct Head {
    solver: Solver,
    ids: Vec<StrandId>,
    follicles: Vec<Frame>,
    elements: usize,
    precision: Precision,
    threads: usize,
    steps: u32,
}

impl Head {
    fn new(elements: usize, precision: Precision, threads: usize) -> Result<Self, Failure> {
        let mut options = SolverOptions { gravity: Vector3::new(0.0, -9.81, 0.0), ..SolverOptions::default() };
        options.step.precision = precision;
        options.workers = if threads > 1 { Workers::Pool(threads) } else { Workers::Serial };
        let mut solver = Solver::new(options)?;
        let follicles: Vec<_> = (0..STRANDS).map(follicle).collect();
        let strands: Vec<_> = follicles.iter().enumerate().map(|(index, follicle)| strand(index, follicle, elements)).collect();
        let ids = solver.add_strands(&strands)?;
        let mut head = Self { solver, ids, follicles, elements, precision, threads, steps: 0 };
        head.take(WARM_UP)?;
        Ok(head)
    }

    /// Seconds, iterations and unconverged strand-steps of some steps.
    fn take(&mut self, steps: u32) -> Result<(f64, f64, f64), Failure> {
        let (mut seconds, mut iterations, mut unconverged) = (0.0, 0.0, 0.0);
        for _ in 0..steps {
            self.steps += 1;
            let head = walking(f64::from(self.steps) / FRAME_RATE);
            let roots: Vec<_> = self.follicles.iter().map(|follicle| head.compose(follicle)).collect();
            self.solver.set_root_frames(&self.ids, &roots, 1.0 / FRAME_RATE)?;
            let report = self.solver.step(1.0 / FRAME_RATE, 1)?;
            seconds += report.seconds;
            iterations += report.mean_iterations;
            unconverged += f64::from(report.unconverged + report.quarantined);
        }
        Ok((seconds, iterations, unconverged))
    }

    fn measure(&mut self, time: Duration) -> Result<StepRow, Failure> {
        let started = Instant::now();
        let mut samples = Vec::new();
        let (mut iterations, mut unconverged) = (0.0, 0.0);
        while samples.len() < AT_LEAST || started.elapsed() < time {
            let sample = self.take(STEPS)?;
            samples.push(sample.0 / f64::from(STEPS));
            iterations += sample.1;
            unconverged += sample.2;
        }
        let steps = samples.len() as f64 * f64::from(STEPS);
        let seconds = median(&mut samples) / STRANDS as f64;
        Ok(StepRow {
            elements: self.elements,
            precision: if self.precision == Precision::F64 { "f64" } else { "f32" },
            threads: self.threads,
            iterations: iterations / steps,
            microseconds_per_strand_and_step: 1e6 * seconds,
            strands_in_real_time: 1.0 / FRAME_RATE / seconds,
            unconverged_share: unconverged / steps / STRANDS as f64,
        })
    }

    fn measure_sampling(&self, time: Duration) -> Result<SamplingRow, Failure> {
        let started = Instant::now();
        let mut samples = Vec::new();
        let wanted =
            Wanted { points_per_strand: SAMPLES, origin: Vector3::zeros(), positions: true, rotations: false, velocities: false };
        let sink = Positions((0..STRANDS * SAMPLES).map(|_| Default::default()).collect());
        while samples.len() < AT_LEAST || started.elapsed() < time {
            let clock = Instant::now();
            self.solver.sample_tiles::<f32>(&self.ids, &wanted, &sink)?;
            black_box(&sink);
            samples.push(clock.elapsed().as_secs_f64());
        }
        let seconds = median(&mut samples) / STRANDS as f64;
        Ok(SamplingRow {
            points_per_strand: SAMPLES,
            microseconds_per_strand: 1e6 * seconds,
            million_points_per_second: 1e-6 * SAMPLES as f64 / seconds,
        })
    }
}

/// The positions of all points, as the bits of f32: memory that any thread may write.
struct Positions(Vec<[AtomicU32; 3]>);

impl SampleSink<f32> for Positions {
    fn take(&self, tile: &Tile<f32>) {
        for (lane, strand) in tile.strands.iter().enumerate() {
            for (point, position) in tile.positions.iter().enumerate() {
                let to = &self.0[*strand as usize * SAMPLES + tile.first + point];
                for axis in 0..3 {
                    to[axis].store(position[axis][lane].to_bits(), Ordering::Relaxed);
                }
            }
        }
    }
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// A number in [0, 1) for a strand: the golden ratio's multiples, so that any few neighbours are spread evenly.
fn spread(index: usize, multiple: f64) -> f64 {
    ((index + 1) as f64 * multiple * 0.618_033_988_749_894_8).fract()
}

/// Where a strand grows: a spiral over the upper half of a sphere of 9 cm; hair leaves between outwards and downwards.
fn follicle(index: usize) -> Frame {
    let height = (index as f64 + 0.5) / STRANDS as f64;
    let around = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 2.399_963_229_728_653 * index as f64);
    let origin = around * Vector3::new(0.09 * (1.0 - height * height).sqrt(), 0.09 * height, 0.0);
    let lift = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), height.asin() - 0.9);
    Frame { origin, rotation: around * lift }
}

/// 25 cm of wavy hair with the dissipation of Bertails et al. 2006.
fn strand(index: usize, follicle: &Frame, elements: usize) -> StrandDef {
    let mut def = StrandDef::straight(0.25, elements);
    def.material = Material { internal_friction: 1e-10, air_drag: 5e-6, ..Material::default() };
    def.natural = vec![[6.0 * spread(index, 1.0), 5.0 + 20.0 * spread(index, 7.0), 0.0]; elements];
    def.root = walking(0.0).compose(follicle);
    let (h, next) = (1e-4, walking(1e-4).compose(follicle));
    def.root_velocity = (next.origin - def.root.origin) / h;
    def.root_angular_velocity = (next.rotation * def.root.rotation.inverse()).scaled_axis() / h;
    def
}
