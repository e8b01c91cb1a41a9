//! How strands differ from each other and along themselves: seeded, the same whoever asks, in whatever order.
//!
//! Every number is a function of the seed, the strand and a place: there is no generator whose state would have to be carried. Along a strand
//! they are a function of arclength, so that more elements resolve the same hair better instead of making another. The numbers have mean 0
//! and variance 1, are sums of four uniform ones and never beyond 2√3; only sums, products and square roots are used, which are the same bits
//! everywhere.

use crate::error::{Error, Result, check_not_negative};
use crate::groom::hair_parameters::HairParameters;
use crate::math::random::mixed;
use crate::rod::definition::{check_lengths, check_rows};
use crate::rod::material::Material;

/// How strands of a head vary.
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
    /// Of the natural twist and curvature from strand to strand: standard deviation over the mean; 0 to 0.25.
    pub between: f64,
    /// Of the natural twist and curvature along a strand (Bertails et al. 2006, section 4.2: "small random variations along each
    /// Super-Helix"): standard deviation over the mean; 0 to 0.25.
    pub along: f64,
    /// Of the section's radius from strand to strand: standard deviation over the mean; 0 to 0.25.
    pub thickness: f64,
    /// Natural curvature in random directions that is added along a strand: standard deviation, rad/m; zero or above. What makes straight
    /// hair frizzy.
    pub frizz: f64,
    /// The arclength over which what varies along a strand changes, m; 1e-4 or above.
    pub period: f64,
    /// The roots' frames are turned about their tangents by up to so much either way, rad; 0 to π. Strands with curls then are out of step.
    pub root_turn: f64,
    /// Another seed, other strands of the same kind.
    pub seed: u64,
}

impl Default for Variation {
    fn default() -> Self {
        Self::none()
    }
}

/// A strand that varies.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedStrand {
    /// Section and material.
    pub material: Material,
    /// Natural twist and curvatures of each element, rad/m.
    pub natural: Vec<[f64; 3]>,
    /// By how much to turn the root's frame about its tangent, rad.
    pub root_turn: f64,
}

/// What is asked for: each has its own numbers.
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
    pub const MOST: f64 = 0.25;

    /// No variation; 2 cm.
    pub const fn none() -> Self {
        Self { between: 0.0, along: 0.0, thickness: 0.0, frizz: 0.0, period: 0.02, root_turn: 0.0, seed: 0 }
    }

    /// A little of each, as people have it: 0.1 between, 0.1 along, thickness 0.08, frizz 8 rad/m, roots turned by up to half a radian.
    pub const fn natural() -> Self {
        Self { between: 0.1, along: 0.1, thickness: 0.08, frizz: 8.0, period: 0.02, root_turn: 0.5, seed: 0 }
    }

    /// Checks every value; `argument` is the name put before the field in the message.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the first value out of range.
    pub fn check(&self, argument: &str) -> Result<()> {
        for (name, value) in [("between", self.between), ("along", self.along), ("thickness", self.thickness)] {
            if !(0.0..=Self::MOST).contains(&value) {
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

    /// Four uniform numbers of a place, summed to mean 0 and variance 1.
    fn number(&self, strand: u64, of: Of, place: u64) -> f64 {
        let mut state = mixed(self.seed ^ mixed(strand ^ mixed(place.wrapping_mul(8).wrapping_add(of as u64))));
        let mut sum = 0.0;
        for _ in 0..4 {
            state = mixed(state.wrapping_add(0x9e37_79b9_7f4a_7c15));
            sum += (state >> 11) as f64 * (1.0 / (1_u64 << 53) as f64);
        }
        (sum - 2.0) * 3.0_f64.sqrt()
    }

    /// A number that changes over `period`: between places a mean of the two, of variance 1 throughout.
    fn along(&self, strand: u64, of: Of, arclength: f64) -> f64 {
        let place = arclength / self.period;
        let before = place.floor();
        let share = place - before;
        let (first, second) = (self.number(strand, of, before as u64), self.number(strand, of, (before as u64).wrapping_add(1)));
        ((1.0 - share) * first + share * second) / ((1.0 - share) * (1.0 - share) + share * share).sqrt()
    }
}

impl Variation {
    /// The natural twist and curvatures of a strand that has a shape of its own (rows of (κ0, κ1, κ2), rad/m, of elements of these lengths, m),
    /// varied as those of the strand of that number: `between`, `along` and `frizz`.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a variation out of range (`variation`), lengths that are not above zero, rows that are not finite or not
    /// as many as elements.
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
            let varied = |of: Of, share: f64| if share == 0.0 { 0.0 } else { share * self.along(strand, of, middle) };
            let curl = own * (1.0 + varied(Of::AlongCurl, self.along));
            let twist = own * (1.0 + varied(Of::AlongTwist, self.along));
            let [k0, k1, k2] = of(element);
            [k0 * twist, k1 * curl + varied(Of::FrizzFirst, self.frizz), k2 * curl + varied(Of::FrizzSecond, self.frizz)]
        };
        element_lengths.iter().enumerate().map(one).collect()
    }
}

impl HairParameters {
    /// The strand of that number (any number: the same one always gives the same strand) with elements of these lengths, m. What varies
    /// along it is taken at the elements' middles.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for parameters out of range (`hair`) and lengths that are not above zero.
    pub fn strand(&self, strand: u64, element_lengths: &[f64]) -> Result<VariedStrand> {
        self.check("hair")?;
        check_lengths("element_lengths", element_lengths)?;
        let v = &self.variation;
        let thickness = 1.0 + v.thickness * v.number(strand, Of::Thickness, 0);
        let natural = v.varied(strand, element_lengths, |_| self.natural);
        // A uniform number is enough here, and the sum of four is bounded: a quarter of its range either way.
        let turn = v.number(strand, Of::Turn, 0) / (2.0 * 3.0_f64.sqrt());
        let mut material = self.material;
        material.radius = material.radius.map(|radius| radius * thickness);
        Ok(VariedStrand { material, natural, root_turn: v.root_turn * turn })
    }
}
