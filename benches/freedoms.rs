//! The cost of two freedoms per element (twist and bending about the soft axis) beside three: free hair, and hair under a comb.
//! The two take turns, step by step, so that other programs affect both alike.
//!
//! `cargo bench --profile demo --bench freedoms`: ratios of one thread's processor time, medians over the steps.
//! `cargo bench … -- --steps free|comb BITS COUNT`: that many steps and nothing else, for callgrind.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use rustix::time::{ClockId, clock_gettime};
use superhelix::hair::HairType;
use superhelix::{
    BodyDef, BodyId, Frame, Freedoms, InstructionSet, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId,
};

const TEETH: usize = 7;

/// Hair on rows of follicles, and what moves there.
struct Scene {
    solver: Solver,
    strands: Vec<StrandId>,
    roots: Vec<Frame>,
    teeth: Vec<BodyId>,
    step: f64,
    time: f64,
}

/// `count` hairs of 15 cm, 2 mm from each other in rows of 20; with a `comb` or free, roots swaying.
fn scene(comb: bool, count: usize, elements: usize, freedoms: Freedoms, set: Option<InstructionSet>) -> Scene {
    let mut options = SolverOptions { instruction_set: set, ..SolverOptions::default() };
    options.step.tolerance = 1e-5;
    if !comb {
        // The same number of iterations for both.
        (options.step.max_iterations, options.step.tolerance, options.step.max_subdivisions) = (3, f64::MIN_POSITIVE, 0);
    }
    let mut solver = Solver::new(options).expect("a solver");
    let hair = HairType::Ga1.measured();
    let defs: Vec<StrandDef> = (0..count)
        .map(|k| {
            let mut def = StrandDef::straight(0.15, elements);
            def.natural = vec![[2.0, 15.0, 0.0]; elements];
            def.material = superhelix::Material { viscosity: 2e-3, ..hair.material() };
            def.freedoms = freedoms;
            let origin = Vector3::new(4e-3 * (k / 20) as f64, 2e-3 * (k % 20) as f64, 0.0);
            let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5 * PI);
            let about = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.7 * k as f64);
            def.root = Frame { origin, rotation: down * about };
            def
        })
        .collect();
    let strands = solver.add_strands(&defs).expect("strands");
    let mut teeth = Vec::new();
    if comb {
        let contact = StrandContact { exempt_length: 0.01, ..StrandContact::default() };
        solver.set_contact(&strands, Some(&contact)).expect("contact");
        let tooth = |k: usize| {
            let end = |x: f64| Vector3::new(x, 6e-3 * (k as f64 - 0.5 * (TEETH - 1) as f64), 0.0);
            let shape = Shape::new_capsule(end(-0.03), end(0.05), 1e-3).expect("a tooth");
            BodyDef { pose: stroke(0.0), ..BodyDef::new(Arc::new(shape)) }
        };
        teeth = solver.add_bodies((0..TEETH).map(tooth).collect()).expect("teeth");
        for _ in 0..60 {
            solver.step(1.0 / 60.0, 1).expect("a step");
        }
    }
    let step = if comb { 1e-3 } else { 1.0 / 60.0 };
    Scene { solver, strands, roots: defs.iter().map(|def| def.root).collect(), teeth, step, time: 0.0 }
}

/// Into the hair within 0.4 s, down through it by 14 cm until 1.4 s.
fn stroke(t: f64) -> Frame {
    let smooth = |part: f64| 0.5 * (1.0 - (PI * part.clamp(0.0, 1.0)).cos());
    let origin = Vector3::new(-0.06 * (1.0 - smooth(t / 0.4)), 0.019, -0.03 - 0.14 * smooth((t - 0.4) / 1.0));
    Frame { origin, ..Frame::default() }
}

impl Scene {
    /// One step; returns its iterations per strand.
    fn step(&mut self) -> f64 {
        self.time += self.step;
        if self.teeth.is_empty() {
            let aside = Vector3::new(0.02 * (2.0 * PI * self.time).sin(), 0.0, 0.0);
            let frames: Vec<Frame> = self.roots.iter().map(|root| Frame { origin: root.origin + aside, ..*root }).collect();
            self.solver.set_root_frames(&self.strands, &frames, self.step).expect("roots");
        } else {
            let frames = vec![stroke(self.time); self.teeth.len()];
            self.solver.set_body_frames(&self.teeth, &frames, self.step).expect("teeth");
        }
        self.solver.step(self.step, 1).expect("a step").mean_iterations
    }
}

fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn compare(name: &str, comb: bool, count: usize, elements: usize, steps: usize, set: Option<InstructionSet>) {
    let sets = [Freedoms::ALL, Freedoms::TWIST.union(Freedoms::BEND1)];
    let mut scenes = sets.map(|freedoms| scene(comb, count, elements, freedoms, set));
    let mut took = [Vec::new(), Vec::new()];
    let mut iterations = [0.0, 0.0];
    for _ in 0..steps {
        for (k, scene) in scenes.iter_mut().enumerate() {
            let began = processor_seconds();
            iterations[k] += scene.step();
            took[k].push(processor_seconds() - began);
        }
    }
    let sums = took.each_ref().map(|list| list.iter().sum::<f64>());
    let [three, two] = took.each_mut().map(|list| median(list));
    println!(
        "{name}: three {:.3} ms, two {:.3} ms a step (median); ratio of medians {:.3}, of sums {:.3}; iterations a strand {:.2}, {:.2}",
        1e3 * three,
        1e3 * two,
        two / three,
        sums[1] / sums[0],
        iterations[0] / steps as f64,
        iterations[1] / steps as f64
    );
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(at) = arguments.iter().position(|a| a == "--steps") {
        let [kind, bits, count, ..] = &arguments[at + 1..] else { panic!("--steps free|comb BITS COUNT") };
        let freedoms = Freedoms::from_bits("BITS", bits.parse().expect("BITS")).expect("BITS");
        let comb = kind == "comb";
        // Valgrind does not support AVX-512.
        let mut scene = scene(comb, if comb { 100 } else { 96 }, if comb { 5 } else { 10 }, freedoms, Some(InstructionSet::Avx2));
        let iterations: f64 = (0..count.parse().expect("COUNT")).map(|_| scene.step()).sum();
        println!("{iterations}");
        return;
    }
    compare("free, 96 strands of 10 elements", false, 96, 10, 600, None);
    compare("free, 96 strands of 10 elements, scalar", false, 96, 10, 200, Some(InstructionSet::Scalar));
    compare("free, 96 strands of 5 elements", false, 96, 5, 600, None);
    compare("comb, 100 strands of 5 elements", true, 100, 5, 1400, None);
    compare("comb, 100 strands of 16 elements", true, 100, 16, 700, None);
}
