//! A standard combing experiment: force against stroke. Hairs hang from a row of clamps; three rods close on them, so that each hair bends round
//! them about its longer axis, and are drawn down over it. The rods feel how stiff the hairs are across the stroke, and how rough along it.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};

use crate::contact::body::BodyDef;
use crate::contact::shape::Shape;
use crate::error::{Error, Result, check_positive};
use crate::groom::hair::hair_handle::HairHandle;
use crate::math::frame::Frame;
use crate::solver::Solver;
use crate::solver::definition::{SolverOptions, StrandDef};

/// How the experiment is made. Lengths in m.
///
/// ```
/// use superhelix::experiments::CombingTest;
///
/// let test = CombingTest::default();
/// test.check("test")?;
/// assert!(test.steps() > 0); // run(&handle) takes them
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CombingTest {
    /// Hairs side by side, 1 to 1000: forces are of all together.
    pub strands: u32,
    /// Their length, 0.03 or above.
    pub length: f64,
    /// How far the rods go, above zero, and no farther than the hair's length less 25 mm: tips stay below them.
    pub stroke: f64,
    /// How fast, m/s, above zero.
    pub speed: f64,
    /// Elements a hair, 4 to 1000; an element is to be no longer than the rods are apart.
    pub elements: u32,
    /// Steps a second, above zero.
    pub rate: f64,
}

impl Default for CombingTest {
    fn default() -> Self {
        Self { strands: 1, length: 0.06, stroke: 0.03, speed: 0.01, elements: 40, rate: 240.0 }
    }
}

/// What the experiment gave.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CombingCurve {
    /// How far the rods have gone, m, one a step.
    pub stroke: Vec<f64>,
    /// Force of the hairs on the rods against the stroke, N.
    pub force: Vec<f64>,
    /// How hard they press on the rods across it: the sum of what each rod feels, N.
    pub pressure: Vec<f64>,
}

/// The rods: their radius, how far each is from the next along the hair, and how far they press it aside, m.
const RADIUS: f64 = 1e-3;
const APART: f64 = 5e-3;
const ASIDE: f64 = 0.75e-3;
/// Where the uppermost begins below the clamps, m, and what is left below the lowest at the end.
const BEGINS: f64 = 8e-3;
const LEFT: f64 = 25e-3;
/// Of closing, and of rest before the stroke, s.
const CLOSING: f64 = 0.25;

impl CombingCurve {
    /// The mean of a list over the stroke's second half, when the rods slide steadily.
    fn steady(list: &[f64]) -> f64 {
        let half = &list[list.len() / 2..];
        half.iter().sum::<f64>() / half.len().max(1) as f64
    }

    /// Steady force along the stroke, N: how hard the hair is to comb.
    pub fn mean_force(&self) -> f64 {
        Self::steady(&self.force)
    }

    /// Steady force across it, N: how stiff it is.
    pub fn mean_pressure(&self) -> f64 {
        Self::steady(&self.pressure)
    }

    /// The one over the other: how rough it is.
    pub fn friction(&self) -> f64 {
        self.mean_force() / self.mean_pressure()
    }

    /// Work of the stroke, J.
    pub fn work(&self) -> f64 {
        let pairs = self.stroke.windows(2).zip(self.force.windows(2));
        pairs.map(|(s, f)| 0.5 * (f[0] + f[1]) * (s[1] - s[0])).sum()
    }
}

