//! The engine beside its peers: takes one request per line from standard input, and answers each with one line (JSON both).
//! `benches/peers/run.py` sends the requests, and sends the peers' programs the same ones (`wire.py` documents them). By hand:
//!
//! `echo '{...}' | cargo bench --profile demo --bench peers -- --serve`

use std::io::{BufRead, Write as _};
use std::time::{Duration, Instant};

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use rustix::time::{ClockId, clock_gettime};
use serde_json::{Value, json};
use superhelix::{Integrator, Material, Solver, SolverOptions, StrandDef, StrandId};

/// Points of a strand to return for comparison.
const POINTS: usize = 65;
/// Points for measuring its length: the chords between them are short by 4·10⁻⁵ of it on a coil of ten turns.
const FINE_POINTS: usize = 2001;

type Answer<T> = Result<T, String>;

fn number(request: &Value, key: &str) -> Answer<f64> {
    request[key].as_f64().ok_or_else(|| format!("{key}: a number is missing"))
}

fn count(request: &Value, key: &str) -> Answer<usize> {
    request[key].as_u64().map(|value| value as usize).ok_or_else(|| format!("{key}: a whole number is missing"))
}

/// Processor time of this thread so far.
fn processor_time() -> Duration {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    Duration::new(now.tv_sec as u64, now.tv_nsec as u32)
}

/// The strand of a case: turns of a helix about +x that passes through the origin, clamped along its own tangent; straight
/// without turns.
fn strand(case: &Value, elements: usize) -> Answer<StrandDef> {
    let (length, radius, turns) = (number(case, "length")?, number(case, "helix_radius")?, number(case, "turns")?);
    let mut def = StrandDef::straight(length, elements);
    def.material = Material {
        radius: [number(case, "radius")?; 2],
        density: number(case, "density")?,
        youngs_modulus: number(case, "youngs_modulus")?,
        poisson_ratio: number(case, "poisson_ratio")?,
        ..Material::default()
    };
    let angle = 2.0 * std::f64::consts::PI * turns / length;
    let slope = radius * angle;
    let rise = (1.0 - slope * slope).sqrt();
    def.natural = vec![[rise * angle, 0.0, slope * angle]; elements];
    let (n0, n1) = (Vector3::new(rise, 0.0, slope), -Vector3::y());
    let frame = Matrix3::from_columns(&[n0, n1, n0.cross(&n1)]);
    def.root.rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(frame));
    Ok(def)
}

fn options(request: &Value) -> Answer<SolverOptions> {
    let settings = &request["settings"];
    let mut options =
        SolverOptions { gravity: Vector3::new(0.0, 0.0, -number(&request["case"], "gravity")?), ..SolverOptions::default() };
    options.step.integrator = match settings["integrator"].as_str() {
        Some("second order") => Integrator::SecondOrder,
        Some("implicit Euler") => Integrator::ImplicitEuler,
        Some("linearly implicit") => Integrator::LinearlyImplicit,
        Some("reference") => Integrator::Reference,
        other => return Err(format!("settings.integrator: {other:?} is none of the four")),
    };
    if let Some(tolerance) = settings["tolerance"].as_f64() {
        options.step.tolerance = tolerance;
        options.step.reference_tolerance = tolerance.clamp(1e-12, 1e-2);
    }
    if let Some(cap) = settings["cap"].as_u64() {
        options.step.max_iterations = u32::try_from(cap).map_err(|error| error.to_string())?;
    }
    if let Some(error) = settings["error_tolerance"].as_f64() {
        (options.step.error_tolerance, options.step.max_subdivisions) = (error, 5);
    }
    Ok(options)
}

struct World {
    solver: Solver,
    ids: Vec<StrandId>,
    length: f64,
    step: f64,
    iterations: f64,
    unconverged: u32,
    quarantined: u32,
}

impl World {
    fn new(request: &Value) -> Answer<Self> {
        let def = strand(&request["case"], count(request, "elements")?)?;
        let mut solver = Solver::new(options(request)?).map_err(|error| error.to_string())?;
        let ids = solver.add_strands(&vec![def.clone(); count(request, "strands")?]).map_err(|error| error.to_string())?;
        let step = 1.0 / number(request, "rate")?;
        Ok(Self { solver, ids, length: def.length(), step, iterations: 0.0, unconverged: 0, quarantined: 0 })
    }

