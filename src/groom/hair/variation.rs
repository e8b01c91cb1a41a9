//! Random variation between strands and along them: seeded, and independent of the order of queries.
//!
//! Every number is a function of the seed, the strand and a place: there is no generator with a state. Along a strand the numbers
//! are a function of arclength, so more elements resolve the same hair better instead of making another. They have mean 0 and
//! variance 1, and are sums of four uniform ones, so never beyond 2√3. Only sums, products and square roots are used, which have
//! the same bits everywhere.

use super::hair_parameters::HairParameters;
use crate::error::{Error, Result, check_not_negative};
use crate::math::random::mixed;
use crate::rod::definition::{check_lengths, check_rows};
use crate::rod::material::Material;

/// How the strands of a head vary.
///
/// ```
/// use superhelix::hair::Variation;
///
/// let variation = Variation { frizz: 12.0, seed: 5, ..Variation::none() };
/// let straight = [[0.0; 3]; 8];
/// let frizzy = variation.of_shape(0, &[0.025; 8], &straight)?;
/// assert_ne!(frizzy, straight);
/// assert_eq!(frizzy, variation.of_shape(0, &[0.025; 8], &straight)?);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variation {
    /// Natural twist and curvature, between strands: standard deviation over the mean; 0 to 0.25.
    pub between: f64,
    /// Natural twist and curvature, along a strand (Bertails et al. 2006, section 4.2: "small random variations along each
    /// Super-Helix"): standard deviation over the mean; 0 to 0.25.
    pub along: f64,
    /// Radius of the section, between strands: standard deviation over the mean; 0 to 0.25.
    pub thickness: f64,
    /// Additional natural curvature in random directions along a strand: standard deviation, rad/m; zero or above. Makes straight
    /// hair frizzy.
    pub frizz: f64,
    /// The arclength over which properties vary along a strand, m; 1e-4 or above.
    pub period: f64,
    /// The roots' frames are turned about their tangents by up to this angle either way, rad; 0 to π. Curls are then out of
    /// phase.
    pub root_turn: f64,
    /// Another seed gives other strands of the same type.
    pub seed: u64,
}

impl Default for Variation {
    fn default() -> Self {
        Self::none()
    }
}

/// A strand with its variation.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedStrand {
    /// Section and material.
    pub material: Material,
    /// Natural twist and curvatures of each element, rad/m.
    pub natural: Vec<[f64; 3]>,
    /// The rotation of the root's frame about its tangent, rad.
    pub root_turn: f64,
}

/// The varied quantity: each has its own numbers.
#[derive(Clone, Copy)]
enum Of {
    Curl = 1,
    Thickness,
    Turn,
    AlongTwist,
    AlongCurl,
    FrizzFirst,
    FrizzSecond,
}

impl Variation {
    /// The greatest relative deviation: beyond it a number three and a half deviations below its mean would change its sign.
    pub const MAX_DEVIATION: f64 = 0.25;

    /// No variation; 2 cm.
    pub const fn none() -> Self {
        Self { between: 0.0, along: 0.0, thickness: 0.0, frizz: 0.0, period: 0.02, root_turn: 0.0, seed: 0 }
    }

    /// A natural amount of each: 0.1 between, 0.1 along, thickness 0.08, frizz 8 rad/m, roots turned by up to half a radian.
    pub const fn natural() -> Self {
        Self { between: 0.1, along: 0.1, thickness: 0.08, frizz: 8.0, period: 0.02, root_turn: 0.5, seed: 0 }
    }

