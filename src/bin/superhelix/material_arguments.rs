//! The material on the command line: a kind of hair, and flags that change single values of it.

use clap::Args;
use superhelix::error::Error;
use superhelix::rod::material::Material;

use crate::failure::Failure;
use crate::presets::{HairType, semi_axes};

/// Section and material of all strands.
#[derive(Debug, Args)]
#[command(next_help_heading = "Material (SI units)")]
pub struct MaterialArguments {
    /// Kind of hair (Bertails et al. 2006, appendix B); the flags below change single values of it.
    #[arg(long = "type", value_enum, value_name = "TYPE", default_value_t = HairType::Caucasian1)]
    kind: HairType,
    /// Mean radius of the section, the square root of a1 a2, m.
    #[arg(long, value_name = "M")]
    radius: Option<f64>,
    /// Longer semi-axis over the shorter one.
    #[arg(long, value_name = "RATIO")]
    ellipticity: Option<f64>,
    /// Density, kg/m3.
    #[arg(long, value_name = "KG/M3")]
    density: Option<f64>,
    /// Young's modulus, Pa.
    #[arg(long, value_name = "PA")]
    youngs_modulus: Option<f64>,
    /// Poisson's ratio.
    #[arg(long, value_name = "RATIO")]
    poisson_ratio: Option<f64>,
    /// Internal friction gamma, kg m3/s.
    #[arg(long, value_name = "GAMMA")]
    internal_friction: Option<f64>,
    /// Kelvin-Voigt time mu, s.
    #[arg(long, value_name = "S")]
    viscosity: Option<f64>,
    /// Air drag nu, kg/(m s).
    #[arg(long, value_name = "NU")]
    air_drag: Option<f64>,
}

impl MaterialArguments {
    /// The material, checked.
    pub fn material(&self) -> Result<Material, Failure> {
        let preset = self.kind.material();
        let (radius, ellipticity) = self.kind.section();
        let (radius, ellipticity) = (self.radius.unwrap_or(radius), self.ellipticity.unwrap_or(ellipticity));
        let refuse = |flag: &str, value: f64, expected: &str| Failure::Other(format!("--{flag} is {value}; expected {expected}"));
        if !(radius.is_finite() && radius > 0.0) {
            return Err(refuse("radius", radius, "a finite number of metres above zero"));
        }
        if !(ellipticity.is_finite() && ellipticity >= 1.0) {
            return Err(refuse("ellipticity", ellipticity, "a finite number, 1 or above"));
        }
        let material = Material {
            radius: semi_axes(radius, ellipticity),
            density: self.density.unwrap_or(preset.density),
            youngs_modulus: self.youngs_modulus.unwrap_or(preset.youngs_modulus),
            poisson_ratio: self.poisson_ratio.unwrap_or(preset.poisson_ratio),
            internal_friction: self.internal_friction.unwrap_or(preset.internal_friction),
            viscosity: self.viscosity.unwrap_or(preset.viscosity),
            air_drag: self.air_drag.unwrap_or(preset.air_drag),
        };
        material.check("material").map_err(|error| match error {
            Error::InvalidArgument { argument, value, expected } => {
                let flag = argument.strip_prefix("material.").map(|field| format!("--{}", field.replace('_', "-")));
                Failure::Other(format!("{} is {value}; expected {expected}", flag.unwrap_or(argument)))
            }
            other => Failure::from(other),
        })?;
        Ok(material)
    }
}
