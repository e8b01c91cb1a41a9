//! Whether a strand that is held up in a shape stays there when disturbed, and how much stiffer it must be to do so.
//!
//! With the natural shape chosen as [`super::rest_shape`] says, any shape is an equilibrium. Its Hessian is K + W: K elastic, W
//! that of the weight, which depends on the shape and not on the natural one. λ is the smallest eigenvalue of (K + W) x = λ K x.
//! A strand s times as stiff, of the same weight and shape, has K + W/s in units of its own stiffness, hence 1 + (λ − 1)/s
//! instead of λ: the necessary stiffening has a closed form.

use nalgebra::Vector3;

use crate::error::{Error, Result};
use crate::rod::definition::StrandDef;
use crate::rod::material::Material;
use crate::step::equilibrium;

/// How firmly a strand rests in a shape under gravity, with a natural shape that holds it there.
///
/// ```
/// use superhelix::StrandDef;
/// use superhelix::editing::{Stiffening, stability_under_gravity};
/// use superhelix::nalgebra::Vector3;
///
/// // A limp strand that leaves upwards falls over; twice as stiff as its border of stability, it stands.
/// let strand = StrandDef::straight(0.15, 6);
/// let up = Vector3::new(-9.81, 0.0, 0.0);
/// let found = stability_under_gravity(&strand, &strand.natural, up)?;
/// assert!(!found.is_stable());
/// let scale = Stiffening::YoungsModulus.scale(&found, 0.5)?;
/// let stiff = StrandDef { material: Stiffening::YoungsModulus.applied(&strand.material, scale), ..strand.clone() };
/// assert!(stability_under_gravity(&stiff, &strand.natural, up)?.is_stable());
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stability {
    /// The smallest eigenvalue λ of the static Hessian against the elastic stiffness: 1 without gravity (a little more for
    /// strands that it stiffens everywhere), 0 at the limit of stability, negative for unstable ones. Rounding leaves it within
    /// 1e-9. NaN if it could not be found.
    pub smallest_eigenvalue: f64,
}

impl Stability {
    /// Whether the smallest eigenvalue is above zero.
    pub fn is_stable(&self) -> bool {
        self.smallest_eigenvalue > 0.0
    }

    /// The smallest factor, 1 or above, on Young's modulus (at the same Poisson's ratio) for which the eigenvalue is at least
    /// `margin`, 0 to less than 1, in the same shape with a newly chosen natural shape. With margin 0 the strand is exactly at
    /// the limit: it needs a little more.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a margin out of range.
    pub fn youngs_scale(&self, margin: f64) -> Result<f64> {
        check_margin(margin)?;
        let scale = (1.0 - self.smallest_eigenvalue) / (1.0 - margin);
        Ok(if scale < 1.0 { 1.0 } else { scale })
    }

    /// The same for a factor on both radii of the section: stiffness grows with its fourth power, weight with its square.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a margin out of range.
    pub fn radius_scale(&self, margin: f64) -> Result<f64> {
        Ok(self.youngs_scale(margin)?.sqrt())
    }
}

/// What to change of a material to make it stiffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stiffening {
    /// Young's modulus, at the same Poisson's ratio.
    YoungsModulus,
    /// Both semi-axes, and with them the weight.
    Radius,
}

impl Stiffening {
    /// The factor for a strand: see [`Stability::youngs_scale`].
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a margin out of range.
    pub fn scale(self, stability: &Stability, margin: f64) -> Result<f64> {
        match self {
            Self::YoungsModulus => stability.youngs_scale(margin),
            Self::Radius => stability.radius_scale(margin),
        }
    }

    /// A material with this factor.
    #[must_use]
    pub fn applied(self, material: &Material, scale: f64) -> Material {
        match self {
            Self::YoungsModulus => Material { youngs_modulus: material.youngs_modulus * scale, ..*material },
            Self::Radius => Material { radius: material.radius.map(|radius| radius * scale), ..*material },
        }
    }
}

/// Checks that a margin of stability is 0 to less than 1.
pub(crate) fn check_margin(margin: f64) -> Result<()> {
    if (0.0..1.0).contains(&margin) { Ok(()) } else { Err(Error::invalid("margin", margin, "0 to less than 1")) }
}

/// The stability under gravity (m/s²) of a strand of this definition in the shape `curvatures`, one row per element (frozen
/// freedoms at their natural values), held there by the natural shape of
/// [`natural_under_gravity`](super::rest_shape::natural_under_gravity). Costs the cube of the number of elements.
///
/// # Errors
/// [`Error::InvalidArgument`] for an invalid definition, rows or gravity.
pub fn stability_under_gravity(strand: &StrandDef, curvatures: &[[f64; 3]], gravity: Vector3<f64>) -> Result<Stability> {
    Ok(Stability { smallest_eigenvalue: equilibrium::smallest_eigenvalue(strand, curvatures, gravity)? })
}
