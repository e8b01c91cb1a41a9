//! Shapes taken as natural or rest shapes, on the command line.

use std::path::Path;

use clap::{Args, ValueEnum};
use superhelix::editing::Stiffening;

use crate::failure::Failure;
use crate::scene::posing::{Action, Operation, STIFFENINGS};
use crate::scene::{self, Scene};

/// Flags for it.
#[derive(Debug, Args)]
#[command(next_help_heading = "Rest shapes")]
pub struct RestArguments {
    /// What the strands' initial shapes become: their natural shapes, or those in which they rest under the scene's gravity.
    #[arg(long, value_enum, value_name = "SHAPE")]
    take: Option<Taken>,
    #[command(flatten)]
    stiffening: StiffeningArguments,
}

/// What initial shapes become.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Taken {
    /// Natural: without weight the strands would rest in them; with it they sag.
    Natural,
    /// Shapes of rest: the strands hang in them, sag-free. With --stiffen stably.
    Rest,
}

/// How unstable strands are made stable.
#[derive(Debug, Clone, Copy, Args)]
pub struct StiffeningArguments {
    /// Makes strands that would not rest stably as much stiffer as that takes, so that the smallest eigenvalue of the static Hessian against the
    /// elastic stiffness is at least this: 0 to less than 1; 0.05 is a start.
    #[arg(long, value_name = "MARGIN", value_parser = margin)]
    stiffen: Option<f64>,
    /// What makes them stiffer: youngs_modulus or radius (and then they are heavier, too).
    #[arg(long, value_name = "WHAT", default_value = "youngs_modulus", value_parser = stiffening)]
    stiffen_by: Stiffening,
}

impl StiffeningArguments {
    /// By what, and the margin.
    pub fn stiffening(&self) -> Option<(Stiffening, f64)> {
        self.stiffen.map(|margin| (self.stiffen_by, margin))
    }
}

fn margin(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value| (0.0..1.0).contains(value));
    value.ok_or_else(|| "expected a number, 0 to less than 1".to_string())
}

fn stiffening(text: &str) -> Result<Stiffening, String> {
    let found = STIFFENINGS.iter().find(|(name, _)| *name == text).map(|(_, by)| *by);
    found.ok_or_else(|| "expected youngs_modulus or radius".to_string())
}

impl RestArguments {
    /// Does what they say to a scene's strands.
    pub fn apply(&self, scene: &mut Scene, path: &Path) -> Result<(), Failure> {
        let stiffening = self.stiffening.stiffening();
        let action = match (self.take, stiffening) {
            (None, None) => return Ok(()),
            (Some(Taken::Natural), None) => Action::TakeNatural,
            (Some(Taken::Rest), stiffening) => Action::TakeRest(stiffening),
            (_, Some(_)) => return Err(Failure::Other("--stiffen needs --take rest: it is rest that takes stiffness".into())),
        };
        let operation = Operation { key: "--take".into(), strands: None, action };
        scene::do_posing(scene, &[operation]).map_err(|complaint| Failure::scene(path, &complaint))
    }
}
