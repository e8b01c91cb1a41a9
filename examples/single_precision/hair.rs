//! The strands that the comparison steps in both precisions.

use superhelix::{Material, StrandDef};

/// A strand that can be divided into any number of elements.
#[derive(Debug, Clone, Copy)]
pub struct Hair {
    /// Its name in tables.
    pub name: &'static str,
    /// m.
    pub length: f64,
    /// Radius of the round section, m.
    pub radius: f64,
    /// Pa.
    pub youngs_modulus: f64,
    /// Natural curvatures, 1/m.
    pub natural: [f64; 3],
}

/// From stiff to limp, from straight to a tight coil (the helices of 6 mm by 5 mm, and of 1 mm by 10 mm a turn).
pub const ALL: [Hair; 5] = [
    Hair { name: "stiff", length: 0.1, radius: 50e-6, youngs_modulus: 4e9, natural: [0.0; 3] },
    Hair { name: "soft", length: 0.25, radius: 50e-6, youngs_modulus: 1e9, natural: [0.0; 3] },
    Hair { name: "limp", length: 0.5, radius: 20e-6, youngs_modulus: 1e9, natural: [0.0; 3] },
    Hair { name: "curly", length: 0.2, radius: 50e-6, youngs_modulus: 1.5e9, natural: [21.7, 163.8, 0.0] },
    Hair { name: "coil", length: 0.1, radius: 50e-6, youngs_modulus: 2e9, natural: [450.5, 283.0, 0.0] },
];

impl Hair {
    /// A strand of it: air drag of 5·10⁻⁶ kg/(m·s) and Kelvin–Voigt friction of 2 ms, or neither.
    pub fn strand(&self, elements: usize, dissipates: bool) -> StrandDef {
        let (viscosity, air_drag) = if dissipates { (2e-3, 5e-6) } else { (0.0, 0.0) };
        StrandDef {
            material: Material {
                radius: [self.radius; 2],
                youngs_modulus: self.youngs_modulus,
                viscosity,
                air_drag,
                ..Material::default()
            },
            natural: vec![self.natural; elements],
            ..StrandDef::straight(self.length, elements)
        }
    }

    /// Γ: weight times length squared over bending stiffness.
    pub fn gamma(&self) -> f64 {
        let material = self.strand(1, false).material;
        material.linear_density() * 9.81 * self.length.powi(3) / material.stiffness()[1]
    }
}
