//! Random draws: strands and surroundings from the whole accepted space, from hair to cable, uniform in the logarithm.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::{Freedoms, Integrator, Material, StrandDef};

/// Marsaglia's xorshift: the same draws everywhere.
pub struct Draw(u64);

impl Draw {
    /// The draws of one case.
    pub fn of_case(case: u64) -> Self {
        let mut draw = Self(0x9e37_79b9_7f4a_7c15 ^ (case + 1).wrapping_mul(0xd129_0b26_88cc_f16b));
        draw.unit();
        draw
    }
    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    /// True in this fraction of the draws.
    pub fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    /// A whole number below `count`.
    pub fn below(&mut self, count: u32) -> u32 {
        (self.unit() * f64::from(count)) as u32
    }
    /// Evenly in the logarithm.
    pub fn over(&mut self, low: f64, high: f64) -> f64 {
        (low.ln() + (high / low).ln() * self.unit()).exp()
    }
    /// Zero half of the time.
    pub fn or_zero(&mut self, low: f64, high: f64) -> f64 {
        if self.chance(0.5) { 0.0 } else { self.over(low, high) }
    }
    /// A unit vector; the corners of the cube a little oftener than its faces.
    pub fn direction(&mut self) -> Vector3<f64> {
        let v = Vector3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0));
        (v + Vector3::new(1e-3, 0.0, 0.0)).normalize()
    }
    pub fn rotation(&mut self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_scaled_axis(self.direction() * self.between(0.0, std::f64::consts::PI))
    }
}

/// Which part of the space a case is of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Stratum {
    /// Everything at once, a few dozen steps.
    Wide,
    /// The same strands of at most ten elements, steps of 1/60 s or more, for minutes.
    Long,
}

/// One case: the strand, and its stepping.
pub struct Case {
    pub stratum: Stratum,
    pub integrator: Integrator,
    pub def: StrandDef,
    /// Seconds a substep.
    pub h: f64,
    pub tolerance: f64,
    pub max_iterations: u32,
    /// How often a step may be halved, and what error it may add (0: any), in L.
    pub max_subdivisions: u32,
    pub error_tolerance: f64,
    /// Simulated seconds after which a case of the stratum `Long` ends.
    pub seconds: f64,
}

fn integrator(draw: &mut Draw, stratum: Stratum) -> Integrator {
    let share = draw.unit();
    match (stratum, share) {
        (_, s) if s < 0.38 => Integrator::SecondOrder,
        (_, s) if s < 0.75 => Integrator::ImplicitEuler,
        (Stratum::Wide, s) if s > 0.995 => Integrator::Reference,
        _ => Integrator::LinearlyImplicit,
    }
}

/// The case of that number.
pub fn case(draw: &mut Draw, stratum: Stratum) -> Case {
    let integrator = integrator(draw, stratum);
    let most_elements = match (stratum, integrator) {
        (_, Integrator::Reference) => 4.0,
        (Stratum::Long, _) => 10.0,
        _ => 300.0,
    };
    let count = (draw.over(1.0, most_elements + 1.0) as usize).min(most_elements as usize);
    let length = draw.over(1e-3, 3.0);
    let mut lengths: Vec<f64> =
        if draw.chance(0.7) { vec![1.0; count] } else { (0..count).map(|_| draw.over(1e-3, 1.0)).collect() };
    let sum: f64 = lengths.iter().sum();
    lengths.iter_mut().for_each(|x| *x *= length / sum);
    let mut def = StrandDef::straight(length, count);
    let radius = draw.over(1e-6, 5e-3);
    let aspect = if draw.chance(0.5) { draw.over(1.0, 50.0).sqrt() } else { 1.0 };
    def.material = Material {
        radius: if draw.chance(0.5) { [radius * aspect, radius / aspect] } else { [radius / aspect, radius * aspect] },
        density: draw.over(1.0, 2e4),
        youngs_modulus: draw.over(1e3, 1e12),
        poisson_ratio: draw.between(-0.5, 0.5),
        internal_friction: draw.or_zero(1e-14, 1e2),
        viscosity: draw.or_zero(1e-6, 1e2),
        air_drag: draw.or_zero(1e-8, 1e3),
    };
    def.freedoms = Freedoms::from_bits("freedoms", 1 + draw.below(7)).unwrap();
    // One curl for the whole strand, or each element its own.
    let angle = draw.or_zero(1e-3, 100.0);
    let (same, axis) = (draw.chance(0.5), draw.direction());
    let longest = lengths.iter().fold(0.0_f64, |a, b| a.max(*b));
    def.natural = lengths
        .iter()
        .map(|length| if same { axis * (angle / longest) } else { draw.direction() * (angle / length) }.into())
        .collect();
    def.element_lengths = lengths;
    def.root.rotation = draw.rotation();
    let h = match (stratum, integrator) {
        (_, Integrator::Reference) => draw.over(1e-3, 0.25),
        (Stratum::Wide, _) => draw.over(1e-6, 0.25),
        (Stratum::Long, _) if draw.chance(0.2) => draw.over(1.0 / 60.0, 1.0 / 30.0),
        (Stratum::Long, _) => draw.over(1.0 / 30.0, 0.25),
    };
    let tolerance = 10_f64.powf(draw.between(-8.0, -3.0));
    let max_iterations = if draw.chance(0.2) { 1 + draw.below(10) } else { 100 };
    let max_subdivisions = if draw.chance(0.5) { 3 } else { draw.below(4) };
    let error_tolerance = if draw.chance(0.2) { draw.over(1e-6, 1e-2) } else { 0.0 };
    Case { stratum, integrator, def, h, tolerance, max_iterations, max_subdivisions, error_tolerance, seconds: 200.0 }
}
