//! Wisps: a guide of a groom represents the hairs around it, which lie and move together.
//!
//! Symbols: n hairs of section S, bending stiffness EI, internal friction γ and air drag ν; h the hold. A bundle of n fibres
//! bends with n EI if they slide freely past each other and with n² EI if they are bonded; friction, oil and product between them
//! hold it in between (Bathe et al. 2008, Heussinger et al. 2007, on bundles with shear between fibres). The hold is the
//! exponent: n^(1+h) EI. Internal friction, which acts where fibres slide and bend, scales in the same way, and whatever holds
//! them together adds friction; weight and drag are those of n hairs.

use crate::error::{Error, Result};
use crate::rod::material::Material;

/// The fraction of a wisp's section that is hair; the rest is air between loosely lying cylinders.
const PACKING: f64 = 0.5;
/// The margin of stability of lacquered hair: see [`Wisp::margin`].
const LACQUERED_MARGIN: f64 = 0.9;
/// The Kelvin–Voigt time of whatever holds lacquered hair together, s: locks come to rest within half a second.
const CALMING: f64 = 0.1;
/// Most hairs of a wisp: more than a head has.
const MAX_HAIRS: f64 = 1e6;

/// What a guide represents.
///
/// ```
/// use superhelix::{Material, Wisp};
///
/// let hair = Material::default();
/// let wisp = Wisp { hairs: 150.0, hold: 0.5 };
/// let rod = wisp.material(&hair)?;
/// assert!(rod.linear_density() > 149.0 * hair.linear_density());
/// assert!(wisp.radius(&hair) < 1e-3); // m: the distance at which it meets other wisps
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wisp {
    /// Hairs n; 1 to 1e6. A head has about 100,000.
    pub hairs: f64,
    /// How firmly they hold together and keep their style, h: from 0 (bare hair, free to slide) to 1 (lacquered).
    pub hold: f64,
}

impl Default for Wisp {
    /// 200 hairs, hold 0.6: 24 times as stiff for its weight as one of its hairs, like styled hair.
    fn default() -> Self {
        Self { hairs: 200.0, hold: 0.6 }
    }
}

impl Wisp {
    /// One bare hair.
    pub fn bare() -> Self {
        Self { hairs: 1.0, hold: 0.0 }
    }

    /// Checks both; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        if !(1.0..=MAX_HAIRS).contains(&self.hairs) {
            return Err(Error::invalid(format!("{argument}.hairs"), self.hairs, "a number from 1 to 1e6"));
        }
        if !(0.0..=1.0).contains(&self.hold) {
            return Err(Error::invalid(format!("{argument}.hold"), self.hold, "a number from 0 to 1"));
        }
        Ok(())
    }

    /// The factor on a hair's stiffness for its weight: n^h.
    pub fn stiffening(&self) -> f64 {
        power(self.hairs, self.hold)
    }

    /// The material of a rod that moves like the wisp. Its section is that of n hairs, side by side without air between them,
    /// with radii √n times those of one; density and Poisson's ratio are a hair's. Young's modulus is n^(h−1) times a hair's, so
    /// that it bends with n^(1+h) EI and twists in proportion; internal friction is n^(1+h) γ, air drag n ν, and the Kelvin–Voigt
    /// time 0.1 h seconds more than a hair's.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming `wisp.field` or `hair.field`, or `hair` where the products are not ordinary numbers.
    pub fn material(&self, hair: &Material) -> Result<Material> {
        self.check("wisp")?;
        hair.check("hair")?;
        let (n, stiffening) = (self.hairs, self.stiffening());
        let wisp = Material {
            radius: hair.radius.map(|radius| radius * n.sqrt()),
            youngs_modulus: hair.youngs_modulus * stiffening / n,
            internal_friction: hair.internal_friction * n * stiffening,
            viscosity: hair.viscosity + CALMING * self.hold,
            air_drag: hair.air_drag * n,
            ..*hair
        };
        wisp.check("hair")?;
        Ok(wisp)
    }

    /// The radius within which its hairs lie, m: its radius for contact with other wisps.
    pub fn radius(&self, hair: &Material) -> f64 {
        hair.mean_radius() * (self.hairs / PACKING).sqrt()
    }

    /// The margin of stability with which the hold lets it rest as drawn, 0.9 h: the smallest eigenvalue of the static Hessian
    /// against the elastic stiffness must be at least that ([`crate::groom::stability`]). `None` for bare hair, which rests where
    /// it can.
    pub fn margin(&self) -> Option<f64> {
        (self.hold > 0.0).then_some(LACQUERED_MARGIN * self.hold)
    }
}

/// x^h, for x from 1 on and h from 0 to 1, by square roots alone: the same bits on every machine, which the platform's power does
/// not guarantee.
fn power(x: f64, h: f64) -> f64 {
    let (mut result, mut root, mut rest) = (1.0, x, h);
    if rest >= 1.0 {
        return x;
    }
    // One binary digit of h after the other.
    for _ in 0..53 {
        root = root.sqrt();
        rest *= 2.0;
        if rest >= 1.0 {
            rest -= 1.0;
            result *= root;
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_power_is_that_of_the_platform_to_rounding() {
        for x in [1.0, 1.5, 10.0, 200.0, 1e6] {
            for h in [0.0, 1e-9, 0.1, 0.25, 0.6, 0.999, 1.0] {
                let (own, platform) = (power(x, h), f64::powf(x, h));
                assert!((own - platform).abs() < 1e-14 * platform, "{x}^{h}: {own} {platform}");
            }
        }
    }
}
