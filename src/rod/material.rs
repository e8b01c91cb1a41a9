//! The material and section of a strand, and the stiffnesses and densities that follow.
//!
//! Symbols: a1, a2 semi-axes along n1, n2; S = π a1 a2; E Young's modulus; σ Poisson's ratio; G = E/(2(1+σ));
//! EI0 = G π a1³a2³/(a1²+a2²) (twist), EI1 = E π/4 a1 a2³, EI2 = E π/4 a1³ a2 (bending about n1, n2); ρ density;
//! γ internal friction (Bertails et al. 2006, eq. 5d); μ Kelvin–Voigt time (D = ½ ∫ μ Σ EIᵢ κ̇ᵢ²); ν air drag (eq. 5a).

use std::f64::consts::PI;

use crate::error::{Error, Result, check_not_negative, check_positive};

/// Section and material of one strand. SI units.
///
/// ```
/// use superhelix::Material;
///
/// let hair = Material { radius: [45e-6, 30e-6], youngs_modulus: 3e9, air_drag: 5e-6, ..Material::default() };
/// hair.check("hair")?;
/// let [twist, flat, edge] = hair.stiffness(); // N·m²
/// assert!(twist < flat || flat < edge);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Semi-axes of the elliptic cross-section along n1 and n2, m; above zero.
    pub radius: [f64; 2],
    /// Density ρ, kg/m³; above zero.
    pub density: f64,
    /// Young's modulus E, Pa; above zero.
    pub youngs_modulus: f64,
    /// Poisson's ratio σ; above −1, at most 0.5.
    pub poisson_ratio: f64,
    /// Internal friction γ, kg·m³/s; zero or above.
    pub internal_friction: f64,
    /// Kelvin–Voigt time μ, s; zero or above.
    pub viscosity: f64,
    /// Air drag ν, kg/(m·s); zero or above.
    pub air_drag: f64,
}

impl Default for Material {
    /// A round straight hair: 50 µm, 1300 kg/m³, 2 GPa, 0.48, no dissipation.
    fn default() -> Self {
        Self {
            radius: [50e-6; 2],
            density: 1300.0,
            youngs_modulus: 2e9,
            poisson_ratio: 0.48,
            internal_friction: 0.0,
            viscosity: 0.0,
            air_drag: 0.0,
        }
    }
}

impl Material {
    /// Checks every value; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        check_positive(|| format!("{argument}.radius[0]"), self.radius[0])?;
        check_positive(|| format!("{argument}.radius[1]"), self.radius[1])?;
        check_positive(|| format!("{argument}.density"), self.density)?;
        check_positive(|| format!("{argument}.youngs_modulus"), self.youngs_modulus)?;
        if !(self.poisson_ratio > -1.0 && self.poisson_ratio <= 0.5) {
            return Err(Error::invalid(
                format!("{argument}.poisson_ratio"),
                self.poisson_ratio,
                "a number above -1, at most 0.5",
            ));
        }
        check_not_negative(|| format!("{argument}.internal_friction"), self.internal_friction)?;
        check_not_negative(|| format!("{argument}.viscosity"), self.viscosity)?;
        check_not_negative(|| format!("{argument}.air_drag"), self.air_drag)?;
        let derived = [self.stiffness()[0], self.stiffness()[1], self.stiffness()[2], self.linear_density()];
        if derived.iter().any(|value| !value.is_normal()) {
            return Err(Error::invalid(
                argument,
                format!("a material of stiffness {:?} N·m² and {} kg/m", self.stiffness(), self.linear_density()),
                "radius, density and youngs_modulus whose products are ordinary numbers",
            ));
        }
        Ok(())
    }

    /// Its values in the order of its fields, as snapshots have them.
    pub(crate) fn values(&self) -> [f64; 8] {
        let [first, second] = self.radius;
        let Self { density, youngs_modulus, poisson_ratio, internal_friction, viscosity, air_drag, .. } = *self;
        [first, second, density, youngs_modulus, poisson_ratio, internal_friction, viscosity, air_drag]
    }

    /// The material of such values, unchecked.
    pub(crate) fn of_values(values: [f64; 8]) -> Self {
        let [first, second, density, youngs_modulus, poisson_ratio, internal_friction, viscosity, air_drag] = values;
        Self { radius: [first, second], density, youngs_modulus, poisson_ratio, internal_friction, viscosity, air_drag }
    }

    /// EI0 (twist), EI1, EI2 (bending about n1 and n2), N·m².
    pub fn stiffness(&self) -> [f64; 3] {
        let [a1, a2] = self.radius;
        let shear_modulus = self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio));
        let (a1_cubed, a2_cubed) = (a1 * a1 * a1, a2 * a2 * a2);
        [
            shear_modulus * PI * a1_cubed * a2_cubed / (a1 * a1 + a2 * a2),
            self.youngs_modulus * (PI / 4.0) * a1 * a2_cubed,
            self.youngs_modulus * (PI / 4.0) * a1_cubed * a2,
        ]
    }

    /// Mean radius √(a1 a2) of the section, m.
    pub fn mean_radius(&self) -> f64 {
        (self.radius[0] * self.radius[1]).sqrt()
    }

    /// ρS, kg/m.
    pub fn linear_density(&self) -> f64 {
        self.density * PI * self.radius[0] * self.radius[1]
    }

    /// The factor of κ̇ᵢ in the dissipative moment: γ + μ EIᵢ, N·m²·s.
    pub fn dissipation(&self) -> [f64; 3] {
        self.stiffness().map(|stiffness| self.internal_friction + self.viscosity * stiffness)
    }
}
