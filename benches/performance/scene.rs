//! The timed scenes: y up, steps of 1/60 s.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::natural_under_gravity;
use superhelix::io::Motion;
use superhelix::{Frame, Freedoms, Material, StrandDef};

/// Seconds per step.
pub const STEP: f64 = 1.0 / 60.0;
/// Gravity, m/s².
pub const GRAVITY: Vector3<f64> = Vector3::new(0.0, -9.81, 0.0);
/// The number of distinct strands of a crowd; the others repeat them.
const KINDS: usize = 97;

/// How the roots move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scene {
    /// 0.2 m of gently bent hair that hangs at rest by its natural shape; the root sways by ±1 cm at ½ Hz.
    Sway,
    /// 0.25 m of nearly straight hair on a head shaken by ±46° of yaw and ±8 cm at 2 Hz (as in `tests/integrators/hard_cases.rs`).
    Shake,
    /// 0.25 m of wavy hair all over the scalp of a head on a recorded walk (`tests/data/grooms/walk_figure8_head.csv`).
    Walk,
}

impl Scene {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Scene::Sway => "sway",
            Scene::Shake => "shake",
            Scene::Walk => "walk",
        }
    }
}

/// Hair of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hair {
    /// Elements per strand.
    pub elements: usize,
    /// Free curvatures.
    pub freedoms: Freedoms,
    /// Air drag, kg/(m·s).
    pub air_drag: f64,
    /// Internal friction, kg·m³/s.
    pub internal_friction: f64,
    /// Kelvin–Voigt time, s.
    pub viscosity: f64,
}

impl Hair {
    /// Hair with the dissipation of Bertails et al. 2006: internal friction and drag.
    pub fn of(elements: usize) -> Self {
        Self { elements, freedoms: Freedoms::ALL, air_drag: 5e-6, internal_friction: 1e-10, viscosity: 0.0 }
    }

    /// Hair with Kelvin–Voigt friction, which the linearly implicit step treats implicitly: it is then stable at 1/60 s in the
    /// calm scene.
    pub fn viscous(elements: usize) -> Self {
        Self { internal_friction: 0.0, viscosity: 10e-3, ..Self::of(elements) }
    }

    fn material(&self) -> Material {
        Material {
            internal_friction: self.internal_friction,
            air_drag: self.air_drag,
            viscosity: self.viscosity,
            ..Material::default()
        }
    }
}

/// A scene with its motion.
pub struct Stage {
    scene: Scene,
    walk: Option<Motion>,
    follicles: Vec<Frame>,
}

/// A number in [0, 1) per strand: multiples of the golden ratio, so that any few neighbours are spread evenly.
fn spread(index: usize, multiple: f64) -> f64 {
    ((index + 1) as f64 * multiple * 0.618_033_988_749_894_8).fract()
}

impl Stage {
    /// The scene for this many strands.
    pub fn new(scene: Scene, strands: usize) -> Self {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/grooms/walk_figure8_head.csv");
        let walk = (scene == Scene::Walk).then(|| Motion::read(path, None).expect("the walk"));
        let follicles = (0..strands).map(|index| follicle(scene, index, strands)).collect();
        Self { scene, walk, follicles }
    }

    /// The roots at a time, s.
    pub fn roots(&self, time: f64) -> Vec<Frame> {
        let head = self.head(time);
        self.follicles.iter().map(|follicle| head.compose(follicle)).collect()
    }

    fn head(&self, t: f64) -> Frame {
        let turn = std::f64::consts::TAU;
        match (self.scene, &self.walk) {
            (_, Some(motion)) => motion.at(motion.times()[0] + t),
            (Scene::Shake, _) => {
                let swing = (2.0 * turn * t).sin() * (1.0 - (-(4.0 * t).powi(2)).exp());
                Frame {
                    origin: Vector3::new(0.0, 0.0, -0.08 * swing),
                    rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.8 * swing),
                }
            }
            _ => Frame { origin: Vector3::new(0.01 * (0.5 * turn * t).sin(), 0.0, 0.0), ..Frame::default() },
        }
    }

    /// The strands at time 0.
    pub fn strands(&self, hair: &Hair) -> Vec<StrandDef> {
        let count = self.follicles.len();
        let roots = self.roots(0.0);
        let (before, h) = (self.roots(1e-4), 1e-4);
        let kinds = KINDS.min(count);
        let shapes: Vec<_> = (0..kinds).map(|index| self.shape(hair, index, roots[index])).collect();
        (0..count)
            .map(|index| {
                let mut def = shapes[index % kinds].clone();
                def.root = roots[index];
                def.root_velocity = (before[index].origin - roots[index].origin) / h;
                def.root_angular_velocity = (before[index].rotation * roots[index].rotation.inverse()).scaled_axis() / h;
                def
            })
            .collect()
    }

    /// One of the distinct strands.
    fn shape(&self, hair: &Hair, index: usize, root: Frame) -> StrandDef {
        let length = if self.scene == Scene::Sway { 0.2 } else { 0.25 };
        let mut def = StrandDef::straight(length, hair.elements);
        def.material = hair.material();
        def.freedoms = hair.freedoms;
        def.root = root;
        let (one, two) = (spread(index, 1.0), spread(index, 7.0));
        match self.scene {
            Scene::Sway => {
                let shape = vec![[1.0 + 0.2 * one, 4.0 + 0.5 * two, 0.0]; hair.elements];
                def.natural = natural_under_gravity(&def, &shape, GRAVITY).expect("a natural shape");
                def.initial = Some(shape);
            }
            Scene::Shake => def.natural = vec![[0.2 * one, 0.5 * two, 0.0]; hair.elements],
            Scene::Walk => def.natural = vec![[6.0 * one, 5.0 + 20.0 * two, 3.0 * one]; hair.elements],
        }
        def
    }
}

/// The follicle of a strand on the head, relative to the head's origin.
fn follicle(scene: Scene, index: usize, strands: usize) -> Frame {
    let about_z = |angle| UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
    // n1 level, n2 upwards: the curvature κ1 bends the strand down.
    let level = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), -std::f64::consts::FRAC_PI_2);
    match scene {
        Scene::Sway => Frame { origin: Vector3::zeros(), rotation: about_z(-1.2) * level },
        Scene::Shake => Frame { origin: Vector3::new(0.09, 0.0, 0.0), rotation: about_z(0.5 - 0.1 * spread(index, 3.0)) },
        Scene::Walk => {
            // A spiral over the upper half of a sphere of 9 cm; hair leaves between outwards and downwards.
            let height = (index as f64 + 0.5) / strands as f64;
            let azimuth = 2.399_963_229_728_653 * index as f64;
            let around = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), azimuth);
            let radius = (1.0 - height * height).sqrt();
            let origin = around * Vector3::new(0.09 * radius, 0.09 * height, 0.0);
            Frame { origin, rotation: around * about_z(height.asin() - 0.9) }
        }
    }
}
