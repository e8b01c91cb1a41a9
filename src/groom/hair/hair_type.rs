//! Measured types of hair: four of Bertails et al. 2006, appendix B, and four of Bonanni and Kmoch 2008, table 1, whose source is
//! Wortmann et al. 2006.
//!
//! Values that the tables lack are the same for all types, and documented at each field.

use std::f64::consts::PI;

use super::hair_parameters::{CurlFormula, HairParameters};
use super::variation::Variation;
use crate::error::{Error, Result, check_finite, check_not_negative, check_positive};
use crate::rod::material::Material;

/// A measured type of hair.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HairType {
    /// Asian, smooth (Bertails et al. 2006, appendix B): straight, 50 µm, round, 1 GPa.
    Asian,
    /// Caucasian 1, wavy (the same): 35 µm, ellipticity 1.1, 2 GPa, curls of 1 cm radius.
    Caucasian1,
    /// Caucasian 2, curly (the same): 50 µm, ellipticity 1.1, 1.5 GPa, curls of 6 mm radius.
    Caucasian2,
    /// African, fuzzy (the same): 50 µm, ellipticity 1.2, 0.5 GPa, curls of 1 mm radius and 1 cm step.
    African,
    /// H1 (Bonanni and Kmoch 2008, table 1): 93.1 µm across, ellipticity 1.36, 7.59e-9 N·m²; liked by 41 %.
    H1,
    /// H2 (the same): 96.1 µm across, ellipticity 1.33, 9.25e-9 N·m²; liked by 69 %.
    H2,
    /// GA1 (the same): 89.5 µm across, ellipticity 1.45, 5.23e-9 N·m²; liked by 94 %.
    Ga1,
    /// GC3 (the same): 89.3 µm across, ellipticity 1.42, 5.66e-9 N·m²; liked by 94 %.
    Gc3,
}

/// What can be measured of a hair and of a lock of it. SI units.
///
/// ```
/// use superhelix::hair::{CurlFormula, HairType, MeasuredHair};
///
/// // Asian hair that is a little thicker.
/// let hair = MeasuredHair { mean_radius: 55e-6, ..HairType::Asian.measured() };
/// hair.check("hair")?;
/// assert!(hair.material().mean_radius() > 54e-6);
/// assert!(hair.natural(CurlFormula::Exact)[1] < 10.0); // rad/m: nearly straight
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredHair {
    /// Mean radius of the section √(a1 a2), m; above zero.
    pub mean_radius: f64,
    /// Longer semi-axis over the shorter one; 1 or above.
    pub ellipticity: f64,
    /// Radius of the helix at a lock's tip, m; 0 for straight hair (the step is then 0 too).
    pub helix_radius: f64,
    /// Advance of that helix per turn, m; zero or above.
    pub helix_step: f64,
    /// Young's modulus, Pa; above zero.
    pub youngs_modulus: f64,
    /// Poisson's ratio; above −1, at most 0.5.
    pub poisson_ratio: f64,
    /// Density, kg/m³; above zero.
    pub density: f64,
    /// Internal friction γ, kg·m³/s; zero or above.
    pub internal_friction: f64,
    /// Air drag ν, kg/(m·s); zero or above.
    pub air_drag: f64,
    /// Friction against other hair, relative to the engine's own coefficients
    /// ([`StrandContact`](crate::contact::options::StrandContact)); zero or above.
    pub friction: f64,
}

impl Default for MeasuredHair {
    /// [`HairType::Caucasian1`].
    fn default() -> Self {
        HairType::Caucasian1.measured()
    }
}

/// Density of keratin (Bertails et al. 2006, section 4.2), kg/m³.
const DENSITY: f64 = 1300.0;
/// Poisson's ratio of all types of appendix B.
const POISSON_RATIO: f64 = 0.48;
/// The internal friction fitted in figure 6 of Bertails et al. 2006, kg·m³/s; they found 5e-11 to 5e-10.
const INTERNAL_FRICTION: f64 = 1e-10;
/// Air drag of disciplined hair (the same, section 4.2), kg/(m·s).
pub const DISCIPLINED_DRAG: f64 = 5e-6;
/// Air drag of fuzzy hair (the same), kg/(m·s).
pub const FUZZY_DRAG: f64 = 5e-5;
/// The frictional force that corresponds to the engine's own coefficients, N: the mean of table 1.
pub(crate) const MEAN_FRICTIONAL_FORCE: f64 = 0.693e-2;

impl HairType {
    /// All of them.
    pub const ALL: [HairType; 8] = [
        HairType::Asian,
        HairType::Caucasian1,
        HairType::Caucasian2,
        HairType::African,
        HairType::H1,
        HairType::H2,
        HairType::Ga1,
        HairType::Gc3,
    ];

