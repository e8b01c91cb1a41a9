//! Parameters that the strands of a head share, and five high-level sliders that change them.
//!
//! A slider goes from −1 to 1; 0 changes nothing. Each field says what it does. A factor is 1 + (F − 1) x above zero and its
//! reciprocal below (`factor`), so that x and −x cancel and no platform function affects the numbers.

use super::hair_type::{DISCIPLINED_DRAG, FUZZY_DRAG};
use super::variation::Variation;
use crate::contact::options::{Friction, StrandContact};
use crate::error::{Error, Result, check_not_negative};
use crate::rod::definition::{check_lengths, check_rows};
use crate::rod::material::Material;

/// How natural curvatures follow from a measured helix of radius r and step Δ, with p = Δ/2π.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CurlFormula {
    /// κ1 = r/(r² + p²), κ0 = p/(r² + p²): the helix itself.
    #[default]
    Exact,
    /// κ1 = 1/r, κ0 = Δ/(2π r²): Bertails et al. 2006, section 4.2. Equal in the limit of steps much shorter than the radius.
    Paper,
}

/// Parameters that the strands of a head share.
///
/// ```
/// use superhelix::hair::{CurlFormula, HairType, Variation};
///
/// let mut hair = HairType::African.measured().parameters(CurlFormula::Exact)?;
/// hair.variation = Variation::natural();
/// let strand = hair.strand(7, &[0.005; 20])?;
/// assert_eq!(strand.natural.len(), 20);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HairParameters {
    /// Section and material.
    pub material: Material,
    /// Natural twist and curvatures (κ0, κ1, κ2), rad/m.
    pub natural: [f64; 3],
    /// Friction against hair and bodies, relative to the engine's own coefficients; zero or above.
    pub friction: f64,
    /// How strands deviate from that.
    pub variation: Variation,
}

/// High-level sliders, each from −1 to 1; 0 changes nothing.
///
/// ```
/// use superhelix::hair::{CurlFormula, HairType, Sliders};
///
/// let hair = HairType::Caucasian2.measured().parameters(CurlFormula::Exact)?;
/// let wet = hair.with_sliders(&Sliders { weight: 1.0, curliness: -0.5, ..Sliders::default() })?;
/// assert!(wet.material.density > 1.9 * hair.material.density);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sliders {
    /// Curliness: −1 is straight, and the natural curvature grows linearly to its own value at 0; above 0 it grows to 1.5 times
    /// that or to 400 rad/m (curls of 2.5 mm), whichever is more. Twist follows in proportion (without curvature: 0.13 of it, as
    /// in Caucasian 2 hair).
    pub curliness: f64,
    /// Stiffness: Young's modulus, by a factor of up to 8.
    pub stiffness: f64,
    /// Discipline, the opposite of frizz. Above 0, variation along and between strands, and frizz, shrink to nothing at 1, and
    /// air drag goes to 5e-6 kg/(m·s). Below 0, frizz grows by up to 60 rad/m, variation by up to 0.2, and air drag goes to 5e-5
    /// kg/(m·s).
    pub discipline: f64,
    /// Weight (wet, dyed): density, by a factor of up to 2.
    pub weight: f64,
    /// Ease of combing: friction against hair and bodies, and the internal friction that represents friction inside a lock, by a
    /// factor of up to 1/3.
    pub combing_ease: f64,
}

/// The least curvature at curliness 1, rad/m.
const CURLY: f64 = 400.0;
/// Twist over curvature of straight hair when it curls: that of Caucasian 2 hair, p/r = 0.5 cm/(2π 0.6 cm).
const TWIST_FRACTION: f64 = 0.132_629;
/// Frizz at discipline −1, rad/m.
const FRIZZ: f64 = 60.0;
/// Variation along and between strands at discipline −1.
const LOOSE: f64 = 0.2;

/// See the comment of this module.
fn factor(x: f64, most: f64) -> f64 {
    if x >= 0.0 { 1.0 + (most - 1.0) * x } else { 1.0 / (1.0 - (most - 1.0) * x) }
}

impl Sliders {
    /// Checks that all are from −1 to 1; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first that is not.
    pub fn check(&self, argument: &str) -> Result<()> {
        for (name, value) in [
            ("curliness", self.curliness),
            ("stiffness", self.stiffness),
            ("discipline", self.discipline),
            ("weight", self.weight),
            ("combing_ease", self.combing_ease),
        ] {
            if !(-1.0..=1.0).contains(&value) {
                return Err(Error::invalid(format!("{argument}.{name}"), value, "a number from -1 to 1"));
            }
        }
        Ok(())
    }
}

