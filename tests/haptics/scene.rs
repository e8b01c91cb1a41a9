//! Hair that hangs from a row of follicles, a comb of seven teeth, and paths of the hand.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::haptic::{Device, HapticOptions, HapticState, Mode, Tool, haptic};
use superhelix::{BodyDef, BodyId, Frame, Material, Shape, Solver, SolverOptions, StrandContact, StrandDef, Wrench};

/// The device's rate, s.
pub const TICK: f64 = 1e-3;
/// Where the comb waits beside the hair.
pub const OUTSIDE: f64 = -0.06;
const TEETH: usize = 7;

/// The follicle of a hair: 2 mm from the next, in rows of 20. The tangent, the first axis, hangs down; and each hair is turned about it otherwise.
pub fn follicle(k: usize) -> Frame {
    let origin = Vector3::new(4e-3 * (k / 20) as f64, 2e-3 * (k % 20) as f64, 0.0);
    let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5 * PI);
    let about = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.7 * k as f64);
    Frame { origin, rotation: down * about }
}

/// The teeth of the comb, 6 mm apart.
pub fn comb(pose: Frame) -> Vec<BodyDef> {
    let tooth = |k: usize| {
        let end = |x: f64| Vector3::new(x, 6e-3 * (k as f64 - 0.5 * (TEETH - 1) as f64), 0.0);
        let shape = Shape::new_capsule(end(-0.03), end(0.05), 1e-3).unwrap();
        BodyDef { pose, ..BodyDef::new(Arc::new(shape)) }
    };
    (0..TEETH).map(tooth).collect()
}

/// `strands` hairs of 15 cm and five elements, 2 mm from each other in rows of 20, of some natural curvature, at rest; and the teeth.
pub fn combed_hair(strands: usize, curvature: f64) -> (Solver, Vec<BodyId>) {
    combed_strands(strands, curvature, Material::default().radius)
}

