//! Settings of render hair.

use crate::error::{Error, Result, check_not_negative, check_positive};
use crate::math::lanes::InstructionSet;
use crate::workers::Workers;

/// Most guides per render strand.
pub const MAX_GUIDES: usize = 4;
/// Most points of a render strand.
pub const MAX_POINTS: usize = 4096;
/// Most wisps per guide.
pub const MAX_WISPS: usize = 10_000;

/// What is mixed where a render strand lies between guides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Space {
    /// Positions: the strand stays between its guides. Curls that are out of phase cancel. For straight and gently wavy hair.
    #[default]
    Position,
    /// Lengths and curvatures: the strand has the mean length and the mean curl of its guides, which determine the position of
    /// its tip. For curly hair.
    Curvature,
}

/// Settings of render hair. Lengths in m.
///
/// ```
/// use superhelix::render::RenderSettings;
///
/// // Curly hair in tight wisps, kept 1 mm out of bodies.
/// let settings = RenderSettings { curliness: 0.8, wisps_per_guide: 6, clearance: 1e-3, ..RenderSettings::default() };
/// settings.check("settings.")?;
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct RenderSettings {
    /// Points per strand, root and tip included, 2 to [`MAX_POINTS`]; also the number of samples of each guide. Default 16.
    pub points_per_strand: usize,
    /// What to mix between guides.
    pub space: Space,
    /// Most guides per strand, 1 to [`MAX_GUIDES`]. Default 4: with fewer, strands do not follow linear variations over the
    /// scalp exactly.
    pub guides_per_strand: usize,
    /// 0 to 1, from hair that is interpolated over its whole length (0) over hair that is interpolated at the root and gathers in
    /// wisps at the tip (0.5) to disjoint locks (1). With u the curliness, strands blend into their wisp by the fraction c(s) = m
    /// S(s/e), where s runs from 0 at the root to 1 at the tip, m = min(1, 2u), e = min(1, max(0.1, 2 − 2u)) and S(x) = 3x² − 2x³
    /// (1 beyond); where that would kink a strand's root, it blends later. Default 0.5.
    pub curliness: f64,
    /// Whether each guide has a curliness of its own instead, measured on its shape
    /// ([`measured_curliness`](super::measured_curliness)).
    pub measure_curliness: bool,
    /// Guides whose tips are farther apart than their roots by more than this are not mixed in a strand; above 0. Default:
    /// infinite.
    pub max_tip_distance: f64,
    /// The same as a fraction of the shorter guide's length. Default 0.6.
    pub max_tip_ratio: f64,
    /// Wisps per guide, 1 to [`MAX_WISPS`]: with more than one, neighbouring strands gather around a line beside the guide.
    /// Default 4.
    pub wisps_per_guide: usize,
    /// A wisp's radius at root, middle and tip, relative to the one that its roots determine; 0 or above. Default 1, 0.6, 0.08.
    pub wisp_profile: [f64; 3],
    /// 0 to 1: how much wisps' sections are flattened along the scalp's normal. 0 (default): as round as their patch of scalp; 1:
    /// ribbons.
    pub flatness: f64,
    /// Root mean square deviation of whole wisps from their path at the tip, growing from nothing at the root; 0 or above.
    /// Default 0.
    pub clump_noise: f64,
    /// Waves of that along a strand, above 0 to 1000. Default 1.5.
    pub clump_noise_waves: f64,
    /// Fraction of the strands that leave their wisps, 0 to 1. Default 0.02.
    pub flyaways: f64,
    /// Root mean square deviation of those strands from their path at the tip; 0 or above. Default 5 mm.
    pub flyaway_distance: f64,
    /// Root mean square deviation of strands from their path at the tip, growing from nothing at the root; 0 or above. Default 0.
    pub frizz: f64,
    /// Waves of that along a strand, above 0 to 1000. Default 3.
    pub frizz_waves: f64,
    /// Radius at the root; 0 or above. Default 40 µm.
    pub radius: f64,
    /// Radius at the tip. Default 15 µm.
    pub tip_radius: f64,
    /// The fraction of the length from which the radius tapers linearly to that of the tip; 0 to less than 1. Default 0.5.
    pub taper_from: f64,
    /// The shape of the taper, above −1 to below 1: 0 (default) is linear; above 0 strands stay thick and end bluntly; below 0
    /// they get thin early.
    pub taper_shape: f64,
    /// The largest relative difference of radii between strands, 0 to 1. Default 0.1.
    pub radius_variation: f64,
    /// The largest fraction by which strands are cut short, each by its own random one; 0 to less than 1. Default 0.25.
    pub length_variation: f64,
    /// Whether strands are as long as their guides (before they are cut short): their points move along their path until they are
    /// as far apart as the guides', so that neither mixing nor wisps nor bodies shorten or stretch them. Default: yes.
    pub preserve_length: bool,
    /// The distance from a body at which strands are pushed ([`View::bodies`](super::View::bodies)): deeper points are moved
    /// between this and the surface, in the order of depth; above 0. Default 2 mm.
    pub clearance: f64,
    /// Seed of everything random.
    pub seed: u64,
    /// Which threads evaluate.
    pub workers: Workers,
    /// Vector instructions to use; `None` for the best of the machine. The results' bits do not depend on it.
    pub instruction_set: Option<InstructionSet>,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            points_per_strand: 16,
            space: Space::Position,
            guides_per_strand: 4,
            curliness: 0.5,
            measure_curliness: false,
            max_tip_distance: f64::INFINITY,
            max_tip_ratio: 0.6,
            wisps_per_guide: 4,
            wisp_profile: [1.0, 0.6, 0.08],
            flatness: 0.0,
            clump_noise: 0.0,
            clump_noise_waves: 1.5,
            flyaways: 0.02,
            flyaway_distance: 5e-3,
            frizz: 0.0,
            frizz_waves: 3.0,
            radius: 40e-6,
            tip_radius: 15e-6,
            taper_from: 0.5,
            taper_shape: 0.0,
            radius_variation: 0.1,
            length_variation: 0.25,
            preserve_length: true,
            clearance: 2e-3,
            seed: 0,
            workers: Workers::Serial,
            instruction_set: None,
        }
    }
}

