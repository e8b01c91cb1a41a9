//! What a guide of a groom stands for, on the command line.

use clap::Args;
use serde::Serialize;
use superhelix::Wisp;
use superhelix::editing::Stiffening;

use crate::groom::material_arguments::{GroomHair, in_words_of_flags};
use crate::groom::strands::NaturalShape;
use crate::shell::failure::Failure;

/// The wisp that each strand stands for.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Wisps")]
pub struct WispArguments {
    /// How firmly a wisp's hairs hold to each other and to their style: from 0 (they slide freely and rest where they can) to 1 (lacquered). Default: 0.6.
    #[arg(long, value_name = "X", conflicts_with = "bare", allow_negative_numbers = true)]
    hold: Option<f64>,
    /// Hairs that each strand stands for. Default: 200.
    #[arg(long, value_name = "N", conflicts_with = "bare", allow_negative_numbers = true)]
    hairs: Option<f64>,
    /// Each strand is one bare hair: as limp as a hair is, a style falls.
    #[arg(long)]
    bare: bool,
}

/// What the report says of it.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct WispReport {
    /// Hairs a strand stands for.
    pub hairs: f64,
    /// How firmly they hold.
    pub hold: f64,
    /// How much stiffer than one of its hairs, for its weight.
    pub stiffer: f64,
}

impl WispArguments {
    /// For the report.
    pub fn report(&self) -> WispReport {
        let wisp = self.wisp();
        WispReport { hairs: wisp.hairs, hold: wisp.hold, stiffer: wisp.stiffening() }
    }

    /// What they say.
    pub fn wisp(&self) -> Wisp {
        if self.bare {
            return Wisp::bare();
        }
        let usual = Wisp::default();
        Wisp { hairs: self.hairs.unwrap_or(usual.hairs), hold: self.hold.unwrap_or(usual.hold) }
    }

    /// Such hairs as wisps.
    pub fn hair(&self, hair: GroomHair) -> Result<GroomHair, Failure> {
        Ok(GroomHair { material: self.wisp().material(&hair.material).map_err(in_words_of_flags)?, ..hair })
    }

    /// What wisps of that hair need to rest as they are drawn, where they are to.
    pub fn stiffening(&self, natural: NaturalShape, hair: &GroomHair) -> Option<(Stiffening, f64)> {
        let rests = natural == NaturalShape::SagFree && !hair.reshapes();
        self.wisp().margin().filter(|_| rests).map(|margin| (Stiffening::YoungsModulus, margin))
    }
}
