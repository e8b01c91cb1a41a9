//! The scenes of the soak: strands drawn at random, and bodies that fly through them.

use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::shapes::Sides;
use superhelix::{
    BodyDef, BodyId, ContactModel, Frame, Friction, Integrator, Shape, Solver, SolverOptions, StepReport, StrandContact,
    StrandDef, StrandId,
};

/// Steps with bodies, and then without them, of a scene of a few strands and of one of many.
const STEPS: (u32, u32) = (60, 40);
const STEPS_OF_MANY: (u32, u32) = (36, 24);

/// Random numbers (SplitMix64).
struct Dice(u64);

impl Dice {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    fn log_between(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }
    fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[(self.unit() * of.len() as f64) as usize]
    }
    fn ball(&mut self) -> Vector3<f64> {
        loop {
            let v = Vector3::from_fn(|_, _| self.between(-1.0, 1.0));
            if v.norm() <= 1.0 {
                return v;
            }
        }
    }
    fn turn(&mut self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_scaled_axis(self.ball() * 3.0)
    }
}

fn shape(dice: &mut Dice) -> Shape {
    let size = dice.log_between(2e-3, 5e-2);
    match dice.pick(&[0, 1, 2, 3, 4, 5]) {
        0 => Shape::new_sphere(size).unwrap(),
        1 => Shape::new_capsule(dice.ball() * 0.1, dice.ball() * 0.1, dice.log_between(5e-4, 1e-2)).unwrap(),
        2 => Shape::new_ellipsoid(Vector3::from_fn(|_, _| size * dice.between(0.4, 1.0))).unwrap(),
        3 => Shape::new_box(Vector3::from_fn(|_, _| size * dice.between(0.3, 1.0))).unwrap(),
        4 => Shape::new_hull(&(0..12).map(|_| dice.ball() * size).collect::<Vec<_>>()).unwrap(),
        _ => {
            // A tetrahedron as a mesh, wound outward.
            let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
            let vertices = corners.iter().map(|c| Vector3::from(*c) * size).collect();
            Shape::new_mesh(vertices, vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]], Sides::Solid).unwrap()
        }
    }
}

/// Strands and the bodies that fly through them.
pub struct Scene {
    pub many: bool,
    pub solver: Solver,
    pub strands: Vec<StrandId>,
    /// With their poses, their velocities, m/s, and their spins, rad/s.
    pub bodies: Vec<(BodyId, Frame, Vector3<f64>, Vector3<f64>)>,
    pub model: ContactModel,
    /// s.
    pub step: f64,
}

fn strands(dice: &mut Dice) -> Vec<StrandDef> {
    let count = 1 + (dice.unit() * 6.0) as usize;
    let one = |dice: &mut Dice| {
        let elements = 2 + (dice.unit() * 12.0) as usize;
        let mut def = StrandDef::straight(dice.between(0.05, 0.3), elements);
        def.material.youngs_modulus = dice.log_between(1e7, 5e9);
        def.material.internal_friction = dice.log_between(1e-11, 1e-8);
        def.material.air_drag = dice.log_between(1e-6, 1e-4);
        let curl = dice.log_between(1.0, 60.0);
        def.natural = vec![[dice.between(-0.3, 0.3) * curl, curl, 0.0]; elements];
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), dice.between(1.2, 1.9));
        def.root = Frame { origin: dice.ball() * 0.02, rotation };
        def
    };
    (0..count).map(|_| one(dice)).collect()
}

/// Twenty-five to sixty strands in a few wisps that hang beside each other, the strands of a wisp alike and just apart at their roots; and the radius that
/// each of them has.
fn wisps(dice: &mut Dice) -> (Vec<StrandDef>, f64) {
    let count = 25 + (dice.unit() * 36.0) as usize;
    let groups = 1 + (dice.unit() * 5.0) as usize;
    let elements = 3 + (dice.unit() * 6.0) as usize;
    let (radius, length) = (dice.log_between(4e-4, 1.5e-3), dice.between(0.06, 0.2));
    let (stiffness, friction, drag) = (dice.log_between(1e8, 5e9), dice.log_between(1e-11, 1e-9), dice.log_between(1e-6, 1e-4));
    let curl = dice.log_between(1.0, 30.0);
    // Rows of roots a little more than touching, and wisps that bend a little differently.
    let (apart, row) = (radius * dice.between(2.05, 2.6), (count as f64).sqrt().ceil() as usize);
    let bends: Vec<[f64; 3]> = (0..groups)
        .map(|_| [0.1 * curl * dice.between(-1.0, 1.0), curl * dice.between(0.7, 1.0), curl * dice.between(-0.3, 0.3)])
        .collect();
    let one = |k: usize, dice: &mut Dice| {
        let mut def = StrandDef::straight(length * dice.between(0.85, 1.0), elements);
        def.material.youngs_modulus = stiffness;
        def.material.internal_friction = friction;
        def.material.air_drag = drag;
        let bend = bends[k * groups / count].map(|bend| bend * dice.between(0.9, 1.1));
        def.natural = vec![bend; elements];
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 1.57);
        let place = |k: usize| (k as f64 - 0.5 * row as f64) * apart;
        def.root = Frame { origin: Vector3::new(place(k % row), place(k / row), 0.0), rotation };
        def
    };
    ((0..count).map(|k| one(k, dice)).collect(), radius)
}

