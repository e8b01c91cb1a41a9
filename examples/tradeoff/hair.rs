//! The four hair types of Bertails et al. 2006, appendix B, as strands of any number of elements.

use std::f64::consts::PI;

use superhelix::{Freedoms, Material, StrandDef};

/// A type of hair.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hair {
    /// Asian, smooth.
    Straight,
    /// Caucasian 1, wavy.
    Wavy,
    /// Caucasian 2, curly.
    Curly,
    /// African, fuzzy.
    Fuzzy,
}

impl Hair {
    /// All, by the turns that they make.
    pub const ALL: [Hair; 4] = [Hair::Straight, Hair::Wavy, Hair::Curly, Hair::Fuzzy];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        ["straight", "wavy", "curly", "fuzzy"][self as usize]
    }

    /// Length when not cut short, m: half for the type with twice the turns.
    pub fn length(self) -> f64 {
        if self == Hair::Fuzzy { 0.1 } else { 0.2 }
    }

    /// Natural curvatures of the helix with the table's radius and step, exactly: κ1 = r/(r² + p²), κ0 = p/(r² + p²), p the step
    /// over 2π.
    pub fn natural(self) -> [f64; 3] {
        let (radius, step) = match self {
            Hair::Straight => return [0.0; 3],
            Hair::Wavy => (0.01, 0.005),
            Hair::Curly => (0.006, 0.005),
            Hair::Fuzzy => (0.001, 0.01),
        };
        let pitch = step / (2.0 * PI);
        let square = radius * radius + pitch * pitch;
        [pitch / square, radius / square, 0.0]
    }

    /// Section, stiffness and dissipation: γ = 10⁻¹⁰ kg·m³/s, drag of disciplined hair, ten times as much for fuzzy hair.
    pub fn material(self) -> Material {
        let (radius, ellipticity, youngs_modulus, air_drag): (f64, f64, f64, f64) = match self {
            Hair::Straight => (50e-6, 1.0, 1e9, 5e-6),
            Hair::Wavy => (35e-6, 1.1, 2e9, 5e-6),
            Hair::Curly => (50e-6, 1.1, 1.5e9, 5e-6),
            Hair::Fuzzy => (50e-6, 1.2, 0.5e9, 5e-5),
        };
        let root = ellipticity.sqrt();
        Material {
            radius: [radius * root, radius / root],
            youngs_modulus,
            internal_friction: 1e-10,
            air_drag,
            ..Material::default()
        }
    }

    /// A strand of that hair in its natural shape.
    pub fn strand(self, length: f64, elements: usize, freedoms: Freedoms) -> StrandDef {
        StrandDef {
            material: self.material(),
            natural: vec![self.natural(); elements],
            freedoms,
            ..StrandDef::straight(length, elements)
        }
    }
}
