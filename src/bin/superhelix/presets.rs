//! Kinds of hair: the measured values of Bertails et al. 2006, appendix B and section 4.2.

use clap::ValueEnum;
use superhelix::rod::material::Material;

/// A kind of hair by its section, stiffness and dissipation. The shape comes from the groom.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum HairType {
    /// Asian, smooth: 50 µm, round, 1 GPa.
    Asian,
    /// Caucasian 1, wavy: 35 µm, ellipticity 1.1, 2 GPa.
    Caucasian1,
    /// Caucasian 2, curly: 50 µm, ellipticity 1.1, 1.5 GPa.
    Caucasian2,
    /// African, fuzzy: 50 µm, ellipticity 1.2, 0.5 GPa, more air drag.
    African,
}

/// Semi-axes (n1, n2) of a section with this mean radius √(a1 a2) and ellipticity a1/a2.
pub fn semi_axes(mean_radius: f64, ellipticity: f64) -> [f64; 2] {
    [mean_radius * ellipticity.sqrt(), mean_radius / ellipticity.sqrt()]
}

impl HairType {
    /// Mean radius √(a1 a2), m, and ellipticity a1/a2.
    pub fn section(self) -> (f64, f64) {
        match self {
            HairType::Asian => (50e-6, 1.0),
            HairType::Caucasian1 => (35e-6, 1.1),
            HairType::Caucasian2 => (50e-6, 1.1),
            HairType::African => (50e-6, 1.2),
        }
    }

    /// The whole material. Density is keratin's, 1300 kg/m³; internal friction γ = 1e-10 kg·m³/s; air drag ν between the
    /// paper's 5e-6 (disciplined) and 5e-5 kg/(m·s) (fuzzy).
    pub fn material(self) -> Material {
        let (radius, ellipticity) = self.section();
        let (youngs_modulus, air_drag) = match self {
            HairType::Asian => (1e9, 5e-6),
            HairType::Caucasian1 => (2e9, 5e-6),
            HairType::Caucasian2 => (1.5e9, 5e-6),
            HairType::African => (0.5e9, 5e-5),
        };
        Material {
            radius: semi_axes(radius, ellipticity),
            density: 1300.0,
            youngs_modulus,
            poisson_ratio: 0.48,
            internal_friction: 1e-10,
            viscosity: 0.0,
            air_drag,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_usable_and_keep_their_mean_radius() {
        for kind in HairType::value_variants() {
            let material = kind.material();
            material.check("preset").unwrap();
            let (radius, ellipticity) = kind.section();
            assert!(((material.radius[0] * material.radius[1]).sqrt() - radius).abs() < 1e-15);
            assert!((material.radius[0] / material.radius[1] - ellipticity).abs() < 1e-12);
        }
    }
}