/// The same, of strands of some radius, m.
pub fn combed_strands(strands: usize, curvature: f64, radius: [f64; 2]) -> (Solver, Vec<BodyId>) {
    let mut options = SolverOptions::default();
    options.step.tolerance = 1e-5;
    let mut solver = Solver::new(options).unwrap();
    let defs: Vec<StrandDef> = (0..strands)
        .map(|k| {
            let mut def = StrandDef::straight(0.15, 5);
            def.natural = vec![[0.0, curvature, 0.3 * curvature]; 5];
            def.material = Material { radius, viscosity: 2e-3, air_drag: 1e-5, internal_friction: 1e-10, ..Material::default() };
            def.root = follicle(k);
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    solver.set_contact(&ids, Some(&StrandContact { exempt_length: 0.01, ..StrandContact::default() })).unwrap();
    let teeth = solver.add_bodies(comb(stroke(0.0))).unwrap();
    for _ in 0..60 {
        solver.step(1.0 / 60.0, 1).unwrap();
    }
    (solver, teeth)
}

/// Into the hair within 0.4 s, down through it by 14 cm until 1.4 s.
pub fn stroke(t: f64) -> Frame {
    let smooth = |part: f64| 0.5 * (1.0 - (PI * part.clamp(0.0, 1.0)).cos());
    let origin = Vector3::new(OUTSIDE * (1.0 - smooth(t / 0.4)), 0.019, -0.03 - 0.14 * smooth((t - 0.4) / 1.0));
    Frame { origin, ..Frame::default() }
}

/// A path and its velocities, by differences.
pub fn motion(way: impl Fn(f64) -> Frame, t: f64) -> (Frame, Vector3<f64>, Vector3<f64>) {
    let (now, before) = (way(t), way(t - TICK));
    let turn = (now.rotation * before.rotation.inverse()).scaled_axis();
    (now, (now.origin - before.origin) / TICK, turn / TICK)
}

/// The forces on the hand, one per update.
pub type Felt = Vec<(Wrench, HapticState)>;

/// A hand leads the comb while the solver steps at the device's rate.
pub fn direct(scene: &mut (Solver, Vec<BodyId>), way: impl Fn(f64) -> Frame, seconds: f64, options: &HapticOptions) -> Felt {
    let options = HapticOptions { mode: Mode::Direct, ..*options };
    let (solver, teeth) = scene;
    let (mut tool, mut device) = haptic(solver, teeth, &options).unwrap();
    (0..(seconds / TICK) as usize)
        .map(|tick| {
            let (pose, velocity, spin) = motion(&way, tick as f64 * TICK);
            let felt = device.update(&pose, velocity, spin, TICK).unwrap();
            tool.before_step(solver, TICK).unwrap();
            solver.step(TICK, 1).unwrap();
            tool.after_step(solver).unwrap();
            felt
        })
        .collect()
}

/// How the simulation beside a device goes: steps a second, substeps of each, and how late it hands over, s.
#[derive(Debug, Clone, Copy)]
pub struct Rate {
    pub rate: f64,
    pub substeps: u32,
    pub late: f64,
}

impl Rate {
    pub fn new(rate: f64, late: f64) -> Self {
        Self { rate, substeps: 1, late }
    }
}

/// The simulation beside a device: it begins a step every `step` seconds, and hands over `late` seconds after that.
pub struct Simulation {
    pub solver: Solver,
    pub tool: Tool,
    step: f64,
    substeps: u32,
    late: f64,
    next: f64,
    done_at: Option<f64>,
    /// When each step began, and what hair did to the tool at its end.
    pub steps: Vec<(f64, Vector3<f64>)>,
}

impl Simulation {
    pub fn new(scene: (Solver, Vec<BodyId>), rate: Rate, options: &HapticOptions) -> (Self, Device) {
        let Rate { rate, substeps, late } = rate;
        let (solver, teeth) = scene;
        let (tool, device) = haptic(&solver, &teeth, options).unwrap();
        (Self { solver, tool, step: 1.0 / rate, substeps, late, next: 0.0, done_at: None, steps: Vec::new() }, device)
    }

    /// Goes on until the device's time `t`.
    pub fn until(&mut self, t: f64) {
        if self.done_at.is_some_and(|done| t >= done - 1e-9) {
            self.tool.after_step(&mut self.solver).unwrap();
            self.done_at = None;
        }
        if t >= self.next - 1e-9 && self.done_at.is_none() {
            self.tool.before_step(&mut self.solver, self.step).unwrap();
            self.solver.step(self.step, self.substeps).unwrap();
            let force = self.tool.bodies().iter().map(|id| self.solver.body_wrench(*id).unwrap().force).sum();
            self.steps.push((t, force));
            self.next += self.step;
            if self.late == 0.0 {
                self.tool.after_step(&mut self.solver).unwrap();
            } else {
                self.done_at = Some(t + self.late);
            }
        }
    }
}

/// A hand leads the comb while the solver steps at a rate of its own.
pub fn handed_over(
    scene: (Solver, Vec<BodyId>),
    way: impl Fn(f64) -> Frame,
    seconds: f64,
    rate: Rate,
    options: &HapticOptions,
) -> Felt {
    handed_over_and_simulated(scene, way, seconds, rate, options).0
}

/// The same, and the forces at the simulation's own steps, by the time of the pose that they were taken with.
pub fn handed_over_and_simulated(
    scene: (Solver, Vec<BodyId>),
    way: impl Fn(f64) -> Frame,
    seconds: f64,
    rate: Rate,
    options: &HapticOptions,
) -> (Felt, Vec<(f64, Vector3<f64>)>) {
    let (mut simulation, mut device) = Simulation::new(scene, rate, options);
    let felt = (0..(seconds / TICK) as usize)
        .map(|tick| {
            let t = tick as f64 * TICK;
            let (pose, velocity, spin) = motion(&way, t);
            let felt = device.update(&pose, velocity, spin, TICK).unwrap();
            simulation.until(t);
            felt
        })
        .collect();
    (felt, simulation.steps)
}

/// A small reproducible source of numbers in [0, 1).
pub struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}