    /// Its name: `asian`, `caucasian1`, `caucasian2`, `african`, `h1`, `h2`, `ga1`, `gc3`.
    pub fn name(self) -> &'static str {
        match self {
            HairType::Asian => "asian",
            HairType::Caucasian1 => "caucasian1",
            HairType::Caucasian2 => "caucasian2",
            HairType::African => "african",
            HairType::H1 => "h1",
            HairType::H2 => "h2",
            HairType::Ga1 => "ga1",
            HairType::Gc3 => "gc3",
        }
    }

    /// The type with this name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] (`name`) for any other.
    pub fn from_name(name: &str) -> Result<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(|| {
            let names: Vec<&str> = Self::ALL.iter().map(|kind| kind.name()).collect();
            Error::invalid("name", format!("{name:?}"), format!("one of {}", names.join(", ")))
        })
    }

    /// The measurements. From appendix B: radius, ellipticity, helix radius and step, Young's modulus, Poisson's ratio. From
    /// table 1: radius and ellipticity; Young's modulus from the bending stiffness by [`youngs_modulus_from_bending`] (5.1 to 5.2
    /// GPa); friction in proportion to the frictional force (H2's was not measured: 1). Table 1 has no curl, so its hairs are
    /// straight. For all: density 1300 kg/m³, internal friction 1e-10 kg·m³/s, air drag 5e-6 kg/(m·s) (African hair 5e-5),
    /// Poisson's ratio 0.48.
    pub fn measured(self) -> MeasuredHair {
        let appendix = |radius: f64, ellipticity: f64, helix: [f64; 2], youngs_modulus: f64| MeasuredHair {
            mean_radius: radius * 1e-6,
            ellipticity,
            helix_radius: helix[0] * 1e-2,
            helix_step: helix[1] * 1e-2,
            youngs_modulus: youngs_modulus * 1e9,
            poisson_ratio: POISSON_RATIO,
            density: DENSITY,
            internal_friction: INTERNAL_FRICTION,
            air_drag: DISCIPLINED_DRAG,
            friction: 1.0,
        };
        let table = |diameter: f64, ellipticity: f64, stiffness: f64, force: Option<f64>| {
            let longer = 0.5e-6 * diameter;
            let mut hair = appendix(0.0, ellipticity, [0.0, 0.0], 0.0);
            hair.mean_radius = longer / ellipticity.sqrt();
            hair.youngs_modulus = youngs_modulus_from_bending(stiffness * 1e-9, hair.semi_axes());
            hair.friction = force.map_or(1.0, |force| force * 1e-2 / MEAN_FRICTIONAL_FORCE);
            hair
        };
        match self {
            HairType::Asian => appendix(50.0, 1.0, [0.0, 0.0], 1.0),
            HairType::Caucasian1 => appendix(35.0, 1.1, [1.0, 0.5], 2.0),
            HairType::Caucasian2 => appendix(50.0, 1.1, [0.6, 0.5], 1.5),
            HairType::African => MeasuredHair { air_drag: FUZZY_DRAG, ..appendix(50.0, 1.2, [0.1, 1.0], 0.5) },
            HairType::H1 => table(93.1, 1.36, 7.59, Some(0.64)),
            HairType::H2 => table(96.1, 1.33, 9.25, None),
            HairType::Ga1 => table(89.5, 1.45, 5.23, Some(0.65)),
            HairType::Gc3 => table(89.3, 1.42, 5.66, Some(0.79)),
        }
    }
}

/// Young's modulus of an elliptic hair whose bending stiffness about its longer axis is EI1 (N·m²): E = 4 EI1 / (π a1 a2³).
/// Semi-axes in m, the longer first.
pub fn youngs_modulus_from_bending(stiffness: f64, [a1, a2]: [f64; 2]) -> f64 {
    4.0 * stiffness / (PI * a1 * a2 * a2 * a2)
}

impl MeasuredHair {
    /// Semi-axes along n1 and n2, m: a1 = r √e, a2 = r / √e.
    pub fn semi_axes(&self) -> [f64; 2] {
        let root = self.ellipticity.sqrt();
        [self.mean_radius * root, self.mean_radius / root]
    }

    /// Checks every value; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        check_positive(|| format!("{argument}.mean_radius"), self.mean_radius)?;
        check_finite(|| format!("{argument}.ellipticity"), self.ellipticity)?;
        if self.ellipticity < 1.0 {
            return Err(Error::invalid(format!("{argument}.ellipticity"), self.ellipticity, "1 or above"));
        }
        check_not_negative(|| format!("{argument}.helix_radius"), self.helix_radius)?;
        check_not_negative(|| format!("{argument}.helix_step"), self.helix_step)?;
        if self.helix_radius == 0.0 && self.helix_step != 0.0 {
            let expected = "0 where helix_radius is 0: a straight hair has no step";
            return Err(Error::invalid(format!("{argument}.helix_step"), self.helix_step, expected));
        }
        check_not_negative(|| format!("{argument}.friction"), self.friction)?;
        self.material().check(argument)?;
        if self.natural(CurlFormula::Paper).iter().all(|value| value.is_finite()) {
            return Ok(());
        }
        Err(Error::invalid(
            format!("{argument}.helix_radius"),
            self.helix_radius,
            "a helix whose curvature is an ordinary number",
        ))
    }

    /// Section and material.
    pub fn material(&self) -> Material {
        Material {
            radius: self.semi_axes(),
            density: self.density,
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: self.poisson_ratio,
            internal_friction: self.internal_friction,
            viscosity: 0.0,
            air_drag: self.air_drag,
        }
    }

    /// Natural twist and curvatures (κ0, κ1, κ2), rad/m, of the measured helix; zeros if its radius is 0. The hair bends about
    /// n1, the soft axis of an elliptic section.
    pub fn natural(&self, formula: CurlFormula) -> [f64; 3] {
        let (radius, pitch) = (self.helix_radius, self.helix_step / (2.0 * PI));
        if radius == 0.0 {
            return [0.0; 3];
        }
        match formula {
            CurlFormula::Exact => {
                let square = radius * radius + pitch * pitch;
                [pitch / square, radius / square, 0.0]
            }
            CurlFormula::Paper => [pitch / (radius * radius), 1.0 / radius, 0.0],
        }
    }

    /// The parameters of such hair, without variation.
    ///
    /// # Errors
    /// As [`MeasuredHair::check`], of `hair`.
    pub fn parameters(&self, formula: CurlFormula) -> Result<HairParameters> {
        self.check("hair")?;
        Ok(HairParameters {
            material: self.material(),
            natural: self.natural(formula),
            friction: self.friction,
            variation: Variation::none(),
        })
    }
}