    fn advance(&mut self, steps: usize) -> Answer<()> {
        for _ in 0..steps {
            let report = self.solver.step(self.step, 1).map_err(|error| error.to_string())?;
            self.iterations += report.mean_iterations;
            self.unconverged += report.unconverged;
            self.quarantined += report.quarantined;
        }
        Ok(())
    }

    fn points(&self, strand: usize, points: usize) -> Answer<Vec<[f64; 3]>> {
        let mut out = Vec::with_capacity(points);
        self.solver
            .sample_strands(&self.ids[strand..=strand], points, |_, _, sample| out.push(sample.position.into()))
            .map_err(|error| error.to_string())?;
        Ok(out)
    }

    /// The length along the sampled centreline, relative to the true one.
    fn relative_length(&self) -> Answer<f64> {
        let points = self.points(0, FINE_POINTS)?;
        let chords = points.windows(2).map(|pair| (Vector3::from(pair[1]) - Vector3::from(pair[0])).norm());
        Ok(chords.sum::<f64>() / self.length)
    }
}

/// Runs of `records` times `every` steps: the tip after each record, and the seconds of each run.
fn measure(request: &Value) -> Answer<Value> {
    let (records, every) = (count(request, "records")?, count(request, "every")?);
    let (patience, least, most) = (number(request, "patience")?, count(request, "least_runs")?, count(request, "most_runs")?);
    let (mut processor, mut wall) = (Vec::<f64>::new(), Vec::<f64>::new());
    let (mut tips, mut lengths) = (Vec::new(), Vec::new());
    let mut last = None;
    while processor.len() < least || (processor.iter().sum::<f64>() < patience && processor.len() < most) {
        let mut world = World::new(request)?;
        let (mut processor_seconds, mut wall_seconds) = (0.0, 0.0);
        for _ in 0..records {
            let (processor_start, wall_start) = (processor_time(), Instant::now());
            world.advance(every)?;
            wall_seconds += wall_start.elapsed().as_secs_f64();
            processor_seconds += (processor_time() - processor_start).as_secs_f64();
            if last.is_none() {
                tips.push(world.points(0, 2)?[1]);
                lengths.push(world.relative_length()?);
            }
        }
        processor.push(processor_seconds);
        wall.push(wall_seconds);
        last.get_or_insert(world);
    }
    let world = last.ok_or("least_runs: at least one")?;
    let spread = (0..world.ids.len()).try_fold(0.0_f64, |most, strand| {
        Ok::<_, String>(most.max((Vector3::from(world.points(strand, 2)?[1]) - Vector3::from(world.points(0, 2)?[1])).norm()))
    })?;
    Ok(json!({
        "processor": processor, "wall": wall, "tips": tips, "lengths": lengths, "spread": spread,
        "iterations": world.iterations / (records * every) as f64,
        "unconverged": world.unconverged, "quarantined": world.quarantined,
    }))
}

/// One run; the points before and after the last step of each record.
fn watch(request: &Value) -> Answer<Value> {
    let (records, every) = (count(request, "records")?, count(request, "every")?);
    let mut world = World::new(request)?;
    let start = world.points(0, POINTS)?;
    let (mut pairs, mut lengths) = (Vec::new(), Vec::new());
    for _ in 0..records {
        world.advance(every - 1)?;
        let before = world.points(0, POINTS)?;
        world.advance(1)?;
        pairs.push([before, world.points(0, POINTS)?]);
        lengths.push(world.relative_length()?);
    }
    Ok(json!({
        "start": start, "pairs": pairs, "lengths": lengths,
        "unconverged": world.unconverged, "quarantined": world.quarantined,
    }))
}

fn answer(line: &str) -> Answer<Value> {
    let request: Value = serde_json::from_str(line).map_err(|error| error.to_string())?;
    match request["do"].as_str() {
        Some("measure") => measure(&request),
        Some("watch") => watch(&request),
        // The cost of an empty call: there is no language between this program and the engine.
        Some("overhead") => Ok(json!({ "seconds": 0.0, "version": env!("CARGO_PKG_VERSION") })),
        other => Err(format!("do: {other:?} is neither measure, watch nor overhead")),
    }
}

fn main() {
    if !std::env::args().any(|argument| argument == "--serve") {
        println!("peers: started by benches/peers/run.py (`make peers`), which speaks to it over standard input");
        return;
    }
    let mut out = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let line = line.expect("a line");
        let reply = answer(&line).unwrap_or_else(|error| json!({ "error": error }));
        writeln!(out, "{reply}").and_then(|()| out.flush()).expect("standard output");
    }
}