impl RenderSettings {
    /// Checks every field; messages put `outer` before its name.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the field; [`Error::Unsupported`] for instructions that the machine does not have.
    pub fn check(&self, outer: &str) -> Result<()> {
        let within = |name: &str, value: f64, low: f64, high: f64| {
            if (low..=high).contains(&value) {
                Ok(())
            } else {
                Err(Error::invalid(format!("{outer}{name}"), value, format!("{low} to {high}")))
            }
        };
        let count = |name: &str, value: usize, low: usize, high: usize| {
            if (low..=high).contains(&value) {
                Ok(())
            } else {
                Err(Error::invalid(format!("{outer}{name}"), value, format!("{low} to {high}")))
            }
        };
        let above = |name: &str, value: f64| {
            if value > 0.0 {
                Ok(())
            } else {
                Err(Error::invalid(format!("{outer}{name}"), value, "a number above zero (infinite: none)"))
            }
        };
        count("points_per_strand", self.points_per_strand, 2, MAX_POINTS)?;
        count("guides_per_strand", self.guides_per_strand, 1, MAX_GUIDES)?;
        count("wisps_per_guide", self.wisps_per_guide, 1, MAX_WISPS)?;
        within("curliness", self.curliness, 0.0, 1.0)?;
        above("max_tip_distance", self.max_tip_distance)?;
        above("max_tip_ratio", self.max_tip_ratio)?;
        for (knot, value) in self.wisp_profile.iter().enumerate() {
            check_not_negative(|| format!("{outer}wisp_profile[{knot}]"), *value)?;
        }
        within("flatness", self.flatness, 0.0, 1.0)?;
        within("flyaways", self.flyaways, 0.0, 1.0)?;
        for (name, value) in
            [("frizz", self.frizz), ("clump_noise", self.clump_noise), ("flyaway_distance", self.flyaway_distance)]
        {
            check_not_negative(|| format!("{outer}{name}"), value)?;
        }
        for (name, value) in [("frizz_waves", self.frizz_waves), ("clump_noise_waves", self.clump_noise_waves)] {
            if !(value > 0.0 && value <= 1000.0) {
                return Err(Error::invalid(format!("{outer}{name}"), value, "above 0, up to 1000"));
            }
        }
        if !(self.taper_shape > -1.0 && self.taper_shape < 1.0) {
            return Err(Error::invalid(format!("{outer}taper_shape"), self.taper_shape, "above -1, below 1"));
        }
        check_positive(|| format!("{outer}clearance"), self.clearance)?;
        check_not_negative(|| format!("{outer}radius"), self.radius)?;
        check_not_negative(|| format!("{outer}tip_radius"), self.tip_radius)?;
        for (name, value) in [("taper_from", self.taper_from), ("length_variation", self.length_variation)] {
            if !(0.0..1.0).contains(&value) {
                return Err(Error::invalid(format!("{outer}{name}"), value, "0 to less than 1"));
            }
        }
        within("radius_variation", self.radius_variation, 0.0, 1.0)?;
        if let Some(set) = self.instruction_set
            && set > InstructionSet::detected()
        {
            return Err(Error::Unsupported {
                argument: format!("{outer}instruction_set"),
                value: set.name().into(),
                hint: format!("this machine has {}", InstructionSet::detected().name()),
            });
        }
        self.workers.check(outer.trim_end_matches('.'))
    }
}