fn scene(dice: &mut Dice, many: bool) -> Scene {
    let model = dice.pick(&[ContactModel::Penalty, ContactModel::RegularisedPenalty, ContactModel::Coulomb]);
    let mut options = SolverOptions::default();
    options.step.integrator = dice.pick(&[Integrator::ImplicitEuler, Integrator::SecondOrder]);
    options.contact.model = model;
    options.contact.hair = many || dice.unit() < 0.4;
    let mut solver = Solver::new(options).unwrap();
    let (defs, wisp_radius) = if many { wisps(dice) } else { (strands(dice), dice.log_between(1e-4, 3e-3)) };
    let strands = solver.add_strands(&defs).unwrap();
    let contact = StrandContact {
        wisp_radius,
        friction: Friction { along: dice.between(0.0, 0.6), against: dice.between(0.0, 0.9) },
        hair_friction: Friction { along: dice.between(0.0, 0.5), against: dice.between(0.0, 0.8) },
        exempt_length: 0.005,
        ..StrandContact::default()
    };
    solver.set_contact(&strands, Some(&contact)).unwrap();
    let step = dice.pick(&[1.0 / 30.0, 1.0 / 60.0, 1.0 / 120.0]);
    let mut bodies = Vec::new();
    for _ in 0..1 + (dice.unit() * 3.0) as usize {
        // From outside everything, through the hair, at up to 3 m/s and with a spin.
        let away = dice.ball().normalize() * dice.between(0.15, 0.3) - Vector3::new(0.0, 0.0, 0.1);
        let aim = Vector3::new(0.0, 0.0, -0.1) + dice.ball() * 0.08;
        let velocity = (aim - away).normalize() * dice.log_between(0.2, 4.0);
        let pose = Frame { origin: away, rotation: dice.turn() };
        let def = BodyDef { pose, thickness: dice.pick(&[0.0, 5e-4]), ..BodyDef::new(Arc::new(shape(dice))) };
        let id = solver.add_bodies(vec![def]).unwrap()[0];
        bodies.push((id, pose, velocity, dice.ball() * dice.log_between(0.1, 20.0)));
    }
    Scene { many, solver, strands, bodies, model, step }
}

impl Scene {
    /// How many steps it takes with bodies, and then without them.
    pub fn steps(&self) -> (u32, u32) {
        if self.many { STEPS_OF_MANY } else { STEPS }
    }

    /// The ids of the bodies.
    pub fn body_ids(&self) -> Vec<BodyId> {
        self.bodies.iter().map(|body| body.0).collect()
    }

    /// Takes a step in which the bodies fly on.
    pub fn throw(&mut self) -> StepReport {
        let ids = self.body_ids();
        let frames: Vec<Frame> = self
            .bodies
            .iter_mut()
            .map(|(_, pose, velocity, spin)| {
                pose.origin += *velocity * self.step;
                pose.rotation = UnitQuaternion::from_scaled_axis(*spin * self.step) * pose.rotation;
                *pose
            })
            .collect();
        self.solver.set_body_frames(&ids, &frames, self.step).unwrap();
        self.solver.step(self.step, 1).unwrap()
    }
}

/// The scene of a number, and its name.
pub fn case_of(case: u64, many: bool) -> (Scene, String) {
    let scene = scene(&mut Dice(case), many);
    let name = format!("case {case} ({} strands, {:?}, h = 1/{:.0})", scene.strands.len(), scene.model, 1.0 / scene.step);
    (scene, name)
}
