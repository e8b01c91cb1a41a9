//! From an error that may be made to the cheapest settings that were measured to make no more.

use crate::analysis::measured::{self, Price};
use crate::analysis::settings::{self, HairShape, Settings};
use crate::error::{Error, Result, check_positive};
use crate::step::options::{Integrator, StepOptions};

/// A set of the scenes of `docs/notebook/tradeoff.md`: what the hair is to go through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Scenes(u32);

impl Scenes {
    /// It hangs from a head that sways by a centimetre to each side at ½ Hz.
    pub const CALM_SWAY: Scenes = Scenes(1);
    /// It leaves a walking head sideways and down.
    pub const WALK: Scenes = Scenes(2);
    /// The head turns by ±46° and sways by ±8 cm at 2 Hz.
    pub const HEAD_SHAKE: Scenes = Scenes(4);
    /// The head bounces by ±2 cm at 3 Hz.
    pub const CURLY_BOUNCE: Scenes = Scenes(8);
    /// 3 cm of it stand out from a head that turns by ±20° at 3 Hz.
    pub const STIFF_BRISTLE: Scenes = Scenes(16);
    /// It hangs in gusts of up to 7 m/s.
    pub const WIND_GUST: Scenes = Scenes(32);
    /// All six.
    pub const ALL: Scenes = Scenes(63);

    /// Their names, in the order of the bits.
    pub const NAMES: [&'static str; 6] = ["calm_sway", "walk", "head_shake", "curly_bounce", "stiff_bristle", "wind_gust"];

    /// The set with these bits.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an empty set or an unknown bit.
    pub fn from_bits(argument: &str, bits: u32) -> Result<Self> {
        if bits == 0 || bits > Self::ALL.0 {
            return Err(Error::invalid(argument, bits, "a non-empty set of the six scenes (bits 1 to 32)"));
        }
        Ok(Self(bits))
    }

    /// The set's bits.
    pub fn bits(self) -> u32 {
        self.0
    }

    /// Both sets together.
    #[must_use]
    pub fn union(self, other: Scenes) -> Scenes {
        Scenes(self.0 | other.0)
    }

    fn indices(self) -> impl Iterator<Item = usize> {
        (0..Self::NAMES.len()).filter(move |index| self.0 & (1 << index) != 0)
    }
}

impl Default for Scenes {
    fn default() -> Self {
        Self::ALL
    }
}

/// A setting of the measured product.
#[derive(Clone, Copy)]
struct Candidate {
    rate: u32,
    elements: u32,
    error: f64,
    cost: f64,
}

/// The measured product for a type of hair. A setting's error is the worst of the scenes, and no less than that of any finer setting: one
/// that was lucky is not believed. Its cost is that of the dearest scene.
fn candidates(kind: usize, scenes: Scenes) -> Vec<Candidate> {
    let mut candidates: Vec<Candidate> = Vec::new();
    for (step, rate) in measured::RATES.into_iter().enumerate().rev() {
        for (fineness, elements) in measured::ELEMENTS.into_iter().enumerate().rev() {
            let worst = |of: fn(&Price) -> f32| {
                let most =
                    scenes.indices().map(|scene| of(&measured::SECOND_ORDER[kind][scene][step][fineness])).fold(0.0, f32::max);
                f64::from(most)
            };
            let finer = candidates.iter().filter(|finer| finer.elements >= elements).map(|finer| finer.error);
            let error = finer.fold(worst(|price| price.0), f64::max);
            candidates.push(Candidate { rate, elements, error, cost: worst(|price| price.1) });
        }
    }
    candidates
}

/// The cheapest settings that were measured to err by no more than `target_error`, for hair of that shape, frames of `frame_time` seconds and
/// what the hair is to go through.
///
/// The error is the root mean square distance of the strand's points from where they should be, over two seconds, in units of its length:
/// for an error in metres divide by the length. Measured were the four hair types of Bertails et al. 2006 (appendix B) at
/// [`LENGTHS`](measured::LENGTHS), second order in the step. The answer holds for the type that is as curled as the hair asked for or the
/// next more curled; longer strands get more elements in proportion, shorter ones no fewer. Hair of other stiffness, weight or friction,
/// or in wilder motion, errs by more or less.
///
/// # Errors
/// [`Error::InvalidArgument`] naming `target_error` (below what the finest measured settings reach, which is said), `curvature` (more
/// curled than what was measured), `length` or `frame_time`.
pub fn suggest_settings(target_error: f64, scenes: Scenes, hair: &HairShape, frame_time: f64) -> Result<Settings> {
    check_positive(|| "target_error".into(), target_error)?;
    hair.check()?;
    settings::substeps(frame_time, 1.0 / f64::from(measured::RATES[measured::RATES.len() - 1]))?;
    let Some(kind) = hair.measured_type() else {
        let most = measured::CURVATURES[measured::CURVATURES.len() - 1];
        return Err(Error::invalid("curvature", hair.curvature, format!("at most {most:.0} rad/m: more was not measured")));
    };
    let longer = (hair.length / measured::LENGTHS[kind]).max(1.0);
    let mut chosen: Option<Settings> = None;
    let mut best = f64::INFINITY;
    for candidate in candidates(kind, scenes) {
        best = best.min(candidate.error);
        // The table has three digits.
        if candidate.error > target_error * (1.0 + 1e-6) {
            continue;
        }
        let rate = f64::from(candidate.rate);
        let substeps = settings::substeps(frame_time, 1.0 / rate)?;
        let elements = settings::elements(hair, (f64::from(candidate.elements) * longer).ceil())?;
        let cost =
            candidate.cost * f64::from(substeps) / (frame_time * rate) * f64::from(elements) / f64::from(candidate.elements);
        if chosen.is_none_or(|chosen| chosen.cost.is_none_or(|least| cost < least)) {
            let step =
                StepOptions { integrator: Integrator::SecondOrder, tolerance: measured::TOLERANCE, ..StepOptions::default() };
            chosen = Some(Settings { step, substeps, elements, error: Some(candidate.error), cost: Some(cost) });
        }
    }
    chosen.ok_or_else(|| {
        let finest = format!("{best:.2e} or more: the least that was measured in these scenes with this type of hair");
        Error::invalid("target_error", target_error, finest)
    })
}
