//! Hair handle: what a hand feels of hair, in the three groups of properties of Bonanni and Kmoch 2008, section 2: geometry,
//! bending, friction.
//!
//! Table 1's four hairs are available by name, as are all of [`HairType`].

use std::f64::consts::PI;

use super::hair_parameters::{CurlFormula, HairParameters, Sliders};
use super::hair_type::{HairType, MEAN_FRICTIONAL_FORCE, MeasuredHair, youngs_modulus_from_bending};
use crate::error::{Error, Result, check_finite, check_not_negative, check_positive};

/// What a hand feels of hair. SI units.
///
/// ```
/// use superhelix::hair::{HairHandle, HairType};
///
/// let handle = HairHandle { natural_curvature: 40.0, ..HairHandle::from(HairType::Caucasian1) };
/// let hair = handle.parameters()?;
/// assert!((hair.natural[1] - 40.0).abs() < 1e-9);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HairHandle {
    /// Geometry: the longer diameter of the section, m; above zero.
    pub major_diameter: f64,
    /// Geometry: the longer over the shorter diameter; 1 or above.
    pub ellipticity: f64,
    /// Geometry: natural twist, rad/m; zero or above, and zero if the curvature is.
    pub natural_twist: f64,
    /// Geometry: natural curvature, rad/m; zero for straight hair, or above.
    pub natural_curvature: f64,
    /// Bending: stiffness about the longer axis, about which hair bends, N·m²; above zero.
    pub bending_stiffness: f64,
    /// Friction between hairs, as the frictional force of table 1, N; zero or above. 0.693 cN, the mean of the measured ones,
    /// gives the engine's own coefficients.
    pub frictional_force: f64,
    /// Friction within a hair and a lock, γ, kg·m³/s; zero or above.
    pub internal_friction: f64,
}

impl From<HairType> for HairHandle {
    fn from(kind: HairType) -> Self {
        let measured = kind.measured();
        let [a1, a2] = measured.semi_axes();
        let [twist, curvature, _] = measured.natural(CurlFormula::Exact);
        Self {
            major_diameter: 2.0 * a1,
            ellipticity: measured.ellipticity,
            natural_twist: twist,
            natural_curvature: curvature,
            bending_stiffness: measured.youngs_modulus * 0.25 * PI * a1 * a2 * a2 * a2,
            frictional_force: measured.friction * MEAN_FRICTIONAL_FORCE,
            internal_friction: measured.internal_friction,
        }
    }
}

impl HairHandle {
    /// Checks every number; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        check_positive(|| format!("{argument}.major_diameter"), self.major_diameter)?;
        check_finite(|| format!("{argument}.ellipticity"), self.ellipticity)?;
        if self.ellipticity < 1.0 {
            return Err(Error::invalid(format!("{argument}.ellipticity"), self.ellipticity, "1 or above"));
        }
        check_not_negative(|| format!("{argument}.natural_twist"), self.natural_twist)?;
        check_not_negative(|| format!("{argument}.natural_curvature"), self.natural_curvature)?;
        if self.natural_curvature == 0.0 && self.natural_twist != 0.0 {
            let expected = "0 where natural_curvature is 0";
            return Err(Error::invalid(format!("{argument}.natural_twist"), self.natural_twist, expected));
        }
        check_positive(|| format!("{argument}.bending_stiffness"), self.bending_stiffness)?;
        check_not_negative(|| format!("{argument}.frictional_force"), self.frictional_force)?;
        check_not_negative(|| format!("{argument}.internal_friction"), self.internal_friction)
    }

    /// The measured quantities of such hair; those that a hand does not feel (density, Poisson's ratio, air drag) are the same
    /// for all types.
    pub fn measured(&self) -> MeasuredHair {
        let longer = 0.5 * self.major_diameter;
        // The helix with this twist and curvature.
        let square = self.natural_curvature * self.natural_curvature + self.natural_twist * self.natural_twist;
        let over = |value: f64| if self.natural_curvature == 0.0 { 0.0 } else { value / square };
        let mut hair = MeasuredHair {
            mean_radius: longer / self.ellipticity.sqrt(),
            ellipticity: self.ellipticity,
            helix_radius: over(self.natural_curvature),
            helix_step: over(2.0 * PI * self.natural_twist),
            internal_friction: self.internal_friction,
            friction: self.frictional_force / MEAN_FRICTIONAL_FORCE,
            ..HairType::Ga1.measured()
        };
        hair.youngs_modulus = youngs_modulus_from_bending(self.bending_stiffness, hair.semi_axes());
        hair
    }

    /// The parameters of strands of such hair, without variation.
    ///
    /// # Errors
    /// As [`HairHandle::check`], of `handle`.
    pub fn parameters(&self) -> Result<HairParameters> {
        self.check("handle")?;
        self.measured().parameters(CurlFormula::Exact)
    }

    /// The handle with two sliders moved, each from −1 to 1 (the future work of Bonanni and Kmoch 2008). `curliness` acts on
    /// natural twist and curvature, `combing_ease` on the friction between hairs and within a lock, like the [`Sliders`] of those
    /// names.
    /// # Errors
    /// As [`HairHandle::check`]; [`Error::InvalidArgument`] for a slider out of range.
    pub fn with_sliders(&self, curliness: f64, combing_ease: f64) -> Result<Self> {
        let sliders = Sliders { curliness, combing_ease, ..Sliders::default() };
        sliders.check("").map_err(|error| error.renamed(".", ""))?;
        let moved = self.parameters()?.with_sliders(&sliders)?;
        let [natural_twist, natural_curvature, _] = moved.natural;
        Ok(Self {
            natural_twist,
            natural_curvature,
            frictional_force: moved.friction * MEAN_FRICTIONAL_FORCE,
            internal_friction: moved.material.internal_friction,
            ..*self
        })
    }
}