    /// Checks every value; messages put `argument` before the field's name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        for (name, value) in [("between", self.between), ("along", self.along), ("thickness", self.thickness)] {
            if !(0.0..=Self::MAX_DEVIATION).contains(&value) {
                return Err(Error::invalid(format!("{argument}.{name}"), value, "a number from 0 to 0.25"));
            }
        }
        check_not_negative(|| format!("{argument}.frizz"), self.frizz)?;
        if !(self.period >= 1e-4 && self.period.is_finite()) {
            return Err(Error::invalid(format!("{argument}.period"), self.period, "a finite number, 1e-4 or above"));
        }
        if (0.0..=std::f64::consts::PI).contains(&self.root_turn) {
            return Ok(());
        }
        Err(Error::invalid(format!("{argument}.root_turn"), self.root_turn, "a number from 0 to pi"))
    }

    /// The sum of four uniform numbers of a place, with mean 0 and variance 1.
    fn number(&self, strand: u64, of: Of, place: u64) -> f64 {
        let mut state = mixed(self.seed ^ mixed(strand ^ mixed(place.wrapping_mul(8).wrapping_add(of as u64))));
        let mut sum = 0.0;
        for _ in 0..4 {
            state = mixed(state.wrapping_add(0x9e37_79b9_7f4a_7c15));
            sum += (state >> 11) as f64 * (1.0 / (1_u64 << 53) as f64);
        }
        (sum - 2.0) * 3.0_f64.sqrt()
    }

    /// A number that changes over `period`: interpolated between two places, with variance 1 throughout.
    fn along(&self, strand: u64, of: Of, arclength: f64) -> f64 {
        let place = arclength / self.period;
        let before = place.floor();
        let fraction = place - before;
        let (first, second) = (self.number(strand, of, before as u64), self.number(strand, of, (before as u64).wrapping_add(1)));
        ((1.0 - fraction) * first + fraction * second) / ((1.0 - fraction) * (1.0 - fraction) + fraction * fraction).sqrt()
    }
}

impl Variation {
    /// The natural twist and curvatures of a strand with a shape of its own (rows of (κ0, κ1, κ2), rad/m, of elements of these
    /// lengths, m), varied like those of the strand with this number: `between`, `along` and `frizz`.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a variation out of range (`variation`), lengths that are not above zero, rows that are not
    /// finite or not one per element.
    pub fn of_shape(&self, strand: u64, element_lengths: &[f64], natural: &[[f64; 3]]) -> Result<Vec<[f64; 3]>> {
        self.check("variation")?;
        check_lengths("element_lengths", element_lengths)?;
        check_rows("natural", natural, element_lengths.len())?;
        Ok(self.varied(strand, element_lengths, |element| natural[element]))
    }

    fn varied(&self, strand: u64, element_lengths: &[f64], of: impl Fn(usize) -> [f64; 3]) -> Vec<[f64; 3]> {
        let own = 1.0 + self.between * self.number(strand, Of::Curl, 0);
        let mut begin = 0.0;
        let one = |(element, length): (usize, &f64)| {
            let middle = begin + 0.5 * length;
            begin += length;
            let varied = |of: Of, fraction: f64| if fraction == 0.0 { 0.0 } else { fraction * self.along(strand, of, middle) };
            let curl = own * (1.0 + varied(Of::AlongCurl, self.along));
            let twist = own * (1.0 + varied(Of::AlongTwist, self.along));
            let [k0, k1, k2] = of(element);
            [k0 * twist, k1 * curl + varied(Of::FrizzFirst, self.frizz), k2 * curl + varied(Of::FrizzSecond, self.frizz)]
        };
        element_lengths.iter().enumerate().map(one).collect()
    }
}

impl HairParameters {
    /// The strand with this number (any number: the same one always gives the same strand) with elements of these lengths, m.
    /// Properties that vary along it are evaluated at the elements' middles.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for parameters out of range (`hair`) and lengths that are not above zero.
    pub fn strand(&self, strand: u64, element_lengths: &[f64]) -> Result<VariedStrand> {
        self.check("hair")?;
        check_lengths("element_lengths", element_lengths)?;
        let v = &self.variation;
        let thickness = 1.0 + v.thickness * v.number(strand, Of::Thickness, 0);
        let natural = v.varied(strand, element_lengths, |_| self.natural);
        // One uniform number is enough here. The sum of four is bounded: a quarter of its range either way.
        let turn = v.number(strand, Of::Turn, 0) / (2.0 * 3.0_f64.sqrt());
        let mut material = self.material;
        material.radius = material.radius.map(|radius| radius * thickness);
        Ok(VariedStrand { material, natural, root_turn: v.root_turn * turn })
    }
}
