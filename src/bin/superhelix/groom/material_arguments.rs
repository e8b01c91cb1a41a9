//! The material on the command line: a kind of hair, flags that change single values of it, and sliders.

use clap::Args;
use superhelix::hair::{CurlFormula, HairParameters, HairType, Sliders, Variation};
use superhelix::{Error, GroomOptions, Material, StrandContact};

use crate::shell::failure::Failure;

/// Section and material of all strands.
#[derive(Debug, Args)]
#[command(next_help_heading = "Material (SI units)")]
pub struct MaterialArguments {
    /// Kind of hair: asian, caucasian1, caucasian2, african (Bertails et al. 2006, appendix B), h1, h2, ga1, gc3 (Bonanni and Kmoch 2008,
    /// table 1). The flags below change single values of it.
    #[arg(long = "type", value_name = "TYPE", default_value = "caucasian1", value_parser = hair_type)]
    kind: HairType,
    /// Mean radius of the section, the square root of a1 a2, m.
    #[arg(long, value_name = "M")]
    radius: Option<f64>,
    /// Longer semi-axis over the shorter one.
    #[arg(long, value_name = "RATIO")]
    ellipticity: Option<f64>,
    /// Density, kg/m3.
    #[arg(long, value_name = "KG/M3")]
    density: Option<f64>,
    /// Young's modulus, Pa.
    #[arg(long, value_name = "PA")]
    youngs_modulus: Option<f64>,
    /// Poisson's ratio.
    #[arg(long, value_name = "RATIO")]
    poisson_ratio: Option<f64>,
    /// Internal friction gamma, kg m3/s.
    #[arg(long, value_name = "GAMMA")]
    internal_friction: Option<f64>,
    /// Kelvin-Voigt time mu, s.
    #[arg(long, value_name = "S")]
    viscosity: Option<f64>,
    /// Air drag nu, kg/(m s).
    #[arg(long, value_name = "NU")]
    air_drag: Option<f64>,
    /// Slider -1 to 1: curlier, straight at -1. Of a groom: its strands' own natural curvatures, in proportion.
    #[arg(long, value_name = "X", default_value_t = 0.0, allow_negative_numbers = true)]
    curliness: f64,
    /// Slider -1 to 1: stiffer than the values above (docs/theory/hair_types.md has what all sliders do).
    #[arg(long, value_name = "X", default_value_t = 0.0, allow_negative_numbers = true)]
    stiffness: f64,
    /// Slider -1 to 1: more disciplined, less frizzy.
    #[arg(long, value_name = "X", default_value_t = 0.0, allow_negative_numbers = true)]
    discipline: f64,
    /// Slider -1 to 1: heavier.
    #[arg(long, value_name = "X", default_value_t = 0.0, allow_negative_numbers = true)]
    weight: f64,
    /// Slider -1 to 1: easier to comb, less friction.
    #[arg(long, value_name = "X", default_value_t = 0.0, allow_negative_numbers = true)]
    combing_ease: f64,
    /// Seed of what varies between and along strands.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
}

/// What the strands of a groom, which have shapes of their own, are given.
#[derive(Debug, Clone, Copy)]
pub struct GroomHair {
    /// Section and material.
    pub material: Material,
    /// The slider, for natural shapes.
    pub curliness: f64,
    /// How natural shapes vary: not at all, unless discipline is below 0.
    pub variation: Variation,
}

impl GroomHair {
    /// Options that make strands of such hair, as they are drawn and with as many elements as the fit's own.
    pub fn options(&self) -> GroomOptions<'static> {
        let Self { material, curliness, variation } = *self;
        GroomOptions { curliness, variation, ..GroomOptions::of(material) }
    }

    /// Whether natural shapes are others than the groom's.
    pub fn reshapes(&self) -> bool {
        self.curliness != 0.0 || self.variation.frizz > 0.0
    }
}

/// A kind of hair by its name, for clap.
fn hair_type(text: &str) -> Result<HairType, String> {
    HairType::from_name(text).map_err(|error| match error {
        Error::InvalidArgument { expected, .. } => format!("expected {expected}"),
        other => other.to_string(),
    })
}

/// A complaint about an argument of the library in the words of the flags.
pub fn in_words_of_flags(error: Error) -> Failure {
    match error {
        Error::InvalidArgument { argument, value, expected } => {
            let field = ["hair.", "material.", "sliders.", "wisp."].iter().find_map(|head| argument.strip_prefix(head));
            let flag = field.map(|field| match field {
                "mean_radius" => "--radius".to_owned(),
                other => format!("--{}", other.replace('_', "-")),
            });
            Failure::Other(format!("{} is {value}; expected {expected}", flag.unwrap_or(argument)))
        }
        other => Failure::from(other),
    }
}

impl MaterialArguments {
    /// What strands of a groom are given, checked.
    pub fn groom(&self) -> Result<GroomHair, Failure> {
        let HairParameters { material, variation, .. } = self.parameters(CurlFormula::Exact, Variation::none())?;
        Ok(GroomHair { material, curliness: self.curliness, variation })
    }

    /// The seed of what is random.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The flag, if there is one, by which a groom's natural shapes become others.
    pub fn reshaping(&self) -> Option<&'static str> {
        if self.curliness != 0.0 {
            return Some("--curliness");
        }
        (self.discipline < 0.0).then_some("--discipline below 0")
    }

    /// Friction and radius for contact, and all else as the engine has it.
    pub fn contact(&self) -> Result<StrandContact, Failure> {
        Ok(self.parameters(CurlFormula::Exact, Variation::none())?.contact())
    }

    /// Material, natural curl, friction and variation, with the sliders and the seed of these arguments.
    pub fn parameters(&self, formula: CurlFormula, variation: Variation) -> Result<HairParameters, Failure> {
        let mut hair = self.kind.measured();
        for (value, place) in [
            (self.radius, &mut hair.mean_radius),
            (self.ellipticity, &mut hair.ellipticity),
            (self.density, &mut hair.density),
            (self.youngs_modulus, &mut hair.youngs_modulus),
            (self.poisson_ratio, &mut hair.poisson_ratio),
            (self.internal_friction, &mut hair.internal_friction),
            (self.air_drag, &mut hair.air_drag),
        ] {
            *place = value.unwrap_or(*place);
        }
        let mut parameters = hair.parameters(formula).map_err(in_words_of_flags)?;
        parameters.variation = Variation { seed: self.seed, ..variation };
        parameters.material.viscosity = self.viscosity.unwrap_or(0.0);
        parameters.material.check("material").map_err(in_words_of_flags)?;
        let sliders = Sliders {
            curliness: self.curliness,
            stiffness: self.stiffness,
            discipline: self.discipline,
            weight: self.weight,
            combing_ease: self.combing_ease,
        };
        parameters.with_sliders(&sliders).map_err(in_words_of_flags)
    }
}