impl CombingTest {
    /// Checks every number; `argument` is the name put before the field in the message.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first that is out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        let count = |name: &str, value: u32, low: u32| {
            if (low..=1000).contains(&value) {
                return Ok(());
            }
            Err(Error::invalid(format!("{argument}.{name}"), value, format!("{low} to 1000")))
        };
        count("strands", self.strands, 1)?;
        count("elements", self.elements, 4)?;
        for (name, value) in [("length", self.length), ("stroke", self.stroke), ("speed", self.speed), ("rate", self.rate)] {
            check_positive(|| format!("{argument}.{name}"), value)?;
        }
        if self.length / f64::from(self.elements) > APART {
            let expected = format!("elements of {APART} m at most: more of them");
            return Err(Error::invalid(format!("{argument}.elements"), self.elements, expected));
        }
        let most = self.length - LEFT;
        if self.stroke > most {
            let expected = format!("at most {most} m, the hair's length less {LEFT} m");
            return Err(Error::invalid(format!("{argument}.stroke"), self.stroke, expected));
        }
        Ok(())
    }

    /// Steps of the stroke.
    pub fn steps(&self) -> usize {
        (self.stroke / self.speed * self.rate).round().max(2.0) as usize
    }

    /// Makes the experiment with such hair.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming a field of `handle` or of `test`.
    pub fn run(&self, handle: &HairHandle) -> Result<CombingCurve> {
        self.check("test")?;
        let hair = handle.parameters()?;
        let mut options = SolverOptions::default();
        options.step.tolerance = 1e-5;
        let mut solver = Solver::new(options)?;
        let defs: Vec<StrandDef> = (0..self.strands).map(|k| self.strand(k, &hair)).collect();
        let strands = solver.add_strands(&defs)?;
        solver.set_contact(&strands, Some(&hair.contact()))?;
        let half_width = 2e-3 * f64::from(self.strands) + 5e-3;
        let rod = Arc::new(Shape::new_capsule(Vector3::y() * -half_width, Vector3::y() * half_width, RADIUS)?);
        let clear = RADIUS + hair.contact().radius;
        // Open, rods stand half a millimetre off a hair that hangs straight; closed, they press it aside.
        let frames = |closed: f64, way: f64| -> Vec<Frame> {
            let off = clear + 0.5e-3 - closed * (0.5e-3 + ASIDE);
            (0..3_u8)
                .map(|k| {
                    let side = if k == 1 { -1.0 } else { 1.0 };
                    let origin = Vector3::new(side * off, 0.0, -(BEGINS + APART * f64::from(k) + way));
                    Frame { origin, ..Frame::default() }
                })
                .collect()
        };
        let rods = frames(0.0, 0.0).into_iter().map(|pose| BodyDef { pose, ..BodyDef::new(rod.clone()) }).collect();
        let rods = solver.add_bodies(rods)?;
        let h = 1.0 / self.rate;
        let closing = (CLOSING * self.rate).ceil().max(1.0) as u32;
        for step in 1..=2 * closing {
            let closed = (f64::from(step) / f64::from(closing)).min(1.0);
            solver.set_body_frames(&rods, &frames(closed, 0.0), h)?;
            solver.step(h, 1)?;
        }
        let steps = self.steps();
        let mut curve = CombingCurve::default();
        for step in 1..=steps {
            let way = self.stroke * step as f64 / steps as f64;
            solver.set_body_frames(&rods, &frames(1.0, way), h)?;
            solver.step(h, 1)?;
            let (mut along, mut across) = (0.0, 0.0);
            for rod in &rods {
                let force = solver.body_wrench(*rod)?.force;
                along += force.z;
                across += force.x.abs();
            }
            curve.stroke.push(way);
            curve.force.push(along);
            curve.pressure.push(across);
        }
        Ok(curve)
    }

    fn strand(&self, k: u32, hair: &crate::groom::hair::hair_parameters::HairParameters) -> StrandDef {
        let count = self.elements as usize;
        let mut def = StrandDef::straight(self.length, count);
        def.natural = vec![hair.natural; count];
        // Drawn straight: curly hair begins combed.
        def.initial = Some(vec![[0.0; 3]; count]);
        def.material = hair.material;
        let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5 * PI);
        let y = 2e-3 * (f64::from(k) - 0.5 * f64::from(self.strands - 1));
        def.root = Frame { origin: Vector3::y() * y, rotation: down };
        def
    }
}