impl HairParameters {
    /// Checks every value; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        self.material.check(argument)?;
        for (axis, value) in self.natural.iter().enumerate() {
            crate::error::check_finite(|| format!("{argument}.natural[{axis}]"), *value)?;
        }
        check_not_negative(|| format!("{argument}.friction"), self.friction)?;
        self.variation.check(argument)
    }

    /// The parameters with the sliders moved.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a value out of range, before or after.
    pub fn with_sliders(&self, sliders: &Sliders) -> Result<Self> {
        sliders.check("sliders")?;
        self.check("hair")?;
        let mut hair = *self;
        hair.natural = curled(self.natural, sliders.curliness);
        hair.material.youngs_modulus *= factor(sliders.stiffness, 8.0);
        hair.material.density *= factor(sliders.weight, 2.0);
        hair.material.internal_friction *= factor(-sliders.combing_ease, 3.0);
        hair.friction *= factor(-sliders.combing_ease, 3.0);
        let (x, own) = (sliders.discipline, self.variation);
        let drag = self.material.air_drag;
        if x >= 0.0 {
            let variation = &mut hair.variation;
            variation.along = own.along * (1.0 - x);
            variation.between = own.between * (1.0 - x);
            variation.thickness = own.thickness * (1.0 - x);
            variation.frizz = own.frizz * (1.0 - x);
            hair.material.air_drag = drag + x * (drag.min(DISCIPLINED_DRAG) - drag);
        } else {
            let variation = &mut hair.variation;
            variation.along = (own.along - LOOSE * x).min(Variation::MAX_DEVIATION.max(own.along));
            variation.between = (own.between - LOOSE * x).min(Variation::MAX_DEVIATION.max(own.between));
            variation.frizz = own.frizz - FRIZZ * x;
            hair.material.air_drag = drag - x * (drag.max(FUZZY_DRAG) - drag);
        }
        hair.check("hair")?;
        Ok(hair)
    }

    /// The contact parameters of such a strand: the engine's own values with this hair's radius and friction.
    pub fn contact(&self) -> StrandContact {
        let own = StrandContact::default();
        let scaled =
            |friction: Friction| Friction { along: friction.along * self.friction, against: friction.against * self.friction };
        let [a1, a2] = self.material.radius;
        StrandContact {
            radius: a1.max(a2),
            friction: scaled(own.friction),
            hair_friction: scaled(own.hair_friction),
            viscous_friction: scaled(own.viscous_friction),
            ..own
        }
    }
}

/// Curvature below which a strand counts as straight, rad/m: a circle of a million kilometres.
const STRAIGHT: f64 = 1e-9;

/// The natural twist and curvatures of a strand with a shape of its own (rows of (κ0, κ1, κ2), rad/m, of elements of these
/// lengths, m) after moving the slider [`Sliders::curliness`]. One factor scales all rows: the slider's factor for hair of this
/// strand's root mean square curvature. −1 is straight; 1 is 1.5 times its own curvature or 400 rad/m in the mean. Straight
/// strands curl like straight types.
///
/// # Errors
/// [`Error::InvalidArgument`] for a slider out of range (`curliness`), lengths that are not above zero, rows that are not finite
/// or not one per element.
pub fn curled_shape(element_lengths: &[f64], natural: &[[f64; 3]], curliness: f64) -> Result<Vec<[f64; 3]>> {
    Sliders { curliness, ..Sliders::default() }.check("").map_err(|error| error.renamed(".", ""))?;
    check_rows("natural", natural, element_lengths.len())?;
    check_lengths("element_lengths", element_lengths)?;
    let (mut square, mut length) = (0.0, 0.0);
    for (part, [_, first, second]) in element_lengths.iter().zip(natural) {
        square += part * (first * first + second * second);
        length += part;
    }
    let mean = (square / length).sqrt();
    if mean < STRAIGHT {
        return Ok(natural.iter().map(|[twist, ..]| curled([*twist, 0.0, 0.0], curliness)).collect());
    }
    let [_, wanted, _] = curled([0.0, mean, 0.0], curliness);
    Ok(natural.iter().map(|row| row.map(|value| value * (wanted / mean))).collect())
}

/// See [`Sliders::curliness`].
fn curled([twist, first, second]: [f64; 3], x: f64) -> [f64; 3] {
    let curvature = (first * first + second * second).sqrt();
    if x <= 0.0 {
        return [twist, first, second].map(|value| value * (1.0 + x));
    }
    let wanted = curvature + x * ((1.5 * curvature).max(CURLY) - curvature);
    if curvature == 0.0 {
        return [twist + TWIST_FRACTION * wanted, wanted, 0.0];
    }
    [twist, first, second].map(|value| value * (wanted / curvature))
}
